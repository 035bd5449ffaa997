/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scene by scene: --batch, --plot, --find, --sensitivity, --report and --check; with --each once for each row of a table. Its lines
 * of CSV are the cells that are copied, then those of the result; with --columns some of both. With --resume the rows whose copied
 * cells stand in the output are not computed again. The last of them may be there in part: it is taken out and computed. */
#include <errno.h>
#include <search.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/json.h"
#include "base/language.h"
#include "base/must.h"
#include "batch.h"
#include "io/csv.h"
#include "io/file.h"
#include "output.h"
#include "say.h"
#include "scene/schema.h"
#include "view/figures.h"
#include "view/html.h"
#include "view/page.h"

#define NAMES_SHOWN 10 /* of scenes that failed */
#define LABEL_MOST  20 /* bytes */

struct each_head {
    const char *name, *printed; /* printed: in CSV */
    const struct field *field;  /* of the value that it sets; NULL: of none, or of a part of a scene such as slope */
    bool sets;
};

struct each_row {
    size_t line;
    const char **cells; /* NULL: the row is bad, or done */
    bool done;          /* its lines stand in the output */
};

/* What is computed one after the other: every scene of the command line, with --each once for each row of a table. A column whose
 * head is a path of --set changes the scene; all others are copied in front of what is printed, and say which row it is. */
struct each {
    struct arguments arguments; /* of the present scene: with the changes of its row */
    const char *path;           /* the present scene */
    const char *name;           /* as messages call it: its path, or "slopes.csv:17" */
    size_t at, count;           /* the present one, from 1; of how many */
    const struct arguments *given;
    struct arena arena;
    struct csv table; /* of --each */
    size_t heads_count, rows_count, columns_count;
    struct each_head *heads;
    struct each_row *rows; /* NULL: no --each */
    size_t *columns;       /* of --columns: numbers of cells, the copied ones first; NULL: all */
    size_t copied;         /* columns; their places in the lines that are printed, SIZE_MAX: it is not printed */
    size_t *copied_at;
    bool resumed;       /* the head of the output stands there already */
    struct text failed; /* names of those that failed */
    size_t failures;
    bool bad_rows; /* at least one row cannot be read */
};

static bool is_copied(const struct each_head *head)
{
    return !head->sets && head->name[0];
}

/* ---- the table ---- */

static const char *copy_cell(struct each *e, struct csv_cell cell)
{
    return ceduo_arena_copy(&e->arena, cell.p, cell.n);
}

static bool read_heads(struct each *e)
{
    const struct csv *t = &e->table;
    e->heads = ceduo_arena_take(&e->arena, (t->heads_count + 1) * sizeof *e->heads);
    for (size_t n = 0; n < t->heads_count; n++) {
        const char *name = copy_cell(e, t->heads[n]);
        const char *first = ceduo_arena_copy(&e->arena, name, strcspn(name, ".["));
        bool sets = ceduo_schema_field(ceduo_schema_scene(), first) != NULL;
        for (size_t i = 0; i < e->heads_count; i++)
            if (name[0] && strcmp(e->heads[i].name, name) == 0)
                return ceduo_csv_complain(t, t->heads[n], _("'%s' is given twice"), name);
        e->heads[e->heads_count++] = (struct each_head){name, name, sets ? ceduo_schema_at(name) : NULL, sets};
    }
    return true;
}

static enum exit_status read_table(struct each *e)
{
    struct problems problems = {0};
    bool good = ceduo_csv_open(&e->table, &e->arena, e->given->each, &problems);
    if (good) {
        e->table.source->foreign = false; /* its name was given for this */
        good = ceduo_csv_first(&e->table) && read_heads(e);
    }
    e->rows = good ? ceduo_arena_take(&e->arena, (ceduo_csv_lines(&e->table) + 1) * sizeof *e->rows) : NULL;
    if (good)
        ceduo_csv_scan(&e->table, NULL);
    while (good && ceduo_csv_next(&e->table)) {
        const char **cells = ceduo_arena_take(&e->arena, e->heads_count * sizeof *cells);
        for (size_t n = 0; n < e->heads_count; n++)
            cells[n] = copy_cell(e, ceduo_csv_cell(&e->table, n));
        e->bad_rows |= e->table.bad;
        e->rows[e->rows_count++] = (struct each_row){.line = e->table.place.line, .cells = e->table.bad ? NULL : cells};
    }
    ceduo_say_problems(&problems);
    e->table.problems = NULL;
    return good ? EXIT_DONE : EXIT_INPUT;
}

