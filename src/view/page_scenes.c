/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Several scenes as profiles of one slope: the answer for each, the worst first, and for the place below as a whole. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "page_parts.h"
#include "report.h"

#define SCENE_WIDTH 32 /* columns of the scene's name */

/* Answer for an option of a profile; a higher rank is worse. */
struct profile_option {
    const char *name, *answer;
    enum ceduo_judgement judgement;
    int rank;
    double share; /* judged share; NaN: unknown */
};

struct ceduo_profile {
    const char *title, *place;
    double accepted;
    size_t number, n; /* number: order of addition; n: options */
    struct profile_option *options;
};

static int rank_judgement(enum ceduo_judgement judgement)
{
    static const int ranks[] = {
        [CEDUO_JUDGEMENT_UNANSWERED] = 0,  [CEDUO_JUDGEMENT_YES] = 1,     [CEDUO_JUDGEMENT_CANNOT_JUDGE] = 2,
        [CEDUO_JUDGEMENT_NOT_DECIDED] = 3, [CEDUO_JUDGEMENT_DEPENDS] = 4, [CEDUO_JUDGEMENT_NO] = 5};
    return ranks[judgement];
}

static const char *copy_string(struct ceduo_profiles *p, const char *string)
{
    return ceduo_check_memory(ceduo_arena_string(&p->arena, string));
}

void ceduo_profiles_add(struct ceduo_profiles *p, const struct ceduo_report *report, const char *name)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    p->items = ceduo_check_memory(realloc(p->items, (p->count + 1) * sizeof *p->items));
    struct ceduo_profile *to = &p->items[p->count];
    const struct ceduo_control *c = r->scene->controls_count > 0 ? &r->scene->controls[r->last_control] : NULL;
    *to = (struct ceduo_profile){.title = copy_string(p, name ? name : ceduo_in_language(r->scene->title, r->scene->title_it)),
                                 .place = c && c->name ? copy_string(p, c->name) : NULL,
                                 .accepted = c ? c->accepted : NAN,
                                 .number = p->count++,
                                 .n = n,
                                 .options = ceduo_check_memory(ceduo_arena_alloc(&p->arena, (n + 1) * sizeof *to->options))};
    for (size_t i = 0; i < n; i++) {
        struct profile_option *option = &to->options[i];
        LOCAL_TEXT(answer);
        *option = (struct profile_option){copy_string(p, r->scene->options[i].name), "-", CEDUO_JUDGEMENT_UNANSWERED, 0, NAN};
        if (!c)
            continue;
        const struct ceduo_subject subject = ceduo_subject_find(report, i, r->last_control);
        ceduo_words_answer(&answer, &subject, CEDUO_PAGE_WIDTH - SCENE_WIDTH - 1);
        option->answer = copy_string(p, ceduo_text_string(&answer));
        option->judgement = subject.outcome.answer;
        option->rank = rank_judgement(option->judgement);
        option->share = subject.today.value;
    }
}

/* Return the best option, which determines the rank of a profile. */
static const struct profile_option *find_best(const struct ceduo_profile *p)
{
    const struct profile_option *best = p->options;
    for (size_t i = 1; i < p->n; i++) {
        const struct profile_option *o = &p->options[i];
        if (o->rank < best->rank || (o->rank == best->rank && o->share < best->share))
            best = o;
    }
    return best;
}

/* Sort the worst first; equal profiles keep their order. */
static int compare_worst(const void *a, const void *b)
{
    const struct ceduo_profile *p = a, *q = b;
    const struct profile_option *x = find_best(p), *y = find_best(q);
    if (x->rank != y->rank)
        return y->rank - x->rank;
    if (x->share != y->share && !isnan(x->share) && !isnan(y->share))
        return x->share < y->share ? 1 : -1;
    return (p->number > q->number) - (p->number < q->number);
}

size_t ceduo_profiles_sort(struct ceduo_profiles *p, size_t *order)
{
    if (p->count > 1)
        qsort(p->items, p->count, sizeof *p->items, compare_worst);
    for (size_t i = 0; i < p->count; i++)
        order[i] = p->items[i].number;
    return p->count;
}

/* True if all profiles have the same control and the same options. */
static bool has_one_place(const struct ceduo_profiles *p)
{
    const struct ceduo_profile *a = p->items;
    for (size_t i = 0; i < p->count; i++) {
        const struct ceduo_profile *b = &p->items[i];
        if (isnan(b->accepted) || a->accepted != b->accepted || a->n != b->n || !a->place != !b->place ||
            (a->place && strcmp(a->place, b->place) != 0))
            return false;
        for (size_t k = 0; k < a->n; k++)
            if (b->options[k].judgement == CEDUO_JUDGEMENT_UNANSWERED ||
                (a->n > 1 && strcmp(a->options[k].name, b->options[k].name) != 0))
                return false;
    }
    return true;
}

/* Append the worst judgement of an option over all profiles. */
static void add_overall(struct ceduo_page *page, const struct ceduo_profiles *p, size_t option)
{
    enum ceduo_judgement worst = CEDUO_JUDGEMENT_YES;
    size_t n = 0;
    for (size_t i = 0; i < p->count; i++)
        if (p->items[i].options[option].rank > rank_judgement(worst))
            worst = p->items[i].options[option].judgement;
    for (size_t i = 0; i < p->count; i++)
        n += p->items[i].options[option].judgement == worst;
    struct text *text = ceduo_page_text(page);
    ceduo_text_append(text, JUDGEMENT_MARK(worst));
    ceduo_text_append_joined(text, ": ", _("on %zu of %zu profiles"), n, p->count);
}

void ceduo_profiles_page(struct ceduo_page *page, const struct ceduo_profiles *p)
{
    static const struct ceduo_page_column columns[] = {{N_("scene"), SCENE_WIDTH, 0, COL_WRAP},
                                                       {NP_("head", "answer"), 0, 1, 0}};
    bool overall = p->count > 1 && has_one_place(p);
    CEDUO_PAGE_TABLE_OF(page, columns);
    if (overall && p->items->place)
        ceduo_page_cell_format(page, _("%s as a whole"), p->items->place);
    else if (overall)
        ceduo_page_cell_format(page, "%s", _("the place as a whole"));
    for (size_t i = 0; i < p->count + overall; i++) {
        const struct ceduo_profile *one = &p->items[i - (i > 0 && overall)];
        bool all = overall && i == 0;
        if (!all)
            ceduo_page_cell_format(page, "%s", one->title);
        if (one->n > 1)
            ceduo_page_cell_format(page, "%s", "");
        for (size_t k = 0; k < one->n; k++) {
            if (one->n > 1)
                ceduo_page_cell_format(page, "  %s", one->options[k].name);
            if (all)
                add_overall(page, p, k);
            else
                ceduo_page_cell_format(page, "%s", one->options[k].answer);
        }
    }
}

void ceduo_profiles_free(struct ceduo_profiles *p)
{
    ceduo_arena_free(&p->arena);
    free(p->items);
    *p = (struct ceduo_profiles){0};
}
