/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of the command line in one table, which the parser, the help and the checks read. A new option is a row, and a
 * setter if no other fits. The lists of changes and options belong to the arguments; their strings are those of main(). */
#include <getopt.h>
#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "arguments.h"
#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "io/file.h"
#include "messages.h"
#include "scene/choices.h"

#define WIDTH_MIN   20
#define HEIGHT_MIN  6
#define THREADS_MAX 1024

/* ---- shared setters ---- */

static enum exit_status set_text(struct arguments *a, const struct option_row *row, char *value)
{
    memcpy((char *)a + row->offset, &value, sizeof value);
    return EXIT_DONE;
}

/* Set an enum or a count to the index of a word of row->value. */
static enum exit_status set_word(struct arguments *a, const struct option_row *row, char *value)
{
    int i = 0;
    size_t length = strlen(value);
    LOCAL_TEXT(all);
    for (const char *word = row->value; *word; i++) {
        size_t n = strcspn(word, "|");
        if (n == length && strncmp(word, value, n) == 0) {
            memcpy((char *)a + row->offset, &i, sizeof i);
            return EXIT_DONE;
        }
        ceduo_text_format(&all, "%s%.*s", i > 0 ? ", " : "", (int)n, word);
        word += n + (word[n] == '|');
    }
    return ceduo_usage_error(row->name, _("'%s' is unknown; one of: %s"), value, all.bytes);
}

/* Set the language immediately, for messages about later options. */
static enum exit_status set_language(struct arguments *a, const struct option_row *row, char *value)
{
    enum exit_status status = set_word(a, row, value);
    if (status == EXIT_DONE)
        ceduo_language_set(value);
    return status;
}

static enum exit_status add_word(struct arguments *a, const struct option_row *row, char *value)
{
    struct word_list *words = (void *)((char *)a + row->offset);
    words->items[words->n++] = value;
    return EXIT_DONE;
}

/* ---- setters of one option ---- */

static enum exit_status set_flag(struct arguments *a, const struct option_row *row, char *value)
{
    (void)value;
    *(bool *)((char *)a + row->offset) = true;
    return EXIT_DONE;
}

/* Set a whole number from row->lo to row->hi. Without a value the member keeps its default. */
static enum exit_status set_count(struct arguments *a, const struct option_row *row, char *value)
{
    switch (value ? ceduo_count_read(value, row->lo, row->hi, (uint64_t *)(void *)((char *)a + row->offset))
                  : CEDUO_NUMBER_GOOD) {
    case CEDUO_NUMBER_GOOD:
        return EXIT_DONE;
    case CEDUO_NUMBER_TOO_LARGE:
        return ceduo_usage_error(row->name, _("%s is outside %s to %s"), value, ROUNDTRIP(row->lo), ROUNDTRIP(row->hi));
    default:
        return ceduo_usage_error(row->name, _("'%s' is not a whole number"), value);
    }
}

static enum exit_status set_seed(struct arguments *a, const struct option_row *row, char *value)
{
    enum exit_status status = set_count(a, row, value);
    snprintf(a->seed_set, sizeof a->seed_set, "simulation.seed=%llu", (unsigned long long)a->seed);
    a->sets.items[a->sets.n++] = a->seed_set;
    return status;
}

/* Report text that is not a number; if it is a percentage, suggest the share. */
static enum exit_status report_no_number(const struct option_row *row, const char *value)
{
    char part[64];
    double number;
    size_t length = strlen(value);
    snprintf(part, sizeof part, "%.*s", (int)(length < sizeof part ? length - (length > 0) : 0), value);
    if (length > 0 && value[length - 1] == '%' && ceduo_number_read(part, &number) == CEDUO_NUMBER_GOOD)
        return ceduo_usage_error(row->name, _("'%s' is not a number; write %s"), value,
                                 ceduo_number_shortest(number / 100, part));
    return ceduo_usage_error(row->name, _("'%s' is not a number"), value);
}

static enum exit_status report_no_share(const struct option_row *row, const char *value)
{
    return ceduo_usage_error(row->name, _("%s is not a share; write a number between 0 and 1, such as 0.05 for 5 %%"), value);
}

