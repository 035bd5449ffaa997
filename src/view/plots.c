/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure.h"
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
    const char *why = canvas->words_alone ? NULL : functions[plot](canvas, area, picture);
    if (!why)
        return;
    int width = ceduo_canvas_label_width(canvas, why);
    int column = width < area->width ? (area->width - width) / 2 : 0;
    ceduo_canvas_put(canvas, area->left + column, area->top + (area->height - 1) / 2, area->width, CEDUO_ROLE_TEXT, why);
}

/* ---- titles ---- */

/* What a picture shows; %s: where, or which belt; `run`: it is of rocks, without forest where none go through one. */
static const struct {
    const char *title;
    bool whole, run; /* whole: of all options, so that none stands before it */
} titles[CEDUO_PLOTS] = {[CEDUO_PLOT_PROFILE] = {N_("slope, forest, and ways"), false, true},
                         [CEDUO_PLOT_ENERGY] = {N_("energy of the rocks"), false, true},
                         [CEDUO_PLOT_HEIGHT] = {N_("height of the rocks above the ground"), false, true},
                         [CEDUO_PLOT_HISTOGRAM] = {N_("energy at %s"), false, true},
                         [CEDUO_PLOT_ADC] = {N_("average distance between contacts, m"), false, false},
                         [CEDUO_PLOT_ROTATION] = {N_("year by year, up to %s"), false, false},
                         [CEDUO_PLOT_STAND] = {N_("%s, from above"), false, false},
                         [CEDUO_PLOT_COMPARE] = {N_("Options side by side, up to %s"), true, false},
                         [CEDUO_PLOT_TRADEOFF] = {N_("Protection and yield of the options, up to %s"), true, false},
                         [CEDUO_PLOT_DOUBT] = {N_("how sure it is at %s"), false, false},
                         [CEDUO_PLOT_HAZARD] = {N_("How often, and with how much, at %s"), true, false}};

void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *p)
{
    const struct ceduo_control *control = ceduo_plot_control(p);
    const struct ceduo_option *option = ceduo_plot_option(p);
    const struct ceduo_belt *belt = ceduo_plot_belt(p);
    LOCAL_TEXT(place);
    if (plot == CEDUO_PLOT_STAND)
        ceduo_text_put(&place, belt && belt->name ? belt->name : _("no forest"));
    else if (control)
        ceduo_plot_control_name(&place, control);
    else
        ceduo_text_put(&place, _("no control"));
    if (!titles[plot].whole)
        ceduo_text_format(text, "%s: ", option && option->name ? option->name : "");
    ceduo_append_with(text, _(titles[plot].title), ceduo_text_string(&place));
    if (titles[plot].run && !ceduo_plot_wooded(p))
        ceduo_text_then(text, ", ", _("without forest"));
}
