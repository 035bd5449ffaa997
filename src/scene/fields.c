/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of keys: what the files say, and the members of the scene that hold it. A new key is a member with its
 * comment in a public header and one row here. */
#include <math.h>

#include "base/intl.h"
#include "schema.h"

#define HALF_PI 1.5707963267948966
#define FAR 1e9 /* m: survey coordinates and more */

/* ---- shorthand for rows ---- */

/* Where a value goes: a member; a member and what belongs to it. */
#define PAIR(type, member, other) offsetof(struct type, member), sizeof((struct type *)0)->member, offsetof(struct type, other)
#define AT(type, member) offsetof(struct type, member), sizeof((struct type *)0)->member, 0
#define LIST(type, items, count) PAIR(type, items, count)
#define PLACE(type, given, relative) PAIR(type, given, relative)
#define POINTS(type, x, z, count) \
    offsetof(struct type, x), offsetof(struct type, z) + sizeof(double *) - offsetof(struct type, x), offsetof(struct type, count)
#define SAME 0, 0, 0 /* a group whose members are of the structure around it */
#define NOWHERE 0, 0, 0
/* Of the draft, but within the slope. */
#define IN_SLOPE(member) (offsetof(struct scene_draft, member) - offsetof(struct scene_draft, scene.slope))
#define OF_SLOPE(items, count) IN_SLOPE(items), sizeof((struct scene_draft *)0)->items, IN_SLOPE(count)

#define NUM(key, kind, at, unit, scale, lo, hi, flags, value, meaning) \
    {key, kind, at, unit, scale, lo, hi, flags, value, meaning, NULL, NULL}
#define WORD(key, at, flags, value, meaning, choices) \
    {key, FIELD_CHOICE, at, "", 1, -INFINITY, INFINITY, flags, value, meaning, choices, NULL}
#define OTHER(key, kind, at, flags, value, meaning, object) \
    {key, kind, at, "", 1, -INFINITY, INFINITY, flags, value, meaning, NULL, object}
#define OBJECT(name, type, fields, folder) {name, fields, sizeof fields / sizeof fields[0], sizeof(type), folder}
#define STRING(macro) TEXT_OF(macro)
#define TEXT_OF(text) #text

/* ---- rock ---- */

static const struct field rock_fields[] = {
    WORD("shape", AT(ceduo_rock_def, shape), 0, "sphere", N_("shape of the rock"), &ceduo_shape_words),
    NUM("diameter_m", FIELD_SPREAD, AT(ceduo_rock_def, diameter), "m", 1, 0, 1000, FIELD_ABOVE, NULL,
        N_("diameter of a sphere or cylinder")),
    NUM("height_m", FIELD_SPREAD, AT(ceduo_rock_def, height), "m", 1, 0, 1000, FIELD_ABOVE, NULL,
        N_("height of a cylinder")),
    NUM("axes_m", FIELD_SPREADS, AT(ceduo_rock_def, axes), "m", 1, 0, 1000, FIELD_ABOVE, NULL,
        N_("the three axes of an ellipsoid or block")),
    NUM("volume_m3", FIELD_SPREAD, AT(ceduo_rock_def, volume), "m3", 1, 0, 1e6, FIELD_ABOVE, NULL,
        N_("volume of a sphere, instead of its diameter")),
    NUM("mass_kg", FIELD_SPREAD, AT(ceduo_rock_def, mass), "kg", 1, 0, 1e10, FIELD_ABOVE, NULL,
        N_("mass; of a sphere instead of its diameter, of others instead of density")),
    NUM("density_kg_m3", FIELD_SPREAD, AT(ceduo_rock_def, density), "kg/m3", 1, 0, 30000, FIELD_ABOVE, "2600",
        N_("density of the rock; the default is limestone's, an assumption")),
};

static const struct object rock_object = OBJECT("rock", struct ceduo_rock_def, rock_fields, NULL);

/* ---- release ---- */

