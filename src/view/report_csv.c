/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "report.h"

#define KILO 1e-3

/* A row, or the header that names its cells: the same calls write both. */
struct row {
    struct text *text;
    bool header, more;
    const char *group; /* "bare", "bare.speed_m_s"; NULL: none */
};

static void begin(struct row *row, const char *name)
{
    if (row->more)
        ceduo_text_char(row->text, ',');
    row->more = true;
    if (row->header && row->group)
        ceduo_text_format(row->text, "%s.", row->group);
    if (row->header)
        ceduo_text_put(row->text, name);
}

static void number(struct row *row, const char *name, double value)
{
    char room[CEDUO_NUMBER_ROOM];
    begin(row, name);
    if (!row->header && isfinite(value))
        ceduo_text_put(row->text, ceduo_number_shortest(value, room));
}

static void count(struct row *row, const char *name, uint64_t value)
{
    begin(row, name);
    if (!row->header)
        ceduo_text_format(row->text, "%" PRIu64, value);
}

static void flag(struct row *row, const char *name, bool value)
{
    begin(row, name);
    if (!row->header)
        ceduo_text_put(row->text, value ? "true" : "false");
}

static void string(struct row *row, const char *name, const char *value)
{
    begin(row, name);
    if (!row->header && value)
        ceduo_text_csv(row->text, value);
}

static void distribution(struct row *row, const char *group, const struct ceduo_distribution *d, double scale)
{
    row->group = group;
    number(row, "mean", d->mean * scale);
    number(row, "se", d->se * scale);
    number(row, "sd", d->sd * scale);
    number(row, "p50", d->p50 * scale);
    number(row, "p95", d->p95 * scale);
    number(row, "p95_lo", d->p95_lo * scale);
    number(row, "p95_hi", d->p95_hi * scale);
    number(row, "p99", d->p99 * scale);
    number(row, "max", d->max * scale);
}

static void pair(struct row *row, const char *group, double mean, double se)
{
    row->group = group;
    number(row, "mean", mean);
    number(row, "se", se);
}

/* Names of an arrivals' groups. */
struct arrival_names {
    const char *all, *speed, *energy, *translation, *height, *released;
};

static void arrivals(struct row *row, const struct arrival_names *names, const struct ceduo_arrivals *a)
{
    row->group = names->all;
    if (isnan(a->reach_probability)) {
        begin(row, "rocks_reached");
    } else {
        count(row, "rocks_reached", a->reached);
    }
    number(row, "reach_probability", a->reach_probability);
    number(row, "reach_lo", a->reach_lo);
    number(row, "reach_hi", a->reach_hi);
    number(row, "exceed_probability", a->exceed_probability);
    number(row, "exceed_lo", a->exceed_lo);
    number(row, "exceed_hi", a->exceed_hi);
    distribution(row, names->speed, &a->speed, 1);
    distribution(row, names->energy, &a->energy, KILO);
    distribution(row, names->translation, &a->translation, KILO);
    distribution(row, names->height, &a->height, 1);
    pair(row, names->released, a->energy_per_released * KILO, a->energy_per_released_se * KILO);
}

static void scene_cells(struct row *row, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    row->group = NULL;
    string(row, "scene", report->file->path);
    string(row, "title", r->scene->title);
    count(row, "seed", r->scene->simulation.seed);
    count(row, "rocks", report->rocks_asked > 0 ? report->rocks_asked : ceduo_result_rocks(r));
    string(row, "law", ceduo_words_law(r->scene->simulation.law));
    row->group = "rock";
    number(row, "mass_kg", r->rock.mass);
    number(row, "mean_diameter_m", r->rock.mean_diameter);
    number(row, "moment_kg_m2", r->rock.moment);
    row->group = NULL;
    number(row, "threshold_m", r->scene->simulation.threshold);
}

static void summary_cells(struct row *row, const struct ceduo_index *s)
{
    row->group = "summary";
    number(row, "length_m", s->length);
    number(row, "longest_gap_m", s->longest_gap);
    number(row, "adc_m", s->contacts > 0 ? s->length / s->contacts : NAN);
    number(row, "contacts", s->contacts);
    number(row, "meet_nothing_probability", s->meet_nothing_probability);
    number(row, "dissipated_kJ", s->dissipated * KILO);
    number(row, "dissipated_kJ_per_100m", s->dissipated / s->length * 100 * KILO);
    flag(row, "passes_threshold", s->contact == CEDUO_PASS);
}

