/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages as a terminal shows them, and the tables of figures of JSON and CSV. */
#include "expect.h"
#include "local.h"

#include <stdlib.h>
#include <string.h>

#include <math.h>

#include "view/figures.h"
#include "view/page.h"

/* ---- a page made by hand ---- */

static char *printed(struct ceduo_page *page, bool plain)
{
    struct text text = {0};
    ceduo_page_print(&text, page, plain);
    ceduo_page_free(page);
    return text.bytes;
}

static void expect_page(struct ceduo_page *page, bool plain, const char *wanted)
{
    LOCAL_BYTES char *text = printed(page, plain);
    assert_string_equal(text, wanted);
}

TEST(paragraphs_are_wrapped)
{
    struct ceduo_page page = {.width = 24};
    ceduo_text_append(ceduo_page_add(&page, CEDUO_PAGE_TITLE), "A title that is   too long for a line ");
    ceduo_text_append(ceduo_page_item(&page, CEDUO_PAGE_FACT, "Rock"), "cylinder, 512.3 kg");
    ceduo_text_append(ceduo_page_add(&page, CEDUO_PAGE_SECTION), "option");
    ceduo_text_append(ceduo_page_add(&page, CEDUO_PAGE_WARNING), "a bell \a is never rung");
    expect_page(&page, false,
                "A title that is too long\n"
                "for a line\n"
                "Rock     cylinder, 512.3\n"
                "         kg\n"
                "\n"
                "option\n"
                "    ! a bell \\x07 is\n"
                "      never rung\n");
}

static const struct ceduo_page_column columns[] = {
    {"place", 6, 1, COL_WRAP}, {"name", 5, 0, 0}, {"kJ", -6, 0, 0}, {"", 3, 1, 0}, {NULL, -9, 0, 0}};

static void add_row(struct ceduo_page *page, const char *place, const char *name, double value)
{
    ceduo_text_append(ceduo_page_text(page), place);
    ceduo_text_append(ceduo_page_text(page), name);
    ceduo_page_number(page, value, 3);
    ceduo_text_append(ceduo_page_text(page), "yes");
    struct ceduo_page_cell *mean = ceduo_page_cell(page);
    ceduo_text_append(&mean->text, "100 (90\xe2\x80\x93"
                                   "110)");
    ceduo_text_append(&mean->shorter, "100\xc2\xb1"
                                      "10");
}

static struct ceduo_page table(void)
{
    struct ceduo_page page = {.width = 40};
    ceduo_page_table(&page, columns, 5);
    ceduo_text_append(&ceduo_page_head(&page)->text, "> 1234567 kJ");
    ceduo_text_append(&ceduo_page_head(&page)->shorter, "> 1 GJ");
    add_row(&page, "0–20", "oak", 12.34);
    add_row(&page, "1000–2000", "hornbeam", 1234567);
    add_row(&page, "5", "\xe6\xa3\xae\xe6\x9e\x97", 0.00001234);
    add_row(&page, "by the brook, below the seven beeches with the shrine", "ash", 1);
    return page;
}

/* A cell that is too long is cut or continues in the next row; text wider than the page is wrapped. A number has the digits
 * that fit; a wide character takes two columns. */
TEST(cells_are_aligned_in_columns)
{
    struct ceduo_page page = table();
    expect_page(&page, false,
                " place name     kJ       > 1 GJ\n"
                " 0–20  oak    12.3 yes   100±10\n"
                " 1000–2000\n"
                "       horn\xe2\x80\xa6   1e6 yes   100±10\n"
                " 5     \xe6\xa3\xae\xe6\x9e\x97   1e-5 yes   100±10\n"
                " by the brook, below the seven beeches\n"
                " with the shrine\n"
                "       ash    1.00 yes   100±10\n");
}

/* A number too small to have a power of ten of its own is not inf. */
TEST(the_least_numbers_are_not_inf)
{
    struct ceduo_page page = {.width = 40};
    ceduo_page_table(&page, columns, 5);
    add_row(&page, "9", "oak", 3e-323);
    LOCAL_BYTES char *text = printed(&page, false);
    assert_null(strstr(text, "inf"));
}

