/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FUZZ_H
#define CEDUO_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#define FUZZ_PATH_SIZE 64

/* A harness takes one input of any bytes, from libFuzzer or replay.c. Run it from the top of the sources, which has the
 * profiles. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Make a file in memory of `size` bytes, which has `path` until the caller closes the returned descriptor. */
static inline int fuzz_make_file(const void *bytes, size_t size, char path[FUZZ_PATH_SIZE])
{
    int fd = memfd_create("fuzz", MFD_CLOEXEC);
    if (fd < 0 || write(fd, bytes, size) != (ssize_t)size)
        abort();
    snprintf(path, FUZZ_PATH_SIZE, "/proc/self/fd/%d", fd);
    return fd;
}

#endif
