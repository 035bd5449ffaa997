/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "folder.h"
#include "local.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "ceduo/observe.h"
#include "io/file.h"
#include "model/document.h"

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
static struct problems problems;

static void write_file(const char *name, const char *text)
{
    char whole[256];
    in_folder(whole, name);
    assert_true(ceduo_file_write(whole, text, strlen(text)));
}

static char *read_file(const char *name)
{
    char whole[256];
    static char text[65536];
    in_folder(whole, name);
    FILE *f = fopen(whole, "r");
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
    char share[256], *profiles = realpath("profiles", NULL); /* the shipped stands, as if they were installed */
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
    ceduo_problems_free(&problems);
}

static int tear_down(void **state)
{
    if (d.path)
        ceduo_document_forget(&d);
    close_scene();
    return folder_tear_down(state);
}

static void must(bool good)
{
    if (!good)
        fail_msg("%s", problems.text.bytes);
}

static void open_scene(void)
{
    close_scene();
    must(ceduo_document_open(&d, path, &problems));
}

static void set(const char *where, const char *value)
{
    must(ceduo_document_set(&d, where, value, &problems));
}

static void refuse(const char *where, const char *value, const char *why)
{
    LOCAL_BY(ceduo_problems_free) struct problems found = {0};
    size_t before = d.at;
    assert_false(ceduo_document_set(&d, where, value, &found));
    assert_non_null(strstr(found.text.bytes, why));
    assert_int_equal(d.at, before);
}

static void set_millimetres(int mm)
{
    char value[16];
    snprintf(value, sizeof value, "0.%03d", mm);
    set("rock.diameter_m", value);
}

/* Laid out anew, or with what its lines say beside their values. */
static void save_as(const char *to, bool laid_out_anew)
{
    bool anew;
    assert_true(ceduo_document_save(&d, to, &anew));
    assert_int_equal(anew, laid_out_anew);
    assert_false(ceduo_document_unsaved(&d));
}

static void save(const char *to)
{
    save_as(to, false);
}

/* The copy that is kept of unsaved work; NULL: there is none. */
static const char *copy_of(void)
{
    static char text[4096];
    FILE *f = fopen(d.recovery, "r");
    if (!f)
        return NULL;
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    fclose(f);
    return text;
}

/* Steps, each with the rock's diameter after it and ! where that is not saved: set, save, undo and redo. A copy is kept of
 * what is shown for just as long as that is not what is on disk. */
static void walk(const char *steps)
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
            assert_true(step[0] == 'u' ? ceduo_document_undo(&d) : ceduo_document_redo(&d));
        snprintf(copied, sizeof copied, "rock: {diameter_m: %s, ", diameter);
        if (d.file.scene.rock.diameter.mean != atof(diameter) || ceduo_document_unsaved(&d) != unsaved)
            fail_msg("%g, %d at %s", d.file.scene.rock.diameter.mean, ceduo_document_unsaved(&d), steps);
        if ((copy_of() != NULL) != unsaved || (unsaved && !strstr(copy_of(), copied)))
            fail_msg("%s is the copy at %s", copy_of() ? copy_of() : "none", steps);
    }
    assert_int_equal(*steps, '\0');
}

static void expect_in(const char *file, const char *words)
{
    if (!strstr(read_file(file), words))
        fail_msg("%s is missing in\n%s", words, read_file(file));
}

TEST_WITH(changed_values_keep_comments, set_up, tear_down)
{
    open_scene();
    assert_false(ceduo_document_unsaved(&d));
    set("rock.diameter_m", "0.75");
    set("title", "\"Above: the mill\"");
    assert_true(ceduo_document_unsaved(&d));
    save(path);
    const char *text = read_file("scene.yaml");
    assert_non_null(strstr(text, "# my comment\n"));
    assert_non_null(strstr(text, "title: \"Above: the mill\"   # a title\n"));
    assert_non_null(strstr(text, "rock: {diameter_m: 0.75, density_kg_m3: 2600}\n"));
    assert_non_null(strstr(text, "stand: stand.yaml}   # below the rock\n"));
}

