/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an office expects of a place: percentiles of speed, energy and height with their intervals, and design values. */
#include <math.h>

#include "base/language.h"
#include "page_parts.h"

/* Heights below a metre have no third digit, those below a decimetre no second. */
#define SHOWN(value) WRITTEN(value, (value) < 0.1 ? 1 : (value) < 1 ? 2 : 3)

static void add_percentile(struct ceduo_page *page, double value, double lo, double hi)
{
    struct text *cell = ceduo_page_text(page);
    ceduo_text_put(cell, SHOWN(value));
    if (isnan(value))
        return;
    if (!isnan(lo) && !isnan(hi))
        ceduo_text_format(cell, " (%s\xe2\x80\x93%s)", SHOWN(lo), SHOWN(hi));
    else if (!isnan(lo))
        ceduo_text_format(cell, " (> %s)", SHOWN(lo));
    else if (!isnan(hi))
        ceduo_text_format(cell, " (< %s)", SHOWN(hi));
}

static void add_row(struct ceduo_page *page, const char *name, const struct ceduo_distribution *d, double scale)
{
    ceduo_page_write(page, "%s", name);
    add_percentile(page, d->p50 * scale, d->p50_lo * scale, d->p50_hi * scale);
    add_percentile(page, d->p95 * scale, d->p95_lo * scale, d->p95_hi * scale);
    add_percentile(page, d->p99 * scale, d->p99_lo * scale, d->p99_hi * scale);
}

void ceduo_page_percentiles(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control, bool bare)
{
    static const struct ceduo_page_column columns[] = {{NULL, 22, 4, CEDUO_WHOLE},
                                                       {N_("50 %"), -18, 0, CEDUO_WHOLE},
                                                       {N_("95 %"), -18, 0, CEDUO_WHOLE},
                                                       {N_("99 %"), -18, 0, CEDUO_WHOLE}};
    const struct ceduo_arrivals *runs[] = {option < SIZE_MAX ? ceduo_result_wooded(r, option, control) : NULL,
                                           bare ? &r->bare.arrivals[control] : NULL};
    if (!runs[0] && !runs[1])
        return;
    ceduo_page_say(page, CEDUO_PAGE_CAPTION, "%s",
                   _("Percentiles of the rocks that arrive, of so many released (95 % interval):"));
    for (size_t i = 0; i < 2; i++) {
        const struct ceduo_arrivals *a = runs[i];
        if (!a)
            continue;
        CEDUO_PAGE_TABLE_OF(page, columns);
        ceduo_text_format(&ceduo_page_head(page)->text, i == 0 ? _("wood, %llu of %llu") : _("bare, %llu of %llu"),
                          (unsigned long long)a->reached, (unsigned long long)a->released);
        add_row(page, _("speed, m/s"), &a->speed, 1);
        add_row(page, _("energy, kJ"), &a->energy, J_TO_KJ);
        add_row(page, _("underside, m up"), &a->height, 1);
    }
}

/* ---- design values ---- */

/* The factors of speed and energy of UNI 11211-4, 1.02 where it was done well, otherwise 1.10. */
#define FACTOR(good) ((good) ? 1.02 : 1.10)

/* No factor of the height was found in a text that could be opened: it is printed without one, and that is said. The height is
 * that of the blocks' tops: a work as high as their undersides would stop none. */
void ceduo_page_design(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_design_values *d = &r->scene->design;
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, control), *bare = &r->bare.arrivals[control];
    bool calibrated = ceduo_notes_calibrated(report->file->notes, "slope");
    double survey = FACTOR(d->survey == CEDUO_SURVEY_GOOD), blocks = FACTOR(d->blocks == CEDUO_SURVEY_GOOD);
    double model = FACTOR(calibrated), speed = survey * model, energy = J_TO_KJ * speed * speed * blocks;
    if (d->survey < 0 || d->blocks < 0 || isnan(bare->speed.p95))
        return;
    if (wooded && !isnan(wooded->speed.p95))
        ceduo_page_say(page, CEDUO_PAGE_SENTENCE,
                       _("Design values of UNI 11211-4, as long as the wood stands as in this option: speed %s m/s, energy %s "
                         "kJ, height of the block's top %s m."),
                       WRITTEN(wooded->speed.p95 * speed, 3), WRITTEN(wooded->energy.p95 * energy, 3), SHOWN(wooded->top_p95));
    ceduo_page_say(page, CEDUO_PAGE_SENTENCE,
                   _("Design values of UNI 11211-4, without forest: speed %s m/s, energy %s kJ, height of the block's "
                     "top %s m."),
                   WRITTEN(bare->speed.p95 * speed, 3), WRITTEN(bare->energy.p95 * energy, 3), SHOWN(bare->top_p95));
    ceduo_page_say(
        page, CEDUO_PAGE_DETAIL,
        _("Speed: 95th percentile times %.2f for the survey of the ground and %.2f for the model, %s. Energy: 95th "
          "percentile times the square of both and %.2f for the survey of the blocks. Height: 95th percentile of the "
          "block's top, its underside and its mean diameter, without a factor."),
        survey, model, calibrated ? _("fitted to what was seen") : _("not fitted here"), blocks);
}
