#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The core reaches for no file, terminal, locale or environment, and exports nothing without its prefix.
cd "$(dirname "$0")/../.." || exit 1
lib=${BUILD:-build/release}/libceduo.a
bad=$(nm -u "$lib" | awk '{print $NF}' | grep -E '^(.*printf|f?open|getenv|setlocale|yaml_|initscr|newterm|stdout|stderr|puts|exit|abort)')
if [ -z "$bad" ]; then echo "ok 1 - the core reaches for nothing outside"; else
    echo "not ok 1 - the core reaches for nothing outside"; echo "# $bad"; fi
bad=$(nm -g --defined-only "$lib" | awk 'NF == 3 {print $3}' | grep -v '^ceduo_' | grep -vE '^(__asan|__odr|__tsan|__ubsan)')
if [ -z "$bad" ]; then echo "ok 2 - every exported symbol begins with ceduo_"; else
    echo "not ok 2 - every exported symbol begins with ceduo_"; echo "# $bad"; fi
bad=$(grep -rnE '#include <(ncurses|curses)' src --include='*.[ch]' | grep -v '^src/tui/terminal')
if [ -z "$bad" ]; then echo "ok 3 - one file alone knows curses"; else
    echo "not ok 3 - one file alone knows curses"; echo "# $bad"; fi
bad=$(grep -rnE '#include "(view|model|tui|cli)/' src/core src/io include; grep -rnE '#include "(model|tui|cli)/' src/view
    grep -rnE '#include "(tui|cli)/' src/model; grep -rnE '#include "cli/' src/tui)
if [ -z "$bad" ]; then echo "ok 4 - dependencies point one way"; else
    echo "not ok 4 - dependencies point one way"; echo "# $bad"; fi
echo "1..4"
