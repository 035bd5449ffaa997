/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of scenes, forests and years: each field is changed alone (test_table.c does so for every row). If a field affects
 * results, the key must change, or old results would be shown for new values. Otherwise it must stay, or equal rocks would be
 * simulated twice. */
#include "core/runs/key.h"
#include "expect.h"
#include "scene/stand.h"
#include "scene/volume.h"

#include <math.h>
#include <string.h>

#include "paper_site.h"

/* Subject of a key, and which fields affect it. */
enum about {
    FLIGHT = 1 << 0, /* scene: trajectories without stems, and their statistics */
    STEMS = 1 << 1,  /* option: stems with the energy of brauner, each kind with a given volume */
    DORREN = 1 << 2, /* as above, with the energy of dorren */
    DBHS = 1 << 3,   /* brauner, diameters with a spread */
    YEARS = 1 << 4,  /* option: growth and cutting of its forest */
};
#define WOOD    (STEMS | DORREN | DBHS | YEARS)
#define BRAUNER (STEMS | DBHS | YEARS)

static struct paper_site site;
static double stay[] = {40, 20}; /* trees that the cutting retains */

static uint64_t compute_key(enum about about)
{
    return about == FLIGHT  ? ceduo_scene_key(&site.scene)
           : about == YEARS ? ceduo_years_key(&site.option)
                            : ceduo_option_key(&site.scene, &site.option);
}

/* ---- fields ---- */

/* SPREAD: a struct ceduo_number. WORD: an enum or an int. Members with their own loop have no row. */
enum kind { NUMBER, SPREAD, WORD, FLAG, COUNT, TEXT };

struct field {
    const char *name;
    size_t offset;
    enum kind kind;
    unsigned decides; /* affected keys */
};

#define FIELD(of, member, kind, decides)                                                                                       \
    {                                                                                                                          \
#of "." #member, offsetof(struct of, member), kind, decides                                                            \
    }

/* Change a value of this kind. A count decreases, because arrays have no further elements. */
static void change(void *at, enum kind kind)
{
    static char other[] = "another name";
    double number;
    int word;
    size_t count;
    switch (kind) {
    case NUMBER:
        memcpy(&number, at, sizeof number);
        number = isnan(number) ? .5 : number + .125;
        memcpy(at, &number, sizeof number);
        break;
    case WORD:
        memcpy(&word, at, sizeof word);
        word = word > 0 ? word - 1 : word + 1;
        memcpy(at, &word, sizeof word);
        break;
    case COUNT:
        memcpy(&count, at, sizeof count);
        EXPECT(count, >, 0);
        count--;
        memcpy(at, &count, sizeof count);
        break;
    case FLAG:
        *(bool *)at = !*(bool *)at;
        break;
    case TEXT:
        *(char **)at = other;
        break;
    default:
        fail_msg("kind %d is not changed as a whole", kind);
    }
}

static void expect_decides(enum about about, uint64_t before, const char *name, const char *part, bool decides)
{
    if ((compute_key(about) != before) != decides)
        fail_msg("%s%s, key of %d: it %s", name, part, about, decides ? "stays" : "changes");
}

/* The kind of a distribution matters only if its deviation is above 0. */
static void walk_spread(enum about about, struct ceduo_number *n, const char *name)
{
    const enum ceduo_spread_kind kind = n->kind,
                                 other = kind == CEDUO_SPREAD_NORMAL ? CEDUO_SPREAD_UNIFORM : CEDUO_SPREAD_NORMAL;
    uint64_t before = compute_key(about);
    n->kind = other;
    expect_decides(about, before, name, ", kind without spread", false);
    change(&n->mean, NUMBER);
    expect_decides(about, before, name, ", mean", true);
    before = compute_key(about);
    n->spread = .25;
    expect_decides(about, before, name, ", spread", true);
    before = compute_key(about);
    n->kind = kind;
    expect_decides(about, before, name, ", kind", true);
}

#define KEY_SIZE_MAX 1024

static void walk(enum about about, void *structure, size_t size, const struct field *fields, size_t n)
{
    unsigned char was[KEY_SIZE_MAX];
    memcpy(was, structure, size);
    const uint64_t before = compute_key(about);
    for (size_t i = 0; i < n; i++) {
        const struct field *f = &fields[i];
        void *at = (char *)structure + f->offset;
        if (f->kind == SPREAD) {
            walk_spread(about, at, f->name);
        } else {
            change(at, f->kind);
            expect_decides(about, before, f->name, "", f->decides & about);
        }
        memcpy(structure, was, size);
        EXPECT(compute_key(about), ==, before);
    }
}

