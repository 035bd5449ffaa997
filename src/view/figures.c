/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "figures.h"

#include <math.h>

double ceduo_figure_scale(const struct ceduo_figure *f, double scale)
{
    return f->scale > 0 ? scale * f->scale : scale;
}

struct ceduo_value ceduo_figure_value(const struct ceduo_figure *f, const void *object, double scale)
{
    const void *from = object && f->from ? f->from(object) : object;
    struct ceduo_value v = from ? f->value(f, from) : (struct ceduo_value){.kind = CEDUO_NULL};
    if (v.kind == CEDUO_VALUE_NUMBER)
        v.number *= ceduo_figure_scale(f, scale);
    bool exists = v.kind != CEDUO_VALUE_NUMBER || isfinite(v.number);
    if (!exists || (v.kind == CEDUO_VALUE_TEXT && !v.text))
        v.kind = CEDUO_NULL;
    return v;
}

const void *ceduo_figure_object(const struct ceduo_figure *f, const void *object)
{
    const void *from = object && f->from ? f->from(object) : object;
    return from ? (const char *)from + f->offset : NULL;
}
