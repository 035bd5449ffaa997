/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Search for the value of the field that reaches a goal. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "popup.h"
#include "scene/regulation.h"
#include "view/value_text.h"

enum { FIND_GOAL, FIND_TARGET, FIND_SURE, FIND_LO, FIND_HI };

#define FIND_ROCKS 2000 /* few, for a quick answer */

/* ---- the goal ---- */

/* A goal in words. The amount is typed in the unit: per 1000, %, kJ, m. */
static const struct {
    enum ceduo_goal goal;
    const char *words, *unit;
    double per; /* amount of the unit in one unit of the goal */
} goals[] = {{CEDUO_GOAL_ADC, N_("mean distance between hits below … m (ADC)"), "m", 1},
             {CEDUO_GOAL_FREE_RUN, N_("probability of a free run at most … %"), "%", 100},
             {CEDUO_GOAL_EXCEED, N_("at most … per 1000 exceed the limit"), N_("per 1000"), 1000},
             {CEDUO_GOAL_ARRIVE, N_("at most … per 1000 arrive"), N_("per 1000"), 1000},
             {CEDUO_GOAL_WORST_EXCEED, N_("worst year: at most … per 1000 exceed the limit"), N_("per 1000"), 1000},
             {CEDUO_GOAL_WORST_ARRIVE, N_("worst year: at most … per 1000 arrive"), N_("per 1000"), 1000},
             {CEDUO_GOAL_ENERGY, N_("mean energy of arrivals at most … kJ"), "kJ", 1}};
#define GOALS_OFFERED (sizeof goals / sizeof goals[0])

static void complete_goals(struct app *app, struct popup *p)
{
    (void)app;
    for (size_t i = 0; i < GOALS_OFFERED; i++)
        ceduo_popup_add_item(p, _(goals[i].words), _(goals[i].words));
}

/* Read words of the list, or the form of the command line: energy=50. The amount may be in the field below. */
static bool read_goal(struct app *app, struct popup *p, struct ceduo_search *search)
{
    const char *typed = p->fields[FIND_GOAL].line.text;
    enum ceduo_goal_reading reading = ceduo_goal_read(ceduo_app_format(app, "%s", typed), &search->goal, &search->target);
    size_t row = 0;
    while (row < GOALS_OFFERED && strcmp(typed, _(goals[row].words)) != 0 &&
           !(reading == CEDUO_GOAL_GOOD && goals[row].goal == search->goal))
        row++;
    if (row == GOALS_OFFERED)
        ceduo_app_warn(app, "%s",
                       reading == CEDUO_GOAL_NO_SHARE
                           ? _("a share is a number from 0 to 1: 0.05 for 5 %")
                           : _("the goal is one of the list, or adc, free-run, energy=KJ, exceed=SHARE, arrive=SHARE"));
    double amount = NAN;
    if (row == GOALS_OFFERED || !ceduo_popup_number(app, p, FIND_TARGET, &amount))
        return false;
    search->goal = goals[row].goal;
    search->target = reading == CEDUO_GOAL_GOOD ? search->target : NAN;
    search->target = isnan(amount) ? search->target : amount / goals[row].per;
    if (ceduo_goal_is_share(search->goal) && search->target > 1)
        ceduo_app_warn(app, _("%g %s is impossible"), amount, _(goals[row].unit));
    else if (!ceduo_goals[search->goal].usual && isnan(search->target))
        ceduo_app_warn(app, _("how many %s? This goal has no default"), _(goals[row].unit));
    else
        return true;
    return false;
}

/* ---- the request ---- */

/* Append the regional rules for standards if the searched value is a number of standards. */
static void append_standards_rule(struct app *app, const char *path, struct text *text)
{
    const struct ceduo_belt *belt = ceduo_app_belt(app);
    const struct field *field = ceduo_search_field(app->scratch, path);
    const char *stand = ceduo_app_stand(app);
    bool standards = strncmp(path, stand, strlen(stand)) == 0 &&
                     (strcmp(field->key, "stay_per_ha") == 0 || strncmp(path + strlen(stand), ".trees[", 7) == 0);
    if (!standards || !belt)
        return;
    struct ceduo_compliance c = ceduo_regulation_check(&app->document.file.scene.rules, &belt->stand);
    double own = app->document.file.scene.reserves_minimum;
    if (c.standards_item)
        ceduo_text_append_joined(text, " ", _("The rules of %s require at least %g standards per ha (%s, %u); %g are left."),
                                 c.regulation->name, c.standards_item->min, c.standards_item->article, c.standards_item->year,
                                 c.standards);
    if (!isnan(own) && own > 0)
        ceduo_text_append_joined(text, " ", _("The scene requires at least %g per ha."), own);
}

