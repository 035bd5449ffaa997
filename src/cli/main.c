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
#include "ceduo/status.h"
#include "say.h"
#include "tui/program.h"

/* Ends the program without memory, from any thread; nothing here allocates. What a person has edited is in the recovery
 * copy already, which each edit writes; a file is put in its place whole or not at all. */
static void end_without_memory(void)
{
    static atomic_flag ends = ATOMIC_FLAG_INIT;
    while (atomic_flag_test_and_set(&ends)) /* another thread does it */
        pause();
    fprintf(stderr, "ceduo: %s\n",
            ceduo_terminal_restore() ? _("out of memory; unsaved work was kept and is offered at the next start")
                                     : _("out of memory"));
    _exit(EXIT_RUN);
}

/* GSL's own handler would abort. Some of its functions go on with what they could not allocate. */
static void on_gsl_error(const char *reason, const char *file, int line, int error)
{
    (void)reason, (void)file, (void)line;
    if (error == GSL_ENOMEM)
        end_without_memory();
}

static enum exit_status print(const struct arguments *a)
{
    LOCAL_TEXT(text);
    if (a->mode == MODE_HELP)
        ceduo_arguments_help(&text);
    else
        ceduo_text_format(&text, "ceduo %s\n", CEDUO_VERSION);
    ceduo_say_plainly(&text);
    return ceduo_output_write(a, &text);
}

static enum exit_status no_terminal(const char *why)
{
    LOCAL_TEXT(text);
    ceduo_text_format(&text, _("ceduo: %s; use 'ceduo --batch SCENE.yaml', or try 'ceduo --help'\n"), why);
    ceduo_say(&text);
    return EXIT_USAGE;
}

/* Opens the terminal program, or feeds it the script that was given. */
static enum exit_status interact(const struct arguments *a)
{
    static const enum exit_status statuses[] = {EXIT_DONE, EXIT_USAGE, EXIT_INPUT, EXIT_OUTPUT}; /* of a script */
    const char *why = a->script ? NULL : ceduo_terminal_missing();
    if (why)
        return no_terminal(why);
    struct app app;
    bool good = ceduo_program_create(&app, a->scenes_count > 0 ? a->scenes[0] : NULL, a->charset, (unsigned)a->threads,
                                     a->script != NULL);
    enum exit_status status = EXIT_INPUT;
    ceduo_say_problems(&app.document.problems);
    if (good && a->script) {
        status = statuses[ceduo_script_run(&app, a->script)];
    } else if (good) {
        enum terminal_end end = ceduo_terminal_run(&app);
        status = end == TERMINAL_DONE ? EXIT_DONE : EXIT_RUN;
        if (end == TERMINAL_NONE)
            status = no_terminal(_("this terminal cannot be used"));
    }
    ceduo_app_free(&app);
    return status;
}

int main(int argc, char **argv)
{
    ceduo_memory_hook = end_without_memory;
    /* A file opened later must not become standard output by chance. Reading from or writing to a closed one then fails as
     * it should: /dev/null is opened the wrong way round. */
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
    ceduo_language_start();
    signal(SIGXFSZ, SIG_IGN); /* a file that is too large for its limit is an error like a full disk */
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
        [MODE_HELP] = print,
        [MODE_VERSION] = print,
    };
    struct arguments arguments;
    enum exit_status status = ceduo_arguments_read(&arguments, argc, argv);
    if (status == EXIT_DONE) /* whether it can be written is told before anything is computed */
        status = ceduo_output_check(&arguments) ? commands[arguments.mode](&arguments) : EXIT_OUTPUT;
    ceduo_say_no_progress();
    ceduo_arguments_free(&arguments);
    return (int)status;
}
