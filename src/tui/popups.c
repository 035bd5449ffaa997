/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The popups that there are. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io/emit.h"
#include "io/file.h"
#include "base/intl.h"
#include "ceduo/material.h"
#include "model/seek.h"
#include "popup.h"

/* ---- help ---- */

void ceduo_popup_help(struct app *app)
{
    struct popup *p = ceduo_popup_text(app, _("Keys"));
    if (!p)
        return;
    const struct form_cell *cell = app->pane == 0 ? ceduo_form_cell(&app->forms[app->view]) : NULL;
    struct text field = {0};
    if (cell)
        ceduo_form_explain(&app->document, cell, &field);
    if (field.bytes) {
        ceduo_text_safe(&p->text, field.bytes);
        ceduo_text_put(&p->text, "\n \n");
    }
    ceduo_text_free(&field);
    ceduo_text_put(&p->text, _("Every edit is live: figures and pictures follow at once.\n \n"));
    for (int i = 0; i < ACTION_COUNT; i++) {
        const struct action_row *a = &ceduo_actions[i];
        char keys[32];
        snprintf(keys, sizeof keys, "%s%s%s", a->word, a->word2[0] ? "  " : "", a->word2);
        ceduo_text_format(&p->text, "%-18s%s\n", keys, _(a->help));
    }
    ceduo_text_put(&p->text, _(" \nA star marks what is assumed and not measured. Dim values are defaults.\n"
                               "A number with a spread is typed as {mean: 0.6, spread: 0.1, kind: normal}.\n"
                               "The column on the right: of 1000 rocks released, without forest; the three lights; what "
                               "the index (Eq. 4 and 5 of Ciabocco et al. 2009) takes and leaves; how sure it is.\n"
                               "With the mouse: click a field or a view's name; the wheel moves; with Shift held the "
                               "terminal itself selects text.\n"));
}

/* ---- presets and other files ---- */

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

/* Fills a list with the files of a shelf, the first of each name. */
static void add_profiles(struct popup *p, const char *shelf)
{
    const char *const *folders = ceduo_file_folders(&p->arena);
    for (size_t i = 0; folders && folders[i]; i++) {
        size_t n;
        const char *const *names = ceduo_file_list(&p->arena, folders[i], shelf, &n);
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
                              r.adc_m, ceduo_words_rule(r.rule), r.free_run_probability * 100, r.dissipated * 1e-3,
                              ceduo_words_rule(r.rule));
    }
    ceduo_text_free(&yaml);
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

static void chose_word(struct app *app, struct popup *p, const char *value)
{
    ceduo_app_set(app, p->path, value);
}

/* The option that is shown with another stand in every belt, as a new option. */
static void chose_new_option(struct app *app, struct popup *p, const char *value)
{
    struct problems problems = {0};
    bool good = ceduo_document_add_option(&app->document, value, &problems);
    (void)p;
    if (ceduo_app_edited(app, good, &problems)) {
        app->option = app->document.file.scene.options_count - 1;
        ceduo_app_edited(app, true, &problems);
        ceduo_app_say(app, _("added '%s'; Enter renames it, 2 changes its stand"), ceduo_app_option(app)->name);
    }
}

void ceduo_popup_presets(struct app *app, bool new_option)
{
    char forest[64];
    ceduo_app_forest(app, forest, sizeof forest);
    if (!new_option && ceduo_app_option(app)->belts_count == 0) {
        ceduo_app_say(app, "%s", _("there is no belt yet: a adds one in view 1"));
        return;
    }
    struct popup *p = ceduo_popup_list(app, new_option ? _("A new option with the stand …") : _("Stand of this belt"),
                                       new_option ? chose_new_option : chose_word);
    if (!p)
        return;
    snprintf(p->path, sizeof p->path, "%s[%zu].stand", forest, app->belt);
    p->preview = preview_stand;
    ceduo_text_put(&p->text, " ");
    add_profiles(p, "stands");
}

