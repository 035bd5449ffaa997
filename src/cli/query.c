/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads one scene, simulates it, and computes its pictures and its uncertainty, with progress. */
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/hash.h"
#include "base/language.h"
#include "batch.h"
#include "core/runs/result.h"
#include "messages.h"
#include "model/jobs.h"
#include "study/effort.h"
#include "view/words.h"

/* ---- reading ---- */

enum exit_status ceduo_find_option(const struct scene_file *file, const char *name, size_t *index)
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
    ceduo_print_message("ceduo", ceduo_text_string(&message));
    return EXIT_USAGE;
}

/* Keep only the options of --option, in the order of the scene. */
static enum exit_status keep_options(const struct arguments *a, struct scene_file *file)
{
    bool *wanted = ceduo_arena_alloc(&file->arena, file->scene.options_count * sizeof *wanted);
    for (size_t i = 0, index; i < a->options.n; i++) {
        if (ceduo_find_option(file, a->options.items[i], &index) != EXIT_DONE)
            return EXIT_USAGE;
        wanted[index] = true;
    }
    const struct node *list = ceduo_node_get(file->root, "options");
    if (a->options.n == 0 || !list)
        return EXIT_DONE;
    size_t *kept = ceduo_arena_alloc(&file->arena, list->n * sizeof *kept);
    for (size_t k = 0; kept && k < list->n; k++)
        if (wanted[k])
            kept[file->kept_count++] = k;
    file->kept = kept;
    for (size_t k = list->n; list && k-- > 0;)
        if (!wanted[k])
            list = ceduo_node_removed(&file->arena, list, k);
    const struct node *root = list ? ceduo_node_with(&file->arena, file->root, "options", list) : NULL;
    if (root && ceduo_node_get(root, "observed")) /* observations may refer to a removed option */
        root = ceduo_node_without(&file->arena, root, "observed");
    LOCAL_PROBLEMS(problems);
    file->root = root;
    return root && ceduo_scene_bind(file, &problems) ? EXIT_DONE : EXIT_RUN;
}

/* Print warnings unless they equal the last printed: each row of --each repeats those about the file. */
static void warn_once(struct text *text)
{
    static uint64_t last;
    uint64_t hash = hash_bytes(ceduo_text_string(text), text->length);
    if (text->length == 0 || hash == last)
        return;
    last = hash;
    ceduo_print_error(text);
}

