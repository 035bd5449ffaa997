/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "form.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "view/value_text.h"

#define LABEL_MIN  18 /* min. columns of labels */
#define VALUE_MIN  25 /* min. columns of values */
#define COLUMN_MAX 30 /* max. columns of a table's column */

void ceduo_form_clear(struct form *form, const struct document *document)
{
    form->document = document;
    form->n = 0;
    ceduo_arena_free(&form->arena);
}

static struct form_row *add_row(struct form *form, enum form_kind kind, const char *label)
{
    form->rows = ceduo_grow(form->rows, form->n, &form->capacity, sizeof *form->rows);
    struct form_row *row = &form->rows[form->n++];
    *row = (struct form_row){.kind = kind, .label = ceduo_arena_string(&form->arena, label), .list = ""};
    return row;
}

void ceduo_form_heading(struct form *form, const char *text)
{
    add_row(form, FORM_HEADING, text);
}

void ceduo_form_note(struct form *form, const char *text)
{
    add_row(form, FORM_NOTE, text);
}

/* ---- cells ---- */

#define DIGITS_MAX  5 /* show fewer digits of computed values; the full value appears while editing */
#define COLUMNS_MAX 63
#define CELL_SIZE   (4 * COLUMNS_MAX + 2)

static size_t count_digits(const char *shown)
{
    size_t n = 0;
    for (const char *c = shown; *c; c++)
        n += isdigit((unsigned char)*c) && (n > 0 || *c != '0');
    return n;
}

/* Write the text of a cell for `span` columns. */
static void write_cell(char shown[CELL_SIZE], const struct form_cell *cell, int span)
{
    LOCAL_TEXT(words);
    if (cell->given && strcmp(cell->field->key, "path") == 0) /* show a path of the scene in words */
        ceduo_format_path(cell->text, &words);
    else
        ceduo_text_append(&words, cell->text[0] ? cell->text : "-");
    size_t length = ceduo_utf8_cut(ceduo_text_string(&words), COLUMNS_MAX);
    snprintf(shown, CELL_SIZE, "%.*s%s", (int)length, ceduo_text_string(&words), cell->assumed ? "*" : "");
    double number;
    bool is_long = count_digits(shown) > DIGITS_MAX || (int)ceduo_utf8_width(shown) > span;
    if (is_long && strpbrk(shown, ".,") && ceduo_input_parse_number(cell->text, &number) == CEDUO_NUMBER_GOOD)
        snprintf(shown, CELL_SIZE, fabs(number) < 1e4 || fabs(number) >= 1e9 ? "%.4g%s" : "%.0f%s", number,
                 cell->assumed ? "*" : "");
    if (strspn(shown, "0123456789.+-e *") == strlen(shown))
        ceduo_number_localize(shown);
    char *suffix = cell->field->type == FIELD_CHOICE ? strstr(shown, " (") : NULL;
    if (suffix && (int)ceduo_utf8_width(shown) > span) /* keep only the common name of a species */
        *suffix = '\0';
}

/* Append a value as shown: a scalar in the words and unit of the field, a spread, a list, or the name of a mapping. */
static void show_node(struct text *to, const struct node *node, const struct field *field)
{
    const char *name = node->kind == NODE_MAP ? ceduo_node_text(node, "name") : NULL;
    if (name && field->flags & FIELD_FOLLOWS) {
        ceduo_text_append(to, ceduo_in_language(name, ceduo_node_text(node, "name_it")));
    } else if (node->written && node->written->kind == NODE_SCALAR) {
        ceduo_text_append(to, node->written->text);
    } else if (node->kind == NODE_SCALAR) {
        ceduo_format_value(field, node->text, to);
    } else if (node->kind == NODE_MAP && field->type == FIELD_SPREAD) {
        const char *mean = ceduo_node_text(node, "mean"), *spread = ceduo_node_text(node, "spread");
        const char *kind = ceduo_node_text(node, "kind");
        ceduo_text_format(to, "%s \xc2\xb1 %s%s", mean ? mean : "?", spread ? spread : "0",
                          kind && strcmp(kind, "uniform") == 0 ? " u" : "");
    } else if (node->kind == NODE_LIST) {
        for (size_t i = 0; i < node->n; i++)
            ceduo_text_append_joined(to, i ? " " : "", "%s", node->items[i]->kind == NODE_SCALAR ? node->items[i]->text : "~");
    } else {
        ceduo_text_append(to, "{}");
    }
}

