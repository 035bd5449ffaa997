/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a path to a scene: the file is found and read, changes are applied from left to right, references are
 * followed, and the tree is bound. The arena of the scene file owns all that comes of it. */
#include "scene_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "base/must.h"
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
                                .kept = file->kept};
    if (!ceduo_validate(&v))
        return false;
    file->scene = v.draft.scene;
    file->scene.title = file->scene.title ? file->scene.title : (char *)(uintptr_t)ceduo_file_name(file->path);
    bool good = ceduo_problems_settle(problems) && problems->met == before;
    file->slope_node = good ? ceduo_node_get(file->root, "slope") : NULL;
    return good;
}

/* The '=' that ends a path; one within brackets belongs to a name. */
static const char *equals_of(const char *set)
{
    bool inside = false;
    for (const char *p = set; *p; p++) {
        inside = *p == '[' || (inside && *p != ']');
        if (*p == '=' && !inside)
            return p;
    }
    return strchr(set, '='); /* a bracket that is never closed */
}

/* How messages call a change, and what it is. */
static struct source source_of(const struct scene_sets *sets, size_t i)
{
    bool cell = i >= sets->n - sets->cells;
    return (struct source){.name = cell ? sets->row : "--set",
                           .bytes = sets->items[i],
                           .length = strlen(sets->items[i]),
                           .is_option = true,
                           .is_cell = cell};
}

static bool set_one(struct scene_file *file, struct source set, struct problems *problems)
{
    set.beside = file->path;
    const struct source *source = ceduo_source_keep(&file->arena, set);
    if (!source)
        return false;
    const char *equals = equals_of(source->bytes);
    if (!equals || strspn(source->bytes, " ") == (size_t)(equals - source->bytes))
        return ceduo_problem(problems, source, 1, 1, _("expected %s"), "PATH=VALUE");
    size_t length = (size_t)(equals - source->bytes), value_at = length + 1;
    while (length > 0 && source->bytes[length - 1] == ' ')
        length--;
    /* what a shell passes on without quotes, and YAML cuts or takes apart */
    LOCAL_TEXT(path);
    ceduo_text_add(&path, source->bytes, length);
    const struct field *field = ceduo_schema_at(ceduo_text_string(&path));
    const char *given = equals + 1 + strspn(equals + 1, " ");
    bool all = *given == '#'; /* nothing is left of it */
    const struct node *value = all ? NULL : ceduo_yaml_read_value(&file->arena, source, value_at, problems);
    if (!value && !all)
        return false;
    bool text = field ? field->type <= FIELD_FILE : all || value->kind == NODE_SCALAR;
    bool cut = all || (value->kind == NODE_SCALAR && !value->quoted && strstr(given, " #"));
    if (all || (text && (cut || (value->kind == NODE_MAP && !value->flow))))
        return ceduo_problem(problems, source, 1, value_at + 1,
                             cut ? _("'#' begins a comment; between quotes it is text: %s=\"%s\"")
                                 : _("': ' makes a mapping; between quotes it is text: %s=\"%s\""),
                             ceduo_text_string(&path), given);
    const struct node *root = ceduo_resolve_set(&file->arena, file->root, source, length, value, problems);
    if (root)
        file->root = root;
    return root != NULL;
}

bool ceduo_scene_set(struct scene_file *file, const char *option, const char *set, struct problems *problems)
{
    return set_one(file, (struct source){.name = option, .bytes = set, .is_option = true}, problems);
}

/* A name that is neither a file nor a scene among the profiles (`plain`: without its ending, NULL without memory): the nearest of
 * these, and where they were looked for. */
static void complain_no_scene(struct scene_file *file, const char *path, const char *plain, struct problems *problems)
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
            ceduo_text_then(&known, k > 0 || i > 0 ? ", " : "", "%s", list[k]);
        near = near ? near : ceduo_text_nearest(plain, list, n);
        ceduo_text_format(&folders, "%s%s/scenes", i > 0 ? ", " : "", all[i]);
    }
    if (near)
        ceduo_text_then(&names, "; ", _("did you mean '%s'?"), near);
    else if (known.bytes)
        ceduo_text_then(&names, "; ", _("scenes that come with it: %s"), known.bytes);
    if (folders.bytes)
        ceduo_text_then(&names, " ", _("(looked for here and in %s)"), folders.bytes);
    ceduo_problem(problems, &(struct source){.name = path}, 0, 0, _("cannot read it: %s%s"), strerror(ENOENT),
                  ceduo_text_string(&names));
}

/* From the text of a scene, and the first n changes, to the scene. */
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
    for (size_t i = 0; i < n; i++)
        if (!set_one(file, source_of(sets, i), problems))
            return false;
    const struct node *root = ceduo_resolve_scene(&file->arena, file->root, problems);
    if (!root)
        return false;
    file->root = root;
    return ceduo_scene_bind(file, problems) && problems->met == before;
}

/* Whether the scene is good with the first n changes alone. */
static bool is_good_with(const struct source *source, const struct scene_sets *sets, size_t n, struct problems *problems)
{
    struct scene_file trial = {0};
    struct problems found = {0};
    bool good = make_scene(&trial, source, sets, n, &found);
    problems->memory |= found.memory;
    ceduo_problems_free(&found);
    ceduo_scene_release(&trial);
    return good;
}

/* Reads a scene. A change that is right by itself may not fit the rest, and what is wrong is then found at a value of the file: the
 * change is named before that. It is the one after which the scene was never good again. */
static bool read_source(struct scene_file *file, const struct source *source, const struct scene_sets *sets,
                        struct problems *problems)
{
    if (make_scene(file, source, sets, sets->n, problems))
        return true;
    if (sets->n == 0 || problems->usage || !ceduo_problems_settle(problems) || !is_good_with(source, sets, 0, problems))
        return false;
    size_t last = sets->n - 1;
    while (last > 0 && !problems->memory && !is_good_with(source, sets, last, problems))
        last--;
    const struct source set = source_of(sets, last);
    const size_t column = (size_t)(equals_of(set.bytes) - set.bytes) + 2;
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
    ceduo_memory_lost(); /* what was lost before is of others */
    size_t length = strlen(path);
    length -= length > 5 && strcmp(path + length - 5, ".yaml") == 0 ? 5 : 0;
    const char *plain = ceduo_arena_copy(&file->arena, path, length);
    const char *found = strcmp(path, "-") == 0 ? path : ceduo_file_find(&file->arena, path, NULL, "scenes");
    if (!found && *path && !strchr(path, '/') && access(path, F_OK) != 0 && errno == ENOENT) {
        complain_no_scene(file, path, plain, problems);
        return false;
    }
    const struct source *source = ceduo_file_read(&file->arena, found ? found : path, YAML_BYTES_MOST, problems);
    if (found && strcmp(found, path) != 0)
        file->name = plain;
    return source && read_source(file, source, sets, problems);
}

bool ceduo_scene_load_text(struct scene_file *file, const char *name, const char *text, struct problems *problems)
{
    *file = (struct scene_file){.path = name};
    ceduo_memory_lost();
    const struct source *source = ceduo_source_keep(&file->arena, (struct source){.name = name, .bytes = text});
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