static void index_cells(struct row *row, const struct ceduo_index *index)
{
    row->group = "index";
    number(row, "dissipated_kJ", index->dissipated * KILO);
    number(row, "residual_kJ", index->residual * KILO);
    if (isnan(index->residual))
        begin(row, "exhausted");
    else
        flag(row, "exhausted", index->exhausted);
    number(row, "measured_kJ", index->measured * KILO);
}

static void end_cells(struct row *row, const struct ceduo_report *report, size_t option, const struct ceduo_year *year)
{
    const struct ceduo_flown *f = &report->result->options[option].wooded;
    if (year && year->wooded.rocks > 0)
        f = &year->wooded;
    const struct ceduo_ends *e = &f->ends;
    double n = (double)f->rocks, origin = report->file->origin_x;
    row->group = "ends";
    number(row, "stopped_by_stems", (double)e->count[CEDUO_STOPPED_BY_STEMS] / n);
    number(row, "came_to_rest", (double)e->count[CEDUO_AT_REST] / n);
    number(row, "left_slope", (double)e->count[CEDUO_LEFT_SLOPE] / n);
    count(row, "unfinished", e->count[CEDUO_UNFINISHED]);
    row->group = "stop_x_m";
    number(row, "p50", e->stop_p50 + origin);
    number(row, "p95", e->stop_p95 + origin);
    number(row, "max", e->stop_max + origin);
}

/* Sentences joined by "; ". */
static void join(void *context, const char *sentence)
{
    struct text *all = context;
    if (all->length > 0)
        ceduo_text_put(all, "; ");
    ceduo_text_put(all, sentence);
}

static void warning_cell(struct row *row, const struct ceduo_report *report, size_t option,
                         const struct ceduo_year *year)
{
    struct text all = {0};
    const struct ceduo_option *o = year ? &year->option : &report->result->scene->options[option];
    const struct ceduo_stand_result *stands = year ? year->stands : report->result->options[option].stands;
    if (!row->header) {
        ceduo_words_run_warnings(report->result, &report->remarks, join, &all);
        for (size_t i = 0; i < o->belts_count; i++)
            ceduo_words_stand_warnings(report->result->scene, &o->belts[i], &stands[i], join, &all);
    }
    row->group = NULL;
    string(row, "warnings", all.bytes);
    ceduo_text_free(&all);
}

/* `year` NULL: the stands as filed. */
static void control_row(struct row *row, const struct ceduo_report *report, size_t option, size_t control,
                        const struct ceduo_year *year)
{
    static const struct arrival_names bare = {"bare",        "bare.speed_m_s", "bare.energy_kJ", "bare.translation_kJ",
                                              "bare.height_m", "bare.energy_per_released_kJ"};
    static const struct arrival_names wooded = {
        "wooded", "wooded.speed_m_s", "wooded.energy_kJ", "wooded.translation_kJ", "wooded.height_m",
        "wooded.energy_per_released_kJ"};
    const struct ceduo_result *r = report->result;
    const struct ceduo_option_result *found = &r->options[option];
    const struct ceduo_control *c = &r->scene->controls[control];
    const struct ceduo_distribution none = ceduo_distribution_none();
    const struct ceduo_arrivals nothing = {.reach_probability = NAN, .reach_lo = NAN, .reach_hi = NAN,
                                           .exceed_probability = NAN, .exceed_lo = NAN, .exceed_hi = NAN,
                                           .speed = none, .energy = none, .translation = none, .height = none,
                                           .energy_per_released = NAN, .energy_per_released_se = NAN,
                                           .contacts = NAN, .contacts_se = NAN};
    const struct ceduo_arrivals *through = ceduo_result_wooded(r, option, control);
    const struct ceduo_index *index = year ? year->controls : found->controls;
    if (year && !row->header)
        through = year->wooded.rocks > 0 ? &year->wooded.arrivals[control] : NULL;
    through = through ? through : &nothing;
    scene_cells(row, report);
    string(row, "option", r->scene->options[option].name);
    if (year) {
        count(row, "year", year->year);
        flag(row, "cut", year->cut);
    }
    summary_cells(row, &index[r->last_control]);
    row->group = NULL;
    number(row, "x_m", c->x_given);
    string(row, "name", c->name);
    number(row, "accepted_kJ", ceduo_words_accepted(c));
    arrivals(row, &bare, &r->bare.arrivals[control]);
    index_cells(row, &index[control]);
    arrivals(row, &wooded, through);
    pair(row, "wooded.contacts", through->contacts, through->contacts_se);
    row->group = "lights";
    string(row, "contact", ceduo_words_light(index[control].contact));
    string(row, "free_run", ceduo_words_light(index[control].free_run));
    string(row, "energy", ceduo_words_light(index[control].energy));
    end_cells(row, report, option, year);
    const struct ceduo_paired none_paired = {NAN, NAN};
    struct ceduo_difference d = {none_paired, none_paired, none_paired};
    if (option > 0 && !year)
        d = found->differences[control];
    pair(row, "difference.reach_probability", d.reach_probability.mean, d.reach_probability.se);
    pair(row, "difference.exceed_probability", d.exceed_probability.mean, d.exceed_probability.se);
    pair(row, "difference.energy_per_released_kJ", d.energy_per_released.mean * KILO, d.energy_per_released.se * KILO);
    warning_cell(row, report, option, year);
    ceduo_text_char(row->text, '\n');
    row->more = false;
}

