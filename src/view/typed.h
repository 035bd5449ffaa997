/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TYPED_H
#define CEDUO_TYPED_H

#include "scene/schema.h"

/* Values as a person reads and types them: diameters in cm, a comma or a dot for the decimals, pairs with a blank between.
 * Files, --set and all output keep the units and the dot of the table; what is here is for screens alone. The units are those
 * of the table (struct field_shown). */

/* Reads a number that was typed, with a dot or one comma for the decimals: 7.5, 7,5. */
enum ceduo_number_reading ceduo_input_parse_number(const char *typed, double *value);

/* Puts what was typed into a field as a file writes it; what is no number there stays as it is, for the reader to refuse.
 * "7,5" in a diameter: 0.075; "2,6 ± 0,1": {mean: 2.6, spread: 0.1}; a point "60,5 35": [60.5, 35]; a place "End - 10,5":
 * end-10.5. */
void ceduo_input_parse_value(const struct field *field, const char *typed, struct text *value);

/* Whether what was typed lies in the range of a field, and otherwise says why not, in the unit that is shown. What is no number
 * is not looked at. */
bool ceduo_input_is_in_range(const struct field *field, const char *typed, struct text *why);

/* Whether what was typed is so far from what is usual that a person is asked back; then puts the question. */
bool ceduo_input_is_unusual(const struct field *field, const char *typed, struct text *question);

/* Puts a profile that was typed, "0 60, 20 35" or "0,5 60,2; 20 35", as a list of vertices, and its first and last x. False
 * where it is none. */
bool ceduo_input_parse_points(const char *typed, struct text *vertices, double *first, double *last);

/* Puts a value of a file as it is shown. */
void ceduo_format_value(const struct field *field, const char *written, struct text *shown);
const char *ceduo_format_number(const struct field *field, double value, char room[CEDUO_NUMBER_SIZE]);

/* The unit in which a field is shown, and its range in it; false where it has none. */
const char *ceduo_format_unit(const struct field *field);
bool ceduo_format_range(const struct field *field, struct text *text);

/* Puts what a path means in words: "stools per ha, belt 2". */
void ceduo_format_path(const char *path, struct text *text);

#endif
