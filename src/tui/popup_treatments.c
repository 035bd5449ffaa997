/* SPDX-License-Identifier: GPL-3.0-or-later */
/* New options that treat the stands of the option shown: cut now, selection coppice, not cut. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "core/stand/rotation.h"
#include "io/file.h"
#include "popup.h"
#include "scene/stand.h"

#define FIRST_YEAR   1  /* year 0 is the stand as filed */
#define KEPT_USUALLY 60 /* standards per ha, proposed if the stands do not specify how many are retained */

enum treatment { CUT_NOW, SELECTION, NO_CUT, TREATMENTS };

static const struct {
    const char *value, *item, *description;
} treatments[TREATMENTS] = {
    [CUT_NOW] = {":cut", N_("this stand, cut now, leaving N standards per ha"),
                 N_("A copy of the option shown that is cut in year 1 and then once in each rotation. Enter asks how many "
                    "standards a cut leaves.")},
    [SELECTION] = {":selection", N_("this stand as a selection coppice"),
                   N_("A copy of the option shown that is cut as a selection coppice from year 1 on: each cut takes the oldest "
                      "shoots of each stool. From the first cut on each stool has shoots of all ages (assumed).")},
    [NO_CUT] = {":none", N_("this stand, not cut"),
                N_("A copy of the option shown that grows and is not cut. Enter asks for how many years.")}};

static enum treatment find_treatment(const char *value)
{
    enum treatment t = 0;
    while (t < TREATMENTS && strcmp(treatments[t].value, value) != 0)
        t++;
    return t;
}

/* ---- growth and cutting for stands without them ---- */

/* A shipped stand that lends its growth or its cutting. */
struct lender {
    struct scene_file file;
    int fit; /* 0: none found */
};

static const struct ceduo_belt *lent_belt(const struct lender *l)
{
    return &l->file.scene.options[0].belts[0];
}

/* Find the best shipped stand with growth and cutting: by species, hop hornbeam, system. Caller releases l->file. */
static void find_lender(struct app *app, int species, enum ceduo_system system, struct lender *l)
{
    const char *const *folders = ceduo_file_folders(app->scratch);
    int usual = ceduo_species_find("ostrya-carpinifolia");
    *l = (struct lender){.fit = 0};
    for (size_t i = 0; folders && folders[i]; i++) {
        size_t n;
        const char *const *names = ceduo_file_list(app->scratch, folders[i], "stands", &n);
        for (size_t k = 0; k < n; k++) {
            struct scene_file file = {0};
            const char *path = ceduo_app_format(app, "%s/stands/%s.yaml", folders[i], names[k]);
            bool good = ceduo_document_is_shipped(path) && ceduo_popup_read_stand(app, path, &file);
            const struct ceduo_stand *s = good ? &file.scene.options[0].belts[0].stand : NULL;
            bool lends = s && ceduo_stand_grows(s) && s->cutting.rotation > 0;
            int fit = !lends ? 0 : 1 + 4 * (s->species == species) + 2 * (s->species == usual) + (s->system == system);
            if (fit > l->fit) {
                ceduo_scene_release(&l->file);
                *l = (struct lender){file, fit};
            } else {
                ceduo_scene_release(&file);
            }
        }
    }
}

/* ---- changes ---- */

struct plan {
    struct app *app;
    enum treatment kind;
    double number;         /* standards per ha, or years without a cut; NaN: none */
    struct changes edits;  /* paths are relative to the option */
    struct text borrowed;  /* sentences about borrowed growth and cutting */
    struct text untreated; /* sentences about unchanged belts */
    size_t treated;        /* number of treated belts */
};

