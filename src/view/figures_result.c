/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures of a result, of its years and of a search: each is named once. */
#include "figures_parts.h"

#include "ceduo/status.h"
#include "scene/choices.h"

/* ---- values ---- */

READ(light_at, enum ceduo_light, TEXT, WORD(ceduo_words_light(m)))
READ(energy_model_at, enum ceduo_energy_model, TEXT, WORD(ceduo_energy_words.names[m]))
#define LIGHT_AT(member) .value = light_at, .offset = offsetof(struct ceduo_index, member)

/* ---- objects of a place ---- */

static const struct ceduo_result *result_of(const struct ceduo_place *p)
{
    return p->report->result;
}

/* The option as it is filed, or in a year. */
static const struct ceduo_option *forest_of(const struct ceduo_place *p)
{
    return p->year ? &p->year->option : &result_of(p)->scene->options[p->option];
}

static const struct ceduo_index *indices_of(const struct ceduo_place *p)
{
    return p->year ? p->year->controls : result_of(p)->options[p->option].controls;
}

static const struct ceduo_simulated *wood_of(const struct ceduo_place *p)
{
    return p->year && p->year->wooded.rocks > 0 ? &p->year->wooded : &result_of(p)->options[p->option].wooded;
}

static const struct ceduo_arrivals *through_the_wood(const struct ceduo_place *p)
{
    if (!p->year)
        return ceduo_result_wooded(result_of(p), p->option, p->control);
    return p->year->wooded.rocks > 0 ? &p->year->wooded.arrivals[p->control] : NULL;
}

/* Of today alone; NULL where no stem stands. */
static const struct ceduo_alternative_energy *other_law(const struct ceduo_place *p)
{
    const struct ceduo_alternative_energy *other = &result_of(p)->options[p->option].others[p->control];
    return !p->year && other->known && other->stems ? other : NULL;
}

/* NULL where growth or cuts are not known. */
static const struct ceduo_yield *yield_at(const struct ceduo_place *p)
{
    const struct ceduo_verdict *v = p->report->verdict;
    const struct ceduo_yield *yield = v ? &v->choices[p->option].yield : NULL;
    return yield && !isnan(yield->cut_per_year) ? yield : NULL;
}

/* NULL if the window is today alone, or its years were not simulated. */
static const struct ceduo_choice *window_at(const struct ceduo_place *p)
{
    const struct ceduo_choice *c = ceduo_report_ahead(p->report, p->option);
    return c && c->over->simulated > 0 ? c : NULL;
}

static const struct ceduo_stand_result *belt_result(const struct ceduo_place *p)
{
    return &(p->year ? p->year->stands : result_of(p)->options[p->option].stands)[p->belt];
}

OBJECT(report_of, place, o->report)
OBJECT(scene_of, place, result_of(o)->scene)
OBJECT(rock_of, place, &result_of(o)->rock)
OBJECT(slope_of, place, &result_of(o)->scene->slope)
OBJECT(year_of, place, o->year)
OBJECT(option_of, place, &result_of(o)->scene->options[o->option])
OBJECT(first_option_of, place, &result_of(o)->scene->options[0])
OBJECT(belt_of, place, &forest_of(o)->belts[o->belt])
OBJECT(stand_of, place, belt_result(o))
OBJECT(rules_of, place, belt_result(o)->rules.of ? &belt_result(o)->rules : NULL)
OBJECT(control_of, place, &result_of(o)->scene->controls[o->control])
OBJECT(index_of, place, &indices_of(o)[o->control])
OBJECT(last_index_of, place, &indices_of(o)[result_of(o)->last_control])
OBJECT(bare_of, place, &result_of(o)->bare.arrivals[o->control])
OBJECT(topography_of, place, &result_of(o)->bare.arrivals[o->control].topography)
OBJECT(wooded_of, place, through_the_wood(o))
OBJECT(other_of, place, other_law(o))
OBJECT(flown_of, place, wood_of(o))
OBJECT(stops_of, place, wood_of(o)->ends.stop_x.n > 0 ? o : NULL)
OBJECT(difference_of, place, o->option > 0 && !o->year ? &result_of(o)->options[o->option].differences[o->control] : NULL)
OBJECT(yield_of, place, yield_at(o))
OBJECT(place_of_yield, place, yield_at(o) ? o : NULL)
OBJECT(felling_of, place, &yield_at(o)->fellings[o->felling])
OBJECT(felled_belt_of, place, &result_of(o)->scene->options[o->option].belts[yield_at(o)->fellings[o->felling].belt])
OBJECT(rotation_of, place, o->report->years ? o : NULL)
OBJECT(window_of, place, window_at(o))
OBJECT(standards_of, compliance, o->standards_item)
OBJECT(turn_of, compliance, o->turn_item)
OBJECT(search_of, find_report, o->search)
OBJECT(found_of, find_report, o->found)
OBJECT(sure_of, find_report, o->sure && o->sure->inputs > 0 ? o->sure : NULL) /* nothing uncertain: nothing was computed */
OBJECT(nearest_of, find_report, o->found->found ? NULL : o->found)
OBJECT(sure_found_of, reliability, o->found.found ? o : NULL)
OBJECT(sure_nearest_of, reliability, o->found.found ? NULL : o)
OBJECT(found_yield_of, find_report, o->yield && !isnan(o->yield->cut_per_year) ? o->yield : NULL)
OBJECT(yields_of, find_report, found_yield_of(o) ? o : NULL)

/* ---- lists ---- */

static bool enter_option(struct ceduo_place *p, size_t i)
{
    p->option = i;
    bool inside = i < result_of(p)->scene->options_count;
    if (inside && p->report->years)
        p->sum = ceduo_years_sum(p->report->years[i], result_of(p)->last_control);
    return inside;
}

ENTER(enter_belt, belt, forest_of(p)->belts_count)
ENTER(enter_control, control, result_of(p)->scene->controls_count)

static bool enter_year(struct ceduo_place *p, size_t i)
{
    const struct ceduo_years *years = p->report->years ? p->report->years[p->option] : NULL;
    p->year = years && i < years->count ? &years->years[i] : NULL;
    return p->year != NULL;
}

/* Up to the end of the first whole rotation, whichever years are asked for. */
static bool enter_felling(struct ceduo_place *p, size_t i)
{
    const struct ceduo_yield *yield = yield_at(p);
    struct ceduo_window rotation = ceduo_window_compute(&result_of(p)->scene->options[p->option]);
    p->felling = i;
    return yield && i < yield->fellings_count && yield->fellings[i].year <= rotation.last + 1;
}

