/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the index says of an option's belts, and of what is left behind them; and blocks of other sizes. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "scene/choices.h"

/* ---- belts ---- */

static void add_belts_table(struct ceduo_page *page, const struct ceduo_scene *scene, const struct ceduo_option *o,
                            const struct ceduo_option_result *found)
{
    static const struct ceduo_page_column columns[] = {
        {N_("m"), 10, 4, CEDUO_WHOLE},       {N_("stand"), 27, 0, 0}, {N_("ADC m"), -7, 0, 0},   {NULL, 6, 1, 0},
        {NP_("head", "free run"), -9, 0, 0}, {N_("kJ"), -7, 0, 0},    {N_("kJ/100 m"), -9, 0, 0}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_text_format(&ceduo_page_head(page)->text, "<%s m", SHORTEST(scene->simulation.threshold));
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_belt *b = &o->belts[i];
        const struct ceduo_stand_result *s = &found->stands[i];
        ceduo_page_write(page, "%s\xe2\x80\x93%s", SHORTEST(b->from_given), SHORTEST(b->to_given));
        ceduo_page_write(page, "%s%s", b->name, b->assumed ? "*" : "");
        ceduo_page_number(page, s->adc_m, 3);
        ceduo_page_yes(page, s->passes_threshold);
        ceduo_page_percent(page, s->free_run_probability);
        ceduo_page_number(page, s->dissipated * J_TO_KJ, 3);
        ceduo_page_number(page, s->per_100m * J_TO_KJ, 3);
    }
}

/* The same in a sentence. */
static void say_belt(struct ceduo_page *page, const struct ceduo_belt *b, const struct ceduo_stand_result *s)
{
    const char *mark = b->assumed ? "*" : "";
    if (s->bare)
        ceduo_page_say(page, CEDUO_PAGE_SENTENCE, "%s%s: %s", b->name, mark, _("no stems"));
    else
        ceduo_page_say(page, CEDUO_PAGE_SENTENCE, _("%s%s: ADC %s m, free run %.1f %%, %s kJ per 100 m (%s)"), b->name, mark,
                       WRITTEN(s->adc_m, 3), s->free_run_probability * 100, WRITTEN(s->per_100m * J_TO_KJ, 3),
                       ceduo_rule_words.names[s->rule]);
}

static void say_other_forms(struct ceduo_page *page, const struct ceduo_belt *b, const struct ceduo_stand_result *s)
{
    static const enum ceduo_rule rules[] = {CEDUO_GSTEIGER_STOOLS, CEDUO_GSTEIGER_STEMS, CEDUO_INTERCEPTION, CEDUO_CROFTON};
    struct text *line = ceduo_page_add(page, CEDUO_PAGE_DETAIL);
    ceduo_text_format(line, _("%s by %s; other forms:"), b->name, ceduo_rule_words.names[s->rule]);
    for (size_t k = 0, n = 0; k < sizeof rules / sizeof rules[0]; k++)
        if (rules[k] != s->rule)
            ceduo_text_format(line, "%s %s %s m", n++ ? "," : "", ceduo_rule_words.names[rules[k]],
                              WRITTEN(ceduo_adc_value(&s->adc, rules[k]), 3));
}

void ceduo_page_belts(struct ceduo_page *page, const struct ceduo_report *report, size_t option)
{
    const struct ceduo_scene *scene = report->result->scene;
    const struct ceduo_option *o = &scene->options[option];
    const struct ceduo_option_result *found = &report->result->options[option];
    bool table = page->width >= CEDUO_PAGE_WIDTH;
    if (table && o->belts_count > 0)
        add_belts_table(page, scene, o, found);
    for (size_t i = 0; i < o->belts_count && !table; i++)
        say_belt(page, &o->belts[i], &found->stands[i]);
    for (size_t i = 0; i < o->belts_count; i++)
        if (!found->stands[i].bare)
            say_other_forms(page, &o->belts[i], &found->stands[i]);
}

/* ---- what is left ---- */

/* The rule that was applied in all belts, or a word that says that it differs. */
static const char *rule_of(const struct ceduo_option *o, const struct ceduo_option_result *found)
{
    const char *rule = NULL;
    for (size_t i = 0; i < o->belts_count; i++) {
        const char *here = ceduo_rule_words.names[found->stands[i].rule];
        if (!found->stands[i].bare && rule && strcmp(rule, here) != 0)
            return _("each belt's own rule");
        rule = found->stands[i].bare ? rule : here;
    }
    return rule ? rule : _("no rule");
}