/* Replace a mapping of the belt's stand by the lender's, marked as assumed. */
static void set_lent(struct plan *p, size_t belt, const struct lender *l, const char *key)
{
    const struct node *map = ceduo_resolve_at(l->file.root, ceduo_app_format(p->app, "forest[0].stand.%s", key));
    LOCAL_TEXT(value);
    ceduo_text_append_char(&value, '{');
    for (size_t i = 0; i < map->n; i++) {
        if (strcmp(map->items[i]->key, "source") == 0)
            continue;
        ceduo_text_format(&value, "%s: ", map->items[i]->key);
        ceduo_emit_flow(&value, map->items[i]);
        ceduo_text_append(&value, ", ");
    }
    const char *source = ceduo_app_format(p->app, _("as in the stand '%s'"), lent_belt(l)->name);
    ceduo_text_format(&value, "source: {kind: assumed, text: %s}}", ceduo_app_scalar(p->app, source));
    ceduo_changes_add(&p->edits, CHANGE_SET, ceduo_app_format(p->app, "forest[%zu].stand.%s", belt, key), value.bytes);
}

/* Append a sentence once. */
static void add_borrowed(struct plan *p, const char *sentence)
{
    if (!strstr(ceduo_text_string(&p->borrowed), sentence))
        ceduo_text_append_joined(&p->borrowed, p->borrowed.length > 0 ? " " : "", "%s", sentence);
}

static void report_lent(struct plan *p, const char *stand, const struct lender *l, bool growth, bool cutting)
{
    add_borrowed(p, ceduo_app_format(p->app,
                                     growth && cutting ? _("Growth and cutting of '%s' are those of '%s' (assumed).")
                                     : growth          ? _("The growth of '%s' is that of '%s' (assumed).")
                                                       : _("The cutting of '%s' is that of '%s' (assumed)."),
                                     stand, lent_belt(l)->name));
}

/* Set the retained standards, with the ages of `model` in proportion. Without ages all are one rotation old. */
static void keep_standards(struct plan *p, size_t belt, const struct ceduo_stand *model)
{
    double total = 0, remaining = p->number;
    LOCAL_TEXT(list);
    for (size_t i = 0; i < model->cutting.retained_count; i++)
        total += model->cutting.stay_per_ha[i];
    for (size_t i = 0; total > 0 && i < model->cutting.retained_count; i++) {
        double share = model->cutting.stay_per_ha[i] / total, own = fmin(remaining, ceil(share * p->number - 1e-9));
        ceduo_text_format(&list, "%s%g", i > 0 ? ", " : "", own);
        remaining -= own;
    }
    if (total == 0)
        ceduo_text_format(&list, "%g", remaining);
    ceduo_changes_set(&p->edits, ceduo_app_format(p->app, "forest[%zu].stand.cutting.stay_per_ha", belt), "[%s]", list.bytes);
}

/* Return the first growth that cuts which leave trees lack. */
static enum cut_lack find_lack(const struct ceduo_stand *stand)
{
    struct ceduo_stand cut = *stand;
    double one = 1;
    cut.cutting = (struct ceduo_cutting){.rotation = 1, .retained_count = 1, .stay_per_ha = &one};
    return ceduo_cut_lack(&cut, FIRST_YEAR);
}

static void leave_belt(struct plan *p, size_t belt, const char *reason)
{
    ceduo_text_append_joined(&p->untreated, p->untreated.length > 0 ? " " : "", _("Belt %zu is unchanged: %s."), belt + 1,
                             reason);
}

