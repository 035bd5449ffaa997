/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "folder.h"
#include "local.h"
#include "table.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "io/file.h"
#include "model/document.h"
#include "scene/value.h"

static const char scene[] = "# my comment\n"
                            "ceduo: scene/1\n"
                            "title: \"T\"   # a title\n"
                            "rock: {diameter_m: 0.5, density_kg_m3: 2600}\n"
                            "slope:\n"
                            "  vertices_m: [[0, 50], [40, 20], [100, 0]] # a profile\n"
                            "  segments: [{rn: 0.3, rt: 0.8}, {rn: 0.35, rt: 0.85}]\n"
                            "controls: [{x_m: 90, name: road, accepted_kJ: 50}]\n"
                            "forest:\n"
                            "  - {from_m: 10, to_m: 80, stand: stand.yaml}   # below the rock\n";

static const char stand[] =
    "ceduo: stand/1\nname: S\nstools: {per_ha: 2000, spacing_m: 0.4}\n"
    "shoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]\ntrees: [{per_ha: 60, dbh_m: 0.2, height_m: 12}]\n";

static char path[256];
static struct document d;

static void write_file(const char *name, const char *text)
{
    char full[256];
    in_folder(full, name);
    assert_true(ceduo_file_write(full, text, strlen(text)));
}

static char *read_file(const char *name)
{
    char full[256];
    static char text[65536];
    in_folder(full, name);
    FILE *f = fopen(full, "r");
    assert_non_null(f);
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    fclose(f);
    return text;
}

static int set_up(void **state)
{
    (void)state;
    folder_make();
    setenv("XDG_STATE_HOME", folder, 1);
    char share[256], *profiles = realpath("profiles", NULL); /* the shipped profiles, as if they were installed */
    make_folder("share");
    in_folder(share, "share");
    setenv("XDG_DATA_HOME", share, 1);
    in_folder(share, "share/ceduo");
    assert_non_null(profiles);
    assert_int_equal(symlink(profiles, share), 0);
    free(profiles);
    in_folder(path, "scene.yaml");
    write_file("scene.yaml", scene);
    write_file("stand.yaml", stand);
    return 0;
}

static void close_scene(void)
{
    ceduo_document_close(&d);
}

static int tear_down(void **state)
{
    if (d.path)
        ceduo_recovery_delete(&d.recovery);
    close_scene();
    return folder_tear_down(state);
}

static void expect_success(bool passed)
{
    if (!passed)
        fail_msg("%s", ceduo_problems_print(&d.problems));
}

static void open_scene(void)
{
    close_scene();
    expect_success(ceduo_document_open(&d, path, NULL, 0));
}

static void set(const char *where, const char *value)
{
    expect_success(ceduo_document_set(&d, where, value));
}

static void set_millimetres(int mm)
{
    char value[16];
    snprintf(value, sizeof value, "0.%03d", mm);
    set("rock.diameter_m", value);
}

/* Save, and check that the file was laid out again, or kept its comments and its layout. */
static void save_as(const char *to, bool new_layout)
{
    bool laid_out;
    assert_true(ceduo_document_save(&d, to, &laid_out));
    assert_int_equal(laid_out, new_layout);
    assert_false(ceduo_document_unsaved(&d));
}

static void save(const char *to)
{
    save_as(to, false);
}

/* Return the recovery copy of unsaved work; NULL: none. */
static const char *read_copy(void)
{
    static char text[4096];
    FILE *f = fopen(d.recovery.path, "r");
    if (!f)
        return NULL;
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    fclose(f);
    return text;
}

/* Run steps set, save, undo and redo. Each is followed by the rock's diameter and, if that is unsaved, by !. A recovery copy
 * exists exactly while the shown state is unsaved. */
static void run_edits(const char *steps)
{
    char step[8], diameter[8], copied[64];
    int n = 0;
    for (; sscanf(steps, " %7[a-z]:%7[0-9.]%n", step, diameter, &n) == 2; steps += n) {
        bool unsaved = steps[n] == '!';
        n += unsaved;
        if (strcmp(step, "set") == 0)
            set("rock.diameter_m", diameter);
        else if (strcmp(step, "save") == 0)
            save(path);
        else
            assert_true(ceduo_document_undo_or_redo(&d, step[0] == 'u' ? -1 : 1));
        snprintf(copied, sizeof copied, "rock: {diameter_m: %s, ", diameter);
        if (d.file.scene.rock.diameter.mean != atof(diameter) || ceduo_document_unsaved(&d) != unsaved)
            fail_msg("%g, %d at %s", d.file.scene.rock.diameter.mean, ceduo_document_unsaved(&d), steps);
        if ((read_copy() != NULL) != unsaved || (unsaved && !strstr(read_copy(), copied)))
            fail_msg("copy %s at %s", read_copy() ? read_copy() : "none", steps);
    }
    assert_int_equal(*steps, '\0');
}

