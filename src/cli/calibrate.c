/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --calibrate: values of one or several scenes, fitted to what was seen there. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/must.h"
#include "batch.h"
#include "interrupt.h"
#include "io/doubt_inputs.h"
#include "io/file.h"
#include "model/keep_fit.h"
#include "output.h"
#include "say.h"
#include "view/figures.h"

#define MOST CEDUO_CALIBRATION_MOST

/* All scenes, and the fitted values in each. */
struct job {
    const struct arguments *arguments;
    size_t scenes_count, parameters_count;
    struct scene_file *files;
    struct ceduo_calibration_scene *scenes;
    struct ceduo_input *inputs; /* [scene][parameter] */
    const char *paths[MOST];
    const struct field *fields[MOST];
    double lo[MOST], hi[MOST];
    struct progress progress;
};

/* ---- the values ---- */

static enum exit_status check_range(const struct job *j, size_t i)
{
    LOCAL_TEXT(range);
    double bad = !ceduo_schema_in_range(j->fields[i], j->lo[i]) ? j->lo[i] : j->hi[i];
    if (ceduo_schema_in_range(j->fields[i], bad))
        return EXIT_DONE;
    ceduo_schema_range_text(j->fields[i], &range);
    return ceduo_usage("calibrate", _("%s is outside the range of %s: %s"), SHORTEST(bad), j->paths[i],
                       ceduo_text_string(&range));
}

/* mu acts through the shape of the rock, in one law. */
static enum exit_status check_mu(const struct job *j, size_t i)
{
    size_t arms = 0;
    if (strcmp(j->fields[i]->key, "mu") != 0)
        return EXIT_DONE;
    for (size_t s = 0; s < j->scenes_count; s++)
        arms += j->files[s].scene.simulation.law == CEDUO_LAW_ARM;
    if (arms == 0)
        return ceduo_usage("calibrate", _("'%s' has no part in this law; only arm knows it"), j->paths[i]);
    if (!ceduo_calibration_tells_mu(j->scenes, j->scenes_count))
        return ceduo_usage("calibrate",
                           _("'%s' cannot be told from rocks of one shape; observe rocks of two, or leave it as it is"),
                           j->paths[i]);
    return EXIT_DONE;
}

/* PATH=LO:HI, which the options have checked; its places in every scene. */
static enum exit_status find_value(struct job *j, size_t i)
{
    const char *given = j->arguments->calibrates.items[i], *equals = strrchr(given, '=');
    size_t places = 0;
    char *path = ceduo_must(strndup(given, (size_t)(equals - given)));
    j->paths[i] = path;
    char *end;
    j->lo[i] = strtod(equals + 1, &end);
    j->hi[i] = strtod(end + 1, NULL);
    for (size_t s = 0; s < j->scenes_count; s++) {
        struct ceduo_input *input = &j->inputs[s * j->parameters_count + i];
        const struct field *field = ceduo_input_find(&j->files[s], path, input);
        if (!field)
            return ceduo_usage(
                "calibrate", _("'%s' is not a number of a scene that can be fitted; ceduo --list-parameters shows all"), path);
        j->fields[i] = field;
        input->lo = j->lo[i];
        input->hi = j->hi[i];
        places += input->places_count;
        for (size_t k = 0; k < i; k++)
            if (ceduo_input_shares(input, &j->inputs[s * j->parameters_count + k]))
                return ceduo_usage("calibrate", _("'%s' and '%s' are the same value"), j->paths[k], path);
    }
    if (places == 0)
        return ceduo_usage("calibrate", _("no scene has a value '%s'"), path);
    enum exit_status status = check_range(j, i);
    return status == EXIT_DONE ? check_mu(j, i) : status;
}

/* Something must have been seen. */
static enum exit_status check_seen(const struct job *j)
{
    for (size_t s = 0; s < j->scenes_count; s++)
        for (size_t i = 0; i < j->scenes[s].observations_count; i++)
            if (j->scenes[s].observations[i].use == CEDUO_OBSERVED_FIT)
                return EXIT_DONE;
    return ceduo_usage("calibrate", _("no scene says what was seen there, to be fitted; write it under 'observed' "
                                      "(man ceduo-scene)"));
}

