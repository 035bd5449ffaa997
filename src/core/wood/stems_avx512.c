/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The drawing of stems on AVX-512 (F and DQ): see lanes_avx512.c. */
#include "stems_state.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq")
#endif

#define REAL_LANES 8
#include "stems_fill.h"

const struct stems_kernel ceduo_stems_avx512 = {fill_points, make_stools};

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
