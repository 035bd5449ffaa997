/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparisons that say what the values were. A failing one ends the test, as cmocka's own do; the values in its message are
 * taken anew. */
#ifndef EXPECT_H
#define EXPECT_H

#include "test.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

struct shown {
    char text[40];
};

static inline struct shown shown_number(double value)
{
    struct shown s;
    snprintf(s.text, sizeof s.text, "%.17g", value);
    return s;
}

static inline struct shown shown_signed(long long value)
{
    struct shown s;
    snprintf(s.text, sizeof s.text, "%lld", value);
    return s;
}

static inline struct shown shown_unsigned(unsigned long long value)
{
    struct shown s;
    snprintf(s.text, sizeof s.text, "%llu", value);
    return s;
}

#define SHOWN(x)                                                                                                               \
    (_Generic((x), double                                                                                                      \
              : shown_number, float                                                                                            \
              : shown_number, unsigned long                                                                                    \
              : shown_unsigned, unsigned long long                                                                             \
              : shown_unsigned, default                                                                                        \
              : shown_signed)(x)                                                                                               \
         .text)

/* EXPECT(found.value, <=, 5.5) */
#define EXPECT(left, op, right)                                                                                                \
    do {                                                                                                                       \
        if (!((left)op(right)))                                                                                                \
            fail_msg("%s is %s, wanted %s %s, which is %s", #left, SHOWN(left), #op, #right, SHOWN(right));                    \
    } while (0)

/* |left - right| <= most; false where either is NaN. */
#define EXPECT_NEAR(left, right, most)                                                                                         \
    do {                                                                                                                       \
        if (!(fabs((left) - (right)) <= (most)))                                                                               \
            fail_msg("%s is %s, wanted %s, which is %s, within %s", #left, SHOWN(left), #right, SHOWN(right), SHOWN(most));    \
    } while (0)

/* The next of the words that stand between bars, from where the last one ended: false where there is none. */
static inline bool next_word(const char **words, char word[64])
{
    int n = (int)strcspn(*words, "|");
    bool more = **words != '\0';
    snprintf(word, 64, "%.*s", n, *words);
    *words += n + ((*words)[n] == '|');
    return more;
}

#endif
