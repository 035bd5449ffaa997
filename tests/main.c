/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the tests of one file: a program has those of a folder, and is called by the name of the file. As "all" it runs each. */
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GROUPS_MAX 100
#define TESTS_MAX  1000

/* Tests of one file. */
static struct group {
    const char *file;
    struct CMUnitTest *tests;
    size_t count;
    CMFixtureFunction set_up, tear_down;
} groups[GROUPS_MAX];

static struct CMUnitTest tests[TESTS_MAX];
static size_t groups_count, tests_count;

/* Returns the group of a file, whose tests are added one after the other. */
static struct group *group_of(const char *file)
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
    group_of(file)->count++;
    tests[tests_count++] = (struct CMUnitTest){name, test, set_up, tear_down, NULL};
}

void test_around(const char *file, CMFixtureFunction set_up, CMFixtureFunction tear_down)
{
    struct group *group = group_of(file);
    group->set_up = set_up;
    group->tear_down = tear_down;
}

/* Runs the tests of a group and returns how many failed; with TEST_FIRST in the environment none after the first that fails. */
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
