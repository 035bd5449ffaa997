/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 4: what was found: the forms of the ADC, the energies that arrive, and all of it in words. */
#include "app.h"
#include "base/language.h"
#include "view/words.h"

/* All of it in words: of this option, and of the run as a whole. */
static void draw_page(struct app *app, struct ceduo_area page)
{
    page.width -= 2; /* the mark of more below stands beside the text */
    struct text text = {0};
    struct ceduo_report report = ceduo_app_report(app);
    ceduo_report_option(&text, &report, app->option, page.width);
    ceduo_words_run_warnings(report.result, &report.remarks, ceduo_app_add_warning, &text);
    ceduo_app_scrolled(app, page, &text);
}

static void draw(struct app *app, struct ceduo_area area)
{
    struct ceduo_picture picture = ceduo_app_picture(app);
    bool wide = area.width >= 110;
    int pictures = wide ? area.height : area.height / 2;
    int half = wide ? area.width / 2 - 1 : area.width;
    struct ceduo_area adc = {area.left, area.top, half, wide ? pictures / 3 : area.height >= 30 ? pictures / 2 : 0};
    struct ceduo_area histogram = {area.left, area.top + adc.height, half, pictures - adc.height - 1};
    struct ceduo_area page = {wide ? area.left + half + 2 : area.left, wide ? area.top : area.top + pictures,
                              wide ? area.width - half - 2 : area.width, wide ? area.height : area.height - pictures};
    if (wide && area.height >= 30) { /* energy along the slope as well */
        histogram.height = pictures / 3;
        struct ceduo_area energy = {area.left, histogram.top + histogram.height + 1, half,
                                    area.height - adc.height - histogram.height - 1};
        ceduo_plot_draw(CEDUO_PLOT_ENERGY, &app->cells->canvas, &energy, &picture);
    }
    if (adc.height > 4)
        ceduo_plot_draw(CEDUO_PLOT_ADC, &app->cells->canvas, &adc, &picture);
    if (picture.scene->blocks_count > 0 && histogram.height >= 20) { /* beside the energies how often they come */
        struct ceduo_area hazard = {area.left, histogram.top + histogram.height / 2, half, (histogram.height + 1) / 2};
        histogram.height = histogram.height / 2 - 1;
        ceduo_plot_draw(CEDUO_PLOT_HAZARD, &app->cells->canvas, &hazard, &picture);
        ceduo_plot_draw(CEDUO_PLOT_HISTOGRAM, &app->cells->canvas, &histogram, &picture);
    } else {
        ceduo_plot_draw(picture.scene->blocks_count > 0 ? CEDUO_PLOT_HAZARD : CEDUO_PLOT_HISTOGRAM, &app->cells->canvas,
                        &histogram, &picture);
    }
    draw_page(app, page);
}

const struct view ceduo_view_results = {
    .title = NP_("view", "results"),
    .panes = 1,
    .result = true,
    .draw = draw,
    .bar = {{ACTION_DOWN, N_("read on")}, {ACTION_EXPORT, N_("export")}, {ACTION_NEXT_OPTION, N_("next option")}}};
