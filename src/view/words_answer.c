/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judgement of a control, with the reason. */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "base/utf8.h"
#include "core/runs/assess.h"
#include "plot.h"
#include "report.h"
#include "scene/derived.h"
#include "scene/slope.h"
#include "words.h"

/* Word in files, text for people, and light of each judgement. */
static const struct {
    const char *word, *verdict;
    enum ceduo_light light;
} judgements[] = {[CEDUO_JUDGEMENT_UNANSWERED] = {NULL, NULL, CEDUO_LIGHT_UNKNOWN},
                  [CEDUO_JUDGEMENT_YES] = {"yes", N_("YES"), CEDUO_LIGHT_PASS},
                  [CEDUO_JUDGEMENT_NO] = {"no", N_("NO"), CEDUO_LIGHT_FAIL},
                  [CEDUO_JUDGEMENT_NOT_DECIDED] = {"not-decided", N_("NOT DECIDED"), CEDUO_LIGHT_UNKNOWN},
                  [CEDUO_JUDGEMENT_DEPENDS] = {"depends", N_("IT DEPENDS"), CEDUO_LIGHT_UNKNOWN},
                  [CEDUO_JUDGEMENT_CANNOT_JUDGE] = {"nothing", N_("CANNOT BE ASSESSED"), CEDUO_LIGHT_UNKNOWN}};

const char *ceduo_words_judgement(enum ceduo_judgement judgement)
{
    return judgements[judgement].word;
}

/* ---- cannot be judged ---- */

/* Append why a control contradicts its terrain (CEDUO_TERRAIN_CONTRADICTS): its angle, the usual one, and what to check. */
static void append_contradiction(struct text *text, const struct ceduo_arrivals *bare)
{
    double reach = ceduo_topography_find(bare)->reach * DEGREES, shadow = ceduo_topography_find(bare)->shadow * DEGREES;
    if (shadow > CEDUO_SHADOW_STEEP)
        ceduo_text_append_joined(
            text, " ",
            _("But it lies under a shadow angle of %.1f\xc2\xb0 (from the foot of the face), and rocks usually reach "
              "places under more than %.0f\xc2\xb0."),
            shadow, CEDUO_SHADOW_STEEP);
    else
        ceduo_text_append_joined(
            text, " ",
            _("But it lies under a reach angle of %.1f\xc2\xb0 (from the release), and rocks usually reach places "
              "under more than %.0f\xc2\xb0."),
            reach, CEDUO_REACH_STEEP);
    ceduo_text_append_joined(text, " ", "%s",
                             _("Check roughness and friction of the ground, the law of impact and the profile."));
}

/* Append "none of 999 rocks arrives, even without forest". */
static void append_arrivals(struct text *text, const struct ceduo_arrivals *bare)
{
    unsigned long long released = (unsigned long long)ceduo_rocks_released(bare),
                       n = (unsigned long long)ceduo_rocks_reached(bare);
    if (n == 0)
        ceduo_text_format(text, _("none of %llu rocks arrives, even without forest"), released);
    else
        ceduo_text_format(text,
                          ngettext("only %llu of %llu rocks arrives, even without forest",
                                   "only %llu of %llu rocks arrive, even without forest", (unsigned long)n),
                          n, released);
}

