/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each place becomes a control of a copy of the scene; rocks are simulated one by one. */
#include "envelope.h"
#include "ceduo/simulate.h"

#include <math.h>
#include <stdlib.h>

#include "base/parallel.h"
#include "base/ranks.h"
#include "prepared.h"
#include "strike.h"

/* Values of the rocks that pass a place. */
struct passing_values {
    size_t n;
    double *height, *energy, energy_sum;
};

static void add_rock(struct passing_values *to, const struct ceduo_rock *rock, const struct ceduo_crossing *c)
{
    if (!c->reached)
        return;
    double energy = flying_energy(rock->mass, rock->moment, c->vx, c->vz, c->spin);
    to->height[to->n] = c->height;
    to->energy[to->n++] = energy;
    to->energy_sum += energy;
}

/* Return the values of ranks p n, rounded up. */
static struct ceduo_cell_quantiles select_quantiles(double *values, size_t n)
{
    struct ceduo_cell_quantiles q = {NAN, NAN, NAN, NAN};
    struct rank ranks[] = {
        {(size_t)ceil(0.05 * (double)n), &q.p5}, {(n + 1) / 2, &q.p50}, {(size_t)ceil(0.95 * (double)n), &q.p95}, {n, &q.max}};
    if (n > 0)
        ceduo_ranks_select(values, n, ranks, sizeof ranks / sizeof ranks[0]);
    return q;
}

static bool is_cancelled(void *flag)
{
    return ceduo_cancelled(flag);
}

/* Simulate rocks, with blocks only those drawn with natural size frequencies, and add their values at each place. */
static enum ceduo_status simulate_rocks(struct ceduo_tracer *tracer, const struct sizes *sizes,
                                        const struct ceduo_envelopes_def *def, struct ceduo_crossing *crossings,
                                        struct passing_values *places)
{
    const struct ceduo_trajectory_callbacks callbacks = {.is_cancelled = is_cancelled, .context = (void *)def->cancel};
    enum ceduo_status status = CEDUO_OK;
    uint64_t simulated = 0;
    for (uint64_t rock = 0; simulated < def->rocks && status == CEDUO_OK; rock++) {
        struct ceduo_trajectory trajectory;
        if (ceduo_cancelled(def->cancel))
            return CEDUO_CANCELLED;
        if (sizes->n > 0 && !ceduo_rock_is_typical(sizes, def->scene->simulation.seed, rock))
            continue;
        simulated++;
        status = ceduo_tracer_run(tracer, rock, &callbacks, &trajectory, crossings);
        for (size_t i = 0; i < def->places && status == CEDUO_OK; i++)
            add_rock(&places[i], &trajectory.rock, &crossings[i]);
    }
    return status;
}

enum ceduo_status ceduo_envelopes(const struct ceduo_envelopes_def *def, struct ceduo_envelope *envelopes)
{
    const size_t n = def->places, rocks = (size_t)def->rocks;
    struct ceduo_scene scene = *def->scene;
    struct ceduo_control *controls = calloc(n + 1, sizeof *controls);
    struct ceduo_crossing *crossings = calloc(n + 1, sizeof *crossings);
    struct passing_values *places = calloc(n + 1, sizeof *places);
    double *values = malloc((2 * n * rocks + 1) * sizeof *values);
    struct ceduo_tracer *tracer = NULL;
    struct sizes sizes = {0};
    enum ceduo_status status = CEDUO_NO_MEMORY;
    if (!controls || !crossings || !places || !values || !ceduo_sizes_init(&sizes, def->scene))
        goto done;
    for (size_t i = 0; i < n; i++) {
        controls[i].x = def->x[i];
        places[i].height = &values[2 * i * rocks];
        places[i].energy = places[i].height + rocks;
    }
    scene.controls = controls;
    scene.controls_count = n;
    tracer = ceduo_tracer_create(&scene, def->option);
    if (tracer)
        status = simulate_rocks(tracer, &sizes, def, crossings, places);
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        struct passing_values *p = &places[i];
        envelopes[i] = (struct ceduo_envelope){.passed = p->n,
                                               .mean_energy = p->n > 0 ? p->energy_sum / (double)p->n : NAN,
                                               .height = select_quantiles(p->height, p->n),
                                               .energy = select_quantiles(p->energy, p->n)};
    }
done:
    ceduo_tracer_free(tracer);
    ceduo_sizes_release(&sizes);
    free(controls);
    free(crossings);
    free(places);
    free(values);
    return status;
}
