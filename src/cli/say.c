/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "say.h"

#include <langinfo.h>
#include <limits.h>
#include <locale.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/language.h"

bool ceduo_say_utf8(void)
{
    return strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
}

/* What is written in place of the signs that the program itself uses, and of accented letters, so that columns stay; none is
 * longer. */
static const char *const plain_signs[][2] = {
    {"\xe2\x80\xa6", "..."}, {"\xe2\x80\x93", "-"}, {"\xe2\x88\x92", "-"}, {"\xc2\xb1", "+-"}, {"\xc3\xa0", "a"},
    {"\xc3\xa8", "e"},       {"\xc3\xa9", "e"},     {"\xc3\xac", "i"},     {"\xc3\xb2", "o"},  {"\xc3\xb9", "u"},
    {"\xc3\x80", "A"},       {"\xc3\x88", "E"},     {"\xc2\xb3", "3"},     {"\xc2\xb2", "2"},  {"\xc3\x8c", "I"},
    {"\xc3\x92", "O"},       {"\xe2\x9c\x94", "+"}, {"\xe2\x9c\x98", "x"}};
#define PLAIN_SIGNS (sizeof plain_signs / sizeof plain_signs[0])

/* For a terminal that knows ASCII alone: what it cannot show otherwise becomes a question mark. */
void ceduo_say_plainly(struct text *text)
{
    size_t to = 0;
    if (ceduo_say_utf8())
        return;
    for (size_t i = 0; i < text->length; i++) {
        unsigned char c = (unsigned char)text->bytes[i];
        size_t sign = 0;
        while (sign < PLAIN_SIGNS && strncmp(text->bytes + i, plain_signs[sign][0], strlen(plain_signs[sign][0])) != 0)
            sign++;
        if (sign < PLAIN_SIGNS) {
            size_t n = strlen(plain_signs[sign][1]);
            memcpy(text->bytes + to, plain_signs[sign][1], n);
            to += n;
            i += strlen(plain_signs[sign][0]) - 1;
        } else if (c < 0x80) {
            text->bytes[to++] = text->bytes[i];
        } else if ((c & 0xc0) != 0x80) {
            text->bytes[to++] = '?';
        }
    }
    text->length = to;
    if (text->bytes)
        text->bytes[to] = '\0';
}

static bool line_open; /* of progress */

void ceduo_say_progress(const char *format, ...)
{
    LOCAL_TEXT(line);
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&line, format, args);
    va_end(args);
    fprintf(stderr, "\r%-78s", ceduo_text_string(&line));
    line_open = true;
}

void ceduo_say_no_progress(void)
{
    if (line_open)
        fprintf(stderr, "\r%-78s\r", "");
    line_open = false;
}

void ceduo_say(struct text *text)
{
    if (text->length == 0)
        return;
    ceduo_say_no_progress();
    ceduo_say_plainly(text);
    fputs(ceduo_text_string(text), stderr);
}

void ceduo_say_problems(struct problems *problems)
{
    ceduo_problems_close(problems);
    ceduo_say(&problems->text);
    ceduo_problems_free(problems);
}

void ceduo_say_why(const char *what, const char *why)
{
    LOCAL_TEXT(line);
    ceduo_text_safe(&line, what);
    ceduo_text_put(&line, ": ");
    ceduo_text_safe(&line, why);
    ceduo_text_char(&line, '\n');
    ceduo_say(&line);
}

enum exit_status ceduo_usage(const char *option, const char *format, ...)
{
    LOCAL_TEXT(message);
    LOCAL_TEXT(safe);
    LOCAL_TEXT(line);
    va_list args;
    if (option)
        ceduo_text_format(&message, "--%s: ", option);
    va_start(args, format);
    ceduo_text_vformat(&message, format, args);
    va_end(args);
    ceduo_text_safe(&safe, message.bytes);
    ceduo_text_format(&line, _("ceduo: %s\ntry 'ceduo --help'\n"), safe.bytes);
    ceduo_say(&line);
    return EXIT_USAGE;
}

/* ---- signals ---- */

static atomic_bool raised;
static volatile sig_atomic_t which;
static const int signals[] = {SIGINT, SIGTERM, SIGHUP};

static void on_signal(int number)
{
    which = number;
    atomic_store(&raised, true);
}

static void set_handlers(void (*handler)(int))
{
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        struct sigaction now, new = {.sa_handler = handler, .sa_flags = handler == on_signal ? (int)SA_RESETHAND : 0};
        sigemptyset(&new.sa_mask);
        /* what the caller of the program has switched off (nohup) stays off */
        if (sigaction(signals[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            sigaction(signals[i], &new, NULL);
    }
}

void ceduo_interrupt_catch(void)
{
    set_handlers(on_signal);
}

const atomic_bool *ceduo_interrupt_flag(void)
{
    return &raised;
}

void ceduo_interrupt_release(void)
{
    set_handlers(SIG_DFL);
    if (atomic_load(&raised)) {
        ceduo_say_no_progress();
        raise(which);
    }
}

/* ---- the language ---- */

/* Text is translated by gettext(), which takes its language from LANGUAGE or from the name of the locale, and does nothing
 * in the locale C. A machine need not have the locale of a language: any other does, with LANGUAGE. */
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
