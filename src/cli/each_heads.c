/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heads of --each: a path of --set, the name of a copied column, or a typing error. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "base/oom.h"
#include "each.h"

/* ---- intended paths ---- */

struct meant {
    const char *pattern; /* path with [] for each index */
    const char *key;     /* last key */
    bool everyday;       /* the key is a common head of other tables, too */
};

struct meants {
    struct arena arena;
    struct meant *items;
    size_t n, capacity;
};

/* Parts of a scene whose keys are everyday words, such as year, count or mean, unless they have a unit: share_seen, least_y. */
static bool is_everyday(const char *pattern, const char *key, enum path_value kind)
{
    static const char *const parts[] = {"page", "rules", "years", "uncertainty", "observed", "design"};
    bool part = strstr(pattern, ".uncertainty[]") != NULL;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        part |= strncmp(pattern, parts[i], strlen(parts[i])) == 0 && strchr(".[", pattern[strlen(parts[i])]);
    return kind == PATH_TEXT || kind == PATH_FILE || (part && !strchr(key, '_'));
}

/* Return a pattern with each of its brackets filled: with the text in the brackets of `from`, then with 0. */
static const char *fill_brackets(struct arena *arena, const char *pattern, const char *from)
{
    LOCAL_TEXT(path);
    for (const char *p = pattern; *p; p++) {
        ceduo_text_append_char(&path, *p);
        if (*p != '[')
            continue;
        const char *open = from ? strchr(from, '[') : NULL, *close = open ? strchr(open, ']') : NULL;
        if (close && close > open + 1)
            ceduo_text_append_n(&path, open + 1, (size_t)(close - open) - 1);
        else
            ceduo_text_append_char(&path, '0');
        from = close;
    }
    return ceduo_arena_string(arena, ceduo_text_string(&path));
}

static void add_meant(struct meants *m, const char *pattern, size_t length, enum path_value kind)
{
    const char *copy = ceduo_arena_copy(&m->arena, pattern, length);
    for (size_t i = 0; i < m->n; i++)
        if (strcmp(m->items[i].pattern, copy) == 0)
            return;
    const char *dot = strrchr(copy, '.'), *key = dot ? dot + 1 : copy;
    m->items = ceduo_arena_grow(&m->arena, m->items, m->n, 1, &m->capacity, sizeof *m->items);
    /* the key of a mapping is never a typing error: energy and height are columns of many tables */
    bool everyday = kind == PATH_OTHER || is_everyday(copy, key, kind);
    m->items[m->n++] = (struct meant){copy, key, everyday};
}

/* Add a value, each part of its path that may be a file, and its top-level key. */
static void add_path(void *meants, const char *path, const struct field *f)
{
    struct meants *m = meants;
    if (f->type == FIELD_TAG)
        return;
    for (size_t n = 1; path[n]; n++)
        if (path[n] == '.' && path[n - 1] != ']') {
            const char *around = ceduo_arena_copy(&m->arena, path, n);
            bool file = ceduo_schema_value(fill_brackets(&m->arena, around, NULL)) == PATH_FILE;
            if (file)
                add_meant(m, path, n, PATH_WORD); /* heads such as stand or slope name the file */
        }
    size_t top = strcspn(path, ".[");
    const char *part = ceduo_arena_copy(&m->arena, path, top);
    if (path[top] && strcmp(part, "page") != 0 && !ceduo_schema_is_settled(part))
        add_meant(m, path, top, PATH_OTHER);
    enum path_value kind = ceduo_schema_value(fill_brackets(&m->arena, path, NULL));
    add_meant(m, path, strlen(path), kind == PATH_OTHER ? PATH_NUMBER : kind);
}

/* ---- typing errors ---- */

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* True if two words differ by one added, missing or replaced letter, or by two exchanged letters. Ignores case. */
static bool is_one_edit(const char *a, const char *b)
{
    size_t n = strlen(a), m = strlen(b), begin = 0, end = 0;
    if (n > m + 1 || m > n + 1)
        return false;
    size_t shorter = n < m ? n : m;
    while (begin < shorter && lower(a[begin]) == lower(b[begin]))
        begin++;
    while (end < shorter - begin && lower(a[n - 1 - end]) == lower(b[m - 1 - end]))
        end++;
    size_t a_rest = n - begin - end, b_rest = m - begin - end;
    bool exchanged =
        a_rest == 2 && b_rest == 2 && lower(a[begin]) == lower(b[begin + 1]) && lower(a[begin + 1]) == lower(b[begin]);
    return exchanged || (a_rest <= 1 && b_rest <= 1);
}

