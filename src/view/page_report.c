/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chapter of the report: blocks of the terminal page with pictures between them. */

#include <string.h>

#include "base/language.h"
#include "io/node.h"
#include "page_parts.h"
#include "plot.h"
#include "scene/derived.h"
#include "svg.h"

/* ---- pictures ---- */

#define FULL_CELLS      92  /* cells of a picture of full width */
#define HALF_CELLS      46  /* cells of a picture of half width */
#define WIDE_CELLS      112 /* cells of a wide picture with few rows */
#define CROWDED_OPTIONS 4   /* max options of a page with all pictures */
#define HEIGHT_ROWS     6   /* rows of the strip of heights below the slope */
#define ENERGY_ROWS     8   /* rows of the strip of energies with the axis */
#define PROFILE_ROWS    24  /* rows of the slope above the strips, */
#define PAIR_ROWS       18  /* and of two slopes next to each other, */
#define CROWDED_ROWS    12  /* also above the table of many options */
#define FENCE_ROWS      3   /* rows that the sentences on a fence take from the slope */

static void add_picture(struct ceduo_page *page, enum ceduo_plot plot, int columns, int rows,
                        const struct ceduo_picture *picture, const char *description)
{
    struct ceduo_svg *svg = ceduo_svg_create(columns, rows);
    struct ceduo_area area = {.width = columns - 1, .height = rows}; /* a browser's sign may be wider than a cell */
    ceduo_plot_draw(plot, ceduo_svg_canvas(svg), &area, picture);
    struct ceduo_page_block *block = ceduo_page_picture(page, svg, columns == HALF_CELLS);
    ceduo_plot_title(&block->text, plot, picture);
    ceduo_text_append(&block->description, description);
}

/* Append one picture of the slope with its trajectories and, if they are known, the heights and energies of the rocks below
 * it, on one axis. */
static void add_slope_picture(struct ceduo_page *page, struct ceduo_picture picture, const char *title, int columns, int rows)
{
    struct ceduo_svg *svg = ceduo_svg_create(columns, rows);
    struct ceduo_canvas *canvas = ceduo_svg_canvas(svg);
    struct ceduo_span span = {0};
    int strips = picture.snapshot ? HEIGHT_ROWS + ENERGY_ROWS : 0;
    struct ceduo_area area = {.width = columns, .height = rows - strips};
    picture.paper = true;
    picture.span = &span;
    picture.no_x_axis = strips > 0;
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, canvas, &area, &picture);
    picture.trajectories = columns == FULL_CELLS; /* in a smaller picture they would hide the curves */
    area = (struct ceduo_area){.top = rows - strips, .width = columns, .height = HEIGHT_ROWS};
    if (strips > 0 && span.width > 0)
        ceduo_plot_draw(CEDUO_PLOT_HEIGHT, canvas, &area, &picture);
    picture.no_x_axis = false;
    area = (struct ceduo_area){.top = rows - ENERGY_ROWS, .width = columns, .height = ENERGY_ROWS};
    if (strips > 0 && span.width > 0)
        ceduo_plot_draw(CEDUO_PLOT_ENERGY, canvas, &area, &picture);
    struct ceduo_page_block *block = ceduo_page_picture(page, svg, columns == HALF_CELLS);
    ceduo_text_append(&block->text, title);
    ceduo_text_append(&block->description,
                      _("Side view of the slope with the forest, and below it on the same axis the height of the rocks above "
                        "the ground and their energy, with and without forest. Thin lines: trajectories of some rocks. "
                        "Upright lines: controls."));
}

static struct ceduo_picture make_picture(const struct ceduo_report *report, size_t option)
{
    const struct ceduo_result *r = report->result;
    return (struct ceduo_picture){.scene = r->scene,
                                  .snapshot = report->snapshot,
                                  .verdict = report->verdict,
                                  .option = option,
                                  .control = ceduo_scene_last_control(r->scene),
                                  .years = report->years_ahead ? report->years_ahead[option] : NULL,
                                  .years_of_options = report->years_ahead,
                                  .year = SIZE_MAX};
}

/* True if the scene would exceed four pages; sections that other commands show are dropped. */
static bool is_crowded(const struct ceduo_report *report)
{
    return ceduo_report_has_hazard(report) && report->result->scene->options_count > CROWDED_OPTIONS;
}

/* True if the page has no space for the uncertainty over the years. */
static bool is_long(const struct ceduo_report *report)
{
    size_t options = report->result->scene->options_count;
    return options > CROWDED_OPTIONS || (options > 1 && ceduo_report_has_hazard(report));
}

