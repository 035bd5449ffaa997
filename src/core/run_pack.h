/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_PACK_H
#define CEDUO_RUN_PACK_H

#include "base/bytes.h"
#include "ceduo/run.h"

/* A run as it is saved. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_run_pack(const struct ceduo_run *run, struct bytes *b);

#endif
