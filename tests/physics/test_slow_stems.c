/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rocks among stems: the program's walk and the slow one. First rock by rock with equal stems and facet draws, then in their
 * statistics with other random numbers and with stems that the slow walk takes from a map. */
#include "ceduo/simulate.h"
#include "core/runs/run.h"
#include "expect.h"
#include "io/scene_file.h"
#include "local.h"
#include "scene/volume.h"

#include <math.h>
#include <stdlib.h>

#include "full.h"
#include "line_scene.h"
#include "plain_forest.h"
#include "runs.h"
#include "sample.h"
#include "slow_scene.h"

#define SEGMENTS_MAX 100

/* A scene file, its option, and the slow walk in it. */
struct site {
    char name[64];
    struct scene_file file;
    struct ceduo_option *option;
    struct slow_segment segments[SEGMENTS_MAX];
    struct slow_def def;
};

static void set_volumes(const struct ceduo_stand *stand, struct ceduo_stems *stems, size_t n)
{
    for (size_t i = 0; i < n; i++)
        stems[i].volume = ceduo_stem_volume(stand, &stems[i], NULL);
}

static void read_site(struct site *site, const char *name, size_t option, enum ceduo_law law)
{
    struct problems problems = {0};
    snprintf(site->name, sizeof site->name, "%s, %s", name, law == CEDUO_LAW_CRSP ? "crsp" : "lumped");
    assert_true(ceduo_scene_load(&site->file, named("profiles/scenes/%s.yaml", name), NULL, 0, &problems));
    struct ceduo_scene *scene = &site->file.scene;
    site->option = &scene->options[option];
    for (size_t i = 0; i < site->option->belts_count; i++) {
        struct ceduo_stand *stand = &site->option->belts[i].stand;
        set_volumes(stand, stand->shoots, stand->shoots_count);
        set_volumes(stand, stand->trees, stand->trees_count);
    }
    scene->simulation.law = law;
    EXPECT(scene->slope.vertices, <=, SEGMENTS_MAX);
    site->def = slow_scene(scene, site->segments);
}

/* ---- rock by rock ---- */

struct met {
    const struct site *site;
    size_t count;
    struct slow_stem stems[FOREST_STEMS_MAX];
};

/* Return the energy (J) that a hit of p takes. Kinds of stems differ in diameter or height. */
static double find_energy(const struct ceduo_option *option, double b, const struct ceduo_stem_encounter *p)
{
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_stand *stand = &option->belts[i].stand;
        for (size_t k = 0; k < stand->shoots_count + stand->trees_count; k++) {
            const struct ceduo_stems *s = k < stand->shoots_count ? &stand->shoots[k] : &stand->trees[k - stand->shoots_count];
            if (s->dbh == p->dbh && s->height == p->height)
                return printed_energy(stand, s, b, p->y);
        }
    }
    fail_msg("no stem of the stands has dbh %g", p->dbh);
    return NAN;
}

static void note_stem(void *context, const struct ceduo_stem_encounter *p)
{
    struct met *m = context;
    EXPECT(m->count, <, FOREST_STEMS_MAX);
    m->stems[m->count++] = (struct slow_stem){p->x, p->height, find_energy(m->site->option, 2 * m->site->def.radius, p)};
}

struct facets {
    uint64_t seed, rock;
};

static double draw_facet(void *context, uint64_t contact)
{
    const struct facets *f = context;
    return line_facet_draw(f->seed, f->rock, contact);
}

static bool is_same(const struct ceduo_trajectory *a, const struct ceduo_crossing *c, const struct slow_trajectory *b)
{
    static const enum ceduo_end ends[] = {[SLOW_REST] = CEDUO_END_AT_REST,
                                          [SLOW_LEFT] = CEDUO_END_LEFT_SLOPE,
                                          [SLOW_STOPPED] = CEDUO_END_STOPPED_BY_STEMS,
                                          [SLOW_UNFINISHED] = CEDUO_END_UNFINISHED};
    if (a->end != ends[b->end] || a->contacts != b->contacts || a->stems_hit != b->hits || c->reached != b->crossing.reached)
        return false;
    double apart = fabs(a->x - b->x) / 100;
    if (c->reached)
        apart = fmax(apart, hypot(c->vx - b->crossing.vx, c->vz - b->crossing.vz) / hypot(c->vx, c->vz));
    return apart <= 1e-6;
}

