/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "keys.h"

#include <string.h>

#include "base/language.h"
#include "base/utf8.h"

const struct action_info ceduo_actions[ACTION_COUNT] = {
#define X(NAME, key, word, key2, word2, bar, help, act) {key, key2, word, word2, bar, help},
    ACTIONS(X)
#undef X
};

enum action ceduo_action_find(int key)
{
    for (int i = 0; i < ACTION_COUNT; i++)
        if (key != K_NONE && (ceduo_actions[i].key == key || ceduo_actions[i].key2 == key))
            return (enum action)i;
    return ACTION_NONE;
}

int ceduo_key_compute(const char *name)
{
    static const struct {
        const char *name;
        int key;
    } others[] = {{"Esc", K_ESCAPE}, {"Space", ' '},   {"Backspace", K_BACKSPACE},
                  {"F8", K_F1 + 7},  {"F9", K_F1 + 8}, {"Ctrl-U", K_CTRL_U}};
    uint32_t code;
    size_t n = strlen(name);
    if (n > 0 && ceduo_utf8_decode(name, n, &code) == n)
        return (int)code;
    for (int i = 0; i < ACTION_COUNT; i++) {
        if (strcmp(ceduo_actions[i].word, name) == 0)
            return ceduo_actions[i].key;
        if (strcmp(ceduo_actions[i].word2, name) == 0)
            return ceduo_actions[i].key2;
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (strcmp(others[i].name, name) == 0)
            return others[i].key;
    return K_NONE;
}