/* Read the fields; the path is the popup's. */
static bool read_search(struct app *app, struct popup *p, struct ceduo_search *search)
{
    double cases = 0; /* plausible cases of 100 in which the goal must be reached */
    *search = (struct ceduo_search){.path = p->target, .option = app->option, .rocks = FIND_ROCKS, .lo = NAN, .hi = NAN};
    if (!read_goal(app, p, search) || !ceduo_popup_number(app, p, FIND_SURE, &cases) ||
        !ceduo_popup_number(app, p, FIND_LO, &search->lo) || !ceduo_popup_number(app, p, FIND_HI, &search->hi))
        return false;
    search->sure = cases / 100;
    if (search->lo <= search->hi)
        return true;
    ceduo_app_warn(app, "%s", _("two bounds are needed, the smaller first"));
    return false;
}

/* Start the search. The popup stays open until it is done. */
static bool submit_search(struct app *app, struct popup *p)
{
    struct ceduo_search search;
    if (read_search(app, p, &search)) {
        ceduo_jobs_request(app->live.jobs,
                           &(struct job_request){JOB_SEARCH, &app->document.file, .levels = 1, .search = &search});
        ceduo_app_show_message(app, "%s", _("computing … Esc or another key stops it"));
    }
    return false;
}

/* ---- the result ---- */

/* Append the value found and whether it is unique. After a search over a rotation, append the yield. */
static void append_result(struct app *app, struct popup *p, const struct ceduo_search *s, const struct search_answer *answer,
                          struct text *text)
{
    const struct ceduo_found *f = &answer->found;
    const struct field *field = ceduo_search_field(app->scratch, p->target);
    char buf[CEDUO_NUMBER_SIZE];
    if (f->found && !f->whole_range) /* otherwise the field keeps its value */
        ceduo_text_format(text, "%s = %s: ", ceduo_app_path(app, p->target), ceduo_format_number(field, f->value, buf));
    ceduo_find_words(text, s, f, field, s->sure == 0); /* no space, and the user has typed it */
    if (!f->monotone)
        ceduo_text_append_joined(text, "; ", _("not monotone: there may be other values"));
    if (s->sure > 0) {
        ceduo_text_append(text, "; ");
        ceduo_find_reliable(text, s, &answer->sure, field);
    }
    if (s->rotation)
        ceduo_text_append_joined(text, "; ", _("over the years ahead"));
    if (s->rotation && !isnan(answer->yield.cut_per_year))
        ceduo_text_append_joined(text, ", ", _("yielding %.3g m\xc2\xb3 per ha and year"), answer->yield.cut_per_year);
}

/* Set the value found in the field, and report it. A failed search leaves the popup open. */
void ceduo_popup_on_found(struct app *app, struct search_answer *answer)
{
    struct popup *p = app->popup;
    struct ceduo_search search;
    const struct ceduo_found *found = &answer->found;
    LOCAL_TEXT(words);
    if (!p || p->on_submit != submit_search)
        return;
    app->message[0] = '\0';
    ceduo_problems_free(&app->document.problems);
    app->document.problems = answer->problems;
    answer->problems = (struct problems){0};
    if (answer->status != CEDUO_OK || !read_search(app, p, &search)) {
        ceduo_app_finish_edit(app, false);
        return;
    }
    search.target = answer->target;
    search.rotation = answer->rotation;
    append_result(app, p, &search, answer, &words);
    if (!found->found || found->whole_range ||
        ceduo_app_finish_edit(app, ceduo_document_set(&app->document, p->target, ROUNDTRIP(found->value))))
        ceduo_app_show_message(app, "%s", words.bytes);
    ceduo_popup_close(app);
}

/* ---- the range ---- */

static bool is_valid_value(const struct app *app, const char *path, double value)
{
    return ceduo_preview_fits(&app->document.file, path, ROUNDTRIP(value));
}

/* Return a value of three digits between `current` and `end`, as close to the end as the scene allows; may be `current`. */
static double find_limit(const struct app *app, const char *path, bool whole, double current, double end)
{
    if (is_valid_value(app, path, end))
        return end;
    double valid = current, invalid = end;
    for (int i = 0; i < 20; i++) {
        double middle = whole ? round((valid + invalid) / 2) : (valid + invalid) / 2;
        if (middle == valid || middle == invalid)
            break;
        *(is_valid_value(app, path, middle) ? &valid : &invalid) = middle;
    }
    double grain = valid == 0 ? 1 : pow(10, floor(log10(fabs(valid))) - 2);
    double inward = end > current ? floor(valid / grain) * grain : ceil(valid / grain) * grain;
    bool between = end > current ? inward >= current : inward <= current;
    return between && is_valid_value(app, path, inward) ? inward : valid;
}

