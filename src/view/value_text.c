/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "value_text.h"

#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "words.h"

#define TYPED_MAX       1024 /* bytes of a typed line */
#define RANGE_WIDTH_MAX 2e9  /* wider ranges are not worth showing */

static bool is_number(const struct field *f)
{
    return f->type == FIELD_NUMBER || f->type == FIELD_SPREAD || f->type == FIELD_COUNT;
}

/* ---- reading ---- */

enum ceduo_number_reading ceduo_input_parse_number(const char *typed, double *value)
{
    char buffer[TYPED_MAX];
    typed += strspn(typed, " ");
    size_t n = strlen(typed);
    while (n > 0 && typed[n - 1] == ' ')
        n--;
    if (n >= sizeof buffer)
        return CEDUO_NUMBER_NONE;
    memcpy(buffer, typed, n);
    buffer[n] = '\0';
    char *comma = strchr(buffer, ',');
    if (comma && !strchr(buffer, '.') && !strchr(comma + 1, ','))
        *comma = '.';
    return ceduo_number_read(buffer, value);
}

/* Convert a displayed number to the file's unit, without rounding noise. */
static const char *to_file_unit(const struct field *f, double shown, char buffer[CEDUO_NUMBER_SIZE])
{
    char digits[CEDUO_NUMBER_SIZE];
    double value = shown / f->shown.per;
    snprintf(digits, sizeof digits, "%.14g", value);
    if (f->shown.per != 1)
        ceduo_number_read(digits, &value);
    return ceduo_number_shortest(value, buffer);
}

/* Parse numbers separated by blanks or semicolons; also by commas if `commas_separate`. Return 0 if any is invalid. */
static size_t read_numbers(const char *typed, bool commas_separate, double *values, size_t max)
{
    const char *between = commas_separate ? " \t;,[]" : " \t;[]";
    for (size_t n = 0;; n++) {
        char buffer[64];
        typed += strspn(typed, between);
        size_t length = strcspn(typed, between), used = length;
        while (used > 0 && typed[used - 1] == ',')
            used--;
        snprintf(buffer, sizeof buffer, "%.*s", (int)used, typed);
        if (n == max || used == 0 || used >= sizeof buffer || ceduo_input_parse_number(buffer, &values[n]) != CEDUO_NUMBER_GOOD)
            return typed[strspn(typed, " \t;,[]")] == '\0' ? n : 0;
        typed += length;
    }
}

bool ceduo_input_parse_points(const char *typed, struct text *vertices, double *first, double *last)
{
    double values[TYPED_MAX / 2];
    char x[CEDUO_NUMBER_SIZE], z[CEDUO_NUMBER_SIZE];
    size_t n = strchr(typed, ';') ? 0 : read_numbers(typed, true, values, TYPED_MAX / 2);
    bool rises = true;
    for (size_t i = 2; i < n; i += 2)
        rises &= values[i] > values[i - 2];
    if (!rises || n < 4 || n % 2 != 0)
        n = read_numbers(typed, false, values, TYPED_MAX / 2);
    if (n < 4 || n % 2 != 0)
        return false;
    ceduo_text_append(vertices, "[");
    for (size_t i = 0; i < n; i += 2)
        ceduo_text_format(vertices, "%s[%s, %s]", i ? ", " : "", ceduo_number_shortest(values[i], x),
                          ceduo_number_shortest(values[i + 1], z));
    ceduo_text_append(vertices, "]");
    *first = values[0];
    *last = values[n - 2];
    return true;
}

/* Convert "2,6 ± 0,1"; with u appended: uniform. */
static bool append_spread(const struct field *f, const char *typed, struct text *value)
{
    const char *sign = strstr(typed, "\xc2\xb1"), *plain = sign ? sign : strstr(typed, "+-");
    double mean, spread;
    char buffer[TYPED_MAX], a[CEDUO_NUMBER_SIZE], b[CEDUO_NUMBER_SIZE];
    if (!plain || strlen(typed) >= sizeof buffer)
        return false;
    snprintf(buffer, sizeof buffer, "%.*s", (int)(plain - typed), typed);
    bool good = ceduo_input_parse_number(buffer, &mean) == CEDUO_NUMBER_GOOD;
    snprintf(buffer, sizeof buffer, "%s", plain + 2);
    char *uniform = strchr(buffer, 'u');
    if (uniform)
        *uniform = '\0';
    if (!good || ceduo_input_parse_number(buffer, &spread) != CEDUO_NUMBER_GOOD)
        return false;
    ceduo_text_format(value, "{mean: %s, spread: %s%s}", to_file_unit(f, mean, a), to_file_unit(f, spread, b),
                      uniform ? ", kind: uniform" : "");
    return true;
}

