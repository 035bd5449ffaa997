/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparisons that print both values. A failing one ends the test, like cmocka's own. The message evaluates the values
 * again. */
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

/* |left - right| <= max; false if either is NaN. */
#define EXPECT_NEAR(left, right, max)                                                                                          \
    do {                                                                                                                       \
        if (!(fabs((left) - (right)) <= (max)))                                                                                \
            fail_msg("%s is %s, wanted %s, which is %s, within %s", #left, SHOWN(left), #right, SHOWN(right), SHOWN(max));     \
    } while (0)

/* |value - expected| <= relative |expected| */
static inline void expect_relative(double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fmax(fabs(expected), 1e-300)))
        fail_msg("%.17g is not %.17g within %g of it", value, expected, relative);
}

/* Copy the next word between bars and advance *words; false at the end. */
static inline bool next_word(const char **words, char word[64])
{
    int n = (int)strcspn(*words, "|");
    bool more = **words != '\0';
    snprintf(word, 64, "%.*s", n, *words);
    *words += n + ((*words)[n] == '|');
    return more;
}

/* Apply a macro to each of up to 12 arguments, with a constant first argument. */
#define EACH_1(apply, with, a)                                                apply(with, a)
#define EACH_2(apply, with, a, ...)                                           apply(with, a) EACH_1(apply, with, __VA_ARGS__)
#define EACH_3(apply, with, a, ...)                                           apply(with, a) EACH_2(apply, with, __VA_ARGS__)
#define EACH_4(apply, with, a, ...)                                           apply(with, a) EACH_3(apply, with, __VA_ARGS__)
#define EACH_5(apply, with, a, ...)                                           apply(with, a) EACH_4(apply, with, __VA_ARGS__)
#define EACH_6(apply, with, a, ...)                                           apply(with, a) EACH_5(apply, with, __VA_ARGS__)
#define EACH_7(apply, with, a, ...)                                           apply(with, a) EACH_6(apply, with, __VA_ARGS__)
#define EACH_8(apply, with, a, ...)                                           apply(with, a) EACH_7(apply, with, __VA_ARGS__)
#define EACH_9(apply, with, a, ...)                                           apply(with, a) EACH_8(apply, with, __VA_ARGS__)
#define EACH_10(apply, with, a, ...)                                          apply(with, a) EACH_9(apply, with, __VA_ARGS__)
#define EACH_11(apply, with, a, ...)                                          apply(with, a) EACH_10(apply, with, __VA_ARGS__)
#define EACH_12(apply, with, a, ...)                                          apply(with, a) EACH_11(apply, with, __VA_ARGS__)
#define EACH_OF(_1, _2, _3, _4, _5, _6, _7, _8, _9, _10, _11, _12, name, ...) name
#define EACH(apply, with, ...)                                                                                                 \
    EACH_OF(__VA_ARGS__, EACH_12, EACH_11, EACH_10, EACH_9, EACH_8, EACH_7, EACH_6, EACH_5, EACH_4, EACH_3, EACH_2, EACH_1, 0) \
    (apply, with, __VA_ARGS__)
#define UNWRAP(...)                                __VA_ARGS__
#define WITH_UNWRAPPED(apply, ...)                 apply(__VA_ARGS__)
#define EXPECT_FIELD_IS(of, field, value)          EXPECT((of).field, ==, value);
#define EXPECT_FIELD(of, pair)                     WITH_UNWRAPPED(EXPECT_FIELD_IS, of, UNWRAP pair)
#define EXPECT_FIELD_SAME_IN(first, second, field) EXPECT((first).field, ==, (second).field);
#define EXPECT_FIELD_SAME(both, field)             WITH_UNWRAPPED(EXPECT_FIELD_SAME_IN, UNWRAP both, field)
#define EXPECT_NOT_KNOWN(unused, value)            assert_true(isnan(value));

/* EXPECT_IS(end, (x, 500), (status, CEDUO_END_AT_REST)): compare members of one object with ==. */
#define EXPECT_IS(of, ...)                                                                                                     \
    do {                                                                                                                       \
        EACH(EXPECT_FIELD, of, __VA_ARGS__)                                                                                    \
    } while (0)

/* EXPECT_SAME(a, b, x, z): these members are equal in both. */
#define EXPECT_SAME(first, second, ...)                                                                                        \
    do {                                                                                                                       \
        EACH(EXPECT_FIELD_SAME, (first, second), __VA_ARGS__)                                                                  \
    } while (0)

/* ROWS(EXPECT_NEAR, (a, 1, .1), (b, 2, .1)): pass each row to the same function or macro. */
#define ROW(function, row) function row;
#define ROWS(function, ...)                                                                                                    \
    do {                                                                                                                       \
        EACH(ROW, function, __VA_ARGS__)                                                                                       \
    } while (0)

/* All arguments are NaN. */
#define EXPECT_NAN(...)                                                                                                        \
    do {                                                                                                                       \
        EACH(EXPECT_NOT_KNOWN, , __VA_ARGS__)                                                                                  \
    } while (0)

#endif
