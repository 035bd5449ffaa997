/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plain_walk.h"
/* the same text, compiled with another kind of number */
#include "physics/slow_walk.c"
