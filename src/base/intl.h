/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_INTL_H
#define CEDUO_INTL_H

#include "language.h"

#endif
