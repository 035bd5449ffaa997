/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tour: the first questions of a user, answered on the real screens, one key at a time. */
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "popup.h"
#include "program.h"

/* A step: the scene of a question and its first step, then a text and the keys that the text explains, with blanks between.
 * Space, or the key itself, presses the next key. A step that follows keys explains their effect. */
struct tour_step {
    const char *scene;    /* opened at the first step of a question; NULL: the question goes on */
    const char *question; /* at most 36 columns; NULL: the question goes on */
    const char *text;     /* at most two lines of 80 columns */
    const char *keys;     /* "": only read */
};

#define PAPER "paper-site"
#define FOUR  "four-systems"

static const struct tour_step steps[] = {
    {PAPER, N_("Does the forest stop the rocks?"),
     N_("Ten questions on the site of the paper, each on the real screen. Space goes on and presses the keys for you. The tour "
        "saves nothing."),
     ""},
    {NULL, NULL,
     N_("Line 2 is the answer: in how many of the years ahead too many rocks exceed the limit. The right column has the "
        "figures of today."),
     ""},

    {PAPER, N_("How sure is the answer?"), N_("View 7 computes how far the answer can be off if the inputs are uncertain."),
     "7"},
    {NULL, NULL, N_("The bar is the range of 9 in 10 plausible cases. The sentences below say what to measure first."), ""},

    {PAPER, N_("Which of two cuts is better?"), N_("View 5 has a row for each option. So far it is the forest as it is."), "5"},
    {NULL, NULL, N_("a adds an option: another treatment, or another stand. The last of the list is a coppice just cut."),
     "a End Enter"},
    {NULL, NULL, N_("The same with another stand: a selection coppice just cut."), "a End Up Up Up Enter"},
    {NULL, NULL, N_("d deletes the row under the cursor: here the first one, the forest as it is."), "g d"},
    {NULL, NULL, N_("The sentence below the table says which cut lets the fewest dangerous rocks through."), ""},

    {FOUR, N_("How much does a cut yield?"), N_("Another scene, with four treatments. View 5 compares them."), "5"},
    {NULL, NULL, N_("m3/y is the volume felled per hectare and year, beside the years in which the limit is exceeded."), ""},

    {PAPER, N_("How many trees must I keep?"), N_("View 2 is the stand of a belt."), "2"},
    {NULL, NULL, N_("/ goes to a line of the form by a word of its label or of its name in the file."), "/ t r e e s Enter"},
    {NULL, NULL, N_("f finds the value of the field that reaches a goal: here at most 50 of 1000 rocks above the limit."),
     "f Down Down Enter Enter Enter Enter Enter"},
    {NULL, NULL, N_("The line above the keys has the result after some seconds. Here trees alone are not enough."), ""},

    {FOUR, N_("What is the year after a cut like?"), N_("View 6 follows each option from year to year."), "6"},
    {NULL, NULL, N_("The right column is for the year under the cursor: year 1, just cut. Tab enlarges the picture."), ""},

    {PAPER, N_("How do I enter my own slope?"), N_("n asks for a new scene."), "n"},
    {NULL, NULL, N_("Enter takes what is proposed or typed. The profile is a CSV file, or points x z as here."), "Enter Enter"},
    {NULL, NULL, N_("The first lines tell how the profile was read: its length, its fall, and where the rocks start."),
     "Enter Enter Enter Enter Enter Enter Enter"},
    {NULL, NULL, N_("The scene is complete and computed. Each value can now be changed; s saves the scene."), ""},

    {PAPER, N_("How do I enter my own forest?"), N_("In view 2, c takes the counts of a sample plot. p reads a whole survey."),
     "2 c"},
    {NULL, NULL, N_("Size and slope of the plot, then the counts: 12 stools with 40 shoots of 7.5 cm and 8 m, and 2 trees."),
     "Enter Enter 1 2 Enter 4 0 Enter 7 . 5 Enter 8 Enter 2 Enter Enter Enter"},
    {NULL, NULL, N_("The stand now has these stems per hectare, on the horizontal area. Growth and cutting are kept."), ""},

    {PAPER, N_("What if a larger rock falls?"), N_("View 3 is the rock."), "3"},
    {NULL, NULL, N_("Enter opens the field under the cursor: the diameter becomes 0.8 m."), "Down Enter . 8 Enter"},
    {NULL, NULL, N_("The answer follows at once, as after every edit. u undoes."), ""},

    {PAPER, N_("How do I hand in the result?"), N_("w exports what is shown. The last but one is a report to sign."),
     "w End Up Enter"},
    {NULL, NULL, N_("The head of the report: place, owner, parcel, author, date, note. Empty lines are left out."),
     "Enter Enter Enter Enter Enter Enter"},
    {NULL, NULL, N_("Enter would now write the report. The tour leaves that to you, and ends here."), ""},
};