/* Set a share above 0, at most row->hi. */
static enum exit_status set_share(struct arguments *a, const struct option_row *row, char *value)
{
    double *share = (double *)(void *)((char *)a + row->offset);
    if (ceduo_number_read(value, share) != CEDUO_NUMBER_GOOD)
        return report_no_number(row, value);
    return *share > 0 && *share <= row->hi ? EXIT_DONE : report_no_share(row, value);
}

static enum exit_status set_plot(struct arguments *a, const struct option_row *row, char *value)
{
    a->plot = ceduo_plot_find(value);
    if (a->plot != CEDUO_PLOT_NONE)
        return EXIT_DONE;
    const char *remedy = ceduo_removed_hint(value);
    return remedy ? ceduo_usage_error(row->name, _("'%s' is gone: %s"), value, _(remedy))
                  : ceduo_usage_error(row->name, _("'%s' is unknown; one of: %s"), value, ceduo_plot_names);
}

/* Read min to max numbers with a separator between them. Missing ones keep their values. */
static bool read_numbers(const char *text, const char *separator, int min, int max, double *numbers)
{
    for (int n = 1; n <= max; n++) {
        char part[256];
        size_t length = strcspn(text, separator);
        snprintf(part, sizeof part, "%.*s", (int)(length < sizeof part ? length : 0), text);
        if (ceduo_number_read(part, &numbers[n - 1]) != CEDUO_NUMBER_GOOD)
            return false;
        if (!text[length])
            return n >= min;
        text += length + 1;
    }
    return false;
}

static bool is_whole(double number)
{
    return number == floor(number);
}

/* Report a value in a wrong form. */
static enum exit_status report_form(const struct option_row *row, const char *value, const char *form, const char *example)
{
    return ceduo_usage_error(row->name, _("'%s' is not %s, such as '%s'"), value, form, example);
}

static enum exit_status set_size(struct arguments *a, const struct option_row *row, char *value)
{
    double n[2];
    if (!read_numbers(value, "x", 2, 2, n) || !is_whole(n[0]) || !is_whole(n[1]))
        return report_form(row, value, "COLUMNSxLINES", "80x24");
    if (n[0] < WIDTH_MIN || n[0] > CEDUO_CANVAS_MAX_WIDTH || n[1] < HEIGHT_MIN || n[1] > CEDUO_CANVAS_MAX_HEIGHT) {
        char smallest[16], largest[16];
        snprintf(smallest, sizeof smallest, "%dx%d", WIDTH_MIN, HEIGHT_MIN);
        snprintf(largest, sizeof largest, "%dx%d", CEDUO_CANVAS_MAX_WIDTH, CEDUO_CANVAS_MAX_HEIGHT);
        return ceduo_usage_error(row->name, _("%s is outside %s to %s"), value, smallest, largest);
    }
    a->plot_width = (int)n[0];
    a->plot_height = (int)n[1];
    return EXIT_DONE;
}

/* Set "A:B" or "A:B:STEP", whole years; without a value, the years ahead. */
static enum exit_status set_years(struct arguments *a, const struct option_row *row, char *value)
{
    a->years = true;
    if (!value)
        return EXIT_DONE;
    double parts[3] = {0, 0, 1};
    bool good = read_numbers(value, ":", 2, 3, parts) && is_whole(parts[0]) && is_whole(parts[1]) && is_whole(parts[2]);
    if (!good)
        return report_form(row, value, "A:B[:STEP]", "0:25");
    if (parts[1] < parts[0])
        return ceduo_usage_error(row->name, _("%s: the last year is before the first; write %.0f:%.0f"), value, parts[1],
                                 parts[0]);
    if (parts[0] < 0 || parts[1] > 100000 || parts[2] < 1 || (parts[1] - parts[0]) / parts[2] >= CEDUO_YEARS_MAX)
        return ceduo_usage_error(row->name, _("%s: give at most %d years between 0 (the stand in the file) and 100000"), value,
                                 CEDUO_YEARS_MAX);
    a->window = (struct ceduo_window){
        .first = (unsigned)parts[0], .last = (unsigned)parts[1], .step = parts[2] > 100000 ? 100000 : (unsigned)parts[2]};
    return EXIT_DONE;
}

