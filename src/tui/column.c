/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The column that stands still in every view: what passes, whether it protects, how sure that is. */
#include "screen.h"

#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "scene/choices.h"

#define HEIGHT_FOR_ALL 24 /* lines with room for everything and some warnings */
#define HEIGHT_FOR_MAX 17 /* with room for the lights behind all but the heights */

struct pen {
    struct app *app;
    struct ceduo_area area;
    int y;
};

__attribute__((format(printf, 3, 4))) static void line(struct pen *pen, enum ceduo_role role, const char *format, ...)
{
    struct text safe = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_safe(&safe, ceduo_arena_vformat(pen->app->scratch, format, args));
    va_end(args);
    if (pen->y < pen->area.top + pen->area.height)
        ceduo_canvas_put(&pen->app->cells->canvas, pen->area.left, pen->y, pen->area.width, role, ceduo_text_string(&safe));
    pen->y++;
    ceduo_text_free(&safe);
}

static void draw_scene(struct pen *pen)
{
    const struct ceduo_scene *s = &pen->app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(pen->app);
    struct ceduo_rock rock = ceduo_rock_mean(&s->rock);
    double min = INFINITY, max = 0, per_year = 0;
    for (size_t i = 0; i < s->blocks_count; i++) {
        min = fmin(min, s->blocks[i].volumes[0]);
        max = fmax(max, s->blocks[i].volumes[1]);
        per_year += s->blocks[i].per_year;
    }
    if (s->blocks_count > 0) /* no single size stands for them */
        line(pen, CEDUO_ROLE_TEXT, _("Blocks  %.3g-%.3g m\xc2\xb3  %.3g/year"), min, max, per_year);
    else if (!isnan(rock.mass))
        line(pen, CEDUO_ROLE_TEXT, _("Rock  %.3g m  %.4g kg%s"), rock.mean_diameter, rock.mass,
             ceduo_notes_assume(pen->app->document.file.notes, "rock") ? "*" : "");
    if (s->options_count < 2 && o->belts_count == 0)
        line(pen, CEDUO_ROLE_TEXT, "%s", _("Wood  none"));
    else
        line(pen, CEDUO_ROLE_TEXT, _("Wood  %s%s"), s->options_count > 1 ? o->name : o->belts[0].name,
             o->belts_count > 1 && s->options_count < 2 ? " \xc2\xb7 \xe2\x80\xa6" : "");
}

/* Of 1000: "832\xc2\xb12"; without an interval where lo = hi. */
static const char *share(const struct pen *pen, double p, double lo, double hi)
{
    if (isnan(p))
        return "-";
    if (hi > lo)
        return ceduo_app_format(pen->app, "%.0f\xc2\xb1%.0f", p * 1000, ceil(fmax(hi - p, p - lo) * 1000));
    return ceduo_app_format(pen->app, "%.0f", p * 1000);
}

/* The same as "832 (831-834)" where there is room. */
static bool is_wide(const struct pen *pen)
{
    return pen->area.width >= 34;
}

static const char *wide_share(const struct pen *pen, double p, double lo, double hi)
{
    if (isnan(p))
        return "-";
    return ceduo_app_format(pen->app, "%.0f (%.0f-%.0f)", p * 1000, floor(lo * 1000), ceil(hi * 1000));
}

static const char *figure(const struct pen *pen, double value)
{
    return isnan(value) ? "-" : ceduo_app_format(pen->app, "%.3g", value);
}

/* A line of the figures, those of the forest first: the column without forest stands beside it. */
static void draw_pair(struct pen *pen, enum ceduo_role role, const char *name, const char *wood, const char *bare)
{
    int column = is_wide(pen) ? 15 : 7;
    int wider = strstr(wood, "\xc2\xb1") ? 1 : 0; /* a byte more than columns */
    line(pen, role, "%-*s%*s%*s", ceduo_utf8_field(name, 11), name, column + wider, wood, 8, bare);
}

/* A part of the pair above: its name is set in by a blank. */
static void draw_pair_in(struct pen *pen, const char *name, const char *wood, const char *bare)
{
    draw_pair(pen, CEDUO_ROLE_TEXT, ceduo_app_format(pen->app, " %s", name), wood, bare);
}

static void draw_figures(struct pen *pen, const char *name, double wood, double bare)
{
    draw_pair(pen, CEDUO_ROLE_TEXT, name, figure(pen, wood), figure(pen, bare));
}

/* Rocks that end before the control. */
static void draw_missed(struct pen *pen, const char *name, enum ceduo_end end, const struct ceduo_arrivals *wood,
                        const struct ceduo_arrivals *bare)
{
    draw_pair_in(pen, name, wood->released > 0 ? share(pen, wood->missed[end], 0, 0) : "-",
                 share(pen, bare->missed[end], 0, 0));
}

