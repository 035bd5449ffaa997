/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "arguments.h"

#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ceduo/scene.h"
#include "ceduo/years.h"
#include "base/intl.h"
#include "io/part_file.h"

#define THREADS_MOST 1024
#define WIDTH_LEAST  20
#define HEIGHT_LEAST 6

/* One table: parsing and help. */
enum {
    OPTION_ROWS = 256,
    OPTION_SEED,
    OPTION_ONLY,
    OPTION_YEARS,
    OPTION_FIND,
    OPTION_GOAL,
    OPTION_SHARD,
    OPTION_MERGE,
    OPTION_PLOT,
    OPTION_SIZE,
    OPTION_CHARSET,
    OPTION_SCRIPT,
    OPTION_CHECK,
    OPTION_PARAMETERS,
    OPTION_PROFILES,
    OPTION_HELP,
    OPTION_VERSION
};

static const struct argument_row rows[] = {
    {"batch", 'b', NULL, N_("compute the scenes and print the result; no terminal is touched")},
    {"format", 'f', "table|csv|json", N_("how to print it (table)")},
    {"output", 'o', "FILE", N_("where to; a regular file is written whole or not at all")},
    {"set", 's', "PATH=VALUE", N_("change a parameter of the scene; may be repeated")},
    {"rocks", 'n', "N", N_("rocks simulated; with --tolerance the most")},
    {"tolerance", 'e', "REL", N_("go on until mean energies are known to REL of themselves (95 %)")},
    {"rows", OPTION_ROWS, "controls|stands", N_("what a row of CSV is (controls)")},
    {"seed", OPTION_SEED, "N", N_("seed of the random numbers, 0 to 2^53")},
    {"threads", 'j', "N", N_("threads; the result does not depend on them (all cores)")},
    {"option", OPTION_ONLY, "NAME", N_("only this option of the scene; may be repeated")},
    {"years", OPTION_YEARS, "A:B[:STEP]", N_("every option year by year, from the stands as filed (year 0)")},
    {"find", OPTION_FIND, "PATH=LO:HI", N_("the value of a parameter that reaches --goal at the worst control")},
    {"goal", OPTION_GOAL, "GOAL[=VALUE]", N_("adc, free-run (at most the light's limit), energy (mean kJ) or exceed (share, 0.05)")},
    {"shard", OPTION_SHARD, "I/N", N_("compute part I of N of each scene, and write it as a line for --merge")},
    {"merge", OPTION_MERGE, NULL, N_("print what the parts in the files given come to, as one run would")},
    {"plot", OPTION_PLOT, "WHAT", N_("print a picture: profile, energy, height, histogram, adc, rotation, stand or compare")},
    {"size", OPTION_SIZE, "WxH", N_("of a picture in columns and lines (80x24)")},
    {"charset", OPTION_CHARSET, "braille|block|ascii", N_("what pictures are made of (the locale's)")},
    {"script", OPTION_SCRIPT, "FILE", N_("feed keys and commands to the terminal program; needs no terminal")},
    {"check", OPTION_CHECK, NULL, N_("read the scenes and print every problem; compute nothing")},
    {"list-parameters", OPTION_PARAMETERS, NULL, N_("path, type, unit, range, default and meaning of each")},
    {"list-profiles", OPTION_PROFILES, NULL, N_("scenes, slopes and stands that are found by name")},
    {"quiet", 'q', NULL, N_("no progress")},
    {"help", OPTION_HELP, NULL, N_("this page")},
    {"version", OPTION_VERSION, NULL, N_("the version")},
};

#define ROWS (sizeof rows / sizeof rows[0])

const struct argument_row *ceduo_arguments_rows(size_t *n)
{
    *n = ROWS;
    return rows;
}

#define HELP_COLUMN 30

/* A help text from its column on, in lines of 80 columns at most. */
static void put_help(struct text *text, const char *help)
{
    size_t column = HELP_COLUMN;
    while (*help) {
        size_t n = strcspn(help, " "), gap = column > HELP_COLUMN;
        if (column + gap + n > 79) {
            ceduo_text_format(text, "\n%*s", HELP_COLUMN, "");
            column = HELP_COLUMN;
            gap = 0;
        }
        ceduo_text_format(text, "%s%.*s", gap ? " " : "", (int)n, help);
        column += gap + n;
        help += n + (help[n] == ' ');
    }
    ceduo_text_char(text, '\n');
}

