/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Titles and sources of the scenes, slopes and stands that come with the program, and notes of its regions: their files stay
 * as they are, a page says them in its language. */
#include <string.h>

#include "base/language.h"
#include "words.h"

static const char *const shipped[] = {
    /* titles of scenes */
    N_("Blocks above the road"),
    N_("Four systems, before and after the cut"),
    N_("Test site of Ciabocco et al. 2009"),
    N_("A made-up quarry with 50 stops"),
    N_("Small blocks above a road, which coppice?"),
    N_("Through a rotation, which system lets fewest rocks pass?"),
    N_("Standards in two cuts, or selection"),
    N_("Fell the wood at once, or in three sections?"),
    N_("Standards one by one, or in groups"),
    N_("House below a terrace, which wood guards it?"),
    N_("Tschamut 2014, a bare meadow"),
    N_("Vaujany, bare and in forest (figures to be checked)"),
    /* what is assumed */
    N_("a block in two years, the number above a volume v as v^-1.1: to be counted at the foot of the cliff"),
    N_("accepted_kJ 50 is assumed"),
    N_("accepted_kJ 50 is assumed; x_m and the speed, measured on one rock by video: Ciabocco, Boccia and Ripa "
       "2009, Table 2 and section 2"),
    N_("beech, Table 4, for hop hornbeam: 20 % either way"),
    N_("25 % either way: Tabacchi et al. 2011 give less for this diameter and height"),
    N_("25 % either way"),
    N_("error of one sample plot, 15 % either way"),
    N_("10 % either way"),
    N_("limestones and dolomites"),
    N_("tangent of 17 to 39 degrees"),
    N_("0.3 in Table 2, not measured"),
    N_("made up"),
    N_("a guess before anything was seen"),
    N_("computed by ceduo at Rn 0.36, Rt 0.87, roughness 0.24 rad, friction 0.55"),
    N_("blocks of 0.05 to 0.2 m3, all sizes equally likely; density of limestone"),
    N_("blocks leave the top of the rock face at a walking pace"),
    N_("accepted_kJ 20 is assumed; 20 to 50 would be plausible"),
    N_("the belts, the years of their cuts, the law of impact, 2 rocks a year"),
    N_("accepted_kJ 50 is assumed; x_m: Ciabocco, Boccia and Ripa 2009, Table 2"),
    N_("blocks of 0.6 to 1 m3; density of limestone"),
    N_("accepted_kJ 80 is assumed, for a wall of masonry"),
    N_("to be checked: mean diameter of the rocks; the density is a guess"),
    N_("to be checked: rocks were pushed off by an excavator"),
    N_("to be checked: 38 degrees; the line where rocks were counted is taken 176 m from the release along the map"),
    N_("a start for the fit"),
    N_("to be checked: 290 stems per hectare of 31 cm, standard deviation 21 cm; species, height and volume are "
       "guesses"),
    N_("to be checked: 95 % of some 100 rocks"),
    N_("to be checked: 15.4 m/s; the standard deviation is a guess"),
    N_("to be checked: 34 % of some 100 rocks"),
    N_("to be checked: 11.7 m/s; the standard deviation is a guess"),
    N_("profile and choice of grounds are made up; their Rn and Rt are the middle of ranges in use with CRSP 3.0 "
       "(Pfeiffer et al. 1993)"),
    N_("fitted for the law arm to the stops of all three blocks; mu is not determined; rt has no part in it"),
    N_("curves of growth, shoots a stool and greatest density are of the right size; none is measured"),
    N_("engineering figure typical of beech coppice"),
    N_("usual rotation; the 180 in four ages meet the minimum of the Umbrian forest regulation (Gazzetta "
       "Ufficiale of 24 May 2003, Art. 23)"),
    N_("usual rotation; engineering figure"),
    N_("every 14 years the oldest of three cohorts, then 42 years old; 40 a hectare, minimum of the Tuscan forest"
       " regulation (Gazzetta Ufficiale of 13 April 2002, Art. 25), their age assumed"),
    N_("usual rotation; 80 a hectare, minimum for beech and oaks of the Ligurian forest regulation (Gazzetta "
       "Ufficiale of 19 February 2000, Art. 42), half of them from the cut before"),
    N_("engineering figure typical of chestnut coppice"),
    N_("engineering figure; the 70 in two ages are the most that the Umbrian forest regulation has for chestnut, "
       "two thirds of them one rotation old (Gazzetta Ufficiale of 24 May 2003, Art. 23)"),
    N_("value of beech, Ciabocco, Boccia and Ripa 2009, Table 4, by 45/104, the work to maximum load of American "
       "chestnut over that of American beech (Wood Handbook, FPL-GTR-190, 2010, Table 5-3a)"),
    N_("usual rotation; the 70 in two ages are the most that the Umbrian forest regulation has for chestnut, two "
       "thirds of them one rotation old (Gazzetta Ufficiale of 24 May 2003, Art. 23)"),
    N_("every 10 years the oldest of three cohorts, then 30 years old; 40 a hectare, minimum of the Tuscan forest"
       " regulation (Gazzetta Ufficiale of 13 April 2002, Art. 25), their age assumed"),
    N_("usual rotation; 30 a hectare, minimum for chestnut of the Tuscan forest regulation (Gazzetta Ufficiale of"
       " 13 April 2002, Art. 24), half of them from the cut before"),
    N_("engineering figure typical of Apennine coppice; their shoots were just cut"),
    N_("engineering figure; the 180 in four ages meet the minimum of the Umbrian forest regulation (Gazzetta "
       "Ufficiale of 24 May 2003, Art. 23)"),
    N_("value of beech, Ciabocco, Boccia and Ripa 2009, Table 4, taken for hop hornbeam as that paper does for "
       "its coppice"),
    N_("six trees; discs half as wide as trees of 12 m are high, 30 groups a hectare or 18 m apart, as the "
       "Umbrian forest regulation allows (Gazzetta Ufficiale of 24 May 2003, Art. 30)"),
    N_("engineering figure typical of Apennine coppice"),
    N_("after the Swiss guideline NaiS (Frehner, Wasser, Schwitter 2005), to be checked against the guideline; "
       "height by the beech curve H = 1.3 + 73.805 d - 54.734 d^2, d in m (Quetel 2005, cited in the thesis of "
       "Toe, Grenoble)"),
    N_("usual rotation; engineering figure typical of Apennine coppice"),
    N_("engineering figure typical of manna ash coppice"),
    N_("value of beech, Ciabocco, Boccia and Ripa 2009, Table 4, taken for manna ash as that paper does for its "
       "coppice"),
    N_("engineering figure typical of downy oak coppice"),
    N_("value of beech, Ciabocco, Boccia and Ripa 2009, Table 4, taken for downy oak; American beech and white "
       "oak differ by 2 % in work to maximum load (Wood Handbook, FPL-GTR-190, 2010, Table 5-3a)"),
    N_("engineering figure typical of Turkey oak coppice"),
    N_("value of beech, Ciabocco, Boccia and Ripa 2009, Table 4, taken for Turkey oak; American beech and white "
       "oak differ by 2 % in work to maximum load (Wood Handbook, FPL-GTR-190, 2010, Table 5-3a)"),
    N_("every half rotation the oldest of three cohorts, then 39 years old; 40 a hectare, minimum of the Tuscan "
       "forest regulation (Gazzetta Ufficiale of 13 April 2002, Art. 25), their age assumed"),
    N_("usual rotation; 60 a hectare, minimum of the Ministry Decree Law of 11 November 1964 (Ciabocco, Boccia "
       "and Ripa 2009, section 4.2), half of them from the cut before, as the Tuscan forest regulation asks "
       "(Gazzetta Ufficiale of 13 April 2002, Art. 24)"),
    /* notes of regions */
    N_("only the 60 standards that Ciabocco, Boccia and Ripa 2009 cite are checked; D.G.R. 1732 of 2018 has rules of "
       "its own"),
    N_("at least half of the standards come from earlier cuts, evenly spread (art. 22); the turns are those of "
       "the regulation before, 44/R of 2001, whose 'carpino' is not taken for hop hornbeam"),
    N_("R.R. 11 of 2012 changed art. 26 and 33; a simple coppice has at most two thirds of the minimum, above the"
       " maximum it is one with large reserves (art. 23)"),
};

const char *ceduo_words_shipped(const char *text)
{
    for (size_t i = 0; i < sizeof shipped / sizeof shipped[0]; i++)
        if (strcmp(shipped[i], text) == 0)
            return _(shipped[i]);
    return text;
}
