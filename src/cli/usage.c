/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "usage.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/intl.h"
#include "base/text.h"

enum exit_status ceduo_usage_no_memory(void)
{
    fputs(_("ceduo: out of memory\n"), stderr);
    return EXIT_RUN;
}

enum exit_status ceduo_usage(const char *option, const char *format, ...)
{
    struct text message = {0}, safe = {0};
    va_list args;
    if (option)
        ceduo_text_format(&message, "--%s: ", option);
    va_start(args, format);
    ceduo_text_vformat(&message, format, args);
    va_end(args);
    ceduo_text_safe(&safe, message.bytes ? message.bytes : "");
    bool good = !message.failed && !safe.failed && safe.bytes;
    if (good)
        fprintf(stderr, _("ceduo: %s\ntry 'ceduo --help'\n"), safe.bytes);
    ceduo_text_free(&message);
    ceduo_text_free(&safe);
    return good ? EXIT_USAGE : ceduo_usage_no_memory();
}
