/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ADC of each belt beside the threshold, on a logarithmic scale: by all four rules, or by the one that is applied. */
#include <math.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "plot_parts.h"
#include "scene/choices.h"

#define RULES (CEDUO_CROFTON - CEDUO_GSTEIGER_STOOLS + 1)
#define LEAST 1e-300 /* m; the numbers below it stand too far apart for the next mark to be another */

struct scale {
    double threshold, lo, hi; /* m */
};

static double share_of(const struct scale *s, double metres)
{
    return isfinite(metres) ? fmax(0, log(metres / s->lo) / log(s->hi / s->lo)) : 0;
}

static void add_row(struct ceduo_page *page, const struct scale *s, double metres, enum ceduo_role role)
{
    ceduo_page_bar(page, share_of(s, metres), role)->limit = share_of(s, s->threshold);
    ceduo_page_write(page, isfinite(metres) ? _("%s m") : "%s", BESIDE(metres, 3, s->threshold));
}

/* Its name, and a row for each rule. */
static void add_belt(struct ceduo_page *page, const struct scale *s, const struct ceduo_belt *belt,
                     const struct ceduo_stand_result *r)
{
    static const struct ceduo_page_column columns[] = {
        {"", 18, 0, 0}, {"", 6, 1, CEDUO_FILLS}, {"", -8, 1, CEDUO_FITS}, {"", 1, 1, 0}, {"", 8, 1, CEDUO_DROPPED(1)}};
    struct text *name = ceduo_page_add(page, CEDUO_PAGE_NOTE);
    page->last->role = CEDUO_ROLE_BELT;
    ceduo_plot_belt_name(name, belt);
    ceduo_text_then(name, ", ", "%s\xe2\x80\x93%s m", SHORTEST(belt->from_given), SHORTEST(belt->to_given));
    if (r->bare)
        ceduo_text_then(name, ": ", _("no stems, nothing to meet: NO"));
    else
        CEDUO_PAGE_TABLE_OF(page, columns);
    for (int f = 0; f < RULES && !r->bare; f++) {
        enum ceduo_rule rule = (enum ceduo_rule)(CEDUO_GSTEIGER_STOOLS + f);
        double value = ceduo_adc_value(&r->adc, rule);
        bool applied = rule == r->rule;
        enum ceduo_light light = r->passes_threshold ? CEDUO_PASS : CEDUO_FAIL;
        LOCAL_TEXT(word);
        ceduo_text_format(&word, "%s%s", applied ? "\xe2\x96\xb6 " : "  ", ceduo_words_law(ceduo_rule_words.names[rule]));
        ceduo_page_mark(page, applied ? CEDUO_ROLE_TITLE : CEDUO_ROLE_TEXT, word.bytes);
        add_row(page, s, value, !applied ? CEDUO_ROLE_DIM : value < s->threshold ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD);
        ceduo_page_mark(page, ceduo_plot_light_role(light), applied ? ceduo_plot_light_mark(light) : "");
        ceduo_page_write(page, "%s", applied ? _("applied") : "");
    }
}

/* A row for each belt, with the rule that is applied alone. */
static void add_belts(struct ceduo_page *page, const struct scale *s, const struct ceduo_scene *scene,
                      const struct ceduo_option *option, size_t n)
{
    static const struct ceduo_page_column columns[] = {{"", 10, 0, CEDUO_FILLS},
                                                       {"", 1, 2, CEDUO_FITS | CEDUO_DROPPED(2)},
                                                       {"", 6, 1, CEDUO_FILLS | CEDUO_DROPPED(1)},
                                                       {"", -6, 1, CEDUO_FITS},
                                                       {"", 1, 1, 0}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_text_put(&page->last->cells[0].text, _("distance between contacts, ADC"));
    ceduo_text_put(&page->last->cells[0].shorter, _("ADC"));
    ceduo_text_format(&page->last->cells[3].text, _("< %s m"), SHORTEST(s->threshold));
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        struct ceduo_stand_result r = ceduo_assess_stand(scene, belt);
        LOCAL_TEXT(name);
        ceduo_plot_belt_name(&name, belt);
        ceduo_page_mark(page, CEDUO_ROLE_BELT, name.bytes);
        ceduo_page_write(page, "%s\xe2\x80\x93%s m", SHORTEST(belt->from_given), SHORTEST(belt->to_given));
        add_row(page, s, r.adc_m, r.passes_threshold ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD);
        ceduo_page_light(page, r.passes_threshold ? CEDUO_PASS : CEDUO_FAIL);
    }
}

const char *ceduo_plot_adc(struct ceduo_drawing *d)
{
    const struct ceduo_option *option = d->option;
    if (!option || option->belts_count == 0)
        return _("no forest: nothing to meet");
    double threshold = d->scene->simulation.threshold, least = threshold, most = threshold;
    int rows = 1; /* of all belts in full */
    for (size_t i = 0; i < option->belts_count; i++) {
        struct ceduo_stand_result r = ceduo_assess_stand(d->scene, &option->belts[i]);
        rows += r.bare ? 1 : 1 + RULES;
        for (int f = 0; f < RULES; f++) {
            double v = ceduo_adc_value(&r.adc, (enum ceduo_rule)(CEDUO_GSTEIGER_STOOLS + f));
            if (!isfinite(v) || !(v > 0))
                continue;
            least = fmin(least, v);
            most = fmax(most, v);
        }
    }
    struct scale s = {threshold, ceduo_plot_round(fmax(least / 1.5, LEAST), false), ceduo_plot_round(1.5 * most, true)};
    size_t n = option->belts_count, room = d->height > 2 ? (size_t)d->height - 1 : 1;
    if (rows > d->height) {
        add_belts(d->page, &s, d->scene, option, n <= room ? n : room - 1);
        if (n > room)
            ceduo_page_say(d->page, CEDUO_PAGE_NOTE, _("and %zu more belts"), n - room + 1);
        return NULL;
    }
    for (size_t i = 0; i < n; i++) {
        struct ceduo_stand_result r = ceduo_assess_stand(d->scene, &option->belts[i]);
        add_belt(d->page, &s, &option->belts[i], &r);
    }
    ceduo_page_line(d->page, CEDUO_ROLE_DIM,
                    _("\xe2\x94\x82 %g m: in this distance without a contact a rock reaches its full speed."), s.threshold);
    return NULL;
}
