/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 8: what was observed beside what is simulated, and a fit to it, which goes on in the background. */
#include <math.h>

#include "app.h"
#include "base/language.h"
#include "base/utf8.h"
#include "edit.h"
#include "model/keep_fit.h"
#include "popup.h"
#include "popups.h"
#include "view/report_calibration.h"
#include "view/words.h"

#define PICTURE_MIN 8
#define RANGE       "\xe2\x80\x93"

/* ---- rows: observed, simulated with its band ---- */

#define OBSERVED_WIDTH    8
#define BAND_WIDTH        11
#define WORD_WIDTH        10
#define NAME_WIDTH(width) ((width)-OBSERVED_WIDTH - BAND_WIDTH - WORD_WIDTH - 3)

/* A name that has no room stands in a line above. */
static void append_row(struct text *row, int width, const char *name, const char *seen, const char *band, const char *word)
{
    int columns = NAME_WIDTH(width);
    if ((int)ceduo_utf8_width(name) > columns) {
        ceduo_text_format(row, "%s\n", name);
        name = "";
    }
    ceduo_text_format(row, "%-*s %*s %*s %s\n", ceduo_utf8_field(name, columns), name, ceduo_utf8_field(seen, OBSERVED_WIDTH),
                      seen, ceduo_utf8_field(band, BAND_WIDTH), band, word);
}

static void append_number(struct text *text, const struct ceduo_observation *o, double value, double origin)
{
    if (o->kind == CEDUO_OBSERVED_PASSED)
        ceduo_text_format(text, "%.0f", value);
    else
        ceduo_words_number(text, ceduo_seen_shown(o->kind, value, origin), 3);
}

static void append_observation(struct text *text, const struct scene_file *file, const struct ceduo_predicted *p, int width)
{
    const struct ceduo_observation *o = &file->observations[p->observation];
    double origin = file->scene.slope.origin_x;
    struct text name = {0}, seen = {0}, band = {0};
    ceduo_text_safe(&name, o->name);
    if (o->use == CEDUO_OBSERVED_CHECK)
        ceduo_text_format(&name, " %s", _("(check)"));
    append_number(&seen, o, p->seen, origin);
    const char *unit = ceduo_observed_quantity(o->kind)->unit;
    ceduo_text_format(&seen, "%s%s", unit[0] ? " " : "", unit);
    append_number(&band, o, p->lo, origin);
    ceduo_text_put(&band, RANGE);
    append_number(&band, o, p->hi, origin);
    append_row(text, width, ceduo_text_string(&name), ceduo_text_string(&seen), isnan(p->lo) ? "-" : ceduo_text_string(&band),
               !p->inside                  ? _("OUTSIDE")
               : p->p_value < CEDUO_MISFIT ? _("mean only") /* what is refuted below is how the values are spread */
                                           : _("inside"));
    ceduo_text_free(&name);
    ceduo_text_free(&seen);
    ceduo_text_free(&band);
}

static void append_rows(struct text *text, const struct scene_file *file, const struct ceduo_predicted *p, int width)
{
    append_row(text, width, _("mean or count"), _("seen"), _("sim., 95 %"), "");
    for (size_t i = 0; i < file->observations_count; i++)
        append_observation(text, file, &p[i], width);
    ceduo_text_char(text, '\n');
}

/* ---- words ---- */

/* Of each list and count by its probability, which sees the form of a list, too. */
static void append_misfits(struct text *text, const struct scene_file *file, const struct ceduo_predicted *p)
{
    struct text bad = {0};
    for (size_t i = 0; i < file->observations_count; i++) {
        if (p[i].p_value >= CEDUO_MISFIT)
            continue;
        if (bad.length > 0)
            ceduo_text_put(&bad, "; ");
        ceduo_text_safe(&bad, file->observations[i].name);
        const char *chance = p[i].p_value < 0.001 ? "<.001" : WRITTEN(p[i].p_value, 2);
        if (isnan(p[i].p_value))
            ceduo_text_format(&bad, " (%s)", _("no simulated rock does that"));
        else if (p[i].inside)
            ceduo_text_format(&bad, _(" (the mean fits, how the values are spread does not: p %s)"), chance);
        else
            ceduo_text_format(&bad, " (p %s)", chance);
    }
    if (bad.length > 0)
        ceduo_text_format(text, _("The scene as it is does not give what was seen: %s.\n"), ceduo_text_string(&bad));
    else
        ceduo_text_put(text, _("The scene as it is can give all that was seen.\n"));
    ceduo_text_free(&bad);
}

