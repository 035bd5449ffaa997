/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Free a variable at the end of its block: LOCAL(ceduo_run, run) = …; release an object on the stack:
 * LOCAL_BY(ceduo_scene_release) struct scene_file file = …; free memory: LOCAL_BYTES char *text = …; */
#ifndef LOCAL_H
#define LOCAL_H

#include <stdlib.h>
#include <string.h>

#define LOCAL_FREES(type)                                                                                                      \
    struct type;                                                                                                               \
    void type##_free(struct type *object);                                                                                     \
    static inline void type##_free_local(struct type **object)                                                                 \
    {                                                                                                                          \
        type##_free(*object);                                                                                                  \
    }

LOCAL_FREES(ceduo_cells)
LOCAL_FREES(ceduo_tracer)
LOCAL_FREES(ceduo_observer)
LOCAL_FREES(ceduo_pool)
LOCAL_FREES(ceduo_result)
LOCAL_FREES(ceduo_run)
LOCAL_FREES(ceduo_snapshot)
LOCAL_FREES(ceduo_surface)
LOCAL_FREES(ceduo_years)

#define LOCAL(type, name) __attribute__((cleanup(type##_free_local))) struct type *name
#define LOCAL_BY(release) __attribute__((cleanup(release)))
#define LOCAL_BYTES       LOCAL_BY(local_bytes_free)

__attribute__((unused)) static inline void local_bytes_free(void *pointer)
{
    void *bytes;
    memcpy(&bytes, pointer, sizeof bytes);
    free(bytes);
}

#endif
