/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel.h"

const struct kernel *ceduo_kernel(enum ceduo_kernel wanted)
{
#if defined(__x86_64__) && defined(__GNUC__)
    bool best = wanted == CEDUO_KERNEL_BEST, avx2 = __builtin_cpu_supports("avx2");
    bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"); /* untaken 5: machine */
    if (avx512 && (best || wanted == CEDUO_KERNEL_AVX512))                                         /* untaken 5: machine */
        return &ceduo_kernel_avx512;
    if (avx2 && (best || wanted == CEDUO_KERNEL_AVX2)) /* untaken 5: machine */
        return &ceduo_kernel_avx2;
#else
    (void)wanted;
#endif
    return &ceduo_kernel_scalar;
}
