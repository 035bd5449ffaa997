/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch.h"

#include <errno.h>
#include <langinfo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "interrupt.h"
#include "options.h"
#include "io/file.h"
#include "base/intl.h"

#define HELD_MOST ((size_t)256 * 1024) /* bytes of results that wait in memory */

double ceduo_batch_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool is_utf8(void)
{
    return strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
}

/* What is written in place of the signs that the program itself uses; none is longer. */
static const char *const plain_signs[][2] = {
    {"\xe2\x80\xa6", "..."}, {"\xe2\x80\x93", "-"}, {"\xe2\x88\x92", "-"}, {"\xc2\xb1", "+-"}};

/* For a terminal that knows ASCII alone: what it cannot show otherwise becomes a question mark. */
static void make_plain(struct text *text)
{
    size_t to = 0;
    for (size_t i = 0; i < text->length; i++) {
        unsigned char c = (unsigned char)text->bytes[i];
        size_t sign = 0;
        while (sign < 4 && strncmp(text->bytes + i, plain_signs[sign][0], strlen(plain_signs[sign][0])) != 0)
            sign++;
        if (sign < 4) {
            size_t n = strlen(plain_signs[sign][1]);
            memcpy(text->bytes + to, plain_signs[sign][1], n);
            to += n;
            i += strlen(plain_signs[sign][0]) - 1;
        } else if (c < 0x80) {
            text->bytes[to++] = text->bytes[i];
        } else if ((c & 0xc0) != 0x80) {
            text->bytes[to++] = '?';
        }
    }
    text->length = to;
    if (text->bytes)
        text->bytes[to] = '\0';
}

void ceduo_batch_localise(struct text *text)
{
    if (!is_utf8())
        make_plain(text);
}

void ceduo_batch_say(struct text *text)
{
    ceduo_batch_localise(text);
    if (text->bytes)
        fputs(text->bytes, stderr);
    if (text->failed)
        fputs(_("ceduo: out of memory\n"), stderr); /* what was to be said is cut short */
}

void ceduo_batch_complain(const char *what, const char *why)
{
    struct text line = {0};
    ceduo_text_safe(&line, what);
    ceduo_text_put(&line, ": ");
    ceduo_text_safe(&line, why);
    ceduo_text_char(&line, '\n');
    ceduo_batch_say(&line);
    ceduo_text_free(&line);
}

static enum exit_status worse(enum exit_status a, enum exit_status b)
{
    return a > b ? a : b;
}

/* ---- writing ---- */

static bool write_stdout(const char *bytes, size_t n)
{
    while (n > 0) {
        ssize_t done = write(STDOUT_FILENO, bytes, n);
        if (done < 0 && errno == EINTR && !atomic_load(ceduo_interrupt_flag()))
            continue;
        if (done < 0)
            return false;
        bytes += done;
        n -= (size_t)done;
    }
    return true;
}

/* First what the open file `before` holds (-1: nothing). */
static enum exit_status write_after(int before, const struct arguments *a, const struct text *text)
{
    if (ceduo_text_lost() || text->failed) {
        ceduo_batch_complain("ceduo", _("out of memory"));
        return EXIT_RUN;
    }
    const char *bytes = text->bytes ? text->bytes : "";
    bool good = a->output ? ceduo_file_write_after(before, a->output, bytes, text->length)
                          : write_stdout(bytes, text->length);
    if (good)
        return EXIT_DONE;
    ceduo_batch_complain(a->output ? a->output : _("standard output"), strerror(errno));
    return EXIT_OUTPUT;
}

enum exit_status ceduo_batch_write(const struct arguments *a, const struct text *text)
{
    return write_after(-1, a, text);
}

/* Whether --output is this file, by whatever name. Says so. */
static bool is_output(const struct arguments *a, const char *path)
{
    if (!a->output || !path || !ceduo_file_same(a->output, path))
        return false;
    ceduo_batch_complain(a->output, _("it is read in this run; write elsewhere"));
    return true;
}

