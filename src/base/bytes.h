/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BYTES_H
#define CEDUO_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Numbers as bytes, little end first, whatever the machine. One function for both ways, so that what is written and
 * what is read cannot differ in their order. Starts as {0} to write, {.reads = true, .from, .length} to read. */
struct bytes {
    bool reads;
    const unsigned char *from;
    size_t length, at;
    unsigned char *to; /* written; to be freed by the caller */
    size_t room;
    bool bad; /* more was read than there is: what came then is 0 */
    bool no_memory;
};

void ceduo_bytes_count(struct bytes *b, uint64_t *value);
void ceduo_bytes_number(struct bytes *b, double *value);

/* Room for n bytes to be written at, or n bytes to be read; NULL where there are none. */
unsigned char *ceduo_bytes_write(struct bytes *b, size_t n);
const unsigned char *ceduo_bytes_read(struct bytes *b, size_t n);

/* What has not been read yet. */
size_t ceduo_bytes_left(const struct bytes *b);

/* A column of n numbers of which some are NaN: a bit for each, then those that are there, `*there` of them. False without
 * memory; reading, where the bytes do not hold them or one that is there is not finite. */
bool ceduo_bytes_column(struct bytes *b, double *column, size_t n, uint64_t *there);

/* The numbers of a second column that are there where those of the first are. */
bool ceduo_bytes_column_as(struct bytes *b, const double *first, double *column, size_t n);

#endif
