/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure how long a user waits, on the grid of cells without a terminal: from a key to the first picture of at least 1000
 * rocks, to 10 000 rocks, and from an edit of a stand to its index and to the first rocks through it. Prints CSV. */
#include <ftw.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "frame.h"
#include "tui/program.h"

#define EDITS_MAX 10000

static void report(const char *label, double *ms, size_t n, double goal_median, double goal_p99)
{
    qsort(ms, n, sizeof *ms, by_value);
    printf("%s,%zu,%.3f,%.3f,%g,%g\n", label, n, ms[n / 2], ms[(n * 99) / 100], goal_median, goal_p99);
}

/* Wait until the drawn figures rest on at least `rocks` rocks. */
static void wait_for(struct app *app, uint64_t rocks)
{
    do {
        struct pollfd fd = {.fd = ceduo_jobs_fd(app->live.jobs), .events = POLLIN};
        poll(&fd, 1, 1000);
        ceduo_program_poll(app);
    } while (!app->live.result || app->live.results.snapshot->snapshot->bare->simulated.rocks < rocks ||
             app->live.requested_key != app->live.results.snapshot->key);
    ceduo_screen_draw(app);
}

static void to_field(struct app *app, const char *path)
{
    struct form *form = ceduo_app_form(app);
    for (size_t i = 0; i < form->n; i++)
        if (form->rows[i].n > 0 && strcmp(form->rows[i].cells[0].path, path) == 0)
            form->row = i;
}

static int remove_entry(const char *path, const struct stat *st, int type, struct FTW *where)
{
    (void)st;
    (void)type;
    (void)where;
    return remove(path);
}

int main(int argc, char **argv)
{
    /* unsaved work on the scene would be offered first */
    char state[] = "/tmp/ceduo-bench-XXXXXX";
    if (!mkdtemp(state) || setenv("XDG_STATE_HOME", state, 1) != 0)
        return 1;
    (void)argc;
    size_t repeats = argument(argv, 1, 100, 1, EDITS_MAX);
    struct app app;
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    static double first[EDITS_MAX], all[EDITS_MAX], stand[EDITS_MAX], wooded[EDITS_MAX];
    if (!ceduo_program_create(&app, "profiles/scenes/paper-site.yaml", CEDUO_CHARSET_BRAILLE, (unsigned)cores, false))
        return 1;
    ceduo_app_resize(&app, 120, 40);
    ceduo_jobs_wait(app.live.jobs, true);
    printf("what,edits,median_ms,p99_ms,goal_median_ms,goal_p99_ms\n");
    for (size_t i = 0; i < repeats; i++) {
        ceduo_program_key(&app, '3');
        to_field(&app, "rock.diameter_m");
        double start = ceduo_clock();
        ceduo_program_key(&app, i % 2 ? '-' : '+');
        wait_for(&app, 1000);
        first[i] = 1e3 * (ceduo_clock() - start);
        wait_for(&app, 10000);
        all[i] = 1e3 * (ceduo_clock() - start);
        ceduo_program_key(&app, '2');
        to_field(&app, "forest[0].stand.stools.per_ha");
        start = ceduo_clock();
        ceduo_program_key(&app, i % 2 ? '-' : '+');
        ceduo_screen_draw(&app);
        stand[i] = 1e3 * (ceduo_clock() - start);
        wait_for(&app, 1000);
        wooded[i] = 1e3 * (ceduo_clock() - start);
    }
    report("key to a picture of 1000 rocks", first, repeats, 33, 100);
    report("key to a picture of 10000 rocks", all, repeats, 120, 0);
    report("edit of a stand to its index", stand, repeats, 5, 0);
    report("edit of a stand to 1000 rocks through it", wooded, repeats, 33, 100);
    ceduo_app_free(&app);
    nftw(state, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    return 0;
}