/* The next cell of a line that the program printed; NULL: nothing is left. */
static const char *next_cell(struct each *e, const char **line)
{
    const char *from = *line, *end;
    if (!from)
        return NULL;
    bool quoted = *from == '"';
    for (end = from; *end && (quoted || (*end != ',' && *end != '\n')); end++)
        if (quoted && end > from && *end == '"') {
            quoted = end[1] == '"';
            end += quoted;
            if (!quoted)
                continue;
        }
    *line = *end == ',' ? end + 1 : NULL;
    quoted = *from == '"';
    char *cell = ceduo_arena_copy(&e->arena, from + quoted, (size_t)(end - from) - (quoted ? 2 : 0)), *to = cell;
    for (const char *p = cell; *p; p++) {
        *to++ = *p;
        p += quoted && p[0] == '"' && p[1] == '"';
    }
    *to = '\0';
    return cell;
}

/* ---- lines of CSV ---- */

/* The cells of a row that are copied, or their heads, each with a comma behind it. */
static void append_copied(const struct each *e, const char *const *cells, struct text *line)
{
    for (size_t i = 0; i < e->heads_count; i++)
        if (is_copied(&e->heads[i])) {
            ceduo_text_csv(line, cells ? cells[i] : e->heads[i].printed);
            ceduo_text_char(line, ',');
        }
}

/* The cells of a line at n places, each with a comma behind it. */
static void append_cells(const char *line, size_t length, const size_t *at, size_t n, struct text *to)
{
    for (size_t k = 0; k < n; k++) {
        const char *p = line, *end = line + length, *from = p;
        for (size_t i = 0; i <= at[k] && p <= end; i++, p++) {
            bool quoted = false;
            for (from = p; p < end && (quoted || *p != ','); p++)
                quoted ^= *p == '"';
        }
        ceduo_text_add(to, from, p > from ? (size_t)(p - from) - 1 : 0);
        ceduo_text_char(to, ',');
    }
}

/* A whole line, or the cells of it that --columns names. */
static void append_line(const struct each *e, const char *line, size_t n, struct text *out)
{
    if (e->columns)
        append_cells(line, n, e->columns, e->columns_count, out);
    else
        ceduo_text_add(out, line, n);
    out->length -= e->columns_count > 0; /* the last comma */
    ceduo_text_char(out, '\n');
}

/* Names the copied columns as the table does, with row. in front of what the result has a column of its own for; then finds
 * those of --columns among them and the result's. */
static enum exit_status choose_columns(struct each *e, const struct text *header)
{
    size_t n = 0, copied, length, most = e->heads_count + 1;
    for (size_t i = 0; i < header->length; i++)
        most += header->bytes[i] == ',';
    const char **names = ceduo_arena_take(&e->arena, most * sizeof *names);
    for (size_t i = 0; i < e->heads_count; i++) {
        struct each_head *head = &e->heads[i];
        const char *left = header->length > 0 ? header->bytes : NULL;
        for (const char *own; is_copied(head) && (own = next_cell(e, &left));)
            if (strcmp(own, head->name) == 0)
                head->printed = ceduo_arena_format(&e->arena, "row.%s", head->name);
        if (is_copied(head))
            names[n++] = head->printed;
    }
    const char *left = header->length > 0 ? header->bytes : NULL;
    copied = n;
    for (const char *own; (own = next_cell(e, &left));)
        names[n++] = own;
    e->copied_at = ceduo_arena_take(&e->arena, (copied + 1) * sizeof *e->copied_at);
    for (; e->copied < copied; e->copied++)
        e->copied_at[e->copied] = e->given->columns ? SIZE_MAX : e->copied;
    if (!e->given->columns)
        return EXIT_DONE;
    e->columns = ceduo_arena_take(&e->arena, (strlen(e->given->columns) + 1) * sizeof *e->columns);
    for (const char *word = e->given->columns; *word; word += length + (word[length] == ',')) {
        length = strcspn(word, ",");
        const char *wanted = ceduo_arena_copy(&e->arena, word, length);
        size_t i = 0;
        while (i < n && strcmp(names[i], wanted) != 0)
            i++;
        if (i == n) {
            const char *near = ceduo_text_nearest(wanted, names, n);
            return near ? ceduo_usage("columns", _("no column '%s'; did you mean '%s'?"), wanted, near)
                        : ceduo_usage("columns", _("no column '%s'; --list-columns names all"), wanted);
        }
        if (i < copied)
            e->copied_at[i] = e->columns_count;
        e->columns[e->columns_count++] = i;
    }
    return EXIT_DONE;
}

