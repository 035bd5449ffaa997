/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of the core's walk against a plain C loop, on the slope of Ciabocco et al. 2009, both in this one run, in turn.
 *
 *   bench_walk [REPEATS [ROCKS]]        default 7, 100000
 *
 * CSV on stdout: medians of wall time; for the core, making the run and flying the rocks, with every sample kept, on
 * the best kernel of the machine or on the one that is named; ratio_to_plain in contacts per second. Agreement of the two,
 * whether all kernels give the same contacts and mean speed, and memory, on stderr. Exit 1 where they disagree. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "ceduo/ceduo.h"
#include "measure.h"
#include "plain_loop.h"

#define SEGMENTS     13
#define CONTROL_X    135.0
#define CELLS        200
#define MANY_ROCKS   1000000
#define ROCKS_LEAST  1000 /* fewer say nothing about agreement */
#define REPEATS_MOST 99
#define AGREE        4.0 /* combined standard errors */

/* Table 3 of Ciabocco et al. 2009. */
static double vertex_x[SEGMENTS + 1] = {0,     10,    13,    26.95,  42.8,   48.11,  56.36,
                                        70.69, 84.66, 97.43, 115.42, 134.59, 144.33, 152.68};
static double vertex_z[SEGMENTS + 1] = {126, 106, 86, 76, 66, 61, 56, 46, 36, 26, 16, 6, 2, 0};
static const double wall[3] = {0.31, 0.87, 0.25}, ledge[3] = {0.40, 0.90, 0.001}, talus[3] = {0.31, 0.83, 0.15};

struct site {
    const char *law, *roughness;
    struct ceduo_segment segments[SEGMENTS];
    struct ceduo_control control;
    struct ceduo_belt belt;
    struct ceduo_option option;
    struct ceduo_scene scene;
    struct plain_segment plain_segments[SEGMENTS];
    struct plain_def plain;
    struct plain_sums plain_sums; /* over all repeats, each with its own seed */
    double plain_rate;            /* contacts per second */
};

/* One line of the table. */
struct measure {
    const char *what;
    unsigned threads;
    enum ceduo_kernel kernel;
    uint64_t rocks;
    size_t cells;
    double seconds[REPEATS_MOST];
    uint64_t contacts;
    struct ceduo_arrivals arrivals;
};

static void fail(const char *why)
{
    fprintf(stderr, "bench_walk: %s\n", why);
    exit(1);
}

/* ---- the site ---- */

static const double *ground_of(size_t j)
{
    return j == 0 ? wall : j == 1 ? ledge : talus;
}

static void init_scene(struct site *site, enum ceduo_law law, bool height)
{
    for (size_t j = 0; j < SEGMENTS; j++) {
        const double *ground = ground_of(j);
        site->segments[j] = (struct ceduo_segment){.rn = ceduo_number(ground[0]),
                                                   .rt = ceduo_number(ground[1]),
                                                   .roughness_m = height ? ground[2] : NAN,
                                                   .roughness_rad = height ? NAN : ground[2],
                                                   .friction = ceduo_segment_default().friction};
    }
    site->control = (struct ceduo_control){.x = CONTROL_X, .x_given = CONTROL_X, .accepted = NAN, .measured_speed = NAN};
    site->option = (struct ceduo_option){.belts_count = 0, .belts = &site->belt};
    struct ceduo_scene *scene = &site->scene;
    scene->rock = ceduo_scene_default().rock;
    scene->rock.shape = CEDUO_CYLINDER;
    scene->rock.diameter = ceduo_number(0.56);
    scene->rock.height = ceduo_number(0.80);
    scene->release = (struct ceduo_release){.x = ceduo_number(0),
                                            .height = ceduo_number(0),
                                            .vx = ceduo_number(0.3),
                                            .vz = ceduo_number(-0.3),
                                            .spin = ceduo_number(0)};
    scene->slope = (struct ceduo_slope){
        .facets = CEDUO_AGAINST, .vertices = SEGMENTS + 1, .x = vertex_x, .z = vertex_z, .segments = site->segments};
    scene->controls_count = 1;
    scene->controls = &site->control;
    scene->options_count = 1;
    scene->options = &site->option;
    scene->simulation = ceduo_scene_default().simulation;
    scene->simulation.law = law;
    scene->simulation.rocks = MANY_ROCKS;
}

