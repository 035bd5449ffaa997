/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure the time of a sensitivity analysis: the paper's site with its twelve inputs, and four options today and over their
 * rotations. CSV on stdout, medians. */
#include <inttypes.h>
#include <stdio.h>

#include "frame.h"
#include "io/scene_file.h"

/* `goal`: seconds with the default points and rocks on two cores; 0: none. */
static void measure(const char *path, bool rotation, double goal, size_t repeats, size_t points, uint64_t rocks,
                    unsigned threads)
{
    struct scene_file file;
    struct scene_inputs inputs;
    read_scene(&file, path);
    if (!ceduo_inputs_collect(&file, &inputs))
        fail("no memory");
    const struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                              .scene = &file.scene,
                                              .inputs_count = inputs.n,
                                              .inputs = inputs.items,
                                              .points = points,
                                              .rocks = rocks,
                                              .rotation = rotation,
                                              .threads = threads};
    struct timing t;
    uint64_t evaluations = 0;
    for (size_t r = 0; r < repeats; r++) {
        struct ceduo_uncertainty_result answer;
        timing_begin(&t);
        if (ceduo_uncertainty_compute(&def, &answer) != CEDUO_OK)
            fail("the sensitivity failed");
        timing_end(&t, r);
        evaluations = answer.evaluations;
        ceduo_uncertainty_release(&answer);
    }
    printf("%s,%s,%zu,%zu,%" PRIu64 ",%u,%" PRIu64 ",%.3f,%.3f,%g\n", path, rotation ? "rotation" : "today", inputs.n, points,
           rocks, threads, evaluations, median(t.seconds, repeats), median(t.busy, repeats), goal);
    ceduo_scene_release(&file);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 5, 1, REPEATS_MAX), points = argument(argv, 2, CEDUO_UNCERTAINTY_POINTS, 2, SIZE_MAX);
    uint64_t rocks = argument(argv, 3, CEDUO_UNCERTAINTY_ROCKS, 2, UINT64_MAX);
    unsigned threads = (unsigned)argument(argv, 4, 2, 1, 1024);
    puts("scene,years,inputs,points,rocks,threads,evaluations,seconds_median,cpu_seconds_median,goal_seconds");
    measure("profiles/scenes/paper-site.yaml", false, .35, repeats, points, rocks, threads);
    measure("profiles/scenes/rotation.yaml", false, 0, repeats, points, rocks, threads);
    measure("profiles/scenes/rotation.yaml", true, 0, repeats, points, rocks, threads);
    return 0;
}