/* Adds the line of heads, unless it stands in the output already. */
static void add_header(const struct each *e, const struct text *header, struct text *out)
{
    LOCAL_TEXT(line);
    if (header->length == 0 || e->resumed)
        return;
    append_copied(e, NULL, &line);
    ceduo_text_add(&line, header->bytes, header->length - 1);
    append_line(e, ceduo_text_string(&line), line.length, out);
}

/* ---- what stands in the output already ---- */

static int by_key(const void *a, const void *b)
{
    return strcmp(a, b);
}

static void keep(void *key)
{
    (void)key; /* it lies in the arena */
}

/* Leaves out the rows that the output holds, but for the last of them, of which a line may be missing: that is taken off the
 * output. What says which row a line is of are its copied cells. */
static enum exit_status resume(struct each *e, const struct text *header)
{
    bool tells = e->copied > 0, twice = false;
    for (size_t k = 0; k < e->copied; k++)
        tells &= e->copied_at[k] != SIZE_MAX;
    if (!tells)
        return ceduo_usage("resume", _("print a column of --each that changes nothing: it says which row a line is of"));
    const char **keys = ceduo_arena_take(&e->arena, (e->rows_count + 1) * sizeof *keys), *last = NULL;
    void *known = NULL, *done = NULL; /* of the rows; of those that the output holds */
    for (size_t r = 0; r < e->rows_count; r++) {
        LOCAL_TEXT(key);
        if (e->rows[r].cells)
            append_copied(e, e->rows[r].cells, &key);
        keys[r] = ceduo_arena_string(&e->arena, ceduo_text_string(&key));
        twice |= e->rows[r].cells && *(const char **)ceduo_must(tsearch(keys[r], &known, by_key)) != keys[r];
    }
    tdestroy(known, keep);
    if (twice) {
        ceduo_say_why(e->given->each, _("two rows have the same copied cells, so that --resume cannot tell them apart"));
        return EXIT_INPUT;
    }
    if (access(e->given->output, F_OK) != 0 && errno == ENOENT)
        return EXIT_DONE;
    struct problems problems = {0};
    const struct source *old = ceduo_file_read(&e->arena, e->given->output, CSV_BYTES_MOST, &problems);
    ceduo_say_problems(&problems);
    LOCAL_TEXT(first);
    add_header(e, header, &first);
    if (!old)
        return EXIT_OUTPUT;
    if (old->length > 0 && (old->length < first.length || memcmp(old->bytes, first.bytes, first.length) != 0)) {
        ceduo_say_why(e->given->output, _("it has other columns than these; write elsewhere, or remove it"));
        return EXIT_OUTPUT;
    }
    e->resumed = old->length > 0;
    size_t start = first.length;
    for (const char *line = old->bytes + first.length, *end = line;
         e->resumed && (end = memchr(line, '\n', (size_t)(old->bytes + old->length - line))); line = end + 1) {
        LOCAL_TEXT(key);
        append_cells(line, (size_t)(end - line), e->copied_at, e->copied, &key);
        if (last && strcmp(last, ceduo_text_string(&key)) == 0)
            continue;
        if (last)
            ceduo_must(tsearch(last, &done, by_key));
        last = ceduo_arena_string(&e->arena, ceduo_text_string(&key));
        start = (size_t)(line - old->bytes);
    }
    for (size_t r = 0; r < e->rows_count; r++)
        if (e->rows[r].cells && tfind(keys[r], &done, by_key))
            e->rows[r] = (struct each_row){.done = true};
    tdestroy(done, keep);
    if (!e->resumed || truncate(e->given->output, (off_t)start) == 0)
        return EXIT_DONE;
    ceduo_say_why(e->given->output, strerror(errno));
    return EXIT_OUTPUT;
}