/* The share in the line above, under the other energy law; `other` may be NULL. */
static void draw_other(struct pen *pen, const struct ceduo_other_energy *other)
{
    if (other && other->known && other->stems)
        draw_pair(pen, CEDUO_ROLE_DIM, ceduo_app_format(pen->app, "  %s", ceduo_energy_words.names[other->model]),
                  share(pen, ceduo_share_by_other_law(other), 0, 0), "");
}

/* Years from one dangerous rock to the next: what matters where blocks of all sizes come down. */
static void draw_every(struct pen *pen, const struct ceduo_arrivals *wood, const struct ceduo_arrivals *bare)
{
    struct text a = {0}, b = {0};
    ceduo_words_every(&a, ceduo_hazard_feared(&wood->hazard));
    ceduo_words_every(&b, ceduo_hazard_feared(&bare->hazard));
    draw_pair_in(pen, _("years apart"), ceduo_app_kept(pen->app, &a), ceduo_app_kept(pen->app, &b));
}

/* Where all released end: on the way, or here. */
static void draw_released(struct pen *pen, const struct ceduo_arrivals *wood, const struct ceduo_arrivals *bare,
                          const struct ceduo_other_energy *other)
{
    static const struct {
        const char *name;
        enum ceduo_end end;
        bool always;
    } rows[] = {{N_("stems stop"), CEDUO_STOPPED_BY_STEMS, true},
                {N_("at rest"), CEDUO_AT_REST, true},
                {N_("left"), CEDUO_LEFT_SLOPE, false},
                {N_("unfinished"), CEDUO_UNFINISHED, false}};
    draw_pair_in(pen, _("arrive"),
                 (is_wide(pen) ? wide_share : share)(pen, wood->reach_probability, wood->reach_lo, wood->reach_hi),
                 share(pen, bare->reach_probability, 0, 0));
    draw_other(pen, other);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].always || wood->ended[rows[i].end] > 0 || bare->ended[rows[i].end] > 0)
            draw_missed(pen, _(rows[i].name), rows[i].end, wood, bare);
}

/* How sure the figures shown are: not those of a year to come; false where nothing is known. */
static bool doubt_of(const struct app *app, struct ceduo_doubt_report *report)
{
    return app->view != VIEW_ROTATION && ceduo_app_doubt(app, report) && report->answer;
}

/* The range of what may be true of the figure in the line above, once it is known: in the unit of that line. */
static bool draw_doubt(struct pen *pen, bool energy)
{
    struct app *app = pen->app;
    struct ceduo_doubt_report report;
    if (!doubt_of(app, &report) || (report.answer->main == CEDUO_DOUBT_ENERGY) != energy)
        return false;
    const struct ceduo_doubt_figure *f = ceduo_doubt_figure_of(report.answer, app->option, report.answer->main, false);
    const char *range = energy ? ceduo_app_format(app, "%.3g-%.3g", f->fit.p5 * J_TO_KJ, f->fit.p95 * J_TO_KJ)
                               : ceduo_app_format(app, "%.0f-%.0f", f->fit.p5 * 1000, f->fit.p95 * 1000);
    draw_pair(pen, CEDUO_ROLE_DIM, ceduo_app_format(app, "  %s", P_("view", "doubt")), range,
              ceduo_app_doubt_is_rough(app) ? _("rough") : "");
    return true;
}

/* The share that the options are compared by, with the same error as in the other views. */
static void draw_exceed(struct pen *pen, double accepted, const struct ceduo_arrivals *wood, const struct ceduo_arrivals *bare)
{
    double p = wood->exceed_probability, half = ceduo_share_at(wood).half;
    draw_pair_in(pen, ceduo_app_format(pen->app, ">%.4g kJ", accepted * J_TO_KJ),
                 is_wide(pen) ? wide_share(pen, p, wood->exceed_lo, wood->exceed_hi) : share(pen, p, p - half, p + half),
                 share(pen, bare->exceed_probability, 0, 0));
}

/* What arrives through the forest beside what arrives without it; `wood` NULL: not known yet, or never (index). `other`
 * may be NULL. */