static void init_plain(struct site *site, bool height)
{
    for (size_t j = 0; j < SEGMENTS; j++) {
        const double *ground = ground_of(j);
        struct plain_segment *s = &site->plain_segments[j];
        *s = plain_segment_between(vertex_x[j], vertex_z[j], vertex_x[j + 1], vertex_z[j + 1]);
        s->rn = ground[0];
        s->rt = ground[1];
        s->roughness = ground[2];
        s->friction = ceduo_segment_default().friction;
    }
    struct ceduo_rock rock;
    if (ceduo_rock_of_means(&site->scene.rock, &rock) != CEDUO_OK)
        fail("bad rock");
    bool crsp = site->scene.simulation.law == CEDUO_LAW_CRSP;
    site->plain = (struct plain_def){.count = SEGMENTS,
                                     .segments = site->plain_segments,
                                     .law = crsp ? PLAIN_CRSP : PLAIN_LUMPED,
                                     .roughness_is_height = height,
                                     .gravity = CEDUO_GRAVITY,
                                     .mass = rock.mass,
                                     .radius = rock.radius,
                                     .k = rock.k,
                                     .x = 0,
                                     .z = vertex_z[0],
                                     .vx = 0.3,
                                     .vz = -0.3,
                                     .control = CONTROL_X};
}

static void init_site(struct site *site, enum ceduo_law law, bool height)
{
    memset(site, 0, sizeof *site);
    site->law = law == CEDUO_LAW_CRSP ? "crsp" : "lumped";
    site->roughness = height ? "height" : "angle";
    init_scene(site, law, height);
    init_plain(site, height);
}

/* ---- measuring ---- */

static double time_plain(struct site *site, uint64_t rocks, size_t repeat)
{
    site->plain.seed = repeat + 1;
    double start = ceduo_clock();
    plain_loop(&site->plain, rocks, &site->plain_sums);
    return ceduo_clock() - start;
}

static double time_core(const struct site *site, struct measure *m)
{
    double cell_x[CELLS];
    for (size_t i = 0; i < m->cells; i++)
        cell_x[i] = vertex_x[SEGMENTS] * (double)(i + 1) / (double)m->cells;
    double start = ceduo_clock();
    struct ceduo_run_def def = ceduo_run_def_default(&site->scene);
    def.threads = m->threads;
    def.kernel = m->kernel;
    def.cells = m->cells;
    def.cell_x = m->cells > 0 ? cell_x : NULL;
    struct ceduo_run *run;
    if (ceduo_run_create(&def, &run) != CEDUO_OK || ceduo_run_extend(run, m->rocks) != CEDUO_OK)
        fail("the run failed");
    double seconds = ceduo_clock() - start;
    m->contacts = ceduo_run_contacts(run);
    if (ceduo_run_arrivals(run, 0, &m->arrivals) != CEDUO_OK)
        fail("no memory");
    ceduo_run_free(run);
    return seconds;
}

static void print_line(const struct site *site, const char *what, uint64_t rocks, double seconds, double rate)
{
    printf("%s,%s,against,%s,%" PRIu64 ",%.4f,%.0f,%.3f\n", what, site->law, site->roughness, rocks, seconds, rate,
           rate / site->plain_rate);
    fflush(stdout);
}

/* ---- agreement ---- */

/* Mean and standard error from sums. */
static void mean_of(double sum, double sum2, double n, double *mean, double *se)
{
    *mean = sum / n;
    *se = sqrt((sum2 / n - *mean * *mean) / (n - 1));
}

static bool agrees(const struct site *site, const char *what, double plain, double plain_se, double core, double core_se)
{
    double off = fabs(plain - core) / hypot(plain_se, core_se);
    bool good = off <= AGREE;
    fprintf(stderr, "%s %s %-17s plain %10.4f  ceduo %10.4f  apart %.1f standard errors%s\n", site->law, site->roughness, what,
            plain, core, off, good ? "" : ": DISAGREE");
    return good;
}

