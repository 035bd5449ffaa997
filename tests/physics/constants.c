/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Print statistics of a few runs, each with its standard error: NAME VALUE ERROR. test_constants.sh compares them with other
 * numerical constants. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "ceduo/ceduo.h"
#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "physics/line_scene.h"
#include "physics/paper_site.h"
#include "scene/slope.h"

#define VERTICES 20000

static void fail(void)
{
    fputs("constants: no memory\n", stderr);
    exit(1);
}

static void show(const char *name, const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rocks)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    struct ceduo_run *run;
    struct ceduo_arrivals a;
    struct ceduo_ends ends;
    def.option = option;
    def.rocks_max = rocks;
    if (ceduo_run_create(&def, &run) != CEDUO_OK || ceduo_run_extend(run, rocks) != CEDUO_OK ||
        ceduo_run_arrivals(run, 0, &a) != CEDUO_OK || ceduo_run_ends(run, &ends) != CEDUO_OK)
        fail();
    double n = (double)rocks, contacts = (double)ceduo_run_contacts(run) / n;
    printf("%s-reach %.15g %.3g\n", name, a.reach.mean, (a.reach.hi - a.reach.lo) / 3.92);
    printf("%s-contacts %.15g %.3g\n", name, contacts, contacts / sqrt(n)); /* their spread is about their size */
    if (a.reached > 100) {
        printf("%s-speed %.15g %.3g\n", name, a.speed.mean, a.speed.se);
        printf("%s-energy %.15g %.3g\n", name, a.energy.mean, a.energy.se);
        printf("%s-height %.15g %.3g\n", name, a.height.mean, a.height.se);
        printf("%s-p95 %.15g %.3g\n", name, a.energy.p95, 3 * a.energy.se);
    }
    if (ends.stop_x.n > 100)
        printf("%s-stop %.15g %.3g\n", name, ends.stop_x.mean, ceduo_moments_se(&ends.stop_x));
    if (option)
        printf("%s-stems %.15g %.3g\n", name, (double)ceduo_run_stems(run).hit / n, sqrt((double)ceduo_run_stems(run).hit) / n);
    ceduo_run_free(run);
}

/* The paper's slope cut finely along its lines, each vertex moved by up to `by` m. */
static void show_fine(const char *name, struct ceduo_scene scene, double by, uint64_t rocks)
{
    struct ceduo_slope from = scene.slope, to = from;
    struct line_random r = {.state = 1};
    to.vertices = VERTICES;
    to.x = malloc(VERTICES * sizeof *to.x);
    to.z = malloc(VERTICES * sizeof *to.z);
    to.segments = malloc(VERTICES * sizeof *to.segments);
    if (!to.x || !to.z || !to.segments)
        fail();
    for (size_t i = 0; i < VERTICES; i++) {
        to.x[i] = from.x[from.vertices - 1] * (double)i / (VERTICES - 1);
        to.z[i] = ceduo_slope_height(&from, to.x[i]) + by * line_uniform(&r, -1, 1);
        to.segments[i] = from.segments[ceduo_slope_segment(&from, to.x[i])];
    }
    scene.slope = to;
    show(name, &scene, NULL, rocks);
    free(to.x);
    free(to.z);
    free(to.segments);
}

int main(void)
{
    for (int kind = 0; kind < CEDUO_LAW_COUNT + 2; kind++) { /* the last two with the friction bound */
        static const char *const names[][4] = {
            {"lumped", "lumped-forest", "lumped-cut", "lumped-moved"},
            {"crsp", "crsp-forest", "crsp-cut", "crsp-moved"},
            {"arm", "arm-forest", "arm-cut", "arm-moved"},
            {"lumped-bound", "lumped-bound-forest", "lumped-bound-cut", "lumped-bound-moved"},
            {"crsp-bound", "crsp-bound-forest", "crsp-bound-cut", "crsp-bound-moved"}};
        const char *const *name = names[kind];
        int law = kind < CEDUO_LAW_COUNT ? kind : kind - CEDUO_LAW_COUNT;
        static struct paper_site site;
        paper_site_init(&site);
        paper_site_read_theta(&site, law == CEDUO_LAW_CRSP ? PAPER_HEIGHT : PAPER_ANGLE);
        site.scene.simulation.law = (enum ceduo_law)law;
        site.scene.simulation.friction_bound = kind >= CEDUO_LAW_COUNT;
        show(name[0], &site.scene, NULL, 5000);
        show(name[1], &site.scene, &site.option, 2000);
        show_fine(name[2], site.scene, 0, 2000);
        show_fine(name[3], site.scene, 1e-3, 1000);
    }
    return 0;
}
