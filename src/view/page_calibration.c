/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of --calibrate: what was seen beside what the fit says of it, the fitted values with what is not refuted, and in
 * words what is not determined, what lies at a bound, and whether the model can give what was seen at all. */
#include <math.h>

#include "base/language.h"
#include "page.h"
#include "report_calibration.h"
#include "words.h"

#define TOGETHER 0.7 /* correlation that is told */

static const struct ceduo_page_column seen_columns[] = {{N_("seen"), 26, 2, 0},       {N_("use"), 5, 2, 0},
                                                        {N_("rocks"), -5, 2, 0},      {N_("mean"), -8, 2, 0},
                                                        {N_("fit, 95 %"), -15, 2, 0}, {N_("p"), -5, 2, 0}};

static void put_range(struct text *t, double lo, double hi)
{
    if (isnan(lo) || isnan(hi)) {
        ceduo_text_char(t, '-');
        return;
    }
    ceduo_words_number(t, lo, 3);
    ceduo_text_put(t, "\xe2\x80\x93");
    ceduo_words_number(t, hi, 3);
}

static void put_p(struct text *t, double p)
{
    if (isnan(p))
        ceduo_text_char(t, '-');
    else if (p < 0.001)
        ceduo_text_put(t, "<.001");
    else
        ceduo_text_format(t, "%.*f", p < 0.1 ? 3 : 2, p);
}

/* Two scenes may call alike what was seen there. */
static void put_seen_name(struct text *name, const struct ceduo_calibration_report *r, const struct ceduo_predicted *p)
{
    ceduo_text_safe(name, ceduo_seen_of(r, p)->name);
    if (r->scenes_count > 1)
        ceduo_text_then(name, ", ", _("scene %zu"), p->scene + 1);
}

static void put_seen(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    ceduo_page_table(page, seen_columns, 6);
    for (size_t i = 0; i < r->answer->predicted_count; i++) {
        const struct ceduo_predicted *p = &r->answer->predicted[i];
        const struct ceduo_observation *o = ceduo_seen_of(r, p);
        double origin = r->files[p->scene].scene.slope.origin_x;
        put_seen_name(ceduo_page_text(page), r, p);
        ceduo_text_put(ceduo_page_text(page), o->use == CEDUO_OBSERVED_FIT ? "fit" : "check");
        ceduo_text_format(ceduo_page_text(page), "%zu", ceduo_seen_number(o));
        ceduo_words_number(ceduo_page_text(page), ceduo_seen_shown(o->kind, p->seen, origin), 3);
        put_range(ceduo_page_text(page), ceduo_seen_shown(o->kind, p->lo, origin), ceduo_seen_shown(o->kind, p->hi, origin));
        put_p(ceduo_page_text(page), p->p_value);
    }
}

static const struct ceduo_page_column value_columns[] = {
    {N_("fitted"), 26, 2, 0}, {N_("between"), -13, 2, 0}, {N_("best"), -8, 2, 0}, {N_("not refuted, 95 %"), -18, 2, 0}};

static void put_values(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    ceduo_page_table(page, value_columns, 4);
    for (size_t i = 0; i < r->answer->parameters_count; i++) {
        const struct ceduo_fitted *f = &r->answer->parameters[i];
        double per = r->fields[i]->shown.per > 0 ? r->fields[i]->shown.per : 1;
        ceduo_calibration_name(ceduo_page_text(page), r->paths[i], r->fields[i]);
        put_range(ceduo_page_text(page), f->lo * per, f->hi * per);
        ceduo_calibration_number(ceduo_page_text(page), r->fields[i], f->best);
        put_range(ceduo_page_text(page), f->p2_5 * per, f->p97_5 * per);
    }
}

/* A sentence with a name where it has %s; frees the name. */
static void put_with_name(struct ceduo_page *page, struct text *to, const char *format, struct text *name)
{
    for (; *format; format++)
        if (format[0] == '%' && format[1] == 's')
            ceduo_text_put(to, ceduo_text_string(name)), format++;
        else
            ceduo_text_char(to, *format);
    page->failed |= name->failed;
    ceduo_text_free(name);
}

/* What is said of a value by its name. */
static void put_named(struct ceduo_page *page, enum ceduo_page_kind kind, const struct ceduo_calibration_report *r, size_t i,
                      const char *format)
{
    struct text name = {0};
    ceduo_calibration_name(&name, r->paths[i], r->fields[i]);
    struct text *t = ceduo_page_add(page, kind);
    put_with_name(page, t, format, &name);
}

static void put_limits(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    for (size_t i = 0; i < r->answer->parameters_count; i++) {
        const struct ceduo_fitted *f = &r->answer->parameters[i];
        if (!f->determined)
            put_named(page, CEDUO_PAGE_WARNING, r, i,
                      _("%s is not determined by what was seen: nearly everything within its bounds fits as well."));
        if (f->at_bound)
            put_named(page, CEDUO_PAGE_WARNING, r, i,
                      _("%s lies at a bound: what fits best may be beyond it. Widen its bounds, or ask what the model lacks."));
    }
}