static void say_as_it_is(struct app *app, struct text *text, int width)
{
    const struct scene_file *file = &app->document.file;
    const struct comparison *s = ceduo_live_comparison(&app->live, file);
    if (!s) {
        ceduo_text_put(text, _("not computed yet"));
        return;
    }
    append_rows(text, file, s->predicted, width);
    append_misfits(text, file, s->predicted);
    if (ceduo_fit_has_observations(file))
        ceduo_text_put(text, _("c fits the ground to what was seen; only a fit says what of it is determined.\n"));
    ceduo_text_format(text, _("Simulated: %llu rocks.\n"), (unsigned long long)s->rocks);
}

static void append_best(struct text *text, const struct fit_request *w, size_t i, double best)
{
    ceduo_calibration_name(text, w->paths[i], w->fields[i]);
    ceduo_text_char(text, ' ');
    ceduo_calibration_number(text, w->fields[i], best);
}

/* What a short first fit tells of values that cannot be known from what was seen. */
static void say_loose(const struct fit *f, struct text *text)
{
    LOCAL_TEXT(names);
    for (size_t i = 0; i < f->request.n; i++)
        if (f->loose.loose[i]) {
            ceduo_text_put(&names, names.length > 0 ? ", " : "");
            ceduo_calibration_name(&names, f->request.paths[i], f->request.fields[i]);
        }
    ceduo_text_format(text, _("What was seen does not hold %zu values: fix %s. c fits without it; to go on takes long.\n"),
                      f->request.n, ceduo_text_string(&names));
}

static void say_fitting(const struct live *live, struct text *text)
{
    const struct fit *f = live->results.fit; /* NULL: nothing is known yet */
    const struct ceduo_calibration_state *s = f ? &f->state : NULL;
    ceduo_text_put(text, _("A fit is under way. Esc stops it, and nothing of it is kept.\n"));
    if (!s || s->evaluations == 0)
        return;
    if (s->stage == CEDUO_CHAINS && isfinite(s->rhat))
        ceduo_text_format(text, _("%llu scenes; R-hat %.3f (at most 1.05 is wanted), effective size %.0f (200).\n"),
                          (unsigned long long)s->evaluations, s->rhat, s->effective_size);
    else
        ceduo_text_format(text, _("%llu scenes; log-likelihood %.2f.\n"), (unsigned long long)s->evaluations,
                          s->log_likelihood);
    if (f->loose.n > 0)
        say_loose(f, text);
    ceduo_text_put(text, _("The best values so far:\n"));
    for (size_t i = 0; i < f->request.n; i++) {
        ceduo_text_put(text, "  ");
        append_best(text, &f->request, i, s->best[i]);
        ceduo_text_char(text, '\n');
    }
}

static struct ceduo_calibration_report report_of(const struct fit *f)
{
    return (struct ceduo_calibration_report){.scenes_count = 1,
                                             .files = &f->file,
                                             .paths = f->paths,
                                             .fields = f->request.fields,
                                             .rocks = f->request.rocks,
                                             .seed = f->file.scene.simulation.seed,
                                             .answer = &f->answer};
}

/* What Enter does not keep, and the command that writes it. */
static void say_draws(const struct fit *f, struct text *text)
{
    char lo[CEDUO_NUMBER_ROOM], hi[CEDUO_NUMBER_ROOM];
    ceduo_text_put(text,
                   _("Enter keeps the best values and, as their source, these ranges. It does not keep all that fits as well, "
                     "the draws. Once the scene is saved, as SCENE.yaml, this writes them to FITTED.draws.csv, and "
                     "FITTED.yaml, which reads them:\n"));
    ceduo_text_put(text, "  ceduo");
    for (size_t i = 0; i < f->request.n; i++) {
        struct text value = {0};
        ceduo_text_format(&value, "%s=%s:%s", f->request.paths[i], ceduo_number_shortest(f->request.lo[i], lo),
                          ceduo_number_shortest(f->request.hi[i], hi));
        ceduo_text_put(text, " --calibrate ");
        ceduo_text_quoted(text, ceduo_text_string(&value));
        ceduo_text_free(&value);
    }
    ceduo_text_format(text, " -n %llu -o FITTED.yaml SCENE.yaml\n", (unsigned long long)f->request.rocks);
}

