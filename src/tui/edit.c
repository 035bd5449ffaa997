/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Editing of the field under the cursor, and of list items: belts, controls, segments, cohorts, classes. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "popup.h"
#include "scene/material.h"
#include "scene/slope.h"
#include "view/value_text.h"

/* Return the path of the value that a cell shows: for a text with an Italian translation, the translation in Italian. The path
 * is a copy, because an edit rebuilds the form. */
static const char *shown_path(const struct app *app, const struct form_cell *cell)
{
    const char *path = ceduo_app_format(app, "%s", cell->path), *italian = ceduo_app_format(app, "%s_it", path);
    bool has_both = cell->field->type == FIELD_TEXT && cell->given && ceduo_document_node(&app->document, italian);
    return has_both ? ceduo_in_language(path, italian) : path;
}

static bool set_cell_value(struct app *app, const struct form_cell *cell, const char *value)
{
    const struct field *field = cell->field;
    const char *path = shown_path(app, cell);
    const struct node *node = ceduo_document_node(&app->document, path);
    LOCAL_TEXT(written);
    if (field->type == FIELD_TEXT && strcmp(value, node && node->kind == NODE_SCALAR ? node->text : cell->written) == 0)
        return true;      /* an unchanged text is no edit */
    if (value[0] == '\0') /* empty: back to the default */
        return ceduo_app_finish_edit(app, ceduo_document_delete(&app->document, path));
    if (field->type == FIELD_TEXT || field->type == FIELD_FILE)
        ceduo_emit_scalar(&written, value, true);
    else
        ceduo_input_parse_value(field, value, &written);
    if (ceduo_app_set(app, path, ceduo_text_string(&written)))
        return true;
    const struct problem *p = app->document.problems.wrong.items; /* the label of the field replaces its path */
    if (p->path && (strpbrk(p->path, "_.[") || strcmp(p->path, field->key) == 0))
        ceduo_app_warn(app, "%s: %s", _(field->shown.label), p->message);
    return false;
}

static bool submit_field(struct app *app, struct popup *p)
{
    const struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    struct line *line = &p->fields[0].line;
    return !cell || (ceduo_popup_confirm_unusual(app, cell->field, line) && set_cell_value(app, cell, line->text));
}

static void report_no_item(struct app *app)
{
    ceduo_app_show_message(app, "%s", _("put the cursor on an item of a list first"));
}

/* Return the cell under the cursor of the form; NULL, with a message, if there is none or if the keys act on a picture. */
static struct form_cell *find_cell(struct app *app)
{
    struct form_cell *cell = ceduo_app_state(app)->pane == 0 ? ceduo_form_cell(ceduo_app_form(app)) : NULL;
    if (!cell)
        report_no_item(app);
    return cell;
}

/* Edit the whole value: the form may show it shortened or in words. */
void ceduo_edit_start(struct app *app)
{
    struct form_cell *cell = find_cell(app);
    if (!cell)
        return;
    if (cell->field->type == FIELD_CHOICE || (cell->field->flags & FIELD_FOLLOWS)) {
        ceduo_popup_list_choices(app, cell);
        return;
    }
    const struct node *node = ceduo_document_node(&app->document, shown_path(app, cell));
    LOCAL_TEXT(text);
    bool plain = node && node->kind == NODE_LIST; /* a list of scalars, with blanks */
    for (size_t i = 0; plain && i < node->n; i++)
        plain = node->items[i]->kind == NODE_SCALAR;
    if (node && node->kind == NODE_SCALAR)
        ceduo_format_value(cell->field, node->text, &text);
    else if (node && cell->field->type != FIELD_SPREAD && !plain)
        ceduo_emit_flow(&text, node);
    else
        ceduo_text_append(&text, cell->text);
    struct popup *p = ceduo_popup_fields(app, "", "", submit_field);
    p->kind = POPUP_FIELD;
    ceduo_popup_add_field(p, "", ceduo_text_string(&text));
}

