/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the tests of a program; a program with a main of its own calls test_run(). */
#include "test.h"

#define TESTS_MAX 100

static struct CMUnitTest tests[TESTS_MAX];
static size_t count;

void test_add(const char *name, CMUnitTestFunction test, CMFixtureFunction set_up, CMFixtureFunction tear_down)
{
    assert_true(count < TESTS_MAX);
    tests[count++] = (struct CMUnitTest){name, test, set_up, tear_down, NULL};
}

int test_run(CMFixtureFunction set_up, CMFixtureFunction tear_down)
{
    return _cmocka_run_group_tests("tests", tests, count, set_up, tear_down);
}

__attribute__((weak)) int main(void)
{
    return test_run(NULL, NULL);
}