static void add_cell(struct form *form, struct form_row *row, const struct field *field, const char *path)
{
    struct form_cell *cell = &row->cells[row->n++];
    const struct node *node = ceduo_document_node(form->document, path), *italian = NULL;
    const char *default_value = !node && field->value ? field->value : "";
    LOCAL_TEXT(shown);
    *cell = (struct form_cell){.path = ceduo_arena_string(&form->arena, path),
                               .field = field,
                               .written = node && node->kind == NODE_SCALAR ? node->text : default_value,
                               .given = node != NULL,
                               .assumed = node && ceduo_scene_assumes_value(&form->document->file, path)};
    if (node && node->kind == NODE_SCALAR && field->type == FIELD_TEXT)
        italian = ceduo_document_node(form->document, ceduo_arena_format(&form->arena, "%s_it", path));
    if (italian && italian->kind == NODE_SCALAR)
        ceduo_text_append(&shown, ceduo_in_language(node->text, italian->text));
    else if (node)
        show_node(&shown, node, field);
    else
        ceduo_format_value(field, default_value, &shown);
    if ((field->type == FIELD_NUMBERS || field->type == FIELD_SPREADS || field->type == FIELD_SPREAD) && shown.bytes)
        ceduo_number_localize(shown.bytes);
    cell->text = ceduo_arena_string(&form->arena, ceduo_text_string(&shown));
    char whole[CELL_SIZE];
    write_cell(whole, cell, COLUMNS_MAX);
    cell->columns = (int)ceduo_utf8_width(whole);
}

void ceduo_form_field(struct form *form, const char *path, const char *label)
{
    const struct field *field = ceduo_schema_row(path);
    add_cell(form, add_row(form, FORM_FIELDS, label ? label : _(field->shown.label)), field, path);
}

/* Return the next word of a list separated by blanks; NULL at the end. */
static const char *next_key(struct form *form, const char **keys)
{
    size_t n = strcspn(*keys, " ");
    const char *key = n > 0 ? ceduo_arena_copy(&form->arena, *keys, n) : NULL;
    *keys += n + strspn(*keys + n, " ");
    return key;
}

void ceduo_form_fields(struct form *form, const char *prefix, const char *keys)
{
    for (const char *key; (key = next_key(form, &keys));)
        ceduo_form_field(form, ceduo_arena_format(&form->arena, "%s%s", prefix, key), NULL);
}

void ceduo_form_rest(struct form *form, const char *group)
{
    const struct object *fields = ceduo_schema_row(group)->object;
    for (const struct field *f = fields->fields; f < fields->fields + fields->n; f++) {
        const char *path = ceduo_arena_format(&form->arena, "%s.%s", group, f->key);
        bool exists = f->type == FIELD_GROUP || f->type == FIELD_LIST;
        for (size_t k = 0; k < form->n; k++)
            exists |= form->rows[k].n > 0 && strcmp(form->rows[k].cells[0].path, path) == 0;
        if (!exists)
            ceduo_form_field(form, path, NULL);
    }
}

/* Add a line for item i of a list. */
static struct form_row *add_item(struct form *form, const char *list, size_t i)
{
    struct form_row *row = add_row(form, FORM_FIELDS, ceduo_arena_format(&form->arena, "%zu", i + 1));
    row->list = ceduo_arena_string(&form->arena, list);
    row->index = i;
    return row;
}

/* Give the rows of a table, from its head on, the columns of its widest cells and short heads, then of its long heads. */
static void set_columns(struct form *form, size_t head)
{
    int *columns = ceduo_check_memory(ceduo_arena_alloc(&form->arena, 2 * FORM_COLUMNS * sizeof *columns));
    for (size_t k = 0; k < form->rows[head].n; k++) {
        const struct field_shown *shown = &form->rows[head].cells[k].field->shown;
        columns[FORM_COLUMNS + k] = (int)ceduo_utf8_width(_(shown->label));
        columns[k] = shown->brief ? (int)ceduo_utf8_width(ceduo_translate_in(shown->brief)) : columns[FORM_COLUMNS + k];
        for (size_t i = head + 1; i < form->n; i++)
            if (form->rows[i].cells[k].columns > columns[k])
                columns[k] = form->rows[i].cells[k].columns;
    }
    for (size_t i = head; i < form->n; i++)
        form->rows[i].columns = columns;
}

