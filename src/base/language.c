/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "language.h"

#include <locale.h>
#include <string.h>

static _Thread_local bool data_language;

void ceduo_language_of_data(bool on)
{
    data_language = on;
}

const char *ceduo_translate(const char *string)
{
    return data_language || !string[0] ? string : gettext(string); /* the translation of "" is the header of the catalogue */
}

const char *ceduo_in_language(const char *english, const char *italian)
{
    return italian && strcmp(ceduo_translate(N_("en")), "it") == 0 ? italian : english; /* "en" is translated to its own code */
}

const char *ceduo_translate_n(const char *one, const char *many, unsigned long n)
{
    return data_language ? n == 1 ? one : many : dcngettext(NULL, one, many, n, LC_MESSAGES);
}

const char *ceduo_translate_in(const char *marked)
{
    const char *found = ceduo_translate(marked), *context = strchr(marked, '\004');
    return found == marked && context ? context + 1 : found;
}
