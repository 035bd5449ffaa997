/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of a result, of its years and of a search. */
#include "core/runs/result.h"
#include "core/runs/statistics.h"
#include "core/runs/year_runs.h"
#include "figures_parts.h"
#include "scene/derived.h"

#include "scene/choices.h"

/* ---- values ---- */

READ(light_at, enum ceduo_light, TEXT, WORD(ceduo_words_light(m)))
READ(energy_model_at, enum ceduo_energy_model, TEXT, WORD(ceduo_energy_words.names[m]))
#define LIGHT(member) .value = light_at, .offset = offsetof(struct ceduo_index, member)

/* ---- objects of a place ---- */

static const struct ceduo_result *get_result(const struct ceduo_place *p)
{
    return p->report->result;
}

/* Return the option today, or in the year of the place. */
static const struct ceduo_option *get_forest(const struct ceduo_place *p)
{
    return p->year ? &p->year->option : &get_result(p)->scene->options[p->option];
}

static const struct ceduo_index *get_indices(const struct ceduo_place *p)
{
    return p->year ? p->year->controls : get_result(p)->options[p->option].controls;
}

static const struct ceduo_simulated *get_wooded_run(const struct ceduo_place *p)
{
    return p->year && p->year->wooded.rocks > 0 ? &p->year->wooded : &get_result(p)->options[p->option].wooded;
}

static const struct ceduo_arrivals *get_wooded_arrivals(const struct ceduo_place *p)
{
    if (!p->year)
        return ceduo_result_wooded(get_result(p), p->option, p->control);
    return p->year->wooded.rocks > 0 ? &p->year->wooded.arrivals[p->control] : NULL;
}

/* Return the result by the other law, today only; NULL if no stem stands. */
static const struct ceduo_alternative_energy *find_alternative(const struct ceduo_place *p)
{
    const struct ceduo_alternative_energy *alternative = &get_result(p)->options[p->option].alternatives[p->control];
    return !p->year && alternative->known && alternative->stems ? alternative : NULL;
}

/* NULL if growth or cuts are unknown. */
static const struct ceduo_yield *find_yield(const struct ceduo_place *p)
{
    const struct ceduo_verdict *v = p->report->verdict;
    const struct ceduo_yield *yield = v ? &v->choices[p->option].yield : NULL;
    return yield && !isnan(yield->cut_per_year) ? yield : NULL;
}

/* NULL if the window is only today, or if its years were not simulated. */
static const struct ceduo_choice *find_years_ahead(const struct ceduo_place *p)
{
    const struct ceduo_choice *c = ceduo_report_years_ahead(p->report, p->option);
    return c && c->last_summary->simulated > 0 ? c : NULL;
}

static const struct ceduo_stand_result *get_stand_result(const struct ceduo_place *p)
{
    return &(p->year ? p->year->stands : get_result(p)->options[p->option].stands)[p->belt];
}

OBJECT(get_report, place, o->report)
OBJECT(get_scene, place, get_result(o)->scene)
OBJECT(get_rock, place, &get_result(o)->rock)
OBJECT(get_slope, place, &get_result(o)->scene->slope)
OBJECT(get_year, place, o->year)
OBJECT(get_option, place, &get_result(o)->scene->options[o->option])
OBJECT(get_first, place, &get_result(o)->scene->options[0])
OBJECT(get_belt, place, &get_forest(o)->belts[o->belt])
OBJECT(get_stand, place, get_stand_result(o))
OBJECT(get_rules, place, get_stand_result(o)->rules.regulation ? &get_stand_result(o)->rules : NULL)
OBJECT(get_control, place, &get_result(o)->scene->controls[o->control])
OBJECT(get_fence, place, ceduo_fence_stands(&get_result(o)->scene->controls[o->control].fence) ? o : NULL)
OBJECT(get_fence_years, place, o->year ? NULL : ceduo_report_fence_years(o->report, o->option, o->control))
OBJECT(get_designs, place, o->designed ? &o->designs : NULL)
OBJECT(get_fenced, arrivals, ceduo_fence_find(o))
OBJECT(get_smallest, fence_arrivals, ceduo_fence_smallest(o->enough))
OBJECT(get_smallest_of_years, fence_years, ceduo_fence_smallest(o->enough))
OBJECT(get_index, place, &get_indices(o)[o->control])
OBJECT(get_last_index, place, &get_indices(o)[get_result(o)->last_control])
OBJECT(get_bare, place, &get_result(o)->bare.arrivals[o->control])
OBJECT(get_topography, place, &get_result(o)->bare.arrivals[o->control].topography)
OBJECT(get_wooded, place, get_wooded_arrivals(o))
OBJECT(get_alt, place, find_alternative(o))
OBJECT(get_run, place, get_wooded_run(o))
OBJECT(get_stops, place, get_wooded_run(o)->ends.stop_x.n > 0 ? o : NULL)
OBJECT(get_difference, place, o->option > 0 && !o->year ? &get_result(o)->options[o->option].differences[o->control] : NULL)
OBJECT(get_yield, place, find_yield(o))
OBJECT(enter_yield, place, find_yield(o) ? o : NULL)
OBJECT(get_felling, place, &find_yield(o)->fellings[o->felling])
OBJECT(get_felled_belt, place, &get_result(o)->scene->options[o->option].belts[find_yield(o)->fellings[o->felling].belt])
OBJECT(get_rotation, place, o->report->years ? o : NULL)
OBJECT(get_window, place, find_years_ahead(o))
/* NULL as find_years_ahead(), or if the forest cannot be judged */
static const struct ceduo_years_summary *find_summary(const struct ceduo_place *p)
{
    const struct ceduo_choice *c = p->year ? NULL : find_years_ahead(p);
    return c && !c->summaries[p->control].nothing ? &c->summaries[p->control] : NULL;
}

/* NULL: not computed, or of another place than the last control */
static const struct ceduo_surface_fit *find_share_range(const struct ceduo_place *p)
{
    const struct ceduo_uncertainty_report *u = p->report->uncertainty;
    bool has = u && u->answer && !p->year && p->control == get_result(p)->last_control;
    return has ? &ceduo_uncertainty_find_figure(u->answer, p->option, CEDUO_UNCERTAINTY_EXCEED, false)->fit : NULL;
}

OBJECT(get_summary, place, find_summary(o))
OBJECT(get_share_range, place, find_share_range(o))
OBJECT(get_standards, compliance, o->standards_item)
OBJECT(get_turn, compliance, o->turn_item)
OBJECT(get_search, find_report, o->search)
OBJECT(get_found, find_report, o->found)
/* NULL: no input is uncertain */
OBJECT(get_reliability, find_report, o->reliability && o->reliability->inputs > 0 ? o->reliability : NULL)
OBJECT(get_nearest, find_report, o->found->found ? NULL : o->found)
OBJECT(get_sure_found, reliability, o->found.found ? o : NULL)
OBJECT(get_sure_nearest, reliability, o->found.found ? NULL : o)
OBJECT(get_found_yield, find_report, o->yield && !isnan(o->yield->cut_per_year) ? o->yield : NULL)
OBJECT(get_yield_report, find_report, get_found_yield(o) ? o : NULL)

/* ---- lists ---- */

static bool enter_option(struct ceduo_place *p, size_t i)
{
    p->option = i;
    bool inside = i < get_result(p)->scene->options_count;
    if (inside && p->report->years)
        p->sum = ceduo_years_summarize(p->report->years[i], get_result(p)->last_control);
    return inside;
}

ENTER(enter_belt, belt, get_forest(p)->belts_count)

static bool enter_control(struct ceduo_place *p, size_t i)
{
    p->control = i;
    bool inside = i < get_result(p)->scene->controls_count;
    if (inside)
        p->designed = ceduo_designs_compute(p->report, p->option, i, get_wooded_arrivals(p), &p->designs);
    return inside;
}

static bool enter_year(struct ceduo_place *p, size_t i)
{
    const struct ceduo_years *years = p->report->years ? p->report->years[p->option] : NULL;
    p->year = years && i < years->count ? &years->years[i] : NULL;
    return p->year != NULL;
}

/* Stop at the end of the first rotation, independently of the requested years. */
static bool enter_felling(struct ceduo_place *p, size_t i)
{
    const struct ceduo_yield *yield = find_yield(p);
    struct ceduo_window rotation = ceduo_window_compute(&get_result(p)->scene->options[p->option]);
    p->felling = i;
    return yield && i < yield->fellings_count && yield->fellings[i].year <= rotation.last + 1;
}