#define WALK(about, structure, fields) walk(about, structure, sizeof *(structure), fields, LENGTH(fields))

/* Walk over consecutive numbers; each matters. */
static void walk_numbers(enum about about, double *numbers, size_t n, const char *name)
{
    const uint64_t before = compute_key(about);
    for (size_t i = 0; i < n; i++) {
        double was = numbers[i];
        change(&numbers[i], NUMBER);
        expect_decides(about, before, name, "", true);
        numbers[i] = was;
    }
}

static const struct field scene_fields[] = {
    FIELD(ceduo_scene, title, TEXT, 0),

    FIELD(ceduo_scene, controls_count, COUNT, FLIGHT),
    FIELD(ceduo_scene, options_count, COUNT, 0),
    FIELD(ceduo_scene, rocks_per_year, NUMBER, 0),
    FIELD(ceduo_scene, reserves_minimum, NUMBER, 0),
};

static const struct field rock_fields[] = {
    FIELD(ceduo_rock_def, shape, WORD, FLIGHT),     FIELD(ceduo_rock_def, diameter, SPREAD, FLIGHT),
    FIELD(ceduo_rock_def, height, SPREAD, FLIGHT),  FIELD(ceduo_rock_def, volume, SPREAD, FLIGHT),
    FIELD(ceduo_rock_def, mass, SPREAD, FLIGHT),    FIELD(ceduo_rock_def, density, SPREAD, FLIGHT),
    FIELD(ceduo_rock_def, axes[0], SPREAD, FLIGHT), FIELD(ceduo_rock_def, axes[1], SPREAD, FLIGHT),
    FIELD(ceduo_rock_def, axes[2], SPREAD, FLIGHT),
};

static const struct field class_fields[] = {
    FIELD(ceduo_size_class, per_year, NUMBER, FLIGHT),
    FIELD(ceduo_size_class, exponent, NUMBER, FLIGHT),
};

static const struct field release_fields[] = {
    FIELD(ceduo_release, x, SPREAD, FLIGHT),    FIELD(ceduo_release, height, SPREAD, FLIGHT),
    FIELD(ceduo_release, vx, SPREAD, FLIGHT),   FIELD(ceduo_release, vz, SPREAD, FLIGHT),
    FIELD(ceduo_release, spin, SPREAD, FLIGHT),
};

static const struct field slope_fields[] = {
    FIELD(ceduo_slope, facets, WORD, FLIGHT),
    FIELD(ceduo_slope, vertices, COUNT, FLIGHT),
    FIELD(ceduo_slope, origin_x, NUMBER, 0),
    FIELD(ceduo_slope, origin_z, NUMBER, 0),
};

static const struct field segment_fields[] = {
    FIELD(ceduo_segment, rn, SPREAD, FLIGHT),          FIELD(ceduo_segment, rt, SPREAD, FLIGHT),
    FIELD(ceduo_segment, roughness_m, NUMBER, FLIGHT), FIELD(ceduo_segment, roughness_rad, NUMBER, FLIGHT),
    FIELD(ceduo_segment, friction, NUMBER, FLIGHT),    FIELD(ceduo_segment, mu, NUMBER, FLIGHT),
};

static const struct field control_fields[] = {
    FIELD(ceduo_control, x, NUMBER, FLIGHT),
    FIELD(ceduo_control, x_given, NUMBER, 0),
    FIELD(ceduo_control, name, TEXT, 0),
    FIELD(ceduo_control, accepted, NUMBER, FLIGHT),
    FIELD(ceduo_control, measured_speed, NUMBER, 0),
};

static const struct field simulation_fields[] = {
    FIELD(ceduo_simulation, law, WORD, FLIGHT),
    FIELD(ceduo_simulation, rocks, COUNT, 0),
    FIELD(ceduo_simulation, seed, COUNT, FLIGHT),
    FIELD(ceduo_simulation, contact_model, WORD, STEMS),
    FIELD(ceduo_simulation, rule, WORD, 0),
    FIELD(ceduo_simulation, threshold, NUMBER, 0),
    FIELD(ceduo_simulation, gravity, NUMBER, FLIGHT),
    FIELD(ceduo_simulation, scale_rn, FLAG, FLIGHT),
    FIELD(ceduo_simulation, friction_bound, FLAG, FLIGHT),
};

