/* SPDX-License-Identifier: GPL-3.0-or-later */
/* TEST(name) { … } is a test of cmocka. The tests of a file run in source order. */
#ifndef TEST_H
#define TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* cmocka requires the four headers above */
#include <cmocka.h>

#define LENGTH(a) (sizeof(a) / sizeof(a)[0])

void test_add(const char *file, const char *name, CMUnitTestFunction test, CMFixtureFunction set_up,
              CMFixtureFunction tear_down);
void test_around(const char *file, CMFixtureFunction set_up, CMFixtureFunction tear_down);

/* Call `set_up` before the first test of the file and `tear_down` after the last. */
#define AROUND_TESTS(set_up, tear_down)                                                                                        \
    __attribute__((constructor)) static void add_around(void)                                                                  \
    {                                                                                                                          \
        test_around(__FILE__, set_up, tear_down);                                                                              \
    }                                                                                                                          \
    struct around_needs_a_semicolon

/* A test with its own set-up and tear-down. */
#define TEST_WITH(name, set_up, tear_down)                                                                                     \
    static void name(void **state);                                                                                            \
    __attribute__((constructor)) static void add_##name(void)                                                                  \
    {                                                                                                                          \
        test_add(__FILE__, #name, name, set_up, tear_down);                                                                    \
    }                                                                                                                          \
    static void name(__attribute__((unused)) void **unused)

#define TEST(name) TEST_WITH(name, NULL, NULL)

#endif
