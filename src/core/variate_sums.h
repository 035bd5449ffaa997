/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VARIATE_SUMS_H
#define CEDUO_VARIATE_SUMS_H

#include <stddef.h>

#include "ceduo/trajectory.h"

/* Control variates. At each contact the facet's turn less its mean, multiplied by what is known before it is drawn, has mean
 * 0 whatever came before: so have its sums along a rock's way, up to any place where the rock comes to (a stopped martingale).
 * They tell in part which rocks drew luck, and a regression on them takes that part out of means and shares. */
#define VARIATES 10

/* What is summed of the rocks at a control beside their number: as many means are adjusted. */
enum varied {
    VARIED_REACHED,  /* 1 for a rock that arrives, otherwise 0 */
    VARIED_EXCEEDED, /* likewise with more than is accepted */
    VARIED_SPEED, VARIED_HEIGHT, VARIED_ENERGY, VARIED_TRANSLATION, /* what it brings, 0 where it does not arrive */
    VARIED_ENDED,    /* and from here on 1 for a rock that did not arrive, by how it ended */
    VARIED = VARIED_ENDED + CEDUO_ENDS
};

#define VARIATE_PAIRS (VARIATES * (VARIATES + 1) / 2)

/* So many numbers of a rock are multiplied by each of its variates and summed at a time. */
#define VARIED_ROW 8

/* Of one rock: its variates, then a 1, then zeros. */
struct variate_row {
    _Alignas(64) double x[2 * VARIED_ROW];
};

/* Sums over all rocks, which are those up to the last control and serve all. */
struct variate_sums {
    double with[2][VARIATES][VARIED_ROW]; /* of each variate times the halves of a row; read only up to the variate itself */
};

/* The sum of variate i, or of i times j, which is no larger. */
static inline double *variate_sum(struct variate_sums *s, size_t i)
{
    return &s->with[VARIATES / VARIED_ROW][i][VARIATES % VARIED_ROW];
}

static inline double *variate_product(struct variate_sums *s, size_t i, size_t j)
{
    return &s->with[j / VARIED_ROW][i][j % VARIED_ROW];
}

/* Sums over the rocks at a control. */
struct varied_sums {
    double with[VARIATES][VARIED_ROW]; /* of each variate times what the rock brings, up to VARIED_ENDED */
    double ended[CEDUO_ENDS][VARIATES];
};

/* Adds n rocks, each in its turn: `rows` are their variates, `brought` the VARIED_ROW numbers that each brings, 0 where it
 * does not arrive. The bits are the same for each kind of registers. */
struct variates_kernel {
    void (*add)(struct variate_sums *to, const struct variate_row *rows, size_t n);
    void (*add_with)(struct varied_sums *to, const double *brought, const struct variate_row *rows, size_t n);
};
/* The first is for any machine. */
extern const struct variates_kernel ceduo_variates_scalar, ceduo_variates_avx2, ceduo_variates_avx512;

#endif