static const struct field option_fields[] = {
    FIELD(ceduo_option, name, TEXT, 0),
    FIELD(ceduo_option, belts_count, COUNT, WOOD),
};

static const struct field belt_fields[] = {
    FIELD(ceduo_belt, from, NUMBER, WOOD),      FIELD(ceduo_belt, to, NUMBER, WOOD), FIELD(ceduo_belt, from_given, NUMBER, 0),
    FIELD(ceduo_belt, to_given, NUMBER, 0),     FIELD(ceduo_belt, name, TEXT, 0),    FIELD(ceduo_belt, assumed, FLAG, 0),
    FIELD(ceduo_belt, cut_year, NUMBER, YEARS),
};

/* The species gives the volume of each stem by its equation if diameters vary, and of new stems after a cut. */
static const struct field stand_fields[] = {
    FIELD(ceduo_stand, system, WORD, 0),
    FIELD(ceduo_stand, species, WORD, DBHS | YEARS),
    FIELD(ceduo_stand, stools_per_ha, NUMBER, WOOD),
    FIELD(ceduo_stand, spacing, NUMBER, WOOD),
    FIELD(ceduo_stand, shoots_count, COUNT, WOOD),
    FIELD(ceduo_stand, trees_count, COUNT, WOOD),

    FIELD(ceduo_stand, energy, WORD, WOOD),
    FIELD(ceduo_stand, u, NUMBER, BRAUNER),
    FIELD(ceduo_stand, fracture_ratio, NUMBER, DORREN),
};

static const struct field stems_fields[] = {
    FIELD(ceduo_stems, per_ha, NUMBER, WOOD), FIELD(ceduo_stems, dbh, NUMBER, WOOD),
    FIELD(ceduo_stems, height, NUMBER, WOOD), FIELD(ceduo_stems, volume, NUMBER, BRAUNER),
    FIELD(ceduo_stems, dbh_sd, NUMBER, WOOD), FIELD(ceduo_stems, age, NUMBER, YEARS),
};

/* If some stand in groups. */
static const struct field group_fields[] = {
    FIELD(ceduo_stems, group, WORD, WOOD),
    FIELD(ceduo_stems, group_radius, NUMBER, WOOD),
};

static const struct field stump_fields[] = {
    FIELD(ceduo_stumps, per_ha, NUMBER, WOOD),
    FIELD(ceduo_stumps, diameter, NUMBER, WOOD),
    FIELD(ceduo_stumps, height, NUMBER, WOOD),
    FIELD(ceduo_stumps, energy, NUMBER, WOOD),
};

static const struct field log_fields[] = {
    FIELD(ceduo_logs, per_ha, NUMBER, WOOD),
    FIELD(ceduo_logs, length, NUMBER, WOOD),
    FIELD(ceduo_logs, diameter, NUMBER, WOOD),
    FIELD(ceduo_logs, energy, NUMBER, WOOD),
};

static const struct field growth_fields[] = {
    FIELD(ceduo_growth, shoots_young, NUMBER, YEARS),
    FIELD(ceduo_growth, shoots_old, NUMBER, YEARS),
    FIELD(ceduo_growth, sdi_max, NUMBER, YEARS),
    FIELD(ceduo_growth, stump_years, WORD, YEARS),
};

static const struct field curve_fields[] = {
    FIELD(ceduo_curve, dbh_max, NUMBER, YEARS),
    FIELD(ceduo_curve, dbh_rate, NUMBER, YEARS),
    FIELD(ceduo_curve, height_max, NUMBER, YEARS),
    FIELD(ceduo_curve, height_rate, NUMBER, YEARS),
};

static const struct field cutting_fields[] = {
    FIELD(ceduo_cutting, rotation, WORD, YEARS),
    FIELD(ceduo_cutting, cohorts, WORD, YEARS),
    FIELD(ceduo_cutting, retained_count, COUNT, YEARS),
};

/* ---- fields to walk over ---- */

static void walk_simulation(enum about about)
{
    WALK(about, &site.scene.simulation, simulation_fields);
}