static bool enter_difference(struct ceduo_place *p, size_t i)
{
    size_t controls = result_of(p)->scene->controls_count;
    p->option = controls > 0 ? 1 + i / controls : SIZE_MAX;
    p->control = controls > 0 ? i % controls : 0;
    return p->option < result_of(p)->scene->options_count;
}

/* ---- sentences ---- */

static void say_of_run(const struct ceduo_place *p, ceduo_sentence_sink *say, void *context)
{
    ceduo_words_still_moving(result_of(p), say, context);
    ceduo_words_run_warnings(result_of(p), &p->report->remarks, say, context);
}

static void say_of_stand(const struct ceduo_place *p, ceduo_sentence_sink *say, void *context)
{
    ceduo_words_stand_warnings(result_of(p)->scene, belt_of(p), stand_of(p), say, context);
}

/* What is said of a control, by the sampling error alone; of a year by its own rocks. */
static struct ceduo_outcome outcome_of(const struct ceduo_place *p)
{
    if (p->year) {
        enum ceduo_judgement judgement = ceduo_judge_control(&result_of(p)->bare.arrivals[p->control], through_the_wood(p));
        return (struct ceduo_outcome){.answer = judgement, .today = judgement};
    }
    return ceduo_report_outcome(p->report, p->option, p->control);
}

static void say_because(const struct ceduo_place *p, ceduo_sentence_sink *say, void *context)
{
    const struct ceduo_outcome o = outcome_of(p);
    const struct ceduo_subject subject = ceduo_subject_find(p->report, p->option, p->control);
    LOCAL_TEXT(why);
    if ((o.ahead && o.answer != CEDUO_NOTHING) || o.impossible)
        ceduo_words_reason(&why, &subject);
    else
        ceduo_words_because(&why, p->report->result, p->control, through_the_wood(p));
    say(context, ceduo_text_string(&why));
}

static void say_of_all(const struct ceduo_place *place, ceduo_sentence_sink *say, void *context)
{
    struct ceduo_place p = *place;
    say_of_run(&p, say, context);
    for (size_t i = 0; enter_belt(&p, i); i++)
        say_of_stand(&p, say, context);
}

/* ---- what is more than a member ---- */

VALUE(format_of, place, TEXT, WORD("ceduo-result-1"))
VALUE(path_of, report, TEXT, WORD(o->file->name))
VALUE(rocks_of, report, COUNT, COUNT(o->rocks_asked > 0 ? o->rocks_asked : ceduo_result_rocks(o->result)))
VALUE(points_of, slope, COUNT, COUNT(o->points > 0 ? o->points : o->vertices))
VALUE(used_of, slope, COUNT, COUNT(o->vertices))
VALUE(law_of, scene, TEXT, WORD(ceduo_law_words.names[o->simulation.law]))
VALUE(accepted_of, control, NUMBER, NUMBER(ceduo_words_accepted(o)))
VALUE(reached_of, arrivals, COUNT, isnan(o->reach.mean) ? NOTHING : COUNT(o->reached))
VALUE(rule_of, stand_result, TEXT, WORD(isinf(o->adc_m) ? NULL : ceduo_rule_words.names[o->rule]))
VALUE(region_of, compliance, TEXT, WORD(o->of->name))
VALUE(standards_met, compliance, FLAG, o->standards_item ? IS(o->standards_met) : NOTHING)
VALUE(turn_met, compliance, FLAG, o->turn_item && !isnan(o->turn) ? IS(o->turn_met) : NOTHING)
VALUE(index_per_100m, index, NUMBER, NUMBER(o->length > 0 ? o->per_100m : NAN))
VALUE(mean_adc, index, NUMBER, NUMBER(o->contacts > 0 ? o->length / o->contacts : NAN))
VALUE(passes_contact, index, FLAG, IS(o->contact == CEDUO_PASS))
VALUE(exhausted_of, index, FLAG, isnan(o->residual) ? NOTHING : IS(o->exhausted))
VALUE(below_of, estimate, NUMBER, NUMBER(ceduo_pairs_are_equal(o) ? o->hi : NAN))
VALUE(share_at, simulated, NUMBER, NUMBER(o->rocks > 0 ? *(const double *)member(f, o) : NAN))
VALUE(missed_at, arrivals, NUMBER, NUMBER(o->released > 0 ? *(const double *)member(f, o) : NAN))
VALUE(stop_at, place, NUMBER, NUMBER(*(const double *)member(f, &wood_of(o)->ends) + o->report->file->scene.slope.origin_x))
VALUE(too_much_of, place, COUNT, o->sum.nothing || isnan(o->sum.exceed.mean) ? NOTHING : COUNT(o->sum.unprotected_energy))
VALUE(fails_of, place, COUNT, o->sum.nothing ? NOTHING : COUNT(*(const size_t *)member(f, o)))
VALUE(judgement_of, place, TEXT, WORD(ceduo_words_judgement(outcome_of(o).answer)))
VALUE(judgement_today, place, TEXT, WORD(o->year ? NULL : ceduo_words_judgement(outcome_of(o).today)))
VALUE(window_lo, choice, NUMBER, NUMBER(fmax(0, o->mean.mean - o->mean.half)))
VALUE(window_hi, choice, NUMBER, NUMBER(fmin(1, o->mean.mean + o->mean.half)))
VALUE(window_worst, choice, NUMBER, NUMBER(o->worst.mean))
VALUE(window_worst_year, choice, COUNT, COUNT(o->over->worst_year))
VALUE(window_failing, choice, COUNT, o->energy_known ? COUNT(o->over->unprotected_energy) : NOTHING)
VALUE(judgement_of_other, alternative_energy, TEXT, WORD(ceduo_words_judgement(o->judgement)))
VALUE(felled_of, place, NUMBER, NUMBER(ceduo_years_felled(o->report->years[o->option])))
VALUE(find_format, find_report, TEXT, WORD("ceduo-find-1"))
VALUE(find_path, find_report, TEXT, WORD(o->file->name))
VALUE(find_option, find_report, TEXT, WORD(o->file->scene.options[o->search->option].name_given))
VALUE(goal_of, search, TEXT, WORD(ceduo_goals[o->goal].word))
VALUE(over_of, search, TEXT, WORD(o->rotation ? "rotation" : "today"))
VALUE(side_of, found, TEXT, WORD(!o->found ? NULL : o->side == CEDUO_SMALLEST ? "smallest" : "largest"))
VALUE(sure_side, reliability, TEXT, WORD(!o->found.found ? NULL : o->found.side == CEDUO_SMALLEST ? "smallest" : "largest"))

