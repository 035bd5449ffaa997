/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --resume: the output grows scene by scene. A side file has a line for each scene: hash of its input, number of its lines in
 * the output, their hash, exit status. A scene is appended to the output, then to the side file. After a kill, lines that are
 * missing in the side file, or differ from it, are computed again and appended. At the end the lines are sorted by row if
 * necessary. */
#include "resume.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/language.h"
#include "base/oom.h"
#include "io/file.h"
#include "messages.h"

#define FORMAT      "ceduo-resume-1"
#define PART_LENGTH 59 /* bytes of a line of the side file, with the line end */
#define PART_FORMAT "%016" PRIx64 " %016" PRIx64 " %020zu %03d\n"

/* ---- identity of the run ---- */

uint64_t ceduo_resume_files(const struct scene_file *file)
{
    uint64_t hash = HASH_START;
    for (const struct source *s = file->arena.sources; s; s = s->before)
        hash_count(&hash, hash_bytes(s->bytes, s->length));
    return hash;
}

static void hash_text(uint64_t *hash, const char *text)
{
    hash_count(hash, text ? hash_bytes(text, strlen(text)) : 0);
}

/* Hash all files of the scenes, and all changes except the seed. A scene may be invalid without the changes of a row. */
static uint64_t hash_scenes(const struct arguments *a)
{
    uint64_t hash = HASH_START;
    for (size_t i = 0; i < a->scenes_count; i++) {
        LOCAL_PROBLEMS(problems);
        struct scene_file file;
        hash_text(&hash, a->scenes[i]);
        ceduo_scene_load(&file, a->scenes[i], a->sets.items, a->sets.n, &problems);
        hash_count(&hash, ceduo_resume_files(&file));
        ceduo_scene_release(&file);
    }
    for (size_t i = 0; i < a->sets.n; i++)
        if (strcmp(a->sets.items[i], a->seed_set) != 0)
            hash_text(&hash, a->sets.items[i]);
    return hash;
}

/* Hash the options that change figures, except those with a line of their own. */
static uint64_t hash_options(const struct arguments *a)
{
    uint64_t hash = HASH_START;
    const unsigned words[] = {a->mode, (unsigned)a->stands, a->years, a->window.first, a->window.last, a->window.step, a->goal};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        hash_count(&hash, words[i]);
    hash_count(&hash, a->points);
    hash_each(&hash, a->tolerance, a->find.lo, a->find.hi, a->goal_value, a->sure);
    hash_text(&hash, a->find.path);
    for (size_t i = 0; i < a->options.n; i++)
        hash_text(&hash, a->options.items[i]);
    return hash;
}

/* Hash the head of the output and the names of the columns that are set. */
static uint64_t hash_columns(const struct each *e, const struct text *head)
{
    uint64_t hash = hash_bytes(head->bytes, head->length);
    for (size_t i = 0; i < e->heads_count; i++)
        hash_text(&hash, e->heads[i].sets == PATH_UNKNOWN ? "" : e->heads[i].name);
    return hash;
}

uint64_t ceduo_resume_run(const struct arguments *a, const struct scene_file *file)
{
    uint64_t hash = ceduo_resume_files(file);
    hash_text(&hash, CEDUO_VERSION);
    hash_count(&hash, hash_options(a));
    hash_count(&hash, a->rocks);
    for (size_t i = 0; i < a->sets.n; i++)
        hash_text(&hash, a->sets.items[i]);
    return hash;
}

/* Names of the lines of the identity, in order. */
static const char *const identity_names[] = {N_("version"), N_("scene"), N_("options"), N_("seed"), N_("rocks"), N_("columns")};
enum { IDENTITY = sizeof identity_names / sizeof identity_names[0] };

static void make_identity(struct resume *r, const struct each *e)
{
    const struct arguments *a = r->arguments;
    ceduo_text_format(&r->identity,
                      FORMAT "\nversion %s\nscene %016" PRIx64 "\noptions %016" PRIx64 "\nseed %s\nrocks %" PRIu64
                             "\ncolumns %016" PRIx64 "\n",
                      CEDUO_VERSION, hash_scenes(a), hash_options(a), a->seed_set[0] ? a->seed_set : "-", a->rocks,
                      hash_columns(e, r->head));
}

