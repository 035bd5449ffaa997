/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads, writes and finds files. A file is written beside its target and then renamed; devices are written in place. The bytes
 * read are in the caller's arena, which lists the file. */
#include "file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/language.h"
#include "base/utf8.h"

/* ---- reading ---- */

#define CAPACITY_FIRST ((size_t)64 * 1024)
#define BEGINNING      4096   /* bytes of a file that are searched for its kind */
#define NO_FILE        ENOSTR /* private errno value: not a regular file */

static bool is_standard(const char *path)
{
    return strcmp(path, "-") == 0;
}

/* Read a file into the arena without another copy. Standard input may be anything. Refuse devices: they may never end. Do not
 * read regular files of size 0: some in /proc never end. */
static bool read_file(struct arena *arena, const char *path, size_t max, struct source *into)
{
    struct stat st = {0};
    bool named = !is_standard(path);
    if (named && stat(path, &st) != 0)
        return false;
    if (named && !S_ISREG(st.st_mode) && !S_ISFIFO(st.st_mode)) {
        errno = S_ISDIR(st.st_mode) ? EISDIR : NO_FILE;
        return false;
    }
    int fd = named ? open(path, O_RDONLY | O_NOCTTY | O_CLOEXEC) : STDIN_FILENO, error = 0;
    if (fd < 0 || fstat(fd, &st) != 0)
        error = errno;
    bool sized = S_ISREG(st.st_mode);
    size_t capacity = sized ? (size_t)st.st_size + 1 : CAPACITY_FIRST, n = 0; /* + 1: to detect the end */
    if (error == 0 && sized && (uintmax_t)st.st_size > max)
        error = EFBIG;
    char *bytes = error == 0 ? ceduo_arena_alloc(arena, capacity + 1) : NULL;
    for (ssize_t got = sized ? st.st_size : 1; bytes && error == 0 && got > 0;) {
        got = read(fd, bytes + n, capacity - n);
        if (got < 0)
            error = errno == EINTR ? 0 : errno;
        n += got > 0 ? (size_t)got : 0;
        got = got < 0 ? 1 : got;
        if (n > max)
            error = EFBIG;
        if (n < capacity || error != 0)
            continue;
        char *larger = ceduo_arena_alloc(arena, 2 * capacity + 1);
        if (larger) /* untaken: memory */
            memcpy(larger, bytes, n);
        bytes = larger;
        capacity *= 2;
    }
    if (fd > STDIN_FILENO)
        close(fd);
    into->bytes = bytes;
    into->length = n;
    errno = error != 0 ? error : ENOMEM;
    return bytes && error == 0;
}

const struct source *ceduo_source_copy(struct arena *arena, struct source source)
{
    struct source *copied = ceduo_arena_alloc(arena, sizeof *copied);
    source.name = ceduo_arena_string(arena, source.name);
    source.length = strlen(source.bytes);
    source.bytes = ceduo_arena_copy(arena, source.bytes, source.length);
    const char *base_file = source.base_file ? ceduo_arena_string(arena, source.base_file) : NULL;
    if (!copied || !source.name || !source.bytes || (source.base_file && !base_file))
        return NULL;
    source.base_file = base_file;
    *copied = source;
    return copied;
}

/* True if the beginning of a file has the key ceduo with a kind and its number, as in "ceduo": "scene/1". */
static bool has_kind(const char *bytes, size_t length)
{
    const char *p = bytes, *end = bytes + (length < BEGINNING ? length : BEGINNING);
    while ((p = memmem(p, (size_t)(end - p), "ceduo", 5))) {
        p += 5;
        p += strspn(p, "\"' :"); /* bytes end in NUL */
        size_t n = strspn(p, "abcdefghijklmnopqrstuvwxyz");
        if (n > 0 && p + n + 1 < end && p[n] == '/' && p[n + 1] >= '0' && p[n + 1] <= '9')
            return true;
        p = p < end ? p : end;
    }
    return false;
}

const struct source *ceduo_file_read(struct arena *arena, const char *path, size_t max, struct problems *problems)
{
    struct source *source = ceduo_arena_alloc(arena, sizeof *source);
    char *name = ceduo_arena_string(arena, is_standard(path) ? _("standard input") : path);
    if (!source || !name)
        return NULL;
    *source = (struct source){.name = name, .path = ceduo_arena_string(arena, path), .before = arena->sources};
    errno = ENOMEM;
    if (source->path && read_file(arena, path, max, source)) {
        source->foreign = !has_kind(source->bytes, source->length);
        arena->sources = source;
        return source;
    }
    int error = errno;
    if (error == EFBIG)
        ceduo_problem(problems, source, 0, 0, _("larger than %zu MiB"), max >> 20);
    else if (error != ENOMEM)
        ceduo_problem(problems, source, 0, 0, _("cannot read it: %s"),
                      error == NO_FILE ? _("a device or a socket; name a file") : ceduo_error_text(error));
    return NULL;
}