static void say_fit(const struct fit *f, struct text *text, int width)
{
    const struct ceduo_calibration_report r = report_of(f);
    ceduo_text_put(text,
                   _("Fitted. Enter takes these values into the scene, Esc leaves it as it is, as the picture shows it.\n"));
    for (size_t i = 0; i < f->request.n; i++) {
        const struct ceduo_fitted *one = &f->answer.parameters[i];
        ceduo_text_put(text, "  ");
        append_best(text, &f->request, i, one->best);
        ceduo_text_put(text, " (");
        ceduo_calibration_number(text, f->request.fields[i], one->p2_5);
        ceduo_text_put(text, RANGE);
        ceduo_calibration_number(text, f->request.fields[i], one->p97_5);
        ceduo_text_put(text, ")");
        if (!one->determined)
            ceduo_text_format(text, ", %s", _("not determined"));
        ceduo_text_char(text, '\n');
    }
    ceduo_text_char(text, '\n');
    append_rows(text, &f->file, f->answer.predicted, width);
    ceduo_calibration_words(text, &r, (size_t)width);
    ceduo_text_char(text, '\n');
    say_draws(f, text);
}

static void say_nothing_seen(struct text *text)
{
    ceduo_text_put(text, _("This scene does not say what was seen on its slope.\n\n"));
    ceduo_text_put(
        text, _("Where rocks have stopped, how many passed a place, how fast or how high they were, scars on stems: a asks "
                "for what of it is known. A table of values is named in the scene's file, see man ceduo-scene.\n\n"));
    ceduo_text_put(text, _("Here it is then compared with simulated rocks, and c fits the ground to it.\n"));
}

/* ---- what was observed, to edit ---- */

/* What is asked for, in the order in which it is shown; `key`: what adds it. */
static const struct {
    const char *group;
    char key;
    const char *what;
} groups[] = {{"stops", 's', N_("stops: where rocks came to rest")},
              {"passed", 'c', N_("a count: how many passed a place")},
              {"height", 'h', N_("heights above the ground at a place, m")},
              {"scars", 'd', N_("damaged stems: heights of their scars, m")},
              {"speed", 'v', N_("speeds at a place, m/s")},
              {"energy", 'e', N_("energies at a place, kJ")}};
#define GROUPS (sizeof groups / sizeof groups[0])

/* The first item of the list that has the group, and in it the key (NULL: any); NULL: none has. */
static const struct node *first_with(const struct node *rows, const char *group, const char *key)
{
    for (size_t i = 0; i < rows->n; i++) {
        const struct node *found = ceduo_node_get(rows->items[i], group);
        if (found && (!key || ceduo_node_get(found, key)))
            return found;
    }
    return NULL;
}

/* All keys of a group but those of a table of values, where there is none. */
static void build_group(struct form *form, const struct document *d, const struct object *object, const char *group)
{
    const struct object *of = ceduo_schema_field(object, group)->object;
    const char *keys[FORM_COLUMNS + 1] = {NULL};
    const struct node *rows = ceduo_document_node(d, "observed");
    for (size_t i = 0, n = 0; i < of->n && n < FORM_COLUMNS; i++)
        if (of->fields[i].type > FIELD_FILE || first_with(rows, group, of->fields[i].key))
            keys[n++] = of->fields[i].key;
    ceduo_form_group(form, d, object, "observed", group, keys);
}

static void build(struct app *app, struct form *form)
{
    static const char *const columns[] = {"name", "use", "option", NULL};
    const struct document *d = &app->document;
    const struct object *object = ceduo_schema_field(ceduo_schema_scene(), "observed")->object;
    const struct node *rows = ceduo_document_node(d, "observed");
    if (!rows || rows->kind != NODE_LIST || rows->n == 0)
        return;
    for (size_t i = 0; i < GROUPS; i++)
        if (first_with(rows, groups[i].group, NULL)) {
            ceduo_form_heading(form, _(groups[i].what));
            build_group(form, d, object, groups[i].group);
        }
    ceduo_form_heading(form, _("All that was seen"));
    ceduo_form_table(form, d, object, "observed", columns, "");
}

static void chose_group(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    ceduo_popup_item_of(app, "observed", value, NULL, 0);
}

static void add(struct app *app, int unused)
{
    (void)unused;
    struct popup *p = ceduo_popup_list(app, _("What was seen?"), chose_group);
    for (size_t i = 0; i < GROUPS; i++)
        ceduo_popup_answer(p, groups[i].key, _(groups[i].what), groups[i].group);
}

/* ---- drawing ---- */

enum { PANE_FORM, PANE_TEXT, PANES };

