/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which value of the field reaches a goal? */
#include <math.h>
#include <string.h>

#include "base/intl.h"
#include "model/seek.h"
#include "popup.h"
#include "popups.h"

enum { FIND_GOAL, FIND_LO, FIND_HI };

static bool read_goal(struct app *app, char *text, struct ceduo_search *search)
{
    enum ceduo_goal_reading reading = ceduo_goal_read(text, &search->goal, &search->target);
    if (reading == CEDUO_GOAL_NO_SHARE)
        ceduo_app_warn(app, "%s", _("a share is 0 to 1, as 0.05 for 5 %"));
    else if (reading != CEDUO_GOAL_GOOD)
        ceduo_app_warn(app, "%s", _("the goal is adc, free-run, energy=KJ or exceed=SHARE"));
    else if (!ceduo_goals[search->goal].usual && isnan(search->target))
        ceduo_app_warn(app, "%s", _("energy wants a mean in kJ: energy=50"));
    else
        return true;
    return false;
}

#define FIND_ROCKS 2000 /* so that the answer is there soon */

/* What the fields ask for; the path is the popup's. */
static bool read_fields(struct app *app, struct popup *p, struct seek *seek)
{
    char goal[64];
    *seek = (struct seek){.file = &app->document.file,
                          .search = {.path = p->path, .option = app->option, .rocks = FIND_ROCKS}};
    snprintf(goal, sizeof goal, "%.63s", p->fields[FIND_GOAL].text);
    if (!read_goal(app, goal, &seek->search))
        return false;
    if (ceduo_number_read(p->fields[FIND_LO].text, &seek->search.lo) != CEDUO_NUMBER_GOOD ||
        ceduo_number_read(p->fields[FIND_HI].text, &seek->search.hi) != CEDUO_NUMBER_GOOD || !(seek->search.lo <= seek->search.hi)) {
        ceduo_app_warn(app, "%s", _("from and to are numbers, the smaller first"));
        return false;
    }
    return true;
}

/* Starts the search; the popup stays until it is done. */
static bool filled_find(struct app *app, struct popup *p)
{
    struct seek seek;
    if (read_fields(app, p, &seek)) {
        ceduo_jobs_seek(app->figures.jobs, &seek);
        ceduo_app_say(app, "%s", _("looking for it; any key stops"));
    }
    return false;
}

/* Puts the value that was found into the field, and says it. */
static bool take(struct app *app, struct popup *p, struct sought *sought)
{
    struct seek seek;
    const struct ceduo_found *found = &sought->found;
    app->problems = sought->problems;
    sought->problems = (struct problems){0};
    if (sought->status != CEDUO_OK || !read_fields(app, p, &seek))
        return ceduo_app_edited(app, false);
    seek.search.target = sought->target;
    struct text words = {0};
    bool set = true;
    if (found->found && found->whole_range) { /* then the value that is there is as good as another */
        const struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
        ceduo_text_format(&words, _("every value from %s to %s reaches the goal %s; the field stays %s"),
                          p->fields[FIND_LO].text, p->fields[FIND_HI].text, p->fields[FIND_GOAL].text,
                          cell && cell->text[0] ? cell->text : _("as it is"));
    } else {
        ceduo_find_page(&words, &(struct ceduo_find_report){seek.file, &seek.search, found});
    }
    if (found->found && !found->whole_range) {
        char room[CEDUO_NUMBER_ROOM];
        set = ceduo_document_set(&app->document, p->path, ceduo_number_shortest(found->value, room), &app->problems);
        ceduo_app_edited(app, set);
    } else {
        ceduo_problems_free(&app->problems);
    }
    for (char *c = words.bytes; c && *c; c++)
        *c = *c == '\n' ? ' ' : *c;
    if (set && words.bytes)
        ceduo_app_say(app, "%s", words.bytes);
    ceduo_text_free(&words);
    return true;
}

void ceduo_popup_found(struct app *app, struct sought *sought)
{
    struct popup *p = app->popup;
    if (!p || p->filled != filled_find)
        return;
    app->message[0] = '\0';
    if (take(app, p, sought))
        ceduo_popup_close(app);
    else
        snprintf(p->message, sizeof p->message, "%.*s", (int)sizeof p->message - 1, app->message);
}

void ceduo_popup_find(struct app *app)
{
    const struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    bool number = cell && cell->field && (cell->field->type == FIELD_NUMBER || cell->field->type == FIELD_COUNT ||
                                          cell->field->type == FIELD_SPREAD);
    if (!number) {
        ceduo_app_warn(app, "%s", _("put the cursor on a number first: f looks for its value that reaches a goal"));
        return;
    }
    char path[FORM_PATH], lo[CEDUO_NUMBER_ROOM], hi[CEDUO_NUMBER_ROOM];
    snprintf(path, sizeof path, "%s", cell->path);
    double value = 0;
    bool known = ceduo_number_read(cell->text, &value) == CEDUO_NUMBER_GOOD && value > 0;
    ceduo_number_shortest(known ? (cell->field->type == FIELD_COUNT ? 1 : value / 10) : 1, lo);
    ceduo_number_shortest(known ? value * 10 : 1000, hi);
    struct popup *p = ceduo_popup_fields(app, _("Which value reaches a goal?"), filled_find);
    if (!p)
        return;
    snprintf(p->path, sizeof p->path, "%s", path);
    ceduo_text_format(&p->text, _("%s, with the same rocks for every value. Goals at the worst control: adc, free-run, "
                                  "energy=KJ (mean), exceed=SHARE (0.05). What is found is put into the field; u takes it back."),
                      path);
    ceduo_popup_field(p, _("goal"), "adc");
    ceduo_popup_field(p, _("from"), lo);
    ceduo_popup_field(p, _("to"), hi);
}
