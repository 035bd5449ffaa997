/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/language.h"
#include "base/oom.h"
#include "io/file.h"

#define UNSAVED "# unsaved work on " /* start of the first line of a copy */

/* Create every folder of a path. */
static bool make_folders(char *path)
{
    for (char *p = path + 1;; p++) {
        if (*p != '/' && *p != '\0')
            continue;
        char c = *p;
        *p = '\0';
        bool good = mkdir(path, 0700) == 0 || errno == EEXIST;
        *p = c;
        if (!good || c == '\0')
            return good;
    }
}

static bool state_folder(struct text *folder)
{
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    if (state && state[0] == '/')
        ceduo_text_format(folder, "%s/ceduo", state);
    else if (home && home[0] == '/')
        ceduo_text_format(folder, "%s/.local/state/ceduo", home);
    return folder->bytes && make_folders(folder->bytes);
}

/* Return a number that is unique also among machines that share the folder. */
static uint64_t random_number(void)
{
    uint64_t number = (uint64_t)getpid();
    if (getrandom(&number, sizeof number, GRND_NONBLOCK) < 0)
        hash_count(&number, (uint64_t)time(NULL));
    return number;
}

struct recovery_copy ceduo_recovery_begin(const char *path)
{
    struct text name = {0};
    if (!state_folder(&name)) {
        ceduo_text_free(&name);
        return (struct recovery_copy){.file = -1};
    }
    char *real = path ? realpath(path, NULL) : NULL;
    const char *place = real ? real : path ? path : "";
    ceduo_text_format(&name, "/%016" PRIx64 "-%016" PRIx64 ".yaml", hash_bytes(place, strlen(place)), random_number());
    free(real);
    return (struct recovery_copy){.path = name.bytes, .file = -1};
}

/* Replace the copy. The new file is locked before it gets the copy's name. Return its descriptor; -1 on failure. */
static int replace_copy(const char *path, const struct text *text)
{
    LOCAL_TEXT(temporary);
    ceduo_text_format(&temporary, "%s.ceduo-tmp-XXXXXX", path);
    int file = mkostemp(temporary.bytes, O_CLOEXEC); /* mode 0600 */
    if (file < 0)
        return -1;
    bool locked = flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; /* some file systems have no locks */
    if (locked && ceduo_file_write_all(file, text->bytes, text->length, NULL) && rename(temporary.bytes, path) == 0)
        return file;
    unlink(temporary.bytes);
    close(file);
    return -1;
}

#define TRIES 3 /* another process may delete the new file before it is locked, because it looks abandoned */

bool ceduo_recovery_write(struct recovery_copy *copy, const char *path, const char *bytes, size_t n)
{
    LOCAL_TEXT(text);
    char *real = path ? realpath(path, NULL) : NULL;
    ceduo_text_append(&text, UNSAVED);
    ceduo_emit_scalar(&text, real ? real : "a new scene", true);
    ceduo_text_append_char(&text, '\n');
    ceduo_text_append_n(&text, bytes, n);
    free(real);
    int file = -1;
    for (int i = 0; i < TRIES && file < 0; i++)
        file = replace_copy(copy->path, &text);
    if (file < 0)
        return false;
    if (copy->file >= 0)
        close(copy->file);
    copy->file = file;
    return true;
}

/* Close the copy, which unlocks it. */
static void close_copy(struct recovery_copy *copy)
{
    if (copy->path && copy->file >= 0)
        close(copy->file);
    copy->file = -1;
}

void ceduo_recovery_delete(struct recovery_copy *copy)
{
    if (copy->path && copy->file >= 0)
        unlink(copy->path);
    close_copy(copy);
}

void ceduo_recovery_end(struct recovery_copy *copy)
{
    close_copy(copy);
    free(copy->path);
    copy->path = NULL;
}

char *ceduo_recovery_text(const char *path)
{
    LOCAL_ARENA(arena);
    LOCAL_PROBLEMS(problems);
    const struct source *source = ceduo_file_read(&arena, path, YAML_BYTES_MAX, &problems);
    return source ? ceduo_check_memory(strdup(source->bytes)) : NULL;
}

/* True if no process locks the file, and the path still leads to it: its owner may have replaced it. */
static bool is_abandoned(const char *path)
{
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat own, named;
    bool locked = file >= 0 && flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    bool abandoned = file >= 0 && !locked && fstat(file, &own) == 0 && S_ISREG(own.st_mode) && stat(path, &named) == 0 &&
                     own.st_dev == named.st_dev && own.st_ino == named.st_ino;
    if (file >= 0)
        close(file);
    return abandoned;
}

/* Set `name` to the path of the next abandoned copy. Return false if there is none. */
static bool next_abandoned(DIR *dir, const struct text *folder, struct text *name)
{
    for (struct dirent *e; (e = readdir(dir));) {
        int used = 0;
        sscanf(e->d_name, "%*16[0-9a-f]-%*16[0-9a-f].yaml%n", &used);
        if (used == 0)
            continue;
        name->length = 0;
        ceduo_text_format(name, "%s/%s", folder->bytes, e->d_name);
        if (!is_abandoned(name->bytes))
            continue;
        if (e->d_name[used] == '\0')
            return true;
        unlink(name->bytes); /* leftover temporary file of a killed process */
    }
    return false;
}

#define LISTED_MAX 100

static int newest_first(const void *a, const void *b)
{
    time_t x = ((const struct recovery *)a)->when, y = ((const struct recovery *)b)->when;
    return (x < y) - (x > y);
}

static const struct node *read_yaml(struct arena *arena, const char *text)
{
    LOCAL_PROBLEMS(problems);
    const struct source source = {.name = "", .bytes = text, .length = strlen(text)};
    return ceduo_yaml_read(arena, &source, &problems);
}

/* Return the path of the scene from the first line of a copy; NULL: none. */
static const char *read_scene(struct arena *arena, const char *text)
{
    LOCAL_TEXT(line);
    size_t n = strlen(UNSAVED);
    if (strncmp(text, UNSAVED, n) != 0)
        return NULL;
    ceduo_text_format(&line, "scene: %.*s", (int)strcspn(text + n, "\n"), text + n);
    const char *scene = ceduo_node_text(read_yaml(arena, line.bytes), "scene");
    return scene && scene[0] == '/' ? scene : NULL;
}

struct recovery *ceduo_recovery_list(struct arena *arena, size_t *n)
{
    LOCAL_TEXT(folder);
    LOCAL_TEXT(name);
    struct recovery *list = ceduo_arena_alloc(arena, LISTED_MAX * sizeof *list);
    DIR *dir = state_folder(&folder) ? opendir(folder.bytes) : NULL;
    *n = 0;
    while (dir && *n < LISTED_MAX && next_abandoned(dir, &folder, &name)) {
        struct stat st;
        char *text = stat(name.bytes, &st) == 0 ? ceduo_recovery_text(name.bytes) : NULL;
        if (!text)
            continue;
        const struct node *root = read_yaml(arena, text);
        const char *title = ceduo_node_text(root, "title");
        list[(*n)++] = (struct recovery){.file = ceduo_arena_string(arena, name.bytes),
                                         .scene = read_scene(arena, text),
                                         .title = ceduo_in_language(title ? title : "", ceduo_node_text(root, "title_it")),
                                         .when = st.st_mtime};
        free(text);
    }
    if (dir)
        closedir(dir);
    qsort(list, *n, sizeof *list, newest_first);
    return list;
}
