/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STATUS_H
#define CEDUO_STATUS_H

/* What a call of the core returns. The core writes no text: whoever called it knows the file and the field that a
 * status speaks of, and says so to the user. */
enum ceduo_status {
    CEDUO_OK = 0,
    CEDUO_NO_MEMORY,
    CEDUO_CANCELLED,         /* the caller's cancel flag was raised; the run holds whatever was finished before */
    CEDUO_BAD_ROCK,          /* a size, mass or density is missing, not finite or not above 0 */
    CEDUO_BAD_SLOPE,         /* fewer than two vertices, x not rising, a coefficient outside its range */
    CEDUO_RELEASE_OFF_SLOPE, /* the release, or a part of its spread, lies beyond the slope */
    CEDUO_RELEASE_BELOW,     /* the release, or a part of its spread, lies below the ground */
    CEDUO_CONTROL_OFF_SLOPE, /* a control lies beyond the slope */
    CEDUO_CONTROL_BEHIND,    /* a control does not lie beyond the release */
    CEDUO_NO_FIT,            /* no curve goes through these pairs */
    CEDUO_BAD_NUMBER,        /* another number or word of the scene beyond its range, as of its simulation */
    CEDUO_BAD_BELT,          /* belts that overlap, that end before they begin, or that lie beyond the slope */
    CEDUO_BAD_STAND          /* a number or word of a stand beyond its range, or stems without their sizes */
};

#endif