void ceduo_popup_choices(struct app *app, const struct form_cell *cell)
{
    const struct field *f = cell->field;
    char path[FORM_PATH], now[64];
    snprintf(path, sizeof path, "%s", cell->path);
    snprintf(now, sizeof now, "%s", cell->text);
    struct popup *p = ceduo_popup_list(app, path, chose_word);
    if (!p)
        return;
    snprintf(p->path, sizeof p->path, "%s", path);
    if (f->type == FIELD_CHOICE) {
        for (size_t i = 0; i < f->choices->n; i++) {
            ceduo_popup_item(p, f->choices->names[i], f->choices->names[i]);
            if (strcmp(f->choices->names[i], now) == 0)
                p->at = i;
        }
        return;
    }
    add_profiles(p, f->object->folder);
    if (f->object == ceduo_schema_stand()) {
        p->preview = preview_stand;
        ceduo_text_put(&p->text, " ");
    }
}

/* ---- opening ---- */

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

static bool unsaved_first(struct app *app)
{
    if (!ceduo_document_unsaved(&app->document))
        return false;
    ceduo_app_warn(app, "%s", _("unsaved work: s saves it, or u back to what is saved, before another scene is opened"));
    return true;
}

void ceduo_popup_open(struct app *app)
{
    if (unsaved_first(app))
        return;
    struct popup *p = ceduo_popup_list(app, _("Open"), chose_scene);
    if (!p)
        return;
    ceduo_popup_item(p, _("a file …"), "");
    add_profiles(p, "scenes");
}

/* ---- a new scene ---- */

enum { NEW_TITLE, NEW_PROFILE, NEW_MATERIAL, NEW_ROCK, NEW_CONTROL, NEW_ACCEPTED, NEW_STAND };

/* "0 120, 30 100, 60 95" as a list of vertices; false where it is none. */
static bool typed_vertices(const char *text, struct text *yaml, double *first, double *last)
{
    size_t n = 0;
    ceduo_text_put(yaml, "vertices_m: [");
    while (*text) {
        double x, z;
        int used = 0;
        if (sscanf(text, " %lf %lf%n", &x, &z, &used) != 2)
            return false;
        *first = n == 0 ? x : *first;
        *last = x;
        ceduo_text_format(yaml, "%s[%.10g, %.10g]", n++ ? ", " : "", x, z);
        text += used;
        text += strspn(text, " ,;");
    }
    ceduo_text_put(yaml, "]");
    return n >= 2;
}

static bool ends_in_csv(const char *name)
{
    size_t n = strlen(name);
    return n > 4 && strcmp(name + n - 4, ".csv") == 0;
}

/* What is typed into a field is that field's value alone: a number where one is wanted, otherwise a text. */
static bool numbers_typed(struct app *app, const struct popup *p)
{
    static const int numbers[] = {NEW_ROCK, NEW_CONTROL, NEW_ACCEPTED};
    double value;
    for (size_t i = 0; i < 3; i++) {
        const char *text = p->fields[numbers[i]].text;
        bool may_be_empty = numbers[i] == NEW_ACCEPTED && text[0] == '\0';
        if (!may_be_empty && ceduo_number_read(text, &value) != CEDUO_NUMBER_GOOD) {
            ceduo_app_warn(app, _("%s: '%s' is no number; write a dot for the decimals"), p->labels[numbers[i]], text);
            return false;
        }
    }
    return true;
}

static bool stand_typed(struct app *app, struct popup *p)
{
    const char *stand = p->fields[NEW_STAND].text;
    if (stand[0] == '\0' || ceduo_file_find(&p->arena, stand, NULL, "stands"))
        return true;
    ceduo_app_warn(app, _("no stand '%s': a file, or a name such as simple-coppice; may be left empty"), stand);
    return false;
}