static void put_correlations(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    for (size_t i = 0; i < r->answer->parameters_count; i++)
        for (size_t k = 0; k < i; k++) {
            struct text a = {0}, b = {0};
            double c = r->answer->correlation[i][k];
            if (!(fabs(c) >= TOGETHER))
                continue;
            ceduo_calibration_name(&a, r->paths[k], r->fields[k]);
            ceduo_calibration_name(&b, r->paths[i], r->fields[i]);
            ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_ITEM),
                              c > 0 ? _("%s and %s rise together (correlation %.2f): only both are known, not each.")
                                    : _("%s falls where %s rises (correlation %.2f): only both are known, not each."),
                              ceduo_text_string(&a), ceduo_text_string(&b), c);
            page->failed |= a.failed || b.failed;
            ceduo_text_free(&a);
            ceduo_text_free(&b);
        }
}

static void put_one_misfit(struct ceduo_page *page, const struct ceduo_calibration_report *r, const struct ceduo_predicted *p,
                           const char *format)
{
    struct text name = {0}, *t = ceduo_page_add(page, CEDUO_PAGE_WARNING);
    put_seen_name(&name, r, p);
    put_with_name(page, t, format, &name);
}

/* How many of the values that were kept back lie where single rocks are predicted. */
static void put_single(struct ceduo_page *page, const struct ceduo_calibration_report *r, const struct ceduo_predicted *p)
{
    const struct ceduo_observation *o = ceduo_seen_of(r, p);
    double origin = r->files[p->scene].scene.slope.origin_x;
    struct text name = {0}, range = {0};
    if (!o->values || isnan(p->one_lo))
        return;
    put_seen_name(&name, r, p);
    put_range(&range, ceduo_seen_shown(o->kind, p->one_lo, origin), ceduo_seen_shown(o->kind, p->one_hi, origin));
    ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_ITEM),
                      _("%s: of %zu values %zu lie within the 95 %% predicted of single rocks, %s."), ceduo_text_string(&name),
                      o->n, p->one_inside, ceduo_text_string(&range));
    page->failed |= name.failed || range.failed;
    ceduo_text_free(&name);
    ceduo_text_free(&range);
}

static void put_misfits(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    const struct ceduo_calibration *a = r->answer;
    for (size_t i = 0; i < a->predicted_count; i++) {
        const struct ceduo_predicted *p = &a->predicted[i];
        const struct ceduo_observation *o = ceduo_seen_of(r, p);
        if (p->p_value < CEDUO_MISFIT && o->use == CEDUO_OBSERVED_FIT && p->inside)
            put_one_misfit(page, r, p,
                           _("This model can give the mean of what was seen here, but not how the values are spread: %s."));
        else if (p->p_value < CEDUO_MISFIT && o->use == CEDUO_OBSERVED_FIT)
            put_one_misfit(page, r, p, _("This model cannot give what was seen here: %s."));
        else if (p->p_value < CEDUO_MISFIT)
            put_one_misfit(page, r, p, _("The fit does not hold for what was to check it: %s."));
        if (o->use == CEDUO_OBSERVED_CHECK)
            put_single(page, r, p);
        if (o->kind == CEDUO_OBSERVED_SCARS && o->of > 0 && isnan(o->share_seen))
            put_one_misfit(page, r, p,
                           _("A survey finds too few scars, and %s does not say what share it found (share_seen): the "
                             "number of blows is taken too low."));
    }
    if (!a->misfit)
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE), _("The model can give all that it was fitted to."));
}

static void put_end(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    const struct ceduo_calibration *a = r->answer;
    if (!a->settled)
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_WARNING),
                       _("The chains do not agree yet, so the ranges are rough: fit fewer values, or observe more."));
    ceduo_text_put(
        ceduo_page_add(page, CEDUO_PAGE_NOTE),
        _("A ground that is fitted on a profile holds for this profile; a hundred metres beside it may be another."));
    ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                      _("%llu scenes were computed with %llu rocks each; R-hat %.3f, effective size %.0f."),
                      (unsigned long long)a->evaluations, (unsigned long long)r->rocks, a->rhat, a->effective_size);
}

static void put_words(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    put_misfits(page, r);
    put_limits(page, r);
    put_correlations(page, r);
    put_end(page, r);
}

void ceduo_calibration_words(struct text *text, const struct ceduo_calibration_report *r, size_t width)
{
    struct ceduo_page page = {.width = width};
    put_words(&page, r);
    text->failed |= page.failed;
    ceduo_page_print(text, &page, false);
    ceduo_page_free(&page);
}

void ceduo_calibration_page(struct text *text, const struct ceduo_calibration_report *r, bool plain)
{
    struct ceduo_page page = {.width = 80};
    for (size_t s = 0; s < r->scenes_count; s++) {
        struct text *title = ceduo_page_add(&page, CEDUO_PAGE_TITLE);
        if (r->scenes_count > 1)
            ceduo_text_format(title, "%zu ", s + 1);
        ceduo_text_safe(title, ceduo_words_shipped(r->files[s].scene.title));
    }
    ceduo_text_put(ceduo_page_add(&page, CEDUO_PAGE_SECTION), _("Fitted to what was seen"));
    put_values(&page, r);
    ceduo_page_add(&page, CEDUO_PAGE_GAP);
    put_seen(&page, r);
    ceduo_page_add(&page, CEDUO_PAGE_GAP);
    put_words(&page, r);
    text->failed |= page.failed;
    ceduo_page_print(text, &page, plain);
    ceduo_page_free(&page);
}
