/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RECOVERY_H
#define CEDUO_RECOVERY_H

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

#include "base/arena.h"

/* Copies of unsaved work in the user's state folder ($XDG_STATE_HOME/ceduo, ~/.local/state/ceduo): one for each process
 * and scene, the process in the name, so that one left behind by a program that is gone is known. */

/* Where this process keeps its copy for a scene; path NULL: a scene without a file. NULL where there is no folder. To
 * be freed. */
char *ceduo_recovery_path(const char *path);

/* Writes it, the scene's path in a first comment line. */
bool ceduo_recovery_write(const char *recovery, const char *path, const char *bytes, size_t n);

/* A copy that was left behind. */
struct recovery {
    const char *file;  /* where it lies */
    const char *scene; /* whose work it is; NULL: a scene that was never saved */
    const char *title; /* of the scene; "" where it says none */
    time_t when;       /* of the last edit */
};

/* All copies whose processes have ended, the newest first; `*n` of them, in the arena. */
struct recovery *ceduo_recovery_list(struct arena *arena, size_t *n);

/* The text of a copy; NULL where it cannot be read. To be freed. */
char *ceduo_recovery_text(const char *file);

#endif
