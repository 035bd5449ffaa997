/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One scene is read, and asked for runs, pictures, doubt; and how far that is. */
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/hash.h"
#include "base/language.h"
#include "batch.h"
#include "model/jobs.h"
#include "say.h"
#include "study/effort.h"
#include "view/words.h"

/* ---- reading ---- */

enum exit_status ceduo_batch_option(const struct scene_file *file, const char *name, size_t *index)
{
    const struct ceduo_scene *scene = &file->scene;
    for (*index = 0; *index < scene->options_count; ++*index)
        if (strcmp(scene->options[*index].name_given, name) == 0 || strcmp(scene->options[*index].name, name) == 0)
            return EXIT_DONE;
    LOCAL_TEXT(message);
    LOCAL_TEXT(names);
    for (size_t i = 0; i < scene->options_count; i++)
        ceduo_text_format(&names, "%s'%s'", i > 0 ? ", " : "", scene->options[i].name_given);
    ceduo_text_format(&message, _("--option: no option '%s' in %s; it has: %s"), name, file->path, ceduo_text_string(&names));
    ceduo_say_why("ceduo", ceduo_text_string(&message));
    return EXIT_USAGE;
}

/* Keeps only the options that were asked for, in the scene's order. */
static enum exit_status choose(const struct arguments *a, struct scene_file *file)
{
    bool *wanted = ceduo_arena_take(&file->arena, file->scene.options_count * sizeof *wanted);
    for (size_t i = 0, index; i < a->options.n; i++) {
        if (ceduo_batch_option(file, a->options.items[i], &index) != EXIT_DONE)
            return EXIT_USAGE;
        wanted[index] = true;
    }
    const struct node *list = ceduo_node_get(file->root, "options");
    if (a->options.n == 0 || !list)
        return EXIT_DONE;
    size_t *kept = ceduo_arena_take(&file->arena, list->n * sizeof *kept);
    for (size_t k = 0; kept && k < list->n; k++)
        if (wanted[k])
            kept[file->kept_count++] = k;
    file->kept = kept;
    for (size_t k = list->n; list && k-- > 0;)
        if (!wanted[k])
            list = ceduo_node_removed(&file->arena, list, k);
    const struct node *root = list ? ceduo_node_with(&file->arena, file->root, "options", list) : NULL;
    if (root && ceduo_node_get(root, "observed")) /* may be of an option that is left out */
        root = ceduo_node_without(&file->arena, root, "observed");
    LOCAL_PROBLEMS(problems);
    file->root = root;
    return root && ceduo_scene_bind(file, &problems) ? EXIT_DONE : EXIT_RUN;
}

/* Print warnings unless they are those printed last: the values of a file are the same for each row of --each. */
static void warn_once(struct text *text)
{
    static uint64_t last;
    uint64_t hash = hash_bytes(ceduo_text_string(text), text->length);
    if (text->length == 0 || hash == last)
        return;
    last = hash;
    ceduo_say(text);
}

enum exit_status ceduo_batch_read(const struct arguments *a, const char *path, struct scene_file *file)
{
    LOCAL_PROBLEMS(problems);
    struct scene_sets sets = {a->sets.items, a->sets.n, a->cells, a->called};
    bool good = ceduo_scene_load_row(file, path, &sets, &problems);
    const struct problem *first = problems.wrong.items;
    ceduo_problems_print(&problems);
    if (!good && problems.wrong.n > 0 && a->called && strncmp(first->place, a->called, strlen(a->called)) != 0)
        ceduo_say_why(a->called, _("this scene cannot be computed:")); /* what follows names another file, or a change */
    if (good)
        warn_once(&problems.text);
    else
        ceduo_say(&problems.text);
    enum exit_status status = good ? EXIT_DONE : problems.usage && !problems.cell ? EXIT_USAGE : EXIT_INPUT;
    for (const struct source *s = file->arena.sources; s && status != EXIT_OUTPUT; s = s->before)
        if (ceduo_output_is(a, s->path))
            status = EXIT_OUTPUT;
    return status == EXIT_DONE && a->mode != MODE_FIND && a->mode != MODE_CALIBRATE ? choose(a, file) : status;
}

/* ---- progress ---- */

struct progress ceduo_progress_begin(const struct arguments *a)
{
    return (struct progress){.start = ceduo_clock(), .wanted = !a->quiet && isatty(STDERR_FILENO)};
}

bool ceduo_progress_due(struct progress *p, double *seconds)
{
    double t = ceduo_clock();
    *seconds = t - p->start;
    if (!p->wanted || *seconds < 1 || t - p->shown < 0.2)
        return false;
    p->shown = t;
    return true;
}

