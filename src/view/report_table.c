/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>

#include "base/intl.h"
#include "scene/words.h"
#include "report.h"

#define KILO 1e-3
#define WIDTH 80

struct page {
    struct text *text;
    const struct ceduo_report *report;
    bool plain; /* ASCII alone */
    size_t width; /* columns */
};

/* ---- small parts ---- */

static void put_number(struct page *p, double value, int digits)
{
    ceduo_words_number(p->text, value, digits);
}

/* One character: its bytes, and the columns that it takes; in a locale that does not know it one. */
static size_t step(const char *at, size_t *columns)
{
    wchar_t wide;
    mbstate_t state = {0};
    size_t n = mbrtowc(&wide, at, MB_CUR_MAX, &state);
    int width = n > 0 && n <= MB_CUR_MAX ? wcwidth(wide) : 1;
    for (n = 1; ((unsigned char)at[n] & 0xc0) == 0x80;)
        n++;
    *columns = width < 0 ? 1 : (size_t)width;
    return n;
}

static size_t columns_of(const char *string)
{
    size_t columns = 0, one;
    for (; *string; columns += one)
        string += step(string, &one);
    return columns;
}

/* A string padded to so many columns; cut with … where it is longer. Negative: aligned to the right. */
static void put_padded(struct page *p, const char *string, int width)
{
    struct text safe = {0};
    ceduo_text_safe(&safe, string);
    const char *bytes = safe.bytes ? safe.bytes : "";
    size_t want = (size_t)(width < 0 ? -width : width), have = columns_of(bytes), columns = 0, n = 0, one;
    for (size_t i = have; width < 0 && i < want; i++)
        ceduo_text_char(p->text, ' ');
    if (have <= want) {
        ceduo_text_put(p->text, bytes);
    } else {
        for (size_t next; (next = step(bytes + n, &one), columns + one < want); n += next)
            columns += one;
        ceduo_text_add(p->text, bytes, n);
        ceduo_text_put(p->text, p->plain ? "~" : "\xe2\x80\xa6");
        have = columns + 1;
    }
    for (; width > 0 && have < want; have++)
        ceduo_text_char(p->text, ' ');
    ceduo_text_free(&safe);
}

/* As short as can be: 3e26, 7e-3; where that has no more room either, what is small as 0.00. */
static void put_shortest(struct text *cell, double value, size_t room)
{
    char power[16];
    snprintf(power, sizeof power, "%.0e", value);
    ceduo_text_free(cell);
    ceduo_text_format(cell, "%.*se%ld", (int)strcspn(power, "e"), power, strtol(strchr(power, 'e') + 1, NULL, 10));
    if (fabs(value) < 1 && columns_of(cell->bytes ? cell->bytes : "") > room) {
        ceduo_text_free(cell);
        ceduo_text_format(cell, "%.*f", (int)room - (value < 0 ? 3 : 2), value);
    }
}

/* A number in a column, a blank before it; in thousands or millions (134e3) where it has no room, or with fewer digits. */
static void put_cell(struct page *p, double value, int digits, int width)
{
    struct text cell = {0};
    ceduo_words_number(&cell, value, digits);
    for (int e = 3; e <= 9 && fabs(value) >= 1e3 && columns_of(cell.bytes ? cell.bytes : "") >= (size_t)width; e += 3) {
        ceduo_text_free(&cell);
        ceduo_text_format(&cell, "%.0fe%d", value / pow(10, e), e);
    }
    while (digits > 1 && columns_of(cell.bytes ? cell.bytes : "") >= (size_t)width) {
        ceduo_text_free(&cell);
        ceduo_words_number(&cell, value, --digits);
    }
    if (isfinite(value) && columns_of(cell.bytes ? cell.bytes : "") >= (size_t)width)
        put_shortest(&cell, value, (size_t)width - 1);
    put_padded(p, cell.bytes ? cell.bytes : "", -width);
    ceduo_text_free(&cell);
}

static const char *plus_minus(const struct page *p)
{
    return p->plain ? "+-" : "\xc2\xb1";
}

static const char *dash(const struct page *p)
{
    return p->plain ? "-" : "\xe2\x80\x93";
}

static size_t new_line(struct page *p, size_t indent)
{
    ceduo_text_char(p->text, '\n');
    for (size_t i = 0; i < indent; i++)
        ceduo_text_char(p->text, ' ');
    return indent;
}

/* A paragraph, wrapped, its lines after the first indented by `indent`. A word that is longer than a line is broken. */
static void put_wrapped(struct page *p, const char *first, size_t indent, const char *sentence)
{
    struct text safe = {0};
    ceduo_text_safe(&safe, sentence);
    ceduo_text_put(p->text, first);
    size_t column = columns_of(first), one;
    bool start = true;
    for (const char *at = safe.bytes ? safe.bytes : ""; *at; at += strspn(at, " ")) {
        const char *end = at + strcspn(at, " ");
        size_t width = 0;
        for (const char *c = at; c < end; width += one)
            c += step(c, &one);
        if (!start && column + 1 + width > p->width) {
            column = new_line(p, indent);
        } else if (!start) {
            ceduo_text_char(p->text, ' ');
            column++;
        }
        for (size_t n; at < end; at += n, column += one) {
            n = step(at, &one);
            if (column + one > p->width && column > indent)
                column = new_line(p, indent);
            ceduo_text_add(p->text, at, n);
        }
        start = false;
    }
    ceduo_text_char(p->text, '\n');
    ceduo_text_free(&safe);
}

/* "991 (984–995)": of 1000 rocks, with the 95 % interval. */
static void put_of_1000(struct page *p, struct text *text, double probability, double lo, double hi)
{
    ceduo_text_format(text, "%.0f (%.0f%s%.0f)", probability * 1000, floor(lo * 1000), dash(p), ceil(hi * 1000));
}

/* ---- head ---- */