static bool filled_new(struct app *app, struct popup *p)
{
    struct text yaml = {0}, title = {0}, csv = {0}, material = {0}, stand = {0};
    const char *profile = p->fields[NEW_PROFILE].text;
    if (!numbers_typed(app, p) || !stand_typed(app, p))
        return false;
    ceduo_emit_scalar(&material, p->fields[NEW_MATERIAL].text, true);
    ceduo_emit_scalar(&stand, p->fields[NEW_STAND].text, true);
    ceduo_emit_scalar(&title, p->fields[NEW_TITLE].text, true);
    ceduo_emit_scalar(&csv, profile, true);
    ceduo_text_format(&yaml, "ceduo: scene/1\ntitle: %s\nrock: {diameter_m: %s}\nslope: {", title.bytes ? title.bytes : "x",
                      p->fields[NEW_ROCK].text);
    bool good = true;
    double first = -1e6, last = 1e6; /* of a file that is not read yet: wide enough */
    if (ends_in_csv(profile))
        ceduo_text_format(&yaml, "csv: %s", csv.bytes ? csv.bytes : "");
    else
        good = typed_vertices(profile, &yaml, &first, &last);
    ceduo_text_format(&yaml, ", materials: [{from_m: %.10g, to_m: %.10g, material: %s}]}\n", first, last,
                      material.bytes ? material.bytes : ceduo_material_talus()->name);
    ceduo_text_format(&yaml, "controls: [{x_m: %s", p->fields[NEW_CONTROL].text);
    if (p->fields[NEW_ACCEPTED].text[0])
        ceduo_text_format(&yaml, ", accepted_kJ: %s", p->fields[NEW_ACCEPTED].text);
    ceduo_text_put(&yaml, "}]\n");
    if (!good) {
        ceduo_app_warn(app, "%s", _("the profile: a file that ends in .csv, or points x z, x z, … with x rising"));
    } else {
        good = ceduo_app_open_text(app, yaml.bytes ? yaml.bytes : "");
        struct problems problems = {0};
        char set[FORM_PATH + 64];
        const struct ceduo_slope *s = &app->document.file.scene.slope;
        if (good && p->fields[NEW_STAND].text[0]) {
            snprintf(set, sizeof set, "forest=[{from_m: %.10g, to_m: %.10g, stand: %.100s}]", s->origin_x,
                     app->document.file.scene.controls[0].x_given, stand.bytes ? stand.bytes : "bare");
            const char *const sets[] = {set};
            ceduo_app_edited(app, ceduo_document_set_all(&app->document, sets, 1, "forest", &problems), &problems);
        }
    }
    ceduo_text_free(&yaml);
    ceduo_text_free(&title);
    ceduo_text_free(&csv);
    ceduo_text_free(&material);
    ceduo_text_free(&stand);
    return good;
}

void ceduo_popup_new(struct app *app)
{
    if (unsaved_first(app))
        return;
    struct popup *p = ceduo_popup_fields(app, _("New scene"), filled_new);
    if (!p)
        return;
    ceduo_text_put(&p->text, _("The profile: a CSV file with distance and elevation, as QGIS writes it, or points typed as "
                               "x z, x z, … Everything can be changed later."));
    ceduo_popup_field(p, _("title"), _("My slope"));
    ceduo_popup_field(p, _("profile (CSV file or points)"), "0 60, 20 35, 60 20, 100 12");
    ceduo_popup_field(p, _("ground: talus, colluvium, cliff"), ceduo_material_talus()->name);
    ceduo_popup_field(p, _("rock: diameter, m"), "0.6");
    ceduo_popup_field(p, _("counted at x, m"), "90");
    ceduo_popup_field(p, _("that bears, kJ (may be empty)"), "50");
    ceduo_popup_field(p, _("stand on the whole way"), "simple-coppice");
}

/* ---- saving ---- */

static bool filled_save(struct app *app, struct popup *p)
{
    const char *path = p->fields[0].text;
    if (path[0] == '\0') {
        ceduo_app_warn(app, "%s", _("a name is needed"));
        return false;
    }
    bool confirmed = p->kept && strcmp(p->kept, path) == 0;
    bool exists = access(path, F_OK) == 0;
    bool own = app->document.path && strcmp(app->document.path, path) == 0 &&
               !ceduo_document_changed_on_disk(&app->document);
    if (exists && !confirmed && !own) {
        free(p->kept);
        p->kept = strdup(path);
        ceduo_app_warn(app, "%s", _("there is such a file already; Enter once more replaces it"));
        return false;
    }
    return ceduo_app_save_to(app, path);
}

void ceduo_popup_save_as(struct app *app, const char *why)
{
    struct popup *p = ceduo_popup_fields(app, _("Save as"), filled_save);
    if (!p)
        return;
    const struct document *d = &app->document;
    if (why)
        ceduo_text_format(&p->text, _("It could not be saved: %s. Give another name, or one in another folder."), why);
    else if (d->shipped)
        ceduo_text_put(&p->text, _("This scene belongs to the program and is never written over; save your own copy."));
    const char *slash = d->path && d->shipped ? strrchr(d->path, '/') : NULL;
    ceduo_popup_field(p, _("file"), slash ? slash + 1 : d->path ? d->path : "scene.yaml");
}

static void chose_disk(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    if (strcmp(value, "write") == 0)
        ceduo_app_write(app);
    else if (strcmp(value, "as") == 0)
        ceduo_popup_save_as(app, NULL);
}

