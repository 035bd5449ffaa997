/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a hit of a stem does to a rock, in one text for the walk of one rock and for lanes: it is written with the
 * operations of one_lane.h or lanes.h, one of which was included before. */
#ifndef CEDUO_HIT_H
#define CEDUO_HIT_H

/* A hit as the rock comes: its kinetic energy, what the stem takes of a rock that has as much (J), and the share of the
 * rock's energy that this hit takes at the most. */
struct hit {
    reals energy, cost, part;
};

/* J that the stem takes. */
LANE reals energy_taken(struct hit h)
{
    reals most = mul(h.part, h.energy);
    return pick(less(h.cost, most), h.cost, most);
}

/* Kinetic energy (J) of a rock in flight. */
LANE reals flying_energy(reals mass, reals moment, reals vx, reals vz, reals spin)
{
    reals translation = mul(mul(all(0.5), mass), add(mul(vx, vx), mul(vz, vz)));
    return add(translation, mul(mul(all(0.5), moment), mul(spin, spin)));
}

/* The share of its speed that the rock keeps, 0 where the stem stops it. */
LANE reals speed_kept(struct hit h)
{
    reals taken = energy_taken(h);
    return pick(less(taken, h.energy), root_of(sub(all(1), over(taken, h.energy))), all(0));
}

#endif
