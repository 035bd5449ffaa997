/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HASH_H
#define CEDUO_HASH_H

#include <endian.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A hash of numbers: begin with HASH_START and mix in one after the other. Each step maps different values to different hashes,
 * so that a change of one number is always detected. Pointers and structs do not compile, because an address differs between
 * runs of the program, and padding is undefined. */
#define HASH_START 14695981039346656037u

static inline void hash_word(uint64_t *hash, uint64_t value)
{
    *hash = (*hash ^ value) * 0x9e3779b97f4a7c15u; /* 2^64 over the golden ratio, odd */
    *hash ^= *hash >> 32;
}

static inline void hash_numbers(uint64_t *hash, const double *numbers, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        hash_word(hash, bits);
    }
}

/* Begin the hash of n bytes, and mix in a chunk of them. The length of each chunk but the last is a multiple of 8. */
static inline uint64_t hash_begin(size_t n)
{
    return HASH_START ^ (uint64_t)n;
}

static inline void hash_chunk(uint64_t *hash, const char *bytes, size_t n)
{
    for (size_t i = 0; i < n; i += 8) {
        uint64_t word = 0;
        memcpy(&word, bytes + i, n - i < 8 ? n - i : 8);
        hash_word(hash, le64toh(word));
    }
}

/* Return the hash of n bytes, the same on every machine. It detects accidental changes, not malicious ones. */
static inline uint64_t hash_string(const char *bytes, size_t n)
{
    uint64_t hash = hash_begin(n);
    hash_chunk(&hash, bytes, n);
    return hash;
}

/* Mix in an integer. The product rejects pointers. */
#define hash_count(hash, value) hash_word(hash, 1u * (value))

/* Mix in the bits of a double: -0 and 0 differ, NaN equals NaN. */
#define hash_double(hash, value) hash_numbers(hash, &(const double){value}, 1)

/* Mix in n doubles. Accepts only a pointer to double. */
#define hash_doubles(hash, doubles, n)                                                                                         \
    hash_numbers(hash, _Generic((doubles), double * : (doubles), const double * : (doubles)), n)

/* Mix in all doubles of an array. Rejects a pointer. */
#define hash_array(hash, array)                                                                                                \
    do {                                                                                                                       \
        _Static_assert(!__builtin_types_compatible_p(__typeof__(array), __typeof__(&(array)[0])), "an array, not a pointer");  \
        hash_doubles(hash, array, sizeof(array) / sizeof(array)[0]);                                                           \
    } while (0)

/* Mix in the listed doubles. */
#define hash_each(hash, ...)                                                                                                   \
    do {                                                                                                                       \
        const double hashed_numbers[] = {__VA_ARGS__};                                                                         \
        hash_array(hash, hashed_numbers);                                                                                      \
    } while (0)

/* Return the hash of n bytes of a string. The product rejects pointers to structs and pointers. */
#define hash_bytes(bytes, n) hash_string(((void)sizeof(1u * (bytes)[0]), (bytes)), n)

#endif