TEST_WITH(a_changed_stand_starts_from_its_file, set_up, tear_down)
{
    open_scene();
    set("forest[0].stand.stools.per_ha", "2500");
    for (int i = 0; i < 2; i++) { /* saving twice says the same */
        save(path);
        const char *text = read_file("scene.yaml");
        assert_non_null(strstr(text, "base: stand.yaml"));
        assert_non_null(strstr(text, "# below the rock"));
        assert_non_null(strstr(text, "2500"));
        assert_null(strstr(text, "6000"));
        set("rock.diameter_m", "0.6");
    }
    assert_string_equal(read_file("stand.yaml"), stand);
    open_scene();
    assert_true(d.file.scene.options[0].belts[0].stand.stools_per_ha == 2500);
    assert_true(d.file.scene.options[0].belts[0].stand.spacing == 0.4);
}

/* What its file does not have at all is added to it as well. */
TEST_WITH(a_stand_is_given_more, set_up, tear_down)
{
    open_scene();
    set("forest[0].stand.species", "fagus-sylvatica");
    save(path);
    expect_in("scene.yaml", "stand: {base: stand.yaml, species: fagus-sylvatica}}   # below the rock\n");
    open_scene();
    assert_int_equal(d.file.scene.options[0].belts[0].stand.species, ceduo_species_find("fagus-sylvatica"));
}

/* A slope has no base: one that is changed is written out, and its file stays. */
TEST_WITH(a_changed_slope_is_written_out, set_up, tear_down)
{
    static const char slope[] = "ceduo: slope/1\nvertices_m: [[0, 50], [100, 0]]\nsegments: [{rn: 0.3, rt: 0.8}]\n"
                                "source: {kind: assumed, text: by hand}\n";
    write_file("slope.yaml", slope);
    write_file("scene.yaml", "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: slope.yaml # mine\ncontrols_m: [90]\n");
    open_scene();
    size_t before = 0, now = 0;
    for (const struct source_note *n = d.file.notes; n; n = n->before)
        before++;
    set("rock.diameter_m", "0.6"); /* the slope is as it was made before, and so is what is said of it */
    for (const struct source_note *n = d.file.notes; n; n = n->before)
        now++;
    assert_int_equal(now, before);
    assert_true(ceduo_scene_assumes_value(&d.file, "slope.vertices_m"));
    set("slope.facets", "both");
    save(path);
    assert_string_equal(read_file("slope.yaml"), slope);
    const char *text = read_file("scene.yaml");
    assert_non_null(strstr(text, "facets: both"));
    assert_non_null(strstr(text, "vertices_m: [[0, 50], [100, 0]]"));
    assert_null(strstr(text, "slope.yaml"));
    open_scene();
    assert_true(d.file.scene.slope.facets == CEDUO_BOTH && d.file.scene.slope.vertices == 2);
}

TEST_WITH(what_is_wrong_changes_nothing, set_up, tear_down)
{
    open_scene();
    refuse("rock.diameter_m", "-1", "-1 is below 0 m");
    refuse("rock.diameter_m", "0,5", "decimal comma: write 0.5");
    refuse("forest[0].to_m", "400", "beyond the slope");
    refuse("rock.size", "1", "unknown key");
    assert_true(d.file.scene.rock.diameter.mean == 0.5);
    assert_false(ceduo_document_unsaved(&d));
}

TEST_WITH(undo_and_redo, set_up, tear_down)
{
    open_scene();
    assert_false(ceduo_document_undo(&d));
    for (int i = 1; i <= 100; i++) {
        set_millimetres(i);
    }
    for (int i = 99; i >= 1; i--) {
        assert_true(ceduo_document_undo(&d));
        assert_true(d.file.scene.rock.diameter.mean == (double)i / 1000);
    }
    assert_true(ceduo_document_undo(&d));
    assert_false(ceduo_document_undo(&d));
    assert_false(ceduo_document_unsaved(&d));
    assert_true(ceduo_document_redo(&d));
    assert_true(d.file.scene.rock.diameter.mean == 0.001);
    set("rock.diameter_m", "0.9");
    assert_false(ceduo_document_redo(&d));
}