static void walk_option(enum about about)
{
    WALK(about, &site.option, option_fields);
    for (size_t i = 0; i < 2; i++) {
        struct ceduo_stand *stand = &site.belts[i].stand;
        ROWS(WALK, (about, &site.belts[i], belt_fields), (about, stand, stand_fields),
             (about, &site.plots[i].shoots, stems_fields), (about, &site.plots[i].trees, stems_fields),
             (about, &stand->growth, growth_fields), (about, &stand->growth.shoots, curve_fields),
             (about, &stand->growth.trees, curve_fields), (about, &stand->cutting, cutting_fields));
    }
}

/* Open the paper's site with forests that are cut regularly. */
static void open_site(void)
{
    paper_site_init(&site);
    for (size_t i = 0; i < 2; i++) {
        /* a species with another volume than the one before, for stems high enough for its equation */
        site.belts[i].stand.species = ceduo_species_find("fraxinus-ornus");
        site.plots[i].shoots.height = site.plots[i].trees.height = 8;
        site.belts[i].stand.cutting =
            (struct ceduo_cutting){.rotation = 25, .cohorts = 3, .retained_count = LENGTH(stay), .stay_per_ha = stay};
    }
}

TEST(inputs_of_a_flight_affect_the_scene_key)
{
    open_site();
    ROWS(WALK, (FLIGHT, &site.scene, scene_fields), (FLIGHT, &site.scene.rock, rock_fields),
         (FLIGHT, &site.scene.release, release_fields), (FLIGHT, &site.scene.slope, slope_fields));
    walk_numbers(FLIGHT, site.x, PAPER_VERTICES, "x of a vertex");
    walk_numbers(FLIGHT, site.z, PAPER_VERTICES, "z of a vertex");
    for (size_t j = 0; j < PAPER_SEGMENTS; j++)
        WALK(FLIGHT, &site.segments[j], segment_fields);
    WALK(FLIGHT, &site.control, control_fields);
    walk_simulation(FLIGHT);
    walk_option(FLIGHT); /* a forest has its own key */
}

/* The frequencies of blocks matter as well. */
TEST(block_frequencies_affect_the_scene_key)
{
    double volumes[] = {0.1, 1, 1, 5};
    struct ceduo_size_class classes[] = {{2, 1, 2, volumes}, {1, 0, 2, volumes + 2}};
    open_site();
    uint64_t none = compute_key(FLIGHT);
    site.scene.blocks = classes;
    site.scene.blocks_count = 1;
    uint64_t one = compute_key(FLIGHT);
    EXPECT(one, !=, none);
    site.scene.blocks_count = 2;
    EXPECT(compute_key(FLIGHT), !=, one);
    for (size_t i = 0; i < LENGTH(classes); i++)
        WALK(FLIGHT, &classes[i], class_fields);
    walk_numbers(FLIGHT, volumes, LENGTH(volumes), "volume");
}

/* Two values exchanged make another scene. */
TEST(exchanged_values_affect_the_scene_key)
{
    open_site();
    site.scene.release.vx = ceduo_number(2);
    site.scene.release.vz = ceduo_number(-1);
    uint64_t key = compute_key(FLIGHT);
    site.scene.release.vx = ceduo_number(-1);
    site.scene.release.vz = ceduo_number(2);
    EXPECT(compute_key(FLIGHT), !=, key);
    site.segments[0].roughness_m = .25;
    site.segments[0].roughness_rad = NAN;
    key = compute_key(FLIGHT);
    site.segments[0].roughness_m = NAN;
    site.segments[0].roughness_rad = .25;
    EXPECT(compute_key(FLIGHT), !=, key);
}

TEST(stems_affect_the_forest_key)
{
    open_site();
    walk_simulation(STEMS);
    walk_option(STEMS);
    for (size_t i = 0; i < 2; i++) {
        site.belts[i].stand.energy = CEDUO_ENERGY_MODEL_DORREN;
        site.belts[i].stand.fracture_ratio = 1.5;
    }
    walk_option(DORREN);
    for (size_t i = 0; i < 2; i++) {
        site.belts[i].stand.energy = CEDUO_ENERGY_MODEL_BRAUNER;
        site.plots[i].shoots.dbh_sd = site.plots[i].trees.dbh_sd = .02;
    }
    walk_option(DBHS);
}

