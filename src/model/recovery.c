/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/must.h"
#include "io/file.h"

#define UNSAVED "# unsaved work on " /* begins the first line of a copy */

/* Makes every folder of a path. */
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

char *ceduo_recovery_path(const char *path)
{
    struct text name = {0};
    if (!state_folder(&name)) {
        ceduo_text_free(&name);
        return NULL;
    }
    char *real = path ? realpath(path, NULL) : NULL;
    const char *place = real ? real : path ? path : "";
    ceduo_text_format(&name, "/%016" PRIx64 "-%ld.yaml", hash_bytes(place, strlen(place)), (long)getpid());
    free(real);
    return name.bytes;
}

bool ceduo_recovery_write(const char *recovery, const char *path, const char *bytes, size_t n)
{
    LOCAL_TEXT(text);
    char *real = path ? realpath(path, NULL) : NULL;
    ceduo_text_put(&text, UNSAVED);
    ceduo_text_safe(&text, real ? real : "a new scene");
    ceduo_text_char(&text, '\n');
    ceduo_text_add(&text, bytes, n);
    bool good = ceduo_file_save((struct pending_file){.path = recovery, .bytes = text.bytes, .n = text.length});
    free(real);
    return good;
}

char *ceduo_recovery_text(const char *path)
{
    LOCAL_ARENA(arena);
    LOCAL_PROBLEMS(problems);
    const struct source *source = ceduo_file_read(&arena, path, YAML_BYTES_MOST, &problems);
    return source ? ceduo_must(strdup(source->bytes)) : NULL;
}

/* The next copy in the folder whose process has ended: its name is put. */
static bool next_left(DIR *dir, const struct text *folder, struct text *name)
{
    for (struct dirent *e; (e = readdir(dir));) {
        unsigned long long place;
        long process;
        int used = 0;
        if (sscanf(e->d_name, "%16llx-%ld.yaml%n", &place, &process, &used) != 2 || used == 0)
            continue;
        if (process == (long)getpid() || kill((pid_t)process, 0) == 0 || errno == EPERM)
            continue; /* its program still runs */
        name->length = 0;
        ceduo_text_format(name, "%s/%s", folder->bytes, e->d_name);
        if (e->d_name[used] == '\0')
            return true;
        unlink(name->bytes); /* its writer was killed, and it may be half of one */
    }
    return false;
}

#define LISTED_MAX 100

static int newest_first(const void *a, const void *b)
{
    time_t x = ((const struct recovery *)a)->when, y = ((const struct recovery *)b)->when;
    return x < y ? 1 : x > y ? -1 : 0;
}

/* What follows a word to the end of its line, without quotes; NULL where the word is not there. */
static const char *rest_of_line(struct arena *arena, const char *text, const char *word)
{
    const char *at = strstr(text, word);
    if (!at)
        return NULL;
    at += strlen(word);
    at += strspn(at, " \"");
    size_t n = strcspn(at, "\n");
    while (n > 0 && (at[n - 1] == '"' || at[n - 1] == ' '))
        n--;
    return ceduo_arena_copy(arena, at, n);
}

struct recovery *ceduo_recovery_list(struct arena *arena, size_t *n)
{
    LOCAL_TEXT(folder);
    LOCAL_TEXT(name);
    struct recovery *list = ceduo_arena_take(arena, LISTED_MAX * sizeof *list);
    DIR *dir = state_folder(&folder) ? opendir(folder.bytes) : NULL;
    *n = 0;
    while (dir && *n < LISTED_MAX && next_left(dir, &folder, &name)) {
        struct stat st;
        char *text = stat(name.bytes, &st) == 0 ? ceduo_recovery_text(name.bytes) : NULL;
        if (!text)
            continue;
        const char *scene = rest_of_line(arena, text, UNSAVED), *title = rest_of_line(arena, text, "\ntitle:");
        list[(*n)++] = (struct recovery){.file = ceduo_arena_string(arena, name.bytes),
                                         .scene = scene && scene[0] == '/' ? scene : NULL,
                                         .title = title ? title : "",
                                         .when = st.st_mtime};
        free(text);
    }
    if (dir)
        closedir(dir);
    qsort(list, *n, sizeof *list, newest_first);
    return list;
}
