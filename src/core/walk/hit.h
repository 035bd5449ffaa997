/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a hit of a stem does to a rock, in one text for the walk of one rock and for lanes. */
#ifndef CEDUO_HIT_H
#define CEDUO_HIT_H

#include "base/real.h"

/* A hit as the rock comes: its kinetic energy, what the stem takes of a rock that has as much (J), and the share of the
 * rock's energy that this hit takes at the most. */
struct hit {
    real energy, cost, share;
};

/* J that the stem takes. */
HOT real energy_taken(struct hit h)
{
    return min(h.cost, h.share * h.energy);
}

/* Kinetic energy (J) of a rock in flight. */
HOT real flying_energy(real mass, real moment, real vx, real vz, real spin)
{
    return 0.5 * mass * (vx * vx + vz * vz) + 0.5 * moment * (spin * spin);
}

/* The share of its speed that the rock keeps, 0 where the stem stops it. */
HOT real speed_kept(struct hit h)
{
    real taken = energy_taken(h);
    return pick(less(taken, h.energy), root_of(1 - taken / h.energy), all(0));
}

#endif