TEST_WITH(options_belts_and_segments, set_up, tear_down)
{
    open_scene();
    assert_true(ceduo_document_duplicate(&d, "options", 0, NULL, NULL, &problems));
    assert_int_equal(d.file.scene.options_count, 2);
    assert_string_equal(d.file.scene.options[0].name, "current");
    assert_string_equal(d.file.scene.options[1].name, "current (2)");
    assert_true(ceduo_document_add_option(&d, "large-reserves-cut", &problems));
    assert_string_equal(d.file.scene.options[2].name, "large-reserves-cut");
    assert_true(d.file.scene.options[2].belts[0].to == 80);
    assert_true(ceduo_document_move(&d, "options", 2, 0, &problems));
    assert_string_equal(d.file.scene.options[0].name, "large-reserves-cut");
    assert_true(ceduo_document_duplicate(&d, "options[1].forest", 0, "options[1].forest[0].to_m=45",
                                         "options[1].forest[1].from_m=45", &problems));
    assert_int_equal(d.file.scene.options[1].belts_count, 2);
    assert_true(ceduo_document_split_segment(&d, 0, "[20, 35]", false, &problems));
    assert_int_equal(d.file.scene.slope.vertices, 4);
    assert_true(d.file.scene.slope.segments[1].rn.mean == 0.3);
    assert_true(ceduo_document_delete(&d, "options[2]", &problems));
    assert_int_equal(d.file.scene.options_count, 2);
    const char *const stools_and_shoots[] = {"options[1].forest[0].stand.stools", "options[1].forest[0].stand.shoots"};
    assert_true(ceduo_document_set_all(&d, stools_and_shoots, 2, "shoots", &problems));
    assert_int_equal(d.file.scene.options[1].belts[0].stand.shoots_count, 0);
    save_as(path, true);
    open_scene();
    assert_int_equal(d.file.scene.options_count, 2);
    assert_int_equal(d.file.scene.options[1].belts_count, 2);
    assert_int_equal(d.file.scene.options[1].belts[0].stand.shoots_count, 0);
    assert_int_equal(d.file.scene.options[1].belts[1].stand.shoots_count, 1);
    assert_int_equal(d.file.scene.slope.vertices, 4);
}

static const char of_two[] = "ceduo: scene/1\n"
                             "rock: {diameter_m: 0.5, density_kg_m3: 2600}\n"
                             "slope: {vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
                             "controls_m: [90]\n"
                             "options:\n"
                             "  - {name: bare}\n"
                             "  - {name: thick, forest: [{from_m: 10, to_m: 80, stand: stand.yaml}]}\n"
                             "doubt:\n"
                             "  - {path: \"options[thick].forest[0].to_m\", lo: 70, hi: 80}\n"
                             "  - {path: \"slope.segments[0].rn\", lo: 0.2, hi: 0.4}\n"
                             "observed:\n"
                             "  - {option: thick, name: thick, stops: {x_m: [40, 60]}}\n"
                             "  - {passed: {x_m: 80, count: 1, of: 9, option: thick}}\n"
                             "  - {option: bare, passed: {x_m: 80, count: 8, of: 9}}\n";

/* What was seen through an option's forest, and what is in doubt about it, stay with it once it has another name. */
TEST_WITH(an_option_takes_along_what_names_it, set_up, tear_down)
{
    write_file("two.yaml", of_two);
    in_folder(path, "two.yaml");
    open_scene();
    assert_int_equal(d.file.inputs_count, 2);
    assert_true(ceduo_document_rename_option(&d, 1, "2 \"thick]", &problems));
    assert_string_equal(d.file.scene.options[1].name, "2 \"thick]");
    assert_int_equal(d.file.observations_count, 3);
    assert_int_equal(d.file.observations[0].option, 1);
    assert_string_equal(d.file.observations[0].name, "thick");
    assert_int_equal(d.file.observations[1].option, 1);
    assert_int_equal(d.file.observations[2].option, 0);
    assert_int_equal(d.file.inputs_count, 2);
    save(path);
    expect_in("two.yaml", "options[1].forest[0].to_m");
    assert_true(ceduo_document_undo(&d)); /* one state */
    assert_string_equal(d.file.scene.options[1].name, "thick");
    assert_int_equal(d.file.observations[0].option, 1);
    assert_false(ceduo_document_undo(&d));
    assert_false(ceduo_document_rename_option(&d, 1, "bare", &problems));
    assert_string_equal(d.file.scene.options[1].name, "thick");
    open_scene();
    assert_int_equal(d.file.observations[1].option, 1);
}