bool ceduo_batch_can_write(const struct arguments *a)
{
    struct arena arena = {0};
    bool good = !a->output || ceduo_file_can_write(a->output);
    if (!good)
        ceduo_batch_complain(*a->output ? a->output : "--output", *a->output ? strerror(errno) : _("name a file"));
    if (a->output && good)
        ceduo_file_tidy(a->output);
    for (size_t i = 0; a->output && good && i < a->scenes_count; i++) {
        const char *path = a->scenes[i];
        if (a->mode != MODE_MERGE && strcmp(path, "-") != 0)
            path = ceduo_file_find(&arena, path, NULL, "scenes");
        good = !is_output(a, path);
    }
    ceduo_arena_free(&arena);
    return good;
}

/* Results that wait for the last scene go into a nameless file once they are large, so that thousands of scenes need no
 * more memory than one. Where there is no room for such a file they stay in memory. */
static void set_aside(FILE **spool, struct text *out)
{
    if (out->failed || out->length < HELD_MOST)
        return;
    if (!*spool && (*spool = tmpfile()))
        setvbuf(*spool, NULL, _IONBF, 0);
    long end = *spool ? ftell(*spool) : -1;
    if (end < 0)
        return;
    if (fwrite(out->bytes, 1, out->length, *spool) == out->length)
        out->length = 0;
    else if (fseek(*spool, end, SEEK_SET) != 0 || ftruncate(fileno(*spool), end) != 0)
        out->failed = true;
}

/* ---- progress ---- */

struct progress ceduo_progress_begin(const struct arguments *a, uint64_t before)
{
    return (struct progress){
        .start = ceduo_batch_now(), .before = before, .wanted = !a->quiet && isatty(STDERR_FILENO)};
}

void ceduo_progress_show(void *context, uint64_t rocks)
{
    struct progress *p = context;
    double t = ceduo_batch_now();
    if (!p->wanted || t - p->start < 1 || t - p->shown < 0.2)
        return;
    fprintf(stderr, _("\r%llu rocks, %.0f s"), (unsigned long long)(rocks - p->before), t - p->start);
    p->shown = t;
    p->open = true;
}

void ceduo_progress_end(const struct progress *p)
{
    if (p->open)
        fputs("\r                              \r", stderr);
}

/* ---- one scene ---- */

static bool is_wanted(const struct arguments *a, const char *name)
{
    for (size_t i = 0; name && i < a->options_count; i++)
        if (strcmp(a->options[i], name) == 0)
            return true;
    return false;
}

enum exit_status ceduo_batch_no_option(const struct scene_file *file, const char *name)
{
    struct text message = {0};
    ceduo_text_format(&message, _("--option: no option '%s' in %s; it has: "), name, file->path);
    for (size_t i = 0; i < file->scene.options_count; i++)
        ceduo_text_format(&message, "%s'%s'", i > 0 ? ", " : "", file->scene.options[i].name);
    ceduo_batch_complain("ceduo", message.bytes ? message.bytes : "");
    ceduo_text_free(&message);
    return EXIT_USAGE;
}

/* Keeps only the options that were asked for, in the scene's order. */
enum exit_status ceduo_batch_choose(const struct arguments *a, struct scene_file *file)
{
    for (size_t i = 0; i < a->options_count; i++) {
        bool found = false;
        for (size_t k = 0; k < file->scene.options_count; k++)
            found |= strcmp(file->scene.options[k].name, a->options[i]) == 0;
        if (!found)
            return ceduo_batch_no_option(file, a->options[i]);
    }
    const struct node *list = ceduo_node_get(file->root, "options");
    if (a->options_count == 0 || !list)
        return EXIT_DONE;
    for (size_t k = list->n; list && k-- > 0;)
        if (!is_wanted(a, ceduo_node_text(list->items[k], "name")))
            list = ceduo_node_removed(&file->arena, list, k);
    const struct node *root = list ? ceduo_node_with(&file->arena, file->root, "options", list) : NULL;
    struct problems problems = {0};
    file->root = root;
    bool good = root && ceduo_scene_bind(file, &problems);
    ceduo_problems_free(&problems);
    return good ? EXIT_DONE : EXIT_RUN;
}

