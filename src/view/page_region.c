/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A region: many lines of one scene on one page. Answers by class, rocks a year of all lines together, the worst lines, and the
 * lines that were not judged. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "page_parts.h"
#include "svg.h"

#define CLASSES (CEDUO_CLASS_NOT_JUDGED + 1)

static const char *const class_names[CLASSES] = {
    N_("not reached"), N_("yes, also without forest"), N_("yes"), N_("open"), N_("no"), N_("not judged")};
static const enum ceduo_role class_roles[CLASSES] = {CEDUO_ROLE_BARE, CEDUO_ROLE_GOOD, CEDUO_ROLE_GOOD,
                                                     CEDUO_ROLE_WARN, CEDUO_ROLE_BAD,  CEDUO_ROLE_DIM};

/* An option on a line, at the last control. */
struct line_answer {
    enum ceduo_class class;
    const char *why;      /* NULL: no answer, because the control has no accepted energy or no rock was simulated */
    double share;         /* judged share today; NaN: unknown */
    double reach, exceed; /* rocks a year; NaN: the scene has no blocks, or the control no accepted energy */
};

struct ceduo_region_line {
    const char *name, *reason; /* reason of the failure; NULL: none */
    size_t number;             /* in the order of addition */
    size_t scene;              /* given by the caller */
    struct line_answer *answers;
};

/* ---- collection ---- */

static const char *copy_string(struct ceduo_region *r, const char *string)
{
    return ceduo_check_memory(ceduo_arena_string(&r->arena, string));
}

static struct ceduo_region_line *add_line(struct ceduo_region *r, const char *name, size_t scene)
{
    r->lines = ceduo_check_memory(ceduo_grow(r->lines, r->count, &r->capacity, sizeof *r->lines));
    r->lines[r->count] = (struct ceduo_region_line){.name = copy_string(r, name), .number = r->count, .scene = scene};
    return &r->lines[r->count++];
}

void ceduo_region_add_failed(struct ceduo_region *r, const char *name, size_t scene, const char *reason)
{
    add_line(r, name, scene)->reason = copy_string(r, reason);
    r->failed++;
}

void ceduo_region_add(struct ceduo_region *r, const struct ceduo_report *report, const char *name, size_t scene)
{
    const struct ceduo_result *result = report->result;
    const struct ceduo_scene *s = result->scene;
    if (s->controls_count == 0 || (r->options && r->options_count != s->options_count)) {
        ceduo_region_add_failed(r, name, scene, _("it has other options than the first line"));
        return;
    }
    struct ceduo_region_line *line = add_line(r, name, scene);
    if (!r->options) {
        const struct ceduo_control *c = last_control(result);
        r->title = copy_string(r, ceduo_in_language(s->title, s->title_it));
        r->place = c->name ? copy_string(r, c->name) : NULL;
        r->accepted = c->accepted;
        r->options_count = s->options_count;
        r->options = ceduo_check_memory(ceduo_arena_alloc(&r->arena, s->options_count * sizeof *r->options));
        for (size_t i = 0; i < s->options_count; i++)
            r->options[i] = copy_string(r, s->options[i].name);
    }
    line->answers = ceduo_check_memory(ceduo_arena_alloc(&r->arena, r->options_count * sizeof *line->answers));
    for (size_t i = 0; i < r->options_count; i++) {
        const struct ceduo_subject subject = ceduo_subject_find(report, i, result->last_control);
        const struct ceduo_hazard *hazard = ceduo_hazard_find(subject.wooded), *bare = ceduo_hazard_find(subject.bare);
        struct line_answer *a = &line->answers[i];
        *a = (struct line_answer){.share = ceduo_share_judged(subject.wooded).mean, .reach = NAN, .exceed = NAN};
        a->class = ceduo_outcome_classify(result, &subject.outcome, result->last_control, &a->why);
        if (hazard) {
            a->reach = hazard->reach.mean;
            a->exceed = hazard->accepted.mean;
        }
        if (bare && i == 0) {
            r->bare_reach += bare->reach.mean;
            r->bare_exceed += bare->accepted.mean;
            r->rated++;
        }
    }
}

