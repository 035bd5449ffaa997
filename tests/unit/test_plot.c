/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/runs/statistics.h"
#include "local.h"
#include "scene/derived.h"
#include "table.h"
#include "unit/site.h"

#include <stdio.h>
#include <stdlib.h>

#include "view/cells.h"
#include "view/plot.h"

#define BRAILLE CEDUO_CHARSET_BRAILLE
#define ASCII   CEDUO_CHARSET_ASCII

static struct site s;
static struct ceduo_picture picture;
static size_t first_stem;

static int set_up_bare(void **state)
{
    (void)state;
    site_init(&s);
    picture = (struct ceduo_picture){.scene = &s.scene, .snapshot = &s.snapshot};
    return 0;
}

static int set_up_wooded(void **state)
{
    set_up_bare(state);
    wooded_site_init(&s);
    return 0;
}

/* A test with this site. */
#define TEST_BARE(name)   TEST_WITH(name, set_up_bare, NULL)
#define TEST_WOODED(name) TEST_WITH(name, set_up_wooded, NULL)

/* Let no rock reach the path through the forest. */
static void stop_all_rocks(void)
{
    for (int i = 0; i < CELLS; i++)
        s.wood_envelopes[i] = no_rock;
    s.wood_energies[0].n = 0;
    s.wood_arrivals[0] = (struct ceduo_arrivals){.released = 10, .energy = ceduo_distribution_none()};
}

static struct ceduo_cells *draw_plot(enum ceduo_plot plot, int width, int height, enum ceduo_charset charset)
{
    struct ceduo_cells *cells = ceduo_cells_create(width, height, charset);
    assert_non_null(cells);
    struct ceduo_area area = {0, 0, width, height};
    ceduo_plot_draw(plot, &cells->canvas, &area, &picture);
    return cells;
}

/* Return the expected picture from a file of this name; caller frees. */
static char *read_picture(const char *name)
{
    char path[256], *bytes = calloc(1, 1 << 16);
    snprintf(path, sizeof path, "tests/unit/pictures/%s.txt", name);
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    assert_true(fread(bytes, 1, (1 << 16) - 1, f) > 0);
    fclose(f);
    return bytes;
}

static void expect_picture(enum ceduo_plot plot, int width, int height, enum ceduo_charset charset, const char *name)
{
    LOCAL(ceduo_cells, cells) = draw_plot(plot, width, height, charset);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells), *expected = read_picture(name);
    assert_string_equal(text, expected);
}

static bool picture_contains(enum ceduo_plot plot, int width, int height, const char *words)
{
    LOCAL(ceduo_cells, cells) = draw_plot(plot, width, height, ASCII);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells);
    assert_non_null(text);
    bool found = strstr(text, words) != NULL;
    return found;
}

/* Count the cells of a role. */
static int count_cells(const struct ceduo_cells *cells, enum ceduo_role role)
{
    int n = 0;
    for (int row = 0; row < cells->height; row++)
        for (int column = 0; column < cells->width; column++)
            n += ceduo_cells_role(cells, column, row) == role;
    return n;
}

/* Upper half: two stems hit, one passed above; one stem hit in the lower half. */
static const struct ceduo_stem_encounter encountered[] = {
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
               {"forest-exceed", &s.wood_arrivals[0].exceed.mean},
               {"peak", &s.envelopes[2].height.max},
               {"forest-peak", &s.wood_envelopes[2].height.p95}};
static const struct {
    const char *name;
    size_t *number;
} counts[] = {{"option", &picture.option},
              {"control", &picture.control},
              {"belt", &picture.belt},
              {"trees", &s.belts[0].stand.trees_count},
              {"belts", &s.options[0].belts_count},
              {"belts-of-second", &s.options[1].belts_count},
              {"first-stem", &first_stem},
              {"stems", &picture.stems_count}};

static struct ceduo_belt belts[6];

static void set_belts(size_t n)
{
    s.options[0] = (struct ceduo_option){.name = "belts", .belts_count = n, .belts = belts};
}

