/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VALUE_TEXT_H
#define CEDUO_VALUE_TEXT_H

#include "scene/schema.h"

/* Values as people read and type them: diameters in cm, decimal comma or dot, pairs with a blank. Files, --set and all
 * output use the units of the table and a dot; this module is for screens only. Display units: struct field_shown. */

/* Parse a number with a dot or one comma: 7.5, 7,5. */
enum ceduo_number_reading ceduo_input_parse_number(const char *typed, double *value);

/* Convert typed text to the notation of files; text that is not a number is copied, so that the parser rejects it. "7,5" in
 * a diameter: 0.075; "2,6 ± 0,1": {mean: 2.6, spread: 0.1}; point "60,5 35": [60.5, 35]; place "End - 10,5": end-10.5. */
void ceduo_input_parse_value(const struct field *field, const char *typed, struct text *value);

/* True if the typed number is in the range of a field; otherwise set the reason, in the display unit. Text that is not a
 * number passes. */
bool ceduo_input_is_in_range(const struct field *field, const char *typed, struct text *reason);

/* True if the typed value is so unusual that the user must confirm; set the question. */
bool ceduo_input_is_unusual(const struct field *field, const char *typed, struct text *question);

/* Convert a typed profile, "0 60, 20 35" or "0,5 60,2; 20 35", to a list of vertices; set first and last x. False if
 * invalid. */
bool ceduo_input_parse_points(const char *typed, struct text *vertices, double *first, double *last);

/* Append a value of a file in display notation. */
void ceduo_format_value(const struct field *field, const char *written, struct text *shown);
const char *ceduo_format_number(const struct field *field, double value, char buffer[CEDUO_NUMBER_SIZE]);

/* Return the display unit of a field; append its range in that unit. False if it has none. */
const char *ceduo_format_unit(const struct field *field);
bool ceduo_format_range(const struct field *field, struct text *text);

/* Append a path in words: "stools per ha, belt 2". */
void ceduo_format_path(const char *path, struct text *text);

#endif
