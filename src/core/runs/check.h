/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHECK_H
#define CEDUO_CHECK_H

#include "ceduo/simulate.h"

/* Check the input of a caller before use: pointers, counts, indices, windows. Each returns CEDUO_OK, CEDUO_BAD_ARGUMENT, or the
 * status of a bad scene. Requires arrays as long as their counts, which cannot be checked. */

enum ceduo_status ceduo_check_window(struct ceduo_window window);
enum ceduo_status ceduo_check_run_def(const struct ceduo_run_def *def);
enum ceduo_status ceduo_check_request(const struct ceduo_request *request);

#endif
