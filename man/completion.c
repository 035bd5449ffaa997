/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Write the completion of ceduo's command line for a shell: completion bash|zsh. Options and their words come from the tables
 * of the program; the shell asks the program for parameters and profiles. */
#include <stdio.h>
#include <string.h>

#include "cli/arguments.h"

/* Return the words allowed as value of an option, or NULL. */
static const char *option_words(const struct option_row *row)
{
    static char words[256];
    words[0] = '\0';
    const char *from = strcmp(row->name, "plot") == 0 ? ceduo_plot_names : row->value;
    if (strcmp(row->name, "goal") == 0)
        for (int i = 0; i < CEDUO_GOALS; i++)
            snprintf(words + strlen(words), sizeof words - strlen(words), "%s%s", i > 0 ? " " : "", ceduo_goals[i].word);
    else if (from && strpbrk(from, "|,"))
        for (size_t n = 0; *from && n + 1 < sizeof words; from++) {
            if (*from != ',')
                words[n++] = *from == '|' ? ' ' : *from;
            words[n] = '\0';
        }
    return words[0] ? words : NULL;
}

static bool takes_path(const struct option_row *row)
{
    return row->value && strncmp(row->value, "PATH=", 5) == 0;
}

static bool takes_table(const struct option_row *row)
{
    return row->value && strstr(row->value, ".csv");
}

static bool takes_option(const struct option_row *row)
{
    return strcmp(row->name, "option") == 0;
}

static bool takes_file(const struct option_row *row)
{
    return row->value && (strncmp(row->value, "FILE", 4) == 0 || takes_table(row));
}

/* ---- bash ---- */

static void print_pattern(const struct option_row *row)
{
    if (row->letter)
        printf("-%c|", row->letter);
    printf("--%s)", row->name);
}

/* Print the names of the options of a scene, one per line, by simulating one rock. */
#define OPTIONS(scene)                                                                                                         \
    "-b -q -n 1 -f csv --columns option -- " scene " 2>/dev/null |\n"                                                          \
    "            awk 'NR > 1 && !seen[$0]++ {if (sub(/^\"/, \"\") && sub(/\"$/, \"\")) gsub(/\"\"/, \"\\\"\"); print}'"

