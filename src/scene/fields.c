/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of keys of files, with the members of the scene that hold their values. To add a key, add a member with a comment
 * to a public header, and a row here. */
#include "fields.h"

#include <string.h>

#define NAME_IT(member, more_flags)                                                                                            \
    ROW(FIELD_TEXT, "name_it", NO_RANGE, .shown = NAMED(N_("in Italian")), member, .flags = KEYLESS(NO_RUN | (more_flags)),    \
        .meaning = N_("the same in Italian pages, screens and lists; without it in English"))

/* ---- rock ---- */

static const struct field rock_fields[] = {
    WORD("shape", .shown = NAMED(N_("shape")), MEMBER(ceduo_rock_def, shape), .value = "sphere",
         .meaning = N_("shape of the rock"), .choices = &ceduo_shape_words),
    SPREAD("diameter_m", .shown = USUAL(N_("diameter, m"), 0.05, 15), MEMBER(ceduo_rock_def, diameter), RANGE("m", 0, 1000),
           .flags = ABOVE, .meaning = N_("diameter of a sphere or cylinder")),
    SPREAD("height_m", .shown = USUAL(N_("height, m"), 0.05, 15), MEMBER(ceduo_rock_def, height), RANGE("m", 0, 1000),
           .flags = ABOVE, .meaning = N_("height of a cylinder")),
    ROW(FIELD_SPREADS, "axes_m", .shown = USUAL(N_("axes, m"), 0.05, 15), MEMBER(ceduo_rock_def, axes), RANGE("m", 0, 1000),
        .flags = ABOVE, .meaning = N_("the three axes of an ellipsoid or block")),
    SPREAD("volume_m3", .shown = USUAL(N_("volume, m3"), 0.0001, 2000), MEMBER(ceduo_rock_def, volume), RANGE("m3", 0, 1e6),
           .flags = ABOVE, .meaning = N_("volume of a sphere, instead of its diameter")),
    SPREAD("mass_kg", .shown = USUAL(N_("mass, kg"), 0.1, 5e6), MEMBER(ceduo_rock_def, mass), RANGE("kg", 0, 1e10),
           .flags = ABOVE, .meaning = N_("mass: of a sphere instead of its diameter, of other shapes instead of the density")),
    SPREAD("density_kg_m3", .shown = USUAL(N_("density, kg/m3"), 1000, 5000), MEMBER(ceduo_rock_def, density),
           RANGE("kg/m3", 0, 30000), .flags = ABOVE, .value = "2600",
           .meaning = N_("density of the rock; the default is limestone's, an assumption")),
};
const struct object ceduo_rock_object = OBJECT(ceduo_rock_def, rock_fields, NULL);

/* ---- blocks ---- */

static const struct field block_fields[] = {
    NUMBER("per_year", .shown = SHOWN(N_("blocks per year"), N_("per year"), 0.0001, 1000), MEMBER(ceduo_size_class, per_year),
           RANGE("1/y", 0, 1e6), .flags = REQUIRED | ABOVE, .meaning = N_("blocks of these sizes that come down in a year")),
    ROW(FIELD_NUMBERS, "volume_m3", .shown = SHOWN(N_("volumes, m3"), N_("m3"), 0.0001, 2000),
        LIST(ceduo_size_class, volumes, volumes_count), RANGE("m3", 0, 1e6), .flags = REQUIRED | ABOVE,
        .meaning = N_("the smallest and the largest: [lo, hi]")),
    NUMBER("exponent", .shown = USUAL(N_("exponent"), 0.2, 2), MEMBER(ceduo_size_class, exponent), RANGE("", 0, 10),
           .flags = FIELD_ZERO,
           .meaning =
               N_("the number of blocks above a volume v goes with v^-exponent; 0, in a list of classes also the default: as "
                  "many in every range of equal ratio")),
};
static const struct object block_object = OBJECT(ceduo_size_class, block_fields, NULL);
ASKED_AT_ONCE(block_fields);

/* ---- release ---- */

#define RELEASE_FIELDS                                                                                                         \
    SPREAD("x_m", .shown = NAMED(N_("x, m")), MEMBER(ceduo_release, x), RANGE("m", -COORDINATE_MAX, COORDINATE_MAX),           \
           .flags = FIELD_MEANLESS | FIELD_PLACE,                                                                              \
           .meaning = N_("where the rock starts; in the slope's coordinates; without it at the first vertex")),                \
        SPREAD("height_m", .shown = USUAL(N_("height, m"), 0, 500), MEMBER(ceduo_release, height), RANGE("m", 0, 10000),       \
               .value = "0", .meaning = N_("height of its underside above the ground")),                                       \
        SPREAD("vx_m_s", .shown = USUAL(N_("speed along, m/s"), -60, 60), MEMBER(ceduo_release, vx),                           \
               RANGE("m/s", -1000, 1000), .value = "0", .meaning = N_("horizontal speed, positive downslope along x")),        \
        SPREAD("vz_m_s", .shown = USUAL(N_("speed upward, m/s"), -60, 60), MEMBER(ceduo_release, vz),                          \
               RANGE("m/s", -1000, 1000), .value = "0", .meaning = N_("vertical speed, positive upward")),                     \
        SPREAD("spin_rad_s", .shown = USUAL(N_("spin, rad/s"), -200, 200), MEMBER(ceduo_release, spin),                        \
               RANGE("rad/s", -10000, 10000), .value = "0",                                                                    \
               .meaning = N_("spin, positive rolling forward; not used by the law lumped"))
static const struct field release_fields[] = {RELEASE_FIELDS};
static const struct field shared_release_fields[] = {
    RELEASE_FIELDS, NUMBER("share", .shown = NAMED(N_("share")), MEMBER(ceduo_release, share), RANGE("", 0, 1),
                           .flags = FIELD_REQUIRED | FIELD_ABOVE,
                           .meaning = N_("share of the rocks that start here; the shares of all releases add up to 1"))};
static const struct object shared_release_object = OBJECT(ceduo_release, shared_release_fields, NULL);
const struct object ceduo_release_object = OBJECT(ceduo_release, release_fields, NULL);

