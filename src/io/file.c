/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and writes whole files, and finds them. A file is written beside its target and then takes its place
 * (temporary.c); what is no regular file is written straight. Reading never waits for ever. What is read lies in the
 * arena of the caller; where this has a shelf, each file is read once and kept there. */
#include "file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/language.h"
#include "temporary.h"

/* ---- reading ---- */

#define ROOM_FIRST ((size_t)64 * 1024)
#define FIFO_WAIT  3000 /* ms */
#define PART       8192 /* bytes read or written at a time: a stack may be small */
#define BEGINNING  4096 /* bytes of a file in which it says what it is */

/* Reasons of our own, by numbers that no call here gives. */
#define NOBODY_WRITES ETIME
#define NO_FILE       ENOSTR
#define NO_END        ENOSR

/* Some of the system's files, /proc/kmsg for one, seem empty and never end: who reads on waits for ever. */
static bool waits_for_more(int fd)
{
    struct pollfd poll_fd = {.fd = fd, .events = POLLIN};
    struct stat st;
    return fstat(fd, &st) == 0 && S_ISREG(st.st_mode) && st.st_size == 0 && poll(&poll_fd, 1, 0) == 0;
}

/* As read(), but what writes to a FIFO may begin later: a reader that came first waits for it, though not for ever.
 * `first`: nothing was read yet. */
static ssize_t read_part(int fd, char *to, size_t room, bool first)
{
    struct pollfd poll_fd = {.fd = fd, .events = POLLIN};
    struct stat st;
    if (waits_for_more(fd)) {
        errno = NO_END;
        return -1;
    }
    for (bool waited = false, came = false;;) {
        ssize_t n = read(fd, to, room);
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0 && errno == EAGAIN && fstat(fd, &st) == 0 && S_ISREG(st.st_mode)) {
            errno = NO_END;
            return -1;
        }
        if (n < 0 && errno == EAGAIN) { /* it is there, and has nothing to say yet */
            came = true;
            poll(&poll_fd, 1, -1);
            continue;
        }
        if (n != 0 || came || !first || fstat(fd, &st) != 0 || !S_ISFIFO(st.st_mode))
            return n;
        if (waited) {
            errno = NOBODY_WRITES;
            return -1;
        }
        int ready = poll(&poll_fd, 1, FIFO_WAIT);
        if (ready > 0 && !(poll_fd.revents & POLLIN)) /* it came and went */
            return 0;
        waited = ready == 0;
    }
}

/* What a file holds, straight into the arena: a large one is in memory once. `size` is what the file says of itself; a
 * device or pipe says nothing. */
static bool read_all(int fd, struct arena *arena, size_t size, size_t most, struct source *into)
{
    size_t room = size > 0 ? size + 1 : ROOM_FIRST, n = 0; /* one more, to see the end */
    char *bytes = ceduo_arena_take(arena, room + 1);
    while (bytes) {
        ssize_t got = read_part(fd, bytes + n, room - n, n == 0);
        if (got < 0)
            return false;
        n += (size_t)got;
        into->bytes = bytes;
        into->length = n;
        if (got == 0)
            return true;
        if (n > most) {
            errno = EFBIG;
            return false;
        }
        if (n < room)
            continue;
        room *= 2;
        char *more = ceduo_arena_take(arena, room + 1);
        if (more)
            memcpy(more, bytes, n);
        bytes = more;
    }
    errno = ENOMEM;
    return false;
}

static bool read_text(int fd, struct text *into, size_t most)
{
    char part[PART];
    for (;;) {
        ssize_t n = read_part(fd, part, sizeof part, into->length == 0);
        if (n < 0)
            return false;
        if (n == 0)
            return true;
        ceduo_text_add(into, part, (size_t)n);
        if (into->failed) {
            errno = ENOMEM;
            return false;
        }
        if (into->length > most) {
            errno = EFBIG;
            return false;
        }
    }
}

static bool is_standard(const char *path)
{
    return strcmp(path, "-") == 0;
}

/* 0, or why this is not read: only files, pipes and terminals come to an end, and /dev/null. A socket can only be standard
 * input, as some programs give it. */
static int why_not(int fd, const struct stat *st)
{
    struct stat null;
    switch (st->st_mode & S_IFMT) {
    case S_IFREG:
    case S_IFIFO:
    case S_IFSOCK:
        return 0;
    case S_IFDIR:
        return EISDIR;
    case S_IFCHR:
        return isatty(fd) || (stat("/dev/null", &null) == 0 && null.st_rdev == st->st_rdev) ? 0 : NO_FILE;
    default:
        return NO_FILE;
    }
}

