/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Check that a clear verdict is not reversed: for many seeds, find the clearly best option after the first 1000 rocks and after
 * ten times that number, today and over a rotation. Prints CSV: how often an option was clear first and last, how often it
 * became unclear, and how often another one became clearly best. The last must never happen: exit 1.
 *
 *   bench_verdict [SEEDS [THREADS]]     100 seeds, all cores */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "frame.h"
#include "study/verdict.h"

#define SEEDS     100
#define STEPS     2
#define YEAR_STEP 5 /* some years of a rotation; all years use the same rule */
#define NOBODY    SIZE_MAX

static const uint64_t rocks[STEPS] = {1024, 10240};

/* The clearly best option after each step, or none. */
struct leaders {
    size_t best[STEPS];
};

struct count {
    size_t first, last, lost, reversed;
};

static size_t clear_best(const struct ceduo_leader *leader)
{
    return leader->known && leader->rivals == 0 ? leader->best : NOBODY;
}

static void record(const struct ceduo_scene *scene, struct ceduo_pool **pool, unsigned threads, size_t step,
                   struct leaders *today, struct leaders *rotation)
{
    struct ceduo_request q = ceduo_request_default(scene);
    struct ceduo_results answer;
    struct ceduo_verdict verdict;
    q.rocks = rocks[step];
    q.run.rocks_max = rocks[STEPS - 1];
    q.run.threads = threads;
    q.run.arrivals_only = true;
    q.years = true;
    q.years_max = YEAR_STEP;
    if (ceduo_simulate_request(&q, pool, &answer) != CEDUO_OK ||
        ceduo_compare_options(answer.result, answer.years, NULL, &verdict) != CEDUO_OK)
        fail("the question failed");
    today->best[step] = clear_best(&verdict.today);
    rotation->best[step] = clear_best(&verdict.rotation);
    ceduo_verdict_release(&verdict);
    ceduo_results_release(&answer);
}

static void count(const struct leaders *leaders, struct count *c)
{
    size_t first = leaders->best[0], last = leaders->best[STEPS - 1];
    c->first += first != NOBODY;
    c->last += last != NOBODY;
    c->lost += first != NOBODY && last == NOBODY;
    c->reversed += first != NOBODY && last != NOBODY && first != last;
}

static size_t report(const char *scene, const char *when, size_t seeds, const struct count *c)
{
    printf("%s,%s,%zu,%zu,%zu,%zu,%zu\n", scene, when, seeds, c->first, c->last, c->lost, c->reversed);
    return c->reversed;
}

static size_t judge(const char *name, size_t seeds, unsigned threads)
{
    struct scene_file file;
    struct count today = {0}, rotation = {0};
    char path[128];
    snprintf(path, sizeof path, "profiles/scenes/%s.yaml", name);
    read_scene(&file, path);
    for (size_t seed = 1; seed <= seeds; seed++) {
        struct ceduo_pool *pool = NULL;
        struct leaders now, over;
        file.scene.simulation.seed = seed;
        for (size_t step = 0; step < STEPS; step++)
            record(&file.scene, &pool, threads, step, &now, &over);
        ceduo_pool_free(pool);
        count(&now, &today);
        count(&over, &rotation);
    }
    size_t reversed = report(name, "today", seeds, &today) + report(name, "rotation", seeds, &rotation);
    ceduo_scene_release(&file);
    return reversed;
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t seeds = argument(argv, 1, SEEDS, 0, SIZE_MAX);
    unsigned threads = (unsigned)argument(argv, 2, (uint64_t)sysconf(_SC_NPROCESSORS_ONLN), 1, 1024);
    printf("scene,when,seeds,clear_at_1024,clear_at_10240,no_longer_clear,reversed\n");
    size_t reversed =
        judge("four-systems", seeds, threads) + judge("rotation", seeds, threads) + judge("staggered", seeds, threads);
    return reversed > 0;
}