/* Return the path that the head of a copied column probably means; NULL: none. */
static const char *find_meant(const struct meants *m, struct arena *arena, const char *head)
{
    for (size_t i = 0; i < m->n; i++)
        if (m->items[i].everyday && strcmp(head, m->items[i].key) == 0)
            return NULL;
    for (size_t i = 0; i < m->n; i++)
        if (!m->items[i].everyday && strcasecmp(head, m->items[i].key) == 0)
            return fill_brackets(arena, m->items[i].pattern, NULL);
    for (size_t i = 0; i < m->n; i++)
        if (is_one_edit(head, m->items[i].pattern))
            return m->items[i].pattern;
    return NULL;
}

/* Return the path nearest to an invalid path; NULL: none. */
static const char *find_nearest(const struct meants *m, struct arena *arena, const char *head)
{
    LOCAL_TEXT(pattern);
    const char **patterns = ceduo_arena_alloc(arena, (m->n + 1) * sizeof *patterns);
    for (size_t i = 0; i < m->n; i++)
        patterns[i] = m->items[i].pattern;
    for (const char *p = head; *p; p++) {
        ceduo_text_append_char(&pattern, *p);
        if (*p == '[')
            p += strcspn(p, "]") - 1;
    }
    const char *near = ceduo_text_nearest(ceduo_text_string(&pattern), patterns, m->n);
    return near ? fill_brackets(arena, near, head) : NULL;
}

/* Report the head of a copied column if it looks like a path. Return true if it does not. */
static bool check_copied(const struct csv *table, size_t column, const struct meants *m, struct arena *arena, const char *head)
{
    bool path = strpbrk(head, ".[");
    const char *removed = path ? ceduo_removed_hint(head) : NULL;
    if (removed)
        return ceduo_csv_error(table, table->heads[column], "'%s': %s", head, _(removed));
    const char *meant = path ? find_nearest(m, arena, head) : find_meant(m, arena, head);
    if (meant)
        return ceduo_csv_error(table, table->heads[column],
                               _("'%s' is not a path of --set; write '%s' to set it, or rename the column to copy it"), head,
                               meant);
    return !path ||
           ceduo_csv_error(
               table, table->heads[column],
               _("'%s' is not a path of --set (ceduo --list-parameters); to copy the column, rename it without '.' and '['"),
               head);
}

/* ---- all heads ---- */

struct printed_head {
    const char *text; /* in CSV */
    size_t column;
};

static int compare_printed(const void *a, const void *b)
{
    const struct printed_head *x = a, *y = b;
    int order = strcmp(x->text, y->text);
    return order != 0 ? order : (x->column > y->column) - (x->column < y->column);
}

static bool check_duplicates(const struct csv *table, struct arena *arena, const struct each_head *heads, size_t n)
{
    struct printed_head *sorted = ceduo_arena_alloc(arena, (n + 1) * sizeof *sorted);
    size_t named = 0, duplicates = 0;
    for (size_t i = 0; i < n; i++) {
        LOCAL_TEXT(text);
        ceduo_text_append_csv(&text, heads[i].name);
        if (heads[i].name[0])
            sorted[named++] = (struct printed_head){ceduo_arena_string(arena, ceduo_text_string(&text)), i};
    }
    qsort(sorted, named, sizeof *sorted, compare_printed);
    for (size_t i = 1; i < named && duplicates < CEDUO_PROBLEMS_MAX; i++)
        if (strcmp(sorted[i - 1].text, sorted[i].text) == 0) {
            duplicates++;
            ceduo_csv_error(table, table->heads[sorted[i].column], _("'%s' is given twice"), heads[sorted[i].column].name);
        }
    return duplicates == 0;
}

bool ceduo_each_heads(const struct csv *table, struct arena *arena, struct each_head *heads)
{
    struct meants m = {0};
    LOCAL_ARENA(scratch);
    size_t n = table->heads_count, bad = 0;
    ceduo_schema_visit(ceduo_schema_scene(), "", add_path, &m);
    for (size_t i = 0; i < n; i++) {
        const char *name = ceduo_arena_copy(arena, table->heads[i].p, table->heads[i].n);
        enum path_value sets = name[0] ? ceduo_schema_value(name) : PATH_UNKNOWN;
        heads[i] = (struct each_head){name, sets};
        if (name[0] && sets == PATH_UNKNOWN && bad < CEDUO_PROBLEMS_MAX)
            bad += !check_copied(table, i, &m, &scratch, name);
    }
    ceduo_arena_free(&m.arena);
    return check_duplicates(table, &scratch, heads, n) && bad == 0;
}
