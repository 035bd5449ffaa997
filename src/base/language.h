/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Marks text for translation. Whole sentences, never pieces; where a number decides on the form, ngettext(). N_ only marks: the
 * libraries scene, core and study know no language, so what their tables say is marked there and translated with _() where
 * it is shown. What a file, JSON or CSV has is never translated. The language is set in cli/say.c; `make po` brings
 * the marked text into src/po. */
#ifndef CEDUO_LANGUAGE_H
#define CEDUO_LANGUAGE_H

#include <libintl.h>
#include <stdbool.h>

#define _(string)  ceduo_translate(string)
#define N_(string) string

/* A word that is not translated alike everywhere, as the head of a narrow column: N_ and _ with a context. */
#define NP_(context, string) context "\004" string
#define P_(context, string)  ceduo_translate_in(NP_(context, string))

/* One of two forms, by the number. */
#undef ngettext
#define ngettext(one, many, n) ceduo_translate_n(one, many, n)

const char *ceduo_translate(const char *string) __attribute__((format_arg(1)));
const char *ceduo_translate_n(const char *one, const char *many, unsigned long n) __attribute__((format_arg(1), format_arg(2)));
const char *ceduo_translate_in(const char *marked);

/* What a file says in English, and perhaps in Italian (NULL: not): that of the language. */
const char *ceduo_in_language(const char *english, const char *italian);

/* Until it is taken back, text of this thread stays English: sentences in JSON and CSV are the same in every language. */
void ceduo_language_of_data(bool on);

#endif