/* ---- files ---- */

static enum exit_status refuse(const char *path, const char *reason)
{
    ceduo_print_message(path, reason);
    return EXIT_OUTPUT;
}

/* Open a regular file. Return -1 and set *why on error. */
static int open_regular(const char *path, const char **reason)
{
    struct stat st;
    *reason = NULL;
    if (stat(path, &st) == 0 && !S_ISREG(st.st_mode)) {
        *reason = S_ISDIR(st.st_mode) ? ceduo_error_text(EISDIR) : _("--resume needs a regular file, not a device or a pipe");
        return -1;
    }
    int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666);
    if (fd < 0)
        *reason = ceduo_error_text(errno);
    return fd;
}

/* Open and lock the output. If another program has replaced it meanwhile, open the new file. */
static enum exit_status open_locked(struct resume *r)
{
    const char *path = r->arguments->output, *reason;
    for (;;) {
        struct stat own, now;
        r->file = open_regular(path, &reason);
        if (r->file < 0)
            return refuse(path, reason);
        if (flock(r->file, LOCK_EX | LOCK_NB) != 0)
            return refuse(path, errno == EWOULDBLOCK ? _("another ceduo is writing to it; wait for its end, or write elsewhere")
                                                     : ceduo_error_text(errno));
        if (fstat(r->file, &own) == 0 && stat(path, &now) == 0 && own.st_ino == now.st_ino && own.st_dev == now.st_dev)
            return EXIT_DONE;
        close(r->file);
    }
}

/* A file read through a buffer, because an output may be larger than memory. */
#define BUFFER ((size_t)1 << 16)
struct reader {
    int fd;
    size_t length, from, n; /* bytes of the file; begin and length of the buffer */
    bool failed;            /* with errno set */
    char bytes[BUFFER];
};

static void start_reader(struct reader *reader, int fd)
{
    struct stat st = {.st_size = 0};
    reader->fd = fd;
    reader->failed = fstat(fd, &st) != 0;
    reader->length = (size_t)st.st_size;
    reader->from = reader->n = 0;
}

/* Return the bytes at an offset, and their number *n: at least `wanted`, unless the file ends. */
static const char *read_at(struct reader *reader, size_t offset, size_t wanted, size_t *n)
{
    bool inside = offset >= reader->from && offset + wanted <= reader->from + reader->n;
    if (!inside) {
        reader->from = offset;
        reader->n = 0;
    }
    for (ssize_t more = 1; !inside && more != 0 && reader->n < wanted;) {
        more = pread(reader->fd, reader->bytes + reader->n, BUFFER - reader->n, (off_t)(offset + reader->n));
        if (more < 0 && errno == EINTR)
            continue;
        reader->failed |= more < 0;
        if (more <= 0)
            break;
        reader->n += (size_t)more;
    }
    *n = reader->from + reader->n - offset;
    return reader->bytes + (offset - reader->from);
}

/* True if the file begins with these bytes. */
static bool begins_with(struct reader *reader, const char *bytes, size_t length)
{
    for (size_t offset = 0, n; offset < length; offset += n) {
        const char *found = read_at(reader, offset, 1, &n);
        n = n < length - offset ? n : length - offset;
        if (n == 0 || memcmp(found, bytes + offset, n) != 0)
            return false;
    }
    return true;
}

/* Append all bytes, or none, to a file of `end` bytes. False with errno set. */
static bool append(int fd, size_t end, const char *bytes, size_t n)
{
    if (lseek(fd, (off_t)end, SEEK_SET) >= 0 && ceduo_file_write_all(fd, bytes, n, NULL))
        return true;
    int reason = errno;
    if (ftruncate(fd, (off_t)end) != 0)
        reason = errno;
    errno = reason;
    return false;
}

/* ---- existing output ---- */

