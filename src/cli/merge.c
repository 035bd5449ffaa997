/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --merge: joins the parts that --shard wrote. Reads all files, sorts the parts into groups of one scene, checks that
 * each group is whole, and prints each scene from its runs. The parts point into the texts of the files. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "base/language.h"
#include "batch.h"
#include "ceduo/part.h"
#include "ceduo/version.h"
#include "interrupt.h"
#include "io/part_file.h"
#include "output.h"
#include "print.h"
#include "say.h"
#include "sensitivity.h"
#include "view/report_doubt.h"

#define PART_BYTES_MOST (SIZE_MAX / 2) /* of a file; what memory holds is the bound */

/* All parts, in the order in which they are read until they are sorted. */
struct parts {
    struct arena arena;
    struct part *items;
    size_t n, room;
    struct text *texts; /* of the files: what the parts point into */
    size_t files;
    bool bad, no_memory;
};

/* A line on standard error about a place in a file; what was read before is bad by it. */
__attribute__((format(printf, 4, 5))) static void complain(struct parts *all, const char *file, size_t line, const char *format,
                                                           ...)
{
    struct text what = {0}, why = {0};
    ceduo_text_put(&what, strcmp(file, "-") == 0 ? _("standard input") : file);
    if (line > 0)
        ceduo_text_format(&what, ":%zu", line);
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&why, format, args);
    va_end(args);
    ceduo_say_why(ceduo_text_string(&what), ceduo_text_string(&why));
    all->bad = true;
    ceduo_text_free(&what);
    ceduo_text_free(&why);
}

/* ---- reading ---- */

static void add_part(struct parts *all, const struct part *part)
{
    struct part *items = ceduo_grow(all->items, all->n, &all->room, sizeof *items);
    if (!items) {
        all->no_memory = true;
        return;
    }
    all->items = items;
    all->items[all->n++] = *part;
}

/* False where the rest of the file is not worth reading. */
static bool add_line(struct parts *all, const char *file, size_t line, char *bytes, size_t n)
{
    struct part part = {.file = file, .line = line};
    enum part_fault fault = ceduo_part_read(&all->arena, &part, bytes, n);
    static const char *const faults[] = {[PART_NONE] = N_("not a part written by --shard"),
                                         [PART_CUT] = N_("the part is incomplete; compute this shard again"),
                                         [PART_CHANGED] =
                                             N_("the part was changed after it was written; compute this shard again")};
    if (fault == PART_GOOD)
        add_part(all, &part);
    else if (fault == PART_FORMAT)
        complain(all, file, line, _("the part has a format that this version (%s) cannot read"), CEDUO_VERSION);
    else if (fault == PART_VERSION)
        complain(all, file, line,
                 _("the part is from version %s, but this is %s; compute and merge all shards with one version"), part.scene,
                 CEDUO_VERSION);
    else if (fault == PART_MEMORY)
        all->no_memory = true;
    else
        complain(all, file, line, "%s", _(faults[fault]));
    return fault != PART_NONE;
}

static void read_file(struct parts *all, const char *file)
{
    struct text *text = &all->texts[all->files++];
    if (!ceduo_file_take(file, text, PART_BYTES_MOST)) {
        complain(all, file, 0, _("cannot read it: %s"), ceduo_file_why(errno));
        return;
    }
    if (text->length == 0)
        complain(all, file, 0, _("contains no part"));
    size_t line = 1;
    for (size_t at = 0; at < text->length; line++) {
        char *from = text->bytes + at, *end = memchr(from, '\n', text->length - at);
        size_t n = end ? (size_t)(end - from) : text->length - at;
        at = add_line(all, file, line, from, n) ? at + n + 1 : text->length;
    }
}

/* ---- sorting ---- */

static int compare(uint64_t a, uint64_t b)
{
    return (a > b) - (a < b);
}

/* Scenes as they were given, whatever the order of the files; the shards of one in their order. */
static int by_scene(const void *a, const void *b)
{
    const struct part *p = a, *q = b;
    int order = compare(p->place, q->place);
    order = order != 0 ? order : strcmp(p->scene, q->scene);
    order = order != 0 ? order : compare(p->key, q->key);
    order = order != 0 ? order : compare(p->shards, q->shards);
    return order != 0 ? order : compare(p->shard, q->shard);
}

/* The same scene in the same number of shards. */
static bool belong_together(const struct part *p, const struct part *q)
{
    return p->place == q->place && p->key == q->key && p->shards == q->shards && p->rocks == q->rocks && p->points == q->points;
}

