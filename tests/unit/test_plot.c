/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "local.h"
#include "table.h"
#include "unit/site.h"

#include <stdio.h>
#include <stdlib.h>

#include "view/cells.h"
#include "view/plot.h"

#define BRAILLE CEDUO_CHARSET_BRAILLE
#define ASCII   CEDUO_CHARSET_ASCII

static struct site s;
static struct ceduo_picture p;
static size_t first_stem;

static int bare_site(void **state)
{
    (void)state;
    site_init(&s);
    p = (struct ceduo_picture){.scene = &s.scene, .snapshot = &s.snapshot};
    return 0;
}

static int wooded_site(void **state)
{
    bare_site(state);
    wooded_site_init(&s);
    return 0;
}

/* Of the picture of such a site. */
#define TEST_BARE(name)   TEST_WITH(name, bare_site, NULL)
#define TEST_WOODED(name) TEST_WITH(name, wooded_site, NULL)

/* Through the wood no rock gets to the path. */
static void stop_all(void)
{
    for (int i = 0; i < CELLS; i++)
        s.wood_envelopes[i] = no_rock;
    s.wood_energies[0].n = 0;
    s.wood_arrivals[0] = (struct ceduo_arrivals){.released = 10, .energy = ceduo_distribution_none()};
}

static struct ceduo_cells *draw(enum ceduo_plot plot, int width, int height, enum ceduo_charset charset)
{
    struct ceduo_cells *cells = ceduo_cells_create(width, height, charset);
    assert_non_null(cells);
    struct ceduo_area area = {0, 0, width, height};
    ceduo_plot_draw(plot, &cells->canvas, &area, &p);
    return cells;
}

/* What a picture looks like stands in a file of its name, for the caller to free. */
static char *picture_file(const char *name)
{
    char path[256], *bytes = calloc(1, 1 << 16);
    snprintf(path, sizeof path, "tests/unit/pictures/%s.txt", name);
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    assert_true(fread(bytes, 1, (1 << 16) - 1, f) > 0);
    fclose(f);
    return bytes;
}

static void expect(enum ceduo_plot plot, int width, int height, enum ceduo_charset charset, const char *name)
{
    LOCAL(ceduo_cells, cells) = draw(plot, width, height, charset);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells), *expected = picture_file(name);
    assert_string_equal(text, expected);
}

static bool shows(enum ceduo_plot plot, int width, int height, const char *words)
{
    LOCAL(ceduo_cells, cells) = draw(plot, width, height, ASCII);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells);
    assert_non_null(text);
    bool found = strstr(text, words) != NULL;
    return found;
}

/* Cells of a role. */
static int cells_of(const struct ceduo_cells *cells, enum ceduo_role role)
{
    int n = 0;
    for (int row = 0; row < cells->height; row++)
        for (int column = 0; column < cells->width; column++)
            n += ceduo_cells_role(cells, column, row) == role;
    return n;
}

/* Two of the upper half hit, one flown over; one in the lower half. */
static const struct ceduo_stem_encounter passed[] = {
    {.x = 22, .y = 0.3, .dbh = 0.3, .height = 20, .hit = true},
    {.x = 27, .y = -0.1, .dbh = 0.08, .height = 8, .shoot = true, .hit = true},
    {.x = 32, .y = 0.2, .dbh = 0.08, .height = 8, .shoot = true},
    {.x = 62, .y = -0.4, .dbh = 0.08, .height = 8, .shoot = true, .hit = true},
};

/* ---- rows ---- */

static const struct {
    const char *name;
    double *number;
} numbers[] = {{"z1", &s.z[1]},
               {"z2", &s.z[2]},
               {"origin-x", &s.scene.slope.origin_x},
               {"origin-z", &s.scene.slope.origin_z},
               {"threshold", &s.scene.simulation.threshold},
               {"shoots", &s.shoots.per_ha},
               {"stools", &s.belts[0].stand.stools_per_ha},
               {"accepted", &s.controls[0].accepted},
               {"bare-exceed", &s.arrivals[0].exceed.mean},
               {"wood-exceed", &s.wood_arrivals[0].exceed.mean},
               {"peak", &s.envelopes[2].height.max},
               {"wood-peak", &s.wood_envelopes[2].height.p95}};
static const struct {
    const char *name;
    size_t *number;
} counts[] = {{"option", &p.option},
              {"control", &p.control},
              {"belt", &p.belt},
              {"trees", &s.belts[0].stand.trees_count},
              {"belts", &s.options[0].belts_count},
              {"belts-of-second", &s.options[1].belts_count},
              {"first-stem", &first_stem},
              {"stems", &p.stems_count}};

