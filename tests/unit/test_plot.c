/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command_line.h"
#include "cli/options.h"
#include "view/cells.h"
#include "view/plots.h"

#define BRAILLE CEDUO_CHARSET_BRAILLE
#define BLOCK   CEDUO_CHARSET_BLOCK
#define ASCII   CEDUO_CHARSET_ASCII

/* ---- a small scene ---- */

#define CELLS         10
#define ENERGIES      8
#define WOOD_ENERGIES 5

/* A slope of 100 m that falls 60 m, a path at 40 m and a road at 80 m, a coppice with standards between. Numbers are
 * round so that a reader can check a picture by eye. It points into itself: never copy it. */
struct site {
    struct ceduo_scene scene;
    double x[3], z[3];
    struct ceduo_segment segments[2];
    struct ceduo_control controls[2];
    struct ceduo_option options[2];
    struct ceduo_belt belts[2];
    struct ceduo_stems shoots, trees;
    struct ceduo_outlook outlook;
    struct ceduo_sight bare, wood;
    struct ceduo_sight *wooded[2];
    struct ceduo_arrivals arrivals[2], wood_arrivals[2];
    struct ceduo_energies energies[2], wood_energies[2];
    struct ceduo_trail trail, wood_trail;
    double cell_x[CELLS], values[ENERGIES], wood_values[WOOD_ENERGIES];
    double trail_x[5], trail_z[5], wood_trail_x[3], wood_trail_z[3];
    struct ceduo_envelope envelopes[CELLS], wood_envelopes[CELLS];
};

static void set_ground(struct site *s)
{
    const double x[3] = {0, 50, 100}, z[3] = {0, -40, -60};
    memcpy(s->x, x, sizeof x);
    memcpy(s->z, z, sizeof z);
    for (int i = 0; i < 2; i++)
        s->segments[i] = (struct ceduo_segment){.rn = ceduo_number(0.4),
                                                .rt = ceduo_number(0.9),
                                                .roughness_m = NAN,
                                                .roughness_rad = 0.1,
                                                .friction = 0.3};
    s->scene.slope = (struct ceduo_slope){
        .facets = CEDUO_AGAINST, .vertices = 3, .x = s->x, .z = s->z, .segments = s->segments, .origin_z = 60};
}

static void set_forest(struct site *s)
{
    s->shoots = (struct ceduo_stems){.per_ha = 2000, .dbh = 0.08, .height = 8, .volume = 0.02, .age = NAN};
    s->trees = (struct ceduo_stems){.per_ha = 100, .dbh = 0.3, .height = 20, .volume = 0.6, .age = NAN};
    s->belts[0] = (struct ceduo_belt){.from = 20,
                                      .to = 70,
                                      .from_given = 20,
                                      .to_given = 70,
                                      .name = "coppice",
                                      .assumed = true,
                                      .stand = {.system = CEDUO_COPPICE_WITH_STANDARDS,
                                                .species = -1,
                                                .stools_per_ha = 800,
                                                .spacing = 0.5,
                                                .shoots_count = 1,
                                                .trees_count = 1,
                                                .shoots = &s->shoots,
                                                .trees = &s->trees,
                                                .u = 102800}};
    s->belts[1] = s->belts[0];
    s->belts[1].name = "cut";
    s->belts[1].assumed = false;
    s->belts[1].stand = (struct ceduo_stand){.system = CEDUO_BARE, .species = -1, .u = NAN};
    s->options[0] = (struct ceduo_option){"kept", 1, &s->belts[0]};
    s->options[1] = (struct ceduo_option){"felled", 1, &s->belts[1]};
}

static const struct ceduo_envelope no_rock = {
    .mean_energy = NAN, .speed = {NAN, NAN, NAN, NAN}, .height = {NAN, NAN, NAN, NAN}, .energy = {NAN, NAN, NAN, NAN}};

/* Heights of 1, 2, 3 m and energies of 10 kJ a cell more from place to place; eight rocks of ten at the path. */
static void set_bare(struct site *s)
{
    static const double kj[ENERGIES] = {12, 21, 25, 33, 34, 38, 47, 55};
    static const double x[5] = {0, 20, 40, 60, 80}, z[5] = {0, -10, -30, -42, -52};
    for (int i = 0; i < CELLS; i++) {
        double e = 10e3 * (i + 1);
        s->cell_x[i] = 10 * i + 5;
        s->envelopes[i] = (struct ceduo_envelope){
            .passed = 8, .mean_energy = e, .height = {0.5, 1, 2, 3}, .energy = {0.5 * e, 0.9 * e, 1.5 * e, 2 * e}};
    }
    for (int i = 0; i < ENERGIES; i++)
        s->values[i] = 1e3 * kj[i];
    memcpy(s->trail_x, x, sizeof x);
    memcpy(s->trail_z, z, sizeof z);
    s->trail = (struct ceduo_trail){5, s->trail_x, s->trail_z};
    s->arrivals[0] = (struct ceduo_arrivals){
        .released = 10, .reached = 8, .exceeded = 2, .reach_probability = 0.8, .exceed_probability = 0.2};
    s->arrivals[0].energy = (struct ceduo_distribution){.mean = 33125, .p50 = 33e3, .p95 = 55e3, .max = 55e3};
    s->arrivals[1] = (struct ceduo_arrivals){.released = 10, .exceed_probability = NAN};
    s->arrivals[1].energy = ceduo_distribution_none();
    s->energies[0] = (struct ceduo_energies){ENERGIES, s->values};
    s->energies[1] = (struct ceduo_energies){0, s->values};
    s->bare = (struct ceduo_sight){.references = 1,
                                   .flown = {.rocks = 10, .controls = 2, .arrivals = s->arrivals},
                                   .picture_rocks = 10,
                                   .envelopes = s->envelopes,
                                   .energies = s->energies,
                                   .trails_count = 1,
                                   .trails = &s->trail};
}

/* Lower and slower, and no further than 70 m; five rocks of ten at the path. */
static void set_wood(struct site *s)
{
    static const double kj[WOOD_ENERGIES] = {8, 15, 21, 25, 41};
    static const double x[3] = {0, 20, 40}, z[3] = {0, -12, -32};
    for (int i = 0; i < CELLS; i++) {
        double e = i < 4 ? 8e3 * (i + 1) : 32e3 - 8e3 * (i - 3);
        s->wood_envelopes[i] = (struct ceduo_envelope){
            .passed = 5, .mean_energy = e, .height = {0.3, 0.6, 1.5, 2}, .energy = {0.5 * e, 0.9 * e, 1.5 * e, 2 * e}};
        if (i >= 7)
            s->wood_envelopes[i] = no_rock;
    }
    for (int i = 0; i < WOOD_ENERGIES; i++)
        s->wood_values[i] = 1e3 * kj[i];
    memcpy(s->wood_trail_x, x, sizeof x);
    memcpy(s->wood_trail_z, z, sizeof z);
    s->wood_trail = (struct ceduo_trail){3, s->wood_trail_x, s->wood_trail_z};
    s->wood_arrivals[0] = (struct ceduo_arrivals){
        .released = 10, .reached = 5, .exceeded = 1, .reach_probability = 0.5, .exceed_probability = 0.1};
    s->wood_arrivals[0].energy = (struct ceduo_distribution){.mean = 22e3, .p50 = 21e3, .p95 = 41e3, .max = 41e3};
    s->wood_arrivals[1] = s->arrivals[1];
    s->wood_energies[0] = (struct ceduo_energies){WOOD_ENERGIES, s->wood_values};
    s->wood_energies[1] = (struct ceduo_energies){0, s->wood_values};
    s->wood = (struct ceduo_sight){.references = 1,
                                   .key = 1,
                                   .flown = {.rocks = 10, .controls = 2, .arrivals = s->wood_arrivals},
                                   .picture_rocks = 10,
                                   .envelopes = s->wood_envelopes,
                                   .energies = s->wood_energies,
                                   .trails_count = 1,
                                   .trails = &s->wood_trail};
}

static void site_init(struct site *s)
{
    *s = (struct site){.scene = {.title = "small",
                                 .rock = ceduo_scene_default().rock,
                                 .simulation = ceduo_scene_default().simulation,
                                 .controls_count = 2,
                                 .controls = s->controls,
                                 .options_count = 2,
                                 .options = s->options}};
    s->scene.rock.diameter = ceduo_number(0.8);
    s->scene.release.vx = ceduo_number(1);
    s->controls[0] = (struct ceduo_control){40, 40, "path", 40e3, NAN};
    s->controls[1] = (struct ceduo_control){80, 80, NULL, NAN, NAN};
    set_ground(s);
    set_forest(s);
    set_bare(s);
    set_wood(s);
    s->outlook = (struct ceduo_outlook){
        .cells = CELLS, .controls = 2, .options = 2, .cell_x = s->cell_x, .bare = &s->bare, .wooded = s->wooded};
    s->scene.simulation.contact_model = CEDUO_INDEX;
    assert_int_equal(ceduo_scene_check(&s->scene, NULL), CEDUO_OK);
}

/* The same with rocks among stems. Where none stand what is to be seen is the slope without forest. */
static void wooded_site_init(struct site *s)
{
    site_init(s);
    s->scene.simulation.contact_model = CEDUO_STEMS;
    s->wooded[0] = &s->wood;
    s->wooded[1] = &s->bare;
}

/* Through the wood no rock gets to the path. */
static void stop_all(struct site *s)
{
    for (int i = 0; i < CELLS; i++)
        s->wood_envelopes[i] = no_rock;
    s->wood_energies[0].n = 0;
    s->wood_arrivals[0] = (struct ceduo_arrivals){.released = 10, .energy = ceduo_distribution_none()};
}

static struct ceduo_picture picture_of(const struct site *s)
{
    return (struct ceduo_picture){.scene = &s->scene, .outlook = &s->outlook};
}

static struct ceduo_cells *draw(enum ceduo_plot plot, const struct ceduo_picture *p, int width, int height,
                                 enum ceduo_charset charset)
{
    struct ceduo_cells *cells = ceduo_cells_create(width, height, charset);
    assert_non_null(cells);
    struct ceduo_area area = {0, 0, width, height};
    ceduo_plot_kinds[plot].draw(&cells->canvas, &area, p);
    return cells;
}

