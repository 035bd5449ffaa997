/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_NOTES_H
#define CEDUO_NOTES_H

#include <stdbool.h>

#define CEDUO_NOTE_TABLE "table" /* kind of a note: what was understood of a table */

/* A note of where a value comes from. */
struct source_note {
    const char *path;           /* of the mapping that it stands in, or of a value in it that it is not of */
    const char *kind;           /* measured, literature, assumed; changed: of a value that the source around it is not of */
    const char *text, *text_it; /* in Italian; NULL: not said */
    bool made;                  /* by the program, not in the files */
    const struct source_note *before;
};

/* Call `say` with the text of each note of a kind, in the order of the files. */
void ceduo_notes_each(const struct source_note *notes, const char *kind, void (*say)(void *context, const char *text),
                      void *context);

/* Whether `outer` is `path` or leads to it. */
bool ceduo_path_leads_to(const char *outer, const char *path);

/* Whether a note is of growth or cutting: it matters to the years to come, not to the stand as it is. */
bool ceduo_note_of_years(const struct source_note *note);

/* True where some value below `path` is "assumed", "calibrated", …, but for growth and cutting. */
bool ceduo_notes_say(const struct source_note *notes, const char *kind, const char *path);

/* The note of the innermost mapping around a value; NULL where nothing is said. */
const struct source_note *ceduo_notes_find(const struct source_note *notes, const char *path);

#endif