static const char *assumed_mark(const struct page *p, const char *path)
{
    return ceduo_scene_assumes(p->report->file, path) ? "*" : "";
}

static void put_rock(struct page *p)
{
    const struct ceduo_result *r = p->report->result;
    ceduo_text_format(p->text, _("Rock     %s, "), ceduo_words_shape(r->scene->rock.shape));
    put_number(p, r->rock.mass, 4);
    ceduo_text_put(p->text, _(" kg, mean diameter "));
    put_number(p, r->rock.mean_diameter, 3);
    ceduo_text_format(p->text, " m%s%s\n", ceduo_rock_varies(&r->scene->rock) ? _(" (means of its spread)") : "",
                      assumed_mark(p, "rock"));
}

static void put_slope(struct page *p)
{
    const struct ceduo_scene *s = p->report->result->scene;
    const struct ceduo_slope *slope = &s->slope;
    double low = 0, high = 0;
    for (size_t i = 0; i < slope->vertices; i++) {
        low = fmin(low, slope->z[i]);
        high = fmax(high, slope->z[i]);
    }
    struct text line = {0};
    ceduo_words_number(&line, slope->x[slope->vertices - 1], 4);
    ceduo_text_put(&line, _(" m long, "));
    ceduo_words_number(&line, high - low, 4);
    ceduo_text_format(&line, ngettext(" m high, %zu segment; law %s, facets %s%s", " m high, %zu segments; law %s, facets %s%s",
                                      slope->vertices - 1),
                      slope->vertices - 1, ceduo_words_law(s->simulation.law), ceduo_facets_words.names[slope->facets], assumed_mark(p, "slope"));
    put_wrapped(p, _("Slope    "), 9, line.bytes ? line.bytes : "");
    ceduo_text_free(&line);
}

static void put_head(struct page *p)
{
    const struct ceduo_result *r = p->report->result;
    put_wrapped(p, "", 0, r->scene->title);
    put_rock(p);
    put_slope(p);
    ceduo_text_format(p->text, _("Rocks    %llu, seed %llu\n"), (unsigned long long)ceduo_result_rocks(r),
                      (unsigned long long)r->scene->simulation.seed);
}

/* ---- arrivals ---- */

static void put_place(struct page *p, const struct ceduo_control *c, size_t i)
{
    char room[CEDUO_NUMBER_ROOM];
    struct text place = {0};
    ceduo_text_format(&place, _("At %s m"), ceduo_number_shortest(c->x_given, room));
    if (c->name)
        ceduo_text_format(&place, ", %s", c->name);
    struct text where = {0};
    ceduo_text_format(&where, "controls[%zu].accepted_kJ", i);
    if (!isnan(c->accepted))
        ceduo_text_format(&place, _(", bears %s kJ%s"), ceduo_number_shortest(ceduo_words_accepted(c), room),
                          where.bytes && ceduo_scene_assumes_value(p->report->file, where.bytes) ? "*" : "");
    put_wrapped(p, "  ", 4, place.bytes ? place.bytes : "");
    ceduo_text_free(&where);
    ceduo_text_free(&place);
}

#define MEAN_WIDTH 12 /* columns, one of them blank */

/* A mean and its error, with as many digits as have room; (2.0±0.3)e6 where no other way has. */
static void put_mean(const struct page *p, struct text *text, const struct ceduo_arrivals *a)
{
    double mean = a->energy.mean * KILO, half = ceduo_half_width(a->energy.se, a->reached) * KILO;
    for (int digits = 4; digits > 0 && a->reached > 0; digits--) {
        ceduo_text_free(text);
        ceduo_words_number(text, mean, digits);
        if (digits == 4 || isnan(half)) {
            ceduo_text_format(text, " %s", plus_minus(p));
            ceduo_words_number(text, half, 2);
        } else {
            /* the error up to whole units of the mean's last place */
            const char *point = strchr(text->bytes ? text->bytes : "", '.');
            int places = point ? (int)strlen(point + 1) : 0;
            double unit = pow(10, -places);
            if (strchr(text->bytes ? text->bytes : "", 'e'))
                break;
            ceduo_text_format(text, "%s%.*f", plus_minus(p), places, ceil(half / unit) * unit);
        }
        if (columns_of(text->bytes ? text->bytes : "") < MEAN_WIDTH)
            return;
    }
    int e = mean > 0 ? (int)floor(log10(mean)) : 0;
    for (int places = 1; places >= 0 && a->reached > 0; places--) {
        double unit = pow(10, e - places);
        ceduo_text_free(text);
        if (isnan(half)) /* of one rock */
            ceduo_text_format(text, "%.*fe%d %s-", places, mean / pow(10, e), e, plus_minus(p));
        else
            ceduo_text_format(text, "(%.*f%s%.*f)e%d", places, mean / pow(10, e), plus_minus(p), places,
                              ceil(half / unit) * pow(10, -places), e);
        if (columns_of(text->bytes ? text->bytes : "") < MEAN_WIDTH)
            return;
    }
}

/* The two runs side by side, in columns where there is room. */
static void put_arrivals_row(struct page *p, const char *name, const struct ceduo_arrivals *a)
{
    struct text reach = {0}, exceed = {0}, mean = {0};
    put_of_1000(p, &reach, a->reach_probability, a->reach_lo, a->reach_hi);
    if (!isnan(a->exceed_probability))
        put_of_1000(p, &exceed, a->exceed_probability, a->exceed_lo, a->exceed_hi);
    else
        ceduo_text_put(&exceed, "-");
    put_mean(p, &mean, a);
    ceduo_text_put(p->text, "    ");
    put_padded(p, name, 16);
    put_padded(p, reach.bytes ? reach.bytes : "", -16);
    put_padded(p, exceed.bytes ? exceed.bytes : "", -16);
    put_padded(p, mean.bytes ? mean.bytes : "-", -MEAN_WIDTH);
    put_cell(p, a->energy.p95 * KILO, 3, 6);
    put_cell(p, a->speed.mean, 3, 5);
    put_cell(p, a->height.p95, 2, 5);
    ceduo_text_char(p->text, '\n');
    ceduo_text_free(&reach);
    ceduo_text_free(&exceed);
    ceduo_text_free(&mean);
}

