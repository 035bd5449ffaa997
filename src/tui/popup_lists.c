/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists to choose from: words of a field, shipped and own files; with the effect of each choice on the lights. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "core/runs/assess.h"
#include "io/file.h"
#include "popup.h"
#include "scene/choices.h"
#include "scene/material.h"
#include "view/value_text.h"
#include "view/words.h"

/* ---- one stand ---- */

bool ceduo_popup_read_stand(const struct app *app, const char *value, struct scene_file *file)
{
    LOCAL_PROBLEMS(problems);
    const char *name = app->document.path ? app->document.path : "preset";
    const char *yaml =
        ceduo_app_format(app,
                         "{ceduo: scene/1, rock: {diameter_m: 0.68}, slope: {vertices_m: [[0, 10], [100, 0]], segments: "
                         "[{rn: 0.3, rt: 0.8}]}, controls_m: [90], forest: [{from_m: 0, to_m: 100, stand: %s}]}",
                         ceduo_app_scalar(app, value));
    bool good = ceduo_scene_load_text(file, name, yaml, &problems);
    file->scene.rock = app->document.file.scene.rock;
    file->scene.simulation = app->document.file.scene.simulation;
    return good;
}

/* Describe stems, mean diameter, age, basal area and owner. In Italian, set `*label` to the name of a shipped stand. */
static const char *describe_stand(struct app *app, const char *value, const char *owner, const char **label)
{
    struct scene_file file;
    const char *words = owner;
    if (ceduo_popup_read_stand(app, value, &file)) {
        const struct ceduo_belt *b = &file.scene.options[0].belts[0];
        struct ceduo_stand_result r = ceduo_assess_stand(&file.scene, b);
        double age = NAN, dbh = sqrt(4 * r.basal_area / (M_PI * r.stems_per_ha));
        for (size_t i = 0; i < b->stand.shoots_count; i++)
            age = fmax(age, b->stand.shoots[i].age);
        const char *years = isnan(age) ? "  -" : ceduo_app_format(app, "%3.0f", age);
        words = ceduo_app_format(app, _("%5.0f/ha %4.1f cm %s y %4.1f m2/ha"), r.stems_per_ha, r.bare ? 0 : dbh * 100, years,
                                 r.basal_area);
        if (!owner[0] && ceduo_in_language("", "it")[0])
            *label = ceduo_app_format(app, "%s", b->name);
        words = owner[0] ? ceduo_app_format(app, "%s %s", words, owner) : words;
    }
    ceduo_scene_release(&file);
    return words;
}

/* ---- files ---- */

#define HEADER_BYTES 4096 /* bytes that contain the header of a file */
#define FILES_MAX    500  /* max. files read in the scene's folder */

static bool has_header(const char *path, const char *tag)
{
    char head[HEADER_BYTES + 1];
    FILE *file = fopen(path, "re");
    head[file ? fread(head, 1, HEADER_BYTES, file) : 0] = '\0';
    if (file)
        fclose(file);
    return strstr(head, tag) != NULL;
}

/* Add files of a kind ("stands", …), shipped or the user's. Those in the scene's folder come first; `full_path`: with path. */
static void add_files(struct app *app, struct popup *p, const char *kind, bool shipped, bool full_path, const char *current)
{
    const char *scene = app->document.path && !app->document.shipped ? app->document.path : "", *slash = strrchr(scene, '/');
    const char *own_folder = ceduo_app_format(app, "%.*s", slash ? (int)(slash - scene) + 1 : 0, scene); /* "": current */
    const char *tag = ceduo_app_format(app, "ceduo: %.*s", (int)strlen(kind) - 1, kind);
    const char *const *folders = ceduo_file_folders(&p->arena);
    for (size_t i = shipped; i == 0 || (folders && folders[i - 1]); i++) {
        bool local = i == 0, stands = strcmp(kind, "stands") == 0;
        const char *folder = !local ? folders[i - 1] : own_folder[0] ? own_folder : ".", *owner = shipped ? "" : _("yours");
        size_t n;
        const char *const *names = ceduo_file_list(&p->arena, folder, local ? "." : kind, &n);
        for (size_t k = 0; k < n && !(local && k == FILES_MAX); k++) {
            const char *path = local ? ceduo_app_format(app, "%s%s.yaml", own_folder, names[k])
                                     : ceduo_app_format(app, "%s/%s/%s.yaml", folder, kind, names[k]);
            const char *name = local ? ceduo_app_format(app, "%s.yaml", names[k]) : names[k];
            const char *value = local && full_path ? path : name;
            if (local ? !has_header(path, tag) : ceduo_document_is_shipped(path) != shipped)
                continue;
            if (ceduo_picker_has(&p->picker, value))
                continue;
            const char *label = name;
            const char *about = stands  ? describe_stand(app, local ? path : name, owner, &label)
                                : local ? _("yours, in this folder")
                                        : owner;
            const char *text = about[0] ? ceduo_app_format(app, "%-*s %s", ceduo_utf8_field(label, 33), label, about) : label;
            const char *searched = label == name ? name : ceduo_app_format(app, "%s %s", label, name);
            ceduo_picker_add(&p->picker, text, searched, value, current && strcmp(current, value) == 0);
        }
    }
}

