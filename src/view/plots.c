/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot_parts.h"

#include <string.h>

#include "base/language.h"

const struct ceduo_plot_kind ceduo_plot_kinds[CEDUO_PLOTS] = {
#define X(NAME, name, needs_run, needs_cells, by_option) [CEDUO_PLOT_##NAME] = {#name, needs_run, needs_cells, by_option},
    CEDUO_PLOT_LIST(X)
#undef X
};

#define X(NAME, name, needs_run, needs_cells, by_option) ", " #name
const char *const ceduo_plot_names = &(CEDUO_PLOT_LIST(X))[2];
#undef X

enum ceduo_plot ceduo_plot_find(const char *name)
{
    for (int i = CEDUO_PLOT_NONE + 1; i < CEDUO_PLOTS; i++)
        if (strcmp(ceduo_plot_kinds[i].name, name) == 0)
            return (enum ceduo_plot)i;
    return CEDUO_PLOT_NONE;
}

void ceduo_plot_draw(enum ceduo_plot plot, struct ceduo_canvas *canvas, const struct ceduo_area *area,
                     const struct ceduo_picture *picture)
{
    static ceduo_plot_function *const functions[CEDUO_PLOTS] = {
#define X(NAME, name, needs_run, needs_cells, by_option) [CEDUO_PLOT_##NAME] = ceduo_plot_##name,
        CEDUO_PLOT_LIST(X)
#undef X
    };
    const char *why = functions[plot](canvas, area, picture);
    if (!why)
        return;
    int width = ceduo_canvas_label_width(canvas, why);
    int column = width < area->width ? (area->width - width) / 2 : 0;
    ceduo_canvas_put(canvas, area->left + column, area->top + (area->height - 1) / 2, area->width, CEDUO_ROLE_TEXT, why);
}

/* ---- titles ---- */

/* What stands after the option's name. */
static void put_subject(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *p, const char *where)
{
    const struct ceduo_belt *belt = ceduo_plot_belt(p);
    bool wooded = ceduo_plot_wooded(p);
    switch (plot) {
    case CEDUO_PLOT_PROFILE:
        ceduo_text_put(text, wooded ? _("slope, forest, and ways through it") : _("slope, forest, and ways without forest"));
        break;
    case CEDUO_PLOT_ADC:
        ceduo_text_put(text, _("average distance between contacts, m"));
        break;
    case CEDUO_PLOT_ROTATION:
        ceduo_text_format(text, _("year by year, up to %s"), where);
        break;
    case CEDUO_PLOT_HEIGHT:
        ceduo_text_put(text, wooded ? _("height of the rocks above the ground")
                                    : _("height of the rocks above the ground, without forest"));
        break;
    case CEDUO_PLOT_ENERGY:
        ceduo_text_put(text, wooded ? _("energy of the rocks") : _("energy of the rocks, without forest"));
        break;
    case CEDUO_PLOT_HISTOGRAM:
        ceduo_text_format(text, wooded ? _("energy at %s") : _("energy at %s, without forest"), where);
        break;
    case CEDUO_PLOT_DOUBT:
        ceduo_text_format(text, _("how sure it is at %s"), where);
        break;
    default:
        ceduo_text_format(text, _("%s, from above"), belt && belt->name ? belt->name : _("no forest"));
    }
}

void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *p)
{
    struct text place = {0};
    const struct ceduo_control *control = ceduo_plot_control(p);
    const struct ceduo_option *option = ceduo_plot_option(p);
    if (control)
        ceduo_plot_control_name(&place, control);
    const char *where = place.bytes ? place.bytes : _("no control");
    if (plot == CEDUO_PLOT_COMPARE) {
        ceduo_text_format(text, _("Options side by side, up to %s"), where);
    } else if (plot == CEDUO_PLOT_TRADEOFF) {
        ceduo_text_format(text, _("Protection and yield of the options, up to %s"), where);
    } else if (plot == CEDUO_PLOT_HAZARD) {
        ceduo_text_format(text, _("How often, and with how much, at %s"), where);
    } else {
        ceduo_text_format(text, "%s: ", option && option->name ? option->name : "");
        put_subject(text, plot, p, where);
    }
    ceduo_text_free(&place);
}
