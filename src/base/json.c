/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json.h"

#include <inttypes.h>
#include <string.h>

#include "utf8.h"

static void append_string(struct text *text, const char *string)
{
    size_t n = strlen(string);
    ceduo_text_append_char(text, '"');
    for (size_t i = 0; i < n;) {
        uint32_t code = 0;
        size_t length = ceduo_utf8_decode(string + i, n - i, &code);
        if (length == 0) {
            ceduo_text_append(text, "\\ufffd");
            length = 1;
        } else if (code == '"' || code == '\\') {
            ceduo_text_append_char(text, '\\');
            ceduo_text_append_char(text, (char)code);
        } else if (!ceduo_utf8_printable(code) && code <= 0xffff) {
            ceduo_text_format(text, "\\u%04x", (unsigned)code);
        } else if (!ceduo_utf8_printable(code)) { /* as a UTF-16 surrogate pair */
            unsigned high = 0xd7c0 + (code >> 10), low = 0xdc00 + (code & 0x3ff);
            ceduo_text_format(text, "\\u%04x\\u%04x", high, low);
        } else {
            ceduo_text_append_n(text, string + i, length);
        }
        i += length;
    }
    ceduo_text_append_char(text, '"');
}

static void begin(struct json *json, const char *key)
{
    if (json->more)
        ceduo_text_append(json->text, ", ");
    json->more = true;
    if (key) {
        append_string(json->text, key);
        ceduo_text_append(json->text, ": ");
    }
}

void ceduo_json_open(struct json *json, const char *key, char bracket)
{
    begin(json, key);
    ceduo_text_append_char(json->text, bracket);
    json->more = false;
}

void ceduo_json_close(struct json *json, char bracket)
{
    ceduo_text_append_char(json->text, bracket);
    json->more = true;
}

void ceduo_json_number(struct json *json, const char *key, double value)
{
    begin(json, key);
    ceduo_text_append(json->text, ROUNDTRIP(value));
}

void ceduo_json_count(struct json *json, const char *key, uint64_t value)
{
    begin(json, key);
    ceduo_text_format(json->text, "%" PRIu64, value);
}

void ceduo_json_string(struct json *json, const char *key, const char *value)
{
    begin(json, key);
    if (value)
        append_string(json->text, value);
    else
        ceduo_text_append(json->text, "null");
}

void ceduo_json_flag(struct json *json, const char *key, bool value)
{
    begin(json, key);
    ceduo_text_append(json->text, value ? "true" : "false");
}