static void draw(struct app *app, struct ceduo_area area)
{
    const struct scene_file *file = &app->document.file;
    const struct live *f = &app->live;
    const struct comparison *c = ceduo_live_comparison(f, file);
    const struct ceduo_seen_stops *stops = NULL; /* of the option that is shown, otherwise the first there are */
    for (size_t i = c ? c->file.observations_count : 0; i-- > 0;)
        if (c->stops[i].known)
            stops = &c->stops[i];
    for (size_t i = c ? c->file.observations_count : 0; i-- > 0;)
        if (c->stops[i].known && c->file.observations[i].option == app->option)
            stops = &c->stops[i];
    struct text text = {0};
    struct view_state *state = ceduo_app_state(app);
    bool fit = f->fitting || ceduo_live_fitted(f);
    if (fit)
        state->pane = PANE_TEXT;
    int lines = state->pane == PANE_TEXT ? 0 : (int)state->form.n, form = area.height / 3 < lines ? area.height / 3 : lines;
    if (form > 0) {
        ceduo_app_draw_form(app, (struct ceduo_area){area.left, area.top + area.height - form, area.width, form}, true);
        area.height -= form + 1;
    }
    area.width -= 2; /* the mark of more below stands beside the text */
    if (file->observations_count == 0)
        say_nothing_seen(&text);
    else if (f->fitting)
        say_fitting(f, &text);
    else if (fit)
        say_fit(ceduo_live_fitted(f), &text, area.width);
    else
        say_as_it_is(app, &text, area.width);
    int max = area.height - ceduo_app_text_lines(app, ceduo_text_string(&text), area.width) - 1;
    int height = max > area.height / 2 ? max : area.height / 2;
    if (stops && height >= PICTURE_MIN) {
        struct ceduo_area top = {area.left, area.top, area.width, height};
        ceduo_plot_seen(&app->cells->canvas, &top, stops, file->scene.slope.origin_x);
        area.top += height + 1;
        area.height -= height + 1;
    }
    ceduo_app_scrolled(app, area, &text);
}

/* ---- keys ---- */

static void start(struct app *app, int unused)
{
    (void)unused;
    if (app->document.file.observations_count == 0)
        ceduo_app_warn(app, "%s", _("nothing was seen here that could be fitted: a asks for it"));
    else if (!ceduo_fit_has_observations(&app->document.file))
        ceduo_app_warn(app, "%s", _("all that was seen is to check a fit: mark what is to be fitted 'use: fit'"));
    else
        ceduo_popup_fit(app);
}

/* The best values into the scene, as one edit. */
static void take(struct app *app, int unused)
{
    (void)unused;
    const struct fit *f = ceduo_live_fitted(&app->live);
    if (!f && !app->live.fitting && ceduo_app_state(app)->pane == PANE_FORM && ceduo_app_form(app)->n > 0) {
        ceduo_edit_start(app);
        return;
    }
    if (!f) {
        ceduo_app_say(app, "%s",
                      app->live.fitting ? _("the fit is not done yet; Esc stops it") : _("c fits the ground to what was seen"));
        return;
    }
    const struct ceduo_calibration_report r = report_of(f);
    struct text source = {0};
    double best[CEDUO_CALIBRATION_MOST];
    for (size_t i = 0; i < f->request.n; i++)
        best[i] = f->answer.parameters[i].best;
    ceduo_calibration_sources(&source, &r);
    const struct fit_values values = {f->request.n, f->inputs, f->request.fields, best, ceduo_text_string(&source), NULL};
    bool good = ceduo_keep_fit(&app->document, &values, &app->problems);
    if (ceduo_app_edited(app, good))
        ceduo_app_say(app, "%s", _("the scene has the values and their ranges, not the draws; u takes them back"));
    ceduo_text_free(&source);
}

static void stop(struct app *app, int unused)
{
    (void)unused;
    if (app->live.fitting)
        ceduo_app_say(app, "%s", _("the fit is stopped; the scene is as it was"));
    else if (ceduo_live_fitted(&app->live))
        ceduo_app_say(app, "%s", _("the scene is left as it was"));
    ceduo_live_drop_fit(&app->live);
}

static const struct act acts[] = {
    {ACTION_COUNTS, start, 0}, {ACTION_EDIT, take, 0}, {ACTION_ADD, add, 0}, {ACTION_STOP, stop, 0}, {0}};

const struct view ceduo_view_observed = {.title = NP_("view", "seen"),
                                         .panes = PANES,
                                         .observed = true,
                                         .build = build,
                                         .draw = draw,
                                         .acts = {acts, acts},
                                         .bar = {{ACTION_ADD, N_("add")},
                                                 {ACTION_COUNTS, N_("fit")},
                                                 {ACTION_EDIT, N_("take the fit")},
                                                 {ACTION_STOP, N_("leave it")},
                                                 {ACTION_NEXT_PANE, N_("read on")},
                                                 {ACTION_NEXT_OPTION, N_("next option")}}};
