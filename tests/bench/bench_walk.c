/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compare the speed of the core's walk with a plain C loop, on the slope of Ciabocco et al. 2009, without forest and among its
 * stems, by turns in one run. The plain loop draws all stems in the path of a rock before its release, and sorts them.
 *
 *   bench_walk [REPEATS [ROCKS]]        default 7, 100000
 *
 * CSV on stdout: medians of wall time. For the core they include making the run and simulating the rocks with every sample
 * kept, on the machine's best kernel or the one named in the row; ratio_to_plain is in rocks per second. Standard error
 * reports agreement of the two, whether all kernels give equal contacts, hits and mean speed, and memory. Exit 1 if they
 * disagree. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

#include "core/runs/run.h"
#include "frame.h"
#include "physics/plain_forest.h"

#define MANY_ROCKS 1000000
#define ROCKS_MIN  1000 /* fewer cannot show agreement */
#define AGREE      4.0  /* combined standard errors */

/* Sums over the rocks of the plain loop; speed and energy of rocks that passed. */
struct plain_sums {
    uint64_t rocks, passed, contacts, hits;
    double contacts2, hits2, speed, speed2, energy, energy2;
};

struct site {
    const char *law, *roughness, *place; /* place: "stems", or the roughness */
    struct paper_site paper;
    struct slow_segment plain_segments[PAPER_SEGMENTS];
    struct slow_def plain;
    struct plain_sums plain_sums; /* over all repeats, each with its own seed */
    double plain_seconds;         /* per rock */
    struct plain_forest forest;   /* option NULL: without forest */
};

/* One row of the table. */
struct measure {
    const char *label;
    unsigned threads;
    enum ceduo_kernel kernel;
    uint64_t rocks;
    double seconds[REPEATS_MAX];
    uint64_t contacts, hits;
    struct ceduo_arrivals arrivals;
};

static double draw(void *random, uint64_t contact)
{
    (void)contact;
    return line_uniform(random, 0, 1);
}

static void init_site(struct site *site, enum ceduo_law law, bool height, bool stems)
{
    site->law = law == CEDUO_LAW_CRSP ? "crsp" : "lumped";
    site->roughness = height ? "height" : "angle";
    site->place = stems ? "stems" : site->roughness;
    paper_site_init(&site->paper);
    paper_site_read_theta(&site->paper, height ? PAPER_HEIGHT : PAPER_ANGLE);
    site->paper.control.accepted = NAN;
    site->paper.scene.simulation.law = law;
    site->paper.scene.simulation.rocks = MANY_ROCKS;
    site->plain = slow_scene(&site->paper.scene, site->plain_segments);
    site->plain.uniform = draw;
    site->forest.rng = gsl_rng_alloc(gsl_rng_mt19937);
    if (stems)
        site->forest.option = &site->paper.option;
}

/* ---- measurement ---- */

static double time_plain(struct site *site, uint64_t rocks, size_t repeat)
{
    struct line_random random = {.state = repeat + 1};
    struct plain_sums *sums = &site->plain_sums;
    site->plain.context = &random;
    gsl_rng_set(site->forest.rng, repeat + 1);
    double start = ceduo_clock();
    for (uint64_t i = 0; i < rocks; i++) {
        if (site->forest.option && !plain_forest_draw(&site->forest, &site->plain))
            fail("too many stems");
        const struct slow_trajectory trajectory = slow_walk(&site->plain);
        sums->rocks++;
        sums->contacts += trajectory.contacts;
        sums->contacts2 += (double)(trajectory.contacts * trajectory.contacts);
        sums->hits += trajectory.hits;
        sums->hits2 += (double)(trajectory.hits * trajectory.hits);
        if (!trajectory.crossing.reached)
            continue;
        double speed = hypot(trajectory.crossing.vx, trajectory.crossing.vz),
               energy = slow_energy(&site->plain, &trajectory.crossing);
        sums->passed++;
        sums->speed += speed;
        sums->speed2 += speed * speed;
        sums->energy += energy;
        sums->energy2 += energy * energy;
    }
    return ceduo_clock() - start;
}

static double time_core(const struct site *site, struct measure *m)
{
    double start = ceduo_clock();
    struct ceduo_run_def def = ceduo_run_def_default(&site->paper.scene);
    def.threads = m->threads;
    def.kernel = m->kernel;
    def.option = site->forest.option;
    struct ceduo_run *run = simulate_run(&def, m->rocks);
    double seconds = ceduo_clock() - start;
    m->contacts = ceduo_run_contacts(run);
    m->hits = ceduo_run_stems(run).hit;
    if (ceduo_run_arrivals(run, 0, &m->arrivals) != CEDUO_OK)
        fail("no memory");
    ceduo_run_free(run);
    return seconds;
}

static void print_line(const struct site *site, const char *label, uint64_t rocks, double seconds, double contacts, double hits)
{
    printf("%s,%s,against,%s,%" PRIu64 ",%.4f,%.0f,%.1f,%.3f", label, site->law, site->roughness, rocks, seconds,
           contacts / seconds, seconds / contacts * 1e9, site->plain_seconds / (seconds / (double)rocks));
    if (hits > 0)
        printf(",stems,%.1f\n", seconds / hits * 1e9);
    else
        puts(",,");
    fflush(stdout);
}

/* ---- agreement ---- */

/* Compute mean and standard error from sums. */
static void compute_mean(double sum, double sum2, double n, double *mean, double *se)
{
    *mean = sum / n;
    *se = sqrt((sum2 / n - *mean * *mean) / (n - 1));
}