static struct ceduo_belt belts[6];

static void set_belts(size_t n)
{
    s.options[0] = (struct ceduo_option){.name = "belts", .belts_count = n, .belts = belts};
}

/* What is other than in the site: a word, or the name of a number and its value. */
static void change(const char *word)
{
    static double many[1000];
    const char *is = strchr(word, '=');
    size_t length = is ? (size_t)(is - word) : strlen(word);
    double value = is ? atof(is + 1) : NAN;
    bool known = false;
    for (size_t i = 0; i < LENGTH(numbers); i++)
        if (is && strlen(numbers[i].name) == length && memcmp(numbers[i].name, word, length) == 0)
            *numbers[i].number = value, known = true;
    for (size_t i = 0; i < LENGTH(counts); i++)
        if (is && strlen(counts[i].name) == length && memcmp(counts[i].name, word, length) == 0)
            *counts[i].number = (size_t)value, known = true;
    p.stems = p.stems_count > 0 ? &passed[first_stem] : NULL;
    if (strcmp(word, "wood") == 0)
        wooded_site_init(&s);
    else if (strcmp(word, "stopped") == 0)
        stop_all();
    else if (strcmp(word, "unknown") == 0) /* the runs through the forest */
        s.wooded[0] = NULL;
    else if (strcmp(word, "nothing") == 0) /* is computed */
        p.snapshot = NULL;
    else if (strcmp(word, "long-name") == 0)
        s.options[0].name = "coppice with standards";
    else if (strcmp(word, "empty") == 0) /* places */
        for (int i = 0; i < CELLS; i++)
            s.envelopes[i] = no_rock;
    else if (memcmp(word, "energies=", 9) == 0) /* of all rocks */
        for (int i = 0; i < ENERGIES; i++)
            s.values[i] = value;
    else if (memcmp(word, "arrived=", 8) == 0)
        s.arrivals[0].reached = (uint64_t)value;
    else if (memcmp(word, "wood-arrived=", 13) == 0)
        s.wood_arrivals[0].reached = (uint64_t)value;
    else if (strcmp(word, "tail") == 0) { /* three of 1000 with far more than the others */
        for (int i = 0; i < 1000; i++)
            many[i] = i < 997 ? 1e3 * (i % 50) : 1e6;
        s.energies[0] = (struct ceduo_energies){1000, many};
    } else if (strcmp(word, "three-belts") == 0) { /* the second is short, the third bare */
        const double ends[3][2] = {{s.belts[0].from, 45}, {60, 70}, {70, 90}};
        for (int i = 0; i < 3; i++) {
            belts[i] = s.belts[i / 2];
            belts[i].from = ends[i][0];
            belts[i].to = ends[i][1];
        }
        set_belts(3);
    } else if (!known) {
        fail_msg("'%s' changes nothing", word);
    }
}

TEST(pictures_show_what_they_should)
{
    const char *plots = "profile|strips|histogram|compare|stand";
    for (char section[64]; next_word(&plots, section);)
        for (TABLE(row, "unit/plots.txt", section)) {
            char words[128], name[16], charset[8], *rest = words;
            int width, height, plot = CEDUO_PLOT_PROFILE;
            snprintf(words, sizeof words, "%s", row.at[0]);
            bare_site(NULL);
            first_stem = 0;
            for (char *word; (word = strsep(&rest, " "));)
                if (*word)
                    change(word);
            assert_int_equal(sscanf(row.at[1], "%15s %dx%d %7s", name, &width, &height, charset), 4);
            while (strcmp(ceduo_plot_kinds[plot].name, name) != 0)
                assert_true(++plot < CEDUO_PLOTS);
            if (row.at[2][0]) /* a file of the whole picture */
                expect((enum ceduo_plot)plot, width, height, charset[0] == 'a' ? ASCII : BRAILLE, row.at[2]);
            if (row.at[3][0] && !shows((enum ceduo_plot)plot, width, height, row.at[3]))
                fail_msg("%s: %s: '%s' is missing", row.at[0], row.at[1], row.at[3]);
            if (row.at[4][0] && shows((enum ceduo_plot)plot, width, height, row.at[4]))
                fail_msg("%s: %s: '%s' is shown", row.at[0], row.at[1], row.at[4]);
        }
}

/* ---- the profile ---- */

