/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What --merge reads. The first byte chooses how the others are taken:
 *   0  a line of a part as it is
 *   1  the same, but first its sum is put right: what stands behind the sum is reached
 *   2  a file of parts, all sums put right, joined and reported as the program does
 *   3  the bytes of inputs; the scene is read from what they hold
 *   4… the bytes of the runs of one of the pools below, which are adopted and reported
 * Once, before the first input, it makes such inputs itself and sees that each is taken, or refused where it is bad: a
 * change of the format cannot leave it testing nothing. With FUZZ_SEEDS=FOLDER it writes them there, as seeds, and ends. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/hash.h"
#include "ceduo/part.h"
#include "cli/batch.h"
#include "fuzz.h"
#include "io/part_file.h"

#define LENGTH(a)  (sizeof(a) / sizeof(a)[0])
#define SCENE      "fuzz.yaml"
#define STAND      "stand.yaml"
#define ROCKS      12
#define ROCKS_MOST ((uint64_t)1 << 16) /* of a pool for a scene that may be any: beyond it is slow for nothing */

enum { LINE, SEALED, PARTS, INPUTS, POOLS };

static const char stand[] = "ceduo: stand/1\nname: a\nstools: {per_ha: 2000, spacing_m: 0.25}\n"
                            "shoots: [{per_ha: 5000, dbh_m: 0.07, height_m: 6}]\n";

/* Some rocks reach the control, some are stopped. */
static const char plain[] =
    "ceduo: scene/1\ntitle: p\nrock: {diameter_m: 0.5}\nrelease: {vx_m_s: 1}\n"
    "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.35, rt: 0.875, roughness_rad: 0.125}]}\n"
    "controls: [{x_m: 40, accepted_kJ: 20}]\nforest: [{from_m: 10, to_m: 30, stand: " STAND "}]\nsimulation: {rocks: 12}\n";

/* Rocks of different sizes, so that the samples of every quantity are kept; two controls, two options. */
static const char spread[] =
    "ceduo: scene/1\ntitle: s\nrock: {diameter_m: {mean: 0.5, spread: 0.1}}\nrelease: {vx_m_s: 1}\n"
    "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.35, rt: 0.875, roughness_rad: 0.125}]}\n"
    "controls: [{x_m: 20}, {x_m: 60, accepted_kJ: 20}]\n"
    "options: [{name: a, forest: [{from_m: 10, to_m: 30, stand: " STAND "}]}, {name: b}]\n"
    "simulation: {rocks: 12, contact_model: poisson}\n";

/* All rocks go the same way: histograms of many rocks are as short as those of one. */
static const char smooth[] =
    "ceduo: scene/1\ntitle: w\nrock: {diameter_m: 0.5}\nrelease: {vx_m_s: 1}\n"
    "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.35, rt: 0.875}]}\ncontrols: [{x_m: 40}]\n";

/* Pools that bytes are adopted into: with samples and, where exact_bytes are few, with histograms. `first`: the rocks
 * before it come from a good part. */
static const struct pool_kind {
    const char *text;
    uint64_t rocks, first;
    size_t exact_bytes;
} kinds[] = {
    {plain, ROCKS, 0, CEDUO_EXACT_BYTES},
    {spread, ROCKS, 0, CEDUO_EXACT_BYTES},
    {plain, ROCKS, 0, 64},
    {plain, 2 * CEDUO_BLOCK_ROCKS + ROCKS, 2 * CEDUO_BLOCK_ROCKS, CEDUO_EXACT_BYTES},
    {smooth, 2 * CEDUO_BLOCK_ROCKS + ROCKS, CEDUO_BLOCK_ROCKS, 64},
};

struct saved {
    unsigned char *bytes;
    size_t n;
};

/* A pool and what it was made from. */
struct made {
    struct arena arena;
    struct shelf shelf;
    struct scene_file file;
    struct ceduo_pool *pool;
};

static struct saved before[LENGTH(kinds)]; /* the good part before `first` */
static FILE *told;                         /* the program's own complaints are not wanted */

static void fail(const char *what)
{
    fprintf(told, "fuzz_part: %s\n", what);
    abort();
}

static void expect(bool condition, const char *what)
{
    if (!condition)
        fail(what);
}