static enum exit_status open_job(struct job *j)
{
    const struct arguments *a = j->arguments;
    enum exit_status status = EXIT_DONE;
    j->scenes_count = a->scenes_count;
    j->parameters_count = a->calibrates.n;
    j->files = ceduo_must(calloc(j->scenes_count, sizeof *j->files));
    j->scenes = ceduo_must(calloc(j->scenes_count, sizeof *j->scenes));
    j->inputs = ceduo_must(calloc(j->scenes_count * j->parameters_count, sizeof *j->inputs));
    for (size_t s = 0; s < j->scenes_count; s++) {
        enum exit_status read = ceduo_batch_read(a, a->scenes[s], &j->files[s]);
        status = read > status ? read : status;
        j->scenes[s] = (struct ceduo_calibration_scene){.scene = &j->files[s].scene,
                                                        .inputs = j->inputs + s * j->parameters_count,
                                                        .observations_count = j->files[s].observations_count,
                                                        .observations = j->files[s].observations};
    }
    for (size_t i = 0; i < j->parameters_count && status == EXIT_DONE; i++)
        status = find_value(j, i);
    return status == EXIT_DONE ? check_seen(j) : status;
}

static void close_job(struct job *j)
{
    for (size_t s = 0; s < j->scenes_count; s++)
        ceduo_scene_release(&j->files[s]);
    for (size_t i = 0; i < j->parameters_count; i++)
        free((char *)(uintptr_t)j->paths[i]);
    free(j->files);
    free(j->scenes);
    free(j->inputs);
}

/* ---- computing ---- */

static void show(void *context, const struct ceduo_calibration_state *state)
{
    double seconds;
    if (!ceduo_progress_due(context, &seconds))
        return;
    if (state->stage == CEDUO_CHAINS && isfinite(state->rhat))
        ceduo_say_progress(_("%llu scenes; R-hat %.3f (1.05), effective size %.0f (200); %.0f s"),
                           (unsigned long long)state->evaluations, state->rhat, state->effective_size, seconds);
    else
        ceduo_say_progress(_("%llu scenes; log-likelihood %.2f; %.0f s"), (unsigned long long)state->evaluations,
                           state->log_likelihood, seconds);
}

static void print(const struct job *j, const struct ceduo_calibration_report *report, struct text *out)
{
    const struct ceduo_place place = {.calibration = report};
    if (j->arguments->format == CEDUO_JSON) {
        ceduo_figures_json(out, ceduo_calibration_figures, &place, false);
    } else if (j->arguments->format == CEDUO_CSV) {
        ceduo_csv_head(out, &ceduo_calibration_csv);
        ceduo_csv_rows(out, &ceduo_calibration_csv, &place);
    } else {
        ceduo_calibration_page(out, report, !ceduo_say_utf8());
    }
}

/* ---- writing the scene ---- */

static bool writes_scene(const struct arguments *a)
{
    const char *dot = a->output ? strrchr(a->output, '.') : NULL;
    return dot && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0);
}

/* The heads of the table of draws: the places of each value in the first scene. */
static void append_draws(const struct job *j, const struct ceduo_calibration *answer, struct text *out)
{
    struct text heads[MOST] = {{0}};
    const char *names[MOST];
    for (size_t i = 0; i < j->parameters_count; i++) {
        for (size_t k = 0; k < j->inputs[i].places_count; k++)
            ceduo_text_format(&heads[i], "%s%s", k > 0 ? " " : "", j->inputs[i].places[k]);
        names[i] = heads[i].length > 0 ? ceduo_text_string(&heads[i]) : j->paths[i];
    }
    ceduo_calibration_draws(out, answer, names);
    for (size_t i = 0; i < j->parameters_count; i++)
        ceduo_text_free(&heads[i]);
}

static bool edit_scene(const struct job *j, const struct ceduo_calibration_report *r, const char *draws,
                       struct document *document, struct problems *problems)
{
    const struct arguments *a = j->arguments;
    LOCAL_TEXT(source);
    double best[MOST];
    ceduo_calibration_sources(&source, r);
    for (size_t i = 0; i < j->parameters_count; i++)
        best[i] = r->answer->parameters[i].best;
    const struct fit_values fit = {j->parameters_count, j->inputs, j->fields, best, ceduo_text_string(&source), draws};
    bool good = ceduo_document_open(document, a->scenes[0], problems);
    free(document->recovery); /* what the terminal program keeps of the scene is not ours */
    document->recovery = NULL;
    good = good &&
           (a->sets.n == 0 || ceduo_document_set_all(document, (const char *const *)a->sets.items, a->sets.n, "", problems));
    good = good && ceduo_keep_fit(document, &fit, problems);
    return good;
}

/* The scene is made while the table lies under a name of its own, and is to name it as it will be called. */
static void name_draws(struct text *scene, const struct pending_file *draws)
{
    const char *mark = draws->temporary + strlen(draws->target);
    char *at = strstr(scene->bytes, mark);
    if (at) {
        scene->length -= strlen(mark);
        memmove(at, at + strlen(mark), strlen(at + strlen(mark)) + 1);
    }
}

