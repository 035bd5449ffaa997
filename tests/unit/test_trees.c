/* SPDX-License-Identifier: GPL-3.0-or-later */
/* YAML trees: written, read back, compared, walked along a path, and patched into a text. */
#include "local.h"
#include "table.h"

#include <math.h>
#include <string.h>

#include "base/utf8.h"
#include "io/node.h"

static const struct node *parse(struct arena *arena, const struct text *text)
{
    struct source *source = ceduo_arena_alloc(arena, sizeof *source);
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    *source =
        (struct source){.name = "test", .bytes = ceduo_arena_copy(arena, text->bytes, text->length), .length = text->length};
    const struct node *root = ceduo_yaml_read(arena, source, &problems);
    if (!root)
        fail_msg("%s\n%s", text->bytes, ceduo_problems_print(&problems));
    return root;
}

static const struct node *parsed(struct arena *arena, const char *bytes)
{
    struct text text = {.bytes = (char *)(uintptr_t)bytes, .length = strlen(bytes)};
    return parse(arena, &text);
}

/* Expect line ends and control characters to be escaped. */
static void expect_printable(const struct text *text)
{
    uint32_t c = 0;
    for (size_t i = 0, length; i < text->length; i += length) {
        length = ceduo_utf8_decode(text->bytes + i, text->length - i, &c);
        if (length == 0 || (c != '\n' && !ceduo_utf8_printable(c)))
            fail_msg("U+%04x in: %s", c, text->bytes);
    }
}

/* Write a tree in both ways and read it back. */
static void expect_back(struct arena *arena, const struct node *node)
{
    for (int pass = 0; pass < 2; pass++) {
        LOCAL_TEXT(text);
        if (pass == 0)
            ceduo_emit(&text, node);
        else
            ceduo_emit_flow(&text, node);
        expect_printable(&text);
        const struct node *back = parse(arena, &text);
        if (!ceduo_node_equal(back, node) || (node->kind == NODE_SCALAR && strcmp(back->text, node->text) != 0))
            fail_msg("not read back: %s", text.bytes);
    }
}

/* In a mapping, in a list and in a nested list; with and without quotes. */
static void expect_scalar_back(const char *scalar)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    const struct node *empty = parsed(&arena, "{}"), *list = parsed(&arena, "[a, [b], {c: d}]");
    for (int quoted = 0; quoted < 2; quoted++) {
        const struct node *word = ceduo_node_scalar(&arena, NULL, scalar, quoted);
        expect_back(&arena, ceduo_node_with(&arena, empty, "key", word));
        expect_back(&arena, ceduo_node_replaced(&arena, list, 0, word));
        expect_back(&arena,
                    ceduo_node_replaced(&arena, parsed(&arena, "[[a, b]]"), 0, ceduo_node_replaced(&arena, list, 2, word)));
    }
}

TEST(scalars_are_read_back)
{
    const char *words = " a|a |true|false|null|yes|~|y|-|- a|-a|--|a-b|a:b|a: b|#x|a #b|\"q\"|\\|\n|a\nb|\x01|\x7f|0.5|"
                        "1e5|007|+1|\xc3\xa0|[a]|{a}|&a|*a|!a|%a|@a|`a`|>|?|? a|:|a,b|=|<<|_|.|/|a/b|..|---|...|'|a'b|"
                        "AZaz09|on|null x|a\tb|\\n|no|a\xc2\x80|a\xc2\x85z|\xc2\x9f|\xc2\xa0|a\xe2\x80\xa8z|\xe2\x80\xa9|"
                        "\357\273\277a|\xef\xbf\xbe|\xef\xbf\xbf|\xf4\x8f\xbf\xbf|\xef\xb7\x90|\xe2\x80\xae|a\rb|a  b| |"
                        "\t";
    expect_scalar_back("");
    expect_scalar_back("|");
    for (char word[64]; next_word(&words, word);)
        expect_scalar_back(word);
}

TEST(trees_are_read_back)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    for (TABLE(row, "unit/texts.txt", "trees that are read back"))
        expect_back(&arena, parsed(&arena, row.at[0]));
}

