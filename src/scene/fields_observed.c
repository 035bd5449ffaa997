/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of observations of real rocks. Their kinds are in ceduo/scene.h. */
#include "fields.h"

#define KIND_VALUES(KIND) MEMBER(observed, values[CEDUO_OBSERVED_##KIND])
#define POSITION(key, name, member, more_flags, about)                                                                         \
    NUMBER(key, .shown = NAMED(name), MEMBER(observed_values, member), RANGE("m", -COORDINATE_MAX, COORDINATE_MAX),            \
           .flags = (more_flags) | NO_RUN, .meaning = about)
#define VALUES(key, name, about)                                                                                               \
    ROW(FIELD_NUMBERS, key, .shown = NAMED(name), LIST(observed_values, values, values_count),                                 \
        RANGE("", -COORDINATE_MAX, COORDINATE_MAX), .flags = NO_RUN, .meaning = about)
#define COUNT(key, name, member, lo, more_flags, about)                                                                        \
    ROW(FIELD_COUNT, key, .shown = NAMED(name), MEMBER(observed_values, member), RANGE("", lo, 1e9),                           \
        .flags = (more_flags) | NO_RUN, .meaning = about)
#define RELEASED                                                                                                               \
    COUNT("of", N_("rocks released"), released_count, 1, 0, N_("rocks released; without it only those seen are compared"))
#define TABLE                                                                                                                  \
    FILE_NAME("csv", NAMED(N_("table")), MEMBER(observed_values, csv), NO_RUN,                                                 \
              N_("a table that holds the values, instead of a list")),                                                         \
        TEXT("column", NAMED(N_("column")), MEMBER(observed_values, column), NO_RUN,                                           \
             N_("its column; without it the one that is named as usual, or the only one")),                                    \
        TEXT("only", NAMED(N_("only")), MEMBER(observed_values, only), NO_RUN,                                                 \
             N_("only those of its rows that have this in another column, such as block=1"))
#define MEAN                                                                                                                   \
    NUMBER("mean", .shown = NAMED(N_("mean")), MEMBER(observed_values, mean), RANGE("", 0, 1e9), .flags = NO_RUN,              \
           .meaning = N_("instead of values: their mean")),                                                                    \
        NUMBER("sd", .shown = NAMED(N_("standard deviation")), MEMBER(observed_values, sd), RANGE("", 0, 1e9),                 \
               .flags = NO_RUN, .meaning = N_("their standard deviation")),                                                    \
        COUNT("n", N_("number"), n, 1, 0, N_("number of rocks with a value"))

static const struct field stops_fields[] = {
    VALUES("x_m", N_("stops"), N_("where rocks came to rest or were stopped; in the slope's coordinates")),
    TABLE,
    RELEASED,
    POSITION("seen_from_m", N_("looked for from, m"), seen_from, 0,
             N_("stops above it were not searched for; without it the whole slope was searched")),
};
static const struct object stops_object = OBJECT(observed_values, stops_fields, NULL);
ASKED_AT_ONCE(stops_fields);

static const struct field passed_fields[] = {
    POSITION("x_m", N_("counted at, m"), x, REQUIRED, N_("where they were observed")),
    COUNT("count", N_("passed"), count, 0, REQUIRED, N_("rocks that passed")),
    COUNT("of", N_("rocks released"), released_count, 1, REQUIRED, N_("rocks released")),
};
static const struct object passed_object = OBJECT(observed_values, passed_fields, NULL);
ASKED_AT_ONCE(passed_fields);

static const struct field crossing_fields[] = {
    POSITION("x_m", N_("seen at, m"), x, REQUIRED, N_("where they were observed")),
    VALUES("values", N_("values"), N_("one value for each rock: m/s, m above the ground, kJ")),
    TABLE,
    MEAN,
};
static const struct object crossing_object = OBJECT(observed_values, crossing_fields, NULL);
ASKED_AT_ONCE(crossing_fields);

static const struct field sample_fields[] = {
    VALUES("values", N_("values"), N_("one value for each rock: m/s, m above the ground, kJ")),
    TABLE,
    MEAN,
};
static const struct object sample_object = OBJECT(observed_values, sample_fields, NULL);

static const struct field largest_fields[] = {
    GROUP("speed_m_s", N_("largest speed"), KIND_VALUES(LARGEST_SPEED), 0, &sample_object),
    GROUP("height_m", N_("largest height"), KIND_VALUES(LARGEST_HEIGHT), 0, &sample_object),
};
static const struct object largest_object = OBJECT(observed, largest_fields, NULL);