/* Back to the state on disk is saved, whichever way it is come to; any other state is not. */
TEST_WITH(undo_leads_back_to_what_is_saved, set_up, tear_down)
{
    open_scene();
    walk("set:0.6! save:0.6 set:0.7! undo:0.6 undo:0.5! redo:0.6 set:0.8! undo:0.6");
}

/* An edit from before what is saved takes its place: no way leads back to it, though as many steps from the start. */
TEST_WITH(a_branch_leaves_what_is_saved_behind, set_up, tear_down)
{
    open_scene();
    walk("set:0.6! save:0.6 undo:0.5! set:0.7!");
    assert_false(ceduo_document_redo(&d));
    walk("undo:0.5! redo:0.7! set:0.8! save:0.8 undo:0.7! redo:0.8");
}

/* The oldest states are forgotten, half of them; what is on disk is known again where it is among those that are left. */
TEST_WITH(history_is_cut, set_up, tear_down)
{
    for (int saved = 0; saved <= 11; saved++) { /* of 12 states: 0 is the file's, 1 to 11 are 0.101 to 0.111 m */
        write_file("scene.yaml", scene);
        open_scene();
        for (int i = 1; i <= 11; i++) {
            if (i == 11) /* as if it took up all that history may */
                d.file.arena.bytes += DOCUMENT_HISTORY_BYTES;
            set_millimetres(100 + i);
            if (i == saved)
                save(path);
        }
        for (int i = 11; i >= 5; i--) {
            assert_true(d.file.scene.rock.diameter.mean == (100 + i) / 1000.);
            assert_int_equal(ceduo_document_unsaved(&d), i != saved);
            assert_int_equal(ceduo_document_undo(&d), i > 5);
        }
        for (int i = 6; i <= 11; i++)
            assert_true(ceduo_document_redo(&d));
        assert_false(ceduo_document_redo(&d));
        for (int i = 12; i <= 20; i++) /* no more goes until as much again is taken up */
            set_millimetres(100 + i);
        for (int i = 19; i >= 5; i--) {
            assert_true(ceduo_document_undo(&d));
            assert_true(d.file.scene.rock.diameter.mean == (100 + i) / 1000.);
            assert_int_equal(ceduo_document_unsaved(&d), i != saved);
        }
        assert_false(ceduo_document_undo(&d));
    }
}

TEST_WITH(a_changed_value_has_no_source, set_up, tear_down)
{
    write_file("scene.yaml", "# mine\nceduo: scene/1\nrock: {diameter_m: 0.5}\n"
                             "slope: {vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
                             "controls:\n  - x_m: 90\n    accepted_kJ: 50 # a wall\n"
                             "    source: {kind: assumed, text: a guess}\n");
    open_scene();
    assert_true(ceduo_scene_assumes_value(&d.file, "controls[0].accepted_kJ"));
    set("controls[0].accepted_kJ", "60");
    assert_false(ceduo_scene_assumes_value(&d.file, "controls[0].accepted_kJ"));
    assert_true(ceduo_scene_assumes_value(&d.file, "controls[0].x_m"));
    assert_true(ceduo_document_undo(&d));
    assert_true(ceduo_scene_assumes_value(&d.file, "controls[0].accepted_kJ"));
    assert_true(ceduo_document_redo(&d));
    save(path);
    expect_in("scene.yaml", "    accepted_kJ: 60 # a wall\n"
                            "    source: {kind: assumed, text: a guess, except: [accepted_kJ]}\n");
    open_scene(); /* the file says so, too */
    assert_false(ceduo_scene_assumes_value(&d.file, "controls[0].accepted_kJ"));
    assert_true(ceduo_scene_assumes_value(&d.file, "controls[0].x_m"));
}

