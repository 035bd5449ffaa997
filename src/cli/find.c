/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --find: the value of one parameter for which a goal is reached. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch.h"
#include "output.h"
#include "say.h"
#include "ceduo/version.h"
#include "interrupt.h"
#include "base/intl.h"
#include "base/json.h"
#include "model/seek.h"

static const char *side_of(const struct ceduo_found *found)
{
    return found->side == CEDUO_SMALLEST ? "smallest" : "largest";
}

static void put_json(struct text *out, const struct arguments *a, const struct seek *s, const struct ceduo_found *f)
{
    struct json json = {.text = out}, *j = &json;
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "format", "ceduo-find-1");
    ceduo_json_string(j, "version", CEDUO_VERSION);
    ceduo_json_string(j, "scene", s->file->path);
    ceduo_json_string(j, "path", s->path);
    ceduo_json_string(j, "option", s->file->scene.options[s->option].name);
    ceduo_json_string(j, "goal", ceduo_goals[a->goal].word);
    ceduo_json_number(j, "target", s->target);
    ceduo_json_number(j, "lo", s->lo);
    ceduo_json_number(j, "hi", s->hi);
    ceduo_json_flag(j, "found", f->found);
    ceduo_json_number(j, "value", f->value);
    if (f->found)
        ceduo_json_string(j, "side", side_of(f));
    else
        ceduo_json_null(j, "side");
    ceduo_json_number(j, "goal_at_value", f->goal_at_value);
    ceduo_json_number(j, "nearest", f->nearest);
    ceduo_json_number(j, "goal_at_nearest", f->goal_at_nearest);
    ceduo_json_flag(j, "monotone", f->monotone);
    ceduo_json_count(j, "evaluations", f->evaluations);
    ceduo_json_count(j, "rocks", s->rocks);
    ceduo_json_close(j, '}');
    ceduo_text_char(out, '\n');
}

static void put_csv(struct text *out, const struct arguments *a, const struct seek *s, const struct ceduo_found *f)
{
    char room[CEDUO_NUMBER_ROOM];
    const char *const texts[] = {s->file->path, s->path, s->file->scene.options[s->option].name, ceduo_goals[a->goal].word};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        ceduo_text_csv(out, texts[i]);
        ceduo_text_char(out, ',');
    }
    const double numbers[] = {s->target, s->lo, s->hi, f->value, f->goal_at_value, f->nearest, f->goal_at_nearest};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        ceduo_text_format(out, "%s,", isfinite(numbers[i]) ? ceduo_number_shortest(numbers[i], room) : "");
    ceduo_text_format(out, "%s,%s,%s,%u,%llu\n", f->found ? "true" : "false", f->found ? side_of(f) : "",
                      f->monotone ? "true" : "false", f->evaluations, (unsigned long long)s->rocks);
}

static void put_page(struct text *out, const struct arguments *a, const struct seek *s, const struct ceduo_found *f)
{
    if (a->scenes_count > 1) {
        ceduo_text_safe(out, s->file->path);
        ceduo_text_put(out, ":\n");
    }
    ceduo_seek_say(s, f, out);
}

/* The one option to look at. */
static enum exit_status choose(const struct arguments *a, const struct scene_file *file, size_t *option)
{
    const struct ceduo_scene *scene = &file->scene;
    bool several = a->options_count == 0 && scene->options_count > 1;
    *option = 0;
    for (size_t i = 0; i < a->options_count; i++) {
        size_t k = 0;
        while (k < scene->options_count && strcmp(scene->options[k].name, a->options[i]) != 0)
            k++;
        if (k == scene->options_count)
            return ceduo_batch_no_option(file, a->options[i]);
        several |= i > 0 && k != *option;
        *option = k;
    }
    if (several)
        ceduo_say_why("ceduo", _("--find: the scene has several options; name one with --option"));
    return several ? EXIT_USAGE : EXIT_DONE;
}

enum exit_status ceduo_batch_find(const struct arguments *a)
{
    struct text out = {0};
    enum exit_status status = EXIT_DONE;
    if (a->format == CEDUO_CSV)
        ceduo_text_put(&out, "scene,path,option,goal,target,lo,hi,value,goal_at_value,nearest,goal_at_nearest,found,side,"
                             "monotone,evaluations,rocks\n");
    for (size_t i = 0; i < a->scenes_count; i++) {
        struct scene_file file;
        size_t option = 0;
        enum exit_status one = ceduo_batch_read(a, a->scenes[i], NULL, &file);
        if (one == EXIT_DONE)
            one = choose(a, &file, &option);
        if (one == EXIT_DONE) {
            ceduo_interrupt_catch();
            struct seek seek = {.file = &file,
                                .path = a->find,
                                .option = option,
                                .goal = a->goal,
                                .target = a->goal_value,
                                .lo = a->find_lo,
                                .hi = a->find_hi,
                                .rocks = a->rocks > 0 ? a->rocks : file.scene.simulation.rocks,
                                .threads = a->threads,
                                .cancel = ceduo_interrupt_flag()};
            struct ceduo_found found;
            struct problems problems = {0};
            enum ceduo_status done = ceduo_seek(&seek, &found, &problems);
            ceduo_problems_close(&problems);
            ceduo_say(&problems.text);
            if (done == CEDUO_OK && found.found) /* the nearest is of those that do not reach it */
                found.nearest = found.goal_at_nearest = NAN;
            if (done != CEDUO_OK)
                one = problems.count > 0 ? EXIT_USAGE : EXIT_RUN;
            else if (a->format == CEDUO_JSON)
                put_json(&out, a, &seek, &found);
            else if (a->format == CEDUO_CSV)
                put_csv(&out, a, &seek, &found);
            else
                put_page(&out, a, &seek, &found);
            ceduo_problems_free(&problems);
            ceduo_interrupt_release();
        }
        ceduo_scene_release(&file);
        status = one > status ? one : status;
    }
    ceduo_say_plainly(&out);
    if (status != EXIT_OUTPUT && (out.length > 0 || out.failed) && !atomic_load(ceduo_interrupt_flag())) {
        enum exit_status written = ceduo_output_write(a, &out);
        status = written > status ? written : status;
    }
    ceduo_text_free(&out);
    return status;
}
