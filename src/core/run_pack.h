/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_PACK_H
#define CEDUO_RUN_PACK_H

#include "base/bytes.h"
#include "ceduo/run.h"

/* Adds a run as it is saved. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_run_pack(const struct ceduo_run *run, struct bytes *b);

/* Continues a run with what was saved. CEDUO_BAD_PART: the run is as it was. CEDUO_NO_MEMORY: it is only to be freed. */
enum ceduo_status ceduo_run_adopt(struct ceduo_run *run, const unsigned char *bytes, size_t n);

#endif
