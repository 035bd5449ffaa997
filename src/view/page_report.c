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

static void add_picture(struct ceduo_page *page, enum ceduo_plot plot, int columns, int rows,
                        const struct ceduo_picture *picture, const char *description)
{
    struct ceduo_svg *svg = ceduo_svg_create(columns, rows);
    struct ceduo_area area = {.width = columns, .height = rows};
    ceduo_plot_draw(plot, ceduo_svg_canvas(svg), &area, picture);
    struct ceduo_page_block *block = ceduo_page_picture(page, svg, columns == HALF_CELLS);
    ceduo_plot_title(&block->text, plot, picture);
    ceduo_text_append(&block->description, description);
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
                                  .year = SIZE_MAX};
}

/* True if the scene would exceed four pages; sections that other commands show are dropped. */
static bool is_crowded(const struct ceduo_report *report)
{
    return ceduo_report_has_hazard(report) && report->result->scene->options_count > CROWDED_OPTIONS;
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
    ceduo_text_append(text, _("Some inputs are uncertain."));
    if (r->scene->options_count > 1)
        ceduo_text_append_joined(text, " ",
                                 _("With '%s', in nine of ten plausible cases, %.0f to %.0f of 1000 rocks %s today."),
                                 r->scene->options[option].name, m.p5, m.p95, phrase);
    else
        ceduo_text_append_joined(text, " ", _("In nine of ten plausible cases, %.0f to %.0f of 1000 rocks %s today."), m.p5,
                                 m.p95, phrase);
    if (o.over_years && o.uncertain && r->scene->blocks_count == 0)
        ceduo_text_append_joined(text, " ", _("The limit is exceeded in %.0f to %.0f of the next %zu years."), o.failing_lo,
                                 o.failing_hi, report->verdict->choices[option].last_summary->years);
    if (o.answer == CEDUO_JUDGEMENT_DEPENDS)
        ceduo_text_append_joined(text, " ", "%s",
                                 _("Some of these cases keep within the limit and some do not: the answer depends on "
                                   "uncertain inputs."));
    else if (o.answer == CEDUO_JUDGEMENT_YES || o.answer == CEDUO_JUDGEMENT_NO)
        ceduo_text_append_joined(text, " ", "%s", _("The answer is the same in all of these cases."));
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

#define SLOPE_ROWS 19
#define SLOPE_MIN  12 /* if tables of several options follow */
#define STRIP_ROWS 10

static void add_slope(struct ceduo_page *page, const struct ceduo_report *report)
{
    struct ceduo_picture picture = make_picture(report, ceduo_result_best(report->result, report->verdict));
    size_t options = report->result->scene->options_count;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("The slope and the rocks"));
    ceduo_page_facts(page, report);
    add_picture(page, CEDUO_PLOT_PROFILE, FULL_CELLS, options > 1 ? SLOPE_MIN : SLOPE_ROWS, &picture,
                _("Side view of the slope with the forest. Thin lines: trajectories of some rocks. Upright lines: controls."));
    picture.trajectories = true;
    if (report->snapshot && !is_crowded(report))
        add_picture(page, CEDUO_PLOT_HEIGHT, FULL_CELLS, STRIP_ROWS, &picture,
                    _("Height above ground of the same trajectories along the slope, with the median and the 95th percentile, "
                      "with and without forest."));
    if (report->snapshot && report->result->scene->controls_count > 0 && options == 1)
        add_picture(page, CEDUO_PLOT_ENERGY, FULL_CELLS, STRIP_ROWS, &picture,
                    _("Mean and 95th percentile of the energy of passing rocks along the slope, with and without forest."));
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
        ceduo_page_percentiles(page, r, option, k, true);
        ceduo_page_fence(page, report, option, k);
        ceduo_page_design(page, report, option, k);
    }
}

#define YEARS_ROWS 10

