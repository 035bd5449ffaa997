/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a search found, in sentences. */
#include <math.h>

#include "base/language.h"
#include "report.h"

static void put_value(struct text *text, double value)
{
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_put(text, ceduo_number_shortest(value, room));
}

static void put_goal(struct text *text, enum ceduo_goal goal, double value)
{
    ceduo_text_format(text, "%s ", _(ceduo_goals[goal].name));
    if (ceduo_goal_is_share(goal))
        ceduo_text_format(text, "%.3g %%", value * 100);
    else if (isinf(value))
        ceduo_text_put(text, _("without end"));
    else
        ceduo_text_format(text, "%.4g %s", value, ceduo_goals[goal].unit);
}

static void put_found(struct text *text, const struct ceduo_search *s, const struct ceduo_found *f)
{
    ceduo_text_safe(text, s->path);
    ceduo_text_put(text, " = ");
    put_value(text, f->value);
    ceduo_text_put(text, "\n  ");
    ceduo_text_put(text, f->whole_range              ? _("every value of the range reaches the goal: ")
                         : f->side == CEDUO_SMALLEST ? _("the smallest value that reaches the goal: ")
                                                     : _("the largest value that reaches the goal: "));
    put_goal(text, s->goal, f->goal_at_value);
}

static void put_none(struct text *text, const struct ceduo_search *s, const struct ceduo_found *f)
{
    struct text path = {0};
    ceduo_text_safe(&path, s->path);
    ceduo_text_format(text, _("no value of %s from "), ceduo_text_string(&path));
    text->failed |= path.failed;
    ceduo_text_free(&path);
    put_value(text, s->lo);
    ceduo_text_put(text, _(" to "));
    put_value(text, s->hi);
    ceduo_text_put(text, _(" reaches the goal"));
    if (isnan(f->nearest))
        return;
    ceduo_text_put(text, _("\n  nearest: "));
    put_value(text, f->nearest);
    ceduo_text_put(text, ", ");
    put_goal(text, s->goal, f->goal_at_nearest);
}

void ceduo_find_page(struct text *text, const struct ceduo_find_report *report)
{
    const struct ceduo_search *s = report->search;
    const struct ceduo_goal_row *goal = &ceduo_goals[s->goal];
    (report->found->found ? put_found : put_none)(text, s, report->found);
    ceduo_text_put(text, goal->below ? _(" (below ") : _(" (at most "));
    ceduo_text_format(text, "%g %s", ceduo_goal_is_share(s->goal) ? s->target * 100 : s->target, goal->unit);
    ceduo_text_put(text, _(" is wanted), option '"));
    ceduo_text_safe(text, report->file->scene.options[s->option].name);
    ceduo_text_put(text, !s->rotation                  ? _("', worst control\n")
                         : ceduo_goal_is_mean(s->goal) ? _("', worst control, in the mean of one whole rotation\n")
                                                        : _("', worst control, in the worst year of one whole rotation\n"));
    if (report->yield && !isnan(report->yield->cut_per_year))
        ceduo_text_format(text, _("  yield: %.3g m\xc2\xb3 felled per hectare and year, %.3g m\xc2\xb3 standing per hectare\n"),
                          report->yield->cut_per_year, report->yield->standing);
    if (!report->found->monotone)
        ceduo_text_put(text, _("  ! The goal does not only rise or only fall over this range: there may be other values.\n"));
}
