/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of --sensitivity: how far each option may be off, what that depends on, whether the order of the options
 * holds, and what to measure first. */
#include <math.h>

#include "base/language.h"
#include "page.h"
#include "report_doubt.h"
#include "words.h"

#define FIRST 3 /* inputs that are named as what to measure first */

static const struct ceduo_doubt_figure *main_of(const struct ceduo_doubt_report *r, size_t option)
{
    return ceduo_doubt_figure_of(r->answer, option, r->answer->main, false);
}

/* Of 1000 rocks, or kJ per released rock. */
static double scale_of(const struct ceduo_doubt_report *r)
{
    return r->answer->main == CEDUO_DOUBT_ENERGY ? KILO : 1000;
}

static void put_section(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    const struct ceduo_control *c = &r->file->scene.controls[ceduo_scene_last_control(&r->file->scene)];
    struct text *t = ceduo_page_add(page, CEDUO_PAGE_SECTION);
    struct text name = {0};
    ceduo_text_safe(&name, c->name ? c->name : "");
    if (r->answer->main == CEDUO_DOUBT_EXCEED)
        ceduo_text_format(t, _("How sure is it? %s at %g m, of 1000 rocks those with more than %g kJ"),
                          ceduo_text_string(&name), c->x_given, ceduo_words_accepted(c));
    else
        ceduo_text_format(t, _("How sure is it? %s at %g m, kJ per released rock"), ceduo_text_string(&name), c->x_given);
    t->failed |= name.failed;
    ceduo_text_free(&name);
}

static const struct ceduo_page_column option_columns[] = {
    {N_("option"), 32, 2, 0}, {N_("now"), -7, 0, 0}, {N_("rocks"), -13, 2, 0}, {N_("doubt (90 %)"), -15, 2, 0}};

/* Of 1000 rocks a whole number, of energies three digits. */
static void put_value(struct text *t, double value, double scale)
{
    if (scale < 1)
        ceduo_words_number(t, value * scale, 3);
    else
        ceduo_text_format(t, "%.0f", value * scale);
}

static void put_range(struct text *t, double lo, double hi, double scale)
{
    put_value(t, lo, scale);
    ceduo_text_put(t, "\xe2\x80\x93");
    put_value(t, hi, scale);
}

static void put_options(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    const struct ceduo_scene *s = &r->file->scene;
    double scale = scale_of(r);
    ceduo_page_table(page, option_columns, 4);
    for (size_t i = 0; i < s->options_count; i++) {
        const struct ceduo_doubt_figure *f = main_of(r, i);
        struct ceduo_doubt_now now = ceduo_doubt_now_of(r, i);
        ceduo_text_safe(ceduo_page_text(page), s->options[i].name);
        put_value(ceduo_page_text(page), now.value, scale);
        put_range(ceduo_page_text(page), now.lo, now.hi, scale);
        put_range(ceduo_page_text(page), f->p5, f->p95, scale);
    }
}

static const struct ceduo_page_column input_columns[] = {{N_("it depends on"), 34, 2, 0},
                                                         {N_("from"), -9, 1, 0},
                                                         {N_("to"), -9, 1, 0},
                                                         {N_("share"), -6, 1, 0},
                                                         {N_("left if known"), -13, 2, 0}};

/* An input matters where its share is more than its error. */
static bool matters(const struct ceduo_doubt_figure *f, size_t g)
{
    return f->indices.total[g].value > 2 * f->indices.total[g].se && f->indices.total[g].value >= 0.01;
}