/* ---- saved in another folder ---- */

/* Write a scene into a/scenes, with its files in a/slopes and a/stands. b/stands has a different stand of the same name. */
static void scatter(const char *slope_reference)
{
    static const char *const folders[] = {"a", "a/scenes", "a/slopes", "a/stands", "a/more", "b", "b/scenes", "b/stands"};
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++)
        make_folder(folders[i]);
    char text[1024];
    snprintf(text, sizeof text,
             "# mine\nceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: %s\ncontrols: [{x_m: 90}]\nforest:\n"
             "  - {from_m: 10, to_m: 30, stand: ../stands/wood.yaml}\n"
             "  - {from_m: 40, to_m: 60, stand: {base: ../stands/wood.yaml, name: V}}\n"
             "  - {from_m: 70, to_m: 80, stand: ads-1}\n",
             slope_reference);
    write_file("a/scenes/s.yaml", text);
    write_file("a/slopes/line.csv", "distance,elevation\n0,50\n40,20\n100,0\n");
    write_file("a/slopes/line.yaml",
               "ceduo: slope/1\nvertices_m: [[0, 50], [40, 20], [100, 0]]\nsegments: [{rn: 0.3, rt: 0.8}]\n");
    write_file("a/slopes/by-csv.yaml", "ceduo: slope/1\ncsv: line.csv\nsegments: [{rn: 0.3, rt: 0.8}]\n");
    write_file("a/stands/wood.yaml", stand);
    write_file("b/stands/wood.yaml", "ceduo: stand/1\ntrees: [{per_ha: 7, dbh_m: 0.2, height_m: 12}]\n");
    in_folder(path, "a/scenes/s.yaml");
}

/* Check the values read from the files of `scatter`. */
static void expect_files(void)
{
    const struct ceduo_option *o = &d.file.scene.options[0];
    assert_int_equal(d.file.scene.slope.vertices, 3);
    assert_true(d.file.scene.slope.z[1] == -30);
    assert_true(o->belts[0].stand.stools_per_ha == 2000 && o->belts[1].stand.stools_per_ha == 2000);
    assert_string_equal(o->belts[1].name, "V");
    assert_string_equal(o->belts[2].name, "ADS 1");
}

static void reopen(const char *file)
{
    strcpy(path, file);
    open_scene();
    expect_files();
}

/* ---- steps ---- */

static size_t count_notes(void)
{
    size_t n = 0;
    for (const struct source_note *note = d.file.notes; note; note = note->before)
        n++;
    return n;
}

/* Return two changes of a row: PATH=VALUE, or a path to delete. */
static const struct changes *make_changes(const char *first, const char *second)
{
    static struct changes changes;
    changes = (struct changes){.document = &d};
    for (int i = 0; i < 2; i++) {
        const char *text = i == 0 ? first : second, *equals = strchr(text, '=');
        char where[256];
        snprintf(where, sizeof where, "%.*s", (int)strcspn(text, "="), text);
        ceduo_changes_add(&changes, equals ? CHANGE_SET : CHANGE_DELETE, where, equals ? equals + 1 : NULL);
    }
    return &changes;
}