void ceduo_form_table(struct form *form, const char *list, const char *group, const char *keys)
{
    size_t first = form->n;
    const struct node *node = ceduo_document_node(form->document, list);
    const struct field *object_field = ceduo_schema_row(ceduo_arena_format(&form->arena, "%s[0]", list));
    object_field = group ? ceduo_schema_field(object_field->object, group) : object_field;
    struct form_row *head = add_row(form, FORM_COLUMNS_ROW, "");
    list = head->list = ceduo_arena_string(&form->arena, list);
    for (const char *rest = keys, *key; head->n < FORM_COLUMNS && (key = next_key(form, &rest));)
        head->cells[head->n++] = (struct form_cell){.path = "", .field = ceduo_schema_field(object_field->object, key)};
    for (size_t i = 0; node && node->kind == NODE_LIST && i < node->n; i++) {
        const struct node *item = group ? ceduo_node_get(node->items[i], group) : node->items[i];
        if (!item)
            continue;
        struct form_row *row = add_item(form, list, i);
        row->group = group ? object_field->key : NULL;
        for (const char *rest = keys, *key; row->n < FORM_COLUMNS && (key = next_key(form, &rest));) {
            const struct field *field = ceduo_schema_field(object_field->object, key),
                               *other_unit = ceduo_schema_unit(object_field->object, field);
            if (!ceduo_node_get(item, key) && other_unit &&
                ceduo_node_get(item, other_unit->key)) /* the file uses another unit */
                field = other_unit;
            const char *path =
                ceduo_arena_format(&form->arena, "%s[%zu].%s%s%s", list, i, group ? group : "", group ? "." : "", field->key);
            const char *named = field->type == FIELD_NUMBER ? ceduo_node_text(item, "path") : NULL;
            const struct field *value =
                named ? ceduo_schema_at(named) : NULL; /* a bound of an uncertain input: in the unit of that input */
            add_cell(form, row, value && value->shown.per != 1 ? value : field, path);
        }
    }
    set_columns(form, first);
    if (!node || node->n == 0)
        add_row(form, FORM_FIELDS, _("none; a adds one"))->list = list;
}

void ceduo_form_points(struct form *form, const char *list)
{
    const struct node *node = ceduo_document_node(form->document, list);
    for (size_t i = 0; node && node->kind == NODE_LIST && i < node->n; i++)
        add_cell(form, add_item(form, list, i), ceduo_schema_at(list), ceduo_arena_format(&form->arena, "%s[%zu]", list, i));
}

/* ---- the cursor ---- */

static bool has_fields(const struct form_row *row)
{
    return row->kind == FORM_FIELDS;
}

void ceduo_form_clamp(struct form *form)
{
    size_t down = form->row < form->n ? form->row : form->n - (form->n > 0), up = down;
    while (down < form->n && !has_fields(&form->rows[down]))
        down++;
    while (up > 0 && !has_fields(&form->rows[up]))
        up--;
    form->row = down < form->n ? down : up;
    size_t n = form->n > 0 ? form->rows[form->row].n : 0;
    form->column = form->column < n ? form->column : n - (n > 0);
}

void ceduo_form_move(struct form *form, int lines, int columns)
{
    size_t step = lines < 0 ? SIZE_MAX : 1; /* upwards: wraps around above the first line */
    for (int remaining = abs(lines); remaining > 0; remaining--) {
        size_t to = form->row + step;
        while (to < form->n && !has_fields(&form->rows[to]))
            to += step;
        if (to >= form->n)
            break;
        form->row = to;
    }
    if (columns > 0 || (columns < 0 && form->column > 0))
        form->column += (size_t)columns;
    ceduo_form_clamp(form);
}

struct form_row *ceduo_form_row(struct form *form)
{
    return form->row < form->n && has_fields(&form->rows[form->row]) ? &form->rows[form->row] : NULL;
}

struct form_cell *ceduo_form_cell(struct form *form)
{
    struct form_row *row = ceduo_form_row(form);
    return row && form->column < row->n ? &row->cells[form->column] : NULL;
}

