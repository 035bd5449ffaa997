/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LOCALIZE_H
#define CEDUO_LOCALIZE_H

/* The language and characters of the environment. Numbers have a dot in every language: LC_NUMERIC stays that of C. */
void ceduo_language_start(void);

/* Another language: "it" or "en". Where its translation is not found, text stays English. */
void ceduo_language_set(const char *language);

#endif