TEST_BARE(span_tells_where_the_slope_stands)
{
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(80, 24, BRAILLE);
    struct ceduo_area area = {0, 0, 80, 24};
    struct ceduo_span span;
    p.span = &span;
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &area, &p);
    assert_true(span.x0 == 0);
    assert_true(span.x1 >= 100 && span.x1 < 104);
    assert_true(span.left >= 3 && span.left + span.width <= 80);
    p.from = 40;
    p.to = 60;
    ceduo_cells_clear(cells);
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &area, &p);
    assert_true(span.x0 == 40);
    assert_true(span.x1 >= 60 && span.x1 < 62);
}

TEST_BARE(the_selected_way_is_drawn_over_all)
{
    struct ceduo_cells *cells = draw(CEDUO_PLOT_PROFILE, 60, 20, BRAILLE);
    assert_int_equal(cells_of(cells, CEDUO_ROLE_TRAJECTORY), 0);
    assert_true(cells_of(cells, CEDUO_ROLE_STEM) > 5);
    assert_true(cells_of(cells, CEDUO_ROLE_STOOL) > 5);
    assert_true(cells_of(cells, CEDUO_ROLE_CLOUD) > 0);
    ceduo_cells_free(cells);
    p.selected = &s.line;
    cells = draw(CEDUO_PLOT_PROFILE, 60, 20, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_TRAJECTORY) > 10);
    ceduo_cells_free(cells);
}

TEST_WOODED(ways_that_are_not_known_are_not_drawn)
{
    s.wooded[0] = NULL;
    LOCAL(ceduo_cells, cells) = draw(CEDUO_PLOT_PROFILE, 60, 16, BRAILLE);
    assert_int_equal(cells_of(cells, CEDUO_ROLE_CLOUD), 0);
    assert_true(cells_of(cells, CEDUO_ROLE_STOOL) > 5);
}

/* The rows of a column that hold dots of a role. */
static int rows_of(const struct ceduo_cells *cells, int column, enum ceduo_role role)
{
    int n = 0;
    for (int row = 0; row < cells->height; row++)
        n += ceduo_cells_role(cells, column, row) == role;
    return n;
}

TEST_WOODED(stems_that_the_rock_came_to_stand_where_they_are)
{
    p.snapshot = NULL;
    p.stems = passed;
    p.stems_count = 4;
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(84, 40, BRAILLE);
    struct ceduo_area area = {0, 0, 84, 40};
    struct ceduo_span span;
    p.span = &span;
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &area, &p);
    double metres = (span.x1 - span.x0) / (2 * span.width - 1); /* of a dot, either way */
    assert_int_equal(cells_of(cells, CEDUO_ROLE_STOOL), 0);
    for (int i = 0; i < 4; i++) {
        int column = span.left + (int)lround((passed[i].x - span.x0) / metres) / 2;
        double rows = passed[i].height / metres / 4;
        int found = rows_of(cells, column, passed[i].hit ? CEDUO_ROLE_STEM : CEDUO_ROLE_DIM);
        assert_true(found >= rows - 2 && found <= rows + 1);
    }
    expect(CEDUO_PLOT_PROFILE, 84, 20, ASCII, "stems-that-the-rock-came-to-stand-where-they-are");
}

/* A lying log has a place along the way, but none in the plane. */
TEST_WOODED(logs_stand_in_no_plan)
{
    struct ceduo_stem_encounter logs[] = {{.x = 30, .y = NAN, .dbh = NAN, .height = 2, .hit = true},
                                          {.x = 90, .y = NAN, .dbh = NAN, .height = 2, .hit = true},
                                          {.x = 200, .y = NAN, .dbh = NAN, .height = 2, .hit = true}};
    p.stems = logs;
    p.stems_count = 3;
    LOCAL(ceduo_cells, cells) = draw(CEDUO_PLOT_PROFILE, 84, 40, BRAILLE);
    assert_in_range(cells_of(cells, CEDUO_ROLE_STEM), 2, 4); /* two lie on the profile */
    assert_true(shows(CEDUO_PLOT_STAND, 84, 20, "One pattern of many"));
}

/* ---- strips ---- */

/* Strokes through the forest, dots without it. */
TEST_WOODED(strips_show_the_wood_beside_the_bare_slope)
{
    LOCAL(ceduo_cells, cells) = draw(CEDUO_PLOT_ENERGY, 70, 16, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_FOREST) > 30);
    assert_true(cells_of(cells, CEDUO_ROLE_BARE) > 30);
}