/* Names may have blanks and quotes: one per line, never expanded; readline quotes the inserted name. */
static const char *const bash_head =
    "# bash completion for ceduo\n"
    "\n"
    "# a word as it was typed, without its quotes, to plain\n"
    "_ceduo_plain()\n"
    "{\n"
    "    local word=$1 quote= c\n"
    "    plain=\n"
    "    while [[ -n $word ]]; do\n"
    "        c=${word:0:1} word=${word:1}\n"
    "        if [[ -n $quote && $c == \"$quote\" ]]; then\n"
    "            quote=\n"
    "        elif [[ -z $quote && $c == [\\'\\\"] ]]; then\n"
    "            quote=$c\n"
    "        elif [[ $c == \\\\ && ( -z $quote || ( $quote == \\\" && $word == [\\\\\\\"\\$\\`]* ) ) ]]; then\n"
    "            plain+=${word:0:1} word=${word:1}\n"
    "        else\n"
    "            plain+=$c\n"
    "        fi\n"
    "    done\n"
    "}\n"
    "\n"
    "# of the lines given those that begin as what was typed\n"
    "_ceduo_offer()\n"
    "{\n"
    "    local line\n"
    "    while IFS= read -r line; do\n"
    "        [[ $line == \"$plain\"* ]] && COMPREPLY+=(\"$line\")\n"
    "    done\n"
    "}\n"
    "\n"
    "# folders, and files that match an expression\n"
    "_ceduo_files()\n"
    "{\n"
    "    local pattern=$plain name c\n"
    "    [[ $cur == '~/'* ]] && pattern=$HOME${plain:1}\n"
    "    for c in '\\' '*' '?' '['; do\n"
    "        pattern=${pattern//\"$c\"/\"\\\\$c\"}\n"
    "    done\n"
    "    while IFS= read -r name; do\n"
    "        [[ -d $name || ( -e $name && $name =~ $1 ) ]] || continue\n"
    "        [[ $cur == '~/'* ]] && name='~'${name:${#HOME}}\n"
    "        COMPREPLY+=(\"$name\")\n"
    "    done < <(compgen -G \"$pattern*\")\n"
    "}\n"
    "\n"
    "# paths of parameters with the indices that were typed, and 0 for others\n"
    "_ceduo_paths()\n"
    "{\n"
    "    local line listed\n"
    "    listed=$(sed 's/\\[[^]]*\\]/[]/g; s/^options\\[\\]\\.forest\\[\\]/forest[]/' <<< \"$plain\")\n"
    "    while IFS= read -r line; do\n"
    "        [[ $line == \"$listed\"* ]] || continue\n"
    "        line=${line:${#listed}}\n"
    "        COMPREPLY+=(\"$plain${line//\\[\\]/[0]}\")\n"
    "    done\n"
    "}\n"
    "\n"
    "# names of the options of the scenes that were typed\n"
    "_ceduo_options()\n"
    "{\n"
    "    local word plain\n"
    "    for word in \"${COMP_WORDS[@]:1}\"; do\n"
    "        _ceduo_plain \"${word/#'~/'/$HOME/}\"\n"
    "        [[ -z $plain || $plain == -* ]] || \"$program\" " OPTIONS(
        "\"$plain\"") "\n"
                      "    done\n"
                      "}\n"
                      "\n"
                      "_ceduo()\n"
                      "{\n"
                      "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} program plain\n"
                      "    # --option=value comes in three words\n"
                      "    if [[ $cur == = ]]; then\n"
                      "        cur=\n"
                      "    elif [[ $prev == = ]]; then\n"
                      "        prev=${COMP_WORDS[COMP_CWORD-2]}\n"
                      "    fi\n"
                      "    _ceduo_plain \"${COMP_WORDS[0]/#'~/'/$HOME/}\"\n"
                      "    program=$plain\n"
                      "    _ceduo_plain \"$cur\"\n"
                      "    COMPREPLY=()\n"
                      "    case $prev in";

/* Print the names of the scenes among the profiles, one per line, from the program's list. */
#define SCENES                                                                                                                 \
    "--list-profiles 2>/dev/null |\n"                                                                                          \
    "            awk 'match($0, / +scene  /) {print substr($0, 1, RSTART - 1)}'"
#define PARAMETERS(after)                                                                                                      \
    "--list-parameters 2>/dev/null |\n"                                                                                        \
    "            awk 'NR > 1 && !NF {exit} NR > 1 {print $1 \"" after "\"}'"

static void print_bash(const struct option_row *rows, size_t n)
{
    puts(bash_head);
    for (size_t i = 0; i < n; i++) {
        if (!rows[i].value || rows[i].value[0] == '[') /* no value, or an optional one */
            continue;
        fputs("    ", stdout);
        print_pattern(&rows[i]);
        const char *words = option_words(&rows[i]);
        if (words)
            printf(" _ceduo_offer < <(printf '%%s\\n' %s); return;;\n", words);
        else if (takes_path(&rows[i]))
            puts("\n"
                 "        _ceduo_paths < <(\"$program\" " PARAMETERS(
                     "=") ")\n"
                          "        [[ ${COMPREPLY-} == *= ]] && compopt -o nospace 2>/dev/null\n"
                          "        return;;");
        else if (takes_option(&rows[i]))
            puts(" _ceduo_offer < <(_ceduo_options); return;;");
        else if (takes_file(&rows[i]))
            puts(takes_table(&rows[i]) ? " _ceduo_files '\\.csv$'; return;;" : " _ceduo_files ''; return;;");
        else
            puts(" return;;");
    }
    puts("    esac\n"
         "    if [[ $plain == -* ]]; then");
    fputs("        _ceduo_offer < <(printf '%s\\n'", stdout);
    for (size_t i = 0; i < n; i++)
        printf(" --%s", rows[i].name);
    puts(")\n"
         "    else\n"
         "        _ceduo_files '\\.(ya?ml|jsonl)$'\n"
         "        _ceduo_offer < <(\"$program\" " SCENES ")\n"
         "    fi\n"
         "}\n"
         "complete -o filenames -F _ceduo ceduo");
}

