/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A temporary folder for a test, removed with its content. */
#ifndef FOLDER_H
#define FOLDER_H

#include "expect.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char folder[64];

static inline void folder_make(void)
{
    snprintf(folder, sizeof folder, "/tmp/ceduo-test-XXXXXX");
    assert_non_null(mkdtemp(folder));
}

static inline int folder_remove_one(const char *path, const struct stat *about, int kind, struct FTW *place)
{
    (void)about;
    (void)kind;
    (void)place;
    return remove(path);
}

/* Remove the folder; return the result of a tear-down. */
static inline int folder_remove(void)
{
    return nftw(folder, folder_remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

/* Set-up for tests that need an empty folder. */
static inline int folder_set_up(void **state)
{
    (void)state;
    folder_make();
    return 0;
}

static inline int folder_tear_down(void **state)
{
    (void)state;
    return folder_remove();
}

static inline void in_folder(char path[256], const char *name)
{
    snprintf(path, 256, "%s/%s", folder, name);
}

/* Make a folder inside it. */
static inline void make_folder(const char *name)
{
    char path[256];
    in_folder(path, name);
    assert_int_equal(mkdir(path, 0700), 0);
}

/* Set-up with a folder of the user's own profiles; one profile is a folder. */
static inline int folder_set_up_profiles(void **state)
{
    folder_set_up(state);
    make_folder("ceduo");
    make_folder("ceduo/stands");
    make_folder("ceduo/stands/folder.yaml");
    setenv("XDG_DATA_HOME", folder, 1);
    return 0;
}

/* Write a file inside it, without waiting for the disk. */
static inline void folder_write(const char *name, const char *text)
{
    char path[256];
    in_folder(path, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fputs(text, file) == EOF, 0);
    assert_int_equal(fclose(file), 0);
}

#endif
