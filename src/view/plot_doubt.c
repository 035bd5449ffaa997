/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How sure the answer is: for each option the range of what may be true, in it the error of the rocks; below, what the option
 * of the picture depends on, as bars of the share of each input, with the width of the doubt if it were known. */
#include <math.h>

#include "base/language.h"
#include "measure.h"
#include "plot_parts.h"
#include "report_doubt.h"

#define SHOWN_LEAST  0.005 /* of the share of an input */
#define INPUTS_LEAST 2     /* lines: a head and one input */

static void add_option(struct ceduo_page *page, const struct ceduo_measure *m, enum ceduo_role role, const char *name)
{
    ceduo_page_mark(page, role, name);
    struct ceduo_page_bar *bar = ceduo_page_bar(page, m->hi, CEDUO_ROLE_TITLE);
    bar->from = fmax(1e-9, m->lo); /* what the rocks leave open takes at least one cell, at 0, too */
    bar->least = m->may_lo;
    bar->most = m->may_hi;
    ceduo_page_write(page, isnan(m->may_lo) ? "%s" : "%s (%s)", VALUE_OF(*m), MAY_BE(*m));
}

/* Returns the lines that it takes. */
static int add_options(struct ceduo_page *page, const struct ceduo_doubt_report *r, size_t option, int height)
{
    static const struct ceduo_page_column columns[] = {
        {"", 10, 0, CEDUO_FILLS}, {"", 12, 1, CEDUO_FILLS}, {"", -12, 1, CEDUO_FITS}};
    const struct ceduo_scene *scene = &r->file->scene;
    size_t n = scene->options_count, lines = height > 4 ? (size_t)height - 1 : 3;
    size_t most = lines * 2 / 3, room = n + INPUTS_LEAST <= lines ? n : most > 1 ? most - 1 : 1;
    size_t first = option >= room ? option - room + 1 : 0;
    CEDUO_PAGE_TABLE_OF(page, columns);
    struct ceduo_page_cell *heads = page->last->cells;
    const struct ceduo_measure judged = ceduo_judged(&scene->controls[ceduo_scene_last_control(scene)], NULL);
    bool share = ceduo_doubt_main(r, 0)->kind != CEDUO_DOUBT_ENERGY;
    ceduo_text_put(&heads[0].text, share ? NAMED(judged, CEDUO_HEAD) : _("kJ a rock"));
    ceduo_text_put(&heads[2].text, r->over ? _("years (may be)") : _("now (may be)"));
    double end = 0; /* of the axis */
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_measure m = ceduo_doubt_measure(r, i, NULL);
        end = fmax(end, fmax(m.may_hi, m.hi));
        if (i >= first && i < first + room)
            add_option(page, &m, i == option ? CEDUO_ROLE_TITLE : CEDUO_ROLE_TEXT, scene->options[i].name);
    }
    end = end > 0 ? ceduo_plot_round(end, true) : 1;
    end = ceduo_doubt_scale(r) > 1 ? fmin(1000, end) : end;
    ceduo_text_format(&page->last->cells[1].text, "0\xe2\x80\x93%s", ROUNDED(end, 4));
    ceduo_page_scale(page, 1, 0, end);
    if (n > room)
        ceduo_page_say(page, CEDUO_PAGE_NOTE, ngettext("%zu more option: ] goes on", "%zu more options: ] goes on", n - room),
                       n - room);
    return 1 + (int)(n > room ? room + 1 : n);
}

static void add_inputs(struct ceduo_page *page, const struct ceduo_doubt_report *r, size_t option, int lines)
{
    static const struct ceduo_page_column columns[] = {
        {N_("it depends on"), 18, 0, CEDUO_FILLS}, {"", 6, 1, CEDUO_FILLS}, {"", -5, 1, CEDUO_FITS}, {"", -8, 2, CEDUO_FITS}};
    const struct ceduo_doubt_figure *f = ceduo_doubt_main(r, option);
    if (lines < 2)
        return;
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_text_format(&page->last->cells[3].text, _("of %.3g wide"), (f->fit.p95 - f->fit.p5) * ceduo_doubt_scale(r));
    for (size_t i = 0, n = 1; f->fit.enough && i < f->uses && n < (size_t)lines; i++)
        if (f->fit.total[f->order[i]].value >= SHOWN_LEAST) {
            double share = ceduo_doubt_share(f, f->order[i]);
            ceduo_doubt_input_name(ceduo_page_text(page), r, f->order[i]);
            ceduo_page_bar(page, share, CEDUO_ROLE_MEAN);
            ceduo_page_write(page, "%.0f %%", share * 100);
            ceduo_doubt_left(ceduo_page_text(page), f, f->order[i], _("leaves %s"));
            n++;
        }
}

const char *ceduo_plot_doubt(struct ceduo_drawing *d)
{
    const struct ceduo_doubt_report *r = d->picture->doubt;
    if (!r)
        return _("not computed yet");
    if (!r->answer)
        return ceduo_doubt_none(r);
    int used = add_options(d->page, r, d->picture->option, d->height);
    add_inputs(d->page, r, d->picture->option, d->height - used);
    return NULL;
}
