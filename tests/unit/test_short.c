/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The short page of every shipped scene, from 80 to 200 columns: no line is wider, none ends in a blank, and it fits a
 * screen. */
#include "expect.h"
#include "local.h"
#include "scene/derived.h"

#include <glob.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "io/scene_file.h"
#include "view/page_parts.h"

#define ROCKS     50
#define WIDTH_MIN 80
#define WIDTH_MAX 200

static void check_page(const char *scene, const struct ceduo_page *page, size_t lines_max)
{
    LOCAL_TEXT(text);
    size_t lines = 0;
    ceduo_page_print(&text, page, false);
    for (char *line = text.bytes, *end; *line; line = end + 1, lines++) {
        end = strchr(line, '\n');
        *end = '\0';
        if (ceduo_utf8_width(line) > page->width || (end > line && end[-1] == ' '))
            fail_msg("%s at %zu columns: '%s'", scene, page->width, line);
    }
    if (lines > lines_max)
        fail_msg("%s at %zu columns: %zu lines", scene, page->width, lines);
}

static void check_scene(const char *path)
{
    struct scene_file file;
    struct problems problems = {0};
    assert_true(ceduo_scene_load(&file, path, NULL, 0, &problems));
    struct ceduo_request question = ceduo_request_default(&file.scene);
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict verdict;
    question.rocks = question.run.rocks_max = ROCKS;
    question.years = true;
    question.years_independent = true;
    question.year_rocks = 50;
    question.years_max = 60;
    assert_int_equal(ceduo_simulate_request(&question, NULL, &answer), CEDUO_OK);
    assert_int_equal(ceduo_compare_options(answer.result, answer.years, NULL, &verdict), CEDUO_OK);
    const struct ceduo_report report = {.file = &file, .result = answer.result, .verdict = &verdict};
    size_t options = file.scene.options_count, shared = file.scene.blocks_count > 0 ? 16 : 14;
    for (size_t k = 0; k < file.scene.controls_count; k++)
        shared += ceduo_fence_stands(&file.scene.controls[k].fence) ? 4 : 0;
    for (size_t width = WIDTH_MIN; width <= WIDTH_MAX; width++) {
        struct ceduo_page page = {.width = width};
        ceduo_page_short(&page, &report);
        check_page(path, &page, options > 1 ? shared + 2 * options : 24);
        ceduo_page_free(&page);
    }
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

TEST(every_scene_fits_its_width_and_a_screen)
{
    glob_t scenes;
    assert_int_equal(glob("profiles/scenes/*.yaml", 0, NULL, &scenes), 0);
    EXPECT(scenes.gl_pathc, >, 10);
    for (size_t i = 0; i < scenes.gl_pathc; i++)
        check_scene(scenes.gl_pathv[i]);
    globfree(&scenes);
}