static void expect(enum ceduo_plot plot, const struct ceduo_picture *p, int width, int height,
                   enum ceduo_charset charset, const char *expected)
{
    struct ceduo_cells *cells = draw(plot, p, width, height, charset);
    char *text = ceduo_cells_dump(cells);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
    ceduo_cells_free(cells);
}

static bool shows(enum ceduo_plot plot, const struct ceduo_picture *p, int width, int height, const char *words)
{
    struct ceduo_cells *cells = draw(plot, p, width, height, ASCII);
    char *text = ceduo_cells_dump(cells);
    assert_non_null(text);
    bool found = strstr(text, words) != NULL;
    free(text);
    ceduo_cells_free(cells);
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

/* ---- the profile ---- */

static void profile_is_true_to_scale(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_PROFILE, &p, 72, 22, ASCII,
           "                         v path (40 m)         v 80 m\n"
           "  |v release             '                     '\n"
           "60+'..           :       '                     '\n"
           "  |  '':..       :       '                     '\n"
           "  |     '.''..   :    .  '                     '\n"
           "50+       '.. '.::    :  '                     '\n"
           "  |          '. ::  . :  '  .                  '\n"
           "40+            '::'.: :  '  :                  '\n"
           "  |               '.:.: .'  :    :             '\n"
           "  |                 '.:.:'  :    :     :       '\n"
           "30+                   ''::  :    :     :       '\n"
           "  |                      ':':.  ::     :       '\n"
           "  |                      ' ''.''::  :  :       '\n"
           "20+                      '    ''::'':  ::      '\n"
           "  |                      '        '''::::      '\n"
           "  |                      '             ''':..  '\n"
           "10+                      '                  ''':..\n"
           "  |                      '                     '  ''...\n"
           " 0+                      '                     '       ''..\n"
           "  ++----+-----+----+-----+----+-----+----+-----+----+-----+\n"
           "   0 m  10    20   30    40   50    60   70    80   90  100\n"
           "              +-------- coppice* --------+\n");
    expect(CEDUO_PLOT_PROFILE, &p, 44, 16, BRAILLE,
           "   ▼ release     ▼ path (40 m)  ▼ 80 m\n"
           "60┤⣀        ⡀    ⠨              ⠨\n"
           "  │⠈⠛⢖⠤⣀    ⡇    ⠨              ⠨\n"
           "  │   ⠉⠢⡉⠒⠤⣠⡇   ⡆⠨              ⠨\n"
           "  │     ⠈⠑⢄⢸⡧⣠  ⡇⠨ ⢀            ⠨\n"
           "40┤        ⠉⠧⣸⢆⢰⡇⠨ ⢸   ⡀        ⠨\n"
           "  │           ⠑⢽⣇⢸ ⢸   ⡇   ⡄    ⠨\n"
           "  │             ⠉⠻⣤⣸ ⢠ ⡇   ⡇    ⠨\n"
           "  │              ⠨ ⠙⠵⣺⢄⣿ ⢠ ⣇    ⠨\n"
           "20┤              ⠨   ⠈⠑⠿⢖⣼⣀⣿    ⠨\n"
           "  │              ⠨       ⠈⠉⠛⠲⢤⣀ ⠨\n"
           "  │              ⠨            ⠈⠉⠺⠤⢄⡀\n"
           " 0┤              ⠨              ⠨  ⠈⠑⠒⠤⣀\n"
           "  └┬──────┬──────┬───────┬──────┬──────┬─\n"
           "   0 m    20     40      60     80    100\n"
           "          ├─── coppice* ────┤\n");
}

static void span_tells_where_the_slope_stands(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    struct ceduo_cells *cells = ceduo_cells_create(80, 24, BRAILLE);
    struct ceduo_area area = {0, 0, 80, 24};
    struct ceduo_span span;
    ceduo_plot_profile(&cells->canvas, &area, &p, &span);
    assert_true(span.x0 == 0);
    assert_true(span.x1 >= 100 && span.x1 < 104);
    assert_true(span.left >= 3 && span.left + span.width <= 80);
    p.from = 40;
    p.to = 60;
    ceduo_cells_clear(cells);
    ceduo_plot_profile(&cells->canvas, &area, &p, &span);
    assert_true(span.x0 == 40);
    assert_true(span.x1 >= 60 && span.x1 < 62);
    ceduo_cells_free(cells);
}

static void heights_are_stretched_where_the_slope_is_flat_and_the_factor_is_written(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    p.outlook = NULL;
    s.options[0].belts_count = 0;
    s.z[1] = -2;
    s.z[2] = -3;
    s.scene.slope.origin_z = 3;
    expect(CEDUO_PLOT_PROFILE, &p, 60, 12, ASCII,
           "  v release              v path (40 m)     80 m v heights x8\n"
           "3+..                     '                      '\n"
           " |  '''....              '                      '\n"
           " |         '''...        '                      '\n"
           "2+               '''...  '                      '\n"
           " |                     ''''...                  '\n"
           "1+                       '    ''''......        '\n"
           " |                       '              '''''...:..\n"
           "0+                       '                      '  ''''''...\n"
           " ++-----+----+-----+-----+-----+----+-----+-----+----+-----+\n"
           "  0 m   10   20    30    40    50   60    70    80   90  100\n"
           "  no forest\n");
    assert_false(shows(CEDUO_PLOT_PROFILE, &p, 200, 8, "heights"));
    s.z[1] = -800; /* a wall: pressed */
    s.z[2] = -900;
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 60, 12, "heights x0."));
}

static void the_selected_way_is_drawn_over_all(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    struct ceduo_cells *cells = draw(CEDUO_PLOT_PROFILE, &p, 60, 20, BRAILLE);
    assert_int_equal(cells_of(cells, CEDUO_ROLE_WAY), 0);
    assert_true(cells_of(cells, CEDUO_ROLE_STEM) > 5);
    assert_true(cells_of(cells, CEDUO_ROLE_STOOL) > 5);
    assert_true(cells_of(cells, CEDUO_ROLE_CLOUD) > 0);
    ceduo_cells_free(cells);
    p.selected = &s.trail;
    cells = draw(CEDUO_PLOT_PROFILE, &p, 60, 20, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_WAY) > 10);
    ceduo_cells_free(cells);
}

static void the_wooded_profile_says_whose_forest_it_is(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_PROFILE, &p, 84, 20, ASCII,
           "                      v path (40 m)       v 80 m\n"
           "  |v release          '                   '\n"
           "60+'..         :      '                   '            true to scale\n"
           "  |  '':.      :      '                   '            1 ways of 10 through\n"
           "50+     ':'..  :    : '                   '             kept\n"
           "  |       ''.'.:    : '                   '\n"
           "  |          '.:.  .: '  :                '            At 40 m, wood (bare)\n"
           "40+            '':.:: '  :    .           '             500 (800) of 1000\n"
           "  |               ':: ': :    :   .       '             100 (200) > 40 kJ\n"
           "30+                 '':: : .  :   :       '\n"
           "  |                   ''.: :  :.  :       '            At 80 m, wood (bare)\n"
           "20+                   '   ':. ::  ::      '             0 (0) of 1000\n"
           "  |                   '      '':. ::      '\n"
           "  |                   '          '''..    '            coppice*\n"
           "10+                   '               '''.:             20-70 m\n"
           "  |                   '                   '''...        2100 stems/ha\n"
           " 0+                   '                   '     ''..    up to 20 m high\n"
           "  ++---------+--------+---------+---------+--------+-\n"
           "   0 m       20       40        60        80      100\n"
           "             +------ coppice* -------+\n");
    s.options[0].name = "coppice with standards";
    expect(CEDUO_PLOT_PROFILE, &p, 60, 16, BRAILLE,
           "   ▼ release     ▼ path (40 m)  ▼ 80 m\n"
           "60┤⡀        ⡀    ⠨              ⠨ ways: coppice with standa…\n"
           "  │⠈⠓⢦⣀     ⡇    ⠨              ⠨\n"
           "  │   ⠉⠫⡢⢄⡀⢠⡇   ⡆⠨              ⠨\n"
           "  │     ⠈⠑⢌⢺⡇⢠  ⡇⠨ ⢀            ⠨\n"
           "40┤        ⠉⠯⣺⡀⢰⡇⠨ ⢸   ⡀        ⠨\n"
           "  │           ⠙⢾⡇⢸ ⢸   ⡇   ⡄    ⠨\n"
           "  │             ⠉⠺⣀⢸ ⢠ ⡇   ⡇    ⠨\n"
           "  │              ⠨ ⠙⠤⣸ ⣿ ⢠ ⣇    ⠨\n"
           "20┤              ⠨   ⠈⠑⠿⢄⣸ ⣿    ⠨\n"
           "  │              ⠨       ⠈⠉⠛⠢⢄⡀ ⠨\n"
           "  │              ⠨            ⠈⠉⠺⠤⢄⡀\n"
           " 0┤              ⠨              ⠨  ⠈⠑⠒⠤⣀\n"
           "  └┬──────┬──────┬───────┬──────┬──────┬─\n"
           "   0 m    20     40      60     80    100\n"
           "          ├─── coppice* ────┤\n");
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 54, 16, "ways: coppice w"));
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 40, 12, "ways: copp"));
    p.option = 1;
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, "without forest"));
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, " no stems"));
    assert_false(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, "through"));
}

static void ways_that_are_not_known_are_not_drawn(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    s.wooded[0] = NULL;
    struct ceduo_cells *cells = draw(CEDUO_PLOT_PROFILE, &p, 60, 16, BRAILLE);
    assert_int_equal(cells_of(cells, CEDUO_ROLE_CLOUD), 0);
    assert_true(cells_of(cells, CEDUO_ROLE_STOOL) > 5);
    ceduo_cells_free(cells);
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, "ways not computed yet"));
    assert_false(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, "of 1000"));
    assert_false(shows(CEDUO_PLOT_PROFILE, &p, 60, 16, "ways:"));
}

