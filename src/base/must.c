/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "must.h"

void (*ceduo_memory_hook)(void);

void ceduo_no_memory(void)
{
    if (ceduo_memory_hook)
        ceduo_memory_hook();
}
