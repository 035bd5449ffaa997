/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The keys of what was seen of real rocks. */
#include "fields.h"

#define PLACE_SEEN(key, name, member, flags, meaning)                                                                          \
    NUMBER(key, NAMED(name, NULL), AT(seen_values, member), "m", -FAR, FAR, (flags) | UNFLOWN, NULL, meaning)
#define VALUES_SEEN(key, name, meaning)                                                                                        \
    NUM(FIELD_NUMBERS, key, NAMED(name, NULL), LIST(seen_values, values, values_count), "", 1, -FAR, FAR, UNFLOWN, NULL,       \
        meaning)
#define COUNT_SEEN(key, name, member, lo, flags, meaning)                                                                      \
    NUM(FIELD_COUNT, key, NAMED(name, NULL), AT(seen_values, member), "", 1, lo, 1e9, (flags) | UNFLOWN, NULL, meaning)
#define OF_SEEN COUNT_SEEN("of", N_("rocks released"), of, 1, 0, N_("rocks released; without it only those seen are compared"))
#define CSV_SEEN                                                                                                               \
    OTHER(FIELD_FILE, "csv", NAMED(N_("table"), NULL), AT(seen_values, csv), UNFLOWN, NULL,                                    \
          N_("a table that holds the values, instead of a list"), NULL, NULL),                                                 \
        TEXT("column", NAMED(N_("column"), NULL), AT(seen_values, column), UNFLOWN,                                            \
             N_("its column; without it the one that is named as usual, or the only one")),                                    \
        TEXT("only", NAMED(N_("only"), NULL), AT(seen_values, only), UNFLOWN,                                                  \
             N_("only those of its rows that have this in another column, such as block=1"))
#define MEAN_SEEN                                                                                                              \
    NUMBER("mean", NAMED(N_("mean"), NULL), AT(seen_values, mean), "", 0, 1e9, UNFLOWN, NULL,                                  \
           N_("instead of values: their mean")),                                                                               \
        NUMBER("sd", NAMED(N_("standard deviation"), NULL), AT(seen_values, sd), "", 0, 1e9, UNFLOWN, NULL,                    \
               N_("their standard deviation")),                                                                                \
        COUNT_SEEN("n", N_("number"), n, 1, 0, N_("how many rocks they are of"))

static const struct field stops_fields[] = {
    VALUES_SEEN("x_m", N_("stops"), N_("where rocks came to rest or were stopped; in the slope's coordinates")),
    CSV_SEEN,
    OF_SEEN,
    PLACE_SEEN("seen_from_m", N_("looked for from, m"), seen_from, 0,
               N_("stops before it were not looked for; without it all were")),
};
static const struct object stops_object = OBJECT(seen_values, stops_fields, NULL);

static const struct field passed_fields[] = {
    PLACE_SEEN("x_m", N_("counted at, m"), x, REQUIRED, N_("where they were counted")),
    COUNT_SEEN("count", N_("passed"), count, 0, REQUIRED, N_("rocks that passed")),
    COUNT_SEEN("of", N_("rocks released"), of, 1, REQUIRED, N_("rocks released")),
};
static const struct object passed_object = OBJECT(seen_values, passed_fields, NULL);

static const struct field crossing_fields[] = {
    PLACE_SEEN("x_m", N_("seen at, m"), x, REQUIRED, N_("where they were seen")),
    VALUES_SEEN("values", N_("values"), N_("values of rocks that passed: m/s, m above the ground, kJ")),
    CSV_SEEN,
    MEAN_SEEN,
};
static const struct object crossing_object = OBJECT(seen_values, crossing_fields, NULL);

static const struct field sample_fields[] = {
    VALUES_SEEN("values", N_("values"), N_("values, one for each rock: m/s, m above the ground, kJ")),
    CSV_SEEN,
    MEAN_SEEN,
};
static const struct object sample_object = OBJECT(seen_values, sample_fields, NULL);

static const struct field largest_fields[] = {
    GROUP("speed_m_s", NAMED(N_("largest speed"), NULL), AT(seen, largest_speed), 0,
          N_("largest speed of each rock on its way"), &sample_object),
    GROUP("height_m", NAMED(N_("largest height"), NULL), AT(seen, largest_height), 0,
          N_("largest height of each rock above the ground"), &sample_object),
};
static const struct object largest_object = OBJECT(seen, largest_fields, NULL);

