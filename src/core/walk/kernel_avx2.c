/* SPDX-License-Identifier: GPL-3.0-or-later */
#define REAL_LANES 4
#define KERNEL     ceduo_kernel_avx2
#include "kernel_text.h"