void ceduo_region_free(struct ceduo_region *r)
{
    ceduo_arena_free(&r->arena);
    free(r->lines);
    *r = (struct ceduo_region){0};
}

/* ---- order ---- */

/* Rank of a line by the first option: no, open, the others; within a class by rate, then by share. */
static double get_rank(const struct ceduo_region_line *line)
{
    static const double ranks[CLASSES] = {[CEDUO_CLASS_NO] = 3, [CEDUO_CLASS_OPEN] = 2, [CEDUO_CLASS_FOREST] = 1};
    return !line->answers || !line->answers[0].why ? -1 : ranks[line->answers[0].class];
}

static double compare_unknown(double a, double b)
{
    return (isnan(b) ? -1 : b) - (isnan(a) ? -1 : a);
}

static int compare_lines(const void *a, const void *b)
{
    const struct ceduo_region_line *x = a, *y = b;
    double order = get_rank(y) - get_rank(x);
    if (order == 0 && x->answers && y->answers) {
        order = compare_unknown(x->answers[0].exceed, y->answers[0].exceed);
        order = order != 0 ? order : compare_unknown(x->answers[0].share, y->answers[0].share);
    }
    return order > 0 ? 1 : order < 0 ? -1 : (x->number > y->number) - (x->number < y->number);
}

size_t ceduo_region_sort(struct ceduo_region *r)
{
    if (r->count > 1)
        qsort(r->lines, r->count, sizeof *r->lines, compare_lines);
    return r->count - r->failed;
}

size_t ceduo_region_scene(const struct ceduo_region *r, size_t i, const char **name)
{
    *name = r->lines[i].name;
    return r->lines[i].scene;
}

/* ---- the page ---- */

static size_t count_class(const struct ceduo_region *r, size_t option, enum ceduo_class class)
{
    size_t n = class == CEDUO_CLASS_NOT_JUDGED ? r->failed : 0;
    for (size_t i = 0; i < r->count; i++) {
        const struct line_answer *a = r->lines[i].answers ? &r->lines[i].answers[option] : NULL;
        n += a && a->why && a->class == class;
    }
    return n;
}

#define BAR_COLUMNS  46
#define LABEL_CELLS  24
#define NUMBER_CELLS 7

/* Draw how many lines have each answer. */
static void add_histogram(struct ceduo_page *page, const struct ceduo_region *r, size_t option, bool alone)
{
    struct ceduo_svg *svg = ceduo_svg_create(BAR_COLUMNS, CLASSES);
    struct ceduo_canvas *canvas = ceduo_svg_canvas(svg);
    size_t counts[CLASSES], max = 1;
    LOCAL_TEXT(numbers);
    for (int i = 0; i < CLASSES; i++) {
        counts[i] = count_class(r, option, (enum ceduo_class)i);
        max = counts[i] > max ? counts[i] : max;
    }
    for (int i = 0; i < CLASSES; i++) {
        LOCAL_TEXT(number);
        ceduo_text_format(&number, "%zu", counts[i]);
        ceduo_text_format(&numbers, "%s%s %zu", i > 0 ? ", " : "", _(class_names[i]), counts[i]);
        ceduo_canvas_draw_text(canvas, 0, i, LABEL_CELLS, CEDUO_ROLE_TEXT, _(class_names[i]));
        ceduo_canvas_draw_text(canvas, LABEL_CELLS, i, NUMBER_CELLS, CEDUO_ROLE_TEXT, ceduo_text_string(&number));
        ceduo_canvas_bar(canvas, LABEL_CELLS + NUMBER_CELLS, i, BAR_COLUMNS - LABEL_CELLS - NUMBER_CELLS,
                         (double)counts[i] / (double)max, class_roles[i]);
    }
    struct ceduo_page_block *block = ceduo_page_picture(page, svg, !alone);
    ceduo_text_format(&block->text, _("Lines by answer: %s"), r->options[option]);
    ceduo_text_append(&block->description, ceduo_text_string(&numbers));
}