/* Append the name of each line that differs between two identities. */
static void append_differences(const char *a, const char *b, struct text *names)
{
    for (size_t i = 0; i < IDENTITY; i++) {
        a += strcspn(a, "\n");
        b += strcspn(b, "\n");
        a += *a == '\n';
        b += *b == '\n';
        size_t n = strcspn(a, "\n");
        if (n != strcspn(b, "\n") || strncmp(a, b, n) != 0)
            ceduo_text_append_joined(names, names->length > 0 ? ", " : "", "%s", _(identity_names[i]));
    }
}

static enum exit_status refuse_other(const struct resume *r, const char *names)
{
    LOCAL_TEXT(reason);
    ceduo_text_format(&reason, _("it belongs to another run (different: %s); write elsewhere, or remove it and %s"), names,
                      r->side_path);
    return refuse(r->arguments->output, ceduo_text_string(&reason));
}

/* Read a line of the side file. */
static bool read_part(const char *line, size_t n, struct resume_part *part)
{
    char text[PART_LENGTH + 1] = "";
    int status;
    if (n < PART_LENGTH || line[PART_LENGTH - 1] != '\n')
        return false;
    memcpy(text, line, PART_LENGTH);
    *part = (struct resume_part){0};
    if (sscanf(text, "%16" SCNx64 " %16" SCNx64 " %20zu %3d", &part->key, &part->hash, &part->lines, &status) != 4 ||
        status < 0)
        return false;
    part->status = (enum exit_status)status;
    return true;
}

static uint64_t hash_range(struct reader *reader, size_t from, size_t length)
{
    uint64_t hash = hash_begin(length);
    for (size_t offset = 0, n; offset < length; offset += n) {
        const char *bytes = read_at(reader, from + offset, 8, &n);
        n = n >= length - offset ? length - offset : n - n % 8;
        if (n == 0)
            break;
        hash_chunk(&hash, bytes, n);
    }
    return hash;
}

/* Find the lines of a part, which begin at `from`. Set *whole to true if they match the side file. Return the byte after
 * them. */
static size_t find_lines(struct reader *reader, size_t from, struct resume_part *part, bool *whole)
{
    size_t end = from, n;
    for (size_t i = 0; i < part->lines;) {
        const char *bytes = read_at(reader, end, 1, &n), *line = memchr(bytes, '\n', n);
        end += line ? (size_t)(line - bytes) + 1 : n;
        i += line != NULL;
        if (n == 0)
            break;
    }
    part->from = from;
    part->n = end - from;
    *whole = hash_range(reader, from, part->n) == part->hash;
    return end;
}

static int compare_parts(const void *a, const void *b)
{
    const struct resume_part *x = a, *y = b;
    int order = (x->key > y->key) - (x->key < y->key);
    return order != 0 ? order : (x->from > y->from) - (x->from < y->from);
}

/* Find the complete parts of the output, and truncate both files after the last of them. */
static bool find_parts(struct resume *r, struct reader *output, struct reader *side)
{
    size_t offset = r->identity.length, side_end = offset, from = r->head->length, max = (side->length - offset) / PART_LENGTH,
           n;
    struct resume_part part;
    r->old_parts = ceduo_check_memory(calloc(max + 1, sizeof *r->old_parts));
    r->end = from;
    for (const char *line; line = read_at(side, offset, PART_LENGTH, &n), read_part(line, n, &part); offset += PART_LENGTH) {
        bool whole;
        from = find_lines(output, from, &part, &whole);
        if (!whole)
            continue;
        r->old_parts[r->old_count++] = part;
        r->end = from;
        side_end = offset + PART_LENGTH;
    }
    if (r->old_count > 0)
        qsort(r->old_parts, r->old_count, sizeof *r->old_parts, compare_parts);
    return !output->failed && !side->failed && ftruncate(r->file, (off_t)r->end) == 0 &&
           ftruncate(r->side, (off_t)side_end) == 0;
}