/* Read "PATH=LO:HI". The path is not copied. `one`: LO and HI may be equal. */
static enum exit_status read_range(const struct option_row *row, char *value, const char *example, bool one,
                                   struct path_range *range)
{
    char *equals = strrchr(value, '=');
    double ends[2];
    if (!equals || equals == value || !read_numbers(equals + 1, ":", 2, 2, ends))
        return report_form(row, value, row->value, example);
    if (one ? ends[1] < ends[0] : ends[1] <= ends[0])
        return ceduo_usage_error(row->name, _("the range %s is empty; HI must be above LO"), equals + 1);
    *equals = '\0';
    *range = (struct path_range){value, ends[0], ends[1]};
    return EXIT_DONE;
}

static enum exit_status set_find(struct arguments *a, const struct option_row *row, char *value)
{
    return read_range(row, value, "forest[0].stand.trees[0].per_ha=1:1000", true, &a->find);
}

static enum exit_status add_calibrate(struct arguments *a, const struct option_row *row, char *value)
{
    if (a->calibrates_count == CEDUO_CALIBRATION_MAX)
        return ceduo_usage_error(row->name, _("at most %d values can be fitted at once"), CEDUO_CALIBRATION_MAX);
    return read_range(row, value, "slope.materials[talus].rn=0.2:0.5", false, &a->calibrates[a->calibrates_count++]);
}

static enum exit_status set_goal(struct arguments *a, const struct option_row *row, char *value)
{
    enum ceduo_goal_reading reading = ceduo_goal_read(value, &a->goal, &a->goal_value);
    const char *number = value + strlen(value) + 1;
    LOCAL_TEXT(words);
    switch (reading) {
    case CEDUO_GOAL_UNKNOWN:
        ceduo_goal_words(&words);
        return ceduo_usage_error(row->name, _("'%s' is unknown; one of: %s"), value, ceduo_text_string(&words));
    case CEDUO_GOAL_NO_NUMBER:
        return report_no_number(row, number);
    case CEDUO_GOAL_NEGATIVE:
        return ceduo_usage_error(row->name, _("%s is below %s%s%s"), number, "0", "", "");
    case CEDUO_GOAL_NO_SHARE:
        return report_no_share(row, number);
    default:
        return EXIT_DONE;
    }
}

/* Set the output to the file of --report. Require .html: if the user forgot the file, `value` is a scene, which must not be
 * overwritten. */
static enum exit_status set_report(struct arguments *a, const struct option_row *row, char *value)
{
    bool standard = strcmp(value, "-") == 0;
    if (!standard && !ceduo_file_is_html(value))
        return ceduo_usage_error(row->name,
                                 _("'%s' does not end in .html or .htm; name the page, or - for standard output, then the "
                                   "scenes: --report page.html scene.yaml"),
                                 value);
    a->output = standard ? NULL : value;
    return EXIT_DONE;
}

/* Set a file, or - for standard output. */
static enum exit_status set_output(struct arguments *a, const struct option_row *row, char *value)
{
    (void)row;
    a->output = strcmp(value, "-") == 0 ? NULL : value;
    return EXIT_DONE;
}

/* ---- the table ---- */

#define MEMBER(member) offsetof(struct arguments, member)

/* Modes that refuse an option. */
enum {
    M_CHECK = 1u << MODE_CHECK,
    M_FIND = 1u << MODE_FIND,
    M_UNCERTAINTY = 1u << MODE_SENSITIVITY,
    M_FIT = 1u << MODE_CALIBRATE,
    M_PAGE = 1u << MODE_REPORT,
    M_SURVEY = 1u << MODE_SURVEY,
    M_LISTS = 1u << MODE_PARAMETERS | 1u << MODE_PROFILES | 1u << MODE_COLUMNS | 1u << MODE_SCHEMA,
    M_SCREEN = 1u << MODE_TERMINAL
};

