/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_JSON_H
#define CEDUO_JSON_H

#include <stdbool.h>
#include <stdint.h>

#include "text.h"

/* Write JSON into a text, on one line, with its commas. `key` NULL: an item of a list. */
struct json {
    struct text *text;
    bool more; /* this level has a value already */
};

void ceduo_json_open(struct json *json, const char *key, char bracket);
void ceduo_json_close(struct json *json, char bracket);
void ceduo_json_number(struct json *json, const char *key, double value); /* null if not finite */
void ceduo_json_count(struct json *json, const char *key, uint64_t value);
void ceduo_json_string(struct json *json, const char *key, const char *value); /* null for NULL */
void ceduo_json_flag(struct json *json, const char *key, bool value);

#endif
