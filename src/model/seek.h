/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SEEK_H
#define CEDUO_SEEK_H

#include "ceduo/find.h"
#include "ceduo/yield.h"
#include "io/scene_file.h"
#include "study/goal.h"

/* The value of one parameter of a scene for which one option reaches a goal at its worst control: reserves per ha, a
 * rotation, the length of a belt … Every value is tried with the same rocks, so that the answer is the same each
 * time. */

struct seek {
    struct scene_file *file; /* as it was read; the search leaves it at its last value */
    struct ceduo_search search;
    unsigned threads;
    const atomic_bool *cancel; /* may be NULL */
    struct ceduo_yield yield;  /* of the option at the value that was found, or else comes nearest: without fellings; NaN
                                * where it is not known */
};

/* Looks for it. A wrong path or range is told in `problems`. CEDUO_OK also where nothing is found. */
enum ceduo_status ceduo_seek(struct seek *seek, struct ceduo_found *found, struct problems *problems);

#endif
