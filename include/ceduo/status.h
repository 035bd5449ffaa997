/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STATUS_H
#define CEDUO_STATUS_H

/* Results of a call, each with its ceduo_status_text(). The text does not name the file, field or item: the caller knows it. */
#define CEDUO_STATUSES(X)                                                                                                      \
    X(OK, "done")                                                                                                              \
    X(NO_MEMORY, "out of memory")                                                                                              \
    X(CANCELLED, "cancelled") /* by the caller's flag; the run keeps the finished rocks */                                     \
    X(BAD_ROCK, "a size, mass or density of the rock is missing, not finite or not above 0")                                   \
    X(BAD_SLOPE, "the slope has fewer than two vertices, its x does not rise, or a coefficient is outside its range")          \
    X(RELEASE_OFF_SLOPE, "the release, or a part of its spread, lies beyond the slope")                                        \
    X(RELEASE_BELOW, "the release, or a part of its spread, lies below the ground")                                            \
    X(CONTROL_OFF_SLOPE, "a control lies beyond the slope")                                                                    \
    X(CONTROL_BEHIND, "a control does not lie beyond the release")                                                             \
    X(NO_FIT, "no curve goes through these pairs")                                                                             \
    X(BAD_NUMBER, "a number or word is outside its range, or a list is missing")                                               \
    X(BAD_BELT, "a belt overlaps another, ends before it begins, or lies beyond the slope")                                    \
    X(BAD_STAND, "a number or word of a stand is outside its range, or stems have no size")                                    \
    X(BAD_FILE, "a scene could not be read; its messages say why")                                                             \
    X(BAD_ARGUMENT, "a pointer is missing, or a count, an index or a window of years is outside its range")                    \
    X(BAD_PLACE, "an input names a place that the scene does not have")

enum ceduo_status {
#define X(NAME, text) CEDUO_##NAME,
    CEDUO_STATUSES(X)
#undef X
};

/* Return a sentence in English without a full stop; never NULL. */
const char *ceduo_status_text(enum ceduo_status status);

#define CEDUO_VERSION "0.4.0"

/* Return the version of the running library. Before 1.0 structs may change: programs must compare it with their
 * CEDUO_VERSION. */
const char *ceduo_version(void);

#endif