static const struct option_row rows[] = {
    {"batch", 'b', NULL, NULL, 0, MODE_BATCH, M_SURVEY,
     .help = N_("compute the scenes and print the result, without a terminal")},
    {"format", 'f', "table|csv|json|geojson", set_word, MEMBER(format), MODE_TERMINAL,
     M_CHECK | M_PAGE | M_SURVEY | M_LISTS | M_SCREEN, .help = N_("format of the output (table)")},
    {"details", 0, NULL, set_flag, MEMBER(details), MODE_BATCH, M_CHECK | M_FIND | M_UNCERTAINTY | M_FIT | M_PAGE | M_SURVEY,
     .help = N_("print the whole page with every figure, not only the answer")},
    {"output", 'o', "FILE", set_output, 0, MODE_TERMINAL, M_CHECK | M_PAGE | M_SCREEN,
     .help = N_("write to FILE, - for standard output; a regular file is written completely or not at all")},
    {"set", 's', "PATH=VALUE", add_word, MEMBER(sets), MODE_TERMINAL, M_SURVEY | M_SCREEN,
     .help = N_("change a parameter of the scene; may be repeated")},
    {"rocks", 'n', "N", set_count, MEMBER(rocks), MODE_TERMINAL, M_CHECK | M_SURVEY | M_SCREEN,
     .help = N_("number of rocks; with --tolerance the maximum"), .lo = 1, .hi = CEDUO_ROCKS_MAX},
    {"tolerance", 'e', "REL", set_share, MEMBER(tolerance), MODE_TERMINAL,
     M_CHECK | M_FIND | M_UNCERTAINTY | M_FIT | M_SURVEY | M_SCREEN,
     .help = N_("simulate until the 95 % error of each mean energy is below REL of it"), .hi = 1 - 0x1p-53},
    {"rows", 0, "controls|stands", set_word, MEMBER(stands), MODE_TERMINAL,
     M_CHECK | M_FIND | M_UNCERTAINTY | M_FIT | M_PAGE | M_SURVEY | M_SCREEN, NEEDS_CSV,
     .help = N_("what each row of CSV describes (controls)")},
    {"each", 0, "ROWS.csv", set_text, MEMBER(each), MODE_TERMINAL, M_FIT | M_SURVEY | M_SCREEN,
     .help = N_("compute the scenes once for each row of a table: columns named as a path of --set change them, the others are "
                "copied")},
    {"key", 0, "NAME", set_text, MEMBER(key), MODE_TERMINAL, M_FIT | M_SURVEY | M_SCREEN, NEEDS_EACH,
     .help =
         N_("the column of --each that names a row: messages use it, and other copied columns are printed only if --columns "
            "names them")},
    {"columns", 0, "LIST", set_text, MEMBER(columns), MODE_TERMINAL, M_CHECK | M_FIT | M_PAGE | M_SURVEY | M_LISTS | M_SCREEN,
     NEEDS_CSV, .help = N_("print these columns of CSV, with commas between their names; NAME=COLUMN renames one")},
    {"resume", 0, NULL, set_flag, MEMBER(resume), MODE_TERMINAL, M_CHECK | M_FIT | M_PAGE | M_SURVEY | M_SCREEN, NEEDS_FILE,
     .help = N_("with --each and -o: do not compute rows again that FILE has; FILE grows row by row, and so does FILE.resume")},
    {"seed", 0, "N", set_seed, MEMBER(seed), MODE_TERMINAL, M_SURVEY | M_SCREEN,
     .help = N_("seed of the random numbers, 0 to 2^53"), .lo = 0, .hi = 0x1p53},
    {"threads", 'j', "N", set_count, MEMBER(threads), MODE_TERMINAL, M_SURVEY,
     .help = N_("number of threads; it does not change the result (all cores)"), .lo = 1, .hi = THREADS_MAX},
    {"option", 0, "NAME", add_word, MEMBER(options), MODE_TERMINAL, M_FIT | M_SURVEY | M_SCREEN,
     .help = N_("compute only this option of the scene; may be repeated")},
    {"years", 0, "[A:B[:STEP]]", set_years, 0, MODE_BATCH, M_CHECK | M_FIT | M_SURVEY,
     .help =
         N_("compute every option year by year: the common years ahead, or the years A to B; year 0 is the stand in the file")},
    {"find", 0, "PATH=LO:HI", set_find, 0, MODE_FIND, M_CHECK | M_PAGE | M_SURVEY, NEEDS_GOAL,
     .help = N_("find the value of a parameter that reaches --goal at the worst control")},
    {"goal", 0, "GOAL[=VALUE]", set_goal, 0, MODE_TERMINAL, M_CHECK | M_SURVEY, NEEDS_FIND,
     .help = N_("adc, free-run (at most the light's limit), energy (mean kJ), exceed (share, 0.05), arrive (share), "
                "worst-exceed or worst-arrive (the worst of the years ahead)")},
    {"sure", 0, "SHARE", set_share, MEMBER(sure), MODE_TERMINAL, M_CHECK | M_SURVEY, NEEDS_FIND,
     .help = N_("with --find: also find the value that reaches the goal in this share of plausible cases, such as 0.9"),
     .hi = 1},
    {"sensitivity", 0, "[N]", set_count, MEMBER(points), MODE_SENSITIVITY, M_CHECK | M_SURVEY,
     .help = N_("show the effect of uncertain inputs on the result; N points (256)"), .lo = 2,
     .hi = CEDUO_UNCERTAINTY_POINTS_MAX},
    {"report", 0, "FILE", set_report, 0, MODE_REPORT, M_CHECK | M_SURVEY,
     .help = N_("write a report as HTML, with pictures and a chapter for each scene; with --each, one page for all rows; - is "
                "standard output")},
    {"chapters", 0, "N", set_count, MEMBER(chapters), MODE_TERMINAL, ~(unsigned)M_PAGE, NEEDS_EACH,
     .help = N_("with --report and --each: add a chapter for each of the N worst rows (0)"), .hi = 1000},
    {"calibrate", 0, "PATH=LO:HI", add_calibrate, 0, MODE_CALIBRATE, M_CHECK | M_PAGE | M_SURVEY,
     .help = N_("fit this value to the observations, between LO and HI; may be repeated; -o FILE.yaml writes the first scene "
                "with the fitted values")},
    {"plot", 0, "WHAT", set_plot, 0, MODE_BATCH, M_CHECK | M_FIND | M_FIT | M_PAGE | M_SURVEY,
     .help = N_(
         "print a picture: profile, energy, height, histogram, rotation, years, stand, compare, ahead, tradeoff, uncertainty, "
         "hazard or fence")},
    {"size", 0, "WxH", set_size, 0, MODE_TERMINAL, M_CHECK | M_SURVEY, NEEDS_PLOT,
     .help = N_("size of a picture in columns and lines (80x24)")},
    {"charset", 0, "braille|block|ascii", set_word, MEMBER(charset), MODE_TERMINAL, M_CHECK | M_SURVEY, NEEDS_PICTURE,
     .help = N_("characters of pictures (from the locale)")},
    {"language", 0, "it|en", set_language, MEMBER(language), MODE_TERMINAL, 0,
     .help = N_("language of tables, screens and messages (from the locale)")},
    {"script", 0, "FILE", set_text, MEMBER(script), MODE_TERMINAL, ~(unsigned)M_SCREEN,
     .help = N_("run keys and commands in the terminal program; needs no terminal")},
    {"tour", 0, NULL, set_flag, MEMBER(tour), MODE_TERMINAL, ~(unsigned)M_SCREEN,
     .help = N_("show the terminal program in ten questions; Esc ends the tour and opens the scene")},
    {"check", 0, NULL, NULL, 0, MODE_CHECK, M_SURVEY, .help = N_("check the scenes and print every problem; compute nothing")},
    {"list-parameters", 0, NULL, NULL, 0, MODE_PARAMETERS, M_SURVEY,
     .help = N_("list path, type, unit, range, default and meaning of each parameter")},
    {"list-profiles", 0, NULL, NULL, 0, MODE_PROFILES, M_SURVEY,
     .help = N_("list the scenes, slopes, stands and rules that can be named")},
    {"list-columns", 0, NULL, NULL, 0, MODE_COLUMNS, M_SURVEY,
     .help = N_("list path, type, unit and meaning of each column of CSV, also with --rows stands or --years")},
    {"schema", 0, "result|find|sensitivity|calibration|failed", set_word, MEMBER(schema), MODE_SCHEMA, M_SURVEY,
     .help = N_("print the JSON Schema of this output")},
    {"survey", 0, "FILE.csv", set_text, MEMBER(survey), MODE_SURVEY, M_CHECK,
     .help = N_("write the stand of a survey: a CSV file with a row for each stem on sample plots; --survey --template writes "
                "an empty one")},
    {"quiet", 'q', NULL, set_flag, MEMBER(quiet), MODE_TERMINAL, 0, .help = N_("print no progress")},
    {"help", 'h', NULL, NULL, 0, MODE_HELP, 0, .help = N_("print this help")},
    {"version", 'V', NULL, NULL, 0, MODE_VERSION, 0, .help = N_("print the version")},
};