void ceduo_popup_changed_on_disk(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("The file has changed on disk since it was read"), chose_disk);
    if (!p)
        return;
    ceduo_popup_item(p, _("never mind: do not save now"), "");
    ceduo_popup_item(p, _("save under another name"), "as");
    ceduo_popup_item(p, _("write over what is there"), "write");
}

static void chose_quit(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    if (strcmp(value, "save") == 0) {
        app->quit_once_saved = true; /* once a name is given, where one is asked for */
        ceduo_app_save(app);
    } else if (strcmp(value, "drop") == 0) {
        ceduo_document_forget(&app->document);
        app->quit = true;
    }
}

void ceduo_popup_quit(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("There is unsaved work"), chose_quit);
    if (!p)
        return;
    ceduo_popup_item(p, _("stay"), "");
    ceduo_popup_item(p, _("save and quit"), "save");
    ceduo_popup_item(p, _("quit and lose it"), "drop");
}

static void chose_recover(struct app *app, struct popup *p, const char *value)
{
    struct problems problems = {0};
    bool without_file = value[0] == 'o';
    if (strcmp(value, "forget") == 0) {
        unlink(p->path);
    } else if (without_file ? ceduo_app_open_text(app, p->kept)
                            : ceduo_app_edited(app, ceduo_document_recover(&app->document, p->kept, &problems), &problems)) {
        unlink(p->path); /* this program keeps a copy of its own now */
        ceduo_app_say(app, "%s", _("your work is back; s saves it, u shows what was before"));
    }
}

void ceduo_popup_recover(struct app *app, char *text, char *file, bool without_file)
{
    struct popup *p = ceduo_popup_list(app, without_file ? _("A new scene that was never saved was left behind")
                                                         : _("Unsaved work on this scene was left behind"),
                                       chose_recover);
    if (p && strlen(file) < sizeof p->path) {
        snprintf(p->path, sizeof p->path, "%s", file);
        p->kept = text;
        text = NULL;
        ceduo_popup_item(p, _("take it up again"), without_file ? "open" : "take");
        ceduo_popup_item(p, _("forget it"), "forget");
    } else {
        ceduo_popup_close(app);
    }
    free(text);
    free(file);
}

/* ---- searching and naming ---- */

static bool filled_search(struct app *app, struct popup *p)
{
    snprintf(app->search, sizeof app->search, "%.*s", (int)sizeof app->search - 1, p->fields[0].text);
    ceduo_app_key(app, 'N');
    return true;
}

void ceduo_popup_search(struct app *app)
{
    struct popup *p = ceduo_popup_fields(app, _("Search in this view"), filled_search);
    if (p)
        ceduo_popup_field(p, _("word"), app->search);
}

/* ---- how much is enough ---- */

enum { FIND_GOAL, FIND_LO, FIND_HI };

static bool read_goal(struct app *app, char *text, struct seek *seek)
{
    enum ceduo_goal_reading reading = ceduo_goal_read(text, &seek->goal, &seek->target);
    if (reading == CEDUO_GOAL_NO_SHARE)
        ceduo_app_warn(app, "%s", _("a share is 0 to 1, as 0.05 for 5 %"));
    else if (reading != CEDUO_GOAL_GOOD)
        ceduo_app_warn(app, "%s", _("the goal is adc, free-run, energy=KJ or exceed=SHARE"));
    else if (!ceduo_goals[seek->goal].usual && isnan(seek->target))
        ceduo_app_warn(app, "%s", _("energy wants a mean in kJ: energy=50"));
    else
        return true;
    return false;
}

#define FIND_ROCKS 2000 /* so that the answer is there at once */

