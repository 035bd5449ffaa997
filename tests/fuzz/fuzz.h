/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FUZZ_H
#define CEDUO_FUZZ_H

#include <stddef.h>
#include <stdint.h>

/* A harness takes one input of any bytes, from libFuzzer or replay.c. Run it from the top of the sources, which has the
 * profiles. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
