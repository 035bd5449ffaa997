/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "ceduo/version.h"
#include "base/json.h"
#include "report.h"

#define KILO 1e-3

static void say_json(void *context, const char *sentence)
{
    ceduo_json_string(context, NULL, sentence);
}

static void distribution(struct json *j, const char *key, const struct ceduo_distribution *d, double scale)
{
    ceduo_json_open(j, key, '{');
    ceduo_json_number(j, "mean", d->mean * scale);
    ceduo_json_number(j, "se", d->se * scale);
    ceduo_json_number(j, "sd", d->sd * scale);
    ceduo_json_number(j, "p50", d->p50 * scale);
    ceduo_json_number(j, "p95", d->p95 * scale);
    ceduo_json_number(j, "p95_lo", d->p95_lo * scale);
    ceduo_json_number(j, "p95_hi", d->p95_hi * scale);
    ceduo_json_number(j, "p99", d->p99 * scale);
    ceduo_json_number(j, "max", d->max * scale);
    ceduo_json_close(j, '}');
}

static void pair(struct json *j, const char *key, double mean, double se)
{
    ceduo_json_open(j, key, '{');
    ceduo_json_number(j, "mean", mean);
    ceduo_json_number(j, "se", se);
    ceduo_json_close(j, '}');
}

static void arrivals(struct json *j, const char *key, const struct ceduo_arrivals *a, bool wooded)
{
    ceduo_json_open(j, key, '{');
    ceduo_json_count(j, "rocks_reached", a->reached);
    ceduo_json_number(j, "reach_probability", a->reach_probability);
    ceduo_json_number(j, "reach_lo", a->reach_lo);
    ceduo_json_number(j, "reach_hi", a->reach_hi);
    ceduo_json_number(j, "exceed_probability", a->exceed_probability);
    ceduo_json_number(j, "exceed_lo", a->exceed_lo);
    ceduo_json_number(j, "exceed_hi", a->exceed_hi);
    distribution(j, "speed_m_s", &a->speed, 1);
    distribution(j, "energy_kJ", &a->energy, KILO);
    distribution(j, "translation_kJ", &a->translation, KILO);
    distribution(j, "height_m", &a->height, 1);
    pair(j, "energy_per_released_kJ", a->energy_per_released * KILO, a->energy_per_released_se * KILO);
    if (wooded)
        pair(j, "contacts", a->contacts, a->contacts_se);
    ceduo_json_close(j, '}');
}

static void stand(struct json *j, const struct ceduo_report *report, const struct ceduo_belt *belt,
                  const struct ceduo_stand_result *r)
{
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "name", belt->name);
    ceduo_json_number(j, "from_m", belt->from_given);
    ceduo_json_number(j, "to_m", belt->to_given);
    ceduo_json_number(j, "length_m", r->length);
    ceduo_json_number(j, "stems_per_ha", r->stems_per_ha);
    ceduo_json_number(j, "stools_per_ha", r->stools_per_ha);
    ceduo_json_number(j, "trees_per_ha", r->trees_per_ha);
    ceduo_json_number(j, "basal_area_m2_ha", r->basal_area);
    ceduo_json_open(j, "adc", '{');
    ceduo_json_string(j, "rule", r->bare ? NULL : ceduo_words_rule(r->rule));
    ceduo_json_number(j, "adc_m", r->adc_m);
    ceduo_json_number(j, "gsteiger_stools_m", r->adc.gsteiger_stools);
    ceduo_json_number(j, "gsteiger_stems_m", r->adc.gsteiger_stems);
    ceduo_json_number(j, "interception_m", r->adc.interception);
    ceduo_json_number(j, "crofton_m", r->adc.crofton);
    ceduo_json_close(j, '}');
    ceduo_json_flag(j, "passes_threshold", r->passes_threshold);
    ceduo_json_number(j, "free_run_probability", r->free_run_probability);
    ceduo_json_number(j, "contacts", r->contacts);
    ceduo_json_number(j, "energy_per_contact_J", r->energy_per_contact);
    ceduo_json_number(j, "dissipated_kJ", r->dissipated * KILO);
    ceduo_json_number(j, "dissipated_kJ_per_100m", r->dissipated / r->length * 100 * KILO);
    ceduo_json_open(j, "warnings", '[');
    ceduo_words_stand_warnings(&report->file->scene, belt, r, say_json, j);
    ceduo_json_close(j, ']');
    ceduo_json_close(j, '}');
}

