/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PRINT_H
#define CEDUO_PRINT_H

#include "scenes.h"

/* Asks, and adds the answer as --format says. `pool`: see ceduo_ask(). `seconds`: that the runs took; below 0: from
 * `start` until now. */
enum exit_status ceduo_print_report(const struct arguments *arguments, const struct scene_file *file,
                                    struct ceduo_question *question, struct ceduo_pool **pool, double seconds,
                                    struct text *out);

/* Adds the pictures of a scene, from runs where they need any. */
enum exit_status ceduo_print_plots(const struct arguments *arguments, struct scene_file *file, struct text *out);

#endif