static const struct field release_fields[] = {
    NUM("x_m", FIELD_SPREAD, AT(ceduo_release, x), "m", 1, -FAR, FAR, FIELD_MEANLESS | FIELD_PLACE, NULL,
        N_("where the rock starts; in the slope's coordinates; without it at the first vertex")),
    NUM("height_m", FIELD_SPREAD, AT(ceduo_release, height), "m", 1, 0, 10000, 0, "0",
        N_("height of its underside above the ground")),
    NUM("vx_m_s", FIELD_SPREAD, AT(ceduo_release, vx), "m/s", 1, -1000, 1000, 0, "0",
        N_("horizontal speed, positive downslope along x")),
    NUM("vz_m_s", FIELD_SPREAD, AT(ceduo_release, vz), "m/s", 1, -1000, 1000, 0, "0",
        N_("vertical speed, positive upward")),
    NUM("spin_rad_s", FIELD_SPREAD, AT(ceduo_release, spin), "rad/s", 1, -10000, 10000, 0, "0",
        N_("spin, positive where it rolls forward; the law lumped knows none")),
};

static const struct object release_object = OBJECT("release", struct ceduo_release, release_fields, NULL);

/* ---- slope ---- */

static const struct field segment_fields[] = {
    NUM("rn", FIELD_SPREAD, AT(ceduo_segment, rn), "", 1, 0, 1, FIELD_REQUIRED, NULL, N_("normal restitution Rn")),
    NUM("rt", FIELD_SPREAD, AT(ceduo_segment, rt), "", 1, 0, 1, FIELD_REQUIRED, NULL, N_("tangential restitution Rt")),
    NUM("roughness_rad", FIELD_NUMBER, AT(ceduo_segment, roughness_rad), "rad", 1, 0, HALF_PI, FIELD_UNDER | FIELD_ONE_OF, "0",
        N_("largest angle by which the ground's small facets are turned")),
    NUM("roughness_m", FIELD_NUMBER, AT(ceduo_segment, roughness_m), "m", 1, 0, 1000, 0, NULL,
        N_("the same as a height S over the rock's radius, atan(S/R), as in CRSP")),
    NUM("friction", FIELD_NUMBER, AT(ceduo_segment, friction), "", 1, 0, 100, 0, "0.5",
        N_("tangent of the angle of rolling friction; the default is an assumption")),
};

static const struct object segment_object = OBJECT("segment", struct ceduo_segment, segment_fields, NULL);

static const struct field material_fields[] = {
    NUM("from_m", FIELD_NUMBER, AT(material_belt, from), "m", 1, -FAR, FAR, FIELD_REQUIRED, NULL,
        N_("where the ground begins")),
    NUM("to_m", FIELD_NUMBER, AT(material_belt, to), "m", 1, -FAR, FAR, FIELD_REQUIRED, NULL,
        N_("where it ends")),
    WORD("material", AT(material_belt, material), FIELD_REQUIRED, NULL, N_("a ground of the library"), &ceduo_material_words),
};

static const struct object material_object = OBJECT("material", struct material_belt, material_fields, NULL);

static const struct field slope_fields[] = {
    OTHER("ceduo", FIELD_TAG, NOWHERE, FIELD_REQUIRED | FIELD_NOWHERE, "slope/1", N_("what kind of file this is"), NULL),
    OTHER("name", FIELD_TEXT, NOWHERE, FIELD_NOWHERE | FIELD_UNFLOWN, NULL, N_("name of the slope"), NULL),
    WORD("facets", AT(ceduo_slope, facets), 0, "against", N_("which way the ground's small facets are turned"), &ceduo_facets_words),
    NUM("vertices_m", FIELD_POINTS, POINTS(ceduo_slope, x, z, vertices), "m", 1, -FAR, FAR, 0, NULL,
        N_("the profile: pairs [x, z], x rising")),
    OTHER("segments", FIELD_LIST, LIST(ceduo_slope, segments, segments_given), FIELD_DRAFT, NULL,
          N_("the ground: one for each segment, or one for all"), &segment_object),
    OTHER("materials", FIELD_LIST, OF_SLOPE(materials, materials_count), FIELD_DRAFT, NULL,
          N_("the ground from the library, instead of segments"), &material_object),
    OTHER("csv", FIELD_FILE, NOWHERE, FIELD_NOWHERE, NULL,
          N_("the profile from a CSV file with distance and elevation, instead of vertices_m"), NULL),
};