static bool enter_difference(struct ceduo_place *p, size_t i)
{
    size_t controls = get_result(p)->scene->controls_count;
    p->option = controls > 0 ? 1 + i / controls : SIZE_MAX;
    p->control = controls > 0 ? i % controls : 0;
    return p->option < get_result(p)->scene->options_count;
}

/* ---- sentences ---- */

static void report_run_warnings(const struct ceduo_place *p, ceduo_sentence_sink *sink, void *context)
{
    ceduo_words_warn_no_answer(get_result(p), sink, context);
    ceduo_words_run_warnings(get_result(p), &p->report->remarks, sink, context);
}

static void report_stand_warnings(const struct ceduo_place *p, ceduo_sentence_sink *sink, void *context)
{
    ceduo_words_stand_warnings(get_result(p)->scene, get_belt(p), get_stand(p), sink, context);
}

/* Return the judgement of a control by sampling error only; in a year by its own rocks. */
static struct ceduo_outcome judge(const struct ceduo_place *p)
{
    if (p->year) {
        enum ceduo_judgement judgement = ceduo_judge_control(&get_result(p)->bare.arrivals[p->control], get_wooded_arrivals(p));
        return (struct ceduo_outcome){.answer = judgement, .today = judgement};
    }
    return ceduo_report_outcome(p->report, p->option, p->control);
}

static void report_reason(const struct ceduo_place *p, ceduo_sentence_sink *sink, void *context)
{
    const struct ceduo_outcome o = judge(p);
    const struct ceduo_subject subject = ceduo_subject_find(p->report, p->option, p->control);
    LOCAL_TEXT(reason);
    if ((o.over_years && o.answer != CEDUO_JUDGEMENT_CANNOT_JUDGE) || o.impossible)
        ceduo_words_reason(&reason, &subject);
    else
        ceduo_words_judgement_reason(&reason, p->report->result, p->control, get_wooded_arrivals(p));
    sink(context, ceduo_text_string(&reason));
}

static void report_all_warnings(const struct ceduo_place *place, ceduo_sentence_sink *sink, void *context)
{
    struct ceduo_place p = *place;
    report_run_warnings(&p, sink, context);
    for (size_t i = 0; enter_belt(&p, i); i++)
        report_stand_warnings(&p, sink, context);
}

/* ---- computed values ---- */

VALUE(result_format, place, TEXT, WORD("ceduo-result-1"))
VALUE(result_path, report, TEXT, WORD(o->file->name))
VALUE(rocks_simulated, report, COUNT, COUNT(o->rocks_asked > 0 ? o->rocks_asked : ceduo_result_rocks(o->result)))
VALUE(points_given, slope, COUNT, COUNT(o->points > 0 ? o->points : o->vertices))
VALUE(points_used, slope, COUNT, COUNT(o->vertices))
VALUE(impact_law, scene, TEXT, WORD(ceduo_law_words.names[o->simulation.law]))
VALUE(accepted_energy, control, NUMBER, NUMBER(ceduo_words_accepted(o)))
VALUE(fence_life, control, NUMBER, NUMBER(ceduo_fence_life(&o->fence)))
VALUE(choice_class, fence_choice, COUNT, o->class_index < CEDUO_FENCE_CLASSES ? COUNT((uint64_t)o->class_index) : NO_VALUE)
VALUE(design_class, fence_design, COUNT, o->class_index >= 0 ? COUNT((uint64_t)o->class_index) : NO_VALUE)
VALUE(design_class_factored, fence_design, COUNT, o->class_factored >= 0 ? COUNT((uint64_t)o->class_factored) : NO_VALUE)
VALUE(rocks_reached, arrivals, COUNT, isnan(o->reach.mean) ? NO_VALUE : COUNT(o->reached))
VALUE(adc_rule, stand_result, TEXT, WORD(isinf(o->adc_m) ? NULL : ceduo_rule_words.names[o->rule]))
VALUE(region_name, compliance, TEXT, WORD(o->regulation->name))
VALUE(standards_met, compliance, FLAG, o->standards_item ? FLAG(o->standards_met) : NO_VALUE)
VALUE(turn_met, compliance, FLAG, o->turn_item && !isnan(o->turn) ? FLAG(o->turn_met) : NO_VALUE)
VALUE(index_per_100m, index, NUMBER, NUMBER(o->length > 0 ? o->per_100m : NAN))
VALUE(mean_adc, index, NUMBER, NUMBER(o->contacts > 0 ? o->length / o->contacts : NAN))
VALUE(passes_contact, index, FLAG, FLAG(o->contact == CEDUO_LIGHT_PASS))
VALUE(is_exhausted, index, FLAG, isnan(o->residual) ? NO_VALUE : FLAG(o->exhausted))
VALUE(difference_bound, estimate, NUMBER, NUMBER(ceduo_pairs_are_equal(o) ? o->hi : NAN))
VALUE(share_at, simulated, NUMBER, NUMBER(o->rocks > 0 ? *(const double *)get_member(f, o) : NAN))
VALUE(missed_at, arrivals, NUMBER, NUMBER(o->released > 0 ? *(const double *)get_member(f, o) : NAN))
VALUE(stop_at, place, NUMBER,
      NUMBER(*(const double *)get_member(f, &get_wooded_run(o)->ends) + o->report->file->scene.slope.origin_x))
VALUE(failing_energy_years, place, COUNT,
      o->sum.nothing || isnan(o->sum.exceed.mean) ? NO_VALUE : COUNT(o->sum.unprotected_energy))
VALUE(failing_years, place, COUNT, o->sum.nothing ? NO_VALUE : COUNT(*(const size_t *)get_member(f, o)))
VALUE(judgement_word, place, TEXT, WORD(ceduo_words_judgement(judge(o).answer)))
VALUE(judgement_today, place, TEXT, WORD(o->year ? NULL : ceduo_words_judgement(judge(o).today)))
static struct ceduo_value read_class(const struct ceduo_place *p, bool word)
{
    const char *why;
    const struct ceduo_outcome outcome = judge(p);
    const enum ceduo_class class = ceduo_outcome_classify(get_result(p), &outcome, p->control, &why);
    return !why ? NO_VALUE : word ? WORD(why) : COUNT(class);
}

VALUE(verdict_class, place, COUNT, read_class(o, false))
VALUE(verdict_why, place, TEXT, read_class(o, true))
VALUE(worst_year, years_summary, COUNT, COUNT(o->worst_year))
VALUE(worst_exceed, years_summary, NUMBER, NUMBER(isnan(o->exceed.mean) ? NAN : o->worst))
VALUE(window_lo, choice, NUMBER, NUMBER(fmax(0, o->mean.mean - o->mean.half)))
VALUE(window_hi, choice, NUMBER, NUMBER(fmin(1, o->mean.mean + o->mean.half)))
VALUE(window_worst, choice, NUMBER, NUMBER(o->worst.mean))
VALUE(window_worst_year, choice, COUNT, COUNT(o->last_summary->worst_year))
VALUE(window_failing, choice, COUNT, o->energy_known ? COUNT(o->last_summary->unprotected_energy) : NO_VALUE)
VALUE(judgement_by_alternative_law, alternative_energy, TEXT, WORD(ceduo_words_judgement(o->judgement)))
VALUE(felled_length, place, NUMBER, NUMBER(ceduo_years_felled(o->report->years[o->option])))
VALUE(find_format, find_report, TEXT, WORD("ceduo-find-1"))
VALUE(find_path, find_report, TEXT, WORD(o->file->name))
VALUE(find_option, find_report, TEXT, WORD(o->file->scene.options[o->search->option].name_given))
VALUE(goal_word, search, TEXT, WORD(ceduo_goals[o->goal].word))
VALUE(search_period, search, TEXT, WORD(o->rotation ? "rotation" : "today"))
VALUE(found_side, found, TEXT, WORD(!o->found ? NULL : o->side == CEDUO_SIDE_SMALLEST ? "smallest" : "largest"))
VALUE(reliable_side, reliability, TEXT,
      WORD(!o->found.found                        ? NULL
           : o->found.side == CEDUO_SIDE_SMALLEST ? "smallest"
                                                  : "largest"))

