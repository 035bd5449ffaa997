/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "wide.h"

#include <math.h>
#include <stdlib.h>

#define TABLES 9
#define SMALL  16 /* the least room of a table */

bool ceduo_wide_ground_init(struct wide_ground *wide, const struct ground *g)
{
    size_t n = g->n, room = n + 3 < SMALL ? SMALL : n + 3;
    double **tables[TABLES] = {&wide->x,  &wide->z,  &wide->m,     &wide->c,    &wide->s,
                               &wide->rn, &wide->rt, &wide->theta, &wide->brake};
    double *all = calloc(TABLES * room, sizeof *all);
    if (!all)
        return false;
    for (size_t i = 0; i < TABLES; i++)
        *tables[i] = all + i * room;
    for (size_t i = 0; i <= n; i++) {
        wide->x[i + 1] = g->x[i];
        wide->z[i + 1] = g->z[i];
    }
    wide->x[0] = g->x[0] - 1;
    wide->x[n + 2] = g->x[n] + 1;
    wide->z[0] = wide->z[n + 2] = INFINITY;
    for (size_t j = 0; j < n; j++) {
        const struct ground_segment *s = &g->segments[j];
        wide->m[j + 1] = s->m;
        wide->c[j + 1] = s->c;
        wide->s[j + 1] = s->s;
        wide->rn[j + 1] = s->rn;
        wide->rt[j + 1] = s->rt;
        wide->theta[j + 1] = s->theta;
        wide->brake[j + 1] = s->mu * s->c;
    }
    return true;
}

void ceduo_wide_ground_release(struct wide_ground *wide)
{
    free(wide->x); /* all tables are one piece */
    *wide = (struct wide_ground){0};
}

#if defined(__x86_64__) && defined(__GNUC__)

wide_walk_fn *ceduo_wide_walk(enum ceduo_kernel kernel, size_t *lanes)
{
    bool avx2 = __builtin_cpu_supports("avx2");
    bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
    if (avx512 && (kernel == CEDUO_KERNEL_BEST || kernel == CEDUO_KERNEL_AVX512)) {
        *lanes = 16;
        return ceduo_wide_walk_avx512;
    }
    if (avx2 && (kernel == CEDUO_KERNEL_BEST || kernel == CEDUO_KERNEL_AVX2)) {
        *lanes = 8;
        return ceduo_wide_walk_avx2;
    }
    *lanes = 1;
    return NULL;
}

#else

wide_walk_fn *ceduo_wide_walk(enum ceduo_kernel kernel, size_t *lanes)
{
    (void)kernel;
    *lanes = 1;
    return NULL;
}

#endif
