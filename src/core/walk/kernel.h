/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KERNEL_H
#define CEDUO_KERNEL_H

#include "ceduo/run.h"
#include "core/wood/stems_state.h"

/* Functions that are compiled for each kind of registers. */
struct lanes_job;
struct kernel {
    /* Follows many rocks at once (lanes.h); NULL: they are followed one by one. */
    void (*walk)(const struct lanes_job *job);
    const struct stems_kernel *stems;
};

/* Of the best kind of registers that this machine has, or of that kind if it has it; otherwise for any machine. */
const struct kernel *ceduo_kernel(enum ceduo_kernel wanted);

/* For x86-64. */
extern const struct kernel ceduo_kernel_avx512, ceduo_kernel_avx2;

#endif
