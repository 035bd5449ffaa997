/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of what there is to choose from: the words of a field, the program's and the user's files. */
#include <stdio.h>
#include <string.h>

#include "base/intl.h"
#include "io/file.h"
#include "ceduo/material.h"
#include "popup.h"
#include "popups.h"
#include "view/typed.h"
#include "scene/words.h"

/* How common a system is: Table 7 of Ciabocco et al. 2009, Marche. */
static const char *how_common(const char *name)
{
    static const char *const texts[] = {
        [CEDUO_SIMPLE_COPPICE] = N_("87 050 ha, 43.4 % of Marche: with reserves"),
        [CEDUO_COPPICE_WITH_STANDARDS] = N_("13 250 ha, 6.6 % of Marche: with standards"),
        [CEDUO_SELECTION_COPPICE] = N_("350 ha, 0.2 % of Marche: selection system"),
        [CEDUO_LARGE_RESERVES] = N_("30 275 ha, 15.1 % of Marche: a lot of reserves"),
        [CEDUO_HIGH_FOREST] = N_("28 550 ha, 14.2 % of Marche: natural high forest")};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        if (strncmp(name, ceduo_system_words.names[i], strlen(ceduo_system_words.names[i])) == 0)
            return _(texts[i]);
    return "";
}

/* Fills a list with the files of a kind ("stands", …), the first of each name. */
static void add_profiles(struct popup *p, const char *kind)
{
    const char *const *folders = ceduo_file_folders(&p->arena);
    for (size_t i = 0; folders && folders[i]; i++) {
        size_t n;
        const char *const *names = ceduo_file_list(&p->arena, folders[i], kind, &n);
        for (size_t k = 0; k < n; k++) {
            char name[128];
            bool known = false;
            snprintf(name, sizeof name, "%.*s", (int)(strlen(names[k]) - 5), names[k]);
            for (size_t m = 0; m < p->items_count; m++)
                known |= strcmp(p->items[m].value, name) == 0;
            char line[256];
            snprintf(line, sizeof line, "%-27s %s", name, how_common(name));
            if (!known)
                ceduo_popup_item(p, line, name);
        }
    }
}

/* What a preset would give, in the lines over the list. */
static void preview_stand(struct app *app, struct popup *p, const char *value)
{
    struct scene_file file = {0};
    struct problems problems = {0};
    struct text yaml = {0};
    ceduo_text_format(&yaml,
                      "{ceduo: scene/1, rock: {diameter_m: 0.68}, slope: {vertices_m: [[0, 10], [100, 0]], segments: "
                      "[{rn: 0.3, rt: 0.8}]}, controls_m: [90], forest: [{from_m: 0, to_m: 100, stand: %s}]}",
                      value);
    ceduo_text_free(&p->text);
    if (yaml.bytes && ceduo_scene_read_text(&file, "preset", yaml.bytes, &problems)) {
        file.scene.rock = app->document.file.scene.rock;
        file.scene.simulation = app->document.file.scene.simulation;
        const struct ceduo_belt *b = &file.scene.options[0].belts[0];
        struct ceduo_stand_result r = ceduo_assess_stand(&file.scene, b);
        ceduo_text_format(&p->text, _("%s: %.0f stools, %.0f stems, %.0f trees per ha; basal area %.1f m2/ha\n"), b->name,
                          r.stools_per_ha, r.stems_per_ha, r.trees_per_ha, r.basal_area);
        if (r.bare)
            ceduo_text_put(&p->text, _("no stems\n"));
        else
            ceduo_text_format(&p->text, _("with this rock: ADC %.3g m by %s, free run %.1f %%, %.3g kJ/100 m (%s)\n"),
                              r.adc_m, ceduo_rule_words.names[r.rule], r.free_run_probability * 100, r.dissipated * KILO,
                              ceduo_rule_words.names[r.rule]);
    }
    ceduo_text_free(&yaml);
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

static void add_stands(struct popup *p)
{
    p->preview = preview_stand;
    ceduo_text_put(&p->text, " "); /* lines for it */
    add_profiles(p, "stands");
}

static void chose_word(struct app *app, struct popup *p, const char *value)
{
    ceduo_app_set(app, p->path, value);
}

/* The option that is shown with another stand in every belt, as a new option. */
static void chose_new_option(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    if (ceduo_app_edited(app, ceduo_document_add_option(&app->document, value, &app->problems))) {
        app->option = app->document.file.scene.options_count - 1;
        ceduo_app_refresh(app);
        ceduo_app_say(app, _("added '%s'; Enter renames it, 2 changes its stand"), ceduo_app_option(app)->name);
    }
}

static void list_stands(struct app *app, const char *title, popup_chosen *chosen)
{
    struct popup *p = ceduo_popup_list(app, title, chosen);
    if (!p)
        return;
    ceduo_app_stand(app, p->path, sizeof p->path);
    add_stands(p);
}

void ceduo_popup_presets(struct app *app)
{
    if (ceduo_app_option(app)->belts_count == 0)
        ceduo_app_say(app, "%s", _("there is no belt yet: a adds one in view 1"));
    else
        list_stands(app, _("Stand of this belt"), chose_word);
}

void ceduo_popup_new_option(struct app *app)
{
    list_stands(app, _("A new option with the stand …"), chose_new_option);
}

static void add_word(struct popup *p, const struct field *f, const char *word)
{
    struct text shown = {0};
    ceduo_shown_value(f, word, &shown);
    ceduo_popup_item(p, ceduo_text_string(&shown), word);
    ceduo_text_free(&shown);
}

void ceduo_popup_choices(struct app *app, const struct form_cell *cell)
{
    const struct field *f = cell->field;
    struct popup *p = ceduo_popup_list(app, cell->path, chose_word);
    if (!p)
        return;
    snprintf(p->path, sizeof p->path, "%s", cell->path);
    if (f->type == FIELD_CHOICE)
        for (size_t i = 0; i < f->choices->n; i++) {
            add_word(p, f, f->choices->names[i]);
            if (strcmp(f->choices->names[i], cell->written) == 0)
                p->at = i;
        }
    else if (f->object == ceduo_schema_stand())
        add_stands(p);
    else
        add_profiles(p, f->object->folder);
}

/* ---- a scene to open ---- */

static bool opened(struct app *app, struct popup *p)
{
    return ceduo_app_open(app, p->fields[0].text);
}

static void chose_scene(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    if (value[0]) {
        ceduo_app_open(app, value);
        return;
    }
    struct popup *q = ceduo_popup_fields(app, _("Open a scene"), opened);
    if (q)
        ceduo_popup_field(q, _("file"), "");
}

void ceduo_popup_open(struct app *app)
{
    if (ceduo_popup_unsaved(app))
        return;
    struct popup *p = ceduo_popup_list(app, _("Open"), chose_scene);
    if (!p)
        return;
    ceduo_popup_item(p, _("a file …"), "");
    add_profiles(p, "scenes");
}