/* The head of a column of shares: what is too much at a place, or where that is not said, `otherwise`. */
static void put_limit(struct page *p, const struct ceduo_control *c, const char *otherwise, int width)
{
    char room[CEDUO_NUMBER_ROOM];
    struct text limit = {0};
    if (isnan(c->accepted))
        ceduo_text_put(&limit, otherwise);
    else
        ceduo_text_format(&limit, "> %s kJ", ceduo_number_shortest(ceduo_words_accepted(c), room));
    if (columns_of(limit.bytes ? limit.bytes : "") >= (size_t)width) {
        double size = fabs(c->accepted);
        ceduo_text_free(&limit);
        ceduo_text_format(&limit, size < 1e6 ? "> %.3g kJ" : "> %.3g MJ", c->accepted * (size < 1e6 ? KILO : 1e-6));
    }
    put_padded(p, limit.bytes ? limit.bytes : "", -width);
    ceduo_text_free(&limit);
}

static void put_arrivals_head(struct page *p, const struct ceduo_control *c)
{
    ceduo_text_put(p->text, "    ");
    put_padded(p, _("of 1000"), 16);
    put_padded(p, _("arrive"), -16);
    put_limit(p, c, "", 16);
    put_padded(p, _("mean kJ"), -12);
    put_padded(p, _("95 %"), -6);
    put_padded(p, _("m/s"), -5);
    put_padded(p, _("m up"), -5);
    ceduo_text_char(p->text, '\n');
}

/* The same in sentences. */
static void put_arrivals_sentences(struct page *p, const char *name, const struct ceduo_arrivals *a)
{
    struct text line = {0};
    ceduo_text_format(&line, "%s: ", name);
    put_of_1000(p, &line, a->reach_probability, a->reach_lo, a->reach_hi);
    ceduo_text_put(&line, _(" of 1000 arrive"));
    if (!isnan(a->exceed_probability)) {
        ceduo_text_put(&line, ", ");
        put_of_1000(p, &line, a->exceed_probability, a->exceed_lo, a->exceed_hi);
        ceduo_text_put(&line, _(" with more than it bears"));
    }
    if (a->reached > 0) {
        ceduo_text_put(&line, _("; mean "));
        ceduo_words_number(&line, a->energy.mean * KILO, 4);
        ceduo_text_format(&line, " %s ", plus_minus(p));
        ceduo_words_number(&line, ceduo_half_width(a->energy.se, a->reached) * KILO, 2);
        ceduo_text_put(&line, _(" kJ, 95 % below "));
        ceduo_words_number(&line, a->energy.p95 * KILO, 3);
    }
    ceduo_text_char(&line, '.');
    put_wrapped(p, "    ", 6, line.bytes ? line.bytes : "");
    ceduo_text_free(&line);
}

/* What became of the rocks on their way through the wood. */
static void put_fates(struct page *p, const struct ceduo_flown *f, const struct ceduo_arrivals *a)
{
    const struct ceduo_ends *e = &f->ends;
    double n = (double)f->rocks;
    struct text line = {0};
    ceduo_text_format(&line, _("Of 1000, %.0f are stopped by stems, %.0f come to rest, %.0f leave the slope"),
                      (double)e->count[CEDUO_STOPPED_BY_STEMS] / n * 1000,
                      (double)e->count[CEDUO_AT_REST] / n * 1000, (double)e->count[CEDUO_LEFT_SLOPE] / n * 1000);
    if (e->count[CEDUO_UNFINISHED] > 0)
        ceduo_text_format(&line, _("; %llu of %llu never come to an end"),
                          (unsigned long long)e->count[CEDUO_UNFINISHED], (unsigned long long)f->rocks);
    if (a->reached > 0)
        ceduo_text_format(&line, _("; one that arrives here has hit %.3g stems"), a->contacts);
    ceduo_text_char(&line, '.');
    put_wrapped(p, "    ", 6, line.bytes ? line.bytes : "");
    ceduo_text_free(&line);
}

static void put_arrivals(struct page *p, size_t option, size_t control)
{
    const struct ceduo_result *r = p->report->result;
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control], *wooded = ceduo_result_wooded(r, option, control);
    if (p->width >= WIDTH) {
        put_arrivals_head(p, &r->scene->controls[control]);
        if (wooded)
            put_arrivals_row(p, _("through the wood"), wooded);
        put_arrivals_row(p, _("without forest"), bare);
    } else {
        if (wooded)
            put_arrivals_sentences(p, _("Through the wood"), wooded);
        put_arrivals_sentences(p, _("Without forest"), bare);
    }
    if (wooded)
        put_fates(p, &r->options[option].wooded, wooded);
    if (bare->reached == 0 && bare->unfinished == 0)
        ceduo_text_format(p->text, _("    Without forest no rock arrives (of 1000, below %.1f with 95 %%).\n"),
                          bare->reach_hi * 1000);
    else if (wooded && wooded->reached == 0 && wooded->unfinished == 0)
        ceduo_text_format(p->text, _("    Through the wood no rock arrives (of 1000, below %.1f with 95 %%).\n"),
                          wooded->reach_hi * 1000);
}

/* ---- forest ---- */

