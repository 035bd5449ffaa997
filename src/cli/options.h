/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OPTIONS_H
#define CEDUO_OPTIONS_H

#include "arguments.h"

#define OPTIONS_MOST 64 /* arguments.given has a bit for each */
#define THREADS_MOST 1024

/* The options of the command line in one table: parsing, help, completion and the checks of what goes together read it.
 * A new option is a row, and a function where its value is like no other's. */
struct option_row {
    const char *name;
    char letter; /* 0: none */
    /* as the help shows it, "a|b|c" where it is one of these; "[N]": it may have one; NULL: it takes none */
    const char *value;
    enum exit_status (*set)(struct arguments *arguments, const struct option_row *row, char *value); /* may be NULL */
    size_t at;        /* of the member that is set, for the setters that several options share */
    enum mode mode;   /* that it asks for; MODE_TERMINAL: none */
    unsigned without; /* modes with which it does not go: a bit for each */
    const char *help;
};

const struct option_row *ceduo_option_rows(size_t *n);

/* What to do instead of an option that an earlier version had, such as "--plain"; NULL: it had none of this name. */
const char *ceduo_option_gone(const char *word);

/* Whether the option of this name stands on the command line. */
bool ceduo_option_given(const struct arguments *arguments, const char *name);

/* --charset, or what the locale can show. */
enum ceduo_charset ceduo_option_charset(const struct arguments *arguments);

/* Sets what an option asks for. EXIT_DONE, or another status once the reason is told. */
enum exit_status ceduo_option_set(struct arguments *arguments, const struct option_row *row, char *value);

#endif
