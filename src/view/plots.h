/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLOTS_H
#define CEDUO_PLOTS_H

#include "base/text.h"
#include "plot.h"

/* The pictures by name: what draws one, whether it needs a run, and envelopes of it, and whether there is one for each
 * option. */
#define CEDUO_PLOT_LIST(X)                                                                                             \
    X(PROFILE, "profile", draw_profile, true, false, true)                                                             \
    X(ENERGY, "energy", draw_energy, true, true, true)                                                                 \
    X(HEIGHT, "height", draw_height, true, true, true)                                                                 \
    X(HISTOGRAM, "histogram", ceduo_plot_histogram, true, false, true)                                                 \
    X(ADC, "adc", ceduo_plot_adc, false, false, true)                                                                  \
    X(ROTATION, "rotation", ceduo_plot_rotation, true, false, true)                                                    \
    X(STAND, "stand", ceduo_plot_stand, false, false, true)                                                            \
    X(COMPARE, "compare", ceduo_plot_compare, true, false, false)

enum ceduo_plot {
    CEDUO_PLOT_NONE,
#define X(NAME, name, draw, needs_run, needs_cells, by_option) CEDUO_PLOT_##NAME,
    CEDUO_PLOT_LIST(X)
#undef X
        CEDUO_PLOTS
};

struct ceduo_plot_kind {
    const char *name;
    void (*draw)(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture);
    bool needs_run, needs_cells, by_option;
};

extern const struct ceduo_plot_kind ceduo_plot_kinds[CEDUO_PLOTS]; /* that of CEDUO_PLOT_NONE is empty */

/* CEDUO_PLOT_NONE for a word that names none. */
enum ceduo_plot ceduo_plot_find(const char *name);

/* "profile, energy, …": all names. */
extern const char *const ceduo_plot_names;

/* One line that says what the picture shows. */
void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *picture);

#endif
