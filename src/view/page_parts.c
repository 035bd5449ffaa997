/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "page_parts.h"

#include <math.h>
#include <string.h>

#include "base/language.h"

void ceduo_page_interval(struct ceduo_page *page, const struct ceduo_measure *m)
{
    ceduo_measure_interval(ceduo_page_text(page), m);
}

void ceduo_page_mean(struct ceduo_page *page, const struct ceduo_arrivals *a)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    cell->kind = a->reached > 0 ? CEDUO_CELL_MEAN : CEDUO_CELL_NUMBER;
    cell->value = a->reached > 0 ? a->energy.mean * J_TO_KJ : NAN;
    cell->half = ceduo_half_width(a->energy.se, a->reached) * J_TO_KJ;
}

void ceduo_page_limit(struct ceduo_page *page, const struct ceduo_control *c, enum ceduo_measure_name otherwise)
{
    struct ceduo_page_cell *head = ceduo_page_head(page);
    struct ceduo_measure m = ceduo_judged(c, NULL);
    bool kilo = fabs(c->accepted) < 1e6;
    ceduo_measure_name(&head->text, &m, isnan(c->accepted) ? otherwise : CEDUO_SHORT_HEAD);
    ceduo_measure_name(&head->written, &m, CEDUO_HEAD);
    if (!isnan(c->accepted))
        ceduo_text_format(&head->shorter, kilo ? "> %s kJ" : "> %s MJ", ROUNDED(c->accepted * (kilo ? 1e-3 : 1e-6), 3));
}

void ceduo_page_free_run(struct ceduo_page *page, double share)
{
    ceduo_page_write(page, "%s %%", PERCENT(share, CEDUO_FREE_RUN_MOST));
}

/* A word in green or red. */
static void write_word(struct ceduo_page *page, const char *word, bool good, bool bad)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    cell->role = good ? CEDUO_ROLE_GOOD : bad ? CEDUO_ROLE_BAD : CEDUO_ROLE_BLANK;
    ceduo_text_put(&cell->text, word);
}

void ceduo_page_verdict(struct ceduo_page *page, enum ceduo_light light)
{
    bool good = light == CEDUO_PASS, bad = light == CEDUO_FAIL;
    write_word(page, good ? _("pass") : bad ? _("FAIL") : "?", good, bad);
}

void ceduo_page_yes(struct ceduo_page *page, bool yes)
{
    write_word(page, yes ? _("yes") : _("NO"), yes, !yes);
}

void ceduo_page_warn(void *page, const char *sentence)
{
    ceduo_page_say(page, CEDUO_PAGE_WARNING, "%s", sentence);
}

void ceduo_page_once(struct ceduo_page *page, enum ceduo_page_kind kind, const char *sentence)
{
    for (const struct ceduo_page_block *b = page->first; b; b = b->next)
        if (strcmp(ceduo_text_string(&b->text), sentence) == 0)
            return;
    ceduo_page_say(page, kind, "%s", sentence);
}

void ceduo_page_warn_once(void *page, const char *sentence)
{
    ceduo_page_once(page, CEDUO_PAGE_WARNING, sentence);
}

void ceduo_page_note(void *page, const char *sentence)
{
    ceduo_page_say(page, CEDUO_PAGE_NOTE, "%s", sentence);
}
