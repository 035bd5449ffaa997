/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TEMPORARY_H
#define CEDUO_TEMPORARY_H

#include <stdbool.h>
#include <stddef.h>

/* A file that is to take the place of another. Where the file system can, it has no name until it is filled, and is gone
 * with the program that fills it. Otherwise, and for a moment before it takes its place, it is FILE.ceduo-tmp-PROCESS-N
 * beside it. A lock tells those of living programs from what a killed one left behind; each that begins takes that away. */
struct temporary {
    int fd; /* to be filled */
    const char *target;
    char *path; /* the first `stem` bytes are those of all temporaries of this target */
    size_t stem;
    bool named; /* something lies there */
};

/* `target` is not a link, and must stay until the end. False with errno set; to be ended even then. */
bool ceduo_temporary_begin(struct temporary *temporary, const char *target);

/* Gives it its name beside the target, if it has none yet. False with errno set. */
bool ceduo_temporary_name(struct temporary *temporary);

/* Puts it in the target's place. `wait`: for the disk, too. False with errno set. */
bool ceduo_temporary_place(struct temporary *temporary, bool wait);

void ceduo_temporary_end(struct temporary *temporary);

/* Takes away what killed programs left behind of a target. */
void ceduo_temporary_tidy(const char *target);

#endif
