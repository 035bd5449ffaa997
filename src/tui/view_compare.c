/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 5: the silvicultural options side by side, today and over one whole rotation of each. View 6 shows the same
 * options year by year. */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "popup.h"
#include "popups.h"
#include "view/plot_parts.h"

static void build(struct app *app, struct form *form)
{
    static const char *const columns[] = {"name", NULL};
    const struct field *options = ceduo_schema_field(ceduo_schema_scene(), "options");
    if (ceduo_node_get(app->document.file.root, "options"))
        ceduo_form_table(form, &app->document, options->object, "options", columns, "");
    else
        ceduo_form_note(form, _("One way to treat this wood. a adds another from a preset, y a copy of this one."));
    form->row = app->option + 1; /* below the names of the columns */
}

/* ---- the table ---- */

/* Columns behind the names, as they stand from left to right. */
enum column { TODAY, EVERY, WORST, MEAN, MARK, FAILS, YIELD, LIGHTS, COLUMNS };
static const int widths[COLUMNS] = {
    [TODAY] = 8, [EVERY] = 9, [WORST] = 11, [MEAN] = 9, [MARK] = 6, [FAILS] = 7, [YIELD] = 8, [LIGHTS] = 10};

#define NAME_MIN  22 /* columns that tell the names of most options apart */
#define SPARK_MIN 12
#define SPARK_MAX 60

/* How the table fits its place: names beside the figures or above them, and which columns have room. */
struct layout {
    int lines; /* that an option takes */
    int name;  /* columns of a name */
    int left;  /* where the first figure stands */
    int spark; /* columns of the years at a glance; 0: none */
    int spark_left;
    int lights_left; /* where the lights stand beside the name above the figures; 0: not there */
    bool has[COLUMNS];
};

static int width_of(const struct layout *l)
{
    int width = 0;
    for (int c = 0; c < COLUMNS; c++)
        width += l->has[c] ? widths[c] : 0;
    return width;
}

/* What goes first where there is little room. */
static const enum column dispensable[] = {LIGHTS, YIELD, WORST, MARK, FAILS, EVERY};

static struct layout lay_out(const struct app *app, struct ceduo_area area)
{
    struct layout l = {.lines = 1};
    const struct ceduo_verdict *v = &app->live.verdict;
    for (int c = 0; c < COLUMNS; c++)
        l.has[c] = c != EVERY || (v->wooded && app->live.result->scene->blocks_count > 0);
    int all = width_of(&l), rest = area.width - all;
    bool two_fit = 2 * (int)v->n + 8 <= area.height;
    if (rest < NAME_MIN + SPARK_MIN + 4 && two_fit)
        l.lines = 2;
    for (size_t k = 0; k < sizeof dispensable / sizeof dispensable[0]; k++)
        if (area.width - width_of(&l) < (l.lines == 2 ? 0 : NAME_MIN))
            l.has[dispensable[k]] = false;
    rest = area.width - width_of(&l);
    l.left = area.left + (l.lines == 2 ? 0 : rest);
    if (l.lines == 2) {
        int lights = l.has[LIGHTS] ? 0 : 4;
        l.name = area.width * 3 / 5 < 34 ? area.width - 29 : 34;
        l.spark = area.width - l.name - 1 - lights;
        l.spark = l.spark > SPARK_MAX ? SPARK_MAX : l.spark;
        l.lights_left = lights ? area.left + area.width - 3 : 0;
        l.spark_left = area.left + l.name + 1;
    } else if (rest >= NAME_MIN + SPARK_MIN + 4) {
        l.name = (rest - 2) / 2 > 34 ? 34 : (rest - 2) / 2;
        l.spark = rest - l.name - 2 > SPARK_MAX ? SPARK_MAX : rest - l.name - 2;
        l.spark_left = area.left + l.name + 1;
    } else {
        l.name = rest - 1;
    }
    return l;
}

static void draw_name(struct app *app, int left, int y, int width, size_t i)
{
    enum ceduo_role role = i == app->option ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT;
    for (int x = 0; role == CEDUO_ROLE_CURSOR && x < width; x++)
        ceduo_cells_label(app->cells, left + x, y, role, " ");
    ceduo_plot_put_ends(&app->cells->canvas, left, y, width, role, app->live.result->scene->options[i].name);
}