static void summary(struct json *j, const struct ceduo_index *s)
{
    ceduo_json_open(j, "summary", '{');
    ceduo_json_number(j, "length_m", s->length);
    ceduo_json_number(j, "longest_gap_m", s->longest_gap);
    ceduo_json_number(j, "adc_m", s->contacts > 0 ? s->length / s->contacts : NAN);
    ceduo_json_number(j, "contacts", s->contacts);
    ceduo_json_number(j, "meet_nothing_probability", s->meet_nothing_probability);
    ceduo_json_number(j, "dissipated_kJ", s->dissipated * KILO);
    ceduo_json_number(j, "dissipated_kJ_per_100m", s->dissipated / s->length * 100 * KILO);
    ceduo_json_flag(j, "passes_threshold", s->contact == CEDUO_PASS);
    ceduo_json_close(j, '}');
}

static void control(struct json *j, const struct ceduo_result *r, size_t k, const struct ceduo_index *index,
                    const struct ceduo_arrivals *wooded)
{
    const struct ceduo_control *c = &r->scene->controls[k];
    bool reached = !isnan(index->residual);
    ceduo_json_open(j, NULL, '{');
    ceduo_json_number(j, "x_m", c->x_given);
    ceduo_json_string(j, "name", c->name);
    ceduo_json_number(j, "accepted_kJ", ceduo_words_accepted(c));
    arrivals(j, "bare", &r->bare.arrivals[k], false);
    ceduo_json_open(j, "index", '{');
    ceduo_json_number(j, "dissipated_kJ", index->dissipated * KILO);
    ceduo_json_number(j, "residual_kJ", index->residual * KILO);
    if (reached)
        ceduo_json_flag(j, "exhausted", index->exhausted);
    else
        ceduo_json_null(j, "exhausted");
    if (!isnan(index->measured))
        ceduo_json_number(j, "measured_kJ", index->measured * KILO);
    ceduo_json_close(j, '}');
    if (wooded)
        arrivals(j, "wooded", wooded, true);
    else
        ceduo_json_null(j, "wooded");
    ceduo_json_open(j, "lights", '{');
    ceduo_json_string(j, "contact", ceduo_words_light(index->contact));
    ceduo_json_string(j, "free_run", ceduo_words_light(index->free_run));
    ceduo_json_string(j, "energy", ceduo_words_light(index->energy));
    ceduo_json_close(j, '}');
    ceduo_json_close(j, '}');
}

static void ends(struct json *j, const struct ceduo_report *report, size_t i)
{
    const struct ceduo_flown *f = &report->result->options[i].wooded;
    const struct ceduo_ends *e = &f->ends;
    double n = (double)f->rocks, origin = report->file->origin_x;
    ceduo_json_open(j, "ends", '{');
    ceduo_json_number(j, "stopped_by_stems", (double)e->count[CEDUO_STOPPED_BY_STEMS] / n);
    ceduo_json_number(j, "came_to_rest", (double)e->count[CEDUO_AT_REST] / n);
    ceduo_json_number(j, "left_slope", (double)e->count[CEDUO_LEFT_SLOPE] / n);
    ceduo_json_count(j, "unfinished", e->count[CEDUO_UNFINISHED]);
    ceduo_json_close(j, '}');
    if (e->stop_x.n == 0) {
        ceduo_json_null(j, "stop_x_m");
        return;
    }
    ceduo_json_open(j, "stop_x_m", '{');
    ceduo_json_number(j, "p50", e->stop_p50 + origin);
    ceduo_json_number(j, "p95", e->stop_p95 + origin);
    ceduo_json_number(j, "max", e->stop_max + origin);
    ceduo_json_close(j, '}');
}

static void year(struct json *j, const struct ceduo_report *report, const struct ceduo_year *y)
{
    const struct ceduo_result *r = report->result;
    ceduo_json_open(j, NULL, '{');
    ceduo_json_count(j, "year", y->year);
    ceduo_json_flag(j, "cut", y->cut);
    ceduo_json_open(j, "stands", '[');
    for (size_t k = 0; k < y->option.belts_count; k++)
        stand(j, report, &y->option.belts[k], &y->stands[k]);
    ceduo_json_close(j, ']');
    summary(j, &y->controls[r->last_control]);
    ceduo_json_open(j, "controls", '[');
    for (size_t k = 0; k < r->scene->controls_count; k++)
        control(j, r, k, &y->controls[k], y->wooded.rocks > 0 ? &y->wooded.arrivals[k] : NULL);
    ceduo_json_close(j, ']');
    ceduo_json_close(j, '}');
}