static const struct field stretch_fields[] = {
    NUMBER("from_m", .shown = BRIEF(N_("from, m"), N_("from m")), MEMBER(observed, stretch_from),
           RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = REQUIRED | NO_RUN, .meaning = N_("where it begins")),
    NUMBER("to_m", .shown = BRIEF(N_("to, m"), N_("to m")), MEMBER(observed, stretch_to),
           RANGE("m", -COORDINATE_MAX, COORDINATE_MAX), .flags = REQUIRED | NO_RUN, .meaning = N_("where it ends")),
    GROUP("speed_m_s", N_("mean speed"), KIND_VALUES(WAY_SPEED), 0, &sample_object),
    GROUP("height_m", N_("mean height"), KIND_VALUES(WAY_HEIGHT), 0, &sample_object),
    GROUP("energy_kJ", N_("mean energy"), KIND_VALUES(WAY_ENERGY), 0, &sample_object),
};
static const struct object stretch_object = OBJECT(observed, stretch_fields, NULL);

static const struct field scars_fields[] = {
    POSITION("from_m", N_("from, m"), from, REQUIRED, N_("where it begins")),
    POSITION("to_m", N_("to, m"), to, REQUIRED, N_("where it ends")),
    VALUES("height_m", N_("height"), N_("heights of the middles of scars above the ground")),
    TABLE,
    RELEASED,
    NUMBER("share_seen", .shown = NAMED(N_("share seen")), MEMBER(observed_values, share_seen), RANGE("", 0, 1),
           .flags = ABOVE | NO_RUN,
           .meaning = N_("share of the scars that a survey finds; bark hides 16 to 49 % of them (Stoffel 2005)")),
};
static const struct object scars_object = OBJECT(observed_values, scars_fields, NULL);
ASKED_AT_ONCE(scars_fields);

static const struct field observed_fields[] = {
    TEXT("name", NAMED(N_("name")), MEMBER(observed, name), NO_RUN, N_("a name of its own; without it one is made")),
    TEXT("name_it", NAMED(N_("in Italian")), MEMBER(observed, name_it), NO_RUN,
         N_("the same in Italian pages, screens and lists; without it in English")),
    WORD("use", .shown = NAMED(N_("use")), MEMBER(observed, use), .flags = NO_RUN, .value = "fit",
         .meaning = N_("whether the ground is fitted to it, or it only checks the fit"), .choices = &ceduo_use_words),
    TEXT("option", NAMED(N_("option")), MEMBER(observed, option), NO_RUN,
         N_("the option that stood there; without it the first")),
    GROUP("rock", N_("rock"), MEMBER(observed, rock), 0, &ceduo_rock_object),
    GROUP("release", N_("release"), MEMBER(observed, release), 0, &ceduo_release_object),
    GROUP_LABELLED("stops", NAMED(N_("stops")), KIND_VALUES(STOPS), 0, N_("where rocks stopped"), &stops_object),
    GROUP_LABELLED("passed", NAMED(N_("passed")), KIND_VALUES(PASSED), 0, N_("how many passed a place"), &passed_object),
    GROUP_LABELLED("speed", NAMED(N_("speed")), KIND_VALUES(SPEED), 0, N_("speed of those that passed a place, m/s"),
                   &crossing_object),
    GROUP_LABELLED("height", NAMED(N_("height")), KIND_VALUES(HEIGHT), 0,
                   N_("height of their underside above the ground there, m"), &crossing_object),
    GROUP_LABELLED("energy", NAMED(N_("energy")), KIND_VALUES(ENERGY), 0, N_("their energy there, kJ"), &crossing_object),
    GROUP("largest", N_("largest"), EMBEDDED, 0, &largest_object),
    GROUP("on_the_way", N_("on the way"), EMBEDDED, 0, &stretch_object),
    GROUP_LABELLED("scars", NAMED(N_("scars")), KIND_VALUES(SCARS), 0, N_("scars on stems along a stretch"), &scars_object),
};
const struct object ceduo_observed_object = OBJECT(observed, observed_fields, NULL);

#define OTHER_KEYS 8 /* keys that are not chosen as a kind: name, name_it, use, option, rock, release, largest, on_the_way */
_Static_assert(sizeof observed_fields / sizeof observed_fields[0] - OTHER_KEYS <= CEDUO_ASKED_KINDS_MAX,
               "observed: more kinds than there are digits");
