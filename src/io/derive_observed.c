/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was seen of real rocks. It may be written as a list of rows or as a mapping from kinds to rows, lists inline or as
 * tables: ceduo_observed_arrange() brings all into the one form that the table of keys has, before it is read. Then each
 * row becomes one or several observations. */
#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "csv.h"
#include "derive.h"
#include "resolve.h"

/* ---- one form ---- */

/* What may stand beside a kind or within it. */
static const char *const beside[] = {"name", "use", "option", "rock", "release", "source"};

static bool is_beside(const char *key)
{
    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++)
        if (strcmp(key, beside[i]) == 0)
            return true;
    return false;
}

static bool is_number(const struct node *node)
{
    double value;
    return !node->quoted && ceduo_number_read(node->text, &value) != CEDUO_NUMBER_NONE;
}

/* A path in place of the values is a table. */
static const struct node *name_tables(struct arena *arena, const struct node *kind)
{
    static const char *const lists[] = {"x_m", "values", "height_m"};
    bool place = ceduo_node_get(kind, "values") || ceduo_node_get(kind, "mean"); /* then x_m is a number */
    for (size_t i = place ? 1 : 0; kind && i < 3; i++) {
        const struct node *list = ceduo_node_get(kind, lists[i]);
        if (!list || list->kind != NODE_SCALAR || is_number(list) || ceduo_node_get(kind, "csv"))
            continue;
        const struct node *without = ceduo_node_without(arena, kind, lists[i]);
        kind = without ? ceduo_node_with(arena, without, "csv", ceduo_node_renamed(arena, list, "csv")) : NULL;
    }
    return kind;
}

/* Takes out of a kind what belongs beside it. */
static const struct node *lift(struct arena *arena, const struct node *row, const char *key)
{
    const struct node *kind = ceduo_node_get(row, key);
    for (size_t i = kind->kind == NODE_MAP ? kind->n : 0; row && kind && i-- > 0;) {
        const struct node *entry = kind->items[i];
        if (!is_beside(entry->key) || ceduo_node_get(row, entry->key))
            continue;
        kind = ceduo_node_without(arena, kind, entry->key);
        row = ceduo_node_with(arena, row, entry->key, entry);
    }
    if (kind && kind->kind == NODE_MAP)
        kind = name_tables(arena, kind);
    return row && kind ? ceduo_node_with(arena, row, key, kind) : NULL;
}

/* What a release of its own does not say is as in the scene. */
static const struct node *fill_release(struct arena *arena, const struct node *row, const struct node *scene)
{
    const struct node *own = ceduo_node_get(row, "release");
    for (size_t i = 0; own && own->kind == NODE_MAP && scene && scene->kind == NODE_MAP && i < scene->n; i++)
        if (!ceduo_node_get(own, scene->items[i]->key) && strcmp(scene->items[i]->key, "source") != 0)
            own = ceduo_node_with(arena, own, scene->items[i]->key, scene->items[i]);
    return own ? ceduo_node_with(arena, row, "release", own) : row;
}

static const struct node *arrange_row(struct deriver *d, const struct node *row)
{
    const struct node *arranged = row;
    for (size_t i = 0; row->kind == NODE_MAP && arranged && i < row->n; i++)
        if (!is_beside(row->items[i]->key))
            arranged = lift(d->arena, arranged, row->items[i]->key);
    return arranged && row->kind == NODE_MAP ? fill_release(d->arena, arranged, ceduo_node_get(d->root, "release")) : arranged;
}

/* Rows of one kind, from a mapping or a list of such. */
static const struct node *add_kind(struct arena *arena, const struct node *list, const struct node *kind)
{
    size_t n = kind->kind == NODE_LIST ? kind->n : 1;
    for (size_t i = 0; list && i < n; i++) {
        const struct node *empty = ceduo_node_empty(arena, NODE_MAP, kind->source);
        const struct node *value = kind->kind == NODE_LIST ? kind->items[i] : kind;
        struct node *row = NULL;
        if (empty && (row = ceduo_arena_take(arena, sizeof *row))) {
            const struct node *made = ceduo_node_with(arena, empty, kind->key, value);
            *row = made ? *made : *empty;
            row->line = value->line;
            row->column = value->column;
            list = made ? ceduo_node_inserted(arena, list, list->n, row) : NULL;
        } else {
            list = NULL;
        }
    }
    return list;
}