void ceduo_words_too_few_arrivals(struct text *text, const struct ceduo_result *r, size_t control)
{
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control];
    LOCAL_TEXT(place_name);
    ceduo_words_place(&place_name, &r->scene->controls[control]);
    ceduo_text_format(text, _("The forest above %s cannot be assessed: "), ceduo_text_string(&place_name));
    append_arrivals(text, bare);
    ceduo_text_append_char(text, '.');
    /* start and reach of the rocks without forest */
    const struct ceduo_slope *s = &r->scene->slope;
    double start = r->scene->release.x.mean, falls = atan(ceduo_slope_fall(s, start)) * 180 / M_PI;
    double farthest = r->bare.ends.stop_max, distance = farthest - start; /* NaN: no rock stops */
    double face = ceduo_slope_face(s);
    ceduo_text_append_joined(text, " ",
                             falls < 0 ? _("They start at %.10g m, where the ground rises by %.0f\xc2\xb0.")
                                       : _("They start at %.10g m, where the ground falls by %.0f\xc2\xb0."),
                             start + s->origin_x, fabs(falls));
    if (r->scene->release.x_assumed)
        ceduo_text_append_joined(text, " ", "%s", _("That is where the profile begins: release.x_m is not given."));
    if (distance < 0.05)
        ceduo_text_append_joined(text, " ", "%s", _("They do not move from there."));
    else if (!isnan(distance))
        ceduo_text_append_joined(text, " ", _("They come to rest within %s m of it."), SIG(distance, 2));
    if (falls < 0)
        ceduo_text_append_joined(text, " ", "%s", _("The profile may have been drawn upward."));
    /* remedy: an unreached face is probably the release area */
    if (face > start && !(farthest > face))
        ceduo_text_append_joined(
            text, " ",
            _("The ground is steeper than 45\xc2\xb0 from %.10g m on: if they start there, write release.x_m: %.10g."),
            face + s->origin_x, face + s->origin_x);
    else if (ceduo_terrain(bare) == CEDUO_TERRAIN_CONTRADICTS)
        append_contradiction(text, bare);
    else if (!(farthest > s->x[ceduo_slope_segment(s, start) + 1]))
        ceduo_text_append_joined(
            text, " ", "%s",
            _("Write where they start (release.x_m), or what sets them in motion (release.height_m, vx_m_s)."));
    else
        ceduo_text_append_joined(text, " ", "%s", _("If release and ground are right, rocks do not reach this place."));
}

void ceduo_words_warn_no_answer(const struct ceduo_result *r, ceduo_sentence_sink *sink, void *context)
{
    for (size_t c = 0; c < r->scene->controls_count; c++) {
        LOCAL_TEXT(sentence);
        if (!ceduo_too_few_arrivals(&r->bare.arrivals[c]))
            continue;
        ceduo_words_too_few_arrivals(&sentence, r, c);
        sink(context, ceduo_text_string(&sentence));
        return; /* controls farther down are not reached either */
    }
}

/* ---- reason ---- */

void ceduo_words_judgement_reason(struct text *text, const struct ceduo_result *r, size_t control,
                                  const struct ceduo_arrivals *wooded)
{
    const struct ceduo_control *c = &r->scene->controls[control];
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control];
    enum ceduo_judgement judgement = ceduo_judge_control(bare, wooded);
    bool also_bare = ceduo_judge_control(bare, NULL) == CEDUO_JUDGEMENT_YES;
    if (judgement == CEDUO_JUDGEMENT_CANNOT_JUDGE) {
        ceduo_words_too_few_arrivals(text, r, control);
        return;
    }
    if (judgement == CEDUO_JUDGEMENT_UNANSWERED) {
        ceduo_text_append(text, isnan(c->accepted) ? _("No accepted energy is set (accepted_kJ).")
                                : !r->wooded       ? _("With contact_model: index no rocks are simulated through the forest.")
                                                   : _("Not computed yet."));
        return;
    }
    const struct ceduo_arrivals *shown = wooded ? wooded : bare;
    if (r->scene->blocks_count > 0)
        ceduo_text_format(text, _("A rock with more than %s kJ arrives every %s years (one in %s years is accepted)."),
                          LOCALIZED(ceduo_words_accepted(c)), RETURN_PERIOD_RANGE(ceduo_judged_rate(shown)),
                          LOCALIZED(ceduo_accepted_return(c)));
    else
        ceduo_text_format(text, _("%s of 1000 arrive with more than %g kJ (%.0f are allowed)."),
                          INTERVAL(ceduo_measure_exceeding(c, shown)), ceduo_words_accepted(c), CEDUO_EXCEED_MAX * 1000);
    if (ceduo_energy_light(shown) == CEDUO_LIGHT_UNKNOWN)
        ceduo_text_append_joined(text, " ", _("%llu rocks were still moving when the simulation stopped; they may arrive."),
                                 (unsigned long long)ceduo_rocks_unfinished(shown));
    else if (judgement == CEDUO_JUDGEMENT_NOT_DECIDED)
        ceduo_text_append_joined(text, " ",
                                 ngettext("%lu rock is too few to decide; simulate more.",
                                          "%lu rocks are too few to decide; simulate more.",
                                          (unsigned long)ceduo_rocks_released(shown)),
                                 (unsigned long)ceduo_rocks_released(shown));
    else if (also_bare)
        ceduo_text_append_joined(text, " ", "%s", _("The slope meets the limit even without forest."));
}

