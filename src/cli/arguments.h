/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ARGUMENTS_H
#define CEDUO_ARGUMENTS_H

#include <stdbool.h>
#include <stdint.h>

#include "study/goal.h"
#include "view/cells.h"
#include "view/plot.h"
#include "view/report.h"

/* Exit statuses, as the manual has them. */
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

struct arguments {
    enum mode mode;
    uint64_t given; /* options, as bits: see ceduo_option_given() */
    enum ceduo_format format;
    enum ceduo_plot plot;        /* a picture instead of the page */
    int plot_width, plot_height; /* cells, title and all */
    const char *script;          /* keys and commands for the terminal program; NULL: none */
    enum ceduo_charset charset;
    int language;       /* a word of the option's row */
    const char *output; /* NULL: standard output */
    int stands;         /* CSV rows are stands */
    bool quiet;
    uint64_t rocks;   /* 0: the scene's */
    double tolerance; /* 0: none */
    unsigned threads;
    struct word_list sets; /* PATH=VALUE, in their order, --seed among them */
    size_t cells;          /* of a row of --each: the last of these */
    struct word_list options;
    struct word_list calibrates; /* PATH=LO:HI */
    char **scenes;
    size_t scenes_count;
    const char *called; /* how messages call the present scene where there are several; NULL: they need not */
    const char *label;  /* how a table calls its row of --each; NULL: there is none */
    char seed[64];
    bool years;                 /* every option year by year */
    struct ceduo_window window; /* those years; step 0: one whole rotation of each */
    const char *find;           /* PATH of the value looked for; NULL: none */
    double find_lo, find_hi;
    enum ceduo_goal goal;
    double goal_value;               /* NaN: the light's own limit */
    double sure;                     /* share of what may be true in which the goal is reached; 0: not asked for */
    size_t points;                   /* of --sensitivity */
    const char *survey;              /* a CSV file of plots; NULL: none */
    const char *each;                /* a CSV file of which each row changes the scenes; NULL: none */
    const char *columns;             /* of CSV, by their heads with a comma between them; NULL: all */
    int schema;                      /* a word of the option's row */
    bool resume;                     /* go on with what the output holds */
    struct ceduo_profiles *profiles; /* of pages of several scenes: what the table before them says */
};

#endif