/* ---- the tables ---- */

#define NO_END   "too few rocks arrive to bound it"
#define NO_STEMS "no stem of the stand counts"

static const struct ceduo_figure distribution[] = {
    {"mean", "", "mean", MEMBER(distribution, mean), .null = NO_ROCK},
    {"se", "", "standard error of the mean", MEMBER(distribution, se), .null = TOO_FEW},
    {"sd", "", "standard deviation", MEMBER(distribution, sd), .null = TOO_FEW},
    {"p50", "", "median", MEMBER(distribution, p50), .null = NO_ROCK},
    {"p50_lo", "", "lower end of its 95 % interval", MEMBER(distribution, p50_lo), .null = NO_END},
    {"p50_hi", "", "upper end of its 95 % interval", MEMBER(distribution, p50_hi), .null = NO_END},
    {"p95", "", "95th percentile", MEMBER(distribution, p95), .null = NO_ROCK},
    {"p95_lo", "", "lower end of its 95 % interval", MEMBER(distribution, p95_lo), .null = NO_END},
    {"p95_hi", "", "upper end of its 95 % interval", MEMBER(distribution, p95_hi), .null = NO_END},
    {"p99", "", "99th percentile", MEMBER(distribution, p99), .null = NO_ROCK},
    {"p99_lo", "", "lower end of its 95 % interval", MEMBER(distribution, p99_lo), .null = NO_END},
    {"p99_hi", "", "upper end of its 95 % interval", MEMBER(distribution, p99_hi), .null = NO_END},
    {"max", "", "largest value", MEMBER(distribution, max), .null = NO_ROCK},
    END};

static const struct ceduo_figure paired[] = {
    {"mean", "", "mean", MEMBER(estimate, mean), .null = "it is not known, as what exceeds without accepted_kJ"},
    {"se", "", "its standard error", MEMBER(estimate, se), .null = "it is not known, as where no two rocks differ"},
    END};

#define TOO_RARE "rocks arrive less often"
#define UNBOUND  "the rocks that arrive do not bound it"
#define NEVER    "the rate is 0"

static const void *get_hazard_figures(const void *arrivals)
{
    const struct ceduo_hazard *h = &((const struct ceduo_arrivals *)arrivals)->hazard;
    return isnan(h->per_year) ? NULL : h;
}

static const void *exceed_item(const void *object, size_t i)
{
    const struct ceduo_hazard *h = object;
    return h->curve && i < h->curve->count ? &h->curve->points[i] : NULL;
}

static const void *return_item(const void *object, size_t i)
{
    return i < CEDUO_RETURNS ? &((const struct ceduo_hazard *)object)->returns[i] : NULL;
}

static const void *intensity_item(const void *object, size_t i)
{
    return i < CEDUO_INTENSITIES ? &((const struct ceduo_hazard *)object)->intensity[i] : NULL;
}

VALUE(return_years, hazard, NUMBER, NUMBER(1 / *(const double *)get_member(f, o)))

static const struct ceduo_figure rate_figures[] = {{"per_year", "1/y", "rocks a year", MEMBER(estimate, mean)},
                                                   {"lo", "1/y", "lower end of its 95 % interval", MEMBER(estimate, lo)},
                                                   {"hi", "1/y", "upper end of its 95 % interval", MEMBER(estimate, hi)},
                                                   END};

static const struct ceduo_figure exceed_rate[] = {{"energy_kJ", "kJ", "energy", MEMBER(hazard_point, energy), .scale = J_TO_KJ},
                                                  {.table = rate_figures, .offset = offsetof(struct ceduo_hazard_point, rate)},
                                                  END};

static const struct ceduo_figure returns[] = {
    {"years", "y", "return period", MEMBER(return, years)},
    {"energy_kJ", "kJ", "energy that is reached or exceeded once in this number of years", MEMBER(return, energy.mean),
     .scale = J_TO_KJ, .null = TOO_RARE},
    {"lo", "kJ", "lower end of its 95 % interval", MEMBER(return, energy.lo), .scale = J_TO_KJ, .null = UNBOUND},
    {"hi", "kJ", "upper end of its 95 % interval", MEMBER(return, energy.hi), .scale = J_TO_KJ, .null = UNBOUND},
    END};

static const struct ceduo_figure matrix[] = {
    {"intensity", "", "weak, medium or strong: below 30 kJ, 30 to 300 kJ, above 300 kJ (BAFU 2016)", MEMBER(intensity, word)},
    {"from_kJ", "kJ", "lower limit of the class", MEMBER(intensity, from), .scale = J_TO_KJ},
    {"to_kJ", "kJ", "upper limit", MEMBER(intensity, to), .scale = J_TO_KJ, .null = "there is none"},
    {.table = rate_figures, .offset = offsetof(struct ceduo_intensity, rate)},
    {"rate_left", "", "share of the rate without forest", MEMBER(intensity, remaining_share),
     .null = "none arrive without forest"},
    {"to_30_years", "", "true if the energy of 30 years is in this class: a mark of the matrix",
     MEMBER(intensity, of_return[1])},
    {"to_100_years", "", "the same of 100 years", MEMBER(intensity, of_return[2])},
    {"to_300_years", "", "the same of 300 years", MEMBER(intensity, of_return[3])},
    END};

static const struct ceduo_figure hazard_figures[] = {
    {"per_year", "1/y", "blocks that come down", MEMBER(hazard, per_year)},
    {"effective_rocks", "", "effective sample size (Kish): (sum of weights)^2/(sum of their squares)",
     MEMBER(hazard, effective)},
    {"exceed_rate", "", "rocks a year that arrive with more than an energy, up to the first energy that none exceeds",
     .table = exceed_rate, .item = exceed_item, .details = true, .null = "--details is not given"},
    {"return", "", "energies of 10, 30, 100 and 300 years", .table = returns, .item = return_item, .columns = CEDUO_RETURNS},
    {"reach_per_year", "1/y", "rocks that arrive", MEMBER(hazard, reach.mean)},
    {"reach_years", "y", "years from one that arrives to the next", .value = return_years,
     .offset = offsetof(struct ceduo_hazard, reach.mean), .null = NEVER},
    {"exceed_per_year", "1/y", "rocks that arrive with more than accepted_kJ", MEMBER(hazard, accepted.mean), .null = NO_LIMIT},
    {"accepted_years", "y", "years from one that does to the next", .value = return_years,
     .offset = offsetof(struct ceduo_hazard, accepted.mean), .null = NO_LIMIT ", or the rate is 0"},
    {"accepted_years_lo", "y", "lower end of its 95 % interval", .value = return_years,
     .offset = offsetof(struct ceduo_hazard, accepted.hi), .null = NO_LIMIT ", or no rock could have so much energy"},
    {"accepted_years_hi", "y", "upper end of its 95 % interval", .value = return_years,
     .offset = offsetof(struct ceduo_hazard, accepted.lo), .null = NO_LIMIT ", or " UNBOUND},
    {"accepted_return_y", "y", "years between two such rocks that are accepted: as in the scene, or 100",
     MEMBER(hazard, accepted_return), .null = NO_LIMIT},
    {"matrix", "", "classes of intensity, by classes of return period", .table = matrix, .item = intensity_item,
     .columns = CEDUO_INTENSITIES},
    {"rate_left", "",
     "share of the rate without forest: of what exceeds accepted_kJ, or of all that arrive where that is not "
     "given",
     MEMBER(hazard, remaining_share), .null = "it is 0 without forest"},
    END};

/* ---- fences ---- */

#define NO_CLASS  "no class is enough"
#define NO_HEIGHT "no class of any height is enough"
#define NO_BLOCKS "the scene has no blocks"
#define SHARE(key, meaning, member)                                                                                            \
    {key, "", meaning, MEMBER(fence_arrivals, member.mean)},                                                                   \
        {key "_lo", "", "lower end of its 95 % interval", MEMBER(fence_arrivals, member.lo)},                                  \
    {                                                                                                                          \
        key "_hi", "", "upper end of its 95 % interval, where an unfinished rock counts", MEMBER(fence_arrivals, member.hi)    \
    }

static const void *enough_item(const void *object, size_t i)
{
    return i < CEDUO_FENCE_HEIGHTS ? &((const struct ceduo_fence_arrivals *)object)->enough[i] : NULL;
}

