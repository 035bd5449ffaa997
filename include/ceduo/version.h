/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VERSION_H
#define CEDUO_VERSION_H

#define CEDUO_VERSION "0.4.0"

/* That of the library which runs. Before 1.0 structures may differ between versions: a program compares it with the
 * CEDUO_VERSION that it was compiled with. */
const char *ceduo_version(void);

#endif