/* Apply a change to the site: a word, or the name of a number and its value. */
static void apply_change(const char *word)
{
    static double energies[1000];
    const char *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    double value = equals ? atof(equals + 1) : NAN;
    bool known = false;
    for (size_t i = 0; i < LENGTH(numbers); i++)
        if (equals && strlen(numbers[i].name) == length && memcmp(numbers[i].name, word, length) == 0)
            *numbers[i].number = value, known = true;
    for (size_t i = 0; i < LENGTH(counts); i++)
        if (equals && strlen(counts[i].name) == length && memcmp(counts[i].name, word, length) == 0)
            *counts[i].number = (size_t)value, known = true;
    picture.stems = picture.stems_count > 0 ? &encountered[first_stem] : NULL;
    if (strcmp(word, "forest") == 0)
        wooded_site_init(&s);
    else if (strcmp(word, "stopped") == 0)
        stop_all_rocks();
    else if (strcmp(word, "unknown") == 0) /* runs through the forest are not computed */
        s.wooded[0] = NULL;
    else if (strcmp(word, "nothing") == 0) /* no run is computed */
        picture.snapshot = NULL;
    else if (strcmp(word, "long-name") == 0)
        s.options[0].name = "coppice with standards";
    else if (strcmp(word, "empty") == 0) /* no rock passes */
        for (int i = 0; i < CELLS; i++)
            s.envelopes[i] = no_rock;
    else if (memcmp(word, "energies=", 9) == 0) /* equal for all rocks */
        for (int i = 0; i < ENERGIES; i++)
            s.values[i] = value;
    else if (memcmp(word, "arrived=", 8) == 0)
        s.arrivals[0].reached = (uint64_t)value;
    else if (memcmp(word, "forest-arrived=", 15) == 0)
        s.wood_arrivals[0].reached = (uint64_t)value;
    else if (strcmp(word, "tail") == 0) { /* three of 1000 rocks have far more energy than the others */
        for (int i = 0; i < 1000; i++)
            energies[i] = i < 997 ? 1e3 * (i % 50) : 1e6;
        s.energies[0] = (struct ceduo_energies){1000, energies};
    } else if (strcmp(word, "three-belts") == 0) { /* the second is short, the third has no stems */
        const double ends[3][2] = {{s.belts[0].from, 45}, {60, 70}, {70, 90}};
        for (int i = 0; i < 3; i++) {
            belts[i] = s.belts[i / 2];
            belts[i].from = ends[i][0];
            belts[i].to = ends[i][1];
        }
        set_belts(3);
    } else if (!known) {
        fail_msg("unknown change '%s'", word);
    }
}

TEST(pictures_are_as_expected)
{
    const char *plots = "profile|strips|histogram|compare|stand";
    for (char section[64]; next_word(&plots, section);)
        for (TABLE(row, "unit/plots.txt", section)) {
            char words[128], name[16], charset[8], *rest = words;
            int width, height, plot = CEDUO_PLOT_PROFILE;
            snprintf(words, sizeof words, "%s", row.at[0]);
            set_up_bare(NULL);
            first_stem = 0;
            for (char *word; (word = strsep(&rest, " "));)
                if (*word)
                    apply_change(word);
            assert_int_equal(sscanf(row.at[1], "%15s %dx%d %7s", name, &width, &height, charset), 4);
            while (strcmp(ceduo_plot_kinds[plot].name, name) != 0)
                assert_true(++plot < CEDUO_PLOTS);
            if (row.at[2][0]) /* file with the whole picture */
                expect_picture((enum ceduo_plot)plot, width, height, charset[0] == 'a' ? ASCII : BRAILLE, row.at[2]);
            if (row.at[3][0] && !picture_contains((enum ceduo_plot)plot, width, height, row.at[3]))
                fail_msg("%s: %s: '%s' is missing", row.at[0], row.at[1], row.at[3]);
            if (row.at[4][0] && picture_contains((enum ceduo_plot)plot, width, height, row.at[4]))
                fail_msg("%s: %s: '%s' is shown", row.at[0], row.at[1], row.at[4]);
        }
}

/* ---- the profile ---- */

TEST_BARE(span_is_the_visible_part_of_the_slope)
{
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(80, 24, BRAILLE);
    struct ceduo_area area = {0, 0, 80, 24};
    struct ceduo_span span;
    picture.span = &span;
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &area, &picture);
    assert_true(span.x0 == 0);
    assert_true(span.x1 >= 100 && span.x1 < 104);
    assert_true(span.left >= 3 && span.left + span.width <= 80);
    picture.from = 40;
    picture.to = 60;
    ceduo_cells_clear(cells);
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &area, &picture);
    assert_true(span.x0 == 40);
    assert_true(span.x1 >= 60 && span.x1 < 62);
}