static const void *enough_in_years_item(const void *object, size_t i)
{
    return i < CEDUO_FENCE_HEIGHTS ? &((const struct ceduo_fence_years *)object)->enough[i] : NULL;
}

static const struct ceduo_figure fence_choice[] = {
    {"height_m", "m", "height", MEMBER(fence_choice, height)},
    {"class", "", "smallest class of ETAG 027 that at most the share of lights.energy defeats", .value = choice_class,
     .null = NO_CLASS},
    {"energy_kJ", "kJ",
     "energy of this class; of class 8, which has no upper end, the largest energy of a rock under this height",
     MEMBER(fence_choice, energy), .scale = J_TO_KJ, .null = NO_CLASS},
    {"defeated", "", "share of the released that defeats such a fence; of class 8 if no class is enough",
     MEMBER(fence_choice, defeated)},
    {"decided", "", "whether the 95 % intervals leave the class as it is", MEMBER(fence_choice, decided)},
    END};

static const struct ceduo_figure fence_arrivals[] = {
    SHARE("over", "share of all released whose top passes above the fence", above),
    SHARE("through", "share with more energy of translation than the fence holds", through),
    SHARE("both", "share that does both", both),
    SHARE("defeated", "share that does either: over + through - both", defeated),
    SHARE("worn", "share that is held with more than a third of the energy: above the service level", worn),
    {"per_year", "1/y", "rocks a year that defeat the fence", MEMBER(fence_arrivals, per_year), .null = NO_BLOCKS},
    {"in_life", "", "chance that one does in the life of the fence", MEMBER(fence_arrivals, in_life), .null = NO_BLOCKS},
    {"enough", "", "heights of 2 to 8 m, each with the smallest class that is enough", .table = fence_choice,
     .item = enough_item, .columns = CEDUO_FENCE_HEIGHTS},
    {"smallest", "", "the smallest of these classes, and its smallest height", .from = get_smallest, .table = fence_choice,
     .null = NO_HEIGHT},
    END};

static const struct ceduo_figure fence_years[] = {
    {"mean", "", "share of the released that defeats the fence, mean of the years", MEMBER(fence_years, mean.mean)},
    {"mean_lo", "", "lower end of its interval: mean of the lower ends of the years", MEMBER(fence_years, mean.lo)},
    {"mean_hi", "", "upper end", MEMBER(fence_years, mean.hi)},
    {"worst", "", "the share of the worst year", MEMBER(fence_years, worst.mean)},
    {"worst_lo", "", "lower end of its 95 % interval", MEMBER(fence_years, worst.lo)},
    {"worst_hi", "", "upper end of its 95 % interval", MEMBER(fence_years, worst.hi)},
    {"worst_year", "y", "that year", MEMBER(fence_years, worst_year)},
    {"failing_years", "", "years in which a larger share defeats the fence than lights.energy allows",
     MEMBER(fence_years, failing)},
    {"per_year", "1/y", "rocks a year that defeat the fence, mean of the years", MEMBER(fence_years, per_year),
     .null = NO_BLOCKS},
    {"in_life", "", "chance that one does in the life of the fence", MEMBER(fence_years, in_life), .null = NO_BLOCKS},
    {"enough", "", "the same as of today, for the largest share of today and of all years", .table = fence_choice,
     .item = enough_in_years_item, .columns = CEDUO_FENCE_HEIGHTS},
    {"smallest", "", "the smallest of these classes, and its smallest height", .from = get_smallest_of_years,
     .table = fence_choice, .null = NO_HEIGHT},
    END};

#define NO_WINDOW "no option grows or is cut and no years are given, or contact_model is index"
static const struct ceduo_figure fence[] = {
    {"energy_kJ", "kJ", "as in the scene", .from = get_control, MEMBER(control, fence.energy), .scale = J_TO_KJ},
    {"height_m", "m", "as in the scene", .from = get_control, MEMBER(control, fence.height)},
    {"life_y", "y", "as in the scene, or 50", .from = get_control, .value = fence_life},
    {"window", "", "the years ahead, of this option", .from = get_fence_years, .table = fence_years,
     .null = NO_WINDOW ", or in a year of --years"},
    END};

#define NO_LOAD "fewer rocks arrive than the percentile counts"
static const struct ceduo_figure design_values[] = {
    {"speed_m_s", "m/s", "95th percentile of the speed, times survey and model", MEMBER(fence_design, speed), .null = NO_ROCK},
    {"energy_kJ", "kJ", "95th percentile of the energy of translation, times blocks and the square of survey and model",
     MEMBER(fence_design, energy), .scale = J_TO_KJ, .null = NO_ROCK},
    {"height_m", "m",
     "height of the fence: 95th percentile of the middle of the rocks and 0.5 m, or of their top if it is larger",
     MEMBER(fence_design, height), .null = NO_ROCK},
    {"class", "", "smallest class that holds energy_kJ", .value = design_class, .null = NO_LOAD},
    {"class_gamma_e", "", "smallest class that holds energy_kJ times gamma_e", .value = design_class_factored,
     .null = "design.gamma_e is not given, or " NO_LOAD},
    END};

static const struct ceduo_figure design_factors[] = {
    {"survey", "", "of the survey of the ground", MEMBER(fence_factors, survey)},
    {"model", "", "of the model: whether it is fitted to observations", MEMBER(fence_factors, model)},
    {"blocks", "", "of the survey of the blocks", MEMBER(fence_factors, blocks)},
    {"gamma_e", "", "of the energy of the fence, as in the scene", MEMBER(fence_factors, energy),
     .null = "design.gamma_e is not given"},
    END};

static const struct ceduo_figure worst_designs[] = {
    {"arrivals", "", "of the rocks that arrive", IN(designs, values[CEDUO_DESIGN_WORST_ARRIVING], design_values)},
    {"system", "", "of forest and fence as one system", IN(designs, values[CEDUO_DESIGN_WORST_SYSTEM], design_values)},
    END};

static const struct ceduo_figure designs[] = {
    {"factors", "", "partial factors of UNI 11211-4", IN(designs, factors, design_factors)},
    {"bare", "", "of the rocks that arrive without forest", IN(designs, values[CEDUO_DESIGN_BARE], design_values)},
    {"arrivals", "", "of the rocks that arrive with forest", IN(designs, values[CEDUO_DESIGN_ARRIVING], design_values)},
    {"system", "",
     "of forest and fence as one system: percentiles of the rocks that arrive without forest, where one that the forest stops "
     "counts as 0",
     IN(designs, values[CEDUO_DESIGN_SYSTEM], design_values)},
    {"worst", "", "the largest of the years ahead", .table = worst_designs},
    END};

#define MISSED(end) .value = missed_at, .offset = offsetof(struct ceduo_arrivals, missed[end])
static const struct ceduo_figure missed[] = {
    {"stopped_by_stems", "", "share of the released that stems stop before it", MISSED(CEDUO_END_STOPPED_BY_STEMS)},
    {"came_to_rest", "", "share that comes to rest before it", MISSED(CEDUO_END_AT_REST)},
    {"left_slope", "", "share that leaves the profile before it", MISSED(CEDUO_END_LEFT_SLOPE)},
    {"unfinished", "", "share that was still moving before it", MISSED(CEDUO_END_UNFINISHED)},
    END};

