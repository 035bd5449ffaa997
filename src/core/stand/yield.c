/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>
#include <stdlib.h>

#include "rotation.h"
#include "scene/schema.h"
#include "scene/stand.h"
#include "scene/volume.h"
#include "yield.h"

/* ---- one stand ---- */

double ceduo_stand_volume(const struct ceduo_stand *stand)
{
    double sum = 0;
    enum ceduo_volume_from from;
    for (size_t i = 0; i < stand->shoots_count; i++)
        sum += stand->shoots[i].per_ha * ceduo_stem_volume(stand, &stand->shoots[i], &from);
    for (size_t i = 0; i < stand->trees_count; i++)
        sum += stand->trees[i].per_ha * ceduo_stem_volume(stand, &stand->trees[i], &from);
    return sum;
}

/* Sums of a stand over one rotation from its first cut on, m3/ha. */
struct rotation_sum {
    double felled, died, standing; /* standing: summed over the years */
    double space;                  /* share of growing space that the trees take before a cut */
};

static enum ceduo_status sum_rotation(const struct ceduo_belt *belt, unsigned first, struct rotation_sum *sum)
{
    const struct ceduo_stand *stand = &belt->stand;
    unsigned rotation = stand->cutting.rotation;
    struct ceduo_grown_stand current, next;
    enum ceduo_volume_from from;
    enum ceduo_status status = ceduo_stand_at(stand, belt->cut_year, first, &current);
    if (status != CEDUO_OK)
        return status;
    double after_cut = ceduo_stand_volume(&current.stand);
    for (unsigned t = 1; t <= rotation && status == CEDUO_OK; t++) {
        sum->standing += ceduo_stand_volume(&current.stand);
        status = t < rotation ? ceduo_stand_at(stand, belt->cut_year, first + t, &next)
                              : ceduo_stand_before_cut(stand, belt->cut_year, first + t, &next);
        if (status == CEDUO_OK) {
            size_t n = current.stand.shoots_count, m = next.stand.shoots_count;
            /* only shoots: trees do not die */
            double died = 0;
            for (size_t i = 1; i <= n && i <= m; i++) { /* aligned at the oldest cohort: a younger cohort may have been added */
                const struct ceduo_stems *before = &current.stand.shoots[n - i], *after = &next.stand.shoots[m - i];
                died += fmax(0, before->per_ha - after->per_ha) * ceduo_stem_volume(&current.stand, before, &from);
            }
            sum->died += died;
            ceduo_grown_stand_release(&current);
            current = next;
        }
    }
    sum->felled = ceduo_stand_volume(&current.stand) - after_cut;
    sum->space = ceduo_growing_space_used(&stand->growth, &current.stand);
    ceduo_grown_stand_release(&current);
    return status;
}

/* ---- fellings ---- */

static int by_year(const void *a, const void *b)
{
    const struct ceduo_felling *f = a, *g = b;
    if (f->year != g->year)
        return f->year < g->year ? -1 : 1;
    return (f->belt > g->belt) - (f->belt < g->belt);
}

static size_t count_fellings(const struct ceduo_belt *belt, unsigned last)
{
    unsigned first = ceduo_first_cut(&belt->stand, belt->cut_year);
    return first > last ? 0 : (last - first) / belt->stand.cutting.rotation + 1;
}

static enum ceduo_status list_fellings(const struct ceduo_option *option, unsigned last, struct ceduo_yield *yield)
{
    size_t n = 0;
    for (size_t i = 0; i < option->belts_count; i++)
        n += count_fellings(&option->belts[i], last);
    yield->fellings = calloc(n + 1, sizeof *yield->fellings);
    enum ceduo_status status = yield->fellings ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < option->belts_count && status == CEDUO_OK; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        unsigned year = ceduo_first_cut(&belt->stand, belt->cut_year);
        for (size_t k = count_fellings(belt, last); k-- > 0 && status == CEDUO_OK; year += belt->stand.cutting.rotation) {
            struct ceduo_felling *f = &yield->fellings[yield->fellings_count++];
            struct ceduo_grown_stand before = {0}, after = {0};
            *f = (struct ceduo_felling){.year = year, .belt = i};
            status = ceduo_stand_before_cut(&belt->stand, belt->cut_year, year, &before);
            if (status == CEDUO_OK)
                status = ceduo_stand_at(&belt->stand, belt->cut_year, year, &after);
            if (status == CEDUO_OK) { /* an inventory may have less than its cuts leave */
                f->volume = fmax(0, ceduo_stand_volume(&before.stand) - ceduo_stand_volume(&after.stand));
                f->stems_per_ha = fmax(0, ceduo_stand_shoots(&before.stand) + ceduo_stand_trees(&before.stand) -
                                              ceduo_stand_shoots(&after.stand) - ceduo_stand_trees(&after.stand));
            }
            ceduo_grown_stand_release(&after);
            ceduo_grown_stand_release(&before);
        }
    }
    if (status == CEDUO_OK)
        qsort(yield->fellings, yield->fellings_count, sizeof *yield->fellings, by_year);
    return status;
}

enum ceduo_status ceduo_yield_compute(const struct ceduo_option *option, unsigned last, struct ceduo_yield *yield)
{
    double length = 0, felled = 0, died = 0, standing = 0, today = 0;
    enum ceduo_status status = last <= CEDUO_YEAR_MAX ? ceduo_check_stands(option) : CEDUO_BAD_ARGUMENT;
    *yield = (struct ceduo_yield){0};
    if (status != CEDUO_OK)
        return status;
    for (size_t i = 0; i < option->belts_count && status == CEDUO_OK; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        double metres = belt->to - belt->from, rotation = belt->stand.cutting.rotation;
        unsigned first = ceduo_first_cut(&belt->stand, belt->cut_year);
        struct rotation_sum sum = {0};
        if (ceduo_stand_is_bare(&belt->stand) && !ceduo_stand_sprouts(&belt->stand))
            continue;
        status = first == CEDUO_NEVER ? CEDUO_OK : sum_rotation(belt, first, &sum);
        double weight = first == CEDUO_NEVER || sum.space > 1 ? NAN : metres / rotation;
        yield->space = fmax(yield->space, sum.space);
        length += metres;
        felled += weight * sum.felled;
        died += weight * sum.died;
        standing += weight * sum.standing;
        today += metres * ceduo_stand_volume(&belt->stand);
    }
    yield->cut_per_year = felled / length; /* NaN without a forest */
    yield->died_per_year = died / length;
    yield->standing = standing / length;
    yield->volume_today = today / length;
    if (status == CEDUO_OK)
        status = list_fellings(option, last, yield);
    if (status != CEDUO_OK)
        ceduo_yield_release(yield);
    return status;
}

void ceduo_yield_release(struct ceduo_yield *yield)
{
    free(yield->fellings);
    *yield = (struct ceduo_yield){0};
}
