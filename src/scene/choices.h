/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHOICES_H
#define CEDUO_CHOICES_H

#include <stddef.h>

/* Words of files for an enum, or for rows of a library. Word i stands for value i. */
struct choices {
    const char *const *names;
    size_t n;
    const char *const *also; /* of each value: all words that files may have, with | between them; NULL: only names */
};

extern const struct choices ceduo_shape_words, ceduo_facets_words, ceduo_system_words, ceduo_energy_words, ceduo_offset_words,
    ceduo_flag_words, ceduo_quality_words, ceduo_law_words, ceduo_rule_words, ceduo_contact_model_words, ceduo_spread_words,
    ceduo_use_words, ceduo_species_words, ceduo_material_words;

/* A library from an X-macro of rows: name, other words for it, members of struct ceduo_KIND after the name. Makes KIND_rows, their names
 * and ceduo_KIND_words; `also` makes all words of a row from its arguments. */
#define LIBRARY(kind, LIST, also)                                                                                              \
    static const struct ceduo_##kind kind##_rows[] = {LIST(LIBRARY_ROW)};                                                      \
    static const char *const kind##_names[] = {LIST(LIBRARY_NAME)};                                                            \
    static const char *const kind##_also[] = {LIST(also)};                                                                     \
    const struct choices ceduo_##kind##_words = {kind##_names, sizeof kind##_names / sizeof kind##_names[0], kind##_also}
#define LIBRARY_ROW(name, also, ...) {name, __VA_ARGS__},
#define LIBRARY_NAME(name, ...)      name,

/* Return the value of a word; -1: none. In lists with other words, case, blanks and hyphens do not matter. */
int ceduo_choice_find(const struct choices *choices, const char *word);

/* Remedy for an option, a key (alone or at the end of a path) or a word that only earlier versions had. Marked for translation; NULL:
 * no version had it. */
const char *ceduo_removed_hint(const char *name);

#endif
