/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compare the speed of the contact laws, by turns, on the slope of Ciabocco et al. 2009 and on a long meadow.
 *
 *   bench_laws [REPEATS [ROCKS]]        default 9, 20000
 *
 * CSV on stdout: medians of processor time of one thread, nanoseconds per rock and per contact, ratios to lumped. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/runs/run.h"
#include "frame.h"
#include "physics/line_scene.h"

struct turn {
    double seconds[REPEATS_MAX];
    uint64_t contacts;
};

static double measure_time(const struct ceduo_scene *scene, enum ceduo_kernel kernel, uint64_t rocks, uint64_t *contacts)
{
    double start = processor_s();
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.kernel = kernel;
    def.threads = 1;
    def.rocks_max = rocks;
    struct ceduo_run *run = simulate_run(&def, rocks);
    *contacts = ceduo_run_contacts(run);
    double seconds = processor_s() - start;
    ceduo_run_free(run);
    return seconds;
}

static void measure(const char *place, struct ceduo_scene *scene, enum ceduo_kernel kernel, size_t repeats, uint64_t rocks)
{
    static const char *const kernels[] = {"best", "scalar", "avx2", "avx512"};
    static const char *const laws[] = {"lumped", "crsp", "arm"};
    struct turn turns[CEDUO_LAW_COUNT];
    for (size_t i = 0; i < repeats; i++)
        for (int law = 0; law < CEDUO_LAW_COUNT; law++) {
            scene->simulation.law = (enum ceduo_law)law;
            turns[law].seconds[i] = measure_time(scene, kernel, rocks, &turns[law].contacts);
        }
    double lumped = 0, lumped_contact = 0;
    for (int law = 0; law < CEDUO_LAW_COUNT; law++) {
        double rock = median(turns[law].seconds, repeats) / (double)rocks * 1e9;
        double contact = rock * (double)rocks / (double)turns[law].contacts;
        if (law == 0) {
            lumped = rock;
            lumped_contact = contact;
        }
        printf("%s,%s,%s,%.1f,%.2f,%.2f,%.2f,%.2f\n", place, kernels[kernel], laws[law],
               (double)turns[law].contacts / (double)rocks, rock, contact, rock / lumped, contact / lumped_contact);
    }
    fflush(stdout);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 9, 1, REPEATS_MAX);
    uint64_t rocks = argument(argv, 2, 20000, 1, CEDUO_ROCKS_MAX);
    static struct paper_site site;
    static struct line_scene meadow;
    const double x[] = {0, 60, 400}, z[] = {0, -40, -50};
    paper_site_init(&site);
    for (size_t j = 0; j < PAPER_SEGMENTS; j++)
        site.segments[j].mu = ceduo_segment_default().mu;
    line_scene_init(&meadow, 3, x, z, (struct line_ground){0.35, 0.85, 0.5}, 0.3, CEDUO_LAW_ARM);
    line_scene_release(&meadow, 1, 0, 1, 0, 0);
    for (size_t j = 0; j < 2; j++) {
        meadow.segments[j].mu = ceduo_segment_default().mu;
        meadow.segments[j].roughness_m = 0.1;
    }
    meadow.scene.rock.shape = CEDUO_SHAPE_ELLIPSOID;
    for (int i = 0; i < 3; i++)
        meadow.scene.rock.axes[i] = ceduo_number(0.4 + 0.2 * i);
    puts("place,kernel,law,contacts_a_rock,ns_a_rock,ns_a_contact,rock_to_lumped,contact_to_lumped");
    for (int kernel = CEDUO_KERNEL_SCALAR; kernel <= CEDUO_KERNEL_AVX512; kernel++) {
        measure("paper", &site.scene, (enum ceduo_kernel)kernel, repeats, rocks);
        measure("meadow", &meadow.scene, (enum ceduo_kernel)kernel, repeats, rocks);
    }
    return 0;
}