/* Compare the files with this run. Set *again to true if they have no usable line. */
static enum exit_status compare_run(const struct resume *r, struct reader *output, struct reader *side, bool *again)
{
    size_t format = strlen(FORMAT), head = r->head->length, n;
    *again = output->length < head && begins_with(output, r->head->bytes, output->length);
    if (!begins_with(side, FORMAT, side->length < format ? side->length : format))
        return refuse(r->side_path, _("this is not a file of --resume; move it away"));
    if (output->length == 0)
        return EXIT_DONE;
    if (side->length == 0) {
        LOCAL_TEXT(reason);
        ceduo_text_format(&reason, _("its side file %s is missing; write elsewhere, or remove it"), r->side_path);
        return refuse(r->arguments->output, ceduo_text_string(&reason));
    }
    LOCAL_TEXT(found);
    LOCAL_TEXT(names);
    const char *identity = read_at(side, 0, 2 * r->identity.length, &n);
    ceduo_text_append_n(&found, identity, n < 2 * r->identity.length ? n : 2 * r->identity.length);
    append_differences(ceduo_text_string(&r->identity), ceduo_text_string(&found), &names);
    if (names.length == 0 && !*again && !begins_with(output, r->head->bytes, head))
        ceduo_text_append(&names, _("columns")); /* the head differs */
    *again |= side->length < r->identity.length;
    return names.length > 0 ? refuse_other(r, ceduo_text_string(&names)) : EXIT_DONE;
}

static enum exit_status read_files(struct resume *r)
{
    struct reader *readers = ceduo_check_memory(malloc(2 * sizeof *readers)), *output = readers, *side = readers + 1;
    start_reader(output, r->file);
    start_reader(side, r->side);
    bool again = false, good = !output->failed && !side->failed;
    enum exit_status status = good ? compare_run(r, output, side, &again) : EXIT_DONE;
    again |= output->length == 0;
    if (good && status == EXIT_DONE && !again)
        good = find_parts(r, output, side);
    else if (good && status == EXIT_DONE)
        good = ftruncate(r->file, 0) == 0 && ftruncate(r->side, 0) == 0 &&
               append(r->side, 0, r->identity.bytes, r->identity.length);
    int reason = errno;
    free(readers);
    return good ? status : refuse(r->arguments->output, ceduo_error_text(reason));
}

enum exit_status ceduo_resume_open(struct resume *r, struct each *e, const struct text *head)
{
    *r = (struct resume){.arguments = e->given, .head = head, .file = -1, .side = -1};
    LOCAL_TEXT(side);
    const char *reason;
    ceduo_text_format(&side, "%s.resume", e->given->output);
    r->side_path = ceduo_check_memory(strdup(ceduo_text_string(&side)));
    enum exit_status status = open_locked(r);
    if (status != EXIT_DONE)
        return status;
    r->side = open_regular(r->side_path, &reason);
    if (r->side < 0)
        return refuse(r->side_path, reason);
    make_identity(r, e);
    return read_files(r);
}

/* ---- scene by scene ---- */

static void add_to_order(struct resume *r, struct resume_part part)
{
    r->order = ceduo_check_memory(ceduo_grow(r->order, r->order_count, &r->order_capacity, sizeof *r->order));
    r->order[r->order_count++] = part;
}

bool ceduo_resume_has(struct resume *r, uint64_t key, enum exit_status *status)
{
    size_t lo = 0, hi = r->old_count; /* bounds of the first part of this key */
    while (lo < hi) {
        size_t middle = lo + (hi - lo) / 2;
        if (r->old_parts[middle].key < key)
            lo = middle + 1;
        else
            hi = middle;
    }
    if (lo == r->old_count)
        return false;
    struct resume_part *first = &r->old_parts[lo], *part = first + first->used;
    if (first->key != key || part == r->old_parts + r->old_count || part->key != key)
        return false;
    first->used++;
    add_to_order(r, *part);
    *status = part->status;
    return true;
}

/* Append the line of a part to a side file. */
static void append_part(const struct resume_part *part, struct text *side)
{
    ceduo_text_format(side, PART_FORMAT, part->key, part->hash, part->lines, (int)part->status);
}