/* Looks for the value, and puts it into the field where one is found. */
static bool filled_find(struct app *app, struct popup *p)
{
    struct seek seek = {.file = &app->document.file, .path = p->path, .option = app->option, .rocks = FIND_ROCKS,
                        .threads = ceduo_worker_threads(app->worker)};
    char goal[64];
    snprintf(goal, sizeof goal, "%.63s", p->fields[FIND_GOAL].text);
    if (!read_goal(app, goal, &seek))
        return false;
    if (ceduo_number_read(p->fields[FIND_LO].text, &seek.lo) != CEDUO_NUMBER_GOOD ||
        ceduo_number_read(p->fields[FIND_HI].text, &seek.hi) != CEDUO_NUMBER_GOOD || !(seek.lo <= seek.hi)) {
        ceduo_app_warn(app, "%s", _("from and to are numbers, the smaller first"));
        return false;
    }
    struct ceduo_found found;
    struct problems problems = {0};
    enum ceduo_status status = ceduo_seek(&seek, &found, &problems);
    bool good = status == CEDUO_OK;
    if (!good) {
        ceduo_app_edited(app, false, &problems);
        return false;
    }
    struct text words = {0};
    bool set = true;
    if (found.found && found.whole_range) { /* then the value that is there is as good as another */
        const struct form_cell *cell = ceduo_form_cell(&app->forms[app->view]);
        ceduo_text_format(&words, _("every value from %s to %s reaches the goal %s; the field stays %s"),
                          p->fields[FIND_LO].text, p->fields[FIND_HI].text, p->fields[FIND_GOAL].text,
                          cell && cell->text[0] ? cell->text : _("as it is"));
    } else {
        ceduo_seek_say(&seek, &found, &words);
    }
    if (found.found && !found.whole_range) {
        char room[CEDUO_NUMBER_ROOM], path[1024];
        snprintf(path, sizeof path, "%s", p->path);
        set = ceduo_document_set(&app->document, path, ceduo_number_shortest(found.value, room), &problems);
        ceduo_app_edited(app, set, &problems);
    } else {
        ceduo_problems_free(&problems);
    }
    for (char *c = words.bytes; c && *c; c++)
        *c = *c == '\n' ? ' ' : *c;
    if (set && words.bytes)
        ceduo_app_say(app, "%s", words.bytes);
    ceduo_text_free(&words);
    return true;
}

void ceduo_popup_find(struct app *app)
{
    struct form_row *row = ceduo_form_row(&app->forms[app->view]);
    const struct form_cell *cell = row && row->n > 0 ? &row->cells[app->forms[app->view].column] : NULL;
    bool number = cell && cell->field && (cell->field->type == FIELD_NUMBER || cell->field->type == FIELD_COUNT ||
                                          cell->field->type == FIELD_SPREAD);
    if (!number) {
        ceduo_app_warn(app, "%s", _("put the cursor on a number first: f looks for its value that reaches a goal"));
        return;
    }
    char path[FORM_PATH], lo[CEDUO_NUMBER_ROOM], hi[CEDUO_NUMBER_ROOM];
    snprintf(path, sizeof path, "%s", cell->path);
    double value = 0;
    bool known = ceduo_number_read(cell->text, &value) == CEDUO_NUMBER_GOOD && value > 0;
    ceduo_number_shortest(known ? (cell->field->type == FIELD_COUNT ? 1 : value / 10) : 1, lo);
    ceduo_number_shortest(known ? value * 10 : 1000, hi);
    struct popup *p = ceduo_popup_fields(app, _("Which value reaches a goal?"), filled_find);
    if (!p)
        return;
    snprintf(p->path, sizeof p->path, "%s", path);
    ceduo_text_format(&p->text, _("%s, with the same rocks for every value. Goals at the worst control: adc, free-run, "
                                  "energy=KJ (mean), exceed=SHARE (0.05). What is found is put into the field; u takes it back."),
                      path);
    ceduo_popup_field(p, _("goal"), "adc");
    ceduo_popup_field(p, _("from"), lo);
    ceduo_popup_field(p, _("to"), hi);
}

static bool filled_name(struct app *app, struct popup *p)
{
    struct problems problems = {0};
    struct text value = {0};
    char path[64];
    snprintf(path, sizeof path, "options[%zu].name", app->option);
    ceduo_emit_scalar(&value, p->fields[0].text, true);
    bool good = value.bytes && ceduo_document_set(&app->document, path, value.bytes, &problems);
    ceduo_text_free(&value);
    return ceduo_app_edited(app, good, &problems);
}

void ceduo_popup_rename(struct app *app)
{
    struct popup *p = ceduo_popup_fields(app, _("Name of this option"), filled_name);
    if (p)
        ceduo_popup_field(p, _("name"), ceduo_app_option(app)->name);
}

/* ---- from a plot's counts to hectares ---- */

enum { COUNT_AREA, COUNT_SLOPE, COUNT_ANGLE, COUNT_STOOLS, COUNT_SHOOTS, COUNT_TREES };