TEST_BARE(the_selected_trajectory_is_drawn_on_top)
{
    struct ceduo_cells *cells = draw_plot(CEDUO_PLOT_PROFILE, 60, 20, BRAILLE);
    assert_int_equal(count_cells(cells, CEDUO_ROLE_TRAJECTORY), 0);
    assert_true(count_cells(cells, CEDUO_ROLE_STEM) > 5);
    assert_true(count_cells(cells, CEDUO_ROLE_STOOL) > 5);
    assert_true(count_cells(cells, CEDUO_ROLE_CLOUD) > 0);
    ceduo_cells_free(cells);
    picture.selected = &s.line;
    cells = draw_plot(CEDUO_PLOT_PROFILE, 60, 20, BRAILLE);
    assert_true(count_cells(cells, CEDUO_ROLE_TRAJECTORY) > 10);
    ceduo_cells_free(cells);
}

TEST_WOODED(unknown_trajectories_are_not_drawn)
{
    s.wooded[0] = NULL;
    LOCAL(ceduo_cells, cells) = draw_plot(CEDUO_PLOT_PROFILE, 60, 16, BRAILLE);
    assert_int_equal(count_cells(cells, CEDUO_ROLE_CLOUD), 0);
    assert_true(count_cells(cells, CEDUO_ROLE_STOOL) > 5);
}

/* Count the rows of a column with dots of a role. */
static int count_rows(const struct ceduo_cells *cells, int column, enum ceduo_role role)
{
    int n = 0;
    for (int row = 0; row < cells->height; row++)
        n += ceduo_cells_role(cells, column, row) == role;
    return n;
}

TEST_WOODED(encountered_stems_are_at_their_position)
{
    picture.snapshot = NULL;
    picture.stems = encountered;
    picture.stems_count = 4;
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(84, 40, BRAILLE);
    struct ceduo_area area = {0, 0, 84, 40};
    struct ceduo_span span;
    picture.span = &span;
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &area, &picture);
    double metres = (span.x1 - span.x0) / (2 * span.width - 1); /* per dot, horizontally and vertically */
    assert_int_equal(count_cells(cells, CEDUO_ROLE_STOOL), 0);
    for (int i = 0; i < 4; i++) {
        int column = span.left + (int)lround((encountered[i].x - span.x0) / metres) / 2;
        double rows = encountered[i].height / metres / 4;
        int found = count_rows(cells, column, encountered[i].hit ? CEDUO_ROLE_STEM : CEDUO_ROLE_DIM);
        assert_true(found >= rows - 2 && found <= rows + 1);
    }
    expect_picture(CEDUO_PLOT_PROFILE, 84, 20, ASCII, "encountered-stems");
}

/* A log lying on the ground has a position along the slope, but none in the plan. */
TEST_WOODED(logs_are_not_in_the_plan)
{
    struct ceduo_stem_encounter logs[] = {{.x = 30, .y = NAN, .dbh = NAN, .height = 2, .hit = true},
                                          {.x = 90, .y = NAN, .dbh = NAN, .height = 2, .hit = true},
                                          {.x = 200, .y = NAN, .dbh = NAN, .height = 2, .hit = true}};
    picture.stems = logs;
    picture.stems_count = 3;
    LOCAL(ceduo_cells, cells) = draw_plot(CEDUO_PLOT_PROFILE, 84, 40, BRAILLE);
    assert_in_range(count_cells(cells, CEDUO_ROLE_STEM), 2, 4); /* two lie on the profile */
    assert_true(picture_contains(CEDUO_PLOT_STAND, 84, 20, "One pattern of many"));
}

/* ---- strips ---- */

/* Lines with forest, dots without. */
TEST_WOODED(strips_show_results_with_and_without_forest)
{
    LOCAL(ceduo_cells, cells) = draw_plot(CEDUO_PLOT_ENERGY, 70, 16, BRAILLE);
    assert_true(count_cells(cells, CEDUO_ROLE_FOREST) > 30);
    assert_true(count_cells(cells, CEDUO_ROLE_BARE) > 30);
}