static void rotation(struct json *j, const struct ceduo_report *report, const struct ceduo_years *all)
{
    const struct ceduo_result *r = report->result;
    struct ceduo_years_summary s = ceduo_years_sum(all, r->last_control);
    ceduo_json_open(j, "rotation", '{');
    ceduo_json_count(j, "years", s.years);
    ceduo_json_number(j, "felled_m", ceduo_years_felled(all));
    ceduo_json_count(j, "unprotected_contact", s.unprotected_contact);
    ceduo_json_count(j, "unprotected_free_run", s.unprotected_free_run);
    ceduo_json_count(j, "unprotected_energy", s.unprotected_energy);
    pair(j, "reach_probability", s.reach.mean, s.reach.se);
    pair(j, "exceed_probability", s.exceed.mean, s.exceed.se);
    pair(j, "energy_per_released_kJ", s.energy_per_released.mean * KILO, s.energy_per_released.se * KILO);
    ceduo_json_count(j, "worst_year", s.worst_year);
    ceduo_json_number(j, "passes_per_year", s.passes_per_year);
    ceduo_json_number(j, "exceeds_per_year", s.exceeds_per_year);
    ceduo_json_close(j, '}');
}

static void years(struct json *j, const struct ceduo_report *report, const struct ceduo_years *all)
{
    ceduo_json_open(j, "years", '[');
    for (size_t i = 0; i < all->count; i++)
        year(j, report, &all->years[i]);
    ceduo_json_close(j, ']');
    rotation(j, report, all);
}

static void option(struct json *j, const struct ceduo_report *report, size_t i)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_option *o = &r->scene->options[i];
    const struct ceduo_option_result *found = &r->options[i];
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "name", o->name);
    ceduo_json_open(j, "stands", '[');
    for (size_t k = 0; k < o->belts_count; k++)
        stand(j, report, &o->belts[k], &found->stands[k]);
    ceduo_json_close(j, ']');
    summary(j, &found->controls[r->last_control]);
    ceduo_json_open(j, "controls", '[');
    for (size_t k = 0; k < r->scene->controls_count; k++)
        control(j, r, k, &found->controls[k], ceduo_result_wooded(r, i, k));
    ceduo_json_close(j, ']');
    ends(j, report, i);
    if (report->years)
        years(j, report, report->years[i]);
    ceduo_json_close(j, '}');
}

static void paired(struct json *j, const char *key, struct ceduo_paired d, double scale)
{
    pair(j, key, d.mean * scale, d.se * scale);
}

static void difference(struct json *j, const struct ceduo_result *r, size_t i, size_t k)
{
    const struct ceduo_difference *d = &r->options[i].differences[k];
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "option", r->scene->options[i].name);
    ceduo_json_string(j, "against", r->scene->options[0].name);
    ceduo_json_number(j, "x_m", r->scene->controls[k].x_given);
    paired(j, "reach_probability", d->reach_probability, 1);
    paired(j, "exceed_probability", d->exceed_probability, 1);
    paired(j, "energy_per_released_kJ", d->energy_per_released, KILO);
    ceduo_json_close(j, '}');
}

static void work(struct json *j, const struct ceduo_report *report)
{
    ceduo_json_open(j, "work", '{');
    ceduo_json_count(j, "rocks_flown", report->work.rocks);
    ceduo_json_count(j, "contacts", report->work.contacts);
    ceduo_json_count(j, "stems_drawn", report->work.stems.drawn);
    ceduo_json_count(j, "runs", report->work.runs);
    ceduo_json_count(j, "runs_reused", report->work.reused);
    ceduo_json_number(j, "seconds", report->seconds);
    ceduo_json_close(j, '}');
}

void ceduo_report_json(struct text *text, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    struct json json = {.text = text}, *j = &json;
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "format", "ceduo-result-1");
    ceduo_json_string(j, "version", CEDUO_VERSION);
    ceduo_json_string(j, "scene", report->file->path);
    ceduo_json_string(j, "title", r->scene->title);
    ceduo_json_count(j, "seed", r->scene->simulation.seed);
    ceduo_json_count(j, "rocks", ceduo_result_rocks(r));
    ceduo_json_string(j, "law", ceduo_words_law(r->scene->simulation.law));
    ceduo_json_open(j, "rock", '{');
    ceduo_json_number(j, "mass_kg", r->rock.mass);
    ceduo_json_number(j, "mean_diameter_m", r->rock.mean_diameter);
    ceduo_json_number(j, "moment_kg_m2", r->rock.moment);
    ceduo_json_close(j, '}');
    ceduo_json_number(j, "threshold_m", r->scene->simulation.threshold);
    ceduo_json_open(j, "warnings", '[');
    ceduo_words_run_warnings(r, &report->remarks, say_json, j);
    ceduo_json_close(j, ']');
    ceduo_json_open(j, "options", '[');
    for (size_t i = 0; i < r->scene->options_count; i++)
        option(j, report, i);
    ceduo_json_close(j, ']');
    ceduo_json_open(j, "differences", '[');
    for (size_t i = 1; i < r->scene->options_count; i++)
        for (size_t k = 0; k < r->scene->controls_count; k++)
            difference(j, r, i, k);
    ceduo_json_close(j, ']');
    work(j, report);
    ceduo_json_close(j, '}');
    ceduo_text_char(text, '\n');
}