void ceduo_form_go_to_item(struct form *form, const char *list, size_t index)
{
    size_t last = form->row;
    for (size_t i = 0; i < form->n; i++)
        if (form->rows[i].kind == FORM_FIELDS && strcmp(form->rows[i].list, list) == 0 && form->rows[i].index <= index)
            last = i;
    form->row = last;
    ceduo_form_clamp(form);
}

/* True if the label of line i, or a heading above it or above its table, contains a word. */
static bool line_shows(const struct form *form, size_t i, const char *word)
{
    const char *list = form->rows[i].list;
    bool found = strcasestr(form->rows[i].label, word);
    for (; i > 0 && (!has_fields(&form->rows[i - 1]) || (list[0] && strcmp(form->rows[i - 1].list, list) == 0)); i--)
        found |= form->rows[i - 1].kind == FORM_HEADING && strcasestr(form->rows[i - 1].label, word);
    return found;
}

/* True if the value of a cell, or the head of its column, long or short, contains a word. */
static bool cell_shows(const struct form_cell *cell, bool has_head, const char *word)
{
    const struct field_shown *head = &cell->field->shown;
    char shown[CELL_SIZE];
    write_cell(shown, cell, COLUMNS_MAX);
    return strcasestr(cell->text, word) || strcasestr(shown, word) || (has_head && strcasestr(_(head->label), word)) ||
           (has_head && head->brief && strcasestr(ceduo_translate_in(head->brief), word));
}

bool ceduo_form_search(struct form *form, const char *word)
{
    for (int by_path = 0; word[0] && by_path < 2; by_path++) /* words on the screen first */
        for (size_t step = 1; step <= form->n; step++) {
            size_t i = (form->row + step) % form->n, k = 0;
            const struct form_row *row = &form->rows[i];
            bool found = has_fields(row) && !by_path && line_shows(form, i, word); /* the first cell stands for its line */
            while (has_fields(row) && !found && k < row->n) {
                found = by_path ? strcasestr(row->cells[k].path, word) != NULL
                                : cell_shows(&row->cells[k], row->columns != NULL, word);
                k += !found;
            }
            if (!found)
                continue;
            form->row = i;
            form->column = k;
            ceduo_form_clamp(form);
            return true;
        }
    return false;
}

/* ---- drawing ---- */

/* Return the columns of the labels in a rectangle `width` wide. All have the same width; if possible no label is cut. */
static int label_columns(const struct form *form, int width)
{
    int columns = LABEL_MIN;
    for (size_t i = 0; i < form->n; i++) {
        const struct form_row *row = &form->rows[i];
        int own = (int)ceduo_utf8_width(row->label) + 1;
        if (row->kind == FORM_FIELDS && !row->list[0] && own > columns)
            columns = own;
    }
    int max = width - VALUE_MIN > LABEL_MIN ? width - VALUE_MIN : LABEL_MIN;
    return columns < max ? columns : max;
}

/* Share `space` columns among the cells of a row: each gets what it wants, then its long head and a share of the rest, or the
 * widest get less. Each cell has a blank after it. */
static void share_columns(const struct form_row *row, int space, int *each)
{
    int n = (int)row->n, rest = space;
    for (int k = 0; k < n; k++) {
        each[k] = row->columns ? row->columns[k] + 1 : space / n < COLUMN_MAX ? space / n : COLUMN_MAX;
        rest -= each[k];
    }
    for (; rest < 0; rest++) {
        int widest = 0;
        for (int k = 1; k < n; k++)
            widest = each[k] > each[widest] ? k : widest;
        each[widest]--;
    }
    for (int k = 0; k < n && row->columns; k++) {
        int more = row->columns[FORM_COLUMNS + k] + 1 - each[k];
        more = more > 0 && more <= rest ? more : 0;
        each[k] += more;
        rest -= more;
    }
    for (int k = 0; k < n; k++) {
        int more = rest / (n - k);
        more = each[k] + more <= COLUMN_MAX ? more : each[k] < COLUMN_MAX ? COLUMN_MAX - each[k] : 0;
        each[k] += more;
        rest -= more;
    }
}

/* Compute the columns of cell k of a row in a rectangle `width` wide with labels of `label` columns. */
static void cell_place(const struct form_row *row, int width, int label, size_t k, int *from, int *span)
{
    label = row->list[0] ? 4 : label;
    *from = label;
    *span = width - label - 1;
    if (!row->list[0] || row->n == 0)
        return;
    int each[FORM_COLUMNS];
    share_columns(row, width - label, each);
    for (size_t i = 0; i < k && i < row->n; i++)
        *from += each[i];
    *span = k < row->n ? each[k] - 1 : 0;
}

