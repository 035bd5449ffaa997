/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a run as bytes, and back. One function packs each thing in both directions. A part is read twice: first all of
 * it is checked, then its blocks are merged into the run. */
#include "run_pack.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

/* What numbers added to 0 one after the other give: finite, and never -0, of which the sign would get lost in the next sum. */
static void pack_added(struct bytes *b, double *sum)
{
    ceduo_bytes_number(b, sum);
    b->bad |= b->reads && (!isfinite(*sum) || (*sum == 0 && signbit(*sum)));
}

static void pack_moments(struct bytes *b, struct ceduo_moments *m)
{
    ceduo_bytes_count(b, &m->n);
    ceduo_bytes_number(b, &m->mean);
    ceduo_bytes_number(b, &m->m2);
    ceduo_bytes_number(b, &m->max);
}

static void pack_weights(struct bytes *b, double weights[CEDUO_ENDS])
{
    for (int e = 0; e < CEDUO_ENDS; e++)
        pack_added(b, &weights[e]);
}

static void pack_sum(struct bytes *b, struct weighted_sum *s)
{
    pack_added(b, &s->t);
    pack_added(b, &s->tt);
    pack_added(b, &s->tw);
}

static void pack_block(const struct ceduo_run *run, struct bytes *b, struct block *block)
{
    ceduo_bytes_count(b, &block->contacts);
    for (int e = 0; e < CEDUO_ENDS; e++)
        ceduo_bytes_count(b, &block->ends[e]);
    ceduo_bytes_count(b, &block->uphill);
    ceduo_bytes_count(b, &block->early);
    ceduo_bytes_count(b, &block->stems.drawn);
    ceduo_bytes_count(b, &block->stems.hit);
    ceduo_bytes_count(b, &block->stems.met);
    pack_moments(b, &block->stop_x);
    if (run->sized)
        pack_weights(b, block->ended);
    for (size_t c = 0; c < run->controls; c++) {
        struct sums *s = &block->controls[c];
        for (int q = 0; q < QUANTITIES; q++)
            pack_moments(b, &s->of[q]);
        pack_moments(b, &s->contacts);
        ceduo_bytes_count(b, &s->exceeded);
        for (int e = 0; e < CEDUO_ENDS; e++)
            ceduo_bytes_count(b, &s->ended[e]);
        if (!run->sized)
            continue;
        pack_weights(b, s->missed);
        pack_sum(b, &s->hits);
    }
}

static bool is_plain_zero(double value)
{
    return value == 0 && !signbit(value);
}

/* Of nothing they are 0: anything else would get lost where they are merged. */
static bool good_moments(const struct ceduo_moments *m, uint64_t n)
{
    if (m->n == 0 && !(is_plain_zero(m->mean) && is_plain_zero(m->m2) && is_plain_zero(m->max)))
        return false;
    return m->n == n && isfinite(m->mean) && isfinite(m->m2) && isfinite(m->max) && m->m2 >= 0;
}

/* Whether so many rocks ended in one of these ways each. */
static bool good_ends(const uint64_t ends[CEDUO_ENDS], uint64_t rocks)
{
    uint64_t sum = 0;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        if (ends[e] > rocks)
            return false;
        sum += ends[e];
    }
    return sum == rocks;
}

static bool good_weights(const double weights[CEDUO_ENDS])
{
    for (int e = 0; e < CEDUO_ENDS; e++)
        if (!(weights[e] >= 0))
            return false;
    return true;
}

static bool good_sum(const struct weighted_sum *s)
{
    return s->t >= 0 && s->tt >= 0 && s->tw >= 0;
}