/* Propose a range around the current value with ends that the scene accepts. */
static void propose_range(struct app *app, const char *path, const struct field *f, const char *written, double *lo, double *hi)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    bool whole = f->type == FIELD_COUNT || strcmp(f->unit, "1/ha") == 0;
    double current;
    bool known = ceduo_number_read(written, &current) == CEDUO_NUMBER_GOOD;
    *lo = known && current > 0 && f->type != FIELD_COUNT ? current / 10 : 1;
    *hi = known && current > 0 ? current * 10 : 1000;
    *lo = whole ? floor(*lo) : *lo;
    if (f->flags & FIELD_PLACE) {
        *lo = s->origin_x;
        *hi = s->origin_x + s->x[s->vertices - 1];
    }
    *lo = fmax(*lo, f->lo);
    *hi = fmin(*hi, f->hi);
    if (known) {
        *lo = find_limit(app, path, whole, current, fmin(*lo, current));
        *hi = find_limit(app, path, whole, current, fmax(*hi, current));
    }
}

/* Open the popup; `written`: the current value. */
static void ask_goal(struct app *app, const char *path, const char *written)
{
    char buf[CEDUO_NUMBER_SIZE];
    double lo, hi;
    const struct field *f = ceduo_search_field(app->scratch, path);
    propose_range(app, path, f, written, &lo, &hi);
    struct popup *p = ceduo_popup_fields(app, _("Which value reaches a goal?"), path, submit_search);
    ceduo_text_format(&p->text,
                      _("Value of: %s. Every value is tried with the same rocks; the goal applies to the worst control. The "
                        "result replaces the field (u undoes)."),
                      ceduo_app_path(app, path));
    append_standards_rule(app, path, &p->text);
    ceduo_popup_add_choice(p, _("goal"), _(goals[0].words), complete_goals);
    ceduo_popup_add_value(p, _("how many (empty: default)"), "", &ceduo_popup_amount);
    struct field *cases = ceduo_popup_add_value(p, _("in … % of plausible cases"), "", &ceduo_popup_amount);
    cases->hi = 100;
    cases->flags = FIELD_ABOVE;
    for (int i = 0; i < 2; i++) {
        const char *end = ceduo_format_number(f, i == 0 ? lo : hi, buf);
        struct field *own = ceduo_popup_add_value(p, i == 0 ? _("values from") : _("to"), end, f);
        own->shown.usual_min = -INFINITY; /* no end is unusual */
        own->shown.usual_max = INFINITY;
    }
}

static void select_number(struct app *app, struct popup *p)
{
    const struct node *node = ceduo_document_node(&app->document, p->value);
    ask_goal(app, p->value, node && node->kind == NODE_SCALAR ? node->text : "");
}

/* Ask for the number of a list to search, one of the first nine. */
static void ask_list_number(struct app *app, const char *path, const struct node *list)
{
    if (list->n == 1) {
        ask_goal(app, ceduo_app_format(app, "%s[0]", path), list->items[0]->text);
        return;
    }
    struct popup *p = ceduo_popup_list(app, _("Which number of the list?"), "", select_number);
    for (size_t i = 0; i < list->n && i < POPUP_DIGITS_MAX; i++)
        ceduo_popup_add_menu_item(p, (char)('1' + i), list->items[i]->kind == NODE_SCALAR ? list->items[i]->text : "",
                                  ceduo_app_format(app, "%s[%zu]", path, i));
}

void ceduo_popup_find(struct app *app)
{
    const struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    const struct node *node = cell ? ceduo_document_node(&app->document, cell->path) : NULL;
    bool usable = cell && !(cell->field->flags & FIELD_NO_MEMBER);
    enum field_type type = usable ? cell->field->type : FIELD_TEXT;
    if (type == FIELD_NUMBERS && node && node->kind == NODE_LIST)
        ask_list_number(app, cell->path, node);
    else if (type == FIELD_NUMBER || type == FIELD_COUNT || type == FIELD_SPREAD)
        ask_goal(app, cell->path, cell->written);
    else
        ceduo_app_warn(app, "%s", _("put the cursor on a number first; f finds its value for a goal"));
}
