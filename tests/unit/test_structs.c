/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The library, asked with any struct that its headers allow: each number at, inside or beyond its bounds, not a number, not
 * finite, each word beyond its list. It computes or refuses, and comes to an end. */
#include "expect.h"
#include "full.h"
#include "local.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "ceduo/ceduo.h"
#include "physics/paper_site.h"
#include "scene/schema.h"

#define ASKED   FULL_OR(100000, 20000)
#define SECONDS 20 /* for one question: then it hangs */

static struct paper_site site;
static struct ceduo_stems shoots[2], trees[2];
static double stay[2][2];
static uint64_t state = 1;

static uint64_t draw(uint64_t n)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % n;
}

static double any_number(const struct field *f)
{
    double lo = isfinite(f->lo) ? f->lo : -1e9, hi = isfinite(f->hi) ? f->hi : 1e9;
    const double numbers[] = {lo,     hi,    lo - 1, hi * 2 + 1, (lo + hi) / 2, lo + (hi - lo) * 1e-3, 0, -0., -1, 1,
                              1e-300, 1e300, NAN,    INFINITY,   -INFINITY};
    return numbers[draw(LENGTH(numbers))] * f->scale;
}

static void change_field(const struct field *f, char *item);

/* Changes some member of an item, or of what it holds. */
static void change(const struct object *object, char *item)
{
    change_field(&object->fields[draw(object->n)], item);
}

static void change_field(const struct field *f, char *item)
{
    char *at = item + f->offset, *items;
    size_t n;
    uint64_t count;
    if (f->flags & (FIELD_NOWHERE | FIELD_DRAFT))
        return;
    double number = any_number(f);
    struct ceduo_number spread = {number, draw(2) ? 0 : any_number(f), (enum ceduo_spread_kind)(draw(8) ? draw(2) : 77)};
    int word = f->choices ? (int)draw(f->choices->n + 3) - 2 : 0;
    switch (f->type) {
    case FIELD_NUMBER:
        memcpy(f->flags & FIELD_PLACE ? item + f->beside : at, &number, sizeof number);
        break;
    case FIELD_SPREAD:
        memcpy(at, &spread, sizeof spread);
        break;
    case FIELD_COUNT:
        count = strcmp(f->key, "rocks") == 0 ? draw(50) : draw(2) ? draw(600) : UINT64_MAX;
        memcpy(at, f->size == sizeof(unsigned) ? (void *)&(unsigned){(unsigned)count} : &count, f->size);
        break;
    case FIELD_CHOICE:
        word = draw(8) ? word : 999;
        memcpy(at, &word, sizeof word);
        break;
    case FIELD_GROUP:
        change(f->object, at);
        break;
    case FIELD_NUMBERS:
    case FIELD_LIST:
        memcpy(&items, at, sizeof items);
        memcpy(&n, item + f->beside, sizeof n);
        if (n > 0 && f->type == FIELD_LIST)
            change(f->object, items + draw(n) * f->object->size);
        else if (n > 0)
            memcpy(items + draw(n) * sizeof number, &number, sizeof number);
        break;
    default:
        break;
    }
}

static void open_site(void)
{
    memset(&site, 0, sizeof site);
    paper_site_init(&site);
    for (size_t i = 0; i < 2; i++) {
        shoots[i] = paper_stems(4000, .06, 7);
        trees[i] = paper_stems(100, .2, 14);
        stay[i][0] = stay[i][1] = 60;
        site.belts[i].stand = paper_coppice(&shoots[i], &trees[i], 1, 20, stay[i]);
    }
}

TEST(any_struct_is_refused_or_computed)
{
    uint64_t computed = 0, asked = (uint64_t)ASKED;
    for (uint64_t i = 0; i < asked; i++) {
        struct ceduo_question q;
        struct ceduo_answer a;
        open_site();
        for (uint64_t k = 1 + draw(3); k > 0; k--)
            change(ceduo_schema_scene(), (char *)&site.scene);
        q = ceduo_question_default(&site.scene);
        q.rocks = 1 + draw(10);
        q.run.threads = 1;
        q.years = draw(4) == 0;
        q.year_rocks = 2;
        q.years_most = 5;
        alarm(SECONDS); /* ends the test */
        enum ceduo_status status = ceduo_ask(&q, NULL, &a);
        alarm(0);
        if (status == CEDUO_OK) {
            double share = a.result->bare.arrivals[0].reach_probability;
            assert_true(isnan(share) || (share >= 0 && share <= 1));
            computed++;
        }
        EXPECT(status, !=, CEDUO_NO_MEMORY);
        ceduo_answer_release(&a);
    }
    EXPECT(computed, >, asked / 4); /* and not all is refused */
    EXPECT(computed, <, asked * 9 / 10);
}

/* A list that is said to be there and is not. */
TEST(missing_lists_are_refused)
{
    open_site();
    double volumes[] = {1, 2};
    struct ceduo_block_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    struct ceduo_scene *s = &site.scene;
    s->blocks = &blocks;
    s->blocks_count = 1;
    assert_int_equal(ceduo_scene_check(s, NULL), CEDUO_OK);
    struct ceduo_stand *stand = &site.belts[0].stand;
    void *const pointers[] = {&blocks.volumes,
                              &s->blocks,
                              &s->controls,
                              &s->options,
                              &s->slope.x,
                              &s->slope.z,
                              &s->slope.segments,
                              &s->options[0].belts,
                              &stand->shoots,
                              &stand->trees,
                              &stand->cutting.stay_per_ha};
    for (size_t i = 0; i < LENGTH(pointers); i++) {
        void *was, *none = NULL;
        memcpy(&was, pointers[i], sizeof was);
        memcpy(pointers[i], &none, sizeof none);
        EXPECT(ceduo_scene_check(s, NULL), !=, CEDUO_OK);
        memcpy(pointers[i], &was, sizeof was);
        EXPECT(ceduo_scene_check(s, NULL), ==, CEDUO_OK);
    }
    blocks.volumes = NULL;
    EXPECT(ceduo_scene_check(s, NULL), ==, CEDUO_BAD_ROCK);
}

TEST(as_many_rocks_as_are_asked_for)
{
    open_site();
    struct ceduo_question q = ceduo_question_default(&site.scene);
    struct ceduo_answer a;
    q.rocks = 5000;
    EXPECT(ceduo_ask(&q, NULL, &a), ==, CEDUO_OK);
    EXPECT(ceduo_result_rocks(a.result), ==, 5000);
    ceduo_answer_release(&a);
}
