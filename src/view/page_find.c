/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Result of a search as sentences. */
#include <math.h>

#include "base/language.h"
#include "report.h"
#include "value_text.h"

static void append_goal(struct text *text, enum ceduo_goal goal, double value, double target)
{
    ceduo_text_format(text, "%s ", _(ceduo_goals[goal].name));
    if (ceduo_goal_is_share(goal))
        ceduo_text_format(text, "%s %%", VS_LIMIT(value * 100, 3, target * 100));
    else if (isinf(value))
        ceduo_text_append(text, _("without end"));
    else
        ceduo_text_format(text, "%s %s", VS_LIMIT(value, 4, target), ceduo_goals[goal].unit);
}

/* Round to four digits, on the side that reaches the goal; JSON has all digits. */
static double round_to_goal(const struct ceduo_search *s, const struct ceduo_found *f)
{
    double scale = pow(10, fmax(0, 3 - floor(log10(fabs(f->value)))));
    if (f->whole_range || !isfinite(scale) || f->value == floor(f->value))
        return f->value;
    return f->side == CEDUO_SIDE_SMALLEST ? fmin(s->hi, ceil(f->value * scale) / scale)
                                          : fmax(s->lo, floor(f->value * scale) / scale);
}

void ceduo_find_reliable(struct text *text, const struct ceduo_search *s, const struct ceduo_reliability *reliability,
                         const struct field *field)
{
    const struct ceduo_found *f = &reliability->found;
    char buffer[CEDUO_NUMBER_SIZE], from[CEDUO_NUMBER_SIZE], to[CEDUO_NUMBER_SIZE];
    double percent = reliability->sure * 100, reached = reliability->share.value * 100, error = 196 * reliability->share.se;
    if (reliability->inputs == 0)
        ceduo_text_append(text, _("no other input is uncertain: the result holds if the scene is right"));
    else if (!f->found)
        ceduo_text_format(text, _("no value holds in %g %% of plausible cases; nearest: %s, in %.0f %% (\xc2\xb1%.0f)"),
                          percent, ceduo_format_number(field, f->nearest, buffer), reached, error);
    else if (f->whole_range)
        ceduo_text_format(text, _("every value of the range holds in %g %% of plausible cases"), percent);
    else
        ceduo_text_format(text,
                          isnan(reliability->lo)
                              ? _("in %g %% of plausible cases: %s (reaches the goal in %.0f %%, \xc2\xb1%.0f)")
                              : _("in %g %% of plausible cases: %s (reaches the goal in %.0f %%, \xc2\xb1%.0f; "
                                  "with this error the value is %s to %s)"),
                          percent, ceduo_format_number(field, round_to_goal(s, f), buffer), reached, error,
                          ceduo_format_number(field, reliability->lo, from), ceduo_format_number(field, reliability->hi, to));
}

void ceduo_find_words(struct text *text, const struct ceduo_search *s, const struct ceduo_found *f, const struct field *field,
                      bool limit_wanted)
{
    char buffer[CEDUO_NUMBER_SIZE], hi[CEDUO_NUMBER_SIZE];
    const struct ceduo_goal_row *row = &ceduo_goals[s->goal];
    LOCAL_TEXT(goal);
    append_goal(&goal, s->goal, f->found ? f->goal_at_value : f->goal_at_nearest, s->target);
    if (f->found)
        ceduo_text_format(text,
                          f->whole_range                   ? _("every value of the range reaches the goal: %s")
                          : f->side == CEDUO_SIDE_SMALLEST ? _("the smallest value that reaches the goal: %s")
                                                           : _("the largest value that reaches the goal: %s"),
                          goal.bytes);
    else
        ceduo_text_format(text, _("no value from %s to %s reaches the goal"), ceduo_format_number(field, s->lo, buffer),
                          ceduo_format_number(field, s->hi, hi));
    if (!f->found && !isnan(f->nearest))
        ceduo_text_append_joined(text, "; ", _("nearest: %s, %s"), ceduo_format_number(field, f->nearest, buffer), goal.bytes);
    if (limit_wanted)
        ceduo_text_append_joined(text, " ", row->below ? _("(goal: below %g %s)") : _("(goal: at most %g %s)"),
                                 ceduo_goal_is_share(s->goal) ? s->target * 100 : s->target, row->unit);
}

void ceduo_page_find(struct text *text, const struct ceduo_find_report *report)
{
    char buffer[CEDUO_NUMBER_SIZE];
    const struct ceduo_search *s = report->search;
    const struct ceduo_found *f = report->found;
    LOCAL_TEXT(option);
    ceduo_text_append_escaped(text, s->path);
    if (f->found)
        ceduo_text_format(text, " = %s\n  ", ceduo_number_shortest(round_to_goal(s, f), buffer));
    else
        ceduo_text_append(text, ": ");
    ceduo_find_words(text, s, f, NULL, true);
    ceduo_text_append_escaped(&option, report->file->scene.options[s->option].name);
    ceduo_text_append_joined(text, ", ", _("option '%s', %s"), ceduo_text_string(&option),
                             !s->rotation                  ? _("worst control")
                             : ceduo_goal_is_mean(s->goal) ? _("worst control, in the mean of the years ahead")
                                                           : _("worst control, in the worst of the years ahead"));
    ceduo_text_append_char(text, '\n');
    if (report->yield && !isnan(report->yield->cut_per_year)) {
        ceduo_text_append_joined(text, "  ",
                                 _("yield: %.3g m\xc2\xb3 felled per hectare and year, %.3g m\xc2\xb3 standing per hectare"),
                                 report->yield->cut_per_year, report->yield->standing);
        if (!report->yield_depends)
            ceduo_text_append_joined(text, "; ", "%s", _("the same for every value of the range"));
        ceduo_text_append_char(text, '\n');
    }
    if (s->sure > 0) {
        ceduo_text_append(text, "  ");
        ceduo_find_reliable(text, s, report->reliability, NULL);
        ceduo_text_append_char(text, '\n');
    }
    if (!f->monotone)
        ceduo_text_append_joined(text, "  ! ", "%s\n", _("not monotone: there may be other values"));
}
