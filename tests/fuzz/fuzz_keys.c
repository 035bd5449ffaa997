/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Play a script of keys to the terminal program in its own folder. '/' is not passed on, so that no script writes outside. */
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "tui/program.h"

/* A rock flies over the control, hits stems or the ground and stops: simulating it takes little time. */
static const char scene[] =
    "ceduo: scene/1\ntitle: fuzz\nrock: {diameter_m: 0.5}\nrelease: {x_m: 1, height_m: 5, vx_m_s: 4}\n"
    "slope: {vertices_m: [[0, 64], [50, 30], [100, 0]],\n"
    "  segments: [{rn: 0.1, rt: 0.2, friction: 3}, {rn: 0.1, rt: 0.2, friction: 3}]}\n"
    "controls: [{x_m: 3, name: road, accepted_kJ: 50}]\n"
    "options:\n"
    "  - {name: a, forest: [{from_m: 2, to_m: 40, stand: {stools: {per_ha: 2000, spacing_m: 0.25},\n"
    "     shoots: [{per_ha: 5000, dbh_m: 0.07, height_m: 6}], trees: [{per_ha: 100, dbh_m: 0.2, height_m: 12}]}}]}\n"
    "  - {name: b}\n"
    "simulation: {rocks: 10, law: lumped}\n";

static void write_scene(void)
{
    FILE *f = fopen("fuzz.yaml", "w");
    if (!f || fputs(scene, f) < 0 || fclose(f) != 0)
        abort();
}

static char folder[64];

static int remove_one(const char *path, const struct stat *st, int kind, struct FTW *at)
{
    (void)st, (void)kind, (void)at;
    return remove(path);
}

static void remove_folder(void)
{
    (void)nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

/* Make the folder, in memory if possible: most of the time would go to disk writes. */
static bool make_folder(const char *parent)
{
    snprintf(folder, sizeof folder, "%s/ceduo-fuzz-XXXXXX", parent);
    return mkdtemp(folder) && chdir(folder) == 0;
}

/* Make the folder once; discard messages. */
static void set_up(void)
{
    static bool done;
    if (done)
        return;
    done = true;
    if ((!make_folder("/dev/shm") && !make_folder("/tmp")) || atexit(remove_folder) != 0)
        abort();
    setenv("HOME", folder, 1);
    setenv("XDG_STATE_HOME", folder, 1);
    setenv("XDG_DATA_HOME", folder, 1);
    stderr = fopen("/dev/null", "w");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE], *text = malloc(size + 1);
    if (!text)
        return 0;
    set_up();
    write_scene();
    memcpy(text, data, size);
    text[size] = '\0';
    for (size_t i = 0; i < size; i++)
        if (text[i] == '/')
            text[i] = 'j';
    for (char *p = text; (p = strstr(p, "wait")) || (p = strstr(text, "dump -")) || (p = strstr(text, "roles -"));)
        *p = '#'; /* 100 000 rocks take too long, and standard output must stay clean */
    int fd = fuzz_make_file(text, size, path);
    struct app app;
    if (!ceduo_program_create(&app, "fuzz.yaml", CEDUO_CHARSET_BRAILLE, 1, true))
        abort();
    (void)ceduo_script_run(&app, path);
    ceduo_screen_draw(&app);
    ceduo_app_free(&app);
    close(fd);
    free(text);
    return 0;
}
