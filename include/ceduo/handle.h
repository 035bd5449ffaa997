/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HANDLE_H
#define CEDUO_HANDLE_H

#include <stddef.h>
#include <stdint.h>

#include "scene.h"

/* A handle is a number that stands for a scene. Python, R and every language that can call C use these functions, whose types
 * never change. All strings are UTF-8, numbers in text have a dot, and units are those of files and results (kJ, kg, m).
 *
 *     ceduo_handle h = ceduo_open("paper-site");
 *     double share[3];
 *     if (ceduo_set(h, "forest[0].stand.stools.per_ha", "800") || ceduo_simulate(h, 1000, 1) ||
 *         ceduo_get(h, "options[0].controls[0].wooded.reach_probability", share))
 *         fprintf(stderr, "%s\n", ceduo_error(h));
 *     ceduo_close(h);
 *
 * Each function may be called by any thread. A second call for a handle that another thread uses at the same time, and a call
 * for a handle that is not open, return CEDUO_BAD_ARGUMENT. Numbers of closed handles are not used again. */
typedef uint64_t ceduo_handle;

/* Read a scene: a path, the name of a shipped scene, or "-" for standard input. Return 0 on failure, which ceduo_error(0)
 * describes. The caller closes the handle. */
ceduo_handle ceduo_open(const char *path);

/* Set the value at a path of `ceduo --list-parameters`. `text` is written as in a file: "800", "crsp", "{mean: 1, spread: .2}".
 * A path that does not exist and a text of another kind are errors at once. The next call that needs the scene checks the scene
 * with all its changes, so that several values can change together. */
enum ceduo_status ceduo_set(ceduo_handle handle, const char *path, const char *text);

/* Simulate all options. `rocks` 0: the number in the scene. `threads` 0: 1. */
enum ceduo_status ceduo_simulate(ceduo_handle handle, uint64_t rocks, unsigned threads);

/* Get a number and the ends of its 95 % interval (NaN: none): value[0], value[1], value[2]. `path` is the path of a figure in
 * the JSON of a result, "options[0].controls[0].wooded.energy_kJ.p95" (an item may have its name in the brackets), or else
 * that of a value of the scene. A figure that is null is NaN; a flag is 0 or 1. A figure is an error before ceduo_simulate(),
 * and after a later ceduo_set(). */
enum ceduo_status ceduo_get(ceduo_handle handle, const char *path, double value[3]);

/* Copy the values of single rocks, in the order of the rocks, which is the same in all options. `quantity` is "energy_kJ",
 * "speed_m_s" or "height_m" at a control, NaN for a rock that does not reach it; "stop_x_m", NaN for a rock that does not stop;
 * "weight", in a scene with blocks. `option` -1: without forest. Write at most n values to `to` (may be NULL if n is 0).
 * Return the number of rocks; -1 on failure. */
int64_t ceduo_samples(ceduo_handle handle, int option, size_t control, const char *quantity, double *to, size_t n);

/* Return a description of the last call of this thread, in English; "" if that call did not fail or was for another handle.
 * The string is valid until this thread's next call for a handle. */
const char *ceduo_error(ceduo_handle handle);

enum ceduo_status ceduo_close(ceduo_handle handle);

#endif
