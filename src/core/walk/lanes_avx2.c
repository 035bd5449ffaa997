/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk of lanes on AVX2. The rest of the program is for any machine: this file and stems_avx2.c alone set the target. */
#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#define REAL_LANES 4
#include "lanes_walk.h"

void ceduo_lanes_walk_avx2(const struct lanes_job *job)
{
    walk_job(job);
}

#ifdef __clang__
#pragma clang attribute pop
#endif

#else
#include "lanes.h"
#endif
