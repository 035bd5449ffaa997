/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "wide.h"

#include <math.h>
#include <stdlib.h>

static void fill(struct wide_table *t, size_t i, double first, double second)
{
    t->pairs[i][0] = first;
    t->pairs[i][1] = second;
    if (i < TABLE_SMALL) {
        t->first[i] = first;
        t->second[i] = second;
    }
}

static void fill_all(struct wide_ground *wide, const struct ground *g)
{
    size_t n = g->n;
    fill(&wide->place, 0, g->x[0] - 1, INFINITY);
    for (size_t i = 0; i <= n; i++)
        fill(&wide->place, i + 1, g->x[i], g->z[i]);
    fill(&wide->place, n + 2, g->x[n] + 1, INFINITY);
    for (size_t j = 0; j < n; j++) {
        const struct ground_segment *s = &g->segments[j];
        fill(&wide->slope, j + 1, s->m, s->theta);
        fill(&wide->tilt, j + 1, s->c, s->s);
        fill(&wide->share, j + 1, s->rn, s->rt);
        fill(&wide->brake, j + 1, s->friction * s->c, 0);
        fill(&wide->grip, j + 1, s->mu, s->friction);
    }
}

struct wide_ground *ceduo_wide_ground_create(const struct ground *g)
{
    struct wide_ground *wide = aligned_alloc(_Alignof(struct wide_ground), sizeof *wide);
    if (!wide)
        return NULL;
    *wide = (struct wide_ground){0};
    struct wide_table *tables[] = {&wide->place, &wide->slope, &wide->tilt, &wide->share, &wide->brake, &wide->grip};
    size_t count = sizeof tables / sizeof tables[0], entries = g->n + 3;
    wide->small = entries <= TABLE_SMALL;
    wide->room = calloc(count * entries, sizeof *wide->room);
    if (!wide->room) {
        free(wide);
        return NULL;
    }
    for (size_t i = 0; i < count; i++)
        tables[i]->pairs = wide->room + i * entries;
    fill_all(wide, g);
    return wide;
}

void ceduo_wide_ground_free(struct wide_ground *wide)
{
    if (!wide)
        return;
    free(wide->room);
    free(wide);
}

wide_walk_fn *ceduo_wide_walk(enum ceduo_kernel kernel, size_t *lanes)
{
#if defined(__x86_64__) && defined(__GNUC__)
    bool avx2 = __builtin_cpu_supports("avx2");
    bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
    if (avx512 && (kernel == CEDUO_KERNEL_BEST || kernel == CEDUO_KERNEL_AVX512)) {
        *lanes = 32;
        return ceduo_wide_walk_avx512;
    }
    if (avx2 && (kernel == CEDUO_KERNEL_BEST || kernel == CEDUO_KERNEL_AVX2)) {
        *lanes = 16;
        return ceduo_wide_walk_avx2;
    }
#else
    (void)kernel;
#endif
    *lanes = 1;
    return NULL;
}
