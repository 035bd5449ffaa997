/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <unistd.h>

#include "base/language.h"
#include "base/must.h"
#include "batch.h"
#include "ceduo/version.h"
#include "command_line.h"
#include "localize.h"
#include "output.h"
#include "say.h"
#include "tui/terminal.h"

/* Ends the program without memory, from any thread; nothing here allocates. What a person has edited is in the recovery
 * copy already, which each edit writes; a file is put in its place whole or not at all. */
static void end_without_memory(void)
{
    static atomic_flag ends = ATOMIC_FLAG_INIT;
    while (atomic_flag_test_and_set(&ends)) /* another thread does it */
        pause();
    fputs(ceduo_terminal_restore() ? _("ceduo: out of memory; unsaved work was kept and is offered at the next start\n")
                                   : _("ceduo: out of memory\n"),
          stderr);
    _exit(EXIT_RUN);
}

/* GSL's own handler would abort. Some of its functions go on with what they could not allocate. */
static void on_gsl_error(const char *reason, const char *file, int line, int error)
{
    (void)reason, (void)file, (void)line;
    if (error == GSL_ENOMEM)
        end_without_memory();
}

/* A file opened later must not become standard output by chance. Reading from or writing to a closed one then fails as
 * it should: /dev/null is opened the wrong way round. */
static void keep_standard_streams(void)
{
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

static enum exit_status print(const struct arguments *a, void (*fill)(struct text *text))
{
    struct text text = {0};
    fill(&text);
    ceduo_say_plainly(&text);
    enum exit_status status = ceduo_output_write(a, &text);
    ceduo_text_free(&text);
    return status;
}

static void fill_version(struct text *text)
{
    ceduo_text_format(text, "ceduo %s\n", CEDUO_VERSION);
}

static enum exit_status act(const struct arguments *a)
{
    if (!ceduo_output_check(a)) /* told before anything is computed */
        return EXIT_OUTPUT;
    switch (a->mode) {
    case MODE_BATCH:
        return ceduo_batch_run(a);
    case MODE_FIND:
        return ceduo_batch_find(a);
    case MODE_SENSITIVITY:
        return ceduo_batch_sensitivity(a);
    case MODE_REPORT:
        return ceduo_batch_report(a);
    case MODE_CALIBRATE:
        return ceduo_batch_calibrate(a);
    case MODE_CHECK:
        return ceduo_batch_check(a);
    case MODE_PARAMETERS:
        return ceduo_batch_parameters(a);
    case MODE_PROFILES:
        return ceduo_batch_profiles(a);
    case MODE_COLUMNS:
        return ceduo_batch_columns(a);
    case MODE_SCHEMA:
        return ceduo_batch_schema(a);
    case MODE_SURVEY:
        return ceduo_batch_survey(a);
    case MODE_HELP:
        return print(a, ceduo_arguments_help);
    case MODE_VERSION:
        return print(a, fill_version);
    default:
        return ceduo_interactive_run(a);
    }
}

int main(int argc, char **argv)
{
    ceduo_memory_hook = end_without_memory;
    keep_standard_streams();
    ceduo_language_start();
    signal(SIGXFSZ, SIG_IGN); /* a file that is too large for its limit is an error like a full disk */
    gsl_set_error_handler(on_gsl_error);
    struct arguments arguments;
    enum exit_status status = ceduo_arguments_read(&arguments, argc, argv);
    if (status == EXIT_DONE)
        status = act(&arguments);
    ceduo_say_no_progress();
    ceduo_arguments_free(&arguments);
    return (int)status;
}