/* ---- slope ---- */

static const struct field segment_fields[] = {
    SPREAD("rn", .shown = BRIEF(N_("bounce Rn"), N_("Rn")), MEMBER(ceduo_segment, rn), RANGE("", 0, 1), .flags = REQUIRED,
           .meaning = N_("normal restitution Rn")),
    SPREAD("rt", .shown = BRIEF(N_("slide Rt"), N_("Rt")), MEMBER(ceduo_segment, rt), RANGE("", 0, 1), .flags = REQUIRED,
           .meaning = N_("tangential restitution Rt")),
    NUMBER("roughness_rad", .shown = BRIEF(N_("roughness, rad"), N_("rough. rad")), MEMBER(ceduo_segment, roughness_rad),
           RANGE("rad", 0, M_PI_2), .flags = FIELD_UNDER | FIELD_ONE_OF, .value = "0",
           .meaning = N_("largest angle by which the ground's small facets are turned")),
    NUMBER("roughness_m", .shown = BRIEF(N_("roughness, m"), N_("rough. m")), MEMBER(ceduo_segment, roughness_m),
           RANGE("m", 0, 1000), .meaning = N_("the same as a height S over the rock's radius, atan(S/R), as in CRSP")),
    NUMBER("friction", .shown = NAMED(N_("friction")), MEMBER(ceduo_segment, friction), RANGE("", 0, 100), .value = "0.5",
           .meaning = N_("tangent of the angle of rolling friction; the default is an assumption")),
    NUMBER("mu", .shown = BRIEF(N_("grip mu"), N_("mu")), MEMBER(ceduo_segment, mu), RANGE("", 0, 3), .value = "0.6",
           .meaning = N_("arm: Coulomb's friction where the rock strikes; the default is an assumption")),
};
static const struct object segment_object = OBJECT(ceduo_segment, segment_fields, NULL);

static const struct field material_fields[] = {
    NUMBER("from_m", .shown = BRIEF(N_("from, m"), N_("from m")), MEMBER(material_belt, from),
           RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = REQUIRED, .meaning = N_("where it begins")),
    NUMBER("to_m", .shown = BRIEF(N_("to, m"), N_("to m")), MEMBER(material_belt, to),
           RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = REQUIRED, .meaning = N_("where it ends")),
    WORD("material", .shown = NAMED(N_("ground")), MEMBER(material_belt, material), .flags = REQUIRED,
         .meaning = N_("a ground of the library"), .choices = &ceduo_material_words),
    NUMBER("rn", .shown = BRIEF(N_("bounce Rn"), N_("Rn")), MEMBER(material_belt, rn), RANGE("", 0, 1),
           .meaning = N_("normal restitution Rn")),
    NUMBER("rt", .shown = BRIEF(N_("slide Rt"), N_("Rt")), MEMBER(material_belt, rt), RANGE("", 0, 1),
           .meaning = N_("tangential restitution Rt")),
    NUMBER("roughness_m", .shown = BRIEF(N_("roughness, m"), N_("rough. m")), MEMBER(material_belt, roughness),
           RANGE("m", 0, 1000), .meaning = N_("the same as a height S over the rock's radius, atan(S/R), as in CRSP")),
    NUMBER("friction", .shown = NAMED(N_("friction")), MEMBER(material_belt, friction), RANGE("", 0, 100),
           .meaning = N_("tangent of the angle of rolling friction; the default is an assumption")),
    NUMBER("mu", .shown = BRIEF(N_("grip mu"), N_("mu")), MEMBER(material_belt, mu), RANGE("", 0, 3),
           .meaning = N_("arm: Coulomb's friction where the rock strikes; the default is an assumption")),
};
static const struct object material_object = OBJECT(material_belt, material_fields, NULL);

static const struct field slope_fields[] = {
    TAG("slope/1"),
    TEXT("name", NAMED(N_("name")), NO_MEMBER, FIELD_NO_MEMBER | NO_RUN, N_("name of the slope")),
    NAME_IT(NO_MEMBER, FIELD_NO_MEMBER),
    WORD("facets", .shown = NAMED(N_("facets")), MEMBER(ceduo_slope, facets), .value = "against",
         .meaning = N_("which way the ground's small facets are turned"), .choices = &ceduo_facets_words),
    ROW(FIELD_POINTS, "vertices_m", .shown = NAMED(N_("point of the profile")), POINTS(ceduo_slope, x, vertices),
        RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .meaning = N_("the profile: pairs [x, z], x rising")),
    ITEMS("segments", N_("ground"), LIST(ceduo_slope, segments, segments_given), FIELD_FILE_ONLY, &segment_object),
    ITEMS("materials", N_("ground"), SLOPE_LIST(materials, materials_count), FIELD_FILE_ONLY, &material_object),
    FILE_NAME("csv", NAMED(N_("file")), NO_MEMBER, FIELD_NO_MEMBER,
              N_("the profile from a CSV file with distance and elevation, instead of vertices_m")),
    TEXT("layer", NAMED(N_("line")), NO_MEMBER, FIELD_NO_MEMBER, N_("line of the CSV file, if the file holds several")),
    NUMBER(
        "tolerance_m", .shown = USUAL(N_("simplify to, m"), 0, 2), MEMBER(ceduo_slope, tolerance), RANGE("m", 0, 100),
        .value = "0.5",
        .meaning = N_(
            "distance within which points of the profile are left out: the roughness of the ground stands for smaller relief; "
            "the default is for ground from the library, an assumption; for segments it is 0: all points")),
    FLAG("reversed", .shown = NAMED(N_("drawn upward")), MEMBER(ceduo_slope, reversed), .value = "false",
         .meaning = N_(
             "true if the profile is drawn upward: it is mirrored with its segments or materials, so that x begins at its top; "
             "places in the scene are of the mirrored profile")),
};
static const struct object slope_object = OBJECT(ceduo_slope, slope_fields, "slopes");

/* ---- rules ---- */