#define OPTIONS (sizeof rows / sizeof rows[0])
_Static_assert(OPTIONS <= 64, "arguments.given has a bit for each");

const struct option_row *ceduo_option_rows(size_t *n)
{
    *n = OPTIONS;
    return rows;
}

bool ceduo_arguments_given(const struct arguments *a, const char *name)
{
    size_t i = 0;
    while (strcmp(rows[i].name, name) != 0)
        i++;
    return (a->given >> i & 1) != 0;
}

/* ---- the help ---- */

#define HELP_COLUMN 30

void ceduo_arguments_help(struct text *text)
{
    ceduo_text_append(text, _("ceduo: does this coppice stop the rocks?\n\n"
                              "usage: ceduo [SCENE.yaml]\n"
                              "       ceduo --batch [OPTION...] SCENE.yaml...\n"
                              "       ceduo --report PAGE.html [OPTION...] SCENE.yaml...\n"
                              "       ceduo --plot WHAT [OPTION...] SCENE.yaml...\n"
                              "       ceduo --check SCENE.yaml...\n"
                              "       ceduo --survey PLOTS.csv [-o STAND.yaml]\n"
                              "       ceduo --list-parameters | --list-profiles\n\n"
                              "SCENE is a file, - for standard input, or the name of a shipped scene.\n\n"));
    for (size_t i = 0; i < OPTIONS; i++) {
        const char *value = rows[i].value ? rows[i].value : "", *blank = rows[i].value ? " " : "";
        char head[64];
        int width = rows[i].letter ? snprintf(head, sizeof head, "  -%c, --%s%s%s", rows[i].letter, rows[i].name, blank, value)
                                   : snprintf(head, sizeof head, "      --%s%s%s", rows[i].name, blank, value);
        ceduo_text_format(text, "%-*s%s%*s", HELP_COLUMN, head, width < HELP_COLUMN ? "" : "\n",
                          width < HELP_COLUMN ? 0 : HELP_COLUMN, "");
        for (const char *help = _(rows[i].help), *next; *help; help = next) {
            int n = (int)ceduo_utf8_wrap(help, 79 - HELP_COLUMN, &next);
            ceduo_text_format(text, "%.*s\n%*s", n, help, *next ? HELP_COLUMN : 0, "");
        }
    }
    ceduo_text_append(text, _("\nexample: ceduo --batch -s 'forest[0].stand.stools.per_ha=2000' paper-site\n"
                              "exit status: 0 done, 1 run failed, 2 usage, 3 bad input, 4 output failed;\n"
                              "see man ceduo; step by step: man ceduo-workflows\n"));
}