static const struct field way_fields[] = {
    NUMBER("from_m", NAMED(N_("from, m"), N_("from m")), AT(seen, way_from), "m", -FAR, FAR, REQUIRED | UNFLOWN, NULL,
           N_("where the stretch begins")),
    NUMBER("to_m", NAMED(N_("to, m"), N_("to m")), AT(seen, way_to), "m", -FAR, FAR, REQUIRED | UNFLOWN, NULL,
           N_("where it ends")),
    GROUP("speed_m_s", NAMED(N_("mean speed"), NULL), AT(seen, way_speed), 0,
          N_("mean speed of each rock along it, metre by metre"), &sample_object),
    GROUP("height_m", NAMED(N_("mean height"), NULL), AT(seen, way_height), 0, N_("mean height of each rock above the ground"),
          &sample_object),
    GROUP("energy_kJ", NAMED(N_("mean energy"), NULL), AT(seen, way_energy), 0, N_("mean energy of each rock"), &sample_object),
};
static const struct object way_object = OBJECT(seen, way_fields, NULL);

static const struct field scars_fields[] = {
    PLACE_SEEN("from_m", N_("from, m"), from, REQUIRED, N_("where the stretch begins")),
    PLACE_SEEN("to_m", N_("to, m"), to, REQUIRED, N_("where it ends")),
    VALUES_SEEN("height_m", N_("heights"), N_("heights of the middles of scars above the ground")),
    CSV_SEEN,
    OF_SEEN,
    NUMBER("share_seen", NAMED(N_("share seen"), NULL), AT(seen_values, share_seen), "", 0, 1, ABOVE | UNFLOWN, NULL,
           N_("share of the scars that a survey finds; bark hides 16 to 49 % of them (Stoffel 2005)")),
};
static const struct object scars_object = OBJECT(seen_values, scars_fields, NULL);

static const struct field seen_fields[] = {
    TEXT("name", NAMED(N_("name"), NULL), AT(seen, name), UNFLOWN, N_("a name of its own; without it one is made")),
    WORD("use", NAMED(N_("use"), NULL), AT(seen, use), UNFLOWN, "fit",
         N_("whether the ground is fitted to it, or it only checks the fit"), &ceduo_use_words),
    TEXT("option", NAMED(N_("option"), NULL), AT(seen, option), UNFLOWN,
         N_("the option that stood there; without it the first")),
    GROUP("rock", NAMED(N_("rock"), NULL), AT(seen, rock), 0, N_("the rock, where it is another than the scene's"),
          &ceduo_rock_object),
    GROUP("release", NAMED(N_("release"), NULL), AT(seen, release), 0,
          N_("how it started, where that differs from the scene's"), &ceduo_release_object),
    GROUP("stops", NAMED(N_("stops"), NULL), AT(seen, stops), 0, N_("where rocks stopped"), &stops_object),
    GROUP("passed", NAMED(N_("passed"), NULL), AT(seen, passed), 0, N_("how many passed a place"), &passed_object),
    GROUP("speed", NAMED(N_("speed"), NULL), AT(seen, speed), 0, N_("speed of those that passed a place, m/s"),
          &crossing_object),
    GROUP("height", NAMED(N_("height"), NULL), AT(seen, height), 0, N_("height of their underside above the ground there, m"),
          &crossing_object),
    GROUP("energy", NAMED(N_("energy"), NULL), AT(seen, energy), 0, N_("their energy there, kJ"), &crossing_object),
    GROUP("largest", NAMED(N_("largest"), NULL), SAME, 0, N_("the largest of each rock on its way"), &largest_object),
    GROUP("on_the_way", NAMED(N_("on the way"), NULL), SAME, 0, N_("means of each rock along a stretch"), &way_object),
    GROUP("scars", NAMED(N_("scars"), NULL), AT(seen, scars), 0, N_("scars on stems along a stretch"), &scars_object),
};
const struct object ceduo_seen_object = OBJECT(seen, seen_fields, NULL);