/* Four curves do not fit: show the most important one, with and without forest. */
TEST_WOODED(small_strips_show_one_pair_of_curves)
{
    struct ceduo_span span = {4, 60, 0, 100}; /* too narrow for labels */
    picture.span = &span;
    struct ceduo_area area = {0, 0, 70, 20};
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(70, 20, ASCII);
    ceduo_plot_draw(CEDUO_PLOT_ENERGY, &cells->canvas, &area, &picture);
    LOCAL_BYTES char *text = ceduo_cells_dump(cells);
    assert_non_null(strstr(text, "mean energy, kJ"));
}

/* Labels are sorted by the ends of the curves: here the mean with forest is above the mean without. */
TEST_WOODED(labels_are_in_the_order_of_the_ends)
{
    for (int i = 0; i < CELLS; i++) {
        s.wood_envelopes[i] = s.envelopes[i];
        s.wood_envelopes[i].mean_energy = 190e3;
        s.wood_envelopes[i].energy.p95 = 20e3;
    }
    LOCAL(ceduo_cells, cells) = draw_plot(CEDUO_PLOT_ENERGY, 70, 16, ASCII);
    const char *labels[] = {"forest mean", "without p95", "without mean", "forest p95"};
    char *text = ceduo_cells_dump(cells), *label = text;
    for (int i = 0; i < 4; i++) {
        label = strstr(label, labels[i]);
        assert_non_null(label);
    }
    free(text);
}

TEST_WOODED(strips_without_rocks_through_the_forest)
{
    stop_all_rocks();
    s.wooded[0] = NULL;
    picture.option = 1; /* no stems: both runs are equal and drawn as lines */
    LOCAL(ceduo_cells, cells) = draw_plot(CEDUO_PLOT_ENERGY, 70, 8, BRAILLE);
    assert_true(count_cells(cells, CEDUO_ROLE_FOREST) > 30);
    assert_in_range(count_cells(cells, CEDUO_ROLE_BARE), 13, 20); /* 13: the label */
}

TEST_BARE(strips_and_profile_have_the_same_columns)
{
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(70, 24, ASCII);
    struct ceduo_area above = {0, 0, 70, 16}, below = {0, 16, 70, 8};
    struct ceduo_span span;
    picture.span = &span;
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &cells->canvas, &above, &picture);
    ceduo_plot_draw(CEDUO_PLOT_HEIGHT, &cells->canvas, &below, &picture);
    int rules[2] = {0, 0};
    for (int column = 0; column < 70; column++) {
        rules[0] += ceduo_cells_role(cells, column, 5) == CEDUO_ROLE_CONTROL;
        rules[1] += ceduo_cells_role(cells, column, 5) == CEDUO_ROLE_CONTROL &&
                    ceduo_cells_role(cells, column, 20) == CEDUO_ROLE_CONTROL;
    }
    assert_int_equal(rules[0], 2);
    assert_int_equal(rules[1], 2);
}

/* ---- the stand ---- */

/* Adding stools does not move the others. */
TEST_BARE(existing_stools_do_not_move)
{
    s.belts[0].stand.trees_count = 0;
    LOCAL(ceduo_cells, few) = draw_plot(CEDUO_PLOT_STAND, 80, 40, BRAILLE);
    s.belts[0].stand.stools_per_ha *= 1.5;
    s.shoots.per_ha *= 1.5;
    LOCAL(ceduo_cells, more) = draw_plot(CEDUO_PLOT_STAND, 80, 40, BRAILLE);
    int dots[2] = {0, 0};
    for (int i = 0; i < 80 * 37; i++) {
        assert_int_equal(few->cell[i].dots & ~more->cell[i].dots, 0);
        dots[0] += few->cell[i].dots != 0;
        dots[1] += more->cell[i].dots != 0;
    }
    assert_true(dots[1] > dots[0]);
}

/* Trees of 10 cm, a rock of 3 m: trees with their centre less than 1.55 m from its path are hit, no others. A row of the
 * picture is half a metre. */
TEST_BARE(hit_stems_lie_in_the_strip_of_the_rock)
{
    s.scene.rock.diameter = ceduo_number(3);
    s.belts[0].stand.shoots_count = 0;
    s.trees.per_ha = 5000;
    s.trees.dbh = 0.1;
    LOCAL(ceduo_cells, cells) = draw_plot(CEDUO_PLOT_STAND, 80, 43, BRAILLE);
    for (int row = 0; row < 40; row++)
        for (int column = 0; column < 80; column++) {
            double off = fabs(0.503 * (row + 0.5 - 20)); /* m */
            enum ceduo_role role = ceduo_cells_role(cells, column, row);
            assert_false(role == CEDUO_ROLE_TRAJECTORY && off > 1.6 + 0.3);
            assert_false(role == CEDUO_ROLE_STEM && off < 1.5 - 0.3);
        }
    assert_true(count_cells(cells, CEDUO_ROLE_TRAJECTORY) > 10);
    assert_true(count_cells(cells, CEDUO_ROLE_STEM) > 50);
}

