/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KERNEL_H
#define CEDUO_KERNEL_H

#include "ceduo/simulate.h"
#include "core/forest/stems_state.h"

/* Functions compiled for each kind of registers. */
struct lanes_job;
struct kernel {
    /* Simulates many rocks at once (lanes.h); NULL: not available, simulate them one by one. */
    void (*walk)(const struct lanes_job *job);
    /* Draws the next places of a stream. */
    void (*fill)(struct stems *stems, int side, enum stem_stream stream);
    /* Makes some of the next stools of a side. Requires plain stools ahead of the release, and capacity for SHOOTS_MAX. */
    void (*make_stools)(struct stems *stems, int side);
};

/* Return the kernel of the best registers of this machine, or the wanted kernel if available; otherwise the scalar one. */
const struct kernel *ceduo_kernel(enum ceduo_kernel wanted);

/* The scalar kernel runs on any machine; AVX kernels need x86-64. */
extern const struct kernel ceduo_kernel_avx512, ceduo_kernel_avx2, ceduo_kernel_scalar;

#endif