/* Run one row of unit/documents.txt; false if it fails. */
static bool run_step(const char *const cell[TABLE_COLUMNS])
{
    static char remembered[65536], full[512];
    static size_t notes;
    const char *a = cell[1], *b = cell[2], *placeholder = strchr(b, '@'); /* replaced by the folder */
    const struct node *node = ceduo_document_node(&d, a);
    size_t i = (size_t)atoi(a), k = (size_t)atoi(b);
    struct value value;
    bool passed = true;
#define IS(word) (strcmp(cell[0], word) == 0)
    if (IS("file"))
        write_file(a, b);
    else if (IS("scatter"))
        scatter(a);
    else if (IS("files"))
        expect_files();
    else if (IS("open")) {
        if (*a)
            in_folder(path, a);
        open_scene();
    } else if (IS("save") || IS("lay-out")) {
        in_folder(full, a);
        save_as(*a ? full : path, IS("lay-out"));
    } else if (IS("edit"))
        run_edits(a);
    else if (IS("set"))
        set(a, b);
    else if (IS("refuse")) {
        size_t before = d.current;
        passed = !ceduo_document_set(&d, a, b) && strstr(ceduo_problems_print(&d.problems), cell[3]) && d.current == before;
    } else if (IS("set-all"))
        passed = ceduo_changes_apply(make_changes(a, b), cell[3]);
    else if (IS("duplicate"))
        passed = ceduo_document_duplicate(&d, a, k, *cell[3] ? make_changes(cell[3], cell[4]) : NULL);
    else if (IS("add"))
        passed = ceduo_document_add_option(&d, a, a);
    else if (IS("move"))
        passed = ceduo_document_move(&d, a, k, (size_t)atoi(cell[3]));
    else if (IS("split"))
        passed = ceduo_document_split_segment(&d, i, b, false);
    else if (IS("delete"))
        passed = ceduo_document_delete(&d, a);
    else if (IS("rename") || IS("cannot-rename"))
        passed = ceduo_document_rename_option(&d, i, b) == IS("rename");
    else if (IS("undo") || IS("cannot-undo"))
        passed = ceduo_document_undo_or_redo(&d, -1) == IS("undo");
    else if (IS("redo") || IS("cannot-redo"))
        passed = ceduo_document_undo_or_redo(&d, 1) == IS("redo");
    else if (IS("unsaved") || IS("saved"))
        passed = ceduo_document_unsaved(&d) == IS("unsaved");
    else if (IS("changed") || IS("unchanged"))
        passed = ceduo_document_changed_on_disk(&d) == IS("changed");
    else if (IS("assumed") || IS("known"))
        passed = ceduo_scene_assumes_value(&d.file, a) == IS("assumed");
    else if (IS("exists") || IS("missing"))
        passed = (node != NULL) == IS("exists");
    else if (IS("text"))
        passed = node && strcmp(node->text, b) == 0;
    else if (IS("number"))
        passed = ceduo_value_find(&d.file.scene, a, &value) && ceduo_value_get(&value) == atof(b);
    else if (IS("word"))
        passed = ceduo_value_find(&d.file.scene, a, &value) &&
                 strcmp(value.field->choices->names[(int)ceduo_value_get(&value)], b) == 0;
    else if (IS("vertices"))
        passed = d.file.scene.slope.vertices == i;
    else if (IS("inputs"))
        passed = d.file.inputs_count == i;
    else if (IS("observed-through")) /* option and name */
        passed = i < d.file.observations_count && d.file.observations[i].option == k &&
                 (!*cell[3] || strcmp(d.file.observations[i].name, cell[3]) == 0);
    else if (IS("remember"))
        strcpy(remembered, read_file(a));
    else if (IS("as-remembered"))
        passed = strcmp(remembered, read_file(a)) == 0;
    else if (IS("has") || IS("lacks")) {
        snprintf(full, sizeof full, "%.*s%s%s", placeholder ? (int)(placeholder - b) : 400, b, placeholder ? folder : "",
                 placeholder ? placeholder + 1 : "");
        passed = (strstr(read_file(a), full) != NULL) == IS("has");
    } else if (IS("notes")) { /* number of notes, equal to the last count if an argument is given */
        passed = !*a || count_notes() == notes;
        notes = count_notes();
    } else {
        fail_msg("unknown step '%s'", cell[0]);
    }
    return passed;
}

TEST(documents_pass_their_steps)
{
    const char *sections =
        "comments|base|deleted key|added key|slope|invalid|items|names|undo|branch|copy|source|source of a file|"
        "source of moved items|disk|other folder 1|other folder 2|other folder 3|other folder 4|next folder|profile|typed";
    for (char section[64]; next_word(&sections, section);) {
        assert_int_equal(set_up(NULL), 0);
        for (TABLE(row, "unit/documents.txt", section))
            if (!run_step(row.at))
                fail_msg("%s, step %zu: %s %s %s %s: %s", section, row.rows, row.at[0], row.at[1], row.at[2], row.at[3],
                         ceduo_problems_print(&d.problems));
        assert_int_equal(tear_down(NULL), 0);
    }
}

