/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KEYS_H
#define CEDUO_KEYS_H

#include <stdbool.h>

/* A key: a Unicode code point, or a key of the second list. */
enum { K_NONE, K_TAB = 9, K_CTRL_L = 12, K_ENTER, K_CTRL_R = 18, K_CTRL_U = 21, K_ESCAPE = 27, K_SPECIAL = 0x110000 };
enum {
    K_UP = K_SPECIAL + 1,
    K_DOWN,
    K_LEFT,
    K_RIGHT,
    K_HOME,
    K_END,
    K_PAGE_UP,
    K_PAGE_DOWN,
    K_DELETE,
    K_BACKSPACE,
    K_SHIFT_TAB
};
#define K_F(n) (K_SHIFT_TAB + (n))

/* The views. A new one is a file with a `struct view` (app.h) and a line here: NAME, name, key, its word, title. */
#define VIEWS(V)                                                                                                               \
    V(SLOPE, slope, '1', "1", NP_("view", "slope"))                                                                            \
    V(STAND, stand, '2', "2", NP_("view", "stand"))                                                                            \
    V(ROCK, rock, '3', "3", NP_("view", "rock"))                                                                               \
    V(RESULTS, results, '4', "4", NP_("view", "results"))                                                                      \
    V(COMPARE, compare, '5', "5", NP_("view", "compare"))                                                                      \
    V(ROTATION, rotation, '6', "6", NP_("view", "rotation"))                                                                   \
    V(UNCERTAINTY, uncertainty, '7', "7", NP_("view", "uncertainty"))                                                          \
    V(OBSERVED, observed, '8', "8", NP_("view", "observed"))

#define VIEW_ACTION(NAME, name, key, word, help) X(VIEW_##NAME, key, word, K_NONE, "", 0, help, RUN(open_view, VIEW_##NAME))

/* The table of actions, for keys, bar, help and manual: name, key, its word, second key, its word, rank in the bar, help,
 * and the handler, with or without an argument. NULL: only views handle it. */