/* ---- sections ---- */

/* Append the effect of uncertain inputs on the answer, for the best option. */
static void add_uncertainty(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    if (r->scene->controls_count == 0 || !r->wooded || ceduo_page_is_unassessable(r))
        return;
    const struct ceduo_uncertainty_report *uncertainty = report->uncertainty;
    const struct ceduo_control *place = &r->scene->controls[r->last_control];
    bool several = r->scene->options_count > 1;
    size_t option = ceduo_result_best(r, report->verdict);
    const struct ceduo_outcome o = ceduo_report_outcome(report, option, r->last_control);
    struct ceduo_measure m = ceduo_measure_exceeding(place, NULL); /* NaN value: the range is not widened */
    ceduo_measure_uncertainty(&m, uncertainty, option, r->last_control);
    if (isnan(m.p5)) {
        if (!uncertainty || ceduo_uncertainty_is_off(uncertainty) || !uncertainty->inputs || uncertainty->inputs->n > 0)
            ceduo_page_para(page, CEDUO_PAGE_ANSWER, "%s",
                            _("Uncertainty was not computed. The answer assumes that the scene is exact."));
        return;
    }
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_ANSWER);
    const char *phrase = MEASURE_NAME(m, CEDUO_PHRASE);
    if (several)
        ceduo_text_append_joined(text, "", _("With '%s', in nine of ten plausible cases, %.0f to %.0f of 1000 rocks %s today."),
                                 r->scene->options[option].name, m.p5, m.p95, phrase);
    else
        ceduo_text_append_joined(text, "", _("In nine of ten plausible cases, %.0f to %.0f of 1000 rocks %s today."), m.p5,
                                 m.p95, phrase);
    if (!several && o.over_years && o.uncertain && r->scene->blocks_count == 0)
        ceduo_text_append_joined(text, " ", _("The limit is exceeded in %.0f to %.0f of the next %zu years."), o.failing_lo,
                                 o.failing_hi, report->verdict->choices[option].last_summary->years);
    if (!several && o.answer == CEDUO_JUDGEMENT_DEPENDS) /* with several options it is in the first sentence */
        ceduo_text_append_joined(text, " ", "%s",
                                 _("Some of these cases keep within the limit and some do not: the answer depends on "
                                   "uncertain inputs."));
    else if (o.answer == CEDUO_JUDGEMENT_YES || o.answer == CEDUO_JUDGEMENT_NO)
        ceduo_text_append_joined(text, " ", "%s", _("The answer is the same in all of these cases."));
}

#define HEADLINE 66 /* max columns of an answer above other sentences */

/* Append the answer of the best of several options. */
static void add_headline(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t best = ceduo_result_best(r, report->verdict);
    LOCAL_TEXT(answer);
    if (r->scene->options_count < 2 || ceduo_page_is_unassessable(r) || !r->wooded || !report->verdict)
        return;
    const struct ceduo_subject s = ceduo_subject_find(report, best, r->last_control);
    if (s.outcome.answer == CEDUO_JUDGEMENT_UNANSWERED)
        return;
    ceduo_words_answer(&answer, &s, HEADLINE);
    ceduo_page_para(page, CEDUO_PAGE_ANSWER, _("%s, with the best option, '%s'"), ceduo_text_string(&answer),
                    r->scene->options[best].name);
}

/* Give the box of the answer its role. */
static void colour_answer(const struct ceduo_page *page, const struct ceduo_report *report)
{
    static const enum ceduo_role roles[] = {[CEDUO_JUDGEMENT_YES] = CEDUO_ROLE_GOOD,
                                            [CEDUO_JUDGEMENT_NO] = CEDUO_ROLE_BAD,
                                            [CEDUO_JUDGEMENT_NOT_DECIDED] = CEDUO_ROLE_WARN,
                                            [CEDUO_JUDGEMENT_DEPENDS] = CEDUO_ROLE_WARN};
    const struct ceduo_result *r = report->result;
    if (r->scene->controls_count == 0)
        return;
    enum ceduo_judgement answer = ceduo_report_outcome(report, ceduo_result_best(r, report->verdict), r->last_control).answer;
    for (struct ceduo_page_block *b = page->first; b; b = b->next)
        if (b->kind == CEDUO_PAGE_ANSWER && answer < sizeof roles / sizeof roles[0])
            b->role = roles[answer];
}