/* ---- checks ---- */

static enum exit_status report_conflict(const char *option, const char *conflicting)
{
    return ceduo_usage_error(NULL, _("--%s cannot be used with --%s"), option, conflicting);
}

static enum exit_status report_requirement(const char *option, const char *needed)
{
    return ceduo_usage_error(NULL, _("--%s requires %s"), option, needed);
}

/* Report an option that conflicts with the mode or requires another option. Lists and reports accept --format table, their only
 * format. */
static enum exit_status check_rows(const struct arguments *a, const char *mode)
{
    bool plot = a->plot != CEDUO_PLOT_NONE, csv = a->format == CEDUO_CSV, columns = ceduo_format_has_columns(a->format);
    const struct {
        const char *name;
        bool given;
    } needs[] = {[NEEDS_GOAL] = {"--goal", ceduo_arguments_given(a, "goal")},
                 [NEEDS_FIND] = {"--find", a->mode == MODE_FIND},
                 [NEEDS_PLOT] = {"--plot", plot},
                 [NEEDS_PICTURE] = {"--plot", plot || a->mode == MODE_TERMINAL},
                 [NEEDS_CSV] = {"--format csv", columns || a->mode == MODE_COLUMNS},
                 [NEEDS_EACH] = {"--each", a->each != NULL},
                 [NEEDS_FILE] = {"--each --output --format csv", a->each && a->output && csv}};
    for (size_t i = 0; i < OPTIONS; i++) {
        const struct option_row *row = &rows[i];
        bool table = strcmp(row->name, "format") == 0 && a->format == CEDUO_TABLE;
        bool wrong_plot = a->mode == MODE_SENSITIVITY && strcmp(row->name, "plot") == 0 && a->plot != CEDUO_PLOT_UNCERTAINTY;
        bool conflicts = wrong_plot || (row->conflicts >> a->mode & 1);
        if (!(a->given >> i & 1) || (table && (a->mode == MODE_REPORT || a->mode >= MODE_PARAMETERS)))
            continue;
        if (conflicts && a->mode == MODE_TERMINAL)
            return report_requirement(row->name, "--batch");
        if (conflicts)
            return report_conflict(mode, row->name);
        if (row->needs != NEEDS_NOTHING && !needs[row->needs].given)
            return report_requirement(row->name, needs[row->needs].name);
    }
    return EXIT_DONE;
}

