/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROBLEM_H
#define CEDUO_PROBLEM_H

#include <string.h>

#include "base/text.h"

/* Where text came from: a file, standard input, an option of the command line. */
struct source {
    const char *name;            /* as the user knows it */
    const char *path;            /* of a file; "-": standard input */
    const struct source *before; /* that was read before it into the same memory */
    const char *bytes;           /* with a NUL behind them */
    size_t length;
    bool is_option;     /* a --set: what is wrong with it is a usage error */
    bool is_cell;       /* of a row of --each that is set in that way: it is bad input, and has no line of its own */
    const char *beside; /* of an option: the file that its paths are looked for beside */
    bool foreign;       /* a file that does not say that it is one of ours: it may be anything, and nobody's business */
};

#define CEDUO_FOREIGN_MAX 20 /* columns of such a file that are shown */

/* Bytes of the byte order mark that it begins with; the mark takes no column. */
static inline size_t ceduo_source_mark(const struct source *source)
{
    return source->length >= 3 && memcmp(source->bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

/* The bytes of the line at *at without its end; *at is then the next one. False at the end of the source. */
bool ceduo_source_next(const struct source *source, size_t *at, size_t *from, size_t *to);

/* The byte at a line and column, both from 1, columns in characters; its length where the source has no such line. */
size_t ceduo_source_byte(const struct source *source, size_t line, size_t column);

#define CEDUO_PROBLEMS_MAX   20 /* printed in full */
#define CEDUO_PROBLEMS_LINES 5  /* of others of a kind */

/* Problems of one kind: the same words but for their numbers, about one key of whatever item, in one source. The first is
 * printed in full. */
struct problem_kind {
    uint64_t hash;
    size_t end, more;                   /* where its text ends; how many others there are, */
    size_t lines[CEDUO_PROBLEMS_LINES]; /* and on which lines the first of them stand */
};

/* What is wrong with the input, ready to print: place, mend, the source line and a caret. */
struct problems {
    struct text text;
    size_t count;
    size_t met; /* with those that were known already: whether a step went well */
    size_t kinds_count;
    struct problem_kind kinds[CEDUO_PROBLEMS_MAX];
    struct text known;    /* hashes of those reported */
    struct text warnings; /* about values that are good; follow the text if nothing is wrong */
    bool usage;           /* at least one is about the command line */
    bool cell;            /* that which is of an option is a cell of --each */
    bool memory;          /* memory ran out: the list may lack some */
};

/* Adds one; false, so that a check can end with it. line and column count from 1; 0: no place known (the source's name alone is shown). Of a foreign source the message
 * is without its values, and of its lines only the beginning of the first is shown. */
bool ceduo_problem(struct problems *problems, const struct source *source, size_t line, size_t column, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* Where something is wrong: as above, and the path of a value in the source (NULL or "": none), which is shown even of a foreign
 * one. `own`: its values are none of the source's words, and are shown, too. */
struct problem_place {
    const struct source *source;
    size_t line, column;
    const char *path;
    bool own;
};
bool ceduo_problem_at(struct problems *problems, struct problem_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void ceduo_problem_v(struct problems *problems, struct problem_place place, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));

/* Puts them after the words of `head`, which is none of them, and frees it. */
void ceduo_problems_prepend(struct problems *problems, struct problems *head);

/* Notes whether memory ran out while the input was read; false then. Asked where the reading ends well, and by
 * ceduo_problems_finish(). */
bool ceduo_problems_check_memory(struct problems *problems);

/* Ends the list: how many others there are of a kind, and the number of those that were not printed; the warnings if there is none. */
void ceduo_problems_finish(struct problems *problems);
void ceduo_problems_free(struct problems *problems);

/* Problems that are freed where their block ends. */
#define LOCAL_PROBLEMS(name) __attribute__((cleanup(ceduo_problems_free))) struct problems name = {0}

#endif