#define ITEM_FIELDS(min_row, max_row)                                                                                          \
    WORD_LIST("species", NAMED(N_("species")), LIST(ceduo_regulation_item, species, species_count), NO_RUN,                    \
              N_("species of this row; without it all species that no earlier row names")),                                    \
        WORD("system", .shown = NAMED(N_("system")), MEMBER(ceduo_regulation_item, system), .flags = NO_RUN,                   \
             .meaning = N_("silvicultural system of this row; without it every system"), .choices = &ceduo_system_words),      \
        min_row, max_row,                                                                                                      \
        TEXT("article", NAMED(N_("article and act of the rule")), MEMBER(ceduo_regulation_item, article), REQUIRED | NO_RUN,   \
             N_("article")),                                                                                                   \
        ROW(FIELD_COUNT, "year", .shown = NAMED(N_("year")), MEMBER(ceduo_regulation_item, year), RANGE("", 1800, 2200),       \
            .flags = REQUIRED | NO_RUN, .meaning = N_("year of that act"))

static const struct field standards_fields[] = {
    ITEM_FIELDS(NUMBER("per_ha", .shown = NAMED(N_("standards per ha")), MEMBER(ceduo_regulation_item, min),
                       RANGE("1/ha", 0, 1e5), .flags = REQUIRED | NO_RUN,
                       .meaning = N_("standards that a cut must leave at least")),
                NUMBER("most_per_ha", .shown = NAMED(N_("at most")), MEMBER(ceduo_regulation_item, max), RANGE("1/ha", 0, 1e5),
                       .flags = NO_RUN, .meaning = N_("standards that it may leave at most"))),
};
static const struct object standards_object = OBJECT(ceduo_regulation_item, standards_fields, NULL);

static const struct field turns_fields[] = {
    ITEM_FIELDS(NUMBER("least_y", .shown = NAMED(N_("years at least")), MEMBER(ceduo_regulation_item, min), RANGE("y", 0, 1000),
                       .flags = REQUIRED | NO_RUN, .meaning = N_("age at which shoots may be cut at the earliest")),
                NUMBER("most_y", .shown = NAMED(N_("at most")), MEMBER(ceduo_regulation_item, max), RANGE("y", 0, 1000),
                       .flags = NO_RUN, .meaning = N_("age at which they may be cut at the latest"))),
};
static const struct object turns_object = OBJECT(ceduo_regulation_item, turns_fields, NULL);

static const struct field rules_fields[] = {
    TAG("rules/1"),
    TEXT("name", NAMED(N_("region")), MEMBER(ceduo_regulation, name), REQUIRED | NO_RUN, N_("name of the region")),
    TEXT("note", NAMED(N_("note")), MEMBER(ceduo_regulation, note), NO_RUN, N_("remark printed with the rules")),
    TEXT("note_it", NAMED(N_("in Italian")), MEMBER(ceduo_regulation, note_it), NO_RUN,
         N_("the same in Italian pages, screens and lists; without it in English")),
    ITEMS("standards", N_("standards"), LIST(ceduo_regulation, standards, standards_count), NO_RUN, &standards_object),
    ITEMS("turns", N_("rotations"), LIST(ceduo_regulation, turns, turns_count), NO_RUN, &turns_object),
};
static const struct object rules_object = OBJECT(ceduo_regulation, rules_fields, "rules");

/* ---- uncertainty ---- */

#define UNCERTAINTY_NUMBER(key, name, member, about)                                                                           \
    NUMBER(key, .shown = NAMED(name), MEMBER(uncertainty_row, member), RANGE("", -1e12, 1e12), .flags = NO_RUN,                \
           .meaning = about)

static const struct field uncertainty_fields[] = {
    TEXT("path", NAMED(N_("value")), MEMBER(uncertainty_row, path), REQUIRED | NO_RUN,
         N_("the uncertain value, as for --set; [*] stands for all items; slope.materials[NAME].KEY for a ground")),
    UNCERTAINTY_NUMBER("lo", N_("lower end"), lo, N_("lowest plausible value, in its unit; with hi")),
    UNCERTAINTY_NUMBER("hi", N_("upper end"), hi, N_("highest plausible value; all values between are equally likely")),
    UNCERTAINTY_NUMBER("mean", N_("mean"), mean, N_("instead: the mean of a normal distribution; with sd")),
    UNCERTAINTY_NUMBER("sd", N_("standard deviation"), sd,
                       N_("its standard deviation; the distribution is truncated at three of them")),
    WORD_LIST("one_of", NAMED(N_("one of")), LIST(uncertainty_row, one_of, one_of_count), NO_RUN,
              N_("instead, for a word: the plausible words, all equally likely")),
};
static const struct object uncertainty_object = OBJECT(uncertainty_row, uncertainty_fields, NULL);

/* ---- stand ---- */