static void put_belt(struct page *p, const struct ceduo_belt *b, const struct ceduo_stand_result *s)
{
    char from[CEDUO_NUMBER_ROOM], to[CEDUO_NUMBER_ROOM];
    struct text range = {0}, name = {0}, share = {0};
    ceduo_text_format(&range, "%s%s%s", ceduo_number_shortest(b->from_given, from), dash(p),
                      ceduo_number_shortest(b->to_given, to));
    ceduo_text_format(&name, "%s%s", b->name, b->assumed ? "*" : "");
    ceduo_text_put(p->text, "    ");
    ceduo_text_put(p->text, range.bytes ? range.bytes : "");
    size_t columns = columns_of(range.bytes ? range.bytes : "");
    if (columns > 9) { /* survey coordinates: a line of their own */
        ceduo_text_put(p->text, "\n    ");
        columns = 0;
    }
    for (size_t i = columns; i < 9; i++)
        ceduo_text_char(p->text, ' ');
    ceduo_text_char(p->text, ' ');
    put_padded(p, name.bytes ? name.bytes : "", 27);
    put_cell(p, s->adc_m, 3, 7);
    ceduo_text_format(p->text, " %-6s", s->passes_threshold ? _("yes") : _("NO"));
    ceduo_text_format(&share, "%.1f %%", s->free_run_probability * 100);
    put_padded(p, share.bytes ? share.bytes : "", -9);
    put_cell(p, s->dissipated * KILO, 3, 7);
    put_cell(p, s->dissipated / s->length * 100 * KILO, 3, 9);
    ceduo_text_char(p->text, '\n');
    ceduo_text_free(&range);
    ceduo_text_free(&name);
    ceduo_text_free(&share);
}

/* The rule that was applied in all belts, or a word that says that it differs. */
static const char *rule_of(const struct ceduo_option *o, const struct ceduo_option_result *found)
{
    const char *rule = NULL;
    for (size_t i = 0; i < o->belts_count; i++) {
        if (found->stands[i].bare)
            continue;
        const char *here = ceduo_words_rule(found->stands[i].rule);
        if (rule && strcmp(rule, here) != 0)
            return _("each belt's own rule");
        rule = here;
    }
    return rule ? rule : _("no rule");
}

static void put_other_forms(struct page *p, const struct ceduo_option *o, const struct ceduo_option_result *found)
{
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_stand_result *s = &found->stands[i];
        if (s->bare)
            continue;
        struct text line = {0};
        const enum ceduo_rule rules[] = {CEDUO_GSTEIGER_STOOLS, CEDUO_GSTEIGER_STEMS, CEDUO_INTERCEPTION, CEDUO_CROFTON};
        ceduo_text_format(&line, _("%s by %s; other forms:"), o->belts[i].name, ceduo_words_rule(s->rule));
        for (size_t k = 0, n = 0; k < 4; k++) {
            if (rules[k] == s->rule)
                continue;
            ceduo_text_format(&line, "%s %s ", n++ ? "," : "", ceduo_words_rule(rules[k]));
            ceduo_words_number(&line, ceduo_adc_value(&s->adc, rules[k]), 3);
            ceduo_text_put(&line, " m");
        }
        put_wrapped(p, "      ", 8, line.bytes ? line.bytes : "");
        ceduo_text_free(&line);
    }
}

static void put_lights(struct page *p, size_t option, size_t control)
{
    void (*const lights[])(struct text *, const struct ceduo_result *, size_t, size_t) = {
        ceduo_words_contact, ceduo_words_free_run, ceduo_words_energy};
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        struct text line = {0};
        lights[i](&line, p->report->result, option, control);
        put_wrapped(p, "    ", 6, line.bytes ? line.bytes : "");
        ceduo_text_free(&line);
    }
}

static void put_residual(struct page *p, const struct ceduo_control *c, const struct ceduo_arrivals *a,
                         const struct ceduo_index *index, const char *rule)
{
    struct text line = {0};
    ceduo_text_format(&line, _("By the index (Eq. 4, %s) stems could take "), rule);
    ceduo_words_number(&line, index->dissipated * KILO, 3);
    ceduo_text_put(&line, " kJ");
    if (index->length > 0) {
        ceduo_text_put(&line, ", ");
        ceduo_words_number(&line, index->dissipated / index->length * 100 * KILO, 3);
        ceduo_text_format(&line, _(" kJ per 100 m (%s)"), rule);
    }
    if (a->reached == 0) {
        ceduo_text_put(&line, _("; no rock arrives, nothing is left to compare."));
    } else if (index->exhausted) {
        ceduo_text_put(&line, _(", more than the mean rock brings: used up on average. Some rocks still pass."));
    } else {
        ceduo_text_put(&line, _("; left (Eq. 5): "));
        ceduo_words_number(&line, a->energy.mean * KILO, 4);
        ceduo_text_format(&line, " %s ", p->plain ? "-" : "\xe2\x88\x92");
        ceduo_words_number(&line, index->dissipated * KILO, 3);
        ceduo_text_put(&line, " = ");
        ceduo_words_number(&line, index->residual * KILO, 3);
        ceduo_text_put(&line, " kJ.");
    }
    put_wrapped(p, "    ", 6, line.bytes ? line.bytes : "");
    ceduo_text_free(&line);
    if (isnan(index->measured))
        return;
    struct text seen = {0};
    ceduo_text_put(&seen, _("Measured here on one rock: "));
    ceduo_words_number(&seen, index->measured * KILO, 3);
    ceduo_text_format(&seen, _(" kJ (%g m/s). One rock is no validation."), c->measured_speed);
    put_wrapped(p, "    ", 6, seen.bytes ? seen.bytes : "");
    ceduo_text_free(&seen);
}

/* The belts where there is no room for a table. */
static void put_belts_narrow(struct page *p, const struct ceduo_option *o, const struct ceduo_option_result *found)
{
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_stand_result *s = &found->stands[i];
        struct text line = {0};
        ceduo_text_format(&line, "%s%s: ADC ", o->belts[i].name, o->belts[i].assumed ? "*" : "");
        ceduo_words_number(&line, s->adc_m, 3);
        ceduo_text_format(&line, _(" m, free run %.1f %%, "), s->free_run_probability * 100);
        ceduo_words_number(&line, s->dissipated / s->length * 100 * KILO, 3);
        ceduo_text_format(&line, _(" kJ per 100 m (%s)"), s->bare ? _("no stems") : ceduo_words_rule(s->rule));
        put_wrapped(p, "    ", 6, line.bytes ? line.bytes : "");
        ceduo_text_free(&line);
    }
}