static const struct node *list_of_rows(struct deriver *d, const struct node *seen)
{
    const struct node *list = seen->kind == NODE_MAP ? ceduo_node_empty(d->arena, NODE_LIST, seen->source) : seen;
    for (size_t i = 0; seen->kind == NODE_MAP && list && i < seen->n; i++)
        list = add_kind(d->arena, list, seen->items[i]);
    return list;
}

/* doubt: {draws: FILE, rows: […]}: the rows are the list that may stand there alone. */
static void arrange_doubt(struct deriver *d)
{
    const struct node *doubt = ceduo_node_get(d->root, "doubt"), *rows = ceduo_node_get(doubt, "rows");
    if (!doubt || doubt->kind != NODE_MAP || !(d->draws = ceduo_node_get(doubt, "draws")))
        return;
    for (size_t i = 0; i < doubt->n; i++)
        if (strcmp(doubt->items[i]->key, "draws") != 0 && strcmp(doubt->items[i]->key, "rows") != 0)
            ceduo_node_problem(d->problems, doubt->items[i], "doubt", _("unknown key; known here: draws, rows"));
    const struct node *root = ceduo_node_without(d->arena, d->root, "doubt");
    root = root && rows ? ceduo_node_with(d->arena, root, "doubt", ceduo_node_renamed(d->arena, rows, "doubt")) : root;
    if (root)
        d->root = root;
    else
        ceduo_problem_memory(d->problems);
}

void ceduo_observed_arrange(struct deriver *d)
{
    arrange_doubt(d);
    const struct node *seen = ceduo_node_get(d->root, "observed");
    if (!seen || seen->kind == NODE_SCALAR)
        return;
    const struct node *list = list_of_rows(d, seen);
    for (size_t i = 0; list && i < list->n; i++) {
        const struct node *row = arrange_row(d, list->items[i]);
        list = row == list->items[i] ? list : row ? ceduo_node_replaced(d->arena, list, i, row) : NULL;
    }
    const struct node *root = list ? ceduo_node_with(d->arena, d->root, "observed", list) : NULL;
    if (root)
        d->root = root;
    else
        ceduo_problem_memory(d->problems);
}

/* ---- values ---- */

/* What kind of value a row holds: the name of its column in a table, if nothing else is said, and its scale. */
struct seen_kind {
    enum ceduo_observed_kind kind;
    const char *path, *list; /* of the row; of its values */
    const char *columns[6];
    double scale;
};

static const struct seen_kind kinds[] = {
    {CEDUO_OBSERVED_STOPS, "stops", "x_m", {"x_m", "distance", "distanza", "progressiva", "x", NULL}, 1},
    {CEDUO_OBSERVED_PASSED, "passed", NULL, {NULL}, 1},
    {CEDUO_OBSERVED_SPEED, "speed", "values", {"speed_m_s", "speed", "velocity", NULL}, 1},
    {CEDUO_OBSERVED_HEIGHT, "height", "values", {"height_m", "height", NULL}, 1},
    {CEDUO_OBSERVED_ENERGY, "energy", "values", {"energy_kJ", "energy", NULL}, 1000},
    {CEDUO_OBSERVED_LARGEST_SPEED, "largest.speed_m_s", "values", {"speed_m_s", "speed", "velocity", NULL}, 1},
    {CEDUO_OBSERVED_LARGEST_HEIGHT, "largest.height_m", "values", {"height_m", "height", NULL}, 1},
    {CEDUO_OBSERVED_WAY_SPEED, "on_the_way.speed_m_s", "values", {"speed_m_s", "speed", "velocity", NULL}, 1},
    {CEDUO_OBSERVED_WAY_HEIGHT, "on_the_way.height_m", "values", {"height_m", "height", NULL}, 1},
    {CEDUO_OBSERVED_WAY_ENERGY, "on_the_way.energy_kJ", "values", {"energy_kJ", "energy", NULL}, 1000},
    {CEDUO_OBSERVED_SCARS, "scars", "height_m", {"height_m", "height", NULL}, 1},
};

