/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The column that stands still in every view: what passes, whether it protects, how sure that is. */
#include "screen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "scene/words.h"

#define HEIGHT_FOR_ALL  24 /* lines with room for everything and some warnings */
#define HEIGHT_FOR_MOST 17 /* with room for the lights behind all but the heights */

struct pen {
    struct app *app;
    struct ceduo_area area;
    int y;
};

__attribute__((format(printf, 3, 4))) static void line(struct pen *pen, enum ceduo_role role, const char *format, ...)
{
    struct text text = {0}, safe = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    ceduo_text_safe(&safe, ceduo_text_string(&text));
    if (pen->y < pen->area.top + pen->area.height && safe.bytes)
        ceduo_canvas_put(&pen->app->cells->canvas, pen->area.left, pen->y, pen->area.width, role, safe.bytes);
    pen->y++;
    ceduo_text_free(&text);
    ceduo_text_free(&safe);
}

/* No single size stands for blocks. */
static void put_blocks(struct pen *pen, const struct ceduo_scene *s)
{
    double least = INFINITY, most = 0, per_year = 0;
    for (size_t i = 0; i < s->blocks_count; i++) {
        least = fmin(least, s->blocks[i].volumes[0]);
        most = fmax(most, s->blocks[i].volumes[1]);
        per_year += s->blocks[i].per_year;
    }
    line(pen, CEDUO_ROLE_TEXT, _("Blocks  %.3g-%.3g m\xc2\xb3  %.3g/year"), least, most, per_year);
}

static void put_scene(struct pen *pen)
{
    const struct ceduo_scene *s = &pen->app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(pen->app);
    struct ceduo_rock rock = ceduo_rock_mean(&s->rock);
    if (s->blocks_count > 0)
        put_blocks(pen, s);
    else if (!isnan(rock.mass))
        line(pen, CEDUO_ROLE_TEXT, _("Rock  %.3g m  %.4g kg%s"), rock.mean_diameter, rock.mass,
             ceduo_notes_assume(pen->app->document.file.notes, "rock") ? "*" : "");
    if (s->options_count < 2 && o->belts_count == 0)
        line(pen, CEDUO_ROLE_TEXT, "%s", _("Wood  none"));
    else
        line(pen, CEDUO_ROLE_TEXT, _("Wood  %s%s"), s->options_count > 1 ? o->name : o->belts[0].name,
             o->belts_count > 1 && s->options_count < 2 ? " \xc2\xb7 \xe2\x80\xa6" : "");
}

/* Of 1000: "832 (831-834)" where there is room, otherwise "832±2"; without an interval where lo = hi. */
static void share(char *to, size_t size, double p, double lo, double hi, bool wide)
{
    if (isnan(p))
        snprintf(to, size, "-");
    else if (wide)
        snprintf(to, size, "%.0f (%.0f-%.0f)", p * 1000, floor(lo * 1000), ceil(hi * 1000));
    else if (hi > lo)
        snprintf(to, size, "%.0f\xc2\xb1%.0f", p * 1000, ceil(fmax(hi - p, p - lo) * 1000));
    else
        snprintf(to, size, "%.0f", p * 1000);
}

/* The share that the options are compared by: with the same error as in the other views. */
static void compared_share(char *to, size_t size, const struct ceduo_arrivals *a, bool wide)
{
    double half = wide ? 0 : ceduo_share_at(a).half;
    if (wide)
        share(to, size, a->exceed_probability, a->exceed_lo, a->exceed_hi, true);
    else
        share(to, size, a->exceed_probability, a->exceed_probability - half, a->exceed_probability + half, false);
}

static void figure(char *to, size_t size, double value)
{
    snprintf(to, size, isnan(value) ? "-" : "%.3g", value);
}

/* A line of the figures, those of the forest first: the column without forest stands beside it. */
static void put_pair(struct pen *pen, enum ceduo_role role, const char *name, const char *wood, const char *bare)
{
    int column = pen->area.width >= 34 ? 15 : 7;
    int wider = strstr(wood, "\xc2\xb1") ? 1 : 0; /* a byte more than columns */
    line(pen, role, "%-*s%*s%*s", ceduo_utf8_field(name, 11), name, column + wider, wood, 8, bare);
}

