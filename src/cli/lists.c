/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --list-parameters, --list-columns, --list-profiles, --schema and --survey. */
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "batch.h"
#include "io/file.h"
#include "io/node.h"
#include "io/survey_file.h"
#include "messages.h"
#include "scene/schema.h"
#include "view/figures.h"

/* ---- tables ---- */

#define WIDTH_MAX 44 /* of a column; wider cells shift the rest of the line */

/* Align the columns of a tab-separated table, except the last. */
static void align(struct text *to, const char *rows)
{
    size_t widths[8] = {0}, column = 0, n;
    for (int pass = 0; pass < 2; pass++)
        for (const char *p = rows; *p; p += n + 1) {
            n = strcspn(p, "\t\n");
            size_t width = ceduo_utf8_char_width(p, n);
            bool last = p[n] == '\n';
            if (!pass && !last && width > widths[column])
                widths[column] = width > WIDTH_MAX ? WIDTH_MAX : width;
            if (pass) {
                ceduo_text_append_n(to, p, n);
                ceduo_text_format(to, "%*s", last ? 0 : width > widths[column] ? 1 : (int)(widths[column] + 2 - width), "");
                ceduo_text_append(to, last ? "\n" : "");
            }
            column = last ? 0 : column + 1;
        }
}

/* Print rows as a table, with a text below it. */
static enum exit_status print_table(const struct arguments *a, struct text *rows, const char *below)
{
    LOCAL_TEXT(table);
    align(&table, ceduo_text_string(rows));
    ceduo_text_append(&table, below);
    ceduo_fit_charset(&table);
    ceduo_text_free(rows);
    return ceduo_output_write(a, &table);
}

/* ---- parameters ---- */

static const char *const type_names[] = {
    [FIELD_TEXT] = "text",          [FIELD_FILE] = "file",   [FIELD_NUMBER] = "number", [FIELD_SPREAD] = "number~",
    [FIELD_SPREADS] = "3 numbers~", [FIELD_COUNT] = "count", [FIELD_CHOICE] = "word",   [FIELD_FLAG] = "flag",
    [FIELD_NUMBERS] = "numbers",    [FIELD_WORDS] = "words", [FIELD_POINTS] = "points"};

static void print_parameter(void *context, const char *path, const struct field *f)
{
    struct text *text = context;
    LOCAL_TEXT(words);
    if (f->type == FIELD_TAG || strncmp(path, "options[].forest[].", 19) == 0)
        return; /* equal to forest[] */
    if (f->choices)
        ceduo_text_join(&words, f->choices->names, f->choices->n, "|");
    else if (!ceduo_schema_range_text(f, &words))
        ceduo_text_append_char(&words, '-');
    ceduo_text_format(text, "%s\t%s\t%s\t%s\t%s\t%s\n", path, type_names[f->type], f->unit[0] ? f->unit : "-",
                      ceduo_text_string(&words), f->value ? f->value : "-", _(f->meaning));
}

enum exit_status ceduo_batch_parameters(const struct arguments *a)
{
    struct text rows = {0};
    ceduo_text_format(&rows, "%s\t%s\t%s\t%s\t%s\t%s\n", _("path"), _("type"), _("unit"), _("range"), _("default"),
                      _("meaning"));
    ceduo_schema_visit(ceduo_schema_scene(), "", print_parameter, &rows);
    return print_table(a, &rows,
                       _("\nnumber~: also {mean: ..., spread: ..., kind: normal|uniform}, drawn for each rock\n"
                         "options[].forest[] holds what forest[] holds; any mapping may hold source: {kind, text}\n"));
}

/* ---- outputs ---- */

enum exit_status ceduo_batch_columns(const struct arguments *a)
{
    struct text rows = {0};
    ceduo_text_format(&rows, "%s\t%s\t%s\t%s\t%s\n", _("column"), _("type"), _("unit"), _("empty if"), _("meaning"));
    ceduo_figures_columns(&rows, ceduo_row_figures, false);
    ceduo_figures_columns(&rows, ceduo_result_csv(a->stands, a->years)->columns, false);
    return print_table(a, &rows, "");
}