/* Does not wait for somebody to open the other end of a FIFO: read_part() does, but not for ever. */
static int open_to_read(const char *path)
{
    bool standard = is_standard(path);
    int fd = standard ? STDIN_FILENO : open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    struct stat st = {0};
    if (fd < 0 && errno == ENXIO) /* a socket, or a device that is not there */
        errno = NO_FILE;
    int why = fd >= 0 && fstat(fd, &st) == 0 ? why_not(fd, &st) : 0;
    if (why != 0) {
        if (!standard)
            close(fd);
        errno = why;
        return -1;
    }
    if (fd >= 0 && !standard && !S_ISFIFO(st.st_mode) && !(S_ISREG(st.st_mode) && st.st_size == 0))
        fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) & ~O_NONBLOCK);
    return fd;
}

const char *ceduo_file_why(int why)
{
    switch (why) {
    case NOBODY_WRITES:
        return _("no program writes to this FIFO");
    case NO_FILE:
        return _("a device or a socket; name a file");
    case NO_END:
        return _("this file has no end; name a regular file");
    default:
        return strerror(why);
    }
}

/* Keeps the errno of what was done before. */
static void close_read(const char *path, int fd)
{
    int why = errno;
    if (fd >= 0 && !is_standard(path))
        close(fd);
    errno = why;
}

static bool read_file(struct arena *arena, const char *path, size_t most, struct source *source)
{
    int fd = open_to_read(path);
    struct stat st;
    bool sized = fd >= 0 && fstat(fd, &st) == 0 && S_ISREG(st.st_mode) && st.st_size > 0;
    bool good = fd >= 0;
    if (sized && (uintmax_t)st.st_size > most) {
        errno = EFBIG; /* told without reading it */
        good = false;
    }
    good = good && read_all(fd, arena, sized ? (size_t)st.st_size : 0, most, source);
    close_read(path, fd);
    return good;
}

bool ceduo_file_take(const char *path, struct text *text, size_t most)
{
    int fd = open_to_read(path);
    bool good = fd >= 0 && read_text(fd, text, most);
    close_read(path, fd);
    return good;
}

/* ---- the shelf ---- */

static bool same(const char *a, const char *b)
{
    return a && b ? strcmp(a, b) == 0 : a == b;
}

static const char *keep(struct arena *arena, const char *string)
{
    return string ? ceduo_arena_string(arena, string) : NULL;
}

bool ceduo_shelf_find(struct arena *arena, struct shelf *shelf, const char *name, const char *beside, const char *folder,
                      const char *path)
{
    struct shelf_find *find = ceduo_arena_take(arena, sizeof *find);
    if (!find)
        return false;
    *find = (struct shelf_find){.name = keep(arena, name),
                                .beside = keep(arena, beside),
                                .folder = keep(arena, folder),
                                .path = keep(arena, path),
                                .before = shelf->finds};
    if (arena->failed) /* its words are not all there */
        return false;
    shelf->finds = find;
    return true;
}

bool ceduo_shelf_file(struct arena *arena, struct shelf *shelf, const char *path, const char *bytes, size_t length)
{
    struct shelf_file *file = ceduo_arena_take(arena, sizeof *file);
    if (!file)
        return false;
    *file = (struct shelf_file){.path = keep(arena, path), .bytes = bytes, .length = length, .before = shelf->files};
    if (arena->failed)
        return false;
    shelf->files = file;
    return true;
}

static const struct shelf_file *on_shelf(const struct shelf *shelf, const char *path)
{
    for (const struct shelf_file *f = shelf ? shelf->files : NULL; f; f = f->before)
        if (strcmp(f->path, path) == 0)
            return f;
    return NULL;
}

/* Into the arena, and onto its shelf: a file that is used twice is read once. */
static bool read_into(struct arena *arena, const char *path, size_t most, struct source *source)
{
    struct shelf *shelf = arena->shelf;
    const struct shelf_file *known = on_shelf(shelf, path);
    if (known && known->length > most) {
        errno = EFBIG;
        return false;
    }
    if (known) {
        source->bytes = known->bytes;
        source->length = known->length;
        return true;
    }
    errno = ENOENT;
    bool good = !(shelf && shelf->closed) && read_file(arena, path, most, source);
    int why = errno;
    if (good && shelf && !ceduo_shelf_file(arena, shelf, path, source->bytes, source->length)) {
        good = false;
        why = ENOMEM;
    }
    errno = why;
    return good;
}

