/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz calls of ceduo/handle.h, one per line: a letter, the digit of a handle, then arguments. A missing argument is NULL or 0.
 *
 *   o N SCENE                open one of `scenes` as handle N
 *   s N PATH TEXT            set
 *   r N ROCKS THREADS        simulate
 *   g N PATH                 get
 *   v N OPTION CONTROL QUANTITY NUMBER   copy samples
 *   c N                      close
 *
 * A call that fails has a message, and a call that succeeds has none. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "fuzz.h"

#define HANDLES   4
#define CALLS_MAX 40
#define ROCKS_MAX 30 /* in a simulation, and in a copy of samples */

struct opened {
    ceduo_handle handle; /* 0: none; a closed handle keeps its number */
    bool open;
};

/* Read an argument from the rest of a line; NULL: there is none. */
static char *next_word(char **rest)
{
    return strsep(rest, " ");
}

static long long next_number(char **rest)
{
    const char *word = next_word(rest);
    return word ? strtoll(word, NULL, 0) : 0;
}

static void check_message(ceduo_handle handle, bool good)
{
    if ((ceduo_error(handle)[0] == '\0') != good)
        abort();
}

static void open_handle(struct opened *o, char *rest)
{
    static const char *const scenes[] = {"profiles/scenes/paper-site.yaml", "profiles/scenes/rotation.yaml",
                                         "profiles/scenes/blocks-above-the-road.yaml", "profiles/none.yaml", NULL};
    unsigned long long number = (unsigned long long)next_number(&rest);
    if (o->open)
        return;
    ceduo_handle handle = ceduo_open(scenes[number % (sizeof scenes / sizeof *scenes)]);
    check_message(0, handle != 0);
    *o = handle ? (struct opened){handle, true} : *o;
}

/* Simulate few rocks, or more than the maximum. The scene may have many. */
static void simulate(ceduo_handle handle, char *rest)
{
    double own[3];
    uint64_t rocks = (uint64_t)next_number(&rest);
    unsigned threads = (unsigned)next_number(&rest);
    rocks = rocks <= CEDUO_ROCKS_MAX ? rocks % ROCKS_MAX : rocks;
    if (rocks == 0 && ceduo_get(handle, "simulation.rocks", own) == CEDUO_OK && own[0] > ROCKS_MAX)
        rocks = 1;
    check_message(handle, ceduo_simulate(handle, rocks, threads) == CEDUO_OK);
}

static void get(ceduo_handle handle, char *rest)
{
    double value[3];
    bool good = ceduo_get(handle, rest, rest ? value : NULL) == CEDUO_OK;
    check_message(handle, good);
    if (good && (isinf(value[0]) || value[1] > value[2]))
        abort();
}

static void copy_samples(ceduo_handle handle, char *rest)
{
    int option = (int)next_number(&rest);
    size_t control = (size_t)next_number(&rest);
    const char *quantity = next_word(&rest);
    size_t n = (size_t)next_number(&rest) % ROCKS_MAX;
    double *to = malloc(n * sizeof *to);
    int64_t rocks = ceduo_samples(handle, option, control, quantity, n > 0 ? to : NULL, n);
    check_message(handle, rocks >= 0);
    for (size_t i = 0; i < n && (int64_t)i < rocks; i++)
        if (isinf(to[i]))
            abort();
    free(to);
}

static void call(struct opened *handles, char *line)
{
    char letter = line[0];
    struct opened *o = &handles[line[0] ? (unsigned char)line[1] % HANDLES : 0];
    char *rest = strchr(line, ' ');
    rest = rest ? rest + 1 : NULL;
    if (letter == 'o') {
        open_handle(o, rest);
    } else if (letter == 's') {
        const char *path = next_word(&rest);
        check_message(o->handle, ceduo_set(o->handle, path, rest) == CEDUO_OK);
    } else if (letter == 'r') {
        simulate(o->handle, rest);
    } else if (letter == 'g') {
        get(o->handle, rest);
    } else if (letter == 'v') {
        copy_samples(o->handle, rest);
    } else if (letter == 'c') {
        if ((ceduo_close(o->handle) == CEDUO_OK) != o->open)
            abort();
        o->open = false;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct opened handles[HANDLES] = {{0, false}};
    char *text = malloc(size + 1), *rest = text;
    if (!text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    for (size_t i = 0; rest && i < CALLS_MAX; i++)
        call(handles, strsep(&rest, "\n"));
    for (size_t i = 0; i < HANDLES; i++)
        if (handles[i].open && ceduo_close(handles[i].handle) != CEDUO_OK)
            abort();
    free(text);
    return 0;
}