void ceduo_arguments_help(struct text *text)
{
    ceduo_text_put(text, _("ceduo: does this coppice stop the rocks?\n\n"
                           "usage: ceduo [SCENE.yaml]\n"
                           "       ceduo --batch [OPTION...] SCENE.yaml...\n"
                           "       ceduo --plot WHAT [OPTION...] SCENE.yaml...\n"
                           "       ceduo --shard I/N [OPTION...] SCENE.yaml...\n"
                           "       ceduo --merge [OPTION...] PART...\n"
                           "       ceduo --check SCENE.yaml...\n"
                           "       ceduo --list-parameters | --list-profiles\n\n"
                           "SCENE is a file, - for standard input, or the name of a shipped scene.\n\n"));
    for (size_t i = 0; i < ROWS; i++) {
        char head[64];
        int n = snprintf(head, sizeof head, "  %c%c%s --%s%s%s", rows[i].letter < 256 ? '-' : ' ',
                         rows[i].letter < 256 ? rows[i].letter : ' ', rows[i].letter < 256 ? "," : " ", rows[i].name,
                         rows[i].value ? " " : "", rows[i].value ? rows[i].value : "");
        ceduo_text_format(text, "%-30s%s", head, n >= 30 ? "\n                              " : "");
        put_help(text, _(rows[i].help));
    }
    ceduo_text_put(text, _("\nexample: ceduo --batch -s 'forest[0].stand.stools.per_ha=2000' paper-site\n"
                           "exit status: 0 done, 1 run failed, 2 usage, 3 bad input, 4 output failed;\n"
                           "see man ceduo\n"));
}

static enum exit_status no_memory(void)
{
    fputs(_("ceduo: out of memory\n"), stderr);
    return EXIT_RUN;
}

__attribute__((format(printf, 1, 2))) static enum exit_status usage(const char *format, ...)
{
    struct text message = {0}, safe = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&message, format, args);
    va_end(args);
    ceduo_text_safe(&safe, message.bytes ? message.bytes : "");
    bool good = !message.failed && !safe.failed && safe.bytes;
    if (good)
        fprintf(stderr, _("ceduo: %s\ntry 'ceduo --help'\n"), safe.bytes);
    ceduo_text_free(&message);
    ceduo_text_free(&safe);
    return good ? EXIT_USAGE : no_memory();
}

static enum exit_status read_count(const char *name, const char *value, double lo, double hi, uint64_t *to)
{
    switch (ceduo_count_read(value, lo, hi, to)) {
    case CEDUO_NUMBER_GOOD:
        return EXIT_DONE;
    case CEDUO_NUMBER_TOO_LARGE:
        return usage(_("--%s: %s lies outside %.0f to %.0f"), name, value, lo, hi);
    default:
        return usage(_("--%s: '%s' is no whole number"), name, value);
    }
}

static enum exit_status read_tolerance(struct arguments *a, const char *value)
{
    double number;
    if (ceduo_number_read(value, &number) != CEDUO_NUMBER_GOOD)
        return usage(_("--tolerance: '%s' is no number"), value);
    if (!(number > 0) || !(number < 1))
        return usage(_("--tolerance: %s must lie above 0 and below 1"), value);
    a->tolerance = number;
    return EXIT_DONE;
}

/* Index of a word, -1 where it is none of them. */
static int word_of(const char *value, const char *const *words, int n)
{
    for (int i = 0; i < n; i++)
        if (strcmp(words[i], value) == 0)
            return i;
    return -1;
}

static enum exit_status read_format(struct arguments *a, const char *value)
{
    static const char *const words[] = {"table", "csv", "json"};
    int i = word_of(value, words, 3);
    if (i < 0)
        return usage(_("--format: '%s' is unknown; one of table, csv, json"), value);
    a->format = (enum ceduo_format)i;
    return EXIT_DONE;
}

static enum exit_status read_rows(struct arguments *a, const char *value)
{
    static const char *const words[] = {"controls", "stands"};
    int i = word_of(value, words, 2);
    if (i < 0)
        return usage(_("--rows: '%s' is unknown; one of controls, stands"), value);
    a->stands = i == 1;
    return EXIT_DONE;
}

