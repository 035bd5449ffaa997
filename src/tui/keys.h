/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KEYS_H
#define CEDUO_KEYS_H

#include <stdbool.h>

/* A key as the program knows it: a Unicode code point, or one of these. */
enum key {
    K_NONE = 0,
    K_CTRL_L = 12,
    K_TAB = 9,
    K_ENTER = 13,
    K_CTRL_R = 18,
    K_CTRL_U = 21,
    K_ESCAPE = 27,
    K_SPECIAL = 0x110000,
    K_UP,
    K_DOWN,
    K_LEFT,
    K_RIGHT,
    K_HOME,
    K_END,
    K_PAGE_UP,
    K_PAGE_DOWN,
    K_BACKSPACE,
    K_DELETE,
    K_SHIFT_TAB,
    K_F1,
    K_F10 = K_F1 + 9
};

/* The views. A new one is a file with a `struct view` (app.h) and a line here: name, the same in small, key, its word, what
 * the key does. */
#define VIEWS(V)                                                                                                               \
    V(SLOPE, slope, '1', "1", N_("view: slope"))                                                                               \
    V(STAND, stand, '2', "2", N_("view: stand"))                                                                               \
    V(ROCK, rock, '3', "3", N_("view: rock and release"))                                                                      \
    V(RESULTS, results, '4', "4", N_("view: results"))                                                                         \
    V(COMPARE, compare, '5', "5", N_("view: compare"))                                                                         \
    V(ROTATION, rotation, '6', "6", N_("view: rotation"))                                                                      \
    V(DOUBT, doubt, '7', "7", N_("view: doubt"))                                                                               \
    V(OBSERVED, observed, '8', "8", N_("view: what was seen"))

#define VIEW_ACTION(NAME, name, key, word, help) X(VIEW_##NAME, key, word, K_NONE, "", 0, help)

/* The one table of actions: keys, bar, help and manual come from it.
 * name, first key, its word, second key, its word, in the bar, what it does */
