/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "messages.h"

#include <fcntl.h>
#include <langinfo.h>
#include <limits.h>
#include <locale.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/language.h"
#include "view/cells.h"

bool ceduo_is_utf8(void)
{
    return strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
}

void ceduo_fit_charset(struct text *text)
{
    struct text plain = {0};
    if (ceduo_is_utf8())
        return;
    for (const char *p = ceduo_text_string(text), *sign; *p; p = sign) {
        LOCAL_TEXT(foreign);
        for (sign = p; *sign && (unsigned char)*sign < 0x80;)
            sign++;
        ceduo_text_append_n(&plain, p, (size_t)(sign - p));
        for (p = sign; (unsigned char)*sign >= 0x80;)
            sign++;
        ceduo_text_append_n(&foreign, p, (size_t)(sign - p));
        ceduo_cells_ascii(&plain, ceduo_text_string(&foreign));
    }
    ceduo_text_free(text);
    *text = plain;
}

static bool line_open; /* of progress */

void ceduo_show_progress(const char *format, ...)
{
    LOCAL_TEXT(line);
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&line, format, args);
    va_end(args);
    fprintf(stderr, "\r%-78s", ceduo_text_string(&line));
    line_open = true;
}

void ceduo_clear_progress(void)
{
    if (line_open)
        fprintf(stderr, "\r%-78s\r", "");
    line_open = false;
}

void ceduo_print_error(struct text *text)
{
    if (text->length == 0)
        return;
    ceduo_clear_progress();
    ceduo_fit_charset(text);
    fputs(ceduo_text_string(text), stderr);
}

void ceduo_print_problems(struct problems *problems)
{
    ceduo_problems_print(problems);
    ceduo_print_error(&problems->text);
    ceduo_problems_free(problems);
}

void ceduo_print_message(const char *subject, const char *text)
{
    LOCAL_TEXT(line);
    ceduo_text_append_escaped(&line, subject);
    ceduo_text_append(&line, ": ");
    ceduo_text_append_escaped(&line, text);
    ceduo_text_append_char(&line, '\n');
    ceduo_print_error(&line);
}

enum exit_status ceduo_usage_error(const char *option, const char *format, ...)
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
    ceduo_text_append_escaped(&safe, message.bytes);
    ceduo_text_format(&line, _("ceduo: %s\ntry 'ceduo --help'\n"), safe.bytes);
    ceduo_print_error(&line);
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
        /* keep signals ignored that the parent ignored (nohup) */
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
        ceduo_clear_progress();
        raise(which);
    }
}

/* ---- the language ---- */

#ifndef CEDUO_LOCALEDIR
#define CEDUO_LOCALEDIR "/usr/local/share/locale"
#endif

/* Return the first of LC_ALL, the category and LANG that is set; "": none. */
static const char *get_locale(const char *category)
{
    const char *const names[] = {"LC_ALL", category, "LANG"};
    for (size_t i = 0; i < 3; i++) {
        const char *value = getenv(names[i]);
        if (value && value[0])
            return value;
    }
    return "";
}

/* Search the translation relative to the program, built or installed, then in the folder of the installation. Without it text
 * stays English. */
static void load_translation(void)
{
    static const char *const folders[] = {"locale", "build/release/locale", "../locale", "../share/locale", CEDUO_LOCALEDIR};
    char self[PATH_MAX], path[2 * PATH_MAX];
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    self[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(self, '/');
    const int length = slash ? (int)(slash + 1 - self) : 0;
    bool found = false;
    for (size_t i = 0; !found && i < sizeof folders / sizeof folders[0]; i++) {
        const bool is_absolute = folders[i][0] == '/';
        snprintf(path, sizeof path, "%.*s%s/it/LC_MESSAGES/ceduo.mo", is_absolute ? 0 : length, self, folders[i]);
        const int fd = is_absolute || slash ? open(path, O_RDONLY | O_CLOEXEC) : -1;
        struct stat st;
        if (fd >= 0 && fstat(fd, &st) == 0 && st.st_size > 0) {
            void *bytes = mmap(NULL, (size_t)st.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
            found = bytes != MAP_FAILED && ceduo_language_use(bytes, (size_t)st.st_size);
            if (!found && bytes != MAP_FAILED)
                munmap(bytes, (size_t)st.st_size);
        }
        if (fd >= 0)
            close(fd);
    }
}

void ceduo_language_set(const char *language)
{
    if (strcmp(language, "en") == 0) {
        ceduo_language_use(NULL, 0);
        setlocale(LC_MESSAGES, "C");
    } else {
        load_translation();
        setenv("LANGUAGE", language, 1); /* for messages of the system */
        setlocale(LC_MESSAGES, "");
    }
}

/* True if the name of a locale, or an item of LANGUAGE, is Italian: "it_IT.UTF-8@euro", but not "italic". */
static bool is_italian(const char *name)
{
    return strncmp(name, "it", 2) == 0 && strchr("_.@:", name[2]);
}

void ceduo_language_start(void)
{
    const char *characters = get_locale("LC_CTYPE"), *messages = get_locale("LC_MESSAGES");
    const char *dot = strchr(characters, '.'), *language = getenv("LANGUAGE");
    bool utf8 = dot && (strncasecmp(dot, ".utf-8", 6) == 0 || strncasecmp(dot, ".utf8", 5) == 0);
    if (!setlocale(LC_CTYPE, "") && utf8)
        setlocale(LC_CTYPE, "C.UTF-8");
    setlocale(LC_MESSAGES, "");
    if (!messages[0] || strcmp(messages, "C") == 0 || strcmp(messages, "POSIX") == 0)
        return;
    bool italian = false;
    for (const char *item = language && language[0] ? language : messages; item && !italian; item = strchr(item, ':')) {
        item += *item == ':';
        italian = is_italian(item);
    }
    if (italian)
        load_translation();
}
