/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CSV_SLOPE_H
#define CEDUO_CSV_SLOPE_H

#include "base/arena.h"
#include "problem.h"

/* A profile as its files give it. */
struct points {
    double *x, *z;
    size_t n;
    bool commas; /* for the decimals, as spreadsheets write them in Italian or German */
};

/* A profile from a CSV file as QGIS writes it: a header with the columns distance and elevation (x and z will do),
 * separated by comma, semicolon or tab. Where they are not separated by commas, commas may stand for the decimals. With x, y and
 * elevation it is a line on the map, and distances are along it.
 * False where that fails, which is reported. */
bool ceduo_csv_slope_read(struct arena *arena, const char *path, struct points *points, struct problems *problems);

#endif
