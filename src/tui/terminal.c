/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The only file that uses curses, colours and terminal signals. */
#define NCURSES_WIDECHAR 1
#include "program.h"

#include "base/utf8.h" /* before curses, which defines `columns` */

#include <curses.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <term.h>
#include <termios.h>
#include <unistd.h>
#include <wchar.h>

#include "base/clock.h"
#include "base/language.h"

/* ---- colours ---- */

#define BRIGHT 8 /* difference between a colour and its bright form */

/* Style of each role, in the 16 colours of the terminal. Colour is never the only sign: words and symbols repeat the meaning.
 * GOOD and BAD are blue and red or orange: people with any kind of colour vision tell them apart. In the usual palettes the
 * pairs have the contrast that WCAG 2.2 requires (tests/tui/test_colours.py). */
static const struct role_style {
    short dark, light; /* curses colours of each theme, -1: default of the terminal */
    attr_t attributes;
} role_styles[CEDUO_ROLE_COUNT] = {
    [CEDUO_ROLE_BLANK] = {-1, -1, A_NORMAL},
    [CEDUO_ROLE_TEXT] = {-1, -1, A_NORMAL},
    [CEDUO_ROLE_DIM] = {-1, -1, A_DIM},
    [CEDUO_ROLE_TITLE] = {-1, -1, A_BOLD},
    [CEDUO_ROLE_AXIS] = {-1, -1, A_DIM},
    [CEDUO_ROLE_GROUND] = {COLOR_YELLOW, -1, A_NORMAL},
    [CEDUO_ROLE_CLOUD] = {COLOR_CYAN, COLOR_BLUE, A_NORMAL},
    [CEDUO_ROLE_ENVELOPE] = {COLOR_CYAN, COLOR_BLUE, A_NORMAL},
    [CEDUO_ROLE_MEAN] = {-1, -1, A_BOLD},
    [CEDUO_ROLE_TRAJECTORY] = {COLOR_MAGENTA + BRIGHT, COLOR_MAGENTA, A_BOLD},
    [CEDUO_ROLE_STEM] = {COLOR_GREEN, -1, A_NORMAL},
    [CEDUO_ROLE_STOOL] = {COLOR_GREEN, -1, A_NORMAL},
    [CEDUO_ROLE_BELT] = {COLOR_GREEN, -1, A_NORMAL},
    [CEDUO_ROLE_CONTROL] = {COLOR_RED + BRIGHT, COLOR_RED, A_NORMAL},
    [CEDUO_ROLE_GOOD] = {COLOR_CYAN, COLOR_BLUE, A_BOLD},
    [CEDUO_ROLE_BAD] = {COLOR_RED + BRIGHT, COLOR_RED, A_BOLD},
    [CEDUO_ROLE_WARN] = {COLOR_YELLOW + BRIGHT, COLOR_MAGENTA, A_NORMAL},
    [CEDUO_ROLE_BARE] = {COLOR_CYAN, COLOR_BLUE, A_NORMAL},
    [CEDUO_ROLE_FOREST] = {COLOR_GREEN, -1, A_NORMAL},
    [CEDUO_ROLE_CURSOR] = {-1, -1, A_REVERSE},
};

static bool colours_wanted(void)
{
    const char *no = getenv("NO_COLOR");
    return !(no && no[0]) && has_colors();
}

/* ---- bracketed paste ---- */

static bool has_paste; /* the terminal reports begin and end of a paste, and accepts a copy; the Linux console does not */
#define PASTES_OFF "\033[?2004l"

static void set_bracketed_paste(bool on)
{
    ssize_t unused = has_paste ? write(STDOUT_FILENO, on ? "\033[?2004h" : PASTES_OFF, sizeof PASTES_OFF - 1) : 0;
    (void)unused;
}

/* ---- the clipboard ---- */

#define COPY_MAX 56000 /* bytes; xterm accepts 75 000 characters of base64 */

static void append_base64(struct text *to, const char *bytes, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        uint32_t triple = 0;
        for (size_t k = 0; k < 3; k++)
            triple = triple << 8 | (i + k < n ? (uint8_t)bytes[i + k] : 0);
        for (size_t k = 0; k < 4; k++)
            ceduo_text_append_char(to, i + k > n ? '=' : digits[triple >> (18 - 6 * k) & 63]);
    }
}