/* A row and where it is. */
struct seen_place {
    struct deriver *d;
    const struct seen_kind *kind;
    const char *at; /* observed[0].stops */
    const struct node *node;
};

static const char *within(const struct seen_place *p, const char *key)
{
    return ceduo_derive_text(p->d, "%s.%s", p->at, key);
}

/* The column of a table that holds the values; CEDUO_CSV_NONE where there is none, which is told. */
static size_t find_column(const struct seen_place *p, struct csv *csv, const char *named, const char *key)
{
    const char *const own[] = {named, NULL};
    struct text all = {0};
    size_t known = ceduo_csv_column(csv, p->kind->columns), column = named ? ceduo_csv_column(csv, own) : known;
    csv->source->foreign = known == CEDUO_CSV_NONE;
    size_t n = ceduo_csv_columns(csv, &all);
    if (column == CEDUO_CSV_NONE && !named && n == 1)
        column = 0;
    const char *at = within(p, ceduo_node_get(p->node, key) ? key : "csv");
    if (column == CEDUO_CSV_TWICE)
        ceduo_derive_complain(p->d, at, _("the table has this column twice; rename one: %s"), ceduo_text_string(&all));
    else if (column == CEDUO_CSV_NONE && named)
        ceduo_derive_complain(p->d, at, _("the table has no column '%s'; it has: %s"), named, ceduo_text_string(&all));
    else if (column == CEDUO_CSV_NONE)
        ceduo_derive_complain(p->d, at, _("name the column that holds the values (column); the table has: %s"),
                              ceduo_text_string(&all));
    p->d->problems->memory |= all.failed;
    ceduo_text_free(&all);
    return column == CEDUO_CSV_TWICE ? CEDUO_CSV_NONE : column;
}

/* The rows that are wanted: those with a word in a column; CEDUO_CSV_NONE where all are. False where it is told that this
 * makes no sense. */
static bool find_only(const struct seen_place *p, struct csv *csv, const char *only, size_t *column, const char **word)
{
    const char *equals = only ? strchr(only, '=') : NULL;
    *column = CEDUO_CSV_NONE;
    if (!only)
        return true;
    if (!equals || equals == only) {
        ceduo_derive_complain(p->d, within(p, "only"), _("'%s' is not COLUMN=WORD, such as block=1"), only);
        return false;
    }
    *word = equals + 1;
    *column = find_column(p, csv, ceduo_derive_text(p->d, "%.*s", (int)(equals - only), only), "only");
    return *column != CEDUO_CSV_NONE;
}

static void read_table(const struct seen_place *p, const char *path, struct seen_values *v)
{
    struct deriver *d = p->d;
    struct csv csv;
    struct csv_span field;
    size_t only;
    const char *word = NULL;
    if (!ceduo_csv_open(&csv, d->arena, path, d->problems))
        return;
    size_t column = find_column(p, &csv, v->column, "column");
    if (column == CEDUO_CSV_NONE || !find_only(p, &csv, v->only, &only, &word) ||
        !(v->values = ceduo_bind_take(d->arena, ceduo_csv_lines(&csv), sizeof *v->values, d->problems)))
        return;
    while (ceduo_csv_next(&csv)) {
        bool other = only != CEDUO_CSV_NONE && (!ceduo_csv_field(&csv, only, &field) || !ceduo_csv_is(field, word));
        if (other)
            continue;
        if (!ceduo_csv_field(&csv, column, &field))
            ceduo_problem(d->problems, csv.source, csv.number, 1, _("too few columns"));
        else if (ceduo_csv_number(&csv, field, -1e9, 1e9, "", &v->values[v->values_count], d->problems))
            v->values_count++;
    }
    if (v->values_count == 0)
        ceduo_derive_complain(d, within(p, "csv"), _("the table has no such row"));
}

