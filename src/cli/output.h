/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OUTPUT_H
#define CEDUO_OUTPUT_H

#include "arguments.h"
#include "base/text.h"
#include "io/file.h"

/* Whether it can be written to where --output says, as far as that can be told, and that is none of the files given;
 * says why not. */
bool ceduo_output_check(const struct arguments *arguments);

/* Whether --output is this file, by whatever name. Says so. */
bool ceduo_output_is(const struct arguments *arguments, const char *path);

/* Writes to where --output says. EXIT_OUTPUT with the reason on standard error where that fails. */
enum exit_status ceduo_output_write(const struct arguments *arguments, const struct text *text);

/* The output of many scenes. With --output they wait for the last scene: in memory if they are few, otherwise in a file beside the
 * place of the output. From then on signals stay caught, so that this file is removed. */
struct output {
    struct pending_file file;
    int fd;
    bool begun; /* the file is open */
};

/* Write the text of a scene, and take it out of the text, unless it waits in memory. */
enum exit_status ceduo_output_next(struct output *output, const struct arguments *arguments, struct text *text);

/* Write the rest, and put the file in its place. `whole`: false if there must be no output. */
enum exit_status ceduo_output_end(struct output *output, const struct arguments *arguments, struct text *text, bool whole);

#endif
