/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an office expects of a place: percentiles of speed, energy and height with their intervals. */
#include <math.h>

#include "base/language.h"
#include "page_parts.h"
#include "words.h"

/* Heights below a metre have no third digit. */
#define DIGITS(value) ((value) < 1 ? 2 : 3)

static void add_percentile(struct ceduo_page *page, double value, double lo, double hi)
{
    struct text *cell = ceduo_page_text(page);
    if (isnan(value)) {
        ceduo_text_char(cell, '-');
        return;
    }
    ceduo_text_put(cell, WRITTEN(value, DIGITS(value)));
    if (!isnan(lo) && !isnan(hi))
        ceduo_text_format(cell, " (%s\xe2\x80\x93%s)", WRITTEN(lo, DIGITS(lo)), WRITTEN(hi, DIGITS(hi)));
    else if (!isnan(lo))
        ceduo_text_format(cell, " (> %s)", WRITTEN(lo, DIGITS(lo)));
    else if (!isnan(hi))
        ceduo_text_format(cell, " (< %s)", WRITTEN(hi, DIGITS(hi)));
}

static void add_row(struct ceduo_page *page, const char *name, const struct ceduo_distribution *d, double scale)
{
    ceduo_text_put(ceduo_page_text(page), name);
    add_percentile(page, d->p50 * scale, d->p50_lo * scale, d->p50_hi * scale);
    add_percentile(page, d->p95 * scale, d->p95_lo * scale, d->p95_hi * scale);
    add_percentile(page, d->p99 * scale, d->p99_lo * scale, d->p99_hi * scale);
}

static void add_run(struct ceduo_page *page, bool wood, const struct ceduo_arrivals *a)
{
    static const struct ceduo_page_column columns[] = {{NULL, 22, 4, CEDUO_WHOLE},
                                                       {N_("50 %"), -18, 0, CEDUO_WHOLE},
                                                       {N_("95 %"), -18, 0, CEDUO_WHOLE},
                                                       {N_("99 %"), -18, 0, CEDUO_WHOLE}};
    ceduo_page_table(page, columns, sizeof columns / sizeof columns[0]);
    ceduo_text_format(&ceduo_page_head(page)->text, wood ? _("wood, %llu of %llu") : _("bare, %llu of %llu"),
                      (unsigned long long)a->reached, (unsigned long long)a->released);
    add_row(page, _("speed, m/s"), &a->speed, 1);
    add_row(page, _("energy, kJ"), &a->energy, KILO);
    add_row(page, _("height, m"), &a->height, 1);
}

/* ---- design values ---- */

/* The factors of UNI 11211-4 as Peila and Ronco 2009 have them: 1.02 where it was done well, otherwise 1.10. */
#define FACTOR(good) ((good) ? 1.02 : 1.10)

static void say_design(struct ceduo_page *page, const struct ceduo_report *report, const char *where,
                       const struct ceduo_arrivals *a)
{
    const struct ceduo_design_values *d = &report->result->scene->design;
    bool calibrated = ceduo_notes_calibrated(report->file->notes, "slope");
    double survey = FACTOR(d->survey == CEDUO_SURVEY_GOOD), blocks = FACTOR(d->blocks == CEDUO_SURVEY_GOOD);
    double model = FACTOR(calibrated), way = survey * model;
    if (isnan(a->speed.p95))
        return;
    ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_SENTENCE),
                      calibrated ? _("Design values of UNI 11211-4, %s: speed %s m/s, energy %s kJ, height %s m. These are the 95th "
                                     "percentiles times %.2f for the survey of the ground and %.2f for the model, fitted to what "
                                     "was seen; the energy times their square and %.2f for the survey of the blocks.")
                                 : _("Design values of UNI 11211-4, %s: speed %s m/s, energy %s kJ, height %s m. These are the 95th "
                                     "percentiles times %.2f for the survey of the ground and %.2f for the model, not fitted "
                                     "here; the energy times their square and %.2f for the survey of the blocks."),
                      where, WRITTEN(a->speed.p95 * way, 3), WRITTEN(a->energy.p95 * KILO * way * way * blocks, 3),
                      WRITTEN(a->height.p95 * way, 3), survey, model, blocks);
}

void ceduo_page_design(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, control);
    if (r->scene->design.survey < 0 || r->scene->design.blocks < 0)
        return;
    if (wooded)
        say_design(page, report, _("as long as the wood stands as in this option"), wooded);
    say_design(page, report, _("without forest"), &r->bare.arrivals[control]);
}

void ceduo_page_percentiles(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control)
{
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, control);
    ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_CAPTION),
                   _("Percentiles of the rocks that arrive, of so many released (95 % interval):"));
    if (wooded)
        add_run(page, true, wooded);
    add_run(page, false, &r->bare.arrivals[control]);
}
