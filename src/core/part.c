/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/part.h"

void ceduo_part_range(uint64_t rocks, uint64_t part, uint64_t parts, uint64_t *first, uint64_t *end)
{
    uint64_t blocks = rocks / CEDUO_BLOCK_ROCKS + (rocks % CEDUO_BLOCK_ROCKS != 0);
    *first = blocks * (part - 1) / parts * CEDUO_BLOCK_ROCKS;
    *end = blocks * part / parts * CEDUO_BLOCK_ROCKS;
    *first = *first < rocks ? *first : rocks;
    *end = *end < rocks ? *end : rocks;
}

/* Eight bytes at a time, each multiplied in and folded: a changed, lost or moved one changes what follows. */
uint64_t ceduo_bytes_sum(const void *bytes, size_t n)
{
    const unsigned char *p = bytes;
    uint64_t sum = 14695981039346656037u ^ (uint64_t)n;
    for (size_t i = 0; i < n; i += 8) {
        uint64_t word = 0;
        size_t most = n - i < 8 ? n - i : 8;
        if (most == 8)
            word = (uint64_t)p[i] | (uint64_t)p[i + 1] << 8 | (uint64_t)p[i + 2] << 16 | (uint64_t)p[i + 3] << 24 |
                   (uint64_t)p[i + 4] << 32 | (uint64_t)p[i + 5] << 40 | (uint64_t)p[i + 6] << 48 |
                   (uint64_t)p[i + 7] << 56;
        else
            for (size_t k = 0; k < most; k++)
                word |= (uint64_t)p[i + k] << (8 * k);
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    }
    return sum;
}
