/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A calibration as JSON, CSV and draws; and the words that the page shares with them. */
#include "report_calibration.h"

#include <math.h>
#include <string.h>

#include "base/json.h"
#include "base/language.h"
#include "ceduo/version.h"
#include "words.h"

/* ---- words ---- */

#define GROUND "slope.materials["

void ceduo_calibration_name(struct text *text, const char *path, const struct field *field)
{
    const char *name = path + sizeof GROUND - 1, *bracket = strchr(path, '[');
    ceduo_text_put(text, _(field->shown.label));
    if (strncmp(path, GROUND, sizeof GROUND - 1) == 0)
        ceduo_text_format(text, ", %.*s", (int)strcspn(name, "]"), name);
    else if (bracket && bracket[1] != '*')
        ceduo_text_format(text, " [%.*s]", (int)strcspn(bracket + 1, "]"), bracket + 1);
}

void ceduo_calibration_number(struct text *text, const struct field *field, double value)
{
    ceduo_words_number(text, value * (field->shown.per > 0 ? field->shown.per : 1), 3);
}

double ceduo_seen_shown(enum ceduo_observed_kind kind, double value, double origin)
{
    bool place = ceduo_observed_row(kind)->quantity == CEDUO_QUANTITY_PLACE;
    return place ? value + origin : value * (1 / ceduo_observed_quantity(kind)->scale);
}

const struct ceduo_observation *ceduo_seen_of(const struct ceduo_calibration_report *r, const struct ceduo_predicted *p)
{
    return &r->files[p->scene].observations[p->observation];
}

size_t ceduo_seen_number(const struct ceduo_observation *o)
{
    return o->kind == CEDUO_OBSERVED_PASSED ? (size_t)o->of : o->n;
}

void ceduo_calibration_source(struct text *text, const struct ceduo_calibration_report *r, size_t i)
{
    const struct ceduo_fitted *f = &r->answer->parameters[i];
    const char *between = "";
    for (size_t k = 0; k < r->answer->predicted_count; k++) {
        const struct ceduo_observation *o = ceduo_seen_of(r, &r->answer->predicted[k]);
        if (o->use != CEDUO_OBSERVED_FIT)
            continue;
        ceduo_text_format(text, "%s%zu ", between, ceduo_seen_number(o));
        ceduo_text_safe(text, o->name);
        between = ", ";
    }
    ceduo_text_format(text, "; %s 95 %% ", r->fields[i]->key);
    ceduo_words_number(text, f->p2_5, 3);
    ceduo_text_put(text, "\xe2\x80\x93");
    ceduo_words_number(text, f->p97_5, 3);
    if (!f->determined)
        ceduo_text_put(text, "; not determined");
}

void ceduo_calibration_sources(struct text *text, const struct ceduo_calibration_report *r)
{
    for (size_t i = 0; i < r->answer->parameters_count; i++) {
        if (i > 0)
            ceduo_text_put(text, "; ");
        ceduo_calibration_source(text, r, i);
    }
}

/* ---- JSON ---- */

static void put_parameter(struct json *j, const struct ceduo_calibration_report *r, size_t i)
{
    const struct ceduo_fitted *f = &r->answer->parameters[i];
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "path", r->paths[i]);
    ceduo_json_number(j, "lo", f->lo);
    ceduo_json_number(j, "hi", f->hi);
    ceduo_json_number(j, "best", f->best);
    ceduo_json_number(j, "p2_5", f->p2_5);
    ceduo_json_number(j, "p50", f->p50);
    ceduo_json_number(j, "p97_5", f->p97_5);
    ceduo_json_flag(j, "determined", f->determined);
    ceduo_json_flag(j, "at_bound", f->at_bound);
    ceduo_json_close(j, '}');
}

static void put_observation(struct json *j, const struct ceduo_calibration_report *r, const struct ceduo_predicted *p)
{
    const struct ceduo_observation *o = ceduo_seen_of(r, p);
    double origin = r->files[p->scene].scene.slope.origin_x;
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "what", o->name);
    ceduo_json_string(j, "scene", r->files[p->scene].path);
    ceduo_json_string(j, "option", r->files[p->scene].scene.options[o->option].name);
    ceduo_json_string(j, "use", o->use == CEDUO_OBSERVED_FIT ? "fit" : "check");
    ceduo_json_count(j, "n", ceduo_seen_number(o));
    ceduo_json_number(j, "deviance", p->at_best.deviance);
    ceduo_json_number(j, "p_value", p->p_value);
    ceduo_json_number(j, "seen", ceduo_seen_shown(o->kind, p->seen, origin));
    ceduo_json_number(j, "predicted_lo", ceduo_seen_shown(o->kind, p->lo, origin));
    ceduo_json_number(j, "predicted_hi", ceduo_seen_shown(o->kind, p->hi, origin));
    ceduo_json_flag(j, "inside", p->inside);
    ceduo_json_number(j, "single_lo", ceduo_seen_shown(o->kind, p->one_lo, origin));
    ceduo_json_number(j, "single_hi", ceduo_seen_shown(o->kind, p->one_hi, origin));
    if (o->values && !isnan(p->one_lo))
        ceduo_json_count(j, "single_inside", p->one_inside);
    ceduo_json_close(j, '}');
}