/* Rows for shoots and for trees. */
#define STEM_ROWS(given)                                                                                                       \
    NUMBER("per_ha", .shown = SHOWN(N_("per hectare"), N_("per ha"), 0, 50000), MEMBER(ceduo_stems, per_ha),                   \
           RANGE("1/ha", 0, 1e6), .flags = given, .meaning = N_("stems per horizontal hectare")),                              \
        NUMBER("dbh_m", .shown = CENTIMETRES(N_("diameter, cm"), N_("diam. cm"), 0.01, 2), MEMBER(ceduo_stems, dbh),           \
               RANGE("m", 0, 10), .flags = REQUIRED | ABOVE, .meaning = N_("diameter at breast height")),                      \
        NUMBER("dbh_cm", .shown = SHOWN(N_("diameter, cm"), N_("diam. cm"), 1, 200), MEMBER(ceduo_stems, dbh),                 \
               SCALED_RANGE("cm", 0.01, 0, 1000), .flags = ABOVE, .meaning = N_("the same in centimetres, instead of dbh_m")), \
        NUMBER("height_m", .shown = SHOWN(N_("height, m"), N_("height m"), 0.5, 50), MEMBER(ceduo_stems, height),              \
               RANGE("m", 0, 150), .flags = REQUIRED | ABOVE, .meaning = N_("height")),                                        \
        NUMBER("volume_m3", .shown = SHOWN(N_("volume, m3"), N_("vol. m3"), 0, 30), MEMBER(ceduo_stems, volume),               \
               RANGE("m3", 0, 1000), .flags = ABOVE,                                                                           \
               .meaning = N_("volume of a stem; without it from species, dbh and height")),                                    \
        NUMBER("dbh_sd_m", .shown = CENTIMETRES(N_("spread of the diameters, cm"), N_("sd cm"), 0, 0.5),                       \
               MEMBER(ceduo_stems, dbh_sd), RANGE("m", 0, 10), .value = "0",                                                   \
               .meaning = N_("standard deviation of the diameters")),                                                          \
        NUMBER("dbh_sd_cm", .shown = SHOWN(N_("spread of the diameters, cm"), N_("sd cm"), 0, 50),                             \
               MEMBER(ceduo_stems, dbh_sd), SCALED_RANGE("cm", 0.01, 0, 1000), .value = "0",                                   \
               .meaning = N_("the same in centimetres, instead of dbh_sd_m")),                                                 \
        NUMBER("age_y", .shown = SHOWN(N_("age, years"), N_("age y"), 0, 500), MEMBER(ceduo_stems, age), RANGE("y", 0, 2000),  \
               .flags = YEARS, .meaning = N_("age"))

static const struct field stems_fields[] = {
    NUMBER("per_stool", .shown = SHOWN(N_("shoots per stool"), N_("a stool"), 0.1, 15), MEMBER(ceduo_stems, per_stool),
           RANGE("", 0, 10000), .flags = ABOVE | FIELD_ONE_OF,
           .meaning = N_("shoots on each stool, instead of per_ha: with more stools there are more shoots")),
    STEM_ROWS(FIELD_ONE_OF),
};
static const struct object stems_object = OBJECT(ceduo_stems, stems_fields, NULL);

static const struct field groups_fields[] = {
    ROW(FIELD_COUNT, "stems", .shown = SHOWN(N_("trees in a group"), N_("in group"), 1, 30), MEMBER(ceduo_stems, group),
        RANGE("", 1, 200), .value = "1", .meaning = N_("trees that stand together in a group; 1: each by itself")),
    NUMBER("radius_m", .shown = SHOWN(N_("radius of a group, m"), N_("radius m"), 0.5, 30), MEMBER(ceduo_stems, group_radius),
           RANGE("m", 0, 100), .meaning = N_("radius of the disc in which the trees of a group stand at random")),
};
static const struct object groups_object = OBJECT(ceduo_stems, groups_fields, NULL);

static const struct field trees_fields[] = {
    STEM_ROWS(REQUIRED),
    GROUP("groups", N_("groups"), EMBEDDED, 0, &groups_object),
};
static const struct object trees_object = OBJECT(ceduo_stems, trees_fields, NULL);

static const struct field stumps_fields[] = {
    NUMBER("per_ha", .shown = USUAL(N_("stumps per ha"), 0, 10000), MEMBER(ceduo_stumps, per_ha), RANGE("1/ha", 0, 1e6),
           .flags = ZERO, .meaning = N_("stumps per horizontal hectare")),
    NUMBER("diameter_m", .shown = CENTIMETRES(N_("diameter, cm"), NULL, 0.02, 2), MEMBER(ceduo_stumps, diameter),
           RANGE("m", 0, 10), .flags = ABOVE, .meaning = N_("diameter of a stump")),
    NUMBER("height_m", .shown = USUAL(N_("height, m"), 0.02, 2), MEMBER(ceduo_stumps, height), RANGE("m", 0, 20),
           .flags = ABOVE, .meaning = N_("height of a stump: a rock higher above the ground flies over")),
    NUMBER("energy_kJ", .shown = USUAL(N_("takes, kJ"), 0, 500), MEMBER(ceduo_stumps, energy), SCALED_RANGE("kJ", 1000, 0, 1e6),
           .meaning = N_("energy that a hit takes from the rock")),
};
static const struct object stumps_object = OBJECT(ceduo_stumps, stumps_fields, NULL);

static const struct field logs_fields[] = {
    NUMBER("per_ha", .shown = USUAL(N_("logs per ha"), 0, 2000), MEMBER(ceduo_logs, per_ha), RANGE("1/ha", 0, 1e6),
           .flags = ZERO, .meaning = N_("lying logs per horizontal hectare")),
    NUMBER("length_m", .shown = USUAL(N_("length, m"), 0.5, 40), MEMBER(ceduo_logs, length), RANGE("m", 0, 150), .flags = ABOVE,
           .meaning = N_("length of a log, which lies at a random angle")),
    NUMBER("diameter_m", .shown = CENTIMETRES(N_("diameter, cm"), NULL, 0.02, 2), MEMBER(ceduo_logs, diameter),
           RANGE("m", 0, 10), .flags = ABOVE, .meaning = N_("diameter of a log: a rock higher above the ground flies over")),
    NUMBER("energy_kJ", .shown = USUAL(N_("takes, kJ"), 0, 500), MEMBER(ceduo_logs, energy), SCALED_RANGE("kJ", 1000, 0, 1e6),
           .meaning = N_("energy that a hit takes from the rock")),
};
static const struct object logs_object = OBJECT(ceduo_logs, logs_fields, NULL);

static const struct field stools_fields[] = {
    NUMBER("per_ha", .shown = USUAL(N_("stools per ha"), 0, 10000), MEMBER(ceduo_stand, stools_per_ha), RANGE("1/ha", 0, 1e6),
           .flags = REQUIRED | ZERO, .meaning = N_("stools per horizontal hectare")),
    NUMBER("spacing_m", .shown = USUAL(N_("spacing, m"), 0.02, 3), MEMBER(ceduo_stand, spacing), RANGE("m", 0, 20),
           .flags = REQUIRED | ZERO, .meaning = N_("distance between neighbouring shoots of a stool (dbh_int of the paper)")),
};
static const struct object stools_object = OBJECT(ceduo_stand, stools_fields, NULL);