/* ---- scenes ---- */

/* A scene whose files are on a shelf alone. */
static void read_scene(struct made *m, const char *text)
{
    const struct arguments none = {.threads = 1};
    *m = (struct made){0};
    expect(ceduo_shelf_find(&m->arena, &m->shelf, SCENE, NULL, "scenes", SCENE) &&
               ceduo_shelf_find(&m->arena, &m->shelf, STAND, SCENE, "stands", STAND) &&
               ceduo_shelf_file(&m->arena, &m->shelf, SCENE, text, strlen(text)) &&
               ceduo_shelf_file(&m->arena, &m->shelf, STAND, stand, strlen(stand)),
           "no shelf");
    m->shelf.closed = true;
    expect(ceduo_batch_read(&none, SCENE, &m->shelf, &m->file) == EXIT_DONE, "the harness's own scene is not read");
}

static void make_pool(struct made *m, const struct pool_kind *kind, bool part, uint64_t first)
{
    read_scene(m, kind->text);
    struct ceduo_run_def def = ceduo_run_def_default(&m->file.scene);
    def.rocks_most = kind->rocks;
    def.exact_bytes = kind->exact_bytes;
    def.part = part;
    def.first = first;
    expect(ceduo_pool_create(&def, &m->pool) == CEDUO_OK && ceduo_pool_fill(m->pool) == CEDUO_OK, "no pool");
}

static void free_made(struct made *m)
{
    ceduo_pool_free(m->pool);
    ceduo_scene_release(&m->file);
    ceduo_arena_free(&m->arena);
}

static struct saved part_of(const struct pool_kind *kind, uint64_t first, uint64_t end)
{
    struct made m;
    struct saved s = {0};
    make_pool(&m, kind, true, first);
    expect(ceduo_pool_extend(m.pool, end) == CEDUO_OK && ceduo_pool_save(m.pool, &s.bytes, &s.n) == CEDUO_OK,
           "a part cannot be flown");
    free_made(&m);
    return s;
}

/* ---- a line ---- */

static bool same_bytes(const void *a, size_t n, const void *b, size_t m)
{
    return n == m && (n == 0 || memcmp(a, b, n) == 0);
}

static bool same_text(const struct text *a, const struct text *b)
{
    return same_bytes(a->bytes, a->length, b->bytes, b->length);
}

/* A part that is written and read again is the same part; from the second time on it is the same line, too (the first
 * may have put right a name that is no UTF-8). */
static void check_written(struct arena *arena, const struct part *part)
{
    struct text lines[3] = {{0}, {0}, {0}};
    struct part was = *part;
    for (size_t i = 0; i < LENGTH(lines); i++) {
        struct part again = {0};
        ceduo_part_write(&lines[i], &was);
        expect(!lines[i].failed && lines[i].bytes[lines[i].length - 1] == '\n', "a line without its end");
        char *copy = ceduo_arena_copy(arena, lines[i].bytes, lines[i].length - 1);
        expect(ceduo_part_read(arena, &again, copy, lines[i].length - 1) == PART_GOOD, "a written part is not read");
        expect(again.place == was.place && again.shard == was.shard && again.shards == was.shards && again.rocks == was.rocks &&
                   again.key == was.key && again.seconds == was.seconds &&
                   same_bytes(again.inputs, again.inputs_length, was.inputs, was.inputs_length) &&
                   same_bytes(again.runs, again.runs_length, was.runs, was.runs_length),
               "read again it is another part");
        was = again;
    }
    expect(same_text(&lines[1], &lines[2]), "written again it is another line");
    for (size_t i = 0; i < LENGTH(lines); i++)
        ceduo_text_free(&lines[i]);
}

/* `whole`: its sum is its own, so that it must be what the program would write. */
static bool take_line(const uint8_t *data, size_t n, bool whole)
{
    struct arena arena = {0};
    struct part part = {0};
    char *line = malloc(n > 0 ? n : 1); /* no more: what is read behind it is seen */
    expect(line != NULL, "out of memory");
    if (n > 0)
        memcpy(line, data, n);
    enum part_fault fault = ceduo_part_read(&arena, &part, line, n);
    expect(fault != PART_MEMORY, "out of memory");
    if (fault == PART_GOOD) {
        struct text text = {0};
        ceduo_part_write(&text, &part);
        expect(!whole || same_bytes(data, n, text.bytes, text.length - 1), "its sum is right, but it is another line");
        ceduo_text_free(&text);
        check_written(&arena, &part);
    }
    free(line);
    ceduo_arena_free(&arena);
    return fault == PART_GOOD;
}

