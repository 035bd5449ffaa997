/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds, deletes, duplicates and moves items of the list under the cursor: belts, controls, segments, cohorts, classes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/intl.h"
#include "edit.h"
#include "view/typed.h"

/* The item under the cursor, copied because each edit builds the form again. */
struct item {
    char list[FORM_PATH]; /* path of its list */
    const char *key;      /* last word of that path */
    size_t index;
    bool there;           /* false: the list is empty */
};

static bool find_item(struct app *app, struct item *item)
{
    const struct form_row *row = ceduo_form_row(ceduo_app_form(app));
    if (!row || !row->list[0])
        return false;
    snprintf(item->list, sizeof item->list, "%s", row->list);
    const char *dot = strrchr(item->list, '.');
    item->key = dot ? dot + 1 : item->list;
    item->index = row->index;
    item->there = row->n > 0;
    return true;
}

/* ---- adding ---- */

/* The first stretch without forest, and the belt that it lies before; false where the forest fills the slope. */
static bool free_stretch(const struct app *app, double *from, double *to, size_t *index)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(app);
    double origin = app->document.file.scene.slope.origin_x, end = s->slope.x[s->slope.vertices - 1];
    double at = s->release.x.mean;
    for (size_t i = 0; i <= o->belts_count; i++) {
        double next = i < o->belts_count ? o->belts[i].from : end;
        if (next - at > 0.5) {
            *from = at + origin;
            *to = next + origin;
            *index = i;
            return true;
        }
        at = i < o->belts_count ? o->belts[i].to : at;
    }
    return false;
}

static bool add_belt(struct app *app, const struct item *item)
{
    double from, to;
    size_t index;
    char belt[256];
    if (!free_stretch(app, &from, &to, &index)) {
        ceduo_app_warn(app, "%s", _("the belts fill the slope; shorten one, or y splits one in two"));
        return false;
    }
    snprintf(belt, sizeof belt, "{from_m: %.10g, to_m: %.10g, stand: simple-coppice}", from, to);
    return ceduo_document_insert(&app->document, item->list, index, belt, &app->problems);
}

static bool add_control(struct app *app, const struct item *item)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    double last = s->controls[0].x, end = s->slope.x[s->slope.vertices - 1];
    for (size_t i = 1; i < s->controls_count; i++)
        last = s->controls[i].x > last ? s->controls[i].x : last;
    double start = s->release.x.mean + s->release.x.spread * 3;
    double x = last < end ? (last + end) / 2 : (start + s->controls[0].x) / 2;
    char control[64];
    snprintf(control, sizeof control, "{x_m: %.6g}", x + app->document.file.scene.slope.origin_x);
    return ceduo_document_insert(&app->document, item->list, 1000000, control, &app->problems);
}

static bool copy_item(struct app *app, const struct item *item)
{
    return item->there && ceduo_document_duplicate(&app->document, item->list, item->index, &app->problems);
}

/* A first cohort of shoots needs stools to stand on. */
static bool add_shoots(struct app *app, const struct item *item)
{
    if (item->there)
        return copy_item(app, item);
    char stools[FORM_PATH + 64], shoots[FORM_PATH + 64];
    snprintf(stools, sizeof stools, "%.*sstools={per_ha: 2500, spacing_m: 0.35}", (int)(item->key - item->list), item->list);
    snprintf(shoots, sizeof shoots, "%s=[{per_ha: 7500, dbh_m: 0.07, height_m: 8}]", item->list);
    const char *const sets[] = {stools, shoots};
    return ceduo_document_set_all(&app->document, sets, 2, item->list, &app->problems);
}

static bool add_trees(struct app *app, const struct item *item)
{
    return item->there ? copy_item(app, item)
                       : ceduo_document_insert(&app->document, item->list, 0, "{per_ha: 60, dbh_m: 0.2, height_m: 12}",
                                               &app->problems);
}

/* ---- duplicating ---- */

/* A belt is duplicated by splitting it: two cannot stand in one place. */
static bool split_belt(struct app *app, const struct item *item)
{
    const struct ceduo_belt *b = &ceduo_app_option(app)->belts[item->index];
    char first[FORM_PATH + 64], second[FORM_PATH + 64];
    double middle = (b->from_given + b->to_given) / 2;
    snprintf(first, sizeof first, "%s[%zu].to_m=%.10g", item->list, item->index, middle);
    snprintf(second, sizeof second, "%s[%zu].from_m=%.10g", item->list, item->index + 1, middle);
    return ceduo_document_split(&app->document, item->list, item->index, first, second, &app->problems);
}