static const struct field energy_fields[] = {
    WORD("model", .shown = NAMED(N_("energy law")), MEMBER(ceduo_stand, energy), .value = "brauner",
         .meaning = N_("energy law: what a contact with a stem takes from the rock"), .choices = &ceduo_energy_words),
    NUMBER("u_J_m3", .shown = SHOWN(N_("stem strength U, J/m3"), N_("U, J/m3"), 20000, 500000), MEMBER(ceduo_stand, u),
           RANGE("J/m3", 0, 1e7), .flags = ABOVE,
           .meaning = N_("brauner: work of breaking; without it that of the species, or of beech if unknown")),
    NUMBER("fracture_ratio", .shown = NAMED(N_("fracture ratio")), MEMBER(ceduo_stand, fracture_ratio), RANGE("", 0, 10),
           .flags = ABOVE,
           .meaning =
               N_("dorren: energy of this species over that of silver fir; without it that of the species, or 1 if unknown")),
    WORD("offset", .shown = NAMED(N_("hit off centre")), MEMBER(ceduo_stand, offset), .value = "dorren",
         .meaning = N_("brauner, a stem hit beside its middle: the whole energy, or the share of Dorren et al. 2006"),
         .choices = &ceduo_offset_words),
    NUMBER("hit_below_m", .shown = USUAL(N_("hits below, m"), 0.5, 10), MEMBER(ceduo_stand, hit_below), RANGE("m", 0, 150),
           .flags = ABOVE | ZERO,
           .meaning =
               N_("a hit takes nothing where the centre of the rock is higher, as a thin stem bends away; without it every hit "
                  "takes")),
};
static const struct object energy_object = OBJECT(ceduo_stand, energy_fields, NULL);

const char *ceduo_schema_alternative(const struct object *object, const char *key)
{
    static const char *const pairs[][2] = {{"per_ha", "per_stool"},          {"dbh_m", "dbh_cm"},   {"dbh_sd_m", "dbh_sd_cm"},
                                           {"roughness_rad", "roughness_m"}, {"vertices_m", "csv"}, {"segments", "materials"},
                                           {"controls", "controls_m"},       {"forest", "options"}};
    for (size_t i = 0; i < 2 * (sizeof pairs / sizeof pairs[0]); i++)
        if (strcmp(key, pairs[i / 2][i % 2]) == 0 && ceduo_schema_field(object, pairs[i / 2][1 - i % 2]))
            return pairs[i / 2][1 - i % 2];
    return NULL;
}

bool ceduo_schema_same(const char *a, const char *b)
{
    const char *key = strrchr(a, '.'), *other_key = strrchr(b, '.');
    bool siblings = key && other_key && key - a == other_key - b && strncmp(a, b, (size_t)(key - a)) == 0;
    const char *alternative = siblings ? ceduo_schema_alternative(&stems_object, key + 1) : NULL;
    return strcmp(a, b) == 0 || (alternative && strcmp(alternative, other_key + 1) == 0);
}

static const struct field curve_fields[] = {
    NUMBER("dbh_most_m", .shown = CENTIMETRES(N_("largest diam., cm"), NULL, 0.02, 3), MEMBER(ceduo_curve, dbh_max),
           RANGE("m", 0, 10), .flags = REQUIRED | ABOVE | ZERO | YEARS,
           .meaning = N_("diameter that old stems approach: d(t) = D(1 - exp(-kt))")),
    NUMBER("dbh_rate_1_y", .shown = NAMED(N_("its rate, 1/year")), MEMBER(ceduo_curve, dbh_rate), RANGE("1/y", 0, 10),
           .flags = REQUIRED | ABOVE | ZERO | YEARS, .meaning = N_("k of the diameter")),
    NUMBER("height_most_m", .shown = USUAL(N_("largest height, m"), 1, 60), MEMBER(ceduo_curve, height_max), RANGE("m", 0, 150),
           .flags = REQUIRED | ABOVE | ZERO | YEARS, .meaning = N_("height that old stems approach: h(t) = H(1 - exp(-mt))")),
    NUMBER("height_rate_1_y", .shown = NAMED(N_("its rate, 1/year")), MEMBER(ceduo_curve, height_rate), RANGE("1/y", 0, 10),
           .flags = REQUIRED | ABOVE | ZERO | YEARS, .meaning = N_("m of the height")),
};
static const struct object curve_object = OBJECT(ceduo_curve, curve_fields, NULL);

static const struct field growth_fields[] = {
    GROUP("shoots", N_("shoots"), MEMBER(ceduo_growth, shoots), 0, &curve_object),
    GROUP("trees", N_("trees"), MEMBER(ceduo_growth, trees), 0, &curve_object),
    NUMBER("shoots_young", .shown = NAMED(N_("shoots when young")), MEMBER(ceduo_growth, shoots_young), RANGE("", 1, 1000),
           .flags = ZERO | YEARS, .meaning = N_("shoots that come up on a stool after a cut")),
    NUMBER("shoots_old", .shown = NAMED(N_("shoots when old")), MEMBER(ceduo_growth, shoots_old), RANGE("", 1, 1000),
           .flags = ZERO | YEARS, .meaning = N_("shoots of an old stool: n(t) = old + (young - old)exp(-t/5)")),
    NUMBER("trees_sdi_most", .shown = NAMED(N_("density of trees alone")), MEMBER(ceduo_growth, trees_sdi_max),
           RANGE("", 0, 1e5), .flags = ZERO | YEARS,
           .meaning = N_("density index of the trees at which they take all growing space; without it 35 % of sdi_most, an "
                         "assumption")),
    NUMBER("sdi_most", .shown = NAMED(N_("greatest density")), MEMBER(ceduo_growth, sdi_max), RANGE("", 0, 1e5),
           .flags = ZERO | YEARS,
           .meaning = N_("stand density index to which shoots thin themselves; 0 or absent: they do not")),
    ROW(FIELD_COUNT, "stump_years", .shown = USUAL(N_("stumps stay, years"), 0, 100), MEMBER(ceduo_growth, stump_years),
        RANGE("y", 0, 500), .flags = YEARS, .value = "0", .meaning = N_("years for which the stumps of a cut stay")),
};
static const struct object growth_object = OBJECT(ceduo_growth, growth_fields, NULL);

