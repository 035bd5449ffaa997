/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of a table in a text file. Columns end at "|"; blanks around them are dropped. Double quotes keep blanks, and in them
 * \n, \t, \", \\ and \xc3 are as in C. # begins a comment, == the next table.
 *   for (TABLE(row, "unit/typed.txt", "numbers")) row.at[0] … */
#ifndef TABLE_H
#define TABLE_H

#include "expect.h"

#define TABLE_COLUMNS 6

struct table {
    FILE *file;
    size_t rows;
    char line[1024];
    const char *at[TABLE_COLUMNS]; /* "": missing */
};

static inline struct table table_open(const char *path, const char *title)
{
    struct table t = {0};
    char whole[128], head[128];
    snprintf(whole, sizeof whole, "tests/%s", path);
    snprintf(head, sizeof head, "== %s\n", title);
    t.file = fopen(whole, "r");
    assert_non_null(t.file);
    while (fgets(t.line, sizeof t.line, t.file) && strcmp(t.line, head) != 0)
        ;
    return t;
}

static inline char *table_unescaped(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++) {
        unsigned c = (unsigned char)*from;
        if (*from == '\\' && *++from == 'x' && sscanf(from, "x%2x", &c) == 1)
            from += 2;
        else if (c == '\\')
            c = *from == 'n' ? '\n' : *from == 't' ? '\t' : (unsigned char)*from;
        *to++ = (char)c;
    }
    *to = '\0';
    return text;
}

/* Strip the blanks around a column, or its quotes. */
static inline const char *table_column(char *text)
{
    text += strspn(text, " ");
    for (size_t n = strlen(text); n > 0 && (text[n - 1] == ' ' || text[n - 1] == '\n'); n--)
        text[n - 1] = '\0';
    size_t n = strlen(text);
    if (n < 2 || text[0] != '"' || text[n - 1] != '"')
        return text;
    text[n - 1] = '\0';
    return table_unescaped(text + 1);
}

static inline bool table_next(struct table *t)
{
    do
        if (!fgets(t->line, sizeof t->line, t->file) || strncmp(t->line, "== ", 3) == 0) {
            fclose(t->file);
            EXPECT(t->rows, >, 0);
            return false;
        }
    while (t->line[0] == '#' || t->line[0] == '\n');
    char *rest = t->line, *column;
    for (size_t i = 0; i < TABLE_COLUMNS; i++)
        t->at[i] = (column = strsep(&rest, "|")) ? table_column(column) : "";
    t->rows++;
    return true;
}

#define TABLE(row, path, title)                                                                                                \
    struct table row = table_open(path, title);                                                                                \
    table_next(&row);

#endif
