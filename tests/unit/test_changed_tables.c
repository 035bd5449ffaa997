/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* A random change to a valid table: a cell removed or repeated, a quote or separator inserted, a line cut. The figures equal
 * those of the valid table, or the table is refused. CHANGES=10000 tries 10000 of each kind. Two changes would give another
 * valid table and are not made: a cut within the last cell of a line, and a cut before its first byte. */
#include "local.h"

#include <stdio.h>
#include <sys/mman.h>
#include <unistd.h>

#include "expect.h"
#include "full.h"
#include "io/csv.h"
#include "io/scene_file.h"
#include "io/survey_file.h"
#include "physics/line_scene.h"

#define CHANGES FULL_OR(300, 80)
#define BYTES   4096

static struct line_random state;

/* ---- tables ---- */

static const char profile[] =
    "Profilo A;;\nDistanza;Quota (m s.l.m.);Note\n0;412,5;\"ciglio; \"\"A\"\"\"\n12,5;398,25;\n40;371;a 3\"\n"
    "75,25;345,9;\n118;330,1;\"due\nrighe\"\n160;326;strada\n";
static const char line[] =
    "fid,x,y,z,code\n1,600000,4870000,412.5,\n2,600010,4870000,398.2,\n3,600040,4870000,371,\n4,600118,4870000,330,\n";
static const char stops[] = "id;block;x_m;note\n1;a;40,5;\"x;y\"\n2;b;51,25;\n3;a;47;\n4;c;66;\"\"\"n\"\"\"\n5;a;71,5;end\n";
static const char plots[] =
    "saggio;superficie_m2;pendenza_gradi;specie;tipo;ceppaia;diametro_cm;altezza_m;distanza_m\n"
    "A;200;35;carpino nero;pollone;1;6,2;6,4;0,3\nA;;;carpino nero;pollone;1;7,1;;\nA;;;cerro;matricina;;22,4;12,5;\n"
    "B;150;0;carpino nero;pollone;1;8,8;7,9;\nB;;;\"carpino "
    "nero\";pollone;2;6,6;6,7;0,4\nB;;;cerro;albero;;12;9;\nC;200;30;;;;;;\n";

static const char tally[] =
    "Rilievo 2024;;;;;;;\nSaggio;Area saggio (m2);Classe diam.;N. polloni;N. matricine;N. ceppaie;Stato;Specie\n"
    "A;400;5;36;;18;vivo;carpino nero\nA;;10;21;2;;vivo;carpino nero\nA;;12;4;;;morto;carpino nero\n"
    "B;350;5;40;;25;vivo;\"carpino nero\"\nB;;20;;4;;vivo;Q. cerris\nTotale;;;101;6;;;\n";

/* ---- figures ---- */

/* Append the figures of a table; false if it is refused. */
typedef bool figures(const char *path, struct text *to);

static bool profile_figures(const char *path, struct text *to)
{
    LOCAL_ARENA(arena);
    LOCAL_PROBLEMS(problems);
    struct points p;
    bool good = ceduo_csv_slope_read(&arena, path, NULL, &p, &problems);
    for (size_t i = 0; good && i < p.n; i++)
        ceduo_text_format(to, "%.17g %.17g\n", p.x[i], p.z[i]);
    return good;
}

static bool stops_figures(const char *path, struct text *to)
{
    LOCAL_PROBLEMS(problems);
    LOCAL_BY(ceduo_scene_release) struct scene_file file = {0};
    LOCAL_TEXT(scene);
    ceduo_text_format(
        &scene,
        "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: {vertices_m: [[0, 50], [60, 20], [100, 0]], materials: "
        "[{from_m: 0, to_m: 100, material: talus}]}\ncontrols_m: [90]\nobserved: [{stops: {csv: %s, only: block = a}}]\n",
        path);
    bool good = ceduo_scene_load_text(&file, "profiles/scenes/changed.yaml", scene.bytes, &problems);
    for (size_t i = 0; good && i < file.observations[0].n; i++)
        ceduo_text_format(to, "%.17g\n", file.observations[0].values[i]);
    return good;
}

