/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POPUP_H
#define CEDUO_POPUP_H

#include "app.h"
#include "picker.h"
#include "scene/schema.h"

enum popup_kind { POPUP_TEXT, POPUP_FIELD, POPUP_LIST, POPUP_FIELDS }; /* FIELD: one that stands in the form */

#define POPUP_FIELDS_MAX 16
#define POPUP_DIGITS_MAX 9 /* answers that a digit chooses, 1 to 9 */

/* Callers whose number of fields or answers comes from a table assert at build that it fits. */
_Static_assert(CEDUO_ASKED_FIELDS_MAX <= POPUP_FIELDS_MAX, "a popup asks for all fields of a mapping");
_Static_assert(CEDUO_ASKED_KINDS_MAX <= POPUP_DIGITS_MAX, "a digit chooses a kind of observation");

/* What a popup calls. */
typedef void popup_call(struct app *app, struct popup *popup);

/* The fields were filled, or one of them is left. False: it is said what is wrong, and it stays open. */
typedef bool popup_check(struct app *app, struct popup *popup);

/* A line to fill. */
struct popup_field {
    char label[40];
    struct line line;
    int row;             /* of the caller's table of fields, for its own use */
    popup_call *offer;   /* adds to the picker what goes with the text that is typed; NULL: nothing is offered */
    struct field *value; /* what may stand there: it is checked as the line is left; NULL: anything */
};

struct popup {
    enum popup_kind kind;
    const char *title;
    struct arena arena;
    struct text text;                            /* to read; over a list or fields: what it is about */
    struct popup_field fields[POPUP_FIELDS_MAX]; /* of a list the first: what is searched for, and its items if they change */
    size_t fields_count;
    size_t at;             /* the field under the cursor */
    struct picker picker;  /* of the list, or of the field under the cursor */
    const char *endings;   /* of files that may be typed: ".csv .txt"; NULL: none */
    bool asks;             /* a list of few answers: the first letter of each chooses it, nothing is searched for */
    bool ready;            /* what is offered was listed once */
    bool moved;            /* the cursor was moved in the picker */
    bool typed_wins;       /* a new name: what is typed stays, unless the cursor was moved in the picker */
    struct viewport lines; /* of a text, or fields */
    struct ceduo_area box; /* where it was drawn */
    const char *path;      /* what a choice is for */
    const char *kept;      /* a text that goes with it */
    const char *value;     /* the item under the cursor, or the one that was chosen */
    struct preview ahead;  /* what it would do to the lights, once that is computed */
    bool ahead_known;
    popup_call *chosen;  /* `value`; the popup is off the screen already, and freed after the call */
    popup_call *preview; /* puts `text` anew for `value`; of a text: each time it is drawn; NULL: it stays */
    popup_check *filled, *check;
    void (*picture)(struct app *app, struct popup *popup, struct ceduo_area area); /* below fields, where nothing is offered */
    void (*then)(struct app *app); /* what goes on once unsaved work is saved or given up */
};

/* Each opens a popup in place of any other; `path`: what it is for, kept as a copy. */
struct popup *ceduo_popup_text(struct app *app, const char *title);
struct popup *ceduo_popup_list(struct app *app, const char *title, const char *path, popup_call *chosen);
struct popup *ceduo_popup_fields(struct app *app, const char *title, const char *path, popup_check *filled);
void ceduo_popup_item(struct popup *popup, const char *text, const char *value);
/* An item that a key chooses, which stands before its words; all items of the list must be such. */
void ceduo_popup_answer(struct popup *popup, char key, const char *text, const char *value);
struct popup_field *ceduo_popup_field(struct popup *popup, const char *label, const char *value);
/* A field with a list of what may stand in it; what matches what is typed is taken. */
struct popup_field *ceduo_popup_choice(struct popup *popup, const char *label, const char *value, popup_call *offer);
/* A field for a value of a kind, of which it has a copy that the caller may change. `amount`: a number of no file, from 0 on. */
struct field *ceduo_popup_value(struct popup *popup, const char *label, const char *value, const struct field *kind);
extern const struct field ceduo_popup_amount;