/* Adds a line with the sum of what stands before its sum, or, where it has none, of the whole. */
static void seal(struct text *to, const uint8_t *line, size_t n)
{
    static const char sum[] = ", \"sum\": \"";
    for (size_t at = n; at-- > 0;)
        if (n - at >= sizeof sum - 1 && memcmp(line + at, sum, sizeof sum - 1) == 0) {
            n = at;
            break;
        }
    ceduo_text_add(to, (const char *)line, n);
    ceduo_text_format(to, "%s%016" PRIx64 "\"}", sum, hash_bytes(line, n));
    expect(!to->failed, "out of memory");
}

static bool take_sealed(const uint8_t *data, size_t n)
{
    struct text text = {0};
    seal(&text, data, n);
    bool good = take_line((const uint8_t *)text.bytes, text.length, false);
    ceduo_text_free(&text);
    return good;
}

/* ---- a file of parts ---- */

static bool take_parts(const uint8_t *data, size_t n)
{
    struct text text = {0};
    for (size_t at = 0; at < n;) {
        const uint8_t *end = memchr(data + at, '\n', n - at);
        size_t length = end ? (size_t)(end - (data + at)) : n - at;
        seal(&text, data + at, length);
        ceduo_text_char(&text, '\n');
        at += length + 1;
    }
    int fd = memfd_create("fuzz", MFD_CLOEXEC);
    expect(fd >= 0 && write(fd, text.bytes, text.length) == (ssize_t)text.length, "no file");
    char path[64];
    snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
    char *scenes[] = {path};
    static const enum ceduo_format formats[] = {CEDUO_JSON, CEDUO_CSV, CEDUO_CSV, CEDUO_TABLE};
    const struct arguments a = {.mode = MODE_MERGE,
                                .format = formats[n % 4],
                                .stands = n % 4 == 2,
                                .output = "/dev/null",
                                .quiet = true,
                                .threads = 1,
                                .scenes = scenes,
                                .scenes_count = 1};
    enum exit_status status = ceduo_batch_merge(&a);
    expect(status == EXIT_DONE || status == EXIT_RUN || status == EXIT_INPUT, "a status that --merge has not");
    close(fd);
    ceduo_text_free(&text);
    return status == EXIT_DONE;
}

/* ---- inputs ---- */

/* What was read is written to the same bytes. */
static void check_inputs(const struct part_inputs *in, const uint8_t *data, size_t n)
{
    struct part_inputs turned = *in;
    struct arena arena = {0};
    turned.shelf = (struct shelf){0}; /* read from the last to the first: put back in their order */
    for (const struct shelf_find *f = in->shelf.finds; f; f = f->before)
        expect(ceduo_shelf_find(&arena, &turned.shelf, f->name, f->beside, f->folder, f->path), "out of memory");
    for (const struct shelf_file *f = in->shelf.files; f; f = f->before)
        expect(ceduo_shelf_file(&arena, &turned.shelf, f->path, f->bytes, f->length), "out of memory");
    size_t length;
    unsigned char *bytes = ceduo_part_inputs(&turned, &length);
    expect(bytes && same_bytes(bytes, length, data, n), "inputs written again are other inputs");
    free(bytes);
    ceduo_arena_free(&arena);
}