static void add_answer(struct ceduo_page *page, const struct ceduo_region *r)
{
    struct text *question = ceduo_page_add(page, CEDUO_PAGE_QUESTION);
    if (isnan(r->accepted))
        ceduo_text_format(question, _("Do rocks reach %s?"), r->place ? r->place : _("the place below"));
    else
        ceduo_text_format(question, _("On which lines does the forest protect %s up to %s kJ?"),
                          r->place ? r->place : _("the place below"), LOCALIZED(r->accepted * J_TO_KJ));
    for (size_t i = 0; i < r->options_count; i++)
        ceduo_page_para(page, CEDUO_PAGE_ANSWER,
                        _("%s: %zu not protected, %zu open, %zu protected or not reached, %zu not judged, of %zu lines."),
                        r->options[i], count_class(r, i, CEDUO_CLASS_NO), count_class(r, i, CEDUO_CLASS_OPEN),
                        count_class(r, i, CEDUO_CLASS_NOT_REACHED) + count_class(r, i, CEDUO_CLASS_WITHOUT_FOREST) +
                            count_class(r, i, CEDUO_CLASS_FOREST),
                        count_class(r, i, CEDUO_CLASS_NOT_JUDGED), r->count);
}

static void add_classes(struct ceduo_page *page, const struct ceduo_region *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("option"), 30, 0, COL_WRAP}, {N_("not reached"), -12, 1, 0}, {N_("yes, also without forest"), -12, 1, 0},
        {N_("yes"), -12, 1, 0},          {N_("open"), -12, 1, 0},        {N_("no"), -12, 1, 0},
        {N_("not judged"), -12, 1, 0}};
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("Lines by answer"));
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < r->options_count; i++) {
        ceduo_page_cell_format(page, "%s", r->options[i]);
        for (int k = 0; k < CLASSES; k++)
            ceduo_page_cell_format(page, "%zu", count_class(r, i, (enum ceduo_class)k));
    }
    for (size_t i = 0; i < r->options_count; i++)
        add_histogram(page, r, i, r->options_count == 1);
}

static void add_rate_row(struct ceduo_page *page, const char *name, double reach, double exceed)
{
    ceduo_page_cell_format(page, "%s", name);
    ceduo_page_cell_format(page, "%s", SIG(reach, 3));
    ceduo_page_cell_format(page, "%s", isnan(exceed) ? "-" : SIG(exceed, 3));
}

/* Append the sum of the rates of all lines. */
static void add_rates(struct ceduo_page *page, const struct ceduo_region *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("option"), 30, 0, COL_WRAP}, {N_("arrive"), -12, 1, 0}, {N_("above the limit"), -16, 1, 0}};
    if (r->rated == 0)
        return;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("Rocks per year, all lines together"));
    CEDUO_PAGE_TABLE_OF(page, columns);
    add_rate_row(page, _("without forest"), r->bare_reach, r->bare_exceed);
    for (size_t i = 0; i < r->options_count; i++) {
        double reach = 0, exceed = 0;
        for (size_t k = 0; k < r->count; k++) {
            const struct line_answer *a = r->lines[k].answers ? &r->lines[k].answers[i] : NULL;
            reach += a && !isnan(a->reach) ? a->reach : 0;
            exceed += a && !isnan(a->reach) ? a->exceed : 0;
        }
        add_rate_row(page, r->options[i], reach, exceed);
    }
    ceduo_page_para(
        page, CEDUO_PAGE_NOTE,
        ngettext("Sum over %zu line with a rate. Rates add up only if the blocks of each line are those of its own "
                 "part of the cliff.",
                 "Sum over %zu lines with a rate. Rates add up only if the blocks of each line are those of its own "
                 "part of the cliff.",
                 r->rated),
        r->rated);
}

#define WORST 10