static void notes_tell_when_no_rock_arrives(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    stop_all(&s);
    struct ceduo_picture p = picture_of(&s);
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, " 0 (800) of 1000"));
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, " 0 (200) > 40 kJ"));
    s.arrivals[0].exceed_probability = NAN;
    s.wood_arrivals[0].exceed_probability = NAN;
    assert_false(shows(CEDUO_PLOT_PROFILE, &p, 84, 20, "> 40 kJ"));
}

/* Two of the upper half hit, one flown over; one in the lower half. */
static const struct ceduo_stem_passed passed[] = {
    {.x = 22, .y = 0.3, .dbh = 0.3, .height = 20, .hit = true},
    {.x = 27, .y = -0.1, .dbh = 0.08, .height = 8, .shoot = true, .hit = true},
    {.x = 32, .y = 0.2, .dbh = 0.08, .height = 8, .shoot = true},
    {.x = 62, .y = -0.4, .dbh = 0.08, .height = 8, .shoot = true, .hit = true},
};

/* The rows of a column that hold dots of a role. */
static int rows_of(const struct ceduo_cells *cells, int column, enum ceduo_role role)
{
    int n = 0;
    for (int row = 0; row < cells->height; row++)
        n += ceduo_cells_role(cells, column, row) == role;
    return n;
}

static void stems_that_the_rock_came_to_stand_where_they_are(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    p.outlook = NULL;
    p.stems = passed;
    p.stems_count = 4;
    struct ceduo_cells *cells = ceduo_cells_create(84, 40, BRAILLE);
    struct ceduo_area area = {0, 0, 84, 40};
    struct ceduo_span span;
    ceduo_plot_profile(&cells->canvas, &area, &p, &span);
    double metres = (span.x1 - span.x0) / (2 * span.width - 1); /* of a dot, either way */
    assert_int_equal(cells_of(cells, CEDUO_ROLE_STEM) + cells_of(cells, CEDUO_ROLE_STOOL), 0);
    for (int i = 0; i < 4; i++) {
        int column = span.left + (int)lround((passed[i].x - span.x0) / metres) / 2;
        double rows = passed[i].height / metres / 4;
        int found = rows_of(cells, column, passed[i].hit ? CEDUO_ROLE_WAY : CEDUO_ROLE_DIM);
        assert_true(found >= rows - 2 && found <= rows + 1);
    }
    ceduo_cells_free(cells);
    expect(CEDUO_PLOT_PROFILE, &p, 84, 20, ASCII,
           "                      v path (40 m)       v 80 m\n"
           "  |v release  .       '                   '\n"
           "60+'.         :       '                   '            true to scale\n"
           "  |  ''.      :       '                   '            ways not computed yet\n"
           "50+     '.    :       '                   '            stems this rock came to\n"
           "  |       ''. : .     '                   '\n"
           "  |          ': :  :  '                   '            coppice*\n"
           "40+            ''. :  '                   '             20-70 m\n"
           "  |               ':. '                   '             2100 stems/ha\n"
           "30+                  ':                   '             up to 20 m high\n"
           "  |                   ''..                '\n"
           "20+                   '   '..    :        '\n"
           "  |                   '      ''..:        '\n"
           "  |                   '          '''..    '\n"
           "10+                   '               '''.:\n"
           "  |                   '                   '''...\n"
           " 0+                   '                   '     ''..\n"
           "  ++---------+--------+---------+---------+--------+-\n"
           "   0 m       20       40        60        80      100\n"
           "             +------ coppice* -------+\n");
}

/* By the contact model poisson a contact has a place along the way, but no size. */
static void contacts_without_size_are_drawn_as_high_as_the_stand(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    s.scene.simulation.contact_model = CEDUO_POISSON;
    struct ceduo_stem_passed contact[] = {
        {.x = 30, .y = NAN, .dbh = NAN, .height = INFINITY, .hit = true},
        {.x = 90, .y = NAN, .dbh = NAN, .height = INFINITY, .hit = true}, /* no belt: no height */
        {.x = 200, .y = NAN, .dbh = NAN, .height = INFINITY, .hit = true}};
    struct ceduo_picture p = picture_of(&s);
    p.stems = contact;
    p.stems_count = 3;
    struct ceduo_cells *cells = draw(CEDUO_PLOT_PROFILE, &p, 84, 40, BRAILLE);
    assert_in_range(cells_of(cells, CEDUO_ROLE_WAY), 6, 12);
    ceduo_cells_free(cells);
    assert_true(shows(CEDUO_PLOT_STAND, &p, 84, 20, "One pattern of many"));
}

/* Survey coordinates on the axes, the same picture. */
static void axes_have_the_users_coordinates(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    s.scene.slope.origin_x = 481000;
    s.scene.slope.origin_z = 1000;
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 80, 24, "481040"));
    assert_true(shows(CEDUO_PLOT_PROFILE, &p, 80, 24, " 960+"));
    assert_true(shows(CEDUO_PLOT_HEIGHT, &p, 80, 24, "481040"));
}

/* ---- strips ---- */

static void strips_show_quantiles_along_the_slope(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_HEIGHT, &p, 60, 12, ASCII,
           "  height above the ground, m\n"
           "3+    .   .   .   .   :   .   .   .   .   .'  .   .    max\n"
           " |                    '                    '\n"
           " |                    '                    '\n"
           "2+    ' ' ' ' ' ' ' ' ' ' ' ' ' ' ' ' ' ' ''' ' ' '    p95\n"
           " |                    '                    '\n"
           " |                    '                    '\n"
           "1+   ''''''''''''''''''''''''''''''''''''''''''''''    p50\n"
           " |                    '                    '\n"
           "0+                    '                    '\n"
           " ++---------+---------+----------+---------+---------+\n"
           "  0 m       20        40         60        80      100\n");
    expect(CEDUO_PLOT_ENERGY, &p, 60, 16, BRAILLE,
           "    energy, kJ\n"
           "150┤                    ⠅                  ⠨      ⡀⠄   p95\n"
           "   │                    ⠅                  ⠨  ⡀⠄⠂⠁\n"
           "   │                    ⠅                 ⡀⠬⠂⠁\n"
           "   │                    ⠅             ⡀⠄⠂⠁ ⠨\n"
           "100┤                    ⠅         ⡀⠄⠂⠁     ⠨      ⢀⡀   mean\n"
           "   │                    ⠅     ⡀⠄⠂⠁         ⢨⣀⡠⠤⠒⠊⠉⠅    p50\n"
           "   │                    ⠅ ⡀⠄⠂⠁       ⣀⡠⠤⠔⠒⡉⠩⠄ ⠂ ⠁\n"
           "   │                  ⡀⠄⠇⠁      ⣀⠤⠔⠊⡉ ⠄ ⠁  ⠨\n"
           " 50┤              ⡀⠄⠂⠁  ⠅ ⣀⡠⡤⠒⠎⠉⠂ ⠁        ⠨     ⡀⡀⡀   p5\n"
           "   │      bears 40 kJ⠤⡴⠶⠭⠭⠂          ⡀⡀⡀⠄⠄⠄⠪⠂⠂⠁⠁⠁\n"
           "   │      ⡀⠄⠂⢁⣀⠤⠖⠊⠋ ⠁   ⠅⡀⡀⡀⠄⠄⠄⠂⠂⠂⠁⠁⠁      ⠨\n"
           "   │   ⢄⣂⠥⠤⠒⠊⡁⡁⡀⠄⠄⠄⠂⠂⠂⠁⠁⠅                  ⠨\n"
           "  0┤  ⠈⠃⠂⠂⠁⠁⠁           ⠅                  ⠨\n"
           "   └┬─────────┬─────────┬────────┬─────────┬─────────┬\n"
           "    0 m       20        40       60        80      100\n");
}

/* Strokes through the forest, dots without it. */
static void strips_show_the_wood_beside_the_bare_slope(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_HEIGHT, &p, 70, 16, ASCII,
           "    height above ground, m  -- wood  .. bare\n"
           "2.0+    .   .   .   .   . ' .   .   .   .   .   :   .   .    bare p95\n"
           "   |                      '                     '\n"
           "   |                      '                     '\n"
           "1.5+   .  ....  ....  ....' ....  ....          '            wood p95\n"
           "   |                      '                     '\n"
           "   |                      '                     '\n"
           "1.0+    . . . . . . . . . : . . . . . . . . . . : . . . .    bare p50\n"
           "   |                      '                     '\n"
           "   |                      '                     '\n"
           "0.5+   ''''''''''''''''''''''''''''''''''       '            wood p50\n"
           "   |                      '                     '\n"
           "   |                      '                     '\n"
           "0.0+                      '                     '\n"
           "   ++----------+----------+----------+----------+----------+\n"
           "    0 m        20         40         60         80       100\n");
    expect(CEDUO_PLOT_ENERGY, &p, 70, 16, BRAILLE,
           "    energy, kJ  ── wood  ·· bare\n"
           "150┤                      ⠅                    ⠨            bare p95\n"
           "   │                      ⠅                    ⠨    ⠄ ⠁\n"
           "   │                      ⠅                   ⡀⠨⠂ ⠁\n"
           "   │                      ⠅               ⡀ ⠂  ⠨\n"
           "100┤                      ⠅           ⠄ ⠁      ⠨       ⡀    bare mean\n"
           "   │                      ⠅       ⠄ ⠁          ⠨⡀⡀⠄⠂⠂⠁⠁\n"
           "   │                      ⠅ ⡀ ⠂ ⠁        ⡀⡀⠄⠄⠂⠁⠩\n"
           "   │                    ⡀ ⠇        ⡀⠄⠄⠂⠂⠁      ⠨\n"
           " 50┤                ⠄ ⢂⡀  ⠅ ⡀⡀⠄⠂⠂⠁⠁            ⠨\n"
           "   │        bears 40 kJ⠌⠦⠶⠥⠥⣀                  ⠨\n"
           "   │      ⡀ ⠂⣀⡥⡀⠎⣅⣂⠥⠥⠤⠒⠒⠢⠤⠥⢄⣀⡉ ⠒⠤ ⣀            ⠨\n"
           "   │   ⣀⣦⣄⣖⠯⠦⠓⠒⠉⠉         ⠅  ⠈⠉⠑⠒⠢⠤⢍⣀⣒⡤        ⠨            wood p95\n"
           "  0┤  ⠈⠉                  ⠅           ⠈⠉       ⠨            wood mean\n"
           "   └┬──────────┬──────────┬─────────┬──────────┬──────────┬\n"
           "    0 m        20         40        60         80       100\n");
    struct ceduo_cells *cells = draw(CEDUO_PLOT_ENERGY, &p, 70, 16, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_WOOD) > 30);
    assert_true(cells_of(cells, CEDUO_ROLE_BARE) > 30);
    ceduo_cells_free(cells);
}