/* A part of the pair above: its name is set in by a blank. */
static void put_pair_in(struct pen *pen, const char *name, const char *wood, const char *bare)
{
    char set_in[64];
    snprintf(set_in, sizeof set_in, " %s", name);
    put_pair(pen, CEDUO_ROLE_TEXT, set_in, wood, bare);
}

static void put_figures(struct pen *pen, const char *name, double wood, double bare)
{
    char a[32], b[32];
    figure(a, sizeof a, wood);
    figure(b, sizeof b, bare);
    put_pair(pen, CEDUO_ROLE_TEXT, name, a, b);
}

/* Rocks that end before the control. */
static void put_missed(struct pen *pen, const char *name, enum ceduo_end end, const struct ceduo_arrivals *wood,
                       const struct ceduo_arrivals *bare, bool always)
{
    char a[32] = "-", b[32];
    if (!always && wood->ended[end] == 0 && bare->ended[end] == 0)
        return;
    if (wood->released > 0)
        share(a, sizeof a, wood->missed[end], 0, 0, false);
    share(b, sizeof b, bare->missed[end], 0, 0, false);
    put_pair_in(pen, name, a, b);
}

/* The share in the line above, under the other energy law; `other` may be NULL. */
static void put_other(struct pen *pen, const struct ceduo_other_energy *other)
{
    char a[32], name[32];
    if (!other || !other->known || !other->stems)
        return;
    share(a, sizeof a, ceduo_share_by_other_law(other), 0, 0, false);
    snprintf(name, sizeof name, "  %s", ceduo_energy_words.names[other->model]);
    put_pair(pen, CEDUO_ROLE_DIM, name, a, "");
}

/* Years from one dangerous rock to the next: what matters where blocks of all sizes come down. */
static void put_every(struct pen *pen, const struct ceduo_arrivals *wood, const struct ceduo_arrivals *bare)
{
    struct text a = {0}, b = {0};
    ceduo_words_every(&a, ceduo_hazard_feared(&wood->hazard));
    ceduo_words_every(&b, ceduo_hazard_feared(&bare->hazard));
    put_pair_in(pen, _("years apart"), ceduo_text_string(&a), ceduo_text_string(&b));
    ceduo_text_free(&a);
    ceduo_text_free(&b);
}

/* Where all released end: on the way, or here. */
static void put_released(struct pen *pen, const struct ceduo_arrivals *wood, const struct ceduo_arrivals *bare,
                         const struct ceduo_other_energy *other)
{
    char a[32], b[32];
    share(a, sizeof a, wood->reach_probability, wood->reach_lo, wood->reach_hi, pen->area.width >= 34);
    share(b, sizeof b, bare->reach_probability, 0, 0, false);
    put_pair_in(pen, _("arrive"), a, b);
    put_other(pen, other);
    put_missed(pen, _("stems stop"), CEDUO_STOPPED_BY_STEMS, wood, bare, true);
    put_missed(pen, _("at rest"), CEDUO_AT_REST, wood, bare, true);
    put_missed(pen, _("left"), CEDUO_LEFT_SLOPE, wood, bare, false);
    put_missed(pen, _("unfinished"), CEDUO_UNFINISHED, wood, bare, false);
}

/* How sure the figures shown are: not those of a year to come; false where nothing is known. */
static bool doubt_of(const struct app *app, struct ceduo_doubt_report *report)
{
    return app->view != VIEW_ROTATION && ceduo_app_doubt(app, report) && report->answer;
}

/* The range of what may be true of the figure in the line above, once it is known: in the unit of that line. */
static bool put_doubt(struct pen *pen, bool energy)
{
    struct app *app = pen->app;
    struct ceduo_doubt_report report;
    char range[64], name[64];
    if (!doubt_of(app, &report) || (report.answer->main == CEDUO_DOUBT_ENERGY) != energy)
        return false;
    const struct ceduo_doubt_figure *f = ceduo_doubt_figure_of(report.answer, app->option, report.answer->main, false);
    if (energy)
        snprintf(range, sizeof range, "%.3g-%.3g", f->p5 * J_TO_KJ, f->p95 * J_TO_KJ);
    else
        snprintf(range, sizeof range, "%.0f-%.0f", f->p5 * 1000, f->p95 * 1000);
    snprintf(name, sizeof name, "  %s", P_("view", "doubt"));
    put_pair(pen, CEDUO_ROLE_DIM, name, range, ceduo_app_doubt_is_rough(app) ? _("rough") : "");
    return true;
}