/* One scene may have been given by another path on another machine: its parts go by the name of the first shard. */
static void give_one_name(struct parts *all)
{
    for (size_t i = 0; i < all->n; i++)
        for (size_t k = 0; k < all->n && all->items[i].shard == 1; k++)
            if (belong_together(&all->items[i], &all->items[k]))
                all->items[k].scene = all->items[i].scene;
}

static size_t group_end(const struct parts *all, size_t from)
{
    size_t end = from + 1;
    while (end < all->n && belong_together(&all->items[from], &all->items[end]))
        end++;
    return end;
}

/* ---- checking ---- */

/* "2, 5-7" of the shards that a group lacks; nothing where it has all. */
static void list_missing(const struct parts *all, size_t from, size_t end, struct text *list)
{
    uint64_t next = 1;
    for (size_t i = from; i <= end; i++) {
        uint64_t shard = i < end ? all->items[i].shard : all->items[from].shards + 1;
        if (shard > next)
            ceduo_text_format(list, "%s%llu", list->length > 0 ? ", " : "", (unsigned long long)next);
        if (shard > next + 1)
            ceduo_text_format(list, "-%llu", (unsigned long long)(shard - 1));
        next = shard + 1;
    }
}

static void check_group(struct parts *all, size_t from, size_t end)
{
    const struct part *first = &all->items[from];
    for (size_t i = from + 1; i < end; i++) {
        const struct part *p = &all->items[i], *q = &all->items[i - 1];
        if (p->shard == q->shard)
            complain(all, p->file, p->line, _("shard %llu of %llu of '%s' is given twice; it is also in %s:%zu"),
                     (unsigned long long)p->shard, (unsigned long long)p->shards, p->scene, q->file, q->line);
    }
    struct text missing = {0};
    list_missing(all, from, end, &missing);
    if (missing.length > 0)
        complain(all, first->file, first->line, _("'%s' has %llu shards; these are missing: %s"), first->scene,
                 (unsigned long long)first->shards, missing.bytes);
    ceduo_text_free(&missing);
}

/* Two groups of one scene: the shorter is the stranger, or that of more shards of which more are missing. */
static void check_strangers(struct parts *all, size_t from, size_t middle, size_t end)
{
    bool second = end - middle <= middle - from;
    size_t i = second ? middle : from, to = second ? end : middle;
    const struct part *own = &all->items[second ? from : middle];
    for (; i < to; i++) {
        const struct part *p = &all->items[i];
        if (p->shards != own->shards)
            complain(all, p->file, p->line, _("shard %llu of %llu of '%s', of which %s:%zu is one of %llu"),
                     (unsigned long long)p->shard, (unsigned long long)p->shards, p->scene, own->file, own->line,
                     (unsigned long long)own->shards);
        else
            complain(all, p->file, p->line,
                     _("shard %llu of %llu of another '%s' than that of %s:%zu: the scene, a file that it refers to, "
                       "an option or the number of rocks differs"),
                     (unsigned long long)p->shard, (unsigned long long)p->shards, p->scene, own->file, own->line);
    }
}

static void check(struct parts *all)
{
    for (size_t from = 0, end; from < all->n; from = end) {
        end = group_end(all, from);
        check_group(all, from, end);
        const struct part *p = &all->items[from], *q = end < all->n ? &all->items[end] : NULL;
        if (q && p->place == q->place && strcmp(p->scene, q->scene) == 0)
            check_strangers(all, from, end, group_end(all, end));
    }
}

/* ---- joining ---- */

static enum exit_status unusable(struct parts *all, const struct part *part)
{
    complain(all, part->file, part->line, _("shard %llu of %llu of '%s' does not fit the others; compute it again"),
             (unsigned long long)part->shard, (unsigned long long)part->shards, part->scene);
    return EXIT_INPUT;
}

static enum exit_status out_of_memory(const struct part *part)
{
    ceduo_say_why(part->scene, _("out of memory"));
    return EXIT_RUN;
}

/* The runs of a scene from its parts. */
static enum exit_status adopt(struct parts *all, size_t from, size_t end, struct ceduo_pool *pool, double *seconds)
{
    for (size_t i = from; i < end; i++) {
        const struct part *p = &all->items[i];
        enum ceduo_status status = ceduo_pool_adopt(pool, p->runs, p->runs_length);
        if (status != CEDUO_OK)
            return status == CEDUO_NO_MEMORY ? out_of_memory(p) : unusable(all, p);
        *seconds += p->seconds;
    }
    return EXIT_DONE;
}

