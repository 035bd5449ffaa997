/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ROCK_TRAJECTORY_H
#define CEDUO_ROCK_TRAJECTORY_H

#include "base/text.h"
#include "study/snapshot.h"

/* A piece of it: a flight, or a roll along the ground. */
struct rock_piece {
    struct ceduo_piece piece;
    size_t stems; /* that it has come to, up to its end */
};

/* The trajectory of one rock, piece by piece. */
struct rock_trajectory {
    uint64_t key, rock; /* of the run and the rock that they were followed for */
    size_t n, room, at; /* pieces; how many of them are shown, 0: all */
    struct rock_piece *pieces;
    struct ceduo_stem_passed *stems; /* that it comes to */
    size_t stems_count, stems_room;
    double begun;   /* s: when the following began */
    bool cut_short; /* it took too long to be followed to its end */
    struct ceduo_trajectory whole;
    struct ceduo_polyline line; /* what is shown of it */
};

/* Follows a rock of the run with this key through the forest of an option, unless it was followed already. False without
 * memory. */
bool ceduo_rock_trajectory_follow(struct rock_trajectory *trajectory, const struct ceduo_scene *scene,
                                  const struct ceduo_option *option, uint64_t key, uint64_t rock);

/* How many of the stems lie on what is shown. */
size_t ceduo_rock_trajectory_stems(const struct rock_trajectory *trajectory);

/* A piece further (1) or back (-1), or none; says what happens on the last one shown, or how the trajectory ends. */
void ceduo_rock_trajectory_step(struct rock_trajectory *trajectory, int by, const struct ceduo_scene *scene, struct text *text);

void ceduo_rock_trajectory_free(struct rock_trajectory *trajectory);

#endif
