/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ARGUMENTS_H
#define CEDUO_ARGUMENTS_H

#include <stdbool.h>
#include <stdint.h>

#include "study/goal.h"
#include "view/cells.h"
#include "view/plot.h"
#include "view/report.h"

/* The command line: exit statuses, as in the manual, and modes. */
enum exit_status { EXIT_DONE = 0, EXIT_RUN = 1, EXIT_USAGE = 2, EXIT_INPUT = 3, EXIT_OUTPUT = 4 };

enum mode {
    MODE_TERMINAL,
    MODE_BATCH,
    MODE_FIND,
    MODE_SENSITIVITY,
    MODE_CALIBRATE,
    MODE_REPORT,
    MODE_CHECK,
    MODE_PARAMETERS,
    MODE_PROFILES,
    MODE_COLUMNS,
    MODE_SCHEMA,
    MODE_SURVEY,
    MODE_HELP,
    MODE_VERSION
};

struct word_list {
    const char **items;
    size_t n;
};

/* PATH=LO:HI; path NULL: none. */
struct path_range {
    const char *path;
    double lo, hi;
};

struct arguments {
    enum mode mode;
    uint64_t given; /* a bit for each option: see ceduo_arguments_given() */
    enum ceduo_format format;
    enum ceduo_plot plot;        /* a picture instead of the page */
    int plot_width, plot_height; /* cells, with the title */
    const char *script;          /* keys and commands for the terminal program; NULL: none */
    bool tour;                   /* start the terminal program with the tour */
    enum ceduo_charset charset;
    int language;       /* a word of the option's row */
    const char *output; /* NULL: standard output */
    int stands;         /* rows of CSV are stands */
    bool details;       /* the whole page, not the short one */
    bool quiet;
    uint64_t rocks;   /* 0: the scene's */
    double tolerance; /* 0: none */
    uint64_t threads;
    struct word_list sets; /* PATH=VALUE, in order, with --seed */
    size_t cells;          /* number of sets from a row of --each; they are the last */
    struct word_list options;
    size_t calibrates_count;
    struct path_range calibrates[CEDUO_CALIBRATION_MAX];
    char **scenes;
    size_t scenes_count;
    const char *called; /* name of the current scene in messages; NULL: there is only one scene */
    const char *label;  /* of its row of --each in tables; NULL: no row */
    size_t number;      /* number of the current scene, from 0 */
    uint64_t seed;
    char seed_set[64];          /* the seed as PATH=VALUE */
    bool years;                 /* compute every option year by year */
    struct ceduo_window window; /* step 0: one whole rotation of each option */
    struct path_range find;
    enum ceduo_goal goal;
    double goal_value;               /* NaN: limit of the light */
    double sure;                     /* share of plausible cases that reach the goal; 0: not given */
    uint64_t points;                 /* of --sensitivity */
    const char *survey;              /* a CSV file of plots; NULL: none */
    const char *each;                /* a CSV file whose rows change the scenes; NULL: none */
    const char *key;                 /* column of `each` that names a row; NULL: none */
    const char *columns;             /* heads of CSV, separated by commas; NULL: all */
    int schema;                      /* a word of the option's row */
    bool resume;                     /* keep the lines of the output */
    struct ceduo_profiles *profiles; /* of several scenes, for the table before the pages */
    struct text *title;              /* of the first scene of a report */
    struct ceduo_region *region;     /* lines of a report with --each; NULL: none */
    uint64_t chapters;               /* number of chapters of this report */
};

/* Requirement of an option. */
enum option_requirement { NEEDS_NOTHING, NEEDS_GOAL, NEEDS_FIND, NEEDS_PLOT, NEEDS_PICTURE, NEEDS_CSV, NEEDS_EACH, NEEDS_FILE };

/* An option of the command line. Parser, help, checks, completion and the synopsis of ceduo(1) read this row. */
struct option_row {
    const char *name;
    char letter;       /* 0: none */
    const char *value; /* in the help: "a|b": one of these words, "[N]": optional; NULL: takes no value */
    enum exit_status (*set)(struct arguments *arguments, const struct option_row *row, char *value); /* may be NULL */
    size_t offset;      /* of the member that a shared setter sets */
    enum mode mode;     /* mode that it selects; MODE_TERMINAL: none */
    unsigned conflicts; /* modes that refuse it, a bit for each */
    enum option_requirement needs;
    const char *help;
    double lo, hi; /* range of a number */
};

const struct option_row *ceduo_option_rows(size_t *n);

/* Read the command line. Reports errors. Always call ceduo_arguments_free(). */
enum exit_status ceduo_arguments_read(struct arguments *arguments, int argc, char **argv);
void ceduo_arguments_free(struct arguments *arguments);

/* True if this option is on the command line. */
bool ceduo_arguments_given(const struct arguments *arguments, const char *name);

/* Append the page of --help. */
void ceduo_arguments_help(struct text *text);

#endif
