/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values in files: ends of their ranges, texts that look like other types, similar words. */
#include "local.h"
#include "table.h"

#include <math.h>
#include <regex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/node.h"
#include "io/scene_file.h"
#include "unit/every_key.h"

/* ---- ranges ---- */

/* Return the messages of a scene with path=value; NULL if the scene has no such place. Caller frees. */
static char *read_problems(const char *scene, const char *path, const char *value)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    LOCAL_TEXT(set);
    char *messages = NULL;
    assert_true(ceduo_scene_load(&file, scene, NULL, 0, &problems));
    ceduo_text_format(&set, "%s=%s", path, value);
    if (ceduo_scene_set(&file, "--set", set.bytes, &problems)) {
        ceduo_scene_bind(&file, &problems);
        messages = strdup(ceduo_problems_print(&problems));
    }
    return messages;
}

/* True if a value is in the range of `place`; other problems do not count. */
static bool is_in_range(const char *path, const char *place, const char *value)
{
    LOCAL_BYTES char *messages = NULL;
    for (size_t i = 0; !messages && i < LENGTH(scenes); i++)
        messages = read_problems(scenes[i], path, value);
    if (!messages)
        fail_msg("no scene here holds %s", path);
    static const char *const words[] = {" is below ", " is not above ", " is above ", " is not below ", " the spread reaches "};
    LOCAL_TEXT(start);
    ceduo_text_format(&start, ": %s: ", place);
    const char *at = strstr(messages, start.bytes);
    bool in = true;
    for (size_t i = 0; at && i < LENGTH(words); i++) {
        const char *word = strstr(at, words[i]);
        in &= !word || memchr(at, '\n', (size_t)(word - at));
    }
    return in;
}

static void expect_range(const char *path, const char *place, double value, bool in)
{
    char text[64];
    snprintf(text, sizeof text, "%.17g", value);
    if (is_in_range(path, place, text) != in)
        fail_msg("%s = %s is %s", path, text, in ? "refused" : "taken");
}

static size_t fields, open_ends;

/* Try the limits, and their neighbouring numbers on both sides. */
static void check_field(void *context, const char *path, const struct field *f)
{
    (void)context;
    bool points = f->type == FIELD_POINTS, listed = f->type == FIELD_NUMBERS || f->type == FIELD_SPREADS || points;
    if (strstr(path, "uncertainty[]") || strncmp(path, "observed[]", 10) == 0) /* as for the value; test_observed.py */
        return;
    if (f->type != FIELD_NUMBER && f->type != FIELD_SPREAD && f->type != FIELD_COUNT && !listed)
        return;
    LOCAL_BY(ceduo_text_free) struct text place = {0}, whole = {0};
    first_place(path, f, "[0]", &place);
    ceduo_text_format(&whole, "%s%s", place.bytes, points ? "[1]" : "");
    bool count = f->type == FIELD_COUNT;
    assert_true(isfinite(f->lo));
    assert_true(isfinite(f->hi));
    EXPECT(f->lo, <, f->hi);
    expect_range(whole.bytes, place.bytes, count ? f->lo - 1 : nextafter(f->lo, -INFINITY), false);
    expect_range(whole.bytes, place.bytes, f->lo, !(f->flags & FIELD_ABOVE));
    expect_range(whole.bytes, place.bytes, count ? f->lo + 1 : nextafter(f->lo, INFINITY), true);
    expect_range(whole.bytes, place.bytes, count ? f->hi - 1 : nextafter(f->hi, -INFINITY), true);
    expect_range(whole.bytes, place.bytes, f->hi, !(f->flags & FIELD_UNDER));
    expect_range(whole.bytes, place.bytes, count ? f->hi + 2 : nextafter(f->hi, INFINITY), false); /* 2^53 + 1 is no double */
    fields++;
    open_ends += (f->flags & FIELD_UNDER) != 0;
}

TEST(every_range_ends_at_its_limits)
{
    fields = open_ends = 0;
    ceduo_schema_visit(ceduo_schema_scene(), "", check_field, NULL);
    EXPECT(fields, >, 60);
    EXPECT(open_ends, >, 0); /* the loop covered the table */
}

/* ---- texts ---- */