/* `edit`: the typed text; NULL: the cell is not being edited. */
static void draw_cell(struct ceduo_cells *cells, const struct form_cell *cell, int x, int y, int span, bool cursor,
                      const char *edit)
{
    char shown[CELL_SIZE];
    write_cell(shown, cell, span);
    if (cursor)
        for (int i = 0; i < span; i++)
            ceduo_cells_label(cells, x + i, y, CEDUO_ROLE_CURSOR, " ");
    if (cursor && edit) {
        int n = ceduo_cells_label_end(cells, x, y, span - 1, CEDUO_ROLE_CURSOR, edit);
        ceduo_cells_label(cells, x + n, y, CEDUO_ROLE_CURSOR, "_");
        return;
    }
    enum ceduo_role role = cursor ? CEDUO_ROLE_CURSOR : cell->given ? CEDUO_ROLE_TEXT : CEDUO_ROLE_DIM;
    ceduo_canvas_draw_text(&cells->canvas, x, y, span, role, shown);
}

/* `label`: columns of the labels. */
static void draw_row(const struct form *form, struct ceduo_cells *cells, size_t i, int y, int label, const char *edit)
{
    const struct form_row *row = &form->rows[i];
    struct ceduo_canvas *canvas = &cells->canvas;
    int left = form->area.left, width = form->area.width;
    if (row->kind == FORM_HEADING || row->kind == FORM_NOTE) {
        ceduo_canvas_draw_text(canvas, left, y, width, row->kind == FORM_HEADING ? CEDUO_ROLE_TITLE : CEDUO_ROLE_DIM,
                               row->label);
        return;
    }
    if (row->kind == FORM_FIELDS) {
        int span = row->n == 0 ? width : row->list[0] ? 3 : label - 1;
        ceduo_canvas_draw_text(canvas, left, y, span, i == form->row && row->n == 0 ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_DIM,
                               row->label);
    }
    for (size_t k = 0; k < row->n; k++) {
        int from, span;
        cell_place(row, width, label, k, &from, &span);
        const struct field_shown *shown = &row->cells[k].field->shown;
        bool fits = !shown->brief || (int)ceduo_utf8_width(_(shown->label)) <= span;
        if (row->kind == FORM_COLUMNS_ROW)
            ceduo_canvas_draw_text(canvas, left + from, y, span, CEDUO_ROLE_TITLE,
                                   fits ? _(shown->label) : ceduo_translate_in(shown->brief));
        else
            draw_cell(cells, &row->cells[k], left + from, y, span, i == form->row && k == form->column, edit);
    }
}

void ceduo_form_scroll(struct form *form, struct ceduo_area area)
{
    struct viewport *v = &form->lines;
    size_t above = form->row, below = form->row;
    form->area = area;
    while (above > 0 && !has_fields(&form->rows[above - 1])) /* show headings with the line below */
        above--;
    while (below + 1 < form->n && !has_fields(&form->rows[below + 1]))
        below++;
    if (below + 1 < form->n || below - form->row >= (size_t)area.height) /* show notes with the last field above */
        below = form->row;
    viewport_fit(v, area.height, (int)form->n);
    viewport_show(v, (int)above, (int)below);
    viewport_show(v, (int)form->row, (int)form->row); /* the cursor has priority in a low area */
}

void ceduo_form_draw(struct form *form, struct ceduo_cells *cells, struct ceduo_area area, const char *edit)
{
    form->area = area;
    if (area.height <= 0 || area.width < 8)
        return;
    const struct viewport *v = &form->lines;
    int label = label_columns(form, area.width);
    for (int i = v->first; i < v->first + v->rows && i < v->count; i++)
        draw_row(form, cells, (size_t)i, area.top + i - v->first, label, edit);
}

/* Compute the first column of cell k; the label belongs to the first cell. The end of the last cell is that of the form. */
static int cell_start(const struct form *form, const struct form_row *row, size_t k)
{
    int from, span, width = form->area.width;
    cell_place(row, width, label_columns(form, width), k, &from, &span);
    return k == 0 ? 0 : k < row->n ? from : width;
}

