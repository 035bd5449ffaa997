/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stems cost: ground contacts a second without forest beside ground contacts and encounters (stools or trees of which
 * a stem is hit) a second through it, on one thread, by turns in one run. CSV on stdout, medians. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "ceduo/ceduo.h"
#include "io/scene_file.h"
#include "measure.h"

#define REPEATS_MOST 101

struct kind {
    const char *what;
    enum ceduo_contact_model model;
    uint64_t contacts;
    struct ceduo_stem_counts stems;
    double seconds[REPEATS_MOST];
};

static void fly(struct ceduo_scene scene, struct kind *k, uint64_t rocks, size_t repeat)
{
    scene.simulation.contact_model = k->model;
    struct ceduo_run_def def = ceduo_run_def_default(&scene);
    def.option = k->model == CEDUO_INDEX ? NULL : &scene.options[0];
    def.rocks_most = rocks;
    struct ceduo_run *run;
    double start = ceduo_clock();
    if (ceduo_run_create(&def, &run) != CEDUO_OK || ceduo_run_extend(run, rocks) != CEDUO_OK)
        exit(1);
    k->seconds[repeat] = ceduo_clock() - start;
    k->contacts = ceduo_run_contacts(run);
    k->stems = ceduo_run_stems(run);
    ceduo_run_free(run);
}

static void measure(const char *path, size_t repeats, uint64_t rocks)
{
    struct scene_file file;
    struct problems problems = {0};
    if (!ceduo_scene_read(&file, path, NULL, 0, &problems))
        exit(1);
    struct kind kinds[] = {{.what = "bare", .model = CEDUO_INDEX},
                           {.what = "stems", .model = CEDUO_STEMS},
                           {.what = "poisson", .model = CEDUO_POISSON}};
    size_t n = sizeof kinds / sizeof kinds[0];
    for (size_t r = 0; r < repeats; r++)
        for (size_t k = 0; k < n; k++)
            fly(file.scene, &kinds[k], rocks, r);
    double bare = 0;
    for (size_t k = 0; k < n; k++) {
        qsort(kinds[k].seconds, repeats, sizeof(double), by_value);
        double seconds = kinds[k].seconds[repeats / 2];
        double rate = (double)(kinds[k].contacts + kinds[k].stems.met) / seconds;
        bare = k == 0 ? rate : bare;
        printf("%s,%s,%" PRIu64 ",%.4f,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%.0f,%.3f\n", path, kinds[k].what, rocks,
               seconds, kinds[k].contacts, kinds[k].stems.met, kinds[k].stems.hit, kinds[k].stems.drawn, rate, rate / bare);
    }
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

int main(int argc, char **argv)
{
    size_t repeats = argc > 1 ? strtoul(argv[1], NULL, 10) : 7;
    uint64_t rocks = argc > 2 ? strtoull(argv[2], NULL, 10) : 50000;
    if (repeats < 1 || repeats > REPEATS_MOST || rocks < 1) {
        fputs("usage: bench_stems [REPEATS [ROCKS]]\n", stderr);
        return 2;
    }
    puts("scene,what,rocks,seconds_median,contacts,met,hit,drawn,contacts_and_met_per_s,ratio_to_bare");
    measure("profiles/scenes/paper-site.yaml", repeats, rocks);
    measure("profiles/scenes/four-systems.yaml", repeats, rocks);
    return 0;
}