static void append_share(struct text *text, struct ceduo_portion share)
{
    if (isnan(share.mean))
        ceduo_text_put(text, "\xe2\x80\xa6");
    else if (isnan(share.half))
        ceduo_text_format(text, "%.0f", share.mean * 1000);
    else
        ceduo_text_format(text, "%.0f\xc2\xb1%.0f", share.mean * 1000, ceil(share.half * 1000));
}

static void append_figure(struct text *text, const struct app *app, size_t i, enum column column)
{
    const struct ceduo_verdict *v = &app->live.verdict;
    const struct ceduo_choice *c = &v->choices[i];
    const struct ceduo_index *index = ceduo_result_last_index(app->live.result, i);
    switch (column) {
    case TODAY:
        if (v->wooded)
            append_share(text, c->today);
        else
            ceduo_words_number(text, index->worst_adc, 3);
        break;
    case EVERY: {
        const struct ceduo_arrivals *a = ceduo_result_wooded(app->live.result, i, app->live.result->last_control);
        if (a)
            ceduo_words_every(text, ceduo_hazard_feared(&a->hazard));
        else
            ceduo_text_put(text, "\xe2\x80\xa6");
        break;
    }
    case WORST:
        if (c->years == 0)
            ceduo_text_put(text, "\xe2\x80\xa6");
        else if (v->wooded)
            ceduo_text_format(text, "%.0f (%u)", c->worst.mean * 1000, c->worst_year);
        else
            ceduo_words_number(text, c->worst.mean, 3);
        break;
    case MEAN:
        if (v->wooded)
            append_share(text, c->mean);
        else
            ceduo_words_number(text, index->per_100m * J_TO_KJ, 3);
        break;
    case FAILS:
        if (c->years == 0)
            ceduo_text_put(text, "\xe2\x80\xa6");
        else if (!c->nothing && (!v->wooded || c->energy_known))
            ceduo_text_format(text, "%zu/%zu", v->wooded ? c->too_much : c->no_contact, c->years);
        else
            ceduo_text_char(text, '-');
        break;
    default:
        ceduo_words_number(text, c->yield.cut_per_year, 2);
    }
}

/* "best" for an option that is clearly better than all others over the years, "worst" for one that is worse than
 * all. */
static const char *mark_of(const struct ceduo_verdict *v, size_t i)
{
    if (!v->rotation.known || v->rotation.uneven || v->rotation.rivals + 1 == v->n)
        return "";
    if (i == v->rotation.best)
        return v->rotation.rivals == 0 ? _("best") : "";
    for (size_t k = 0; k < v->n; k++)
        if (k != i && v->choices[k].mean.mean + v->choices[k].mean.half >= v->choices[i].mean.mean - v->choices[i].mean.half)
            return "";
    return _("worst");
}

static void draw_lights(struct app *app, int x, int y, size_t i)
{
    const struct ceduo_index *s = ceduo_result_last_index(app->live.result, i);
    const enum ceduo_light lights[3] = {s->contact, s->free_run, s->energy};
    for (int k = 0; k < 3; k++)
        ceduo_cells_label(app->cells, x + k, y, ceduo_plot_light_role(lights[k]), ceduo_plot_light_mark(lights[k]));
}

static void draw_figure(struct app *app, int x, int y, size_t i, enum column column)
{
    const char *mark = mark_of(&app->live.verdict, i);
    if (column == LIGHTS) {
        draw_lights(app, x + 2, y, i);
        return;
    }
    if (column == MARK) {
        ceduo_cells_label(app->cells, x + 1, y, i == app->live.verdict.rotation.best ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD, mark);
        return;
    }
    struct text text = {0};
    append_figure(&text, app, i, column);
    ceduo_canvas_label_right(&app->cells->canvas, x + widths[column] - 1, y, CEDUO_ROLE_TEXT, ceduo_text_string(&text));
    ceduo_text_free(&text);
}

/* The years at a glance: a column for each, or of several that share one the worst; as high as what gets through. */
static void draw_spark(struct app *app, const struct layout *l, int y, size_t i)
{
    static const char *const levels[2][9] = {{" ", "\xe2\x96\x81", "\xe2\x96\x82", "\xe2\x96\x83", "\xe2\x96\x84",
                                              "\xe2\x96\x85", "\xe2\x96\x86", "\xe2\x96\x87", "\xe2\x96\x88"},
                                             {"0", "1", "2", "3", "4", "5", "6", "7", "8"}};
    const struct ceduo_years *years = ceduo_live_years(&app->live, app->live.result->scene, i);
    if (!years || l->spark == 0 || !app->live.verdict.wooded)
        return;
    int n = (int)years->count, columns = n < l->spark ? n : l->spark;
    for (int x = 0; x < columns; x++) {
        double max = 0;
        for (int k = x * n / columns; k < (x + 1) * n / columns; k++)
            if (years->years[k].wooded.rocks > 0)
                max = fmax(max, ceduo_share_of(&years->years[k].wooded.arrivals[years->last_control]));
        int level = (int)fmin(8, ceil(max * 8));
        ceduo_cells_label(app->cells, l->spark_left + x, y, CEDUO_ROLE_MEAN,
                          levels[app->charset == CEDUO_CHARSET_ASCII][level]);
    }
}