/* ---- single line ---- */

struct ceduo_outcome ceduo_report_outcome(const struct ceduo_report *report, size_t option, size_t control)
{
    return ceduo_outcome_compute(report->result, report->verdict, report->uncertainty ? report->uncertainty->answer : NULL,
                                 option, control);
}

struct ceduo_subject ceduo_subject_find(const struct ceduo_report *report, size_t option, size_t control)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_verdict *v = report->verdict;
    bool forest = option < r->scene->options_count;
    struct ceduo_subject s = {.report = report,
                              .option = option,
                              .control = control,
                              .place = &r->scene->controls[control],
                              .bare = &r->bare.arrivals[control],
                              .wooded = forest ? ceduo_result_wooded(r, option, control) : &r->bare.arrivals[control],
                              .index = forest ? &r->options[option].controls[control] : NULL,
                              .choice = v && option < v->n ? &v->choices[option] : NULL};
    const struct ceduo_alternative_energy *alternative = forest ? &r->options[option].alternatives[control] : NULL;
    s.alternative = alternative && alternative->known && alternative->stems ? alternative : NULL;
    s.today = ceduo_measure_exceeding(s.place, s.wooded);
    s.mean = ceduo_measure_share(s.choice ? s.choice->mean : (struct ceduo_mean_share){NAN, NAN});
    if (forest) {
        s.outcome = ceduo_report_outcome(report, option, control);
        ceduo_measure_uncertainty(&s.today, report->uncertainty, option, control);
        ceduo_measure_mean_uncertainty(&s.mean, report->uncertainty, option);
    }
    return s;
}

struct ceduo_subject ceduo_subject_find_year(const struct ceduo_report *report, size_t option, const struct ceduo_year *year)
{
    struct ceduo_subject s = ceduo_subject_find(report, option, report->result->last_control);
    s.index = &year->controls[s.control];
    s.wooded = year->wooded.rocks > 0 ? &year->wooded.arrivals[s.control] : NULL;
    s.choice = NULL;
    s.today = ceduo_measure_exceeding(s.place, s.wooded);
    return s;
}

const char *ceduo_words_judgement_name(enum ceduo_judgement judgement)
{
    return _(judgements[judgement].verdict);
}

const char *ceduo_words_judgement_mark(enum ceduo_judgement judgement, char buffer[CEDUO_WORDS_SIZE])
{
    if (judgement != CEDUO_JUDGEMENT_UNANSWERED)
        snprintf(buffer, CEDUO_WORDS_SIZE, "%s %s", ceduo_plot_light_mark(judgements[judgement].light),
                 ceduo_words_judgement_name(judgement));
    return buffer;
}

/* From the longest to the shortest; the first that fits is used. */
enum length { FULL, LONG, MIDDLE, SHORT, BRIEF, LENGTHS };

/* Append "; today 31 (YES)". */
static void append_today(struct text *text, const struct ceduo_outcome *o, double today, bool word)
{
    ceduo_text_format(text, _("; today %.0f"), today);
    if (word && o->today != CEDUO_JUDGEMENT_UNANSWERED)
        ceduo_text_format(text, " (%s)", ceduo_words_judgement_name(o->today));
}

/* Append years above the limit: "17", or "0–12" if the answer is open. */
static void append_count(struct text *text, const struct ceduo_outcome *o)
{
    if (o->answer == CEDUO_JUDGEMENT_NO || !(o->failing_lo < o->failing_hi))
        ceduo_text_format(text, "%.0f", o->failing);
    else
        ceduo_text_format(text, "%.0f\xe2\x80\x93%.0f", o->failing_lo, o->failing_hi);
}

/* True if a cut is due and changes the answer. */
static bool is_due(const struct ceduo_subject *s)
{
    const struct ceduo_outcome *o = &s->outcome;
    return o->over_years && s->choice && s->choice->cut > 0 && o->today != o->answer && !o->impossible;
}

