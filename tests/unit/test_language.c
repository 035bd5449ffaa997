/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: brief */
/* Text without a translation, data text, which is never translated, and catalogues. */
#include "test.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>

#include "base/language.h"

TEST(untranslated_text_is_unchanged)
{
    for (int data = 0; data < 2; data++) {
        ceduo_language_set_data(data);
        assert_string_equal(_("no such text"), "no such text");
        assert_string_equal(_(""), "");
        assert_string_equal(ngettext("%d rock", "%d rocks", 1), "%d rock");
        assert_string_equal(ngettext("%d rock", "%d rocks", 0), "%d rocks");
        assert_string_equal(P_("head", "no such head"), "no such head");
        assert_string_equal(ceduo_translate_in(N_("no context")), "no context");
    }
    ceduo_language_set_data(false);
}

/* A catalogue with three texts: head, two tables, texts. */
#define HEAD  20U
#define COUNT 3U
#define TEXTS (HEAD + 16 * COUNT)
static const char texts[] = "%d rock\0%d rocks\0en\0head\004word\0%d masso\0%d massi\0it\0parola";
static const uint32_t entries[] = {0x950412de, 0,  COUNT,      HEAD, HEAD + 8 * COUNT, 16, TEXTS,     2, TEXTS + 17, 9,
                                   TEXTS + 20, 17, TEXTS + 30, 2,    TEXTS + 48,       6,  TEXTS + 51};

static void make_catalogue(char bytes[TEXTS + sizeof texts])
{
    memcpy(bytes, entries, TEXTS);
    memcpy(bytes + TEXTS, texts, sizeof texts);
}

TEST(a_catalogue_translates)
{
    static char bytes[TEXTS + sizeof texts];
    make_catalogue(bytes);
    assert_true(ceduo_language_use(bytes, sizeof bytes));
    assert_string_equal(ngettext("%d rock", "%d rocks", 1), "%d masso");
    assert_string_equal(ngettext("%d rock", "%d rocks", 0), "%d massi");
    assert_string_equal(P_("head", "word"), "parola");
    assert_string_equal(ngettext("head\004word", "words", 2), "parola"); /* has one form */
    assert_string_equal(_("between"), "between");
    assert_string_equal(ceduo_in_language("english", "italian"), "italian");
    ceduo_language_use(NULL, 0);
    assert_string_equal(ceduo_in_language("english", "italian"), "english");
}

/* The messages of the system in English, which the catalogues translate. */
TEST(errors_of_the_system_have_texts)
{
    static const struct {
        int error;
        const char *text;
    } rows[] = {{ENOENT, "No such file or directory"},
                {EACCES, "Permission denied"},
                {EPERM, "Operation not permitted"},
                {EISDIR, "Is a directory"},
                {ENOTDIR, "Not a directory"},
                {EEXIST, "File exists"},
                {ENOSPC, "No space left on device"},
                {EDQUOT, "Disk quota exceeded"},
                {EFBIG, "File too large"},
                {EROFS, "Read-only file system"},
                {EIO, "Input/output error"},
                {ENAMETOOLONG, "File name too long"},
                {ELOOP, "Too many levels of symbolic links"},
                {EBADF, "Bad file descriptor"},
                {EMFILE, "Too many open files"}};
    for (size_t i = 0; i < LENGTH(rows); i++)
        assert_string_equal(ceduo_error_text(rows[i].error), rows[i].text);
}

TEST(a_damaged_catalogue_is_refused)
{
    char bytes[TEXTS + sizeof texts];
    make_catalogue(bytes);
    for (size_t size = 0; size < sizeof bytes; size++)
        assert_false(ceduo_language_use(bytes, size));
    for (size_t i = 0; i < TEXTS; i += sizeof(uint32_t)) {
        make_catalogue(bytes);
        memset(bytes + i, 0xff, sizeof(uint32_t));
        assert_int_equal(ceduo_language_use(bytes, sizeof bytes), i == sizeof(uint32_t)); /* the revision */
        assert_string_equal(P_("head", "none"), "none");
    }
    make_catalogue(bytes);
    bytes[TEXTS + 16] = 'x'; /* the end of the first text */
    assert_false(ceduo_language_use(bytes, sizeof bytes));
    ceduo_language_use(NULL, 0);
}