#define STEPS (sizeof steps / sizeof steps[0])

/* Return the number of questions up to a step. */
static int count_questions(const struct tour_step *last)
{
    int n = 0;
    for (const struct tour_step *s = steps; s <= last; s++)
        n += s->question != NULL;
    return n;
}

/* Return the name of the next key of the step; "": none. */
static const char *next_name(const struct app *app)
{
    return ceduo_app_format(app, "%.*s", (int)strcspn(app->tour.keys, " "), app->tour.keys);
}

/* Change the height that remains for the program. */
static void fit_height(struct app *app)
{
    if (app->cells)
        ceduo_app_resize(app, app->cells->width, app->cells->height);
}

static void end_tour(struct app *app)
{
    app->no_recovery = app->tour.no_recovery;
    app->tour.step = NULL;
    fit_height(app);
    ceduo_popup_close(app);
    app->view = VIEW_SLOPE;
    if (ceduo_app_open(app, app->tour.path ? app->tour.path : PAPER, NULL))
        ceduo_app_show_message(app, "%s", _("The tour has ended. n asks for your own slope, o opens a scene, ? has all keys."));
}

/* Begin a step, with its scene if it begins a question. */
static void begin_step(struct app *app, const struct tour_step *step)
{
    app->tour.step = step;
    app->tour.keys = step->keys;
    if (!step->scene)
        return;
    ceduo_popup_close(app);
    app->view = VIEW_SLOPE;
    app->uncertainty_on = !app->tour.no_recovery; /* as at the start of the program */
    if (!ceduo_app_open(app, step->scene, NULL))
        end_tour(app);
}

void ceduo_tour_start(struct app *app, const char *path)
{
    app->tour.path = path;
    app->tour.no_recovery = app->no_recovery;
    app->no_recovery = true;
    app->message[0] = '\0';
    begin_step(app, steps);
    fit_height(app);
}

bool ceduo_tour_is_end(int key)
{
    return key == K_ESCAPE || ceduo_action_find(key) == ACTION_QUIT;
}

bool ceduo_tour_accepts(const struct app *app, int key)
{
    return ceduo_tour_is_end(key) || key == ' ' || key == K_ENTER || key == ceduo_key_find(next_name(app));
}

int ceduo_tour_key(struct app *app, int key)
{
    struct tour *tour = &app->tour;
    const char *name = next_name(app);
    int wanted = ceduo_key_find(name);
    if (ceduo_tour_is_end(key)) {
        end_tour(app);
        return K_NONE;
    }
    tour->keys += strlen(name);
    tour->keys += strspn(tour->keys, " ");
    if (tour->keys[0] == '\0' && tour->step + 1 < steps + STEPS)
        begin_step(app, tour->step + 1);
    else if (tour->keys[0] == '\0')
        end_tour(app);
    return wanted;
}

void ceduo_tour_draw(struct app *app)
{
    const struct tour_step *step = app->tour.step, *question = step;
    struct ceduo_area area = {0, app->height, app->width, app->cells->height - app->height};
    LOCAL_TEXT(text);
    if (!step)
        return;
    while (!question->question)
        question--;
    const char *name = next_name(app);
    const char *head = ceduo_app_format(app, _(" Tour %d/%d  %s"), count_questions(step), count_questions(steps + STEPS - 1),
                                        _(question->question));
    const char *keys = name[0] ? ceduo_app_format(app, _("Space presses %s  Esc ends"), name) : _("Space goes on  Esc ends");
    ceduo_cells_clear_area(app->cells, area);
    struct ceduo_area line = cut_top(&area, 1);
    ceduo_app_draw_label(app, 0, line.top, CEDUO_ROLE_CURSOR, "%-*s", ceduo_utf8_field(head, app->width), head);
    ceduo_canvas_label_right(&app->cells->canvas, app->width - 1, line.top, CEDUO_ROLE_CURSOR,
                             ceduo_app_format(app, " %s", keys));
    ceduo_text_append(&text, _(step->text));
    ceduo_app_draw_text(app, area, CEDUO_ROLE_TEXT, &text);
    ceduo_app_add_hit(app, (struct hit){.area = {0, line.top, app->width, TOUR_LINES}, .key = ' '});
}
