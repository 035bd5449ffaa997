/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GSL_ERRORS_H
#define CEDUO_GSL_ERRORS_H

#include <stdbool.h>

/* First line of a function: until it returns, an error of GSL in this thread does not end the program, but is the status of GSL's
 * call. Every function of the library that lets GSL allocate or fit has it, and every thread of the library. */
#define GSL_RETURNS_ERRORS __attribute__((cleanup(ceduo_gsl_leave), unused)) bool gsl_returned_errors = ceduo_gsl_enter()

/* Call a function that would go on without memory, such as GSL's singular value decomposition. Returns its status, or
 * GSL_ENOMEM. */
int ceduo_gsl_try(int (*call)(void *context), void *context);

bool ceduo_gsl_enter(void);
void ceduo_gsl_leave(const bool *before);

#endif
