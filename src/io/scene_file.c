/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a scene: finds and reads the file, applies changes from left to right, resolves references and binds the tree. All
 * memory belongs to the arena of the scene file. */
#include "scene_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "base/oom.h"
#include "file.h"
#include "validator.h"

bool ceduo_scene_bind(struct scene_file *file, struct problems *problems)
{
    const struct scene_file previous = *file;
    struct validator v = {.file = file,
                          .arena = &file->arena,
                          .notes = &file->notes,
                          .root = file->root,
                          .problems = problems,
                          .warns = true,
                          .previous = &previous};
    size_t before = problems->met;
    *file = (struct scene_file){.arena = file->arena,
                                .path = file->path,
                                .name = file->name,
                                .raw = file->raw,
                                .root = file->root,
                                .kept_count = file->kept_count,
                                .kept = file->kept,
                                .changed = file->changed};
    if (!ceduo_validate(&v))
        return false;
    file->scene = v.draft.scene;
    file->scene.title = file->scene.title ? file->scene.title : (char *)(uintptr_t)ceduo_file_name(file->path);
    bool good = ceduo_problems_check_memory(problems) && problems->met == before;
    file->slope_node = good ? ceduo_node_get(file->root, "slope") : NULL;
    return good;
}

unsigned ceduo_scene_list(const char *path)
{
    static const char *const lists[] = {"controls", "release", "slope", "forest", "options"};
    for (unsigned i = 0; i < sizeof lists / sizeof lists[0]; i++)
        if (strncmp(path, lists[i], strlen(lists[i])) == 0)
            return 1u << (i < 4 ? i : 3); /* options contain forests */
    return 0;
}

/* Find the '=' after the path. A '=' in brackets belongs to a name. */
static const char *find_equals(const char *set)
{
    bool inside = false;
    for (const char *p = set; *p; p++) {
        inside = *p == '[' || (inside && *p != ']');
        if (*p == '=' && !inside)
            return p;
    }
    return strchr(set, '='); /* the bracket is not closed */
}

/* Return a change as a source, with its name in messages. */
static struct source name_change(const struct scene_sets *sets, size_t i)
{
    bool cell = i >= sets->n - sets->cells;
    return (struct source){.name = cell ? sets->row : "--set",
                           .bytes = sets->items[i],
                           .length = strlen(sets->items[i]),
                           .is_option = true,
                           .is_cell = cell};
}

static bool apply_change(struct scene_file *file, struct source set, struct problems *problems)
{
    set.base_file = file->path;
    const struct source *source = ceduo_source_copy(&file->arena, set);
    if (!source)
        return false;
    const char *equals = find_equals(source->bytes);
    if (!equals || strspn(source->bytes, " ") == (size_t)(equals - source->bytes))
        return ceduo_problem(problems, source, 1, 1, _("expected %s"), "PATH=VALUE");
    size_t length = (size_t)(equals - source->bytes), value_at = length + 1;
    while (source->bytes[length - 1] == ' ')
        length--;
    /* unquoted, '#' would begin a comment and ': ' a mapping */
    LOCAL_TEXT(path);
    ceduo_text_append_n(&path, source->bytes, length);
    const struct field *field = ceduo_schema_at(ceduo_text_string(&path));
    const char *text = equals + 1 + strspn(equals + 1, " ");
    bool all = *text == '#'; /* the whole value would be a comment */
    const struct node *value = all ? NULL : ceduo_yaml_read_value(&file->arena, source, value_at, problems);
    if (!value && !all)
        return false;
    bool takes_text = field ? field->type <= FIELD_FILE : all || value->kind == NODE_SCALAR;
    bool cut = all || (value->kind == NODE_SCALAR && !value->quoted && strstr(text, " #"));
    if (all || (takes_text && (cut || (value->kind == NODE_MAP && !value->flow))))
        return ceduo_problem(problems, source, 1, value_at + 1,
                             _("'%s' is special in YAML; write the text in quotes: %s=\"%s\""), cut ? "#" : ": ",
                             ceduo_text_string(&path), text);
    const struct node *root = ceduo_resolve_set(&file->arena, file->root, source, length, value, problems);
    if (root)
        file->root = root;
    return root != NULL;
}

bool ceduo_scene_set(struct scene_file *file, const char *option, const char *set, struct problems *problems)
{
    return apply_change(file, (struct source){.name = option, .bytes = set, .is_option = true}, problems);
}

/* Report a name that is neither a file nor a scene of the profiles, with the nearest scene and the folders searched. `plain`:
 * the name without .yaml; NULL: no memory. */