TEST(a_plain_terminal_gets_plain_characters)
{
    struct ceduo_page page = table();
    LOCAL_BYTES char *text = printed(&page, true);
    assert_non_null(strstr(text, "0-20  oak"));
    assert_non_null(strstr(text, "horn~"));
    assert_non_null(strstr(text, "+-"));
}

/* ---- drawing ---- */

/* Draw a page into an area of cells at (2, 1), and compare the screen. */
static void expect_drawn(struct ceduo_page *page, struct ceduo_area area, enum ceduo_charset charset, int first, int lines,
                         const char *wanted)
{
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(area.left + area.width + 2, area.top + area.height + 1, charset);
    assert_int_equal(ceduo_page_draw(page, &cells->canvas, area, first), lines);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells);
    assert_string_equal(text, wanted);
}

/* From a line on, within the area, with roles for headings and warnings; margins are smaller than on paper. */
TEST(a_pane_shows_lines_in_roles)
{
    LOCAL_BY(ceduo_page_free) struct ceduo_page page = {.width = 12};
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(16, 5, CEDUO_CHARSET_BRAILLE);
    ceduo_page_para(&page, CEDUO_PAGE_TITLE, "%s", "hidden");
    ceduo_page_para(&page, CEDUO_PAGE_SECTION, "%s", "option");
    ceduo_page_para(&page, CEDUO_PAGE_WARNING, "%s", "a b");
    ceduo_page_para(&page, CEDUO_PAGE_NOTE, "%s", "one");
    page.last->role = CEDUO_ROLE_DIM;
    assert_int_equal(ceduo_page_draw(&page, &cells->canvas, (struct ceduo_area){2, 1, 12, 3}, 2), 5);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells), *roles = ceduo_cells_roles(cells);
    assert_string_equal(text, "\n  option\n  ! a b\n  one\n\n");
    assert_string_equal(roles, "\n  TTTTTT\n  WWWWW\n  ddd\n\n");
}

static const struct ceduo_page_column fitted[] = {{"", 6, 0, COL_GROW},
                                                  {"kJ", -2, 1, COL_SHRINK},
                                                  {"", 4, 1, COL_GROW | COL_PRIORITY(7)},
                                                  {"less", -1, 1, COL_SHRINK | COL_PRIORITY(8)}};

static struct ceduo_page bars(size_t width)
{
    static const char *const names[] = {"coppice, just cut", "coppice, 25 years"};
    struct ceduo_page page = {.width = width};
    CEDUO_PAGE_TABLE_OF(&page, fitted);
    for (int i = 0; i < 2; i++) {
        ceduo_page_cell_format(&page, "%s", names[i]);
        ceduo_page_number(&page, i ? 123.4 : 7, 4);
        struct ceduo_page_bar *bar = ceduo_page_bar(&page, i ? .5 : 1, CEDUO_ROLE_GOOD);
        bar->limit = .75;
        bar->from = i ? .25 : 0;
        ceduo_page_cell_format(&page, "%s", "\xc2\xb1\x31");
    }
    return page;
}

/* Columns are as wide as their cells. A name that is too long keeps its distinctive end; bars take the remaining width. In a
 * narrow pane whole columns of the highest rank are dropped. */
TEST(columns_find_their_widths)
{
    LOCAL_BY(ceduo_page_free) struct ceduo_page wide = bars(40), narrow = bars(24), least = bars(14);
    expect_drawn(&wide, (struct ceduo_area){0, 0, 40, 3}, CEDUO_CHARSET_ASCII, 0, 3,
                 "                     kJ             less\n"
                 "coppice, just cut 7.000 ########|##  +-1\n"
                 "coppice, 25 years 123.4   ####  |    +-1\n\n");
    expect_drawn(&narrow, (struct ceduo_area){3, 1, 24, 3}, CEDUO_CHARSET_BRAILLE, 0, 3,
                 "\n                   kJ\n   \xe2\x80\xa6"
                 "e, just cut 7.000 \xe2\x96\x88\xe2\x96\x88\xe2\x96\x88\xe2\x96\x88\xe2\x94\x82\n   \xe2\x80\xa6"
                 "e, 25 years 123.4  \xe2\x96\x88\xe2\x96\x88 \xe2\x94\x82\n\n");
    expect_drawn(&least, (struct ceduo_area){0, 0, 14, 3}, CEDUO_CHARSET_ASCII, 0, 3,
                 "            kJ\n~just c~ 7.000\n~25 yea~ 123.4\n\n");
}