/* Append the head of the scene. Date and signature are always present. */
static void add_head(struct ceduo_page *page, const struct ceduo_report_head *head)
{
    const char *const lines[][2] = {{_("Place"), head->place},   {_("Owner"), head->owner}, {_("Parcel"), head->parcel},
                                    {_("Author"), head->author}, {_("Note"), head->note},   {_("Date"), head->date},
                                    {_("Signature"), NULL}};
    for (size_t i = 0, n = sizeof lines / sizeof lines[0]; i < n; i++)
        if (i + 2 >= n || (lines[i][1] && lines[i][1][0]))
            ceduo_text_append(ceduo_page_item(page, CEDUO_PAGE_HEAD, lines[i][0]), lines[i][1] ? lines[i][1] : "");
}

/* True if a fence stands at the last control. */
static bool has_fence(const struct ceduo_report *report)
{
    const struct ceduo_scene *scene = report->result->scene;
    return scene->controls_count > 0 && ceduo_fence_stands(&scene->controls[report->result->last_control].fence);
}

/* Append the slope with the best option, and next to it the present one, which is the first. */
static void add_slope(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_scene *scene = report->result->scene;
    const size_t present = 0, best = ceduo_result_best(report->result, report->verdict);
    bool pair = best != present;
    int columns = pair ? HALF_CELLS : FULL_CELLS;
    int profile = scene->options_count > CROWDED_OPTIONS ? CROWDED_ROWS : pair ? PAIR_ROWS : PROFILE_ROWS;
    int rows = profile + HEIGHT_ROWS + ENERGY_ROWS - (has_fence(report) ? FENCE_ROWS : 0);
    struct ceduo_picture picture = make_picture(report, best);
    LOCAL_TEXT(title);
    if (scene->options_count < 2)
        ceduo_plot_title(&title, CEDUO_PLOT_PROFILE, &picture);
    else
        ceduo_text_format(&title, pair ? _("Recommended: %s") : _("Recommended, and present: %s"), scene->options[best].name);
    picture.compared = pair ? &present : NULL;
    add_slope_picture(page, picture, ceduo_text_string(&title), columns, rows);
    if (!pair)
        return;
    picture = make_picture(report, present);
    picture.compared = &best;
    ceduo_text_cut(&title, 0);
    ceduo_text_format(&title, _("Present: %s"), scene->options[present].name);
    add_slope_picture(page, picture, title.bytes, columns, rows);
}

/* Append percentiles of the drawn option. A single option has them with its other figures. */
static void add_option_percentiles(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t option = ceduo_result_best(report->result, report->verdict);
    if (r->scene->options_count < 2 || r->bare.rocks == 0)
        return;
    for (size_t k = is_crowded(report) ? r->last_control : 0; k < r->scene->controls_count; k++) {
        LOCAL_TEXT(place);
        ceduo_words_place(&place, &r->scene->controls[k]);
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_PLACE), _("At %s, with '%s'"), ceduo_text_string(&place),
                          r->scene->options[option].name);
        if (!is_crowded(report))
            ceduo_page_percentiles(page, r, option, k, true);
        ceduo_page_fence(page, report, option, k);
        ceduo_page_design(page, report, option, k);
    }
}

#define YEARS_ROWS 10
#define PANEL_ROWS 8 /* rows of the years of an option */

/* Append the years: of one option, or of all options on one scale. */
static void add_years(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_verdict *v = report->verdict;
    size_t option = v && v->rotation.known ? v->rotation.best : ceduo_result_best(report->result, report->verdict);
    if (!v || option >= v->n || v->choices[option].window.kind == CEDUO_WINDOW_CONSTANT || !report->years_ahead ||
        !report->years_ahead[option] || report->years_ahead[option]->count < 2) /* all years are equal */
        return;
    struct ceduo_picture picture = make_picture(report, option);
    const struct ceduo_scene *scene = report->result->scene;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("Year by year"));
    if (report->result->wooded)
        add_picture(page, CEDUO_PLOT_YEARS, WIDE_CELLS, 2 + PANEL_ROWS * ceduo_plot_years_down(scene->options_count), &picture,
                    _("For each option a curve over the years: how many of 1000 rocks arrive with too much energy. Triangles "
                      "are cuts. The dashed line is the limit."));
    if (scene->options_count < 2) /* several options have tables */
        ceduo_page_years_words(page, report->result, report->years_ahead[option]);
    size_t yields = 0;
    for (size_t i = 0; i < v->n; i++)
        yields += v->choices[i].yield.cut_per_year > 0;
    if (!report->result->wooded) {
        ceduo_page_para(page, CEDUO_PAGE_DETAIL, "%s",
                        _("In the picture C, F and E stand for the tests of contact, of free runs and of energy."));
        add_picture(page, CEDUO_PLOT_ROTATION, FULL_CELLS, YEARS_ROWS, &picture,
                    _("Two curves over the years after a cut, the average distance between contacts and how many of 1000 "
                      "rocks arrive with too much energy, and below them which tests each year passes."));
    } else if (yields > 1 && !ceduo_report_has_hazard(report)) { /* tables of frequencies need its space */
        add_picture(page, CEDUO_PLOT_TRADEOFF, WIDE_CELLS, YEARS_ROWS, &picture,
                    _("A point for each option. To the right: volume felled per hectare and year. Upwards: rocks that pass."));
    }
}