static void add_worst(struct ceduo_page *page, const struct ceduo_region *r, size_t chapters)
{
    static const struct ceduo_page_column columns[] = {
        {N_("line"), 24, 0, COL_WRAP},     {N_("option"), 24, 1, COL_WRAP}, {NP_("head", "answer"), 24, 1, COL_WRAP},
        {N_("reason"), 20, 1, 0},          {N_("of 1000"), -10, 1, 0},      {N_("above the limit per year"), -14, 1, 0},
        {NP_("head", "chapter"), -8, 1, 0}};
    size_t judged = r->count - r->failed, n = judged < WORST ? judged : WORST;
    if (n == 0)
        return;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, ngettext("The worst line", "The %zu worst lines", n), n);
    ceduo_page_para(page, CEDUO_PAGE_CAPTION,
                    isnan(r->accepted) ? _("Rocks of 1000 that arrive today, by '%s':")
                                       : _("Rocks of 1000 above the limit today, by '%s':"),
                    r->options[0]);
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < r->options_count; k++) {
            const struct line_answer *a = &r->lines[i].answers[k];
            ceduo_page_cell_format(page, "%s", k == 0 ? r->lines[i].name : "");
            ceduo_page_cell_format(page, "%s", r->options_count > 1 ? r->options[k] : "");
            ceduo_page_cell_format(page, "%s", a->why ? _(class_names[a->class]) : "-");
            ceduo_page_cell_format(page, "%s", a->why ? _(a->why) : "-");
            ceduo_page_cell_format(page, "%s", isnan(a->share) ? "-" : SIG(a->share * 1000, 3));
            ceduo_page_cell_format(page, "%s", isnan(a->exceed) ? "-" : SIG(a->exceed, 3));
            if (k == 0 && i < chapters)
                ceduo_page_cell_format(page, "%zu", i + 1);
            else
                ceduo_page_cell_format(page, "%s", "");
        }
    ceduo_page_trim(page);
}

#define NOT_JUDGED_MAX 200

static void add_not_judged(struct ceduo_page *page, const struct ceduo_region *r)
{
    static const struct ceduo_page_column columns[] = {{N_("line"), 24, 0, COL_WRAP}, {N_("reason"), 0, 1, COL_WRAP}};
    size_t n = 0;
    for (size_t i = 0; i < r->count; i++) {
        const struct ceduo_region_line *line = &r->lines[i];
        bool stays = line->answers && line->answers[0].why && line->answers[0].class == CEDUO_CLASS_NOT_JUDGED;
        if (!line->reason && !stays)
            continue;
        if (n == 0) {
            ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("Lines that were not judged"));
            CEDUO_PAGE_TABLE_OF(page, columns);
        }
        if (n++ >= NOT_JUDGED_MAX)
            continue;
        ceduo_page_cell_format(page, "%s", line->name);
        ceduo_page_cell_format(page, "%s", line->reason ? line->reason : _("no rock moves: check the release and the profile"));
    }
    if (n > NOT_JUDGED_MAX)
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("and %zu more"), n - NOT_JUDGED_MAX);
}

void ceduo_region_page(struct ceduo_page *page, const struct ceduo_region *r, const struct ceduo_region_origin *origin)
{
    ceduo_page_para(page, CEDUO_PAGE_TITLE, ngettext("%s: %zu line", "%s: %zu lines", r->count), r->title ? r->title : "ceduo",
                    r->count);
    if (r->options) {
        add_answer(page, r);
        add_classes(page, r);
        add_rates(page, r);
        add_worst(page, r, origin->chapters);
    }
    add_not_judged(page, r);
    ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("How to reproduce this page"));
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_FACT, _("Program")), "ceduo %s", CEDUO_VERSION);
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_FACT, _("Table")), "%s, %016llx", origin->table,
                      (unsigned long long)origin->table_hash);
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_FACT, _("Inputs")),
                      _("%016llx: hash of version, options and all files read"), (unsigned long long)origin->run);
    ceduo_page_para(page, CEDUO_PAGE_SENTENCE, "%s", _("This command gives the same page, to the last byte:"));
    ceduo_page_para(page, CEDUO_PAGE_CODE, "%s", origin->command);
}