static bool prepare(struct pending_file *file, const char *path, const struct text *text)
{
    *file =
        (struct pending_file){.path = path, .before = -1, .bytes = ceduo_text_string(text), .n = text->length, .wait = true};
    bool good = ceduo_file_prepare(file);
    if (!good)
        ceduo_say_why(path, strerror(errno));
    return good;
}

static bool place(struct pending_file *file)
{
    bool good = ceduo_file_place(file);
    if (!good)
        ceduo_say_why(file->path, strerror(errno));
    return good;
}

static enum exit_status place_both(const struct job *j, const struct ceduo_calibration_report *r, struct pending_file *draws,
                                   struct pending_file *file)
{
    const char *output = j->arguments->output;
    struct document document = {0};
    struct problems problems = {0};
    LOCAL_TEXT(scene);
    enum exit_status status = EXIT_OUTPUT;
    if (!edit_scene(j, r, draws->temporary, &document, &problems)) {
        ceduo_problems_close(&problems);
        ceduo_say(&problems.text);
        status = EXIT_RUN;
    } else {
        ceduo_document_text(&document, output, &scene);
        name_draws(&scene, draws);
        draws->wait = false; /* for their folder: the scene waits for it, and nothing comes between the two */
        if (prepare(file, output, &scene) && place(draws) && place(file))
            status = EXIT_DONE;
    }
    ceduo_document_close(&document);
    ceduo_problems_free(&problems);
    return status;
}

/* The first scene with the best values, and the draws beside it. Both are filled before either takes its place: a full disk
 * must not leave the draws of this fit beside the scene of another. */
static enum exit_status write_scene(const struct job *j, const struct ceduo_calibration_report *r)
{
    const char *output = j->arguments->output;
    LOCAL_TEXT(path);
    LOCAL_TEXT(draws);
    struct pending_file beside = {0}, file = {0};
    enum exit_status status = EXIT_OUTPUT;
    ceduo_text_format(&path, "%.*s.draws.csv", (int)(strrchr(output, '.') - output), output);
    append_draws(j, r->answer, &draws);
    if (prepare(&beside, ceduo_text_string(&path), &draws)) {
        if (!beside.target) /* a device, a pipe */
            ceduo_say_why(beside.path, strerror(EINVAL));
        else if (strncmp(beside.temporary, beside.target, strlen(beside.target)) != 0) /* of a long name only a part */
            ceduo_say_why(beside.path, strerror(ENAMETOOLONG));
        else
            status = place_both(j, r, &beside, &file);
    }
    ceduo_file_drop(&beside);
    ceduo_file_drop(&file);
    return status;
}

static enum exit_status print_answer(const struct job *j, const struct text *out)
{
    struct arguments plain = *j->arguments;
    if (writes_scene(&plain))
        plain.output = NULL;
    return ceduo_output_write(&plain, out);
}

static enum exit_status compute(struct job *j)
{
    const struct arguments *a = j->arguments;
    struct ceduo_calibration answer;
    LOCAL_TEXT(out);
    j->progress = ceduo_progress_begin(a);
    struct ceduo_calibration_def def = {.scenes_count = j->scenes_count,
                                        .scenes = j->scenes,
                                        .parameters_count = j->parameters_count,
                                        .rocks = a->rocks > 0 ? a->rocks : CEDUO_CALIBRATION_ROCKS,
                                        .seed = j->files[0].scene.simulation.seed,
                                        .threads = a->threads,
                                        .cancel = ceduo_interrupt_flag(),
                                        .progress = show,
                                        .context = &j->progress};
    enum ceduo_status status = ceduo_calibrate(&def, &answer);
    if (status != CEDUO_OK)
        return ceduo_batch_failed(&j->files[0], status);
    struct ceduo_calibration_report report = {.scenes_count = j->scenes_count,
                                              .files = j->files,
                                              .paths = j->paths,
                                              .fields = j->fields,
                                              .rocks = def.rocks,
                                              .seed = def.seed,
                                              .answer = &answer};
    print(j, &report, &out);
    ceduo_say_plainly(&out);
    bool ended = atomic_load(ceduo_interrupt_flag()); /* from here on all is written */
    enum exit_status written = ended ? EXIT_RUN : print_answer(j, &out);
    if (written == EXIT_DONE && writes_scene(a))
        written = write_scene(j, &report);
    ceduo_calibration_free(&answer);
    return written;
}

enum exit_status ceduo_batch_calibrate(const struct arguments *a)
{
    struct job j = {.arguments = a};
    enum exit_status status = open_job(&j);
    if (status == EXIT_DONE) {
        ceduo_interrupt_catch();
        status = compute(&j);
    }
    close_job(&j);
    ceduo_interrupt_release();
    return status;
}