/* Copy with OSC 52. Under tmux, send it twice: for tmux, and for the outer terminal. */
static bool copy_to_clipboard(const char *string)
{
    size_t n = strlen(string);
    const char *tmux = getenv("TMUX");
    LOCAL_TEXT(copied);
    LOCAL_TEXT(sequence);
    if (n > COPY_MAX)
        return false;
    ceduo_text_append(&copied, "\033]52;c;");
    append_base64(&copied, string, n);
    ceduo_text_format(&sequence, "%s\a", copied.bytes);
    if (tmux && tmux[0])
        ceduo_text_format(&sequence, "\033Ptmux;\033%s\a\033\\", copied.bytes);
    for (size_t done = 0; done < sequence.length;) {
        ssize_t written = write(STDOUT_FILENO, sequence.bytes + done, sequence.length - done);
        if (written <= 0 && errno != EINTR)
            break;
        done += written > 0 ? (size_t)written : 0;
    }
    return true;
}

/* ---- a crash or a signal ---- */

static struct termios saved_mode;
static char restore_string[128];
static size_t restore_length;
static volatile sig_atomic_t is_open;     /* curses shows the program */
static volatile sig_atomic_t ending;      /* SIGTERM or SIGHUP, or Ctrl-\ */
static volatile sig_atomic_t interrupted; /* SIGINT, or Ctrl-C */
static volatile sig_atomic_t suspended;   /* SIGTSTP, or Ctrl-Z */
static volatile sig_atomic_t continued;   /* after Ctrl-Z, or after another stop */
static bool can_suspend;                  /* false: a shell without job control ignores SIGTSTP */
static int wake[2] = {-1, -1};

/* Build the string that restores the terminal in advance: a signal handler may only write it. */
static void prepare_restore(void)
{
    static const char *const names[] = {"sgr0", "cnorm", "rmkx", "rmcup"};
    restore_length = 0;
    for (size_t i = 0; i < 5; i++) {
        const char *s = i < 4 ? tigetstr(names[i]) : has_paste ? PASTES_OFF : NULL;
        size_t n = s && s != (char *)-1 ? strlen(s) : 0;
        if (restore_length + n < sizeof restore_string) {
            memcpy(restore_string + restore_length, s ? s : "", n);
            restore_length += n;
        }
    }
}

bool ceduo_terminal_restore(void)
{
    static const char mouse_off[] = "\033[?1000l\033[?1006l";
    if (!is_open)
        return false;
    ssize_t unused = write(STDOUT_FILENO, mouse_off, sizeof mouse_off - 1);
    unused = write(STDOUT_FILENO, restore_string, restore_length);
    (void)unused;
    tcsetattr(STDIN_FILENO, TCSANOW, &saved_mode);
    return true;
}

static void on_crash(int number)
{
    ceduo_terminal_restore();
    signal(number, SIG_DFL);
    raise(number);
}

static void on_signal(int number)
{
    int saved_errno = errno;
    if (number == SIGINT)
        interrupted = 1;
    else if (number == SIGTSTP)
        suspended = 1;
    else if (number == SIGCONT)
        continued = 1;
    else
        ending = number;
    ssize_t unused = write(wake[1], "", 1);
    (void)unused;
    errno = saved_errno;
}

static void catch_signal(int number)
{
    sigaction(number, &(struct sigaction){.sa_handler = on_signal}, NULL);
}

/* Install before newterm(): otherwise curses blocks SIGTSTP while drawing. */
static void set_handlers(void)
{
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}, caught[] = {SIGTERM, SIGHUP, SIGINT, SIGCONT};
    for (size_t i = 0; i < 5; i++)
        sigaction(crashes[i], &(struct sigaction){.sa_handler = on_crash, .sa_flags = (int)(SA_RESETHAND | SA_NODEFER)}, NULL);
    for (size_t i = 0; i < 4; i++)
        catch_signal(caught[i]);
    struct sigaction old_action;
    can_suspend = sigaction(SIGTSTP, NULL, &old_action) == 0 && old_action.sa_handler != SIG_IGN;
    if (can_suspend)
        catch_signal(SIGTSTP);
    signal(SIGPIPE, SIG_IGN);
}

/* ---- drawing ---- */

static void fit_screen(struct app *app)
{
    if (!app->cells || app->cells->width != COLS || app->cells->height != LINES)
        ceduo_app_resize(app, COLS, LINES);
}

