/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk of lanes and the drawing of stems for wide registers: whoever includes it has said how many numbers one holds
 * (REAL_LANES) and what the kernel is called (KERNEL). The rest of the program is for any machine: this file alone sets the
 * target. */
#include "kernel.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#if defined(__clang__) && REAL_LANES == 8
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq"))), apply_to = function)
#elif defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#elif REAL_LANES == 8
#pragma GCC target("avx512f,avx512dq")
#else
#pragma GCC target("avx2")
#endif

#include "core/wood/stems_fill.h"
#include "lanes_walk.h"

const struct kernel KERNEL = {walk_job, fill_points, make_stools};

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
