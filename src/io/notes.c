/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "notes.h"

#include <stddef.h>
#include <string.h>

void ceduo_notes_each(const struct source_note *notes, const char *kind, void (*say)(void *context, const char *text),
                      void *context)
{
    if (!notes)
        return;
    ceduo_notes_each(notes->before, kind, say, context); /* kept last first */
    if (strcmp(notes->kind, kind) == 0)
        say(context, notes->text);
}

bool ceduo_path_leads_to(const char *outer, const char *path)
{
    size_t n = strlen(outer);
    return n == 0 || (strncmp(path, outer, n) == 0 && (path[n] == '\0' || path[n] == '.' || path[n] == '['));
}

bool ceduo_note_of_years(const struct source_note *note)
{
    return strstr(note->path, ".growth") != NULL || strstr(note->path, ".cutting") != NULL;
}

bool ceduo_notes_say(const struct source_note *notes, const char *kind, const char *path)
{
    while (notes && !(strcmp(notes->kind, kind) == 0 && ceduo_path_leads_to(path, notes->path) && !ceduo_note_of_years(notes)))
        notes = notes->before;
    return notes != NULL;
}

const struct source_note *ceduo_notes_find(const struct source_note *notes, const char *path)
{
    const struct source_note *best = NULL;
    for (const struct source_note *note = notes; note; note = note->before) {
        if (!ceduo_path_leads_to(note->path, path))
            continue;
        size_t n = strlen(note->path), max = best ? strlen(best->path) : 0;
        if (!best || n > max || (n == max && strcmp(best->kind, "changed") == 0)) /* its own goes before what is around */
            best = note;
    }
    return best;
}
