/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a table into a manual page, between its two marks: tables scene|slope|stand PAGE that of the parameters,
 * tables keys PAGE that of the keys of the terminal program. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/schema.h"
#include "tui/keys.h"

/* Text of a page: what troff would read as a request or an escape is hidden. */
static void put(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '\\')
            fputs("\\e", out);
        else if (*text == '-')
            fputs("\\-", out);
        else if ((unsigned char)*text == 0xe2 && strncmp(text, "\xe2\x80\xa6", 3) == 0) {
            fputs(" to ", out);
            text += 2;
        } else
            fputc(*text, out);
    }
}

static void put_parameter(void *context, const char *path, const struct field *f)
{
    FILE *out = context;
    char range[96];
    if (f->type == FIELD_TAG || strncmp(path, "options[].forest", 16) == 0 || strncmp(path, "forest[].stand.", 15) == 0 ||
        strncmp(path, "slope.", 6) == 0)
        return;
    bool limited = ceduo_schema_range_text(f, range, sizeof range);
    fprintf(out, ".It Va %s\n%s", path, f->meaning);
    if (f->unit[0])
        fprintf(out, "; %s", f->unit);
    if (limited) {
        fputs("; ", out);
        put(out, range);
    }
    for (size_t i = 0; f->choices && i < f->choices->n; i++) {
        fputs(i ? ", " : "; one of ", out);
        put(out, f->choices->names[i]);
    }
    if (f->value)
        fprintf(out, "; default %s", f->value);
    fputs(f->type == FIELD_SPREAD || f->type == FIELD_SPREADS ? "; may have a spread.\n" : ".\n", out);
}

static void put_parameters(FILE *out, const char *kind)
{
    const struct object *object = strcmp(kind, "stand") == 0   ? ceduo_schema_stand()
                                  : strcmp(kind, "slope") == 0 ? ceduo_schema_slope()
                                                               : ceduo_schema_scene();
    fputs(".Bl -tag -width Ds\n", out);
    ceduo_schema_visit(object, "", put_parameter, out);
    fputs(".El\n", out);
}

/* A key as it is called: a single sign that mdoc would take for its own is hidden. */
static void put_key(FILE *out, const char *word)
{
    fputs(" Ic ", out);
    if (strlen(word) == 1 && strchr(".,:;()[]?!|", word[0]))
        fputs("\\&", out);
    put(out, word);
}

static void put_keys(FILE *out)
{
    fputs(".Bl -tag -width \"Shift\\-Tab\" -compact\n", out);
    for (int i = 0; i < ACTION_COUNT; i++) {
        const struct action_row *a = &ceduo_actions[i];
        fputs(".It", out);
        put_key(out, a->word);
        if (a->word2[0]) {
            fputs(" ,", out);
            put_key(out, a->word2);
        }
        fprintf(out, "\n%s\n", a->help);
    }
    fputs(".El\n", out);
}

int main(int argc, char **argv)
{
    if (argc != 3)
        return 2;
    bool keys = strcmp(argv[1], "keys") == 0;
    const char *begin_mark = keys ? ".\\\" begin keys\n" : ".\\\" begin parameters\n";
    const char *end_mark = keys ? ".\\\" end keys\n" : ".\\\" end parameters\n";
    static char page[1 << 20];
    FILE *in = fopen(argv[2], "r");
    size_t n = in ? fread(page, 1, sizeof page - 1, in) : 0;
    char *begin = strstr(page, begin_mark), *end = strstr(page, end_mark);
    if (!in || n == 0 || !begin || !end)
        return 1;
    fclose(in);
    FILE *out = fopen(argv[2], "w");
    if (!out)
        return 1;
    fwrite(page, 1, (size_t)(begin - page) + strlen(begin_mark), out);
    if (keys)
        put_keys(out);
    else
        put_parameters(out, argv[1]);
    fputs(end, out);
    return fclose(out) == 0 ? 0 : 1;
}
