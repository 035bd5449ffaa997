/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 4: what was found: the ADC of each belt, the energy that is left, the energies that arrive, and all of it in words. */
#include "app.h"
#include "base/language.h"

#define WIDE_MIN   110 /* columns that hold pictures beside the words */
#define HEIGHT_ALL 30  /* lines with room for energy along the slope */
#define BARS_MIN   7   /* lines of the energies as bars */

/* `bars`: the energies as bars stand among the words. */
static void draw_page(struct app *app, struct ceduo_area area, const struct ceduo_picture *picture, bool bars)
{
    area.width -= 2; /* the mark of more below stands beside the text */
    struct ceduo_page page = {.width = (size_t)area.width};
    struct ceduo_pane pane = ceduo_app_pane(app, area.height);
    int rest = area.height - ceduo_page_draw(&page, &app->cells->canvas, (struct ceduo_area){0}, 0);
    if (bars) {
        ceduo_plot_add(CEDUO_PLOT_HISTOGRAM, &page, picture,
                       rest > BARS_MIN ? rest < 2 * BARS_MIN ? rest : 2 * BARS_MIN : BARS_MIN);
        ceduo_page_add(&page, CEDUO_PAGE_GAP);
    }
    ceduo_pane_words(&page, &pane);
    ceduo_app_page(app, area, &page);
}

static void draw(struct app *app, struct ceduo_area area)
{
    struct ceduo_picture picture = ceduo_app_picture(app);
    bool wide = area.width >= WIDE_MIN, blocks = picture.scene->blocks_count > 0;
    enum ceduo_plot plots[3] = {blocks ? CEDUO_PLOT_HAZARD : CEDUO_PLOT_HISTOGRAM, CEDUO_PLOT_ENERGY, CEDUO_PLOT_HEIGHT};
    int half = wide ? area.width / 2 - 1 : area.width, n = !wide ? blocks : area.height >= HEIGHT_ALL ? 3 : 2;
    struct ceduo_area page = area, plot = {area.left, area.top, half, area.height / (wide ? n : 2) - 1};
    if (wide) {
        page.left += half + 2;
        page.width -= half + 2;
    } else if (n > 0) { /* how often which energy comes, in place of the energies as bars */
        plot = cut_bottom(&page, plot.height);
        cut_bottom(&page, 1);
    }
    for (int i = 0; i < n; i++, plot.top += plot.height + 1)
        ceduo_app_plot(app, plots[i], plot, &picture);
    draw_page(app, page, &picture, n == 0);
}

const struct view ceduo_view_results = {
    .panes = 1,
    .result = true,
    .draw = draw,
    .bar = {KEY(DOWN, N_("read on")), KEY(EXPORT, N_("export")), KEY(NEXT_OPTION, N_("next option"))}};