/* True if two warnings of stands are equal, apart from the stand and the numbers. */
static bool is_like_warning(const char *a, const char *b)
{
    static const char *const number = "0123456789.,";
    const char *p = strstr(a, ": "), *q = strstr(b, ": ");
    while (p && q && *p && *p == *q) {
        p += 1 + strspn(p + 1, number);
        q += 1 + strspn(q + 1, number);
    }
    return p && q && *p == *q;
}

/* Append the warnings of all stands. Like ones are one sentence with the names of the other stands. */
static void add_stand_warnings(struct ceduo_page *page, const struct ceduo_result *r)
{
    LOCAL_PAGE(all, page->width);
    for (size_t i = 0; i < r->scene->options_count; i++)
        ceduo_page_stand_warnings(&all, r, i);
    for (const struct ceduo_page_block *b = all.first; b; b = b->next) {
        const struct ceduo_page_block *a = all.first;
        while (a != b && !is_like_warning(a->text.bytes, b->text.bytes))
            a = a->next;
        if (a != b)
            continue;
        LOCAL_TEXT(names);
        for (a = b->next; a; a = a->next)
            if (is_like_warning(a->text.bytes, b->text.bytes)) {
                ceduo_text_append(&names, names.length > 0 ? "; " : "");
                ceduo_text_append_n(&names, a->text.bytes, (size_t)(strstr(a->text.bytes, ": ") - a->text.bytes));
            }
        ceduo_page_para(page, CEDUO_PAGE_WARNING, "%s", b->text.bytes);
        if (names.length > 0)
            ceduo_text_append_joined(&page->last->text, " ", _("Likewise: %s."), names.bytes);
    }
}

static void add_limits(struct ceduo_page *page, const struct ceduo_result *result)
{
    static const char *const limits[] = {
        N_("The model is two-dimensional: lateral motion is ignored."),
        N_("Each rock finds the forest undamaged; rocks do not break, and do not hit each other."),
        N_("Shrubs, falling trees, air drag and soil deformation are ignored. A stem is a cylinder with its dbh."),
        N_("The energy that a stem absorbs was measured on few species. For thin stems it is the largest uncertainty."),
        N_("A coppice cannot guarantee to stop a rock. If people may be hurt, an engineer must judge the site.")};
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("Limits of the model"));
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++)
        ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s", _(limits[i]));
    ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s",
                    result->scene->blocks_count > 0
                        ? _("The frequency of blocks is that of the scene. A survey of the cliff and of the blocks at its foot "
                            "must confirm it.")
                        : _("Shares refer to falling rocks, not to years. A survey of the cliff is needed for frequencies."));
}

/* Copy the tree without the texts of sources: they fill a page, and no figure depends on them. */
static const struct node *remove_source_texts(struct arena *arena, const struct node *node)
{
    bool source = node->key && strcmp(node->key, "source") == 0;
    const struct node *plain = node;
    if (source)
        plain = ceduo_node_without(arena, ceduo_node_without(arena, node, "text"), "text_it");
    for (size_t i = 0; !source && i < node->n; i++)
        plain = ceduo_node_replaced(arena, plain, i, remove_source_texts(arena, node->items[i]));
    return plain;
}

static void add_origin(struct ceduo_page *page, const struct ceduo_report *report)
{
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("How to reproduce this page"));
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_FACT, _("Program")), "ceduo %s", CEDUO_VERSION);
    ceduo_page_para(page, CEDUO_PAGE_SENTENCE, "%s",
                    report->reproducible ? _("This command gives the same page, to the last byte:")
                                         : _("This command reproduces the page:"));
    ceduo_page_para(page, CEDUO_PAGE_CODE, "%s", report->command);
    ceduo_page_para(page, CEDUO_PAGE_SENTENCE, "%s", _("The scene file, without the texts of sources:"));
    /* includes changes of the command line, and references to files */
    struct arena arena = {0};
    const struct node *root = ceduo_emit_restore_references(&arena, report->file->root);
    ceduo_emit(ceduo_page_add(page, CEDUO_PAGE_CODE), remove_source_texts(&arena, root));
    ceduo_arena_free(&arena);
}