/* Where there is no room for four curves: the one that matters, with and without forest. */
static void small_strips_show_one_pair_of_curves(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_ENERGY, &p, 70, 8, ASCII,
           "    mean energy, kJ  -- wood  .. bare\n"
           "100+                        '                      '  . . . '    bare\n"
           "   |                        '           . . . ' ' '''\n"
           " 50+                      . : . . ' ' '            '\n"
           "   |        . bears 40 kJ'''::....                 '\n"
           "  0+   '''''''''            '     '''''''''        '             wood\n"
           "   ++-----+-----+-----+-----+-----+----+-----+-----+-----+-----+\n"
           "    0 m   10    20    30    40    50   60    70    80    90  100\n");
    expect(CEDUO_PLOT_HEIGHT, &p, 70, 8, BRAILLE,
           "  p95 of the height, m  ── wood  ·· bare\n"
           "2┤    ⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠪⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠇⠂⠂⠂⠂⠂⠂⠂⠂⠂    bare\n"
           " │   ⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠺⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠒⠂        ⠅             wood\n"
           "1┤                        ⠨                        ⠅\n"
           " │                        ⠨                        ⠅\n"
           "0┤                        ⠨                        ⠅\n"
           " └┬─────┬─────┬─────┬─────┬──────┬─────┬─────┬─────┬─────┬─────┬\n"
           "  0 m   10    20    30    40     50    60    70    80    90  100\n");
    assert_true(shows(CEDUO_PLOT_ENERGY, &p, 50, 24, "mean energy, kJ  -- wood  .. bare"));
    assert_false(shows(CEDUO_PLOT_ENERGY, &p, 50, 24, "p95"));
    struct ceduo_span span = {4, 60, 0, 100}; /* leaves no room for names */
    struct ceduo_area area = {0, 0, 70, 20};
    struct ceduo_cells *cells = ceduo_cells_create(70, 20, ASCII);
    ceduo_plot_energy(&cells->canvas, &area, &p, &span, true);
    char *text = ceduo_cells_dump(cells);
    assert_non_null(strstr(text, "mean energy, kJ"));
    free(text);
    ceduo_cells_free(cells);
}

/* Names stand in the order in which the curves end: here the wooded mean above the bare one. */
static void names_of_curves_follow_their_ends(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    for (int i = 0; i < CELLS; i++) {
        s.wood_envelopes[i] = s.envelopes[i];
        s.wood_envelopes[i].mean_energy = 190e3;
        s.wood_envelopes[i].energy.p95 = 20e3;
    }
    struct ceduo_cells *cells = draw(CEDUO_PLOT_ENERGY, &p, 70, 16, ASCII);
    const char *names[] = {"wood mean", "bare p95", "bare mean", "wood p95"};
    char *text = ceduo_cells_dump(cells), *at = text;
    for (int i = 0; i < 4; i++) {
        at = strstr(at, names[i]);
        assert_non_null(at);
    }
    free(text);
    ceduo_cells_free(cells);
}

/* The wood's own peak is cut as well, and told by name. */
static void a_peak_in_the_wood_is_told(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    s.wood_envelopes[2].height.p95 = 30;
    assert_true(shows(CEDUO_PLOT_HEIGHT, &p, 120, 16, "wood p95 beyond the top: 30.0 m at 25.0 m"));
    assert_true(shows(CEDUO_PLOT_HEIGHT, &p, 70, 16, "; wood p95 up to 30.0 m"));
    assert_true(shows(CEDUO_PLOT_HEIGHT, &p, 58, 16, "; up to 30.0\n"));
}

static void strips_without_wooded_rocks(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    stop_all(&s);
    assert_true(shows(CEDUO_PLOT_ENERGY, &p, 70, 16, "bare mean"));
    assert_false(shows(CEDUO_PLOT_ENERGY, &p, 70, 16, "wood mean"));
    s.wooded[0] = NULL;
    assert_true(shows(CEDUO_PLOT_ENERGY, &p, 70, 16, "not computed yet"));
    assert_true(shows(CEDUO_PLOT_HEIGHT, &p, 70, 16, "not computed yet"));
    p.option = 1; /* no stems: both runs are one, drawn in strokes */
    struct ceduo_cells *cells = draw(CEDUO_PLOT_ENERGY, &p, 70, 8, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_WOOD) > 30);
    assert_in_range(cells_of(cells, CEDUO_ROLE_BARE), 13, 20); /* 13: the words */
    ceduo_cells_free(cells);
}

/* Nine places of ten say how high the scale goes; the tenth is told. */
static void a_peak_is_cut_and_told(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    assert_false(shows(CEDUO_PLOT_HEIGHT, &p, 80, 12, "beyond the top"));
    s.envelopes[2].height.max = 30;
    assert_true(shows(CEDUO_PLOT_HEIGHT, &p, 80, 12, "max beyond the top: 30.0 m at 25.0 m"));
    expect(CEDUO_PLOT_HEIGHT, &p, 70, 16, ASCII,
           "  height above the ground, m; max beyond the top: 30.0 m at 25.0 m\n"
           " |                        '                        '\n"
           "3+    .   .               :   .   .   .   .   .   .'  .   .      max\n"
           " |                        '                        '\n"
           " |                        '                        '\n"
           " |                        '                        '\n"
           "2+    . . . . . . . . . . : . . . . . . . . . . . .'. . . .      p95\n"
           " |                        '                        '\n"
           " |                        '                        '\n"
           " |                        '                        '\n"
           "1+   ''''''''''''''''''''''''''''''''''''''''''''''''''''''''    p50\n"
           " |                        '                        '\n"
           " |                        '                        '\n"
           "0+                        '                        '\n"
           " ++-----+-----+-----+-----+------+-----+-----+-----+-----+-----+\n"
           "  0 m   10    20    30    40     50    60    70    80    90  100\n");
}

static void strips_share_the_profiles_columns(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    struct ceduo_cells *cells = ceduo_cells_create(70, 24, ASCII);
    struct ceduo_area above = {0, 0, 70, 16}, below = {0, 16, 70, 8};
    struct ceduo_span span;
    ceduo_plot_profile(&cells->canvas, &above, &p, &span);
    ceduo_plot_height(&cells->canvas, &below, &p, &span, true);
    int rules[2] = {0, 0};
    for (int column = 0; column < 70; column++) {
        rules[0] += ceduo_cells_role(cells, column, 5) == CEDUO_ROLE_CONTROL;
        rules[1] += ceduo_cells_role(cells, column, 5) == CEDUO_ROLE_CONTROL &&
                    ceduo_cells_role(cells, column, 20) == CEDUO_ROLE_CONTROL;
    }
    assert_int_equal(rules[0], 2);
    assert_int_equal(rules[1], 2);
    ceduo_cells_free(cells);
}

static void places_without_rocks_stay_empty(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    for (int i = 0; i < CELLS; i++)
        s.envelopes[i] = no_rock;
    assert_true(shows(CEDUO_PLOT_HEIGHT, &p, 60, 12, "no rock passes here"));
    assert_true(shows(CEDUO_PLOT_ENERGY, &p, 60, 12, "no rock passes here"));
    p.outlook = NULL;
    assert_true(shows(CEDUO_PLOT_ENERGY, &p, 60, 12, "not computed yet"));
}

/* ---- bars ---- */

static void histogram_counts_by_round_bins(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_HISTOGRAM, &p, 60, 8, BRAILLE,
           "n = 8 of 10; of 1000: 200 > 40 kJ\n"
           "10–20 kJ ██████████                     1  12.5 %\n"
           "20–30 kJ ████████████████████           2  25.0 %\n"
           "30–40 kJ ██████████████████████████████ 3  37.5 % ◀ p50 33\n"
           "40–50 kJ ██████████                     1  12.5 % ◀ bears 40\n"
           "50–60 kJ ██████████                     1  12.5 % ◀ p95 55\n"
           "\n"
           "\n");
    expect(CEDUO_PLOT_HISTOGRAM, &p, 60, 5, ASCII,
           "n = 8 of 10; of 1000: 200 > 40 kJ\n"
           " 0-20 kJ ####                   1  12.5 %\n"
           "20-40 kJ ###################### 5  62.5 % < p50 33\n"
           "40-60 kJ #########              2  25.0 % < bears 40, p95 55\n"
           "\n");
    p.control = 1;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 60, 8, "no rock arrives"));
    p.control = 2;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 60, 8, "no control"));
}

static void a_long_tail_goes_into_one_bin(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    static double many[1000];
    for (int i = 0; i < 1000; i++)
        many[i] = i < 997 ? 1e3 * (i % 50) : 1e6;
    s.energies[0] = (struct ceduo_energies){1000, many};
    s.arrivals[0].reached = 1000;
    expect(CEDUO_PLOT_HISTOGRAM, &p, 70, 8, ASCII,
           "n = 1000 of 10; of 1000: 200 > 40 kJ\n"
           " 0-10 kJ ###################################### 200  20.0 %\n"
           "10-20 kJ ###################################### 200  20.0 %\n"
           "20-30 kJ ###################################### 200  20.0 %\n"
           "30-40 kJ ###################################### 200  20.0 % < p50 33\n"
           "40-50 kJ #####################################  197  19.7 % < bears 40\n"
           ">= 50 kJ #                                        3   0.3 % < p95 55\n"
           "\n");
    s.arrivals[0].reached = 5000;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 100, 8, "drawn: the first 1000"));
}

static void equal_energies_make_a_bin(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    for (int i = 0; i < ENERGIES; i++)
        s.values[i] = 0;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 60, 8, "100.0 %"));
    for (int i = 0; i < ENERGIES; i++)
        s.values[i] = 5e12;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 60, 8, "100.0 %"));
}