static void put_inputs(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    const struct ceduo_doubt_figure *f = main_of(r, 0);
    double scale = scale_of(r);
    size_t rest = 0, order[CEDUO_SENSITIVITY_GROUPS];
    ceduo_doubt_order_of(r->answer, f, order);
    ceduo_page_table(page, input_columns, 5);
    for (size_t i = 0; i < r->answer->groups; i++) {
        size_t g = order[i];
        if (!matters(f, g)) {
            rest++;
            continue;
        }
        ceduo_doubt_input_name(ceduo_page_text(page), r, g);
        for (int end = 0; end < 2; end++)
            ceduo_doubt_input_shown(ceduo_page_text(page), r, g, end);
        ceduo_text_format(ceduo_page_text(page), "%.0f %%", fmin(1, fmax(0, f->indices.total[g].value)) * 100);
        struct text *left = ceduo_page_text(page);
        if (isnan(f->left[g]))
            ceduo_text_char(left, '-');
        else
            put_value(left, f->left[g], scale);
    }
    if (rest == r->answer->groups)
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                       _("No input stands out; more base points (--sensitivity=N) may tell."));
    else if (rest > 0)
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                          ngettext("%zu other input has hardly any effect.", "%zu other inputs have hardly any effect.", rest),
                          rest);
}

#define SURE   0.95
#define LIKELY 0.8

/* Of two that differ in few cases the order is not sure, but neither is it open. */
static const char *verdict_of(const struct ceduo_doubt_order *o)
{
    return o->probability >= SURE              ? _("clear")
           : o->probability >= LIKELY          ? _("likely")
           : o->equal >= SURE                  ? _("no difference")
           : o->probability + o->equal >= SURE ? _("hardly ever worse")
                                               : _("undecided");
}

void ceduo_doubt_order_words(struct text *text, const struct ceduo_doubt_report *r, size_t i)
{
    const struct ceduo_scene *s = &r->file->scene;
    const struct ceduo_doubt_order *o = &r->answer->orders[i];
    struct text better = {0}, than = {0};
    ceduo_text_safe(&better, s->options[o->better].name);
    ceduo_text_safe(&than, s->options[o->than].name);
    ceduo_text_format(text, _("%s is better than %s in %.0f %% of what may be true"), ceduo_text_string(&better),
                      ceduo_text_string(&than), o->probability * 100);
    if (o->probability < 0.995)
        ceduo_text_format(text, _(", equal in %.0f %%, worse in %.0f %%"), o->equal * 100, o->worse * 100);
    ceduo_text_format(text, ": %s.", verdict_of(o));
    text->failed |= better.failed || than.failed;
    ceduo_text_free(&better);
    ceduo_text_free(&than);
}

static void put_orders(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    for (size_t i = 0; i < r->answer->orders_count; i++)
        ceduo_doubt_order_words(ceduo_page_add(page, CEDUO_PAGE_ITEM), r, i);
}

/* "dbh, ADS 1 and per hectare, ADS 1" */
static void put_causes(struct text *text, const struct ceduo_doubt_report *r, const size_t *groups, size_t n)
{
    struct text names[2] = {{0}, {0}};
    for (size_t i = 0; i < n; i++)
        ceduo_doubt_input_name(&names[i], r, groups[i]);
    if (n == 2)
        ceduo_text_format(text, _("%s and %s"), ceduo_text_string(&names[0]), ceduo_text_string(&names[1]));
    else
        ceduo_text_put(text, ceduo_text_string(&names[0]));
    for (size_t i = 0; i < 2; i++) {
        text->failed |= names[i].failed;
        ceduo_text_free(&names[i]);
    }
}

bool ceduo_doubt_causes(struct text *text, const struct ceduo_doubt_report *r, size_t option, enum ceduo_doubt_kind light)
{
    size_t groups[2], n = ceduo_doubt_depends(&r->file->scene, r->answer, option, light, groups);
    if (n > 0)
        put_causes(text, r, groups, n);
    return n > 0;
}

void ceduo_doubt_light_words(struct text *text, const struct ceduo_doubt_report *r, size_t option, enum ceduo_doubt_kind light)
{
    struct text causes = {0};
    if (!ceduo_doubt_causes(&causes, r, option, light))
        return;
    ceduo_text_format(text,
                      light == CEDUO_DOUBT_CONTACT    ? _("Whether the test of contact passes depends on %s.")
                      : light == CEDUO_DOUBT_FREE_RUN ? _("Whether the test of free run passes depends on %s.")
                                                      : _("Whether the test of energy passes depends on %s."),
                      ceduo_text_string(&causes));
    text->failed |= causes.failed;
    ceduo_text_free(&causes);
}

