/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of ceduo/handle.h for R, see ceduo.R. Build: R CMD SHLIB ceduo_r.c -lceduo */
#include <R.h>
#include <Rinternals.h>
#include <ceduo/handle.h>

/* A handle is a number, which a double of R holds. */
static ceduo_handle handle_of(SEXP h)
{
    return (ceduo_handle)asReal(h);
}

static void check(ceduo_handle handle, int failed)
{
    if (failed)
        error("%s", ceduo_error(handle));
}

SEXP r_open(SEXP path)
{
    ceduo_handle handle = ceduo_open(CHAR(asChar(path)));
    check(0, handle == 0);
    return ScalarReal((double)handle);
}

SEXP r_set(SEXP h, SEXP path, SEXP text)
{
    check(handle_of(h), ceduo_set(handle_of(h), CHAR(asChar(path)), CHAR(asChar(text))) != CEDUO_OK);
    return R_NilValue;
}

SEXP r_simulate(SEXP h, SEXP rocks, SEXP threads)
{
    uint64_t n = asReal(rocks) > 0 ? (uint64_t)asReal(rocks) : 0;
    check(handle_of(h), ceduo_simulate(handle_of(h), n, (unsigned)asInteger(threads)) != CEDUO_OK);
    return R_NilValue;
}

SEXP r_get(SEXP h, SEXP path)
{
    SEXP value = PROTECT(allocVector(REALSXP, 3));
    check(handle_of(h), ceduo_get(handle_of(h), CHAR(asChar(path)), REAL(value)) != CEDUO_OK);
    UNPROTECT(1);
    return value;
}

SEXP r_samples(SEXP h, SEXP option, SEXP control, SEXP quantity)
{
    const char *name = CHAR(asChar(quantity));
    int64_t n = ceduo_samples(handle_of(h), asInteger(option), (size_t)asInteger(control), name, NULL, 0);
    check(handle_of(h), n < 0);
    SEXP result = PROTECT(allocVector(REALSXP, n));
    ceduo_samples(handle_of(h), asInteger(option), (size_t)asInteger(control), name, REAL(result), (size_t)n);
    UNPROTECT(1);
    return result;
}

SEXP r_close(SEXP h)
{
    return ScalarInteger(ceduo_close(handle_of(h)));
}