static enum exit_status read_plot(struct arguments *a, const char *value)
{
    a->plot = ceduo_plot_find(value);
    if (a->plot == CEDUO_PLOT_NONE)
        return usage(_("--plot: '%s' is unknown; one of %s"), value, CEDUO_PLOT_NAMES);
    if (a->mode == MODE_TERMINAL)
        a->mode = MODE_BATCH;
    return EXIT_DONE;
}

static enum exit_status read_size(struct arguments *a, const char *value)
{
    char *width = strdup(value), *height = width ? strchr(width, 'x') : NULL;
    double w = 0, h = 0;
    if (!width)
        return no_memory();
    if (height)
        *height++ = '\0';
    bool good = height && ceduo_number_read(width, &w) == CEDUO_NUMBER_GOOD &&
                ceduo_number_read(height, &h) == CEDUO_NUMBER_GOOD && w == floor(w) && h == floor(h);
    free(width);
    if (!good)
        return usage(_("--size: '%s' is no size; write columns x lines, as 80x24"), value);
    if (w < WIDTH_LEAST || w > CEDUO_CANVAS_MAX_WIDTH || h < HEIGHT_LEAST || h > CEDUO_CANVAS_MAX_HEIGHT)
        return usage(_("--size: %s lies outside %dx%d to %dx%d"), value, WIDTH_LEAST, HEIGHT_LEAST,
                     CEDUO_CANVAS_MAX_WIDTH, CEDUO_CANVAS_MAX_HEIGHT);
    a->plot_width = (int)w;
    a->plot_height = (int)h;
    return EXIT_DONE;
}

static enum exit_status read_charset(struct arguments *a, const char *value)
{
    static const char *const words[] = {"braille", "block", "ascii"};
    int i = word_of(value, words, 3);
    if (i < 0)
        return usage(_("--charset: '%s' is unknown; one of braille, block, ascii"), value);
    a->charset = (enum ceduo_charset)i;
    a->charset_given = true;
    return EXIT_DONE;
}

static enum exit_status read_seed(struct arguments *a, const char *value)
{
    uint64_t seed;
    enum exit_status status = read_count("seed", value, 0, 9007199254740992.0, &seed);
    if (status != EXIT_DONE)
        return status;
    snprintf(a->seed, sizeof a->seed, "simulation.seed=%llu", (unsigned long long)seed);
    a->sets[a->sets_count++] = a->seed;
    return EXIT_DONE;
}

static void set_mode(struct arguments *a, enum mode mode)
{
    if (a->mode < MODE_HELP && (a->mode < MODE_CHECK || mode >= MODE_HELP))
        a->mode = mode;
}

/* "A:B" or "A:B:STEP", whole years. */
static enum exit_status read_years(struct arguments *a, const char *value)
{
    double parts[3] = {0, 0, 1};
    char *copy = strdup(value), *rest = copy;
    int n = 0;
    bool good = true;
    if (!copy)
        return no_memory();
    while (good && rest && n < 3) {
        char *part = rest, *colon = strchr(rest, ':');
        rest = colon ? colon + 1 : NULL;
        if (colon)
            *colon = '\0';
        good = ceduo_number_read(part, &parts[n]) == CEDUO_NUMBER_GOOD && parts[n] == floor(parts[n]);
        n++;
    }
    good = good && !rest && n >= 2;
    free(copy);
    if (!good)
        return usage(_("--years: '%s' is no stretch of years; write A:B or A:B:STEP, as 0:25"), value);
    if (parts[0] < 0)
        return usage(_("--years: %s begins before year 0, the stand as filed"), value);
    if (parts[1] < parts[0] || parts[1] > 100000 || parts[2] < 1)
        return usage(_("--years: %s goes backwards, or too far"), value);
    if ((parts[1] - parts[0]) / parts[2] >= CEDUO_YEARS_MOST)
        return usage(_("--years: %s are more than %d years at a time"), value, CEDUO_YEARS_MOST);
    a->years = true;
    a->year_first = (unsigned)parts[0];
    a->year_last = (unsigned)parts[1];
    a->year_step = parts[2] > 100000 ? 100000 : (unsigned)parts[2];
    if (a->mode == MODE_TERMINAL)
        a->mode = MODE_BATCH;
    return EXIT_DONE;
}