static void show_screen(struct app *app, bool colours)
{
    fit_screen(app);
    ceduo_screen_draw(app);
    if (app->redraw)
        clearok(curscr, TRUE);
    app->redraw = false;
    for (int y = 0; y < app->cells->height; y++)
        for (int x = 0; x < app->cells->width; x++) {
            uint32_t code = ceduo_cells_glyph(app->cells, x, y);
            const struct role_style *role_style = &role_styles[ceduo_cells_role(app->cells, x, y)];
            short colour = app->theme == 0 ? role_style->dark : app->theme == 1 ? role_style->light : -1;
            bool as_bold = colour >= BRIGHT && colour >= COLORS; /* a terminal of 8 colours shows bold as bright */
            attr_t attributes = role_style->attributes | (as_bold ? A_BOLD : A_NORMAL);
            short pair = colours && colour >= 0 ? (short)(colour - (as_bold ? BRIGHT : 0) + 1) : 0;
            wchar_t text[2] = {(wchar_t)(code ? code : ' '), 0};
            cchar_t cell;
            if (setcchar(&cell, text, attributes, pair, NULL) == OK)
                mvadd_wch(y, x, &cell);
        }
    wnoutrefresh(stdscr);
    doupdate();
}

/* ---- keys ---- */

/* State of the input. Curses translates known sequences and passes on the characters of others; these are swallowed, also in
 * pieces. Text between the two sequences of a paste is collected. */
static struct {
    enum { PLAIN, ESCAPED, CONTROL, STRING, STRING_ESCAPED, CHARACTERS } state;
    int number;     /* parameter of CSI; -1: none, 9999: several or invalid */
    int characters; /* characters left to swallow */
    double last;    /* time of the last character */
    bool pasting;
    char pasted[sizeof((struct line *)NULL)->text + 8]; /* text that fills it is too long for a line */
    size_t length;
} input;

/* An incomplete sequence is dropped after this time: it was Alt with '[', 'O' or ']'. */
#define SEQUENCE_SECONDS 1
#define C1_FIRST         0x80
#define C1_LAST          0x9f
#define STRINGS          "]PX^_" /* OSC, DCS, SOS, PM and APC begin a string; ST ends it */

static bool is_quiet(void)
{
    return ceduo_clock() - input.last > SEQUENCE_SECONDS;
}

/* Handle a character. The terminal sends no signals for keys, because a paste may contain them. */
static void handle_typed(struct app *app, wint_t c)
{
    int number = c == CTRL('C') ? SIGINT : c == CTRL('Z') ? SIGTSTP : c == CTRL('\\') ? SIGQUIT : 0;
    if (!input.pasting && number != 0 && (number != SIGTSTP || can_suspend))
        on_signal(number);
    else if (!input.pasting && number == 0)
        ceduo_program_key(app, c == '\n' || c == '\r' ? K_ENTER : c == 127 || c == 8 ? K_BACKSPACE : (int)c);
    else if (input.pasting && c != 0 && input.length + 4 < sizeof input.pasted)
        input.length += ceduo_utf8_encode(c, input.pasted + input.length);
}

static void end_control(struct app *app, wint_t last)
{
    input.state = PLAIN;
    if (input.pasting && last == '~' && input.number == 201) {
        input.pasting = false;
        input.pasted[input.length] = '\0';
        ceduo_program_paste(app, input.pasted);
    } else if (input.pasting) {
        return;
    } else if (last == '~' && input.number == 200) {
        input.pasting = true;
        input.length = 0;
    } else if (input.number < 0 && (last == '[' || last == 'M')) { /* function key of Linux; click, in pieces */
        input.state = CHARACTERS;
        input.characters = last == '[' ? 1 : 3;
    }
}

static void handle_character(struct app *app, wint_t c)
{
    bool lost = input.pasting && c == CTRL('C') && is_quiet(); /* a lost end of a paste */
    input.last = ceduo_clock();
    if (!input.pasting && c >= C1_FIRST && c <= C1_LAST) { /* equal to Esc and a character; a paste cannot end in it */
        handle_character(app, K_ESCAPE);
        handle_character(app, c - C1_FIRST + '@');
    } else if (lost) {
        input.pasting = false;
        input.state = PLAIN;
    } else if (input.state == PLAIN && c != K_ESCAPE) {
        handle_typed(app, c);
    } else if (input.state == STRING || input.state == STRING_ESCAPED) {
        bool ends = input.state == STRING ? c == '\a' : c == '\\';
        bool new_sequence = input.state == STRING_ESCAPED && !ends; /* a new sequence begins */
        input.state = ends ? PLAIN : new_sequence ? ESCAPED : c == K_ESCAPE ? STRING_ESCAPED : STRING;
        if (new_sequence)
            handle_character(app, c);
    } else if (input.state == ESCAPED && c == '[') {
        input.state = CONTROL;
        input.number = -1;
    } else if (input.state == ESCAPED && !input.pasting && c == 'O') {
        input.state = CHARACTERS;
        input.characters = 1;
    } else if (input.state == ESCAPED && !input.pasting && c < 128 && c > ' ' && strchr(STRINGS, (int)c)) {
        input.state = STRING;
    } else if (input.state == ESCAPED && !input.pasting && c >= ' ' && c != 127) {
        input.state = PLAIN; /* Alt with a character: ignored */
    } else if (input.state == ESCAPED) {
        input.state = PLAIN;
        handle_typed(app, K_ESCAPE);
        handle_character(app, c);
    } else if (c == K_ESCAPE) {
        input.state = ESCAPED;
    } else if (input.state == CHARACTERS) {
        input.state = --input.characters > 0 ? CHARACTERS : PLAIN;
    } else if (c >= ' ' && c < '@') {
        bool digit = c >= '0' && c <= '9' && input.number < 1000;
        input.number = digit ? (input.number < 0 ? 0 : 10 * input.number) + (int)c - '0' : 9999;
    } else if (c >= '@' && c <= '~') {
        end_control(app, c);
    } else {
        input.state = PLAIN;
        handle_typed(app, c);
    }
}