static void draw_row(struct app *app, const struct layout *l, struct ceduo_area area, int y, size_t i)
{
    draw_name(app, area.left, y, l->name, i);
    draw_spark(app, l, y, i);
    if (l->lights_left > 0)
        draw_lights(app, l->lights_left, y, i);
    int x = l->left;
    for (int c = 0; c < COLUMNS; c++)
        if (l->has[c]) {
            draw_figure(app, x, y + l->lines - 1, i, (enum column)c);
            x += widths[c];
        }
}

/* What is counted and where; the name of the place only where there is room. */
static void draw_place(struct app *app, struct ceduo_area area, int width)
{
    const struct ceduo_result *r = app->live.result;
    struct text text = {0};
    if (r->scene->controls_count == 0)
        return;
    const struct ceduo_control *control = &r->scene->controls[r->last_control];
    if (r->wooded && !isnan(control->accepted))
        ceduo_text_format(&text, _("Of 1000 rocks, more than %g kJ at %.6g m"), control->accepted * J_TO_KJ, control->x_given);
    else if (r->wooded)
        ceduo_text_format(&text, _("Of 1000 rocks, those that arrive at %.6g m"), control->x_given);
    else
        ceduo_text_format(&text, _("At %.6g m"), control->x_given);
    size_t before = text.length;
    if (control->name)
        ceduo_text_format(&text, ", %s", control->name);
    if (text.bytes && ceduo_cells_label_width(app->charset, text.bytes) > width)
        text.bytes[before] = '\0';
    ceduo_app_put(app, (struct ceduo_area){area.left, area.top, width, 1}, CEDUO_ROLE_TITLE, &text);
}

static void draw_head(struct app *app, const struct layout *l, struct ceduo_area area)
{
    static const char *const simulated[COLUMNS] = {
        [TODAY] = N_("today"), [EVERY] = N_("every, y"), [WORST] = N_("worst year"),     [MEAN] = N_("rotation"),
        [MARK] = "",           [FAILS] = N_("fail"),     [YIELD] = N_("m\xc2\xb3/ha y"), [LIGHTS] = N_("CFE now")};
    static const char *const by_index[COLUMNS] = {
        [TODAY] = N_("ADC m"), [EVERY] = "",         [WORST] = N_("worst"),          [MEAN] = N_("kJ/100m"),
        [MARK] = "",           [FAILS] = N_("fail"), [YIELD] = N_("m\xc2\xb3/ha y"), [LIGHTS] = N_("CFE now")};
    const struct ceduo_result *r = app->live.result;
    draw_place(app, area, l->lights_left > 0 ? area.width - widths[LIGHTS] : area.width);
    if (l->lights_left > 0)
        ceduo_canvas_label_right(&app->cells->canvas, l->lights_left + 2, area.top, CEDUO_ROLE_TITLE, _("CFE now"));
    int x = l->left;
    for (int c = 0; c < COLUMNS; c++)
        if (l->has[c]) {
            const char *head = _((r->wooded ? simulated : by_index)[c]);
            ceduo_canvas_label_right(&app->cells->canvas, x + widths[c] - 1, area.top + 1, CEDUO_ROLE_TITLE, head);
            x += widths[c];
        }
}

/* ---- what it says ---- */

static void add_sentence(void *context, const char *sentence)
{
    ceduo_text_format(context, "%s\n", sentence);
}

/* Lights that thin shoots alone make green today. */
static void say_thin(const struct ceduo_result *r, struct text *words)
{
    struct text names = {0};
    for (size_t i = 0; i < r->options_count; i++)
        if (ceduo_index_hangs_on_thin(ceduo_result_last_index(r, i)))
            ceduo_text_then(&names, names.length > 0 ? ", " : "", "'%s'", r->scene->options[i].name);
    if (names.length > 0)
        ceduo_text_format(words, _("Counting only stems from %g cm on, contact or free run fails today: %s.\n"),
                          CEDUO_THICK_DBH * 100, ceduo_text_string(&names));
    ceduo_text_free(&names);
}

