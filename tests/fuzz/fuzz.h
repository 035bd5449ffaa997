/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FUZZ_H
#define CEDUO_FUZZ_H

#include <stddef.h>
#include <stdint.h>

/* A harness is one input of any bytes. libFuzzer calls it, or replay.c does. Run from the top of the sources: the shipped
 * profiles are looked for there. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
