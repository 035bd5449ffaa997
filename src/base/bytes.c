/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bytes.h"

#include <endian.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

unsigned char *ceduo_bytes_write(struct bytes *b, size_t n)
{
    if (b->no_memory)
        return NULL;
    if (b->room - b->length < n) {
        size_t room = b->room > 0 ? b->room : 4096;
        while (room - b->length < n)
            room = room + room / 2;
        unsigned char *to = realloc(b->to, room);
        if (!to) {
            b->no_memory = true;
            return NULL;
        }
        b->to = to;
        b->room = room;
    }
    b->length += n;
    return b->to + b->length - n;
}

const unsigned char *ceduo_bytes_read(struct bytes *b, size_t n)
{
    if (b->bad || b->length - b->at < n) {
        b->bad = true;
        return NULL;
    }
    b->at += n;
    return b->from + b->at - n;
}

size_t ceduo_bytes_left(const struct bytes *b)
{
    return b->bad ? 0 : b->length - b->at;
}

/* Copies eight bytes from the order of this machine to little end first, or back: the two are the same. */
static void copy_word(void *to, const void *from)
{
    uint64_t bits;
    memcpy(&bits, from, sizeof bits);
    bits = htole64(bits);
    memcpy(to, &bits, sizeof bits);
}

static void pass_word(struct bytes *b, void *value)
{
    const uint64_t zero = 0;
    const unsigned char *from = b->reads ? ceduo_bytes_read(b, 8) : NULL;
    unsigned char *to = b->reads ? value : ceduo_bytes_write(b, 8);
    if (to)
        copy_word(to, from ? (const void *)from : b->reads ? &zero : value);
}

void ceduo_bytes_count(struct bytes *b, uint64_t *value)
{
    pass_word(b, value);
}

void ceduo_bytes_number(struct bytes *b, double *value)
{
    pass_word(b, value);
}

/* ---- columns ---- */

static bool write_values(struct bytes *b, const double *first, const double *column, size_t n, size_t there)
{
    unsigned char *p = ceduo_bytes_write(b, there * 8);
    for (size_t i = 0; p && i < n; i++)
        if (!isnan(first[i])) {
            copy_word(p, &column[i]);
            p += 8;
        }
    return !b->no_memory;
}

static bool write_column(struct bytes *b, const double *column, size_t n, uint64_t *there)
{
    unsigned char *bits = ceduo_bytes_write(b, (n + 7) / 8);
    *there = 0;
    if (!bits)
        return false;
    memset(bits, 0, (n + 7) / 8);
    for (size_t i = 0; i < n; i++)
        if (!isnan(column[i])) {
            bits[i / 8] = (unsigned char)(bits[i / 8] | 1u << i % 8);
            ++*there;
        }
    return write_values(b, column, column, n, (size_t)*there);
}

/* No bit behind the last. */
static uint64_t count_bits(const unsigned char *bits, size_t n)
{
    uint64_t count = 0;
    for (size_t i = 0; i < (n + 7) / 8; i++)
        for (unsigned byte = bits[i]; byte; byte &= byte - 1)
            count++;
    return n % 8 != 0 && bits[n / 8] >> n % 8 != 0 ? UINT64_MAX : count;
}

/* A value wherever `first`, which may be `column` itself, is a number. */
static bool read_values(struct bytes *b, const double *first, double *column, size_t n, size_t there)
{
    const unsigned char *p = ceduo_bytes_read(b, there * 8);
    for (size_t i = 0; p && i < n; i++) {
        if (isnan(first[i])) {
            column[i] = NAN;
            continue;
        }
        copy_word(&column[i], p);
        p += 8;
        if (!isfinite(column[i]))
            return false;
    }
    return p != NULL;
}

static bool read_column(struct bytes *b, double *column, size_t n, uint64_t *there)
{
    const unsigned char *bits = ceduo_bytes_read(b, (n + 7) / 8);
    *there = bits ? count_bits(bits, n) : 0;
    if (!bits || *there > n)
        return false;
    for (size_t i = 0; i < n; i++)
        column[i] = bits[i / 8] >> i % 8 & 1 ? 0 : NAN;
    return read_values(b, column, column, n, (size_t)*there);
}

bool ceduo_bytes_column(struct bytes *b, double *column, size_t n, uint64_t *there)
{
    return b->reads ? read_column(b, column, n, there) : write_column(b, column, n, there);
}

bool ceduo_bytes_column_as(struct bytes *b, const double *first, double *column, size_t n)
{
    size_t there = 0;
    for (size_t i = 0; i < n; i++)
        there += isnan(first[i]) ? 0 : 1;
    return b->reads ? read_values(b, first, column, n, there) : write_values(b, first, column, n, there);
}
