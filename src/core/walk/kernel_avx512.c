/* SPDX-License-Identifier: GPL-3.0-or-later */
#define REAL_LANES 8
#define KERNEL     ceduo_kernel_avx512
#include "kernel_text.h"