#define HAZARD_ROWS 9

/* Append frequencies at each control, and curves at the last one. */
static void add_hazard(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_scene *scene = report->result->scene;
    struct ceduo_picture picture = make_picture(report, ceduo_result_best(report->result, report->verdict));
    if (!ceduo_report_has_hazard(report))
        return;
    size_t first = is_crowded(report) ? picture.control : 0;
    for (size_t k = first; k < scene->controls_count; k++)
        ceduo_page_hazard(page, report, k, k == first);
    if (is_crowded(report))
        return;
    add_picture(page, CEDUO_PLOT_HAZARD, FULL_CELLS, HAZARD_ROWS, &picture,
                _("Return period over energy, without forest and for each option. Lines mark 30 and 300 kJ, and 30, 100 and "
                  "300 years."));
}

void ceduo_page_chapter(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_scene *scene = report->result->scene;
    bool controls = scene->controls_count > 0, several = scene->options_count > 1;
    ceduo_page_para(page, CEDUO_PAGE_TITLE, "%s", ceduo_in_language(scene->title, scene->title_it));
    add_head(page, &scene->page);
    ceduo_page_question(page, report);
    add_headline(page, report);
    ceduo_page_answer(page, report);
    add_uncertainty(page, report);
    colour_answer(page, report);
    ceduo_page_certainty(page, report);
    ceduo_page_over_time(page, report);
    ceduo_page_fence_answer(page, report, false);
    add_slope(page, report);
    size_t best = ceduo_result_best(report->result, report->verdict);
    if (several && controls && !ceduo_page_is_unassessable(report->result)) {
        ceduo_page_shares(page, report, true);
        ceduo_page_options(page, report, CEDUO_OPTIONS_SHORT, report->result->last_control, best, 0, SIZE_MAX);
    }
    if (controls) {
        add_years(page, report);
        if (!is_crowded(report))
            ceduo_page_energies(page, report, best);
    }
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("The slope and the rocks"));
    ceduo_page_facts(page, report);
    add_option_percentiles(page, report);
    if (several && controls) {
        struct ceduo_picture picture = make_picture(report, best);
        picture.option = SIZE_MAX; /* no row is reversed, as under a cursor */
        ceduo_page_comparison(page, report, is_crowded(report) ? CEDUO_COMPARE_WORDS : CEDUO_COMPARE_REST);
        /* the years of all options or the table of frequencies replace it */
        if (!ceduo_report_years_ahead(report, 0) && !ceduo_report_has_hazard(report) && scene->options_count <= CROWDED_OPTIONS)
            add_picture(page, CEDUO_PLOT_COMPARE, WIDE_CELLS, 2 + (int)scene->options_count, &picture,
                        _("Bars for each option: its average distance between contacts, how many of 1000 rocks arrive with too "
                          "much energy, and their mean energy."));
    } else if (!several) {
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("Through the forest, and without it"));
        ceduo_page_option(page, report, 0, true);
    }
    if (controls && !is_crowded(report))
        ceduo_page_laws(page, report);
    if (report->snapshot && !is_crowded(report) && has_fence(report)) {
        struct ceduo_picture picture = make_picture(report, 0);
        add_picture(
            page, CEDUO_PLOT_FENCE, FULL_CELLS, HAZARD_ROWS, &picture,
            _("Rocks of 1000 that defeat a fence of this height, by the class of the fence, without forest and for each "
              "option."));
    }
    if (controls) {
        if (report->uncertainty && report->uncertainty->answer)
            ceduo_uncertainty_blocks(page, report->uncertainty, !is_long(report));
        add_hazard(page, report);
    }
    if (several)
        ceduo_page_rules(page, report->result);
    ceduo_page_notes(page, report);
    if (several)
        add_stand_warnings(page, report->result);
    add_limits(page, report->result);
    if (is_long(report))
        ceduo_page_note(
            page, _("Left out of this long page: the output of 'ceduo --batch', 'ceduo --plot' and 'ceduo --sensitivity'."));
    add_origin(page, report);
}