static void say_verdict(struct app *app, struct text *words)
{
    const struct ceduo_result *r = app->live.result;
    const struct ceduo_verdict *v = &app->live.verdict;
    if (r->scene->blocks_count > 0 && r->scene->controls_count > 0) {
        ceduo_words_hazard(words, r, app->option, r->last_control);
        ceduo_text_char(words, '\n');
    }
    if (v->n < 2) {
        ceduo_text_put(words, _("One way to treat this wood so far. a adds another from a preset, y a copy of this one.\n"));
    } else {
        ceduo_words_best(words, r->scene, v);
        if (words->length > 0)
            ceduo_text_char(words, '\n');
        if ((!v->rotation.known || v->rotation.uneven) && v->wooded)
            ceduo_text_put(words, _("The years of the rotation are being computed.\n"));
        ceduo_words_turned(r, v, add_sentence, words);
    }
    ceduo_words_windows(r->scene, v, add_sentence, words);
    say_thin(r, words);
    if (v->wooded && !v->accepted)
        ceduo_text_put(words, _("What the place withstands is not given (view 3): energy is not judged.\n"));
    if (!r->wooded)
        ceduo_text_put(words, _("Without forest every option sees the same rocks; the index says what stems could take, "
                                "not what a rock loses.\n"));
    const struct years_known *y = app->live.results.years;
    if (app->live.busy && y && y->done < y->n)
        ceduo_text_format(words, _("Computing: %llu rocks in each year, %zu of %zu options done.\n"),
                          (unsigned long long)y->rocks, y->done, y->n);
    else if (app->live.busy)
        ceduo_text_put(words, _("Computing: the figures become finer.\n"));
    if (v->n > 1 && r->wooded && v->accepted)
        ceduo_text_format(words, _("fail: years in which more than %.0f of 1000 bring too much."), CEDUO_EXCEED_MOST * 1000);
    if (v->rotation.known && !v->rotation.uneven) {
        ceduo_text_char(words, ' ');
        ceduo_words_counted(words, v->choices[0].rocks);
    }
}

enum { PANE_TABLE, PANE_COMPARE, PANE_TRADEOFF, PANES };

#define TRADEOFF_MIN 11  /* lines of the picture of protection against yield */
#define COMPARE_MORE 4   /* lines of the picture of the options besides one for each */
#define BESIDE_MIN   128 /* columns that hold the table and a picture beside it */
#define TABLE_WIDTH  84

static void draw_picture(struct app *app, enum ceduo_plot plot, struct ceduo_area area)
{
    struct ceduo_picture p = ceduo_app_picture(app);
    ceduo_plot_draw(plot, &app->cells->canvas, &area, &p);
}

/* The pictures that have room below the table. */
static void draw_below(struct app *app, struct ceduo_area area, bool compare)
{
    int rows = (int)app->live.verdict.n + COMPARE_MORE;
    bool tradeoff = area.height >= TRADEOFF_MIN;
    compare = compare && area.height >= rows + (tradeoff ? TRADEOFF_MIN + 1 : 0);
    if (compare)
        draw_picture(app, CEDUO_PLOT_COMPARE, (struct ceduo_area){area.left, area.top, area.width, rows});
    area.top += compare ? rows + 1 : 0;
    area.height -= compare ? rows + 1 : 0;
    if (tradeoff)
        draw_picture(app, CEDUO_PLOT_TRADEOFF, area);
}

static void draw_table(struct app *app, struct ceduo_area area, bool compare)
{
    size_t n = app->live.verdict.n;
    struct layout l = lay_out(app, area);
    struct text words = {0};
    say_verdict(app, &words);
    int said = ceduo_app_text_lines(app, ceduo_text_string(&words), area.width),
        min = said < area.height / 3 ? said : area.height / 3;
    draw_head(app, &l, area);
    int room = (area.height - 2 - min) / l.lines;
    int top = (int)app->option >= room ? (int)app->option - room + 1 : 0;
    int y = area.top + 2;
    for (int i = 0; i < room && (size_t)(top + i) < n; i++, y += l.lines)
        draw_row(app, &l, area, y, (size_t)(top + i));
    int rest = area.top + area.height - y;
    bool gap = rest > said;
    struct ceduo_area below = {area.left, y + gap, area.width, rest - gap};
    ceduo_app_put(app, below, CEDUO_ROLE_TEXT, &words);
    if (n > 1)
        draw_below(app, (struct ceduo_area){area.left, y + gap + said + 1, area.width, rest - gap - said - 1}, compare);
}