const struct source *ceduo_source_keep(struct arena *arena, struct source source, struct problems *problems)
{
    struct source *kept = ceduo_arena_take(arena, sizeof *kept);
    source.name = ceduo_arena_string(arena, source.name);
    source.length = strlen(source.bytes);
    source.bytes = ceduo_arena_copy(arena, source.bytes, source.length);
    const char *beside = keep(arena, source.beside);
    if (!kept || !source.name || !source.bytes || (source.beside && !beside)) {
        ceduo_problem_memory(problems);
        return NULL;
    }
    source.beside = beside;
    *kept = source;
    return kept;
}

/* Whether the beginning of a file says what it is: ceduo, then a kind and its number, as in "ceduo": "scene/1". */
static bool says_kind(const char *bytes, size_t length)
{
    const char *p = bytes, *end = bytes + (length < BEGINNING ? length : BEGINNING);
    while ((p = memmem(p, (size_t)(end - p), "ceduo", 5))) {
        for (p += 5; p < end && (*p == '"' || *p == '\'' || *p == ' ' || *p == ':'); p++)
            ;
        const char *kind = p;
        while (p < end && *p >= 'a' && *p <= 'z')
            p++;
        if (p > kind && end - p > 1 && p[0] == '/' && p[1] >= '0' && p[1] <= '9')
            return true;
    }
    return false;
}

const struct source *ceduo_file_read(struct arena *arena, const char *path, size_t most, struct problems *problems)
{
    struct source *source = ceduo_arena_take(arena, sizeof *source);
    char *name = ceduo_arena_string(arena, is_standard(path) ? _("standard input") : path);
    if (!source || !name) {
        ceduo_problem_memory(problems);
        return NULL;
    }
    *source = (struct source){.name = name};
    if (read_into(arena, path, most, source)) {
        source->foreign = !says_kind(source->bytes, source->length);
        return source;
    }
    int why = errno;
    if (why == ENOMEM)
        ceduo_problem_memory(problems);
    else if (why == EFBIG)
        ceduo_problem(problems, source, 0, 0, _("larger than %zu MiB"), most >> 20);
    else
        ceduo_problem(problems, source, 0, 0, _("cannot read it: %s"), ceduo_file_why(why));
    return NULL;
}

/* ---- finding ---- */

static const char *join(struct arena *arena, const char *folder, size_t length, const char *name)
{
    size_t n = strlen(name);
    char *path = ceduo_arena_take(arena, length + n + 2);
    if (!path)
        return NULL;
    memcpy(path, folder, length);
    path[length] = '/';
    memcpy(path + length + 1, name, n + 1);
    return path;
}

static bool is_file(const char *path)
{
    struct stat st;
    return path && stat(path, &st) == 0 && !S_ISDIR(st.st_mode);
}

/* Beside the program: where it was built and where it is installed. */
static size_t program_folders(struct arena *arena, const char **folders)
{
    static const char *const near[] = {"profiles", "../../profiles", "../share/ceduo"};
    char self[PATH_MAX];
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    if (n <= 0)
        return 0;
    self[n] = '\0';
    char *slash = strrchr(self, '/');
    if (!slash)
        return 0;
    for (size_t i = 0; i < 3; i++)
        folders[i] = join(arena, self, (size_t)(slash - self), near[i]);
    return 3;
}

const char *const *ceduo_file_folders(struct arena *arena)
{
    const char **folders = ceduo_arena_take(arena, 8 * sizeof *folders);
    if (!folders)
        return NULL;
    size_t n = 0;
    const char *data = getenv("XDG_DATA_HOME"), *home = getenv("HOME");
    if (data && data[0] == '/')
        folders[n++] = join(arena, data, strlen(data), "ceduo");
    else if (home && home[0])
        folders[n++] = join(arena, home, strlen(home), ".local/share/ceduo");
    n += program_folders(arena, folders + n);
    folders[n++] = ceduo_arena_string(arena, CEDUO_DATADIR);
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        struct stat st;
        if (folders[i] && stat(folders[i], &st) == 0 && S_ISDIR(st.st_mode))
            folders[kept++] = folders[i];
    }
    folders[kept] = NULL;
    return folders;
}

/* A path without the steps up at its start: what may stand in a folder of profiles. */
static const char *without_steps_up(const char *name)
{
    while (strncmp(name, "../", 3) == 0 || strncmp(name, "./", 2) == 0)
        name += name[1] == '/' ? 2 : 3;
    return name;
}

