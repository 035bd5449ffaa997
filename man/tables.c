/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Write a table into a manual page, between its two marks: tables TABLE PAGE [LANGUAGE]. Tables: keys (of the terminal program,
 * in LANGUAGE), goals and search (of --find), ranges (of uncertainty), figures (of JSON) and synopsis. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "cli/arguments.h"
#include "cli/messages.h"
#include "scene/ranges.h"
#include "scene/schema.h"
#include "study/goal.h"
#include "tui/keys.h"
#include "view/figures.h"

/* Print text with the characters of troff escaped. */
static void print_escaped(FILE *out, const char *text)
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

/* Print the name of a key, with a single delimiter of mdoc escaped. */
static void print_key(FILE *out, const char *word)
{
    fputs(" Ic ", out);
    if (strlen(word) == 1 && strchr(".,:;()[]?!|", word[0]))
        fputs("\\&", out);
    print_escaped(out, word);
}

static void print_keys(FILE *out)
{
    fputs(".Bl -tag -width \"Shift\\-Tab\" -compact\n", out);
    for (int i = 0; i < ACTION_COUNT; i++) {
        const struct action_info *a = &ceduo_actions[i];
        fputs(".It", out);
        print_key(out, a->word);
        if (a->word2[0]) {
            fputs(" ,", out);
            print_key(out, a->word2);
        }
        fprintf(out, "\n%s\n", ceduo_translate_in(a->help));
    }
    fputs(".El\n", out);
}

static void print_goals(FILE *out)
{
    fputs(".Bl -tag -width Ds -compact\n", out);
    for (enum ceduo_goal i = 0; i < CEDUO_GOALS; i++) {
        const struct ceduo_goal_row *g = &ceduo_goals[i];
        fputs(".It Cm ", out);
        print_escaped(out, g->word);
        fputc('\n', out);
        print_escaped(out, g->meaning);
        fprintf(out, ",\n%s\n.Ar value%s%s", g->below ? "below" : "at most", ceduo_goal_is_share(i) ? "" : "\n",
                ceduo_goal_is_share(i) ? "" : g->unit);
        fprintf(out, g->usual ? "%s\nby default %s.\n" : "%s\nwhich is required.\n", ceduo_goal_is_share(i) ? " ," : ",",
                g->usual);
    }
    fputs(".El\n", out);
}

/* Print a range: "2400 to 2750", "0.85 to 1.15 times its value" or "brauner, dorren". */
static void print_range(FILE *out, const struct range *r)
{
    if (r->kind == CEDUO_INPUT_WORDS)
        for (size_t i = 0; r->words[i]; i++)
            fprintf(out, "%s%s", i > 0 ? " or " : "", r->words[i]);
    else
        fprintf(out, "%g to %g%s", r->lo, r->hi, r->kind == CEDUO_INPUT_FACTOR ? " times the value" : "");
    fputs(" (", out);
    print_escaped(out, r->source);
    fputs(").\n", out);
    if (r->measured) {
        fputs("Measured by: ", out);
        print_escaped(out, r->measured);
        fputs(".\n", out);
    }
}

