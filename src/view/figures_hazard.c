/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How often which energy arrives, where the scene has blocks. */
#include "figures_parts.h"
#include "words.h"

#define TOO_RARE "rocks arrive less often"
#define UNBOUND  "the rocks that arrive do not bound it"
#define NEVER    "the rate is 0"

const void *ceduo_hazard_of(const void *arrivals)
{
    const struct ceduo_hazard *h = &((const struct ceduo_arrivals *)arrivals)->hazard;
    return isnan(h->per_year) ? NULL : h;
}

static const void *exceed_item(const void *object, size_t i)
{
    const struct ceduo_hazard *h = object;
    return i < h->energies ? &h->exceed[i] : NULL;
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

const struct ceduo_figure ceduo_rate_figures[] = {{"per_year", "1/y", "rocks a year", AT(estimate, mean)},
                                                  {"lo", "1/y", "lower end of its 95 % interval", AT(estimate, lo)},
                                                  {"hi", "1/y", "upper end of its 95 % interval", AT(estimate, hi)},
                                                  END};

static const struct ceduo_figure exceed_rate[] = {{"energy_kJ", "kJ", "energy", AT(exceeding, energy), .scale = J_TO_KJ},
                                                  {.of = ceduo_rate_figures, .offset = offsetof(struct ceduo_exceeding, rate)},
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
    {.of = ceduo_rate_figures, .offset = offsetof(struct ceduo_intensity, within)},
    {"rate_left", "", "share of the rate without forest", AT(intensity, left), .null = "none arrive without forest"},
    {"to_30_years", "", "whether the energy of 30 years is in this class: a mark of the matrix", AT(intensity, of_return[1])},
    {"to_100_years", "", "the same of 100 years", AT(intensity, of_return[2])},
    {"to_300_years", "", "the same of 300 years", AT(intensity, of_return[3])},
    END};

const struct ceduo_figure ceduo_hazard_figures[] = {
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
