/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HASH_H
#define CEDUO_HASH_H

#include <endian.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A hash of numbers: begin with HASH_START, mix in one after the other. Each step maps different values to different
 * hashes, so that a change of one number alone is never missed. */
#define HASH_START 14695981039346656037u

static inline void hash_count(uint64_t *hash, uint64_t value)
{
    *hash = (*hash ^ value) * 0x9e3779b97f4a7c15u; /* 2^64 over the golden ratio, odd */
    *hash ^= *hash >> 32;
}

/* n doubles by their bits: -0 and 0 differ, NaN is like NaN. */
static inline void hash_doubles(uint64_t *hash, const void *doubles, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, (const char *)doubles + i * sizeof bits, sizeof bits);
        hash_count(hash, bits);
    }
}

static inline void hash_double(uint64_t *hash, double value)
{
    hash_doubles(hash, &value, 1);
}

/* The hash of n bytes, the same on every machine: against what gets lost or changed on the way, not against malice. */
static inline uint64_t hash_bytes(const void *bytes, size_t n)
{
    uint64_t hash = HASH_START ^ (uint64_t)n;
    for (size_t i = 0; i < n; i += 8) {
        uint64_t word = 0;
        memcpy(&word, (const char *)bytes + i, n - i < 8 ? n - i : 8);
        hash_count(&hash, le64toh(word));
    }
    return hash;
}

#endif