static const char *find_in(struct arena *arena, const char *root, const char *name, const char *folder)
{
    const char *inside = join(arena, root, strlen(root), without_steps_up(name));
    if (is_file(inside))
        return inside;
    if (strchr(name, '/') || !folder)
        return NULL;
    const char *shelf = join(arena, root, strlen(root), folder);
    const char *path = shelf ? join(arena, shelf, strlen(shelf), name) : NULL;
    if (is_file(path))
        return path;
    char *longer = path ? ceduo_arena_take(arena, strlen(path) + 6) : NULL;
    if (!longer)
        return NULL;
    strcat(strcpy(longer, path), strcmp(folder, "surveys") == 0 ? ".csv" : ".yaml");
    return is_file(longer) ? longer : NULL;
}

static const char *find(struct arena *arena, const char *name, const char *beside, const char *folder)
{
    if (name[0] == '/')
        return is_file(name) ? name : NULL;
    const char *slash = beside ? strrchr(beside, '/') : NULL;
    const char *path = slash ? join(arena, beside, (size_t)(slash - beside), name) : name;
    if (is_file(path))
        return path;
    const char *const *folders = ceduo_file_folders(arena);
    for (size_t i = 0; folders && folders[i]; i++)
        if ((path = find_in(arena, folders[i], name, folder)))
            return path;
    return NULL;
}

const char *ceduo_file_find(struct arena *arena, const char *name, const char *beside, const char *folder)
{
    struct shelf *shelf = arena->shelf;
    if (!shelf)
        return find(arena, name, beside, folder);
    for (const struct shelf_find *f = shelf->finds; f; f = f->before)
        if (strcmp(f->name, name) == 0 && same(f->beside, beside) && same(f->folder, folder))
            return f->path;
    const char *path = shelf->closed ? NULL : find(arena, name, beside, folder);
    return path && ceduo_shelf_find(arena, shelf, name, beside, folder, path) ? path : NULL;
}

static int by_name(const void *a, const void *b)
{
    /* by what stands before .yaml: a name before its own continuation */
    const char *p = *(const char *const *)a, *q = *(const char *const *)b;
    size_t n = strlen(p) - 5, m = strlen(q) - 5;
    int order = strncmp(p, q, n < m ? n : m);
    return order != 0 ? order : (n > m) - (n < m);
}

static bool is_yaml(const char *name)
{
    size_t n = strlen(name);
    return n > 5 && name[0] != '.' && strcmp(name + n - 5, ".yaml") == 0;
}

const char *const *ceduo_file_list(struct arena *arena, const char *folder, const char *shelf, size_t *n)
{
    const char *path = join(arena, folder, strlen(folder), shelf);
    DIR *dir = path ? opendir(path) : NULL;
    const char **names = NULL;
    size_t room = 0;
    *n = 0;
    for (struct dirent *e; dir && (e = readdir(dir));) {
        if (!is_yaml(e->d_name))
            continue;
        if (*n == room) { /* what is outgrown stays in the arena until the end: shelves are short */
            const char **more = ceduo_arena_take(arena, (room = room ? 2 * room : 32) * sizeof *more);
            if (!more)
                break;
            if (names)
                memcpy(more, names, *n * sizeof *more);
            names = more;
        }
        if (!(names[*n] = ceduo_arena_string(arena, e->d_name)))
            break;
        ++*n;
    }
    if (dir)
        closedir(dir);
    if (*n > 0)
        qsort(names, *n, sizeof *names, by_name);
    return names;
}

/* ---- writing ---- */

bool ceduo_file_fill(int fd, const char *bytes, size_t n, const atomic_bool *cancel)
{
    while (n > 0) {
        ssize_t done = write(fd, bytes, n);
        if (done < 0 && errno == EINTR && !(cancel && atomic_load(cancel)))
            continue;
        if (done < 0)
            return false;
        bytes += done;
        n -= (size_t)done;
    }
    return true;
}

static bool write_content(int fd, const struct pending_file *file)
{
    char part[PART];
    ssize_t n = 0;
    off_t at = 0;
    while (file->before >= 0 && (n = pread(file->before, part, sizeof part, at)) > 0) {
        if (!ceduo_file_fill(fd, part, (size_t)n, NULL))
            return false;
        at += n;
    }
    return n == 0 && ceduo_file_fill(fd, file->bytes, file->n, NULL);
}

static bool write_straight(const struct pending_file *file)
{
    int fd = open(file->path, O_WRONLY | O_CLOEXEC);
    if (fd < 0)
        return false;
    bool good = write_content(fd, file);
    int why = errno;
    if (close(fd) != 0 && good)
        return false;
    errno = why;
    return good;
}