static bool take_inputs(const uint8_t *data, size_t n)
{
    struct arena arena = {0};
    struct part_inputs in;
    unsigned char *bytes = malloc(n > 0 ? n : 1);
    expect(bytes != NULL, "out of memory");
    if (n > 0)
        memcpy(bytes, data, n);
    bool good = ceduo_part_inputs_read(&arena, &in, bytes, n);
    free(bytes); /* what was read stands by itself */
    expect(!arena.failed, "out of memory");
    if (good) {
        check_inputs(&in, data, n);
        const struct arguments a = {.sets = in.sets, .options = in.options, .threads = 1};
        struct scene_file file;
        enum exit_status status = ceduo_batch_read(&a, in.path, &in.shelf, &file);
        expect(status != EXIT_DONE || in.shelf.files, "a scene that the inputs do not hold");
        good = status == EXIT_DONE;
        if (good) {
            struct ceduo_run_def def = ceduo_run_def_default(&file.scene);
            struct ceduo_pool *pool;
            def.rocks_most = def.rocks_most < ROCKS_MOST ? def.rocks_most : ROCKS_MOST;
            (void)ceduo_part_key(&file, def.rocks_most, 0);
            expect(ceduo_pool_create(&def, &pool) == CEDUO_OK && ceduo_pool_fill(pool) == CEDUO_OK,
                   "checked, but it cannot be joined");
            ceduo_pool_free(pool);
        }
        ceduo_scene_release(&file);
    }
    ceduo_arena_free(&arena);
    return good;
}

/* ---- runs ---- */

static bool within(double lo, double p, double hi)
{
    return lo >= 0 && lo <= p && p <= hi && hi <= 1;
}

static void check_arrivals(const struct ceduo_flown *flown, uint64_t rocks)
{
    expect(flown->rocks == rocks, "not as many rocks as there were");
    for (size_t c = 0; c < flown->controls; c++) {
        const struct ceduo_arrivals *a = &flown->arrivals[c];
        expect(a->released == rocks && a->reached <= rocks && a->unfinished <= rocks - a->reached &&
                   within(a->reach_lo, a->reach_probability, a->reach_hi),
               "more rocks than there were");
        expect(a->exceeded <= a->reached, "more rocks exceed than arrive");
    }
}

static void check_report(const struct made *m, uint64_t rocks)
{
    struct ceduo_result *result;
    struct text text = {0};
    expect(ceduo_result_create(&m->file.scene, m->pool, &result) == CEDUO_OK, "out of memory");
    check_arrivals(&result->bare, rocks);
    for (size_t i = 0; i < result->options_count; i++)
        check_arrivals(&result->options[i].wooded, rocks);
    const struct ceduo_report report = {.file = &m->file, .result = result, .work = ceduo_pool_work(m->pool)};
    ceduo_report_json(&text, &report);
    ceduo_report_csv(&text, &report, false);
    ceduo_report_table(&text, &report, false);
    expect(!text.failed && text.length > 0, "no report");
    ceduo_text_free(&text);
    ceduo_result_free(result);
}

/* What is adopted can be reported. A run of less than a block has still all that it was given: saved, it is that. */
static bool take_runs(const struct pool_kind *kind, const uint8_t *data, size_t n)
{
    const struct saved *good = &before[kind - kinds];
    struct made m;
    make_pool(&m, kind, false, 0);
    if (kind->first > 0)
        expect(ceduo_pool_adopt(m.pool, good->bytes, good->n) == CEDUO_OK, "a good part is refused");
    unsigned char *bytes = malloc(n > 0 ? n : 1);
    expect(bytes != NULL, "out of memory");
    if (n > 0)
        memcpy(bytes, data, n);
    enum ceduo_status status = ceduo_pool_adopt(m.pool, bytes, n);
    free(bytes);
    expect(status == CEDUO_OK || status == CEDUO_BAD_PART, "neither good nor bad");
    uint64_t rocks = ceduo_run_rocks(ceduo_pool_find(m.pool, NULL));
    if (status == CEDUO_OK && kind->rocks < CEDUO_BLOCK_ROCKS) {
        struct saved again;
        expect(ceduo_pool_save(m.pool, &again.bytes, &again.n) == CEDUO_OK, "out of memory");
        expect(same_bytes(data, n, again.bytes, again.n), "saved again it is another part");
        free(again.bytes);
    }
    if (status == CEDUO_OK && rocks > 0) /* a part without rocks fits where none was flown */
        check_report(&m, rocks);
    free_made(&m);
    return status == CEDUO_OK;
}

/* ---- its own inputs ---- */