/* Where contacts take shares, so that Eq. 4 has no meaning. */
static void say_share_left(struct text *line, const char *rule, const struct ceduo_index *index, const struct ceduo_arrivals *a)
{
    if (a->reached == 0)
        ceduo_text_format(line,
                          _("By the index (%s) every contact takes a share; no rock arrives, nothing is left to "
                            "compare."),
                          rule);
    else if (index->exhausted)
        ceduo_text_format(line,
                          _("By the index (%s) contacts take shares and amounts, more than the mean rock brings: "
                            "used up on average. Some rocks still pass."),
                          rule);
    else
        ceduo_text_format(line,
                          _("By the index (%s) every contact takes a share, so that Eq. 4 has no meaning; of %s kJ "
                            "%s kJ are left."),
                          rule, WRITTEN(a->energy.mean * J_TO_KJ, 4), WRITTEN(index->residual * J_TO_KJ, 3));
}

static void say_amount_left(struct text *line, const char *rule, const struct ceduo_index *index,
                            const struct ceduo_arrivals *a)
{
    double mean = a->energy.mean * J_TO_KJ, taken = index->dissipated * J_TO_KJ, left = index->residual * J_TO_KJ;
    ceduo_text_format(line, _("By the index (Eq. 4, %s) stems could take %s kJ"), rule, WRITTEN(taken, 3));
    if (index->length > 0)
        ceduo_text_then(line, ", ", _("%s kJ per 100 m (%s)"), WRITTEN(index->per_100m * J_TO_KJ, 3), rule);
    if (a->reached == 0) {
        ceduo_text_then(line, "; ", _("no rock arrives, nothing is left to compare."));
    } else if (index->exhausted) {
        ceduo_text_then(line, ", ", _("more than the mean rock brings: used up on average. Some rocks still pass."));
    } else if (taken == 0) {
        ceduo_text_then(line, "; ", _("left (Eq. 5): all of %s kJ."), WRITTEN(left, 3));
    } else { /* all three with the decimals of the first, so that what is written is true */
        int decimals = (int)fmax(0, 3 - floor(log10(mean)));
        ceduo_text_then(line, "; ", _("left (Eq. 5): %.*f \xe2\x88\x92 %.*f = %.*f kJ."), decimals, mean, decimals, taken,
                        decimals, left);
    }
}

void ceduo_page_residual(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control)
{
    const char *rule = rule_of(&r->scene->options[option], &r->options[option]);
    const struct ceduo_index *index = &r->options[option].controls[control];
    const struct ceduo_arrivals *a = &r->bare.arrivals[control];
    struct text *line = ceduo_page_add(page, CEDUO_PAGE_SENTENCE);
    if (isnan(index->dissipated))
        say_share_left(line, rule, index, a);
    else
        say_amount_left(line, rule, index, a);
    if (!isnan(index->measured))
        ceduo_page_say(page, CEDUO_PAGE_SENTENCE, _("Measured here on one rock: %s kJ (%g m/s). One rock is no validation."),
                       WRITTEN(index->measured * J_TO_KJ, 3), r->scene->controls[control].measured_speed);
}

/* ---- blocks of other sizes ---- */

#define SIZES_WIDTH 68

void ceduo_page_sizes(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_block *blocks)
{
    static const struct ceduo_page_column columns[] = {{"", 3, 0, 0},           {"m3", -8, 0, 0},
                                                       {"kg", -9, 0, 0},        {N_("wide m"), -8, 0, 0},
                                                       {N_("ADC m"), -8, 0, 0}, {N_("contacts"), -10, 0, 0},
                                                       {NULL, -18, 0, 0}};
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    double own = NAN;
    if (page->width < SIZES_WIDTH)
        return;
    for (size_t i = 0; i < CEDUO_BLOCKS; i++)
        own = blocks[i].own ? blocks[i].volume : own;
    ceduo_page_say(page, CEDUO_PAGE_CAPTION,
                   _("Blocks of other sizes, same shape and release, of 1000 to %s m (> this scene's):"), SHORTEST(c->x_given));
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_page_limit(page, c, CEDUO_HEAD);
    bool left_out = false;
    for (size_t i = 0; i < CEDUO_BLOCKS; i++) {
        const struct ceduo_block *b = &blocks[i];
        if (!b->own && b->volume < 2 * own && 2 * b->volume > own)
            continue; /* less than an octave apart the order would be chance: the scene's own stands for it */
        const struct ceduo_measure share = ceduo_judged(c, b->arrivals.released > 0 ? &b->arrivals : NULL);
        ceduo_page_write(page, "%s", b->own ? "  >" : "");
        ceduo_page_number(page, b->volume, 3);
        ceduo_page_number(page, b->mass, 3);
        ceduo_page_number(page, b->diameter, 3);
        ceduo_page_number(page, b->adc, 3);
        ceduo_page_number(page, b->contacts, 3);
        ceduo_page_interval(page, &share);
        left_out |= b->arrivals.released == 0;
    }
    if (left_out && r->scene->simulation.contact_model != CEDUO_INDEX && ceduo_result_rocks(r) > 0)
        ceduo_page_say(page, CEDUO_PAGE_SENTENCE,
                       _("A size with a dash was left out: its rocks come to so many stems that they would cost far more than "
                         "those of the scene."));
}
