/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --calibrate: fits values of one or several scenes to their observations. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/language.h"
#include "base/oom.h"
#include "batch.h"
#include "io/file.h"
#include "messages.h"
#include "model/fit.h"
#include "study/predict.h"
#include "view/figures.h"

#define NO_VALUE _("'%s' is not a number of these scenes and cannot be fitted; see ceduo --list-parameters")

/* All scenes, and the places of the fitted values in each. */
struct fit_job {
    const struct arguments *arguments;
    size_t scenes_count, parameters_count;
    struct scene_file *files;
    struct ceduo_calibration_scene *scenes;
    struct ceduo_input *inputs; /* [scene][parameter] */
};

/* ---- the values ---- */

/* Find the places of a fitted value in all scenes. */
static enum exit_status find_parameter(struct fit_job *j, size_t i)
{
    const struct path_range *range_given = &j->arguments->calibrates[i];
    const char *path = range_given->path;
    const struct field *field = NULL;
    size_t places = 0, arms = 0;
    for (size_t s = 0; s < j->scenes_count; s++) {
        struct ceduo_input *input = &j->inputs[s * j->parameters_count + i];
        field = ceduo_input_find(&j->files[s], path, input);
        const char *removed = ceduo_removed_hint(path);
        if (removed)
            return ceduo_usage_error("calibrate", "'%s': %s", path, _(removed));
        if (!field)
            return ceduo_usage_error("calibrate", NO_VALUE, path);
        input->lo = range_given->lo;
        input->hi = range_given->hi;
        places += input->places_count;
        arms += j->files[s].scene.simulation.law == CEDUO_LAW_ARM;
        for (size_t k = 0; k < i; k++)
            if (ceduo_input_overlaps(input, &j->inputs[s * j->parameters_count + k]))
                return ceduo_usage_error("calibrate", _("'%s' and '%s' are the same value"), j->inputs[k].path, path);
    }
    if (places == 0)
        return ceduo_usage_error("calibrate", NO_VALUE, path);
    double bad = !ceduo_schema_in_range(field, range_given->lo) ? range_given->lo : range_given->hi;
    if (!ceduo_schema_in_range(field, bad)) {
        LOCAL_TEXT(range);
        ceduo_schema_range_text(field, &range);
        return ceduo_usage_error("calibrate", _("%s is outside the range of %s: %s"), LOCALIZED(bad), path,
                                 ceduo_text_string(&range));
    }
    bool mu = strcmp(field->key, "mu") == 0; /* depends on the shape of the rock; only the law arm uses it */
    if (mu && arms == 0)
        return ceduo_usage_error("calibrate", _("'%s' has no effect in this law; only arm uses it"), path);
    if (mu && !ceduo_calibration_identifies_mu(j->scenes, j->scenes_count))
        return ceduo_usage_error(
            "calibrate", _("'%s' cannot be identified from rocks of one shape; observe two shapes, or do not fit it"), path);
    return EXIT_DONE;
}

/* ---- files to write ---- */

static bool writes_scene(const struct arguments *a)
{
    const char *dot = a->output ? strrchr(a->output, '.') : NULL;
    return dot && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0);
}

/* Append the path of the draws, FILE.draws.csv for FILE.yaml. */
static void append_draws_path(struct text *path, const struct arguments *a)
{
    ceduo_text_format(path, "%.*s.draws.csv", (int)(strrchr(a->output, '.') - a->output), a->output);
}

/* Write the temporary file of the draws. The scene names the draws before they are renamed, so the temporary name must begin with
 * the final one. Return false with errno set. */
static bool prepare_draws(struct pending_file *draws)
{
    if (!ceduo_file_prepare(draws))
        return false;
    bool device = !draws->target; /* or a pipe */
    errno = device ? EINVAL : ENAMETOOLONG;
    return !device && strncmp(draws->temporary, draws->target, strlen(draws->target)) == 0;
}

/* True if prepare_draws() is expected to succeed; otherwise set errno. Creates no file. */
static bool can_write_draws(const char *path)
{
    struct stat st;
    bool device = stat(path, &st) == 0 && !S_ISREG(st.st_mode);
    if (!ceduo_file_can_write(path))
        return false;
    errno = device ? EINVAL : ENAMETOOLONG;
    return !device && strlen(ceduo_file_name(path)) <= CEDUO_FILE_NAME_MAX;
}