/* ---- the tables ---- */

#define NO_END   "too few rocks arrive to bound it"
#define NO_STEMS "no stem of the stand counts"

static const struct ceduo_figure distribution[] = {
    {"mean", "", "mean", AT(distribution, mean), .null = NO_ROCK},
    {"se", "", "standard error of the mean", AT(distribution, se), .null = FEW},
    {"sd", "", "standard deviation", AT(distribution, sd), .null = FEW},
    {"p50", "", "median", AT(distribution, p50), .null = NO_ROCK},
    {"p50_lo", "", "lower end of its 95 % interval", AT(distribution, p50_lo), .null = NO_END},
    {"p50_hi", "", "upper end of its 95 % interval", AT(distribution, p50_hi), .null = NO_END},
    {"p95", "", "95th percentile", AT(distribution, p95), .null = NO_ROCK},
    {"p95_lo", "", "lower end of its 95 % interval", AT(distribution, p95_lo), .null = NO_END},
    {"p95_hi", "", "upper end of its 95 % interval", AT(distribution, p95_hi), .null = NO_END},
    {"p99", "", "99th percentile", AT(distribution, p99), .null = NO_ROCK},
    {"p99_lo", "", "lower end of its 95 % interval", AT(distribution, p99_lo), .null = NO_END},
    {"p99_hi", "", "upper end of its 95 % interval", AT(distribution, p99_hi), .null = NO_END},
    {"max", "", "largest value", AT(distribution, max), .null = NO_ROCK},
    END};

static const struct ceduo_figure paired[] = {
    {"mean", "", "mean", AT(estimate, mean), .null = "it is not known, as what exceeds without accepted_kJ"},
    {"se", "", "its standard error", AT(estimate, se), .null = "it is not known, as where no two rocks differ"},
    END};

#define TOO_RARE "rocks arrive less often"
#define UNBOUND  "the rocks that arrive do not bound it"
#define NEVER    "the rate is 0"

static const void *hazard_of(const void *arrivals)
{
    const struct ceduo_hazard *h = &((const struct ceduo_arrivals *)arrivals)->hazard;
    return isnan(h->per_year) ? NULL : h;
}

static const void *exceed_item(const void *object, size_t i)
{
    const struct ceduo_hazard *h = object;
    return h->curve && i < h->curve->count ? &h->curve->at[i] : NULL;
}

static const void *return_item(const void *object, size_t i)
{
    return i < CEDUO_RETURNS ? &((const struct ceduo_hazard *)object)->returns[i] : NULL;
}

static const void *intensity_item(const void *object, size_t i)
{
    return i < CEDUO_INTENSITIES ? &((const struct ceduo_hazard *)object)->intensity[i] : NULL;
}

VALUE(years_of, hazard, NUMBER, NUMBER(1 / *(const double *)member(f, o)))

static const struct ceduo_figure rate_figures[] = {{"per_year", "1/y", "rocks a year", AT(estimate, mean)},
                                                   {"lo", "1/y", "lower end of its 95 % interval", AT(estimate, lo)},
                                                   {"hi", "1/y", "upper end of its 95 % interval", AT(estimate, hi)},
                                                   END};

static const struct ceduo_figure exceed_rate[] = {{"energy_kJ", "kJ", "energy", AT(exceeding, energy), .scale = J_TO_KJ},
                                                  {.of = rate_figures, .offset = offsetof(struct ceduo_exceeding, rate)},
                                                  END};

static const struct ceduo_figure returns[] = {
    {"years", "y", "return period", AT(return, years)},
    {"energy_kJ", "kJ", "energy that is reached or exceeded once in so many years", AT(return, energy.mean), .scale = J_TO_KJ,
     .null = TOO_RARE},
    {"lo", "kJ", "lower end of its 95 % interval", AT(return, energy.lo), .scale = J_TO_KJ, .null = UNBOUND},
    {"hi", "kJ", "upper end of its 95 % interval", AT(return, energy.hi), .scale = J_TO_KJ, .null = UNBOUND},
    END};

static const struct ceduo_figure matrix[] = {
    {"intensity", "", "weak, medium or strong: below 30 kJ, 30 to 300 kJ, above 300 kJ (BAFU 2016)", AT(intensity, word)},
    {"from_kJ", "kJ", "lower limit of the class", AT(intensity, from), .scale = J_TO_KJ},
    {"to_kJ", "kJ", "upper limit", AT(intensity, to), .scale = J_TO_KJ, .null = "there is none"},
    {.of = rate_figures, .offset = offsetof(struct ceduo_intensity, within)},
    {"rate_left", "", "share of the rate without forest", AT(intensity, left), .null = "none arrive without forest"},
    {"to_30_years", "", "whether the energy of 30 years is in this class: a mark of the matrix", AT(intensity, of_return[1])},
    {"to_100_years", "", "the same of 100 years", AT(intensity, of_return[2])},
    {"to_300_years", "", "the same of 300 years", AT(intensity, of_return[3])},
    END};