/* A source that stands in another file stays there: what is saved of the stand says what it is not of. */
TEST_WITH(a_changed_value_of_another_file_has_no_source, set_up, tear_down)
{
    LOCAL_TEXT(with_source);
    ceduo_text_format(&with_source, "%ssource: {kind: assumed, text: a guess}\n", stand);
    write_file("stand.yaml", with_source.bytes);
    open_scene();
    const char *const of_it = "forest[0].stand.stools.spacing_m", *const changed = "forest[0].stand.stools.per_ha";
    set(changed, "2500");
    assert_false(ceduo_scene_assumes_value(&d.file, changed));
    save(path);
    assert_string_equal(read_file("stand.yaml"), with_source.bytes);
    expect_in("scene.yaml", "source: {kind: assumed, text: a guess, except: [stools.per_ha]}");
    open_scene();
    assert_false(ceduo_scene_assumes_value(&d.file, changed));
    assert_true(ceduo_scene_assumes_value(&d.file, of_it));
}

TEST_WITH(what_only_moves_keeps_its_source, set_up, tear_down)
{
    write_file("scene.yaml", "ceduo: scene/1\nsource: {kind: assumed, text: all}\nrock: {diameter_m: 0.5}\n"
                             "slope: {vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
                             "controls: [{x_m: 90}]\noptions: [{name: a, forest: [{from_m: 10, to_m: 40, stand: stand.yaml}]}, "
                             "{name: b}]\n");
    open_scene();
    assert_true(ceduo_document_duplicate(&d, "options", 0, NULL, NULL, &problems));
    assert_true(ceduo_document_move(&d, "options", 2, 0, &problems));
    assert_true(ceduo_document_delete(&d, "options[1]", &problems));
    assert_string_equal(d.file.scene.options[1].name, "a (2)");
    assert_true(ceduo_scene_assumes_value(&d.file, "options[1].forest[0].to_m"));
    assert_null(ceduo_document_node(&d, "source.except"));
    set("options[1].forest[0].to_m", "45");
    assert_false(ceduo_scene_assumes_value(&d.file, "options[1].forest[0].to_m"));
    assert_non_null(ceduo_document_node(&d, "source.except"));
}

