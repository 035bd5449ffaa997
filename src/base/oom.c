/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "oom.h"

void (*ceduo_oom_hook)(void);

static _Thread_local bool lost;

void ceduo_oom_set_flag(void)
{
    lost = true;
    if (ceduo_oom_hook) /* untaken: end */
        ceduo_oom_hook();
}

bool ceduo_memory_failed(void)
{
    bool was_lost = lost;
    lost = false;
    return was_lost;
}