void ceduo_edit_step(struct app *app, int direction)
{
    struct form_cell *cell = find_cell(app);
    LOCAL_TEXT(value);
    if (!cell)
        return;
    if (!ceduo_form_step(ceduo_app_form(app), direction, &value) || !value.bytes)
        ceduo_app_show_message(app, "%s", _("this field has no steps; Enter edits it"));
    else if (strcmp(value.bytes, cell->text) == 0)
        ceduo_app_show_message(app, "%s", _("limit of the range reached"));
    else
        set_cell_value(app, cell, value.bytes);
}

/* ==== items ==== */

/* The item under the cursor. Its strings are copied, because each edit rebuilds the form. */
struct item {
    const char *list; /* path of the list */
    const char *key;  /* last word of that path */
    size_t index;
    bool exists;       /* false: the list is empty */
    const char *group; /* the only group of the item that is edited; NULL: the whole item */
    double x;          /* m along the slope, as in the file; NAN: split in the middle */
};

static struct item make_item(const struct app *app, const char *list, size_t index)
{
    list = ceduo_app_format(app, "%s", list);
    const char *dot = strrchr(list, '.');
    return (struct item){.list = list, .key = dot ? dot + 1 : list, .index = index, .exists = true, .x = NAN};
}

/* Find the item under the cursor. `must_exist`: reject the line of an empty list. */
static bool find_item(struct app *app, struct item *item, bool exists)
{
    const struct form_row *row = ceduo_form_row(ceduo_app_form(app));
    bool has_item = row && row->list[0] && ceduo_app_state(app)->pane == 0;
    if (!has_item || (exists && row->n == 0)) {
        report_no_item(app);
        return false;
    }
    *item = make_item(app, row->list, row->index);
    item->exists = row->n > 0;
    item->group = row->group;
    return true;
}

/* ---- splitting ---- */

/* Return the place at `list[index].key`; NaN: none. */
static double get_place(const struct app *app, const struct item *item, size_t index, const char *key)
{
    return ceduo_document_get_place(&app->document, ceduo_app_format(app, "%s[%zu].%s", item->list, index, key));
}

/* Copy an item. `ends`: from_m and to_m of the item, then of the copy; NaN: unchanged. */
static bool copy_with_ends(struct app *app, const struct item *item, const double ends[4])
{
    struct changes c = {.document = &app->document};
    for (size_t i = 0; i < 4; i++)
        if (!isnan(ends[i]))
            ceduo_changes_set(&c,
                              ceduo_app_format(app, "%s[%zu].%s", item->list, item->index + i / 2, i % 2 ? "to_m" : "from_m"),
                              "%.10g", ends[i]);
    return ceduo_document_duplicate(&app->document, item->list, item->index, &c);
}

/* Split an item with from_m and to_m into two, because two items cannot overlap. */
static bool split_stretch(struct app *app, const struct item *item)
{
    double middle = (get_place(app, item, item->index, "from_m") + get_place(app, item, item->index, "to_m")) / 2;
    middle = isnan(item->x) ? middle : item->x;
    return copy_with_ends(app, item, (const double[]){NAN, middle, middle, NAN});
}

/* Insert a point into a segment of the profile at x (NAN: in its middle). */
static bool split_profile(struct app *app, size_t segment, bool split_ground, double x)
{
    const struct node *vertices = ceduo_document_node(&app->document, "slope.vertices_m");
    if (!vertices || segment + 1 >= vertices->n) {
        ceduo_app_warn(app, "%s", _("the profile is a CSV file: edit its points there"));
        return false;
    }
    double px[2], pz[2];
    for (size_t i = 0; i < 2; i++) {
        px[i] = ceduo_node_item_number(vertices->items[segment + i], 0);
        pz[i] = ceduo_node_item_number(vertices->items[segment + i], 1);
    }
    x = isnan(x) ? (px[0] + px[1]) / 2 : x;
    double height = pz[0] + (x - px[0]) / (px[1] - px[0]) * (pz[1] - pz[0]);
    return !isnan(height) && ceduo_document_split_segment(&app->document, segment,
                                                          ceduo_app_format(app, "[%.10g, %.10g]", x, height), split_ground);
}

