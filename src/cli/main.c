/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <malloc.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <unistd.h>

#include "base/language.h"
#include "base/oom.h"
#include "batch.h"
#include "messages.h"
#include "tui/program.h"

/* End the program without memory, from any thread, without allocating. Edits are already in the recovery copy, which each edit
 * writes. Files are replaced atomically. */
static void end_without_memory(void)
{
    static atomic_flag ends = ATOMIC_FLAG_INIT;
    while (atomic_flag_test_and_set(&ends)) /* another thread ends the program */
        pause();
    fprintf(stderr, "ceduo: %s\n",
            ceduo_terminal_restore() ? _("out of memory; unsaved work was kept and is offered at the next start")
                                     : _("out of memory"));
    _exit(EXIT_RUN);
}

/* Replace GSL's handler, which aborts. Some functions of GSL use memory that they failed to allocate. */
static void on_gsl_error(const char *reason, const char *file, int line, int error)
{
    (void)reason, (void)file, (void)line;
    if (error == GSL_ENOMEM)
        end_without_memory();
}

static enum exit_status print_info(const struct arguments *a)
{
    LOCAL_TEXT(text);
    if (a->mode == MODE_HELP)
        ceduo_arguments_help(&text);
    else
        ceduo_text_format(&text, "ceduo %s\n", CEDUO_VERSION);
    ceduo_fit_charset(&text);
    return ceduo_output_write(a, &text);
}

static enum exit_status report_no_terminal(const char *reason)
{
    LOCAL_TEXT(text);
    ceduo_text_format(&text, _("ceduo: %s; use 'ceduo --batch SCENE.yaml', or try 'ceduo --help'\n"), reason);
    ceduo_print_error(&text);
    return EXIT_USAGE;
}

/* Open the terminal program, or run a script in it. */
static enum exit_status interact(const struct arguments *a)
{
    static const enum exit_status statuses[] = {EXIT_DONE, EXIT_USAGE, EXIT_INPUT, EXIT_OUTPUT}; /* of a script */
    const char *reason = a->script ? NULL : ceduo_terminal_missing();
    if (reason)
        return report_no_terminal(reason);
    struct app app;
    bool good = ceduo_program_create(&app, a->scenes_count > 0 ? a->scenes[0] : NULL, a->charset, (unsigned)a->threads,
                                     a->script != NULL);
    enum exit_status status = EXIT_INPUT;
    ceduo_print_problems(&app.document.problems);
    if (good && a->tour)
        ceduo_tour_start(&app, a->scenes_count > 0 ? a->scenes[0] : NULL);
    if (good && a->script) {
        status = statuses[ceduo_script_run(&app, a->script)];
    } else if (good) {
        enum terminal_end end = ceduo_terminal_run(&app);
        status = end == TERMINAL_DONE ? EXIT_DONE : EXIT_RUN;
        if (end == TERMINAL_NONE)
            status = report_no_terminal(_("this terminal cannot be used"));
    }
    ceduo_app_free(&app);
    return status;
}

int main(int argc, char **argv)
{
    ceduo_oom_hook = end_without_memory;
    /* If a standard stream is closed, open /dev/null in its place, so that no other file gets its number. The mode is inverted:
     * reading and writing must still fail. */
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
    ceduo_language_start();
    mallopt(M_TOP_PAD, 32 << 20); /* keep freed memory, which the next short run needs again */
    signal(SIGXFSZ, SIG_IGN);     /* a file size limit becomes an error like a full disk */
    gsl_set_error_handler(on_gsl_error);
    static enum exit_status (*const commands[])(const struct arguments *arguments) = {
        [MODE_TERMINAL] = interact,
        [MODE_BATCH] = ceduo_batch_run,
        [MODE_FIND] = ceduo_batch_run,
        [MODE_SENSITIVITY] = ceduo_batch_run,
        [MODE_CALIBRATE] = ceduo_batch_calibrate,
        [MODE_REPORT] = ceduo_batch_run,
        [MODE_CHECK] = ceduo_batch_run,
        [MODE_PARAMETERS] = ceduo_batch_parameters,
        [MODE_PROFILES] = ceduo_batch_profiles,
        [MODE_COLUMNS] = ceduo_batch_columns,
        [MODE_SCHEMA] = ceduo_batch_schema,
        [MODE_SURVEY] = ceduo_batch_survey,
        [MODE_HELP] = print_info,
        [MODE_VERSION] = print_info,
    };
    struct arguments arguments;
    enum exit_status status = ceduo_arguments_read(&arguments, argc, argv);
    if (status == EXIT_DONE) /* report an unwritable output before computing */
        status = ceduo_output_check(&arguments) ? commands[arguments.mode](&arguments) : EXIT_OUTPUT;
    ceduo_clear_progress();
    ceduo_arguments_free(&arguments);
    return (int)status;
}
