/* SPDX-License-Identifier: GPL-3.0-or-later */
/* So many where FULL is in the environment, as in `make check-all`; fewer in `make check`, which is to be short. */
#ifndef FULL_H
#define FULL_H

#include <stdlib.h>

#define FULL_OR(many, few) (getenv("FULL") ? (many) : (few))

#endif