/* Whether the counts of a block agree with each other: of so many rocks, and so many that hit stems where there are. */
static bool good_block(const struct ceduo_run *run, const struct block *block, uint64_t rocks)
{
    uint64_t stops = block->ends[CEDUO_AT_REST] + block->ends[CEDUO_STOPPED_BY_STEMS];
    if (block->uphill > block->ends[CEDUO_LEFT_SLOPE] || block->early > block->ends[CEDUO_STOPPED_BY_STEMS] ||
        !good_ends(block->ends, rocks) || !good_moments(&block->stop_x, stops) || !good_weights(block->ended))
        return false;
    for (size_t c = 0; c < run->controls; c++) {
        const struct sums *s = &block->controls[c];
        uint64_t reached = s->of[SPEED].n;
        if (reached > rocks || !good_ends(s->ended, rocks - reached) || s->exceeded > reached ||
            !good_moments(&s->contacts, run->ready.wood.bare ? 0 : reached) || !good_weights(s->missed) || !good_sum(&s->hits))
            return false;
        for (int q = 0; q < QUANTITIES; q++)
            if (!good_moments(&s->of[q], reached))
                return false;
    }
    return true;
}

/* What a part begins with: its rocks, and what decides the shape of the rest. */
struct part_head {
    uint64_t first, end, rocks, controls, kept, bare, exact, pairs;
};

static void pack_head(struct bytes *b, struct part_head *h)
{
    uint64_t *const counts[] = {&h->first, &h->end, &h->rocks, &h->controls, &h->kept, &h->bare, &h->exact, &h->pairs};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        ceduo_bytes_count(b, counts[i]);
}

static struct part_head head_of(const struct ceduo_run *run, uint64_t first, uint64_t end)
{
    return (struct part_head){
        first, end, run->def.rocks_most, run->controls, (uint64_t)run->kept, run->ready.wood.bare, run->exact, run->pairs_room};
}

/* The first rocks' energies that lie in a part. */
static uint64_t pairs_of(const struct ceduo_run *run, uint64_t first, uint64_t end)
{
    uint64_t to = end < run->pairs_room ? end : run->pairs_room;
    return to > first ? to - first : 0;
}

/* The samples of rocks first…end - 1, or the histograms, in `bins`. `reached[control]`, then the stops: how many there
 * are; where they are read, how many there must be. False: not those, or no memory. */
static bool pack_samples(struct ceduo_run *run, struct bytes *b, uint64_t first, uint64_t end, struct histogram *bins,
                         uint64_t *reached)
{
    size_t n = (size_t)(end - first), from = (size_t)(first - run->first);
    uint64_t there;
    for (size_t c = 0; c <= run->controls; c++) {
        int kept = c < run->controls ? run->kept : 1;
        double *column = run->exact ? samples_of(run, c, SPEED) + from : NULL;
        if (run->exact && (!ceduo_bytes_column(b, column, n, &there) || (b->reads && there != reached[c])))
            return false;
        for (int q = 0; q < kept; q++) {
            if (run->exact && q > 0 && !ceduo_bytes_column_as(b, column, samples_of(run, c, q) + from, n))
                return false;
            struct histogram *h = run->exact ? NULL : bins_of(bins, run, c, q);
            if (h && (!ceduo_histogram_pack(h, b, n) || (b->reads && h->n != reached[c])))
                return false;
        }
    }
    n = (size_t)pairs_of(run, first, end);
    for (size_t c = 0; n > 0 && c < run->controls; c++)
        if (!ceduo_bytes_column(b, &run->pairs[c * run->pairs_room + first], n, &there) || (b->reads && there > reached[c]))
            return false;
    return true;
}

/* The blocks of a part: those that are kept, and the one that is not full. */
static void save_blocks(const struct ceduo_run *run, struct bytes *b)
{
    for (size_t i = 0; i < run->kept_count; i++)
        pack_block(run, b, &run->kept_blocks[i]);
    struct block tail = run->tail;
    if (run->rocks % CEDUO_BLOCK_ROCKS != 0)
        pack_block(run, b, &tail);
}

