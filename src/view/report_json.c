/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/json.h"
#include "base/language.h"
#include "figures.h"

/* Where sentences go: items of a list, or the one of a key. */
struct sentences {
    struct json *json;
    const char *key;
};

static void put_sentence(void *context, const char *sentence)
{
    const struct sentences *to = context;
    ceduo_json_string(to->json, to->key, sentence);
}

static void put_value(struct json *j, const struct ceduo_figure *f, struct ceduo_value v)
{
    switch (v.kind) {
    case CEDUO_VALUE_NUMBER:
        ceduo_json_number(j, f->key, v.number);
        break;
    case CEDUO_VALUE_COUNT:
        ceduo_json_count(j, f->key, v.count);
        break;
    case CEDUO_VALUE_FLAG:
        ceduo_json_flag(j, f->key, v.flag);
        break;
    case CEDUO_VALUE_TEXT:
        ceduo_json_string(j, f->key, v.text);
        break;
    case CEDUO_NULL:
        if (!f->optional)
            ceduo_json_string(j, f->key, NULL);
    }
}

static void put_figures(struct json *j, const struct ceduo_figure *f, const void *object, double scale);

static void put_list(struct json *j, const struct ceduo_figure *f, const struct ceduo_place *place)
{
    struct ceduo_place item = *place;
    if (f->optional && !f->enter(&item, 0))
        return;
    ceduo_json_open(j, f->key, '[');
    for (size_t i = 0; item = *place, f->enter(&item, i); i++) {
        ceduo_json_open(j, NULL, '{');
        put_figures(j, f->of, &item, 1);
        ceduo_json_close(j, '}');
    }
    ceduo_json_close(j, ']');
}

static void put_items(struct json *j, const struct ceduo_figure *f, const void *object, double scale)
{
    const void *item;
    ceduo_json_open(j, f->key, '[');
    for (size_t i = 0; (item = f->item(object, i)); i++) {
        ceduo_json_open(j, NULL, '{');
        put_figures(j, f->of, item, ceduo_figure_scale(f, scale));
        ceduo_json_close(j, '}');
    }
    ceduo_json_close(j, ']');
}

static void put_object(struct json *j, const struct ceduo_figure *f, const void *object, double scale)
{
    if (!object) {
        put_value(j, f, (struct ceduo_value){.kind = CEDUO_NULL});
        return;
    }
    if (f->key)
        ceduo_json_open(j, f->key, '{');
    put_figures(j, f->of, object, ceduo_figure_scale(f, scale));
    if (f->key)
        ceduo_json_close(j, '}');
}

static void put_figures(struct json *j, const struct ceduo_figure *f, const void *object, double scale)
{
    for (; !ceduo_figure_is_end(f); f++) {
        if (f->value) {
            put_value(j, f, ceduo_figure_value(f, object, scale));
        } else if (f->enter) {
            put_list(j, f, object);
        } else if (f->item) {
            put_items(j, f, object, scale);
        } else if (f->of) {
            put_object(j, f, ceduo_figure_object(f, object), scale);
        } else {
            struct sentences to = {j, f->one ? f->key : NULL};
            if (!f->one)
                ceduo_json_open(j, f->key, '[');
            ceduo_language_of_data(true);
            f->say(object, put_sentence, &to);
            ceduo_language_of_data(false);
            if (!f->one)
                ceduo_json_close(j, ']');
        }
    }
}

static void put_line(struct text *text, const struct ceduo_figure *figures, const void *object)
{
    struct json json = {.text = text};
    ceduo_json_open(&json, NULL, '{');
    put_figures(&json, figures, object, 1);
    ceduo_json_close(&json, '}');
    ceduo_text_char(text, '\n');
}

void ceduo_report_json(struct text *text, const struct ceduo_report *report)
{
    put_line(text, ceduo_result_figures, &(struct ceduo_place){.report = report});
}

void ceduo_find_json(struct text *text, const struct ceduo_find_report *report)
{
    put_line(text, ceduo_find_figures, report);
}
