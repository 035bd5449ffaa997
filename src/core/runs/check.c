/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"

#include <math.h>

#include "scene/schema.h"

enum ceduo_status ceduo_check_window(struct ceduo_window w)
{
    bool good = w.step > 0 && w.first <= w.last && w.last <= CEDUO_YEAR_MAX;
    return good && (w.last - w.first) / w.step < CEDUO_YEARS_MAX ? CEDUO_OK : CEDUO_BAD_ARGUMENT;
}

/* True if a run of the scene may be made so. */
static bool is_run_good(const struct ceduo_run_def *def)
{
    return def->rocks_max <= CEDUO_ROCKS_MAX && def->threads <= CEDUO_THREADS_MAX && def->kernel <= CEDUO_KERNEL_AVX512 &&
           ceduo_option_has_lists(def->option);
}

enum ceduo_status ceduo_check_run_def(const struct ceduo_run_def *def)
{
    enum ceduo_status status = ceduo_scene_check(def->scene, NULL);
    return status == CEDUO_OK && !is_run_good(def) ? CEDUO_BAD_ARGUMENT : status;
}

enum ceduo_status ceduo_check_request(const struct ceduo_request *q)
{
    enum ceduo_status status = q->size == sizeof *q ? ceduo_check_run_def(&q->run) : CEDUO_BAD_ARGUMENT;
    if (status != CEDUO_OK)
        return status;
    size_t options = q->run.scene->options_count;
    bool good = options > 0 && q->rocks <= CEDUO_ROCKS_MAX && (q->only == CEDUO_ALL_OPTIONS || q->only < options);
    return good && (q->window.step == 0 || ceduo_check_window(q->window) == CEDUO_OK) ? CEDUO_OK : CEDUO_BAD_ARGUMENT;
}