static const struct ceduo_figure hazard_figures[] = {
    {"per_year", "1/y", "blocks that come down", AT(hazard, per_year)},
    {"effective_rocks", "", "effective sample size (Kish): (sum of weights)^2/(sum of their squares)", AT(hazard, effective)},
    {"exceed_rate", "", "rocks a year that arrive with more than an energy, up to the first energy that none exceeds",
     .of = exceed_rate, .item = exceed_item, .details = true, .null = "--details is not given"},
    {"return", "", "energies of 10, 30, 100 and 300 years", .of = returns, .item = return_item, .columns = CEDUO_RETURNS},
    {"reach_per_year", "1/y", "rocks that arrive", AT(hazard, reach.mean)},
    {"reach_years", "y", "years from one that arrives to the next", .value = years_of,
     .offset = offsetof(struct ceduo_hazard, reach.mean), .null = NEVER},
    {"exceed_per_year", "1/y", "rocks that arrive with more than accepted_kJ", AT(hazard, accepted.mean), .null = UNSAID},
    {"accepted_years", "y", "years from one that does to the next", .value = years_of,
     .offset = offsetof(struct ceduo_hazard, accepted.mean), .null = UNSAID ", or the rate is 0"},
    {"accepted_years_lo", "y", "lower end of its 95 % interval", .value = years_of,
     .offset = offsetof(struct ceduo_hazard, accepted.hi), .null = UNSAID ", or no rock could have so much energy"},
    {"accepted_years_hi", "y", "upper end of its 95 % interval", .value = years_of,
     .offset = offsetof(struct ceduo_hazard, accepted.lo), .null = UNSAID ", or " UNBOUND},
    {"accepted_return_y", "y", "years between two such rocks that are accepted: as in the scene, or 100",
     AT(hazard, accepted_return), .null = UNSAID},
    {"matrix", "", "classes of intensity, by classes of return period", .of = matrix, .item = intensity_item,
     .columns = CEDUO_INTENSITIES},
    {"rate_left", "",
     "share of the rate without forest: of what exceeds accepted_kJ, or of all that arrive where that is not "
     "given",
     AT(hazard, left), .null = "it is 0 without forest"},
    END};

#define MISSED(end) .value = missed_at, .offset = offsetof(struct ceduo_arrivals, missed[end])
static const struct ceduo_figure missed[] = {
    {"stopped_by_stems", "", "share of the released that stems stop before it", MISSED(CEDUO_STOPPED_BY_STEMS)},
    {"came_to_rest", "", "share that comes to rest before it", MISSED(CEDUO_AT_REST)},
    {"left_slope", "", "share that leaves the profile before it", MISSED(CEDUO_LEFT_SLOPE)},
    {"unfinished", "", "share that was still moving before it", MISSED(CEDUO_UNFINISHED)},
    END};

static const struct ceduo_figure arrivals[] = {
    {"rocks_reached", "", "rocks that reach the control", .value = reached_of, .null = "nothing was flown"},
    {"reach_probability", "", "share of all released that reach it; an unfinished rock counts as not reached",
     AT(arrivals, reach.mean)},
    {"reach_lo", "", "lower end of its 95 % interval", AT(arrivals, reach.lo)},
    {"reach_hi", "", "upper end of its 95 % interval, where an unfinished rock counts as reached", AT(arrivals, reach.hi)},
    {"exceed_probability", "", "share of all released that reach it with more than accepted_kJ", AT(arrivals, exceed.mean),
     .null = UNSAID},
    {"exceed_lo", "", "lower end of its 95 % interval", AT(arrivals, exceed.lo), .null = UNSAID},
    {"exceed_hi", "", "upper end of its 95 % interval", AT(arrivals, exceed.hi), .null = UNSAID},
    {"speed_m_s", "m/s", "speed of the rocks that reach it", IN(arrivals, speed, distribution)},
    {"energy_kJ", "kJ", "their energy of translation and rotation", IN(arrivals, energy, distribution), .scale = J_TO_KJ},
    {"translation_kJ", "kJ", "their energy of translation alone", IN(arrivals, translation, distribution), .scale = J_TO_KJ},
    {"height_m", "m", "height of their underside above the ground", IN(arrivals, height, distribution)},
    {"energy_per_released_kJ", "kJ", "energy over all released rocks; one that does not arrive counts as 0",
     IN(arrivals, energy_per_released, paired), .scale = J_TO_KJ},
    {"missed", "", "how the released end that do not reach it; with reach_probability these make 1", .of = missed},
    {"hazard", "", "how often, and with how much", .from = hazard_of, .of = hazard_figures, .null = "the scene has no blocks"},
    END};

static const struct ceduo_figure wooded[] = {
    {.of = arrivals},
    {"contacts", "", "stems hit before this control by the rocks that reach it", IN(arrivals, contacts, paired)},
    END};

static const struct ceduo_figure adc[] = {
    {"rule", "", "form that was used: gsteiger-stools, gsteiger-stems, interception or crofton", .value = rule_of,
     .null = NO_STEMS},
    {"adc_m", "m", "what it gives", AT(stand_result, adc_m), .null = NO_STEMS},
    {"gsteiger_stools_m", "m", "ADC by gsteiger-stools", AT(stand_result, adc.gsteiger_stools), .null = NO_STEMS},
    {"gsteiger_stems_m", "m", "ADC by gsteiger-stems", AT(stand_result, adc.gsteiger_stems), .null = NO_STEMS},
    {"interception_m", "m", "ADC by interception", AT(stand_result, adc.interception), .null = NO_STEMS},
    {"crofton_m", "m", "ADC by crofton", AT(stand_result, adc.crofton), .null = NO_STEMS},
    END};

static const struct ceduo_figure stand_result[] = {
    {"length_m", "m", "horizontal length of the belt", AT(stand_result, length)},
    {"stems_per_ha", "1/ha", "stems: shoots and trees", AT(stand_result, stems_per_ha)},
    {"stools_per_ha", "1/ha", "stools", AT(stand_result, stools_per_ha)},
    {"trees_per_ha", "1/ha", "single trees", AT(stand_result, trees_per_ha)},
    {"basal_area_m2_ha", "m2/ha", "basal area", AT(stand_result, basal_area)},
    {"adc", "", "Average Distance between Contacts", .of = adc},
    {"passes_threshold", "", "whether adc.adc_m is below the threshold", AT(stand_result, passes_threshold)},
    {"free_run_probability", "", "chance of running as far as the threshold inside the stand without a contact",
     AT(stand_result, free_run_probability)},
    {"contacts", "", "contacts over the whole belt: length over ADC", AT(stand_result, contacts)},
    {"energy_per_contact_J", "J", "energy that one contact by the index could take on average",
     AT(stand_result, energy_per_contact), .null = NO_STEMS},
    {"dissipated_kJ", "kJ", "energy that the stems of the belt could take", AT(stand_result, dissipated), .scale = J_TO_KJ},
    {"dissipated_kJ_per_100m", "kJ", "the same per 100 m", AT(stand_result, per_100m), .scale = J_TO_KJ},
    {"grouped_per_ha", "1/ha", "single trees that stand in groups", AT(stand_result, grouped_per_ha)},
    {"stumps_per_ha", "1/ha", "stumps", AT(stand_result, stumps_per_ha)},
    {"logs_per_ha", "1/ha", "lying logs", AT(stand_result, logs_per_ha)},
    END};