TEST_WITH(undo_and_redo, set_up, tear_down)
{
    open_scene();
    assert_false(ceduo_document_undo_or_redo(&d, -1));
    for (int i = 1; i <= 100; i++) {
        set_millimetres(i);
    }
    for (int i = 99; i >= 1; i--) {
        assert_true(ceduo_document_undo_or_redo(&d, -1));
        assert_true(d.file.scene.rock.diameter.mean == (double)i / 1000);
    }
    assert_true(ceduo_document_undo_or_redo(&d, -1));
    assert_false(ceduo_document_undo_or_redo(&d, -1));
    assert_false(ceduo_document_unsaved(&d));
    assert_true(ceduo_document_undo_or_redo(&d, 1));
    assert_true(d.file.scene.rock.diameter.mean == 0.001);
    set("rock.diameter_m", "0.9");
    assert_false(ceduo_document_undo_or_redo(&d, 1));
}

/* The older half of the states is dropped. The saved state is still recognized if it is among the rest. */
TEST_WITH(history_is_limited, set_up, tear_down)
{
    for (int saved = 0; saved <= 11; saved++) { /* 12 states: 0 is the file's, 1 to 11 are 0.101 to 0.111 m */
        write_file("scene.yaml", scene);
        open_scene();
        for (int i = 1; i <= 11; i++) {
            if (i == 11) /* pretend that it fills the history */
                d.file.arena.bytes += DOCUMENT_HISTORY_BYTES;
            set_millimetres(100 + i);
            if (i == saved)
                save(path);
        }
        for (int i = 11; i >= 5; i--) {
            assert_true(d.file.scene.rock.diameter.mean == (100 + i) / 1000.);
            assert_int_equal(ceduo_document_unsaved(&d), i != saved);
            assert_int_equal(ceduo_document_undo_or_redo(&d, -1), i > 5);
        }
        for (int i = 6; i <= 11; i++)
            assert_true(ceduo_document_undo_or_redo(&d, 1));
        assert_false(ceduo_document_undo_or_redo(&d, 1));
        for (int i = 12; i <= 20; i++) /* no state is dropped until the history is full again */
            set_millimetres(100 + i);
        for (int i = 19; i >= 5; i--) {
            assert_true(ceduo_document_undo_or_redo(&d, -1));
            assert_true(d.file.scene.rock.diameter.mean == (100 + i) / 1000.);
            assert_int_equal(ceduo_document_unsaved(&d), i != saved);
        }
        assert_false(ceduo_document_undo_or_redo(&d, -1));
    }
}

/* Return the recovery copy of a scene whose process has ended, and its path in `file`; NULL: none; caller frees. */
static char *read_abandoned_copy(const char *scene_path, char file[400])
{
    struct arena arena = {0};
    size_t n;
    char *text = NULL, *real = realpath(scene_path, NULL);
    const struct recovery *list = ceduo_recovery_list(&arena, &n);
    for (size_t i = 0; real && i < n; i++)
        if (list[i].scene && strcmp(list[i].scene, real) == 0) {
            text = ceduo_recovery_text(list[i].file);
            snprintf(file, 400, "%s", list[i].file);
        }
    free(real);
    ceduo_arena_free(&arena);
    return text;
}

TEST_WITH(unsaved_work_is_recovered, set_up, tear_down)
{
    char file[400];
    assert_null(read_abandoned_copy(path, file));
    pid_t child = fork();
    if (child == 0) { /* a program that ends without saving */
        open_scene();
        set("rock.diameter_m", "0.123");
        _exit(0);
    }
    int status;
    assert_true(waitpid(child, &status, 0) == child && status == 0);
    char *text = read_abandoned_copy(path, file);
    assert_non_null(text);
    open_scene();
    assert_true(ceduo_document_recover(&d, text));
    assert_true(d.file.scene.rock.diameter.mean == 0.123);
    assert_true(ceduo_document_undo_or_redo(&d, -1));
    assert_true(d.file.scene.rock.diameter.mean == 0.5);
    free(text);
    assert_false(ceduo_document_recover(&d, "[a, list]")); /* not a scene */
    assert_non_null(strstr(ceduo_problems_print(&d.problems), "expected a mapping, not a list"));
    assert_true(d.file.scene.rock.diameter.mean == 0.5);
}

/* Remains of a copy whose writer was killed are not offered for recovery: they may be incomplete. */
TEST_WITH(an_incomplete_copy_is_removed, set_up, tear_down)
{
    struct recovery_copy own = ceduo_recovery_begin(path);
    char file[400], names[2][400];
    assert_non_null(own.path);
    int n = (int)(strrchr(own.path, '-') - own.path); /* up to the process id */
    snprintf(names[0], sizeof names[0], "%.*s-999999999.yaml.ceduo-tmp-999999999-0", n, own.path);
    snprintf(names[1], sizeof names[1], "%.*s-999999999.yam", n, own.path);
    for (int i = 0; i < 2; i++) {
        FILE *f = fopen(names[i], "w");
        assert_non_null(f);
        fputs("rock: {", f);
        fclose(f);
    }
    assert_null(read_abandoned_copy(path, file));
    assert_int_equal(access(names[0], F_OK), -1);
    assert_int_equal(access(names[1], F_OK), 0); /* not a copy of ceduo */
    ceduo_recovery_end(&own);
}

