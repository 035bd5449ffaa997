/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHOICES_H
#define CEDUO_CHOICES_H

#include <stddef.h>

/* Words of files for an enum, or for rows of a library. Word i stands for value i. */
struct choices {
    const char *const *names;
    size_t n;
    const char *const *synonyms; /* per value: all accepted words, separated by |; NULL: only names */
};

extern const struct choices ceduo_shape_words, ceduo_facets_words, ceduo_system_words, ceduo_energy_words, ceduo_offset_words,
    ceduo_flag_words, ceduo_quality_words, ceduo_law_words, ceduo_rule_words, ceduo_contact_model_words, ceduo_spread_words,
    ceduo_use_words, ceduo_species_words, ceduo_material_words;

/* Define a library from an X-macro of rows: name, synonyms, members of struct ceduo_KIND after the name. Defines KIND_rows,
 * their names and ceduo_KIND_words. The macro `synonyms` makes all words of a row from its arguments. */
#define LIBRARY(kind, LIST, synonyms)                                                                                          \
    static const struct ceduo_##kind kind##_rows[] = {LIST(LIBRARY_ROW)};                                                      \
    static const char *const kind##_names[] = {LIST(LIBRARY_NAME)};                                                            \
    static const char *const kind##_synonyms[] = {LIST(synonyms)};                                                             \
    const struct choices ceduo_##kind##_words = {kind##_names, sizeof kind##_names / sizeof kind##_names[0], kind##_synonyms}
#define LIBRARY_ROW(name, synonyms, ...) {name, __VA_ARGS__},
#define LIBRARY_NAME(name, ...)          name,

/* Return the value of a word; -1 if unknown. In lists with synonyms, case, blanks and hyphens are ignored. */
int ceduo_choice_find(const struct choices *choices, const char *word);

/* Return the remedy for an option, a key (alone or at the end of a path) or a word that only earlier versions had. Marked for
 * translation; NULL if no version had it. */
const char *ceduo_removed_hint(const char *name);

#endif
