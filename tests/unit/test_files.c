/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files: how they are found, read and written, and which temporary files remain. */
#include "expect.h"
#include "local.h"

#include "folder.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include "io/file.h"
#include "io/node.h"

TEST_WITH(files_are_found, folder_set_up_profiles, folder_tear_down)
{
    struct arena arena = {0};
    folder_write("ceduo/stands/own.yaml", "x");
    folder_write("ceduo/top.yaml", "x");
    folder_write("beside.yaml", "x");
    char beside[256], wanted[256];
    in_folder(beside, "scene.yaml");
    const struct {
        const char *name, *found;
        bool folder;
    } rows[] = {{"beside.yaml", "beside.yaml", true},
                {"own.yaml", "ceduo/stands/own.yaml", true},
                {"own", "ceduo/stands/own.yaml", true},
                {"own", NULL, false},
                {"./top.yaml", "ceduo/top.yaml", true},
                {"../top.yaml", "ceduo/top.yaml", true},
                {"../.././stands/own.yaml", "ceduo/stands/own.yaml", false},
                {"stands/own", NULL, true},
                {"folder.yaml", NULL, true}, /* a folder is no file */
                {"nothing", NULL, true},
                {"/nothing", NULL, true}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const char *found = ceduo_file_find(&arena, rows[i].name, beside, rows[i].folder ? "stands" : NULL);
        if (!rows[i].found) {
            assert_null(found);
            continue;
        }
        in_folder(wanted, rows[i].found);
        assert_non_null(found);
        assert_string_equal(found, wanted);
    }
    in_folder(wanted, "beside.yaml");
    assert_string_equal(ceduo_file_find(&arena, wanted, NULL, NULL), wanted);
    ceduo_arena_free(&arena);
}

TEST_WITH(folders_of_the_environment, folder_set_up_profiles, folder_tear_down)
{
    char own[256], home[256], path[256];
    in_folder(own, "ceduo");
    in_folder(home, "home");
    const char *const parts[] = {"home", "home/.local", "home/.local/share", "home/.local/share/ceduo"};
    for (size_t i = 0; i < LENGTH(parts); i++) {
        in_folder(path, parts[i]);
        assert_int_equal(mkdir(path, 0700), 0);
    }
    char file[256]; /* a file instead of the folder */
    in_folder(file, "file");
    assert_int_equal(mkdir(file, 0700), 0);
    folder_write("file/ceduo", "x");
    const struct {
        const char *data, *home, *first;
    } rows[] = {{folder, home, own}, {file, home, NULL}, {NULL, home, path}, {"relative", home, path},
                {"", home, path},    {NULL, "", NULL},   {NULL, NULL, NULL}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
        rows[i].data ? setenv("XDG_DATA_HOME", rows[i].data, 1) : unsetenv("XDG_DATA_HOME");
        rows[i].home ? setenv("HOME", rows[i].home, 1) : unsetenv("HOME");
        const char *const *folders = ceduo_file_folders(&arena);
        bool is_first = folders[0] && rows[i].first && strcmp(folders[0], rows[i].first) == 0;
        assert_int_equal(is_first, rows[i].first != NULL);
        for (size_t k = is_first; folders[k]; k++)
            assert_null(strstr(folders[k], folder));
    }
    setenv("XDG_DATA_HOME", folder, 1);
}

TEST_WITH(folders_are_listed, folder_set_up_profiles, folder_tear_down)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    char own[256];
    in_folder(own, "ceduo");
    size_t n = 1;
    assert_null(ceduo_file_list(&arena, own, "slopes", &n));
    assert_int_equal(n, 0);
    const char *const names[] = {"ceduo/stands/a-b.yaml",   "ceduo/stands/a.yaml",    "ceduo/stands/letter.txt",
                                 "ceduo/stands/.yaml",      "ceduo/stands/.c.yaml",   "ceduo/stands/B.yaml",
                                 "ceduo/stands/x",          "ceduo/stands/aaaa.yaml", "ceduo/stands/aa.yaml",
                                 "ceduo/stands/aaaaa.yaml", "ceduo/stands/aaa.yaml"};
    for (size_t i = 0; i < LENGTH(names); i++)
        folder_write(names[i], "x");
    const char *const wanted[] = {"B", "a", "a-b", "aa", "aaa", "aaaa", "aaaaa", "folder"};
    const char *const *list = ceduo_file_list(&arena, own, "stands", &n);
    assert_int_equal(n, LENGTH(wanted));
    for (size_t i = 0; i < n; i++)
        assert_string_equal(list[i], wanted[i]);
    for (int i = 0; i < 100; i++) { /* more than the initial capacity */
        char name[64];
        snprintf(name, sizeof name, "ceduo/stands/n%02d.yaml", i);
        folder_write(name, "x");
    }
    list = ceduo_file_list(&arena, own, "stands", &n);
    assert_int_equal(n, 108);
    for (size_t i = 8; i < n; i++)
        assert_int_equal(atoi(list[i] + 1), (int)i - 8);
}