/* Where there is no room for four curves: the one that matters, with and without forest. */
TEST_WOODED(small_strips_show_one_pair_of_curves)
{
    struct ceduo_span span = {4, 60, 0, 100}; /* leaves no room for names */
    p.span = &span;
    struct ceduo_area area = {0, 0, 70, 20};
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(70, 20, ASCII);
    ceduo_plot_draw(CEDUO_PLOT_ENERGY, &cells->canvas, &area, &p);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells);
    assert_non_null(strstr(text, "mean energy, kJ"));
}

/* Names stand in the order in which the curves end: here the wooded mean above the bare one. */
TEST_WOODED(names_of_curves_follow_their_ends)
{
    for (int i = 0; i < CELLS; i++) {
        s.wood_envelopes[i] = s.envelopes[i];
        s.wood_envelopes[i].mean_energy = 190e3;
        s.wood_envelopes[i].energy.p95 = 20e3;
    }
    LOCAL(ceduo_cells, cells) = draw(CEDUO_PLOT_ENERGY, 70, 16, ASCII);
    const char *names[] = {"forest mean", "without p95", "without mean", "forest p95"};
    char *text = ceduo_cells_dump(cells), *at = text;
    for (int i = 0; i < 4; i++) {
        at = strstr(at, names[i]);
        assert_non_null(at);
    }
    free(text);
}

TEST_WOODED(strips_without_wooded_rocks)
{
    stop_all();
    s.wooded[0] = NULL;
    p.option = 1; /* no stems: both runs are one, drawn in strokes */
    LOCAL(ceduo_cells, cells) = draw(CEDUO_PLOT_ENERGY, 70, 8, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_FOREST) > 30);
    assert_in_range(cells_of(cells, CEDUO_ROLE_BARE), 13, 20); /* 13: the words */
}

TEST_BARE(strips_share_the_profiles_columns)
{
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(70, 24, ASCII);
    struct ceduo_area above = {0, 0, 70, 16}, below = {0, 16, 70, 8};
    struct ceduo_span span;
    p.span = &span;
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &above, &p);
    ceduo_plot_draw(CEDUO_PLOT_HEIGHT, &cells->canvas, &below, &p);
    int rules[2] = {0, 0};
    for (int column = 0; column < 70; column++) {
        rules[0] += ceduo_cells_role(cells, column, 5) == CEDUO_ROLE_CONTROL;
        rules[1] += ceduo_cells_role(cells, column, 5) == CEDUO_ROLE_CONTROL &&
                    ceduo_cells_role(cells, column, 20) == CEDUO_ROLE_CONTROL;
    }
    assert_int_equal(rules[0], 2);
    assert_int_equal(rules[1], 2);
}

/* ---- bars ---- */

/* ---- the stand ---- */

/* More stools are added to those that stand. */
TEST_BARE(stems_that_stay_do_not_move)
{
    s.belts[0].stand.trees_count = 0;
    LOCAL(ceduo_cells, few) = draw(CEDUO_PLOT_STAND, 80, 40, BRAILLE);
    s.belts[0].stand.stools_per_ha *= 1.5;
    s.shoots.per_ha *= 1.5;
    LOCAL(ceduo_cells, more) = draw(CEDUO_PLOT_STAND, 80, 40, BRAILLE);
    int dots[2] = {0, 0};
    for (int i = 0; i < 80 * 37; i++) {
        assert_int_equal(few->cell[i].dots & ~more->cell[i].dots, 0);
        dots[0] += few->cell[i].dots != 0;
        dots[1] += more->cell[i].dots != 0;
    }
    assert_true(dots[1] > dots[0]);
}

/* Trees of 10 cm and a rock of 3 m: those whose middle is less than 1.55 m off its path are met, no others. A row of
 * the picture is half a metre. */
TEST_BARE(what_the_rock_meets_lies_in_its_strip)
{
    s.scene.rock.diameter = ceduo_number(3);
    s.belts[0].stand.shoots_count = 0;
    s.trees.per_ha = 5000;
    s.trees.dbh = 0.1;
    LOCAL(ceduo_cells, cells) = draw(CEDUO_PLOT_STAND, 80, 43, BRAILLE);
    for (int row = 0; row < 40; row++)
        for (int column = 0; column < 80; column++) {
            double off = fabs(0.503 * (row + 0.5 - 20)); /* m */
            enum ceduo_role role = ceduo_cells_role(cells, column, row);
            assert_false(role == CEDUO_ROLE_TRAJECTORY && off > 1.6 + 0.3);
            assert_false(role == CEDUO_ROLE_STEM && off < 1.5 - 0.3);
        }
    assert_true(cells_of(cells, CEDUO_ROLE_TRAJECTORY) > 10);
    assert_true(cells_of(cells, CEDUO_ROLE_STEM) > 50);
}

