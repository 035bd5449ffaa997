/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What people call what was fitted and what it was fitted to; and the draws. */
#include "report_calibration.h"

#include <math.h>
#include <string.h>

#include "base/language.h"
#include "words.h"

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
    ceduo_text_format(text, "; %s 95 %% %s\xe2\x80\x93%s", r->fields[i]->key, WRITTEN(f->p2_5, 3), WRITTEN(f->p97_5, 3));
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

void ceduo_calibration_draws(struct text *text, const struct ceduo_calibration *a, const char *const *heads)
{
    for (size_t i = 0; i < a->parameters_count; i++) {
        ceduo_text_put(text, i > 0 ? "," : "");
        ceduo_text_csv(text, heads[i]);
    }
    ceduo_text_char(text, '\n');
    for (size_t k = 0; k < a->draws_count; k++) {
        for (size_t i = 0; i < a->parameters_count; i++)
            ceduo_text_format(text, "%s%s", i > 0 ? "," : "", SHORTEST(a->draws[k * a->parameters_count + i]));
        ceduo_text_char(text, '\n');
    }
}