/* ---- scene by scene ---- */

/* Reads the table, and with --resume what stands in the output already. `header`: of the output in CSV; else empty. Another status
 * than EXIT_DONE where nothing can be computed; the reason has been told. */
static enum exit_status open_each(struct each *e, const struct arguments *a, const struct text *header)
{
    *e = (struct each){.arguments = *a, .given = a};
    enum exit_status status = a->each ? read_table(e) : EXIT_DONE;
    if (status == EXIT_DONE && (a->each || a->columns))
        status = choose_columns(e, header);
    if (status == EXIT_DONE && a->resume)
        status = resume(e, header);
    e->count = a->scenes_count * (a->each ? e->rows_count : 1);
    e->arguments.sets.items = ceduo_arena_take(&e->arena, (a->sets.n + e->heads_count + 1) * sizeof *a->sets.items);
    memcpy(e->arguments.sets.items, a->sets.items, a->sets.n * sizeof *a->sets.items);
    return status;
}

/* The change that a cell asks for, PATH=VALUE. Texts are quoted as YAML has it; a decimal comma becomes a dot. */
static const char *change_of(struct each *e, const struct each_head *head, const char *cell)
{
    const struct field *f = head->field;
    LOCAL_TEXT(change);
    ceduo_text_format(&change, "%s=", head->name);
    bool text = !f || f->type == FIELD_TEXT || f->type == FIELD_FILE;
    bool number = f && (f->type == FIELD_NUMBER || f->type == FIELD_SPREAD) && e->table.separator != ',' && !strchr(cell, '.');
    ceduo_text_put(&change, text ? "'" : "");
    for (const char *p = cell; *p; p++)
        ceduo_text_add(&change, text && *p == '\'' ? "''" : number && *p == ',' ? "." : p, text && *p == '\'' ? 2 : 1);
    ceduo_text_put(&change, text ? "'" : "");
    return ceduo_arena_string(&e->arena, ceduo_text_string(&change));
}

/* Notes that the present scene has failed. */
static void note_failed(struct each *e)
{
    const char *label = e->arguments.label;
    if (e->failures++ < NAMES_SHOWN)
        ceduo_text_format(&e->failed, label && label != e->name ? "%s%s (%s)" : "%s%s", e->failures > 1 ? ", " : "", e->name,
                          label);
    else if (e->failures == NAMES_SHOWN + 1)
        ceduo_text_put(&e->failed, ", \xe2\x80\xa6");
}

/* Goes to the next scene that is to be computed; false after the last. What is wrong with a row is told, and the row is left out. */
static bool next_scene(struct each *e)
{
    size_t scenes = e->given->scenes_count;
    const struct each_row *row = NULL;
    do {
        if (e->at == e->count)
            return false;
        row = e->rows ? &e->rows[e->at / scenes] : NULL;
        e->path = e->given->scenes[e->at++ % scenes];
        e->name = row ? ceduo_arena_format(&e->arena, "%s:%zu", e->given->each, row->line) : e->path;
        e->arguments.label = row ? e->name : NULL;
        if (row && !row->cells && !row->done)
            note_failed(e);
    } while (row && !row->cells);
    for (size_t i = e->heads_count; row && i-- > 0;) /* the first copied cell that is short, which a geometry is not */
        if (is_copied(&e->heads[i]) && row->cells[i][0] && strlen(row->cells[i]) <= LABEL_MOST)
            e->arguments.label = row->cells[i];
    e->arguments.called = row || e->count > 1 ? e->name : NULL;
    struct word_list *sets = &e->arguments.sets;
    sets->n = e->given->sets.n;
    for (size_t i = 0; row && i < e->heads_count; i++)
        if (e->heads[i].sets && row->cells[i][0])
            sets->items[sets->n++] = change_of(e, &e->heads[i], row->cells[i]);
    e->arguments.cells = sets->n - e->given->sets.n;
    return true;
}

