/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wide walk on AVX2. The rest of the program is for any machine, so this file and stems_avx2.c alone set
 * the target. */
#include "wide.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#include "wide_walk.h"

void ceduo_wide_walk_avx2(const struct wide_job *job)
{
    wide_walk(job);
}

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