static void put_belts(struct page *p, const struct ceduo_option *o, const struct ceduo_option_result *found)
{
    char room[CEDUO_NUMBER_ROOM];
    if (p->width < WIDTH) {
        put_belts_narrow(p, o, found);
        put_other_forms(p, o, found);
        return;
    }
    if (o->belts_count == 0)
        return;
    ceduo_text_put(p->text, "    ");
    put_padded(p, _("m"), 10);
    put_padded(p, _("stand"), 27);
    struct text limit = {0};
    ceduo_text_format(&limit, "<%s m", ceduo_number_shortest(p->report->result->scene->simulation.threshold, room));
    put_padded(p, _("ADC m"), -7);
    ceduo_text_char(p->text, ' ');
    put_padded(p, limit.bytes ? limit.bytes : "", 6);
    put_padded(p, _("free run"), -9);
    put_padded(p, _("kJ"), -7);
    put_padded(p, _("kJ/100 m"), -9);
    ceduo_text_char(p->text, '\n');
    for (size_t i = 0; i < o->belts_count; i++)
        put_belt(p, &o->belts[i], &found->stands[i]);
    put_other_forms(p, o, found);
    ceduo_text_free(&limit);
}

static void say_warning(void *context, const char *sentence)
{
    put_wrapped(context, "    ! ", 6, sentence);
}

/* ---- block sizes ---- */

/* Of 1000 released those with too much energy, or where no energy is said those that arrive. */
static void put_block(struct page *p, const struct ceduo_block *b)
{
    struct text share = {0};
    bool says = !isnan(b->exceed_probability);
    if (!isnan(b->reach_probability))
        put_of_1000(p, &share, says ? b->exceed_probability : b->reach_probability, says ? b->exceed_lo : b->reach_lo,
                    says ? b->exceed_hi : b->reach_hi);
    ceduo_text_put(p->text, b->own ? "  >" : "   ");
    put_cell(p, b->volume, 3, 8);
    put_cell(p, b->mass, 3, 9);
    put_cell(p, b->diameter, 3, 8);
    put_cell(p, b->adc, 3, 8);
    put_cell(p, b->contacts, 3, 10);
    put_padded(p, share.bytes ? share.bytes : "-", -18);
    ceduo_text_char(p->text, '\n');
    ceduo_text_free(&share);
}

static void put_blocks(struct page *p, const struct ceduo_block *blocks)
{
    const struct ceduo_result *r = p->report->result;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    char room[CEDUO_NUMBER_ROOM];
    struct text head = {0};
    ceduo_text_format(&head, _("Blocks of other sizes, same shape and release, of 1000 to %s m (> this scene's):"),
                      ceduo_number_shortest(c->x_given, room));
    put_wrapped(p, "    ", 4, head.bytes ? head.bytes : "");
    ceduo_text_free(&head);
    ceduo_text_put(p->text, "    ");
    put_padded(p, "m3", -7);
    put_padded(p, "kg", -9);
    put_padded(p, _("wide m"), -8);
    put_padded(p, _("ADC m"), -8);
    put_padded(p, _("contacts"), -10);
    put_limit(p, c, _("of 1000 arrive"), 18);
    ceduo_text_char(p->text, '\n');
    for (size_t i = 0; i < CEDUO_BLOCKS; i++)
        put_block(p, &blocks[i]);
}

/* ---- years ---- */

static const char *short_verdict(enum ceduo_light light)
{
    return light == CEDUO_PASS ? _("pass") : light == CEDUO_FAIL ? _("FAIL") : "?";
}

static void put_year(struct page *p, const struct ceduo_year *y)
{
    const struct ceduo_result *r = p->report->result;
    size_t c = r->last_control;
    const struct ceduo_index *s = &y->controls[c];
    const struct ceduo_arrivals *a = y->wooded.rocks > 0 ? &y->wooded.arrivals[c] : NULL;
    struct text share = {0}, mean = {0}, run = {0};
    ceduo_text_format(&run, "%.1f %%", s->worst_free_run * 100);
    if (a && !isnan(a->exceed_probability))
        put_of_1000(p, &share, a->exceed_probability, a->exceed_lo, a->exceed_hi);
    else if (a)
        put_of_1000(p, &share, a->reach_probability, a->reach_lo, a->reach_hi);
    ceduo_text_format(p->text, "    %4u %-4s", y->year, y->cut ? _("cut") : "");
    put_cell(p, s->worst_adc, 3, 7);
    ceduo_text_format(p->text, " %-5s", short_verdict(s->contact));
    put_padded(p, run.bytes ? run.bytes : "", -7);
    ceduo_text_format(p->text, " %-5s", short_verdict(s->free_run));
    put_cell(p, s->length > 0 ? s->dissipated / s->length * 100 * KILO : 0, 3, 9);
    put_padded(p, share.bytes ? share.bytes : "-", -16);
    put_cell(p, a ? a->energy.mean * KILO : NAN, 3, 8);
    ceduo_text_format(p->text, "  %s\n", short_verdict(s->energy));
    ceduo_text_free(&share);
    ceduo_text_free(&mean);
    ceduo_text_free(&run);
}

static void put_years_head(struct page *p)
{
    const struct ceduo_result *r = p->report->result;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(p->text, _("    Year by year, up to %s m:\n    "), ceduo_number_shortest(c->x_given, room));
    put_padded(p, _("year"), 9);
    put_padded(p, _("ADC m"), -7);
    put_padded(p, "", 6);
    put_padded(p, _("free run"), 13);
    put_padded(p, _("kJ/100 m"), -9);
    put_limit(p, c, _("of 1000 arrive"), 16);
    put_padded(p, _("mean kJ"), -8);
    ceduo_text_format(p->text, "  %s\n", _("energy"));
}

