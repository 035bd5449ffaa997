/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHANGES_H
#define CEDUO_CHANGES_H

#include "document.h"

/* What is to be changed at once, and how that is said: for the files that know what goes with a value. */

#define CHANGES_MOST 64

struct changes {
    struct document *d;
    const char *sets[CHANGES_MOST]; /* as of ceduo_document_set_all() */
    size_t n;
    struct text taken, filled, followed;
    struct text refused; /* why it cannot be; "": it can, as far as is known */
    bool failed;
};

void ceduo_changes_add(struct changes *changes, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A number of so many digits as text. */
const char *ceduo_changes_rounded(double value, int digits, char room[CEDUO_NUMBER_ROOM]);

/* Adds what follows a value that is changed: the neighbours of a border, so that there is no new gap and no overlap; a
 * height that is assumed, by its diameter. Says what does not follow: shoots that are given per hectare, standards. */
void ceduo_changes_follow(struct changes *changes, const char *path, const char *value);

#endif
