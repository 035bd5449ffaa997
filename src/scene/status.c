/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/status.h"

const char *ceduo_status_text(enum ceduo_status status)
{
    switch (status) {
#define X(NAME, text)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return text;
        CEDUO_STATUSES(X)
#undef X
    }
    return "unknown status";
}

const char *ceduo_version(void)
{
    return CEDUO_VERSION;
}
