/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KERNEL_H
#define CEDUO_KERNEL_H

#include "ceduo/run.h"

/* The best kind of registers that this machine has, or that kind if it has it; otherwise CEDUO_KERNEL_SCALAR. */
enum ceduo_kernel ceduo_kernel_here(enum ceduo_kernel wanted);

#endif
