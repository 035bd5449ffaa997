/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/contact.h"

#include "law_crsp.h"
#include "law_lumped.h"

struct ceduo_impact ceduo_contact(enum ceduo_law law, struct ceduo_impact in, const struct ceduo_ground_point *at)
{
    switch (law) {
#define X(NAME, name)      \
    case CEDUO_LAW_##NAME: \
        return law_##name(in, at);
        CEDUO_LAWS(X)
#undef X
    case CEDUO_LAW_COUNT:
        break;
    }
    return in;
}

double ceduo_crsp_friction(double rt, double slip)
{
    return crsp_friction(rt, slip);
}

double ceduo_crsp_scaling(double rn, double rt, double vn)
{
    return crsp_scaling(rn, rt, vn);
}