/* The years together, in sentences. */
static void put_years_summary(struct page *p, const struct ceduo_years *years)
{
    const struct ceduo_result *r = p->report->result;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    struct ceduo_years_summary s = ceduo_years_sum(years, r->last_control);
    bool says = !isnan(c->accepted);
    struct text line = {0};
    ceduo_text_format(&line, ngettext("Of this %zu year: without contact %zu, with long free runs %zu",
                                      "Of these %zu years: without contact %zu, with long free runs %zu", s.years),
                      s.years, s.unprotected_contact, s.unprotected_free_run);
    if (s.flown > 0 && says)
        ceduo_text_format(&line, _(", with too much energy %zu"), s.unprotected_energy);
    ceduo_text_put(&line, ". ");
    if (s.flown > 0) {
        struct ceduo_paired mean = says ? s.exceed : s.reach;
        ceduo_text_format(&line, says ? _("In the mean %.0f %s%.0f of 1000 arrive with too much energy, at worst %.0f in year %u.")
                                      : _("In the mean %.0f %s%.0f of 1000 arrive, at worst %.0f in year %u."),
                          mean.mean * 1000, plus_minus(p), ceil(mean.se * CEDUO_Z95 * 1000), s.worst * 1000,
                          s.worst_year);
    } else {
        ceduo_text_format(&line, _("The ADC is largest in year %u."), s.worst_year);
    }
    if (s.flown > 0 && !isnan(r->scene->rocks_per_year)) {
        ceduo_text_format(&line, _(" With %g rocks a year %.3g a year are to be expected to pass"),
                          r->scene->rocks_per_year, s.passes_per_year);
        if (says)
            ceduo_text_format(&line, _(", %.3g of them with too much energy"), s.exceeds_per_year);
        ceduo_text_format(&line, _("; in all %zu years %.3g"), s.years, s.passes_per_year * (double)s.years);
        if (says)
            ceduo_text_format(&line, _(" and %.3g"), s.exceeds_per_year * (double)s.years);
        ceduo_text_char(&line, '.');
    }
    double felled = ceduo_years_felled(years);
    if (felled > 0)
        ceduo_text_format(&line, _(" Felled: %g m of forest along the slope."), felled);
    put_wrapped(p, "    ", 6, line.bytes ? line.bytes : "");
    ceduo_text_free(&line);
}

static void put_years(struct page *p, const struct ceduo_years *years)
{
    put_years_head(p);
    for (size_t i = 0; i < years->count; i++)
        put_year(p, &years->years[i]);
    put_years_summary(p, years);
}

/* Those of a belt that do not stand on the page already, from `since` on: belts of one stand share them. */
static void put_stand_warnings(struct page *p, size_t since, const struct ceduo_belt *belt,
                               const struct ceduo_stand_result *found)
{
    struct text own = {0};
    struct page to = *p;
    to.text = &own;
    ceduo_words_stand_warnings(p->report->result->scene, belt, found, say_warning, &to);
    p->text->failed |= own.failed;
    if (own.length > 0 && !(p->text->length > since && strstr(p->text->bytes + since, own.bytes)))
        ceduo_text_put(p->text, own.bytes);
    ceduo_text_free(&own);
}

static void put_option(struct page *p, size_t i)
{
    const struct ceduo_result *r = p->report->result;
    const struct ceduo_option *o = &r->scene->options[i];
    const struct ceduo_option_result *found = &r->options[i];
    ceduo_text_char(p->text, '\n');
    put_wrapped(p, "", 2, o->name);
    const char *rule = rule_of(o, found);
    for (size_t k = 0; k < r->scene->controls_count; k++) {
        put_place(p, &r->scene->controls[k], k);
        put_arrivals(p, i, k);
        put_lights(p, i, k);
        if (k == 0)
            put_belts(p, o, found);
        put_residual(p, &r->scene->controls[k], &r->bare.arrivals[k], &found->controls[k], rule);
    }
    if (p->report->blocks && p->width >= 68 && !p->report->years)
        put_blocks(p, &p->report->blocks[i * CEDUO_BLOCKS]);
    if (p->report->years && p->width >= WIDTH)
        put_years(p, p->report->years[i]);
    size_t warnings = p->text->length;
    for (size_t k = 0; k < o->belts_count; k++)
        put_stand_warnings(p, warnings, &o->belts[k], &found->stands[k]);
}

/* ---- side by side ---- */

/* "480 ±10": of 1000. */
static void put_per_1000(struct page *p, double mean, double half, bool sign, int width)
{
    struct text cell = {0};
    if (isnan(mean))
        ceduo_text_put(&cell, "-");
    else if (isnan(half)) /* of one rock */
        ceduo_text_format(&cell, sign ? "%+.0f %s-" : "%.0f %s-", mean * 1000, plus_minus(p));
    else
        ceduo_text_format(&cell, sign ? "%+.0f %s%.0f" : "%.0f %s%.0f", mean * 1000, plus_minus(p), ceil(half * 1000));
    put_padded(p, cell.bytes ? cell.bytes : "", -width);
    ceduo_text_free(&cell);
}

static void put_simulated(struct page *p, size_t i)
{
    const struct ceduo_result *r = p->report->result;
    size_t c = r->last_control;
    double half, half_of_difference, difference = ceduo_words_difference(r, i, &half_of_difference);
    double share = ceduo_words_share(r, i, &half);
    put_per_1000(p, share, half, false, 10);
    put_per_1000(p, i == 0 ? NAN : difference, half_of_difference, true, 11);
    ceduo_text_format(p->text, "  %-4s", short_verdict(r->options[i].controls[c].energy));
}

