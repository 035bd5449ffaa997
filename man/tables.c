/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a table into a manual page, between its two marks: tables keys PAGE that of the keys of the terminal program (in a
 * third word's language), goals and search those of a search, ranges those of doubt, figures those of JSON. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "cli/say.h"
#include "scene/ranges.h"
#include "scene/schema.h"
#include "study/goal.h"
#include "tui/keys.h"
#include "view/figures.h"

/* Text of a page: what troff would read as a request or an escape is hidden. */
static void put(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '\\')
            fputs("\\e", out);
        else if (*text == '-')
            fputs("\\-", out);
        else if ((unsigned char)*text == 0xe2 && strncmp(text, "\xe2\x80\xa6", 3) == 0) {
            fputs(" to ", out);
            text += 2;
        } else
            fputc(*text, out);
    }
}

/* A key as it is called: a single sign that mdoc would take for its own is hidden. */
static void put_key(FILE *out, const char *word)
{
    fputs(" Ic ", out);
    if (strlen(word) == 1 && strchr(".,:;()[]?!|", word[0]))
        fputs("\\&", out);
    put(out, word);
}

static void put_keys(FILE *out)
{
    fputs(".Bl -tag -width \"Shift\\-Tab\" -compact\n", out);
    for (int i = 0; i < ACTION_COUNT; i++) {
        const struct action_info *a = &ceduo_actions[i];
        fputs(".It", out);
        put_key(out, a->word);
        if (a->word2[0]) {
            fputs(" ,", out);
            put_key(out, a->word2);
        }
        fprintf(out, "\n%s\n", ceduo_translate_in(a->help));
    }
    fputs(".El\n", out);
}

static void put_goals(FILE *out)
{
    fputs(".Bl -tag -width Ds -compact\n", out);
    for (enum ceduo_goal i = 0; i < CEDUO_GOALS; i++) {
        const struct ceduo_goal_row *g = &ceduo_goals[i];
        fputs(".It Cm ", out);
        put(out, g->word);
        fputc('\n', out);
        put(out, g->meaning);
        fprintf(out, ",\n%s\n.Ar value%s%s", g->below ? "below" : "at most", ceduo_goal_is_share(i) ? "" : "\n",
                ceduo_goal_is_share(i) ? "" : g->unit);
        fprintf(out, g->usual ? "%s\nby default %s.\n" : "%s\nwhich is required.\n", ceduo_goal_is_share(i) ? " ," : ",",
                g->usual);
    }
    fputs(".El\n", out);
}

/* 2400 to 2750; 0.85 to 1.15 times its value; brauner, dorren. */
static void put_range(FILE *out, const struct range *r)
{
    if (r->kind == CEDUO_INPUT_WORDS)
        for (size_t i = 0; r->words[i]; i++)
            fprintf(out, "%s%s", i > 0 ? " or " : "", r->words[i]);
    else
        fprintf(out, "%g to %g%s", r->lo, r->hi, r->kind == CEDUO_INPUT_FACTOR ? " times the value" : "");
    fputs(" (", out);
    put(out, r->source);
    fputs(").\n", out);
    if (r->measured) {
        fputs("What measures it: ", out);
        put(out, r->measured);
        fputs(".\n", out);
    }
}

static void put_ranges(FILE *out)
{
    size_t n;
    const struct range *ranges = ceduo_ranges(&n);
    fputs(".Bl -tag -width Ds -compact\n", out);
    for (size_t i = 0; i < n; i++) {
        const char *end = strrchr(ranges[i].path, '.');
        fputs(".It Va ", out);
        put(out, end + 1);
        fputs(strstr(ranges[i].path, "stools")   ? " of stools\n"
              : strstr(ranges[i].path, "trees[") ? " of shoots and trees\n"
                                                 : "\n",
              out);
        put_range(out, &ranges[i]);
    }
    fputs(".El\n", out);
}

static bool is_listed(const struct ceduo_figure *figures)
{
    const struct ceduo_figure_list *list = ceduo_figure_lists;
    while (list->title && list->figures != figures)
        list++;
    return list->title != NULL;
}

/* `within`: the path of the object that they are of, with its dot. */
static void put_figures(FILE *out, const char *within, const struct ceduo_figure *f)
{
    for (; !ceduo_figure_is_end(f); f++) {
        if (!f->key && !is_listed(f->of))
            put_figures(out, within, f->of);
        if (!f->key)
            continue;
        fprintf(out, ".It Va %s%s\n", within, f->key);
        put(out, f->meaning);
        fprintf(out, "%s%s", f->unit[0] ? "; " : "", f->unit);
        if (f->null) {
            fputs("; null if ", out);
            put(out, f->null);
        }
        fputs(".\n", out);
        if (f->of && !is_listed(f->of)) {
            char path[256];
            snprintf(path, sizeof path, "%s%s.", within, f->key);
            put_figures(out, path, f->of);
        }
    }
}

static void put_figure_lists(FILE *out)
{
    for (const struct ceduo_figure_list *list = ceduo_figure_lists; list->title; list++) {
        fprintf(out, ".Pp\n%s:\n.Bl -tag -width \"reach_probability\" -compact\n", list->title);
        put_figures(out, "", list->figures);
        fputs(".El\n", out);
    }
}

static void put_search(FILE *out)
{
    fputs(".Bl -tag -width \"reach_probability\" -compact\n", out);
    put_figures(out, "", ceduo_find_figures);
    fputs(".El\n", out);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        void (*put)(FILE *out);
    } tables[] = {{"keys", put_keys},
                  {"goals", put_goals},
                  {"ranges", put_ranges},
                  {"search", put_search},
                  {"figures", put_figure_lists}};
    if (argc != 3 && argc != 4)
        return 2;
    if (argc == 4) {
        ceduo_language_start();
        ceduo_language_set(argv[3]);
    }
    size_t table = 0;
    while (table < sizeof tables / sizeof tables[0] && strcmp(argv[1], tables[table].name) != 0)
        table++;
    if (table == sizeof tables / sizeof tables[0])
        return 2;
    char begin_mark[64], end_mark[64];
    snprintf(begin_mark, sizeof begin_mark, ".\\\" begin %s\n", argv[1]);
    snprintf(end_mark, sizeof end_mark, ".\\\" end %s\n", argv[1]);
    static char page[1 << 20];
    FILE *in = fopen(argv[2], "r");
    size_t n = in ? fread(page, 1, sizeof page - 1, in) : 0;
    char *begin = strstr(page, begin_mark), *end = strstr(page, end_mark);
    if (!in || n == 0 || !begin || !end)
        return 1;
    fclose(in);
    FILE *out = fopen(argv[2], "w");
    if (!out)
        return 1;
    fwrite(page, 1, (size_t)(begin - page) + strlen(begin_mark), out);
    tables[table].put(out);
    fputs(end, out);
    return fclose(out) == 0 ? 0 : 1;
}
