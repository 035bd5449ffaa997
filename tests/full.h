/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Repeat counts: `full` if FULL is set, as in `make check-all`; otherwise fewer, so that `make check` is short. */
#ifndef FULL_H
#define FULL_H

#include <stdlib.h>

#define FULL_OR(many, few) (getenv("FULL") ? (many) : (few))

#endif
