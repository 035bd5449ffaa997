/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run the tests of one file, named by the program's own name. A program holds the tests of one folder; as "all" it runs each
 * file. */
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GROUPS_MAX 100
#define TESTS_MAX  1000

/* The tests of one file. */
static struct group {
    const char *file;
    struct CMUnitTest *tests;
    size_t count;
    CMFixtureFunction set_up, tear_down;
} groups[GROUPS_MAX];

static struct CMUnitTest tests[TESTS_MAX];
static size_t groups_count, tests_count;

/* Return the group of a file; the tests of a file are added in a row. */
static struct group *find_group(const char *file)
{
    if (groups_count == 0 || strcmp(groups[groups_count - 1].file, file) != 0) {
        assert_true(groups_count < GROUPS_MAX);
        groups[groups_count++] = (struct group){.file = file, .tests = &tests[tests_count]};
    }
    return &groups[groups_count - 1];
}

void test_add(const char *file, const char *name, CMUnitTestFunction test, CMFixtureFunction set_up,
              CMFixtureFunction tear_down)
{
    assert_true(tests_count < TESTS_MAX);
    find_group(file)->count++;
    tests[tests_count++] = (struct CMUnitTest){name, test, set_up, tear_down, NULL};
}

void test_around(const char *file, CMFixtureFunction set_up, CMFixtureFunction tear_down)
{
    struct group *group = find_group(file);
    group->set_up = set_up;
    group->tear_down = tear_down;
}

/* Run the tests of a group and return the number of failures. If TEST_FIRST is set, stop after the first failure. */
static int run_group(const struct group *group, const char *name)
{
    size_t step = getenv("TEST_FIRST") ? 1 : group->count;
    int failed = 0;
    for (size_t i = 0; i < group->count && failed == 0; i += step)
        failed = _cmocka_run_group_tests(name, group->tests + i, step, group->set_up, group->tear_down);
    return failed;
}

int main(int argc, char **argv)
{
    (void)argc;
    const char *called = strrchr(argv[0], '/') ? strrchr(argv[0], '/') + 1 : argv[0];
    int failed = 0, run = 0;
    for (const struct group *group = groups; group < groups + groups_count; group++) {
        const char *name = strrchr(group->file, '/') + 1;
        size_t n = strlen(called);
        if (strcmp(called, "all") != 0 && (strncmp(name, called, n) != 0 || strcmp(name + n, ".c") != 0))
            continue;
        failed += run_group(group, name);
        run++;
    }
    if (run == 0)
        printf("Bail out! %s.c has no tests here\n", called);
    return failed > 0 || run == 0;
}
