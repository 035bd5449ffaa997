/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FLAG_H
#define CEDUO_FLAG_H

/* A flag that another thread sets to end a call soon. It has the same layout in C and in C++. */
#ifdef __cplusplus
#include <atomic>
typedef std::atomic<bool> ceduo_flag;
#else
#include <stdatomic.h>
typedef atomic_bool ceduo_flag;
#endif

#endif