static void show_rocks(void *progress, uint64_t rocks)
{
    double seconds;
    if (ceduo_progress_due(progress, &seconds))
        ceduo_say_progress(_("%llu rocks, %.0f s"), (unsigned long long)rocks, seconds);
}

static void show_steps(void *progress, uint64_t done, uint64_t all)
{
    double seconds;
    if (ceduo_progress_due(progress, &seconds))
        ceduo_say_progress(_("%llu of %llu, %.0f s"), (unsigned long long)done, (unsigned long long)all, seconds);
}

void ceduo_progress_scenes(struct progress *p, size_t computed, size_t done, size_t all)
{
    double seconds;
    if (computed == 0 || !ceduo_progress_due(p, &seconds))
        return;
    double left = seconds / (double)computed * (double)(all - done);
    LOCAL_TEXT(time);
    ceduo_text_format(&time, left < 120 ? "%.0f s" : "%.0f min", left < 120 ? left : left / 60);
    ceduo_say_progress(_("%zu of %zu scenes, %s left"), done, all, ceduo_text_string(&time));
}

/* ---- nothing to be said ---- */

#define LOOK_ROCKS 1000

/* Warnings about a scene; each is printed once. */
struct warnings {
    const struct scene_file *file;
    struct text printed;
};

static void warn(void *context, const char *sentence)
{
    struct warnings *warnings = context;
    if (strstr(ceduo_text_string(&warnings->printed), sentence))
        return;
    ceduo_say_why(warnings->file->path, sentence);
    ceduo_text_format(&warnings->printed, "%s\n", sentence);
}

/* Warn of stands that no forest has. */
static void warn_stands(const struct ceduo_result *result, struct warnings *warnings)
{
    for (size_t i = 0; i < result->options_count; i++)
        for (size_t k = 0; k < result->scene->options[i].belts_count; k++)
            ceduo_words_unlikely(&result->scene->options[i].belts[k], &result->options[i].stands[k], warn, warnings);
}

void ceduo_batch_warn(const struct arguments *a, const struct scene_file *file, bool stands)
{
    struct warnings warnings = {.file = file};
    struct ceduo_scene bare = file->scene;
    bare.simulation.contact_model = CEDUO_INDEX; /* nothing is flown through the forests */
    struct ceduo_question question = ceduo_question_default(&bare);
    struct ceduo_answer answer;
    question.rocks = bare.simulation.rocks < LOOK_ROCKS ? bare.simulation.rocks : LOOK_ROCKS;
    question.run.rocks_most = question.rocks;
    question.run.threads = (unsigned)a->threads;
    question.run.cancel = ceduo_interrupt_flag();
    if (ceduo_ask(&question, NULL, &answer) == CEDUO_OK) {
        ceduo_words_still(answer.result, warn, &warnings);
        if (stands)
            warn_stands(answer.result, &warnings);
    }
    ceduo_answer_release(&answer);
    ceduo_text_free(&warnings.printed);
}

enum exit_status ceduo_batch_failed(const struct scene_file *file, enum ceduo_status status)
{
    if (status != CEDUO_CANCELLED)
        ceduo_say_why(file->path, status == CEDUO_NO_MEMORY ? _("out of memory") : _("cannot be computed"));
    return EXIT_RUN;
}

/* ---- runs ---- */

void ceduo_ask_begin(struct asked *asked, const struct arguments *a, const struct scene_file *file)
{
    *asked = (struct asked){.progress = ceduo_progress_begin(a), .question = ceduo_question_default(&file->scene)};
    struct ceduo_question *q = &asked->question;
    q->rocks = a->rocks > 0 ? a->rocks : a->tolerance > 0 ? CEDUO_ROCKS_MOST : file->scene.simulation.rocks;
    q->run.rocks_most = q->rocks;
    q->tolerance = a->tolerance;
    q->run.threads = (unsigned)a->threads;
    q->run.other_energy = true;
    q->run.cancel = ceduo_interrupt_flag();
    q->run.progress = show_rocks;
    q->run.context = &asked->progress;
    q->years = a->years;
    q->window = a->window;
}

#define YEAR_ROCKS 1000 /* of each year: they give a share near the limit to 14 of 1000 */
#define YEARS_MOST 60   /* of a longer window some are simulated */

void ceduo_ask_years(struct ceduo_question *q)
{
    q->years = q->years_apart = true;
    q->year_rocks = YEAR_ROCKS;
    q->years_most = YEARS_MOST;
}

