/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mark text for translation: whole sentences, with ngettext() if a number determines the form. N_ only marks text, because
 * scene, core and study do not translate; the caller that displays their text translates it with _(). Text in files, JSON and
 * CSV is never translated. cli/messages.c sets the language; `make po` brings marked text into src/po. */
#ifndef CEDUO_LANGUAGE_H
#define CEDUO_LANGUAGE_H

#include <stdbool.h>
#include <stddef.h>

#define _(string)  ceduo_translate(string)
#define N_(string) string

/* N_ and _ with a context, for a word with several translations, such as the head of a narrow column. */
#define NP_(context, string) context "\004" string
#define P_(context, string)  ceduo_translate_in(NP_(context, string))

/* Return the singular or the plural form, by n. */
#define ngettext(one, many, n) ceduo_translate_n(one, many, n)

const char *ceduo_translate(const char *string) __attribute__((format_arg(1)));
const char *ceduo_translate_n(const char *one, const char *many, unsigned long n) __attribute__((format_arg(1), format_arg(2)));
const char *ceduo_translate_in(const char *marked);

/* Translate by a catalogue that msgfmt made; the caller keeps its memory. Text stays English before, with NULL, and if the
 * catalogue is damaged; then return false. gettext() is not used, because it needs a locale other than C and C.UTF-8. */
bool ceduo_language_use(const char *bytes, size_t size);

/* Return the text of a file in the language of the program. `italian` may be NULL. */
const char *ceduo_in_language(const char *english, const char *italian);

/* Return the text of an error of the system, as strerror(), which needs a locale to translate it. */
const char *ceduo_error_text(int error);

/* While on, text of this thread stays English, so that sentences in JSON and CSV do not depend on the language. */
void ceduo_language_set_data(bool on);

#endif