static bool survey_figures(const char *path, struct text *to)
{
    LOCAL_ARENA(arena);
    LOCAL_PROBLEMS(problems);
    LOCAL_TEXT(yaml);
    struct survey_file file;
    bool good = ceduo_survey_read(&file, &arena, path, NULL, &problems) && ceduo_survey_print_stand(&file, &yaml, &problems);
    for (const char *p = ceduo_text_string(&yaml), *end; good && (end = strchr(p, '\n')); p = end + 1)
        if (*p != '#')
            ceduo_text_append_n(to, p, (size_t)(end - p) + 1);
    return good;
}

/* Append the figures of a text; false if it is refused. */
static bool read_text(figures *read, const char *text, struct text *to)
{
    char path[64];
    int fd = memfd_create("table", MFD_CLOEXEC);
    assert_true(fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text));
    snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
    bool good = read(path, to);
    close(fd);
    return good;
}

/* ---- changes ---- */

static size_t below(size_t n)
{
    return (size_t)line_uniform(&state, 0, (double)n);
}

/* Begin and end of a cell in a text. */
struct cell {
    size_t from, to;
    bool last; /* last of its line */
};

static size_t find_cells(const char *text, char separator, struct cell *cells)
{
    size_t n = 0, from = 0;
    bool quoted = false;
    for (size_t i = 0; text[i]; i++) {
        quoted ^= text[i] == '"';
        if (quoted || (text[i] != separator && text[i] != '\n'))
            continue;
        cells[n++] = (struct cell){from, i, text[i] == '\n'};
        from = i + 1;
    }
    return n;
}

enum change { REMOVE, DOUBLE, QUOTE, SEPARATE, CUT, KINDS };

/* Replace text[from, to) by n bytes. */
static void splice(char *text, size_t from, size_t to, const char *with, size_t n)
{
    memmove(text + from + n, text + to, strlen(text + to) + 1);
    memcpy(text + from, with, n);
}

static void change(char *text, char separator, enum change kind)
{
    struct cell cells[BYTES / 8];
    char copy[BYTES];
    size_t n = find_cells(text, separator, cells), at = below(strlen(text));
    const struct cell *cell = &cells[below(n)];
    size_t length = cell->to - cell->from + 1;
    switch (kind) {
    case REMOVE: /* with its separator; the last cell with the one before it */
        splice(text, cell->from - cell->last, cell->to + !cell->last, "", 0);
        break;
    case DOUBLE:
        memcpy(copy, text + cell->from, length);
        copy[length - 1] = separator;
        splice(text, cell->from, cell->from, copy, length);
        break;
    case QUOTE:
        splice(text, at, at, "\"", 1);
        break;
    case SEPARATE:
        splice(text, at, at, &separator, 1);
        break;
    case CUT: {
        size_t end = cell->to;
        while (text[end] != '\n')
            end++;
        size_t cut = cell->from + below(length);
        bool first = cell == cells || cells[cell - cells - 1].last;
        if (!cell->last && (cut > cell->from || !first))
            splice(text, cut, end, "", 0);
        break;
    }
    case KINDS:
        break;
    }
}

static void expect_good_or_refused(figures *read, const char *good, char separator)
{
    const char *many = getenv("CHANGES");
    int rounds = many ? atoi(many) : CHANGES;
    LOCAL_TEXT(wanted);
    assert_true(read_text(read, good, &wanted));
    for (int kind = 0; kind < KINDS; kind++)
        for (int i = 0; i < rounds; i++) {
            char text[BYTES];
            LOCAL_TEXT(found);
            snprintf(text, sizeof text, "%s", good);
            change(text, separator, (enum change)kind);
            if (read_text(read, text, &found) && strcmp(ceduo_text_string(&found), wanted.bytes) != 0)
                fail_msg("change %d makes another table of\n%s\nfound\n%s", kind, text, ceduo_text_string(&found));
        }
}

TEST(a_changed_profile)
{
    expect_good_or_refused(profile_figures, profile, ';');
}

TEST(a_changed_line_on_the_map)
{
    expect_good_or_refused(profile_figures, line, ',');
}

TEST(a_changed_table_of_stops)
{
    expect_good_or_refused(stops_figures, stops, ';');
}

TEST(a_changed_survey)
{
    expect_good_or_refused(survey_figures, plots, ';');
}

TEST(a_changed_tally)
{
    expect_good_or_refused(survey_figures, tally, ';');
}