/* Values from a table, if they are not listed. False where there is a problem. */
static bool take_values(const struct seen_place *p, struct seen_values *v)
{
    struct deriver *d = p->d;
    size_t before = d->problems->met;
    const struct node *csv = ceduo_node_get(p->node, "csv"), *list = ceduo_node_get(p->node, p->kind->list);
    if (csv && list)
        ceduo_derive_complain(d, within(p, "csv"), _("%s already says this; keep one of the two"), p->kind->list);
    else if (csv) {
        const char *path = ceduo_resolve_path(d->arena, csv, "scenes");
        if (path)
            read_table(p, path, v);
        else
            ceduo_derive_complain(d, within(p, "csv"), _("cannot find '%s' beside this file"), csv->text);
    } else if (list && v->values_count == 0)
        ceduo_derive_complain(d, within(p, p->kind->list), _("the list is empty"));
    else if (v->column || v->only)
        ceduo_derive_complain(d, within(p, v->column ? "column" : "only"),
                              _("names something of a table; name the table, csv"));
    return d->problems->met == before;
}

/* Either values, or their mean, sd and number. */
static bool check_form(const struct seen_place *p, const struct seen_values *v)
{
    int means = !isnan(v->mean) + !isnan(v->sd) + (v->n > 0);
    bool listed = v->values_count > 0;
    if (listed && means > 0)
        ceduo_derive_complain(p->d, p->at, _("values and their mean together; keep one"));
    else if (!listed && means < 3)
        ceduo_derive_complain(p->d, p->at,
                              means == 0 ? _("give values, or their mean, sd and n") : _("a mean needs sd and n too"));
    return listed ? means == 0 : means == 3;
}

/* ---- places ---- */

static bool on_slope(const struct seen_place *p, const char *at, double x)
{
    const struct ceduo_slope *s = &p->d->draft.scene.slope;
    double lo = p->d->origin, hi = s->x[s->vertices - 1] + p->d->origin;
    if (isnan(x) || (x >= lo && x <= hi))
        return true;
    ceduo_derive_refuse(p->d, at, "",
                        x < lo ? _("%s lies before the slope, which begins at %s m")
                               : _("%s lies beyond the slope, which ends at %s m"),
                        x, x < lo ? lo : hi);
    return false;
}

static bool check_stops(const struct seen_place *p, const struct seen_values *v)
{
    bool good = on_slope(p, within(p, "seen_from_m"), v->seen_from), listed = ceduo_node_get(p->node, "x_m") != NULL;
    for (size_t i = 0; i < v->values_count && good; i++) {
        const char *at = listed ? ceduo_derive_text(p->d, "%s.x_m[%zu]", p->at, i) : within(p, "csv");
        good = on_slope(p, at, v->values[i]);
        if (good && v->values[i] < v->seen_from) {
            ceduo_derive_refuse(p->d, at, "", _("%s lies before seen_from_m, %s"), v->values[i], v->seen_from);
            good = false;
        }
    }
    return good;
}

static bool check_negative(const struct seen_place *p, const struct seen_values *v)
{
    for (size_t i = 0; i < v->values_count; i++)
        if (v->values[i] < 0) {
            ceduo_derive_refuse(p->d,
                                ceduo_node_get(p->node, "csv") ? within(p, "csv")
                                                               : ceduo_derive_text(p->d, "%s.%s[%zu]", p->at, p->kind->list, i),
                                "", _("%s is below 0"), v->values[i], 0);
            return false;
        }
    return true;
}

/* More seen than released. */
static bool check_released(const struct seen_place *p, const struct seen_values *v)
{
    uint64_t seen = p->kind->kind == CEDUO_OBSERVED_PASSED ? v->count : v->values_count;
    if (v->of == 0 || seen <= v->of)
        return true;
    ceduo_derive_complain(p->d, within(p, "of"), _("%llu were seen of %llu released"), (unsigned long long)seen,
                          (unsigned long long)v->of);
    return false;
}

/* A control where rocks pass, beyond the release. */
static bool check_place(const struct seen_place *p, double x, const struct ceduo_release *release)
{
    double last = ceduo_number_highest(release->x) + p->d->origin;
    if (!on_slope(p, within(p, "x_m"), x))
        return false;
    if (x > last)
        return true;
    ceduo_derive_refuse(p->d, within(p, "x_m"), "", _("%s does not lie beyond the release, %s m"), x, last);
    return false;
}

