/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What holds on any ground: looked for over many random scenes. */
#include "expect.h"

#include "invariants.h"

#define SCENES        100000
#define LASTING_EVERY 5000 /* scenes of which one may go on for ever */

TEST(invariants_hold_over_random_scenes)
{
    static struct line_scene scene;
    struct invariants_tally t = {0};
    for (uint64_t number = 0; number < SCENES; number++) {
        line_scene_random(&scene, number, LASTING_EVERY);
        invariants_expect(&scene, number, &t);
        if (number % 4 == 0) {
            line_scene_arm(&scene, number);
            invariants_expect(&scene, number, &t);
        }
    }
    print_message("%d scenes: %ju at rest, %ju left, %ju unfinished (%ju may last, %ju sink in a crack); %ju contacts, "
                  "%ju pieces, %ju "
                  "flights, %ju smooth impacts of crsp, %ju crossings\n",
                  SCENES, (uintmax_t)t.ends[CEDUO_AT_REST], (uintmax_t)t.ends[CEDUO_LEFT_SLOPE],
                  (uintmax_t)t.ends[CEDUO_UNFINISHED], (uintmax_t)t.lasting, (uintmax_t)t.cracks, (uintmax_t)t.contacts,
                  (uintmax_t)t.pieces, (uintmax_t)t.flights, (uintmax_t)t.impacts, (uintmax_t)t.crossed);
    EXPECT(t.flights, >, 10 * SCENES / 2);
    EXPECT(t.impacts, >, SCENES); /* the scenes are worth looking at */
    ROWS(EXPECT, (t.ends[CEDUO_AT_REST], >, SCENES / 10), (t.ends[CEDUO_LEFT_SLOPE], >, SCENES / 10),
         (t.crossed, >, SCENES / 10), (t.cracks, <=, SCENES / 20000));
}
