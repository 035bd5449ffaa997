/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "choices.h"

#include <string.h>

#include "ceduo/observe.h"
#include "ceduo/scene.h"

/* One list of words for each X-macro; those of species and materials stand beside their rows. */
#define WORDS(name, LIST)                                                                                                      \
    static const char *const name##_names[] = {LIST(X_WORD)};                                                                  \
    const struct choices ceduo_##name##_words = {name##_names, sizeof name##_names / sizeof name##_names[0]}
#define X_WORD(NAME, word) word,

WORDS(shape, CEDUO_SHAPES);
WORDS(facets, CEDUO_FACETS);
WORDS(system, CEDUO_SYSTEMS);
WORDS(rule, CEDUO_RULES);
WORDS(contact_model, CEDUO_CONTACT_MODELS);
WORDS(spread, CEDUO_SPREAD_KINDS);
WORDS(quality, CEDUO_QUALITIES);
WORDS(use, CEDUO_OBSERVED_USES);
WORDS(offset, CEDUO_ENERGY_OFFSETS);

/* A flag that need not be said. */
#define FLAGS(X) X(FALSE, "false") X(TRUE, "true")
WORDS(flag, FLAGS);

/* Laws are also parts of the names of functions. */
#undef X_WORD
#define X_WORD(NAME, name) #name,
WORDS(energy, CEDUO_ENERGY_MODELS);
WORDS(law, CEDUO_LAWS);

int ceduo_choice_find(const struct choices *choices, const char *word)
{
    for (size_t i = 0; i < choices->n; i++)
        if (strcmp(choices->names[i], word) == 0)
            return (int)i;
    return -1;
}