/* Adds what is printed of the present scene. */
static void add_answer(const struct each *e, const struct text *answer, struct text *out)
{
    const struct each_row *row = e->rows ? &e->rows[(e->at - 1) / e->given->scenes_count] : NULL;
    if (e->given->format == CEDUO_CSV && (row || e->columns)) {
        for (const char *line = ceduo_text_string(answer), *end; (end = strchr(line, '\n')); line = end + 1) {
            LOCAL_TEXT(whole);
            append_copied(e, row ? row->cells : NULL, &whole);
            ceduo_text_add(&whole, line, (size_t)(end - line));
            append_line(e, ceduo_text_string(&whole), whole.length, out);
        }
    } else if (e->given->format == CEDUO_JSON && row) {
        struct json json = {.text = out}; /* "row": what is copied, as numbers where they are, in front of the answer's own */
        double number;
        ceduo_json_open(&json, NULL, '{');
        ceduo_json_open(&json, "row", '{');
        for (size_t i = 0; i < e->heads_count; i++) {
            const char *name = e->heads[i].name, *cell = row->cells[i];
            if (is_copied(&e->heads[i]) && ceduo_number_read(cell, &number) == CEDUO_NUMBER_GOOD)
                ceduo_json_number(&json, name, number);
            else if (is_copied(&e->heads[i]))
                ceduo_json_string(&json, name, cell[0] ? cell : NULL);
        }
        ceduo_json_close(&json, '}');
        ceduo_text_put(out, ", ");
        ceduo_text_put(out, ceduo_text_string(answer) + 1);
    } else {
        if (row)
            ceduo_text_safe(out, e->name);
        for (size_t i = 0; row && i < e->heads_count; i++)
            if (!e->heads[i].sets && row->cells[i][0]) {
                ceduo_text_put(out, " \xc2\xb7 ");
                ceduo_text_safe(out, row->cells[i]);
            }
        ceduo_text_put(out, row ? "\n" : "");
        ceduo_text_put(out, ceduo_text_string(answer));
    }
}

/* Says how many of several failed, and which. */
static void close_each(struct each *e)
{
    if (e->count > 1 && e->failures > 0) {
        LOCAL_TEXT(line);
        ceduo_text_format(&line, ngettext("%zu of %zu failed: %s", "%zu of %zu failed: %s", e->failures), e->failures, e->count,
                          ceduo_text_string(&e->failed));
        ceduo_say_why("ceduo", ceduo_text_string(&line));
    }
    ceduo_text_free(&e->failed);
    ceduo_arena_free(&e->arena);
}

/* ---- all scenes ---- */

static enum exit_status worse(enum exit_status a, enum exit_status b)
{
    return a > b ? a : b;
}

/* Pages of several scenes come behind a table of their verdicts, in its order: the worst first. `starts`: where each begins, and
 * the end. A report has a table of several only, and the head and end of HTML. */
static void put_verdicts(struct text *text, const struct arguments *a, const size_t *starts)
{
    struct text pages = *text;
    bool html = a->mode == MODE_REPORT;
    struct ceduo_html to = {.text = text};
    LOCAL_PAGE(verdicts, html ? CEDUO_PAGE_REPORT_WIDTH : CEDUO_PAGE_WIDTH);
    size_t *order = ceduo_must(calloc(a->profiles->count + 1, sizeof *order)), n = ceduo_profiles_sort(a->profiles, order);
    *text = (struct text){0};
    if (html)
        ceduo_page_html_begin(&to, ceduo_text_string(a->title));
    if (html && n > 1)
        ceduo_page_say(&verdicts, CEDUO_PAGE_TITLE, _("%zu scenes, the worst first"), n);
    if (n > 1)
        ceduo_profiles_page(&verdicts, a->profiles);
    if (html && n > 1) {
        ceduo_page_html(&to, &verdicts, n + 1);
    } else if (!html) {
        ceduo_page_print(text, &verdicts, !ceduo_say_utf8());
        ceduo_say_plainly(text);
    }
    for (size_t i = 0; i < n; i++) {
        if (!html)
            ceduo_text_char(text, '\n');
        ceduo_text_add(text, pages.bytes + starts[order[i]], starts[order[i] + 1] - starts[order[i]]);
    }
    if (html)
        ceduo_page_html_end(&to);
    free(order);
    ceduo_text_free(&pages);
}