static bool check_stretch(const struct seen_place *p, const char *at, double from, double to)
{
    if (!on_slope(p, ceduo_derive_text(p->d, "%s.from_m", at), from) ||
        !on_slope(p, ceduo_derive_text(p->d, "%s.to_m", at), to))
        return false;
    if (to <= from)
        ceduo_derive_refuse(p->d, at, ".to_m", _("%s does not lie beyond from_m, %s"), to, from);
    return to > from;
}

/* ---- rows ---- */

static struct seen_values *values_of(struct seen *row, enum ceduo_observed_kind kind)
{
    struct seen_values *const all[] = {&row->stops,      &row->passed,        &row->speed,          &row->height,
                                       &row->energy,     &row->largest_speed, &row->largest_height, &row->way_speed,
                                       &row->way_height, &row->way_energy,    &row->scars};
    return all[kind];
}

static bool is_on_way(enum ceduo_observed_kind kind)
{
    return kind >= CEDUO_OBSERVED_WAY_SPEED && kind <= CEDUO_OBSERVED_WAY_ENERGY;
}

static bool check_values(const struct seen_place *p, const char *row_path, const struct seen *row, struct seen_values *v,
                         const struct ceduo_release *release)
{
    switch (p->kind->kind) {
    case CEDUO_OBSERVED_STOPS:
        return check_stops(p, v) && check_released(p, v);
    case CEDUO_OBSERVED_PASSED:
        return check_place(p, v->x, release) && check_released(p, v);
    case CEDUO_OBSERVED_SCARS:
        return check_stretch(p, p->at, v->from, v->to) && check_negative(p, v); /* a rock may leave several */
    case CEDUO_OBSERVED_SPEED:
    case CEDUO_OBSERVED_HEIGHT:
    case CEDUO_OBSERVED_ENERGY:
        return check_form(p, v) && check_place(p, v->x, release) && check_negative(p, v);
    default:
        return check_form(p, v) && check_negative(p, v) &&
               (!is_on_way(p->kind->kind) ||
                check_stretch(p, ceduo_derive_text(p->d, "%s.on_the_way", row_path), row->way_from, row->way_to));
    }
}

static const char *made_name(struct deriver *d, const struct seen_kind *k, const struct seen_values *v, const struct seen *row)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
    if (k->kind >= CEDUO_OBSERVED_PASSED && k->kind <= CEDUO_OBSERVED_ENERGY)
        return ceduo_derive_text(d, "%s at %s m", k->path, ceduo_number_shortest(v->x, a));
    if (is_on_way(k->kind))
        return ceduo_derive_text(d, "%s %s-%s m", k->path, ceduo_number_shortest(row->way_from, a),
                                 ceduo_number_shortest(row->way_to, b));
    return k->path;
}

static void put_observation(const struct seen_place *p, const struct seen *row, struct seen_values *v,
                            struct ceduo_observation *o)
{
    double scale = p->kind->scale, origin = p->kind->kind == CEDUO_OBSERVED_STOPS ? p->d->origin : 0;
    for (size_t i = 0; i < v->values_count; i++)
        v->values[i] = v->values[i] * scale - origin;
    gsl_sort(v->values, 1, v->values_count);
    o->kind = p->kind->kind;
    o->named = row->name != NULL;
    o->name = row->name ? row->name : made_name(p->d, p->kind, v, row);
    o->x = v->x - p->d->origin;
    o->from = (is_on_way(o->kind) ? row->way_from : o->kind == CEDUO_OBSERVED_STOPS ? v->seen_from : v->from) - p->d->origin;
    o->to = (is_on_way(o->kind) ? row->way_to : v->to) - p->d->origin;
    o->values = v->values_count > 0 ? v->values : NULL;
    o->n = v->values_count > 0 ? v->values_count : (size_t)v->n;
    o->mean = v->mean * scale;
    o->sd = v->sd * scale;
    o->count = v->count;
    o->of = v->of;
    o->share_seen = v->share_seen;
}