/* Check before the fit that the first scene and the draws can be written, and that the run does not read the file of the draws. */
static enum exit_status check_scene(const struct fit_job *j)
{
    LOCAL_TEXT(path);
    LOCAL_TEXT(reason);
    append_draws_path(&path, j->arguments);
    for (size_t s = 0; s < j->scenes_count; s++)
        for (const struct source *source = j->files[s].arena.sources; source; source = source->before)
            if (ceduo_output_is(path.bytes, source->path))
                return EXIT_OUTPUT;
    if (!ceduo_fit_can_apply(&j->files[0], j->inputs, j->parameters_count, &reason))
        return ceduo_usage_error("output", "%s", reason.bytes);
    if (can_write_draws(path.bytes))
        return EXIT_DONE;
    ceduo_print_message(path.bytes, ceduo_error_text(errno));
    return EXIT_OUTPUT;
}

/* ---- reading ---- */

static enum exit_status open_job(struct fit_job *j)
{
    const struct arguments *a = j->arguments;
    enum exit_status status = EXIT_DONE;
    bool observed = false; /* at least one observation is to be fitted */
    for (size_t s = 0; s < j->scenes_count; s++) {
        enum exit_status read = ceduo_batch_read(a, a->scenes[s], &j->files[s]);
        status = read > status ? read : status;
        observed |= ceduo_fit_has_observations(&j->files[s]);
        j->scenes[s] = (struct ceduo_calibration_scene){.scene = &j->files[s].scene,
                                                        .inputs = j->inputs + s * j->parameters_count,
                                                        .observations_count = j->files[s].observations_count,
                                                        .observations = j->files[s].observations};
    }
    for (size_t i = 0; i < j->parameters_count && status == EXIT_DONE; i++)
        status = find_parameter(j, i);
    if (status == EXIT_DONE && !observed)
        return ceduo_usage_error("calibrate",
                                 _("no scene has observations to fit; add them under 'observed' (man ceduo-scene)"));
    return status == EXIT_DONE && writes_scene(a) ? check_scene(j) : status;
}

/* ---- writing the scene ---- */

/* Print the first scene with the best values. The draws still have a temporary name; the scene names their final file. */
static bool print_scene(const struct fit_job *j, const struct ceduo_calibration_report *r, const struct pending_file *draws,
                        struct text *scene)
{
    const struct arguments *a = j->arguments;
    struct document document = {0};
    LOCAL_TEXT(source);
    ceduo_calibration_sources(&source, r);
    const struct fit_values fit = {r->answer, r->inputs, ceduo_text_string(&source), draws->temporary};
    bool good = ceduo_document_open(&document, a->scenes[0], (const char *const *)a->sets.items, a->sets.n);
    ceduo_recovery_end(&document.recovery); /* no recovery copy in batch runs */
    good = good && ceduo_apply_fit(&document, &fit);
    if (good) {
        const char *mark = draws->temporary + strlen(draws->target);
        ceduo_document_append_yaml(&document, a->output, scene);
        char *found = strstr(scene->bytes, mark);
        if (found) {
            scene->length -= strlen(mark);
            memmove(found, found + strlen(mark), strlen(found + strlen(mark)) + 1);
        }
    }
    ceduo_print_problems(&document.problems);
    ceduo_document_close(&document);
    return good;
}

/* Write the first scene with the best values, and the draws next to it. Rename both files only when both are written: a full
 * disk must not leave draws of this fit with the scene of another. */
static enum exit_status write_scene(const struct fit_job *j, const struct ceduo_calibration_report *r)
{
    const char *output = j->arguments->output;
    LOCAL_TEXT(path);
    LOCAL_TEXT(table);
    LOCAL_TEXT(scene);
    append_draws_path(&path, j->arguments);
    ceduo_calibration_draws(&table, r);
    struct pending_file draws = {.path = path.bytes, .bytes = table.bytes, .n = table.length, .wait = true};
    struct pending_file file = {.path = output, .wait = true};
    enum exit_status status = EXIT_OUTPUT;
    const char *failed = path.bytes; /* file with an error in errno; NULL: already reported, or no error */
    bool filled = prepare_draws(&draws);
    if (filled && !print_scene(j, r, &draws, &scene)) {
        failed = NULL;
        status = EXIT_RUN;
    } else if (filled) {
        file.bytes = scene.bytes;
        file.n = scene.length;
        draws.wait = false; /* the scene waits for the disk, right after */
        if (!ceduo_file_prepare(&file)) {
            failed = output;
        } else if (ceduo_file_commit(&draws)) {
            failed = ceduo_file_commit(&file) ? NULL : output;
            status = failed ? EXIT_OUTPUT : EXIT_DONE;
        }
    }
    if (failed)
        ceduo_print_message(failed, ceduo_error_text(errno));
    ceduo_file_abort(&draws);
    ceduo_file_abort(&file);
    return status;
}