/* The types of yaml.org, version 1.1, and the core schema of 1.2: an unquoted word that matches one is not text. */
static const char *const types[] = {
    "^(~|null|Null|NULL|)$",
    "^(y|Y|yes|Yes|YES|n|N|no|No|NO|true|True|TRUE|false|False|FALSE|on|On|ON|off|Off|OFF)$",
    "^[-+]?0b[0-1_]+$",
    "^[-+]?0o?[0-7_]+$",
    "^[-+]?(0|[1-9][0-9_]*)$",
    "^[-+]?0x[0-9a-fA-F_]+$",
    "^[-+]?[1-9][0-9_]*(:[0-5]?[0-9])+$",
    "^[-+]?([0-9][0-9_]*)?\\.[0-9.]*([eE][-+][0-9]+)?$",
    "^[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+\\.[0-9_]*$",
    "^[-+]?(\\.[0-9]+|[0-9]+(\\.[0-9]*)?)([eE][-+]?[0-9]+)?$",
    "^[-+]?\\.(inf|Inf|INF)$",
    "^\\.(nan|NaN|NAN)$",
    "^[0-9][0-9][0-9][0-9]-[0-9][0-9]?-[0-9][0-9]?([Tt]|[ \t]|$)",
    "^(<<|=)$",
    "^[ \t]|[ \t]$", /* outer blanks are dropped */
};

static bool is_another_type(const char *text)
{
    static regex_t compiled[LENGTH(types)];
    static bool ready;
    for (size_t i = 0; i < LENGTH(types) && !ready; i++)
        assert_int_equal(regcomp(&compiled[i], types[i], REG_EXTENDED | REG_NOSUB), 0);
    ready = true;
    for (size_t i = 0; i < LENGTH(types); i++)
        if (regexec(&compiled[i], text, 0, NULL, 0) == 0)
            return true;
    return false;
}

/* A quoted text is written so that every reader takes it as text. */
static void expect_text(const char *word)
{
    LOCAL_TEXT(text);
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    ceduo_emit_scalar(&text, word, true);
    if (is_another_type(word) && text.bytes[0] != '"')
        fail_msg("'%s' is written %s, which is no text", word, text.bytes);
    const struct source source = {.name = "test", .bytes = text.bytes, .length = text.length};
    const struct node *back = ceduo_yaml_read(&arena, &source, &problems);
    assert_true(back);
    EXPECT(back->kind, ==, NODE_SCALAR);
    assert_string_equal(back->text, word);
}

TEST(names_stay_texts)
{
    const char *const words[] = {"",     " ",      "a ",    " a",    "\ta",   "~",          "null",
                                 "Null", "NULL",   "y",     "N",     "yes",   "Yes",        "YES",
                                 "no",   "No",     "NO",    "true",  "True",  "TRUE",       "false",
                                 "on",   "On",     "off",   "OFF",   "0x10",  "-0x1F",      "0b101",
                                 "0o17", "017",    "+12",   "1_000", "1e3",   "1E+3",       ".5",
                                 "5.",   "-.5e-3", ".",     "..",    "1.2.3", "1:30",       "1:30.5",
                                 ".inf", "-.Inf",  "+.INF", ".nan",  ".NaN",  "2024-01-31", "2024-1-3 10:00",
                                 "<<",   "=",      "0",     "-0"};
    for (size_t i = 0; i < LENGTH(words); i++) {
        assert_true(is_another_type(words[i]));
        expect_text(words[i]);
    }
    /* and all combinations of these characters */
    static const char letters[] = "0179.+-_:xXbBoOeEfFnNaAyY ~";
    uint64_t bits = 1;
    for (int i = 0; i < 200000; i++) {
        char word[8] = "";
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        for (size_t k = 0; k < 1 + (bits >> 20) % 6; k++)
            word[k] = letters[(bits >> (24 + 6 * k)) % (sizeof letters - 1)];
        expect_text(word);
    }
}

/* Quotes are used only if needed: plain text stays plain. */
TEST(plain_names_stay_plain)
{
    const char *words = "ADS 1|simple-coppice|../stands/ads-1.yaml|25 years|10 m|1st|No wood|yesterday|a|nil|x|0.5 m|1 2|"
                        "on the road|profile_1.csv|./s.yaml";
    for (char word[64]; next_word(&words, word);)
        for (int quoted = 0; quoted < 2; quoted++) {
            LOCAL_TEXT(text);
            assert_false(is_another_type(word));
            ceduo_emit_scalar(&text, word, quoted);
            assert_string_equal(text.bytes, word);
        }
    const char *const values[] = {"0.5", "-1", "1e3", ".5", "+.5", "true", "false"}; /* unquoted, these are not texts */
    for (size_t i = 0; i < LENGTH(values); i++) {
        LOCAL_TEXT(text);
        ceduo_emit_scalar(&text, values[i], false);
        assert_string_equal(text.bytes, values[i]);
    }
}

/* ---- similar words ---- */

TEST(the_nearest_word_is_proposed)
{
    for (TABLE(row, "unit/words.txt", "near words")) {
        const char *words[4];
        char text[128], *rest = text, *word;
        size_t n = 0;
        snprintf(text, sizeof text, "%s", row.at[2]);
        while ((word = strsep(&rest, ",")))
            words[n++] = word + strspn(word, " ");
        const char *found = ceduo_text_nearest(row.at[0], words, n);
        assert_string_equal(found ? found : "none", row.at[1]);
    }
}
