/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The drawing of stems on AVX2: see lanes_avx2.c. */
#include "stems_state.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#define REAL_LANES 4
#include "stems_fill.h"

const struct stems_kernel ceduo_stems_avx2 = {fill_points, make_stools};

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
