/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIT_DOUBT_H
#define CEDUO_FIT_DOUBT_H

#include "io/node.h"

/* Rows of `doubt` name values of the scene by their paths. An edit may take such a value away, or move the forest into
 * options: then the rows go along, so that no edit is refused for what is only said about a value. */

/* The scene without the rows that `problems` complains about; the scene itself where there are none. NULL without memory. */
const struct node *ceduo_doubt_without(struct arena *arena, const struct node *root, const struct problems *problems);

/* The scene with the rows about items of a list where these are once an item was put in before `index` (by 1) or that item
 * was taken out (by -1), whose rows go with it. NULL without memory, or for NULL. */
const struct node *ceduo_doubt_shifted(struct arena *arena, const struct node *root, const char *list, size_t index,
                                       int by);

/* The scene with the rows about "forest…" put to options: of one belt to the option "current", of all belts to all options.
 * NULL without memory. */
const struct node *ceduo_doubt_of_options(struct arena *arena, const struct node *root);

#endif
