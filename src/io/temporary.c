/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "temporary.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/utf8.h"

#define MARK      ".ceduo-tmp-"
#define TAIL      24 /* bytes of the longest number of a process, a hyphen and a count */
#define NAME_MOST (NAME_MAX - sizeof MARK - TAIL)
#define TRIES     100
#define DIGITS    "0123456789"

/* Bytes of a path up to and with its last slash. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Room for the names of a target's temporaries, with what they all begin with. Of a long name a part does. */
static bool make_stem(struct temporary *t, const char *target)
{
    size_t folder = folder_length(target), n = strlen(target + folder);
    if (n > NAME_MOST)
        for (n = NAME_MOST; ceduo_utf8_inside(target[folder + n]); n--) /* a character is not cut */
            ;
    *t = (struct temporary){.fd = -1, .target = target, .stem = folder + n};
    if (!(t->path = malloc(t->stem + sizeof MARK + TAIL)))
        return false;
    memcpy(t->path, target, t->stem);
    memcpy(t->path + t->stem, MARK, sizeof MARK);
    t->stem += strlen(MARK);
    return true;
}

/* To be freed. */
static char *folder_of(const struct temporary *t)
{
    size_t n = folder_length(t->path);
    char *folder = strdup(n > 0 ? t->path : ".");
    if (folder && n > 0)
        folder[n] = '\0';
    return folder;
}

/* ---- what others left behind ---- */

static bool is_temporary(const char *name, const char *stem)
{
    size_t n = strlen(stem);
    if (strncmp(name, stem, n) != 0)
        return false;
    size_t process = strspn(name + n, DIGITS);
    const char *hyphen = name + n + process, *count = hyphen + (*hyphen == '-');
    size_t counted = strspn(count, DIGITS);
    return process > 0 && process + counted < TAIL && count > hyphen && counted > 0 && count[counted] == '\0';
}

/* Who has its lock may take it away, if the name still means what was locked. */
static void remove_dead(const char *path)
{
    struct stat opened, there;
    int fd = open(path, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0)
        return;
    if (flock(fd, LOCK_EX | LOCK_NB) == 0 && fstat(fd, &opened) == 0 && S_ISREG(opened.st_mode) && lstat(path, &there) == 0 &&
        opened.st_dev == there.st_dev && opened.st_ino == there.st_ino)
        unlink(path);
    close(fd);
}

static void tidy(struct temporary *t)
{
    size_t folder = folder_length(t->path);
    char *path = folder_of(t);
    DIR *dir = path ? opendir(path) : NULL;
    for (struct dirent *e; dir && (e = readdir(dir));) {
        t->path[t->stem] = '\0';
        if (!is_temporary(e->d_name, t->path + folder))
            continue;
        strcpy(t->path + folder, e->d_name); /* no longer than its own */
        remove_dead(t->path);
    }
    if (dir)
        closedir(dir);
    free(path);
}

void ceduo_temporary_tidy(const char *target)
{
    struct temporary t;
    if (make_stem(&t, target))
        tidy(&t);
    ceduo_temporary_end(&t);
}

/* ---- our own ---- */

static void set_name(struct temporary *t, unsigned count)
{
    snprintf(t->path + t->stem, TAIL, "%ld-%u", (long)getpid(), count);
}

/* Without a name; -1 where that cannot be, or where it could not get one later. */
static int open_nameless(const struct temporary *t)
{
    char *folder = folder_of(t);
    int fd = folder && access("/proc/self/fd", X_OK) == 0 ? open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600) : -1;
    free(folder);
    if (fd >= 0) /* where there are no locks the others leave all alone */
        flock(fd, LOCK_EX | LOCK_NB);
    return fd;
}

/* With a name, and locked. Between the two somebody may have taken it for a dead one's. */
static bool open_named(struct temporary *t)
{
    struct stat st;
    for (unsigned i = 0; i < TRIES; i++) {
        set_name(t, i);
        t->fd = open(t->path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        if (t->fd < 0 && errno != EEXIST)
            return false;
        if (t->fd < 0)
            continue;
        bool taken = flock(t->fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        t->named = !taken && (fstat(t->fd, &st) != 0 || st.st_nlink > 0);
        if (t->named)
            return true;
        close(t->fd);
        t->fd = -1;
    }
    errno = EEXIST;
    return false;
}

bool ceduo_temporary_name(struct temporary *t)
{
    char nameless[64];
    snprintf(nameless, sizeof nameless, "/proc/self/fd/%d", t->fd);
    for (unsigned i = 0; i < TRIES && !t->named; i++) {
        set_name(t, i);
        t->named = linkat(AT_FDCWD, nameless, AT_FDCWD, t->path, AT_SYMLINK_FOLLOW) == 0;
        if (!t->named && errno != EEXIST)
            return false;
    }
    return t->named;
}

bool ceduo_temporary_begin(struct temporary *t, const char *target)
{
    if (!make_stem(t, target))
        return false;
    tidy(t);
    t->fd = open_nameless(t);
    return t->fd >= 0 || open_named(t);
}

/* The rename itself must survive a power cut; where the folder cannot be synced, nothing is lost by going on. */
static void sync_folder(const struct temporary *t)
{
    char *folder = folder_of(t);
    int fd = folder ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (fd >= 0) {
        fsync(fd);
        close(fd);
    }
    free(folder);
}

bool ceduo_temporary_place(struct temporary *t, bool wait)
{
    if (!ceduo_temporary_name(t) || rename(t->path, t->target) != 0)
        return false;
    t->named = false;
    if (wait)
        sync_folder(t);
    return true;
}

void ceduo_temporary_end(struct temporary *t)
{
    if (t->named)
        unlink(t->path);
    if (t->fd >= 0)
        close(t->fd);
    free(t->path);
    *t = (struct temporary){.fd = -1};
}
