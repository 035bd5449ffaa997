/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POPUP_H
#define CEDUO_POPUP_H

#include "app.h"
#include "picker.h"
#include "scene/schema.h"

enum popup_kind { POPUP_TEXT, POPUP_FIELD, POPUP_LIST, POPUP_FIELDS }; /* FIELD: a field of the form */

#define POPUP_FIELDS_MAX 16
#define POPUP_DIGITS_MAX 9 /* items chosen by a digit, 1 to 9 */

/* A caller whose number of fields or answers comes from a table asserts at build time that it fits. */
_Static_assert(CEDUO_ASKED_FIELDS_MAX <= POPUP_FIELDS_MAX, "a popup asks for all fields of a mapping");
_Static_assert(CEDUO_ASKED_KINDS_MAX <= POPUP_DIGITS_MAX, "a digit chooses a kind of observation");

/* Callback of a popup. */
typedef void popup_call(struct app *app, struct popup *popup);

/* Called on submit and when leaving a field. Return false, with a message set, to keep the popup open. */
typedef bool popup_check(struct app *app, struct popup *popup);

/* An input field. */
struct popup_field {
    char label[40];
    struct line line;
    int row;              /* row of the caller's table of fields, for the caller */
    popup_call *complete; /* add completions of the typed text to the picker; may be NULL */
    struct field *value;  /* expected value, checked when leaving the field; NULL: any text */
};

struct popup {
    enum popup_kind kind;
    const char *title;
    struct arena arena;
    struct text text; /* text to read; note over a list or fields */
    struct popup_field
        fields[POPUP_FIELDS_MAX]; /* in a list the first is the search field; its `complete` lists items that change */
    size_t fields_count;
    size_t current;         /* index of the field under the cursor */
    struct picker picker;   /* picker of the list, or of the field under the cursor */
    const char *endings;    /* endings of files that may be typed: ".csv .txt"; NULL: none */
    bool is_menu;           /* a menu: a letter chooses an item, no search */
    bool listed;            /* items are listed */
    bool cursor_moved;      /* the cursor was moved in the picker */
    bool keep_input;        /* do not replace the input by the first completion */
    bool typing;            /* in a text: the search text is being typed, in the first field */
    size_t found;           /* in a text: offset of the place found, plus 1; 0: none */
    bool show_found;        /* scroll to that place when the text is drawn */
    struct viewport lines;  /* viewport of the text or the fields */
    struct ceduo_area box;  /* position on the screen */
    const char *target;     /* path of the edited value, or another key of the caller */
    const char *context;    /* text of the caller */
    const char *value;      /* item under the cursor, or the chosen one */
    struct preview preview; /* effect of that item on the lights, if has_preview */
    bool has_preview;
    popup_call *on_select;   /* called with `value`; the popup is closed, and freed afterwards */
    popup_call *update_note; /* rebuild `text` for `value`; a text popup calls it each time it is drawn; may be NULL */
    popup_check *on_submit, *validate;
    void (*picture)(struct app *app, struct popup *popup,
                    struct ceduo_area area); /* draw below the fields if no item is offered */
    void (*on_done)(struct app *app);        /* continuation after unsaved work is saved or discarded */
};

/* Each function opens a popup in place of any other; `target` is copied. */
struct popup *ceduo_popup_text(struct app *app, const char *title);
struct popup *ceduo_popup_list(struct app *app, const char *title, const char *target, popup_call *on_select);
struct popup *ceduo_popup_fields(struct app *app, const char *title, const char *target, popup_check *on_submit);
void ceduo_popup_add_item(struct popup *popup, const char *text, const char *value);
/* Add an item that a key chooses; the key stands before the text. ' ': only the cursor chooses it. */
void ceduo_popup_add_menu_item(struct popup *popup, char key, const char *text, const char *value);
struct popup_field *ceduo_popup_add_field(struct popup *popup, const char *label, const char *value);
/* Add a field with completions; the best match replaces the typed text. */
struct popup_field *ceduo_popup_add_choice(struct popup *popup, const char *label, const char *value, popup_call *complete);
/* Add a field for a value of a kind; the caller may change its copy of the kind. `amount`: any number >= 0. */
struct field *ceduo_popup_add_value(struct popup *popup, const char *label, const char *value, const struct field *kind);
extern const struct field ceduo_popup_amount;