static void put_by_index(struct page *p, const struct ceduo_index *s)
{
    put_cell(p, s->length > 0 ? s->dissipated / s->length * 100 * KILO : 0, 3, 10);
    if (s->exhausted)
        put_padded(p, _("used up"), -10);
    else
        put_cell(p, s->residual * KILO, 3, 10);
}

static void put_comparison_row(struct page *p, size_t i)
{
    const struct ceduo_result *r = p->report->result;
    const struct ceduo_index *s = &r->options[i].controls[r->last_control];
    ceduo_text_put(p->text, "  ");
    put_padded(p, r->scene->options[i].name, 23);
    put_cell(p, s->worst_adc, 3, 7);
    ceduo_text_format(p->text, " %-5s", short_verdict(s->contact));
    struct text share = {0};
    ceduo_text_format(&share, "%.1f %%", s->worst_free_run * 100);
    put_padded(p, share.bytes ? share.bytes : "", -7);
    ceduo_text_free(&share);
    ceduo_text_format(p->text, " %-5s", short_verdict(s->free_run));
    if (r->wooded)
        put_simulated(p, i);
    else
        put_by_index(p, s);
    ceduo_text_char(p->text, '\n');
}

/* How many options pass one of the lights. */
static size_t passing(const struct ceduo_result *r, int light)
{
    size_t n = 0;
    for (size_t i = 0; i < r->scene->options_count; i++) {
        const struct ceduo_index *s = &r->options[i].controls[r->last_control];
        n += (light == 0 ? s->contact : light == 1 ? s->free_run : s->energy) == CEDUO_PASS;
    }
    return n;
}

static void say_separation(struct page *p, const char *test, size_t pass)
{
    size_t n = p->report->result->scene->options_count;
    struct text line = {0};
    if (pass == n)
        ceduo_text_format(&line, _("All options pass the test of %s: it does not separate them."), test);
    else if (pass == 0)
        ceduo_text_format(&line, _("No option passes the test of %s: it does not separate them."), test);
    if (line.bytes)
        put_wrapped(p, "  ", 2, line.bytes);
    ceduo_text_free(&line);
}

static void put_comparison_head(struct page *p, const struct ceduo_control *c)
{
    bool wooded = p->report->result->wooded;
    ceduo_text_put(p->text, "  ");
    put_padded(p, _("option"), 23);
    put_padded(p, _("ADC m"), -7);
    put_padded(p, "", 6);
    put_padded(p, _("free run"), 13);
    if (wooded)
        put_limit(p, c, _("arrive"), 10);
    else
        put_padded(p, _("kJ/100 m"), -10);
    put_padded(p, wooded ? _("to first") : _("left kJ"), wooded ? -11 : -10);
    if (wooded)
        ceduo_text_format(p->text, "  %s", _("energy"));
    ceduo_text_char(p->text, '\n');
}

static void put_comparison(struct page *p)
{
    const struct ceduo_result *r = p->report->result;
    char room[CEDUO_NUMBER_ROOM];
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    struct text head = {0};
    ceduo_text_format(&head,
                      r->wooded ? _("Side by side, up to %s m: the same rocks through each wood, of 1000 released")
                                : _("Side by side, up to %s m (kJ per 100 m and left: by the rule named above)"),
                      ceduo_number_shortest(c->x_given, room));
    ceduo_text_char(p->text, '\n');
    put_wrapped(p, "", 2, head.bytes ? head.bytes : "");
    ceduo_text_free(&head);
    put_comparison_head(p, c);
    for (size_t i = 0; i < r->scene->options_count; i++)
        put_comparison_row(p, i);
    say_separation(p, _("contact"), passing(r, 0));
    say_separation(p, _("free run"), passing(r, 1));
    if (r->wooded && !isnan(c->accepted))
        say_separation(p, _("energy"), passing(r, 2));
    struct text best = {0};
    ceduo_words_best(&best, r);
    if (best.length > 0)
        put_wrapped(p, "  ", 2, best.bytes);
    ceduo_text_free(&best);
    if (!r->wooded)
        put_wrapped(p, "  ", 2,
                    _("Without forest every option sees the same rocks: what arrives does not separate them. The index "
                      "says what stems could take, not what a rock loses; no column decides alone."));
}

/* ---- rotations side by side ---- */

static void put_count(struct page *p, size_t count, int width)
{
    struct text cell = {0};
    ceduo_text_format(&cell, "%zu", count);
    put_padded(p, cell.bytes ? cell.bytes : "", -width);
    ceduo_text_free(&cell);
}

/* What is compared over the years: the mean share of the released with too much energy, or where that is not said that
 * arrives. */
static struct ceduo_paired mean_of_years(const struct page *p, const struct ceduo_years_summary *s)
{
    const struct ceduo_result *r = p->report->result;
    return isnan(r->scene->controls[r->last_control].accepted) ? s->reach : s->exceed;
}

static void put_rotation_row(struct page *p, size_t i, const struct ceduo_years_summary *s)
{
    struct text worst = {0};
    struct ceduo_paired mean = mean_of_years(p, s);
    ceduo_text_put(p->text, "  ");
    put_padded(p, p->report->result->scene->options[i].name, 23);
    put_count(p, s->unprotected_contact, 8);
    put_count(p, s->unprotected_free_run, 9);
    if (s->flown > 0) {
        put_count(p, s->unprotected_energy, 7);
        put_per_1000(p, mean.mean, mean.se * CEDUO_Z95, false, 13);
        ceduo_text_format(&worst, "%.0f (%u)", s->worst * 1000, s->worst_year);
    } else {
        ceduo_words_number(&worst, s->worst, 3);
        ceduo_text_format(&worst, " (%u)", s->worst_year);
    }
    put_padded(p, worst.bytes ? worst.bytes : "", -14);
    ceduo_text_char(p->text, '\n');
    ceduo_text_free(&worst);
}