/* ---- zsh ---- */

/* Print text in single quotes, with the characters [ ] : of _arguments escaped. */
static void print_quoted(const char *text)
{
    for (; *text; text++) {
        if (*text == '\'')
            fputs("'\\''", stdout);
        else if (strchr("[]:\\", *text))
            printf("\\%c", *text);
        else
            putchar(*text);
    }
}

static void print_zsh_value(const struct option_row *row)
{
    const char *words = option_words(row);
    if (!row->value)
        return;
    putchar(':');
    print_quoted(row->value);
    if (words)
        printf(":(%s)", words);
    else
        fputs(takes_path(row)     ? ":_ceduo_parameters"
              : takes_option(row) ? ":_ceduo_options"
              : takes_table(row)  ? ":_files -g \"*.csv(-.)\""
              : takes_file(row)   ? ":_files"
                                  : ": ",
              stdout);
}

static void print_zsh(const struct option_row *rows, size_t n)
{
    puts("#compdef ceduo\n"
         "_ceduo_parameters()\n"
         "{\n"
         "    local -a paths\n"
         "    local typed=${(Q)PREFIX} listed\n"
         "    listed=$(sed 's/\\[[^]]*\\]/[]/g; s/^options\\[\\]\\.forest\\[\\]/forest[]/' <<< \"$typed\")\n"
         "    paths=(${(f)\"$(\"${(Q)${words[1]/#\\~\\//$HOME/}}\" " PARAMETERS(
             "") ")\"})\n"
                 "    paths=(${(M)paths:#$listed*}) # with the indices that were typed, and 0 for others\n"
                 "    paths=(\"$typed\"${^${paths#$listed}//'[]'/'[0]'})\n"
                 "    compadd -S = -a paths\n"
                 "}\n"
                 "_ceduo_options()\n"
                 "{\n"
                 "    local -a names\n"
                 "    local word\n"
                 "    for word in ${(Q)words[2,-1]/#\\~\\//$HOME/}; do\n"
                 "        [[ -z $word || $word == -* ]] || names+=(${(f)\"$(\"${(Q)${words[1]/#\\~\\//$HOME/}}\" " OPTIONS(
                     "\"$word\"") ")\"})\n"
                                  "    done\n"
                                  "    compadd -a names\n"
                                  "}\n"
                                  "_ceduo_scenes()\n"
                                  "{\n"
                                  "    local -a names\n"
                                  "    names=(${(f)\"$(\"${(Q)${words[1]/#\\~\\//$HOME/}}\" " SCENES ")\"})\n"
                                  "    compadd -a names\n"
                                  "    _files -g '*.(yaml|yml|jsonl)(-.)'\n"
                                  "}\n"
                                  "_arguments -s \\");
    for (size_t i = 0; i < n; i++) {
        bool letter = rows[i].letter != 0;
        fputs("    ", stdout);
        const char *equals = rows[i].value ? "=" : "";
        if (strstr(rows[i].help, "repeated"))
            letter ? printf("'*'{-%c,--%s%s}'[", rows[i].letter, rows[i].name, equals)
                   : printf("'*--%s%s[", rows[i].name, equals);
        else if (letter)
            printf("'(-%c --%s)'{-%c,--%s%s}'[", rows[i].letter, rows[i].name, rows[i].letter, rows[i].name, equals);
        else
            printf("'--%s%s[", rows[i].name, equals);
        print_quoted(rows[i].help);
        putchar(']');
        print_zsh_value(&rows[i]);
        puts("' \\");
    }
    puts("    '*:scene:_ceduo_scenes'");
}

int main(int argc, char **argv)
{
    size_t n;
    const struct option_row *rows = ceduo_option_rows(&n);
    if (argc == 2 && strcmp(argv[1], "bash") == 0)
        print_bash(rows, n);
    else if (argc == 2 && strcmp(argv[1], "zsh") == 0)
        print_zsh(rows, n);
    else
        return 2;
    return ferror(stdout) || fclose(stdout) ? 1 : 0;
}