/* What arrives through the forest beside what arrives without it; `wood` NULL: not known yet, or never (index). `other`
 * may be NULL. */
static void put_arrivals(struct pen *pen, const struct ceduo_control *c, const struct ceduo_arrivals *wood,
                         const struct ceduo_arrivals *bare, const struct ceduo_other_energy *other)
{
    const struct ceduo_distribution none = ceduo_distribution_none();
    bool nothing_said = ceduo_says_nothing(bare);
    const struct ceduo_arrivals nothing = {.reach_probability = NAN,
                                           .exceed_probability = NAN,
                                           .energy_per_released = NAN,
                                           .energy = none,
                                           .hazard = ceduo_hazard_none(),
                                           .height = none};
    wood = wood ? wood : &nothing;
    char a[32], b[32], limit[32];
    bool told = false, blocks = !isnan(bare->hazard.per_year);
    line(pen, CEDUO_ROLE_TITLE, _("At %g m%s%s"), c->x_given, c->name ? ", " : "", c->name ? c->name : "");
    put_pair(pen, CEDUO_ROLE_DIM, _("of 1000"), _("forest"), _("without"));
    if (nothing_said) { /* why stands below, and takes the room */
        put_released(pen, wood, bare, NULL);
        return;
    }
    if (!isnan(c->accepted)) {
        compared_share(a, sizeof a, wood, pen->area.width >= 34);
        share(b, sizeof b, bare->exceed_probability, 0, 0, false);
        snprintf(limit, sizeof limit, ">%.4g kJ", c->accepted * J_TO_KJ);
        put_pair_in(pen, limit, a, b);
        put_other(pen, other);
        told = put_doubt(pen, false);
    }
    if (blocks)
        put_every(pen, wood, bare);
    put_released(pen, wood, bare, isnan(c->accepted) ? other : NULL);
    put_figures(pen, _("kJ a rock"), wood->energy_per_released * J_TO_KJ, bare->energy_per_released * J_TO_KJ);
    told |= put_doubt(pen, true);
    if (!blocks) /* of them the large arrive: a mean of those would read as if the wood did harm */
        put_figures(pen, _("arriving kJ"), wood->energy.mean * J_TO_KJ, bare->energy.mean * J_TO_KJ);
    if (!blocks && pen->area.height >= (told ? HEIGHT_FOR_ALL : HEIGHT_FOR_MOST))
        put_figures(pen, "  95 % kJ", wood->energy.p95 * J_TO_KJ, bare->energy.p95 * J_TO_KJ);
    if (pen->area.height >= HEIGHT_FOR_ALL)
        put_figures(pen, _(" 95% m under"), wood->height.p95, bare->height.p95);
}

static void put_light(struct pen *pen, const char *name, const char *what, enum ceduo_light light)
{
    line(pen, ceduo_plot_light_role(light), "%s %-*s%s %s", ceduo_plot_light_mark(light), ceduo_utf8_field(name, 9), name,
         ceduo_words_verdict(light), what);
}

/* Below a light that changes within what may be true: by what. */
static void put_causes(struct pen *pen, enum ceduo_doubt_kind light)
{
    struct ceduo_doubt_report report;
    struct text causes = {0};
    if (doubt_of(pen->app, &report) && ceduo_doubt_causes(&causes, &report, pen->app->option, light))
        line(pen, CEDUO_ROLE_WARN, _("  depends on %s"), ceduo_text_string(&causes));
    ceduo_text_free(&causes);
}

static void put_contact(struct pen *pen, const char *name, double adc, enum ceduo_light light, double threshold, bool forest)
{
    char what[64];
    if (isinf(adc))
        snprintf(what, sizeof what, "%s", forest ? _("no stems") : _("no forest"));
    else
        snprintf(what, sizeof what, pen->area.width >= 30 ? "%.3g m (<%g)" : "%.3g m", adc, threshold);
    put_light(pen, name, what, light);
}

/* A share and its limit, where there is room; whole is "100", as in Italian 100.0 would have none. */
static void put_percent(struct pen *pen, const char *name, double share, double most, enum ceduo_light light)
{
    char what[64];
    int n = snprintf(what, sizeof what, "%.*f %%", share >= 0.9995 ? 0 : 1, share * 100);
    if (pen->area.width >= 30)
        snprintf(what + n, sizeof what - (size_t)n, " (\xe2\x89\xa4%g)", most * 100);
    put_light(pen, name, what, light);
}