static void put_correlation(struct json *j, const struct ceduo_calibration *a)
{
    ceduo_json_open(j, "correlation", '[');
    for (size_t i = 0; i < a->parameters_count; i++) {
        ceduo_json_open(j, NULL, '[');
        for (size_t k = 0; k < a->parameters_count; k++)
            ceduo_json_number(j, NULL, a->correlation[i][k]);
        ceduo_json_close(j, ']');
    }
    ceduo_json_close(j, ']');
}

void ceduo_calibration_json(struct text *text, const struct ceduo_calibration_report *r)
{
    const struct ceduo_calibration *a = r->answer;
    struct json j = {.text = text};
    ceduo_json_open(&j, NULL, '{');
    ceduo_json_string(&j, "format", "ceduo-calibration-1");
    ceduo_json_string(&j, "version", CEDUO_VERSION);
    ceduo_json_open(&j, "scenes", '[');
    for (size_t s = 0; s < r->scenes_count; s++)
        ceduo_json_string(&j, NULL, r->files[s].path);
    ceduo_json_close(&j, ']');
    ceduo_json_count(&j, "seed", r->seed);
    ceduo_json_count(&j, "rocks", r->rocks);
    ceduo_json_open(&j, "parameters", '[');
    for (size_t i = 0; i < a->parameters_count; i++)
        put_parameter(&j, r, i);
    ceduo_json_close(&j, ']');
    put_correlation(&j, a);
    ceduo_json_open(&j, "observations", '[');
    for (size_t i = 0; i < a->predicted_count; i++)
        put_observation(&j, r, &a->predicted[i]);
    ceduo_json_close(&j, ']');
    ceduo_json_flag(&j, "misfit", a->misfit);
    ceduo_json_flag(&j, "refuted", a->refuted);
    ceduo_json_flag(&j, "settled", a->settled);
    ceduo_json_count(&j, "evaluations", a->evaluations);
    ceduo_json_number(&j, "rhat", a->rhat);
    ceduo_json_number(&j, "effective_size", a->effective_size);
    ceduo_json_close(&j, '}');
    ceduo_text_char(text, '\n');
}

/* ---- CSV ---- */

static void put_number(struct text *text, double value)
{
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_char(text, ',');
    if (isfinite(value))
        ceduo_text_put(text, ceduo_number_shortest(value, room));
}

void ceduo_calibration_csv(struct text *text, const struct ceduo_calibration_report *r)
{
    ceduo_text_put(text, "scene,path,lo,hi,best,p2_5,p50,p97_5,determined,at_bound,misfit\n");
    for (size_t i = 0; i < r->answer->parameters_count; i++) {
        const struct ceduo_fitted *f = &r->answer->parameters[i];
        const double numbers[] = {f->lo, f->hi, f->best, f->p2_5, f->p50, f->p97_5};
        ceduo_text_csv(text, r->files[0].path);
        ceduo_text_char(text, ',');
        ceduo_text_csv(text, r->paths[i]);
        for (size_t k = 0; k < 6; k++)
            put_number(text, numbers[k]);
        ceduo_text_format(text, ",%s,%s,%s\n", f->determined ? "true" : "false", f->at_bound ? "true" : "false",
                          r->answer->misfit ? "true" : "false");
    }
}

void ceduo_calibration_draws(struct text *text, const struct ceduo_calibration *a, const char *const *heads)
{
    for (size_t i = 0; i < a->parameters_count; i++) {
        ceduo_text_put(text, i > 0 ? "," : "");
        ceduo_text_csv(text, heads[i]);
    }
    ceduo_text_char(text, '\n');
    for (size_t k = 0; k < a->draws_count; k++) {
        char room[CEDUO_NUMBER_ROOM];
        for (size_t i = 0; i < a->parameters_count; i++)
            ceduo_text_format(text, "%s%s", i > 0 ? "," : "",
                              ceduo_number_shortest(a->draws[k * a->parameters_count + i], room));
        ceduo_text_char(text, '\n');
    }
}
