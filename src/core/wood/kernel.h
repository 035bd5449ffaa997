/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KERNEL_H
#define CEDUO_KERNEL_H

#include "ceduo/run.h"
#include "core/wood/stems_state.h"

/* What is compiled for each kind of registers. */
struct lanes_job;
struct kernel {
    /* Follows many rocks at once (lanes.h); NULL: they are followed one by one. */
    void (*walk)(const struct lanes_job *job);
    /* Draws the next places of a stream. */
    void (*fill)(struct stems *stems, int side, enum stem_stream stream);
    /* Makes some of the stools that come next on a side, of which the shoots are alike and stand ahead of the release;
     * there is room for SHOOTS_AT_ONCE. */
    void (*make_stools)(struct stems *stems, int side);
};

/* Of the best kind of registers that this machine has, or of that kind if it has it; otherwise for any machine. */
const struct kernel *ceduo_kernel(enum ceduo_kernel wanted);

/* The last is for any machine, the others for x86-64. */
extern const struct kernel ceduo_kernel_avx512, ceduo_kernel_avx2, ceduo_kernel_scalar;

#endif