static bool take(const uint8_t *data, size_t n)
{
    size_t mode = (size_t)(uint8_t)(data[0] - '0') % (POOLS + LENGTH(kinds));
    switch (mode) {
    case LINE:
        return take_line(data + 1, n - 1, true);
    case SEALED:
        return take_sealed(data + 1, n - 1);
    case PARTS:
        return take_parts(data + 1, n - 1);
    case INPUTS:
        return take_inputs(data + 1, n - 1);
    default:
        return take_runs(&kinds[mode - POOLS], data + 1, n - 1);
    }
}

static void try_one(size_t mode, const void *bytes, size_t n, bool good, const char *folder)
{
    static unsigned number;
    struct text text = {0};
    ceduo_text_char(&text, (char)('0' + mode));
    ceduo_text_add(&text, bytes, n);
    expect(!text.failed, "out of memory");
    expect(take((const uint8_t *)text.bytes, text.length) == good, good ? "its own input is refused" : "taken, but bad");
    if (folder) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%02u", folder, number++);
        FILE *f = fopen(path, "wb");
        expect(f && fwrite(text.bytes, 1, text.length, f) == text.length && fclose(f) == 0, "a seed cannot be written");
    }
    ceduo_text_free(&text);
}

static void try_own(size_t mode, const void *bytes, size_t n, const char *folder)
{
    try_one(mode, bytes, n, true, folder);
}

/* Inputs that hold no file, of a scene without a name, and of one that is there on the disk: none is read from there. */
static void try_without_files(const char *path, const char *folder)
{
    size_t n;
    const struct part_inputs in = {.path = path};
    unsigned char *bytes = ceduo_part_inputs(&in, &n);
    expect(bytes != NULL, "out of memory");
    try_one(INPUTS, bytes, n, false, folder);
    free(bytes);
}

/* The line of a shard as the program writes it, but for the seconds: seeds are always the same. */
static void add_shard(struct made *m, uint64_t shard, uint64_t shards, struct text *to)
{
    const struct arguments a = {.shard = shard, .shards = shards, .threads = 1, .quiet = true};
    struct text line = {0};
    struct arena arena = {0};
    struct part part = {0};
    expect(ceduo_batch_shard(&a, SCENE, &m->shelf, &m->file, 1, &line) == EXIT_DONE &&
               ceduo_part_read(&arena, &part, line.bytes, line.length - 1) == PART_GOOD,
           "a shard cannot be flown");
    part.seconds = 0.5;
    ceduo_part_write(to, &part);
    ceduo_text_free(&line);
    ceduo_arena_free(&arena);
}

/* A scene in two shards, of which the second has no rocks. */
static void try_lines(const char *scene, const char *folder)
{
    struct text all = {0};
    struct made m;
    read_scene(&m, scene);
    for (uint64_t shard = 1; shard <= 2; shard++) {
        size_t from = all.length;
        add_shard(&m, shard, 2, &all);
        size_t n = all.length - from - 1;
        try_own(LINE, all.bytes + from, n, folder);
        try_own(SEALED, all.bytes + from, n, folder);
    }
    try_own(PARTS, all.bytes, all.length, folder);
    size_t n;
    static const char *sets[] = {"rock.diameter_m=1"};
    const struct part_inputs in = {.path = SCENE, .sets = {sets, 1}, .shelf = m.shelf};
    unsigned char *bytes = ceduo_part_inputs(&in, &n);
    try_own(INPUTS, bytes, n, folder);
    free(bytes);
    ceduo_text_free(&all);
    free_made(&m);
}

static void set_up(void)
{
    const char *folder = getenv("FUZZ_SEEDS");
    told = stderr;
    stderr = fopen("/dev/null", "w");
    try_lines(plain, folder);
    try_lines(spread, folder);
    try_without_files(NULL, folder);
    try_without_files("tests/fuzz/seeds/scene/small.yaml", folder);
    for (size_t k = 0; k < LENGTH(kinds); k++) {
        if (kinds[k].first > 0)
            before[k] = part_of(&kinds[k], 0, kinds[k].first);
        struct saved s = part_of(&kinds[k], kinds[k].first, kinds[k].rocks);
        try_own(POOLS + k, s.bytes, s.n, folder);
        free(s.bytes);
    }
    if (folder)
        exit(0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (!told)
        set_up();
    if (size > 0)
        (void)take(data, size);
    return 0;
}