/* "PATH=LO:HI"; the path is kept without the rest. */
static enum exit_status read_find(struct arguments *a, char *value)
{
    char *equals = strrchr(value, '='), *colon = equals ? strchr(equals, ':') : NULL;
    bool good = colon && equals > value;
    if (good)
        *colon = '\0';
    good = good && ceduo_number_read(equals + 1, &a->find_lo) == CEDUO_NUMBER_GOOD &&
           ceduo_number_read(colon + 1, &a->find_hi) == CEDUO_NUMBER_GOOD;
    if (colon)
        *colon = ':';
    if (!good)
        return usage(_("--find: '%s' is not PATH=LO:HI, as 'forest[0].stand.trees[0].per_ha=1:1000'"), value);
    if (!(a->find_lo <= a->find_hi))
        return usage(_("--find: the range %s goes backwards"), equals + 1);
    *equals = '\0';
    a->find = value;
    set_mode(a, MODE_FIND);
    return EXIT_DONE;
}

static enum exit_status read_goal(struct arguments *a, char *value)
{
    enum ceduo_goal_reading reading = ceduo_goal_read(value, &a->goal, &a->goal_value);
    const char *number = value + strlen(value) + 1;
    a->goal_given = true;
    switch (reading) {
    case CEDUO_GOAL_UNKNOWN:
        return usage(_("--goal: '%s' is unknown; one of adc, free-run, energy, exceed"), value);
    case CEDUO_GOAL_NO_NUMBER:
        return usage(_("--goal: '%s' is no number"), number);
    case CEDUO_GOAL_NEGATIVE:
        return usage(_("--goal: %s is below 0"), number);
    case CEDUO_GOAL_NO_SHARE:
        return usage(_("--goal: %s is no share; write 0 to 1, as 0.05 for 5 %%"), number);
    default:
        return EXIT_DONE;
    }
}

/* "I/N" */
static enum exit_status read_shard(struct arguments *a, const char *value)
{
    char *part = strdup(value), *parts = part ? strchr(part, '/') : NULL;
    if (parts)
        *parts++ = '\0';
    bool good = parts && ceduo_count_read(parts, 1, SHARDS_MOST, &a->shards) == CEDUO_NUMBER_GOOD &&
                ceduo_count_read(part, 1, (double)a->shards, &a->shard) == CEDUO_NUMBER_GOOD;
    free(part);
    if (!good)
        return usage(_("--shard: '%s' is no part of a whole; write I/N, I from 1 to N, as 3/8, N up to %d"), value,
                     SHARDS_MOST);
    if (a->mode == MODE_TERMINAL)
        a->mode = MODE_BATCH;
    return EXIT_DONE;
}

static enum exit_status read_threads(struct arguments *a, const char *value)
{
    uint64_t n;
    enum exit_status status = read_count("threads", value, 1, THREADS_MOST, &n);
    if (status == EXIT_DONE)
        a->threads = (unsigned)n;
    return status;
}

/* What an option that stands for itself asks for. */
static enum mode mode_of(int letter)
{
    switch (letter) {
    case OPTION_CHECK:
        return MODE_CHECK;
    case OPTION_PARAMETERS:
        return MODE_PARAMETERS;
    case OPTION_PROFILES:
        return MODE_PROFILES;
    case OPTION_HELP:
        return MODE_HELP;
    default:
        return MODE_VERSION;
    }
}

static enum exit_status read_option(struct arguments *a, int letter, char *value)
{
    switch (letter) {
    case 'b':
        if (a->mode == MODE_TERMINAL)
            a->mode = MODE_BATCH;
        return EXIT_DONE;
    case 'f':
        a->format_given = true;
        return read_format(a, value);
    case 'o':
        a->output = value;
        return EXIT_DONE;
    case 's':
        a->sets[a->sets_count++] = value;
        return EXIT_DONE;
    case 'n':
        return read_count("rocks", value, 1, CEDUO_ROCKS_MOST, &a->rocks);
    case 'e':
        return read_tolerance(a, value);
    case 'j':
        return read_threads(a, value);
    case 'q':
        a->quiet = true;
        return EXIT_DONE;
    case OPTION_SHARD:
        return read_shard(a, value);
    case OPTION_MERGE:
        a->merge = true;
        if (a->mode <= MODE_BATCH)
            a->mode = MODE_MERGE;
        return EXIT_DONE;
    case OPTION_ROWS:
        a->rows_given = true;
        return read_rows(a, value);
    case OPTION_SEED:
        return read_seed(a, value);
    case OPTION_ONLY:
        a->options[a->options_count++] = value;
        return EXIT_DONE;
    case OPTION_YEARS:
        return read_years(a, value);
    case OPTION_FIND:
        return read_find(a, value);
    case OPTION_GOAL:
        return read_goal(a, value);
    case OPTION_PLOT:
        return read_plot(a, value);
    case OPTION_SIZE:
        return read_size(a, value);
    case OPTION_SCRIPT:
        a->script = value;
        return EXIT_DONE;
    case OPTION_CHARSET:
        return read_charset(a, value);
    default:
        set_mode(a, mode_of(letter));
        return EXIT_DONE;
    }
}