enum exit_status ceduo_batch_schema(const struct arguments *a)
{
    static const struct {
        const char *format;
        const struct ceduo_figure *figures;
        bool row;
    } outputs[] = {{"ceduo-result-1", ceduo_result_figures, true}, /* in the order of the option's words */
                   {"ceduo-find-1", ceduo_find_figures, true},
                   {"ceduo-sensitivity-1", ceduo_uncertainty_figures, true},
                   {"ceduo-calibration-1", ceduo_calibration_figures, false},
                   {"ceduo-failed-1", ceduo_failed_figures, true}};
    LOCAL_TEXT(schema);
    ceduo_figures_schema(&schema, outputs[a->schema].format, outputs[a->schema].figures, outputs[a->schema].row);
    return ceduo_output_write(a, &schema);
}

/* ---- profiles ---- */

static const char *read_title(struct arena *arena, const char *path)
{
    LOCAL_PROBLEMS(problems);
    const struct source *source = ceduo_file_read(arena, path, YAML_BYTES_MAX, &problems);
    const struct node *root = source ? ceduo_yaml_read(arena, source, &problems) : NULL;
    const char *title = ceduo_in_language(ceduo_node_text(root, "title"), ceduo_node_text(root, "title_it"));
    if (!title)
        title = ceduo_in_language(ceduo_node_text(root, "name"), ceduo_node_text(root, "name_it"));
    return title ? title : root ? "" : _("(cannot be read)");
}

enum exit_status ceduo_batch_profiles(const struct arguments *a)
{
    static const char *const kinds[][2] = {{"scenes", "scene"}, {"slopes", "slope"}, {"stands", "stand"}, {"rules", "rules"}};
    LOCAL_ARENA(arena);
    struct text rows = {0};
    const char *const *folders = ceduo_file_folders(&arena);
    ceduo_text_format(&rows, "%s\t%s\t%s\t%s\n", _("name"), _("kind"), _("title"), _("file"));
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
        for (size_t f = 0, n; folders[f]; f++) {
            const char *const *names = ceduo_file_list(&arena, folders[f], kinds[k][0], &n);
            for (size_t i = 0; i < n; i++) { /* first the name to type: the file's name without .yaml */
                const char *path = ceduo_arena_format(&arena, "%s/%s/%s.yaml", folders[f], kinds[k][0], names[i]);
                ceduo_text_append_escaped(&rows, names[i]);
                ceduo_text_format(&rows, "\t%s\t", kinds[k][1]);
                ceduo_text_append_escaped(&rows, read_title(&arena, path));
                ceduo_text_append_char(&rows, '\t');
                ceduo_text_append_escaped(&rows, path);
                ceduo_text_append_char(&rows, '\n');
            }
        }
    return print_table(a, &rows, "");
}

/* ---- surveys ---- */

/* Print the stand of a survey, or an empty sheet. */
enum exit_status ceduo_batch_survey(const struct arguments *a)
{
    LOCAL_ARENA(arena);
    struct problems problems = {0};
    struct survey_file file;
    LOCAL_TEXT(yaml);
    LOCAL_TEXT(line);
    bool template = strcmp(a->survey, "--template") == 0, standard = strcmp(a->survey, "-") == 0;
    const char *found = standard || template ? NULL : ceduo_file_find(&arena, a->survey, NULL, "surveys");
    if (template)
        ceduo_survey_print_template(&yaml);
    bool good = template || (ceduo_survey_read(&file, &arena, found ? found : a->survey, NULL, &problems) &&
                             ceduo_survey_print_stand(&file, &yaml, &problems));
    ceduo_print_problems(&problems);
    if (good && !template && !a->quiet) {
        ceduo_text_format(&line, "%s\n", file.understood);
        ceduo_print_error(&line);
    }
    return good ? ceduo_output_write(a, &yaml) : EXIT_INPUT;
}
