/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "choices.h"
#include "ceduo/scene.h"

#include <string.h>

#include "base/language.h"
#include "base/utf8.h"

#define FOLDED_MAX 64 /* maximum compared bytes of a word */

/* One list of words for each X-macro. Species and materials have theirs in species.c and material.c. */
#define WORDS(name, LIST, synonyms)                                                                                            \
    static const char *const name##_names[] = {LIST(X_WORD)};                                                                  \
    const struct choices ceduo_##name##_words = {name##_names, sizeof name##_names / sizeof name##_names[0], synonyms}
#define X_WORD(NAME, word) word,

static const char *const system_synonyms[] = {"simple-coppice|ceduo semplice",
                                              "coppice-with-standards|ceduo matricinato|ceduo con matricine",
                                              "selection-coppice|ceduo a sterzo|ceduo disetaneo",
                                              "large-reserves|grandi riserve|ceduo con grandi riserve",
                                              "high-forest|fustaia|alto fusto",
                                              "bare|senza|senza bosco"};

WORDS(shape, CEDUO_SHAPES, NULL);
WORDS(facets, CEDUO_FACETS, NULL);
WORDS(system, CEDUO_SYSTEMS, system_synonyms);
WORDS(rule, CEDUO_RULES, NULL);
WORDS(contact_model, CEDUO_CONTACT_MODELS, NULL);
WORDS(spread, CEDUO_SPREAD_KINDS, NULL);
WORDS(quality, CEDUO_QUALITIES, NULL);
WORDS(use, CEDUO_OBSERVED_USES, NULL);
WORDS(offset, CEDUO_ENERGY_OFFSETS, NULL);

#define FLAGS(X) X(FALSE, "false") X(TRUE, "true")
WORDS(flag, FLAGS, NULL);

/* Names of laws are identifiers, because they are parts of function names. */
#undef X_WORD
#define X_WORD(NAME, name) #name,
WORDS(energy, CEDUO_ENERGY_MODELS, NULL);
WORDS(law, CEDUO_LAWS, NULL);

int ceduo_choice_find(const struct choices *choices, const char *word)
{
    for (size_t i = 0; i < choices->n; i++)
        if (strcmp(choices->names[i], word) == 0)
            return (int)i;
    char wanted[FOLDED_MAX], folded[FOLDED_MAX];
    ceduo_utf8_fold(word, strlen(word), wanted, sizeof wanted);
    for (size_t i = 0; choices->synonyms && i < choices->n; i++)
        for (const char *one = choices->synonyms[i]; *one; one += *one == '|') {
            size_t n = strcspn(one, "|");
            if (strcmp(ceduo_utf8_fold(one, n, folded, sizeof folded), wanted) == 0)
                return (int)i;
            one += n;
        }
    return -1;
}

const char *ceduo_removed_hint(const char *name)
{
    static const struct {
        const char *old, *remedy;
    } removed[] = {
        {"--plain", N_("shares and means are always as counted; leave it out")},
        {"--shard", N_("a scene is computed at once; give each machine scenes of its own, see man ceduo-workflows")},
        {"--merge", N_("results of several scenes are printed together; see man ceduo-workflows")},
        {"doubt", N_("it is called uncertainty now")},
        {"adc", N_("the page of --details has the ADC of each belt")},
        {"glancing", N_("this key is gone: a hit takes what its law says, however slightly it touches; leave it out")},
        {"green_density_kg_m3", N_("this key is gone with the energy law inertia that it belonged to; leave it out")},
        {"poisson", N_("poisson is gone; leave contact_model out: every stem is hit by itself")},
        {"inertia", N_("inertia is gone: the experiment at Vaujany refutes it; write brauner or dorren, or leave it out")},
    };
    const char *dot = strrchr(name, '.'), *last = dot ? dot + 1 : name;
    size_t n = strcspn(last, "=");
    for (size_t i = 0; i < sizeof removed / sizeof removed[0]; i++)
        if (strlen(removed[i].old) == n && strncmp(removed[i].old, last, n) == 0)
            return removed[i].remedy;
    return NULL;
}