/* Low wood and groups matter; empty ones have no effect. */
TEST(low_wood_and_groups_affect_the_forest_key)
{
    open_site();
    struct ceduo_stand *stand = &site.belts[0].stand;
    uint64_t bare = compute_key(STEMS);
    stand->stumps.energy = stand->logs.energy = site.plots[0].trees.group_radius = 3;
    EXPECT(compute_key(STEMS), ==, bare);
    stand->stumps = (struct ceduo_stumps){.per_ha = 300, .diameter = .2, .height = .3, .energy = 1e3};
    stand->logs = (struct ceduo_logs){.per_ha = 300, .length = 2, .diameter = .3, .energy = 1e3};
    site.plots[0].trees.group = 3;
    ROWS(WALK, (STEMS, &stand->stumps, stump_fields), (STEMS, &stand->logs, log_fields),
         (STEMS, &site.plots[0].trees, group_fields), (YEARS, &stand->stumps, stump_fields));
}

/* The same numbers in other members make another forest. */
TEST(other_stems_make_another_forest)
{
    open_site();
    struct ceduo_stand *stand = &site.belts[0].stand;
    struct ceduo_stems *shoots = &site.plots[0].shoots;
    struct ceduo_stems both[] = {site.plots[0].shoots, site.plots[0].trees};
    uint64_t key = compute_key(STEMS);
    stand->shoots = both; /* former trees are now shoots of the stools */
    stand->shoots_count = 2;
    stand->trees_count = 0;
    EXPECT(compute_key(STEMS), !=, key);
    open_site();
    stand->trees_count = 0;
    shoots->volume = 1.5; /* a hit takes 1.5 J, or 1.5 times dorren's energy */
    stand->u = 1;
    key = compute_key(STEMS);
    stand->energy = CEDUO_ENERGY_MODEL_DORREN;
    stand->fracture_ratio = 1.5;
    EXPECT(compute_key(DORREN), !=, key);
    open_site();
    shoots->dbh_sd = .02;
    shoots->volume = NAN; /* each stem has its species' volume at its diameter, */
    key = compute_key(DBHS);
    enum ceduo_volume_from from;
    shoots->volume = ceduo_stem_volume(stand, shoots, &from);
    EXPECT(compute_key(DBHS), !=, key); /* or all together have the given mean */
}

/* Stems with equal energy per hit are the same forest: half the volume with twice the work. Without stems there is no forest,
 * not even for the index. */
TEST(stems_with_equal_energy_are_the_same_forest)
{
    open_site();
    struct ceduo_stand *stand = &site.belts[0].stand;
    stand->trees_count = 0;
    stand->u = 1000;
    site.plots[0].shoots.volume = 2;
    uint64_t key = compute_key(STEMS);
    stand->u = 2000;
    site.plots[0].shoots.volume = 1;
    EXPECT(compute_key(STEMS), ==, key);
    stand->shoots_count = 0;
    key = compute_key(STEMS);
    site.belts[0].to -= 1; /* a belt without stems */
    EXPECT(compute_key(STEMS), ==, key);
    EXPECT(key, !=, 0);
    site.belts[1].stand.shoots_count = site.belts[1].stand.trees_count = 0;
    EXPECT(compute_key(STEMS), ==, 0);
    open_site();
    site.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    EXPECT(compute_key(STEMS), ==, 0);
}

/* The same number of shoots in three cohorts, with the shares of the last two exchanged. */
TEST(cohorts_of_another_share_make_another_forest)
{
    open_site();
    struct ceduo_stems cohorts[3];
    for (size_t i = 0; i < LENGTH(cohorts); i++) {
        cohorts[i] = site.plots[0].shoots;
        cohorts[i].dbh = .02 * (double)(i + 1);
        cohorts[i].per_ha = 1000 * (double)(i + 1);
    }
    site.belts[0].stand.shoots = cohorts;
    site.belts[0].stand.shoots_count = LENGTH(cohorts);
    uint64_t key = compute_key(STEMS);
    cohorts[1].per_ha = 3000;
    cohorts[2].per_ha = 2000;
    EXPECT(compute_key(STEMS), !=, key);
}

TEST(inputs_of_growth_affect_the_years_key)
{
    open_site();
    walk_option(YEARS);
    walk_numbers(YEARS, stay, LENGTH(stay), "trees that stay");
    walk_simulation(YEARS);
}