static enum exit_status report(struct parts *all, size_t from, size_t end, const struct arguments *a,
                               const struct scene_file *file, struct text *out)
{
    struct ceduo_question q = ceduo_batch_question(a, file, NULL);
    q.rocks = q.run.rocks_most = all->items[from].rocks;
    double seconds = 0;
    struct ceduo_pool *pool;
    enum ceduo_status made = ceduo_pool_create(&q.run, &pool);
    if (made == CEDUO_OK)
        made = ceduo_pool_fill(pool);
    enum exit_status status = made == CEDUO_OK          ? adopt(all, from, end, pool, &seconds)
                              : made == CEDUO_NO_MEMORY ? out_of_memory(&all->items[from])
                                                        : unusable(all, &all->items[from]);
    if (status == EXIT_DONE)
        status = ceduo_print_report(a, file, &q, &pool, seconds, out);
    ceduo_pool_free(pool);
    return status;
}

/* The same of a sensitivity. */
static enum exit_status report_doubt(struct parts *all, size_t from, size_t end, const struct arguments *a,
                                     struct scene_file *file, struct text *out)
{
    struct arguments own = *a;
    bool bad;
    own.rocks = all->items[from].rocks;
    own.points = all->items[from].points;
    enum exit_status status = ceduo_sensitivity_join(&own, file, &all->items[from], end - from, &bad, out);
    return bad ? unusable(all, &all->items[from]) : status;
}

/* The scene of a whole group, read again from what its first shard has with it. */
static enum exit_status join(struct parts *all, size_t from, size_t end, const struct arguments *a, struct text *out)
{
    const struct part *first = &all->items[from];
    struct part_inputs inputs;
    if (!ceduo_part_inputs_read(&all->arena, &inputs, first->inputs, first->inputs_length))
        return all->arena.failed ? out_of_memory(first) : unusable(all, first);
    struct arguments own = *a;
    own.sets = inputs.sets;
    own.options = inputs.options;
    struct scene_file file;
    enum exit_status status = ceduo_batch_read(&own, inputs.path, &inputs.shelf, &file);
    uint64_t key = status == EXIT_DONE ? ceduo_part_key(&file, first->rocks, first->points) : UINT64_MAX;
    if (key == 0)
        status = out_of_memory(first);
    else if (status == EXIT_USAGE || (status == EXIT_DONE && key != first->key))
        status = unusable(all, first);
    if (status == EXIT_DONE && first->points > 0)
        status = report_doubt(all, from, end, &own, &file, out);
    else if (status == EXIT_DONE)
        status = report(all, from, end, &own, &file, out);
    ceduo_scene_release(&file);
    return status;
}

static enum exit_status join_all(struct parts *all, const struct arguments *a, struct text *out)
{
    enum exit_status status = EXIT_DONE;
    for (size_t from = 0, end; from < all->n; from = end) {
        end = group_end(all, from);
        bool doubt = all->items[from].points > 0, other = from == 0 || doubt != (all->items[from - 1].points > 0);
        if (other && a->format == CEDUO_CSV && doubt)
            ceduo_doubt_csv_header(out);
        else if (other && a->format == CEDUO_CSV)
            ceduo_report_csv_header(out, a->stands, false);
        else if (from > 0 && a->format == CEDUO_TABLE)
            ceduo_text_char(out, '\n');
        size_t before = out->length;
        enum exit_status one = join(all, from, end, a, out);
        status = one > status ? one : status;
        if (one > EXIT_RUN || (one == EXIT_RUN && out->length == before))
            out->failed = true; /* nothing is printed where something is missing */
        if (out->failed)
            break;
    }
    return status;
}

enum exit_status ceduo_batch_merge(const struct arguments *a)
{
    struct parts all = {.texts = calloc(a->scenes_count, sizeof *all.texts)};
    struct text out = {0};
    enum exit_status status = EXIT_DONE;
    ceduo_interrupt_catch();
    for (size_t i = 0; all.texts && i < a->scenes_count && !atomic_load(ceduo_interrupt_flag()); i++)
        read_file(&all, a->scenes[i]);
    if (!all.texts || all.no_memory) {
        ceduo_say_why("ceduo", _("out of memory"));
        status = EXIT_RUN;
    } else if (all.n > 0) {
        give_one_name(&all);
        qsort(all.items, all.n, sizeof *all.items, by_scene);
        check(&all);
    }
    if (all.bad)
        status = EXIT_INPUT;
    if (status == EXIT_DONE)
        status = join_all(&all, a, &out);
    if (!out.failed && out.length > 0 && status <= EXIT_RUN && !atomic_load(ceduo_interrupt_flag())) {
        enum exit_status written = ceduo_output_write(a, &out);
        status = written > status ? written : status;
    }
    ceduo_text_free(&out);
    for (size_t i = 0; i < all.files; i++)
        ceduo_text_free(&all.texts[i]);
    free(all.texts);
    free(all.items);
    ceduo_arena_free(&all.arena);
    ceduo_interrupt_release();
    return status;
}