static void fill_getopt(struct option *longs, char *shorts)
{
    *shorts++ = ':';
    for (size_t i = 0; i < ROWS; i++) {
        longs[i] = (struct option){rows[i].name, rows[i].value ? required_argument : no_argument, NULL, rows[i].letter};
        if (rows[i].letter < 256) {
            *shorts++ = (char)rows[i].letter;
            if (rows[i].value)
                *shorts++ = ':';
        }
    }
    longs[ROWS] = (struct option){0};
    *shorts = '\0';
}

/* What one of --shard, --merge and --check does not go with. */
struct other_option {
    const char *name;
    bool given;
};

static enum exit_status check_others(const char *one, const char *why, const struct other_option *others, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (others[i].given)
            return usage(_("--%s does not go with --%s: %s"), one, others[i].name, why);
    return EXIT_DONE;
}

static enum exit_status check_parts(struct arguments *a)
{
    const struct other_option others[] = {
        {"shard", a->shards > 0 && a->merge},
        {"years", a->years},
        {"find", a->find != NULL},
        {"plot", a->plot != CEDUO_PLOT_NONE},
        {"check", a->mode == MODE_CHECK},
        {"script", a->script != NULL},
        {"tolerance", a->tolerance > 0},
        {"list-parameters", a->mode == MODE_PARAMETERS},
        {"list-profiles", a->mode == MODE_PROFILES},
        /* of one of the two alone */
        {"format", a->shards > 0 && a->format_given},
        {"rows", a->shards > 0 && a->rows_given},
        {"rocks", a->merge && a->rocks > 0},
        {"seed", a->merge && a->seed[0] != '\0'},
        {"set", a->merge && a->sets_count > 0},
        {"option", a->merge && a->options_count > 0}};
    size_t n = sizeof others / sizeof others[0];
    if (a->merge)
        return check_others("merge", _("what is printed was computed with the parts"), others, n);
    if (a->shards == 0)
        return EXIT_DONE;
    enum exit_status status = check_others("shard", _("it writes a part of one run, which --merge prints"), others, n);
    a->format = CEDUO_JSON; /* lines, one for each scene */
    return status;
}

static enum exit_status check_check(const struct arguments *a)
{
    const struct other_option others[] = {{"format", a->format_given},
                                          {"rows", a->rows_given},
                                          {"rocks", a->rocks > 0},
                                          {"tolerance", a->tolerance > 0},
                                          {"output", a->output != NULL},
                                          {"years", a->years},
                                          {"find", a->find != NULL},
                                          {"goal", a->goal_given},
                                          {"plot", a->plot != CEDUO_PLOT_NONE},
                                          {"size", a->plot_width > 0},
                                          {"charset", a->charset_given},
                                          {"script", a->script != NULL}};
    return check_others("check", _("it computes nothing"), others, sizeof others / sizeof others[0]);
}

/* What would otherwise be passed over without a word. */
static enum exit_status check_unused(const struct arguments *a)
{
    if (a->rows_given && a->format != CEDUO_CSV)
        return usage(_("--rows goes with --format csv"));
    if (a->charset_given && a->plot == CEDUO_PLOT_NONE && a->mode != MODE_TERMINAL)
        return usage(_("--charset goes with --plot and the terminal program"));
    if (a->script && a->mode != MODE_TERMINAL)
        return usage(_("--script feeds the terminal program; it does not go with --batch"));
    if (a->years && a->plot != CEDUO_PLOT_NONE && a->plot != CEDUO_PLOT_ROTATION)
        return usage(_("--years goes with the page, CSV, JSON and --plot rotation"));
    return EXIT_DONE;
}