/* Check the combination of options and the number of scenes. */
static enum exit_status check_arguments(const struct arguments *a)
{
    static const char *const formats[] = {"format table", "format csv", "format json", "format geojson"};
    const char *mode = "batch", *goal = ceduo_goals[a->goal].word;
    for (size_t i = 0; i < OPTIONS; i++)
        if (rows[i].mode == a->mode && (a->given >> i & 1))
            mode = rows[i].name;
    if (a->mode >= MODE_HELP)
        return EXIT_DONE;
    if (check_rows(a, mode) != EXIT_DONE)
        return EXIT_USAGE;
    bool screen = a->mode == MODE_TERMINAL, plot = a->plot != CEDUO_PLOT_NONE;
    bool wants_scene = a->mode >= MODE_BATCH && a->mode <= MODE_CHECK;
    size_t standard = a->each && a->scenes_count > 0; /* --each reads the scene for each row, so it must be a file */
    for (size_t i = 0; i < a->scenes_count; i++)
        standard += strcmp(a->scenes[i], "-") == 0;
    if (a->mode == MODE_FIND && a->window.step > 0)
        return report_conflict("find", "years A:B");
    if (plot && a->format != CEDUO_TABLE)
        return report_conflict("plot", formats[a->format]);
    if (a->format == CEDUO_GEOJSON && !a->each)
        return report_requirement(formats[a->format], "--each");
    if (plot && a->years && !(ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_YEARS))
        return report_requirement("years", "--plot rotation|years|ahead|tradeoff");
    if (a->mode == MODE_FIND && !ceduo_goals[a->goal].usual && isnan(a->goal_value))
        return ceduo_usage_error("goal", _("'%s' needs a value, such as %s=%s"), goal, goal,
                                 ceduo_goal_is_share(a->goal) ? "0.5" : "50");
    if (wants_scene && a->scenes_count == 0)
        return ceduo_usage_error(
            NULL, _("no scene given; name a file, a shipped scene such as 'paper-site', or '-' for standard input"));
    if (!wants_scene && !screen && a->scenes_count > 0)
        return ceduo_usage_error(NULL, _("--%s takes no scene: '%s'"), mode, a->scenes[0]);
    if (screen && a->scenes_count > 1)
        return ceduo_usage_error(NULL, _("the terminal program opens one scene; --batch takes several"));
    return standard > 1 ? ceduo_usage_error(NULL, _("standard input can be read only once; name a file for the scene"))
                        : EXIT_DONE;
}

/* ---- reading ---- */

#define FIRST_LONG 256 /* first number of options without a letter, for getopt */

