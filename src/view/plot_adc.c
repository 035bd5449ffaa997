/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ADC of each belt beside the threshold, on a logarithmic scale; with room below it that of all four rules. */
#include <math.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "plot_parts.h"
#include "scene/choices.h"

#define RULES (CEDUO_CROFTON - CEDUO_GSTEIGER_STOOLS + 1)
#define LEAST 1e-300 /* m; the numbers below it stand too far apart for the next mark to be another */

static void add_value(struct ceduo_page *page, double threshold, double metres, enum ceduo_role role)
{
    ceduo_page_bar(page, isfinite(metres) ? metres : 0, role)->limit = threshold;
    ceduo_page_write(page, isfinite(metres) ? _("%s m") : "%s", BESIDE(metres, 3, threshold));
}

/* A row for each rule, with a mark before the one that is applied. */
static void add_rules(struct ceduo_page *page, double threshold, const struct ceduo_stand_result *r)
{
    for (enum ceduo_rule rule = CEDUO_GSTEIGER_STOOLS; rule <= CEDUO_CROFTON; rule++) {
        ceduo_page_write(page, "%s %s", rule == r->rule ? "\xe2\x96\xb6" : " ", ceduo_words_law(ceduo_rule_words.names[rule]));
        ceduo_page_write(page, "%s", "");
        add_value(page, threshold, ceduo_adc_value(&r->adc, rule), CEDUO_ROLE_DIM);
        ceduo_page_write(page, "%s", "");
    }
}

const char *ceduo_plot_adc(struct ceduo_drawing *d)
{
    static const struct ceduo_page_column columns[] = {{"", 10, 0, CEDUO_FILLS},
                                                       {"", 1, 2, CEDUO_FITS | CEDUO_DROPPED(2)},
                                                       {"", 6, 1, CEDUO_FILLS | CEDUO_DROPPED(1)},
                                                       {"", -6, 1, CEDUO_FITS},
                                                       {"", 1, 1, 0}};
    const struct ceduo_option *option = d->option;
    size_t n = option ? option->belts_count : 0, room = d->height > 2 ? (size_t)d->height - 1 : 1, rows = n + 1;
    double threshold = d->scene->simulation.threshold, least = threshold, most = threshold;
    if (n == 0)
        return _("no forest: nothing to meet");
    for (size_t i = 0; i < n; i++)
        rows += ceduo_stand_is_bare(&option->belts[i].stand) ? 0 : RULES;
    CEDUO_PAGE_TABLE_OF(d->page, columns);
    ceduo_text_put(&d->page->last->cells[0].text, _("distance between contacts, ADC"));
    ceduo_text_put(&d->page->last->cells[0].shorter, _("ADC"));
    ceduo_text_format(&d->page->last->cells[3].text, _("< %s m"), SHORTEST(threshold));
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        struct ceduo_stand_result r = ceduo_assess_stand(d->scene, belt);
        enum ceduo_light light = r.passes_threshold ? CEDUO_PASS : CEDUO_FAIL;
        LOCAL_TEXT(name);
        for (enum ceduo_rule rule = CEDUO_GSTEIGER_STOOLS; rule <= CEDUO_CROFTON; rule++) {
            double v = ceduo_adc_value(&r.adc, rule);
            if (!isfinite(v) || !(v > 0))
                continue;
            least = fmin(least, v);
            most = fmax(most, v);
        }
        if (n > room && i >= room - 1)
            continue;
        ceduo_plot_belt_name(&name, belt);
        ceduo_page_mark(d->page, CEDUO_ROLE_BELT, name.bytes);
        ceduo_page_write(d->page, "%s\xe2\x80\x93%s m", SHORTEST(belt->from_given), SHORTEST(belt->to_given));
        add_value(d->page, threshold, r.adc_m, ceduo_plot_light_role(light));
        ceduo_page_light(d->page, light);
        if (rows <= room && !r.bare)
            add_rules(d->page, threshold, &r);
    }
    ceduo_page_scale(d->page, 2, ceduo_plot_round(fmax(least / 1.5, LEAST), false), ceduo_plot_round(1.5 * most, true));
    if (rows <= room)
        ceduo_page_line(d->page, CEDUO_ROLE_DIM,
                        _("\xe2\x94\x82 %g m: in this distance without a contact a rock reaches its full speed."), threshold);
    if (n > room)
        ceduo_page_say(d->page, CEDUO_PAGE_NOTE, _("and %zu more belts"), n - room + 1);
    return NULL;
}