/* Bars through the forest, marks without it, both of 1000 released. */
static void the_histogram_marks_the_bare_slope(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_HISTOGRAM, &p, 74, 12, BRAILLE,
           "of 1000 released 500 arrive (│ bare 800), 100 (200) with more than 40 kJ\n"
           "                                            wood (bare)\n"
           " 0–10 kJ ████████████                         100 (  0)\n"
           "10–20 kJ ████████████│                        100 (100)\n"
           "20–30 kJ ████████████████████████│            200 (200) ◀ p50 21\n"
           "30–40 kJ                                    │   0 (300)\n"
           "40–50 kJ ████████████│                        100 (100) ◀ bears 40, p95 41\n"
           "50–60 kJ             │                          0 (100)\n"
           "\n"
           "\n"
           "\n"
           "\n");
    expect(CEDUO_PLOT_HISTOGRAM, &p, 60, 6, ASCII,
           "of 1000: 500 arrive (| bare 800), 100 (200) > 40 kJ\n"
           " 0-20 kJ ####|####              200 (100)\n"
           "20-40 kJ #########            | 200 (500) < p50 21\n"
           "40-60 kJ ####    |              100 (200) < bears 40, p95 41\n"
           "\n"
           "\n");
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 50, 12, "of 1000: 500 (| bare 800), 100 (200) > 40 kJ\n"));
    s.controls[0].accepted = s.arrivals[0].exceed_probability = s.wood_arrivals[0].exceed_probability = NAN;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 74, 12, "of 1000 released 500 arrive (| bare 800)\n"));
    s.wood_arrivals[0].reached = 50;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 74, 12, "; drawn: the first 8"));
    p.control = 1;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 74, 12, "no rock arrives"));
}

static void the_histogram_without_wooded_rocks(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    stop_all(&s);
    expect(CEDUO_PLOT_HISTOGRAM, &p, 74, 10, ASCII,
           "of 1000 released 0 arrive (| bare 800), 0 (200) with more than 40 kJ\n"
           "                                                    wood (bare)\n"
           "10-20 kJ                |                               0 (100)\n"
           "20-30 kJ                               |                0 (200)\n"
           "30-40 kJ                                              | 0 (300)\n"
           "40-50 kJ                |                               0 (100) < bears 40\n"
           "50-60 kJ                |                               0 (100)\n"
           "\n"
           "\n"
           "\n");
    s.wooded[0] = NULL;
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 74, 12, "not computed yet"));
    p.option = 1; /* no stems */
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 74, 12, "of 1000 released 800 arrive (| bare 800)"));
}

static void adc_shows_the_forms_beside_the_threshold(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_ADC, &p, 70, 9, BRAILLE,
           "coppice*, 20–70 m\n"
           "  gsteiger-stools  ██████████████▎      │      12.5 m\n"
           "  gsteiger-stems   ███████▋             │      5.35 m\n"
           "▶ interception     ███████████          │      8.24 m applied: passes\n"
           "  crofton          ███████████▌         │      8.83 m\n"
           "                   2      5     10   20 30 m\n"
           "\n"
           "│ 30 m: in this distance without a contact a rock reaches its full sp…\n"
           "\n");
    s.shoots.per_ha = 20;
    s.belts[0].stand.stools_per_ha = 10;
    s.belts[0].stand.trees_count = 0;
    assert_true(shows(CEDUO_PLOT_ADC, &p, 70, 9, "applied: NO"));
    p.option = 1;
    assert_true(shows(CEDUO_PLOT_ADC, &p, 70, 9, "no stems, nothing to meet: NO"));
    s.options[1].belts_count = 0;
    assert_true(shows(CEDUO_PLOT_ADC, &p, 70, 9, "no forest"));
}

static void many_belts_get_a_row_each(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    struct ceduo_belt belts[6];
    for (int i = 0; i < 6; i++)
        belts[i] = s.belts[i % 2];
    s.options[0] = (struct ceduo_option){"six", 6, belts};
    expect(CEDUO_PLOT_ADC, &p, 70, 7, ASCII,
           "coppice*           ###########          |      8.24 m passes\n"
           "cut                                     |        none NO\n"
           "coppice*           ###########          |      8.24 m passes\n"
           "cut                                     |        none NO\n"
           "coppice*           ###########          |      8.24 m passes\n"
           "cut                                     |        none NO\n"
           "                   2      5     10   20 30 m\n");
    assert_true(shows(CEDUO_PLOT_ADC, &p, 70, 5, "and 3 more belts"));
}

static void options_stand_side_by_side(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_COMPARE, &p, 80, 9, BRAILLE,
           "  ADC, m (│ 30)             taken, kJ/100 m           left, kJ (│ bears 40)\n"
           "\n"
           "kept\n"
           "  ████▊      │    8.24 pass ██████████████  90.5      █████▎       │  15.0\n"
           "\n"
           "felled\n"
           "  ███████████│██  none NO                      0      ███████████▋ │  33.1\n"
           "\n"
           "left = 33.12 kJ (mean, without forest) less what the stems could take (index)\n");
    expect(CEDUO_PLOT_COMPARE, &p, 110, 6, ASCII,
           "         ADC, m (| 30)                     taken, kJ/100 m                   left, kJ (| bears 40)\n"
           "\n"
           "kept     #######        |      8.24 pass   ####################  90.5        ########           |  15.0\n"
           "\n"
           "felled   ###############|####  none NO                              0        #################  |  33.1\n"
           "left = 33.12 kJ (mean, without forest) less what the stems could take (index)\n");
    p.control = 1;
    assert_true(shows(CEDUO_PLOT_COMPARE, &p, 120, 6, "no rock arrives"));
}

static void options_are_compared_by_what_gets_through(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_COMPARE, &p, 80, 9, BRAILLE,
           "  ADC, m (│ 30)             of 1000 > 40 kJ (│ 50)    mean, kJ (│ bears 40)\n"
           "\n"
           "kept\n"
           "  ████▊      │    8.24 pass █│               100 NO   ███████▊     │  22.0\n"
           "\n"
           "felled\n"
           "  ███████████│██  none NO   █│▊              200 NO   ███████████▋ │  33.1\n"
           "\n"
           "without forest: 200 of 1000 > 40 kJ, mean 33.12 kJ; mean: of those that arrive\n");
    expect(CEDUO_PLOT_COMPARE, &p, 60, 7, ASCII,
           "  ADC, m (| 30)      of 1000 > 40 kJ    mean, kJ (| 40)\n"
           "kept\n"
           "  ##   |   8.24 pass |         100 NO   ####  |  22.0\n"
           "felled\n"
           "  #####|#  none NO   |         200 NO   ######|  33.1\n"
           "pass: ADC of every belt and every gap below 30 m\n"
           "without forest: 200 of 1000 > 40 kJ, mean 33.12 kJ\n");
    s.wood_arrivals[0].exceed_probability = 0.05;
    assert_true(shows(CEDUO_PLOT_COMPARE, &p, 80, 9, " 50.0 pass"));
    s.controls[0].accepted = s.arrivals[0].exceed_probability = s.wood_arrivals[0].exceed_probability = NAN;
    expect(CEDUO_PLOT_COMPARE, &p, 80, 9, ASCII,
           "  ADC, m (| 30)             of 1000 arrive            mean, kJ\n"
           "\n"
           "kept\n"
           "  #####      |    8.24 pass #######          500      #########       22.0\n"
           "\n"
           "felled\n"
           "  ###########|##  none NO   ###########      800      ##############  33.1\n"
           "\n"
           "without forest: 800 of 1000, mean 33.12 kJ; mean: of those that arrive\n");
}

static void options_without_wooded_rocks_are_compared(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    stop_all(&s);
    expect(CEDUO_PLOT_COMPARE, &p, 80, 9, ASCII,
           "  ADC, m (| 30)             of 1000 > 40 kJ (| 50)    mean, kJ (| bears 40)\n"
           "\n"
           "kept\n"
           "  #####      |    8.24 pass  |                 0 pass              |     -\n"
           "\n"
           "felled\n"
           "  ###########|##  none NO   #|#              200 NO   ############ |  33.1\n"
           "\n"
           "without forest: 200 of 1000 > 40 kJ, mean 33.12 kJ; mean: of those that arrive\n");
    s.wooded[0] = NULL;
    expect(CEDUO_PLOT_COMPARE, &p, 80, 9, BRAILLE,
           "  ADC, m (│ 30)             of 1000 > 40 kJ (│ 50)    mean, kJ (│ bears 40)\n"
           "\n"
           "kept\n"
           "  ████▊      │    8.24 pass  │                 …                   │     …\n"
           "\n"
           "felled\n"
           "  ███████████│██  none NO   █│▊              200 NO   ███████████▋ │  33.1\n"
           "\n"
           "without forest: 200 of 1000 > 40 kJ, mean 33.12 kJ; mean: of those that arrive\n");
    p.outlook = NULL;
    assert_true(shows(CEDUO_PLOT_COMPARE, &p, 80, 9, "Energies are not computed yet"));
}

/* ---- the stand ---- */

static void the_stand_is_drawn_to_scale(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    expect(CEDUO_PLOT_STAND, &p, 60, 14, BRAILLE,
           " ⠲⠤\n"
           "       ⡤⡤\n"
           "       ⠘⠃      ⢈⡇                  ⢰\n"
           "                                   ⠈\n"
           "⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⣀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⡀⣖⡤⡀⡀⡀⡀⡀\n"
           "                                     ⠴⠧⠄⠐⠁        ⠴⢽⡀⠉   ⠠⡄\n"
           "⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠁⠑⠃⠁\n"
           "\n"
           "                                             ⠤⠄\n"
           "  ⠠⢄⡀        ⢤⢤                     ⣀\n"
           "             ⠈⠁                     ⠷⠋\n"
           "┬─────┬─────┬─────┬─────┬─────┬────┬─────┬─────┬─────┬─────┬\n"
           "0 m   2     4     6     8     10   12    14    16    18   20\n"
           "One pattern of many: 5 stools or trees are met\n");
    p.option = 1;
    assert_true(shows(CEDUO_PLOT_STAND, &p, 60, 12, "No stems"));
    p.belt = 1;
    assert_true(shows(CEDUO_PLOT_STAND, &p, 60, 12, "no forest"));
}

