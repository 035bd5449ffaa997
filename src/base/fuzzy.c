/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fuzzy.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

#define LETTERS_MOST 64

enum { ANY = 1, TOGETHER = 9, WORD = 8, START = 4 };

static int lower(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : (unsigned char)c;
}

/* The best of all ways in which the letters stand in the text: best[k] is that of the first k letters, the last of
 * them at the byte before the one looked at (`ending`), or anywhere before it (`best`). */
int ceduo_fuzzy_match(const char *typed, const char *text)
{
    int best[LETTERS_MOST + 1], ending[LETTERS_MOST + 1];
    size_t n = strlen(typed);
    n = n < LETTERS_MOST ? n : LETTERS_MOST;
    for (size_t k = 0; k <= n; k++)
        best[k] = ending[k] = k == 0 ? 0 : -1;
    for (size_t i = 0; text[i]; i++) {
        for (size_t k = n; k > 0; k--) {
            bool same = lower(text[i]) == lower(typed[k - 1]);
            int worth = ANY + (i == 0 || strchr(" -_/.(,", text[i - 1]) ? WORD : 0) + (i == 0 ? START : 0), here = -1;
            if (same && best[k - 1] >= 0)
                here = best[k - 1] + worth;
            if (same && k > 1 && ending[k - 1] >= 0 && ending[k - 1] + TOGETHER + worth > here)
                here = ending[k - 1] + TOGETHER + worth;
            ending[k] = here;
            best[k] = here > best[k] ? here : best[k];
        }
        ending[0] = -1;
    }
    return best[n];
}
