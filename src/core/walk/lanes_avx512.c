/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk of lanes on AVX-512. The rest of the program is for any machine: this file and stems_avx512.c alone set the target. */
#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq")
#endif

#define REAL_LANES 8
#include "lanes_walk.h"

void ceduo_lanes_walk_avx512(const struct lanes_job *job)
{
    walk_job(job);
}

#ifdef __clang__
#pragma clang attribute pop
#endif

#else
#include "lanes.h"
#endif
