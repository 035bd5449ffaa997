/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wide walk on AVX-512. The rest of the program is for any machine, so this file and stems_avx512.c
 * alone set the target. */
#include "wide.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq")
#endif

#define WIDE_AVX512
#include "wide_walk.h"

void ceduo_wide_walk_avx512(const struct wide_job *job)
{
    wide_walk(job);
}

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