static void treat_belt(struct plan *p, size_t i, const struct ceduo_belt *belt)
{
    const struct ceduo_stand *s = &belt->stand;
    enum cut_lack lack = find_lack(s);
    bool never = p->kind == NO_CUT && isnan(p->number), selection = p->kind == SELECTION;
    bool stools = s->stools_per_ha > 0, cut = s->cutting.rotation > 0;
    bool grows = ceduo_stand_grows(s) && (never || lack != CUT_LACKS_SHOOTS);
    bool borrows = selection || (!cut && !never);               /* borrows the cutting */
    bool no_trees = grows && !never && lack == CUT_LACKS_TREES; /* borrows the growth of trees */
    const char *stand = ceduo_app_format(p->app, "forest[%zu].stand", i);
    struct lender l = {.fit = 0};
    if (ceduo_stand_is_bare(s) && !stools)
        return;
    if (!stools && (selection || !cut)) {
        leave_belt(p, i, ceduo_app_format(p->app, _("'%s' has no stools"), belt->name));
        return;
    }
    if (!grows || borrows || no_trees)
        find_lender(p->app, s->species, selection ? CEDUO_SYSTEM_SELECTION_COPPICE : s->system, &l);
    if (l.fit == 0 && (!grows || borrows || no_trees)) { /* the shipped stands are missing */
        leave_belt(p, i, ceduo_app_format(p->app, _("no shipped stand has growth and cutting for '%s'"), belt->name));
        return;
    }
    p->treated++;
    if (!grows)
        set_lent(p, i, &l, "growth");
    if (no_trees)
        set_lent(p, i, &l, "growth.trees");
    if (borrows)
        set_lent(p, i, &l, "cutting");
    if (!grows || borrows)
        report_lent(p, belt->name, &l, !grows, borrows);
    if (no_trees)
        add_borrowed(p, ceduo_app_format(p->app, _("The growth of trees of '%s' is that of '%s' (assumed)."), belt->name,
                                         lent_belt(&l)->name));
    if (selection && grows && s->growth.shoots_old < lent_belt(&l)->stand.growth.shoots_old)
        ceduo_changes_set(&p->edits, ceduo_app_format(p->app, "%s.growth.shoots_old", stand), "%g",
                          lent_belt(&l)->stand.growth.shoots_old);
    if (selection && s->system != CEDUO_SYSTEM_SELECTION_COPPICE) {
        const char *name = ceduo_app_format(p->app, _("%s, as selection coppice"), belt->name);
        ceduo_changes_set(&p->edits, ceduo_app_format(p->app, "%s.system", stand), "selection-coppice");
        ceduo_changes_set(&p->edits, ceduo_app_format(p->app, "%s.name", stand), "%s", ceduo_app_scalar(p->app, name));
    }
    if (p->kind == CUT_NOW && !isnan(p->number))
        keep_standards(p, i, cut ? s : &lent_belt(&l)->stand);
    const char *year = ceduo_app_format(p->app, "forest[%zu].cut_year", i);
    if (never && cut)
        ceduo_changes_add(&p->edits, CHANGE_DELETE, ceduo_app_format(p->app, "%s.cutting", stand), NULL);
    if (!never)
        ceduo_changes_set(&p->edits, year, "%g", FIRST_YEAR + (p->kind == NO_CUT ? p->number : 0));
    else
        ceduo_changes_add(&p->edits, CHANGE_DELETE, year, NULL);
    ceduo_scene_release(&l.file);
}

/* Plan a treatment for each belt of the option shown. The caller frees its texts. */
static struct plan make_plan(struct app *app, enum treatment kind, double number)
{
    const struct ceduo_option *o = ceduo_app_option(app);
    struct plan p = {.app = app, .kind = kind, .number = round(number), .edits = {.document = &app->document}};
    for (size_t i = 0; i < o->belts_count; i++)
        treat_belt(&p, i, &o->belts[i]);
    return p;
}

/* Append the texts of the plan, and free them. */
static void append_plan(struct plan *p, struct text *text)
{
    for (int i = 0; i < 2; i++) {
        struct text *part = i == 0 ? &p->borrowed : &p->untreated;
        if (part->length > 0)
            ceduo_text_append_joined(text, text->length > 0 ? " " : "", "%s", part->bytes);
        ceduo_text_free(part);
    }
}

/* ---- the new option ---- */