/* The picture shows 20 m around the last stem of the belt; offsets are stretched until the strip fills it. */
TEST_WOODED(the_stand_shows_the_trajectory)
{
    picture.stems = encountered;
    picture.stems_count = 3;
    LOCAL(ceduo_cells, cells) = draw_plot(CEDUO_PLOT_STAND, 60, 14, BRAILLE);
    assert_true(count_cells(cells, CEDUO_ROLE_TRAJECTORY) >= 2);
    assert_true(count_cells(cells, CEDUO_ROLE_DIM) >= 1);
    assert_int_equal(count_cells(cells, CEDUO_ROLE_STEM) + count_cells(cells, CEDUO_ROLE_STOOL), 0);
}

TEST_BARE(a_dense_stand_is_drawn_in_time)
{
    s.belts[0].stand.stools_per_ha = 1e6;
    s.shoots.per_ha = 1e7;
    ceduo_cells_free(draw_plot(CEDUO_PLOT_STAND, 200, 400, BRAILLE));
}

/* ---- all pictures ---- */

TEST_WOODED(nothing_is_drawn_outside_the_area)
{
    for (int i = 0; i < 3 * 40 * 12; i++) {
        enum ceduo_charset charset = (enum ceduo_charset)(i % 3);
        struct ceduo_area area = {7, 3, 4 + i / 3 % 40 * 3, 1 + i / 120 * 2};
        for (int plot = CEDUO_PLOT_PROFILE; plot < CEDUO_PLOTS; plot++) {
            LOCAL(ceduo_cells, cells) = ceduo_cells_create(area.width + 14, area.height + 6, charset);
            s.scene.simulation.contact_model = i / 3 % 2 ? CEDUO_CONTACT_MODEL_STEMS : CEDUO_CONTACT_MODEL_INDEX;
            picture.snapshot = i % 7 == 0 ? NULL : &s.snapshot;
            picture.stems = i % 11 < 3 ? encountered : NULL;
            picture.stems_count = i % 11 < 3 ? 4 : 0;
            picture.option = (size_t)(i % 5 == 0);
            ceduo_plot_draw((enum ceduo_plot)plot, &cells->canvas, &area, &picture);
            for (int row = 0; row < cells->height; row++)
                for (int column = 0; column < cells->width; column++) {
                    bool inside = column >= area.left && column < area.left + area.width && row >= area.top &&
                                  row < area.top + area.height;
                    if (!inside && ceduo_cells_role(cells, column, row) != CEDUO_ROLE_BLANK)
                        fail_msg("plot %d, charset %d, %dx%d: drawn at %d, %d", plot, (int)charset, area.width, area.height,
                                 column - area.left, row - area.top);
                }
        }
    }
}

/* A surface that draws nothing: it counts the drawing calls of a vector page. */
struct page {
    int lines, trajectories, bars, axes;
    bool outside; /* a line was outside its frame */
};

static void page_line(void *surface, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b)
{
    struct page *page = surface;
    double right = pen->raster.nx - 0.5 + 1e-9, bottom = pen->raster.ny - 0.5 + 1e-9, edge = -0.5 - 1e-9;
    *(pen->stroke == CEDUO_STROKE_TRAJECTORY ? &page->trajectories : &page->lines) += 1;
    page->outside |= !(a.x >= edge && a.x <= right && b.x >= edge && b.x <= right && a.y >= edge && a.y <= bottom &&
                       b.y >= edge && b.y <= bottom);
}

static void page_bar(void *surface, int column, int row, int width, double fraction, enum ceduo_role role)
{
    struct page *page = surface;
    (void)column, (void)row, (void)width, (void)role;
    page->bars++;
    page->outside |= !(fraction > 0 && fraction <= 1);
}

static void page_axis(void *surface, const struct ceduo_frame *frame, bool bottom, int count, const struct ceduo_tick *ticks)
{
    (void)frame, (void)bottom, (void)count, (void)ticks;
    ((struct page *)surface)->axes++;
}

