/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Page of --batch on one screen: answer, certainty, development, assumptions; with several options their table first. Notes
 * and assumptions fill the remaining lines, with a count of the rest. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "core/runs/result.h"
#include "page_parts.h"
#include "plot.h"
#include "scene/derived.h"
#include "scene/rock.h"

#define LINES        24 /* lines for one option */
#define LINES_SHARED 14 /* lines for several options … */
#define LINES_OPTION 2  /* … plus lines per option */
#define LINES_BLOCKS 2  /* … plus lines for frequencies */
#define LINES_FENCE  4  /* … plus lines for each fence */

/* ---- head ---- */

/* Append the title, with details of the rocks that fit in its line. */
static void add_title(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_scene *s = r->scene;
    const char *title = ceduo_in_language(s->title, s->title_it), *about = ceduo_rock_varies(&s->rock) ? "~" : "";
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_TITLE);
    LOCAL_TEXT(rocks);
    ceduo_text_format(&rocks, " \xe2\x80\x93 ");
    unsigned long n = (unsigned long)ceduo_result_rocks(r);
    ceduo_text_format(&rocks,
                      s->blocks_count > 0 ? ngettext("%lu rock of many sizes", "%lu rocks of many sizes", n)
                                          : ngettext("%lu rock of %s%s m (%s kg)", "%lu rocks of %s%s m (%s kg)", n),
                      n, about, SIG(r->rock.mean_diameter, 2), SIG(r->rock.mass, 3));
    ceduo_text_append(text, title);
    for (char *end = rocks.bytes; *end && ceduo_utf8_width(title) + ceduo_utf8_width(rocks.bytes) > page->width;) {
        end = strrchr(rocks.bytes, '(');
        end = end ? end - 1 : rocks.bytes;
        *end = '\0';
    }
    ceduo_text_append(text, rocks.bytes);
}

/* ---- assumptions and notes ---- */

static void collect_notes(struct ceduo_page *notes, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    ceduo_uncertainty_warn_outside(report->uncertainty, ceduo_page_warn_once, notes);
    ceduo_words_thin_stems(r, ceduo_page_warn_once, notes);
    for (size_t i = 0; i < n; i++)
        ceduo_page_stand_rules(notes, r, i, false);
    if (n > 1 && report->verdict && report->verdict->choices[0].last_summary->years > 0)
        ceduo_words_windows(r->scene, ceduo_page_warn_once, notes);
    for (size_t i = 0; i < n; i++)
        ceduo_page_stand_warnings(notes, r, i);
    ceduo_words_run_warnings(r, &report->remarks, ceduo_page_warn_once, notes);
    if (r->scene->slope.points > r->scene->slope.vertices) {
        struct text *points = ceduo_page_add(notes, CEDUO_PAGE_WARNING);
        ceduo_text_append(points, _("Profile: "));
        ceduo_words_points(points, &r->scene->slope);
        ceduo_text_append_char(points, '.');
    }
}

/* Append a point with its sentences or items, and the number left out. */
static void add_point(struct ceduo_page *page, const char *label, const struct text *body, size_t more)
{
    struct text *text = ceduo_page_item(page, CEDUO_PAGE_POINT, label);
    ceduo_text_append(text, ceduo_text_string(body));
    if (more > 0)
        ceduo_text_append_joined(text, body->length > 0 ? " " : "", _("(%zu more)"), more);
}

/* Append the sentences that fit in `lines`. Return false if none fits, or if the number left out does not fit. */
static bool add_sentences(struct ceduo_page *page, const char *label, const struct ceduo_page *sentences, size_t lines)
{
    LOCAL_PAGE(trial, page->width);
    LOCAL_TEXT(body);
    size_t more = 0;
    for (const struct ceduo_page_block *b = sentences->first; b; b = b->next)
        more++;
    for (const struct ceduo_page_block *b = sentences->first; b; b = b->next) {
        size_t before = body.length; /* the first sentence has priority over the count */
        ceduo_text_append_joined(&body, before == 0 ? "" : b->kind == CEDUO_PAGE_WARNING ? " " : "; ", "%s", b->text.bytes);
        add_point(&trial, label, &body, before == 0 ? 0 : more - 1);
        if (ceduo_page_lines(&trial) > lines)
            ceduo_text_cut(&body, before);
        else
            more--;
        ceduo_page_free(&trial);
    }
    if (body.length == 0)
        return more == 0;
    add_point(&trial, label, &body, more);
    bool counted = ceduo_page_lines(&trial) <= lines;
    add_point(page, label, &body, counted ? more : 0);
    return counted;
}

/* Fill the remaining lines with notes, keeping two for assumptions. Return false if something was left out uncounted. */
static bool add_notes(struct ceduo_page *page, const struct ceduo_report *report, size_t lines)
{
    LOCAL_PAGE(assumed, 0);
    LOCAL_PAGE(notes, 0);
    LOCAL_PAGE(trial, page->width);
    size_t taken = ceduo_page_lines(page) + 1; /* plus the last line */
    size_t remaining = lines > taken + 1 ? lines - taken : 1;
    ceduo_page_assumed(&assumed, report, false);
    collect_notes(&notes, report);
    add_sentences(&trial, _("NOTE"), &notes, remaining - (remaining > 3 ? 2 : 1));
    bool body = add_sentences(page, _("ASSUMED *"), &assumed, remaining - ceduo_page_lines(&trial));
    return add_sentences(page, _("NOTE"), &notes, remaining + taken - 1 - ceduo_page_lines(page)) && body;
}

void ceduo_page_short(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    bool nothing = ceduo_page_is_unassessable(r);
    add_title(page, report);
    ceduo_page_question(page, report);
    if (n > 1 && !nothing) {
        ceduo_page_shares(page, report, true);
        ceduo_page_options(page, report, CEDUO_OPTIONS_SHORT, r->last_control, SIZE_MAX, 0, n);
    }
    ceduo_page_answer(page, report);
    if (n == 1 && !nothing) {
        ceduo_page_add(page, CEDUO_PAGE_GAP);
        const bool stems = ceduo_plot_has_stems(&r->scene->options[0]);
        const struct ceduo_subject s = ceduo_subject_find(report, stems ? 0 : SIZE_MAX, r->last_control);
        ceduo_page_arrivals(page, &s, CEDUO_LINES_SHORT, true);
        if (stems)
            ceduo_page_tests(page, &s, CEDUO_LINES_SHORT);
    }
    ceduo_page_certainty(page, report);
    ceduo_page_over_time(page, report);
    ceduo_page_fence_answer(page, report, true);
    size_t shared = LINES_SHARED + (r->scene->blocks_count > 0 ? LINES_BLOCKS : 0);
    for (size_t k = 0; k < r->scene->controls_count; k++)
        shared += ceduo_fence_stands(&r->scene->controls[k].fence) ? LINES_FENCE : 0;
    bool complete = add_notes(page, report, n > 1 ? shared + LINES_OPTION * n : LINES);
    for (size_t i = 0; report->years && !nothing && i < n; i++) { /* requested with --years */
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", r->scene->options[i].name);
        ceduo_page_years(page, report, i);
    }
    if (report->years && !nothing && n > 1)
        ceduo_page_years_all_options(page, report);
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_POINT, _("MORE")), "--details%s, --sensitivity, --report page.html; %s",
                      complete ? "" : _(" (notes)"), complete ? _("interactive: ceduo SCENE") : _("or ceduo SCENE"));
}