static const struct ceduo_figure arrivals[] = {
    {"rocks_reached", "", "rocks that reach the control", .value = rocks_reached, .null = "nothing was flown"},
    {"reach_probability", "", "share of all released that reach it; an unfinished rock counts as not reached",
     MEMBER(arrivals, reach.mean)},
    {"reach_lo", "", "lower end of its 95 % interval", MEMBER(arrivals, reach.lo)},
    {"reach_hi", "", "upper end of its 95 % interval, where an unfinished rock counts as reached", MEMBER(arrivals, reach.hi)},
    {"exceed_probability", "", "share of all released that reach it with more than accepted_kJ", MEMBER(arrivals, exceed.mean),
     .null = NO_LIMIT},
    {"exceed_lo", "", "lower end of its 95 % interval", MEMBER(arrivals, exceed.lo), .null = NO_LIMIT},
    {"exceed_hi", "", "upper end of its 95 % interval", MEMBER(arrivals, exceed.hi), .null = NO_LIMIT},
    {"speed_m_s", "m/s", "speed of the rocks that reach it", IN(arrivals, speed, distribution)},
    {"energy_kJ", "kJ", "their energy of translation and rotation", IN(arrivals, energy, distribution), .scale = J_TO_KJ},
    {"translation_kJ", "kJ", "their energy of translation alone", IN(arrivals, translation, distribution), .scale = J_TO_KJ},
    {"height_m", "m", "height of their underside above the ground", IN(arrivals, height, distribution)},
    {"energy_per_released_kJ", "kJ", "energy over all released rocks; one that does not arrive counts as 0",
     IN(arrivals, energy_per_released, paired), .scale = J_TO_KJ},
    {"fence", "", "rocks at the fence", .from = get_fenced, .table = fence_arrivals, .null = "the control has no fence"},
    {"missed", "", "ends of the released rocks that do not reach it; with reach_probability these add up to 1",
     .table = missed},
    {"hazard", "", "frequency and energy of the rocks", .from = get_hazard_figures, .table = hazard_figures,
     .null = "the scene has no blocks"},
    END};

static const struct ceduo_figure wooded[] = {
    {.table = arrivals},
    {"contacts", "", "stems hit before this control by the rocks that reach it", IN(arrivals, contacts, paired)},
    END};

static const struct ceduo_figure adc[] = {
    {"rule", "", "form that was used: gsteiger-stools, gsteiger-stems, interception or crofton", .value = adc_rule,
     .null = NO_STEMS},
    {"adc_m", "m", "ADC by that form", MEMBER(stand_result, adc_m), .null = NO_STEMS},
    {"gsteiger_stools_m", "m", "ADC by gsteiger-stools", MEMBER(stand_result, adc.gsteiger_stools), .null = NO_STEMS},
    {"gsteiger_stems_m", "m", "ADC by gsteiger-stems", MEMBER(stand_result, adc.gsteiger_stems), .null = NO_STEMS},
    {"interception_m", "m", "ADC by interception", MEMBER(stand_result, adc.interception), .null = NO_STEMS},
    {"crofton_m", "m", "ADC by crofton", MEMBER(stand_result, adc.crofton), .null = NO_STEMS},
    END};

static const struct ceduo_figure stand_result[] = {
    {"length_m", "m", "horizontal length of the belt", MEMBER(stand_result, length)},
    {"stems_per_ha", "1/ha", "stems: shoots and trees", MEMBER(stand_result, stems_per_ha)},
    {"stools_per_ha", "1/ha", "stools", MEMBER(stand_result, stools_per_ha)},
    {"trees_per_ha", "1/ha", "single trees", MEMBER(stand_result, trees_per_ha)},
    {"basal_area_m2_ha", "m2/ha", "basal area", MEMBER(stand_result, basal_area)},
    {"adc", "", "Average Distance between Contacts", .table = adc},
    {"passes_threshold", "", "true if adc.adc_m is below the threshold", MEMBER(stand_result, passes_threshold)},
    {"free_run_probability", "", "chance of running as far as the threshold inside the stand without a contact",
     MEMBER(stand_result, free_run_probability)},
    {"contacts", "", "contacts over the whole belt: length over ADC", MEMBER(stand_result, contacts)},
    {"energy_per_contact_J", "J", "energy that one contact by the index could take on average",
     MEMBER(stand_result, energy_per_contact), .null = NO_STEMS},
    {"dissipated_kJ", "kJ", "energy that the stems of the belt could take", MEMBER(stand_result, dissipated), .scale = J_TO_KJ},
    {"dissipated_kJ_per_100m", "kJ", "the same per 100 m", MEMBER(stand_result, per_100m), .scale = J_TO_KJ},
    {"grouped_per_ha", "1/ha", "single trees that stand in groups", MEMBER(stand_result, grouped_per_ha)},
    {"stumps_per_ha", "1/ha", "stumps", MEMBER(stand_result, stumps_per_ha)},
    {"logs_per_ha", "1/ha", "lying logs", MEMBER(stand_result, logs_per_ha)},
    END};

#define SILENT    "the rules do not name its species"
#define NEVER_CUT "the stand has no cutting"
static const struct ceduo_figure rules[] = {
    {"region", "", "region of the rules", .value = region_name},
    {"standards_per_ha", "1/ha", "standards that a cut leaves, or without cutting the trees that stand",
     MEMBER(compliance, standards)},
    {"standards_least", "1/ha", "standards asked for at least", .from = get_standards, MEMBER(regulation_item, min),
     .null = SILENT},
    {"standards_most", "1/ha", "at most", .from = get_standards, MEMBER(regulation_item, max),
     .null = "there is no such limit"},
    {"standards_met", "", "true if that is met", .value = standards_met, .null = SILENT},
    {"standards_article", "", "article and act", .from = get_standards, MEMBER(regulation_item, article), .null = SILENT},
    {"standards_year", "", "year of that act", .from = get_standards, MEMBER(regulation_item, year), .null = SILENT},
    {"turn_y", "y", "age of the oldest shoots at a cut", MEMBER(compliance, turn), .null = NEVER_CUT},
    {"turn_least", "y", "age asked for at least", .from = get_turn, MEMBER(regulation_item, min), .null = SILENT},
    {"turn_most", "y", "at most", .from = get_turn, MEMBER(regulation_item, max), .null = "there is no such limit"},
    {"turn_met", "", "true if that is met", .value = turn_met, .null = SILENT ", or " NEVER_CUT},
    {"turn_article", "", "article and act", .from = get_turn, MEMBER(regulation_item, article), .null = SILENT},
    {"turn_year", "", "year of that act", .from = get_turn, MEMBER(regulation_item, year), .null = SILENT},
    END};

static const struct ceduo_figure stand_columns[] = {
    {"name", "", "name of the stand", .from = get_belt, MEMBER(belt, name_given)},
    {"from_m", "m", "where the belt begins", .from = get_belt, MEMBER(belt, from_given)},
    {"to_m", "m", "where it ends", .from = get_belt, MEMBER(belt, to_given)},
    {.from = get_stand, .table = stand_result},
    END};
static const struct ceduo_figure stand_warnings[] = {
    {"warnings", "", "sentences about this stand", .sentences = report_stand_warnings}, END};

static const struct ceduo_figure stand[] = {{.table = stand_columns},
                                            {.table = stand_warnings},
                                            {"rules", "", "rules of the region for a coppice, and if they are met",
                                             .from = get_rules, .table = rules,
                                             .null = "the scene names no rules, or the stand is no coppice"},
                                            END};

static const struct ceduo_figure summary[] = {
    {"length_m", "m", "wooded length", MEMBER(index, length)},
    {"longest_gap_m", "m", "longest stretch without stems", MEMBER(index, longest_gap)},
    {"adc_m", "m", "length_m over contacts", .value = mean_adc, .null = "there are no contacts"},
    {"contacts", "", "contacts in all belts", MEMBER(index, contacts)},
    {"meet_nothing_probability", "", "chance of meeting no stem in any belt", MEMBER(index, meet_nothing_probability)},
    {"dissipated_kJ", "kJ", "energy that the stems could take", MEMBER(index, dissipated), .scale = J_TO_KJ},
    {"dissipated_kJ_per_100m", "kJ", "the same per 100 m of wooded length", .value = index_per_100m, .scale = J_TO_KJ,
     .null = "there is no forest"},
    {"passes_threshold", "", "true if lights.contact of the last control is pass", .value = passes_contact},
    END};

static const struct ceduo_figure by_index[] = {
    {"dissipated_kJ", "kJ", "energy that the stems between the release and this control could take", MEMBER(index, dissipated),
     .scale = J_TO_KJ},
    {"residual_kJ", "kJ", "the mean of bare.energy_kJ less that, and not below 0", MEMBER(index, residual), .scale = J_TO_KJ,
     .null = "no rock arrives without forest"},
    {"exhausted", "", "true if stems could take more than the mean energy", .value = is_exhausted,
     .null = "no rock arrives without forest"},
    {"measured_kJ", "kJ", "energy of translation of the rock at measured_speed_m_s", MEMBER(index, measured), .scale = J_TO_KJ,
     .null = "the control has no measured_speed_m_s"},
    END};