/* The lock decides if a copy's process has ended, not the process id in its name: two machines may share the folder. */
TEST_WITH(a_locked_copy_is_not_offered, set_up, tear_down)
{
    char file[400], copy[400], renamed[400], ready;
    int to_parent[2], to_child[2];
    assert_int_equal(pipe(to_parent) + pipe(to_child), 0);
    pid_t child = fork();
    if (child == 0) { /* a program on another machine: its id is that of no process here */
        open_scene();
        for (int mm = 1; mm < 4; mm++) /* each edit is a new file */
            set_millimetres(mm);
        snprintf(copy, sizeof copy, "%s", d.recovery.path);
        snprintf(renamed, sizeof renamed, "%.*s-999999999.yaml", (int)(strrchr(copy, '-') - copy), copy);
        bool passed = rename(copy, renamed) == 0 && write(to_parent[1], "r", 1) == 1;
        close(to_child[1]);
        passed &= read(to_child[0], &ready, 1) == 0; /* until the test ends */
        _exit(!passed);
    }
    assert_int_equal(read(to_parent[0], &ready, 1), 1);
    assert_null(read_abandoned_copy(path, file));
    int status;
    assert_int_equal(kill(child, SIGKILL), 0);
    assert_true(waitpid(child, &status, 0) == child);
    char *text = read_abandoned_copy(path, file);
    assert_non_null(text);
    free(text);
    /* its id is that of a process of this machine */
    snprintf(renamed, sizeof renamed, "%.*s-%ld.yaml", (int)(strrchr(file, '-') - file), file, (long)getppid());
    assert_int_equal(rename(file, renamed), 0);
    text = read_abandoned_copy(path, file);
    assert_non_null(text);
    free(text);
    for (int i = 0; i < 2; i++) {
        close(to_parent[i]);
        close(to_child[i]);
    }
}

TEST_WITH(a_copy_is_readable_by_its_owner_only, set_up, tear_down)
{
    struct stat st;
    mode_t mask = umask(0);
    open_scene();
    set("rock.diameter_m", "0.2");
    umask(mask);
    assert_int_equal(stat(d.recovery.path, &st), 0);
    assert_int_equal(st.st_mode & 07777, 0600);
}

/* Quotes and blanks at the ends of name and title are preserved. */
TEST_WITH(a_copy_preserves_name_and_title, set_up, tear_down)
{
    char other[400];
    struct arena arena = {0};
    size_t n;
    snprintf(other, sizeof other, "%.240s \"b\" ", path);
    pid_t child = fork();
    if (child == 0) {
        bool laid_out;
        open_scene();
        bool saved = ceduo_document_save(&d, other, &laid_out);
        set("title", "'\"bosco\" d''alto'");
        _exit(!saved);
    }
    int status;
    assert_true(waitpid(child, &status, 0) == child && status == 0);
    const struct recovery *list = ceduo_recovery_list(&arena, &n);
    assert_int_equal(n, 1);
    assert_string_equal(list[0].scene, other);
    assert_string_equal(list[0].title, "\"bosco\" d'alto");
    unlink(list[0].file);
    unlink(other);
    ceduo_arena_free(&arena);
}

/* Independent of their order in the folder. */
TEST_WITH(the_newest_copies_come_first, set_up, tear_down)
{
    static const time_t when[] = {3000, 1000, 5000, 2000, 4000};
    struct recovery_copy own = ceduo_recovery_begin(path);
    struct arena arena = {0};
    size_t n;
    for (int i = 0; i < 5; i++) {
        char name[400];
        snprintf(name, sizeof name, "%.*s-%d.yaml", (int)(strrchr(own.path, '-') - own.path), own.path, 999999990 + i);
        FILE *f = fopen(name, "w");
        assert_non_null(f);
        fputs("# unsaved work on /a/scene\ntitle: t\n", f);
        fclose(f);
        assert_int_equal(utimensat(AT_FDCWD, name, (struct timespec[]){{.tv_sec = when[i]}, {.tv_sec = when[i]}}, 0), 0);
    }
    const struct recovery *list = ceduo_recovery_list(&arena, &n);
    assert_int_equal(n, 5);
    for (int i = 0; i < 5; i++)
        assert_int_equal(list[i].when, 5000 - 1000 * i);
    ceduo_arena_free(&arena);
    ceduo_recovery_end(&own);
}