/* True if the typed value is in range and usual. Otherwise warn, or ask once for confirmation. */
bool ceduo_popup_confirm_unusual(struct app *app, const struct field *kind, struct line *line);

/* Read a value as in a file. Return false and report if it is invalid, not confirmed, or missing but required. */
bool ceduo_popup_read(struct app *app, const struct field *kind, struct line *line, struct text *value);

/* Read the number of a field with a kind, in the unit of the file. `*number` stays if the line is empty. */
bool ceduo_popup_number(struct app *app, struct popup *popup, size_t field, double *number);

/* True if the file named in the first field may be written. An existing file needs Enter twice. A file that the scene is read
 * from is refused; if the scene is saved, its own file is not. */
bool ceduo_popup_confirm_overwrite(struct app *app, struct popup *popup, bool saves_scene);

/* ---- the open popup ---- */

void ceduo_popup_draw(struct app *app);
void ceduo_popup_update_note(struct app *app); /* after a key: update the note for the item under the cursor */
void ceduo_popup_on_preview(struct app *app, const struct preview *effect); /* receive the effect of that item on the lights */
const char *ceduo_popup_key_help(const struct app *app);                    /* keys for the bar */
void ceduo_popup_key(struct app *app, int key);
bool ceduo_popup_paste(struct app *app, const char *text); /* false: no input line is open */

/* ---- the popups: each function opens one, or reports why not ---- */

void ceduo_popup_list_stands(struct app *app);
void ceduo_popup_new_option(struct app *app);
void ceduo_popup_list_choices(struct app *app, const struct form_cell *cell);
void ceduo_popup_open(struct app *app);
void ceduo_popup_new(struct app *app);
void ceduo_popup_export(struct app *app);
void ceduo_popup_copy(struct app *app); /* copy the text of the view, without pictures, to the clipboard */
void ceduo_popup_find(struct app *app);
void ceduo_popup_on_found(struct app *app, struct search_answer *answer); /* receive the result of the search */
void ceduo_popup_ask_counts(struct app *app);
void ceduo_popup_save(
    struct app *app); /* asks for a name if the scene has no file of its own, and for a decision if the file has changed */
void ceduo_popup_save_as(struct app *app);
void ceduo_popup_quit(struct app *app);
void ceduo_popup_recover(struct app *app); /* offers abandoned work of this document or of scenes without a file */

/* Ask for the fields of a new list item, or of one group of it (may be NULL). `offered`: values of the first n fields. */
void ceduo_popup_new_item(struct app *app, const char *list, const char *group, const char *const *offered, size_t n);

/* Call `next`. If there is unsaved work, ask first: save, discard or stay. */
void ceduo_popup_confirm_unsaved(struct app *app, void (*next)(struct app *app));

/* ---- items of lists and fields ---- */

/* Treatments of the option shown. The other two return false if the item is not a treatment. */
void ceduo_popup_offer_treatments(struct app *app, struct popup *popup);
bool ceduo_popup_preview_treatment(struct app *app, struct popup *popup);
bool ceduo_popup_choose_treatment(struct app *app, const char *value);

/* List abandoned work. The second function opens a chosen copy; it returns false if the value is not a copy. */
void ceduo_popup_offer_recoveries(const struct app *app, struct popup *popup);
bool ceduo_popup_open_recovery(struct app *app, const char *value);

void ceduo_popup_offer_files(struct app *app, struct popup *popup); /* with the popup's endings, and folders */
void ceduo_popup_offer_stands(struct app *app, struct popup *popup);
void ceduo_popup_offer_grounds(struct app *app, struct popup *popup);

#define STAND_COUNTED _("from a sample plot")                      /* counts of a sample plot instead of a stand */
#define STAND_SURVEY  _("from a survey")                           /* a CSV file of plots */
bool ceduo_popup_is_measured(const char *stand);                   /* true for the two above */
bool ceduo_popup_ask_measured(struct app *app, const char *stand); /* asks for the data; false: not one of the two */
/* Replace the stand of the belt shown. Report dropped growth and cutting, and that the year of its cut stays. */
bool ceduo_popup_replace_stand(struct app *app, const char *target, const char *value);

/* Read a minimal scene with this stand and the rock of the document. False: it is no stand. Release `file` in any case. */
bool ceduo_popup_read_stand(const struct app *app, const char *value, struct scene_file *file);

#endif