size_t ceduo_items_find_segment(const struct app *app, double x_written)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    const struct node *vertices = ceduo_document_node(&app->document, "slope.vertices_m");
    size_t j =
        vertices ? 0 : ceduo_slope_segment(s, ceduo_slope_mirrored(s, x_written) - s->origin_x); /* profile from a CSV file */
    while (vertices && j + 2 < vertices->n && x_written >= ceduo_node_item_number(vertices->items[j + 1], 0))
        j++;
    return !vertices && s->reversed ? s->vertices - 2 - j : j;
}

/* Split a segment into two with separate grounds; if all share one ground, split at `x` or in the middle of the slope. */
static bool split_segment(struct app *app, const struct item *item)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    const struct node *segments = ceduo_document_node(&app->document, "slope.segments");
    double x = isnan(item->x) ? s->origin_x + s->x[s->vertices - 1] / 2 : item->x;
    size_t segment = segments && segments->n == 1 ? ceduo_items_find_segment(app, x) : item->index;
    return split_profile(app, segment, true, item->x);
}

/* Insert a point after this one; before the last one. */
static bool split_point(struct app *app, const struct item *item)
{
    const struct node *vertices = ceduo_document_node(&app->document, "slope.vertices_m");
    bool last = vertices && item->index > 0 && item->index + 1 == vertices->n;
    return split_profile(app, item->index - last, false, item->x);
}

/* ---- adding ---- */

static bool insert_new_item(struct app *app, const struct item *item, size_t index, const char *yaml)
{
    return ceduo_document_insert(&app->document, item->list, index, yaml);
}

#define BELT_MIN 0.5 /* m; no shorter belt is added */

/* Split a belt. At its end, if there is space, copy it down to the next control, the next belt or the end of the slope. */
static bool add_belt(struct app *app, const struct item *item)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(app);
    size_t next = item->exists ? item->index + 1 : 0;
    double from = item->exists ? o->belts[item->index].to : s->release.x.mean;
    double to = next < o->belts_count ? o->belts[next].from : s->slope.x[s->slope.vertices - 1];
    if (item->exists && !(to - from > BELT_MIN && ceduo_app_form(app)->column == 1))
        return split_stretch(app, item);
    for (size_t i = 0; i < s->controls_count; i++)
        to = s->controls[i].x - from > BELT_MIN ? fmin(to, s->controls[i].x) : to;
    from += s->slope.origin_x;
    to += s->slope.origin_x;
    if (!item->exists)
        return insert_new_item(app, item, 0,
                               ceduo_app_format(app, "{from_m: %.10g, to_m: %.10g, stand: simple-coppice}", from, to));
    return copy_with_ends(app, item, (const double[]){NAN, NAN, from, to});
}

/* Split a ground. Without grounds, add the assumed one from the library. */
static bool add_ground(struct app *app, const struct item *item)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    if (item->exists)
        return split_stretch(app, item);
    return insert_new_item(app, item, 0,
                           ceduo_app_format(app, "{from_m: %.10g, to_m: %.10g, material: %s}", s->origin_x,
                                            s->origin_x + s->x[s->vertices - 1], ceduo_material_talus()->name));
}

static bool add_control(struct app *app, const struct item *item)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    double last = 0, end = s->slope.x[s->slope.vertices - 1], start = s->release.x.mean + s->release.x.spread * 3;
    for (size_t i = 0; i < s->controls_count; i++)
        last = fmax(last, s->controls[i].x);
    double x = (last < end ? (last + end) / 2 : (start + s->controls[0].x) / 2) + s->slope.origin_x;
    x = isnan(item->x) ? x : item->x;
    bool plain = strcmp(item->key, "controls_m") == 0;
    return insert_new_item(app, item, SIZE_MAX, ceduo_app_format(app, "%s%.6g%s", plain ? "" : "{x_m: ", x, plain ? "" : "}"));
}