/* Lights that change within what may be true. */
static void put_lights(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    static const enum ceduo_doubt_kind lights[] = {CEDUO_DOUBT_CONTACT, CEDUO_DOUBT_FREE_RUN, CEDUO_DOUBT_EXCEED};
    const struct ceduo_scene *s = &r->file->scene;
    for (size_t i = 0; i < s->options_count; i++)
        for (size_t k = 0; k < 3; k++) {
            struct text words = {0};
            ceduo_doubt_light_words(&words, r, i, lights[k]);
            struct text *t = words.length > 0 ? ceduo_page_add(page, CEDUO_PAGE_ITEM) : NULL;
            if (t && s->options_count > 1) {
                ceduo_text_safe(t, s->options[i].name);
                ceduo_text_put(t, ": ");
            }
            if (t)
                ceduo_text_put(t, ceduo_text_string(&words));
            page->failed |= words.failed;
            ceduo_text_free(&words);
        }
}

/* Which inputs have one index together. */
static void put_together(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    const struct ceduo_doubt_answer *a = r->answer;
    struct text paths = {0};
    for (size_t i = 0; i < a->together; i++) {
        ceduo_text_put(&paths, i > 0 ? ", " : "");
        ceduo_text_safe(&paths, r->inputs->items[a->moved[i]].path);
    }
    if (a->together > 0)
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                          ngettext("This %zu input moves alone: %s", "These %zu inputs move together: %s", a->together),
                          a->together, ceduo_text_string(&paths));
    page->failed |= paths.failed;
    ceduo_text_free(&paths);
}

struct ceduo_doubt_now ceduo_doubt_now_of(const struct ceduo_doubt_report *r, size_t option)
{
    const struct ceduo_doubt_figure *f = main_of(r, option);
    const struct ceduo_result *finer = r->finer;
    const struct ceduo_arrivals *a = finer ? ceduo_result_wooded(finer, option, finer->last_control) : NULL;
    if (!a || a->released <= r->rocks)
        return (struct ceduo_doubt_now){f->value, f->sampling_lo, f->sampling_hi, r->rocks};
    if (r->answer->main == CEDUO_DOUBT_EXCEED)
        return (struct ceduo_doubt_now){a->exceed_probability, floor(a->exceed_lo * 1000) / 1000,
                                        ceil(a->exceed_hi * 1000) / 1000, /* outwards, as in the other views */
                                        a->released};
    double mean = a->energy_per_released, half = ceduo_half_width(a->energy_per_released_se, a->released);
    return (struct ceduo_doubt_now){mean, mean - half, mean + half, a->released};
}

void ceduo_doubt_range(struct text *text, const struct ceduo_doubt_report *r, size_t option)
{
    const struct ceduo_doubt_figure *f = main_of(r, option);
    double scale = scale_of(r);
    put_value(text, ceduo_doubt_now_of(r, option).value, scale);
    ceduo_text_put(text, " (");
    put_range(text, f->p5, f->p95, scale);
    ceduo_text_char(text, ')');
}

/* What a reader takes along: both errors. */
void ceduo_doubt_both(struct text *text, const struct ceduo_doubt_report *r, size_t option)
{
    const struct ceduo_doubt_figure *f = main_of(r, option);
    double scale = scale_of(r);
    struct text value = {0}, rocks = {0}, doubt = {0};
    struct ceduo_doubt_now now = ceduo_doubt_now_of(r, option);
    put_value(&value, now.value, scale);
    put_range(&rocks, now.lo, now.hi, scale);
    put_range(&doubt, f->p5, f->p95, scale);
    ceduo_text_format(text,
                      r->answer->main == CEDUO_DOUBT_EXCEED ? _("%s of 1000 (rocks %s; doubt %s)")
                                                            : _("%s kJ per released rock (rocks %s; doubt %s)"),
                      ceduo_text_string(&value), ceduo_text_string(&rocks), ceduo_text_string(&doubt));
    text->failed |= value.failed || rocks.failed || doubt.failed;
    ceduo_text_free(&value);
    ceduo_text_free(&rocks);
    ceduo_text_free(&doubt);
}