enum exit_status ceduo_batch_read(const struct arguments *a, const char *path, struct shelf *shelf,
                                  struct scene_file *file)
{
    struct problems problems = {0};
    struct shelf own = {0}; /* what is read from the disk, for -o */
    bool good = ceduo_scene_read_by(file, shelf ? shelf : &own, path, a->sets, a->sets_count, &problems);
    ceduo_problems_close(&problems);
    ceduo_batch_say(&problems.text);
    enum exit_status status = good ? EXIT_DONE : problems.usage ? EXIT_USAGE : EXIT_INPUT;
    ceduo_problems_free(&problems);
    const struct shelf *read = shelf ? shelf : &own;
    for (const struct shelf_file *f = read->closed ? NULL : read->files; f && status != EXIT_OUTPUT; f = f->before)
        if (is_output(a, f->path))
            status = EXIT_OUTPUT;
    if (!shelf)
        file->arena.shelf = NULL;
    return status;
}

static enum exit_status write_report(const struct arguments *a, const struct ceduo_report *report, struct text *out)
{
    if (a->format == CEDUO_JSON) {
        ceduo_report_json(out, report);
        return EXIT_DONE;
    }
    if (a->format == CEDUO_CSV) {
        ceduo_text_put(out, ""); /* without stands no row, but the header */
        ceduo_report_csv(out, report, a->stands);
        return EXIT_DONE;
    }
    struct text page = {0};
    bool plain = !is_utf8();
    ceduo_report_table(&page, report, plain);
    if (plain)
        make_plain(&page);
    if (page.bytes)
        ceduo_text_add(out, page.bytes, page.length);
    out->failed |= page.failed;
    ceduo_text_free(&page);
    return EXIT_DONE;
}

static void free_years(struct ceduo_years **years)
{
    for (size_t i = 0; years && years[i]; i++)
        ceduo_years_free(years[i]);
    free(years);
}

/* The options year by year, with as many rocks as the bare run; without --years over the usual years. NULL where it was interrupted or there is no memory. */
static struct ceduo_years **fly_years(const struct arguments *a, const struct ceduo_scene *scene,
                                      struct ceduo_pool *pool, const struct ceduo_flown *bare)
{
    unsigned first = a->years ? a->year_first : 0, step = a->years ? a->year_step : 1;
    unsigned last = a->years ? a->year_last : ceduo_years_usual(scene);
    struct ceduo_years **years = calloc(scene->options_count + 1, sizeof *years);
    enum ceduo_status status = years ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < scene->options_count && status == CEDUO_OK; i++) {
        status = ceduo_years_create(scene, &scene->options[i], first, last, step, &years[i]);
        if (status == CEDUO_OK)
            status = ceduo_years_fly(years[i], pool, bare, bare->rocks);
    }
    if (status == CEDUO_OK)
        return years;
    free_years(years);
    return NULL;
}

#define BLOCK_ROCKS 2000 /* of each size at the most: a page shows no more digits */

/* Blocks of other sizes through the forest of each option, for the page; NULL unless CEDUO_OK. */
static enum ceduo_status fly_blocks(const struct arguments *a, const struct ceduo_scene *scene, uint64_t rocks,
                                    struct ceduo_block **blocks)
{
    size_t n = scene->options_count;
    *blocks = calloc(n * CEDUO_BLOCKS + 1, sizeof **blocks);
    enum ceduo_status status = *blocks ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n && status == CEDUO_OK; i++)
        status = ceduo_blocks(scene, &scene->options[i], ceduo_plot_last_control(scene),
                              rocks < BLOCK_ROCKS ? rocks : BLOCK_ROCKS, a->threads, ceduo_interrupt_flag(),
                              &(*blocks)[i * CEDUO_BLOCKS]);
    if (status == CEDUO_OK)
        return status;
    free(*blocks);
    *blocks = NULL;
    return status;
}

