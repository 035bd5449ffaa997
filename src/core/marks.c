/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "marks.h"

#include <stdlib.h>

struct place {
    double x;
    size_t what;
};

static int by_x(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->what > q->what) - (p->what < q->what);
}

bool ceduo_marks_init(struct marks *marks, const struct ceduo_scene *scene, size_t cells, const double *cell_x)
{
    size_t n = scene->controls_count + cells;
    struct place *places = malloc((n + 1) * sizeof *places);
    *marks = (struct marks){.n = n,
                            .x = malloc((n + 1) * sizeof(double)),
                            .z = malloc((n + 1) * sizeof(double)),
                            .what = malloc((n + 1) * sizeof(size_t))};
    if (!places || !marks->x || !marks->z || !marks->what) {
        free(places);
        ceduo_marks_release(marks);
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        bool control = i < scene->controls_count;
        places[i] = (struct place){control ? scene->controls[i].x : cell_x[i - scene->controls_count], i};
    }
    qsort(places, n, sizeof *places, by_x);
    for (size_t i = 0; i < n; i++) {
        marks->x[i] = places[i].x;
        marks->what[i] = places[i].what;
        marks->z[i] = ceduo_slope_height(&scene->slope, places[i].x);
    }
    free(places);
    return true;
}

void ceduo_marks_release(struct marks *marks)
{
    free(marks->x);
    free(marks->z);
    free(marks->what);
    *marks = (struct marks){0};
}
