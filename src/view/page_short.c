/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page that --batch prints: the answer, how sure it is, what it becomes over the years, what was assumed, on one screen.
 * Of several options a table comes first. What is assumed and what is to be noted takes the lines that are left; how much more
 * there is is said. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "page_parts.h"
#include "plot.h"

#define LINES        24 /* of one option */
#define LINES_SHARED 14 /* of several … */
#define LINES_OPTION 2  /* … and for each */
#define LINES_BLOCKS 2  /* … and to say how often, where that is known */

/* ---- head ---- */

/* With as much of the rocks as keeps it in one line. */
static void add_title(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_scene *s = r->scene;
    const char *title = ceduo_in_language(s->title, s->title_it), *about = ceduo_rock_varies(&s->rock) ? "~" : "";
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_TITLE);
    LOCAL_TEXT(rocks);
    ceduo_text_format(&rocks, " \xe2\x80\x93 ");
    ceduo_text_format(&rocks, s->blocks_count > 0 ? _("%llu rocks of many sizes") : _("%llu rocks of %s%s m (%s kg)"),
                      (unsigned long long)ceduo_result_rocks(r), about, WRITTEN(r->rock.mean_diameter, 2),
                      WRITTEN(r->rock.mass, 3));
    ceduo_text_append(text, title);
    for (char *end = rocks.bytes; *end && ceduo_utf8_width(title) + ceduo_utf8_width(rocks.bytes) > page->width;) {
        end = strrchr(rocks.bytes, '(');
        end = end ? end - 1 : rocks.bytes;
        *end = '\0';
    }
    ceduo_text_append(text, rocks.bytes);
}

/* ---- one option ---- */

/* ---- what is assumed, and what is to be noted ---- */

static void gather_notes(struct ceduo_page *notes, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    if (report->uncertainty && report->uncertainty->answer)
        ceduo_uncertainty_outside(report->uncertainty, ceduo_page_warn_once, notes);
    ceduo_words_thin_stems(r, ceduo_page_warn_once, notes);
    for (size_t i = 0; i < n; i++)
        ceduo_page_stand_rules(notes, r, i, false);
    if (n > 1 && report->verdict && report->verdict->choices[0].over->years > 0)
        ceduo_words_windows(r->scene, ceduo_page_warn_once, notes);
    for (size_t i = 0; i < n; i++)
        ceduo_page_stand_warnings(notes, r, i);
    ceduo_words_run_warnings(r, &report->remarks, ceduo_page_warn_once, notes);
    if (r->scene->slope.points > r->scene->slope.vertices) {
        struct text *points = ceduo_page_add(notes, CEDUO_PAGE_WARNING);
        ceduo_text_append(points, _("Profile: "));
        ceduo_words_points(points, &r->scene->slope);
        ceduo_text_char(points, '.');
    }
}

/* A point of sentences (warnings) or of other texts, and how many more there are. */
static void add_point(struct ceduo_page *page, const char *label, const struct text *said, size_t more)
{
    struct text *text = ceduo_page_item(page, CEDUO_PAGE_POINT, label);
    ceduo_text_append(text, ceduo_text_string(said));
    if (more > 0)
        ceduo_text_append_joined(text, said->length > 0 ? " " : "", _("(%zu more)"), more);
}

/* Adds those of the sentences, whole ones, that keep within so many lines. False where none has room, or not even how many more. */
static bool add_sentences(struct ceduo_page *page, const char *label, const struct ceduo_page *sentences, size_t lines)
{
    LOCAL_PAGE(tried, page->width);
    LOCAL_TEXT(said);
    size_t more = 0;
    for (const struct ceduo_page_block *b = sentences->first; b; b = b->next)
        more++;
    for (const struct ceduo_page_block *b = sentences->first; b; b = b->next) {
        size_t before = said.length; /* the first goes before how many more */
        ceduo_text_append_joined(&said, before == 0 ? "" : b->kind == CEDUO_PAGE_WARNING ? " " : "; ", "%s", b->text.bytes);
        add_point(&tried, label, &said, before == 0 ? 0 : more - 1);
        if (ceduo_page_lines(&tried) > lines)
            ceduo_text_cut(&said, before);
        else
            more--;
        ceduo_page_free(&tried);
    }
    if (said.length == 0)
        return more == 0;
    add_point(&tried, label, &said, more);
    bool counted = ceduo_page_lines(&tried) <= lines;
    add_point(page, label, &said, counted ? more : 0);
    return counted;
}

/* What is to be noted goes before what is assumed, but for a line or two. False where not all of it, or how much more, is said. */
static bool add_rest(struct ceduo_page *page, const struct ceduo_report *report, size_t lines)
{
    LOCAL_PAGE(assumed, 0);
    LOCAL_PAGE(notes, 0);
    LOCAL_PAGE(tried, page->width);
    size_t taken = ceduo_page_lines(page) + 1; /* and a last one for what more there is */
    size_t left = lines > taken + 1 ? lines - taken : 1;
    ceduo_page_assumed(&assumed, report, false);
    gather_notes(&notes, report);
    add_sentences(&tried, _("NOTE"), &notes, left - (left > 3 ? 2 : 1));
    bool said = add_sentences(page, _("ASSUMED *"), &assumed, left - ceduo_page_lines(&tried));
    return add_sentences(page, _("NOTE"), &notes, left + taken - 1 - ceduo_page_lines(page)) && said;
}

void ceduo_page_short(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    bool nothing = ceduo_page_is_unassessable(r);
    add_title(page, report);
    ceduo_page_question(page, r);
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
    ceduo_page_sure(page, report);
    ceduo_page_over(page, report);
    size_t shared = LINES_SHARED + (r->scene->blocks_count > 0 ? LINES_BLOCKS : 0);
    bool noted = add_rest(page, report, n > 1 ? shared + LINES_OPTION * n : LINES);
    for (size_t i = 0; report->years && !nothing && i < n; i++) { /* they were asked for */
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", r->scene->options[i].name);
        ceduo_page_years(page, report, i);
    }
    if (report->years && !nothing && n > 1)
        ceduo_page_years_beside(page, report);
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_POINT, _("MORE")), "--details%s, --sensitivity, --report page.html; %s",
                      noted ? "" : _(" (notes)"), noted ? _("as screens: ceduo SCENE") : _("or ceduo SCENE"));
}
