/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "page_parts.h"

#include <math.h>

#include "base/language.h"

void ceduo_page_share(struct ceduo_page *page, const struct ceduo_arrivals *a)
{
    struct text *text = ceduo_page_text(page);
    if (!a)
        ceduo_text_put(text, "-");
    else if (!isnan(a->exceed_probability))
        ceduo_words_of_1000(text, a->exceed_probability, a->exceed_lo, a->exceed_hi);
    else
        ceduo_words_of_1000(text, a->reach_probability, a->reach_lo, a->reach_hi);
}

void ceduo_page_per_1000(struct ceduo_page *page, double mean, double half, bool sign)
{
    struct text *text = ceduo_page_text(page);
    if (isnan(mean))
        ceduo_text_put(text, "-");
    else if (isnan(half)) /* of one rock */
        ceduo_text_format(text, sign ? "%+.0f \xc2\xb1-" : "%.0f \xc2\xb1-", mean * 1000);
    else
        ceduo_text_format(text, sign ? "%+.0f \xc2\xb1%.0f" : "%.0f \xc2\xb1%.0f", mean * 1000, ceil(half * 1000));
}

void ceduo_page_limit(struct ceduo_page *page, const struct ceduo_control *c, const char *otherwise)
{
    char room[CEDUO_NUMBER_ROOM];
    struct ceduo_page_cell *head = ceduo_page_head(page);
    if (isnan(c->accepted)) {
        ceduo_text_put(&head->text, otherwise);
        return;
    }
    bool kilo = fabs(c->accepted) < 1e6;
    ceduo_text_format(&head->text, "> %s kJ", ceduo_number_shortest(ceduo_words_accepted(c), room));
    ceduo_text_format(&head->shorter, kilo ? "> %.3g kJ" : "> %.3g MJ", c->accepted * (kilo ? 1e-3 : 1e-6));
}

void ceduo_page_percent(struct ceduo_page *page, double share)
{
    ceduo_text_format(ceduo_page_text(page), "%.1f %%", share * 100);
}

void ceduo_page_verdict(struct ceduo_page *page, enum ceduo_light light)
{
    ceduo_text_put(ceduo_page_text(page), light == CEDUO_PASS ? _("pass") : light == CEDUO_FAIL ? _("FAIL") : "?");
}

void ceduo_page_warn(void *page, const char *sentence)
{
    ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_WARNING), sentence);
}
