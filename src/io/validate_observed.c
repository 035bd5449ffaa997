/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observations of real rocks. They are a list of rows or a mapping from kinds to rows; values are inline or in tables.
 * ceduo_arrange_observed() converts all forms to the form of the table of keys before it is read. Then each row becomes one or
 * several observations. ceduo/calibrate.h describes the observations. */
#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "csv.h"
#include "file.h"
#include "scene/derived.h"
#include "scene/rock.h"
#include "scene_file.h"
#include "study/observe.h"
#include "validator.h"

/* ---- one form ---- */

/* True if a key belongs to the row; it may be written next to the kind or in it. */
static bool is_row_key(const char *key)
{
    static const char *const keys[] = {"name", "name_it", "use", "option", "rock", "release", "source"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (strcmp(key, keys[i]) == 0)
            return true;
    return false;
}

/* Move the row keys from a kind to its row. A path instead of values becomes the table, csv. */
static const struct node *move_row_keys(struct arena *arena, const struct node *row, const char *key)
{
    static const char *const lists[] = {"x_m", "values", "height_m"};
    const struct node *kind = ceduo_node_get(row, key);
    if (kind->kind != NODE_MAP)
        return row;
    for (size_t i = kind->n; row && kind && i-- > 0;) {
        const struct node *entry = kind->items[i];
        if (!is_row_key(entry->key) || ceduo_node_get(row, entry->key))
            continue;
        kind = ceduo_node_without(arena, kind, entry->key);
        row = ceduo_node_with(arena, row, entry->key, entry);
    }
    bool at_place = ceduo_node_get(kind, "values") || ceduo_node_get(kind, "mean"); /* x_m is a number, not a list */
    for (size_t i = at_place; kind && i < 3; i++) {
        double value;
        const struct node *list = ceduo_node_get(kind, lists[i]);
        bool scalar = list && list->kind == NODE_SCALAR;
        if (scalar && !ceduo_node_get(kind, "csv") &&
            (list->quoted || ceduo_number_read(list->text, &value) == CEDUO_NUMBER_NONE))
            kind = ceduo_node_with(arena, ceduo_node_without(arena, kind, lists[i]), "csv", list);
    }
    return ceduo_node_with(arena, row, key, kind);
}

/* Return a row with its keys moved out of the kinds, and with missing keys of its release copied from the scene's. */
static const struct node *arrange_row(struct validator *v, const struct node *row)
{
    const struct node *arranged = row, *scene = ceduo_node_get(v->root, "release");
    if (row->kind != NODE_MAP)
        return row;
    for (size_t i = 0; arranged && i < row->n; i++)
        if (!is_row_key(row->items[i]->key))
            arranged = move_row_keys(v->arena, arranged, row->items[i]->key);
    const struct node *own = ceduo_node_get(arranged, "release");
    for (size_t i = 0; own && own->kind == NODE_MAP && scene && scene->kind == NODE_MAP && i < scene->n; i++)
        if (!ceduo_node_get(own, scene->items[i]->key) && strcmp(scene->items[i]->key, "source") != 0)
            own = ceduo_node_with(v->arena, own, scene->items[i]->key, scene->items[i]);
    return own ? ceduo_node_with(v->arena, arranged, "release", own) : arranged;
}

/* Convert a mapping of kinds, each with a row or a list of rows, to a list of rows with one kind each. NULL on failure. */
static const struct node *list_kinds(struct arena *arena, const struct node *kinds)
{
    const struct node *list = ceduo_node_empty(arena, NODE_LIST, kinds->source);
    for (size_t i = 0; i < kinds->n; i++) {
        const struct node *kind = kinds->items[i];
        for (size_t k = 0; list && k < (kind->kind == NODE_LIST ? kind->n : 1); k++) {
            const struct node *value = kind->kind == NODE_LIST ? kind->items[k] : kind;
            const struct node *empty = ceduo_node_empty(arena, NODE_MAP, kind->source);
            const struct node *made = ceduo_node_with(arena, empty, kind->key, value);
            struct node *row = made ? ceduo_arena_alloc(arena, sizeof *row) : NULL;
            if (!row)
                return NULL;
            *row = *made;
            row->line = value->line;
            row->column = value->column;
            list = ceduo_node_inserted(arena, list, list->n, row);
        }
    }
    return list;
}

void ceduo_arrange_observed(struct validator *v)
{
    const struct node *uncertainty = ceduo_node_get(v->root, "uncertainty"), *rows = ceduo_node_get(uncertainty, "rows"),
                      *root = v->root;
    v->draws = ceduo_node_get(uncertainty, "draws");
    if (v->draws) { /* uncertainty: {draws: FILE, rows: […]} becomes uncertainty: […] */
        for (size_t i = 0; i < uncertainty->n; i++)
            if (strcmp(uncertainty->items[i]->key, "draws") != 0 && strcmp(uncertainty->items[i]->key, "rows") != 0)
                ceduo_problem_at(v->problems, ceduo_node_place(uncertainty->items[i], "uncertainty"),
                                 _("unknown key; known here: %s"), "draws, rows");
        root = ceduo_node_without(v->arena, root, "uncertainty");
        root = rows ? ceduo_node_with(v->arena, root, "uncertainty", rows) : root;
    }
    const struct node *all = ceduo_node_get(root, "observed");
    const struct node *list = all && all->kind == NODE_MAP ? list_kinds(v->arena, all) : all;
    for (size_t i = 0; list && list->kind == NODE_LIST && i < list->n; i++) {
        const struct node *row = arrange_row(v, list->items[i]);
        list = row == list->items[i] ? list : ceduo_node_replaced(v->arena, list, i, row);
    }
    if (list != all)
        root = ceduo_node_with(v->arena, root, "observed", list);
    v->root = root ? root : v->root;
}

/* ---- values ---- */

/* A kind of a row, which is checked. */
struct entry {
    struct validator *v;
    struct observed *row;
    const char *row_path;                /* observed[0] */
    const struct ceduo_release *release; /* of the row */
    enum ceduo_observed_kind kind;
    const struct ceduo_observed_row *kind_row;
    struct observed_values *values;
    const char *path; /* observed[0].stops */
    const struct node *node;
};

/* Columns of a table of observations. */
enum column { VALUES, MAP, NAMED, ONLY, COLUMNS };

struct table {
    struct csv csv;
    size_t columns[COLUMNS];
    const char *only_name, *only_word; /* rows that are used: this column has this word; NULL: all rows */
};

/* Split `only`, COLUMN=WORD. Return false on error. */
static bool split_only(const struct entry *e, struct table *t)
{
    const char *only = e->values->only, *equals = only ? strchr(only, '=') : NULL;
    if (!only)
        return true;
    size_t n = equals ? (size_t)(equals - only) : 0;
    while (n > 0 && only[n - 1] == ' ')
        n--;
    if (n == 0)
        return ceduo_reject(e->v, e->path, "only", _("'%s' is not COLUMN=WORD, such as block=1"), only);
    t->only_name = ceduo_asprintf(e->v, "%.*s", (int)n, only);
    t->only_word = equals + 1 + strspn(equals + 1, " ");
    return true;
}

/* Units that a column of observations may have by mistake. Metres count in brackets only: "speed at 60 m" names a place. */
#define OTHER_UNITS                                                                                                                 \
    "mm|cm|dm|km|in|inch|inches|ft|feet|yd|mi|mile|miles|miglia|piedi|mm/s|cm/s|m/s|m s-1|km/s|m/min|km/h|km h-1|km·h-1|"          \
    "km h⁻¹|km·h⁻¹|kph|kmph|km/hr|km/ora|mph|mi/h|ft/s|fps|kn|kt|knots|nodi|J|joule|joules|kJ|MJ|GJ|N m|kN m|Wh|kWh|kcal|%|" \
    "deg|°"
#define BRACKET_UNITS "m|kg"

/* True if a head ends with a unit, or has one in brackets, that is not one of `units`. */
static bool has_other_unit(struct csv_cell head, const char *units)
{
    for (size_t i = 0; i < head.n; i++) {
        const char *p = head.p + i;
        size_t n = head.n - i;
        if (i > 0 && !strchr(" _([.,;:/-", p[-1])) /* a unit follows a separator, or is the whole head */
            continue;
        bool bracket = i > 0 && strchr("([", p[-1]);
        for (size_t k = 0; bracket && k < n; k++)
            n = strchr(")]", p[k]) ? k : n;
        if (ceduo_csv_matches(p, n, units))
            return false;
        if (ceduo_csv_matches(p, n, OTHER_UNITS) || (bracket && ceduo_csv_matches(p, n, BRACKET_UNITS)))
            return true;
    }
    return false;
}

/* Find the head and the columns. Reports an unknown column of the values or of `only`, or a wrong unit, and returns
 * false. */
static bool find_columns(const struct entry *e, struct table *t)
{
    const struct ceduo_quantity_row *quantity = ceduo_observed_quantity(e->kind);
    struct csv *csv = &t->csv;
    const struct csv_head heads[COLUMNS] = {[VALUES] = {quantity->column, quantity->also, .units = quantity->units},
                                            [MAP] = {"y_m", "y|northing|north|nord", .units = "m"},
                                            [NAMED] = {e->values->column, .units = ""},
                                            [ONLY] = {t->only_name, .units = ""}};
    const struct csv_place begin = csv->next;
    LOCAL_TEXT(all);
    double number;
    ceduo_csv_find_head(csv, heads, COLUMNS, t->columns);
    csv->source->foreign = t->columns[VALUES] == CEDUO_CSV_NOT_FOUND; /* a column that the scene names proves nothing */
    size_t *column = &t->columns[e->values->column ? NAMED : VALUES];
    bool stops = e->kind_row->location == CEDUO_LOCATION_AT_REST && csv->heads_count > 0 && *column < CEDUO_CSV_DUPLICATE;
    bool map = stops && !e->values->column && t->columns[MAP] != CEDUO_CSV_NOT_FOUND &&
               ceduo_csv_matches(csv->heads[*column].p, csv->heads[*column].n, "x|x_m");
    if (*column == CEDUO_CSV_NOT_FOUND && !e->values->column && csv->heads_count == 1) {
        *column = 0;
        if (ceduo_csv_value(csv, csv->heads[0], &number)) {
            csv->next = begin;
            ceduo_csv_begin_headless(csv, csv->separator);
        }
    }
    ceduo_csv_append_heads(csv, &all);
    const char *key = ceduo_node_get(e->node, "column") ? "column" : "csv", *names = ceduo_text_string(&all);
    if (map)
        return ceduo_reject(e->v, e->path, key,
                            _("x and y are coordinates on a map; name the column with the distance along the slope in "
                              "'column'; the table has: %s"),
                            names);
    if (*column == CEDUO_CSV_DUPLICATE) /* already reported */
        return false;
    if (*column == CEDUO_CSV_NOT_FOUND && e->values->column)
        return ceduo_reject(e->v, e->path, key, _("the table has no column '%s'; it has: %s"), e->values->column, names);
    if (*column == CEDUO_CSV_NOT_FOUND)
        return ceduo_reject(e->v, e->path, key, _("name the column with the values in 'column'; the table has: %s"), names);
    if (t->only_name && t->columns[ONLY] >= CEDUO_CSV_DUPLICATE)
        return ceduo_reject(e->v, e->path, "only", _("the table has no column '%s'; it has: %s"), t->only_name, names);
    t->columns[VALUES] = *column;
    if (!has_other_unit(csv->heads[*column], quantity->units))
        return true;
    csv->source->foreign = false;
    return ceduo_csv_error(csv, csv->heads[*column], _("this column must be in %s; convert it and name it '%s'"),
                           quantity->unit, quantity->column);
}

/* True if the cell in the column of `only` is its word, or an equal number. Reports a stray quote. */
static bool is_selected(const struct table *t)
{
    double number, word;
    if (!t->only_name)
        return true;
    struct csv_cell cell = ceduo_csv_next_cell(&t->csv, t->columns[ONLY]);
    if (ceduo_csv_has_stray_quote(cell))
        return ceduo_csv_error(&t->csv, cell, _("a stray quote in this cell; remove it"));
    return ceduo_csv_equals(cell, t->only_word) || (ceduo_number_read(t->only_word, &word) == CEDUO_NUMBER_GOOD &&
                                                    ceduo_csv_value(&t->csv, cell, &number) && number == word);
}

/* Add a note on how the table was read. */
static void describe_table(const struct entry *e, const struct table *t, const char *path)
{
    LOCAL_TEXT(line);
    const struct csv_cell *head = t->csv.headless ? NULL : &t->csv.heads[t->columns[VALUES]];
    ceduo_text_append_escaped(&line, ceduo_file_name(path));
    ceduo_text_format(&line, ngettext(": %zu value", ": %zu values", e->values->values_count), e->values->values_count);
    if (head)
        ceduo_text_format(&line, _(" in the column %.*s"), head->n < 100 ? (int)head->n : 100, head->p);
    else
        ceduo_text_append(&line, _(", no head"));
    if (t->only_name)
        ceduo_text_format(&line, _("; rows with %s = %s"), t->only_name, t->only_word);
    ceduo_csv_describe(&t->csv, t->columns, COLUMNS, "", &line);
    ceduo_add_table_note(e->v, e->path, ceduo_text_string(&line));
}

/* Heads of columns that count rocks, and heads of columns that count or number rocks. */
#define COUNTS                                                                                                                 \
    "count|counts|n rocks|number of rocks|no of rocks|rocks|conteggio|n massi|num massi|numero massi|numero di massi|massi|"   \
    "n blocchi|numero blocchi|numero di blocchi|freq|frequency|frequenza|anzahl|anzahl steine"
#define COUNTS_OR_NUMBERS "n|nr|no|num|number|numero|nummer"

/* True if a column has whole numbers that count rocks: not 1 in each row, and not a vague head with 1, 2, 3. */
static bool counts_rocks(struct csv *csv, size_t column)
{
    const struct csv_place begin = csv->next;
    const struct csv_cell head = csv->heads[column];
    struct problems *problems = csv->problems;
    const bool vague = ceduo_csv_matches(head.p, head.n, COUNTS_OR_NUMBERS);
    bool whole = vague || ceduo_csv_matches(head.p, head.n, COUNTS), single = true, rises = true;
    size_t rows = 0;
    double value, last = 0;
    csv->problems = NULL;
    while (whole && ceduo_csv_next_row(csv)) {
        const struct csv_cell cell = ceduo_csv_next_cell(csv, column);
        if (ceduo_csv_is_empty(cell))
            continue;
        whole = ceduo_csv_value(csv, cell, &value) && value >= 0 && value == floor(value);
        single = single && whole && value == 1;
        rises = rises && whole && (rows == 0 || value == last + 1);
        last = value;
        rows++;
    }
    csv->problems = problems;
    csv->next = begin;
    return whole && !single && !(vague && rises && rows > 2);
}

/* Refuse a column that counts rocks: each row is one rock. */
static bool check_counts(struct csv *csv, const size_t columns[COLUMNS])
{
    for (size_t i = 0; i < csv->heads_count; i++)
        if (i != columns[VALUES] && i != columns[ONLY] && counts_rocks(csv, i))
            return ceduo_csv_error(csv, csv->heads[i],
                                   _("this column counts rocks; write one row for each rock, or name it 'id' if it numbers "
                                     "them"));
    return true;
}

static bool read_table(const struct entry *e, const char *path)
{
    struct validator *v = e->v;
    struct observed_values *to = e->values;
    struct table t = {0};
    struct csv *csv = &t.csv;
    if (!split_only(e, &t) || !ceduo_csv_open(csv, v->arena, path, v->problems) || !find_columns(e, &t))
        return false;
    ceduo_csv_mark_numeric(csv, t.columns[VALUES]);
    ceduo_csv_scan(csv);
    if (!check_counts(csv, t.columns))
        return false;
    to->values = ceduo_alloc(v, csv->rows, sizeof *to->values);
    if (!to->values)
        return false;
    while (ceduo_csv_next_row(csv))
        if (!csv->bad && is_selected(&t) &&
            ceduo_csv_number(csv, ceduo_csv_next_cell(csv, t.columns[VALUES]), -1e9, 1e9,
                             ceduo_observed_quantity(e->kind)->unit, &to->values[to->values_count]))
            to->values_count++;
    if (to->values_count > 0)
        describe_table(e, &t, path);
    return to->values_count > 0 || ceduo_reject(v, e->path, "csv", _("no row of the table matches")); /* untaken: complaint */
}

/* Load the values from a table, unless they are listed. Return false on error. */
static bool load_values(const struct entry *e)
{
    struct validator *v = e->v;
    const struct observed_values *values = e->values;
    size_t before = v->problems->met;
    const struct node *csv = ceduo_node_get(e->node, "csv"), *list = ceduo_node_get(e->node, e->kind_row->list);
    if (csv && list)
        return ceduo_reject(v, e->path, "csv", _("%s already says this; keep one of the two"), e->kind_row->list);
    const char *path = csv ? ceduo_resolve_path(v->arena, csv, "scenes") : NULL;
    if (path)
        return read_table(e, path) && v->problems->met == before;
    if (csv)
        return ceduo_reject(v, e->path, "csv",
                            _("cannot find '%s' next to this file or among the profiles (ceduo --list-profiles)"), csv->text);
    if (list && values->values_count == 0)
        return ceduo_reject(v, e->path, e->kind_row->list, _("the list is empty"));
    const char *table_key = values->column ? "column" : values->only ? "only" : NULL;
    /* untaken: complaint */
    return !table_key || ceduo_reject(v, e->path, table_key, _("this needs a table; name it in 'csv'"));
}

/* Check that either values are given, or their mean, sd and number. */
static bool check_form(const struct entry *e)
{
    const struct observed_values *values = e->values;
    int means = !isnan(values->mean) + !isnan(values->sd) + (values->n > 0);
    return means == (values->values_count > 0 ? 0 : 3) ||
           ceduo_reject(e->v, e->path, "", _("give values, or their mean, sd and n")); /* untaken: complaint */
}

/* Check each value; report the first wrong one. Places of stopped rocks must lie on the slope after seen_from_m. Other values
 * must not be negative. */
static bool check_each(const struct entry *e)
{
    struct validator *v = e->v;
    const struct observed_values *values = e->values;
    bool stops = e->kind_row->location == CEDUO_LOCATION_AT_REST;
    for (size_t i = 0; i < values->values_count; i++) {
        double x = values->values[i];
        const char *path = ceduo_node_get(e->node, "csv") ? ceduo_asprintf(v, "%s.csv", e->path)
                                                          : ceduo_asprintf(v, "%s.%s[%zu]", e->path, e->kind_row->list, i);
        if (stops && !ceduo_check_on_slope(e->v, path, "", x))
            return false;
        if (stops && x < values->seen_from)
            return ceduo_reject(v, path, "", _("%s lies before the begin of the searched area (%s)"), ROUNDTRIP(x),
                                ROUNDTRIP(values->seen_from));
        if (!stops && x < 0)
            return ceduo_reject(v, path, "", _("%s is below %s%s%s"), ROUNDTRIP(x), "0", "", "");
    }
    return true;
}

/* Check that at most the number of released rocks was observed. */
static bool check_released(const struct entry *e)
{
    const struct observed_values *values = e->values;
    unsigned long long observed = e->kind_row->list ? values->values_count : values->count, released = values->released_count;
    return released == 0 || observed <= released ||
           /* untaken: complaint */
           ceduo_reject(e->v, e->path, "of", _("%llu observed, but only %llu released; correct one"), observed, released);
}

static bool check_values(const struct entry *e)
{
    const struct observed_values *values = e->values;
    const struct ceduo_scene *scene = &e->v->draft.scene;
    double last =
        (e->release == &scene->release ? ceduo_scene_release_last(scene) : ceduo_number_max(e->release->x)) + e->v->origin;
    switch (e->kind_row->location) { /* untaken: table */
    case CEDUO_LOCATION_AT_REST:
        return ceduo_check_on_slope(e->v, e->path, "seen_from_m", values->seen_from) && check_each(e) && check_released(e);
    case CEDUO_LOCATION_AT_PLACE:
        return (!e->kind_row->list || check_form(e)) && ceduo_check_on_slope(e->v, e->path, "x_m", values->x) &&
               /* untaken: complaint */
               (values->x > last || ceduo_reject(e->v, e->path, "x_m", _("%s must lie beyond the release (%s m)"),
                                                 ROUNDTRIP(values->x), ROUNDTRIP(last))) &&
               (e->kind_row->list ? check_each(e) : check_released(e));
    case CEDUO_LOCATION_ON_STEMS: /* a rock may hit several stems, so no check of the number released */
        return ceduo_check_stretch(e->v, e->path, values->from, values->to) && check_each(e);
    case CEDUO_LOCATION_LARGEST:
        return check_form(e) && check_each(e);
    case CEDUO_LOCATION_ALONG:
        return check_form(e) && check_each(e) &&
               ceduo_check_stretch(e->v, ceduo_asprintf(e->v, "%s.on_the_way", e->row_path), e->row->stretch_from,
                                   e->row->stretch_to);
    }
    return false;
}

/* ---- rows ---- */

/* Set the name of an observation; without one, its quantity and place. */
static void set_name(const struct entry *e, struct ceduo_observation *o)
{
    const struct field *field = ceduo_schema_row(e->path); /* NULL without memory */
    const char *path = e->kind_row->path, *label = field ? _(field->shown.label) : path;
    double x = e->values->x, from = e->row->stretch_from, to = e->row->stretch_to;
    if (e->row->name) {
        o->name_given = e->row->name;
        o->name = ceduo_in_language(e->row->name, e->row->name_it);
    } else if (e->kind_row->location == CEDUO_LOCATION_AT_PLACE) {
        o->name_given = ceduo_asprintf(e->v, "%s at %s m", path, ROUNDTRIP(x));
        o->name = ceduo_asprintf(e->v, _("%s at %s m"), label, ceduo_number_localize(ROUNDTRIP(x)));
    } else if (e->kind_row->location == CEDUO_LOCATION_ALONG) {
        o->name_given = ceduo_asprintf(e->v, "%s %s-%s m", path, ROUNDTRIP(from), ROUNDTRIP(to));
        o->name = ceduo_asprintf(e->v, "%s %s\xe2\x80\x93%s m", label, ceduo_number_localize(ROUNDTRIP(from)),
                                 ceduo_number_localize(ROUNDTRIP(to)));
    } else {
        o->name_given = path;
        o->name = label;
    }
}

/* Set the members of one kind. `o` has those that all kinds of the row share. */
static void set_observation(const struct entry *e, struct ceduo_observation *o)
{
    struct observed_values *values = e->values;
    bool along = e->kind_row->location == CEDUO_LOCATION_ALONG, at_rest = e->kind_row->location == CEDUO_LOCATION_AT_REST;
    double scale = ceduo_observed_quantity(e->kind)->scale, origin = e->v->origin;
    for (size_t i = 0; i < values->values_count; i++)
        values->values[i] = values->values[i] * scale - (at_rest ? origin : 0);
    gsl_sort(values->values, 1, values->values_count);
    o->kind = e->kind;
    set_name(e, o);
    o->x = values->x - origin;
    o->from = (along ? e->row->stretch_from : at_rest ? values->seen_from : values->from) - origin;
    o->to = (along ? e->row->stretch_to : values->to) - origin;
    o->values = values->values_count > 0 ? values->values : NULL;
    o->n = values->values_count > 0 ? values->values_count : (size_t)values->n;
    o->mean = values->mean * scale;
    o->sd = values->sd * scale;
    o->count = values->count;
    o->released_count = values->released_count;
    o->share_seen = values->share_seen;
}

static bool find_option(struct validator *v, const char *path, const struct observed *row, size_t *option)
{
    const struct ceduo_scene *s = &v->draft.scene;
    LOCAL_TEXT(all);
    for (*option = 0; *option < s->options_count; ++*option) {
        const char *name = s->options[*option].name_given ? s->options[*option].name_given : "";
        if (!row->option || strcmp(name, row->option) == 0)
            return true;
        ceduo_text_append_joined(&all, *option > 0 ? ", " : "", "%s", name);
    }
    if (row->option)
        ceduo_reject(v, path, "option", _("the scene has no option '%s'; it has: %s"), row->option, ceduo_text_string(&all));
    return false;
}

static void validate_row(struct validator *v, const char *path, struct observed *row)
{
    struct ceduo_observation shared = {.use = (enum ceduo_observed_use)row->use};
    size_t before = v->problems->met;
    bool any = false;
    const struct node *node = ceduo_resolve_at(v->root, path);
    if (ceduo_node_get(node, "rock")) {
        ceduo_validate_rock(v, ceduo_asprintf(v, "%s.rock", path), &row->rock);
        shared.rock = &row->rock;
    } else if (v->sized_by_blocks) {
        ceduo_reject(v, path, "", _("'rock' is missing; give the observed rock, because 'blocks' have many sizes"));
    }
    if (ceduo_node_get(node, "release")) {
        ceduo_validate_release(v, ceduo_asprintf(v, "%s.release", path), &row->release);
        shared.release = &row->release;
    }
    bool good = find_option(v, path, row, &shared.option) && v->problems->met == before;
    for (int kind = 0; kind < CEDUO_OBSERVED_KINDS; kind++) {
        const struct ceduo_observed_row *kind_row = ceduo_observed_row((enum ceduo_observed_kind)kind);
        const char *kind_path = ceduo_asprintf(v, "%s.%s", path, kind_row->path);
        const struct entry e = {.v = v,
                                .row = row,
                                .row_path = path,
                                .release = shared.release ? shared.release : &v->draft.scene.release,
                                .kind = (enum ceduo_observed_kind)kind,
                                .kind_row = kind_row,
                                .values = &row->values[kind],
                                .path = kind_path,
                                .node = ceduo_resolve_at(v->root, kind_path)};
        any |= e.node != NULL;
        if (e.node && (!kind_row->list || load_values(&e)) && check_values(&e) && good) {
            struct ceduo_observation *o = &v->file->observations[v->file->observations_count++];
            *o = shared;
            set_observation(&e, o);
        }
    }
    if (any)
        return;
    LOCAL_TEXT(keys); /* of all kinds; kinds may share the first key */
    const char *key = "";
    for (int kind = 0; kind < CEDUO_OBSERVED_KINDS; kind++) {
        const char *last = key;
        key = ceduo_observed_row((enum ceduo_observed_kind)kind)->path;
        size_t n = strcspn(key, ".");
        if (strncmp(last, key, n + 1) != 0)
            ceduo_text_append_joined(&keys, last[0] ? ", " : "", "%.*s", (int)n, key);
    }
    ceduo_reject(v, path, "", _("no observation; give one of: %s"), ceduo_text_string(&keys));
}

void ceduo_validate_observed(struct validator *v)
{
    struct observed *rows = v->draft.observed;
    size_t n = v->draft.observed_count;
    if (n == 0 || !ceduo_is_valid_below(v, "observed") || !v->has_profile || ceduo_is_too_long(v, "observed", n))
        return;
    v->file->observations = ceduo_alloc(v, n * CEDUO_OBSERVED_KINDS, sizeof *v->file->observations);
    for (size_t i = 0; v->file->observations && i < n; i++)
        validate_row(v, ceduo_asprintf(v, "observed[%zu]", i), &rows[i]);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < i; k++)
            ceduo_check_name(v, "observed", i, rows[i].name, rows[k].name);
}
