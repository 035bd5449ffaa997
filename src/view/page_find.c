/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a search found, in sentences. */
#include <math.h>

#include "base/language.h"
#include "report.h"
#include "typed.h"

static void append_goal(struct text *text, enum ceduo_goal goal, double value, double target)
{
    ceduo_text_format(text, "%s ", _(ceduo_goals[goal].name));
    if (ceduo_goal_is_share(goal))
        ceduo_text_format(text, "%s %%", BESIDE(value * 100, 3, target * 100));
    else if (isinf(value))
        ceduo_text_append(text, _("without end"));
    else
        ceduo_text_format(text, "%s %s", BESIDE(value, 4, target), ceduo_goals[goal].unit);
}

/* With four digits, on the side that reaches the goal; JSON has them all. */
static double shown(const struct ceduo_search *s, const struct ceduo_found *f)
{
    double scale = pow(10, fmax(0, 3 - floor(log10(fabs(f->value)))));
    if (f->whole_range || !isfinite(scale) || f->value == floor(f->value))
        return f->value;
    return f->side == CEDUO_SMALLEST ? fmin(s->hi, ceil(f->value * scale) / scale)
                                     : fmax(s->lo, floor(f->value * scale) / scale);
}

void ceduo_find_reliable(struct text *text, const struct ceduo_search *s, const struct ceduo_reliability *sure,
                         const struct field *field)
{
    const struct ceduo_found *f = &sure->found;
    char room[CEDUO_NUMBER_ROOM], from[CEDUO_NUMBER_ROOM], to[CEDUO_NUMBER_ROOM];
    double wanted = sure->sure * 100, reached = sure->share.value * 100, error = 196 * sure->share.se;
    if (sure->inputs == 0)
        ceduo_text_append(text, _("no other input is uncertain: the result holds if the scene does"));
    else if (!f->found)
        ceduo_text_format(text, _("no value holds in %g %% of plausible cases; nearest: %s, in %.0f %% (\xc2\xb1%.0f)"), wanted,
                          ceduo_shown_number(field, f->nearest, room), reached, error);
    else if (f->whole_range)
        ceduo_text_format(text, _("every value of the range holds in %g %% of plausible cases"), wanted);
    else
        ceduo_text_format(text,
                          isnan(sure->lo) ? _("in %g %% of plausible cases: %s (reaches the goal in %.0f %%, \xc2\xb1%.0f)")
                                          : _("in %g %% of plausible cases: %s (reaches the goal in %.0f %%, \xc2\xb1%.0f; "
                                              "with this error the value is %s to %s)"),
                          wanted, ceduo_shown_number(field, shown(s, f), room), reached, error,
                          ceduo_shown_number(field, sure->lo, from), ceduo_shown_number(field, sure->hi, to));
}

void ceduo_find_words(struct text *text, const struct ceduo_search *s, const struct ceduo_found *f, const struct field *field,
                      bool wanted)
{
    char room[CEDUO_NUMBER_ROOM], most[CEDUO_NUMBER_ROOM];
    const struct ceduo_goal_row *row = &ceduo_goals[s->goal];
    LOCAL_TEXT(goal);
    append_goal(&goal, s->goal, f->found ? f->goal_at_value : f->goal_at_nearest, s->target);
    if (f->found)
        ceduo_text_format(text,
                          f->whole_range              ? _("every value of the range reaches the goal: %s")
                          : f->side == CEDUO_SMALLEST ? _("the smallest value that reaches the goal: %s")
                                                      : _("the largest value that reaches the goal: %s"),
                          goal.bytes);
    else
        ceduo_text_format(text, _("no value from %s to %s reaches the goal"), ceduo_shown_number(field, s->lo, room),
                          ceduo_shown_number(field, s->hi, most));
    if (!f->found && !isnan(f->nearest))
        ceduo_text_append_joined(text, "; ", _("nearest: %s, %s"), ceduo_shown_number(field, f->nearest, room), goal.bytes);
    if (wanted)
        ceduo_text_append_joined(text, " ", row->below ? _("(below %g %s is wanted)") : _("(at most %g %s is wanted)"),
                                 ceduo_goal_is_share(s->goal) ? s->target * 100 : s->target, row->unit);
}

void ceduo_page_find(struct text *text, const struct ceduo_find_report *report)
{
    char room[CEDUO_NUMBER_ROOM];
    const struct ceduo_search *s = report->search;
    const struct ceduo_found *f = report->found;
    LOCAL_TEXT(option);
    ceduo_text_append_escaped(text, s->path);
    if (f->found)
        ceduo_text_format(text, " = %s\n  ", ceduo_number_shortest(shown(s, f), room));
    else
        ceduo_text_append(text, ": ");
    ceduo_find_words(text, s, f, NULL, true);
    ceduo_text_append_escaped(&option, report->file->scene.options[s->option].name);
    ceduo_text_append_joined(text, ", ", _("option '%s', %s"), ceduo_text_string(&option),
                             !s->rotation                  ? _("worst control")
                             : ceduo_goal_is_mean(s->goal) ? _("worst control, in the mean of the years ahead")
                                                           : _("worst control, in the worst of the years ahead"));
    ceduo_text_char(text, '\n');
    if (report->yield && !isnan(report->yield->cut_per_year)) {
        ceduo_text_append_joined(text, "  ",
                                 _("yield: %.3g m\xc2\xb3 felled per hectare and year, %.3g m\xc2\xb3 standing per hectare"),
                                 report->yield->cut_per_year, report->yield->standing);
        if (!report->yield_depends)
            ceduo_text_append_joined(text, "; ", "%s", _("the same for every value of the range"));
        ceduo_text_char(text, '\n');
    }
    if (s->sure > 0) {
        ceduo_text_append(text, "  ");
        ceduo_find_reliable(text, s, report->sure, NULL);
        ceduo_text_char(text, '\n');
    }
    if (!f->monotone)
        ceduo_text_append_joined(text, "  ! ", "%s\n", _("not monotone: there may be other values"));
}