static bool check_agreement(const struct site *site, const struct measure *m)
{
    const struct plain_sums *p = &site->plain_sums;
    const struct ceduo_arrivals *a = &m->arrivals;
    double rocks = (double)p->rocks, passed = (double)p->passed, released = (double)a->released, mean, se;
    double core_contacts = (double)m->contacts / released;
    mean_of((double)p->contacts, p->contacts2, rocks, &mean, &se);
    bool good = agrees(site, "contacts per rock", mean, se, core_contacts, se * sqrt(rocks / released));
    double share = passed / rocks, both = (passed + (double)a->reached) / (rocks + released);
    double spread = sqrt(both * (1 - both)) + 1e-300; /* all pass: they agree */
    good &= agrees(site, "share that passes", share, spread / sqrt(rocks), a->reach_probability, spread / sqrt(released));
    mean_of(p->speed, p->speed2, passed, &mean, &se);
    good &= agrees(site, "speed, m/s", mean, se, a->speed.mean, a->speed.se);
    mean_of(p->energy / 1e3, p->energy2 / 1e6, passed, &mean, &se);
    return agrees(site, "energy, kJ", mean, se, a->energy.mean / 1e3, a->energy.se / 1e3) && good;
}

/* ---- the table ---- */

static bool measure_site(struct site *site, size_t repeats, uint64_t rocks)
{
    struct measure core[] = {
        {.what = "ceduo-1-thread-scalar", .threads = 1, .kernel = CEDUO_KERNEL_SCALAR, .rocks = rocks},
        {.what = "ceduo-1-thread-avx2", .threads = 1, .kernel = CEDUO_KERNEL_AVX2, .rocks = rocks},
        {.what = "ceduo-1-thread", .threads = 1, .rocks = rocks},
        {.what = "ceduo-2-threads", .threads = 2, .rocks = rocks},
        {.what = "ceduo-1-thread-200-cells", .threads = 1, .rocks = rocks, .cells = CELLS},
    };
    size_t n = sizeof core / sizeof core[0];
    double plain[REPEATS_MOST];
    for (size_t i = 0; i < repeats; i++) {
        plain[i] = time_plain(site, rocks, i);
        for (size_t c = 0; c < n; c++)
            core[c].seconds[i] = time_core(site, &core[c]);
    }
    double seconds = median(plain, repeats);
    double per_run = (double)site->plain_sums.contacts / (double)repeats;
    site->plain_rate = per_run / seconds;
    print_line(site, "plain-loop", rocks, seconds, site->plain_rate);
    for (size_t c = 0; c < n; c++) {
        seconds = median(core[c].seconds, repeats);
        print_line(site, core[c].what, rocks, seconds, (double)core[c].contacts / seconds);
    }
    bool same = true;
    for (size_t c = 1; c < n; c++)
        same &= core[c].contacts == core[0].contacts && core[c].arrivals.speed.mean == core[0].arrivals.speed.mean;
    fprintf(stderr, "%s %s kernels and threads: %s\n", site->law, site->roughness, same ? "the same" : "DISAGREE");
    return check_agreement(site, &core[0]) && same;
}

static void measure_many(const struct site *site, size_t repeats)
{
    struct measure m = {.what = "ceduo-2-threads", .threads = 2, .rocks = MANY_ROCKS};
    for (size_t i = 0; i < repeats; i++)
        m.seconds[i] = time_core(site, &m);
    double seconds = median(m.seconds, repeats);
    print_line(site, m.what, MANY_ROCKS, seconds, (double)m.contacts / seconds);
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    fprintf(stderr, "peak memory with %d rocks: %.1f MiB\n", MANY_ROCKS, (double)usage.ru_maxrss / 1024);
}

static uint64_t argument(const char *text, uint64_t least, uint64_t most)
{
    char *end;
    unsigned long long value = strtoull(text, &end, 10);
    if (*end != '\0' || value < least || value > most)
        fail("usage: bench_walk [REPEATS [ROCKS]]");
    return value;
}

int main(int argc, char **argv)
{
    size_t repeats = argc > 1 ? (size_t)argument(argv[1], 1, REPEATS_MOST) : 7;
    uint64_t rocks = argc > 2 ? argument(argv[2], ROCKS_LEAST, MANY_ROCKS) : 100000;
    static struct site lumped, crsp;
    init_site(&lumped, CEDUO_LAW_LUMPED, false);
    init_site(&crsp, CEDUO_LAW_CRSP, true);
    puts("what,law,facets,roughness,rocks,seconds_median,contacts_per_s,ratio_to_plain");
    bool good = measure_site(&lumped, repeats, rocks);
    good &= measure_site(&crsp, repeats, rocks);
    measure_many(&lumped, repeats);
    fputs(good ? "plain loop and ceduo agree\n" : "plain loop and ceduo DISAGREE\n", stderr);
    return good ? 0 : 1;
}