/* Trajectories are chaotic: the rounding of doubles may change one in a hundred. */
static void compare_rocks(struct site *site, uint64_t rocks)
{
    static struct met met;
    struct facets facets = {.seed = site->file.scene.simulation.seed};
    uint64_t same = 0, hits = 0, stopped = 0;
    LOCAL(ceduo_tracer, tracer) = ceduo_tracer_create(&site->file.scene, site->option);
    assert_non_null(tracer);
    site->def.uniform = draw_facet;
    site->def.context = &facets;
    site->def.stems = met.stems;
    for (facets.rock = 0; facets.rock < rocks; facets.rock++) {
        struct ceduo_trajectory trajectory;
        struct ceduo_crossing crossing;
        met.site = site;
        met.count = 0;
        assert_int_equal(ceduo_tracer_run(tracer, facets.rock,
                                          &(struct ceduo_trajectory_callbacks){.stem = note_stem, .context = &met}, &trajectory,
                                          &crossing),
                         CEDUO_OK);
        site->def.stems_count = met.count;
        const struct slow_trajectory slow = slow_walk(&site->def);
        same += is_same(&trajectory, &crossing, &slow);
        hits += slow.hits;
        stopped += slow.end == SLOW_STOPPED;
    }
    print_message("# %s: %ju of %ju rocks are equal, %ju hits, %ju stopped\n", site->name, (uintmax_t)same, (uintmax_t)rocks,
                  (uintmax_t)hits, (uintmax_t)stopped);
    ROWS(EXPECT, ((double)same, >=, .99 * (double)rocks), (stopped, >, rocks / 20));
}

/* ---- statistics ---- */

static double draw(void *rng, uint64_t contact)
{
    (void)contact;
    return gsl_rng_uniform(rng);
}

/* Figures of all rocks, then of the rocks that arrive, then of the rocks that stop. */
enum { CONTACTS, HITS, AT_REST, STOPPED, REACH, SPEED, HEIGHT, ENERGY, STOP, FIGURES };

static void walk_slowly(struct site *site, uint64_t rocks, struct spread found[FIGURES])
{
    static struct plain_forest forest;
    struct slow_def *def = &site->def;
    forest.option = site->option;
    forest.rng = gsl_rng_alloc(gsl_rng_mt19937);
    def->uniform = draw;
    def->context = forest.rng;
    for (uint64_t rock = 0; rock < rocks; rock++) {
        assert_true(plain_forest_draw(&forest, def));
        const struct slow_trajectory t = slow_walk(def);
        const struct slow_crossing *c = &t.crossing;
        spread_add(&found[CONTACTS], (double)t.contacts);
        spread_add(&found[HITS], (double)t.hits);
        spread_add(&found[AT_REST], t.end == SLOW_REST);
        spread_add(&found[STOPPED], t.end == SLOW_STOPPED);
        spread_add(&found[REACH], c->reached);
        if (c->reached) {
            spread_add(&found[SPEED], hypot(c->vx, c->vz));
            spread_add(&found[HEIGHT], c->height);
            spread_add(&found[ENERGY], slow_energy(def, c));
        }
        if (t.end == SLOW_REST || t.end == SLOW_STOPPED)
            spread_add(&found[STOP], t.x);
    }
    gsl_rng_free(forest.rng);
}

static void compare_statistics(struct site *site, uint64_t rocks)
{
    static const enum ceduo_sample samples[] = {[SPEED] = CEDUO_SAMPLE_SPEED,
                                                [HEIGHT] = CEDUO_SAMPLE_HEIGHT,
                                                [ENERGY] = CEDUO_SAMPLE_ENERGY,
                                                [STOP] = CEDUO_SAMPLE_STOP};
    static const char *const names[] = {"contacts a rock",        "hits a rock",          "share at rest",
                                        "share stopped by stems", "share at the control", "speed there",
                                        "height there",           "energy there",         "place of stop"};
    struct spread slow[FIGURES] = {{0}};
    LOCAL(ceduo_run, run) = run_option(&site->file.scene, site->option, rocks, 1);
    const struct ceduo_ends ends = read_ends(run);
    double n = (double)rocks, hits = (double)ceduo_run_stems(run).hit, contacts = (double)ceduo_run_contacts(run);
    const double means[] = {contacts / n, hits / n, ends.share[CEDUO_END_AT_REST], ends.share[CEDUO_END_STOPPED_BY_STEMS],
                            read_arrivals(run, 0).reach.mean};
    walk_slowly(site, rocks, slow);
    for (int i = 0; i <= REACH; i++) /* equal numbers of rocks: one error serves for both */
        expect_close(named("%s, %s", site->name, names[i]), means[i], spread_se(&slow[i]), spread_mean(&slow[i]),
                     spread_se(&slow[i]));
    for (int i = SPEED; i < FIGURES; i++) {
        const double *values = ceduo_run_samples(run, 0, samples[i]);
        struct spread fast = {0};
        for (uint64_t rock = 0; rock < rocks; rock++)
            if (!isnan(values[rock]))
                spread_add(&fast, values[rock]);
        expect_close(named("%s, %s", site->name, names[i]), spread_mean(&fast), spread_se(&fast), spread_mean(&slow[i]),
                     spread_se(&slow[i]));
    }
}

static void compare(const char *scene, size_t option, enum ceduo_law law)
{
    static struct site site;
    read_site(&site, scene, option, law);
    compare_rocks(&site, FULL_OR(20000, 500));
    compare_statistics(&site, FULL_OR(1000000, 10000));
    ceduo_scene_release(&site.file);
}

TEST(rocks_among_the_stems_of_the_paper)
{
    compare("paper-site", 0, CEDUO_LAW_LUMPED);
    compare("paper-site", 0, CEDUO_LAW_CRSP);
}

TEST(rocks_among_shoots_and_standards)
{
    compare("four-systems", 2, CEDUO_LAW_LUMPED);
}
