/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ONE_LANE_H
#define CEDUO_ONE_LANE_H

#include <math.h>
#include <stdbool.h>

/* The operations of lanes.h for one number, so that a text that is written with them serves both. A file includes
 * either this or lanes.h. */
#define LANE static inline __attribute__((always_inline))

typedef double reals;
typedef bool flags;

LANE reals all(double s)
{
    return s;
}
LANE reals add(reals p, reals q)
{
    return p + q;
}
LANE reals sub(reals p, reals q)
{
    return p - q;
}
LANE reals mul(reals p, reals q)
{
    return p * q;
}
LANE reals over(reals p, reals q)
{
    return p / q;
}
LANE reals root_of(reals p)
{
    return sqrt(p);
}
LANE flags less(reals p, reals q)
{
    return p < q;
}
LANE flags but(flags p, flags q)
{
    return p && !q;
}
LANE bool any(flags p)
{
    return p;
}
LANE void add_to(double *to, reals p)
{
    *to += p;
}
LANE reals pick(flags m, reals p, reals q)
{
    return m ? p : q;
}

#endif