/* True if the typed value is in range and usual; otherwise warns, or asks once whether it is meant. */
bool ceduo_popup_confirm_unusual(struct app *app, const struct field *kind, struct line *line);

/* Read it as a file has it; false if it is not meant, no such value, or needed and missing, which is reported. */
bool ceduo_popup_read(struct app *app, const struct field *kind, struct line *line, struct text *value);

/* Read the number in a field that has a kind, in the file's unit; `*number` stays if the line is empty. */
bool ceduo_popup_number(struct app *app, struct popup *popup, size_t field, double *number);

/* True if the file named in the first field may be written. For an existing file it asks for Enter once more. */
bool ceduo_popup_may_write(struct app *app, struct popup *popup);

/* ---- the one that is open ---- */

void ceduo_popup_draw(struct app *app);
void ceduo_popup_browse(struct app *app); /* after a key: the note over a list is about the item under the cursor */
void ceduo_popup_previewed(struct app *app, const struct preview *preview); /* what that item would do to the lights is known */
const char *ceduo_popup_bar(const struct app *app);                         /* its keys */
void ceduo_popup_key(struct app *app, int key);
bool ceduo_popup_paste(struct app *app, const char *text); /* false: nothing is typed there */

/* ---- those that there are: each call opens one, or says why it does not ---- */

void ceduo_popup_presets(struct app *app);
void ceduo_popup_new_option(struct app *app);
void ceduo_popup_choices(struct app *app, const struct form_cell *cell);
void ceduo_popup_open(struct app *app);
void ceduo_popup_new(struct app *app);
void ceduo_popup_export(struct app *app);
void ceduo_popup_copy(struct app *app); /* copies what the view says, without its pictures, to the terminal's clipboard */
void ceduo_popup_find(struct app *app);
void ceduo_popup_found(struct app *app, struct search_answer *answer); /* what that search found */
void ceduo_popup_counts(struct app *app);
void ceduo_popup_save(struct app *app); /* asks for a name if the scene has no own file, and what to do if that has changed */
void ceduo_popup_save_as(struct app *app);
void ceduo_popup_quit(struct app *app);
void ceduo_popup_recover(struct app *app); /* unsaved work of earlier processes, if some is of this document or has no file */

/* Ask for the fields of a new item of a list, or of one group of it (may be NULL). `offered`: its first n fields. */
void ceduo_popup_item_find(struct app *app, const char *list, const char *group, const char *const *offered, size_t n);

/* Call `then`; ask first (save, discard, stay) if there is unsaved work. */
void ceduo_popup_confirm_unsaved(struct app *app, void (*then)(struct app *app));

/* ---- items of lists, and what fields may hold ---- */

/* Treatments of the option under the cursor. The other two return false if the item is none of them. */
void ceduo_popup_offer_treatments(struct app *app, struct popup *popup);
bool ceduo_popup_preview_treatment(struct app *app, struct popup *popup);
bool ceduo_popup_on_treatment(struct app *app, const char *value);

/* All unsaved work of earlier processes; the second takes up the one that was chosen, false if the value is none. */
void ceduo_popup_offer_recoveries(const struct app *app, struct popup *popup);
bool ceduo_popup_open_recovery(struct app *app, const char *value);

void ceduo_popup_offer_files(struct app *app, struct popup *popup); /* with the popup's endings, and folders */
void ceduo_popup_offer_stands(struct app *app, struct popup *popup);
void ceduo_popup_offer_grounds(struct app *app, struct popup *popup);

#define STAND_COUNTED _("from a sample plot")                      /* instead of a stand: what a sample plot counts */
#define STAND_SURVEY  _("from a survey")                           /* what a CSV file of plots holds */
bool ceduo_popup_is_measured(const char *stand);                   /* one of these */
bool ceduo_popup_ask_measured(struct app *app, const char *stand); /* asks for it; false if it is none of these */
/* Replace the stand of the belt shown. Reports which growth and cutting are dropped, and that the year of its cut stays. */
bool ceduo_popup_replace_stand(struct app *app, const char *path, const char *value);

/* Read a scene of nothing but the stand, with the rock of this one. False: it is no stand. Release `file` in any case. */
bool ceduo_popup_read_stand(const struct app *app, const char *value, struct scene_file *file);

#endif