static bool counts_of(struct app *app, struct popup *p, double values[6], bool *on_slope)
{
    for (size_t i = 0; i < 6; i++) {
        if (i == COUNT_SLOPE)
            continue;
        bool good = ceduo_number_read(p->fields[i].text, &values[i]) == CEDUO_NUMBER_GOOD && values[i] >= 0;
        if (!good) {
            ceduo_app_warn(app, _("%s: '%s' is no number"), p->labels[i], p->fields[i].text);
            return false;
        }
    }
    const char *how = p->fields[COUNT_SLOPE].text;
    *on_slope = strcmp(how, _("slope")) == 0;
    if (!*on_slope && strcmp(how, _("horizontal")) != 0) {
        ceduo_app_warn(app, _("'%s': slope or horizontal is wanted"), how);
        return false;
    }
    if (!(values[COUNT_AREA] > 0) || values[COUNT_ANGLE] >= 90) {
        ceduo_app_warn(app, "%s", _("the size must be above 0, the angle below 90"));
        return false;
    }
    return true;
}

static bool filled_counts(struct app *app, struct popup *p)
{
    double v[6];
    bool on_slope;
    if (!counts_of(app, p, v, &on_slope))
        return false;
    double area = on_slope ? v[COUNT_AREA] * cos(v[COUNT_ANGLE] * 3.14159265358979323846 / 180) : v[COUNT_AREA];
    double per = 10000 / area;
    const struct ceduo_stand *stand = &ceduo_app_option(app)->belts[app->belt].stand;
    char sets[3][FORM_PATH + 64];
    const char *list[3];
    size_t n = 0;
    if (stand->shoots_count != 1 || stand->trees_count != 1) {
        ceduo_app_warn(app, _("the stand must have one cohort of shoots and one class of trees, not %zu and %zu"),
                       stand->shoots_count, stand->trees_count);
        return false;
    }
    snprintf(sets[0], sizeof sets[0], "%.160s.stools.per_ha=%.6g", p->path, v[COUNT_STOOLS] * per);
    snprintf(sets[1], sizeof sets[1], "%.160s.shoots[0].per_ha=%.6g", p->path, v[COUNT_SHOOTS] * per);
    snprintf(sets[2], sizeof sets[2], "%.160s.trees[0].per_ha=%.6g", p->path, v[COUNT_TREES] * per);
    for (; n < 3; n++)
        list[n] = sets[n];
    struct problems problems = {0};
    bool good = ceduo_document_set_all(&app->document, list, 3, _("counts of a plot"), &problems);
    if (ceduo_app_edited(app, good, &problems))
        ceduo_app_say(app, _("a plot of %.4g m2, horizontal: each stem counted stands for %.4g per ha"), area, per);
    return good;
}

void ceduo_popup_counts(struct app *app)
{
    char forest[64];
    ceduo_app_forest(app, forest, sizeof forest);
    if (ceduo_app_option(app)->belts_count == 0) {
        ceduo_app_say(app, "%s", _("there is no belt yet: a adds one in view 1"));
        return;
    }
    struct popup *p = ceduo_popup_fields(app, _("Stand from the counts of a sample plot"), filled_counts);
    if (!p)
        return;
    snprintf(p->path, sizeof p->path, "%s[%zu].stand", forest, app->belt);
    ceduo_text_put(&p->text, _("Densities are per horizontal hectare. A plot that was measured along the slope is smaller "
                               "than it seems: 400 m2 at 40 degrees are 306 m2."));
    ceduo_popup_field(p, _("size of the plot, m2"), "400");
    ceduo_popup_field(p, _("measured: slope or horizontal"), _("slope"));
    ceduo_popup_field(p, _("angle of the slope, degrees"), "35");
    ceduo_popup_field(p, _("stools counted"), "");
    ceduo_popup_field(p, _("shoots counted"), "");
    ceduo_popup_field(p, _("single trees counted"), "");
}

/* ---- export ---- */

/* The batch command that gives the same figures. */
static void put_command(struct app *app, struct text *text)
{
    struct document *d = &app->document;
    const struct ceduo_arrivals *shown = ceduo_app_shown(app);
    uint64_t rocks = shown ? shown->released : d->file.scene.simulation.rocks;
    ceduo_text_format(text, "ceduo --batch -n %llu '", (unsigned long long)rocks);
    for (const char *c = d->path ? d->path : "scene.yaml"; *c; c++)
        ceduo_text_add(text, *c == '\'' ? "'\\''" : c, *c == '\'' ? 4 : 1); /* as a shell reads it */
    ceduo_text_put(text, "'\n");
}

