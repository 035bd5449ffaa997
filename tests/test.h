/* SPDX-License-Identifier: GPL-3.0-or-later */
/* TEST(name) { … } is a test of cmocka; a program runs all of its tests in the order of the source. */
#ifndef TEST_H
#define TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* cmocka wants the four above first */
#include <cmocka.h>

#define LENGTH(a) (sizeof(a) / sizeof(a)[0])

/* Run all, with functions that are called before the first and after the last. */
int test_run(CMFixtureFunction set_up, CMFixtureFunction tear_down);
void test_add(const char *name, CMUnitTestFunction test, CMFixtureFunction set_up, CMFixtureFunction tear_down);

/* With functions that are called before and after it. */
#define TEST_WITH(name, set_up, tear_down)                                                                                     \
    static void name(void **state);                                                                                            \
    __attribute__((constructor)) static void add_##name(void)                                                                  \
    {                                                                                                                          \
        test_add(#name, name, set_up, tear_down);                                                                              \
    }                                                                                                                          \
    static void name(__attribute__((unused)) void **unused)

#define TEST(name) TEST_WITH(name, NULL, NULL)

#endif