/* Add what was understood of each table. The notes are kept last first. */
static void add_tables(const struct source_note *note, struct text *out)
{
    if (!note)
        return;
    add_tables(note->before, out);
    if (strcmp(note->kind, CEDUO_NOTE_TABLE) == 0)
        ceduo_text_format(out, "%s\n", note->text);
}

static enum exit_status check(const struct arguments *a, struct scene_file *file, struct text *out)
{
    if (!a->quiet)
        add_tables(file->notes, out);
    ceduo_batch_warn(a, file, true);
    return EXIT_DONE;
}

/* Prints the answer of each scene, under one head of CSV. */
enum exit_status ceduo_batch_run(const struct arguments *given)
{
    static ceduo_batch_answer *const answers[] = {[MODE_BATCH] = ceduo_print_report,
                                                  [MODE_FIND] = ceduo_print_find,
                                                  [MODE_SENSITIVITY] = ceduo_print_doubt,
                                                  [MODE_REPORT] = ceduo_print_chapter,
                                                  [MODE_CHECK] = check};
    ceduo_batch_answer *answer = given->plot != CEDUO_PLOT_NONE ? ceduo_print_plots : answers[given->mode];
    LOCAL_TEXT(header);
    LOCAL_TEXT(title);
    LOCAL_TEXT(out);
    struct ceduo_profiles profiles = {0};
    struct arguments arguments = *given, *a = &arguments;
    struct each each;
    a->profiles = &profiles;
    a->title = &title;
    if (a->format == CEDUO_CSV)
        ceduo_csv_head(&header, a->mode == MODE_FIND          ? &ceduo_find_csv
                                : a->mode == MODE_SENSITIVITY ? &ceduo_doubt_csv
                                                              : ceduo_result_csv(a->stands, a->years));
    enum exit_status status = open_each(&each, a, &header), written = status;
    struct progress progress = ceduo_progress_begin(a);
    size_t computed = 0, *starts = ceduo_must(calloc(each.count + 2, sizeof *starts));
    bool first = true;
    while (written == EXIT_DONE && next_scene(&each)) {
        LOCAL_TEXT(one);
        ceduo_progress_scenes(&progress, computed++, each.at - 1, each.count);
        struct scene_file file;
        enum exit_status result = ceduo_batch_read(&each.arguments, each.path, &file);
        if (result == EXIT_DONE) {
            ceduo_interrupt_catch();
            result = answer(&each.arguments, &file, &one);
        }
        ceduo_scene_release(&file);
        status = worse(status, result);
        if (result > EXIT_RUN ||
            (result == EXIT_RUN && !one.bytes)) /* what is printed has not failed, unfinished as it may be */
            note_failed(&each);
        if (result == EXIT_OUTPUT) /* nothing is written over what was read */
            break;
        if (result <= EXIT_RUN && one.bytes && !atomic_load(ceduo_interrupt_flag())) {
            if (first)
                add_header(&each, &header, &out);
            else if (a->format == CEDUO_TABLE && profiles.count == 0 && a->mode != MODE_CHECK)
                ceduo_text_char(&out, '\n');
            add_answer(&each, &one, &out);
            starts[profiles.count] = out.length;
            first = false;
        }
        written = profiles.count > 0 ? EXIT_DONE : ceduo_output_next(a, &out);
        status = worse(status, written);
        if (written == EXIT_DONE)
            ceduo_interrupt_release();
    }
    if (profiles.count > (a->mode == MODE_REPORT ? 0u : 1u))
        put_verdicts(&out, a, starts);
    free(starts);
    if (profiles.count > 0)
        status = worse(status, ceduo_output_next(a, &out));
    status = worse(status, each.bad_rows ? EXIT_INPUT : EXIT_DONE);
    close_each(&each);
    ceduo_profiles_free(&profiles);
    bool waits = a->output && !a->resume && !first && status != EXIT_OUTPUT;
    return waits ? worse(status, ceduo_output_write(a, &out)) : status;
}