/* ---- finding ---- */

const char *ceduo_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool is_file(const char *path)
{
    struct stat st;
    return path && stat(path, &st) == 0 && !S_ISDIR(st.st_mode);
}

const char *const *ceduo_file_folders(struct arena *arena)
{
    static const char *const near[] = {"profiles", "../../profiles", "../share/ceduo"};
    const char **folders = ceduo_arena_alloc(arena, 8 * sizeof *folders);
    if (!folders)
        return NULL;
    size_t n = 0;
    const char *data = getenv("XDG_DATA_HOME"), *home = getenv("HOME");
    if (data && data[0] == '/')
        folders[n++] = ceduo_arena_format(arena, "%s/ceduo", data);
    else if (home && home[0])
        folders[n++] = ceduo_arena_format(arena, "%s/.local/share/ceduo", home);
    char self[PATH_MAX] = ""; /* folders next to the program, built or installed */
    /* untaken: machine */
    const char *slash = readlink("/proc/self/exe", self, sizeof self - 1) > 0 ? strrchr(self, '/') : NULL;
    for (size_t i = 0; slash && i < sizeof near / sizeof near[0]; i++) /* untaken: machine */
        folders[n++] = ceduo_arena_format(arena, "%.*s/%s", (int)(slash - self), self, near[i]);
    folders[n++] = ceduo_arena_string(arena, CEDUO_DATADIR);
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        struct stat st;
        if (folders[i] && stat(folders[i], &st) == 0 && S_ISDIR(st.st_mode))
            folders[count++] = folders[i];
    }
    folders[count] = NULL;
    return folders;
}

static const char *find_in(struct arena *arena, const char *root, const char *name, const char *folder)
{
    const char *inside = name; /* without leading ../ */
    while (strncmp(inside, "../", 3) == 0 || strncmp(inside, "./", 2) == 0)
        inside += inside[1] == '/' ? 2 : 3;
    const char *path = ceduo_arena_format(arena, "%s/%s", root, inside);
    if (is_file(path))
        return path;
    if (strchr(name, '/') || !folder)
        return NULL;
    path = ceduo_arena_format(arena, "%s/%s/%s", root, folder, name);
    if (is_file(path))
        return path;
    const char *end = strcmp(folder, "surveys") == 0 ? ".csv" : ".yaml";
    path = ceduo_arena_format(arena, "%s/%s/%s%s", root, folder, name, end);
    return is_file(path) ? path : NULL;
}

