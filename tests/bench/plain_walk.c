/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plain_walk.h"
/* the same source, compiled with another number type */
#include "physics/slow_walk.c"