static void report_no_scene(struct scene_file *file, const char *path, const char *plain, struct problems *problems)
{
    LOCAL_TEXT(names);
    LOCAL_TEXT(known);
    LOCAL_TEXT(folders);
    const char *near = NULL;
    const char *const *all = plain ? ceduo_file_folders(&file->arena) : NULL;
    for (size_t i = 0; all && all[i]; i++) {
        size_t n;
        const char *const *list = ceduo_file_list(&file->arena, all[i], "scenes", &n);
        for (size_t k = 0; k < n; k++)
            ceduo_text_append_joined(&known, k > 0 || i > 0 ? ", " : "", "%s", list[k]);
        near = near ? near : ceduo_text_nearest(plain, list, n);
        ceduo_text_format(&folders, "%s%s/scenes", i > 0 ? ", " : "", all[i]);
    }
    if (near)
        ceduo_text_append_joined(&names, "; ", _("did you mean '%s'?"), near);
    else if (known.bytes)
        ceduo_text_append_joined(&names, "; ", _("shipped scenes: %s"), known.bytes);
    if (folders.bytes)
        ceduo_text_append_joined(&names, " ", _("(searched here and in %s)"), folders.bytes);
    ceduo_problem(problems, &(struct source){.name = path}, 0, 0, _("cannot read it: %s%s"), ceduo_error_text(ENOENT),
                  ceduo_text_string(&names));
}

/* Make a scene from its text and the first n changes. */
static bool make_scene(struct scene_file *file, const struct source *source, const struct scene_sets *sets, size_t n,
                       struct problems *problems)
{
    size_t before = problems->met;
    file->path = source->name;
    file->name = file->name ? file->name : file->path;
    file->raw = file->root = ceduo_yaml_read(&file->arena, source, problems);
    if (!file->root)
        return false;
    if (file->root->kind != NODE_MAP)
        return ceduo_problem_at(problems, ceduo_node_place(file->root, NULL),
                                _("a scene is a mapping that begins with 'ceduo: scene/1'"));
    file->changed = 0;
    for (size_t i = 0; i < n; i++) {
        if (!apply_change(file, name_change(sets, i), problems))
            return false;
        file->changed |= ceduo_scene_list(sets->items[i]);
    }
    const struct node *root = ceduo_resolve_scene(&file->arena, file->root, problems);
    if (!root)
        return false;
    file->root = root;
    return ceduo_scene_bind(file, problems) && problems->met == before;
}

/* True if the scene is valid with the first n changes. */
static bool is_valid_with(const struct source *source, const struct scene_sets *sets, size_t n, struct problems *problems)
{
    struct scene_file trial = {0};
    struct problems found = {0};
    bool good = make_scene(&trial, source, sets, n, &found);
    problems->memory |= found.memory;
    ceduo_problems_free(&found);
    ceduo_scene_release(&trial);
    return good;
}

/* Read a scene. If a change that is valid on its own makes a value of the file invalid, name the change before that problem:
 * the last --set before which the scene was valid. */
static bool read_source(struct scene_file *file, const struct source *source, const struct scene_sets *sets,
                        struct problems *problems)
{
    if (make_scene(file, source, sets, sets->n, problems))
        return true;
    if (sets->n == 0 || problems->usage || !ceduo_problems_check_memory(problems) || !is_valid_with(source, sets, 0, problems))
        return false;
    size_t last = sets->n - 1;
    while (last > 0 && !problems->memory && !is_valid_with(source, sets, last, problems))
        last--;
    const struct source set = name_change(sets, last);
    const size_t column = (size_t)(find_equals(set.bytes) - set.bytes) + 2;
    return ceduo_problem_at(problems, (struct problem_place){.source = &set, .line = 1, .column = column, .first = true},
                            _("the scene is valid without this change, but not with it:"));
}

bool ceduo_scene_load(struct scene_file *file, const char *path, const char *const *sets, size_t n, struct problems *problems)
{
    return ceduo_scene_load_row(file, path, &(struct scene_sets){.items = sets, .n = n}, problems);
}

bool ceduo_scene_load_row(struct scene_file *file, const char *path, const struct scene_sets *sets, struct problems *problems)
{
    *file = (struct scene_file){.path = path};
    ceduo_memory_failed(); /* clear a stale flag */
    size_t length = strlen(path);
    length -= length > 5 && strcmp(path + length - 5, ".yaml") == 0 ? 5 : 0;
    const char *plain = ceduo_arena_copy(&file->arena, path, length);
    const char *found = strcmp(path, "-") == 0 ? path : ceduo_file_find(&file->arena, path, NULL, "scenes");
    if (!found && *path && !strchr(path, '/') && access(path, F_OK) != 0 && errno == ENOENT) {
        report_no_scene(file, path, plain, problems);
        return false;
    }
    const struct source *source = ceduo_file_read(&file->arena, found ? found : path, YAML_BYTES_MAX, problems);
    if (found && strcmp(found, path) != 0)
        file->name = plain;
    return source && read_source(file, source, sets, problems);
}

bool ceduo_scene_load_text(struct scene_file *file, const char *name, const char *text, struct problems *problems)
{
    *file = (struct scene_file){.path = name};
    ceduo_memory_failed();
    const struct source *source = ceduo_source_copy(&file->arena, (struct source){.name = name, .bytes = text});
    return source && read_source(file, source, &(struct scene_sets){0}, problems);
}

void ceduo_scene_release(struct scene_file *file)
{
    ceduo_arena_free(&file->arena);
    *file = (struct scene_file){0};
}

bool ceduo_scene_assumes_value(const struct scene_file *file, const char *path)
{
    const struct source_note *note = ceduo_notes_find(file->notes, path);
    return note && strcmp(note->kind, "assumed") == 0;
}