/* Where thin shoots alone decide: the same of stems from 8 cm on; in few columns in one line. */
static void put_thick(struct pen *pen, const struct ceduo_index *index, double threshold)
{
    const struct ceduo_meeting *thick = &index->thick;
    bool contact = thick->contact != index->contact, free_run = thick->free_run != index->free_run;
    if (contact && pen->area.width >= 30)
        put_contact(pen,
                    " \xe2\x89\xa5"
                    "8 cm",
                    thick->worst_adc, thick->contact, threshold, index->length > 0);
    if (free_run && pen->area.width >= 30)
        put_percent(pen,
                    " \xe2\x89\xa5"
                    "8 cm",
                    thick->worst_free_run, CEDUO_FREE_RUN_MOST, thick->free_run);
    if ((contact || free_run) && pen->area.width < 30)
        line(pen, CEDUO_ROLE_BAD, "%s %s", ceduo_plot_light_mark(CEDUO_FAIL),
             contact && free_run ? _("\xe2\x89\xa5"
                                     "8 cm alone: both FAIL")
             : contact           ? _("\xe2\x89\xa5"
                                               "8 cm: contact FAILS")
                                 : _("\xe2\x89\xa5"
                                               "8 cm: free run FAILS"));
}

static void put_lights(struct pen *pen, const struct ceduo_index *index, const struct ceduo_arrivals *wood, double threshold)
{
    char what[64] = "";
    bool wide = pen->area.width >= 30;
    if (index->length > 0 && index->longest_gap > threshold) { /* the reason in the page, too */
        snprintf(what, sizeof what, wide ? _("gap %.3g m (>%g)") : _("gap %.3g m"), index->longest_gap, threshold);
        put_light(pen, _("Contact"), what, index->contact);
    } else {
        put_contact(pen, _("Contact"), index->worst_adc, index->contact, threshold, index->length > 0);
    }
    put_causes(pen, CEDUO_DOUBT_CONTACT);
    put_percent(pen, _("Free run"), index->worst_free_run, CEDUO_FREE_RUN_MOST, index->free_run);
    put_causes(pen, CEDUO_DOUBT_FREE_RUN);
    put_thick(pen, index, threshold);
    if (index->energy != CEDUO_UNKNOWN && wood)
        put_percent(pen, _("Energy"), wood->exceed_probability, CEDUO_EXCEED_MOST, index->energy);
    else
        put_light(pen, _("Energy"), "", index->energy);
    put_causes(pen, CEDUO_DOUBT_EXCEED);
}

static void put_index(struct pen *pen, const struct ceduo_index *index)
{
    if (isnan(index->dissipated) && isnan(index->residual))
        line(pen, CEDUO_ROLE_DIM, "%s", _("index: contacts take shares"));
    else if (isnan(index->dissipated))
        line(pen, CEDUO_ROLE_DIM, _("index: shares, left %.3g kJ"), index->residual * J_TO_KJ);
    else if (isnan(index->residual))
        line(pen, CEDUO_ROLE_DIM, _("index: takes %.3g kJ"), index->dissipated * J_TO_KJ);
    else if (index->exhausted)
        line(pen, CEDUO_ROLE_DIM, _("index: %.3g kJ, used up"), index->dissipated * J_TO_KJ);
    else
        line(pen, CEDUO_ROLE_DIM, _("index: %s%.3g, left %.3g kJ"), index->dissipated > 0 ? "-" : "",
             index->dissipated * J_TO_KJ, index->residual * J_TO_KJ);
    if (!isnan(index->measured) && pen->area.height >= HEIGHT_FOR_ALL)
        line(pen, CEDUO_ROLE_DIM, _("seen: %.3g kJ (one rock)"), index->measured * J_TO_KJ);
}

static void add_warning(void *context, const char *sentence)
{
    ceduo_text_format(context, "! %s\n", sentence);
}

/* Belts of one stand share their rules. */
static void add_rule(void *context, bool met, const char *sentence)
{
    struct text *text = context;
    if (!text->bytes || !strstr(text->bytes, sentence))
        ceduo_text_format(text, "%s%s\n", met ? "" : "! ", sentence);
}