static enum exit_status check_together(struct arguments *a)
{
    if (a->mode < MODE_HELP && check_parts(a) != EXIT_DONE)
        return EXIT_USAGE;
    if (a->mode == MODE_CHECK && check_check(a) != EXIT_DONE)
        return EXIT_USAGE;
    if (a->mode == MODE_MERGE && a->scenes_count == 0)
        return usage(_("--merge wants files with the parts that --shard wrote, '-' for standard input"));
    bool wants_scene = a->mode == MODE_BATCH || a->mode == MODE_MERGE || a->mode == MODE_CHECK || a->mode == MODE_FIND;
    if (a->mode == MODE_FIND && !a->goal_given)
        return usage(_("--find wants a --goal: adc, free-run, energy=KJ or exceed"));
    if (a->goal_given && a->mode != MODE_FIND)
        return usage(_("--goal goes with --find"));
    if (a->mode == MODE_FIND && ceduo_goals[a->goal].needs_value && isnan(a->goal_value))
        return usage(_("--goal energy wants the mean energy in kJ: energy=50"));
    if (a->mode == MODE_FIND && (a->plot != CEDUO_PLOT_NONE || a->years || a->tolerance > 0))
        return usage(_("--find goes with neither --plot, --years nor --tolerance"));
    if (wants_scene && a->scenes_count == 0)
        return usage(_("no scene; name a file, '-' for standard input, or a shipped scene such as 'paper-site'"));
    if (!wants_scene && a->mode != MODE_TERMINAL && a->scenes_count > 0 && a->mode < MODE_HELP)
        return usage(_("a list takes no scene: '%s'"), a->scenes[0]);
    if (a->plot != CEDUO_PLOT_NONE && a->format != CEDUO_TABLE)
        return usage(_("--plot prints a picture; it has no --format csv or json"));
    if (a->plot_width > 0 && a->plot == CEDUO_PLOT_NONE)
        return usage(_("--size goes with --plot"));
    if (a->mode < MODE_HELP && check_unused(a) != EXIT_DONE)
        return EXIT_USAGE;
    bool batch_only = a->rocks > 0 || a->tolerance > 0 || a->sets_count > 0 || a->options_count > 0 || a->output ||
                      a->format != CEDUO_TABLE || a->stands;
    if (a->mode == MODE_TERMINAL && batch_only)
        return usage(_("options such as -s, -n, -f and -o belong to --batch"));
    if (a->mode == MODE_TERMINAL && a->scenes_count > 1)
        return usage(_("the terminal program opens one scene; --batch takes several"));
    size_t standard = 0;
    for (size_t i = 0; i < a->scenes_count; i++)
        standard += strcmp(a->scenes[i], "-") == 0;
    if (standard > 1)
        return usage(_("standard input can be read only once"));
    return EXIT_DONE;
}

static unsigned cores(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n > 0 && n <= THREADS_MOST ? (unsigned)n : 1;
}

enum exit_status ceduo_arguments_read(struct arguments *a, int argc, char **argv)
{
    struct option longs[ROWS + 1];
    char shorts[2 * ROWS + 2];
    fill_getopt(longs, shorts);
    size_t most = (size_t)argc + 1;
    *a = (struct arguments){.threads = cores(),
                            .goal_value = NAN,
                            .sets = calloc(most, sizeof *a->sets),
                            .options = calloc(most, sizeof *a->options)};
    if (!a->sets || !a->options)
        return no_memory();
    opterr = 0;
    for (int letter; (letter = getopt_long(argc, argv, shorts, longs, NULL)) != -1;) {
        const char *word = argv[optind - 1];
        if (letter == ':')
            return usage(_("'%s' needs a value"), word);
        if (letter == '?' && word[0] == '-' && word[1] == '-' && optopt)
            return usage(_("'%s': this option takes no value"), word);
        if (letter == '?' && optopt && optopt < 256)
            return usage(_("unknown option '-%c'"), optopt);
        if (letter == '?')
            return usage(_("no such option, or not one alone: '%s'"), word);
        enum exit_status status = read_option(a, letter, optarg);
        if (status != EXIT_DONE)
            return status;
    }
    a->scenes = argv + optind;
    a->scenes_count = (size_t)(argc - optind);
    return check_together(a);
}

void ceduo_arguments_free(struct arguments *a)
{
    free(a->sets);
    free(a->options);
}