static bool copy_item(struct app *app, const struct item *item)
{
    return item->exists && ceduo_document_duplicate(&app->document, item->list, item->index, NULL);
}

/* Add a cohort. The first one also needs stools. */
static bool add_shoots(struct app *app, const struct item *item)
{
    if (item->exists)
        return copy_item(app, item);
    struct changes c = {.document = &app->document};
    ceduo_changes_set(&c, ceduo_app_format(app, "%.*sstools", (int)(item->key - item->list), item->list),
                      "{per_ha: 2500, spacing_m: 0.35}");
    ceduo_changes_set(&c, item->list, "[{per_stool: 3, dbh_m: 0.07, height_m: 8}]");
    return ceduo_changes_apply(&c, item->list);
}

static bool add_trees(struct app *app, const struct item *item)
{
    return item->exists ? copy_item(app, item) : insert_new_item(app, item, 0, "{per_ha: 60, dbh_m: 0.2, height_m: 12}");
}

/* Ask for a class of blocks. Propose the next larger class, ten times rarer, if there is one already. */
static bool ask_block_class(struct app *app, const struct item *item)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    const struct ceduo_size_class *largest = NULL;
    for (size_t i = 0; i < s->blocks_count; i++)
        if (s->blocks[i].volumes[1] > (largest ? largest->volumes[1] : 0))
            largest = &s->blocks[i];
    const char *const offered[] = {
        largest ? ceduo_number_localize(ceduo_app_format(app, "%.4g", largest->per_year / 10)) : "",
        largest ? ceduo_number_localize(ceduo_app_format(app, "%.10g %.10g", largest->volumes[1], 10 * largest->volumes[1]))
                : ""};
    ceduo_popup_new_item(app, item->list, NULL, offered, 2);
    app->popup->title = _("New class of blocks");
    return false;
}

void ceduo_items_add_blocks(struct app *app)
{
    const struct item item = make_item(app, "blocks", 0);
    ask_block_class(app, &item);
}

/* ---- deleting ---- */

/* Delete an item: a segment with a vertex, the last shoots with their stools. A neighbour fills the gap of a ground. */
/* Scale the shares of releases so that they add up to 1 without one of them. */
static void scale_shares(struct changes *c, const struct ceduo_release *releases, size_t n, size_t without)
{
    double rest = 0;
    for (size_t i = 0; i < n; i++)
        rest += i == without ? 0 : releases[i].share;
    for (size_t i = 0; i < n; i++) {
        char path[64];
        snprintf(path, sizeof path, "release[%zu].share", i);
        if (i != without)
            ceduo_changes_set(c, path, "%.4g", releases[i].share / rest);
    }
}

static bool remove_item(struct app *app, const struct item *item, const char *path)
{
    const struct node *list = ceduo_document_node(&app->document, item->list);
    const struct node *vertices = ceduo_document_node(&app->document, "slope.vertices_m");
    struct changes c = {.document = &app->document};
    size_t n = list ? list->n : 0, index = item->index, last = vertices && vertices->n > 0 ? vertices->n - 1 : 0;
    if (strcmp(item->list, "slope.segments") == 0)
        return ceduo_document_remove_vertex(&app->document, index + (index + 1 < last), index);
    if (list && list == vertices)
        return ceduo_document_remove_vertex(&app->document, index, index - (index > 0 && index >= last));
    if (item->group && list && list->items[index]->n > 1 + !!ceduo_node_get(list->items[index], "name"))
        path = ceduo_app_format(app, "%s.%s", path, item->group);
    else if ((item->group || strcmp(item->list, "blocks") == 0 || strcmp(item->list, "release") == 0 ||
              strcmp(item->key, "shoots") == 0) &&
             n == 1)
        path = item->list;
    else if (strcmp(item->list, "release") == 0)
        scale_shares(&c, app->document.file.scene.releases, n, index);
    if (strcmp(item->key, "materials") == 0 && n > 1) {
        const char *end = index == 0 ? "from_m" : "to_m";
        ceduo_changes_set(&c, ceduo_app_format(app, "%s[%zu].%s", item->list, index == 0 ? 1 : index - 1, end), "%.10g",
                          get_place(app, item, index, end));
    } else if (strcmp(item->key, "shoots") == 0 && n == 1) {
        ceduo_changes_add(&c, CHANGE_DELETE,
                          ceduo_app_format(app, "%.*s.stools", (int)(item->key - item->list) - 1, item->list), NULL);
    }
    ceduo_changes_add(&c, CHANGE_DELETE, path, NULL);
    return ceduo_changes_apply(&c, item->list);
}