/* More stools are added to those that stand. */
static void stems_that_stay_do_not_move(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    s.belts[0].stand.trees_count = 0;
    struct ceduo_cells *few = draw(CEDUO_PLOT_STAND, &p, 80, 40, BRAILLE);
    s.belts[0].stand.stools_per_ha *= 1.5;
    s.shoots.per_ha *= 1.5;
    struct ceduo_cells *more = draw(CEDUO_PLOT_STAND, &p, 80, 40, BRAILLE);
    int dots[2] = {0, 0};
    for (int i = 0; i < 80 * 37; i++) {
        assert_int_equal(few->cell[i].dots & ~more->cell[i].dots, 0);
        dots[0] += few->cell[i].dots != 0;
        dots[1] += more->cell[i].dots != 0;
    }
    assert_true(dots[1] > dots[0]);
    ceduo_cells_free(few);
    ceduo_cells_free(more);
}

/* Trees of 10 cm and a rock of 3 m: those whose middle is less than 1.55 m off its path are met, no others. A row of
 * the picture is half a metre. */
static void what_the_rock_meets_lies_in_its_strip(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    s.scene.rock.diameter = ceduo_number(3);
    s.belts[0].stand.shoots_count = 0;
    s.trees.per_ha = 5000;
    s.trees.dbh = 0.1;
    struct ceduo_cells *cells = draw(CEDUO_PLOT_STAND, &p, 80, 43, BRAILLE);
    for (int row = 0; row < 40; row++)
        for (int column = 0; column < 80; column++) {
            double off = fabs(0.503 * (row + 0.5 - 20)); /* m */
            enum ceduo_role role = ceduo_cells_role(cells, column, row);
            assert_false(role == CEDUO_ROLE_WAY && off > 1.6 + 0.3);
            assert_false(role == CEDUO_ROLE_STEM && off < 1.5 - 0.3);
        }
    assert_true(cells_of(cells, CEDUO_ROLE_WAY) > 10);
    assert_true(cells_of(cells, CEDUO_ROLE_STEM) > 50);
    ceduo_cells_free(cells);
}

/* 20 m around the last stem of the belt, offsets stretched until the strip fills the picture. */
static void the_stand_shows_the_way_of_the_rock(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    p.stems = passed;
    p.stems_count = 3;
    expect(CEDUO_PLOT_STAND, &p, 60, 14, BRAILLE,
           "\n"
           "⣦⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄⠄\n"
           "⣿\n"
           "⡿                            ⢰⡆\n"
           "\n"
           "\n"
           "               ⠇\n"
           "\n"
           "\n"
           "⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂⠂\n"
           "\n"
           "┬─────┬─────┬─────┬─────┬─────┬────┬─────┬─────┬─────┬─────┬\n"
           "22 m  24    26    28    30    32   34    36    38    40   42\n"
           "The way of this rock: 2 stems hit in 20 m; across ×6.5\n");
    struct ceduo_cells *cells = draw(CEDUO_PLOT_STAND, &p, 60, 14, BRAILLE);
    assert_true(cells_of(cells, CEDUO_ROLE_WAY) >= 2);
    assert_true(cells_of(cells, CEDUO_ROLE_DIM) >= 1);
    assert_int_equal(cells_of(cells, CEDUO_ROLE_STEM) + cells_of(cells, CEDUO_ROLE_STOOL), 0);
    ceduo_cells_free(cells);
    p.stems_count = 4; /* the last one near the end of the belt */
    assert_true(shows(CEDUO_PLOT_STAND, &p, 60, 14, "The way of this rock: 1 stem hit in 20 m; across x"));
    assert_true(shows(CEDUO_PLOT_STAND, &p, 50, 14, "The way of this rock: 1 stem hit in 20 m\n"));
    s.scene.slope.origin_x = 1000;
    assert_true(shows(CEDUO_PLOT_STAND, &p, 60, 14, "1065"));
}

/* The last stem in another belt: the first 20 m with stems. A belt shorter than that is shown with what follows it. */
static void the_way_is_shown_in_the_belt_shown(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_belt belts[3] = {s.belts[0], s.belts[0], s.belts[1]};
    belts[0].to = 45;
    belts[1].from = 60;
    belts[1].to = 70;
    belts[2].from = 70;
    belts[2].to = 90;
    s.options[0] = (struct ceduo_option){"three", 3, belts};
    struct ceduo_picture p = picture_of(&s);
    p.stems = passed;
    p.stems_count = 4;
    assert_true(shows(CEDUO_PLOT_STAND, &p, 70, 14, "2 stems hit in 20 m, 1 flown over"));
    p.belt = 1;
    assert_true(shows(CEDUO_PLOT_STAND, &p, 70, 14, "1 stem hit in 10 m;"));
    p.belt = 2;
    assert_true(shows(CEDUO_PLOT_STAND, &p, 70, 14, "No stems"));
    p.belt = 0;
    p.stems = &passed[3];
    p.stems_count = 1;
    assert_true(shows(CEDUO_PLOT_STAND, &p, 70, 14, "One pattern of many"));
}

static void a_dense_stand_is_drawn_in_time(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    s.belts[0].stand.stools_per_ha = 1e6;
    s.shoots.per_ha = 1e7;
    ceduo_cells_free(draw(CEDUO_PLOT_STAND, &p, 200, 400, BRAILLE));
}

/* ---- all of them ---- */

static void nothing_is_drawn_beside_the_area(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    for (int i = 0; i < 3 * 40 * 12; i++) {
        enum ceduo_charset charset = (enum ceduo_charset)(i % 3);
        struct ceduo_area area = {7, 3, 4 + i / 3 % 40 * 3, 1 + i / 120 * 2};
        for (int plot = CEDUO_PLOT_PROFILE; plot < CEDUO_PLOTS; plot++) {
            struct ceduo_cells *cells = ceduo_cells_create(area.width + 14, area.height + 6, charset);
            struct ceduo_picture p = picture_of(&s);
            s.scene.simulation.contact_model = i / 3 % 2 ? CEDUO_STEMS : CEDUO_INDEX;
            p.outlook = i % 7 == 0 ? NULL : p.outlook;
            p.stems = i % 11 < 3 ? passed : NULL;
            p.stems_count = i % 11 < 3 ? 4 : 0;
            p.option = (size_t)(i % 5 == 0);
            ceduo_plot_kinds[plot].draw(&cells->canvas, &area, &p);
            for (int row = 0; row < cells->height; row++)
                for (int column = 0; column < cells->width; column++) {
                    bool in = column >= area.left && column < area.left + area.width && row >= area.top &&
                              row < area.top + area.height;
                    if (!in && ceduo_cells_role(cells, column, row) != CEDUO_ROLE_BLANK)
                        fail_msg("plot %d, charset %d, %dx%d: drawn at %d, %d", plot, (int)charset, area.width,
                                 area.height, column - area.left, row - area.top);
                }
            ceduo_cells_free(cells);
        }
    }
}

static void names_are_found(void **state)
{
    (void)state;
    const char *names[] = {"profile", "energy", "height", "histogram", "adc", "rotation", "stand", "compare"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        enum ceduo_plot plot = ceduo_plot_find(names[i]);
        assert_int_not_equal(plot, CEDUO_PLOT_NONE);
        assert_non_null(strstr(ceduo_plot_names, names[i]));
    }
    assert_int_equal(ceduo_plot_find("years"), CEDUO_PLOT_NONE);
    assert_int_equal(ceduo_plot_find(""), CEDUO_PLOT_NONE);
}

static void titles_name_what_is_shown(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_picture p = picture_of(&s);
    const char *expected[2][CEDUO_PLOTS] = {
        {
            "",
            "kept: slope, forest, and ways without forest",
            "kept: energy of the rocks, without forest",
            "kept: height of the rocks above the ground, without forest",
            "kept: energy at path (40 m), without forest",
            "kept: average distance between contacts, m",
            "kept: year by year, up to path (40 m)",
            "kept: coppice, from above",
            "Options side by side, up to path (40 m)",
        },
        {
            "",
            "kept: slope, forest, and ways through it",
            "kept: energy of the rocks",
            "kept: height of the rocks above the ground",
            "kept: energy at path (40 m)",
            "kept: average distance between contacts, m",
            "kept: year by year, up to path (40 m)",
            "kept: coppice, from above",
            "Options side by side, up to path (40 m)",
        },
    };
    for (int i = 0; i < 2 * (CEDUO_PLOTS - 1); i++) {
        int plot = CEDUO_PLOT_PROFILE + i / 2;
        struct text title = {0};
        s.scene.simulation.contact_model = i % 2 ? CEDUO_STEMS : CEDUO_INDEX;
        ceduo_plot_title(&title, (enum ceduo_plot)plot, &p);
        assert_string_equal(title.bytes ? title.bytes : "", expected[i % 2][plot]);
        ceduo_text_free(&title);
    }
    assert_int_equal(ceduo_plot_last_control(&s.scene), 1);
}

/* ---- what pictures are made of ---- */

/* The runs of a scene, flown. */
static struct ceduo_pool *pool_of(const struct site *s, uint64_t rocks, size_t cells, const double *cell_x,
                                  size_t exact_bytes)
{
    struct ceduo_run_def def = ceduo_run_def_default(&s->scene);
    struct ceduo_pool *pool;
    def.rocks_most = 1000;
    def.cells = cells;
    def.cell_x = cell_x;
    def.exact_bytes = exact_bytes;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_extend(pool, rocks), CEDUO_OK);
    return pool;
}

static struct ceduo_outlook *outlook_of(const struct ceduo_outlook_def *def)
{
    struct ceduo_outlook *o;
    assert_int_equal(ceduo_outlook_create(def, &o), CEDUO_OK);
    return o;
}

static void places_lie_beyond_the_release(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    double x[CEDUO_OUTLOOK_CELLS];
    s.scene.release.x = (struct ceduo_number){10, 2, CEDUO_UNIFORM};
    assert_int_equal(ceduo_outlook_places(&s.scene, x), CEDUO_OUTLOOK_CELLS);
    assert_true(x[0] > 12);
    for (int i = 1; i < CEDUO_OUTLOOK_CELLS; i++)
        assert_true(x[i] > x[i - 1]);
    assert_true(x[CEDUO_OUTLOOK_CELLS - 1] <= 100);
    s.scene.release.x = ceduo_number(100);
    assert_int_equal(ceduo_outlook_places(&s.scene, x), 0);
}

