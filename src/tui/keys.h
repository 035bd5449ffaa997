/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KEYS_H
#define CEDUO_KEYS_H

#include <stdbool.h>

/* A key as the program knows it: a Unicode code point, or one of these. */
enum key {
    KEY_NONE = 0,
    KEY_CTRL_L = 12,
    KEY_TAB = 9,
    KEY_ENTER = 13,
    KEY_CTRL_R = 18,
    KEY_CTRL_U = 21,
    KEY_ESCAPE = 27,
    KEY_SPECIAL = 0x110000,
    KEY_UP,
    KEY_DOWN,
    KEY_LEFT,
    KEY_RIGHT,
    KEY_HOME,
    KEY_END,
    KEY_PAGE_UP,
    KEY_PAGE_DOWN,
    KEY_BACKSPACE,
    KEY_DELETE,
    KEY_SHIFT_TAB,
    KEY_F1,
    KEY_F2,
    KEY_F3,
    KEY_F4,
    KEY_F5,
    KEY_F6,
    KEY_F7,
    KEY_F8,
    KEY_F9,
    KEY_F10
};

/* The one table of actions: keys, bar, help and manual come from it.
 * name, first key, its word, second key, its word, in the bar, what it does */
#define ACTIONS(X)                                                                                           \
    X(UP, KEY_UP, "Up", 'k', "k", false, N_("move up"))                                                      \
    X(DOWN, KEY_DOWN, "Down", 'j', "j", false, N_("move down"))                                              \
    X(LEFT, KEY_LEFT, "Left", 'h', "h", false, N_("move left"))                                              \
    X(RIGHT, KEY_RIGHT, "Right", 'l', "l", false, N_("move right"))                                          \
    X(TOP, KEY_HOME, "Home", 'g', "g", false, N_("to the first line"))                                       \
    X(BOTTOM, KEY_END, "End", 'G', "G", false, N_("to the last line"))                                       \
    X(PAGE_UP, KEY_PAGE_UP, "PgUp", KEY_NONE, "", false, N_("a page up"))                                    \
    X(PAGE_DOWN, KEY_PAGE_DOWN, "PgDn", KEY_NONE, "", false, N_("a page down"))                              \
    X(EDIT, KEY_ENTER, "Enter", KEY_NONE, "", true, N_("edit"))                                              \
    X(MORE, '+', "+", '=', "=", false, N_("a step more"))                                                    \
    X(LESS, '-', "-", '_', "_", false, N_("a step less"))                                                    \
    X(ADD, 'a', "a", KEY_NONE, "", true, N_("add"))                                                          \
    X(DELETE, 'd', "d", KEY_DELETE, "Del", true, N_("delete"))                                               \
    X(DUPLICATE, 'y', "y", KEY_NONE, "", true, N_("duplicate"))                                              \
    X(EARLIER, '<', "<", KEY_NONE, "", false, N_("move this item before the one before it"))                 \
    X(LATER, '>', ">", KEY_NONE, "", false, N_("move this item after the next"))                             \
    X(UNDO, 'u', "u", KEY_NONE, "", true, N_("undo"))                                                        \
    X(REDO, KEY_CTRL_R, "Ctrl-R", KEY_NONE, "", false, N_("redo"))                                           \
    X(PRESETS, 'p', "p", KEY_F5, "F5", true, N_("presets"))                                                  \
    X(COUNTS, 'c', "c", KEY_NONE, "", false, N_("stand from the counts of a sample plot"))                   \
    X(NEXT_PANE, KEY_TAB, "Tab", KEY_NONE, "", true, N_("pane"))                                             \
    X(LAST_PANE, KEY_SHIFT_TAB, "Shift-Tab", KEY_NONE, "", false, N_("the pane before"))                     \
    X(VIEW_1, '1', "1", KEY_NONE, "", false, N_("view: slope"))                                              \
    X(VIEW_2, '2', "2", KEY_NONE, "", false, N_("view: stand"))                                              \
    X(VIEW_3, '3', "3", KEY_NONE, "", false, N_("view: rock and release"))                                   \
    X(VIEW_4, '4', "4", KEY_NONE, "", false, N_("view: results"))                                            \
    X(VIEW_5, '5', "5", KEY_NONE, "", false, N_("view: compare"))                                            \
    X(NEXT_OPTION, ']', "]", KEY_NONE, "", false, N_("next option"))                                   \
    X(LAST_OPTION, '[', "[", KEY_NONE, "", false, N_("the option before"))                             \
    X(NEXT_ROCK, '.', ".", KEY_NONE, "", false, N_("next rock's way"))                                       \
    X(LAST_ROCK, ',', ",", KEY_NONE, "", false, N_("the rock's way before"))                                 \
    X(SEARCH, '/', "/", KEY_F3, "F3", false, N_("search"))                                                   \
    X(AGAIN, 'N', "N", KEY_NONE, "", false, N_("search again"))                                              \
    X(NEW, 'n', "n", KEY_F7, "F7", false, N_("new scene"))                                                   \
    X(OPEN, 'o', "o", KEY_F4, "F4", false, N_("open a scene"))                                               \
    X(SAVE, 's', "s", KEY_F2, "F2", true, N_("save"))                                                        \
    X(EXPORT, 'w', "w", KEY_F6, "F6", true, N_("export"))                                                    \
    X(CHARSET, 'b', "b", KEY_NONE, "", false, N_("braille, blocks or ASCII"))                                \
    X(THEME, 't', "t", KEY_NONE, "", false, N_("colours: dark, light, none"))                                \
    X(REDRAW, KEY_CTRL_L, "Ctrl-L", KEY_NONE, "", false, N_("draw the screen anew"))                         \
    X(HELP, '?', "?", KEY_F1, "F1", true, N_("help"))                                                        \
    X(QUIT, 'q', "q", KEY_F10, "F10", true, N_("quit"))

enum action {
#define X(NAME, key, word, key2, word2, bar, help) ACTION_##NAME,
    ACTIONS(X)
#undef X
        ACTION_COUNT,
    ACTION_NONE
};

struct action_row {
    int key, key2;
    const char *word, *word2;
    bool bar;
    const char *help; /* marked for translation */
};

extern const struct action_row ceduo_actions[ACTION_COUNT];

/* The action of a key; ACTION_NONE. */
enum action ceduo_action_of(int key);

/* A key from its name in a script: a single character, or Up, Enter, F1, Ctrl-R, Esc, Space …; KEY_NONE. */
int ceduo_key_of(const char *name);

#endif