#define ACTIONS(X)                                                                                                             \
    X(UP, K_UP, "Up", 'k', "k", 0, N_("move up"))                                                                              \
    X(DOWN, K_DOWN, "Down", 'j', "j", 0, N_("move down"))                                                                      \
    X(LEFT, K_LEFT, "Left", 'h', "h", 0, N_("move left"))                                                                      \
    X(RIGHT, K_RIGHT, "Right", 'l', "l", 0, N_("move right"))                                                                  \
    X(TOP, K_HOME, "Home", 'g', "g", 0, N_("to the first line"))                                                               \
    X(BOTTOM, K_END, "End", 'G', "G", 0, N_("to the last line"))                                                               \
    X(PAGE_UP, K_PAGE_UP, "PgUp", K_NONE, "", 0, N_("a page up"))                                                              \
    X(PAGE_DOWN, K_PAGE_DOWN, "PgDn", K_NONE, "", 0, N_("a page down"))                                                        \
    X(NEXT_PANE, K_TAB, "Tab", K_NONE, "", 0, N_("pane"))                                                                      \
    X(LAST_PANE, K_SHIFT_TAB, "Shift-Tab", K_NONE, "", 0, N_("the pane before"))                                               \
    X(EDIT, K_ENTER, "Enter", K_NONE, "", 1, N_("edit"))                                                                       \
    X(MORE, '+', "+", '=', "=", 0, N_("a step more"))                                                                          \
    X(LESS, '-', "-", '_', "_", 0, N_("a step less"))                                                                          \
    X(ADD, 'a', "a", K_NONE, "", 1, N_("add"))                                                                                 \
    X(DELETE, 'd', "d", K_DELETE, "Del", 0, N_("delete"))                                                                      \
    X(DUPLICATE, 'y', "y", K_NONE, "", 0, N_("duplicate"))                                                                     \
    X(EARLIER, '<', "<", K_NONE, "", 0, N_("move this item before the one before it"))                                         \
    X(LATER, '>', ">", K_NONE, "", 0, N_("move this item after the next"))                                                     \
    X(UNDO, 'u', "u", K_NONE, "", 2, N_("undo"))                                                                               \
    X(REDO, K_CTRL_R, "Ctrl-R", K_NONE, "", 0, N_("redo"))                                                                     \
    X(PRESETS, 'p', "p", K_F1 + 5 - 1, "F5", 1, N_("presets"))                                                                 \
    X(COUNTS, 'c', "c", K_NONE, "", 0, N_("stand from the counts of a sample plot"))                                           \
    VIEWS(VIEW_ACTION)                                                                                                         \
    X(STOP, K_ESCAPE, "Esc", K_NONE, "", 0, N_("stop a fit, or leave what it found"))                                          \
    X(FIND, 'f', "f", K_NONE, "", 1, N_("find the value here that reaches a goal"))                                            \
    X(NEXT_OPTION, ']', "]", K_NONE, "", 0, N_("next option"))                                                                 \
    X(LAST_OPTION, '[', "[", K_NONE, "", 0, N_("the option before"))                                                           \
    X(NEXT_ROCK, '.', ".", K_NONE, "", 0, N_("next rock's way"))                                                               \
    X(LAST_ROCK, ',', ",", K_NONE, "", 0, N_("the rock's way before"))                                                         \
    X(ZOOM, 'z', "z", K_NONE, "", 0, N_("nearer to the slope, at the cursor along it"))                                        \
    X(UNZOOM, 'Z', "Z", K_NONE, "", 0, N_("farther from the slope"))                                                           \
    X(SEARCH, '/', "/", K_F1 + 3 - 1, "F3", 0, N_("search"))                                                                   \
    X(AGAIN, 'N', "N", K_NONE, "", 0, N_("search again"))                                                                      \
    X(COMMANDS, ':', ":", K_NONE, "", 0, N_("commands by their names"))                                                        \
    X(NEW, 'n', "n", K_F1 + 7 - 1, "F7", 0, N_("new scene"))                                                                   \
    X(OPEN, 'o', "o", K_F1 + 4 - 1, "F4", 0, N_("open a scene"))                                                               \
    X(SAVE, 's', "s", K_F1 + 2 - 1, "F2", 2, N_("save"))                                                                       \
    X(SAVE_AS, 'S', "S", K_NONE, "", 0, N_("save under another name"))                                                         \
    X(COPY, 'Y', "Y", K_NONE, "", 1, N_("copy what the view says"))                                                            \
    X(EXPORT, 'w', "w", K_F1 + 6 - 1, "F6", 1, N_("export"))                                                                   \
    X(CHARSET, 'b', "b", K_NONE, "", 0, N_("braille, blocks or ASCII"))                                                        \
    X(THEME, 't', "t", K_NONE, "", 0, N_("colours: dark, light, none"))                                                        \
    X(REDRAW, K_CTRL_L, "Ctrl-L", K_NONE, "", 0, N_("draw the screen anew"))                                                   \
    X(HELP, '?', "?", K_F1, "F1", 2, N_("help"))                                                                               \
    X(QUIT, 'q', "q", K_F10, "F10", 2, N_("quit"))

enum action {
#define X(NAME, key, word, key2, word2, bar, help) ACTION_##NAME,
    ACTIONS(X)
#undef X
        ACTION_COUNT,
    ACTION_NONE
};

struct action_info {
    int key, key2;
    const char *word, *word2;
    int bar;          /* 2: always in the bar, 1: where the view's own keys leave room */
    const char *help; /* marked for translation */
};

extern const struct action_info ceduo_actions[ACTION_COUNT];

/* The action of a key; ACTION_NONE. */
enum action ceduo_action_of(int key);

/* A key from its name in a script: a single character, or Up, Enter, F1, Ctrl-R, Esc, Space …; K_NONE. */
int ceduo_key_of(const char *name);

#endif