/* A segment is split in two of the same ground. */
static bool split_segment(struct app *app, const struct item *item)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    size_t i = item->index;
    char vertex[96];
    if (!ceduo_document_node(&app->document, "slope.vertices_m"))
        return false;
    snprintf(vertex, sizeof vertex, "[%.10g, %.10g]", (s->x[i] + s->x[i + 1]) / 2 + s->origin_x,
             (s->z[i] + s->z[i + 1]) / 2 + s->origin_z);
    return ceduo_document_split_segment(&app->document, i, vertex, &app->problems);
}

/* ---- deleting ---- */

/* The stools go with their last shoots. */
static bool delete_shoots(struct app *app, const struct item *item)
{
    char stand[FORM_PATH], stools[FORM_PATH + 8];
    snprintf(stand, sizeof stand, "%.*s", (int)(item->key - item->list) - 1, item->list);
    snprintf(stools, sizeof stools, "%s.stools", stand);
    const char *const sets[] = {stools, item->list};
    return ceduo_document_set_all(&app->document, sets, 2, stand, &app->problems);
}

static bool delete_item(struct app *app, const struct item *item, const char *path)
{
    const struct node *list = ceduo_document_node(&app->document, item->list);
    if (strcmp(item->list, "slope.segments") == 0)
        return ceduo_document_join_segments(&app->document, item->index, &app->problems);
    if (strcmp(item->key, "shoots") == 0 && list && list->n == 1)
        return delete_shoots(app, item);
    return ceduo_document_delete(&app->document, path, &app->problems);
}

/* The cursor must not slip into the next list, where another d would delete what nobody meant. */
static void stay_in_list(struct app *app, const char *list)
{
    const struct form_row *row = ceduo_form_row(ceduo_app_form(app));
    if (row && strcmp(row->list, list) != 0)
        ceduo_form_move(ceduo_app_form(app), -1, 0);
}

/* ---- the actions ---- */

typedef bool item_function(struct app *app, const struct item *item);

/* How items are added and duplicated, where not by a copy of the one under the cursor. */
static const struct {
    const char *key;
    item_function *add, *duplicate;
} kinds[] = {{"forest", add_belt, split_belt},
             {"controls", add_control, add_control},
             {"segments", copy_item, split_segment},
             {"shoots", add_shoots, copy_item},
             {"trees", add_trees, copy_item}};

static item_function *function_for(const struct item *item, bool add)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(kinds[i].key, item->key) == 0)
            return add ? kinds[i].add : kinds[i].duplicate;
    return copy_item;
}

void ceduo_items_add(struct app *app)
{
    struct item item;
    if (!find_item(app, &item)) {
        ceduo_app_say(app, "%s", _("a adds to a list: put the cursor on one"));
        return;
    }
    bool good = function_for(&item, true)(app, &item);
    if (!good && app->problems.count == 0 && !app->problems.memory)
        return; /* it is said already */
    if (ceduo_app_edited(app, good))
        ceduo_form_move(ceduo_app_form(app), 1, 0);
}

void ceduo_items_delete(struct app *app)
{
    struct item item;
    char path[FORM_PATH + 32];
    if (!find_item(app, &item) || !item.there) {
        ceduo_app_say(app, "%s", _("d deletes an item of a list: put the cursor on one"));
        return;
    }
    snprintf(path, sizeof path, "%s[%zu]", item.list, item.index);
    if (ceduo_app_edited(app, delete_item(app, &item, path))) {
        struct text words = {0};
        stay_in_list(app, item.list);
        ceduo_shown_path(path, &words);
        ceduo_app_say(app, _("deleted: %s; u brings it back"), ceduo_text_string(&words));
        ceduo_text_free(&words);
    }
}

void ceduo_items_duplicate(struct app *app)
{
    struct item item;
    if (!find_item(app, &item) || !item.there)
        ceduo_app_say(app, "%s", _("y duplicates an item of a list: put the cursor on one"));
    else if (ceduo_app_edited(app, function_for(&item, false)(app, &item)))
        ceduo_form_move(ceduo_app_form(app), 1, 0);
}

void ceduo_items_move(struct app *app, int by)
{
    struct item item;
    if (!find_item(app, &item) || !item.there || (by < 0 && item.index == 0))
        return;
    size_t to = item.index + (size_t)by;
    if (ceduo_app_edited(app, ceduo_document_move(&app->document, item.list, item.index, to, &app->problems)))
        ceduo_form_move(ceduo_app_form(app), by, 0);
}
