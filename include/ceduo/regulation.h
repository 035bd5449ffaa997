/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REGULATION_H
#define CEDUO_REGULATION_H

#include "stand.h"

/* What the forest regulation of a region asks of a coppice. */
struct ceduo_regulation_item {
    size_t species_count; /* 0: all others */
    char **species;       /* by their names in ceduo_species_list() */
    int system;           /* of this system alone; -1: of any */
    double least, most;   /* standards per ha, or years; most: NaN where there is none */
    char *article;        /* and the act that it is of */
    unsigned year;        /* of that act */
};

struct ceduo_regulation {
    char *name;           /* of the region; NULL: there is none */
    char *note, *note_it; /* NULL: none; in Italian, NULL: not said */
    size_t standards_count, turns_count;
    struct ceduo_regulation_item *standards, *turns; /* the first that is about a stand counts */
};

/* How a coppice stands to it. */
struct ceduo_compliance {
    const struct ceduo_regulation *of;                              /* NULL: there is none, or the stand is no coppice */
    const struct ceduo_regulation_item *standards_item, *turn_item; /* NULL: it says nothing of this species */
    double standards;             /* per ha: those that a cut leaves; where the stand does not say, its trees */
    double turn;                  /* years: age of the oldest shoots at a cut; NaN: the stand is never cut */
    bool standards_met, turn_met; /* where there is an item, and a turn */
};

struct ceduo_compliance ceduo_regulation_check(const struct ceduo_regulation *regulation, const struct ceduo_stand *stand);

#endif