void ceduo_form_click(struct form *form, int x, int row)
{
    if ((size_t)row >= form->n || !has_fields(&form->rows[row]))
        return;
    form->row = (size_t)row;
    form->column = 0;
    while (form->column + 1 < form->rows[row].n && x >= cell_start(form, &form->rows[row], form->column + 1))
        form->column++;
}

bool ceduo_form_find_cell(struct form *form, struct ceduo_area *area)
{
    const struct form_row *row = ceduo_form_row(form);
    int line = (int)form->row - form->lines.first;
    if (!row || line < 0 || line >= form->area.height)
        return false;
    int from = cell_start(form, row, form->column), to = cell_start(form, row, form->column + 1);
    *area = (struct ceduo_area){form->area.left + from, form->area.top + line, to - from, 1};
    return true;
}

/* ---- explaining and stepping ---- */

void ceduo_form_explain(struct form *form, struct text *text)
{
    const struct form_cell *cell = ceduo_form_cell(form);
    if (!cell)
        return;
    const struct field *f = cell->field;
    const char *unit = ceduo_format_unit(f);
    LOCAL_TEXT(range);
    LOCAL_TEXT(default_value);
    ceduo_text_format(text, "%s: %s", _(f->shown.label), _(f->meaning));
    if (unit[0])
        ceduo_text_format(text, "; %s", unit);
    if (ceduo_format_range(f, &range))
        ceduo_text_format(text, ", %s", ceduo_text_string(&range));
    if (f->value) {
        ceduo_format_value(f, f->value, &default_value);
        ceduo_text_append_joined(text, " ", _("(default %s)"), ceduo_text_string(&default_value));
    }
    const struct source_note *note = ceduo_notes_find(form->document->file.notes, cell->path);
    if (note && cell->given)
        ceduo_text_format(text, " [%s: %s]", _(note->kind), ceduo_in_language(note->text, note->text_it));
}

/* Return one unit of the second significant digit. */
static double compute_step(double value, const struct field *f)
{
    if (value == 0)
        return f->hi <= 1 ? 0.05 : f->hi <= 100 ? 0.1 : 1;
    double step = pow(10, floor(log10(fabs(value)) + 1e-9) - 1);
    return f->type == FIELD_COUNT && step < 1 ? 1 : step;
}

bool ceduo_form_step(struct form *form, int direction, struct text *value)
{
    const struct form_cell *cell = ceduo_form_cell(form);
    double now;
    if (!cell)
        return false;
    const struct field *f = cell->field;
    if (ceduo_schema_is_place(f) && ceduo_schema_place_read(cell->written, &now)) { /* step by 1 m; + goes towards the end */
        ceduo_text_format(value, now - direction > 0 ? "end-%g" : "end", now - direction);
        return true;
    }
    if (f->type == FIELD_CHOICE) {
        const struct choices *c = f->choices;
        int i = ceduo_choice_find(c, cell->written);
        ceduo_text_append(value, c->names[i < 0 ? 0 : ((size_t)i + (direction > 0 ? 1 : c->n - 1)) % c->n]);
        return true;
    }
    if (f->type == FIELD_FLAG) {
        ceduo_text_append(value, strcmp(cell->written, "true") == 0 ? "false" : "true");
        return true;
    }
    const struct node *node = ceduo_document_node(form->document, cell->path);
    bool scalar = !node || node->kind == NODE_SCALAR;
    if (!scalar || (f->type != FIELD_NUMBER && f->type != FIELD_SPREAD && f->type != FIELD_COUNT) ||
        ceduo_input_parse_number(cell->text, &now) != CEDUO_NUMBER_GOOD)
        return false;
    double step = compute_step(now, f), lo = f->lo * f->shown.per, hi = f->hi * f->shown.per;
    if (direction < 0 && now != 0 && fabs(now) < 10.5 * step && compute_step(now - step, f) < step && now > 0)
        step /= 10; /* step from 1.0 down to 0.99, not to 0.9 */
    double next = (round(now / step) + direction) * step;
    next = next < lo ? lo : next > hi ? hi : next;
    int decimals = step < 1 ? (int)ceil(-log10(step) - 1e-9) : 0;
    ceduo_text_format(value, "%.*f", decimals, next == 0 ? 0.0 : next);
    return true;
}