static const char *name_option(const struct plan *p)
{
    const struct app *app = p->app;
    const struct ceduo_scene *scene = &app->document.file.scene;
    const char *name = _("selection coppice");
    bool in_use = false;
    if (p->kind == CUT_NOW)
        name = ceduo_app_format(app, _("cut now, keep %g"), p->number);
    else if (p->kind == NO_CUT)
        name = isnan(p->number)
                   ? _("not cut")
                   : ceduo_app_format(app, ngettext("no cut for %g year", "no cut for %g years", p->number == 1 ? 1 : 2),
                                      p->number);
    for (size_t i = 0; i < scene->options_count; i++)
        in_use |= strcmp(scene->options[i].name, name) == 0;
    return in_use ? ceduo_app_format(app, "%s (%s)", name, ceduo_app_option(app)->name) : name;
}

/* The cursor stays on the copied option, which can be treated again. */
static bool add_treated_option(struct app *app, enum treatment kind, double number)
{
    struct plan p = make_plan(app, kind, number);
    LOCAL_TEXT(text);
    bool good = p.treated > 0 &&
                ceduo_app_finish_edit(app, ceduo_document_vary_option(&app->document, app->option, name_option(&p), &p.edits));
    const struct ceduo_scene *scene = &app->document.file.scene;
    if (good)
        ceduo_text_format(&text, _("added '%s'."), scene->options[scene->options_count - 1].name);
    append_plan(&p, &text);
    if (good || p.treated == 0)
        ceduo_app_show_problem(app, !good, "%s", text.bytes ? text.bytes : _("There is no forest here to treat."));
    return good;
}

static bool submit_number(struct app *app, struct popup *p)
{
    double number = NAN;
    return ceduo_popup_number(app, p, 0, &number) && add_treated_option(app, find_treatment(p->target), number);
}

/* Ask for the number of a treatment. */
static void ask_number(struct app *app, enum treatment kind)
{
    const struct ceduo_option *o = ceduo_app_option(app);
    double stay = 0;
    for (size_t i = 0; i < o->belts_count; i++)
        stay = fmax(stay, ceduo_stand_retained_per_ha(&o->belts[i].stand));
    bool cut = kind == CUT_NOW;
    const char *offered = ceduo_app_format(app, "%g", stay > 0 ? round(stay) : KEPT_USUALLY);
    struct popup *p = ceduo_popup_fields(app, _(treatments[kind].item), treatments[kind].value, submit_number);
    struct field *own =
        ceduo_popup_add_value(p, cut ? _("standards kept per ha") : _("years without a cut"), cut ? offered : "",
                              ceduo_schema_at(cut ? "forest[0].stand.trees[0].per_ha" : "forest[0].cut_year"));
    ceduo_text_append(&p->text, cut ? _("Total of all ages, in the proportions of the stand. 0: all stems are cut.")
                                    : _("Cut in the following year. Empty: never cut."));
    own->flags = cut ? FIELD_REQUIRED : 0;
    own->meaning = cut ? N_("0: all stems are cut") : "";
    own->lo = cut ? 0 : 1;
    own->hi = cut ? own->hi : own->hi - FIRST_YEAR;
}

/* ---- items of a list ---- */

void ceduo_popup_offer_treatments(struct app *app, struct popup *p)
{
    if (ceduo_app_option(app)->belts_count > 0)
        for (int t = 0; t < TREATMENTS; t++)
            ceduo_popup_add_item(p, _(treatments[t].item), treatments[t].value);
}

bool ceduo_popup_preview_treatment(struct app *app, struct popup *p)
{
    enum treatment kind = find_treatment(p->value);
    if (kind == TREATMENTS)
        return false;
    struct plan plan = make_plan(app, kind, NAN);
    ceduo_text_append(&p->text, _(treatments[kind].description));
    append_plan(&plan, &p->text);
    return true;
}

bool ceduo_popup_choose_treatment(struct app *app, const char *value)
{
    enum treatment kind = find_treatment(value);
    if (kind == SELECTION)
        add_treated_option(app, kind, NAN);
    else if (kind != TREATMENTS)
        ask_number(app, kind);
    return kind != TREATMENTS;
}
