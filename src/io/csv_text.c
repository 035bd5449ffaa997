/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the file of a table and converts it to UTF-8 with lines ending in LF. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <uniconv.h>
#include <unistr.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "csv.h"
#include "file.h"

static bool refuse(struct csv *csv, const char *reason)
{
    return ceduo_problem_at(csv->problems, (struct problem_place){.source = csv->source, .own = true}, "%s", reason);
}

/* Return the advice for a binary file, recognized by its first bytes; NULL: not binary. */
static const char *name_binary(const struct source *s)
{
    static const struct {
        const char *bytes, *reason;
        size_t n;
    } kinds[] = {
        {"PK\3\4", N_("this is a workbook; open it and save its sheet as CSV (File, Save as)"), 4},           /* xlsx, ods */
        {"\xd0\xcf\x11\xe0", N_("this is a workbook; open it and save its sheet as CSV (File, Save as)"), 4}, /* xls */
        {"SQLite format 3", N_("this is a GeoPackage or another database; export its layer as CSV"), 15},
        {"%PDF", N_("this is a PDF; save the table as CSV"), 4},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (s->length >= kinds[i].n && memcmp(s->bytes, kinds[i].bytes, kinds[i].n) == 0)
            return _(kinds[i].reason);
    return NULL;
}

/* Replace the text of the source by `bytes`, which are freed. False on failure. */
static bool replace(struct csv *csv, uint8_t *bytes, size_t length)
{
    csv->source->bytes = bytes ? ceduo_arena_copy(csv->arena, (const char *)bytes, length) : NULL;
    csv->source->length = csv->source->bytes ? length : 0;
    free(bytes);
    return csv->source->bytes != NULL;
}

/* True if a text is UTF-16, by its byte order mark or by alternating zero bytes in the first two characters. */
static bool is_utf16(const unsigned char *p, size_t n)
{
    bool marked = n >= 2 && ((p[0] == 0xff && p[1] == 0xfe) || (p[0] == 0xfe && p[1] == 0xff));
    bool zeros = n >= 4 && (p[0] == 0) != (p[1] == 0) && (p[2] == 0) == (p[0] == 0) && (p[3] == 0) == (p[1] == 0);
    return marked || zeros;
}

static bool decode_utf16(struct csv *csv)
{
    const unsigned char *p = (const unsigned char *)csv->source->bytes;
    size_t n = csv->source->length / 2, length;
    bool big = p[0] == 0 || p[0] == 0xfe;
    size_t mark = (p[0] | p[1]) >= 0xfe;
    uint16_t *units = ceduo_arena_alloc(csv->arena, (n + 1) * sizeof *units);
    if (!units) /* untaken: memory */
        return false;
    for (size_t i = 0; i < n; i++)
        units[i] = (uint16_t)(p[2 * i + big] | p[2 * i + !big] << 8);
    if (csv->source->length % 2 != 0 || u16_check(units, n))
        return refuse(csv, _("broken UTF-16; save it again as CSV in UTF-8"));
    uint8_t *bytes = u16_to_u8(units + mark, n - mark, NULL, &length);
    return replace(csv, bytes, length);
}

/* True if a text that is not valid UTF-8 has at least one valid character beyond ASCII. */
static bool is_broken_utf8(const struct source *s)
{
    size_t valid = 0;
    uint32_t code;
    for (size_t i = 0; i < s->length;) {
        size_t n = ceduo_utf8_decode(s->bytes + i, s->length - i, &code);
        valid += n > 1;
        i += n > 0 ? n : 1;
    }
    return valid > 0;
}

/* Convert the text of the source to UTF-8. */
static bool decode(struct csv *csv)
{
    struct source *s = csv->source;
    size_t length = 0;
    bool utf16 = is_utf16((const unsigned char *)s->bytes, s->length);
    if (utf16 && !decode_utf16(csv))
        return false;
    if (!utf16 && u8_check((const uint8_t *)s->bytes, s->length)) {
        if (is_broken_utf8(s))
            return refuse(csv, _("broken UTF-8; save it again as CSV in UTF-8"));
        errno = 0;
        uint8_t *bytes = u8_conv_from_encoding("CP1252", iconveh_error, s->bytes, s->length, NULL, NULL, &length);
        if (!bytes && errno == EILSEQ)
            return refuse(csv, _("neither UTF-8 nor Windows-1252; save it again as CSV in UTF-8"));
        if (!replace(csv, bytes, length))
            return false;
    }
    const char *nul = memchr(s->bytes, '\0', s->length);
    size_t line = 1;
    for (const char *p = s->bytes; nul && p < nul; p++)
        line += *p == '\n';
    /* untaken: complaint */
    return !nul || ceduo_problem_at(csv->problems, (struct problem_place){.source = s, .own = true},
                                    _("a NUL byte (U+0000) on line %zu; save it again as CSV in UTF-8"), line);
}

/* Replace CR by LF in files of old Macintosh, whose lines end in CR alone. */
static bool end_lines(struct csv *csv)
{
    struct source *s = csv->source;
    if (memchr(s->bytes, '\n', s->length) || !memchr(s->bytes, '\r', s->length))
        return true;
    char *bytes = ceduo_arena_copy(csv->arena, s->bytes, s->length);
    for (size_t i = 0; bytes && i < s->length; i++) /* untaken: memory */
        if (bytes[i] == '\r')
            bytes[i] = '\n';
    s->bytes = bytes;
    return bytes != NULL;
}

bool ceduo_csv_open(struct csv *csv, struct arena *arena, const char *path, struct problems *problems)
{
    *csv = (struct csv){.source = (struct source *)(uintptr_t)ceduo_file_read(arena, path, CSV_BYTES_MAX, problems),
                        .arena = arena,
                        .problems = problems};
    size_t before = problems->met;
    if (!csv->source)
        return false;
    const char *binary = name_binary(csv->source);
    if (binary)
        return refuse(csv, binary);
    if (!decode(csv) || !end_lines(csv)) { /* untaken: memory */
        if (problems->met == before)
            ceduo_oom_set_flag();
        return false;
    }
    size_t offset = ceduo_source_mark(csv->source);
    const char *bytes = csv->source->bytes + offset;
    csv->next = (struct csv_place){offset, 1};
    if (!*bytes)
        return ceduo_problem(problems, csv->source, 0, 0, _("the file is empty"));
    if (strncasecmp(bytes, "sep=", 4) == 0 && bytes[4] && strchr("\r\n", bytes[5])) { /* Excel */
        csv->separator = bytes[4];
        csv->next = (struct csv_place){offset + strcspn(bytes, "\n") + (strchr(bytes, '\n') != NULL), 2};
    }
    return true;
}
