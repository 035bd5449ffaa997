/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROBLEM_H
#define CEDUO_PROBLEM_H

#include <string.h>

#include "base/arena.h"
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

#define CEDUO_PROBLEMS_MAX   20 /* listed */
#define CEDUO_PROBLEMS_LINES 5  /* of others of a kind */

/* What is wrong or unusual at a place, and how many others there are of its kind: the same words but for their numbers, about the
 * same key of any item, in one source. Strings are safe to print, in the arena of the problems, and "" if there is none. */
struct problem {
    const char *place;   /* "scene.yaml:3:5", an option, a row of a table */
    const char *path;    /* of the value */
    const char *message; /* without place and path */
    const char *hint;    /* the line of the source, and below it a caret */
    uint64_t kind;
    size_t more, lines[CEDUO_PROBLEMS_LINES]; /* the others, and the lines of the first of them */
};

struct problem_list {
    size_t count, n; /* all, and those listed, each the first of its kind */
    struct problem items[CEDUO_PROBLEMS_MAX + 1];
};

/* Problems of the input. */
struct problems {
    struct problem_list wrong, unusual; /* unusual: values that are good; printed if nothing is wrong */
    size_t met;                         /* wrong, with those that were known already: whether a step went well */
    bool usage;                         /* at least one is about the command line */
    bool cell;                          /* at least one is about a cell of --each */
    bool memory;                        /* memory ran out: the list may lack some */
    struct arena arena;
    struct text known; /* hashes of those reported */
    struct text text;  /* see ceduo_problems_print() */
};

/* A place in a source. */
struct problem_place {
    const struct source *source; /* may be NULL */
    size_t line, column;         /* from 1; 0: not known, the name of the source is shown alone */
    const char *path;            /* of a value, may be NULL; shown even of a foreign source */
    bool own;                    /* values of the message are none of the source's words, and shown even of a foreign source */
    bool unusual;                /* the value is good */
    bool first;                  /* listed before the others */
};

/* Add one. Return false. A foreign source is shown without the values of the message, and of its lines the beginning. */
bool ceduo_problem(struct problems *problems, const struct source *source, size_t line, size_t column, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
bool ceduo_problem_at(struct problems *problems, struct problem_place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void ceduo_problem_v(struct problems *problems, struct problem_place place, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));

/* Return false if memory ran out while the input was read, and note it. Call it where the reading ends well. */
bool ceduo_problems_check_memory(struct problems *problems);

/* Append place, path and message on one line, without its end. */
void ceduo_problem_line(const struct problem *problem, struct text *text);

/* Print all to problems->text, and return it: what is wrong, otherwise what is unusual, and out of memory if it is. */
const char *ceduo_problems_print(struct problems *problems);
void ceduo_problems_free(struct problems *problems);

/* Problems that are freed where their block ends. */
#define LOCAL_PROBLEMS(name) __attribute__((cleanup(ceduo_problems_free))) struct problems name = {0}

#endif