/* The option of a row. */
static bool find_option(struct deriver *d, const char *at, const struct seen *row, size_t *option)
{
    const struct ceduo_scene *s = &d->draft.scene;
    for (*option = 0; *option < s->options_count; ++*option)
        if (!row->option || (s->options[*option].name && strcmp(s->options[*option].name, row->option) == 0))
            return true;
    struct text all = {0};
    for (size_t i = 0; i < s->options_count; i++)
        ceduo_text_then(&all, i > 0 ? ", " : "", "%s", s->options[i].name ? s->options[i].name : "");
    if (row->option)
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.option", at), _("the scene has no option '%s'; it has: %s"),
                              row->option, ceduo_text_string(&all));
    ceduo_text_free(&all);
    return false;
}

/* What all observations of a row share. False where it cannot be known. */
static bool derive_beside(struct deriver *d, const char *at, const struct node *node, struct seen *row,
                          struct ceduo_observation *o)
{
    size_t before = d->problems->met;
    *o = (struct ceduo_observation){.use = (enum ceduo_observed_use)row->use};
    if (ceduo_node_get(node, "rock")) {
        const char *rock = ceduo_derive_text(d, "%s.rock", at);
        ceduo_derive_rock(d, rock, ceduo_node_get(node, "rock"), &row->rock);
        o->rock = &row->rock;
    }
    if (ceduo_node_get(node, "release")) {
        ceduo_derive_release(d, ceduo_derive_text(d, "%s.release", at), &row->release);
        o->release = &row->release;
    }
    return find_option(d, at, row, &o->option) && d->problems->met == before;
}

/* The node at a path such as largest.speed_m_s below a row. */
static const struct node *kind_at(const struct node *row, const char *path)
{
    const char *dot = strchr(path, '.');
    for (size_t i = 0; i < row->n && dot; i++)
        if (strncmp(row->items[i]->key, path, (size_t)(dot - path)) == 0)
            return ceduo_node_get(row->items[i], dot + 1);
    return dot ? NULL : ceduo_node_get(row, path);
}

static void derive_row(struct deriver *d, size_t i)
{
    struct seen *row = &d->draft.seen[i];
    const char *at = ceduo_derive_text(d, "observed[%zu]", i);
    const struct node *node = ceduo_node_get(d->root, "observed")->items[i];
    struct ceduo_observation shared;
    bool found = false;
    bool good = derive_beside(d, at, node, row, &shared);
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        const struct node *values = kind_at(node, kinds[k].path);
        struct seen_values *v = values_of(row, kinds[k].kind);
        const struct seen_place p = {d, &kinds[k], ceduo_derive_text(d, "%s.%s", at, kinds[k].path), values};
        if (!values)
            continue;
        found = true;
        const struct ceduo_release *release = shared.release ? shared.release : &d->draft.scene.release;
        if ((kinds[k].list == NULL || take_values(&p, v)) && check_values(&p, at, row, v, release) && good) {
            struct ceduo_observation *o = &d->observations[d->observations_count++];
            *o = shared;
            put_observation(&p, row, v, o);
        }
    }
    if (!found)
        ceduo_derive_complain(d, at,
                              _("say what was seen: stops, passed, speed, height, energy, largest, on_the_way or scars"));
}

static void check_names(struct deriver *d)
{
    for (size_t i = 0; i < d->draft.seen_count; i++)
        for (size_t k = 0; k < i; k++) {
            const char *name = d->draft.seen[i].name, *other = d->draft.seen[k].name;
            if (name && other && strcmp(name, other) == 0)
                ceduo_derive_complain(d, ceduo_derive_text(d, "observed[%zu].name", i),
                                      _("'%s' is given twice; names must differ"), name);
        }
}

void ceduo_derive_observed(struct deriver *d)
{
    size_t n = d->draft.seen_count;
    if (n == 0 || !ceduo_derive_sound(d, "observed") || !d->profile || ceduo_derive_too_many(d, "observed", n))
        return;
    d->observations = ceduo_bind_take(d->arena, n * sizeof kinds / sizeof kinds[0], sizeof *d->observations, d->problems);
    for (size_t i = 0; d->observations && i < n; i++)
        derive_row(d, i);
    check_names(d);
}