/* ---- computing ---- */

static void show(void *context, const struct ceduo_calibration_state *state)
{
    double seconds;
    if (!ceduo_progress_due(context, &seconds))
        return;
    if (state->stage == CEDUO_CALIBRATION_STAGE_CHAINS && isfinite(state->rhat))
        ceduo_show_progress(_("%llu scenes; R-hat %.3f (1.05), effective size %.0f (200); %.0f s"),
                            (unsigned long long)state->evaluations, state->rhat, state->effective_size, seconds);
    else
        ceduo_show_progress(_("%llu scenes; log-likelihood %.2f; %.0f s"), (unsigned long long)state->evaluations,
                            state->log_likelihood, seconds);
}

static enum exit_status compute(struct fit_job *j)
{
    struct arguments print = *j->arguments; /* the answer goes to standard output if --output is the scene */
    struct ceduo_calibration answer;
    LOCAL_TEXT(out);
    struct progress progress = ceduo_progress_begin(&print);
    struct ceduo_calibration_def def = {.size = sizeof def,
                                        .scenes_count = j->scenes_count,
                                        .scenes = j->scenes,
                                        .parameters_count = j->parameters_count,
                                        .rocks = print.rocks > 0 ? print.rocks : CEDUO_CALIBRATION_ROCKS,
                                        .seed = j->files[0].scene.simulation.seed,
                                        .threads = (unsigned)print.threads,
                                        .cancel = ceduo_interrupt_flag(),
                                        .progress = show,
                                        .context = &progress};
    enum ceduo_status status = ceduo_calibrate(&def, &answer);
    if (status != CEDUO_OK)
        return ceduo_batch_failed(&j->files[0], status);
    struct ceduo_calibration_report report = {
        .scenes_count = j->scenes_count, .files = j->files, .inputs = j->inputs, .rocks = def.rocks, .answer = &answer};
    const struct ceduo_place place = {.calibration = &report};
    if (print.format == CEDUO_JSON) {
        ceduo_figures_json(&out, ceduo_calibration_figures, &place, false);
    } else if (print.format == CEDUO_CSV) {
        ceduo_csv_head(&out, &ceduo_calibration_csv);
        ceduo_csv_rows(&out, &ceduo_calibration_csv, &place);
    } else {
        ceduo_calibration_page(&out, &report, !ceduo_is_utf8());
    }
    ceduo_fit_charset(&out);
    bool scene = writes_scene(&print), ended = atomic_load(ceduo_interrupt_flag()); /* later signals do not prevent writing */
    print.output = scene ? NULL : print.output;
    enum exit_status written = ended ? EXIT_RUN : ceduo_output_write(&print, &out);
    if (written == EXIT_DONE && scene)
        written = write_scene(j, &report);
    ceduo_calibration_release(&answer);
    return written;
}

enum exit_status ceduo_batch_calibrate(const struct arguments *a)
{
    struct fit_job j = {.arguments = a, .scenes_count = a->scenes_count, .parameters_count = a->calibrates_count};
    j.files = ceduo_check_memory(calloc(j.scenes_count, sizeof *j.files));
    j.scenes = ceduo_check_memory(calloc(j.scenes_count, sizeof *j.scenes));
    j.inputs = ceduo_check_memory(calloc(j.scenes_count * j.parameters_count, sizeof *j.inputs));
    enum exit_status status = open_job(&j);
    if (status == EXIT_DONE) {
        ceduo_interrupt_catch();
        status = compute(&j);
    }
    for (size_t s = 0; s < j.scenes_count; s++)
        ceduo_scene_release(&j.files[s]);
    free(j.files);
    free(j.scenes);
    free(j.inputs);
    ceduo_interrupt_release();
    return status;
}