/* Sentences that have no room whole are only counted: view 4 has them. */
static void keep_whole(struct app *app, struct text *sentences, struct ceduo_area area)
{
    size_t left = 0;
    while (sentences->length > 0 && ceduo_app_text_lines(app, sentences->bytes, area.width) + (left > 0) > area.height) {
        char *end = sentences->bytes + sentences->length - 1;
        while (end > sentences->bytes && end[-1] != '\n')
            end--;
        *end = '\0';
        sentences->length = (size_t)(end - sentences->bytes);
        left++;
    }
    if (left > 0)
        ceduo_text_format(sentences, ngettext("! %zu remark more: view 4", "! %zu remarks more: view 4", left), left);
}

static void put_warnings(struct pen *pen)
{
    struct app *app = pen->app;
    struct text w = {0};
    const struct ceduo_option *o = ceduo_app_option(app);
    const struct ceduo_option_result *found = ceduo_app_found(app);
    struct ceduo_run_remarks remarks = {.ground_assumed = app->document.file.ground_assumed, .nothing_said = true};
    ceduo_words_still(app->live.result, add_warning, &w);
    for (size_t i = 0; i < o->belts_count; i++)
        ceduo_words_stand_warnings(app->live.result->scene, &o->belts[i], &found->stands[i], add_warning, &w);
    ceduo_words_run_warnings(app->live.result, &remarks, add_warning, &w);
    for (size_t i = 0; i < o->belts_count; i++)
        ceduo_words_rules(&o->belts[i], &found->stands[i].rules, add_rule, &w);
    struct ceduo_area rest = {pen->area.left, pen->y, pen->area.width, pen->area.top + pen->area.height - pen->y};
    keep_whole(app, &w, rest);
    ceduo_app_put(app, rest, CEDUO_ROLE_WARN, &w);
}

/* How sure the figures are, and whether they are still being refined. */
static void put_mark(struct pen *pen, const struct ceduo_arrivals *a)
{
    struct app *app = pen->app;
    struct text text = {0};
    ceduo_text_format(&text, app->live.busy ? _("computing, %llu rocks") : _("finished, %llu rocks"),
                      (unsigned long long)a->released);
    if (a->reached >= CEDUO_FEW && pen->area.width >= 34)
        ceduo_text_format(&text, ", \xc2\xb1%.2g %%", ceduo_half_width(a->energy.se, a->reached) / a->energy.mean * 100);
    line(pen, CEDUO_ROLE_DIM, "%s", ceduo_text_string(&text));
    ceduo_text_free(&text);
}

/* The forest that the column is of: of view 6 in the year under its cursor, otherwise as it is today. */
struct forest {
    const struct ceduo_year *year; /* NULL: today */
    const struct ceduo_index *index;
    const struct ceduo_arrivals *wood; /* NULL: not known, or never */
};

static struct forest forest_shown(const struct app *app)
{
    const struct ceduo_result *r = app->live.result;
    size_t c = r->last_control;
    struct forest f = {.index = &ceduo_app_found(app)->controls[c], .wood = ceduo_result_wooded(r, app->option, c)};
    const struct ceduo_years *years = app->view == VIEW_ROTATION ? ceduo_live_years(&app->live, r->scene, app->option) : NULL;
    if (!years || app->year >= years->count)
        return f;
    f.year = &years->years[app->year];
    f.index = &f.year->controls[c];
    f.wood = f.year->wooded.rocks > 0 ? &f.year->wooded.arrivals[c] : NULL;
    return f;
}

void ceduo_column_draw(struct app *app, struct ceduo_area area)
{
    struct pen pen = {app, area, area.top};
    put_scene(&pen);
    if (!app->live.result) {
        line(&pen, CEDUO_ROLE_DIM, "%s", _("the first rocks are falling \xe2\x80\xa6"));
        return;
    }
    const struct ceduo_result *r = app->live.result;
    size_t c = r->last_control;
    const struct forest f = forest_shown(app);
    if (f.year)
        line(&pen, CEDUO_ROLE_TITLE, f.year->cut ? _("Year %u, just cut") : _("Year %u"), f.year->year);
    put_arrivals(&pen, &r->scene->controls[c], f.wood, &r->bare.arrivals[c], f.year ? NULL : &ceduo_app_found(app)->others[c]);
    bool said = !ceduo_says_nothing(&r->bare.arrivals[c]);
    if (said)
        put_lights(&pen, f.index, f.wood, r->scene->simulation.threshold);
    put_mark(&pen, f.wood ? f.wood : ceduo_app_shown(app));
    if (said)
        put_index(&pen, f.index);
    put_warnings(&pen);
}
