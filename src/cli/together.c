/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "together.h"

#include <math.h>
#include <string.h>

#include "base/intl.h"
#include "options.h"
#include "say.h"

/* Says which option does not go with `one`. */
static enum exit_status check_with(const struct arguments *a, const char *one, unsigned not_with, const char *why)
{
    size_t n;
    const struct option_row *rows = ceduo_option_rows(&n);
    for (size_t i = 0; i < n; i++)
        if ((a->given >> i & 1) && (rows[i].not_with & not_with))
            return ceduo_usage(NULL, _("--%s does not go with --%s: %s"), one, rows[i].name, why);
    return EXIT_DONE;
}

static enum exit_status check_parts(struct arguments *a)
{
    if (ceduo_option_given(a, "merge"))
        return check_with(a, "merge", NOT_MERGE, _("what is printed was computed with the parts"));
    if (a->shards == 0)
        return EXIT_DONE;
    enum exit_status status = check_with(a, "shard", NOT_SHARD, _("it writes a part of one run, which --merge prints"));
    a->format = CEDUO_JSON; /* lines, one for each scene */
    return status;
}

/* What would otherwise be passed over without a word. */
static enum exit_status check_unused(const struct arguments *a)
{
    if (ceduo_option_given(a, "rows") && a->format != CEDUO_CSV)
        return ceduo_usage(NULL, _("--rows goes with --format csv"));
    if (ceduo_option_given(a, "charset") && a->plot == CEDUO_PLOT_NONE && a->mode != MODE_TERMINAL)
        return ceduo_usage(NULL, _("--charset goes with --plot and the terminal program"));
    if (a->script && a->mode != MODE_TERMINAL)
        return ceduo_usage(NULL, _("--script feeds the terminal program; it does not go with --batch"));
    if (a->years && a->plot != CEDUO_PLOT_NONE && a->plot != CEDUO_PLOT_ROTATION)
        return ceduo_usage(NULL, _("--years goes with the page, CSV, JSON and --plot rotation"));
    return EXIT_DONE;
}

enum exit_status ceduo_arguments_check(struct arguments *a)
{
    if (a->mode < MODE_HELP && check_parts(a) != EXIT_DONE)
        return EXIT_USAGE;
    if (a->mode == MODE_CHECK && check_with(a, "check", NOT_CHECK, _("it computes nothing")) != EXIT_DONE)
        return EXIT_USAGE;
    if (a->mode == MODE_MERGE && a->scenes_count == 0)
        return ceduo_usage(NULL, _("--merge wants files with the parts that --shard wrote, '-' for standard input"));
    bool wants_scene = a->mode == MODE_BATCH || a->mode == MODE_MERGE || a->mode == MODE_CHECK || a->mode == MODE_FIND;
    if (a->mode == MODE_FIND && !ceduo_option_given(a, "goal"))
        return ceduo_usage(NULL, _("--find wants a --goal: adc, free-run, energy=KJ or exceed"));
    if (ceduo_option_given(a, "goal") && a->mode != MODE_FIND)
        return ceduo_usage(NULL, _("--goal goes with --find"));
    if (a->mode == MODE_FIND && !ceduo_goals[a->goal].usual && isnan(a->goal_value))
        return ceduo_usage(NULL, _("--goal energy wants the mean energy in kJ: energy=50"));
    if (a->mode == MODE_FIND && (a->plot != CEDUO_PLOT_NONE || a->years || a->tolerance > 0))
        return ceduo_usage(NULL, _("--find goes with neither --plot, --years nor --tolerance"));
    if (wants_scene && a->scenes_count == 0)
        return ceduo_usage(NULL,
                           _("no scene; name a file, '-' for standard input, or a shipped scene such as 'paper-site'"));
    if (!wants_scene && a->mode != MODE_TERMINAL && a->scenes_count > 0 && a->mode < MODE_HELP)
        return ceduo_usage(NULL, _("a list takes no scene: '%s'"), a->scenes[0]);
    if (a->plot != CEDUO_PLOT_NONE && a->format != CEDUO_TABLE)
        return ceduo_usage(NULL, _("--plot prints a picture; it has no --format csv or json"));
    if (a->plot_width > 0 && a->plot == CEDUO_PLOT_NONE)
        return ceduo_usage(NULL, _("--size goes with --plot"));
    if (a->mode < MODE_HELP && check_unused(a) != EXIT_DONE)
        return EXIT_USAGE;
    bool batch_only = a->rocks > 0 || a->tolerance > 0 || a->sets_count > 0 || a->options_count > 0 || a->output ||
                      a->format != CEDUO_TABLE || a->stands;
    if (a->mode == MODE_TERMINAL && batch_only)
        return ceduo_usage(NULL, _("options such as -s, -n, -f and -o belong to --batch"));
    if (a->mode == MODE_TERMINAL && a->scenes_count > 1)
        return ceduo_usage(NULL, _("the terminal program opens one scene; --batch takes several"));
    size_t standard = 0;
    for (size_t i = 0; i < a->scenes_count; i++)
        standard += strcmp(a->scenes[i], "-") == 0;
    if (standard > 1)
        return ceduo_usage(NULL, _("standard input can be read only once"));
    return EXIT_DONE;
}