/* Deliver a lone Esc after ESCDELAY. */
static void flush_escape(struct app *app)
{
    if (input.state == ESCAPED && !input.pasting) {
        input.state = PLAIN;
        handle_typed(app, K_ESCAPE);
    }
}

#define EVENTS_MAX 8 /* as curses keeps */

/* Handle all events that curses has read at once. It returns the newest first, and one that stays would come with a later
 * click. */
static void handle_mouse(struct app *app)
{
    MEVENT events[EVENTS_MAX];
    int n = 0;
    while (n < EVENTS_MAX && getmouse(&events[n]) == OK)
        n++;
    while (n-- > 0 && !input.pasting && !app->quit) {
        const MEVENT *event = &events[n];
        fit_screen(app);
        if (event->bstate & BUTTON4_PRESSED)
            ceduo_program_wheel(app, event->x, event->y, -3);
        else if (event->bstate & BUTTON5_PRESSED)
            ceduo_program_wheel(app, event->x, event->y, 3);
        else if (event->bstate & (BUTTON1_PRESSED | BUTTON1_CLICKED))
            ceduo_program_click(app, event->x, event->y);
    }
}

/* Handle all waiting keys. Return true if there was one. */
static bool handle_keys(struct app *app)
{
    static const struct {
        int from, to;
    } keys[] = {{KEY_UP, K_UP},     {KEY_DOWN, K_DOWN},      {KEY_LEFT, K_LEFT},     {KEY_RIGHT, K_RIGHT},
                {KEY_HOME, K_HOME}, {KEY_END, K_END},        {KEY_PPAGE, K_PAGE_UP}, {KEY_NPAGE, K_PAGE_DOWN},
                {KEY_DC, K_DELETE}, {KEY_BTAB, K_SHIFT_TAB}, {KEY_ENTER, K_ENTER}};
    bool found = false;
    wint_t code;
    for (int kind; !app->quit && !interrupted && !suspended && !ending && (kind = get_wch(&code)) != ERR; found = true) {
        int key = K_NONE;
        if (kind == KEY_CODE_YES && code == KEY_RESIZE)
            continue;
        if (kind != KEY_CODE_YES || code == KEY_BACKSPACE) {
            handle_character(app, kind == KEY_CODE_YES ? 127 : code);
            continue;
        }
        flush_escape(app);
        if (code == KEY_MOUSE) {
            handle_mouse(app);
            continue;
        }
        for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
            key = (wint_t)keys[i].from == code ? keys[i].to : key;
        if (code >= KEY_F(1) && code <= KEY_F(10))
            key = K_F((int)code - (int)KEY_F0);
        input.state = PLAIN;
        if (key != K_NONE && !input.pasting)
            ceduo_program_key(app, key);
    }
    flush_escape(app);
    if (!input.pasting && is_quiet())
        input.state = PLAIN;
    return found;
}

/* ---- the loop ---- */

/* Restore the terminal and stop until the shell continues the program. */
static void suspend_program(void)
{
    suspended = 0;
    set_bracketed_paste(false);
    endwin();
    signal(SIGTSTP, SIG_IGN);
    kill(0, SIGTSTP); /* stop the whole job, as the terminal does */
    signal(SIGTSTP, SIG_DFL);
    raise(SIGTSTP);
    catch_signal(SIGTSTP);
    continued = 1; /* SIGCONT may reach another thread later */
}

