/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The column that stands still in every view: what passes, whether it protects, how sure that is. */
#include "base/language.h"
#include "screen.h"

static int lines_of(const struct app *app, const struct ceduo_page *page)
{
    return ceduo_page_draw(page, &app->cells->canvas, (struct ceduo_area){0}, 0);
}

/* Warnings that have no room whole are only counted: view 4 has them. */
static void keep_whole(const struct app *app, struct ceduo_page *page, size_t warnings, int height)
{
    size_t left = 0;
    while (left < warnings && lines_of(app, page) + (left > 0) > height) {
        ceduo_page_drop(page);
        left++;
    }
    if (left > 0)
        ceduo_page_say(page, CEDUO_PAGE_WARNING, ngettext("%zu remark more: view 4", "%zu remarks more: view 4", left), left);
}

void ceduo_column_draw(struct app *app, struct ceduo_area area, bool titled)
{
    struct ceduo_page page = {.width = (size_t)area.width};
    struct ceduo_pane pane = ceduo_app_pane(app, area.height);
    if (titled)
        ceduo_screen_title(app, &page);
    keep_whole(app, &page, ceduo_pane_column(&page, &pane), area.height);
    ceduo_page_draw(&page, &app->cells->canvas, area, 0);
    ceduo_page_free(&page);
}