/* Convert "End - 10,5" to "end-10.5". */
static bool append_place(const char *typed, struct text *value)
{
    double back = 0;
    char buffer[CEDUO_NUMBER_SIZE];
    typed += strspn(typed, " ");
    if (strncasecmp(typed, "end", 3) != 0)
        return false;
    typed += 3 + strspn(typed + 3, " ");
    if (*typed && (*typed != '-' || ceduo_input_parse_number(typed + 1, &back) != CEDUO_NUMBER_GOOD || back < 0))
        return false;
    ceduo_text_format(value, back > 0 ? "end-%s" : "end", ceduo_number_shortest(back, buffer));
    return true;
}

/* Convert a list that contains places from the end: 60 end-10. */
static bool append_places(const struct field *f, const char *typed, struct text *value)
{
    char word[64], buffer[CEDUO_NUMBER_SIZE];
    double number;
    LOCAL_TEXT(list);
    for (size_t n; *(typed += strspn(typed, " ;")); typed += n) {
        n = strcspn(typed, " ;");
        snprintf(word, sizeof word, "%.*s", (int)n, typed);
        ceduo_text_append(&list, list.length > 0 ? ", " : "[");
        if (ceduo_input_parse_number(word, &number) == CEDUO_NUMBER_GOOD)
            ceduo_text_append(&list, to_file_unit(f, number, buffer));
        else if (!append_place(word, &list))
            return false;
    }
    ceduo_text_format(value, "%s]", ceduo_text_string(&list));
    return true;
}

/* Convert numbers separated by blanks to a list; text in brackets is already YAML. */
static bool append_numbers(const struct field *f, const char *typed, struct text *value)
{
    double values[TYPED_MAX / 2];
    char buffer[CEDUO_NUMBER_SIZE];
    if (typed[0] == '[')
        return false;
    size_t n = read_numbers(typed, false, values, TYPED_MAX / 2);
    if (n == 0) /* commas are separators, not decimal */
        n = read_numbers(typed, true, values, TYPED_MAX / 2);
    if (n == 0 && ceduo_schema_is_place(f))
        return append_places(f, typed, value);
    for (size_t i = 0; i < n; i++)
        ceduo_text_format(value, "%s%s", i ? ", " : "[", to_file_unit(f, values[i], buffer));
    ceduo_text_append(value, n > 0 ? "]" : "");
    return n > 0;
}

void ceduo_input_parse_value(const struct field *f, const char *typed, struct text *value)
{
    double number;
    char buffer[CEDUO_NUMBER_SIZE];
    if (ceduo_schema_is_place(f) && append_place(typed, value))
        return;
    bool list = f->type == FIELD_NUMBERS || f->type == FIELD_POINTS || f->type == FIELD_SPREADS;
    if (list && append_numbers(f, typed, value))
        return;
    if (f->type == FIELD_SPREAD && append_spread(f, typed, value))
        return;
    if (f->type == FIELD_FLAG && (strcmp(typed, _("true")) == 0 || strcmp(typed, _("false")) == 0))
        typed = strcmp(typed, _("true")) == 0 ? "true" : "false";
    if (is_number(f) && (f->shown.per != 1 || strchr(typed, ',')) &&
        ceduo_input_parse_number(typed, &number) == CEDUO_NUMBER_GOOD)
        typed = to_file_unit(f, number, buffer);
    ceduo_text_append(value, typed);
}

/* ---- ranges ---- */

bool ceduo_input_is_in_range(const struct field *f, const char *typed, struct text *reason)
{
    double shown;
    if (!is_number(f) || ceduo_input_parse_number(typed, &shown) != CEDUO_NUMBER_GOOD ||
        ceduo_schema_in_range(f, shown / f->shown.per))
        return true;
    double lo = f->lo * f->shown.per, hi = f->hi * f->shown.per;
    const char *unit = ceduo_format_unit(f), *blank = unit[0] ? " " : "";
    if (shown < lo)
        ceduo_text_format(reason, _("%s: %s is below %.5g%s%s"), _(f->shown.label), typed, lo, blank, unit);
    else if (shown > hi)
        ceduo_text_format(reason, _("%s: %s is above %.5g%s%s"), _(f->shown.label), typed, hi, blank, unit);
    else
        ceduo_text_format(reason, _("%s: %s itself is outside the range"), _(f->shown.label), typed);
    return false;
}

bool ceduo_input_is_unusual(const struct field *f, const char *typed, struct text *question)
{
    double shown;
    if (!is_number(f) || ceduo_input_parse_number(typed, &shown) != CEDUO_NUMBER_GOOD)
        return false;
    if (ceduo_schema_is_usual(f, shown / f->shown.per))
        return false;
    const char *unit = ceduo_format_unit(f);
    ceduo_text_format(question, _("%s: %g%s%s? Usual is %g to %g. Enter once more takes it."), _(f->shown.label), shown,
                      unit[0] ? " " : "", unit, f->shown.usual_min * f->shown.per, f->shown.usual_max * f->shown.per);
    return true;
}

