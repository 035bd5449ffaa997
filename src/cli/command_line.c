/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Help, checks and reading of the command line, all from the table in options.c. The lists of changes and options are
 * the arguments' own; their strings are those of main(). */
#include "command_line.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "base/must.h"
#include "base/utf8.h"
#include "options.h"
#include "say.h"

/* ---- the help ---- */

static int takes(const struct option_row *row)
{
    return !row->value ? no_argument : row->value[0] == '[' ? optional_argument : required_argument;
}

#define HELP_COLUMN 30

/* A help text from its column on, in lines of 80 columns at most. */
static void put_help(struct text *text, const char *help)
{
    size_t column = HELP_COLUMN;
    while (*help) {
        size_t n = strcspn(help, " "), width = ceduo_utf8_width_of(help, n), gap = column > HELP_COLUMN;
        if (column + gap + width > 79) {
            ceduo_text_format(text, "\n%*s", HELP_COLUMN, "");
            column = HELP_COLUMN;
            gap = 0;
        }
        ceduo_text_format(text, "%s%.*s", gap ? " " : "", (int)n, help);
        column += gap + width;
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
                           "       ceduo --check SCENE.yaml...\n"
                           "       ceduo --survey PLOTS.csv [-o STAND.yaml]\n"
                           "       ceduo --list-parameters | --list-profiles\n\n"
                           "SCENE is a file, - for standard input, or the name of a shipped scene.\n\n"));
    size_t n;
    const struct option_row *rows = ceduo_option_rows(&n);
    for (size_t i = 0; i < n; i++) {
        char head[64];
        int width = snprintf(head, sizeof head, rows[i].letter ? "  -%c, --%s%s%s" : "    %c --%s%s%s",
                             rows[i].letter ? rows[i].letter : ' ', rows[i].name, rows[i].value ? " " : "",
                             rows[i].value ? rows[i].value : "");
        ceduo_text_format(text, "%-30s%s", head, width >= 30 ? "\n                              " : "");
        put_help(text, _(rows[i].help));
    }
    ceduo_text_put(text, _("\nexample: ceduo --batch -s 'forest[0].stand.stools.per_ha=2000' paper-site\n"
                           "exit status: 0 done, 1 run failed, 2 usage, 3 bad input, 4 output failed;\n"
                           "see man ceduo\n"));
}

/* ---- what goes together ---- */

/* Says which option does not go with what is asked for. A format of its own is one that is not the page. */
static enum exit_status check_with(const struct arguments *a)
{
    size_t n;
    const char *mode = "batch";
    const struct option_row *rows = ceduo_option_rows(&n);
    for (size_t i = 0; i < n; i++)
        if (rows[i].mode == a->mode && (a->given >> i & 1))
            mode = rows[i].name;
    for (size_t i = 0; i < n; i++) {
        bool page = strcmp(rows[i].name, "format") == 0 && a->format == CEDUO_TABLE;
        bool doubt = a->mode == MODE_SENSITIVITY && strcmp(rows[i].name, "plot") == 0 && a->plot != CEDUO_PLOT_DOUBT;
        if (!(a->given >> i & 1) || !(doubt || (rows[i].without >> a->mode & 1)))
            continue;
        if (a->mode == MODE_TERMINAL)
            return ceduo_usage(NULL, _("options such as -s, -n, -f and -o require --batch"));
        if (!page || (a->mode != MODE_REPORT && a->mode < MODE_PARAMETERS))
            return ceduo_usage(NULL, _("--%s cannot be used with --%s"), mode, rows[i].name);
    }
    return EXIT_DONE;
}

