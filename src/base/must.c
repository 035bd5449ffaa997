/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "must.h"

void (*ceduo_memory_hook)(void);

static _Thread_local bool lost;

void ceduo_no_memory(void)
{
    lost = true;
    if (ceduo_memory_hook) /* untaken: end */
        ceduo_memory_hook();
}

bool ceduo_memory_lost(void)
{
    bool was_lost = lost;
    lost = false;
    return was_lost;
}