static const struct field cutting_fields[] = {
    ROW(FIELD_COUNT, "rotation_years", .shown = USUAL(N_("rotation, years"), 2, 300), MEMBER(ceduo_stand, cutting.rotation),
        RANGE("y", 1, 500), .flags = REQUIRED | YEARS, .meaning = N_("years between two cuts")),
    ROW(FIELD_COUNT, "cohorts", .shown = NAMED(N_("ages on a stool")), MEMBER(ceduo_stand, cutting.cohorts), RANGE("", 1, 20),
        .flags = YEARS, .value = "1",
        .meaning = N_("cohorts of shoots on a stool; each cut takes the oldest; 1: all shoots are cut")),
    ROW(FIELD_NUMBERS, "stay_per_ha", .shown = NAMED(N_("trees kept per ha")),
        LIST(ceduo_stand, cutting.stay_per_ha, cutting.retained_count), RANGE("1/ha", 0, 1e5), .flags = YEARS,
        .meaning = N_("single trees that a cut leaves: those one rotation old, two rotations old, …")),
};
static const struct object cutting_object = OBJECT(ceduo_stand, cutting_fields, NULL);

static const struct field stand_fields[] = {
    TAG("stand/1"),
    TEXT("name", NAMED(N_("name")), NO_MEMBER, FIELD_NO_MEMBER | NO_RUN, N_("name of the stand")),
    NAME_IT(NO_MEMBER, FIELD_NO_MEMBER),
    FILE_NAME("base", NAMED(N_("made from")), NO_MEMBER, FIELD_NO_MEMBER,
              N_("a stand file to start from: mappings given here are merged into it, lists replaced")),
    WORD("system", .shown = NAMED(N_("system")), MEMBER(ceduo_stand, system), .flags = NO_RUN,
         .meaning = N_("silvicultural system; without it derived from the stems"), .choices = &ceduo_system_words),
    WORD("species", .shown = NAMED(N_("species")), MEMBER(ceduo_stand, species), .flags = YEARS,
         .meaning = N_("main species: volume of its stems and work of breaking"), .choices = &ceduo_species_words),
    GROUP("stools", N_("stools"), EMBEDDED, 0, &stools_object),
    ITEMS("shoots", N_("shoots"), LIST(ceduo_stand, shoots, shoots_count), 0, &stems_object),
    ITEMS("trees", N_("trees"), LIST(ceduo_stand, trees, trees_count), 0, &trees_object),
    GROUP("stumps", N_("stumps"), MEMBER(ceduo_stand, stumps), 0, &stumps_object),
    GROUP("logs", N_("logs"), MEMBER(ceduo_stand, logs), 0, &logs_object),
    GROUP("energy", N_("energy"), EMBEDDED, 0, &energy_object),
    GROUP("growth", N_("growth"), MEMBER(ceduo_stand, growth), 0, &growth_object),
    GROUP("cutting", N_("cutting"), EMBEDDED, 0, &cutting_object),
    ITEMS("uncertainty", N_("uncertainty"), NO_MEMBER, FIELD_NO_MEMBER | FIELD_OR_NONE | NO_RUN | FIELD_CERTAIN,
          &uncertainty_object),
};
static const struct object stand_object = OBJECT(ceduo_stand, stand_fields, "stands");

/* ---- scene ---- */

static const struct field belt_fields[] = {
    NUMBER("from_m", .shown = BRIEF(N_("from, m"), N_("from m")), PLACE(ceduo_belt, from_given, from),
           RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = REQUIRED | FIELD_PLACE,
           .meaning = N_("where the belt begins; in the slope's coordinates")),
    NUMBER("to_m", .shown = BRIEF(N_("to, m"), N_("to m")), PLACE(ceduo_belt, to_given, to),
           RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = REQUIRED | FIELD_PLACE, .meaning = N_("where the belt ends")),
    NUMBER("cut_year", .shown = BRIEF(N_("cut in year"), N_("cut year")), MEMBER(ceduo_belt, cut_year), RANGE("y", -1000, 1000),
           .flags = YEARS,
           .meaning = N_("a year in which it is cut, counted from the stand as filed; without it as soon as it is old enough")),
    GROUP_LABELLED("stand", BRIEF(N_("stand"), NP_("head", "stand")), MEMBER(ceduo_belt, stand), REQUIRED | FIELD_FOLLOWS,
                   N_("a file, or what such a file holds"), &stand_object),
};
static const struct object belt_object = OBJECT(ceduo_belt, belt_fields, NULL);

static const struct field option_fields[] = {
    TEXT("name", NAMED(N_("name")), MEMBER(ceduo_option, name_given), REQUIRED | NO_RUN, N_("name of the option")),
    NAME_IT(MEMBER(ceduo_option, name), 0),
    ITEMS("forest", N_("belt"), LIST(ceduo_option, belts, belts_count), 0, &belt_object),
};
static const struct object option_object = OBJECT(ceduo_option, option_fields, NULL);

static const struct field fence_fields[] = {
    NUMBER("energy_kJ", .shown = USUAL(N_("fence, kJ"), 35, 10000), MEMBER(ceduo_fence, energy),
           SCALED_RANGE("kJ", 1000, 0, 1e6), .flags = REQUIRED | NO_RUN,
           .meaning = N_("energy that it holds: maximum energy level (MEL) of the tested kit")),
    NUMBER("height_m", .shown = USUAL(N_("fence, m high"), 1, 10), MEMBER(ceduo_fence, height), RANGE("m", 0, 100),
           .flags = REQUIRED | ABOVE | NO_RUN, .meaning = N_("nominal height, perpendicular to the ground")),
    NUMBER("life_y", .shown = USUAL(N_("life, years"), 5, 100), MEMBER(ceduo_fence, life), RANGE("y", 0, 1000),
           .flags = ABOVE | NO_RUN,
           .meaning = N_("years for which it stands, for the chance that a block defeats it; without it 50, an assumption")),
};
static const struct object fence_object = OBJECT(ceduo_fence, fence_fields, NULL);

