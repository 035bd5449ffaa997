/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure how far single trajectories diverge under another rounding mode, and its effect on the statistics, on the slope of
 * Ciabocco et al. 2009, with both laws, the facets on either side and both readings of the roughness.
 *
 *   bench_rounding [ROCKS]        default 20000
 *
 * CSV on stdout. Each rock is simulated under round to nearest and under another mode. Columns: the median distance (m) between
 * its positions at its 1st, 5th, 10th, 20th and 40th contact, over the rocks with that many contacts; the share of rocks that
 * end more than 1 mm apart; mean speed and translational energy at the control, with their differences in standard errors.
 *
 * Trajectories hardly diverge: a contact amplifies a difference but also takes speed, and most are within 1e-12 m at their
 * 40th. A trajectory that diverges does so at a decision, such as rolling or bouncing once more. It is as valid as the other,
 * and the mean of many moves by a small part of its error. */
#include <fenv.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "ceduo/simulate.h"
#include "frame.h"

#define ROCKS_MAX 1000000
#define CONTACTS  40

static const uint64_t marks[] = {1, 5, 10, 20, 40};
#define MARKS (sizeof marks / sizeof *marks)

struct track {
    double x[CONTACTS + 1], z[CONTACTS + 1];
    uint64_t contacts;
    struct ceduo_trajectory trajectory;
    struct ceduo_crossing crossing;
};

struct sums {
    double n, sum, squares;
};

static void note(void *context, const struct ceduo_trajectory_segment *p)
{
    struct track *t = context;
    if (p->contacts > t->contacts && p->contacts <= CONTACTS) { /* the first segment after that contact */
        t->contacts = p->contacts;
        t->x[p->contacts] = p->x;
        t->z[p->contacts] = p->z;
    }
}

static void simulate(struct ceduo_tracer *f, uint64_t rock, int mode, struct track *t)
{
    t->contacts = 0;
    fesetround(mode);
    enum ceduo_status status = ceduo_tracer_run(f, rock, &(struct ceduo_trajectory_callbacks){.segment = note, .context = t},
                                                &t->trajectory, &t->crossing);
    fesetround(FE_TONEAREST);
    if (status != CEDUO_OK)
        fail("no memory");
}

static void add(struct sums *s, double v)
{
    s->n++;
    s->sum += v;
    s->squares += v * v;
}

static double mean(const struct sums *s)
{
    return s->n > 0 ? s->sum / s->n : NAN;
}

static double error(const struct sums *s)
{
    return sqrt((s->squares / s->n - mean(s) * mean(s)) / s->n);
}

static void compare(const char *name, const struct paper_site *site, const char *mode_name, int mode, uint64_t rocks)
{
    double *distance[MARKS], mass;
    size_t many[MARKS] = {0};
    uint64_t ends_apart = 0;
    struct sums speed[2] = {0}, energy[2] = {0};
    struct ceduo_tracer *f = ceduo_tracer_create(&site->scene, NULL);
    static struct track t[2];
    for (size_t i = 0; i < MARKS; i++)
        if (!(distance[i] = malloc(rocks * sizeof(double))))
            fail("no memory");
    if (!f)
        fail("no memory");
    for (uint64_t rock = 0; rock < rocks; rock++) {
        for (int k = 0; k < 2; k++) {
            simulate(f, rock, k == 0 ? FE_TONEAREST : mode, &t[k]);
            const struct ceduo_crossing *c = &t[k].crossing;
            mass = t[k].trajectory.rock.mass;
            if (c->reached) {
                add(&speed[k], hypot(c->vx, c->vz));
                add(&energy[k], mass * (c->vx * c->vx + c->vz * c->vz) / 2e3);
            }
        }
        for (size_t i = 0; i < MARKS; i++)
            if (t[0].contacts >= marks[i] && t[1].contacts >= marks[i])
                distance[i][many[i]++] = hypot(t[0].x[marks[i]] - t[1].x[marks[i]], t[0].z[marks[i]] - t[1].z[marks[i]]);
        ends_apart += hypot(t[0].trajectory.x - t[1].trajectory.x, t[0].trajectory.z - t[1].trajectory.z) > 1e-3;
    }
    printf("%s,%s,%" PRIu64, name, mode_name, rocks);
    for (size_t i = 0; i < MARKS; i++) {
        qsort(distance[i], many[i], sizeof(double), by_value);
        printf(",%.1e", many[i] > 0 ? distance[i][many[i] / 2] : NAN);
        free(distance[i]);
    }
    printf(",%.4f,%.4f,%+.3f,%.3f,%+.3f\n", (double)ends_apart / (double)rocks, mean(&speed[0]),
           (mean(&speed[1]) - mean(&speed[0])) / error(&speed[0]), mean(&energy[0]),
           (mean(&energy[1]) - mean(&energy[0])) / error(&energy[0]));
    fflush(stdout);
    ceduo_tracer_free(f);
}

int main(int argc, char **argv)
{
    (void)argc;
    uint64_t rocks = argument(argv, 1, 20000, 100, ROCKS_MAX);
    static const struct {
        const char *name;
        int mode;
    } modes[] = {{"upward", FE_UPWARD}, {"downward", FE_DOWNWARD}, {"toward-zero", FE_TOWARDZERO}};
    puts("law,mode,rocks,apart_at_1,apart_at_5,apart_at_10,apart_at_20,apart_at_40,ends_apart,speed,speed_off_in_se,"
         "translation_kj,translation_off_in_se");
    for (int kind = 0; kind < 8; kind++) {
        static struct paper_site site;
        char name[40];
        snprintf(name, sizeof name, "%s-%s-%s", kind & 4 ? "crsp" : "lumped", kind & 2 ? "both" : "against",
                 kind & 1 ? "height" : "angle");
        paper_site_init(&site);
        paper_site_read_theta(&site, kind & 1 ? PAPER_HEIGHT : PAPER_ANGLE);
        site.scene.slope.facets = kind & 2 ? CEDUO_FACETS_BOTH : CEDUO_FACETS_AGAINST;
        site.scene.simulation.law = kind & 4 ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED;
        for (size_t m = 0; m < sizeof modes / sizeof *modes; m++)
            compare(name, &site, modes[m].name, modes[m].mode, rocks);
    }
    return 0;
}