/* Append the years in which the limit is exceeded, and by how much. */
static void append_years(struct text *text, const struct ceduo_subject *s, enum length length)
{
    const struct ceduo_outcome *o = &s->outcome;
    const struct ceduo_years_summary *summary = &s->choice->summaries[s->control];
    const char *limit = LOCALIZED(s->today.limit);
    double accepted = 1000 * CEDUO_EXCEED_MAX, worst = 1000 * summary->worst;
    LOCAL_TEXT(count);
    append_count(&count, o);
    if (is_due(s)) {
        ceduo_text_format(text, length < BRIEF ? _("%.0f of 1000 in year %u") : _("%.0f of 1000"), worst, summary->worst_year);
        if (length < SHORT)
            ceduo_text_format(
                text, length < MIDDLE ? _(", more than %.0f of 1000 in %s of %zu years") : _(", above %.0f in %s of %zu years"),
                accepted, ceduo_text_string(&count), summary->years);
        return;
    }
    if (o->answer == CEDUO_JUDGEMENT_YES)
        ceduo_text_format(text,
                          length <= LONG     ? _("in every year of %zu at most %.0f of 1000 rocks exceed %s kJ")
                          : length == MIDDLE ? _("in every year of %zu at most %.0f of 1000 exceed %s kJ")
                                             : _("in every year of %zu at most %.0f of 1000"),
                          summary->years, worst, limit);
    else
        ceduo_text_format(text,
                          length <= LONG     ? _("in %s of %zu years more than %.0f of 1000 rocks exceed %s kJ")
                          : length == MIDDLE ? _("in %s of %zu years more than %.0f of 1000 exceed %s kJ")
                          : length == SHORT  ? _("above the limit in %s of %zu years")
                                             : _("in %s of %zu years"),
                          ceduo_text_string(&count), summary->years, accepted, limit);
    if (length == FULL && o->answer != CEDUO_JUDGEMENT_YES && !s->mean_shown)
        ceduo_text_format(text, _(": mean %.0f, worst %.0f in year %u"), 1000 * summary->exceed.mean, worst,
                          summary->worst_year);
    if (length <= SHORT && !s->mean_shown)
        append_today(text, o, s->today.value, length <= LONG || (length == SHORT && o->today != o->answer));
}

/* Append the return period and the accepted one, for scenes with blocks. */
static void append_rate(struct text *text, const struct ceduo_subject *s, enum length length)
{
    bool years_ahead = s->outcome.over_years;
    if (length <= LONG)
        ceduo_text_format(text, _("more than %s kJ every %s years"), LOCALIZED(ceduo_words_accepted(s->place)),
                          RETURN_PERIOD_RANGE(s->outcome.rate));
    else
        ceduo_text_format(text, _("every %s years"), RETURN_PERIOD_RANGE(s->outcome.rate));
    if (length <= MIDDLE)
        ceduo_text_format(text, _(" (accepted: %s)"), LOCALIZED(ceduo_accepted_return(s->place)));
    if (length == FULL && years_ahead)
        ceduo_text_format(text, _(", mean of %zu years"), s->choice->summaries[s->control].years);
    if (length <= SHORT && years_ahead && s->wooded)
        ceduo_text_format(text, _("; today every %s"), RETURN_PERIOD(ceduo_judged_rate(s->wooded)));
}

/* Append "479 of 1000 arrive with more than 50 kJ (at most 50 rocks are accepted); may be 234–748". */
static void append_shares(struct text *text, const struct ceduo_measure *m, const struct ceduo_measure *bare,
                          enum length length)
{
    if (length == BRIEF) {
        ceduo_text_format(text, _("%.0f of 1000"), m->value);
        return;
    }
    ceduo_text_format(text, _("%s of 1000 %s"), MEASURE_VALUE(*m),
                      MEASURE_NAME(*m, length <= LONG ? CEDUO_PHRASE : CEDUO_SHORT_HEAD));
    if (length == FULL && m->limit > 0)
        ceduo_text_format(text, _(" (at most %.0f rocks accepted)"), 1000 * CEDUO_EXCEED_MAX);
    else if (length == FULL && bare)
        ceduo_text_format(text, _(" (%.0f without forest)"), bare->value);
    bool uncertain = !isnan(m->p5);
    if (length > MIDDLE)
        return;
    ceduo_text_format(text, uncertain ? _("; range %s") : _("; %s by sampling error"),
                      uncertain ? PLAUSIBLE_RANGE(*m) : SPAN(*m, m->lo, m->hi));
}