static void stand_row(struct row *row, const struct ceduo_report *report, size_t option, size_t belt)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_belt *b = &r->scene->options[option].belts[belt];
    const struct ceduo_stand_result *s = &r->options[option].stands[belt];
    scene_cells(row, report);
    string(row, "option", r->scene->options[option].name);
    string(row, "name", b->name);
    number(row, "from_m", b->from_given);
    number(row, "to_m", b->to_given);
    number(row, "length_m", s->length);
    number(row, "stems_per_ha", s->stems_per_ha);
    number(row, "stools_per_ha", s->stools_per_ha);
    number(row, "trees_per_ha", s->trees_per_ha);
    number(row, "basal_area_m2_ha", s->basal_area);
    row->group = "adc";
    string(row, "rule", s->bare ? NULL : ceduo_words_rule(s->rule));
    number(row, "adc_m", s->adc_m);
    number(row, "gsteiger_stools_m", s->adc.gsteiger_stools);
    number(row, "gsteiger_stems_m", s->adc.gsteiger_stems);
    number(row, "interception_m", s->adc.interception);
    number(row, "crofton_m", s->adc.crofton);
    row->group = NULL;
    flag(row, "passes_threshold", s->passes_threshold);
    number(row, "free_run_probability", s->free_run_probability);
    number(row, "contacts", s->contacts);
    number(row, "energy_per_contact_J", s->energy_per_contact);
    number(row, "dissipated_kJ", s->dissipated * KILO);
    number(row, "dissipated_kJ_per_100m", s->dissipated / s->length * 100 * KILO);
    struct text all = {0};
    if (!row->header)
        ceduo_words_stand_warnings(r->scene, b, s, join, &all);
    string(row, "warnings", all.bytes);
    ceduo_text_free(&all);
    ceduo_text_char(row->text, '\n');
    row->more = false;
}

void ceduo_report_csv_header(struct text *text, bool stands, bool years)
{
    /* the same calls as for a row, on an empty result */
    struct ceduo_control control = {0};
    struct ceduo_belt belt = {0};
    struct ceduo_option option = {.belts_count = 1, .belts = &belt};
    struct ceduo_scene scene = {.controls_count = 1, .controls = &control, .options_count = 1, .options = &option};
    struct ceduo_arrivals bare = {0};
    struct ceduo_stand_result stand = {0};
    struct ceduo_index index = {0};
    struct ceduo_difference difference = {{0, 0}, {0, 0}, {0, 0}};
    struct ceduo_option_result found = {.stands = &stand, .controls = &index, .differences = &difference};
    struct ceduo_result result = {.scene = &scene, .bare = {.arrivals = &bare}, .options = &found};
    struct ceduo_year year = {.controls = &index};
    struct scene_file file = {0};
    struct ceduo_report report = {.file = &file, .result = &result};
    struct row row = {.text = text, .header = true};
    if (stands)
        stand_row(&row, &report, 0, 0);
    else
        control_row(&row, &report, 0, 0, years ? &year : NULL);
}

void ceduo_report_csv(struct text *text, const struct ceduo_report *report, bool stands)
{
    const struct ceduo_scene *scene = report->result->scene;
    struct row row = {.text = text};
    for (size_t i = 0; i < scene->options_count; i++) {
        size_t n = stands ? scene->options[i].belts_count : scene->controls_count;
        for (size_t k = 0; k < n; k++)
            if (stands)
                stand_row(&row, report, i, k);
            else if (!report->years)
                control_row(&row, report, i, k, NULL);
        for (size_t y = 0; report->years && !stands && y < report->years[i]->count; y++)
            for (size_t k = 0; k < n; k++)
                control_row(&row, report, i, k, &report->years[i]->years[y]);
    }
}