/* ---- effect of a choice ---- */

static popup_call select_new_option;

static void append_light(struct text *text, const char *gap, const char *name, enum ceduo_light light, enum ceduo_light current)
{
    ceduo_text_append_joined(text, gap, _("%s %s"), name, ceduo_words_verdict(light));
    if (light != current)
        ceduo_text_append_joined(text, " ", _("(now %s)"), ceduo_words_verdict(current));
}

static void append_lights(struct app *app, struct text *text, const struct preview *f)
{
    const struct ceduo_result *r = app->live.result;
    const struct ceduo_index *current = r ? ceduo_result_last_index(r, app->option) : &f->index;
    append_light(text, "", _("Contact"), f->index.contact, current->contact);
    if (isfinite(f->index.worst_adc))
        ceduo_text_format(text, _(", %.3g m"), f->index.worst_adc);
    append_light(text, "; ", _("free run"), f->index.free_run, current->free_run);
    append_light(text, "; ", _("energy"), f->index.energy, current->energy);
    if (!isnan(f->exceed))
        ceduo_text_append_joined(text, ", ", _("about %.0f per 1000 above the limit"), 1000 * f->exceed);
    else if (!isnan(f->reach))
        ceduo_text_append_joined(text, ", ", _("about %.0f per 1000 arrive"), 1000 * f->reach);
    ceduo_text_append(text, "\n");
}

/* Append the lights for the value under the cursor at the popup's path. Request them first if unknown. */
static void append_effect(struct app *app, struct popup *p)
{
    LOCAL_TEXT(value);
    if (p->has_preview) {
        if (p->preview.known)
            append_lights(app, &p->text, &p->preview);
        return;
    }
    ceduo_text_append(&p->text, _("the lights: computing …\n"));
    bool every_belt = p->on_select == select_new_option; /* the stand in every belt */
    const char *path = p->target, *yaml = ceduo_app_scalar(app, p->value);
    const char *end = strstr(path, "].stand");
    const struct ceduo_belt *belt = end && !end[strlen("].stand")] ? ceduo_input_belt(&app->document.file.scene, path) : NULL;
    if (every_belt)
        ceduo_document_append_belts(&app->document, p->value, false, &value);
    else if (belt) /* today's lights, for stands without cutting, too */
        ceduo_text_format(&value, "{from_m: %.10g, to_m: %.10g, stand: %s}", belt->from_given, belt->to_given, yaml);
    if (every_belt || belt) {
        path = every_belt ? ceduo_app_forest(app) : ceduo_app_format(app, "%.*s]", (int)(end - path), path);
        yaml = value.bytes;
    }
    if (strlen(yaml) < JOB_TEXT)
        ceduo_jobs_request(app->live.jobs,
                           &(struct job_request){JOB_PREVIEW, &app->document.file, app->option, 1, path, yaml, NULL, NULL});
}

/* Return the ground of the library for a word of a field of grounds; otherwise NULL. */
static const struct ceduo_material *find_material(const struct field *f, const char *word)
{
    size_t n;
    int i = f && f->choices == &ceduo_material_words ? ceduo_choice_find(f->choices, word) : -1;
    return i < 0 ? NULL : &ceduo_materials(&n)[i];
}

static void note_word(struct app *app, struct popup *p)
{
    const struct ceduo_material *m = find_material(ceduo_schema_at(p->target), p->value);
    if (m)
        ceduo_text_format(&p->text, _("Rn %.3g, Rt %.3g (%s), roughness %.3g m, friction %.3g\n"), m->rn, m->rt, m->source,
                          m->roughness, m->friction);
    append_effect(app, p);
}