TEST_WOODED(pictures_can_be_drawn_on_another_surface)
{
    static const struct ceduo_surface surface = {.line = page_line, .bar = page_bar, .axis = page_axis};
    struct ceduo_area area = {0, 0, 100, 30};
    for (int plot = CEDUO_PLOT_PROFILE; plot < CEDUO_PLOTS; plot++) {
        struct page page = {0};
        struct ceduo_cells *cells = ceduo_cells_create(area.width, area.height, CEDUO_CHARSET_BRAILLE);
        struct ceduo_canvas canvas = {&surface, cells, &page, 8, 16, false};
        bool bars = ceduo_plot_kinds[plot].flags & CEDUO_PICTURE_PAGE;
        ceduo_plot_draw((enum ceduo_plot)plot, &canvas, &area, &picture);
        char *words = ceduo_cells_dump(cells);
        if (strspn(words, "\n") == strlen(words) || page.outside)
            fail_msg("%s: outside: %d, words:\n%s", ceduo_plot_kinds[plot].name, page.outside, words);
        free(words);
        ceduo_cells_free(cells);
        bool computed = !(ceduo_plot_kinds[plot].flags & CEDUO_PICTURE_YEARS) && plot != CEDUO_PLOT_UNCERTAINTY &&
                        plot != CEDUO_PLOT_HAZARD && plot != CEDUO_PLOT_FENCE;
        if (computed && (bars ? page.bars == 0 : page.lines == 0 || page.axes == 0))
            fail_msg("%s: %d lines, %d bars, %d axes", ceduo_plot_kinds[plot].name, page.lines, page.bars, page.axes);
        if (plot == CEDUO_PLOT_PROFILE && page.trajectories == 0)
            fail_msg("profile: no trajectories");
    }
}

/* Three options: one in the middle, one with less yield and more rocks passing, one without a yield. */
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
    picture.verdict = &verdict;
    expect_picture(CEDUO_PLOT_TRADEOFF, 60, 16, ASCII, "a-point-for-each-option");
    choices[0].yield.cut_per_year = choices[1].yield.cut_per_year = NAN;
    assert_true(picture_contains(CEDUO_PLOT_TRADEOFF, 60, 16, "no option has growth and cutting data"));
    assert_true(picture_contains(CEDUO_PLOT_TRADEOFF, 20, 16, "too narrow"));
    picture.verdict = NULL;
    assert_true(picture_contains(CEDUO_PLOT_TRADEOFF, 60, 16, "not computed yet"));
}

TEST_BARE(titles_describe_the_picture)
{
    static const struct {
        const char *title, *without_forest;
    } expected[CEDUO_PLOTS] = {
        {NULL, NULL},
        {"kept: slope, forest, and trajectories", ", without forest"},
        {"kept: energy of the rocks", ", without forest"},
        {"kept: height of the rocks above the ground", ", without forest"},
        {"kept: energy at path (40 m)", ", without forest"},
        {"kept: year by year, up to path (40 m)", ""},
        {"Over the years, up to path (40 m)", ""},
        {"kept: coppice, from above", ""},
        {"Options side by side, up to path (40 m)", ""},
        {"Options over the years ahead, up to path (40 m)", ""},
        {"Protection and yield of the options, up to path (40 m)", ""},
        {"kept: how sure it is at path (40 m)", ""},
        {"How often, and with how much, at path (40 m)", ""},
        {"Which class of fence is enough at path (40 m)", ""},
    };
    for (int i = 0; i < 2 * (CEDUO_PLOTS - 1); i++) {
        int plot = CEDUO_PLOT_PROFILE + i / 2;
        LOCAL_TEXT(title);
        LOCAL_TEXT(wanted);
        s.scene.simulation.contact_model = i % 2 ? CEDUO_CONTACT_MODEL_STEMS : CEDUO_CONTACT_MODEL_INDEX;
        ceduo_plot_title(&title, (enum ceduo_plot)plot, &picture);
        ceduo_text_format(&wanted, "%s%s", expected[plot].title, i % 2 ? "" : expected[plot].without_forest);
        assert_string_equal(ceduo_text_string(&title), wanted.bytes);
    }
    assert_int_equal(ceduo_scene_last_control(&s.scene), 1);
}
