/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GSL_ERRORS_H
#define CEDUO_GSL_ERRORS_H

#include <stdbool.h>

/* First line of a function. Until it returns, a GSL error in this thread does not end the program but is returned by the GSL
 * call. Required in every library function that lets GSL allocate or fit, and in every thread of the library. */
#define GSL_RETURNS_ERRORS __attribute__((cleanup(ceduo_gsl_leave), unused)) bool gsl_returned_errors = ceduo_gsl_enter()

/* Run a GSL call that dereferences a failed allocation, such as the SVD. Returns its status, or GSL_ENOMEM. */
int ceduo_gsl_try(int (*call)(void *context), void *context);

bool ceduo_gsl_enter(void);
void ceduo_gsl_leave(const bool *saved_handler);

#endif
