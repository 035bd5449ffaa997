/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CONTACT_H
#define CEDUO_CONTACT_H

/* The laws of an impact on the ground. A new law is a file like src/core/walk/law_crsp.h, named in strike.h, and a line here. */
#define CEDUO_LAWS(X)                                                                                                          \
    X(LUMPED, lumped)                                                                                                          \
    X(CRSP, crsp)                                                                                                              \
    X(ARM, arm)

enum ceduo_law {
#define X(NAME, name) CEDUO_LAW_##NAME,
    CEDUO_LAWS(X)
#undef X
        CEDUO_LAW_COUNT
};

#endif
