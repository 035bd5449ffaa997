/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOUBT_ROWS_H
#define CEDUO_DOUBT_ROWS_H

#include "io/node.h"

/* Rows of `doubt` name values of the scene by their paths. Where an edit moves such a value, they go along. Rows about what is
 * no longer there are passed over by the reader. */

/* The scene with the rows about items of a list where these are once an item was put in before `index` (by 1) or that item
 * was taken out (by -1), whose rows go with it. NULL without memory, or for NULL. */
const struct node *ceduo_doubt_shifted(struct arena *arena, const struct node *root, const char *list, size_t index, int by);

/* The same once an item was moved from one place of the list to another. */
const struct node *ceduo_doubt_moved(struct arena *arena, const struct node *root, const char *list, size_t from, size_t to);

/* The same where rows call item `index` by a name that it is to lose: they call it by its number. */
const struct node *ceduo_doubt_unnamed(struct arena *arena, const struct node *root, const char *list, const char *name,
                                       size_t index);

/* The scene with the rows about "forest…" put to options: of one belt to the option "current", of all belts to all options.
 * NULL without memory. */
const struct node *ceduo_doubt_of_options(struct arena *arena, const struct node *root);

#endif