/* The table with the pictures that have room beside and below it, or one picture alone. */
static void draw(struct app *app, struct ceduo_area area)
{
    int pane = ceduo_app_state(app)->pane;
    bool beside = area.width >= BESIDE_MIN && app->live.verdict.n > 1;
    if (pane != PANE_TABLE) {
        if (!app->message[0])
            ceduo_app_say(app, "%s",
                          pane == PANE_COMPARE ? _("Tab: protection against yield; up, down: another option")
                                               : _("Tab: back to the table; up, down: another option"));
        draw_picture(app, pane == PANE_COMPARE ? CEDUO_PLOT_COMPARE : CEDUO_PLOT_TRADEOFF, area);
        return;
    }
    struct ceduo_area table = {area.left, area.top, beside ? TABLE_WIDTH : area.width, area.height};
    draw_table(app, table, !beside);
    if (beside)
        draw_picture(app, CEDUO_PLOT_COMPARE,
                     (struct ceduo_area){area.left + TABLE_WIDTH + 2, area.top, area.width - TABLE_WIDTH - 2, area.height});
}

static void choose(struct app *app, long i)
{
    long n = (long)app->document.file.scene.options_count;
    ceduo_app_show_option(app, (size_t)(i < 0 ? 0 : i >= n ? n - 1 : i));
}

static void next_option(struct app *app, int by)
{
    choose(app, (long)app->option + by);
}

static void add_option(struct app *app, int unused)
{
    (void)unused;
    ceduo_popup_new_option(app);
}

static void copy_option(struct app *app, int unused)
{
    (void)unused;
    size_t at = app->option;
    if (ceduo_app_edited(app, ceduo_document_copy_option(&app->document, at, &app->problems)))
        choose(app, (long)at + 1);
}

static void delete_option(struct app *app, int unused)
{
    (void)unused;
    const char *path = ceduo_app_format(app, "options[%zu]", app->option);
    const char *name = ceduo_app_format(app, "%s", ceduo_app_option(app)->name);
    if (app->document.file.scene.options_count < 2)
        ceduo_app_say(app, "%s", _("the only option stays"));
    else if (ceduo_app_edited(app, ceduo_document_delete(&app->document, path, &app->problems)))
        ceduo_app_say(app, _("deleted '%s'; u brings it back"), name);
}

static void move_option(struct app *app, int by)
{
    long to = (long)app->option + by;
    if (to < 0 || to >= (long)app->document.file.scene.options_count)
        return;
    bool good = ceduo_document_move(&app->document, "options", app->option, (size_t)to, &app->problems);
    if (ceduo_app_edited(app, good))
        choose(app, to);
}

static bool filled_name(struct app *app, struct popup *p)
{
    return ceduo_app_edited(app, ceduo_document_rename_option(&app->document, app->option, p->fields[0].text, &app->problems));
}

static void rename_option(struct app *app, int unused)
{
    (void)unused;
    if (ceduo_node_get(app->document.file.root, "options"))
        ceduo_popup_field(ceduo_popup_fields(app, _("Name of this option"), filled_name), _("name"),
                          ceduo_app_option(app)->name);
}

static const struct act acts[] = {{ACTION_UP, next_option, -1},
                                  {ACTION_DOWN, next_option, 1},
                                  {ACTION_TOP, next_option, -1000000},
                                  {ACTION_BOTTOM, next_option, 1000000},
                                  {ACTION_ADD, add_option, 0},
                                  {ACTION_DUPLICATE, copy_option, 0},
                                  {ACTION_DELETE, delete_option, 0},
                                  {ACTION_EARLIER, move_option, -1},
                                  {ACTION_LATER, move_option, 1},
                                  {ACTION_EDIT, rename_option, 0},
                                  {0}};

const struct view ceduo_view_compare = {.title = NP_("view", "compare"),
                                        .panes = PANES,
                                        .years = true,
                                        .result = true,
                                        .build = build,
                                        .draw = draw,
                                        .acts = {acts, acts, acts},
                                        .bar = {{ACTION_ADD, N_("add")},
                                                {ACTION_NEXT_PANE, N_("picture")},
                                                {ACTION_DUPLICATE, N_("copy")},
                                                {ACTION_DELETE, N_("delete")},
                                                {ACTION_EDIT, N_("name")}}};