/* The bottom line; of several options the table has it. */
static void put_answer(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    const struct ceduo_scene *s = &r->file->scene;
    if (s->options_count == 1)
        ceduo_doubt_both(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, 0);
}

/* What to measure `nth`, from 0, and what would be left of the doubt. */
bool ceduo_doubt_advice(struct text *text, const struct ceduo_doubt_report *r, size_t option, size_t nth)
{
    const struct ceduo_doubt_figure *f = main_of(r, option);
    double scale = scale_of(r);
    size_t order[CEDUO_SENSITIVITY_GROUPS], told = 0;
    ceduo_doubt_order_of(r->answer, f, order);
    for (size_t i = 0; i < r->answer->groups; i++) {
        size_t g = order[i];
        const char *how = ceduo_doubt_measured(r, g);
        if (!matters(f, g) || !how || told++ < nth)
            continue;
        struct text name = {0};
        ceduo_doubt_input_name(&name, r, g);
        ceduo_text_format(text,
                          nth == 0 ? _("Measure first: %s (%s); of a doubt %.3g wide it would leave %.3g.")
                                   : _("then: %s (%s); of a doubt %.3g wide it would leave %.3g."),
                          ceduo_text_string(&name), _(how), (f->p95 - f->p5) * scale, f->left[g] * scale);
        text->failed |= name.failed;
        ceduo_text_free(&name);
        return true;
    }
    return false;
}

/* Three lines in words. */
static void put_advice(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    for (size_t i = 0; i < FIRST; i++) {
        struct text words = {0};
        if (ceduo_doubt_advice(&words, r, 0, i))
            ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_ITEM), ceduo_text_string(&words));
        page->failed |= words.failed;
        ceduo_text_free(&words);
    }
}

void ceduo_doubt_blocks(struct ceduo_page *page, const struct ceduo_doubt_report *r, enum ceduo_doubt_extent extent)
{
    put_section(page, r);
    put_options(page, r);
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    if (r->file->scene.options_count > 1)
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_SENTENCE), _("What the first option depends on:"));
    put_inputs(page, r);
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    put_advice(page, r);
    put_lights(page, r);
    if (extent >= CEDUO_DOUBT_ORDER)
        put_orders(page, r);
    if (extent == CEDUO_DOUBT_ALL)
        put_together(page, r);
    put_answer(page, r);
    ceduo_text_format(
        ceduo_page_add(page, CEDUO_PAGE_NOTE),
        _("'rocks' is the error of %llu rocks; more rocks reduce it. 'doubt' is what is not known; only measuring "
          "reduces it. %llu scenes were computed."),
        (unsigned long long)ceduo_doubt_now_of(r, 0).rocks, (unsigned long long)r->answer->evaluations);
}

void ceduo_doubt_page(struct text *text, const struct ceduo_doubt_report *r, bool plain)
{
    struct ceduo_page page = {.width = 80};
    ceduo_text_safe(ceduo_page_add(&page, CEDUO_PAGE_TITLE), ceduo_words_shipped(r->file->scene.title));
    if (r->answer)
        ceduo_doubt_blocks(&page, r, CEDUO_DOUBT_ALL);
    else
        ceduo_text_put(ceduo_page_add(&page, CEDUO_PAGE_NOTE), ceduo_doubt_none(r));
    ceduo_page_print(text, &page, plain);
    ceduo_page_free(&page);
}