enum exit_status ceduo_batch_read(const struct arguments *a, const char *path, struct scene_file *file)
{
    LOCAL_PROBLEMS(problems);
    struct scene_sets sets = {a->sets.items, a->sets.n, a->cells, a->called};
    bool good = ceduo_scene_load_row(file, path, &sets, &problems);
    const struct problem *first = problems.wrong.items;
    ceduo_problems_print(&problems);
    if (!good && problems.wrong.n > 0 && a->called && strncmp(first->place, a->called, strlen(a->called)) != 0)
        ceduo_print_message(a->called, _("this scene cannot be computed:")); /* the next line names another file, or a change */
    if (good)
        warn_once(&problems.text);
    else
        ceduo_print_error(&problems.text);
    enum exit_status status = good ? EXIT_DONE : problems.usage && !problems.cell ? EXIT_USAGE : EXIT_INPUT;
    for (const struct source *s = file->arena.sources; s && status != EXIT_OUTPUT; s = s->before)
        if (ceduo_output_is(a->output, s->path))
            status = EXIT_OUTPUT;
    return status == EXIT_DONE && a->mode != MODE_FIND && a->mode != MODE_CALIBRATE ? keep_options(a, file) : status;
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

static void show_rock_count(void *progress, uint64_t rocks)
{
    double seconds;
    if (ceduo_progress_due(progress, &seconds))
        ceduo_show_progress(_("%llu rocks, %.0f s"), (unsigned long long)rocks, seconds);
}

static void show_steps(void *progress, uint64_t done, uint64_t all)
{
    double seconds;
    if (ceduo_progress_due(progress, &seconds))
        ceduo_show_progress(_("%llu of %llu, %.0f s"), (unsigned long long)done, (unsigned long long)all, seconds);
}

void ceduo_progress_scenes(struct progress *p, size_t computed, size_t done, size_t all)
{
    double seconds;
    if (computed == 0 || !ceduo_progress_due(p, &seconds))
        return;
    double remaining = seconds / (double)computed * (double)(all - done);
    LOCAL_TEXT(time);
    ceduo_text_format(&time, remaining < 120 ? "%.0f s" : "%.0f min", remaining < 120 ? remaining : remaining / 60);
    ceduo_show_progress(_("%zu of %zu scenes, %s left"), done, all, ceduo_text_string(&time));
}

/* ---- warnings ---- */

#define CHECK_ROCKS 1000

/* Warnings about a scene, or a row of --each; each is printed once. */
struct warnings {
    const char *name;
    struct text printed;
};

static void warn(void *context, const char *sentence)
{
    struct warnings *warnings = context;
    if (strstr(ceduo_text_string(&warnings->printed), sentence))
        return;
    ceduo_print_message(warnings->name, sentence);
    ceduo_text_format(&warnings->printed, "%s\n", sentence);
}

/* Warn of stands that no forest has. */
static void warn_stands(const struct ceduo_result *result, struct warnings *warnings)
{
    for (size_t i = 0; i < result->options_count; i++)
        for (size_t k = 0; k < result->scene->options[i].belts_count; k++)
            ceduo_words_implausible(&result->scene->options[i].belts[k], &result->options[i].stands[k], warn, warnings);
}

void ceduo_batch_warn(const struct arguments *a, const struct scene_file *file, bool stands)
{
    struct warnings warnings = {.name = a->called ? a->called : file->path};
    struct ceduo_scene bare = file->scene;
    bare.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX; /* simulates the bare slope only */
    struct ceduo_request request = ceduo_request_default(&bare);
    struct ceduo_results results;
    request.rocks = bare.simulation.rocks < CHECK_ROCKS ? bare.simulation.rocks : CHECK_ROCKS;
    request.run.rocks_max = request.rocks;
    request.run.threads = (unsigned)a->threads;
    request.run.cancel = ceduo_interrupt_flag();
    if (ceduo_simulate_request(&request, NULL, &results) == CEDUO_OK) {
        ceduo_words_warn_no_answer(results.result, warn, &warnings);
        if (stands)
            warn_stands(results.result, &warnings);
    }
    ceduo_results_release(&results);
    ceduo_text_free(&warnings.printed);
}

enum exit_status ceduo_batch_failed(const struct scene_file *file, enum ceduo_status status)
{
    if (status != CEDUO_CANCELLED)
        ceduo_print_message(file->path, status == CEDUO_NO_MEMORY ? _("out of memory") : _("cannot be computed"));
    return EXIT_RUN;
}

/* ---- runs ---- */

void ceduo_query_begin(struct query *q, const struct arguments *a, const struct scene_file *file)
{
    *q = (struct query){.progress = ceduo_progress_begin(a), .request = ceduo_request_default(&file->scene)};
    struct ceduo_request *request = &q->request;
    request->rocks = a->rocks > 0 ? a->rocks : a->tolerance > 0 ? CEDUO_ROCKS_MAX : file->scene.simulation.rocks;
    request->run.rocks_max = request->rocks;
    request->tolerance = a->tolerance;
    request->run.threads = (unsigned)a->threads;
    request->run.alternative_energy = true;
    request->run.cancel = ceduo_interrupt_flag();
    request->run.progress = show_rock_count;
    request->run.context = &q->progress;
    request->years = a->years;
    request->window = a->window;
}

enum ceduo_status ceduo_query_run(struct query *q)
{
    struct ceduo_pool *pool = NULL; /* for the pictures */
    enum ceduo_status status = ceduo_simulate_request(&q->request, q->pictures ? &pool : NULL, &q->results);
    q->seconds = ceduo_clock() - q->progress.start;
    const struct ceduo_snapshot_def def = {.scene = q->request.run.scene,
                                           .runs = pool,
                                           .envelope_rocks = q->envelopes ? CEDUO_ENVELOPE_ROCKS : 0,
                                           .trajectories = q->trajectories,
                                           .cancel = q->request.run.cancel};
    if (status == CEDUO_OK && q->pictures)
        status = ceduo_snapshot_create(&def, &q->snapshot);
    ceduo_pool_free(pool);
    return status == CEDUO_OK ? ceduo_compare_options(q->results.result, q->results.years, q->results.rotations, &q->verdict)
                              : status;
}

enum exit_status ceduo_query_end(struct query *q, const struct scene_file *file, enum ceduo_status status)
{
    const struct ceduo_result *r = q->results.result;
    bool finished = !r || ceduo_result_unfinished(r) * 1000 <= ceduo_result_rocks(r);
    if (q->uncertainty.answer)
        ceduo_uncertainty_release(&q->uncertainty_answer);
    ceduo_verdict_release(&q->verdict);
    ceduo_snapshot_free(q->snapshot);
    ceduo_results_release(&q->results);
    return status != CEDUO_OK ? ceduo_batch_failed(file, status) : finished ? EXIT_DONE : EXIT_RUN;
}

/* ---- uncertainty ---- */

/* Compute the uncertainty with the points and rocks of `def`. `finer`: result of the unchanged scene with more rocks; may be
 * NULL. */
static enum ceduo_status ask_uncertainty(struct query *q, struct scene_file *file, const struct ceduo_uncertainty_def *def,
                                         const struct ceduo_result *finer)
{
    q->uncertainty = (struct ceduo_uncertainty_report){
        .file = file, .inputs = &q->inputs, .points = def->points, .rocks = def->rocks, .finer = finer};
    if (def->inputs_count == 0 || def->points == 0)
        return CEDUO_OK;
    enum ceduo_status status = ceduo_uncertainty_compute(def, &q->uncertainty_answer);
    q->uncertainty.answer = status == CEDUO_OK ? &q->uncertainty_answer : NULL;
    q->uncertainty.too_much = status == CEDUO_CANCELLED && !atomic_load(ceduo_interrupt_flag());
    return q->uncertainty.too_much ? CEDUO_OK : status;
}

/* Set the inputs, and the options of the command line. `years`: compute the years of the window, too. False on failure. */
static bool init_uncertainty(struct query *q, const struct arguments *a, struct scene_file *file, bool years,
                             struct ceduo_uncertainty_def *def)
{
    bool good = ceduo_inputs_collect(file, &q->inputs);
    if (!years)
        ceduo_inputs_keep_today(&q->inputs);
    *def = (struct ceduo_uncertainty_def){.size = sizeof(struct ceduo_uncertainty_def),
                                          .scene = &file->scene,
                                          .inputs_count = q->inputs.n,
                                          .inputs = q->inputs.items,
                                          .points = (size_t)a->points,
                                          .rocks = a->rocks > 0 ? a->rocks : CEDUO_UNCERTAINTY_ROCKS,
                                          .rotation = years,
                                          .window = a->window,
                                          .threads = (unsigned)a->threads,
                                          .cancel = ceduo_interrupt_flag(),
                                          .progress = show_steps,
                                          .context = &q->progress};
    return good;
}

enum ceduo_status ceduo_query_uncertainty(struct query *q, const struct arguments *a, struct scene_file *file)
{
    struct ceduo_uncertainty_def def;
    if (!init_uncertainty(q, a, file, a->years, &def))
        return CEDUO_NO_MEMORY;
    def.own_rocks = a->rocks > 0 ? a->rocks : file->scene.simulation.rocks;
    return ask_uncertainty(q, file, &def, NULL);
}

enum ceduo_status ceduo_query_add_uncertainty(struct query *q, const struct arguments *a, struct scene_file *file)
{
    const struct ceduo_result *result = q->results.result;
    uint64_t rocks = ceduo_result_rocks(result);
    struct ceduo_uncertainty_def def;
    enum ceduo_status status = CEDUO_OK;
    bool rotation = q->results.years && !ceduo_uncertainty_no_rotation(&file->scene);
    if (!init_uncertainty(q, a, file, rotation, &def))
        return CEDUO_NO_MEMORY;
    def.brief = true;
    def.own = &q->results;
    def.rocks = rocks < CEDUO_UNCERTAINTY_ROCKS ? rocks : CEDUO_UNCERTAINTY_ROCKS;
    def.points_max = def.points;
    if (rocks < 2 || !result->wooded || ceduo_page_is_unassessable(result))
        def.points = 0;
    else if (def.inputs_count > 0 && !ceduo_arguments_given(a, "sensitivity"))
        status = ceduo_effort_bound(&def, &q->results.work);
    bool too_much = def.points == 0 && def.effort_max > 0;
    if (status == CEDUO_OK)
        status = ask_uncertainty(q, file, &def, result);
    q->uncertainty.too_much |= too_much;
    return status;
}
