/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VERSION_H
#define CEDUO_VERSION_H

#define CEDUO_VERSION "0.3.0"

#endif
