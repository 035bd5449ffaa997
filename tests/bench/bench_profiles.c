/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a finely digitised slope costs: the same rocks on the slope of Ciabocco et al. 2009 as it is (13 segments), cut into
 * many segments along its own lines, with each of these vertices moved by up to 1 mm, and with roughness of all lengths
 * laid over it (the rough one), at a few numbers of vertices.
 *
 *   bench_profiles [REPEATS [ROCKS [VERTICES]]]        default 7, 20000, 100000
 *
 * CSV on stdout, one thread, all by turns in one run: medians of the wall time that making the run takes and of that for
 * flying the rocks; of these times together the ratio to 13 segments, likewise of the time that a contact takes. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "measure.h"
#include "physics/line_scene.h"
#include "physics/paper_site.h"

#define REPEATS_MOST  99
#define VERTICES_MOST 4000000
#define KINDS         6
#define MOVED         1e-3 /* m */
#define WAVES         40   /* of the rough profile, from 40 m to its two finest segments */
#define STEEPNESS     0.15 /* of each wave */

struct profile {
    const char *name;
    struct ceduo_slope slope; /* as the site's own, but for vertices and segments */
};

struct measure {
    double make[REPEATS_MOST], fly[REPEATS_MOST];
    uint64_t contacts;
};

static void fail(const char *why)
{
    fprintf(stderr, "bench_profiles: %s\n", why);
    exit(1);
}

/* ---- profiles ---- */

/* `from` cut into `vertices` vertices, as even as its own vertices allow. */
static struct ceduo_slope cut(const struct ceduo_slope *from, size_t vertices)
{
    struct ceduo_slope to = *from;
    to.vertices = vertices;
    to.x = malloc(vertices * sizeof *to.x);
    to.z = malloc(vertices * sizeof *to.z);
    to.segments = malloc(vertices * sizeof *to.segments);
    if (!to.x || !to.z || !to.segments)
        fail("no memory");
    double end = from->x[from->vertices - 1];
    size_t i = 0;
    for (size_t j = 0; j + 1 < from->vertices; j++) {
        size_t last = (size_t)(from->x[j + 1] / end * (double)(vertices - 1) + 0.5), first = i;
        for (; i < last; i++) {
            double share = (double)(i - first) / (double)(last - first);
            to.x[i] = from->x[j] + share * (from->x[j + 1] - from->x[j]);
            to.z[i] = from->z[j] + share * (from->z[j + 1] - from->z[j]);
            to.segments[i] = from->segments[j];
        }
    }
    to.x[i] = end;
    to.z[i] = from->z[from->vertices - 1];
    return to;
}

/* Every vertex but the ends moved by up to 1 mm, along x no further than the order of the vertices allows. */
static void move_vertices(struct ceduo_slope *s)
{
    struct line_random r = {.state = 1};
    for (size_t i = 1; i + 1 < s->vertices; i++) {
        double room = fmin(MOVED, 0.4 * (s->x[i + 1] - s->x[i]));
        double x = s->x[i] + room * line_uniform(&r, -1, 1);
        s->x[i] = x > s->x[i - 1] ? x : s->x[i];
        s->z[i] += MOVED * line_uniform(&r, -1, 1);
    }
}

/* Waves of all lengths, each as steep as the others. */
static void roughen(struct ceduo_slope *s)
{
    struct line_random r = {.state = 2};
    double end = s->x[s->vertices - 1], longest = 40, shortest = 2 * end / (double)(s->vertices - 1);
    for (size_t w = 0; w < WAVES; w++) {
        double length = longest * pow(shortest / longest, (double)w / (WAVES - 1));
        double phase = line_uniform(&r, 0, 6.283), k = 6.283 / length;
        for (size_t i = 1; i + 1 < s->vertices; i++)
            s->z[i] += STEEPNESS / k * sin(k * s->x[i] + phase);
    }
}

static void make_profiles(struct profile *p, const struct ceduo_slope *paper, size_t vertices)
{
    p[0] = (struct profile){"13-segments", *paper};
    p[1] = (struct profile){"cut", cut(paper, vertices)};
    p[2] = (struct profile){"cut-moved-1-mm", cut(paper, vertices)};
    move_vertices(&p[2].slope);
    p[3] = (struct profile){"rough", cut(paper, vertices)};
    p[4] = (struct profile){"rough", cut(paper, vertices / 10)};
    p[5] = (struct profile){"rough", cut(paper, vertices / 100)};
    for (size_t i = 3; i < KINDS; i++)
        roughen(&p[i].slope);
}

/* ---- measuring ---- */

static void measure(const struct ceduo_scene *site, const struct profile *p, uint64_t rocks, struct measure *m, size_t repeat)
{
    struct ceduo_scene scene = *site;
    enum ceduo_facets facets = scene.slope.facets;
    scene.slope = p->slope;
    scene.slope.facets = facets;
    struct ceduo_run_def def = ceduo_run_def_default(&scene);
    def.rocks_most = rocks;
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
    for (size_t k = 1; k < KINDS; k++) {
        free(p[k].slope.x);
        free(p[k].slope.z);
        free(p[k].slope.segments);
    }
}

static uint64_t argument(const char *text, uint64_t least, uint64_t most)
{
    char *end;
    unsigned long long value = strtoull(text, &end, 10);
    if (*end != '\0' || value < least || value > most)
        fail("usage: bench_profiles [REPEATS [ROCKS [VERTICES]]]");
    return value;
}

int main(int argc, char **argv)
{
    size_t repeats = argc > 1 ? (size_t)argument(argv[1], 1, REPEATS_MOST) : 7;
    uint64_t rocks = argc > 2 ? argument(argv[2], 1, CEDUO_ROCKS_MOST) : 20000;
    size_t vertices = argc > 3 ? (size_t)argument(argv[3], 10000, VERTICES_MOST) : 100000;
    puts("profile,law,vertices,rocks,make_seconds,fly_seconds,contacts_per_rock,ns_per_contact,ratio_to_13_segments,"
         "ratio_of_contacts");
    measure_law(CEDUO_LAW_LUMPED, repeats, rocks, vertices);
    measure_law(CEDUO_LAW_CRSP, repeats, rocks, vertices);
    return 0;
}