static const struct ceduo_figure lights[] = {
    {"contact", "", "pass if the stand makes contact often enough", LIGHT(contact)},
    {"free_run", "", "pass if long runs without contact are rare enough", LIGHT(free_run)},
    {"energy", "",
     "pass if few enough rocks arrive with too much energy; unknown without accepted_kJ and with "
     "contact_model: index",
     LIGHT(energy)},
    {"contact_8cm", "", "contact, counting only stems from 8 cm on (from contact_dbh_m if that is more)", LIGHT(thick.contact)},
    {"free_run_8cm", "", "free_run, counting likewise", LIGHT(thick.free_run)},
    END};

#define ANSWERS "yes, no, not-decided (the 95 % interval holds the limit), nothing (cannot be judged: why has the reason)"
static const struct ceduo_figure verdict_of_other[] = {
    {"answer", "", "the same by that law, but depends where one law says yes and the other no",
     .value = judgement_by_alternative_law, .null = NO_LIMIT},
    END};

static const struct ceduo_figure other_mean[] = {
    {"mean", "", "mean", MEMBER(alternative_energy, arrivals.energy.mean), .null = NO_ROCK},
    {"se", "", "standard error of the mean", MEMBER(alternative_energy, arrivals.energy.se), .null = TOO_FEW},
    END};

static const struct ceduo_figure alternative_energy[] = {
    {"model", "", "that law: dorren, or brauner where all stems of the option follow dorren", .value = energy_model_at,
     .offset = offsetof(struct ceduo_alternative_energy, model)},
    {"rocks", "", "simulated under it: the first 10240 of the run, if it has more",
     MEMBER(alternative_energy, arrivals.released)},
    {"reach_probability", "", "share of these that reach the control", MEMBER(alternative_energy, arrivals.reach.mean)},
    {"reach_lo", "", "lower end of its 95 % interval", MEMBER(alternative_energy, arrivals.reach.lo)},
    {"reach_hi", "", "upper end of its 95 % interval", MEMBER(alternative_energy, arrivals.reach.hi)},
    {"exceed_probability", "", "share of these that reach it with more than accepted_kJ",
     MEMBER(alternative_energy, arrivals.exceed.mean), .null = NO_LIMIT},
    {"exceed_lo", "", "lower end of its 95 % interval", MEMBER(alternative_energy, arrivals.exceed.lo), .null = NO_LIMIT},
    {"exceed_hi", "", "upper end of its 95 % interval", MEMBER(alternative_energy, arrivals.exceed.hi), .null = NO_LIMIT},
    {"energy_kJ", "kJ", "energy of the rocks that reach it", .table = other_mean, .scale = J_TO_KJ},
    {"verdict", "", "answer for the control", .table = verdict_of_other},
    END};

#define NO_ANSWER NO_LIMIT ", or contact_model is index"
static const struct ceduo_figure verdict[] = {
    {"answer", "",
     "whether the forest keeps rocks with more than accepted_kJ to at most 5 of 100 in every year of the window (with blocks: "
     "to one "
     "in accepted_return_y years, in the mean of the window); without a window, today: " ANSWERS,
     .value = judgement_word, .null = NO_ANSWER},
    {"today", "", "the same today", .value = judgement_today, .null = NO_LIMIT ", contact_model is index, or of a year"},
    {"class", "",
     "the answer as a number: 0 not reached, 1 yes, also without forest, 2 yes, 3 not decided or depends, 4 no, 5 not judged: "
     "no rock moves, or the row of --each failed",
     .value = verdict_class, .null = NO_ANSWER},
    {"why", "",
     "reason of the class, a word: not-reached; without-forest; forest; sampling-error, uncertain-inputs, impossible-stand, "
     "contradicts-terrain; exceeds, exceeds-later (not today); no-rock-moves, failed",
     .value = verdict_why, .null = NO_ANSWER},
    {"because", "", "why, in a sentence", .sentences = report_reason, .single = true},
    END};

static const struct ceduo_figure topography[] = {
    {"reach_angle_deg", "deg", "inclination of the line from the release", MEMBER(topography, reach), .scale = DEGREES},
    {"shadow_angle_deg", "deg", "inclination of the line from the foot of the face", MEMBER(topography, shadow),
     .scale = DEGREES, .null = "no ground steeper than 45 degrees over 5 m lies between release and control"},
    END};

static const struct ceduo_figure control[] = {
    {"x_m", "m", "as in the scene", .from = get_control, MEMBER(control, x_given)},
    {"name", "", "as in the scene", .from = get_control, MEMBER(control, name_given), .null = "the control has none"},
    {"accepted_kJ", "kJ", "as in the scene", .from = get_control, .value = accepted_energy, .null = "the control has none"},
    {"fence", "", "the net fence there", .from = get_fence, .table = fence, .null = "the control has none"},
    {"topography", "", "position of the control below the release", .from = get_topography, .table = topography},
    {"bare", "", "rocks that arrive without forest", .from = get_bare, .table = arrivals},
    {"index", "", "the index of the paper", .from = get_index, .table = by_index},
    {"wooded", "", "rocks that arrive through the forest of this option", .from = get_wooded, .table = wooded,
     .null = "contact_model is index"},
    {"other_energy", "", "the same rocks under the other energy law of stems", .from = get_alt, .table = alternative_energy,
     .null = "the option has no stems, contact_model is index, and in a year of --years"},
    {"design", "", "design values of a fence there", .from = get_designs, .table = designs, .null = "the scene has no design"},
    {"lights", "", "verdicts on the way from the release to this control, each pass, fail or unknown, never merged into one",
     .from = get_index, .table = lights},
    {"verdict", "", "answer for the control", .table = verdict},
    END};

#define ENDED(end) .value = share_at, .offset = offsetof(struct ceduo_simulated, ends.share[end])
static const struct ceduo_figure ends[] = {
    {"stopped_by_stems", "", "share of the released that stems stop", ENDED(CEDUO_END_STOPPED_BY_STEMS)},
    {"came_to_rest", "", "share that comes to rest by itself", ENDED(CEDUO_END_AT_REST)},
    {"left_slope", "", "share that leaves the profile", ENDED(CEDUO_END_LEFT_SLOPE)},
    {"unfinished", "", "count of rocks that were still moving after 1000000 contacts",
     MEMBER(simulated, ends.count[CEDUO_END_UNFINISHED])},
    END};

static const struct ceduo_figure stops[] = {
    {"p50", "m", "median", .value = stop_at, .offset = offsetof(struct ceduo_ends, stop_p50)},
    {"p95", "m", "95th percentile", .value = stop_at, .offset = offsetof(struct ceduo_ends, stop_p95)},
    {"max", "m", "farthest", .value = stop_at, .offset = offsetof(struct ceduo_ends, stop_max)},
    END};

/* Rows used in several objects. */
static const struct ceduo_figure summary_row[] = {
    {"summary", "", "the forest between the release and the last control", .from = get_last_index, .table = summary}, END};
static const struct ceduo_figure forest_rows[] = {
    {"stands", "", "an object for each belt, in order", .table = stand, .enter = enter_belt},
    {.table = summary_row},
    {"controls", "", "an object for each control, in the scene's order", .table = control, .enter = enter_control},
    END};
static const struct ceduo_figure end_rows[] = {
    {"ends", "", "ends of the rocks, over the whole profile, through the forest (with contact_model: index without it)",
     .from = get_run, .table = ends},
    {"stop_x_m", "m", "places where rocks were stopped by stems or came to rest", .from = get_stops, .table = stops,
     .null = "no rock was stopped or came to rest"},
    END};
static const struct ceduo_figure year_rows[] = {
    {"year", "", "year, counted from the stands as filed", .from = get_year, MEMBER(year, year)},
    {"cut", "", "true if a belt is cut in it", .from = get_year, MEMBER(year, cut)},
    END};

static const struct ceduo_figure felling[] = {
    {"year", "", "year, counted from the stands as filed", .from = get_felling, MEMBER(felling, year)},
    {"from_m", "m", "where the belt begins", .from = get_felled_belt, MEMBER(belt, from_given)},
    {"to_m", "m", "where it ends", .from = get_felled_belt, MEMBER(belt, to_given)},
    {"stems_per_ha", "1/ha", "stems felled", .from = get_felling, MEMBER(felling, stems_per_ha)},
    {"volume_m3_ha", "m3/ha", "their volume", .from = get_felling, MEMBER(felling, volume)},
    END};