static void draw_arrivals(struct pen *pen, const struct ceduo_control *c, const struct ceduo_arrivals *wood,
                          const struct ceduo_arrivals *bare, const struct ceduo_other_energy *other)
{
    const struct ceduo_distribution none = ceduo_distribution_none();
    const struct ceduo_arrivals nothing = {.reach_probability = NAN,
                                           .exceed_probability = NAN,
                                           .energy_per_released = NAN,
                                           .energy = none,
                                           .hazard = ceduo_hazard_none(),
                                           .height = none};
    wood = wood ? wood : &nothing;
    bool doubted = false, blocks = !isnan(bare->hazard.per_year);
    line(pen, CEDUO_ROLE_TITLE, _("At %g m%s%s"), c->x_given, c->name ? ", " : "", c->name ? c->name : "");
    draw_pair(pen, CEDUO_ROLE_DIM, _("of 1000"), _("forest"), _("without"));
    if (ceduo_says_nothing(bare)) { /* why stands below, and takes the room */
        draw_released(pen, wood, bare, NULL);
        return;
    }
    if (!isnan(c->accepted)) {
        draw_exceed(pen, c->accepted, wood, bare);
        draw_other(pen, other);
        doubted = draw_doubt(pen, false);
    }
    if (blocks)
        draw_every(pen, wood, bare);
    draw_released(pen, wood, bare, isnan(c->accepted) ? other : NULL);
    draw_figures(pen, _("kJ a rock"), wood->energy_per_released * J_TO_KJ, bare->energy_per_released * J_TO_KJ);
    doubted |= draw_doubt(pen, true);
    if (!blocks) /* of them the large arrive: a mean of those would read as if the wood did harm */
        draw_figures(pen, _("arriving kJ"), wood->energy.mean * J_TO_KJ, bare->energy.mean * J_TO_KJ);
    if (!blocks && pen->area.height >= (doubted ? HEIGHT_FOR_ALL : HEIGHT_FOR_MAX))
        draw_figures(pen, "  95 % kJ", wood->energy.p95 * J_TO_KJ, bare->energy.p95 * J_TO_KJ);
    if (pen->area.height >= HEIGHT_FOR_ALL)
        draw_figures(pen, _(" 95% m under"), wood->height.p95, bare->height.p95);
}

static void draw_light(struct pen *pen, const char *name, const char *what, enum ceduo_light light)
{
    line(pen, ceduo_plot_light_role(light), "%s %-*s%s %s", ceduo_plot_light_mark(light), ceduo_utf8_field(name, 9), name,
         ceduo_words_verdict(light), what);
}

/* Below a light that changes within what may be true: by what. */
static void draw_causes(struct pen *pen, enum ceduo_doubt_kind light)
{
    struct ceduo_doubt_report report;
    struct text causes = {0};
    if (doubt_of(pen->app, &report) && ceduo_doubt_causes(&causes, &report, pen->app->option, light))
        line(pen, CEDUO_ROLE_WARN, _("  depends on %s"), ceduo_text_string(&causes));
    ceduo_text_free(&causes);
}

/* Columns with room for limits beside the figures. */
static bool has_limits(const struct pen *pen)
{
    return pen->area.width >= 30;
}

static void draw_contact(struct pen *pen, const char *name, double adc, enum ceduo_light light, double threshold, bool forest)
{
    const char *what = isinf(adc)        ? forest ? _("no stems") : _("no forest")
                              : has_limits(pen) ? ceduo_app_format(pen->app, "%.3g m (<%g)", adc, threshold)
                                         : ceduo_app_format(pen->app, "%.3g m", adc);
    draw_light(pen, name, what, light);
}

/* A share and its limit, where there is room; whole is "100", as in Italian 100.0 would have none. */
static void draw_percent(struct pen *pen, const char *name, double share, double max, enum ceduo_light light)
{
    const char *limit = has_limits(pen) ? ceduo_app_format(pen->app, " (\xe2\x89\xa4%g)", max * 100) : "";
    draw_light(pen, name, ceduo_app_format(pen->app, "%.*f %%%s", share >= 0.9995 ? 0 : 1, share * 100, limit), light);
}

/* Where thin shoots alone decide: the same of stems from 8 cm on; in few columns in one line. */
static void draw_thick(struct pen *pen, const struct ceduo_index *index, double threshold)
{
    static const char name[] = " \xe2\x89\xa5\x38 cm";
    const struct ceduo_meeting *thick = &index->thick;
    bool contact = thick->contact != index->contact, free_run = thick->free_run != index->free_run;
    if (contact && has_limits(pen))
        draw_contact(pen, name, thick->worst_adc, thick->contact, threshold, index->length > 0);
    if (free_run && has_limits(pen))
        draw_percent(pen, name, thick->worst_free_run, CEDUO_FREE_RUN_MOST, thick->free_run);
    if ((contact || free_run) && !has_limits(pen))
        line(pen, CEDUO_ROLE_BAD, "%s %s", ceduo_plot_light_mark(CEDUO_FAIL),
             contact && free_run ? _("\xe2\x89\xa5"
                                     "8 cm alone: both FAIL")
             : contact           ? _("\xe2\x89\xa5"
                                               "8 cm: contact FAILS")
                                 : _("\xe2\x89\xa5"
                                               "8 cm: free run FAILS"));
}