enum ceduo_status ceduo_run_pack(const struct ceduo_run *run, struct bytes *b)
{
    struct ceduo_run from = *run; /* it is only read */
    struct part_head head = head_of(run, run->first, run->rocks);
    uint64_t *reached = calloc(run->controls + 1, sizeof *reached);
    pack_head(b, &head);
    save_blocks(run, b);
    bool good = reached && (run->rocks == run->first || pack_samples(&from, b, run->first, run->rocks, from.bins, reached));
    free(reached);
    return good && !b->no_memory ? CEDUO_OK : CEDUO_NO_MEMORY;
}

/* Reads the blocks of a part into `block`, one after the other. Merges them where `merges`; otherwise checks them and
 * adds up what reached each control, and the stops. */
static bool read_blocks(struct ceduo_run *run, struct bytes *b, const struct part_head *head, struct block *block,
                        uint64_t *reached, bool merges)
{
    for (uint64_t at = head->first; at < head->end; at += CEDUO_BLOCK_ROCKS) {
        uint64_t rocks = head->end - at < CEDUO_BLOCK_ROCKS ? head->end - at : CEDUO_BLOCK_ROCKS;
        ceduo_run_block_clear(block, run->controls);
        pack_block(run, b, block);
        if (merges) {
            ceduo_run_block_merge(rocks == CEDUO_BLOCK_ROCKS ? &run->whole : &run->tail, block, run->controls);
            continue;
        }
        if (b->bad || !good_block(run, block, rocks))
            return false;
        for (size_t c = 0; c < run->controls; c++)
            reached[c] += block->controls[c].of[SPEED].n;
        reached[run->controls] += block->stop_x.n;
    }
    return true;
}

static bool good_head(const struct ceduo_run *run, const struct part_head *h)
{
    struct part_head own = head_of(run, run->rocks, h->end);
    bool whole_blocks = h->first % CEDUO_BLOCK_ROCKS == 0 && (h->end % CEDUO_BLOCK_ROCKS == 0 || h->end == h->rocks);
    return memcmp(h, &own, sizeof own) == 0 && whole_blocks && h->end >= h->first && h->end <= h->rocks;
}

/* Everything is read and checked before the run is changed; samples behind its last rock are nobody's yet. */
static enum ceduo_status adopt(struct ceduo_run *run, struct bytes *b, struct block *block, struct histogram *bins,
                               uint64_t *reached)
{
    struct part_head head;
    pack_head(b, &head);
    if (b->bad || !good_head(run, &head))
        return CEDUO_BAD_PART;
    struct bytes blocks = *b;
    bool good = read_blocks(run, b, &head, block, reached, false) &&
                (head.end == head.first || pack_samples(run, b, head.first, head.end, bins, reached));
    if (b->no_memory)
        return CEDUO_NO_MEMORY;
    if (!good || ceduo_bytes_left(b) > 0)
        return CEDUO_BAD_PART;
    if (!run->exact && !ceduo_histograms_reserve(run->bins, bins, run->columns))
        return CEDUO_NO_MEMORY;
    if (!run->exact)
        ceduo_histograms_merge(run->bins, bins, run->columns);
    read_blocks(run, &blocks, &head, block, reached, true);
    run->rocks = head.end;
    return CEDUO_OK;
}

enum ceduo_status ceduo_run_adopt(struct ceduo_run *run, const unsigned char *bytes, size_t n)
{
    if (run->def.part || run->def.cells > 0)
        return CEDUO_BAD_PART;
    if (!ceduo_run_samples_prepare(run, run->def.rocks_most))
        return CEDUO_NO_MEMORY;
    struct bytes b = {.reads = true, .from = bytes, .length = n};
    struct block block;
    struct histogram *bins = calloc(run->columns, sizeof *bins);
    uint64_t *reached = calloc(run->controls + 1, sizeof *reached);
    bool ready = ceduo_run_block_init(&block, run->controls) && bins && reached;
    enum ceduo_status status = ready ? adopt(run, &b, &block, bins, reached) : CEDUO_NO_MEMORY;
    ceduo_histograms_free(bins, run->columns);
    free(reached);
    free(block.controls);
    return status;
}