static const struct field control_fields[] = {
    NUMBER("x_m", .shown = BRIEF(N_("counted at, m"), N_("at m")), PLACE(ceduo_control, x_given, x),
           RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = REQUIRED | FIELD_PLACE,
           .meaning = N_("where passing rocks are counted")),
    TEXT("name", NAMED(N_("name")), MEMBER(ceduo_control, name_given), NO_RUN, N_("name of the place")),
    NAME_IT(MEMBER(ceduo_control, name), 0),
    NUMBER("accepted_kJ", .shown = SHOWN(N_("limit, kJ"), N_("limit kJ"), 0, 20000), MEMBER(ceduo_control, accepted),
           SCALED_RANGE("kJ", 1000, 0, 1e9), .meaning = N_("energy that the structure or road there withstands")),
    NUMBER("accepted_return_y", .shown = SHOWN(N_("accepted return, years"), N_("return y"), 1, 10000),
           MEMBER(ceduo_control, accepted_return), RANGE("y", 0, 1e6), .flags = ABOVE | NO_RUN | FIELD_CERTAIN,
           .meaning =
               N_("with blocks: accepted years between two rocks with more than accepted_kJ; without it 100, an assumption")),
    NUMBER("measured_speed_m_s", .shown = SHOWN(N_("speed filmed, m/s"), N_("filmed m/s"), 0, 80),
           MEMBER(ceduo_control, measured_speed), RANGE("m/s", 0, 1000), .flags = NO_RUN,
           .meaning = N_("speed of a real rock seen there, for comparison")),
    GROUP_LABELLED("fence", NAMED(N_("net fence")), MEMBER(ceduo_control, fence), NO_RUN | FIELD_CERTAIN,
                   N_("a net fence that stands there, or is planned"), &fence_object),
};
static const struct object control_object = OBJECT(ceduo_control, control_fields, NULL);

static const struct field simulation_fields[] = {
    WORD("law", .shown = NAMED(N_("law of impact")), MEMBER(ceduo_simulation, law), .value = "crsp",
         .meaning = N_("law of impact"), .choices = &ceduo_law_words),
    ROW(FIELD_COUNT, "rocks", .shown = NAMED(N_("rocks (batch)")), MEMBER(ceduo_simulation, rocks),
        RANGE("", 1, CEDUO_ROCKS_MAX), .flags = NO_RUN | FIELD_CERTAIN, .value = "1000", .meaning = N_("rocks simulated")),
    ROW(FIELD_COUNT, "seed", .shown = NAMED(N_("seed")), MEMBER(ceduo_simulation, seed), RANGE("", 0, 9007199254740992.0),
        .flags = FIELD_CERTAIN, .value = "1", .meaning = N_("seed of the random numbers, 0 to 2^53")),
    WORD("contact_model", .shown = NAMED(N_("rocks among stems")), MEMBER(ceduo_simulation, contact_model),
         .flags = FIELD_FOREST, .value = "stems", .meaning = N_("how rocks meet stems: stem by stem, or not at all (index)"),
         .choices = &ceduo_contact_model_words),
    WORD("rule", .shown = NAMED(N_("form of the ADC")), MEMBER(ceduo_simulation, rule), .flags = NO_RUN, .value = "auto",
         .meaning = N_("form of the ADC; auto is the paper's rule"), .choices = &ceduo_rule_words),
    NUMBER("threshold_m", .shown = NAMED(N_("threshold, m")), MEMBER(ceduo_simulation, threshold), RANGE("m", 0, 1e6),
           .flags = ABOVE | NO_RUN, .value = STRING(CEDUO_THRESHOLD_M),
           .meaning = N_("ADC below which a stand protects: distance to full speed (Bozzolo 1987)")),
    NUMBER("contact_dbh_m", .shown = CENTIMETRES(N_("stems count from, cm"), NULL, 0, 0.5),
           MEMBER(ceduo_simulation, contact_dbh), RANGE("m", 0, 10), .flags = NO_RUN, .value = "0.03",
           .meaning = N_("diameter from which on stems count for ADC, free run and index; the default, at which coppice is "
                         "callipered, is an "
                         "assumption; 0: every stem")),
    NUMBER("gravity_m_s2", .shown = USUAL(N_("gravity, m/s2"), 9.7, 9.9), MEMBER(ceduo_simulation, gravity),
           RANGE("m/s2", 0, 1000), .flags = ABOVE, .value = STRING(CEDUO_GRAVITY), .meaning = N_("acceleration of gravity")),
    FLAG("scale_rn", .shown = NAMED(N_("Rn by speed")), MEMBER(ceduo_simulation, scale_rn), .value = "false",
         .meaning = N_("lumped: Rn falls with the speed of the impact, as in CRSP")),
    FLAG("friction_bound", .shown = NAMED(N_("friction bound")), MEMBER(ceduo_simulation, friction_bound), .value = "true",
         .meaning = N_("limit the tangential loss of an impact to friction times its normal impulse, and let rolling rocks "
                       "lose to friction alone; false: the published laws")),
};
static const struct object simulation_object = OBJECT(ceduo_simulation, simulation_fields, NULL);

static const struct field design_fields[] = {
    WORD("survey", .shown = NAMED(N_("survey of the ground")), MEMBER(ceduo_design_values, survey), .flags = REQUIRED | NO_RUN,
         .meaning = N_("how good this survey is"), .choices = &ceduo_quality_words),
    WORD("blocks", .shown = NAMED(N_("survey of the blocks")), MEMBER(ceduo_design_values, blocks), .flags = REQUIRED | NO_RUN,
         .meaning = N_("how good this survey is"), .choices = &ceduo_quality_words),
    NUMBER("gamma_e", .shown = NAMED(N_("factor of the fence")), MEMBER(ceduo_design_values, fence_factor), RANGE("", 1, 10),
           .flags = NO_RUN,
           .meaning = N_("factor by which the energy of a fence is divided for the needed class; without it none is applied")),
};
static const struct object design_object = OBJECT(ceduo_design_values, design_fields, NULL);