/* Return the next word as the value of an option with an optional value: accept "--years 0:25" like "--years=0:25". It must
 * have a colon or begin like a number, and must not be a file. NULL: none. */
static char *find_detached_value(int argc, char **argv)
{
    char *word = optind < argc ? argv[optind] : NULL;
    bool number = word && strcspn(word, "0123456789") <= (size_t)(word[0] == '-');
    bool is_value = word && (number || strchr(word, ':')) && access(word, F_OK) != 0;
    optind += is_value;
    return is_value ? word : NULL;
}

/* Return the priority of a mode: help first, then lists and checks, then computations. Of equal modes the first wins. */
static int rank_mode(enum mode mode)
{
    return (int)(mode < MODE_CHECK ? mode : mode < MODE_HELP ? MODE_CHECK : MODE_HELP);
}

enum exit_status ceduo_arguments_read(struct arguments *a, int argc, char **argv)
{
    struct option longs[OPTIONS + 1] = {{0}};
    char shorts[2 * OPTIONS + 2] = ":", *letter_at = shorts + 1;
    cpu_set_t given; /* processors that Slurm or taskset allow */
    long cores = sched_getaffinity(0, sizeof given, &given) == 0 ? CPU_COUNT(&given) : sysconf(_SC_NPROCESSORS_ONLN);
    size_t max = (size_t)argc + 1;
    *a = (struct arguments){.threads = cores > 0 && cores <= THREADS_MAX ? (uint64_t)cores : 1,
                            .charset = ceduo_is_utf8() ? CEDUO_CHARSET_BRAILLE : CEDUO_CHARSET_ASCII,
                            .plot_width = 80,
                            .plot_height = 24,
                            .points = CEDUO_UNCERTAINTY_POINTS,
                            .goal_value = NAN,
                            .sets.items = ceduo_check_memory(calloc(max, sizeof *a->sets.items)),
                            .options.items = ceduo_check_memory(calloc(max, sizeof *a->options.items))};
    for (size_t i = 0; i < OPTIONS; i++) {
        int takes = !rows[i].value ? no_argument : rows[i].value[0] == '[' ? optional_argument : required_argument;
        longs[i] = (struct option){rows[i].name, takes, NULL, FIRST_LONG + (int)i};
        if (rows[i].letter)
            *letter_at++ = rows[i].letter;
        if (rows[i].letter && rows[i].value)
            *letter_at++ = ':';
    }
    *letter_at = '\0';
    opterr = 0;
    for (int letter; (letter = getopt_long(argc, argv, shorts, longs, NULL)) != -1;) {
        const char *word = argv[optind - 1];
        if (letter == ':')
            return ceduo_usage_error(NULL, _("'%s' needs a value"), word);
        if (letter == '?' && word[0] == '-' && word[1] == '-' && optopt)
            return ceduo_usage_error(NULL, _("'%s': this option takes no value"), word);
        const char *remedy = letter == '?' ? ceduo_removed_hint(word) : NULL;
        if (remedy)
            return ceduo_usage_error(NULL, _("'%s' is gone: %s"), word, _(remedy));
        if (letter == '?')
            return ceduo_usage_error(NULL, _("unknown or ambiguous option '%s'"),
                                     optopt ? (char[]){'-', (char)optopt, '\0'} : word);
        size_t i = letter >= FIRST_LONG ? (size_t)(letter - FIRST_LONG) : 0;
        while (letter < FIRST_LONG && rows[i].letter != letter)
            i++;
        if (!optarg && rows[i].value)
            optarg = find_detached_value(argc, argv);
        enum exit_status status = rows[i].set ? rows[i].set(a, &rows[i], optarg) : EXIT_DONE;
        if (status != EXIT_DONE)
            return status;
        a->given |= (uint64_t)1 << i;
        if (rank_mode(rows[i].mode) > rank_mode(a->mode))
            a->mode = rows[i].mode;
    }
    a->scenes = argv + optind;
    a->scenes_count = (size_t)(argc - optind);
    return check_arguments(a);
}

void ceduo_arguments_free(struct arguments *a)
{
    free(a->sets.items);
    free(a->options.items);
}