/* More rocks may fall while it is read. */
static void show_command(struct app *app, struct popup *p, const char *value)
{
    const struct ceduo_arrivals *shown = ceduo_app_shown(app);
    (void)value;
    ceduo_text_free(&p->text);
    put_command(app, &p->text);
    if (shown)
        ceduo_text_format(&p->text, _("\nThe figures on the screen are of %llu rocks%s.\n"),
                          (unsigned long long)shown->released, app->busy ? _("; more are falling") : "");
    else
        ceduo_text_put(&p->text, _("\nThere are no figures yet: -n is what the scene says.\n"));
    if (ceduo_document_unsaved(&app->document))
        ceduo_text_put(&p->text, _("\nThere is unsaved work: s saves it first.\n"));
}

static void put_report(struct app *app, struct text *text, enum ceduo_format format)
{
    struct ceduo_report report = {.file = &app->document.file,
                                  .result = app->result,
                                  .remarks = {.ground_assumed = app->document.file.ground_assumed},
                                  .seconds = app->seconds};
    if (!app->result)
        return;
    if (format == CEDUO_TABLE)
        ceduo_report_table(text, &report, app->charset == CEDUO_CHARSET_ASCII);
    else if (format == CEDUO_JSON)
        ceduo_report_json(text, &report);
    else {
        ceduo_report_csv_header(text, false, false);
        ceduo_report_csv(text, &report, false);
    }
}

static void put_export(struct app *app, const char *what, struct text *text)
{
    if (strcmp(what, "table") == 0) {
        put_report(app, text, CEDUO_TABLE);
    } else if (strcmp(what, "csv") == 0) {
        put_report(app, text, CEDUO_CSV);
    } else if (strcmp(what, "json") == 0) {
        put_report(app, text, CEDUO_JSON);
    } else {
        struct popup *over = app->popup;
        app->popup = NULL;
        ceduo_app_draw(app);
        app->popup = over;
        char *screen = ceduo_canvas_dump(app->canvas);
        ceduo_text_put(text, screen ? screen : "");
        free(screen);
    }
}

static bool filled_export(struct app *app, struct popup *p)
{
    struct text text = {0};
    put_export(app, p->path, &text);
    const char *path = p->fields[0].text;
    bool confirmed = p->kept && strcmp(p->kept, path) == 0;
    bool good = false;
    if (!confirmed && access(path, F_OK) == 0) {
        free(p->kept);
        p->kept = strdup(path);
        ceduo_app_warn(app, "%s", _("there is such a file already; Enter once more replaces it"));
    } else if (!text.bytes) {
        ceduo_app_warn(app, "%s", _("nothing is computed yet"));
    } else if (!ceduo_file_write(path, text.bytes, text.length)) {
        ceduo_app_warn(app, "%s: %s", path, strerror(errno));
    } else {
        ceduo_app_say(app, _("written: %s"), path);
        good = true;
    }
    ceduo_text_free(&text);
    return good;
}

static void chose_export(struct app *app, struct popup *p, const char *value)
{
    static const char *const names[][2] = {
        {"table", "ceduo.txt"}, {"csv", "ceduo.csv"}, {"json", "ceduo.json"}, {"picture", "ceduo-screen.txt"}};
    (void)p;
    if (strcmp(value, "command") == 0) {
        struct popup *q = ceduo_popup_text(app, _("The batch command that gives the same"));
        if (q)
            q->preview = show_command;
        return;
    }
    struct popup *q = ceduo_popup_fields(app, _("Export to a file"), filled_export);
    if (!q)
        return;
    snprintf(q->path, sizeof q->path, "%s", value);
    for (size_t i = 0; i < 4; i++)
        if (strcmp(names[i][0], value) == 0)
            ceduo_popup_field(q, _("file"), names[i][1]);
}

void ceduo_popup_export(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("Export"), chose_export);
    if (!p)
        return;
    ceduo_popup_item(p, _("the page, as text"), "table");
    ceduo_popup_item(p, _("this screen, with its picture, as text"), "picture");
    ceduo_popup_item(p, _("CSV, a row for each option and control"), "csv");
    ceduo_popup_item(p, _("JSON"), "json");
    ceduo_popup_item(p, _("the batch command that gives the same"), "command");
}