/* Why something came to nothing: an interruption says nothing. */
static enum exit_status fell_short(const struct scene_file *file)
{
    if (!atomic_load(ceduo_interrupt_flag()))
        ceduo_batch_complain(file->path, _("out of memory"));
    return EXIT_RUN;
}

enum exit_status ceduo_batch_report(const struct arguments *a, const struct scene_file *file,
                                    struct ceduo_pool *pool, struct ceduo_report *report, double start,
                                    struct text *out)
{
    struct ceduo_result *result;
    if (ceduo_result_create(&file->scene, pool, &result) != CEDUO_OK) {
        ceduo_batch_complain(file->path, _("out of memory"));
        return EXIT_RUN;
    }
    report->result = result;
    struct ceduo_years **years = a->years ? fly_years(a, &file->scene, pool, &result->bare) : NULL;
    if (a->years && !years) {
        ceduo_result_free(result);
        return fell_short(file);
    }
    report->years = years;
    report->work = ceduo_pool_work(pool);
    if (start > 0)
        report->seconds = ceduo_batch_now() - start;
    struct ceduo_block *blocks = NULL;
    enum ceduo_status sizes = CEDUO_OK; /* CEDUO_BAD_ROCK: so thin a splinter has no other sizes; the page does without */
    if (a->format == CEDUO_TABLE && !a->years && file->scene.controls_count > 0)
        sizes = fly_blocks(a, &file->scene, ceduo_result_rocks(result), &blocks);
    report->blocks = blocks;
    bool short_of = sizes == CEDUO_NO_MEMORY || sizes == CEDUO_CANCELLED;
    enum exit_status status = short_of ? fell_short(file) : write_report(a, report, out);
    free(blocks);
    free_years(years);
    if (ceduo_result_unfinished(result) * 1000 > ceduo_result_rocks(result))
        status = worse(status, EXIT_RUN);
    ceduo_result_free(result);
    return status;
}

/* -n, or with a tolerance alone as many as may be, or the scene's. */
uint64_t ceduo_batch_rocks(const struct arguments *a, const struct scene_file *file)
{
    if (a->rocks > 0)
        return a->rocks;
    return a->tolerance > 0 ? CEDUO_ROCKS_MOST : file->scene.simulation.rocks;
}

/* ---- pictures ---- */

#define PLOT_WIDTH  80
#define PLOT_HEIGHT 24

/* `start`: where this scene's pictures begin; a blank line stands between two. */
static void add_plot(const struct arguments *a, const struct ceduo_picture *picture, size_t start, struct text *out)
{
    enum ceduo_charset charset = ceduo_option_given(a, "charset") ? a->charset
                                 : is_utf8()      ? CEDUO_CHARSET_BRAILLE
                                                  : CEDUO_CHARSET_ASCII;
    int width = a->plot_width > 0 ? a->plot_width : PLOT_WIDTH;
    int height = a->plot_width > 0 ? a->plot_height : PLOT_HEIGHT;
    struct ceduo_canvas *canvas = ceduo_canvas_create(width, height, charset);
    struct ceduo_area area = {.top = 1, .width = width, .height = height - 1};
    struct text title = {0};
    ceduo_plot_title(&title, a->plot, picture);
    char *rows = NULL;
    if (canvas) {
        ceduo_plot_draw(a->plot, canvas, &area, picture);
        ceduo_canvas_label(canvas, 0, 0, CEDUO_ROLE_TITLE, title.bytes ? title.bytes : "");
        rows = ceduo_canvas_dump(canvas);
    }
    if (out->length > start)
        ceduo_text_char(out, '\n');
    ceduo_text_put(out, rows ? rows : "");
    out->failed |= !rows || title.failed;
    free(rows);
    ceduo_text_free(&title);
    ceduo_canvas_free(canvas);
}

