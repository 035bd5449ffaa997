/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROBLEM_H
#define CEDUO_PROBLEM_H

#include <string.h>

#include "base/arena.h"
#include "base/text.h"

/* Source of text: a file, standard input, or an option of the command line. */
struct source {
    const char *name;            /* displayed name */
    const char *path;            /* path of a file; "-": standard input */
    const struct source *before; /* source read before it into the same memory */
    const char *bytes;           /* followed by a NUL */
    size_t length;
    bool is_option;        /* a --set: its errors are usage errors */
    bool is_cell;          /* a cell of --each: its errors are bad input; it has no line of its own */
    const char *base_file; /* of an option: file whose folder is searched for its paths */
    bool foreign;          /* not recognized as a file of ceduo: its text may be private */
};

#define CEDUO_FOREIGN_MAX 20 /* columns of a foreign file that are shown */

/* Return the length of the byte order mark; it takes no column. */
static inline size_t ceduo_source_mark(const struct source *source)
{
    return source->length >= 3 && memcmp(source->bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

/* Set the range of the line at *at, without its end, and move *at to the next line. Return false at the end. */
bool ceduo_source_next(const struct source *source, size_t *position, size_t *from, size_t *to);

/* Return the offset of a line and column (from 1, in characters); the length of the source if it has no such line. */
size_t ceduo_source_byte(const struct source *source, size_t line, size_t column);

#define CEDUO_PROBLEMS_MAX   20 /* problems listed */
#define CEDUO_PROBLEMS_LINES 5  /* lines listed of further problems of a kind */

/* An error or warning at a place, with the number of further ones of its kind. Problems of one kind have the same source, key
 * and words, apart from numbers. Strings are escaped, belong to the arena of the problems, and may be "". */
struct problem {
    const char *place;   /* "scene.yaml:3:5", an option, a row of a table */
    const char *path;    /* of the value */
    const char *message; /* without place and path */
    const char *hint;    /* line of the source, with a caret below */
    uint64_t kind;
    size_t more, lines[CEDUO_PROBLEMS_LINES]; /* number of further problems, and the lines of the first ones */
};

struct problem_list {
    size_t count, n; /* all; listed, the first of each kind */
    struct problem items[CEDUO_PROBLEMS_MAX + 1];
};

/* Problems of the input. */
struct problems {
    struct problem_list wrong, unusual; /* unusual: warnings about valid values, printed if nothing is wrong */
    size_t met;                         /* errors including repeated ones; unchanged: a step succeeded */
    bool usage;                         /* at least one concerns the command line */
    bool cell;                          /* at least one concerns a cell of --each */
    bool brief;                         /* record no lines of sources: finding a line takes long in a large table */
    bool memory;                        /* memory ran out: the list may be incomplete */
    struct arena arena;
    struct text known; /* hashes of reported problems */
    struct text text;  /* see ceduo_problems_print() */
};

/* A place in a source. */
struct problem_place {
    const struct source *source; /* may be NULL */
    size_t line, column;         /* from 1; 0: unknown, only the name of the source is shown */
    const char *path;            /* path of a value; may be NULL; shown even for a foreign source */
    bool own;                    /* the message quotes no text of the source; shown even for a foreign source */
    bool unusual;                /* warning about a valid value */
    bool first;                  /* listed before the others */
};

/* Add a problem. Return false. For a foreign source, omit the values of the message and show only the start of the line. */
bool ceduo_problem(struct problems *problems, const struct source *source, size_t line, size_t column, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
bool ceduo_problem_at(struct problems *problems, struct problem_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void ceduo_problem_v(struct problems *problems, struct problem_place place, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));

/* Return false, and note it, if memory ran out while the input was read. Call it after a successful read. */
bool ceduo_problems_check_memory(struct problems *problems);

/* Append place, path and message as one line without newline. */
void ceduo_problem_line(const struct problem *problem, struct text *text);

/* Print errors, or warnings if there are no errors, and lack of memory, to problems->text. Return the text. */
const char *ceduo_problems_print(struct problems *problems);
void ceduo_problems_free(struct problems *problems);

/* Problems that are freed at the end of their block. */
#define LOCAL_PROBLEMS(name) __attribute__((cleanup(ceduo_problems_free))) struct problems name = {0}

#endif
