/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Marks text for translation. Whole sentences, never pieces; where a number decides on the form, ngettext(). N_ only marks:
 * the libraries scene, core and study know no language, so what their tables say is marked there and translated with _()
 * where it is shown. What a file, JSON or CSV has is never translated. The language is set in cli/language.c; `make po`
 * brings the marked text into src/po. */
#ifndef CEDUO_LANGUAGE_H
#define CEDUO_LANGUAGE_H

#include <libintl.h>

#define _(string)  gettext(string)
#define N_(string) string

#endif