TEST(trees_are_compared)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    for (TABLE(row, "unit/texts.txt", "trees that are compared")) {
        const struct node *a = parsed(&arena, row.at[0]), *b = parsed(&arena, row.at[1]);
        bool equal = strcmp(row.at[2], "equal") == 0;
        assert_int_equal(ceduo_node_equal(a, b), equal);
        assert_int_equal(ceduo_node_equal(b, a), equal);
        assert_true(ceduo_node_equal(a, a));
        assert_false(ceduo_node_equal(a, NULL));
        assert_false(ceduo_node_equal(NULL, a));
    }
    const struct node *map = parsed(&arena, "{a: 1, b: [1, 2, 3]}"), *b = ceduo_node_get(map, "b");
    assert_false(ceduo_node_equal(ceduo_node_renamed(&arena, b, NULL), b)); /* only one has a key */
    assert_null(ceduo_node_get(NULL, "a"));
    assert_null(ceduo_node_get(b, "a"));
    assert_null(ceduo_node_text(map, "b"));
    assert_null(ceduo_node_text(map, "c"));
    assert_string_equal(ceduo_node_text(map, "a"), "1");
    assert_ptr_equal(ceduo_node_without(&arena, map, "c"), map);
    assert_true(ceduo_node_equal(ceduo_node_without(&arena, map, "b"), parsed(&arena, "{a: 1}")));
    assert_true(ceduo_node_item_number(b, 2) == 3);
    const char *const none[] = {"[1, 2]", "[1, 2, [3]]", "[1, 2, x]", "{a: 1, b: 2, c: 3}", "word"};
    for (size_t i = 0; i < LENGTH(none); i++)
        assert_true(isnan(ceduo_node_item_number(parsed(&arena, none[i]), 2)));
    const char *const less[] = {"[2, 3]", "[1, 3]", "[1, 2]"};
    const char *const more[] = {"[9, 1, 2, 3]", "[1, 9, 2, 3]", "[1, 2, 9, 3]", "[1, 2, 3, 9]"};
    const struct node *list = parsed(&arena, "[1, 2, 3]"), *nine = parsed(&arena, "9");
    for (size_t i = 0; i < 3; i++)
        assert_true(ceduo_node_equal(ceduo_node_removed(&arena, list, i), parsed(&arena, less[i])));
    for (size_t i = 0; i < 4; i++)
        assert_true(ceduo_node_equal(ceduo_node_inserted(&arena, list, i, nine), parsed(&arena, more[i])));
}

/* Values are inserted and the rest of the text stays; NULL if more than values changed. */
TEST(texts_are_patched)
{
    for (TABLE(row, "unit/texts.txt", "texts that are patched")) {
        LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
        LOCAL_TEXT(text);
        const struct node *old = parsed(&arena, row.at[0]), *now = parsed(&arena, row.at[1]);
        bool good = ceduo_emit_patched(&text, old->source, old, now);
        assert_int_equal(good, strcmp(row.at[2], "none") != 0);
        if (good)
            assert_string_equal(text.bytes, row.at[2]);
        else
            assert_int_equal(text.length, 0);
    }
}

TEST(walks_end_at_a_missing_node)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    const struct node *root = parsed(&arena, "{forest: [{to_m: 1}, {to_m: 2}], rock: {a: 3}}"),
                      *forest = ceduo_node_get(root, "forest");
    const char *within;
    size_t used;
    assert_string_equal(ceduo_resolve_walk(root, "forest[1].to_m", &within, &used)->text, "2");
    assert_int_equal(used, strlen("forest[1].to_m"));
    assert_ptr_equal(ceduo_resolve_walk(root, "forest[2].to_m", &within, &used), forest);
    assert_int_equal(used, strlen("forest"));
    assert_ptr_equal(ceduo_resolve_walk(root, "rock.b", &within, &used), ceduo_node_get(root, "rock"));
    assert_int_equal(used, strlen("rock"));
    assert_ptr_equal(ceduo_resolve_walk(root, "rock[0]", &within, &used), ceduo_node_get(root, "rock"));
    assert_int_equal(used, strlen("rock"));
}