static void expect_sight(const struct ceduo_sight *sight, const struct ceduo_run *run, size_t cells)
{
    assert_non_null(sight);
    assert_int_equal(sight->flown.rocks, ceduo_run_rocks(run));
    assert_int_equal(sight->picture_rocks, ceduo_run_rocks(run));
    for (size_t c = 0; c < 2; c++) {
        const struct ceduo_arrivals *found = &sight->flown.arrivals[c];
        struct ceduo_arrivals a;
        assert_int_equal(ceduo_run_arrivals(run, c, &a), CEDUO_OK);
        assert_true(a.reached > 0);
        assert_int_equal(found->reached, a.reached);
        assert_int_equal(sight->energies[c].n, a.reached);
        double sum = 0;
        for (size_t i = 0; i < sight->energies[c].n; i++)
            sum += sight->energies[c].values[i];
        assert_true(fabs(sum / (double)a.reached - found->energy.mean) < 1e-6 * sum);
    }
    for (size_t i = 0; i < cells; i++) {
        struct ceduo_envelope e;
        ceduo_run_envelope(run, i, &e);
        assert_int_equal(sight->envelopes[i].passed, e.passed);
    }
}

static void outlook_is_what_the_runs_say(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    double x[CEDUO_OUTLOOK_CELLS];
    size_t cells = ceduo_outlook_places(&s.scene, x);
    struct ceduo_pool *pool = pool_of(&s, 300, cells, x, CEDUO_EXACT_BYTES);
    struct ceduo_outlook *o = outlook_of(&(struct ceduo_outlook_def){
        .scene = &s.scene, .figures = pool, .pictures = pool, .cells = cells, .cell_x = x, .trails = 20});
    assert_int_equal(o->cells, cells);
    assert_int_equal(o->controls, 2);
    assert_int_equal(o->options, 2);
    for (size_t i = 0; i < cells; i++)
        assert_true(o->cell_x[i] == x[i]);
    expect_sight(o->bare, ceduo_pool_find(pool, NULL), cells);
    expect_sight(o->wooded[0], ceduo_pool_find(pool, &s.options[0]), cells);
    assert_true(o->wooded[0]->flown.arrivals[1].reached < o->bare->flown.arrivals[1].reached);
    assert_int_equal(o->bare->trails_count, 20);
    assert_int_equal(o->wooded[0]->trails_count, 20);
    assert_ptr_equal(ceduo_outlook_sight(o, &s.scene, 0), o->wooded[0]);
    assert_null(ceduo_outlook_sight(o, &s.scene, 2));
    assert_null(ceduo_outlook_sight(NULL, &s.scene, 0));
    ceduo_outlook_free(o);
    ceduo_pool_free(pool);
    ceduo_outlook_free(NULL);
}

/* Without stems the rocks are those without forest: the same sight, and it is flown once. */
static void a_forest_without_stems_is_the_bare_slope(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_pool *pool = pool_of(&s, 300, 0, NULL, CEDUO_EXACT_BYTES);
    struct ceduo_outlook *o =
        outlook_of(&(struct ceduo_outlook_def){.scene = &s.scene, .figures = pool, .pictures = pool});
    assert_int_equal(ceduo_pool_work(pool).runs, 2);
    assert_ptr_equal(o->wooded[1], o->bare);
    assert_ptr_not_equal(o->wooded[0], o->bare);
    for (size_t c = 0; c < 2; c++) {
        assert_true(o->differences[c].reach_probability.mean == 0);
        double more = o->bare->flown.arrivals[c].reach_probability - o->wooded[0]->flown.arrivals[c].reach_probability;
        assert_true(fabs(o->differences[2 + c].reach_probability.mean - more) < 1e-12);
    }
    ceduo_outlook_free(o);
    ceduo_pool_free(pool);
}

/* With the contact model index there is one sight, that of all options. */
static void the_index_looks_at_the_bare_slope(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    struct ceduo_pool *pool = pool_of(&s, 300, 0, NULL, CEDUO_EXACT_BYTES);
    struct ceduo_outlook *o =
        outlook_of(&(struct ceduo_outlook_def){.scene = &s.scene, .figures = pool, .pictures = pool});
    assert_int_equal(ceduo_pool_work(pool).runs, 1);
    assert_null(o->wooded[0]);
    assert_null(o->wooded[1]);
    assert_ptr_equal(ceduo_outlook_sight(o, &s.scene, 0), o->bare);
    assert_ptr_equal(ceduo_outlook_sight(o, &s.scene, 1), o->bare);
    ceduo_outlook_free(o);
    ceduo_pool_free(pool);
}