/* Describe a stand in the note over the list. */
static void note_stand(struct app *app, struct popup *p)
{
    struct scene_file file = {0};
    if (!ceduo_popup_preview_treatment(app, p) && !ceduo_popup_is_measured(p->value) &&
        ceduo_popup_read_stand(app, p->value, &file)) {
        const struct ceduo_belt *b = &file.scene.options[0].belts[0];
        struct ceduo_stand_result r = ceduo_assess_stand(&file.scene, b);
        ceduo_text_format(&p->text, _("%s: %.0f stools, %.0f stems, %.0f trees per ha; basal area %.1f m2/ha\n"), b->name,
                          r.stools_per_ha, r.stems_per_ha, r.trees_per_ha, r.basal_area);
        if (!r.bare)
            ceduo_text_format(&p->text, _("with this rock: ADC %.3g m, free run %.1f %% (%s)"), r.adc_m,
                              r.free_run_probability * 100, ceduo_words_law(ceduo_rule_words.names[r.rule]));
        if (!r.bare)
            ceduo_text_append_joined(&p->text, ", ", _("%.3g kJ/100 m"), r.dissipated * J_TO_KJ);
        ceduo_text_append_char(&p->text, '\n');
        append_effect(app, p);
    }
    ceduo_scene_release(&file);
}

/* ---- growth and cutting of a replaced stand ---- */

/* Return the entry of a stand, or NULL if its file has an equal one. */
static const struct node *changed_entry(const struct node *stand, const char *key)
{
    const struct node *entry = ceduo_node_get(stand, key);
    bool reference = stand && stand->written && stand->written->kind == NODE_SCALAR;
    const struct node *filed = reference ? ceduo_node_get(stand->followed, key) : NULL;
    return entry && filed && ceduo_node_equal(entry, filed) ? NULL : entry;
}

bool ceduo_popup_replace_stand(struct app *app, const char *path, const char *value)
{
    static const char *const keys[2] = {"growth", "cutting"};
    const struct node *old = ceduo_document_node(&app->document, path);
    const struct ceduo_belt *belt = ceduo_app_belt(app);
    const char *name = ceduo_app_format(app, "%s", belt ? belt->name : "");
    bool changed[2] = {false, false}, dropped[2] = {false, false}; /* growth, cutting */
    path = ceduo_app_format(app, "%s", path);
    if (!ceduo_app_set(app, path, value))
        return false;
    const struct node *current = ceduo_document_node(&app->document, path);
    belt = ceduo_app_belt(app);
    for (int i = 0; i < 2; i++) {
        const struct node *before = changed_entry(old, keys[i]), *after = ceduo_node_get(current, keys[i]);
        dropped[i] = before && !after;
        changed[i] = before && after && !ceduo_node_equal(before, after);
    }
    LOCAL_TEXT(notes);
    if (changed[0] || changed[1])
        ceduo_text_format(&notes,
                          changed[0] && changed[1] ? _("growth and cutting of '%s' are now those of '%s'")
                          : changed[0]             ? _("the growth of '%s' is now that of '%s'")
                                                   : _("the cutting of '%s' is now that of '%s'"),
                          name, belt->name);
    if (dropped[0] || dropped[1])
        ceduo_text_append_joined(&notes, notes.length > 0 ? "; " : "",
                                 dropped[0] && dropped[1] ? _("growth and cutting of '%s' are dropped: '%s' has none")
                                 : dropped[0]             ? _("the growth of '%s' is dropped: '%s' has none")
                                                          : _("the cutting of '%s' is dropped: '%s' has none"),
                                 name, belt->name);
    if (!isnan(belt->cut_year) && ceduo_node_get(current, "cutting"))
        ceduo_text_append_joined(&notes, notes.length > 0 ? "; " : "", _("it is still cut in year %g"), belt->cut_year);
    if (notes.length > 0)
        ceduo_app_show_message(app, "%s", notes.bytes);
    return true;
}

/* ---- choosing ---- */

static void select_word(struct app *app, struct popup *p)
{
    ceduo_app_set(app, p->target, p->value);
}

/* Add an option with this stand in every belt. */
static void select_new_option(struct app *app, struct popup *p)
{
    const char *name = p->value;
    if (ceduo_popup_choose_treatment(app, p->value))
        return;
    describe_stand(app, p->value, "", &name);
    if (ceduo_app_finish_edit(app, ceduo_document_add_option(&app->document, p->value, name))) {
        ceduo_app_show_option(app, app->document.file.scene.options_count - 1);
        ceduo_app_show_message(app, _("added '%s'; Enter renames it, 2 changes its stand"), ceduo_app_option(app)->name);
    }
}

/* Return the base name of the file of a node, as listed; "": the node is not a reference. */
static const char *listed_name(const struct app *app, const char *path)
{
    const struct node *node = ceduo_document_node(&app->document, path);
    bool reference = node && node->written && node->written->kind == NODE_SCALAR;
    const char *file = reference ? node->written->text : "", *name = ceduo_file_name(file);
    size_t n = strlen(name), ending = name > file && n > 5 && strcmp(name + n - 5, ".yaml") == 0 ? 5 : 0;
    return ceduo_app_format(app, "%.*s", (int)(n - ending), name);
}