const char *ceduo_file_find(struct arena *arena, const char *name, const char *base_file, const char *folder)
{
    if (name[0] == '/')
        return is_file(name) ? name : NULL;
    const char *slash = base_file ? strrchr(base_file, '/') : NULL;
    const char *path = slash ? ceduo_arena_format(arena, "%.*s/%s", (int)(slash - base_file), base_file, name) : name;
    if (is_file(path))
        return path;
    const char *const *folders = ceduo_file_folders(arena);
    for (size_t i = 0; folders && folders[i]; i++)
        if ((path = find_in(arena, folders[i], name, folder)))
            return path;
    return NULL;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

const char *const *ceduo_file_list(struct arena *arena, const char *folder, const char *subfolder, size_t *n)
{
    const char *path = ceduo_arena_format(arena, "%s/%s", folder, subfolder);
    DIR *dir = path ? opendir(path) : NULL;
    size_t entries = 0, length;
    *n = 0;
    if (!dir)
        return NULL;
    while (readdir(dir))
        entries++;
    rewinddir(dir);
    const char **names = ceduo_arena_alloc(arena, entries * sizeof *names);
    for (struct dirent *e; names && *n < entries && (e = readdir(dir));) { /* untaken: race */
        if (e->d_name[0] == '.' || (length = strlen(e->d_name)) <= 5 || strcmp(e->d_name + length - 5, ".yaml") != 0)
            continue;
        if (!(names[*n] = ceduo_arena_copy(arena, e->d_name, length - 5)))
            break;
        ++*n;
    }
    closedir(dir);
    if (*n > 0)
        qsort(names, *n, sizeof *names, by_name);
    return *n > 0 ? names : NULL;
}

/* ---- writing ---- */

bool ceduo_file_write_all(int fd, const char *bytes, size_t n, const atomic_bool *cancel)
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

/* Write the bytes and close `fd`: NFS reports ENOSPC only on close(). */
static bool write_and_close(int fd, const struct pending_file *file)
{
    bool good = ceduo_file_write_all(fd, file->bytes, file->n, NULL) && (!file->target || fsync(fd) == 0);
    int error = errno;
    if (close(fd) != 0 && good)
        return false;
    errno = error;
    return good;
}

/* Find the file to replace and the mode of the new file. Target NULL: write in place (device, dangling link). */
static bool find_target(struct pending_file *file, mode_t *mode)
{
    struct stat st;
    bool exists = stat(file->path, &st) == 0, folder = exists && S_ISDIR(st.st_mode);
    if (folder)
        errno = EISDIR;
    if (folder || (exists ? access(file->path, W_OK) != 0 : errno != ENOENT || !*file->path))
        return false;
    if (exists ? !S_ISREG(st.st_mode) : lstat(file->path, &st) == 0)
        return true;
    mode_t mask = umask(0);
    umask(mask);
    *mode = exists ? st.st_mode & 07777 : 0666 & ~mask;
    file->target = exists ? realpath(file->path, NULL) : strdup(file->path); /* do not replace a link */
    return file->target;
}

/* Create the temporary file beside the target; a long name is shortened. Return its descriptor; -1 with errno set. */
static int open_temporary(struct pending_file *file, mode_t mode)
{
    static const char mark[] = CEDUO_FILE_MARK;
    const char *name = ceduo_file_name(file->target);
    size_t n = strlen(name);
    if (n > CEDUO_FILE_NAME_MAX)
        for (n = CEDUO_FILE_NAME_MAX; ceduo_utf8_is_continuation(name[n]); n--)
            ;
    struct text path = {0};
    ceduo_text_format(&path, "%.*s%s", (int)(name - file->target + (ptrdiff_t)n), file->target, mark);
    errno = ENOMEM;
    int fd = path.bytes ? mkostemp(path.bytes, O_CLOEXEC) : -1;
    if (fd < 0) {
        ceduo_text_free(&path);
        return -1;
    }
    file->temporary = path.bytes;
    if (fchmod(fd, mode) == 0)
        return fd;
    int error = errno;
    close(fd);
    errno = error;
    return -1;
}

bool ceduo_file_prepare(struct pending_file *file)
{
    mode_t mode = 0;
    if (!find_target(file, &mode))
        return false;
    if (!file->target)
        return true;
    int fd = open_temporary(file, mode);
    return fd >= 0 && write_and_close(fd, file);
}

/* Open a device or FIFO, or create the target of a dangling link. */
static int open_in_place(const char *path)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    return fd < 0 && errno == ENOENT ? open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0666) : fd;
}

int ceduo_file_begin(struct pending_file *file)
{
    mode_t mode = 0;
    if (!find_target(file, &mode)) /* untaken: race */
        return -1;
    return file->target ? open_temporary(file, mode) : open_in_place(file->path);
}

bool ceduo_file_finish(struct pending_file *file, int fd)
{
    file->n = 0;
    /* untaken 2: system */
    return write_and_close(fd, file) && (!file->target || ceduo_file_commit(file));
}

bool ceduo_file_commit(struct pending_file *file)
{
    if (!file->target) {
        int fd = open_in_place(file->path);
        return fd >= 0 && write_and_close(fd, file);
    }
    if (rename(file->temporary, file->target) != 0)
        return false;
    free(file->temporary);
    file->temporary = NULL;
    if (!file->wait)
        return true;
    /* the rename must survive a power cut, too; a folder that cannot be synced is no error */
    char *slash = strrchr(file->target, '/');
    if (slash)
        slash[1] = '\0';
    int fd = open(slash ? file->target : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0) {
        fsync(fd);
        close(fd);
    }
    return true;
}

void ceduo_file_abort(struct pending_file *file)
{
    int error = errno;
    if (file->temporary)
        unlink(file->temporary);
    free(file->temporary);
    free(file->target);
    errno = error;
}

bool ceduo_file_write(const char *path, const char *bytes, size_t n)
{
    struct pending_file file = {.path = path, .bytes = bytes, .n = n, .wait = true};
    bool good = ceduo_file_prepare(&file) && ceduo_file_commit(&file);
    ceduo_file_abort(&file);
    return good;
}

bool ceduo_file_is_same(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && (is_standard(b) ? fstat(STDIN_FILENO, &y) : stat(b, &y)) == 0 && S_ISREG(x.st_mode) &&
           x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

bool ceduo_file_is_html(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".html") == 0 || strcasecmp(dot, ".htm") == 0);
}

bool ceduo_file_can_write(const char *path)
{
    struct pending_file file = {.path = path};
    mode_t mode;
    bool good = find_target(&file, &mode);
    if (good && file.target) { /* the temporary file needs a writable folder */
        char *slash = strrchr(file.target, '/');
        if (slash)
            slash[slash == file.target] = '\0';
        good = access(slash ? file.target : ".", W_OK | X_OK) == 0;
    }
    ceduo_file_abort(&file);
    return good;
}