/* Runs that are not there yet leave gaps, which the pictures name. */
static void what_is_not_flown_yet_is_not_known(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_run_def run_def = ceduo_run_def_default(&s.scene);
    struct ceduo_pool *pool;
    struct ceduo_run *run;
    assert_int_equal(ceduo_pool_create(&run_def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_run(pool, NULL, &run), CEDUO_OK);
    struct ceduo_outlook_def def = {.scene = &s.scene, .figures = pool, .pictures = pool};
    struct ceduo_outlook *o = outlook_of(&def);
    assert_null(o->bare);
    ceduo_outlook_free(o);
    assert_int_equal(ceduo_pool_extend(pool, 100), CEDUO_OK);
    o = outlook_of(&def);
    assert_non_null(o->bare);
    assert_null(o->wooded[0]);
    assert_ptr_equal(o->wooded[1], o->bare);
    for (size_t i = 0; i < 4; i++)
        assert_true(isnan(o->differences[i].reach_probability.mean));
    struct ceduo_picture p = {.scene = &s.scene, .outlook = o};
    assert_true(shows(CEDUO_PLOT_ENERGY, &p, 60, 12, "not computed yet"));
    assert_true(shows(CEDUO_PLOT_HISTOGRAM, &p, 60, 12, "not computed yet"));
    ceduo_outlook_free(o);
    ceduo_pool_free(pool);
}

/* Figures come from the longer run, curves from the one that keeps them. */
static void figures_come_from_the_longer_run(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    double x[CEDUO_OUTLOOK_CELLS];
    size_t cells = ceduo_outlook_places(&s.scene, x);
    struct ceduo_pool *figures = pool_of(&s, 600, 0, NULL, CEDUO_EXACT_BYTES);
    struct ceduo_pool *pictures = pool_of(&s, 300, cells, x, CEDUO_EXACT_BYTES);
    struct ceduo_outlook_def def = {
        .scene = &s.scene, .figures = figures, .pictures = pictures, .cells = cells, .cell_x = x};
    struct ceduo_outlook *o = outlook_of(&def);
    assert_int_equal(o->wooded[0]->flown.rocks, 600);
    assert_int_equal(o->wooded[0]->picture_rocks, 300);
    assert_true(o->wooded[0]->envelopes[0].passed <= 300);
    ceduo_outlook_free(o);
    assert_int_equal(ceduo_pool_extend(pictures, 900), CEDUO_OK);
    o = outlook_of(&def);
    assert_int_equal(o->wooded[0]->flown.rocks, 900);
    assert_int_equal(o->bare->flown.rocks, 900);
    ceduo_outlook_free(o);
    ceduo_pool_free(figures);
    ceduo_pool_free(pictures);
}

/* What has not changed since the last outlook is not read again but shared; who is freed first does not matter. */
static void sights_are_taken_over(void **state)
{
    (void)state;
    static struct site a, b;
    for (int order = 0; order < 2; order++) {
        wooded_site_init(&a);
        wooded_site_init(&b);
        b.belts[1].stand = b.belts[0].stand; /* trees where the other has none */
        b.belts[1].stand.shoots_count = 0;
        struct ceduo_pool *pool = pool_of(&a, 300, 0, NULL, CEDUO_EXACT_BYTES);
        struct ceduo_outlook_def def = {.scene = &a.scene, .figures = pool, .pictures = pool, .trails = 5};
        struct ceduo_outlook *first = outlook_of(&def);
        ceduo_pool_turn(pool, &b.scene);
        def.scene = &b.scene;
        def.last = first;
        struct ceduo_outlook *early = outlook_of(&def);
        assert_null(early->wooded[1]);
        assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
        assert_int_equal(ceduo_pool_extend(pool, 300), CEDUO_OK);
        def.last = early;
        struct ceduo_outlook *second = outlook_of(&def);
        assert_ptr_equal(second->bare, first->bare);
        assert_ptr_equal(second->wooded[0], first->wooded[0]);
        assert_non_null(second->wooded[1]);
        assert_ptr_not_equal(second->wooded[1], first->wooded[1]);
        assert_int_equal(atomic_load(&first->wooded[0]->references), 3);
        ceduo_outlook_free(order ? first : second);
        ceduo_outlook_free(early);
        struct ceduo_outlook *left = order ? second : first;
        assert_int_equal(left->wooded[0]->trails_count, 5);
        assert_int_equal(atomic_load(&left->wooded[0]->references), 1);
        assert_true(left->wooded[0]->trails[4].n >= 2);
        ceduo_outlook_free(left);
        ceduo_pool_free(pool);
    }
}

static void longer_runs_are_read_again(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_pool *pool = pool_of(&s, 300, 0, NULL, CEDUO_EXACT_BYTES);
    struct ceduo_outlook_def def = {.scene = &s.scene, .figures = pool, .pictures = pool};
    struct ceduo_outlook *first = outlook_of(&def);
    assert_int_equal(ceduo_pool_extend(pool, 301), CEDUO_OK);
    def.last = first;
    struct ceduo_outlook *second = outlook_of(&def);
    assert_ptr_not_equal(second->bare, first->bare);
    assert_ptr_not_equal(second->wooded[0], first->wooded[0]);
    assert_int_equal(second->wooded[0]->flown.rocks, 301);
    ceduo_outlook_free(first);
    ceduo_outlook_free(second);
    ceduo_pool_free(pool);
}

static void expect_same_energies(const struct ceduo_sight *a, const struct ceduo_sight *b)
{
    for (size_t c = 0; c < 2; c++) {
        assert_false(b->flown.arrivals[c].exact);
        assert_true(a->energies[c].n > 0);
        assert_int_equal(a->energies[c].n, b->energies[c].n);
        for (size_t i = 0; i < a->energies[c].n; i++)
            assert_true(fabs(a->energies[c].values[i] - b->energies[c].values[i]) <= 1e-9 * a->energies[c].values[i]);
    }
}

/* Runs too long for their samples: the energies come from rocks flown once more, the same ones. */
static void energies_are_flown_where_they_were_not_kept(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_pool *kept = pool_of(&s, 300, 0, NULL, CEDUO_EXACT_BYTES), *binned = pool_of(&s, 300, 0, NULL, 0);
    struct ceduo_outlook *a =
        outlook_of(&(struct ceduo_outlook_def){.scene = &s.scene, .figures = kept, .pictures = kept});
    struct ceduo_outlook *b =
        outlook_of(&(struct ceduo_outlook_def){.scene = &s.scene, .figures = binned, .pictures = binned});
    expect_same_energies(a->bare, b->bare);
    expect_same_energies(a->wooded[0], b->wooded[0]);
    ceduo_outlook_free(a);
    ceduo_outlook_free(b);
    ceduo_pool_free(kept);
    ceduo_pool_free(binned);
}

/* Starts and ends where the rock does, never far below the ground, and never jumps. */
static void trails_follow_the_rocks(void **state)
{
    (void)state;
    static struct site s;
    wooded_site_init(&s);
    struct ceduo_pool *pool = pool_of(&s, 20, 0, NULL, CEDUO_EXACT_BYTES);
    struct ceduo_outlook *o = outlook_of(
        &(struct ceduo_outlook_def){.scene = &s.scene, .figures = pool, .pictures = pool, .trails = 20});
    uint64_t hit = 0;
    for (uint64_t i = 0; i < 40; i++) {
        const struct ceduo_option *option = i % 2 ? &s.options[0] : NULL;
        const struct ceduo_trail t = (option ? o->wooded[0] : o->bare)->trails[i / 2];
        struct ceduo_way way;
        assert_int_equal(ceduo_way_follow(&s.scene, option, i / 2, NULL, &way, NULL), CEDUO_OK);
        hit += way.stems_hit;
        assert_true(t.n >= 2);
        assert_true(t.x[0] == way.x0 && t.z[0] == way.z0);
        assert_true(t.x[t.n - 1] == way.x && t.z[t.n - 1] == way.z);
        for (size_t k = 0; k < t.n; k++)
            if (t.x[k] >= 0 && t.x[k] <= 100)
                assert_true(t.z[k] > ceduo_slope_height(&s.scene.slope, t.x[k]) - 0.1);
    }
    assert_true(hit > 0);
    ceduo_outlook_free(o);
    ceduo_pool_free(pool);
}

/* A rock thrown far: every point of its trail and the middle of every chord lies on the parabola. */
static void flights_are_sampled_finely(void **state)
{
    (void)state;
    static struct site s;
    site_init(&s);
    s.scene.release.vx = ceduo_number(10);
    s.scene.release.vz = ceduo_number(10);
    struct ceduo_pool *pool = pool_of(&s, 1, 0, NULL, CEDUO_EXACT_BYTES);
    struct ceduo_outlook *o = outlook_of(
        &(struct ceduo_outlook_def){.scene = &s.scene, .figures = pool, .pictures = pool, .trails = 1});
    const struct ceduo_trail t = o->bare->trails[0];
    size_t checked = 0;
    for (size_t i = 1; i < t.n && t.x[i] < 20; i++, checked++) {
        double x = (t.x[i - 1] + t.x[i]) / 2, z = (t.z[i - 1] + t.z[i]) / 2, seconds = x / 10;
        assert_true(fabs(z - (10 - 0.5 * CEDUO_GRAVITY * seconds) * seconds) < 0.06); /* a step is 0.05 m */
    }
    assert_true(checked > 3);
    ceduo_outlook_free(o);
    ceduo_pool_free(pool);
}

/* ---- the command line ---- */

static enum exit_status read(struct arguments *a, int argc, char **argv)
{
    optind = 0;
    return ceduo_arguments_read(a, argc, argv);
}

#define READ(a, ...)                                                                                                   \
    read(a, sizeof((char *[]){"ceduo", __VA_ARGS__}) / sizeof(char *), (char *[]){"ceduo", __VA_ARGS__, NULL})

static void a_picture_is_asked_for(void **state)
{
    (void)state;
    struct arguments a;
    assert_int_equal(READ(&a, "--plot", "adc", "--size", "100x30", "--charset", "block", "x.yaml"), EXIT_DONE);
    assert_int_equal(a.mode, MODE_BATCH);
    assert_int_equal(a.plot, CEDUO_PLOT_ADC);
    assert_int_equal(a.plot_width, 100);
    assert_int_equal(a.plot_height, 30);
    assert_true(ceduo_option_given(&a, "charset"));
    assert_int_equal(a.charset, BLOCK);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "--plot=profile", "x.yaml"), EXIT_DONE);
    assert_false(ceduo_option_given(&a, "charset"));
    assert_int_equal(a.plot_width, 0);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "--check", "--plot=profile", "x.yaml"), EXIT_USAGE); /* a check draws nothing */
    ceduo_arguments_free(&a);
}

static void wrong_pictures_are_usage_errors(void **state)
{
    (void)state;
    struct arguments a;
    const char *sizes[] = {"",     "80",      "x24",    "80x",       "80x24x2", "19x24",
                           "80x5", "1001x24", "80x501", "8e1000x24", "-80x24",  "80.5x24"};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char size[16];
        snprintf(size, sizeof size, "%s", sizes[i]);
        assert_int_equal(READ(&a, "--plot", "adc", "--size", size, "x.yaml"), EXIT_USAGE);
        ceduo_arguments_free(&a);
    }
    assert_int_equal(READ(&a, "--plot", "years", "x.yaml"), EXIT_USAGE);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "--plot", "adc", "--charset", "latin", "x.yaml"), EXIT_USAGE);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "--plot", "adc", "-f", "json", "x.yaml"), EXIT_USAGE);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "-f", "csv", "--plot", "adc", "x.yaml"), EXIT_USAGE);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "-f", "table", "--plot", "adc", "x.yaml"), EXIT_DONE);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "--plot", "adc"), EXIT_USAGE);
    ceduo_arguments_free(&a);
    assert_int_equal(READ(&a, "--batch", "--size", "80x24", "x.yaml"), EXIT_USAGE);
    ceduo_arguments_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(profile_is_true_to_scale),
        cmocka_unit_test(span_tells_where_the_slope_stands),
        cmocka_unit_test(heights_are_stretched_where_the_slope_is_flat_and_the_factor_is_written),
        cmocka_unit_test(the_selected_way_is_drawn_over_all),
        cmocka_unit_test(the_wooded_profile_says_whose_forest_it_is),
        cmocka_unit_test(ways_that_are_not_known_are_not_drawn),
        cmocka_unit_test(notes_tell_when_no_rock_arrives),
        cmocka_unit_test(stems_that_the_rock_came_to_stand_where_they_are),
        cmocka_unit_test(contacts_without_size_are_drawn_as_high_as_the_stand),
        cmocka_unit_test(axes_have_the_users_coordinates),
        cmocka_unit_test(strips_show_quantiles_along_the_slope),
        cmocka_unit_test(strips_show_the_wood_beside_the_bare_slope),
        cmocka_unit_test(small_strips_show_one_pair_of_curves),
        cmocka_unit_test(names_of_curves_follow_their_ends),
        cmocka_unit_test(a_peak_in_the_wood_is_told),
        cmocka_unit_test(strips_without_wooded_rocks),
        cmocka_unit_test(a_peak_is_cut_and_told),
        cmocka_unit_test(strips_share_the_profiles_columns),
        cmocka_unit_test(places_without_rocks_stay_empty),
        cmocka_unit_test(histogram_counts_by_round_bins),
        cmocka_unit_test(a_long_tail_goes_into_one_bin),
        cmocka_unit_test(equal_energies_make_a_bin),
        cmocka_unit_test(the_histogram_marks_the_bare_slope),
        cmocka_unit_test(the_histogram_without_wooded_rocks),
        cmocka_unit_test(adc_shows_the_forms_beside_the_threshold),
        cmocka_unit_test(many_belts_get_a_row_each),
        cmocka_unit_test(options_stand_side_by_side),
        cmocka_unit_test(options_are_compared_by_what_gets_through),
        cmocka_unit_test(options_without_wooded_rocks_are_compared),
        cmocka_unit_test(the_stand_is_drawn_to_scale),
        cmocka_unit_test(stems_that_stay_do_not_move),
        cmocka_unit_test(what_the_rock_meets_lies_in_its_strip),
        cmocka_unit_test(the_stand_shows_the_way_of_the_rock),
        cmocka_unit_test(the_way_is_shown_in_the_belt_shown),
        cmocka_unit_test(a_dense_stand_is_drawn_in_time),
        cmocka_unit_test(nothing_is_drawn_beside_the_area),
        cmocka_unit_test(names_are_found),
        cmocka_unit_test(titles_name_what_is_shown),
        cmocka_unit_test(places_lie_beyond_the_release),
        cmocka_unit_test(outlook_is_what_the_runs_say),
        cmocka_unit_test(a_forest_without_stems_is_the_bare_slope),
        cmocka_unit_test(the_index_looks_at_the_bare_slope),
        cmocka_unit_test(what_is_not_flown_yet_is_not_known),
        cmocka_unit_test(figures_come_from_the_longer_run),
        cmocka_unit_test(sights_are_taken_over),
        cmocka_unit_test(longer_runs_are_read_again),
        cmocka_unit_test(energies_are_flown_where_they_were_not_kept),
        cmocka_unit_test(trails_follow_the_rocks),
        cmocka_unit_test(flights_are_sampled_finely),
        cmocka_unit_test(a_picture_is_asked_for),
        cmocka_unit_test(wrong_pictures_are_usage_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