/* ---- the actions ---- */

typedef bool item_function(struct app *app, const struct item *item);

/* Functions that add and duplicate items; otherwise the item under the cursor is copied. */
static const struct {
    const char *key;
    item_function *add, *duplicate;
} item_kinds[] = {{"forest", add_belt, split_stretch},        {"controls", add_control, add_control},
                  {"controls_m", add_control, add_control},   {"materials", add_ground, split_stretch},
                  {"segments", split_segment, split_segment}, {"vertices_m", split_point, split_point},
                  {"shoots", add_shoots, copy_item},          {"trees", add_trees, copy_item},
                  {"blocks", ask_block_class, copy_item}};

/* Add or duplicate an item. The cursor goes to the new item, or to the last of the list. */
static void make_new_item(struct app *app, const struct item *item, bool add)
{
    item_function *handler = copy_item;
    for (size_t i = 0; i < sizeof item_kinds / sizeof item_kinds[0]; i++)
        if (strcmp(item_kinds[i].key, item->key) == 0)
            handler = add ? item_kinds[i].add : item_kinds[i].duplicate;
    ceduo_problems_free(&app->document.problems);
    bool good = handler(app, item);
    if (!good && app->document.problems.met == 0 && (app->message[0] || app->popup))
        return; /* reported, or a popup is open */
    if (ceduo_app_finish_edit(app, good))
        ceduo_form_go_to_item(ceduo_app_form(app), item->list, item->exists ? item->index + 1 : 0);
}

void ceduo_items_add(struct app *app)
{
    struct item item;
    if (!find_item(app, &item, false))
        return;
    make_new_item(app, &item, true);
    if (strcmp(item.key, "forest") == 0 && !app->message[0])
        ceduo_app_show_message(app, "%s", _("new belt: p chooses its stand, c enters a sample plot"));
}

void ceduo_items_add_at(struct app *app, const char *list, size_t index, double x)
{
    struct item item = make_item(app, list, index);
    item.x = x;
    make_new_item(app, &item, false);
}

void ceduo_items_delete(struct app *app)
{
    struct item item;
    if (!find_item(app, &item, true))
        return;
    const struct node *list = ceduo_document_node(&app->document, item.list);
    const char *path = ceduo_app_format(app, "%s[%zu]", item.list, item.index);
    if (list && list->n == 1 && strcmp(item.list, "controls") == 0) {
        ceduo_app_show_message(app, "%s", _("the only control cannot be deleted"));
    } else if (ceduo_app_finish_edit(app, remove_item(app, &item, path))) {
        const struct form_row *row = ceduo_form_row(ceduo_app_form(app));
        if (row && strcmp(row->list, item.list) != 0) /* stay in this list, so that repeating d is safe */
            ceduo_form_move(ceduo_app_form(app), -1, 0);
        ceduo_app_show_message(app, _("deleted: %s; u undoes"), ceduo_app_path(app, path));
    }
}

void ceduo_items_duplicate(struct app *app)
{
    struct item item;
    if (find_item(app, &item, true))
        make_new_item(app, &item, false);
}

