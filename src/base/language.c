/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "language.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>

/* ---- the catalogue ---- */

/* A catalogue begins with a head. Its two tables have the length and the offset of each English text, sorted, and of its
 * translation. A text ends with NUL; a second form for plurals follows after that. */
#define CATALOGUE_MAGIC 0x950412deU
struct head {
    uint32_t magic, revision, count, english, translated; /* the last two: offsets of the tables */
};
struct entry {
    uint32_t length, offset;
};

static const char *catalogue;
static struct head head; /* count 0: text stays English */

static struct entry get_entry(uint32_t table, uint32_t i)
{
    struct entry e;
    memcpy(&e, catalogue + table + i * sizeof e, sizeof e);
    return e;
}

static bool table_is_valid(uint32_t table, uint32_t count, size_t size)
{
    bool good = table <= size && count <= (size - table) / sizeof(struct entry);
    for (uint32_t i = 0; good && i < count; i++) {
        const struct entry e = get_entry(table, i);
        good = e.offset < size && e.length < size - e.offset && catalogue[e.offset + e.length] == '\0';
    }
    return good;
}

bool ceduo_language_use(const char *bytes, size_t size)
{
    catalogue = bytes;
    head = (struct head){0};
    if (bytes && size >= sizeof head)
        memcpy(&head, bytes, sizeof head);
    bool good = bytes && head.magic == CATALOGUE_MAGIC && table_is_valid(head.english, head.count, size) &&
                table_is_valid(head.translated, head.count, size);
    if (!good)
        head = (struct head){0};
    return good;
}

/* Return the translation of a text, or the text. `length` is set to that of all forms of the translation; may be NULL. */
static const char *find_translation(const char *text, size_t *length)
{
    for (uint32_t lo = 0, hi = head.count; lo < hi;) {
        const uint32_t middle = lo + (hi - lo) / 2;
        const int order = strcmp(text, catalogue + get_entry(head.english, middle).offset);
        if (order == 0) {
            const struct entry found = get_entry(head.translated, middle);
            if (length)
                *length = found.length;
            return catalogue + found.offset;
        }
        *(order < 0 ? &hi : &lo) = middle + (order > 0);
    }
    return text;
}

/* ---- texts ---- */

static _Thread_local bool data_language;

void ceduo_language_set_data(bool on)
{
    data_language = on;
}

const char *ceduo_translate(const char *string)
{
    /* the translation of "" is the header of the catalogue */
    return data_language || !string[0] ? string : find_translation(string, NULL);
}

const char *ceduo_in_language(const char *english, const char *italian)
{
    return italian && strcmp(ceduo_translate(N_("en")), "it") == 0 ? italian : english; /* "en" is translated to its own code */
}

const char *ceduo_translate_n(const char *one, const char *many, unsigned long n)
{
    size_t length = 0;
    const char *found = data_language ? one : find_translation(one, &length);
    if (found == one)
        return n == 1 ? one : many;
    const size_t second = strlen(found) + 1; /* Italian has the plural of English */
    return n == 1 || second > length ? found : found + second;
}

const char *ceduo_translate_in(const char *marked)
{
    const char *found = ceduo_translate(marked), *context = strchr(marked, '\004');
    return found == marked && context ? context + 1 : found;
}

const char *ceduo_error_text(int error)
{
    switch (error) {
    case ENOENT:
        return _("No such file or directory");
    case EACCES:
        return _("Permission denied");
    case EPERM:
        return _("Operation not permitted");
    case EISDIR:
        return _("Is a directory");
    case ENOTDIR:
        return _("Not a directory");
    case EEXIST:
        return _("File exists");
    case ENOSPC:
        return _("No space left on device");
    case EDQUOT:
        return _("Disk quota exceeded");
    case EFBIG:
        return _("File too large");
    case EROFS:
        return _("Read-only file system");
    case EIO:
        return _("Input/output error");
    case ENAMETOOLONG:
        return _("File name too long");
    case ELOOP:
        return _("Too many levels of symbolic links");
    case EBADF:
        return _("Bad file descriptor");
    case EMFILE:
        return _("Too many open files");
    default:
        return strerror(error);
    }
}