/* One picture for each option, belt or control that it depends on. */
static void add_plots(const struct arguments *a, const struct ceduo_scene *scene, const struct ceduo_outlook *outlook,
                      struct ceduo_years *const *years, struct text *out)
{
    struct ceduo_picture picture = {.scene = scene, .outlook = outlook, .control = ceduo_plot_last_control(scene)};
    size_t start = out->length;
    size_t options = ceduo_plot_by_option(a->plot) ? scene->options_count : 1;
    for (size_t o = 0; o < options; o++) {
        size_t belts = a->plot == CEDUO_PLOT_STAND ? scene->options[o].belts_count : 0;
        size_t controls = a->plot == CEDUO_PLOT_HISTOGRAM ? scene->controls_count : 0;
        picture.option = o;
        picture.years = years ? years[o] : NULL;
        picture.year = SIZE_MAX;
        for (size_t k = 0; k == 0 || k < belts || k < controls; k++) {
            picture.belt = k;
            picture.control = controls > 0 ? k : picture.control;
            add_plot(a, &picture, start, out);
        }
    }
}

static enum exit_status plot_run(const struct arguments *a, const struct scene_file *file,
                                 struct ceduo_pool *pool, const struct ceduo_run_def *def, struct text *out)
{
    struct ceduo_outlook *outlook;
    struct ceduo_outlook_def from = {.scene = &file->scene,
                                     .figures = pool,
                                     .pictures = pool,
                                     .cells = def->cells,
                                     .cell_x = def->cell_x,
                                     .trails = a->plot == CEDUO_PLOT_PROFILE ? CEDUO_OUTLOOK_TRAILS : 0,
                                     .cancel = ceduo_interrupt_flag()};
    if (ceduo_outlook_create(&from, &outlook) != CEDUO_OK)
        return fell_short(file);
    struct ceduo_years **years = NULL;
    if (a->plot == CEDUO_PLOT_ROTATION &&
        !(years = fly_years(a, &file->scene, pool, &outlook->bare->flown))) {
        ceduo_outlook_free(outlook);
        return fell_short(file);
    }
    add_plots(a, &file->scene, outlook, years, out);
    free_years(years);
    bool unfinished = false;
    for (size_t i = 0; i <= outlook->options; i++) {
        const struct ceduo_sight *s = i < outlook->options ? outlook->wooded[i] : outlook->bare;
        unfinished |= s && s->flown.ends.count[CEDUO_UNFINISHED] * 1000 > s->flown.rocks;
    }
    ceduo_outlook_free(outlook);
    return unfinished ? EXIT_RUN : EXIT_DONE;
}

/* ---- a run ---- */

static enum exit_status run_scene(const struct arguments *a, const struct scene_file *file, struct text *out)
{
    struct progress progress = ceduo_progress_begin(a, 0);
    struct ceduo_run_def def = ceduo_run_def_default(&file->scene);
    def.threads = a->threads;
    def.rocks_most = ceduo_batch_rocks(a, file);
    def.cancel = ceduo_interrupt_flag();
    def.progress = ceduo_progress_show;
    def.context = &progress;
    double cell_x[CEDUO_OUTLOOK_CELLS];
    if (ceduo_plot_needs_cells(a->plot))
        def.cells = ceduo_outlook_places(&file->scene, cell_x);
    def.cell_x = cell_x;
    struct ceduo_report report = {
        .file = file, .remarks = {.tolerance = a->tolerance, .ground_assumed = file->ground_assumed}};
    struct ceduo_pool *pool;
    enum ceduo_status status = ceduo_pool_create(&def, &pool);
    if (status == CEDUO_OK)
        status = ceduo_pool_fill(pool);
    if (a->stands && a->format == CEDUO_CSV) /* what is asked of the stands no rock answers */
        report.rocks_asked = def.rocks_most;
    else if (status == CEDUO_OK && a->tolerance > 0)
        status = ceduo_pool_until(pool, a->tolerance, def.rocks_most, &report.remarks.tolerance_met);
    else if (status == CEDUO_OK)
        status = ceduo_pool_extend(pool, def.rocks_most);
    ceduo_progress_end(&progress);
    enum exit_status done = EXIT_RUN;
    if (status == CEDUO_OK && a->plot != CEDUO_PLOT_NONE)
        done = plot_run(a, file, pool, &def, out);
    else if (status == CEDUO_OK)
        done = ceduo_batch_report(a, file, pool, &report, progress.start, out);
    else if (status != CEDUO_CANCELLED)
        ceduo_batch_complain(file->path, status == CEDUO_NO_MEMORY ? _("out of memory") : _("cannot be computed"));
    ceduo_pool_free(pool);
    return done;
}