/* Whether the options go together, and as many scenes are named as they want. */
static enum exit_status check_arguments(const struct arguments *a)
{
    bool plot = a->plot != CEDUO_PLOT_NONE, wants_scene = a->mode >= MODE_BATCH && a->mode <= MODE_CHECK;
    bool by_years = a->plot == CEDUO_PLOT_ROTATION || a->plot == CEDUO_PLOT_TRADEOFF;
    size_t standard = 0;
    for (size_t i = 0; i < a->scenes_count; i++)
        standard += strcmp(a->scenes[i], "-") == 0;
    if (a->mode >= MODE_HELP)
        return EXIT_DONE;
    if (check_with(a) != EXIT_DONE)
        return EXIT_USAGE;
    if (a->mode == MODE_SURVEY && a->scenes_count > 0)
        return ceduo_usage(NULL, _("--survey takes one CSV file, and no scene: '%s'"), a->scenes[0]);
    if (a->mode == MODE_FIND && !ceduo_option_given(a, "goal"))
        return ceduo_usage(NULL, _("--find requires a --goal"));
    if (ceduo_option_given(a, "goal") && a->mode != MODE_FIND)
        return ceduo_usage(NULL, _("--goal requires --find"));
    if (ceduo_option_given(a, "sure") && a->mode != MODE_FIND)
        return ceduo_usage(NULL, _("--sure requires --find"));
    if (a->mode == MODE_FIND && !ceduo_goals[a->goal].usual && isnan(a->goal_value))
        return ceduo_usage(NULL, a->goal == CEDUO_GOAL_ENERGY
                                     ? _("--goal energy needs the mean energy in kJ, such as energy=50")
                                     : _("--goal arrive needs the share of the rocks, such as arrive=0.5"));
    if (a->mode == MODE_FIND && a->window.step > 0)
        return ceduo_usage(NULL, _("--find takes --years without a range"));
    if (wants_scene && a->scenes_count == 0)
        return ceduo_usage(NULL,
                           _("no scene given; name a file, a shipped scene such as 'paper-site', or '-' for standard input"));
    if (!wants_scene && a->mode != MODE_TERMINAL && a->scenes_count > 0)
        return ceduo_usage(NULL, _("the --list options take no scene: '%s'"), a->scenes[0]);
    if (plot && a->format != CEDUO_TABLE)
        return ceduo_usage(NULL, _("--plot prints a picture; it cannot be used with --format csv or json"));
    if (a->plot_width > 0 && !plot)
        return ceduo_usage(NULL, _("--size requires --plot"));
    if (ceduo_option_given(a, "rows") && a->mode != MODE_COLUMNS && a->format != CEDUO_CSV)
        return ceduo_usage(NULL, _("--rows requires --format csv"));
    if (a->columns && a->format != CEDUO_CSV)
        return ceduo_usage(NULL, _("--columns requires --format csv"));
    if (a->resume && (!a->each || !a->output || a->format != CEDUO_CSV || plot))
        return ceduo_usage(NULL, _("--resume requires --each, --output and --format csv"));
    if (ceduo_option_given(a, "charset") && !plot && a->mode != MODE_TERMINAL)
        return ceduo_usage(NULL, _("--charset requires --plot or the terminal program"));
    if (a->script && a->mode != MODE_TERMINAL)
        return ceduo_usage(NULL, _("--script is for the terminal program; it cannot be used with --batch"));
    if (a->years && plot && !by_years)
        return ceduo_usage(NULL, _("--years cannot be used with --plot, except --plot rotation and --plot tradeoff"));
    if (a->mode == MODE_TERMINAL && a->scenes_count > 1)
        return ceduo_usage(NULL, _("the terminal program opens one scene; --batch takes several"));
    standard += a->each && strcmp(a->each, "-") == 0;
    if (standard > 1)
        return ceduo_usage(NULL, _("standard input can be read only once"));
    return EXIT_DONE;
}

/* ---- reading ---- */

#define LONG 256 /* from here on getopt's numbers of options without a letter */

/* Room for n + 1 long options and 2n + 2 characters. */
static void fill_getopt(const struct option_row *rows, size_t n, struct option *longs, char *shorts)
{
    *shorts++ = ':';
    for (size_t i = 0; i < n; i++) {
        longs[i] = (struct option){rows[i].name, takes(&rows[i]), NULL, LONG + (int)i};
        if (rows[i].letter)
            *shorts++ = rows[i].letter;
        if (rows[i].letter && rows[i].value)
            *shorts++ = ':';
    }
    longs[n] = (struct option){0};
    *shorts = '\0';
}

/* The value of an option that may be without one, where it is a word of its own: one with a colon, or that begins as a
 * number does, unless it is a file. */
static char *word_of_its_own(int argc, char **argv)
{
    char *word = optind < argc ? argv[optind] : NULL;
    bool number = word && strcspn(word, "0123456789") <= (size_t)(word[0] == '-');
    bool is_value = word && (number || strchr(word, ':')) && access(word, F_OK) != 0;
    optind += is_value;
    return is_value ? word : NULL;
}

static unsigned cores(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n > 0 && n <= THREADS_MOST ? (unsigned)n : 1;
}

enum exit_status ceduo_arguments_read(struct arguments *a, int argc, char **argv)
{
    struct option longs[OPTIONS_MOST + 1];
    char shorts[2 * OPTIONS_MOST + 2];
    size_t n;
    const struct option_row *rows = ceduo_option_rows(&n);
    fill_getopt(rows, n, longs, shorts);
    size_t most = (size_t)argc + 1;
    *a = (struct arguments){.threads = cores(),
                            .goal_value = NAN,
                            .sets.items = ceduo_must(calloc(most, sizeof *a->sets.items)),
                            .options.items = ceduo_must(calloc(most, sizeof *a->options.items)),
                            .calibrates.items = ceduo_must(calloc(most, sizeof *a->calibrates.items))};
    opterr = 0;
    for (int letter; (letter = getopt_long(argc, argv, shorts, longs, NULL)) != -1;) {
        const char *word = argv[optind - 1];
        if (letter == ':')
            return ceduo_usage(NULL, _("'%s' needs a value"), word);
        if (letter == '?' && word[0] == '-' && word[1] == '-' && optopt)
            return ceduo_usage(NULL, _("'%s': this option takes no value"), word);
        if (letter == '?' && optopt && optopt < 256)
            return ceduo_usage(NULL, _("unknown option '-%c'"), optopt);
        const char *instead = letter == '?' ? ceduo_option_gone(word) : NULL;
        if (instead)
            return ceduo_usage(NULL, _("'%s' is gone: %s"), word, instead);
        if (letter == '?')
            return ceduo_usage(NULL, _("unknown or ambiguous option '%s'"), word);
        size_t i = letter >= LONG ? (size_t)(letter - LONG) : 0;
        while (letter < LONG && rows[i].letter != letter)
            i++;
        if (!optarg && rows[i].value)
            optarg = word_of_its_own(argc, argv);
        enum exit_status status = ceduo_option_set(a, &rows[i], optarg);
        if (status != EXIT_DONE)
            return status;
    }
    a->scenes = argv + optind;
    a->scenes_count = (size_t)(argc - optind);
    return check_arguments(a);
}

void ceduo_arguments_free(struct arguments *a)
{
    free(a->sets.items);
    free(a->options.items);
    free(a->calibrates.items);
}