static void select_stand(struct app *app, struct popup *p)
{
    if (!ceduo_popup_ask_measured(app, p->value))
        ceduo_popup_replace_stand(app, p->target, ceduo_app_scalar(app, p->value));
}

static void offer_measured(struct popup *p)
{
    ceduo_popup_add_item(p, _("from a sample plot: counts and measurements"), STAND_COUNTED);
    ceduo_popup_add_item(p, _("from a survey: a CSV file of plots and stems"), STAND_SURVEY);
}

static void list_stands(struct app *app, const char *title, popup_call *chosen)
{
    struct popup *p = ceduo_popup_list(app, title, ceduo_app_stand(app), chosen);
    p->update_note = note_stand;
    bool replaces = chosen == select_stand;
    const char *current = replaces ? listed_name(app, p->target) : NULL;
    if (!replaces)
        ceduo_popup_offer_treatments(app, p);
    add_files(app, p, "stands", false, false, current);
    if (replaces)
        offer_measured(p);
    add_files(app, p, "stands", true, false, current);
}

void ceduo_popup_offer_stands(struct app *app, struct popup *p)
{
    offer_measured(p);
    add_files(app, p, "stands", false, true, NULL);
    add_files(app, p, "stands", true, true, NULL);
}

/* Add a word of a field. `current`: its value in the file; NULL: choose the displayed text, not the word. */
static void add_word(struct popup *p, const struct field *f, const char *word, const char *current)
{
    LOCAL_TEXT(shown);
    const struct ceduo_material *ground = find_material(f, word);
    ceduo_format_value(f, word, &shown);
    const char *name = ceduo_arena_string(&p->arena, ceduo_text_string(&shown));
    if (ground)
        ceduo_text_format(&shown, ": %s", _(ground->what));
    ceduo_picker_add(&p->picker, ceduo_text_string(&shown), name, current ? word : name, current && strcmp(word, current) == 0);
}

void ceduo_popup_offer_grounds(struct app *app, struct popup *p)
{
    const struct field *f = ceduo_schema_at("slope.materials[0].material");
    (void)app;
    for (size_t i = 0; i < f->choices->n; i++)
        add_word(p, f, f->choices->names[i], NULL);
}

void ceduo_popup_list_stands(struct app *app)
{
    const struct ceduo_belt *belt = ceduo_app_belt(app);
    if (belt)
        list_stands(app, ceduo_app_format(app, _("Stand of belt %zu, now '%s'"), app->belt + 1, belt->name), select_stand);
    else
        ceduo_app_show_message(app, "%s", _("there is no belt yet: a adds one in view 1"));
}

void ceduo_popup_new_option(struct app *app)
{
    list_stands(app, _("New option: a treatment of this one, or another stand"), select_new_option);
}

void ceduo_popup_list_choices(struct app *app, const struct form_cell *cell)
{
    const struct field *f = cell->field;
    if (f->object == ceduo_schema_stand()) {
        ceduo_popup_list_stands(app);
        return;
    }
    struct popup *p = ceduo_popup_list(app, ceduo_app_path(app, cell->path), cell->path, select_word);
    if (f->type == FIELD_CHOICE) {
        for (size_t i = 0; i < f->choices->n; i++)
            add_word(p, f, f->choices->names[i], cell->written);
        p->update_note = note_word;
        return;
    }
    const char *current = listed_name(app, p->target);
    add_files(app, p, f->object->folder, false, false, current);
    add_files(app, p, f->object->folder, true, false, current);
}

/* ---- a scene to open ---- */

static void offer_scenes(struct app *app, struct popup *p)
{
    const char *own = app->document.path && !app->document.shipped ? app->document.path : NULL;
    if (!strchr(p->fields[0].line.text, '/')) {
        ceduo_popup_offer_recoveries(app, p);
        add_files(app, p, "scenes", false, true, own);
        add_files(app, p, "scenes", true, true, own);
    }
    ceduo_popup_offer_files(app, p);
}

static void select_scene(struct app *app, struct popup *p)
{
    if (!ceduo_popup_open_recovery(app, p->value))
        ceduo_app_open(app, p->value, NULL);
}

static void list_scenes(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("Open a scene: name or path"), "", select_scene);
    p->fields[0].complete = offer_scenes;
    p->endings = ".yaml";
}

void ceduo_popup_open(struct app *app)
{
    ceduo_popup_confirm_unsaved(app, list_scenes);
}
