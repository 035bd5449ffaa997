/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run a harness without libFuzzer on every seed and n random changes of each, always the same. Prints TAP. replay NAME CHANGES
 * FILE… */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"

#define CAPACITY 65536

struct seed {
    uint8_t *bytes;
    size_t n;
};

static uint64_t state = 0x9e3779b97f4a7c15;

static size_t draw(size_t below)
{
    state ^= state << 13; /* xorshift64 */
    state ^= state >> 7;
    state ^= state << 17;
    return (size_t)(state % below);
}

static struct seed read_seed(const char *path)
{
    struct seed seed = {malloc(CAPACITY), 0};
    FILE *f = fopen(path, "rb");
    if (!seed.bytes || !f) {
        printf("Bail out! %s cannot be read\n", path);
        exit(1);
    }
    seed.n = fread(seed.bytes, 1, CAPACITY, f);
    fclose(f);
    return seed;
}

/* Replace n bytes at `at` by m others. */
static void splice(struct seed *s, size_t at, size_t n, const void *bytes, size_t m)
{
    if (s->n - n + m > CAPACITY)
        return;
    memmove(s->bytes + at + m, s->bytes + at + n, s->n - at - n);
    memcpy(s->bytes + at, bytes, m);
    s->n += m - n;
}

static void change(struct seed *s, const struct seed *second)
{
    static const char *const words =
        "\n\0 \0:\0: \0- \0[\0]\0{\0}\0,\0=\0\"\0'\0#\0&a \0*a\0!\0|\n\0\t\0\xff\0\xc3\0\xe2\x80\xa6\0"
        "\xef\xbb\xbf\0"
        "1e999\0-\0"
        "0\0"
        "1e-320\0nan\0---\n\0? \0\r\n\0\x1b[2J\0[0]\0[a]\0.\0base: \0mean: \0source: \0"
        "999999999\0"
        "0.5\0\x01\0key \0type \0Enter \0Esc \0";
    size_t at = draw(s->n + 1), rest = s->n - at;
    switch (draw(6)) {
    case 0:
        if (rest > 0)
            s->bytes[at] = (uint8_t)draw(256);
        break;
    case 1: {
        const char *word = words;
        for (size_t n = draw(45); n > 0; n--)
            word += strlen(word) + 1;
        splice(s, at, 0, word, strlen(word));
        break;
    }
    case 2: {
        size_t n = draw(2) ? 1 : draw(60);
        splice(s, at, n < rest ? n : rest, "", 0);
        break;
    }
    case 3: {
        uint8_t copy[100];
        size_t n = draw(sizeof copy);
        n = n < rest ? n : rest;
        memcpy(copy, s->bytes + at, n);
        splice(s, draw(s->n + 1), 0, copy, n);
        break;
    }
    case 4: {
        const char *word = words;
        for (size_t n = draw(45); n > 0; n--)
            word += strlen(word) + 1;
        size_t n = draw(12);
        splice(s, at, n < rest ? n : rest, word, strlen(word));
        break;
    }
    default:
        if (second->n > 0) {
            size_t from = draw(second->n), n = draw(200);
            splice(s, at, 0, second->bytes + from, n < second->n - from ? n : second->n - from);
        }
        break;
    }
}

int main(int argc, char **argv)
{
    if (argc < 4)
        return 2;
    size_t n = (size_t)argc - 3, changes = strtoul(argv[2], NULL, 10);
    struct seed *seeds = calloc(n, sizeof *seeds), one = {malloc(CAPACITY), 0};
    if (!seeds || !one.bytes)
        return 1;
    for (size_t i = 0; i < n; i++)
        seeds[i] = read_seed(argv[i + 3]);
    for (size_t i = 0; i < n; i++)
        LLVMFuzzerTestOneInput(seeds[i].bytes, seeds[i].n);
    for (size_t i = 0; i < changes; i++) {
        const struct seed *from = &seeds[draw(n)];
        memcpy(one.bytes, from->bytes, one.n = from->n);
        for (size_t k = 1 + draw(4); k > 0; k--)
            change(&one, &seeds[draw(n)]);
        LLVMFuzzerTestOneInput(one.bytes, one.n);
    }
    printf("ok 1 - fuzz: %s: %zu seeds and %zu changes of them\n1..1\n", argv[1], n, changes);
    for (size_t i = 0; i < n; i++)
        free(seeds[i].bytes);
    free(seeds);
    free(one.bytes);
    return 0;
}