static const struct object slope_object = OBJECT("slope", struct ceduo_slope, slope_fields, "slopes");

/* ---- stand ---- */

static const struct field stems_fields[] = {
    NUM("per_ha", FIELD_NUMBER, AT(ceduo_stems, per_ha), "1/ha", 1, 0, 1e6, FIELD_REQUIRED | FIELD_ABOVE, NULL,
        N_("stems per horizontal hectare")),
    NUM("dbh_m", FIELD_NUMBER, AT(ceduo_stems, dbh), "m", 1, 0, 10, FIELD_REQUIRED | FIELD_ABOVE, NULL,
        N_("diameter at breast height")),
    NUM("height_m", FIELD_NUMBER, AT(ceduo_stems, height), "m", 1, 0, 150, FIELD_REQUIRED | FIELD_ABOVE, NULL,
        N_("height of a stem")),
    NUM("volume_m3", FIELD_NUMBER, AT(ceduo_stems, volume), "m3", 1, 0, 1000, FIELD_ABOVE, NULL,
        N_("volume of a stem; without it from species, dbh and height")),
    NUM("dbh_sd_m", FIELD_NUMBER, AT(ceduo_stems, dbh_sd), "m", 1, 0, 10, 0, "0",
        N_("standard deviation of the diameters")),
    NUM("age_y", FIELD_NUMBER, AT(ceduo_stems, age), "y", 1, 0, 2000, FIELD_YEARS, NULL, N_("age")),
};

static const struct object stems_object = OBJECT("stems", struct ceduo_stems, stems_fields, NULL);

static const struct field stools_fields[] = {
    NUM("per_ha", FIELD_NUMBER, AT(ceduo_stand, stools_per_ha), "1/ha", 1, 0, 1e6, FIELD_REQUIRED | FIELD_ABOVE | FIELD_ZERO, NULL,
        N_("stools per horizontal hectare")),
    NUM("spacing_m", FIELD_NUMBER, AT(ceduo_stand, spacing), "m", 1, 0, 20, FIELD_REQUIRED | FIELD_ZERO, NULL,
        N_("distance between neighbouring shoots of a stool (dbh_int of the paper)")),
};
static const struct object stools_object = OBJECT("stools", struct ceduo_stand, stools_fields, NULL);

static const struct field energy_fields[] = {
    WORD("model", AT(ceduo_stand, energy), 0, "brauner", N_("what a contact with a stem takes"), &ceduo_energy_words),
    NUM("u_J_m3", FIELD_NUMBER, AT(ceduo_stand, u), "J/m3", 1, 0, 1e7, FIELD_ABOVE, NULL,
        N_("brauner: work of breaking; without it the species', beech's where that is unknown")),
    NUM("fracture_ratio", FIELD_NUMBER, AT(ceduo_stand, fracture_ratio), "", 1, 0, 10, FIELD_ABOVE, "1.5",
        N_("dorren: energy of this species over that of silver fir; the default is an assumption")),
};
static const struct object energy_object = OBJECT("energy", struct ceduo_stand, energy_fields, NULL);

static const struct field curve_fields[] = {
    NUM("dbh_most_m", FIELD_NUMBER, AT(ceduo_curve, dbh_most), "m", 1, 0, 10, FIELD_REQUIRED | FIELD_ABOVE | FIELD_ZERO | FIELD_YEARS, NULL,
        N_("diameter that the oldest come near: d(t) = D(1 - exp(-kt))")),
    NUM("dbh_rate_1_y", FIELD_NUMBER, AT(ceduo_curve, dbh_rate), "1/y", 1, 0, 10, FIELD_REQUIRED | FIELD_ABOVE | FIELD_ZERO | FIELD_YEARS, NULL,
        N_("k of the diameter")),
    NUM("height_most_m", FIELD_NUMBER, AT(ceduo_curve, height_most), "m", 1, 0, 150, FIELD_REQUIRED | FIELD_ABOVE | FIELD_ZERO | FIELD_YEARS, NULL,
        N_("height that the oldest come near: h(t) = H(1 - exp(-mt))")),
    NUM("height_rate_1_y", FIELD_NUMBER, AT(ceduo_curve, height_rate), "1/y", 1, 0, 10, FIELD_REQUIRED | FIELD_ABOVE | FIELD_ZERO | FIELD_YEARS,
        NULL, N_("m of the height")),
};
static const struct object curve_object = OBJECT("curve", struct ceduo_curve, curve_fields, NULL);