#define SILENT    "the rules say nothing of its species"
#define NEVER_CUT "the stand says nothing of its cutting"
static const struct ceduo_figure rules[] = {
    {"region", "", "whose rules", .value = region_of},
    {"standards_per_ha", "1/ha", "standards that a cut leaves, or without cutting the trees that stand",
     AT(compliance, standards)},
    {"standards_least", "1/ha", "standards asked for at least", .from = standards_of, AT(regulation_item, least),
     .null = SILENT},
    {"standards_most", "1/ha", "at most", .from = standards_of, AT(regulation_item, most), .null = "there is no such limit"},
    {"standards_met", "", "whether that is kept", .value = standards_met, .null = SILENT},
    {"standards_article", "", "article and act", .from = standards_of, AT(regulation_item, article), .null = SILENT},
    {"standards_year", "", "year of that act", .from = standards_of, AT(regulation_item, year), .null = SILENT},
    {"turn_y", "y", "age of the oldest shoots at a cut", AT(compliance, turn), .null = NEVER_CUT},
    {"turn_least", "y", "age asked for at least", .from = turn_of, AT(regulation_item, least), .null = SILENT},
    {"turn_most", "y", "at most", .from = turn_of, AT(regulation_item, most), .null = "there is no such limit"},
    {"turn_met", "", "whether that is kept", .value = turn_met, .null = SILENT ", or " NEVER_CUT},
    {"turn_article", "", "article and act", .from = turn_of, AT(regulation_item, article), .null = SILENT},
    {"turn_year", "", "year of that act", .from = turn_of, AT(regulation_item, year), .null = SILENT},
    END};

static const struct ceduo_figure stand_columns[] = {
    {"name", "", "name of the stand", .from = belt_of, AT(belt, name_given)},
    {"from_m", "m", "where the belt begins", .from = belt_of, AT(belt, from_given)},
    {"to_m", "m", "where it ends", .from = belt_of, AT(belt, to_given)},
    {.from = stand_of, .of = stand_result},
    END};
static const struct ceduo_figure stand_warnings[] = {{"warnings", "", "sentences about this stand", .say = say_of_stand}, END};

static const struct ceduo_figure stand[] = {
    {.of = stand_columns},
    {.of = stand_warnings},
    {"rules", "", "what the rules of the region ask of a coppice, and whether it is kept", .from = rules_of, .of = rules,
     .null = "the scene names no rules, or the stand is no coppice"},
    END};

static const struct ceduo_figure summary[] = {
    {"length_m", "m", "wooded length", AT(index, length)},
    {"longest_gap_m", "m", "longest stretch without stems", AT(index, longest_gap)},
    {"adc_m", "m", "length_m over contacts", .value = mean_adc, .null = "there are no contacts"},
    {"contacts", "", "contacts in all belts", AT(index, contacts)},
    {"meet_nothing_probability", "", "chance of meeting no stem in any belt", AT(index, meet_nothing_probability)},
    {"dissipated_kJ", "kJ", "energy that the stems could take", AT(index, dissipated), .scale = J_TO_KJ},
    {"dissipated_kJ_per_100m", "kJ", "the same per 100 m of wooded length", .value = index_per_100m, .scale = J_TO_KJ,
     .null = "there is no forest"},
    {"passes_threshold", "", "whether lights.contact of the last control is pass", .value = passes_contact},
    END};

static const struct ceduo_figure by_index[] = {
    {"dissipated_kJ", "kJ", "energy that the stems between the release and this control could take", AT(index, dissipated),
     .scale = J_TO_KJ},
    {"residual_kJ", "kJ", "the mean of bare.energy_kJ less that, and not below 0", AT(index, residual), .scale = J_TO_KJ,
     .null = "no rock arrives without forest"},
    {"exhausted", "", "true if stems could take more than the mean energy", .value = exhausted_of,
     .null = "no rock arrives without forest"},
    {"measured_kJ", "kJ", "energy of translation of the rock at measured_speed_m_s", AT(index, measured), .scale = J_TO_KJ,
     .null = "the control has no measured_speed_m_s"},
    END};

static const struct ceduo_figure lights[] = {
    {"contact", "", "whether the stand makes contact often enough", LIGHT_AT(contact)},
    {"free_run", "", "whether long runs without contact are rare enough", LIGHT_AT(free_run)},
    {"energy", "",
     "whether few enough rocks arrive with too much energy; unknown without accepted_kJ and with "
     "contact_model: index",
     LIGHT_AT(energy)},
    {"contact_8cm", "", "contact, counting only stems from 8 cm on (from contact_dbh_m if that is more)",
     LIGHT_AT(thick.contact)},
    {"free_run_8cm", "", "free_run, counting likewise", LIGHT_AT(thick.free_run)},
    END};

#define ANSWERS "yes, no, not-decided (the 95 % interval holds the limit), nothing (hardly a rock arrives even without forest)"
static const struct ceduo_figure verdict_of_other[] = {
    {"answer", "", "the same by that law, but depends where one law says yes and the other no", .value = judgement_of_other,
     .null = UNSAID},
    END};

static const struct ceduo_figure other_mean[] = {
    {"mean", "", "mean", AT(alternative_energy, arrivals.energy.mean), .null = NO_ROCK},
    {"se", "", "standard error of the mean", AT(alternative_energy, arrivals.energy.se), .null = FEW},
    END};

static const struct ceduo_figure other_energy[] = {
    {"model", "", "that law: dorren, or brauner where all stems of the option follow dorren", .value = energy_model_at,
     .offset = offsetof(struct ceduo_alternative_energy, model)},
    {"rocks", "", "simulated under it: the first 10240 of the run, if it has more", AT(alternative_energy, arrivals.released)},
    {"reach_probability", "", "share of these that reach the control", AT(alternative_energy, arrivals.reach.mean)},
    {"reach_lo", "", "lower end of its 95 % interval", AT(alternative_energy, arrivals.reach.lo)},
    {"reach_hi", "", "upper end of its 95 % interval", AT(alternative_energy, arrivals.reach.hi)},
    {"exceed_probability", "", "share of these that reach it with more than accepted_kJ",
     AT(alternative_energy, arrivals.exceed.mean), .null = UNSAID},
    {"exceed_lo", "", "lower end of its 95 % interval", AT(alternative_energy, arrivals.exceed.lo), .null = UNSAID},
    {"exceed_hi", "", "upper end of its 95 % interval", AT(alternative_energy, arrivals.exceed.hi), .null = UNSAID},
    {"energy_kJ", "kJ", "energy of the rocks that reach it", .of = other_mean, .scale = J_TO_KJ},
    {"verdict", "", "what is said of the control", .of = verdict_of_other},
    END};

