/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure the cost of a finely digitised slope: the same rocks on four versions of the slope of Ciabocco et al. 2009. These are
 * its 13 segments, many segments along its own lines, the same with each vertex moved by up to 1 mm, and one with added
 * roughness of all lengths (the rough one), at several numbers of vertices.
 *
 *   bench_profiles [REPEATS [ROCKS [VERTICES]]]        default 7, 20000, 100000
 *
 * CSV on stdout, one thread, all by turns in one run: medians of the wall time to make the run and to simulate the rocks, the
 * ratio of their sum to 13 segments, and the same ratio per contact. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/runs/run.h"
#include "frame.h"

#define VERTICES_MAX 4000000
#define KINDS        6
#define MOVED        1e-3 /* m */
#define STEEPNESS    0.15 /* each wave of the rough profile */

struct profile {
    const char *name;
    struct ceduo_slope slope; /* the site's slope with other vertices and segments */
};

struct measure {
    double make[REPEATS_MAX], fly[REPEATS_MAX];
    uint64_t contacts;
};

/* ---- profiles ---- */

/* Move every vertex except the ends by up to 1 mm, keeping the order of x. */
static void move_vertices(struct ceduo_slope *s)
{
    struct line_random r = {.state = 1};
    for (size_t i = 1; i + 1 < s->vertices; i++) {
        double limit = fmin(MOVED, 0.4 * (s->x[i + 1] - s->x[i]));
        double x = s->x[i] + limit * line_uniform(&r, -1, 1);
        s->x[i] = x > s->x[i - 1] ? x : s->x[i];
        s->z[i] += MOVED * line_uniform(&r, -1, 1);
    }
}

static void make_profiles(struct profile *p, const struct ceduo_slope *paper, size_t vertices)
{
    p[0] = (struct profile){"13-segments", *paper};
    p[1] = (struct profile){"cut", slope_cut(paper, vertices)};
    p[2] = (struct profile){"cut-moved-1-mm", slope_cut(paper, vertices)};
    move_vertices(&p[2].slope);
    p[3] = (struct profile){"rough", slope_cut(paper, vertices)};
    p[4] = (struct profile){"rough", slope_cut(paper, vertices / 10)};
    p[5] = (struct profile){"rough", slope_cut(paper, vertices / 100)};
    for (size_t i = 3; i < KINDS; i++)
        roughen_slope(&p[i].slope, STEEPNESS);
}

/* ---- measurement ---- */

static void measure(const struct ceduo_scene *site, const struct profile *p, uint64_t rocks, struct measure *m, size_t repeat)
{
    struct ceduo_scene scene = *site;
    enum ceduo_facets facets = scene.slope.facets;
    scene.slope = p->slope;
    scene.slope.facets = facets;
    struct ceduo_run_def def = ceduo_run_def_default(&scene);
    def.rocks_max = rocks;
    struct ceduo_run *run;
    double start = ceduo_clock();
    if (ceduo_run_create(&def, &run) != CEDUO_OK)
        fail("the run cannot be made");
    double made = ceduo_clock();
    if (ceduo_run_extend(run, rocks) != CEDUO_OK)
        fail("the run failed");
    m->fly[repeat] = ceduo_clock() - made;
    m->make[repeat] = made - start;
    m->contacts = ceduo_run_contacts(run);
    ceduo_run_free(run);
}

static void measure_law(enum ceduo_law law, size_t repeats, uint64_t rocks, size_t vertices)
{
    static struct paper_site site;
    static struct measure m[KINDS];
    struct profile p[KINDS];
    paper_site_init(&site);
    paper_site_read_theta(&site, law == CEDUO_LAW_CRSP ? PAPER_HEIGHT : PAPER_ANGLE);
    site.scene.simulation.law = law;
    make_profiles(p, &site.scene.slope, vertices);
    for (size_t i = 0; i < repeats; i++)
        for (size_t k = 0; k < KINDS; k++)
            measure(&site.scene, &p[k], rocks, &m[k], i);
    double first = 0, first_each = 0;
    for (size_t k = 0; k < KINDS; k++) {
        double make = median(m[k].make, repeats), fly = median(m[k].fly, repeats), contacts = (double)m[k].contacts;
        double each = fly / contacts;
        first = k == 0 ? make + fly : first;
        first_each = k == 0 ? each : first_each;
        printf("%s,%s,%zu,%" PRIu64 ",%.4f,%.4f,%.2f,%.1f,%.2f,%.2f\n", p[k].name, law == CEDUO_LAW_CRSP ? "crsp" : "lumped",
               p[k].slope.vertices, rocks, make, fly, contacts / (double)rocks, 1e9 * each, (make + fly) / first,
               each / first_each);
        fflush(stdout);
    }
    for (size_t k = 1; k < KINDS; k++)
        slope_free(&p[k].slope);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 7, 1, REPEATS_MAX);
    uint64_t rocks = argument(argv, 2, 20000, 1, CEDUO_ROCKS_MAX);
    size_t vertices = argument(argv, 3, 100000, 10000, VERTICES_MAX);
    puts("profile,law,vertices,rocks,make_seconds,fly_seconds,contacts_per_rock,ns_per_contact,ratio_to_13_segments,"
         "ratio_of_contacts");
    measure_law(CEDUO_LAW_LUMPED, repeats, rocks, vertices);
    measure_law(CEDUO_LAW_CRSP, repeats, rocks, vertices);
    return 0;
}