static const struct field growth_fields[] = {
    OTHER("shoots", FIELD_GROUP, AT(ceduo_growth, shoots), 0, NULL, N_("growth of shoots"), &curve_object),
    OTHER("trees", FIELD_GROUP, AT(ceduo_growth, trees), 0, NULL, N_("growth of single trees"), &curve_object),
    NUM("shoots_young", FIELD_NUMBER, AT(ceduo_growth, shoots_young), "", 1, 1, 1000, FIELD_ZERO | FIELD_YEARS, NULL,
        N_("shoots that come up on a stool after a cut")),
    NUM("shoots_old", FIELD_NUMBER, AT(ceduo_growth, shoots_old), "", 1, 1, 1000, FIELD_ZERO | FIELD_YEARS, NULL,
        N_("shoots of a stool that are left in the end: n(t) = old + (young - old)exp(-t/5)")),
    NUM("sdi_most", FIELD_NUMBER, AT(ceduo_growth, sdi_most), "", 1, 0, 1e5, FIELD_ZERO | FIELD_YEARS, NULL,
        N_("stand density index to which shoots thin themselves; without it or 0 they do not")),
};
static const struct object growth_object = OBJECT("growth", struct ceduo_growth, growth_fields, NULL);

static const struct field cutting_fields[] = {
    NUM("rotation_years", FIELD_COUNT, AT(ceduo_stand, cutting.rotation), "y", 1, 1, 500, FIELD_REQUIRED | FIELD_YEARS, NULL,
        N_("years between two cuts")),
    NUM("cohorts", FIELD_COUNT, AT(ceduo_stand, cutting.cohorts), "", 1, 1, 20, FIELD_YEARS, "1",
        N_("cohorts of shoots on a stool, of which each cut takes the oldest; 1: all shoots are cut")),
    NUM("stay_per_ha", FIELD_NUMBERS, LIST(ceduo_stand, cutting.stay_per_ha, cutting.stay_count), "1/ha", 1, 0, 1e5, FIELD_YEARS, NULL,
        N_("single trees that a cut leaves: those one rotation old, two rotations old, …")),
};
static const struct object cutting_object = OBJECT("cutting", struct ceduo_stand, cutting_fields, NULL);

static const struct field stand_fields[] = {
    OTHER("ceduo", FIELD_TAG, NOWHERE, FIELD_REQUIRED | FIELD_NOWHERE, "stand/1", N_("what kind of file this is"), NULL),
    OTHER("name", FIELD_TEXT, NOWHERE, FIELD_NOWHERE | FIELD_UNFLOWN, NULL, N_("name of the stand"), NULL),
    OTHER("base", FIELD_FILE, NOWHERE, FIELD_NOWHERE, NULL,
          N_("a stand file to start from: mappings given here are merged into it, lists replaced"), NULL),
    WORD("system", AT(ceduo_stand, system), FIELD_UNFLOWN, NULL, N_("silvicultural system; without it as the stems say"), &ceduo_system_words),
    WORD("species", AT(ceduo_stand, species), FIELD_YEARS, NULL, N_("main species: volume of its stems and work of breaking"),
         &ceduo_species_words),
    OTHER("stools", FIELD_GROUP, SAME, 0, NULL, N_("stools"), &stools_object),
    OTHER("shoots", FIELD_LIST, LIST(ceduo_stand, shoots, shoots_count), 0, NULL, N_("cohorts of shoots on the stools"), &stems_object),
    OTHER("trees", FIELD_LIST, LIST(ceduo_stand, trees, trees_count), 0, NULL, N_("classes of single trees: standards, reserves"),
          &stems_object),
    OTHER("energy", FIELD_GROUP, SAME, 0, NULL, N_("energy of a contact"), &energy_object),
    OTHER("growth", FIELD_GROUP, AT(ceduo_stand, growth), 0, NULL, N_("how it grows; without it the stand stays as it is"),
          &growth_object),
    OTHER("cutting", FIELD_GROUP, SAME, 0, NULL, N_("how it is cut; without it never"), &cutting_object),
};

