/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_INTL_H
#define CEDUO_INTL_H

#include <libintl.h>

/* Marks a string for translation; N_ only marks it, where it stands in a table. */
#define _(string) gettext(string)
#define N_(string) string

#endif