/* Text that does not fit is cut with a mark, and nothing is drawn outside the area. */
TEST(a_pane_too_narrow_is_cut)
{
    LOCAL_BY(ceduo_page_free) struct ceduo_page page = bars(8);
    expect_drawn(&page, (struct ceduo_area){0, 0, 8, 3}, CEDUO_CHARSET_ASCII, 0, 3, "\ncoppi~ ~\ncoppi~ ~\n\n");
}

/* ---- tables of figures ---- */

static const struct ceduo_figure *with_key(const struct ceduo_figure *f, const char *key)
{
    const struct ceduo_figure *row = NULL;
    for (; !ceduo_figure_is_end(f) && !row; f++)
        row = !f->key ? with_key(f->table, key) : strcmp(f->key, key) == 0 ? f : NULL;
    return row;
}

/* Each row has a unique key and a description, and is a value, an object or sentences. */
static void expect_rows(const struct ceduo_figure *table, const struct ceduo_figure *f)
{
    for (; !ceduo_figure_is_end(f); f++) {
        if (f->key && with_key(table, f->key) != f)
            fail_msg("'%s' stands there twice", f->key);
        if (f->key && (!f->unit || !f->meaning || !f->meaning[0]))
            fail_msg("'%s' has no meaning", f->key);
        if (!!f->value + !!f->table + !!f->sentences != 1)
            fail_msg("'%s' is not one thing", f->key ? f->key : "");
        if (f->table && !f->plain)
            expect_rows(f->key ? f->table : table, f->table);
    }
}

TEST(every_figure_has_a_description)
{
    expect_rows(ceduo_result_figures, ceduo_result_figures);
    expect_rows(ceduo_find_figures, ceduo_find_figures);
    expect_rows(ceduo_uncertainty_figures, ceduo_uncertainty_figures);
    expect_rows(ceduo_calibration_figures, ceduo_calibration_figures);
}

/* ---- a result ---- */

static struct scene_file file;
static struct ceduo_results answer;
static struct ceduo_verdict verdict;
static struct ceduo_report report;
static int set_up(void **state)
{
    (void)state;
    static const char *const sets[] = {"simulation.rocks=60", "rocks_per_year=2"};
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    bool good = ceduo_scene_load(&file, "profiles/scenes/rotation.yaml", sets, 2, &problems);
    struct ceduo_request question = ceduo_request_default(&file.scene);
    question.years = true;
    question.window = (struct ceduo_window){.last = 1, .step = 1};
    question.block_rocks = 20;
    if (!good || ceduo_simulate_request(&question, NULL, &answer) != CEDUO_OK ||
        ceduo_compare_options(answer.result, answer.years, NULL, &verdict) != CEDUO_OK)
        return 1;
    report = (struct ceduo_report){.file = &file,
                                   .result = answer.result,
                                   .years = answer.years,
                                   .blocks = answer.blocks,
                                   .verdict = &verdict,
                                   .work = answer.work};
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    ceduo_verdict_release(&verdict);
    ceduo_results_release(&answer);
    ceduo_scene_release(&file);
    return 0;
}

static size_t fields(const char *row)
{
    size_t n = 1;
    bool quoted = false;
    for (; *row && *row != '\n'; row++) {
        quoted ^= *row == '"';
        n += *row == ',' && !quoted;
    }
    return n;
}

TEST(a_row_has_a_field_for_each_name)
{
    for (int kind = 0; kind < 3; kind++) {
        LOCAL_TEXT(text);
        struct ceduo_report shown = report;
        shown.years = kind == 1 ? report.years : NULL;
        ceduo_csv_head(&text, ceduo_result_csv(kind == 2, kind == 1));
        ceduo_csv_rows(&text, ceduo_result_csv(kind == 2, kind == 1), &(struct ceduo_place){.report = &shown});
        const char *row = strchr(text.bytes, '\n') + 1;
        assert_int_equal(fields(row), fields(text.bytes));
    }
}

AROUND_TESTS(set_up, tear_down);
