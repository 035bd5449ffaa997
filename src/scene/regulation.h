/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REGULATION_H
#define CEDUO_REGULATION_H

#include "ceduo/scene.h"

struct ceduo_compliance ceduo_regulation_check(const struct ceduo_regulation *regulation, const struct ceduo_stand *stand);

#endif