static const struct ceduo_figure verdict[] = {
    {"answer", "",
     "whether the forest keeps rocks with more than accepted_kJ to at most 5 of 100 in every year of the window (with blocks: "
     "to one "
     "in accepted_return_y years, in the mean of the window); without a window, today: " ANSWERS,
     .value = judgement_of, .null = UNSAID ", or contact_model is index"},
    {"today", "", "the same today", .value = judgement_today, .null = UNSAID ", contact_model is index, or of a year"},
    {"because", "", "why, in a sentence", .say = say_because, .one = true},
    END};

static const struct ceduo_figure topography[] = {
    {"reach_angle_deg", "deg", "inclination of the line from the release", AT(topography, reach), .scale = DEGREES},
    {"shadow_angle_deg", "deg", "inclination of the line from the foot of the face", AT(topography, shadow), .scale = DEGREES,
     .null = "no ground steeper than 45 degrees over 5 m lies between release and control"},
    END};

static const struct ceduo_figure control[] = {
    {"x_m", "m", "as in the scene", .from = control_of, AT(control, x_given)},
    {"name", "", "as in the scene", .from = control_of, AT(control, name_given), .null = "the control has none"},
    {"accepted_kJ", "kJ", "as in the scene", .from = control_of, .value = accepted_of, .null = "the control has none"},
    {"topography", "", "how the control lies below the release", .from = topography_of, .of = topography},
    {"bare", "", "what arrives without forest", .from = bare_of, .of = arrivals},
    {"index", "", "the index of the paper", .from = index_of, .of = by_index},
    {"wooded", "", "what arrives through the forest of this option", .from = wooded_of, .of = wooded,
     .null = "contact_model is index"},
    {"other_energy", "", "the same rocks under the other energy law of stems", .from = other_of, .of = other_energy,
     .null = "the option has no stems, contact_model is index, and in a year of --years"},
    {"lights", "", "verdicts on the way from the release to this control, each pass, fail or unknown, never merged into one",
     .from = index_of, .of = lights},
    {"verdict", "", "what is said of the control", .of = verdict},
    END};

#define ENDED(end) .value = share_at, .offset = offsetof(struct ceduo_simulated, ends.share[end])
static const struct ceduo_figure ends[] = {
    {"stopped_by_stems", "", "share of the released that stems stop", ENDED(CEDUO_STOPPED_BY_STEMS)},
    {"came_to_rest", "", "share that comes to rest by itself", ENDED(CEDUO_AT_REST)},
    {"left_slope", "", "share that leaves the profile", ENDED(CEDUO_LEFT_SLOPE)},
    {"unfinished", "", "count of rocks that were still moving after 1000000 contacts",
     AT(simulated, ends.count[CEDUO_UNFINISHED])},
    END};

static const struct ceduo_figure stops[] = {
    {"p50", "m", "median", .value = stop_at, .offset = offsetof(struct ceduo_ends, stop_p50)},
    {"p95", "m", "95th percentile", .value = stop_at, .offset = offsetof(struct ceduo_ends, stop_p95)},
    {"max", "m", "farthest", .value = stop_at, .offset = offsetof(struct ceduo_ends, stop_max)},
    END};

/* Rows that stand in several objects. */
static const struct ceduo_figure summary_row[] = {
    {"summary", "", "the forest between the release and the last control", .from = last_index_of, .of = summary}, END};
static const struct ceduo_figure forest_rows[] = {
    {"stands", "", "an object for each belt, in order", .of = stand, .enter = enter_belt},
    {.of = summary_row},
    {"controls", "", "an object for each control, in the scene's order", .of = control, .enter = enter_control},
    END};
static const struct ceduo_figure end_rows[] = {
    {"ends", "", "how the rocks end, over the whole profile, through the forest (with contact_model: index without it)",
     .from = flown_of, .of = ends},
    {"stop_x_m", "m", "places where rocks were stopped by stems or came to rest", .from = stops_of, .of = stops,
     .null = "no rock was stopped or came to rest"},
    END};
static const struct ceduo_figure year_rows[] = {
    {"year", "", "year, counted from the stands as filed", .from = year_of, AT(year, year)},
    {"cut", "", "whether a belt is cut in it", .from = year_of, AT(year, cut)},
    END};

static const struct ceduo_figure felling[] = {
    {"year", "", "year, counted from the stands as filed", .from = felling_of, AT(felling, year)},
    {"from_m", "m", "where the belt begins", .from = felled_belt_of, AT(belt, from_given)},
    {"to_m", "m", "where it ends", .from = felled_belt_of, AT(belt, to_given)},
    {"stems_per_ha", "1/ha", "stems felled", .from = felling_of, AT(felling, stems_per_ha)},
    {"volume_m3_ha", "m3/ha", "their volume", .from = felling_of, AT(felling, volume)},
    END};

#define NO_GROWTH "a stand says nothing of growth or cutting"
static const struct ceduo_figure yield_rows[] = {
    {"cut_m3_ha_per_year", "m3/ha", "volume felled per hectare of forest and year over a whole rotation",
     AT(yield, cut_per_year), .null = NO_GROWTH},
    {"standing_m3_ha_mean", "m3/ha", "volume standing, in the mean of that rotation", AT(yield, standing), .null = NO_GROWTH},
    {"died_m3_ha_per_year", "m3/ha", "volume of the stems that die between two cuts", AT(yield, died_per_year),
     .null = NO_GROWTH},
    END};
static const struct ceduo_figure yield_columns[] = {{.from = yield_of, .of = yield_rows}, END};
static const struct ceduo_figure yield[] = {{.of = yield_columns},
                                            {"cuts", "",
                                             "an object for each cut, up to the one that ends the first whole rotation",
                                             .of = felling, .enter = enter_felling},
                                            END};

static const struct ceduo_figure year[] = {{.of = year_rows}, {.of = forest_rows}, END};