enum ceduo_status ceduo_ask_runs(struct asked *c)
{
    struct ceduo_pool *pool = NULL; /* for the pictures */
    enum ceduo_status status = ceduo_ask(&c->question, c->pictures ? &pool : NULL, &c->answer);
    c->seconds = ceduo_clock() - c->progress.start;
    const struct ceduo_snapshot_def def = {.scene = c->question.run.scene,
                                           .runs = pool,
                                           .envelope_rocks = c->envelopes ? CEDUO_ENVELOPE_ROCKS : 0,
                                           .trajectories = c->trajectories,
                                           .cancel = c->question.run.cancel};
    if (status == CEDUO_OK && c->pictures)
        status = ceduo_snapshot_create(&def, &c->snapshot);
    ceduo_pool_free(pool);
    return status == CEDUO_OK ? ceduo_verdict_make(c->answer.result, c->answer.years, c->answer.rotations, &c->verdict)
                              : status;
}

enum exit_status ceduo_ask_end(struct asked *c, const struct scene_file *file, enum ceduo_status status)
{
    const struct ceduo_result *r = c->answer.result;
    bool finished = !r || ceduo_result_unfinished(r) * 1000 <= ceduo_result_rocks(r);
    if (c->doubt.answer)
        ceduo_doubt_free(&c->doubt_answer);
    ceduo_verdict_release(&c->verdict);
    ceduo_snapshot_free(c->snapshot);
    ceduo_answer_release(&c->answer);
    return status != CEDUO_OK ? ceduo_batch_failed(file, status) : finished ? EXIT_DONE : EXIT_RUN;
}

/* ---- doubt ---- */

/* Asks with the points and rocks of `def`. `finer`: figures of the scene as it is from more rocks; may be NULL. */
static enum ceduo_status ask_doubt(struct asked *c, struct scene_file *file, const struct ceduo_doubt_def *def,
                                   const struct ceduo_result *finer)
{
    c->doubt = (struct ceduo_doubt_report){
        .file = file, .inputs = &c->inputs, .points = def->points, .rocks = def->rocks, .finer = finer};
    if (def->inputs_count == 0 || def->points == 0)
        return CEDUO_OK;
    enum ceduo_status status = ceduo_doubt_ask(def, &c->doubt_answer);
    c->doubt.answer = status == CEDUO_OK ? &c->doubt_answer : NULL;
    c->doubt.too_much = status == CEDUO_CANCELLED && !atomic_load(ceduo_interrupt_flag());
    return c->doubt.too_much ? CEDUO_OK : status;
}

/* Sets what the command line says. `years`: the years of the window are asked for as well. False without memory. */
static bool begin_doubt(struct asked *c, const struct arguments *a, struct scene_file *file, bool years,
                        struct ceduo_doubt_def *def)
{
    bool good = ceduo_inputs_of(file, &c->inputs);
    if (!years)
        ceduo_inputs_keep_today(&c->inputs);
    *def = (struct ceduo_doubt_def){.scene = &file->scene,
                                    .inputs_count = c->inputs.n,
                                    .inputs = c->inputs.items,
                                    .points = (size_t)a->points,
                                    .rocks = a->rocks > 0 ? a->rocks : CEDUO_DOUBT_ROCKS,
                                    .rotation = years,
                                    .window = a->window,
                                    .threads = (unsigned)a->threads,
                                    .cancel = ceduo_interrupt_flag(),
                                    .progress = show_steps,
                                    .context = &c->progress};
    return good;
}

enum ceduo_status ceduo_ask_doubt(struct asked *c, const struct arguments *a, struct scene_file *file)
{
    struct ceduo_doubt_def def;
    if (!begin_doubt(c, a, file, a->years, &def))
        return CEDUO_NO_MEMORY;
    def.own_rocks = a->rocks > 0 ? a->rocks : file->scene.simulation.rocks;
    return ask_doubt(c, file, &def, NULL);
}

enum ceduo_status ceduo_ask_doubt_beside(struct asked *c, const struct arguments *a, struct scene_file *file)
{
    const struct ceduo_result *result = c->answer.result;
    uint64_t rocks = ceduo_result_rocks(result);
    struct ceduo_doubt_def def;
    enum ceduo_status status = CEDUO_OK;
    bool rotation = c->answer.years && !ceduo_uncertainty_no_rotation(&file->scene);
    if (!begin_doubt(c, a, file, rotation, &def))
        return CEDUO_NO_MEMORY;
    def.brief = true;
    def.own = &c->answer;
    def.rocks = rocks < CEDUO_DOUBT_ROCKS ? rocks : CEDUO_DOUBT_ROCKS;
    def.points_max = def.points;
    if (rocks < 2 || !result->wooded || ceduo_page_says_nothing(result))
        def.points = 0;
    else if (def.inputs_count > 0 && !ceduo_arguments_given(a, "sensitivity"))
        status = ceduo_effort_bound(&def, &c->answer.work);
    bool too_much = def.points == 0 && def.effort_max > 0;
    if (status == CEDUO_OK)
        status = ask_doubt(c, file, &def, result);
    c->doubt.too_much |= too_much;
    return status;
}
