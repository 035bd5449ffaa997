/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch.h"

#include "base/language.h"
#include "options.h"
#include "say.h"
#include "tui/program.h"
#include "tui/script.h"
#include "tui/terminal.h"

static enum exit_status no_terminal(const char *why)
{
    struct text text = {0};
    ceduo_text_format(&text, _("ceduo: %s; use 'ceduo --batch SCENE.yaml', or try 'ceduo --help'\n"), why);
    ceduo_say(&text);
    ceduo_text_free(&text);
    return EXIT_USAGE;
}

static enum exit_status run(const struct arguments *a, struct app *app)
{
    if (a->script) {
        static const enum exit_status statuses[] = {EXIT_DONE, EXIT_USAGE, EXIT_INPUT, EXIT_OUTPUT};
        return statuses[ceduo_script_run(app, a->script)];
    }
    switch (ceduo_terminal_run(app)) {
    case TERMINAL_DONE:
        return EXIT_DONE;
    case TERMINAL_NONE:
        return no_terminal(_("this terminal cannot be used"));
    default:
        return EXIT_RUN;
    }
}

enum exit_status ceduo_interactive_run(const struct arguments *a)
{
    const char *why = a->script ? NULL : ceduo_terminal_missing();
    if (why)
        return no_terminal(why);
    struct app app;
    struct problems problems = {0};
    bool good = ceduo_program_create(&app, a->scenes_count > 0 ? a->scenes[0] : NULL, ceduo_option_charset(a), a->threads,
                                     a->script != NULL, &problems);
    ceduo_problems_close(&problems);
    ceduo_say(&problems.text);
    ceduo_problems_free(&problems);
    if (!good)
        return EXIT_INPUT;
    enum exit_status status = run(a, &app);
    ceduo_program_free(&app);
    return status;
}