/* Append the option that is best over the years. */
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
    if (scene->options_count > 1)
        ceduo_page_para(page, CEDUO_PAGE_PLACE, "%s", scene->options[option].name);
    ceduo_page_years_words(page, report->result, report->years_ahead[option]);
    if (is_crowded(report))
        return;
    ceduo_page_para(page, CEDUO_PAGE_DETAIL, "%s",
                    _("In the picture C, F and E stand for the tests of contact, of free runs and of energy."));
    size_t yields = 0;
    for (size_t i = 0; i < v->n; i++)
        yields += v->choices[i].yield.cut_per_year > 0;
    bool both = yields > 1;
    if (both)
        ceduo_page_para(page, CEDUO_PAGE_DETAIL, "%s",
                        _("Numbers beside points stand for the options in the order of the tables."));
    add_picture(page, CEDUO_PLOT_ROTATION, both ? HALF_CELLS : FULL_CELLS, YEARS_ROWS, &picture,
                _("Two curves over the years after a cut, the average distance between contacts and how many of 1000 rocks "
                  "arrive with too much energy, and below them which tests each year passes."));
    if (both)
        add_picture(page, CEDUO_PLOT_TRADEOFF, HALF_CELLS, YEARS_ROWS, &picture,
                    _("A point for each option. To the right: volume felled per hectare and year. Upwards: rocks that pass."));
}

static void add_limits(struct ceduo_page *page, const struct ceduo_result *result)
{
    static const char *const limits[] = {
        N_("The model is two-dimensional: lateral motion is ignored."),
        N_("Each rock finds the forest undamaged; rocks do not break, and do not hit each other."),
        N_("Shrubs, falling trees, air drag and soil deformation are ignored. A stem is a cylinder with the diameter of its "
           "dbh."),
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
    ceduo_page_question(page, report->result);
    ceduo_page_answer(page, report);
    add_uncertainty(page, report);
    ceduo_page_certainty(page, report);
    ceduo_page_over_time(page, report);
    ceduo_page_fence_answer(page, report, false);
    add_slope(page, report);
    add_option_percentiles(page, report);
    if (several && controls) {
        struct ceduo_picture picture = make_picture(report, 0);
        ceduo_page_comparison(page, report);
        if (!ceduo_report_has_hazard(report) &&
            scene->options_count <= CROWDED_OPTIONS) /* the table of frequencies replaces it */
            add_picture(page, CEDUO_PLOT_COMPARE, WIDE_CELLS, 2 + (int)scene->options_count, &picture,
                        _("Bars for each option: its average distance between contacts, how many of 1000 rocks arrive with too "
                          "much energy, and their mean energy."));
    } else if (!several) {
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("Through the forest, and without it"));
        ceduo_page_option(page, report, 0, true);
    }
    if (controls && !is_crowded(report))
        ceduo_page_laws(page, report);
    if (report->snapshot && controls && !is_crowded(report) &&
        ceduo_fence_stands(&scene->controls[report->result->last_control].fence)) {
        struct ceduo_picture picture = make_picture(report, 0);
        add_picture(
            page, CEDUO_PLOT_FENCE, FULL_CELLS, HAZARD_ROWS, &picture,
            _("Rocks of 1000 that defeat a fence of this height, by the class of the fence, without forest and for each "
              "option."));
    }
    if (controls) {
        if (report->uncertainty && report->uncertainty->answer)
            ceduo_uncertainty_blocks(page, report->uncertainty, scene->options_count <= CROWDED_OPTIONS);
        add_years(page, report);
        add_hazard(page, report);
    }
    if (several)
        ceduo_page_rules(page, report->result);
    ceduo_page_notes(page, report);
    for (size_t i = 0; several && i < scene->options_count; i++)
        ceduo_page_stand_warnings(page, report->result, i);
    add_limits(page, report->result);
    if (scene->options_count > CROWDED_OPTIONS)
        ceduo_page_note(
            page, _("Left out of this long page: the output of 'ceduo --batch', 'ceduo --plot' and 'ceduo --sensitivity'."));
    add_origin(page, report);
}
