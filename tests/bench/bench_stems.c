/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure the cost of stems, on one thread, by turns in one run: ground contacts per second without forest, and contacts plus
 * encounters (hit stools or trees) per second through the forest. CSV on stdout, medians. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/runs/run.h"
#include "frame.h"

struct kind {
    const char *label;
    enum ceduo_contact_model model;
    uint64_t contacts;
    struct ceduo_stem_counts stems;
    double seconds[REPEATS_MAX];
};

static void simulate(struct ceduo_scene scene, struct kind *k, uint64_t rocks, size_t repeat)
{
    scene.simulation.contact_model = k->model;
    struct ceduo_run_def def = ceduo_run_def_default(&scene);
    def.option = k->model == CEDUO_CONTACT_MODEL_INDEX ? NULL : &scene.options[0];
    def.rocks_max = rocks;
    double start = ceduo_clock();
    struct ceduo_run *run = simulate_run(&def, rocks);
    k->seconds[repeat] = ceduo_clock() - start;
    k->contacts = ceduo_run_contacts(run);
    k->stems = ceduo_run_stems(run);
    ceduo_run_free(run);
}

static void measure(const char *path, size_t repeats, uint64_t rocks)
{
    struct scene_file file;
    read_scene(&file, path);
    struct kind kinds[] = {{.label = "bare", .model = CEDUO_CONTACT_MODEL_INDEX},
                           {.label = "stems", .model = CEDUO_CONTACT_MODEL_STEMS}};
    size_t n = sizeof kinds / sizeof kinds[0];
    for (size_t r = 0; r < repeats; r++)
        for (size_t k = 0; k < n; k++)
            simulate(file.scene, &kinds[k], rocks, r);
    double bare = 0;
    for (size_t k = 0; k < n; k++) {
        double seconds = median(kinds[k].seconds, repeats);
        double rate = (double)(kinds[k].contacts + kinds[k].stems.met) / seconds;
        bare = k == 0 ? rate : bare;
        printf("%s,%s,%" PRIu64 ",%.4f,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%.0f,%.3f\n", path, kinds[k].label,
               rocks, seconds, kinds[k].contacts, kinds[k].stems.met, kinds[k].stems.hit, kinds[k].stems.drawn, rate,
               rate / bare);
    }
    ceduo_scene_release(&file);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 7, 1, REPEATS_MAX);
    uint64_t rocks = argument(argv, 2, 50000, 1, UINT64_MAX);
    puts("scene,what,rocks,seconds_median,contacts,met,hit,drawn,contacts_and_met_per_s,ratio_to_bare");
    measure("profiles/scenes/paper-site.yaml", repeats, rocks);
    measure("profiles/scenes/four-systems.yaml", repeats, rocks);
    return 0;
}