#define ACTIONS(X)                                                                                                             \
    X(UP, K_UP, "Up", 'k', "k", 0, N_("move up"), RUN(move_lines, -1))                                                         \
    X(DOWN, K_DOWN, "Down", 'j', "j", 0, N_("move down"), RUN(move_lines, 1))                                                  \
    X(LEFT, K_LEFT, "Left", 'h', "h", 0, N_("move left"), RUN(move_column, -1))                                                \
    X(RIGHT, K_RIGHT, "Right", 'l', "l", 0, N_("move right"), RUN(move_column, 1))                                             \
    X(TOP, K_HOME, "Home", 'g', "g", 0, N_("first line"), RUN(move_lines, -ALL_LINES))                                         \
    X(BOTTOM, K_END, "End", 'G', "G", 0, N_("last line"), RUN(move_lines, ALL_LINES))                                          \
    X(PAGE_UP, K_PAGE_UP, "PgUp", K_NONE, "", 0, N_("page up"), RUN(move_page, -1))                                            \
    X(PAGE_DOWN, K_PAGE_DOWN, "PgDn", K_NONE, "", 0, N_("page down"), RUN(move_page, 1))                                       \
    X(NEXT_PANE, K_TAB, "Tab", K_NONE, "", 0, N_("next pane"), RUN(show_pane, 1))                                              \
    X(PREV_PANE, K_SHIFT_TAB, "Shift-Tab", K_NONE, "", 0, N_("previous pane"), RUN(show_pane, -1))                             \
    X(EDIT, K_ENTER, "Enter", K_NONE, "", 1, N_("edit"), DO(ceduo_edit_start))                                                 \
    X(INCREASE, '+', "+", '=', "=", 0, N_("increase"), RUN(ceduo_edit_step, 1))                                                \
    X(DECREASE, '-', "-", '_', "_", 0, N_("decrease"), RUN(ceduo_edit_step, -1))                                               \
    X(ADD, 'a', "a", K_NONE, "", 1, N_("add"), DO(ceduo_items_add))                                                            \
    X(DELETE, 'd', "d", K_DELETE, "Del", 0, N_("delete"), DO(ceduo_items_delete))                                              \
    X(DUPLICATE, 'y', "y", K_NONE, "", 0, N_("duplicate"), DO(ceduo_items_duplicate))                                          \
    X(MOVE_UP, '<', "<", K_NONE, "", 0, N_("move item up"), RUN(ceduo_items_move, -1))                                         \
    X(MOVE_DOWN, '>', ">", K_NONE, "", 0, N_("move item down"), RUN(ceduo_items_move, 1))                                      \
    X(UNDO, 'u', "u", K_NONE, "", 2, N_("undo"), RUN(undo_or_redo, -1))                                                        \
    X(REDO, K_CTRL_R, "Ctrl-R", K_NONE, "", 0, N_("redo"), RUN(undo_or_redo, 1))                                               \
    X(PRESETS, 'p', "p", K_F(5), "F5", 1, N_("presets"), DO(ceduo_popup_list_stands))                                          \
    X(COUNTS, 'c', "c", K_NONE, "", 0, N_("stand from a sample plot"), DO(ceduo_popup_ask_counts))                             \
    VIEWS(VIEW_ACTION)                                                                                                         \
    X(STOP, K_ESCAPE, "Esc", K_NONE, "", 0, N_("cancel or discard the fit"), DO(NULL))                                         \
    X(FIND, 'f', "f", K_NONE, "", 1, N_("find the value that reaches a goal"), DO(ceduo_popup_find))                           \
    X(NEXT_OPTION, ']', "]", K_NONE, "", 0, N_("next option"), RUN(show_option, 1))                                            \
    X(PREV_OPTION, '[', "[", K_NONE, "", 0, N_("previous option"), RUN(show_option, -1))                                       \
    X(NEXT_ROCK, '.', ".", K_NONE, "", 0, N_("next trajectory"), RUN(ceduo_app_next_rock, 1))                                  \
    X(PREV_ROCK, ',', ",", K_NONE, "", 0, N_("previous trajectory"), RUN(ceduo_app_next_rock, -1))                             \
    X(ZOOM, 'z', "z", K_NONE, "", 0, N_("zoom in"), DO(NULL))                                                                  \
    X(UNZOOM, 'Z', "Z", K_NONE, "", 0, N_("zoom out"), DO(NULL))                                                               \
    X(SEARCH, '/', "/", K_F(3), "F3", 0, N_("search"), DO(ask_search_text))                                                    \
    X(SEARCH_NEXT, 'N', "N", K_NONE, "", 0, N_("search again"), DO(search_next))                                               \
    X(COMMANDS, ':', ":", K_NONE, "", 0, N_("command palette"), DO(list_commands))                                             \
    X(NEW, 'n', "n", K_F(7), "F7", 0, N_("new scene"), DO(ceduo_popup_new))                                                    \
    X(OPEN, 'o', "o", K_F(4), "F4", 0, N_("open a scene"), DO(ceduo_popup_open))                                               \
    X(SAVE, 's', "s", K_F(2), "F2", 2, N_("save"), DO(ceduo_popup_save))                                                       \
    X(SAVE_AS, 'S', "S", K_NONE, "", 0, N_("save under another name"), DO(ceduo_popup_save_as))                                \
    X(COPY, 'Y', "Y", K_NONE, "", 1, N_("copy as text"), DO(ceduo_popup_copy))                                                 \
    X(EXPORT, 'w', "w", K_F(6), "F6", 1, N_("export"), DO(ceduo_popup_export))                                                 \
    X(CHARSET, 'b', "b", K_NONE, "", 0, N_("braille, blocks or ASCII"), DO(change_charset))                                    \
    X(THEME, 't', "t", K_NONE, "", 0, N_("colours: dark, light, none"), DO(change_theme))                                      \
    X(REDRAW, K_CTRL_L, "Ctrl-L", K_NONE, "", 0, N_("redraw"), DO(redraw))                                                     \
    X(HELP, '?', "?", K_F(1), "F1", 2, N_("help"), DO(show_help))                                                              \
    X(QUIT, 'q', "q", K_F(10), "F10", 2, N_("quit"), DO(ceduo_popup_quit))

enum action {
#define X(NAME, key, word, key2, word2, bar, help, binding) ACTION_##NAME,
    ACTIONS(X)
#undef X
        ACTION_COUNT,
    ACTION_NONE
};

struct action_info {
    int key, key2;
    const char *word, *word2;
    int bar;          /* 2: always in the bar, 1: if the view's own keys leave space */
    const char *help; /* marked for translation */
};

extern const struct action_info ceduo_actions[ACTION_COUNT];

/* Return the action of a key, or ACTION_NONE. */
enum action ceduo_action_find(int key);

/* Return a key by name: a single character, or Up, Enter, F1, Ctrl-R, Esc, Space …; otherwise K_NONE. */
int ceduo_key_find(const char *name);

#endif
