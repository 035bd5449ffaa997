/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Print figures of a few runs to the last bit: bits THREADS. They are the same for any threads, optimisation and compiler. */
#include <stdio.h>
#include <stdlib.h>

#include "ceduo/ceduo.h"
#include "core/runs/run.h"
#include "physics/paper_site.h"

static void show(const char *label, const struct ceduo_distribution *d)
{
    printf("%s %a %a %a %a %a %a\n", label, d->mean, d->se, d->p50, d->p95, d->p99, d->max);
}

int main(int argc, char **argv)
{
    unsigned threads = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 1;
    for (int kind = 0; kind < 2 * CEDUO_LAW_COUNT; kind++) {
        struct paper_site site;
        paper_site_init(&site);
        site.scene.simulation.law = (enum ceduo_law)(kind / 2);
        site.scene.simulation.friction_bound = kind & 1;
        site.scene.rock.density = (struct ceduo_number){2600, 100, CEDUO_SPREAD_NORMAL};
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        def.threads = threads;
        def.rocks_max = 10000;
        struct ceduo_run *run;
        struct ceduo_arrivals a;
        if (ceduo_run_create(&def, &run) != CEDUO_OK || ceduo_run_extend(run, 10000) != CEDUO_OK ||
            ceduo_run_arrivals(run, 0, &a) != CEDUO_OK)
            return 1;
        printf("%llu %llu\n", (unsigned long long)a.reached, (unsigned long long)ceduo_run_contacts(run));
        show("speed", &a.speed);
        show("energy", &a.energy);
        show("height", &a.height);
        ceduo_run_free(run);
    }
    return 0;
}
