/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure the time from a key until its screen is drawn on the grid of cells, while rocks are simulated: in lists (a selection
 * recomputes the lights), in forms, and in an edited field. Prints CSV. */
#include <stdio.h>
#include <stdlib.h>

#include "frame.h"
#include "tui/program.h"

#define KEYS_MAX 4096

struct hand {
    struct app app;
    double ms[KEYS_MAX];
    size_t n;
};

static void press(struct hand *h, int key, bool counts)
{
    double start = ceduo_clock();
    ceduo_program_key(&h->app, key);
    ceduo_program_poll(&h->app);
    ceduo_screen_draw(&h->app);
    if (counts && h->n < KEYS_MAX)
        h->ms[h->n++] = 1e3 * (ceduo_clock() - start);
}

static void type(struct hand *h, const char *text)
{
    for (; *text; text++)
        press(h, (unsigned char)*text, true);
}

/* Edit the scene, so that all rocks are simulated again while the next keys come. */
static void set_off(struct hand *h)
{
    press(h, '3', false);
    press(h, K_HOME, false);
    press(h, K_DOWN, false);
    press(h, '+', false);
    press(h, '2', false);
}

static void list(struct hand *h)
{
    press(h, 'p', true);
    for (int i = 0; i < 40; i++)
        press(h, K_DOWN, true);
    type(h, "simple");
    press(h, K_ESCAPE, true);
}

static void find(struct hand *h)
{
    for (int i = 0; i < 6; i++)
        press(h, K_DOWN, false);
    press(h, 'f', true);
    type(h, "arrive");
    for (int i = 0; i < 5; i++)
        press(h, K_ESCAPE, true);
}

static void open_scene(struct hand *h)
{
    press(h, 'o', true);
    press(h, K_DOWN, true);
    press(h, K_DOWN, true);
    press(h, K_ENTER, true);
    type(h, "four");
    press(h, K_ESCAPE, true);
}

static void views(struct hand *h)
{
    for (int key = '1'; key <= '6'; key++)
        press(h, key, true);
}

static void edit(struct hand *h)
{
    for (int i = 0; i < 6; i++)
        press(h, K_DOWN, true);
    for (int i = 0; i < 10; i++)
        press(h, i % 2 ? '-' : '+', true);
}

static void measure(struct hand *h, const char *scene, const char *label, void (*play)(struct hand *h))
{
    h->n = 0;
    for (int i = 0; i < 5; i++) {
        set_off(h);
        play(h);
    }
    qsort(h->ms, h->n, sizeof h->ms[0], by_value);
    printf("%s,%s,%zu,%.2f,%.2f,%.2f\n", scene, label, h->n, h->ms[h->n / 2], h->ms[h->n * 99 / 100], h->ms[h->n - 1]);
    fflush(stdout);
}

int main(void)
{
    static const char *const scenes[] = {"profiles/scenes/paper-site.yaml", "profiles/scenes/four-systems.yaml"};
    static struct hand h;
    printf("scene,what,keys,median_ms,p99_ms,most_ms\n");
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        if (!ceduo_program_create(&h.app, scenes[i], CEDUO_CHARSET_BRAILLE, 2, true))
            return 1;
        ceduo_app_resize(&h.app, 200, 50);
        measure(&h, scenes[i], "views", views);
        measure(&h, scenes[i], "edits", edit);
        measure(&h, scenes[i], "list of stands", list);
        measure(&h, scenes[i], "find", find);
        measure(&h, scenes[i], "open", open_scene);
        ceduo_app_free(&h.app);
    }
    return 0;
}