static void draw_lights(struct pen *pen, const struct ceduo_index *index, const struct ceduo_arrivals *wood, double threshold)
{
    if (index->length > 0 && index->longest_gap > threshold) /* the reason in the page, too */
        draw_light(pen, _("Contact"),
                   has_limits(pen) ? ceduo_app_format(pen->app, _("gap %.3g m (>%g)"), index->longest_gap, threshold)
                                   : ceduo_app_format(pen->app, _("gap %.3g m"), index->longest_gap),
                   index->contact);
    else
        draw_contact(pen, _("Contact"), index->worst_adc, index->contact, threshold, index->length > 0);
    draw_causes(pen, CEDUO_DOUBT_CONTACT);
    draw_percent(pen, _("Free run"), index->worst_free_run, CEDUO_FREE_RUN_MOST, index->free_run);
    draw_causes(pen, CEDUO_DOUBT_FREE_RUN);
    draw_thick(pen, index, threshold);
    if (index->energy != CEDUO_UNKNOWN && wood)
        draw_percent(pen, _("Energy"), wood->exceed_probability, CEDUO_EXCEED_MOST, index->energy);
    else
        draw_light(pen, _("Energy"), "", index->energy);
    draw_causes(pen, CEDUO_DOUBT_EXCEED);
}

static void draw_index(struct pen *pen, const struct ceduo_index *index)
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

static void draw_warnings(struct pen *pen)
{
    struct app *app = pen->app;
    struct text w = {0};
    const struct ceduo_option *o = ceduo_app_option(app);
    const struct ceduo_option_result *found = ceduo_app_found(app);
    struct ceduo_run_remarks remarks = {.ground_assumed = app->document.file.ground_assumed, .nothing_said = true};
    ceduo_words_still(app->live.result, ceduo_app_add_warning, &w);
    for (size_t i = 0; i < o->belts_count; i++)
        ceduo_words_stand_warnings(app->live.result->scene, &o->belts[i], &found->stands[i], ceduo_app_add_warning, &w);
    ceduo_words_run_warnings(app->live.result, &remarks, ceduo_app_add_warning, &w);
    for (size_t i = 0; i < o->belts_count; i++)
        ceduo_words_rules(&o->belts[i], &found->stands[i].rules, add_rule, &w);
    struct ceduo_area rest = {pen->area.left, pen->y, pen->area.width, pen->area.top + pen->area.height - pen->y};
    keep_whole(app, &w, rest);
    ceduo_app_put(app, rest, CEDUO_ROLE_WARN, &w);
}

/* How sure the figures are, and whether they are still being refined. */
static void draw_mark(struct pen *pen, const struct ceduo_arrivals *a)
{
    struct app *app = pen->app;
    struct text text = {0};
    ceduo_text_format(&text, app->live.busy ? _("computing, %llu rocks") : _("finished, %llu rocks"),
                      (unsigned long long)a->released);
    if (a->reached >= CEDUO_FEW && is_wide(pen))
        ceduo_text_format(&text, ", \xc2\xb1%.2g %%", ceduo_half_width(a->energy.se, a->reached) / a->energy.mean * 100);
    line(pen, CEDUO_ROLE_DIM, "%s", ceduo_app_kept(app, &text));
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
    draw_scene(&pen);
    if (!app->live.result) {
        line(&pen, CEDUO_ROLE_DIM, "%s", _("the first rocks are falling \xe2\x80\xa6"));
        return;
    }
    const struct ceduo_result *r = app->live.result;
    size_t c = r->last_control;
    const struct forest f = forest_shown(app);
    if (f.year)
        line(&pen, CEDUO_ROLE_TITLE, f.year->cut ? _("Year %u, just cut") : _("Year %u"), f.year->year);
    draw_arrivals(&pen, &r->scene->controls[c], f.wood, &r->bare.arrivals[c], f.year ? NULL : &ceduo_app_found(app)->others[c]);
    bool said = !ceduo_says_nothing(&r->bare.arrivals[c]);
    if (said)
        draw_lights(&pen, f.index, f.wood, r->scene->simulation.threshold);
    draw_mark(&pen, f.wood ? f.wood : ceduo_app_shown(app));
    if (said)
        draw_index(&pen, f.index);
    draw_warnings(&pen);
}