#define FAILS(which) .value = fails_of, .offset = offsetof(struct ceduo_place, sum.which), .null = NOTHING_SAID
#define NOTHING_SAID "nothing can be said"
static const struct ceduo_figure rotation[] = {
    {"years", "", "how many years were computed", AT(place, sum.years)},
    {"felled_m", "m", "metres of belts felled in them, each time they are", .value = felled_of},
    {"unprotected_contact", "", "years in which lights.contact fails", FAILS(unprotected_contact)},
    {"unprotected_free_run", "", "years in which lights.free_run fails", FAILS(unprotected_free_run)},
    {"unprotected_contact_8cm", "", "years in which lights.contact_8cm fails", FAILS(thick_contact)},
    {"unprotected_free_run_8cm", "", "years in which lights.free_run_8cm fails", FAILS(thick_free_run)},
    {"unprotected_energy", "", "years in which lights.energy fails", .value = too_much_of,
     .null = "the control has no accepted_kJ, contact_model is index, or " NOTHING_SAID},
    {"reach_probability", "", "plain mean over the years", IN(place, sum.reach, paired)},
    {"exceed_probability", "", "plain mean over the years", IN(place, sum.exceed, paired)},
    {"energy_per_released_kJ", "kJ", "plain mean over the years", IN(place, sum.energy_per_released, paired), .scale = J_TO_KJ},
    {"worst_year", "", "year with the largest share that exceeds (or arrives, or with the largest ADC)",
     AT(place, sum.worst_year)},
    {"reach_per_year", "1/y", "rocks to be expected to arrive", AT(place, sum.passes_per_year),
     .null = "the scene has no rocks_per_year"},
    {"exceed_per_year", "1/y", "those of them with more than accepted_kJ", AT(place, sum.exceeds_per_year),
     .null = "the scene has no rocks_per_year, or the control no accepted_kJ"},
    END};

static const struct ceduo_figure window[] = {
    {"from", "y", "first year, counted from today", AT(choice, window.first)},
    {"to", "y", "last year", AT(choice, window.last)},
    {"mean", "", "share of the released that exceeds (without accepted_kJ: that arrives), mean of the years",
     AT(choice, mean.mean)},
    {"mean_lo", "", "lower end of its 95 % interval", .value = window_lo},
    {"mean_hi", "", "upper end of its 95 % interval", .value = window_hi},
    {"worst", "", "the share of the worst year", .value = window_worst},
    {"worst_year", "y", "that year", .value = window_worst_year},
    {"failing_years", "", "years in which lights.energy fails", .value = window_failing, .null = UNSAID},
    END};

#define NO_YEARS "--years is not given"
static const struct ceduo_figure option[] = {
    {"name", "", "name of the option", .from = option_of, AT(option, name_given)},
    {.of = forest_rows},
    {.of = end_rows},
    {"window", "", "the years by which options are judged and compared, at the last control", .from = window_of, .of = window,
     .null = "no option grows or is cut, or contact_model is index"},
    {"years", "", "an object for each year", .of = year, .enter = enter_year, .null = NO_YEARS},
    {"rotation", "", "the years together, at the last control", .from = rotation_of, .of = rotation, .null = NO_YEARS},
    {"yield", "", "stem wood that the option yields", .from = place_of_yield, .of = yield, .null = NO_GROWTH},
    END};

static const struct ceduo_figure share_difference[] = {
    {.of = paired},
    {"below", "", "if no rock fares differently: upper 95 % bound of the share that could", .value = below_of,
     .null = "rocks fare differently, or the forests are the same"},
    END};

static const struct ceduo_figure differences[] = {
    {"reach_probability", "", "difference of the shares that arrive", IN(difference, reach, share_difference)},
    {"exceed_probability", "", "difference of the shares that exceed", IN(difference, exceed, share_difference)},
    {"energy_per_released_kJ", "kJ", "difference of the energies over all released",
     IN(difference, energy_per_released, paired), .scale = J_TO_KJ},
    END};

static const struct ceduo_figure difference[] = {
    {"option", "", "option that is compared", .from = option_of, AT(option, name_given)},
    {"against", "", "the first option", .from = first_option_of, AT(option, name_given)},
    {"x_m", "m", "control", .from = control_of, AT(control, x_given)},
    {.from = difference_of, .of = differences},
    END};

static const struct ceduo_figure rock[] = {
    {"mass_kg", "kg", "mass", AT(rock, mass)},
    {"mean_diameter_m", "m", "mean of its dimensions: the diameter that meets the stems", AT(rock, mean_diameter)},
    {"moment_kg_m2", "kg m2", "moment of inertia", AT(rock, moment)},
    END};

static const struct ceduo_figure profile[] = {
    {"points", "", "its points, as given", .value = points_of},
    {"used", "", "points after simplifying, which are simulated", .value = used_of},
    {"tolerance_m", "m", "distance within which points are left out; 0: none", AT(slope, tolerance)},
    END};

static const struct ceduo_figure scene[] = {
    {"scene", "", "path of the file as it was given, or the name of a scene that comes with the program; standard input for -",
     .from = report_of, .value = path_of},
    {"title", "", "title of the scene, or the name of its file", .from = scene_of, AT(scene, title)},
    {"seed", "", "seed of the random numbers", .from = scene_of, AT(scene, simulation.seed)},
    {"rocks", "", "rocks flown", .from = report_of, .value = rocks_of},
    {"law", "", "law of the impacts: lumped, crsp or arm", .from = scene_of, .value = law_of},
    {"rock", "", "the rock; with spreads, that of the means", .from = rock_of, .of = rock},
    {"slope", "", "the profile", .from = slope_of, .of = profile},
    {"threshold_m", "m", "ADC below which a stand protects", .from = scene_of, AT(scene, simulation.threshold)},
    END};

static const struct ceduo_figure work[] = {
    {"rocks_flown", "",
     "rocks of all runs: one without forest, and one for each forest that differs, under "
     "each energy law; with --years of its years, too, but not of the window",
     AT(report, work.rocks)},
    {"contacts", "", "contacts with the ground, of all rocks", AT(report, work.contacts)},
    {"stems_drawn", "", "stems generated along their ways, hit or not", AT(report, work.stems.drawn)},
    {"runs", "", "runs computed", AT(report, work.runs)},
    {"runs_reused", "", "runs taken from the cache", AT(report, work.reused)},
    {"seconds", "s", "wall-clock time, the one value that changes from run to run", AT(report, seconds)},
    END};