static const struct object stand_object = OBJECT("stand", struct ceduo_stand, stand_fields, "stands");

/* ---- scene ---- */

static const struct field belt_fields[] = {
    NUM("from_m", FIELD_NUMBER, PLACE(ceduo_belt, from_given, from), "m", 1, -FAR, FAR, FIELD_REQUIRED | FIELD_PLACE, NULL,
        N_("where the belt begins; in the slope's coordinates")),
    NUM("to_m", FIELD_NUMBER, PLACE(ceduo_belt, to_given, to), "m", 1, -FAR, FAR, FIELD_REQUIRED | FIELD_PLACE, NULL,
        N_("where the belt ends")),
    NUM("cut_year", FIELD_NUMBER, AT(ceduo_belt, cut_year), "y", 1, -1000, 1000, FIELD_YEARS, NULL,
        N_("a year in which it is cut, from the stand as filed; without it when it is old enough")),
    OTHER("stand", FIELD_GROUP, AT(ceduo_belt, stand), FIELD_REQUIRED | FIELD_FOLLOWS, NULL,
          N_("the stand: a file, or what such a file holds"), &stand_object),
};

static const struct object belt_object = OBJECT("belt", struct ceduo_belt, belt_fields, NULL);

static const struct field option_fields[] = {
    OTHER("name", FIELD_TEXT, AT(ceduo_option, name), FIELD_REQUIRED | FIELD_UNFLOWN, NULL, N_("name of the option"), NULL),
    OTHER("forest", FIELD_LIST, LIST(ceduo_option, belts, belts_count), 0, NULL, N_("belts of forest, rising along x"), &belt_object),
};

static const struct object option_object = OBJECT("option", struct ceduo_option, option_fields, NULL);

static const struct field control_fields[] = {
    NUM("x_m", FIELD_NUMBER, PLACE(ceduo_control, x_given, x), "m", 1, -FAR, FAR, FIELD_REQUIRED | FIELD_PLACE, NULL,
        N_("where the rocks that pass are counted")),
    OTHER("name", FIELD_TEXT, AT(ceduo_control, name), FIELD_UNFLOWN, NULL, N_("what stands there"), NULL),
    NUM("accepted_kJ", FIELD_NUMBER, AT(ceduo_control, accepted), "kJ", 1000, 0, 1e9, 0, NULL,
        N_("energy that it bears")),
    NUM("measured_speed_m_s", FIELD_NUMBER, AT(ceduo_control, measured_speed), "m/s", 1, 0, 1000, FIELD_UNFLOWN, NULL,
        N_("speed of a real rock seen there, for comparison")),
};

static const struct object control_object = OBJECT("control", struct ceduo_control, control_fields, NULL);

static const struct field simulation_fields[] = {
    WORD("law", AT(ceduo_simulation, law), 0, "lumped", N_("law of an impact on the ground"), &ceduo_law_words),
    NUM("rocks", FIELD_COUNT, AT(ceduo_simulation, rocks), "", 1, 1, CEDUO_ROCKS_MOST, FIELD_UNFLOWN, "1000",
        N_("rocks simulated")),
    NUM("seed", FIELD_COUNT, AT(ceduo_simulation, seed), "", 1, 0, 9007199254740992.0, 0, "1",
        N_("seed of the random numbers")),
    WORD("contact_model", AT(ceduo_simulation, contact_model), FIELD_WOOD, "stems",
         N_("how rocks meet stems: each by itself, as a Poisson process at the rule's rate, or not (index)"),
         &ceduo_contact_model_words),
    WORD("rule", AT(ceduo_simulation, rule), FIELD_WOOD, "auto", N_("form of the ADC; auto is the paper's rule"), &ceduo_rule_words),
    NUM("threshold_m", FIELD_NUMBER, AT(ceduo_simulation, threshold), "m", 1, 0, 1e6, FIELD_ABOVE | FIELD_UNFLOWN, STRING(CEDUO_THRESHOLD_M),
        N_("ADC below which a stand protects: distance to full speed (Bozzolo 1987)")),
    NUM("gravity_m_s2", FIELD_NUMBER, AT(ceduo_simulation, gravity), "m/s2", 1, 0, 1000, FIELD_ABOVE, STRING(CEDUO_GRAVITY),
        N_("acceleration of gravity")),
    OTHER("scale_rn", FIELD_FLAG, AT(ceduo_simulation, scale_rn), 0, "false",
          N_("lumped: Rn falls with the speed of the impact, as in CRSP"), NULL),
};
static const struct object simulation_object = OBJECT("simulation", struct ceduo_simulation, simulation_fields, NULL);