static const struct field minimum_fields[] = {
    NUMBER("reserves_per_ha", .shown = NAMED(N_("reserves per ha")), MEMBER(scene_draft, scene.reserves_minimum),
           RANGE("1/ha", 0, 1e5), .flags = REQUIRED | NO_RUN,
           .meaning = N_("single trees that must be kept by law or by wish of the owner; a forest with fewer is reported")),
};
static const struct object minimum_object = OBJECT(scene_draft, minimum_fields, NULL);

/* ---- the head of a report ---- */

#define HEAD(key, label, meaning) TEXT(#key, NAMED(label), MEMBER(ceduo_report_head, key), NO_RUN, meaning)

static const struct field page_fields[] = {
    HEAD(place, N_("place"), N_("where the slope is, such as the municipality")),
    HEAD(owner, N_("owner"), N_("whose forest it is")),
    HEAD(parcel, N_("parcel"), N_("its parcel in the register, or in the management plan")),
    HEAD(author, N_("author"), N_("who answers for the report and signs it")),
    HEAD(date, N_("date"), N_("when it was written, as it is to be printed")),
    HEAD(note, N_("note"), N_("anything else, such as the number of the file")),
};
static const struct object page_object = OBJECT(ceduo_report_head, page_fields, NULL);
ASKED_AT_ONCE(page_fields);

/* ---- years ---- */

static const struct field window_fields[] = {
    NUMBER("first", .shown = NAMED(N_("first year shown")), MEMBER(scene_draft, scene.year_first), RANGE("y", 0, 100000),
           .flags = NO_RUN, .meaning = N_("first year to look at; 0 is the stand as filed")),
    NUMBER("last", .shown = NAMED(N_("last year shown")), MEMBER(scene_draft, scene.year_last), RANGE("y", 0, 100000),
           .flags = NO_RUN, .meaning = N_("last year to look at")),
};
static const struct object window_object = OBJECT(scene_draft, window_fields, NULL);

static const struct field scene_fields[] = {
    TAG("scene/1"),
    TEXT("title", NAMED(N_("title")), MEMBER(scene_draft, scene.title), NO_RUN, N_("title of the scene")),
    TEXT("title_it", NAMED(N_("in Italian")), MEMBER(scene_draft, scene.title_it), NO_RUN,
         N_("the same in Italian pages, screens and lists; without it in English")),
    GROUP("page", N_("head of the report"), MEMBER(scene_draft, scene.page), NO_RUN, &page_object),
    GROUP_LABELLED("rock", NAMED(N_("rock")), MEMBER(scene_draft, scene.rock), REQUIRED, N_("rock"), &ceduo_rock_object),
    ITEMS_LABELLED("blocks", NAMED(N_("blocks that come down")), LIST(scene_draft, scene.blocks, scene.blocks_count),
                   FIELD_SCALAR_OK,
                   N_("sizes of the blocks that come down and how many a year; of one class, a mapping instead of the list"),
                   &block_object),
    GROUP("release", N_("release"), MEMBER(scene_draft, scene.release), 0, &ceduo_release_object),
    ITEMS_LABELLED("release", NAMED(N_("release")), LIST(scene_draft, scene.releases, scene.releases_count), 0,
                   N_("several releases on one profile, a list instead of the mapping"), &shared_release_object),
    GROUP_LABELLED("slope", NAMED(N_("slope")), MEMBER(scene_draft, scene.slope), REQUIRED | FIELD_FOLLOWS,
                   N_("a file, or what such a file holds"), &slope_object),
    ITEMS("controls", N_("control"), LIST(scene_draft, scene.controls, scene.controls_count), 0, &control_object),
    ROW(FIELD_NUMBERS, "controls_m", .shown = NAMED(N_("counted at, m")), LIST(scene_draft, controls_m, controls_m_count),
        RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = FIELD_FILE_ONLY, .meaning = N_("the same by their x alone")),
    ITEMS("forest", N_("belt"), LIST(scene_draft, belts, belts_count), FIELD_FILE_ONLY | FIELD_FOREST, &belt_object),
    ITEMS("options", N_("option"), LIST(scene_draft, scene.options, scene.options_count), FIELD_FOREST, &option_object),
    GROUP("simulation", N_("simulation"), MEMBER(scene_draft, scene.simulation), 0, &simulation_object),
    NUMBER("rocks_per_year", .shown = NAMED(N_("rocks per year")), MEMBER(scene_draft, scene.rocks_per_year),
           RANGE("1/y", 0, 1e6), .flags = NO_RUN, .meaning = N_("rocks that come down in a year, to print how many to expect")),
    ITEMS("uncertainty", N_("uncertainty"), LIST(scene_draft, uncertainties, uncertainties_count),
          FIELD_FILE_ONLY | FIELD_OR_NONE | NO_RUN | FIELD_CERTAIN, &uncertainty_object),
    ITEMS("observed", N_("seen"), LIST(scene_draft, observed, observed_count), FIELD_FILE_ONLY | NO_RUN | FIELD_CERTAIN,
          &ceduo_observed_object),
    GROUP("design", N_("design values"), MEMBER(scene_draft, scene.design), 0, &design_object),
    GROUP("minimum", N_("minimum"), EMBEDDED, 0, &minimum_object),
    GROUP("rules", N_("rules"), MEMBER(scene_draft, scene.rules), FIELD_FOLLOWS | NO_RUN, &rules_object),
    GROUP("years", N_("years"), EMBEDDED, FIELD_CERTAIN, &window_object),
};
static const struct object scene_object = OBJECT(scene_draft, scene_fields, "scenes");

#define ROOT(name)                                                                                                             \
    const struct object *ceduo_schema_##name(void)                                                                             \
    {                                                                                                                          \
        return &name##_object;                                                                                                 \
    }
ROOT(scene)
ROOT(slope)
ROOT(segment)
ROOT(belt)
ROOT(stand)