/* It stays open, and so locked, until it is in its place. */
static bool fill_temporary(const struct pending_file *file, mode_t mode)
{
    int fd = file->temporary.fd;
    bool good = fchmod(fd, mode) == 0 && write_content(fd, file) && (!file->wait || fsync(fd) == 0);
    int once_more = good ? dup(fd) : -1; /* some file systems say only now that there is no room */
    return once_more >= 0 && close(once_more) == 0;
}

static mode_t usual_mode(void)
{
    mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

/* Where a path that leads to nothing yet leads, through links. To be freed. */
static char *follow_links(const char *path)
{
    char *at = strdup(path);
    for (int i = 0; at && i < 16; i++) {
        char to[PATH_MAX];
        ssize_t n = readlink(at, to, sizeof to - 1);
        if (n < 0)
            return at;
        to[n] = '\0';
        struct text next = {0};
        const char *slash = strrchr(at, '/');
        if (to[0] != '/' && slash)
            ceduo_text_add(&next, at, (size_t)(slash - at) + 1);
        ceduo_text_put(&next, to);
        free(at);
        at = next.bytes;
        if (next.failed) {
            ceduo_text_free(&next);
            at = NULL;
        }
    }
    errno = at ? ELOOP : ENOMEM;
    free(at);
    return NULL;
}

static bool prepare(struct pending_file *file)
{
    struct stat st;
    bool exists = stat(file->path, &st) == 0;
    file->temporary.fd = -1;
    if (exists && !S_ISREG(st.st_mode))
        return true;
    if (exists && access(file->path, W_OK) != 0)
        return false;
    file->target = exists ? realpath(file->path, NULL) : follow_links(file->path); /* a link stays a link */
    return file->target && ceduo_temporary_begin(&file->temporary, file->target) &&
           fill_temporary(file, exists ? st.st_mode & 07777 : usual_mode());
}

bool ceduo_file_prepare(struct pending_file *file, const char *path, const char *bytes, size_t n)
{
    *file = (struct pending_file){.path = path, .before = -1, .bytes = bytes, .n = n, .wait = true};
    return prepare(file) && (!file->target || ceduo_temporary_name(&file->temporary));
}

bool ceduo_file_place(struct pending_file *file)
{
    return file->target ? ceduo_temporary_place(&file->temporary, file->wait) : write_straight(file);
}

void ceduo_file_drop(struct pending_file *file)
{
    int why = errno;
    ceduo_temporary_end(&file->temporary);
    free(file->target);
    errno = why;
}

static bool write_file(struct pending_file file)
{
    bool good = prepare(&file) && ceduo_file_place(&file);
    ceduo_file_drop(&file);
    return good;
}

bool ceduo_file_write(const char *path, const char *bytes, size_t n)
{
    return write_file((struct pending_file){.path = path, .before = -1, .bytes = bytes, .n = n, .wait = true});
}

bool ceduo_file_write_quickly(const char *path, const char *bytes, size_t n)
{
    return write_file((struct pending_file){.path = path, .before = -1, .bytes = bytes, .n = n});
}

bool ceduo_file_write_after(int before, const char *path, const char *bytes, size_t n)
{
    return write_file((struct pending_file){.path = path, .before = before, .bytes = bytes, .n = n, .wait = true});
}

void ceduo_file_tidy(const char *path)
{
    struct stat st;
    bool exists = stat(path, &st) == 0;
    char *target = !exists ? follow_links(path) : S_ISREG(st.st_mode) ? realpath(path, NULL) : NULL;
    if (target)
        ceduo_temporary_tidy(target);
    free(target);
}

bool ceduo_file_same(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && (is_standard(b) ? fstat(STDIN_FILENO, &y) : stat(b, &y)) == 0 && S_ISREG(x.st_mode) &&
           x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

bool ceduo_file_can_write(const char *path)
{
    struct stat st;
    bool exists = stat(path, &st) == 0;
    if (exists && S_ISDIR(st.st_mode))
        errno = EISDIR;
    if (exists ? S_ISDIR(st.st_mode) || access(path, W_OK) != 0 : errno != ENOENT || !*path)
        return false;
    if (exists && !S_ISREG(st.st_mode))
        return true;
    char *target = exists ? realpath(path, NULL) : follow_links(path);
    if (!target)
        return false;
    char *slash = strrchr(target, '/');
    if (slash)
        slash[slash == target] = '\0';
    bool good = access(slash ? target : ".", W_OK | X_OK) == 0; /* a file beside it is to take its place */
    int why = errno;
    free(target);
    errno = why;
    return good;
}
