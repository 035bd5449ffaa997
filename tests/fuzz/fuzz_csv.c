/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A CSV profile: what is read rises, and is refused with a word. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "fuzz.h"
#include "io/derive.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[64];
    int fd = memfd_create("fuzz", MFD_CLOEXEC);
    if (fd < 0 || write(fd, data, size) != (ssize_t)size)
        abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
    struct arena arena = {0};
    struct problems problems = {0};
    struct points points = {0};
    if (ceduo_csv_slope_read(&arena, path, &points, &problems)) {
        for (size_t i = 0; i < points.n; i++)
            if (!isfinite(points.x[i]) || !isfinite(points.z[i]) || (i > 0 && !(points.x[i] > points.x[i - 1])))
                abort();
    } else if (problems.count == 0) {
        abort();
    }
    ceduo_problems_free(&problems);
    ceduo_arena_free(&arena);
    close(fd);
    return 0;
}
