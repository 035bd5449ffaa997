/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a contact adds to the variates of its rock, in one text for the walk of one rock and for lanes: it is written with
 * the operations of one_lane.h or lanes.h, one of which was included before. See variate_sums.h. */
#ifndef CEDUO_VARY_H
#define CEDUO_VARY_H

#include <stddef.h>

LANE void add_by_place(double *to, size_t row, reals term, reals place)
{
    reals farther = mul(term, place);
    add_to(to, term);
    add_to(to + row, farther);
    add_to(to + 2 * row, mul(farther, place));
}

/* `turn`: of the facet, less its mean; `along`: the speed along the segment before the contact; `place`: how far on the way
 * to the last control. The sums are `row` numbers apart. */
LANE void vary(double *sums, size_t row, reals turn, reals along, reals place)
{
    reals first = mul(turn, along), second = mul(first, along), third = mul(second, along);
    add_by_place(sums, row, first, place);
    add_by_place(sums + 3 * row, row, second, place);
    add_by_place(sums + 6 * row, row, third, place);
    add_to(sums + 9 * row, mul(third, along));
}

#endif