static int descriptors(void)
{
    int n = 0;
    for (int fd = 0; fd < 256; fd++)
        n += fcntl(fd, F_GETFD) >= 0;
    return n;
}

/* The longest names that a file system allows, of two-byte characters: the temporary file's name is cut between two. */
TEST_WITH(long_names_are_written, folder_set_up_profiles, folder_tear_down)
{
    char name[256] = "", path[512];
    int open_before = descriptors();
    for (int i = 0; i < 127; i++)
        strcat(name, "\xc3\xa4");
    for (int longer = 0; longer < 2; longer++) {
        snprintf(path, sizeof path, "%s/%s%s", folder, longer ? "x" : "", name);
        for (int twice = 0; twice < 2; twice++)
            assert_true(ceduo_file_write(path, "some", 4));
        assert_int_equal(access(path, F_OK), 0);
        assert_int_equal(descriptors(), open_before);
    }
}

static char problem[400];

/* Read a file into `text`; if that fails, put the message into `problem`. */
static bool read_limited(const char *path, struct text *text, size_t max)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    const struct source *source = ceduo_file_read(&arena, path, max, &problems);
    *text = (struct text){0};
    if (source)
        ceduo_text_append_n(text, source->bytes, source->length);
    snprintf(problem, sizeof problem, "%s", ceduo_problems_print(&problems));
    assert_ptr_equal(arena.sources, source);
    return source != NULL;
}

static void expect_bytes(const char *path, size_t max, const char *bytes)
{
    struct text text;
    assert_true(read_limited(path, &text, max));
    assert_string_equal(ceduo_text_string(&text), bytes);
    ceduo_text_free(&text);
}

static void expect_problem(const char *path, size_t max, const char *words)
{
    struct text text;
    assert_false(read_limited(path, &text, max));
    assert_non_null(strstr(problem, words));
}

TEST_WITH(files_are_taken, folder_set_up_profiles, folder_tear_down)
{
    char path[256], link[256], to[256];
    folder_write("some", "twelve bytes");
    in_folder(path, "some");
    expect_bytes(path, 12, "twelve bytes");
    expect_problem(path, 11, "larger than 0 MiB");
    expect_problem(folder, 11, "Is a directory");
    in_folder(path, "none");
    expect_problem(path, 11, "No such file");
    expect_problem("/dev/zero", 11, "a device or a socket; name a file");
    expect_bytes("/proc/self/status", 11, ""); /* its reported size is 0 */
    /* through links to a missing file, by relative and absolute paths; a link to itself is refused */
    in_folder(link, "link");
    in_folder(to, "link2");
    assert_int_equal(symlink("link2", link), 0);
    in_folder(path, "target");
    assert_int_equal(symlink(path, to), 0);
    assert_true(ceduo_file_write(link, "x", 1));
    expect_bytes(path, 9, "x");
    in_folder(link, "loop");
    assert_int_equal(symlink("loop", link), 0);
    assert_false(ceduo_file_write(link, "x", 1));
    assert_int_equal(errno, ELOOP);
    /* a bare name is in the current folder */
    char cwd[4096];
    assert_non_null(getcwd(cwd, sizeof cwd));
    assert_int_equal(chdir(folder), 0);
    assert_int_equal(symlink("bare", "bare-link"), 0);
    assert_true(ceduo_file_write("bare-link", "y", 1));
    expect_bytes("bare", 9, "y");
    assert_int_equal(chdir(cwd), 0);
}