/* The copy of a scene whose process has ended, and in `file` where it lies; NULL: none. To be freed. */
static char *left_of(const char *of, char file[400])
{
    struct arena arena = {0};
    size_t n;
    char *text = NULL, *real = realpath(of, NULL);
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

TEST_WITH(unsaved_work_is_found_again, set_up, tear_down)
{
    char file[400];
    assert_null(left_of(path, file));
    pid_t child = fork();
    if (child == 0) { /* a program that ends without a word */
        open_scene();
        set("rock.diameter_m", "0.123");
        _exit(0);
    }
    int status;
    assert_true(waitpid(child, &status, 0) == child && status == 0);
    char *text = left_of(path, file);
    assert_non_null(text);
    open_scene();
    assert_true(ceduo_document_recover(&d, text, &problems));
    assert_true(d.file.scene.rock.diameter.mean == 0.123);
    assert_true(ceduo_document_undo(&d));
    assert_true(d.file.scene.rock.diameter.mean == 0.5);
    free(text);
    assert_false(ceduo_document_recover(&d, "[a, list]", &problems)); /* which is no scene */
    assert_non_null(strstr(problems.text.bytes, "expected a mapping, not a list"));
    assert_true(d.file.scene.rock.diameter.mean == 0.5);
}

/* What is left of a copy whose writer was killed is not offered as work: it may be half of it. */
TEST_WITH(half_a_copy_is_taken_away, set_up, tear_down)
{
    char *own = ceduo_recovery_path(path), file[400], names[2][400];
    assert_non_null(own);
    int n = (int)(strrchr(own, '-') - own); /* what stands before the process */
    snprintf(names[0], sizeof names[0], "%.*s-999999999.yaml.ceduo-tmp-999999999-0", n, own);
    snprintf(names[1], sizeof names[1], "%.*s-999999999.yam", n, own);
    for (int i = 0; i < 2; i++) {
        FILE *f = fopen(names[i], "w");
        assert_non_null(f);
        fputs("rock: {", f);
        fclose(f);
    }
    assert_null(left_of(path, file));
    assert_int_equal(access(names[0], F_OK), -1);
    assert_int_equal(access(names[1], F_OK), 0); /* somebody else's */
    free(own);
}

/* In whatever order the folder has them. */
TEST_WITH(the_newest_copies_come_first, set_up, tear_down)
{
    static const time_t when[] = {3000, 1000, 5000, 2000, 4000};
    char *own = ceduo_recovery_path(path);
    struct arena arena = {0};
    size_t n;
    for (int i = 0; i < 5; i++) {
        char name[400];
        snprintf(name, sizeof name, "%.*s-%d.yaml", (int)(strrchr(own, '-') - own), own, 999999990 + i);
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
    free(own);
}

/* It holds what is shown, after an undo too, and is there just as long as that is not what is on disk. */
TEST_WITH(the_copy_follows_undo, set_up, tear_down)
{
    open_scene();
    assert_null(copy_of());
    walk("set:0.6! set:0.7! undo:0.6! redo:0.7! undo:0.6! undo:0.5 redo:0.6! save:0.6 redo:0.7! undo:0.6 undo:0.5! set:0.8!");
}

TEST_WITH(unsaved_work_belongs_to_the_name_saved_under, set_up, tear_down)
{
    char file[400], other[256];
    snprintf(other, sizeof other, "%.240s-other", path);
    pid_t child = fork();
    if (child == 0) {
        open_scene();
        set("rock.diameter_m", "0.2");
        bool anew, saved = ceduo_document_save(&d, other, &anew);
        set("rock.diameter_m", "0.3");
        _exit(!saved);
    }
    int status;
    assert_true(waitpid(child, &status, 0) == child && status == 0);
    assert_null(left_of(path, file));
    char *text = left_of(other, file);
    assert_non_null(text);
    unlink(file);
    unlink(other);
    free(text);
}

TEST_WITH(a_file_changed_on_disk_is_noticed, set_up, tear_down)
{
    open_scene();
    assert_false(ceduo_document_changed_on_disk(&d));
    write_file("scene.yaml", "# somebody else\n");
    assert_true(ceduo_document_changed_on_disk(&d));
    save(path);
    assert_false(ceduo_document_changed_on_disk(&d));
}

static void set_time(const char *file, time_t seconds, long nanoseconds)
{
    const struct timespec times[2] = {{.tv_nsec = UTIME_OMIT}, {.tv_sec = seconds, .tv_nsec = nanoseconds}};
    assert_int_equal(utimensat(AT_FDCWD, file, times, 0), 0);
}

/* Its length, the second and the fraction of it in which it was written: each tells by itself. */
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

/* ---- saved elsewhere ---- */

/* A scene in a/scenes whose files lie in a/slopes and a/stands; b/stands has another stand of the same name. */
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

/* What the files lead to, whatever else was changed. */
static void expect_files(void)
{
    const struct ceduo_option *o = &d.file.scene.options[0];
    assert_int_equal(d.file.scene.slope.vertices, 3);
    assert_true(d.file.scene.slope.z[1] == -30);
    assert_true(o->belts[0].stand.stools_per_ha == 2000 && o->belts[1].stand.stools_per_ha == 2000);
    assert_string_equal(o->belts[1].name, "V");
    assert_string_equal(o->belts[2].name, "ADS 1");
}

static void reopen(const char *at)
{
    strcpy(path, at);
    open_scene();
    expect_files();
}

static const char *const slopes[] = {"../slopes/line.yaml", "../slopes/line.csv",
                                     "{csv: ../slopes/line.csv, segments: [{rn: 0.3, rt: 0.8}]}", "../slopes/by-csv.yaml"};

TEST_WITH(references_lead_to_the_same_files_from_elsewhere, set_up, tear_down)
{
    for (size_t i = 0; i < sizeof slopes / sizeof slopes[0]; i++) {
        char there[256], text[4096], wanted[256];
        if (i > 0)
            assert_true(folder_tear_down(NULL) == 0 && set_up(NULL) == 0);
        scatter(slopes[i]);
        open_scene();
        in_folder(there, "b/scenes/t.yaml");
        save(there);
        strcpy(text, read_file("b/scenes/t.yaml"));
        assert_non_null(strstr(text, "# mine\n"));
        assert_null(strstr(text, "../"));
        assert_non_null(strstr(text, "stand: ads-1}")); /* the same from everywhere */
        snprintf(wanted, sizeof wanted, "stand: {base: %s/a/stands/wood.yaml, name: V}", folder);
        assert_non_null(strstr(text, wanted));
        save(there); /* once more, though what was read still says ../ */
        assert_string_equal(read_file("b/scenes/t.yaml"), text);
        set("rock.diameter_m", "0.75");
        save(there);
        reopen(there);
        assert_true(d.file.scene.rock.diameter.mean == 0.75);
    }
}

/* Beside the old one they stay as they were written. */
TEST_WITH(references_stay_where_they_lead_to_the_same, set_up, tear_down)
{
    char there[256], text[4096];
    scatter(slopes[0]);
    open_scene();
    in_folder(there, "a/more/t.yaml");
    save(there);
    strcpy(text, read_file("a/more/t.yaml"));
    assert_string_equal(text, read_file("a/scenes/s.yaml"));
    reopen(there);
}

/* The slope's file names the profile that lies beside it: written into the scene it is another name. */
TEST_WITH(a_changed_slope_keeps_its_profile, set_up, tear_down)
{
    char here[128];
    scatter("../slopes/by-csv.yaml");
    open_scene();
    set("slope.facets", "both");
    strcpy(here, path);
    save(here);
    reopen(here);
    assert_int_equal(d.file.scene.slope.facets, CEDUO_BOTH);
}

/* A profile that is typed in is one beside the scene, as a stand is. */
TEST_WITH(a_typed_profile_lies_beside_the_scene, set_up, tear_down)
{
    char there[256];
    scatter(slopes[2]);
    write_file("a/slopes/low.csv", "distance,elevation\n0,40\n40,10\n80,5\n100,0\n");
    write_file("a/stands/low.yaml", "ceduo: stand/1\ntrees: [{per_ha: 9, dbh_m: 0.2, height_m: 12}]\n");
    open_scene();
    set("slope.csv", "../slopes/low.csv");
    assert_int_equal(d.file.scene.slope.vertices, 4);
    set("slope", "../slopes/line.csv");
    assert_int_equal(d.file.scene.slope.vertices, 3);
    set("slope", "{csv: ../slopes/low.csv, segments: [{rn: 0.3, rt: 0.8}]}");
    set("forest[0].stand", "../stands/low.yaml");
    in_folder(there, "b/scenes/t.yaml");
    save(there);
    strcpy(path, there);
    open_scene();
    assert_int_equal(d.file.scene.slope.vertices, 4);
    assert_true(d.file.scene.options[0].belts[0].stand.trees[0].per_ha == 9);
}

/* Work on a scene that was saved elsewhere can be taken up again there. */
TEST_WITH(the_copy_leads_to_the_same_files, set_up, tear_down)
{
    char there[256], text[4096];
    scatter("../slopes/by-csv.yaml");
    open_scene();
    in_folder(there, "b/scenes/t.yaml");
    save(there);
    set("slope.facets", "both");
    set("forest[0].stand.trees[0].per_ha", "50");
    assert_non_null(copy_of());
    strcpy(text, copy_of());
    ceduo_document_forget(&d);
    reopen(there);
    must(ceduo_document_recover(&d, text, &problems));
    expect_files();
    assert_true(d.file.scene.options[0].belts[0].stand.trees[0].per_ha == 50);
}