/* Append the reason in at most `width` columns; nothing if no form fits. */
static void append_reason(struct text *text, const struct ceduo_subject *s, size_t width)
{
    const struct ceduo_scene *scene = s->report->result->scene;
    const struct ceduo_outcome *o = &s->outcome;
    const struct ceduo_measure bare = ceduo_measure_exceeding(s->place, s->bare);
    const char *remaining = SIG(s->index->residual * J_TO_KJ, 3),
               *mean = SIG(ceduo_measure_figure(CEDUO_MEAN_KJ, s->bare).value, 3);
    for (enum length i = FULL; i < LENGTHS; i++) {
        ceduo_text_free(text);
        if (o->impossible)
            ceduo_text_append(text,
                              i < BRIEF ? _("more stems than a forest can hold: check the stand") : _("impossible stand"));
        else if (o->answer == CEDUO_JUDGEMENT_CANNOT_JUDGE)
            append_arrivals(text, s->bare);
        else if (!s->wooded && s->report->result->wooded)
            ceduo_text_append(text, _("not computed yet"));
        else if (!s->wooded && o->answer != CEDUO_JUDGEMENT_YES)
            ceduo_text_format(
                text, i == FULL ? _("by the index %s of %s kJ remain on average") : _("by the index %s of %s kJ remain"),
                remaining, mean);
        else if (scene->blocks_count > 0 && !isnan(o->rate.mean))
            append_rate(text, s, i);
        else if (o->answer == CEDUO_JUDGEMENT_YES && o->also_bare)
            append_shares(text, &bare, NULL, i);
        else if (o->over_years && o->answer != CEDUO_JUDGEMENT_UNANSWERED)
            append_years(text, s, i);
        else
            append_shares(text, s->wooded ? &s->today : &bare, ceduo_plot_has_stems(&scene->options[s->option]) ? &bare : NULL,
                          i);
        if (ceduo_utf8_width(text->bytes) <= width)
            return;
    }
    ceduo_text_free(text);
}

void ceduo_words_reason(struct text *text, const struct ceduo_subject *s)
{
    LOCAL_TEXT(reason);
    append_reason(&reason, s, SIZE_MAX);
    ceduo_text_format(text, "%s.", ceduo_text_string(&reason));
}

void ceduo_words_answer(struct text *text, const struct ceduo_subject *s, size_t width)
{
    const struct ceduo_outcome *o = &s->outcome;
    LOCAL_TEXT(verdict);
    LOCAL_TEXT(reason);
    LOCAL_TEXT(name);
    LOCAL_TEXT(place);
    if (is_due(s)) /* "✔ YES today; ✘ NO after the cut" */
        ceduo_text_format(&verdict, _("%s today; %s after the cut"), JUDGEMENT_MARK(o->today), JUDGEMENT_MARK(o->answer));
    else
        ceduo_text_append(&verdict, JUDGEMENT_MARK(o->answer));
    if (s->preliminary)
        ceduo_text_append(&verdict, _(" so far"));
    if (o->answer == CEDUO_JUDGEMENT_YES && o->also_bare)
        ceduo_text_append(&verdict, _(", also without forest"));
    size_t taken = verdict.length > 0 ? ceduo_utf8_width(verdict.bytes) + 2 : 0;
    if (s->report->result->scene->controls_count > 1) { /* name the control */
        ceduo_words_place(&name, s->place);
        ceduo_text_append_escaped(&place, ceduo_text_string(&name)); /* as wide as printed */
        ceduo_text_append(&place, ": ");
        if (ceduo_utf8_width(place.bytes) + taken <= width) {
            ceduo_text_append(text, place.bytes);
            taken += ceduo_utf8_width(place.bytes);
        }
    }
    append_reason(&reason, s, width > taken ? width - taken : 0);
    ceduo_text_append(text, ceduo_text_string(&verdict));
    if (reason.length > 0)
        ceduo_text_format(text, "%s%s", verdict.length > 0 ? ": " : "", reason.bytes);
}