static void put_rotations_head(struct page *p, const struct ceduo_control *c, bool flown)
{
    ceduo_text_put(p->text, "  ");
    put_padded(p, _("option"), 23);
    put_padded(p, _("contact"), -8);
    put_padded(p, _("free run"), -9);
    if (flown)
        put_padded(p, _("energy"), -7);
    if (flown)
        put_limit(p, c, _("arrive"), 13);
    put_padded(p, flown ? _("worst (year)") : _("ADC m (year)"), -14);
    ceduo_text_char(p->text, '\n');
}

/* Which option lets the fewest through over the years. The same rocks fly in all of them, so errors go together, and two
 * standard errors as of independent figures are rather too many. */
static void say_best_rotation(struct page *p, const struct ceduo_years_summary *sums)
{
    const struct ceduo_scene *scene = p->report->result->scene;
    size_t n = scene->options_count, best = 0, worse = 0;
    for (size_t i = 1; i < n; i++)
        if (mean_of_years(p, &sums[i]).mean < mean_of_years(p, &sums[best]).mean)
            best = i;
    struct ceduo_paired least = mean_of_years(p, &sums[best]);
    for (size_t i = 0; i < n; i++) {
        struct ceduo_paired mean = mean_of_years(p, &sums[i]);
        worse += mean.mean - least.mean > 2 * hypot(mean.se, least.se);
    }
    struct text line = {0};
    if (worse == 0)
        ceduo_text_put(&line, _("In the mean of these years no option is clearly better by energy."));
    else
        ceduo_text_format(&line, worse == n - 1 ? _("In the mean of these years '%s' lets the fewest through.")
                                                : _("In the mean of these years '%s' lets the fewest through, though not "
                                                    "clearly before all others."), scene->options[best].name);
    put_wrapped(p, "  ", 2, line.bytes ? line.bytes : "");
    ceduo_text_free(&line);
}

static void put_rotations(struct page *p)
{
    const struct ceduo_result *r = p->report->result;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    size_t n = r->scene->options_count;
    struct ceduo_years_summary *sums = calloc(n, sizeof *sums);
    p->text->failed |= !sums;
    if (!sums)
        return;
    for (size_t i = 0; i < n; i++)
        sums[i] = ceduo_years_sum(p->report->years[i], r->last_control);
    char room[CEDUO_NUMBER_ROOM];
    struct text head = {0};
    ceduo_text_format(&head, ngettext("Side by side over %zu year, up to %s m: years in which a test fails",
                                      "Side by side over %zu years, up to %s m: years in which a test fails", sums[0].years),
                      sums[0].years, ceduo_number_shortest(c->x_given, room));
    if (sums[0].flown > 0)
        ceduo_text_put(&head, _("; of 1000 released, in the mean and in the worst year"));
    ceduo_text_char(p->text, '\n');
    put_wrapped(p, "", 2, head.bytes ? head.bytes : "");
    ceduo_text_free(&head);
    put_rotations_head(p, c, sums[0].flown > 0);
    for (size_t i = 0; i < n; i++)
        put_rotation_row(p, i, &sums[i]);
    if (sums[0].flown > 0)
        say_best_rotation(p, sums);
    free(sums);
}

/* ---- foot ---- */

static bool any_assumed(const struct scene_file *file, bool years)
{
    for (const struct source_note *n = file->notes; n; n = n->before)
        if (strcmp(n->kind, "assumed") == 0 && (years || !ceduo_note_of_years(n)))
            return true;
    return false;
}

/* How many notes before `note` (that is, in the files behind it) say the same. */
static bool said_after(const struct source_note *last, const struct source_note *note, size_t *times)
{
    bool first = true;
    *times = 0;
    for (const struct source_note *n = last; n; n = n->before) {
        if (strcmp(n->kind, "assumed") != 0 || strcmp(n->text, note->text) != 0)
            continue;
        ++*times;
        first = n == note; /* the last one seen is the first of the files */
    }
    return !first;
}

/* Each assumption once, with the first place that makes it. The notes are kept last first. */
static void put_assumed(struct page *p, const struct source_note *note)
{
    if (!note)
        return;
    put_assumed(p, note->before);
    size_t times;
    if (!p->report->years && ceduo_note_of_years(note))
        return;
    if (strcmp(note->kind, "assumed") != 0 || said_after(p->report->file->notes, note, &times))
        return;
    struct text line = {0};
    ceduo_text_format(&line, "%s (%s", note->text, note->path[0] ? note->path : _("the scene"));
    if (times > 1)
        ceduo_text_format(&line, ngettext(" and %zu more", " and %zu more", times - 1), times - 1);
    ceduo_text_char(&line, ')');
    put_wrapped(p, "  ", 4, line.bytes ? line.bytes : "");
    ceduo_text_free(&line);
}

static void put_foot(struct page *p)
{
    size_t before = p->text->length;
    ceduo_text_char(p->text, '\n');
    ceduo_words_run_warnings(p->report->result, &p->report->remarks, say_warning, p);
    if (p->text->length == before + 1 && p->text->bytes) {
        p->text->length = before;
        p->text->bytes[before] = '\0';
    }
    if (!any_assumed(p->report->file, p->report->years != NULL))
        return;
    ceduo_text_put(p->text, _("\n* Assumed, not measured:\n"));
    put_assumed(p, p->report->file->notes);
}

void ceduo_report_table(struct text *text, const struct ceduo_report *report, bool plain)
{
    struct page p = {text, report, plain, WIDTH};
    put_head(&p);
    for (size_t i = 0; i < report->result->scene->options_count; i++)
        put_option(&p, i);
    const struct ceduo_scene *scene = report->result->scene;
    if (scene->options_count > 1 && scene->controls_count > 0)
        report->years ? put_rotations(&p) : put_comparison(&p);
    put_foot(&p);
}

void ceduo_report_option(struct text *text, const struct ceduo_report *report, size_t option, int width)
{
    struct page p = {text, report, false, width > 20 ? (size_t)width : 20};
    put_option(&p, option);
}