#define NO_GROWTH "a stand has no growth or cutting"
static const struct ceduo_figure yield_rows[] = {
    {"cut_m3_ha_per_year", "m3/ha", "volume felled per hectare of forest and year over a whole rotation",
     MEMBER(yield, cut_per_year), .null = NO_GROWTH},
    {"standing_m3_ha_mean", "m3/ha", "volume standing, in the mean of that rotation", MEMBER(yield, standing),
     .null = NO_GROWTH},
    {"died_m3_ha_per_year", "m3/ha", "volume of the stems that die between two cuts", MEMBER(yield, died_per_year),
     .null = NO_GROWTH},
    END};
static const struct ceduo_figure yield_columns[] = {{.from = get_yield, .table = yield_rows}, END};
static const struct ceduo_figure yield[] = {{.table = yield_columns},
                                            {"cuts", "",
                                             "an object for each cut, up to the one that ends the first whole rotation",
                                             .table = felling, .enter = enter_felling},
                                            END};

static const struct ceduo_figure year[] = {{.table = year_rows}, {.table = forest_rows}, END};

#define FAILS(which) .value = failing_years, .offset = offsetof(struct ceduo_place, sum.which), .null = NOTHING_SAID
#define NOTHING_SAID "the forest cannot be assessed"
static const struct ceduo_figure rotation[] = {
    {"years", "", "number of years computed", MEMBER(place, sum.years)},
    {"felled_m", "m", "length of the belts felled in them; a belt counts at each cut", .value = felled_length},
    {"unprotected_contact", "", "years in which lights.contact fails", FAILS(unprotected_contact)},
    {"unprotected_free_run", "", "years in which lights.free_run fails", FAILS(unprotected_free_run)},
    {"unprotected_contact_8cm", "", "years in which lights.contact_8cm fails", FAILS(thick_contact)},
    {"unprotected_free_run_8cm", "", "years in which lights.free_run_8cm fails", FAILS(thick_free_run)},
    {"unprotected_energy", "", "years in which lights.energy fails", .value = failing_energy_years,
     .null = "the control has no accepted_kJ, contact_model is index, or " NOTHING_SAID},
    {"reach_probability", "", "plain mean over the years", IN(place, sum.reach, paired)},
    {"exceed_probability", "", "plain mean over the years", IN(place, sum.exceed, paired)},
    {"energy_per_released_kJ", "kJ", "plain mean over the years", IN(place, sum.energy_per_released, paired), .scale = J_TO_KJ},
    {"worst_year", "", "year with the largest share that exceeds (or arrives, or with the largest ADC)",
     MEMBER(place, sum.worst_year)},
    {"reach_per_year", "1/y", "rocks to be expected to arrive", MEMBER(place, sum.passes_per_year),
     .null = "the scene has no rocks_per_year"},
    {"exceed_per_year", "1/y", "of these, rocks with more than accepted_kJ", MEMBER(place, sum.exceeds_per_year),
     .null = "the scene has no rocks_per_year, or the control no accepted_kJ"},
    END};

static const struct ceduo_figure window[] = {
    {"from", "y", "first year, counted from today", MEMBER(choice, window.first)},
    {"to", "y", "last year", MEMBER(choice, window.last)},
    {"mean", "", "share of the released that exceeds (without accepted_kJ: that arrives), mean of the years",
     MEMBER(choice, mean.mean)},
    {"mean_lo", "", "lower end of its 95 % interval", .value = window_lo},
    {"mean_hi", "", "upper end of its 95 % interval", .value = window_hi},
    {"worst", "", "the share of the worst year", .value = window_worst},
    {"worst_year", "y", "that year", .value = window_worst_year},
    {"failing_years", "", "years in which lights.energy fails", .value = window_failing, .null = NO_LIMIT},
    END};

#define NO_YEARS "--years is not given"
static const struct ceduo_figure option[] = {
    {"name", "", "name of the option", .from = get_option, MEMBER(option, name_given)},
    {.table = forest_rows},
    {.table = end_rows},
    {"window", "", "the years by which options are judged and compared, at the last control", .from = get_window,
     .table = window, .null = NO_WINDOW},
    {"years", "", "an object for each year", .table = year, .enter = enter_year, .null = NO_YEARS},
    {"rotation", "", "the years together, at the last control", .from = get_rotation, .table = rotation, .null = NO_YEARS},
    {"yield", "", "stem wood that the option yields", .from = enter_yield, .table = yield, .null = NO_GROWTH},
    END};

static const struct ceduo_figure share_difference[] = {
    {.table = paired},
    {"below", "", "if no rock fares differently: upper 95 % bound of the share that could", .value = difference_bound,
     .null = "rocks fare differently, or the forests are the same"},
    END};

static const struct ceduo_figure differences[] = {
    {"reach_probability", "", "difference of the shares that arrive", IN(difference, reach, share_difference)},
    {"exceed_probability", "", "difference of the shares that exceed", IN(difference, exceed, share_difference)},
    {"energy_per_released_kJ", "kJ", "difference of the energies over all released",
     IN(difference, energy_per_released, paired), .scale = J_TO_KJ},
    END};

static const struct ceduo_figure difference[] = {
    {"option", "", "option that is compared", .from = get_option, MEMBER(option, name_given)},
    {"against", "", "the first option", .from = get_first, MEMBER(option, name_given)},
    {"x_m", "m", "control", .from = get_control, MEMBER(control, x_given)},
    {.from = get_difference, .table = differences},
    END};

static const struct ceduo_figure rock[] = {
    {"mass_kg", "kg", "mass", MEMBER(rock, mass)},
    {"mean_diameter_m", "m", "mean of its dimensions: the diameter that meets the stems", MEMBER(rock, mean_diameter)},
    {"moment_kg_m2", "kg m2", "moment of inertia", MEMBER(rock, moment)},
    END};

static const struct ceduo_figure profile[] = {
    {"points", "", "its points, as given", .value = points_given},
    {"used", "", "points after simplifying, which are simulated", .value = points_used},
    {"tolerance_m", "m", "distance within which points are left out; 0: none", MEMBER(slope, tolerance)},
    END};

static const struct ceduo_figure scene[] = {
    {"scene", "", "path of the file as it was given, or the name of a scene that comes with the program; standard input for -",
     .from = get_report, .value = result_path},
    {"title", "", "title of the scene, or the name of its file", .from = get_scene, MEMBER(scene, title)},
    {"seed", "", "seed of the random numbers", .from = get_scene, MEMBER(scene, simulation.seed)},
    {"rocks", "", "rocks flown", .from = get_report, .value = rocks_simulated},
    {"law", "", "law of the impacts: lumped, crsp or arm", .from = get_scene, .value = impact_law},
    {"rock", "", "the rock; with spreads, that of the means", .from = get_rock, .table = rock},
    {"slope", "", "the profile", .from = get_slope, .table = profile},
    {"threshold_m", "m", "ADC below which a stand protects", .from = get_scene, MEMBER(scene, simulation.threshold)},
    END};

static const struct ceduo_figure work[] = {
    {"rocks_flown", "",
     "rocks of all runs: one without forest, and one for each forest that differs, under "
     "each energy law; with --years of its years, too, but not of the window",
     MEMBER(report, work.rocks)},
    {"contacts", "", "contacts with the ground, of all rocks", MEMBER(report, work.contacts)},
    {"stems_drawn", "", "stems generated along their ways, hit or not", MEMBER(report, work.stems.drawn)},
    {"runs", "", "runs computed", MEMBER(report, work.runs)},
    {"runs_reused", "", "runs taken from the cache", MEMBER(report, work.reused)},
    {"seconds", "s", "wall-clock time, the one value that changes from run to run", MEMBER(report, seconds)},
    END};

const struct ceduo_figure ceduo_result_figures[] = {
    {"format", "", "always ceduo-result-1", .value = result_format},
    VERSION,
    {.table = scene},
    {"warnings", "",
     "sentences about the whole run: tolerance not met, rocks unfinished, shares too close to call, ground assumed",
     .sentences = report_run_warnings},
    {"options", "", "an object for each option, in the scene's order; a scene with forest has one, named current",
     .table = option, .enter = enter_option},
    {"differences", "", "an object for each option but the first, and each control; [] with one option", .table = difference,
     .enter = enter_difference},
    {"work", "", "work of the run", .from = get_report, .table = work},
    END};