/* 20 m around the last stem of the belt, offsets stretched until the strip fills the picture. */
TEST_WOODED(the_stand_shows_the_way_of_the_rock)
{
    p.stems = passed;
    p.stems_count = 3;
    LOCAL(ceduo_cells, cells) = draw(CEDUO_PLOT_STAND, 60, 14, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_TRAJECTORY) >= 2);
    assert_true(cells_of(cells, CEDUO_ROLE_DIM) >= 1);
    assert_int_equal(cells_of(cells, CEDUO_ROLE_STEM) + cells_of(cells, CEDUO_ROLE_STOOL), 0);
}

TEST_BARE(a_dense_stand_is_drawn_in_time)
{
    s.belts[0].stand.stools_per_ha = 1e6;
    s.shoots.per_ha = 1e7;
    ceduo_cells_free(draw(CEDUO_PLOT_STAND, 200, 400, BRAILLE));
}

/* ---- all of them ---- */

TEST_WOODED(nothing_is_drawn_beside_the_area)
{
    for (int i = 0; i < 3 * 40 * 12; i++) {
        enum ceduo_charset charset = (enum ceduo_charset)(i % 3);
        struct ceduo_area area = {7, 3, 4 + i / 3 % 40 * 3, 1 + i / 120 * 2};
        for (int plot = CEDUO_PLOT_PROFILE; plot < CEDUO_PLOTS; plot++) {
            LOCAL(ceduo_cells, cells) = ceduo_cells_create(area.width + 14, area.height + 6, charset);
            s.scene.simulation.contact_model = i / 3 % 2 ? CEDUO_STEMS : CEDUO_INDEX;
            p.snapshot = i % 7 == 0 ? NULL : &s.snapshot;
            p.stems = i % 11 < 3 ? passed : NULL;
            p.stems_count = i % 11 < 3 ? 4 : 0;
            p.option = (size_t)(i % 5 == 0);
            ceduo_plot_draw((enum ceduo_plot)plot, &cells->canvas, &area, &p);
            for (int row = 0; row < cells->height; row++)
                for (int column = 0; column < cells->width; column++) {
                    bool in = column >= area.left && column < area.left + area.width && row >= area.top &&
                              row < area.top + area.height;
                    if (!in && ceduo_cells_role(cells, column, row) != CEDUO_ROLE_BLANK)
                        fail_msg("plot %d, charset %d, %dx%d: drawn at %d, %d", plot, (int)charset, area.width, area.height,
                                 column - area.left, row - area.top);
                }
        }
    }
}

/* A surface that draws no dots: it only counts what a page of vectors would draw. */
struct page {
    int lines, ways, bars, axes;
    bool strayed; /* a line left its frame */
};

static void page_line(void *to, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b)
{
    struct page *page = to;
    double right = pen->raster.nx - 0.5 + 1e-9, bottom = pen->raster.ny - 0.5 + 1e-9, edge = -0.5 - 1e-9;
    *(pen->stroke == CEDUO_STROKE_TRAJECTORY ? &page->ways : &page->lines) += 1;
    page->strayed |= !(a.x >= edge && a.x <= right && b.x >= edge && b.x <= right && a.y >= edge && a.y <= bottom &&
                       b.y >= edge && b.y <= bottom);
}

static void page_bar(void *to, int column, int row, int width, double fraction, enum ceduo_role role)
{
    struct page *page = to;
    (void)column, (void)row, (void)width, (void)role;
    page->bars++;
    page->strayed |= !(fraction > 0 && fraction <= 1);
}

static void page_axis(void *to, const struct ceduo_frame *frame, bool bottom, int count, const struct ceduo_tick *ticks)
{
    (void)frame, (void)bottom, (void)count, (void)ticks;
    ((struct page *)to)->axes++;
}