static const struct field minimum_fields[] = {
    NUM("reserves_per_ha", FIELD_NUMBER, AT(scene_draft, scene.reserves_minimum), "1/ha", 1, 0, 1e5, FIELD_REQUIRED | FIELD_UNFLOWN, NULL,
        N_("single trees that the law or the owner wants to be kept; a wood with fewer is noted")),
};
static const struct object minimum_object = OBJECT("minimum", struct scene_draft, minimum_fields, NULL);

static const struct field scene_fields[] = {
    OTHER("ceduo", FIELD_TAG, NOWHERE, FIELD_REQUIRED | FIELD_NOWHERE, "scene/1", N_("what kind of file this is"), NULL),
    OTHER("title", FIELD_TEXT, AT(scene_draft, scene.title), FIELD_UNFLOWN, NULL, N_("title of the scene"), NULL),
    OTHER("rock", FIELD_GROUP, AT(scene_draft, scene.rock), FIELD_REQUIRED, NULL, N_("the rock"), &rock_object),
    OTHER("release", FIELD_GROUP, AT(scene_draft, scene.release), 0, NULL, N_("how the rock starts"), &release_object),
    OTHER("slope", FIELD_GROUP, AT(scene_draft, scene.slope), FIELD_REQUIRED | FIELD_FOLLOWS, NULL,
          N_("the slope: a file, or what such a file holds"), &slope_object),
    OTHER("controls", FIELD_LIST, LIST(scene_draft, scene.controls, scene.controls_count), 0, NULL, N_("places where the rocks that pass are counted"),
          &control_object),
    NUM("controls_m", FIELD_NUMBERS, LIST(scene_draft, controls_m, controls_m_count), "m", 1, -FAR, FAR, FIELD_DRAFT, NULL,
        N_("the same by their x alone")),
    OTHER("forest", FIELD_LIST, LIST(scene_draft, belts, belts_count), FIELD_DRAFT | FIELD_WOOD, NULL, N_("belts of forest, rising along x"), &belt_object),
    OTHER("options", FIELD_LIST, LIST(scene_draft, scene.options, scene.options_count), FIELD_WOOD, NULL,
          N_("silvicultural options to compare, instead of forest; the first is the baseline"), &option_object),
    OTHER("simulation", FIELD_GROUP, AT(scene_draft, scene.simulation), 0, NULL, N_("how it is computed"), &simulation_object),
    NUM("rocks_per_year", FIELD_NUMBER, AT(scene_draft, scene.rocks_per_year), "1/y", 1, 0, 1e6, FIELD_UNFLOWN, NULL,
        N_("rocks that come down in a year, for what is to be expected of the years")),
    OTHER("minimum", FIELD_GROUP, SAME, 0, NULL, N_("what a wood must keep"), &minimum_object),
};

static const struct object scene_object = OBJECT("scene", struct scene_draft, scene_fields, "scenes");

const struct object *ceduo_schema_scene(void)
{
    return &scene_object;
}

const struct object *ceduo_schema_slope(void)
{
    return &slope_object;
}

const struct object *ceduo_schema_segment(void)
{
    return &segment_object;
}

const struct object *ceduo_schema_belt(void)
{
    return &belt_object;
}

const struct object *ceduo_schema_stand(void)
{
    return &stand_object;
}
