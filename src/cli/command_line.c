/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command_line.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/intl.h"
#include "options.h"
#include "say.h"
#include "together.h"

/* ---- the help ---- */

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

/* ---- reading ---- */

#define LONG 256 /* from here on getopt's numbers of options without a letter */

/* Room for n + 1 long options and 2n + 2 characters. */
static void fill_getopt(const struct option_row *rows, size_t n, struct option *longs, char *shorts)
{
    *shorts++ = ':';
    for (size_t i = 0; i < n; i++) {
        longs[i] = (struct option){rows[i].name, rows[i].value ? required_argument : no_argument, NULL, LONG + (int)i};
        if (rows[i].letter)
            *shorts++ = rows[i].letter;
        if (rows[i].letter && rows[i].value)
            *shorts++ = ':';
    }
    longs[n] = (struct option){0};
    *shorts = '\0';
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
                            .sets = calloc(most, sizeof *a->sets),
                            .options = calloc(most, sizeof *a->options)};
    if (!a->sets || !a->options)
        return ceduo_usage_no_memory();
    opterr = 0;
    for (int letter; (letter = getopt_long(argc, argv, shorts, longs, NULL)) != -1;) {
        const char *word = argv[optind - 1];
        if (letter == ':')
            return ceduo_usage(NULL, _("'%s' needs a value"), word);
        if (letter == '?' && word[0] == '-' && word[1] == '-' && optopt)
            return ceduo_usage(NULL, _("'%s': this option takes no value"), word);
        if (letter == '?' && optopt && optopt < 256)
            return ceduo_usage(NULL, _("unknown option '-%c'"), optopt);
        if (letter == '?')
            return ceduo_usage(NULL, _("no such option, or not one alone: '%s'"), word);
        size_t i = letter >= LONG ? (size_t)(letter - LONG) : 0;
        while (letter < LONG && rows[i].letter != letter)
            i++;
        enum exit_status status = ceduo_option_set(a, &rows[i], optarg);
        if (status != EXIT_DONE)
            return status;
    }
    a->scenes = argv + optind;
    a->scenes_count = (size_t)(argc - optind);
    return ceduo_arguments_check(a);
}

void ceduo_arguments_free(struct arguments *a)
{
    free(a->sets);
    free(a->options);
}
