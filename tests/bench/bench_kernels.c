/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compare the kernels with the plain walk of one rock after another, on eight scenes, by turns in one run.
 *
 *   bench_kernels [REPEATS [ROCKS]]        default 7, 5000
 *
 * CSV on stdout, one thread: medians of processor time, also per contact, per hit of a stem and per stem drawn. The kernel
 * "plain, drawn wide" is the plain walk with stools drawn by the default kernel. It shows the gain of lanes apart from drawing.
 * Exit 1 if a kernel takes more than SLOWER_MAX times as long as the plain walk on a scene, or if the two differ in a contact,
 * a hit or the mean energy. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/runs/run.h"
#include "core/runs/run_state.h"
#include "frame.h"
#include "scene/derived.h"

#define SLOWER_MAX    1.1
#define FINE_METRES   1500
#define FINE_VERTICES (4 * FINE_METRES + 1)
#define FINE_CONTROL  1350 /* m */

struct place {
    const char *name, *path;
    bool fine;    /* on a profile of FINE_VERTICES */
    size_t first; /* option, or NO_FOREST */
};

#define NO_FOREST SIZE_MAX

static const struct place places[] = {
    {"paper-site, bare", "profiles/scenes/paper-site.yaml", false, NO_FOREST},
    {"paper-site", "profiles/scenes/paper-site.yaml", false, 0},
    {"four-systems, selection", "profiles/scenes/four-systems.yaml", false, 4},
    {"standards-in-groups", "profiles/scenes/standards-in-groups.yaml", false, 0},
    {"blocks-above-the-road", "profiles/scenes/blocks-above-the-road.yaml", false, 0},
    {"tschamut-arm, bare", "profiles/scenes/tschamut-arm.yaml", false, NO_FOREST},
    {"fine profile, bare", "profiles/scenes/paper-site.yaml", true, NO_FOREST},
    {"fine profile", "profiles/scenes/paper-site.yaml", true, 0},
};

struct measure {
    const char *label;
    enum ceduo_kernel kernel;
    bool one_by_one; /* the kernel only draws stools */
    double seconds[REPEATS_MAX];
    uint64_t contacts;
    struct ceduo_stem_counts stems;
    double energy; /* J, at the last control */
};

static void simulate(const struct ceduo_scene *scene, const struct ceduo_option *option, struct measure *m, uint64_t rocks,
                     size_t repeat)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    uint64_t reached;
    def.option = option;
    def.rocks_max = rocks;
    def.kernel = m->kernel;
    double start = processor_s();
    struct ceduo_run *run;
    if (ceduo_run_create(&def, &run) != CEDUO_OK)
        fail("the run cannot be created");
    if (m->one_by_one) {
        run->walk_lanes = NULL;
        run->lanes = 1;
    }
    if (ceduo_run_extend(run, rocks) != CEDUO_OK)
        fail("the run failed");
    m->seconds[repeat] = processor_s() - start;
    m->contacts = ceduo_run_contacts(run);
    m->stems = ceduo_run_stems(run);
    m->energy = ceduo_run_energy(run, ceduo_scene_last_control(scene), &reached).mean;
    ceduo_run_free(run);
}

static bool is_same(const struct measure *a, const struct measure *b)
{
    bool energy = a->energy == b->energy || (isnan(a->energy) && isnan(b->energy));
    return a->contacts == b->contacts && a->stems.hit == b->stems.hit && a->stems.drawn == b->stems.drawn && energy;
}

/* Print nanoseconds per event, or an empty cell if there are none. */
static void print_ns(double seconds, uint64_t events)
{
    if (events > 0)
        printf(",%.1f", seconds * 1e9 / (double)events);
    else
        putchar(',');
}

static bool measure_place(const struct place *place, size_t repeats, uint64_t rocks)
{
    struct scene_file file;
    read_scene(&file, place->path);
    struct ceduo_scene scene = file.scene;
    struct ceduo_option option = {0};
    struct ceduo_belt belts[2];
    struct ceduo_control control = scene.controls[0];
    if (place->first != NO_FOREST)
        option = scene.options[place->first];
    if (place->fine) { /* both belts cover half of the slope */
        scene.slope = fine_slope(&scene.slope.segments[0], FINE_METRES, FINE_VERTICES);
        control.x = FINE_CONTROL;
        scene.controls = &control;
        for (size_t i = 0; i < option.belts_count; i++) {
            belts[i] = option.belts[i];
            belts[i].from = (double)(FINE_METRES / 2 * i);
            belts[i].to = (double)(FINE_METRES / 2 * (i + 1));
        }
        option.belts = belts;
    }
    static struct measure kernels[] = {{.label = "plain", .kernel = CEDUO_KERNEL_SCALAR},
                                       {.label = "avx2", .kernel = CEDUO_KERNEL_AVX2},
                                       {.label = "default", .kernel = CEDUO_KERNEL_BEST},
                                       {.label = "\"plain, drawn wide\"", .kernel = CEDUO_KERNEL_BEST, .one_by_one = true}};
    size_t n = sizeof kernels / sizeof kernels[0] - (place->first == NO_FOREST);
    for (size_t r = 0; r < repeats; r++)
        for (size_t k = 0; k < n; k++)
            simulate(&scene, place->first == NO_FOREST ? NULL : &option, &kernels[k], rocks, r);
    double plain_s = median(kernels[0].seconds, repeats);
    bool good = true;
    for (struct measure *m = kernels; m < kernels + n; m++) {
        double seconds = median(m->seconds, repeats), ratio = seconds / plain_s;
        printf("\"%s\",%s,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%.4f", place->name, m->label, rocks, m->contacts,
               m->stems.hit, m->stems.drawn, seconds);
        print_ns(seconds, m->contacts);
        print_ns(seconds, m->stems.hit);
        print_ns(seconds, m->stems.drawn);
        printf(",%.3f\n", ratio);
        if (ratio > SLOWER_MAX)
            fprintf(stderr, "%s: the kernel %s takes %.2f times as long as the plain walk\n", place->name, m->label, ratio);
        if (!is_same(m, &kernels[0]))
            fprintf(stderr, "%s: the kernel %s and the plain walk DISAGREE\n", place->name, m->label);
        good &= ratio <= SLOWER_MAX && is_same(m, &kernels[0]);
    }
    fflush(stdout);
    if (place->fine)
        slope_free(&scene.slope);
    ceduo_scene_release(&file);
    return good;
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 7, 1, REPEATS_MAX);
    uint64_t rocks = argument(argv, 2, 5000, 1, CEDUO_ROCKS_MAX);
    bool good = true;
    puts("scene,kernel,rocks,contacts,stems_hit,stems_drawn,seconds,ns_per_contact,ns_per_hit,ns_per_drawn,ratio_to_plain");
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        good &= measure_place(&places[i], repeats, rocks);
    return good ? 0 : 1;
}