TEST_WITH(unsaved_work_belongs_to_the_saved_name, set_up, tear_down)
{
    char file[400], other[256];
    snprintf(other, sizeof other, "%.240s-other", path);
    pid_t child = fork();
    if (child == 0) {
        open_scene();
        set("rock.diameter_m", "0.2");
        bool laid_out, saved = ceduo_document_save(&d, other, &laid_out);
        set("rock.diameter_m", "0.3");
        _exit(!saved);
    }
    int status;
    assert_true(waitpid(child, &status, 0) == child && status == 0);
    assert_null(read_abandoned_copy(path, file));
    char *text = read_abandoned_copy(other, file);
    assert_non_null(text);
    unlink(file);
    unlink(other);
    free(text);
}

static void set_time(const char *file, time_t seconds, long nanoseconds)
{
    const struct timespec times[2] = {{.tv_nsec = UTIME_OMIT}, {.tv_sec = seconds, .tv_nsec = nanoseconds}};
    assert_int_equal(utimensat(AT_FDCWD, file, times, 0), 0);
}

/* Length, second and fraction of a second of the last write are each enough. */
TEST_WITH(a_file_of_the_same_length_is_noticed, set_up, tear_down)
{
    char other[sizeof scene + 1];
    strcpy(other, scene);
    set_time(path, 1000000000, 500000000);
    open_scene();
    memcpy(strstr(other, "0.5"), "0.9", 3);
    write_file("scene.yaml", other);
    set_time(path, 1000000000, 500000001);
    assert_true(ceduo_document_changed_on_disk(&d));
    set_time(path, 1000000001, 500000000);
    assert_true(ceduo_document_changed_on_disk(&d));
    strcat(other, "\n");
    write_file("scene.yaml", other);
    set_time(path, 1000000000, 500000000);
    assert_true(ceduo_document_changed_on_disk(&d));
    write_file("scene.yaml", scene);
    set_time(path, 1000000000, 500000000);
    assert_false(ceduo_document_changed_on_disk(&d));
    assert_int_equal(unlink(path), 0);
    assert_true(ceduo_document_changed_on_disk(&d));
}

/* Work on a scene saved in another folder can be recovered there. */
TEST_WITH(a_copy_refers_to_the_same_files, set_up, tear_down)
{
    char other[256], text[4096];
    scatter("../slopes/by-csv.yaml");
    open_scene();
    in_folder(other, "b/scenes/t.yaml");
    save(other);
    set("slope.facets", "both");
    set("forest[0].stand.trees[0].per_ha", "50");
    assert_non_null(read_copy());
    strcpy(text, read_copy());
    ceduo_recovery_delete(&d.recovery);
    reopen(other);
    expect_success(ceduo_document_recover(&d, text));
    expect_files();
    assert_true(d.file.scene.options[0].belts[0].stand.trees[0].per_ha == 50);
}

/* A simplified profile and its assumption are kept by other edits and computed again if the release moves. A release at 50 m
 * keeps the one point that a tolerance of 0.25 m keeps and 1 m omits. */
TEST(a_simplified_profile_is_kept)
{
    static const char text[] =
        "ceduo: scene/1\nrock: {diameter_m: 1}\ncontrols_m: [90]\nrelease: {x_m: 0}\n"
        "slope: {vertices_m: [[0, 100], [50, 50.9], [100, 0]], materials: [{from_m: 0, to_m: 100, material: "
        "talus}]}\n";
    static const struct {
        const char *path, *value;
        bool assumed;
    } edits[] = {{"simulation.rocks", "50", true},
                 {"release.x_m", "50", false},
                 {"simulation.rocks", "60", false},
                 {"release.x_m", "0", true},
                 {"rock.diameter_m", "2", true}};
    struct document own;
    assert_true(ceduo_document_new(&own, text));
    assert_true(ceduo_notes_print(own.file.notes, "assumed", "slope.tolerance_m"));
    for (size_t i = 0; i < LENGTH(edits); i++) {
        assert_true(ceduo_document_set(&own, edits[i].path, edits[i].value));
        assert_int_equal(ceduo_notes_print(own.file.notes, "assumed", "slope.tolerance_m"), edits[i].assumed);
    }
    ceduo_document_close(&own);
}