static void print_ranges(FILE *out)
{
    size_t n;
    const struct range *ranges = ceduo_ranges(&n);
    fputs(".Bl -tag -width Ds -compact\n", out);
    for (size_t i = 0; i < n; i++) {
        const char *end = strrchr(ranges[i].path, '.');
        fputs(".It Va ", out);
        print_escaped(out, end + 1);
        fputs(strstr(ranges[i].path, "stools")   ? " of stools\n"
              : strstr(ranges[i].path, "trees[") ? " of shoots and trees\n"
                                                 : "\n",
              out);
        print_range(out, &ranges[i]);
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

/* `prefix`: path of the object that holds the figures, with its dot. */
static void print_figures(FILE *out, const char *prefix, const struct ceduo_figure *f)
{
    for (; !ceduo_figure_is_end(f); f++) {
        if (!f->key && !is_listed(f->table))
            print_figures(out, prefix, f->table);
        if (!f->key)
            continue;
        fprintf(out, ".It Va %s%s\n", prefix, f->key);
        print_escaped(out, f->meaning);
        fprintf(out, "%s%s", f->unit[0] ? "; " : "", f->unit);
        if (f->null) {
            fputs("; null if ", out);
            print_escaped(out, f->null);
        }
        fputs(".\n", out);
        if (f->table && !is_listed(f->table)) {
            char path[256];
            snprintf(path, sizeof path, "%s%s.", prefix, f->key);
            print_figures(out, path, f->table);
        }
    }
}

static void print_figure_lists(FILE *out)
{
    for (const struct ceduo_figure_list *list = ceduo_figure_lists; list->title; list++) {
        fprintf(out, ".Pp\n%s:\n.Bl -tag -width \"reach_probability\" -compact\n", list->title);
        print_figures(out, "", list->figures);
        fputs(".El\n", out);
    }
}

static void print_search(FILE *out)
{
    fputs(".Bl -tag -width \"reach_probability\" -compact\n", out);
    print_figures(out, "", ceduo_find_figures);
    fputs(".El\n", out);
}

/* ---- synopsis ---- */

/* A form of the command line: the option of its mode, or several separated by |, and the option that it needs. */
struct form {
    enum mode mode;
    const char *required, *more, *operand;
};

static const struct form forms[] = {{MODE_TERMINAL, "", NULL, ".Op Ar scene"},
                                    {MODE_BATCH, "batch", NULL, ".Ar scene ..."},
                                    {MODE_FIND, "find", "goal", ".Ar scene ..."},
                                    {MODE_CALIBRATE, "calibrate", NULL, ".Ar scene ..."},
                                    {MODE_SENSITIVITY, "sensitivity", NULL, ".Ar scene ..."},
                                    {MODE_REPORT, "report", NULL, ".Ar scene ..."},
                                    {MODE_BATCH, "plot", NULL, ".Ar scene ..."},
                                    {MODE_CHECK, "check", NULL, ".Ar scene ..."},
                                    {MODE_SURVEY, "survey", NULL, NULL},
                                    {MODE_COLUMNS, "list-columns", NULL, NULL},
                                    {MODE_PARAMETERS, "list-parameters|list-profiles|schema", NULL, NULL},
                                    {MODE_HELP, "help|version", NULL, NULL}};

static const struct option_row *find_option(const char *name, size_t n)
{
    size_t count;
    const struct option_row *row = ceduo_option_rows(&count);
    while (strncmp(row->name, name, n) != 0 || row->name[n])
        row++;
    return row;
}

/* Print a value of the help in mdoc: capitals are arguments, small letters are literal. */
static void print_value(FILE *out, const char *value)
{
    bool literal = strchr(value, '|') || !value[0];
    const char *before = ""; /* no blank before the first part */
    if (literal)
        fputs(" Cm", out);
    for (size_t n; *value; value += n) {
        n = strspn(value, "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
        if (literal) {
            n = strcspn(value, "|");
            fprintf(out, " %.*s%s", (int)n, value, value[n] ? " |" : "");
            n += value[n] == '|';
        } else if (n > 0) {
            fprintf(out, "%s Ar ", before);
            n += value[n] == '.' ? strlen(value + n) : 0;
            for (size_t i = 0; i < n; i++)
                fputc(tolower((unsigned char)value[i]), out);
            before = " Ns";
        } else {
            n = 1;
            if (*value == '[')
                fprintf(out, "%s Op", before);
            else if (*value != ']')
                fprintf(out, *value == ':' || !before[0] ? " %c" : " Ns %c", *value);
            before = *value == '[' ? "" : " Ns";
        }
    }
}

/* `macro`: text before the option. */
static void print_option(FILE *out, const char *macro, const struct option_row *row, bool value)
{
    if (row->letter)
        fprintf(out, "%sFl %c", macro, row->letter);
    else
        fprintf(out, "%sFl -%s", macro, row->name);
    if (value && row->value)
        print_value(out, row->value);
}

/* True if a form may have an option. Forms that print a list or a stand have the options of --survey. */
static bool has_option(const struct form *form, const struct option_row *row)
{
    bool list = form->mode >= MODE_PARAMETERS, years = strcmp(row->name, "years") == 0, rows = strcmp(row->name, "rows") == 0;
    bool plot = strcmp(form->required, "plot") == 0, uncertainty = strcmp(row->name, "sensitivity") == 0;
    const struct option_row *format = find_option("format", 6);
    bool format_goes = !plot && !(format->conflicts >> form->mode & 1);
    if (form->mode == MODE_HELP)
        return strcmp(row->name, "language") == 0;
    if (form->mode == MODE_COLUMNS && (years || rows))
        return true;
    if (row->mode != MODE_TERMINAL && form->mode == MODE_TERMINAL)
        return false;
    if (row->mode != MODE_TERMINAL && !years && strcmp(row->name, "details") != 0 &&
        !(uncertainty && form->mode == MODE_REPORT))
        return false;
    if (row->conflicts >> (list ? MODE_SURVEY : form->mode) & 1)
        return false;
    const bool needs[] = {[NEEDS_NOTHING] = row != format || format_goes,
                          [NEEDS_GOAL] = false,
                          [NEEDS_FIND] = form->mode == MODE_FIND,
                          [NEEDS_PLOT] = plot,
                          [NEEDS_PICTURE] = plot || form->mode == MODE_TERMINAL,
                          [NEEDS_CSV] = format_goes,
                          [NEEDS_EACH] = true,
                          [NEEDS_FILE] = format_goes};
    return needs[row->needs] && !(form->more && strcmp(form->more, row->name) == 0);
}

/* Options with a letter come first, without a value before with a value; then names. */
static int compare_options(const void *a, const void *b)
{
    const struct option_row *x = *(const struct option_row *const *)a, *y = *(const struct option_row *const *)b;
    if (!x->letter != !y->letter)
        return x->letter ? -1 : 1;
    if (x->letter && !x->value != !y->value)
        return x->value ? 1 : -1;
    return x->letter ? x->letter - y->letter : strcmp(x->name, y->name);
}

static void print_form(FILE *out, const struct form *form)
{
    size_t count, n = 0;
    const struct option_row *rows = ceduo_option_rows(&count), *taken[64];
    fputs(".Nm\n", out);
    for (const char *name = form->required; *name; name += *name == '|') {
        const struct option_row *row = find_option(name, strcspn(name, "|"));
        print_option(out, name == form->required ? "." : " | ", row, true);
        fputs(strstr(row->help, "repeated") ? " ..." : form->mode == MODE_SURVEY ? " | Fl -survey -template" : "", out);
        name += strcspn(name, "|");
    }
    fputs(form->required[0] ? "\n" : "", out);
    if (form->more) {
        print_option(out, ".", find_option(form->more, strlen(form->more)), true);
        fputc('\n', out);
    }
    for (size_t i = 0; i < count; i++)
        if (has_option(form, &rows[i]))
            taken[n++] = &rows[i];
    qsort(taken, n, sizeof *taken, compare_options);
    for (size_t i = 0; i < n; i++) {
        print_option(out, ".Op ", taken[i],
                     strcmp(taken[i]->name, "years") != 0 || (form->mode != MODE_FIND && form->mode != MODE_COLUMNS));
        fputc('\n', out);
    }
    if (form->operand)
        fprintf(out, "%s\n", form->operand);
}

static void print_synopsis(FILE *out)
{
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++)
        print_form(out, &forms[i]);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        void (*put)(FILE *out);
    } tables[] = {{"keys", print_keys},     {"goals", print_goals},          {"ranges", print_ranges},
                  {"search", print_search}, {"figures", print_figure_lists}, {"synopsis", print_synopsis}};
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
