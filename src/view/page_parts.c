/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "page_parts.h"

#include <math.h>
#include <string.h>

#include "base/language.h"

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
    const struct ceduo_measure m = ceduo_judged(c, NULL);
    bool kilo = fabs(c->accepted) < 1e6;
    ceduo_text_put(&head->text, NAMED(m, isnan(c->accepted) ? otherwise : CEDUO_SHORT_HEAD));
    ceduo_text_put(&head->written, NAMED(m, CEDUO_HEAD));
    if (!isnan(c->accepted))
        ceduo_text_format(&head->shorter, kilo ? "> %s kJ" : "> %s MJ", ROUNDED(c->accepted * (kilo ? 1e-3 : 1e-6), 3));
}

void ceduo_page_free_run(struct ceduo_page *page, double share)
{
    ceduo_page_write(page, "%s %%", PERCENT(share, CEDUO_FREE_RUN_MOST));
}

void ceduo_page_verdict(struct ceduo_page *page, enum ceduo_light light)
{
    const char *const words[] = {[CEDUO_UNKNOWN] = "?", [CEDUO_PASS] = _("pass"), [CEDUO_FAIL] = _("FAIL")};
    const enum ceduo_role roles[] = {[CEDUO_PASS] = CEDUO_ROLE_GOOD, [CEDUO_FAIL] = CEDUO_ROLE_BAD};
    ceduo_page_mark(page, roles[light], words[light]);
}

void ceduo_page_yes(struct ceduo_page *page, bool yes)
{
    ceduo_page_mark(page, yes ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD, yes ? _("yes") : _("NO"));
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