static enum exit_status batch_scene(const struct arguments *a, size_t i, struct text *out)
{
    struct scene_file file;
    struct shelf shelf = {0};
    enum exit_status status = ceduo_batch_read(a, a->scenes[i], a->shards > 0 ? &shelf : NULL, &file);
    if (status == EXIT_DONE)
        status = ceduo_batch_choose(a, &file);
    if (status == EXIT_DONE && a->plot != CEDUO_PLOT_NONE && !ceduo_plot_needs_run(a->plot)) {
        add_plots(a, &file.scene, NULL, NULL, out);
    } else if (status == EXIT_DONE) {
        ceduo_interrupt_catch();
        status = a->shards > 0 ? ceduo_batch_shard(a, a->scenes[i], &shelf, &file, i + 1, out)
                               : run_scene(a, &file, out);
    }
    ceduo_scene_release(&file);
    return status;
}

/* ---- modes ---- */

enum exit_status ceduo_batch_run(const struct arguments *a)
{
    struct text out = {0};
    FILE *spool = NULL;
    enum exit_status status = EXIT_DONE;
    bool first = true;
    for (size_t i = 0; i < a->scenes_count; i++) {
        struct text one = {0};
        enum exit_status result = batch_scene(a, i, &one);
        status = worse(status, result);
        if (result == EXIT_OUTPUT) { /* nothing is written over what was read */
            ceduo_text_free(&one);
            break;
        }
        bool interrupted = atomic_load(ceduo_interrupt_flag());
        if (result <= EXIT_RUN && one.bytes && !interrupted) {
            if (first && a->format == CEDUO_CSV)
                ceduo_report_csv_header(&out, a->stands, a->years);
            else if (!first && a->format == CEDUO_TABLE)
                ceduo_text_char(&out, '\n');
            ceduo_text_add(&out, one.bytes, one.length);
            first = false;
        }
        out.failed |= one.failed;
        ceduo_text_free(&one);
        if (a->output) {
            set_aside(&spool, &out);
        } else if ((out.length > 0 || out.failed) && !interrupted) {
            enum exit_status written = ceduo_batch_write(a, &out);
            status = worse(status, written);
            out.length = 0;
            if (written != EXIT_DONE)
                break;
        }
        ceduo_interrupt_release();
    }
    if (a->output && status != EXIT_OUTPUT && (!first || out.failed))
        status = worse(status, write_after(spool ? fileno(spool) : -1, a, &out));
    if (spool)
        fclose(spool);
    ceduo_text_free(&out);
    return status;
}

enum exit_status ceduo_batch_check(const struct arguments *a)
{
    enum exit_status status = EXIT_DONE;
    for (size_t i = 0; i < a->scenes_count; i++) {
        struct scene_file file;
        enum exit_status one = ceduo_batch_read(a, a->scenes[i], NULL, &file);
        if (one == EXIT_DONE)
            one = ceduo_batch_choose(a, &file);
        ceduo_scene_release(&file);
        status = worse(status, one);
    }
    return status;
}
