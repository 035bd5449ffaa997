/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energies to compare with the limit of a control, so that a reader can imagine them. */
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "page_parts.h"

#define CAR_MASS    1500.0 /* kg */
#define CAR_KM_H    50.0
#define CLASS_SHOWN 2 /* classes of fences up to this one are always listed */

/* An energy in the table. */
struct row {
    double kJ;
    struct text name;
    const char *source;
    bool limit;
};

#define ROWS_MAX (5 + CEDUO_FENCE_CLASSES)

struct rows {
    size_t n;
    struct row items[ROWS_MAX];
};

/* Add an energy and return its name for the caller to fill; an unknown one is overwritten by the next. */
static struct text *add_row(struct rows *rows, double kJ, const char *source)
{
    struct row *row = &rows->items[rows->n];
    ceduo_text_cut(&row->name, 0);
    row->kJ = kJ;
    row->source = source;
    rows->n += isnan(kJ) ? 0 : 1;
    return &row->name;
}

static int compare_rows(const void *a, const void *b)
{
    const struct row *p = a, *q = b;
    return (p->kJ > q->kJ) - (p->kJ < q->kJ);
}

static double arrival_kJ(enum ceduo_measure_kind kind, const struct ceduo_arrivals *arrivals)
{
    return ceduo_measure_figure(kind, arrivals).value;
}

void ceduo_page_energies(struct ceduo_page *page, const struct ceduo_report *report, size_t option)
{
    static const struct ceduo_page_column columns[] = {
        {"", 20, 2, COL_GROW}, {N_("energy, kJ"), -10, 2, 0}, {NP_("head", "source"), 20, 2, COL_SHRINK}};
    const struct ceduo_result *r = report->result;
    const struct ceduo_subject s = ceduo_subject_find(report, option, r->last_control);
    double car = 0.5 * CAR_MASS * pow(CAR_KM_H / 3.6, 2) * J_TO_KJ;
    double max_kJ = fmax(arrival_kJ(CEDUO_P95_KJ, s.bare), fmax(car, s.place->accepted * J_TO_KJ));
    struct rows rows = {0};
    if (isnan(s.place->accepted))
        return;
    LOCAL_TEXT(place);
    ceduo_words_place(&place, s.place);
    ceduo_text_format(add_row(&rows, ceduo_words_accepted(s.place), _("scene")), _("limit at %s"), place.bytes);
    rows.items[0].limit = true;
    ceduo_text_append(add_row(&rows, arrival_kJ(CEDUO_MEAN_KJ, s.wooded), _("simulated")),
                      _("rocks that arrive with forest, mean"));
    ceduo_text_append(add_row(&rows, arrival_kJ(CEDUO_P95_KJ, s.wooded), _("simulated")),
                      _("rocks that arrive with forest, 95 % are below"));
    ceduo_text_append(add_row(&rows, arrival_kJ(CEDUO_P95_KJ, s.bare), _("simulated")),
                      _("rocks that arrive without forest, 95 % are below"));
    ceduo_text_format(add_row(&rows, car, _("half the mass times the speed squared")), _("car of %.0f kg at %.0f km/h"),
                      CAR_MASS, CAR_KM_H);
    for (int k = 0; k + 1 < CEDUO_FENCE_CLASSES; k++)
        if (k <= CLASS_SHOWN || ceduo_fence_class_energy[k - 1] * J_TO_KJ < max_kJ)
            ceduo_text_format(
                add_row(&rows, ceduo_fence_class_energy[k] * J_TO_KJ, _("ETAG 027: one impact at its limit (MEL)")),
                _("net fence of class %d"), k);
    qsort(rows.items, rows.n, sizeof rows.items[0], compare_rows);
    ceduo_page_para(page, CEDUO_PAGE_CAPTION, "%s", _("Energies, and fences that withstand them (\xe2\x96\xb8 the limit):"));
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < rows.n; i++) {
        struct row *row = &rows.items[i];
        ceduo_page_cell_role(page, row->limit ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_BLANK, row->name.bytes);
        ceduo_page_cell_format(page, "%s", SIG_TRIMMED(row->kJ, row->limit ? 6 : 3));
        ceduo_page_cell_format(page, "%s", row->source);
    }
    for (size_t i = 0; i < ROWS_MAX; i++)
        ceduo_text_free(&rows.items[i].name);
}