static bool agrees(const struct site *site, const char *label, double plain, double plain_se, double core, double core_se)
{
    double errors_apart = fabs(plain - core) / hypot(plain_se, core_se);
    bool good = errors_apart <= AGREE;
    fprintf(stderr, "%s %s %-17s plain %10.4f  ceduo %10.4f  apart %.1f standard errors%s\n", site->law, site->place, label,
            plain, core, errors_apart, good ? "" : ": DISAGREE");
    return good;
}

static bool check_agreement(const struct site *site, const struct measure *m)
{
    const struct plain_sums *p = &site->plain_sums;
    const struct ceduo_arrivals *a = &m->arrivals;
    double rocks = (double)p->rocks, passed = (double)p->passed, released = (double)a->released, mean, se;
    double core_contacts = (double)m->contacts / released;
    compute_mean((double)p->contacts, p->contacts2, rocks, &mean, &se);
    bool good = agrees(site, "contacts per rock", mean, se, core_contacts, se * sqrt(rocks / released));
    if (p->hits > 0) {
        compute_mean((double)p->hits, p->hits2, rocks, &mean, &se);
        good &= agrees(site, "hits per rock", mean, se, (double)m->hits / released, se * sqrt(rocks / released));
    }
    double share = passed / rocks, both = (passed + (double)a->reached) / (rocks + released);
    double spread = sqrt(both * (1 - both)) + 1e-300; /* no spread if all pass: they agree */
    good &= agrees(site, "share that passes", share, spread / sqrt(rocks), a->reach.mean, spread / sqrt(released));
    compute_mean(p->speed, p->speed2, passed, &mean, &se);
    good &= agrees(site, "speed, m/s", mean, se, a->speed.mean, a->speed.se);
    compute_mean(p->energy / 1e3, p->energy2 / 1e6, passed, &mean, &se);
    return agrees(site, "energy, kJ", mean, se, a->energy.mean / 1e3, a->energy.se / 1e3) && good;
}

/* ---- table ---- */

static bool measure_site(struct site *site, size_t repeats, uint64_t rocks)
{
    struct measure core[] = {
        {.label = "ceduo-1-thread-scalar", .threads = 1, .kernel = CEDUO_KERNEL_SCALAR, .rocks = rocks},
        {.label = "ceduo-1-thread-avx2", .threads = 1, .kernel = CEDUO_KERNEL_AVX2, .rocks = rocks},
        {.label = "ceduo-1-thread", .threads = 1, .rocks = rocks},
        {.label = "ceduo-2-threads", .threads = 2, .rocks = rocks},
    };
    size_t kinds = sizeof core / sizeof core[0];
    double plain[REPEATS_MAX];
    for (size_t i = 0; i < repeats; i++) {
        plain[i] = time_plain(site, rocks, i);
        for (size_t c = 0; c < kinds; c++)
            core[c].seconds[i] = time_core(site, &core[c]);
    }
    const struct plain_sums *sums = &site->plain_sums;
    double seconds = median(plain, repeats), n = (double)repeats;
    site->plain_seconds = seconds / (double)rocks;
    print_line(site, "plain-loop", rocks, seconds, (double)sums->contacts / n, (double)sums->hits / n);
    for (size_t c = 0; c < kinds; c++) {
        seconds = median(core[c].seconds, repeats);
        print_line(site, core[c].label, rocks, seconds, (double)core[c].contacts, (double)core[c].hits);
    }
    bool equal = true;
    for (size_t c = 1; c < kinds; c++)
        equal &= core[c].contacts == core[0].contacts && core[c].hits == core[0].hits &&
                 core[c].arrivals.speed.mean == core[0].arrivals.speed.mean;
    fprintf(stderr, "%s %s kernels and threads: %s\n", site->law, site->place, equal ? "the same" : "DISAGREE");
    return check_agreement(site, &core[0]) && equal;
}

static void measure_many(const struct site *site, size_t repeats)
{
    struct measure m = {.label = "ceduo-2-threads", .threads = 2, .rocks = MANY_ROCKS};
    for (size_t i = 0; i < repeats; i++)
        m.seconds[i] = time_core(site, &m);
    double seconds = median(m.seconds, repeats);
    print_line(site, m.label, MANY_ROCKS, seconds, (double)m.contacts, (double)m.hits);
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    fprintf(stderr, "peak memory with %d rocks: %.1f MiB\n", MANY_ROCKS, (double)usage.ru_maxrss / 1024);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 7, 1, REPEATS_MAX);
    uint64_t rocks = argument(argv, 2, 100000, ROCKS_MIN, MANY_ROCKS);
    static struct site lumped, crsp, stems;
    init_site(&lumped, CEDUO_LAW_LUMPED, false, false);
    init_site(&crsp, CEDUO_LAW_CRSP, true, false);
    init_site(&stems, CEDUO_LAW_LUMPED, false, true);
    puts("what,law,facets,roughness,rocks,seconds_median,contacts_per_s,ns_per_contact,ratio_to_plain,forest,ns_per_hit");
    bool good = measure_site(&lumped, repeats, rocks);
    good &= measure_site(&crsp, repeats, rocks);
    good &= measure_site(&stems, repeats, rocks);
    measure_many(&lumped, repeats);
    fputs(good ? "plain loop and ceduo agree\n" : "plain loop and ceduo DISAGREE\n", stderr);
    return good ? 0 : 1;
}
