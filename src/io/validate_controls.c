/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "validate.h"

static void check_control(struct validator *v, const char *path, const struct ceduo_control *c, size_t i)
{
    const struct ceduo_scene *scene = &v->draft.scene;
    double end = v->profile ? scene->slope.x[scene->slope.vertices - 1] : INFINITY;
    bool starts = v->profile && ceduo_is_sound(v, "release.x_m");
    double last = starts ? ceduo_number_highest(scene->release.x) : -INFINITY;
    const char *here = ceduo_decimal(v, c->x_given);
    size_t k = 0;
    while (k < i && scene->controls[k].x != c->x)
        k++;
    if (c->x > end)
        ceduo_complain(v, path, "", _("%s lies beyond the slope, which ends at %s m"), here, ceduo_decimal(v, end + v->origin));
    else if (c->x <= last)
        ceduo_complain(v, path, "", _("%s does not lie beyond the release, %s m"), here, ceduo_decimal(v, last + v->origin));
    else if (k < i)
        ceduo_complain(v, path, "", _("%s is given twice"), here);
}

void ceduo_validate_controls(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    bool listed = scene->controls_count > 0;
    size_t n = listed ? scene->controls_count : v->draft.controls_m_count;
    const char *path = listed ? "controls" : "controls_m";
    scene->controls_count = 0;
    if (ceduo_node_get(v->root, "controls") && ceduo_node_get(v->root, "controls_m")) {
        ceduo_complain(v, "controls_m", "", _("controls already say this; keep one of the two"));
        return;
    }
    if (!ceduo_is_known(v, "controls") || !ceduo_is_known(v, "controls_m"))
        return;
    if (n == 0) {
        ceduo_complain(v, "", "", _("'controls' is missing: name at least one place where passing rocks are counted"));
        return;
    }
    if (ceduo_is_too_long(v, path, n) || (!listed && !(scene->controls = ceduo_room(v, n, sizeof *scene->controls))))
        return;
    for (size_t i = 0; i < n; i++) {
        struct ceduo_control *c = &scene->controls[i];
        if (!listed) { /* by its x alone */
            ceduo_schema_init(ceduo_schema_field(ceduo_schema_scene(), "controls")->object, c);
            c->x_given = v->draft.controls_m[i];
        }
        c->x = c->x_given - v->origin;
        check_control(v, ceduo_format(v, listed ? "%s[%zu].x_m" : "%s[%zu]", path, i), c, i);
    }
    scene->controls_count = n;
}
