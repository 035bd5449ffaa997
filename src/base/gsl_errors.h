/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GSL_ERRORS_H
#define CEDUO_GSL_ERRORS_H

#include <stdbool.h>

/* At the head of a function: until it returns, an error of GSL in this thread is what its call returns, and does not end the
 * program. Every call of the library that lets GSL allocate or fit has it, and every thread that the library starts. */
#define GSL_RETURNS_ERRORS __attribute__((cleanup(ceduo_gsl_leave), unused)) bool gsl_returned_errors = ceduo_gsl_enter()

/* Calls what goes on with memory that it does not get, as GSL's singular value decomposition does. What it returns, or
 * GSL_ENOMEM. */
int ceduo_gsl_try(int (*call)(void *context), void *context);

bool ceduo_gsl_enter(void);
void ceduo_gsl_leave(const bool *before);

#endif
