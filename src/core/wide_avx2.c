/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wide walk and the drawing of stems on AVX2. The rest of the program is for any machine, so this file alone sets
 * the target. */
#include "wide.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#define MANY 4
#include "stems_fill.h"
#include "wide_walk.h"

void ceduo_wide_walk_avx2(const struct wide_job *job)
{
    wide_walk(job);
}

const struct stems_kernel ceduo_stems_avx2 = {fill_points, make_stools};

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
