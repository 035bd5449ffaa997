/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FUZZY_H
#define CEDUO_FUZZY_H

/* How well a text matches what was typed: the letters typed must stand in it in their order, in whatever case. -1:
 * they do not. Better where words begin with them and where they stand together; best where the text begins with all
 * of them. */
int ceduo_fuzzy_match(const char *typed, const char *text);

#endif
