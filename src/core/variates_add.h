/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums of the variates of many rocks: see variate_sums.h. This is compiled for each kind of registers. */
#ifndef CEDUO_VARIATES_ADD_H
#define CEDUO_VARIATES_ADD_H

#include "many.h"
#include "variate_sums.h"

_Static_assert(VARIATES == 10 && VARIED_ROW % MANY == 0, "as they are written out below");
#define EACH_VARIATE(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7) DO(8) DO(9)

/* `from`: VARIED_ROW numbers of the first rock, those of the next `apart` behind them. */
static inline void add_products(double to[VARIATES][VARIED_ROW], const double *from, size_t apart,
                                const struct variate_row *rows, size_t n)
{
    for (size_t part = 0; part < VARIED_ROW; part += MANY) {
#define TAKE(i)      \
    many_reals sum##i; \
    memcpy(&sum##i, &to[i][part], sizeof sum##i);
#define ADD(i) sum##i += numbers * x[i];
#define GIVE(i) memcpy(&to[i][part], &sum##i, sizeof sum##i);
        EACH_VARIATE(TAKE)
        for (size_t r = 0; r < n; r++) {
            const double *x = rows[r].x;
            many_reals numbers;
            memcpy(&numbers, &from[r * apart + part], sizeof numbers);
            EACH_VARIATE(ADD)
        }
        EACH_VARIATE(GIVE)
#undef TAKE
#undef ADD
#undef GIVE
    }
}

static void add_variates(struct variate_sums *to, const struct variate_row *rows, size_t n)
{
    for (int half = 0; half < 2; half++)
        add_products(to->with[half], rows[0].x + half * VARIED_ROW, 2 * VARIED_ROW, rows, n);
}

static void add_varied(struct varied_sums *to, const double *brought, const struct variate_row *rows, size_t n)
{
    add_products(to->with, brought, VARIED_ROW, rows, n);
}

#endif