TEST_WITH(files_are_the_same, folder_set_up_profiles, folder_tear_down)
{
    char path[256], link[256], second[256], missing[256];
    folder_write("some", "x");
    folder_write("other", "x");
    in_folder(path, "some");
    in_folder(link, "link");
    in_folder(second, "other");
    in_folder(missing, "none");
    assert_int_equal(symlink("some", link), 0);
    assert_true(ceduo_file_is_same(path, path));
    assert_true(ceduo_file_is_same(path, link));
    assert_true(ceduo_file_is_same(link, path));
    assert_false(ceduo_file_is_same(path, second) || ceduo_file_is_same(path, missing) || ceduo_file_is_same(missing, path));
    assert_false(ceduo_file_is_same(folder, folder)); /* folders are neither read nor written */
    int was = dup(STDIN_FILENO), fd = open(path, O_RDONLY);
    assert_int_equal(dup2(fd, STDIN_FILENO), STDIN_FILENO);
    close(fd);
    assert_true(ceduo_file_is_same(link, "-"));
    assert_false(ceduo_file_is_same(second, "-"));
    close(STDIN_FILENO);
    assert_false(ceduo_file_is_same(link, "-"));
    expect_problem("-", 9, "standard input: cannot read it: Bad file descriptor");
    dup2(was, STDIN_FILENO);
    close(was);
}

/* A socket is not a file, and a read-only file is not replaced. */
TEST_WITH(files_that_cannot_be_written, folder_set_up_profiles, folder_tear_down)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    int s = socket(AF_UNIX, SOCK_STREAM, 0);
    snprintf(address.sun_path, sizeof address.sun_path, "%s/socket", folder);
    assert_int_equal(bind(s, (struct sockaddr *)&address, sizeof address), 0);
    assert_false(ceduo_file_write(address.sun_path, "x", 1));
    assert_int_equal(errno, ENXIO);
    close(s);
    char path[256];
    folder_write("kept", "old");
    in_folder(path, "kept");
    assert_int_equal(chmod(folder, 0777), 0);
    static const mode_t modes[] = {0444, 0555, 0545, 0666};
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        assert_int_equal(chmod(path, modes[i]), 0);
        bool may = modes[i] == 0666;
        bool root = geteuid() == 0; /* root may write anything: try as another user */
        if (root)
            assert_int_equal(setreuid(65534, 0), 0);
        bool asked = ceduo_file_can_write(path), written = ceduo_file_write(path, "new", 3);
        int why = errno;
        if (root)
            assert_int_equal(setreuid(0, 0), 0);
        assert_int_equal(asked, may);
        assert_int_equal(written, may);
        if (!may)
            assert_int_equal(why, EACCES);
        expect_bytes(path, 9, may ? "new" : "old");
    }
}

static int pipe_in;

static void write_to_pipe(int signal)
{
    (void)signal;
    if (write(pipe_in, "late", 4) == 4)
        close(pipe_in);
}

/* A signal interrupts a read, which continues: the signal's handler writes to the pipe. */
TEST(an_interrupted_read_continues)
{
    int ends[2], was = dup(STDIN_FILENO);
    LOCAL_TEXT(text);
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(dup2(ends[0], STDIN_FILENO), STDIN_FILENO);
    pipe_in = ends[1];
    const struct sigaction action = {.sa_handler = write_to_pipe};
    const struct itimerval soon = {.it_value = {.tv_usec = 100000}};
    assert_int_equal(sigaction(SIGALRM, &action, NULL), 0);
    assert_int_equal(setitimer(ITIMER_REAL, &soon, NULL), 0);
    assert_true(read_limited("-", &text, 100));
    assert_string_equal(text.bytes, "late");
    close(ends[0]);
    dup2(was, STDIN_FILENO);
    close(was);
}

static atomic_bool gives_up;
static atomic_int ticks;

static void give_up_at_third(int signal)
{
    (void)signal;
    if (++ticks == 3)
        gives_up = true;
}

/* An interrupted write continues until it is cancelled: the pipe is full, and not read. */
TEST(an_interrupted_write_continues_until_cancelled)
{
    int ends[2];
    assert_int_equal(pipe2(ends, O_NONBLOCK), 0);
    while (write(ends[1], "x", 1) == 1)
        ;
    assert_int_equal(fcntl(ends[1], F_SETFL, 0), 0);
    const struct sigaction action = {.sa_handler = give_up_at_third};
    const struct itimerval often = {{.tv_usec = 10000}, {.tv_usec = 10000}}, never = {.it_value = {0}};
    assert_int_equal(sigaction(SIGALRM, &action, NULL), 0);
    assert_int_equal(setitimer(ITIMER_REAL, &often, NULL), 0);
    bool filled = ceduo_file_write_all(ends[1], "y", 1, &gives_up);
    int why = errno;
    assert_int_equal(setitimer(ITIMER_REAL, &never, NULL), 0);
    assert_false(filled);
    assert_int_equal(why, EINTR);
    EXPECT(atomic_load(&ticks), >=, 3);
    close(ends[0]);
    close(ends[1]);
}
