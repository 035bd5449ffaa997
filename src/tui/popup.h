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
/* An answer that a key gives, which stands before its words; all items of the list must be such. */
void ceduo_popup_answer(struct popup *popup, char key, const char *text, const char *value);
struct popup_field *ceduo_popup_field(struct popup *popup, const char *label, const char *value);
/* A field with a list of what may stand in it; what matches what is typed is taken. */
struct popup_field *ceduo_popup_choice(struct popup *popup, const char *label, const char *value, popup_call *offer);
/* A number that is none of a file, from 0 on. */
extern const struct field ceduo_popup_amount;
/* A field for a value of a kind, of which it has a copy that the caller may change. */
struct field *ceduo_popup_value(struct popup *popup, const char *label, const char *value, const struct field *kind);

/* True if the typed value is in range and usual; otherwise warns, or asks once whether it is meant. */
bool ceduo_popup_is_meant(struct app *app, const struct field *kind, struct line *line);

/* Reads it as a file has it; false where it is not meant, no such value, or needed and missing, which is said. */
bool ceduo_popup_read(struct app *app, const struct field *kind, struct line *line, struct text *value);

/* The number in a field that has a kind, in the file's unit; `*number` stays where the line is empty. */
bool ceduo_popup_number(struct app *app, struct popup *popup, size_t field, double *number);

/* Returns whether the file named in the first field may be written. For an existing file it asks for Enter once more. */
bool ceduo_popup_may_write(struct app *app, struct popup *popup);

/* ---- the one that is open ---- */

void ceduo_popup_draw(struct app *app);

/* After a key: the note over a list is about the item under the cursor. */
void ceduo_popup_look(struct app *app);
/* What that item would do to the lights is known. */
void ceduo_popup_previewed(struct app *app, const struct preview *preview);
const char *ceduo_popup_bar(const struct app *app); /* its keys */
void ceduo_popup_key(struct app *app, int key);
bool ceduo_popup_paste(struct app *app, const char *text); /* false: nothing is typed there */
void ceduo_popup_close(struct app *app);

/* ---- those that there are: each call opens one, or says why it does not ---- */

void ceduo_popup_presets(struct app *app);
void ceduo_popup_new_option(struct app *app);
void ceduo_popup_choices(struct app *app, const struct form_cell *cell);
void ceduo_popup_open(struct app *app);
void ceduo_popup_new(struct app *app);
void ceduo_popup_export(struct app *app);
/* Copies what the view says, as text without its pictures, to the terminal's clipboard. */
void ceduo_popup_copy(struct app *app);
void ceduo_popup_find(struct app *app);
void ceduo_popup_counts(struct app *app);

/* Asks for the fields of a new item of a list, or of one group of it (may be NULL), and appends it. `offered`: the first n
 * fields. */
void ceduo_popup_item_of(struct app *app, const char *list, const char *group, const char *const *offered, size_t n);

/* Treatments of the option under the cursor as items of a list. The other two return false if the item is none of them. */
void ceduo_popup_offer_treatments(struct app *app, struct popup *popup);
bool ceduo_popup_preview_treatment(struct app *app, struct popup *popup);
bool ceduo_popup_chose_treatment(struct app *app, const char *value);

/* What the search came to that ceduo_popup_find() started. */
void ceduo_popup_found(struct app *app, struct search_answer *sought);

/* ---- saving, and unsaved work (popup_save.c) ---- */

/* Saves to the scene's own file; asks for a name where there is none, and what to do where the file has changed. */
void ceduo_popup_save(struct app *app);
void ceduo_popup_save_as(struct app *app);

/* Ends the program, once the work is saved or given up. */
void ceduo_popup_quit(struct app *app);

/* Goes on with `then`; asks first (save, discard, stay) where there is unsaved work. */
void ceduo_popup_once_saved(struct app *app, void (*then)(struct app *app));

/* Lists unsaved work that earlier processes left behind, where some of it is on this document or has no file. */
void ceduo_popup_recover(struct app *app);
/* Adds all of it to a list; takes up the one that was chosen, false where the value is none. */
void ceduo_popup_offer_recoveries(const struct app *app, struct popup *popup);
bool ceduo_popup_take_recovery(struct app *app, const char *value);

/* ---- what fields of popups may hold ---- */

/* Files with the popup's endings, and folders. */
void ceduo_popup_offer_files(struct app *app, struct popup *popup);

#define STAND_COUNTED _("from a sample plot") /* in the place of a stand: what a sample plot counts */
#define STAND_SURVEY  _("from a survey")      /* what a CSV file of plots holds */
/* Replace the stand of the belt shown. Says which growth and cutting are dropped, and that the year of its cut stays. */
bool ceduo_popup_replace_stand(struct app *app, const char *path, const char *value);
void ceduo_popup_survey(struct app *app); /* asks for that file */

/* A scene of nothing but the stand, with the rock of this one; false if it is no stand. The caller releases `file` in any
 * case. */
bool ceduo_popup_read_stand(const struct app *app, const char *value, struct scene_file *file);

void ceduo_popup_offer_stands(struct app *app, struct popup *popup);
void ceduo_popup_offer_grounds(struct app *app, struct popup *popup);

#endif