static void run_loop(struct app *app, bool colours)
{
    show_screen(app, colours);
    while (!app->quit && !ending) {
        struct pollfd fds[3] = {{.fd = STDIN_FILENO, .events = POLLIN},
                                {.fd = ceduo_jobs_fd(app->live.jobs), .events = POLLIN},
                                {.fd = wake[0], .events = POLLIN}};
        int n = poll(fds, 3, input.state != PLAIN && !input.pasting ? 1000 * SEQUENCE_SECONDS : -1);
        if (n < 0 && errno != EINTR)
            break;
        for (char bytes[32]; read(wake[0], bytes, sizeof bytes) > 0;)
            ;
        if (n > 0 && fds[0].revents & (POLLHUP | POLLERR) && !(fds[0].revents & POLLIN))
            break; /* the window was closed */
        if (interrupted) {
            interrupted = 0;
            ceduo_program_interrupt(app);
        }
        if (suspended)
            suspend_program();
        if (continued) {
            continued = 0;
            reset_prog_mode();
            set_bracketed_paste(true);
            app->redraw = true;
        }
        bool changed = handle_keys(app); /* also after a signal of a new size */
        changed |= ceduo_program_poll(app);
        if (changed || app->redraw || n < 0 || app->cells->width != COLS || app->cells->height != LINES)
            show_screen(app, colours);
    }
}

const char *ceduo_terminal_missing(void)
{
    int error;
    bool in = isatty(STDIN_FILENO), out = isatty(STDOUT_FILENO);
    if (!in || !out)
        return in    ? _("standard output is not a terminal")
               : out ? _("standard input is not a terminal")
                     : _("standard input and output are not a terminal");
    const char *name = getenv("TERM");
    if (!name || !name[0] || setupterm(NULL, STDOUT_FILENO, &error) != OK)
        return _("unknown terminal in TERM; try 'TERM=xterm-256color ceduo'");
    const char *move = tigetstr("cup");
    bool moves = move && move != (char *)-1;
    del_curterm(cur_term); /* curses opens it again */
    return moves ? NULL : _("this terminal cannot place the cursor");
}

enum terminal_end ceduo_terminal_run(struct app *app)
{
    static const struct {
        const char *sequence;
        int key;
    } extra_sequences[] = {{"\033[1~", KEY_HOME}, {"\033[7~", KEY_HOME}, {"\033[H", KEY_HOME},
                           {"\033OH", KEY_HOME},  {"\033[4~", KEY_END},  {"\033[8~", KEY_END},
                           {"\033[F", KEY_END},   {"\033OF", KEY_END}}; /* independent of TERM */
    if (pipe2(wake, O_NONBLOCK | O_CLOEXEC) != 0)
        return TERMINAL_FAILED;
    if (!getenv("ESCDELAY"))
        set_escdelay(25);
    tcgetattr(STDIN_FILENO, &saved_mode); /* before curses changes it */
    set_handlers();
    /* The terminal is opened again for its keys, so that a read never waits. After an unwanted mouse event, such as the
     * release of a button, curses ignores nodelay() and would wait for the next key. The shell shares standard input. */
    const char *name = ttyname(STDIN_FILENO);
    int fd = name ? open(name, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC) : -1;
    FILE *keys = fd >= 0 ? fdopen(fd, "r") : NULL;
    is_open = true;
    SCREEN *screen = newterm(NULL, stdout, keys ? keys : stdin);
    if (!screen) {
        is_open = false;
        if (keys)
            fclose(keys);
        return TERMINAL_NONE;
    }
    has_paste = strncmp(tigetstr("cup"), "\033[", 2) == 0 && strncmp(termname(), "linux", 5) != 0;
    app->copy = has_paste ? copy_to_clipboard : NULL;
    set_bracketed_paste(true);
    prepare_restore();
    if (colours_wanted()) {
        start_color();
        use_default_colors();
        for (short c = 0; c < 2 * BRIGHT && c < COLORS; c++)
            init_pair((short)(c + 1), c, -1);
    }
    raw();
    noecho();
    nonl();
    keypad(stdscr, TRUE);
    for (size_t i = 0; i < sizeof extra_sequences / sizeof extra_sequences[0]; i++)
        define_key(extra_sequences[i].sequence, extra_sequences[i].key);
    nodelay(stdscr, TRUE);
    curs_set(0);
    mouseinterval(0);
    mousemask(BUTTON1_PRESSED | BUTTON4_PRESSED | BUTTON5_PRESSED, NULL);
    run_loop(app, colours_wanted());
    set_bracketed_paste(false);
    endwin();
    is_open = false;
    delscreen(screen);
    if (keys)
        fclose(keys);
    if (ending) {
        signal(ending, SIG_DFL);
        raise(ending);
    }
    return TERMINAL_DONE;
}