/* ---- showing ---- */

const char *ceduo_format_unit(const struct field *f)
{
    return f->shown.unit ? _(f->shown.unit) : f->unit;
}

bool ceduo_format_range(const struct field *f, struct text *text)
{
    if (f->hi - f->lo >= RANGE_WIDTH_MAX)
        return false;
    struct field shown = *f;
    shown.lo *= f->shown.per;
    shown.hi *= f->shown.per;
    return ceduo_schema_range_text(&shown, text);
}

const char *ceduo_format_number(const struct field *f, double value, char buffer[CEDUO_NUMBER_SIZE])
{
    if (!f)
        return ceduo_number_localize(ceduo_number_shortest(value, buffer));
    snprintf(buffer, CEDUO_NUMBER_SIZE, "%.12g", value * f->shown.per);
    return ceduo_number_localize(buffer);
}

void ceduo_format_value(const struct field *f, const char *written, struct text *shown)
{
    /* words of files that have a translation; other words are unchanged */
    static const char *const translated[] = {N_("simple coppice"),
                                             N_("coppice with standards"),
                                             N_("selection coppice"),
                                             N_("large reserves"),
                                             N_("high forest"),
                                             N_("bare"),
                                             N_("sphere"),
                                             N_("cylinder"),
                                             N_("ellipsoid"),
                                             N_("block"),
                                             N_("stems"),
                                             N_("index"),
                                             N_("auto"),
                                             N_("whole"),
                                             N_("fit"),
                                             N_("check"),
                                             N_("against"),
                                             N_("both"),
                                             N_("good"),
                                             N_("poor"),
                                             N_("true"),
                                             N_("false")};
    double value;
    size_t n;
    char buffer[CEDUO_NUMBER_SIZE];
    LOCAL_TEXT(words);
    if (!f || (f->type != FIELD_CHOICE && f->type != FIELD_FLAG)) {
        bool converted = f && is_number(f) && f->shown.per != 1 && ceduo_number_read(written, &value) == CEDUO_NUMBER_GOOD;
        size_t start = shown->length;
        ceduo_text_append(shown, converted ? ceduo_format_number(f, value, buffer) : written);
        if (f && is_number(f) && shown->bytes)
            ceduo_number_localize(shown->bytes + start);
        return;
    }
    for (const char *c = written; *c; c++)
        ceduo_text_append_char(&words, *c == '-' ? ' ' : *c);
    const char *phrase = ceduo_text_string(&words);
    int species = f->choices == &ceduo_species_words ? ceduo_species_find(written) : -1;
    if (species >= 0) { /* "hop hornbeam (Ostrya carpinifolia)" */
        ceduo_text_format(shown, "%s (%c%s)", _(ceduo_species_list(&n)[species].common), phrase[0] - 'a' + 'A', phrase + 1);
        return;
    }
    for (size_t i = 0; i < sizeof translated / sizeof translated[0]; i++)
        if (strcmp(translated[i], phrase) == 0)
            phrase = _(translated[i]);
    int ground = f->choices == &ceduo_material_words ? ceduo_choice_find(f->choices, written) : -1;
    const char *law = ground >= 0 ? _(f->choices->names[ground]) : ceduo_words_law(written);
    ceduo_text_append(shown, strcmp(law, written) != 0 ? law : phrase);
}

/* ---- paths ---- */

void ceduo_format_path(const char *path, struct text *text)
{
    const struct object *object = ceduo_schema_scene();
    const struct field *f = NULL, *named = NULL;
    struct path_step step;
    LOCAL_TEXT(places);
    size_t offset = 0, n = strlen(path);
    while (ceduo_path_next(path, n, &offset, &step)) {
        if (step.bracket && f) {
            size_t i;
            LOCAL_TEXT(place);
            if (ceduo_path_index(&step, &i))
                ceduo_text_format(&place, "%s %zu", _(f->shown.label), i + 1);
            else
                ceduo_text_format(&place, "%s '%.*s'", _(f->shown.label), (int)step.n, step.p);
            if (places.length > 0)
                ceduo_text_format(&place, ", %s", places.bytes);
            ceduo_text_free(&places);
            ceduo_text_append(&places, ceduo_text_string(&place));
            named = NULL;
            continue;
        }
        f = object ? ceduo_schema_step(object, &step) : NULL;
        object = f ? f->object : NULL;
        named = f;
    }
    if (named)
        ceduo_text_format(text, "%s%s", _(named->shown.label), places.length ? ", " : "");
    ceduo_text_append(text, named || places.length ? ceduo_text_string(&places) : path);
}
