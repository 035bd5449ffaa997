/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text is translated by gettext(), which takes its language from LANGUAGE or from the name of the locale, and does nothing
 * in the locale C. A machine need not have the locale of a language: any other does, with LANGUAGE. */
#include "say.h"

#include <limits.h>
#include <locale.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/language.h"

#ifndef CEDUO_LOCALEDIR
#define CEDUO_LOCALEDIR "/usr/local/share/locale"
#endif

#define DOMAIN "ceduo"

/* The first of LC_ALL, the category and LANG that says something, or "". */
static const char *wanted_locale(const char *category)
{
    const char *const names[] = {"LC_ALL", category, "LANG"};
    for (size_t i = 0; i < 3; i++) {
        const char *value = getenv(names[i]);
        if (value && value[0])
            return value;
    }
    return "";
}

/* ---- where translations are ---- */

/* Beside the program, where it was built or installed, then in the folder of the installation. */
static void bind_domain(void)
{
    static const char *const near[] = {"locale", "build/release/locale", "../locale", "../share/locale"};
    char self[PATH_MAX], folder[PATH_MAX + 32];
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    self[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(self, '/');
    const char *found = CEDUO_LOCALEDIR;
    for (size_t i = 0; slash && i < sizeof near / sizeof near[0]; i++) {
        char path[sizeof folder + 64];
        snprintf(folder, sizeof folder, "%.*s/%s", (int)(slash - self), self, near[i]);
        snprintf(path, sizeof path, "%s/it/LC_MESSAGES/" DOMAIN ".mo", folder);
        if (access(path, R_OK) == 0) {
            found = folder;
            break;
        }
    }
    bindtextdomain(DOMAIN, found);
    bind_textdomain_codeset(DOMAIN, "UTF-8"); /* whatever the terminal takes: what is printed is made plain later */
    textdomain(DOMAIN);
}

/* ---- which one ---- */

/* Some versions of libc count C.UTF-8 as C: then another locale does, if there is one. */
static void use_translation(const char *language)
{
    static const char *const locales[] = {"it_IT.UTF-8", "C.UTF-8", "C.utf8", "en_US.UTF-8", "en_GB.UTF-8", "it_IT"};
    setenv("LANGUAGE", language, 1);
    setlocale(LC_MESSAGES, "");
    /* the header of a translation is that of the empty string */
    for (size_t i = 0; !dgettext(DOMAIN, "")[0] && i < sizeof locales / sizeof locales[0]; i++)
        setlocale(LC_MESSAGES, locales[i]);
}

void ceduo_language_set(const char *language)
{
    if (strcmp(language, "en") == 0)
        setlocale(LC_MESSAGES, "C");
    else
        use_translation(language);
}

void ceduo_language_start(void)
{
    const char *characters = wanted_locale("LC_CTYPE"), *messages = wanted_locale("LC_MESSAGES");
    const char *dot = strchr(characters, '.'), *language = getenv("LANGUAGE");
    bool utf8 = dot && (strncasecmp(dot, ".utf-8", 6) == 0 || strncasecmp(dot, ".utf8", 5) == 0);
    if (!setlocale(LC_CTYPE, "") && utf8)
        setlocale(LC_CTYPE, "C.UTF-8");
    bind_domain();
    bool italian = strncmp(messages, "it", 2) == 0 && strchr("_.@", messages[2]); /* "it_IT.UTF-8@euro", but not "italic" */
    if (!setlocale(LC_MESSAGES, "") && italian)
        use_translation(language && language[0] ? language : "it");
}