enum exit_status ceduo_resume_add(struct resume *r, uint64_t key, const struct text *lines, enum exit_status status)
{
    LOCAL_TEXT(side);
    struct stat st;
    struct resume_part part = {
        .key = key, .hash = hash_bytes(lines->bytes, lines->length), .n = lines->length, .status = status};
    for (size_t i = 0; i < lines->length; i++)
        part.lines += lines->bytes[i] == '\n';
    append_part(&part, &side);
    if (r->end == 0) {
        if (!append(r->file, 0, r->head->bytes, r->head->length))
            return refuse(r->arguments->output, ceduo_error_text(errno));
        r->end = r->head->length;
    }
    part.from = r->end;
    if (!append(r->file, r->end, lines->bytes, lines->length))
        return refuse(r->arguments->output, ceduo_error_text(errno));
    r->end += part.n;
    if (fstat(r->side, &st) != 0 || !append(r->side, (size_t)st.st_size, side.bytes, side.length))
        return refuse(r->side_path, ceduo_error_text(errno));
    add_to_order(r, part);
    return EXIT_DONE;
}

/* ---- the end ---- */

static bool is_in_order(const struct resume *r)
{
    size_t from = r->order_count > 0 ? r->head->length : 0;
    for (size_t i = 0; i < r->order_count; i++) {
        if (r->order[i].from != from)
            return false;
        from += r->order[i].n;
    }
    return from == r->end || r->order_count == 0;
}

/* Write the parts of the output in the order of the rows; adjacent parts in one call. False with errno set. */
static bool write_parts(const struct resume *r, struct reader *reader, int fd)
{
    bool good = ceduo_file_write_all(fd, r->head->bytes, r->head->length, NULL);
    for (size_t i = 0, n; good && i < r->order_count; i += n) {
        const struct resume_part *part = &r->order[i];
        size_t length = part->n;
        for (n = 1; i + n < r->order_count && part[n].from == part->from + length; n++)
            length += part[n].n;
        for (size_t offset = 0, piece; good && offset < length; offset += piece) {
            const char *bytes = read_at(reader, part->from + offset, 1, &piece);
            piece = piece < length - offset ? piece : length - offset;
            good = piece > 0 && ceduo_file_write_all(fd, bytes, piece, NULL);
        }
    }
    return good;
}

/* Replace the output by a sorted one. It is locked before the rename, until the program ends. False with errno set. */
static bool replace_output(const struct resume *r)
{
    struct pending_file file = {.path = r->arguments->output, .wait = true};
    struct reader *reader = ceduo_check_memory(malloc(sizeof *reader));
    start_reader(reader, r->file);
    int fd = reader->failed ? -1 : ceduo_file_begin(&file);
    bool locked = fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0 && fcntl(fd, F_DUPFD_CLOEXEC, 0) >= 0;
    bool good = locked && write_parts(r, reader, fd);
    if (fd >= 0 && !good)
        close(fd);
    good = good && ceduo_file_finish(&file, fd);
    free(reader);
    ceduo_file_abort(&file);
    return good;
}

static enum exit_status sort_output(const struct resume *r)
{
    LOCAL_TEXT(side);
    if (!replace_output(r))
        return refuse(r->arguments->output, ceduo_error_text(errno));
    ceduo_text_append_n(&side, r->identity.bytes, r->identity.length);
    for (size_t i = 0; i < r->order_count; i++)
        append_part(&r->order[i], &side);
    return ceduo_file_write(r->side_path, side.bytes, side.length) ? EXIT_DONE : refuse(r->side_path, ceduo_error_text(errno));
}

enum exit_status ceduo_resume_close(struct resume *r, bool whole)
{
    enum exit_status status = EXIT_DONE;
    if (whole && !is_in_order(r)) {
        ceduo_interrupt_catch();
        status = sort_output(r);
        ceduo_interrupt_release();
    }
    if (r->side >= 0)
        close(r->side);
    if (r->file >= 0)
        close(r->file);
    ceduo_text_free(&r->identity);
    free(r->side_path);
    free(r->old_parts);
    free(r->order);
    return status;
}
