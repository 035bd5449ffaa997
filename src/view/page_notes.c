/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands below a page: warnings of the whole run, and each assumption with the first place that makes it. */
#include <string.h>

#include "base/language.h"
#include "page_parts.h"

static bool is_shown(const struct ceduo_report *report, const struct source_note *note)
{
    return strcmp(note->kind, "assumed") == 0 && (report->years || !ceduo_note_of_years(note));
}

/* How many notes say the same; whether one of them is before `note` in the files, that is, later in the list. */
static bool is_repeated(const struct source_note *last, const struct source_note *note, size_t *times)
{
    const struct source_note *first = NULL;
    *times = 0;
    for (const struct source_note *n = last; n; n = n->before) {
        if (strcmp(n->kind, "assumed") != 0 || strcmp(n->text, note->text) != 0)
            continue;
        ++*times;
        first = n;
    }
    return first != note;
}

/* The notes are kept last first. */
static void add_assumed(struct ceduo_page *page, const struct ceduo_report *report, const struct source_note *note)
{
    size_t times;
    if (!note)
        return;
    add_assumed(page, report, note->before);
    if (!is_shown(report, note) || is_repeated(report->file->notes, note, &times))
        return;
    struct text *line = ceduo_page_add(page, CEDUO_PAGE_ITEM);
    const char *said = ceduo_words_shipped(note->text), *place = note->path[0] ? note->path : _("the scene");
    if (times > 1)
        ceduo_text_format(line, ngettext("%s (%s and %zu more)", "%s (%s and %zu more)", times - 1), said, place, times - 1);
    else
        ceduo_text_format(line, "%s (%s)", said, place);
}

/* A warning of the run; a gap before the first. */
static void warn_of_run(void *context, const char *sentence)
{
    struct ceduo_page **page = context;
    if (page[1] == NULL)
        ceduo_page_add(page[0], CEDUO_PAGE_GAP);
    page[1] = page[0];
    ceduo_page_warn(page[0], sentence);
}

void ceduo_page_notes(struct ceduo_page *page, const struct ceduo_report *report)
{
    struct ceduo_page *warned[2] = {page, NULL};
    struct ceduo_run_remarks remarks = report->remarks;
    remarks.nothing_said = true; /* at the head of the page */
    ceduo_words_run_warnings(report->result, &remarks, warn_of_run, warned);
    const struct source_note *note = report->file->notes;
    while (note && !is_shown(report, note))
        note = note->before;
    if (!note)
        return;
    ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_SECTION), _("* Assumed, not measured:"));
    add_assumed(page, report, report->file->notes);
}