void ceduo_items_move(struct app *app, int step)
{
    struct item item;
    if (!find_item(app, &item, true) || (step < 0 && item.index == 0))
        return;
    size_t to = item.index + (size_t)step;
    if (ceduo_app_finish_edit(app, ceduo_document_move(&app->document, item.list, item.index, to)))
        ceduo_form_move(ceduo_app_form(app), step, 0);
}

/* ==== a new item: one field for each key of the schema ==== */

/* Append an item. A single power law of blocks becomes the first class. The first blocks replace rocks_per_year. */
static bool append_item(struct app *app, const char *list, const struct node *existing, const char *yaml)
{
    struct changes c = {.document = &app->document};
    LOCAL_TEXT(first);
    if (existing && existing->kind == NODE_LIST)
        return ceduo_document_insert(&app->document, list, existing->n, yaml);
    if (existing)
        ceduo_emit_flow(&first, existing);
    ceduo_text_append(&first, existing ? ", " : "");
    if (strcmp(list, "blocks") == 0)
        ceduo_changes_add(&c, CHANGE_DELETE, "rocks_per_year", NULL);
    ceduo_changes_set(&c, list, "[%s%s]", ceduo_text_string(&first), yaml);
    return ceduo_changes_apply(&c, list);
}

/* `p->target` is the path of the list, `p->context` the group. */
static bool submit_item(struct app *app, struct popup *p)
{
    const char *list = p->target;
    LOCAL_TEXT(item);
    ceduo_text_append(&item, "{");
    for (size_t i = 0; i < p->fields_count; i++) {
        const struct field *f = p->fields[i].value;
        LOCAL_TEXT(value);
        if (!ceduo_popup_read(app, f, &p->fields[i].line, &value))
            return false;
        if (value.length > 0)
            ceduo_text_format(&item, "%s%s: %s", item.length > 1 ? ", " : "", f->key, value.bytes);
    }
    ceduo_text_append(&item, "}");
    bool counted = strcmp(list, "blocks") == 0 && ceduo_document_node(&app->document, "rocks_per_year");
    const char *yaml =
        p->context ? ceduo_app_format(app, "{%s: %s}", p->context, item.bytes) : ceduo_app_format(app, "%s", item.bytes);
    const struct node *existing = ceduo_document_node(&app->document, list);
    size_t n = !existing ? 0 : existing->kind == NODE_LIST ? existing->n : 1;
    if (!ceduo_app_finish_edit(app, append_item(app, list, existing, yaml))) {
        const struct problem *first = app->document.problems.wrong.items;
        if (first->path && strncmp(first->path, list, strlen(list)) == 0) /* path of the rejected item */
            ceduo_app_warn(app, "%s", first->message);
        return false;
    }
    ceduo_form_go_to_item(ceduo_app_form(app), list, n);
    ceduo_app_show_message(
        app, "%s", counted ? _("added; blocks replace rocks_per_year, which is removed; u undoes") : _("added; u undoes"));
    return true;
}

void ceduo_popup_new_item(struct app *app, const char *list, const char *group, const char *const *offered, size_t n)
{
    const struct field *object_field = ceduo_schema_row(list);
    object_field = group ? ceduo_schema_field(object_field->object, group) : object_field;
    struct popup *p = ceduo_popup_fields(app, _(object_field->meaning), list, submit_item);
    p->context = group ? object_field->key : NULL;
    ceduo_text_append(&p->text, _("Separate numbers with blanks. Decimals have a dot or a comma: 41 44.5 52."));
    for (const struct field *f = object_field->object->fields; f < object_field->object->fields + object_field->object->n;
         f++) {
        if (f->type != FIELD_NUMBER && f->type != FIELD_NUMBERS && f->type != FIELD_COUNT && f->type != FIELD_SPREAD)
            continue; /* skip files of values: they are named in the scene's file */
        ceduo_text_format(&p->text, "\n%s: %s", _(f->shown.label), _(f->meaning));
        ceduo_popup_add_value(p, _(f->shown.label), p->fields_count < n ? offered[p->fields_count] : "", f);
    }
}