TEST_WOODED(pictures_draw_on_another_surface)
{
    static const struct ceduo_surface surface = {.line = page_line, .bar = page_bar, .axis = page_axis};
    struct ceduo_area area = {0, 0, 100, 30};
    for (int plot = CEDUO_PLOT_PROFILE; plot < CEDUO_PLOTS; plot++) {
        struct page page = {0};
        struct ceduo_cells *cells = ceduo_cells_create(area.width, area.height, CEDUO_CHARSET_BRAILLE);
        struct ceduo_canvas canvas = {&surface, cells, &page, 8, 16, false};
        bool bars = ceduo_plot_kinds[plot].flags & CEDUO_PICTURE_PAGE;
        ceduo_plot_draw((enum ceduo_plot)plot, &canvas, &area, &p);
        char *words = ceduo_cells_dump(cells);
        if (strspn(words, "\n") == strlen(words) || page.strayed)
            fail_msg("%s: strayed: %d, words:\n%s", ceduo_plot_kinds[plot].name, page.strayed, words);
        free(words);
        ceduo_cells_free(cells);
        bool computed = plot != CEDUO_PLOT_ROTATION && plot != CEDUO_PLOT_TRADEOFF && plot != CEDUO_PLOT_UNCERTAINTY &&
                        plot != CEDUO_PLOT_HAZARD && plot != CEDUO_PLOT_FENCE;
        if (computed && (bars ? page.bars == 0 : page.lines == 0 || page.axes == 0))
            fail_msg("%s: %d lines, %d bars, %d axes", ceduo_plot_kinds[plot].name, page.lines, page.bars, page.axes);
        if (plot == CEDUO_PLOT_PROFILE && page.ways == 0)
            fail_msg("profile: no ways");
    }
}

/* Three options: one between the others, one that yields less and lets more through, one of which no yield is known. */
TEST_WOODED(a_point_for_each_option)
{
    static struct ceduo_option options[3];
    static char names[3][8] = {"good", "beaten", "unknown"};
    struct ceduo_choice choices[3] = {{.mean = {.25, .0625}, .yield = {.cut_per_year = 4}},
                                      {.mean = {.5, .0625}, .yield = {.cut_per_year = 2}, .beaten = true},
                                      {.mean = {.125, .0625}, .yield = {.cut_per_year = NAN}}};
    for (int i = 0; i < 3; i++)
        options[i].name = names[i];
    s.scene.options = options;
    s.scene.options_count = 3;
    const struct ceduo_verdict verdict = {.wooded = true, .accepted = true, .n = 3, .choices = choices};
    p.verdict = &verdict;
    expect(CEDUO_PLOT_TRADEOFF, 60, 16, ASCII, "a-point-for-each-option");
    choices[0].yield.cut_per_year = choices[1].yield.cut_per_year = NAN;
    assert_true(shows(CEDUO_PLOT_TRADEOFF, 60, 16, "no option has growth and cutting data"));
    assert_true(shows(CEDUO_PLOT_TRADEOFF, 20, 16, "too narrow"));
    p.verdict = NULL;
    assert_true(shows(CEDUO_PLOT_TRADEOFF, 60, 16, "not computed yet"));
}

TEST_BARE(titles_name_what_is_shown)
{
    static const struct {
        const char *title, *of_bare;
    } expected[CEDUO_PLOTS] = {
        {NULL, NULL},
        {"kept: slope, forest, and trajectories", ", without forest"},
        {"kept: energy of the rocks", ", without forest"},
        {"kept: height of the rocks above the ground", ", without forest"},
        {"kept: energy at path (40 m)", ", without forest"},
        {"kept: year by year, up to path (40 m)", ""},
        {"kept: coppice, from above", ""},
        {"Options side by side, up to path (40 m)", ""},
        {"Protection and yield of the options, up to path (40 m)", ""},
        {"kept: how sure it is at path (40 m)", ""},
        {"How often, and with how much, at path (40 m)", ""},
        {"Which class of fence is enough at path (40 m)", ""},
    };
    for (int i = 0; i < 2 * (CEDUO_PLOTS - 1); i++) {
        int plot = CEDUO_PLOT_PROFILE + i / 2;
        LOCAL_TEXT(title);
        LOCAL_TEXT(wanted);
        s.scene.simulation.contact_model = i % 2 ? CEDUO_STEMS : CEDUO_INDEX;
        ceduo_plot_title(&title, (enum ceduo_plot)plot, &p);
        ceduo_text_format(&wanted, "%s%s", expected[plot].title, i % 2 ? "" : expected[plot].of_bare);
        assert_string_equal(ceduo_text_string(&title), wanted.bytes);
    }
    assert_int_equal(ceduo_scene_last_control(&s.scene), 1);
}