/* ---- a search ---- */

#define NONE "no value reaches the goal"
#define ONE  "a value reaches it"
static const struct ceduo_figure search_figures[] = {
    {"scene", "", "path of the file", .value = find_path},
    {"path", "", "path of the parameter", .from = get_search, MEMBER(search, path)},
    {"option", "", "name of the option", .value = find_option},
    {"goal", "", "goal that was asked for", .from = get_search, .value = goal_word},
    {"target", "", "limit of the goal", .from = get_search, MEMBER(search, target)},
    {"lo", "", "lower end of the range", .from = get_search, MEMBER(search, lo)},
    {"hi", "", "upper end of the range", .from = get_search, MEMBER(search, hi)},
    END};
static const struct ceduo_figure found_row[] = {
    {"found", "", "true if a value reaches the goal", .from = get_found, MEMBER(found, found)}, END};
static const struct ceduo_figure value_row[] = {
    {"value", "", "the value", .from = get_found, MEMBER(found, value), .null = NONE}, END};
static const struct ceduo_figure side_row[] = {{"side", "", "smallest or largest: which of the values that reach it this is",
                                                .from = get_found, .value = found_side, .null = NONE},
                                               END};
static const struct ceduo_figure goal_rows[] = {
    {"goal_at_value", "", "goal at this value", .from = get_found, MEMBER(found, goal_at_value), .null = NONE},
    {"nearest", "", "value that comes nearest", .from = get_nearest, MEMBER(found, nearest), .null = ONE},
    {"goal_at_nearest", "", "goal at that value", .from = get_nearest, MEMBER(found, goal_at_nearest), .null = ONE},
    END};
#define NOT_SURE "--sure is not given, or nothing is uncertain"
#define NO_ERROR NONE ", every value does, or the points do not determine it"
static const struct ceduo_figure sure_rows[] = {
    {"wanted", "", "share of plausible cases in which the goal is to be reached", MEMBER(reliability, sure)},
    {"found", "", "true if a value reaches it in that share", MEMBER(reliability, found.found)},
    {"value", "", "the value", MEMBER(reliability, found.value), .null = NONE},
    {"value_lo", "", "lower end of its 95 % interval, by the points and by the rocks", MEMBER(reliability, lo),
     .null = NO_ERROR},
    {"value_hi", "", "its upper end", MEMBER(reliability, hi), .null = NO_ERROR},
    {"side", "", "smallest or largest: which of the values that do this is", .value = reliable_side, .null = NONE},
    {"probability", "", "share of plausible cases in which this value reaches the goal", .from = get_sure_found,
     MEMBER(reliability, share.value), .null = NONE},
    {"probability_se", "", "its standard error, by the points and by the rocks", .from = get_sure_found,
     MEMBER(reliability, share.se), .null = NONE},
    {"nearest", "", "value that reaches the goal in most plausible cases", .from = get_sure_nearest,
     MEMBER(reliability, found.nearest), .null = ONE},
    {"probability_at_nearest", "", "share in which that reaches the goal", .from = get_sure_nearest,
     MEMBER(reliability, share.value), .null = ONE},
    {"evaluations", "", "values computed", MEMBER(reliability, found.evaluations)},
    {"points", "", "plausible cases computed, for each", MEMBER(reliability, points)},
    {"rocks", "", "rocks at each point", MEMBER(reliability, rocks)},
    END};
static const struct ceduo_figure found_yield[] = {
    {.from = get_found_yield, .table = yield_rows},
    {"depends", "", "true if it depends on the value; otherwise it is equal over the whole range",
     MEMBER(find_report, yield_depends)},
    END};
static const struct ceduo_figure find_rows[] = {
    {"monotone", "", "true if the goal only rises or only falls over the range", .from = get_found, MEMBER(found, monotone)},
    {"evaluations", "", "values computed", .from = get_found, MEMBER(found, evaluations)},
    {"rocks", "", "rocks flown for each", .from = get_search, MEMBER(search, rocks)},
    {"over", "", "today, or rotation: over the years ahead (--years, a worst- goal, a parameter of growth or cutting)",
     .from = get_search, .value = search_period},
    {"yield", "", "stem wood that the option yields at this value", .from = get_yield_report, .table = found_yield,
     .null = NO_GROWTH},
    {"sure", "", "the same search with uncertain inputs", .from = get_reliability, .table = sure_rows, .null = NOT_SURE},
    END};

const struct ceduo_figure ceduo_find_figures[] = {{"format", "", "always ceduo-find-1", .value = find_format},
                                                  VERSION,
                                                  {.table = search_figures},
                                                  {.table = found_row},
                                                  {.table = value_row},
                                                  {.table = side_row},
                                                  {.table = goal_rows},
                                                  {.table = find_rows},
                                                  END};
static const struct ceduo_figure find_columns[] = {{.table = search_figures},
                                                   {.table = value_row},
                                                   {.table = goal_rows},
                                                   {.table = found_row},
                                                   {.table = side_row},
                                                   {.table = find_rows},
                                                   END};
const struct ceduo_csv ceduo_find_csv = {find_columns, {NULL}};

/* ---- rows of CSV ---- */

static const struct ceduo_figure option_row[] = {
    {"option", "", "name of the option", .from = get_option, MEMBER(option, name_given)}, END};
static const struct ceduo_figure rest[] = {
    {.table = summary_row},
    {.table = control},
    {.table = end_rows},
    {"difference", "", "", .from = get_difference, .table = differences},
    {"yield", "", "", .table = yield_columns},
    {"warnings", "", "sentences about the run and its stands", .sentences = report_all_warnings},
    END};

static const struct ceduo_figure worst_year_columns[] = {
    {"year", "y", "year of the window with the largest share that exceeds, or arrives without accepted_kJ",
     .value = worst_year},
    {"exceed", "", "share of the released that exceeds accepted_kJ in that year", .value = worst_exceed, .null = NO_LIMIT},
    END};
static const struct ceduo_figure share_range[] = {
    {"p5", "", "lower end of the 90 % range of wooded.exceed_probability today over uncertain inputs", MEMBER(surface_fit, p5)},
    {"p95", "", "its upper end", MEMBER(surface_fit, p95)},
    END};
static const struct ceduo_figure end_columns[] = {
    {"worst", "", "", .from = get_summary, .table = worst_year_columns,
     .null = NO_WINDOW ", the forest cannot be judged, or of a year"},
    {"uncertainty", "", "", .from = get_share_range, .table = share_range,
     .null = "--columns does not name it, nothing is uncertain, the control is not the last, or of a year"},
    VERSION,
    END};

static const struct ceduo_figure control_columns[] = {
    {.table = scene}, {.table = option_row}, {.table = rest}, {.table = end_columns}, END};
static const struct ceduo_figure year_columns[] = {{.table = scene}, {.table = option_row},  {.table = year_rows},
                                                   {.table = rest},  {.table = end_columns}, END};
static const struct ceduo_figure stand_csv_columns[] = {
    {.table = scene},          {.table = option_row},
    {.table = stand_columns},  {"rules", "", "", .from = get_rules, .table = rules},
    {.table = stand_warnings}, END};

const struct ceduo_csv ceduo_control_csv = {control_columns, {enter_option, enter_control}};
const struct ceduo_csv ceduo_year_csv = {year_columns, {enter_option, enter_year, enter_control}};
const struct ceduo_csv ceduo_stand_csv = {stand_csv_columns, {enter_option, enter_belt}};

/* ---- the manual ---- */

const struct ceduo_figure_list ceduo_figure_lists[] = {
    {"A result", ceduo_result_figures},
    {"An object of options", option},
    {"The object summary", summary},
    {"An object of stands", stand},
    {"An object of controls", control},
    {"The objects bare and wooded of a control", arrivals},
    {"Each of their distributions, over the rocks that reach the control", distribution},
    {"Each other mean", paired},
    {"The object fence of a control", fence},
    {"The objects fence of bare and wooded", fence_arrivals},
    {"Each of their choices", fence_choice},
    {"Its object window", fence_years},
    {"The object design", designs},
    {"Each of its design values", design_values},
    {"The object hazard", hazard_figures},
    {"Each rate of it", rate_figures},
    {"An object of years", year},
    {"An object of differences", difference},
    {NULL, NULL}};