const struct ceduo_figure ceduo_result_figures[] = {
    {"format", "", "always ceduo-result-1", .value = format_of},
    VERSION,
    {.of = scene},
    {"warnings", "",
     "sentences about the whole run: tolerance not met, rocks unfinished, shares too close to call, ground assumed",
     .say = say_of_run},
    {"options", "", "an object for each option, in the scene's order; a scene with forest has one, named current", .of = option,
     .enter = enter_option},
    {"differences", "", "an object for each option but the first, and each control; [] with one option", .of = difference,
     .enter = enter_difference},
    {"work", "", "what it took", .from = report_of, .of = work},
    END};

/* ---- a search ---- */

#define NONE "no value reaches the goal"
#define ONE  "a value reaches it"
static const struct ceduo_figure sought[] = {{"scene", "", "path of the file", .value = find_path},
                                             {"path", "", "path of the parameter", .from = search_of, AT(search, path)},
                                             {"option", "", "name of the option", .value = find_option},
                                             {"goal", "", "goal that was asked for", .from = search_of, .value = goal_of},
                                             {"target", "", "limit of the goal", .from = search_of, AT(search, target)},
                                             {"lo", "", "lower end of the range", .from = search_of, AT(search, lo)},
                                             {"hi", "", "upper end of the range", .from = search_of, AT(search, hi)},
                                             END};
static const struct ceduo_figure found_row[] = {
    {"found", "", "whether a value reaches the goal", .from = found_of, AT(found, found)}, END};
static const struct ceduo_figure value_row[] = {{"value", "", "the value", .from = found_of, AT(found, value), .null = NONE},
                                                END};
static const struct ceduo_figure side_row[] = {{"side", "", "smallest or largest: which of the values that reach it this is",
                                                .from = found_of, .value = side_of, .null = NONE},
                                               END};
static const struct ceduo_figure goal_rows[] = {
    {"goal_at_value", "", "goal at this value", .from = found_of, AT(found, goal_at_value), .null = NONE},
    {"nearest", "", "value that comes nearest", .from = nearest_of, AT(found, nearest), .null = ONE},
    {"goal_at_nearest", "", "goal at that value", .from = nearest_of, AT(found, goal_at_nearest), .null = ONE},
    END};
#define NOT_SURE "--sure is not given, or nothing is uncertain"
#define NO_ERROR NONE ", every value does, or the points do not tell it"
static const struct ceduo_figure sure_rows[] = {
    {"wanted", "", "share of what may be true in which the goal is to be reached", AT(reliability, sure)},
    {"found", "", "whether a value reaches it in so much", AT(reliability, found.found)},
    {"value", "", "the value", AT(reliability, found.value), .null = NONE},
    {"value_lo", "", "lower end of its 95 % interval, by the points and by the rocks", AT(reliability, lo), .null = NO_ERROR},
    {"value_hi", "", "its upper end", AT(reliability, hi), .null = NO_ERROR},
    {"side", "", "smallest or largest: which of the values that do this is", .value = sure_side, .null = NONE},
    {"probability", "", "share of what may be true in which this value reaches the goal", .from = sure_found_of,
     AT(reliability, share.value), .null = NONE},
    {"probability_se", "", "its standard error, by the points and by the rocks", .from = sure_found_of,
     AT(reliability, share.se), .null = NONE},
    {"nearest", "", "value that is surest", .from = sure_nearest_of, AT(reliability, found.nearest), .null = ONE},
    {"probability_at_nearest", "", "share in which that reaches the goal", .from = sure_nearest_of,
     AT(reliability, share.value), .null = ONE},
    {"evaluations", "", "values looked at", AT(reliability, found.evaluations)},
    {"points", "", "points of what may be true, for each", AT(reliability, points)},
    {"rocks", "", "rocks at each point", AT(reliability, rocks)},
    END};
static const struct ceduo_figure found_yield[] = {
    {.from = found_yield_of, .of = yield_rows},
    {"depends", "", "whether it depends on the value; otherwise it is the same over the whole range",
     AT(find_report, yield_depends)},
    END};
static const struct ceduo_figure search_rows[] = {
    {"monotone", "", "whether the goal only rises or only falls over the range", .from = found_of, AT(found, monotone)},
    {"evaluations", "", "values looked at", .from = found_of, AT(found, evaluations)},
    {"rocks", "", "rocks flown for each", .from = search_of, AT(search, rocks)},
    {"over", "", "today, or rotation: over one whole rotation, where the parameter is one of growth or cutting",
     .from = search_of, .value = over_of},
    {"yield", "", "stem wood that the option yields at this value", .from = yields_of, .of = found_yield, .null = NO_GROWTH},
    {"sure", "", "the same search with uncertain inputs", .from = sure_of, .of = sure_rows, .null = NOT_SURE},
    END};

const struct ceduo_figure ceduo_find_figures[] = {{"format", "", "always ceduo-find-1", .value = find_format},
                                                  VERSION,
                                                  {.of = sought},
                                                  {.of = found_row},
                                                  {.of = value_row},
                                                  {.of = side_row},
                                                  {.of = goal_rows},
                                                  {.of = search_rows},
                                                  END};
static const struct ceduo_figure find_columns[] = {
    {.of = sought}, {.of = value_row}, {.of = goal_rows}, {.of = found_row}, {.of = side_row}, {.of = search_rows}, END};
const struct ceduo_csv ceduo_find_csv = {find_columns, {NULL}};

/* ---- rows of CSV ---- */

static const struct ceduo_figure option_row[] = {
    {"option", "", "name of the option", .from = option_of, AT(option, name_given)}, END};
static const struct ceduo_figure rest[] = {{.of = summary_row},
                                           {.of = control},
                                           {.of = end_rows},
                                           {"difference", "", "", .from = difference_of, .of = differences},
                                           {"yield", "", "", .of = yield_columns},
                                           {"warnings", "", "sentences about the run and its stands", .say = say_of_all},
                                           END};

static const struct ceduo_figure control_columns[] = {{.of = scene}, {.of = option_row}, {.of = rest}, END};
static const struct ceduo_figure year_columns[] = {{.of = scene}, {.of = option_row}, {.of = year_rows}, {.of = rest}, END};
static const struct ceduo_figure stand_csv_columns[] = {
    {.of = scene},          {.of = option_row},
    {.of = stand_columns},  {"rules", "", "", .from = rules_of, .of = rules},
    {.of = stand_warnings}, END};

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
    {"The object hazard", hazard_figures},
    {"Each rate of it", rate_figures},
    {"An object of years", year},
    {"An object of differences", difference},
    {NULL, NULL}};
