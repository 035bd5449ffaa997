# SPDX-License-Identifier: GPL-3.0-or-later
# ceduo: rockfall among the stems of a coppice.
#
#   make            build the program, ./ceduo      make check      run the tests that CI runs; make quick: those of C, a minute
#   make deps       install missing packages        make check-all  sanitizers, valgrind, Slurm: slow
#   make run        compute the paper's site        make bench      measure speed against a plain C loop
#   make install    PREFIX, DESTDIR; uninstall      make stress     ten million random scenes: slow
#   make bench ONLY=times|errors|NAME...            those that a busy machine spoils, the others, or these; make tables writes them
#   make dist       pack the sources                VARIANT=release|debug|asan|tsan|cov|fuzz
#   make deb        build packages for Debian, in build/deb
#   make man        write the tables of the program into the manual; make samples: what its commands print
#   make pictures   draw the pictures of README
#   make po         bring the marked text of the sources and the manual into src/po/*.po, src/po/man/it.po
#   make lint       run clang's warnings, cppcheck and clang-tidy
#   make fuzz       run libFuzzer, FUZZ_SECONDS=600 for each reader
#   make net        compare what the program prints with an earlier commit: BEFORE=v0.2 ONLY=plot
#   make coverage   list branches of the library and src/io that no test takes, with the reason for each: slow

VERSION := $(shell sed -n 's/.*CEDUO_VERSION "\(.*\)"/\1/p' include/ceduo/status.h)
VARIANT ?= release
PREFIX ?= /usr/local
DESTDIR ?=
BINDIR ?= $(PREFIX)/bin
DATADIR ?= $(PREFIX)/share/ceduo
MANDIR ?= $(PREFIX)/share/man
LOCALEDIR ?= $(PREFIX)/share/locale
LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
BASHDIR ?= $(PREFIX)/share/bash-completion/completions
ZSHDIR ?= $(PREFIX)/share/zsh/site-functions
BUILD := build/$(VARIANT)
# Quotes a path for the shell; users may choose paths with blanks and apostrophes.
quoted = '$(subst ','\'',$(1))'
ifeq ($(origin CC),default)
CC := gcc
endif

WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wformat=2
OPTIMISE_release := -O2
OPTIMISE_debug := -O0 -g
# Without forced inlining and debug information on variables, the wide kernels compile in a tenth of the time; reports still
# have line numbers.
OPTIMISE_asan := -O1 -g1 -Dalways_inline=unused -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
OPTIMISE_tsan := -O1 -g1 -Dalways_inline=unused -fsanitize=thread
# Conditions of the source are counted before the compiler moves any; a function inlined by force would be counted once for each
# caller. Counts are not atomic, which would be seven times slower: each test has one processor, so one thread works at a time.
OPTIMISE_cov = -O2 -g1 -Dalways_inline=unused -fcoverage-mapping $(call quoted,-fprofile-instr-generate=$(CURDIR)/$(BUILD)/counts/%m.profraw)
OPTIMISE_fuzz := -O1 -g -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
CFLAGS ?= $(OPTIMISE_$(VARIANT))
# -ffp-contract=off: fused multiply-adds would give different bits on different machines.
ALL_CFLAGS = -std=c17 -D_GNU_SOURCE -Iinclude -Isrc $(WARNINGS) -ffp-contract=off -pthread \
	-MMD -MP $(CFLAGS) $(EXTRA_CFLAGS)
LIBRARY_LIBS := -lyaml -lunistring -lgsl -lgslcblas -lm
LIBS = -lncursesw -ltinfo $(LIBRARY_LIBS)

# The rooms of the library, with their folders; the other rooms use them.
rooms = $(wildcard $(patsubst %,src/%/*.c,$(1)) $(patsubst %,src/%/*/*.c,$(1)))
CORE := $(call rooms,base scene core study io)
HEADERS := $(wildcard include/ceduo/*.h)
REST := $(filter-out src/cli/main.c,$(call rooms,model view tui cli))
object = $(patsubst %.c,$(BUILD)/%.o,$(1))
LIBRARY := $(BUILD)/libceduo.a
SONAME := libceduo.so.0
SHARED := $(BUILD)/libceduo.so.$(VERSION)
PARTS := $(BUILD)/libparts.a
PROGRAM := $(BUILD)/ceduo
LANGUAGES := $(patsubst src/po/%.po,%,$(wildcard src/po/*.po))
MO := $(LANGUAGES:%=$(BUILD)/locale/%/LC_MESSAGES/ceduo.mo)
# The Italian manual is made from the English one and src/po/man/it.po; what is not translated stays English.
PAGES_IT := $(addprefix $(BUILD)/man/it/,ceduo.1 ceduo-output.5 ceduo-terminal.7 ceduo-workflows.7)

ifeq ($(VARIANT),release)
all: ceduo $(SHARED) $(MO) $(PAGES_IT)
ceduo: $(PROGRAM)
	cp -f $(PROGRAM) $@
else
all: $(PROGRAM) $(SHARED) $(MO) $(PAGES_IT)
endif

$(LIBRARY): $(call object,$(CORE))
	@rm -f $@
	$(AR) rcsD $@ $^

# One set of objects for both. The shared library exports the functions that its headers name, and nothing else.
$(call object,$(CORE)): ALL_CFLAGS += -fPIC -fno-semantic-interposition
$(SHARED): $(call object,$(CORE)) $(BUILD)/exports
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -shared -Wl,-soname,$(SONAME) -Wl,--version-script,$(BUILD)/exports -o $@ $(filter %.o,$^) $(LIBRARY_LIBS)
	@ln -sf $(@F) $(@D)/$(SONAME) && ln -sf $(SONAME) $(@D)/libceduo.so

$(BUILD)/exports: $(HEADERS)
	@mkdir -p $(@D)
	@{ echo '{ global:'; grep -oh '\<ceduo_[a-z0-9_]*[([]' $(HEADERS) | LC_ALL=C sort -u | tr '([' ';;'; echo 'local: *; };'; } >$@

$(PARTS): $(call object,$(REST))
	@rm -f $@
	$(AR) rcsD $@ $^

$(PROGRAM): $(call object,src/cli/main.c) $(PARTS) $(LIBRARY)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(DEFINES) -c -o $@ $<

# The program looks for installed profiles here, after those beside itself.
c_string = "$(subst ?,\?,$(subst ",\",$(subst \,\\,$(1))))"
$(BUILD)/src/io/file.o: DEFINES = -DCEDUO_DATADIR=$(call quoted,$(call c_string,$(DATADIR)))

$(BUILD)/src/cli/say.o: DEFINES = -DCEDUO_LOCALEDIR=$(call quoted,$(call c_string,$(LOCALEDIR)))

# ---- translations ----

$(MO): $(BUILD)/locale/%/LC_MESSAGES/ceduo.mo: src/po/%.po
	@mkdir -p $(@D)
	msgfmt -o $@ $<

# All text that is marked, by the files in which it stands. "95 % of" is no format, though xgettext takes it for one.
TEMPLATE := $(BUILD)/ceduo.pot
.PHONY: $(TEMPLATE)
$(TEMPLATE):
	@mkdir -p $(@D)
	@find src -name '*.[ch]' | LC_ALL=C sort | xgettext -f - -o $@ --force-po --from-code=UTF-8 -L C -k -k_ -kN_ -kngettext:1,2 -kP_:1c,2 -kNP_:1c,2 --flag=N_:1:no-c-format --add-location=file -c'Translators:' \
	    --package-name=ceduo --copyright-holder=
	@awk -v RS= '!/%[-+\#0-9.*]*(ll|l|z|h)?[diouxXeEfgGscp%]/ { sub(/\#, c-format\n/, "") } { gsub(/"POT-Creation-Date[^\n]*\n/, ""); print $$0 "\n" }' \
	    $@ >$@.tmp && mv $@.tmp $@

$(PAGES_IT): $(BUILD)/man/it/%: man/% src/po/man/it.po
	@mkdir -p $(@D)
	@po4a-translate -f man -m $< -M UTF-8 -L UTF-8 -p src/po/man/it.po -l $@ -k 0 >$@.log 2>&1 || { cat $@.log; exit 1; }

po: $(TEMPLATE)
	@mkdir -p $(BUILD)/man
	po4a -f --variable build=$(BUILD) --no-translations --msgmerge-opt=--compendium=$(CURDIR)/src/po/it.po src/po/man/po4a.cfg
	@sed -i '/^"POT-Creation-Date/d' src/po/man/it.po && msgfmt --statistics -o /dev/null src/po/man/it.po
	@for l in $(LANGUAGES); do msgmerge -q --update --backup=none --no-wrap --add-location=file src/po/$$l.po $(TEMPLATE) && \
	    msgfmt -c --statistics -o /dev/null src/po/$$l.po || exit 1; done

# Those of this variant alone: another may be being built.
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)

# ---- a fresh machine ----

DEBIAN := gcc libc6-dev make libncurses-dev libgsl-dev libyaml-dev libunistring-dev librandom123-dev libcmocka-dev mandoc gettext po4a pkgconf python3 \
	tmux zsh locales parallel clang-format jq python3-jsonschema

deps:
	@missing=; for p in $(DEBIAN); do \
	    dpkg-query -W -f '$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; \
	done; \
	[ -z "$$missing" ] && exit 0; \
	if [ "$$(id -u)" != 0 ]; then echo "run as root: apt-get install$$missing"; exit 1; fi; \
	apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing

# With `make -j deps check`, nothing may start before the packages are installed: these goals wait for deps if it is
# requested, and do their work in a make of their own.
GOALS := run quick check check-brief check-all bench stress fuzz lint coverage net
$(GOALS): $(filter deps,$(MAKECMDGOALS))
	@+$(MAKE) --no-print-directory do-$@

do-run: all
	$(PROGRAM) --batch profiles/scenes/paper-site.yaml
	@echo
	@echo "The terminal program: ./ceduo          Four systems side by side: ./ceduo --batch four-systems"
	@echo "More: ./ceduo --help; man man/ceduo.1"

# ---- tests ----

CORES := $(shell nproc 2>/dev/null || echo 1)
T := $(BUILD)/tests
UNIT := $(patsubst tests/%.c,$(T)/%,$(wildcard tests/unit/test_*.c tests/physics/test_*.c))
SCRIPTS := $(wildcard tests/cli/test_*.py tests/cli/test_*.sh tests/tui/test_*.py tests/physics/test_*.sh)
TAPS := $(UNIT:=.tap) $(patsubst tests/%,$(T)/%.tap,$(SCRIPTS))
# These take longest and start first, so that none runs alone at the end. Many mostly wait, so there is one job more than
# there are cores.
SLOW := test_bits.sh test_workflows.py test_years.py test_editing.py test_faults.py test_hangs.py test_popups.py test_alternatives.py \
	test_constants.sh test_random_scenes.py test_terminal.py test_rotation.py test_ways.py test_memory test_memory_files \
	test_install.py test_input_streams.py test_pages.py
TAPS_SLOW := $(foreach t,$(SLOW),$(filter %/$t.tap,$(TAPS)))
JOBS := $(shell expr $(CORES) + 1)
SUPPORT := $(BUILD)/tests/main.o $(call object,$(filter-out tests/physics/test_% tests/physics/bits.c tests/physics/constants.c,$(wildcard tests/physics/*.c)))

# The tests of C, less those that take more than three seconds of processor time, and that of the house: within a minute.
SLOW_C := test_memory test_memory_seen test_verdict test_quarry_sites test_lanes test_statistics_of_runs test_stress test_jobs \
	test_stems_met test_doubt_years test_surface test_structs
TAPS_QUICK := $(filter-out $(addprefix %/,$(SLOW_C:=.tap)),$(UNIT:=.tap)) $(T)/cli/test_house.py.tap
do-quick:
	@+$(MAKE) --no-print-directory -j$(CORES) all
	@rm -f $(TAPS_QUICK)
	@+$(MAKE) --no-print-directory -j$(JOBS) $(TAPS_QUICK)
	@tests/summary $(TAPS_QUICK)

# A short part of them that has to do with languages; .ci/run runs it where others than English are spoken.
TAPS_BRIEF := $(addprefix $(T)/,$(addsuffix .tap,unit/test_language unit/test_texts unit/test_typed cli/test_csv.py cli/test_language.py \
	cli/test_lists.py cli/test_locale.py cli/test_options.py cli/test_table.py tui/test_italian.py tui/test_typing.py))
do-check-brief:
	@+$(MAKE) --no-print-directory -j$(CORES) all
	@rm -f $(TAPS_BRIEF)
	@+$(MAKE) --no-print-directory -j$(JOBS) $(TAPS_BRIEF)
	@tests/summary $(TAPS_BRIEF)

# The last line is: N passed, N failed.
do-check:
	@+$(MAKE) --no-print-directory -j$(CORES) all
	@rm -rf $(TAPS)
	@+$(MAKE) --no-print-directory -j$(JOBS) do-check-replay $(TAPS_SLOW) $(TAPS)
	@tests/summary $(TAPS) $(REPLAYS:%=build/asan/tests/fuzz/%.tap)

$(UNIT): $(T)/%: $(BUILD)/tests/%.o $(SUPPORT) $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ -lcmocka $(LIBS)

WRAPPED := malloc calloc realloc aligned_alloc strdup realpath free pthread_create
$(T)/unit/test_memory_files: WRAPPED += fsync ceduo_arena_take ceduo_arena_more ceduo_arena_copy \
	ceduo_arena_string ceduo_arena_vformat
$(T)/unit/test_memory $(T)/unit/test_memory_files $(T)/unit/test_memory_seen: LDFLAGS += $(WRAPPED:%=-Wl,--wrap=%)

$(UNIT:=.tap): %.tap: %
	@tests/run $@ $<

$(patsubst tests/%,$(T)/%.tap,$(SCRIPTS)): $(T)/%.tap: tests/% $(PROGRAM) $(MO) $(PAGES_IT)
	@CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) CC="$(CC)" BUILD=$(BUILD) tests/run $@ $<

# This test also compares what these print.
$(T)/cli/test_net.py.tap: $(T)/tables $(BUILD)/man/completion

# Both install at the same time: neither may find half of what the other makes.
$(T)/cli/test_install.py.tap $(T)/cli/test_library.py.tap: $(BUILD)/completion/ceduo $(BUILD)/completion/_ceduo

$(BUILD)/tests/%.o: DEFINES = -Itests
.SECONDARY:

# Feeds arbitrary bytes to the readers and keys. `make check` uses the seeds and this many changes of them, always the same;
# `make fuzz` lets libFuzzer change them.
FUZZERS := $(patsubst tests/fuzz/fuzz_%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
REPLAYS := $(FUZZERS:%=replay_%)
CHANGES_scene := 8000
CHANGES_csv := 20000
CHANGES_set := 3000
CHANGES_table := 1000
CHANGES_keys := 2000
SEEDS_scene := profiles/scenes/*.yaml
$(REPLAYS:%=$(T)/fuzz/%): $(T)/fuzz/replay_%: $(BUILD)/tests/fuzz/fuzz_%.o $(BUILD)/tests/fuzz/replay.o $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

$(REPLAYS:%=do-%): do-replay_%: $(T)/fuzz/replay_%
	@printf '#!/bin/sh\nexec ./$< $* $(CHANGES_$*) $(wildcard tests/fuzz/seeds/$*/*) $(SEEDS_$*)\n' >$<.sh
	@chmod +x $<.sh
	@rm -f $<.tap
	@tests/run $<.tap $<.sh

do-replay: $(REPLAYS:%=do-%)

do-check-replay:
	@+$(MAKE) --no-print-directory VARIANT=asan do-replay

$(FUZZERS:%=$(T)/fuzz/%): $(T)/fuzz/%: $(BUILD)/tests/fuzz/fuzz_%.o $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -fsanitize=fuzzer -o $@ $^ $(LIBS)

FUZZ_SECONDS ?= 600
FUZZ_OPTIONS = -max_total_time=$(FUZZ_SECONDS) -timeout=20 -rss_limit_mb=1000 -max_len=8192 -print_final_stats=1 \
	-dict=tests/fuzz/words.dict -artifact_prefix=$(call quoted,$(CURDIR)/$(T)/fuzz/)
$(FUZZERS:%=do-fuzz_%): do-fuzz_%: $(T)/fuzz/%
	@mkdir -p $(T)/fuzz/corpus/$*
	$< $(FUZZ_OPTIONS) $(foreach f,$(T)/fuzz/corpus/$* $(wildcard tests/fuzz/seeds/$*) $(dir $(SEEDS_$*)),$(call quoted,$(CURDIR)/$f)) \
	    2>$<.log || { tail -40 $<.log; exit 1; }
	@grep 'stat::number_of_executed_units\|cov:' $<.log | tail -2

do-fuzz:
	@+$(MAKE) --no-print-directory DEBIAN="$(DEBIAN_FUZZ)" deps
	@+$(MAKE) --no-print-directory CC=clang VARIANT=fuzz $(FUZZERS:%=do-fuzz_%)

DEBIAN_FUZZ := clang libclang-rt-dev

# These checks of cppcheck are off: uninitialised variables of which only the address is taken, and memory kept by realloc
# when a later one fails, both known to be correct here (-Wall, the sanitizers and the tests of failing allocations check
# them too); two variables with the same initial value; NULL at the end of arguments, which POSIX has as a pointer.
DEBIAN_LINT := cppcheck clang clang-tidy
CPPCHECK := -q --error-exitcode=1 --std=c11 --enable=warning,performance,portability --inline-suppr \
	--suppress=missingIncludeSystem --suppress=uninitvar --suppress=legacyUninitvar --suppress=memleak \
	--suppress=duplicateAssignExpression --suppress=varFuncNullUB
CLANG_DEFINES := -std=c17 -D_GNU_SOURCE -Iinclude -Isrc -Itests "-DCEDUO_DATADIR=\"\"" "-DCEDUO_LOCALEDIR=\"\""
do-lint:
	@+$(MAKE) --no-print-directory DEBIAN="$(DEBIAN_LINT)" deps
	find src tests -name '*.c' | xargs -P $(CORES) -n 8 clang -fsyntax-only -Werror $(WARNINGS) $(CLANG_DEFINES)
	cppcheck $(CPPCHECK) -D_GNU_SOURCE -Iinclude -Isrc src
	find src -name '*.c' | xargs -P $(CORES) -n 4 sh -c 'clang-tidy --quiet "$$@" -- $(CLANG_DEFINES) 2>/dev/null' tidy

# Runs tests on a build that counts branches, then names the branches not taken that no comment explains. Tests of the screen
# and of whole workflows are left out: what they take of these parts others take sooner, and they would take most of the time;
# so are that of the house, which runs nothing, and that of the installed library, whose users have other compilers.
COUNTED := $(patsubst $(T)/%,build/cov/tests/%,$(filter-out $(T)/tui/% %/test_workflows.py.tap %/test_house.py.tap %/test_library.py.tap,\
	$(TAPS)))
DEBIAN_COVERAGE := $(DEBIAN_FUZZ) llvm
do-coverage:
	@+$(MAKE) --no-print-directory DEBIAN="$(DEBIAN_COVERAGE)" deps
	@+$(MAKE) --no-print-directory -j$(CORES) CC=clang VARIANT=cov all $(REPLAYS:%=build/cov/tests/fuzz/%)
	@rm -rf $(COUNTED) build/cov/counts build/cov/processors; mkdir -p build/cov/processors
	@+SCENES=500 TEST_SECONDS=20000 PROCESSORS=$(call quoted,$(CURDIR)/build/cov/processors) \
	    $(MAKE) --no-print-directory -j$(CORES) CC=clang VARIANT=cov $(COUNTED) do-replay
	@tests/coverage.py build/cov; explained=$$?; tests/summary $(COUNTED) $(REPLAYS:%=build/cov/tests/fuzz/%.tap) && exit $$explained

# For changes that should leave all output as it was.
do-net: all $(T)/tables $(BUILD)/man/completion
	@CC="$(CC)" tests/net.py --program $(PROGRAM) $(if $(BEFORE),--before '$(BEFORE)') $(if $(ONLY),--only '$(value ONLY)')

DEBIAN_ALL := $(DEBIAN_FUZZ) gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user valgrind slurmctld slurmd slurm-client munge \
	chromium tidy poppler-utils
DEBIAN_BENCH := python3-numpy
# All of it takes two and a half hours on two cores. Each part leaves a log with the name of the commit; those that have passed on
# this commit are not run again. ONLY='threads memory': these alone. FULL: also what `make check` leaves out to be short.
ALL_PARTS := check sanitizers scenes clang threads memory arm slurm dist deb lint
do-all-check do-all-sanitizers: export FULL := 1
do-all-sanitizers do-all-scenes: export TEST_SECONDS := 20000
do-all-check: do-check
do-all-sanitizers:
	@+$(MAKE) --no-print-directory VARIANT=asan do-check
do-all-scenes:
	@+SCENES=10000 $(MAKE) --no-print-directory VARIANT=asan do-check-scenes
do-all-clang: # its sanitizer tells of offsets to null pointers, gcc's does not
	@+$(MAKE) --no-print-directory CC=clang VARIANT=fuzz do-replay
do-all-threads:
	@+$(MAKE) --no-print-directory VARIANT=tsan do-check-threads
$(foreach part,memory arm slurm dist deb,do-all-$(part)): do-all-%: do-check-%
do-all-lint: do-lint

do-check-all:
	@+$(MAKE) --no-print-directory DEBIAN="$(DEBIAN_ALL)" deps
	@+commit=$$(git describe --always --dirty --abbrev=12 2>/dev/null || echo none); logs=build/check-all/$$commit; mkdir -p $$logs; \
	passed() { tail -n 1 $$logs/$$1.log 2>/dev/null | grep -q '^passed '; }; \
	case $$commit in none | *-dirty) rm -f $$logs/*.log ;; esac; \
	for part in $(or $(ONLY),$(ALL_PARTS)); do \
	    passed $$part && continue; \
	    echo "$$part ..."; start=$$(date +%s); \
	    if $(MAKE) --no-print-directory do-all-$$part >$$logs/$$part.log 2>&1; then \
	        echo "passed $$commit $$(date -I) in $$(($$(date +%s) - start)) s" >>$$logs/$$part.log; \
	    else tail -n 20 $$logs/$$part.log; fi; \
	done; \
	missing=; for part in $(ALL_PARTS); do \
	    if passed $$part; then echo "$$part: $$(tail -n 1 $$logs/$$part.log)"; \
	    else echo "$$part: MISSING $$logs/$$part.log"; missing=1; fi; \
	done; [ -z "$$missing" ]

CHECKED_scenes := $(T)/cli/test_random_scenes.py.tap
# These tests use threads: workers of a run and of a pool, of the terminal program, and of years.
CHECKED_threads := $(addprefix $(T)/,unit/test_jobs.tap physics/test_statistics_of_runs.tap physics/test_years.tap tui/test_screens.py.tap \
	tui/test_editing.py.tap tui/test_rotation.py.tap cli/test_years.py.tap cli/test_sensitivity.py.tap)
do-check-scenes do-check-threads: do-check-%: all
	@rm -f $(CHECKED_$*)
	@+$(MAKE) --no-print-directory -j$(CORES) $(CHECKED_$*)
	@tests/summary $(CHECKED_$*)

# Runs these under valgrind: every scene as a batch, a picture, a report, years, a doubt, a search, and the terminal program with
# a script. What is not known takes most of the time, and is asked of two of them.
VALGRIND := valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite,possible
define IN_VALGRIND
--batch -n 200 -s doubt=none $(wildcard profiles/scenes/*.yaml)
--plot profile -n 200 paper-site
--report - -n 100 -s doubt=none paper-site staggered
--years 0:3 -f json -n 100 rotation
--sensitivity=3 -n 50 paper-site four-systems
--batch -n 50 paper-site
--find forest[0].stand.stools.per_ha=500:5000 --goal adc=30 paper-site
--script $(BUILD)/valgrind.keys paper-site
endef
do-check-memory: export IN_VALGRIND := $(IN_VALGRIND)
do-check-memory: all
	printf '%s\n' 'key 2 Down Down Enter' 'type 0.5' 'key Enter u Ctrl-R' 'resize 120 40' 'key 1 a 3 4 5 6 ? Esc' 'dump -' \
	    >$(BUILD)/valgrind.keys
	echo "$$IN_VALGRIND" | xargs -d '\n' -P $(CORES) -I@ sh -c 'echo "@"; exec $(VALGRIND) $(PROGRAM) @ >/dev/null'

# Another kind of processor.
do-check-arm:
	tests/arm.sh

# Runs the workflows again, with Slurm on one node for their job arrays; if Slurm cannot be started, it says why.
do-check-slurm: all
	CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) tests/slurm.sh tests/cli/test_workflows.py || [ $$? = 77 ]

# Runs the tests in the archive, unpacked elsewhere.
do-check-dist: dist
	+to=$$(mktemp -d) && tar -xzf $(DIST).tar.gz -C "$$to" && \
	    $(MAKE) --no-print-directory -C "$$to/$(DIST)" check; status=$$?; rm -rf "$$to"; exit $$status

# Builds the packages for Debian, installs, uses and purges them.
do-check-deb: deb
	CC=$(CC) tests/deb.sh || [ $$? = 77 ]

# The number of random scenes; each core runs a part of them.
STRESS ?= 10000000
do-stress: $(T)/physics/test_stress
	@rm -f $(T)/stress-*.log; each=$$((($(STRESS) + $(CORES) - 1) / $(CORES))); \
	for i in $$(seq 0 $$(($(CORES) - 1))); do \
	    $< $$each $$((100000 + i * each)) >$(T)/stress-$$i.log 2>&1 || echo "FAILED: part $$i" >>$(T)/stress-$$i.log & \
	done; wait; \
	grep -h 'scenes:\|scene \|seed \|FAILED' $(T)/stress-*.log; ! grep -q FAILED $(T)/stress-*.log

BENCH := $(patsubst tests/%.c,$(T)/%,$(wildcard tests/bench/bench_*.c))
$(BENCH): $(T)/%: $(BUILD)/tests/%.o $(call object,$(filter-out tests/bench/bench_%,$(wildcard tests/bench/*.c)) \
		tests/physics/paper_site.c tests/physics/line_scene.c tests/physics/quarry_site.c) $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

do-bench: all $(BENCH)
	@+$(MAKE) --no-print-directory DEBIAN="$(DEBIAN_BENCH)" deps
	@CC="$(CC)" ONLY="$(ONLY)" tests/bench/results.sh $(BENCH) tests/bench/numpy_loop.py tests/bench/bench_valley.py \
	    tests/bench/bench_ground.py
	@$(MAKE) --no-print-directory tables

# ---- the manual ----

PAGES := $(wildcard man/*.[1357])
TABLES := $(T)/tables
$(TABLES): $(BUILD)/man/tables.o $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

# Writes the synopsis and the tables of keys, goals, ranges and figures into the manual pages.
man: $(TABLES)
	@for table in synopsis goals; do $(TABLES) $$table man/ceduo.1; done
	@$(TABLES) ranges man/ceduo-scene.5
	@for table in search figures; do $(TABLES) $$table man/ceduo-output.5; done
	@$(TABLES) keys man/ceduo-terminal.7

# What the commands of the manual print, in the pages that show it.
samples: all
	@CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) BUILD=$(BUILD) tests/cli/test_pages.py --write

# What the benches found last, in the pages that show it.
tables:
	@tests/bench/tables.py man/ceduo-accuracy.7 man/ceduo-validation.7

# Draws the screens that README shows, by their keys, and writes the page that it shows.
pictures: all
	@CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) BUILD=$(BUILD) tests/cli/test_workflows.py --readme

# ---- installing ----

COMPLETION := $(BUILD)/man/completion
$(COMPLETION): $(BUILD)/man/completion.o $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/completion/ceduo $(BUILD)/completion/_ceduo: $(COMPLETION)
	@mkdir -p $(@D)
	$(COMPLETION) $(if $(findstring _ceduo,$@),zsh,bash) >$@

# `uninstall` removes these files by name, because others may have put theirs into the same folders.
DATA := profiles/scenes/*.yaml profiles/slopes/*.yaml profiles/stands/*.yaml profiles/rules/*.yaml \
	profiles/surveys/*.csv profiles/observed/* profiles/jobs/*.sbatch
FOLDERS := $(patsubst profiles/%/,%,$(dir $(DATA)))
to = $(call quoted,$(DESTDIR)$(1))

# pkg-config takes a backslash before blanks and signs.
define PKG_CONFIG_FILE
printf 'includedir=%s\nlibdir=%s\n' $(call quoted,$(INCLUDEDIR)) $(call quoted,$(LIBDIR)) | LC_ALL=C sed 's|[^[:alnum:]%+,./:=@_-]|\\&|g'; \
	printf '%s\n' '' 'Name: ceduo' 'Description: rockfall simulation through coppice' 'Version: $(VERSION)' \
	    'Cflags: -I$${includedir}' 'Libs: -L$${libdir} -lceduo' 'Libs.private: $(LIBRARY_LIBS) -pthread'
endef

install: all $(BUILD)/completion/ceduo $(BUILD)/completion/_ceduo
	install -d -- $(call to,$(BASHDIR)) $(call to,$(ZSHDIR))
	install -m 644 -- $(BUILD)/completion/ceduo $(call to,$(BASHDIR))/ceduo
	install -m 644 -- $(BUILD)/completion/_ceduo $(call to,$(ZSHDIR))/_ceduo
	install -d -- $(call to,$(BINDIR)) $(foreach d,$(FOLDERS),$(call to,$(DATADIR))/$d) $(foreach n,1 3 5 7,$(call to,$(MANDIR))/man$n) \
	    $(foreach n,1 5 7,$(call to,$(MANDIR))/it/man$n)
	install -m 755 -- $(PROGRAM) $(call to,$(BINDIR))/ceduo
	for f in $(DATA); do install -m 644 -- $$f $(call to,$(DATADIR))/$${f#profiles/} || exit 1; done
	for l in $(LANGUAGES); do install -d -- $(call to,$(LOCALEDIR))/$$l/LC_MESSAGES && \
	    install -m 644 -- $(BUILD)/locale/$$l/LC_MESSAGES/ceduo.mo $(call to,$(LOCALEDIR))/$$l/LC_MESSAGES/ || exit 1; done
	for p in $(PAGES); do install -m 644 -- $$p $(call to,$(MANDIR))/man$${p##*.}/ || exit 1; done
	for p in $(PAGES_IT); do install -m 644 -- $$p $(call to,$(MANDIR))/it/man$${p##*.}/ || exit 1; done
	install -d -- $(call to,$(LIBDIR))/pkgconfig $(call to,$(INCLUDEDIR))/ceduo
	install -m 644 -- $(LIBRARY) $(SHARED) $(call to,$(LIBDIR))/
	ln -sf -- $(notdir $(SHARED)) $(call to,$(LIBDIR))/$(SONAME)
	ln -sf -- $(SONAME) $(call to,$(LIBDIR))/libceduo.so
	install -m 644 -- $(HEADERS) $(call to,$(INCLUDEDIR))/ceduo
	{ $(PKG_CONFIG_FILE); } >$(call to,$(LIBDIR))/pkgconfig/ceduo.pc
	chmod 644 -- $(call to,$(LIBDIR))/pkgconfig/ceduo.pc

uninstall:
	rm -f -- $(call to,$(BINDIR))/ceduo
	for f in $(DATA); do rm -f -- $(call to,$(DATADIR))/$${f#profiles/} || exit 1; done
	for d in $(FOLDERS:%=/%) ''; do rmdir -- $(call to,$(DATADIR))$$d 2>/dev/null || :; done
	for l in $(LANGUAGES); do rm -f -- $(call to,$(LOCALEDIR))/$$l/LC_MESSAGES/ceduo.mo || exit 1; done
	for p in $(notdir $(PAGES)); do rm -f -- $(call to,$(MANDIR))/man$${p##*.}/$$p || exit 1; done
	for p in $(notdir $(PAGES_IT)); do rm -f -- $(call to,$(MANDIR))/it/man$${p##*.}/$$p || exit 1; done
	rm -f -- $(call to,$(BASHDIR))/ceduo $(call to,$(ZSHDIR))/_ceduo
	for l in libceduo.a libceduo.so $(SONAME) $(notdir $(SHARED)); do rm -f -- $(call to,$(LIBDIR))/$$l || exit 1; done
	rm -f -- $(call to,$(LIBDIR))/pkgconfig/ceduo.pc
	for h in $(notdir $(HEADERS)); do rm -f -- $(call to,$(INCLUDEDIR))/ceduo/$$h || exit 1; done
	rmdir -- $(call to,$(INCLUDEDIR))/ceduo 2>/dev/null || :

# Packs the sources under version control, or in an unpacked archive those listed in it; the bytes are the same each time.
DIST := ceduo-$(VERSION)
dist:
	rm -rf build/$(DIST) && mkdir -p build/$(DIST)
	{ git ls-files 2>/dev/null || cat MANIFEST; } >build/MANIFEST
	tar -cf - -T build/MANIFEST | tar -xf - -C build/$(DIST)
	cp build/MANIFEST build/$(DIST)/MANIFEST
	tar --sort=name --mtime=@$${SOURCE_DATE_EPOCH:-0} --owner=0 --group=0 --numeric-owner -C build \
	    -cf - $(DIST) | gzip -n >$(DIST).tar.gz
	rm -rf build/$(DIST)

# Packages for Debian, built from the sources packed as above with src/packaging as their folder debian.
DEBIAN_DEB := debhelper lintian
DEB := build/deb
deb: dist
	@+$(MAKE) --no-print-directory DEBIAN="$(DEBIAN) $(DEBIAN_DEB)" deps
	rm -rf $(DEB) && mkdir -p $(DEB)
	tar -xzf $(DIST).tar.gz -C $(DEB)
	cp -R $(DEB)/$(DIST)/src/packaging $(DEB)/$(DIST)/debian
	epoch=$${SOURCE_DATE_EPOCH:-$$(date -u +%s -d "$$(sed -n '/^## $(VERSION) (/ { s/.*(//; s/)//p; q }' NEWS.md)")}; \
	sed -i "s/@VERSION@/$(VERSION)/; s/@DATE@/$$(date -R -u -d @$$epoch)/" $(DEB)/$(DIST)/debian/changelog; \
	find $(DEB)/$(DIST) -exec touch -h -d @$$epoch {} +
	cd $(DEB)/$(DIST) && DEB_BUILD_OPTIONS="noautodbgsym parallel=$(CORES)" dpkg-buildpackage -b -us -uc
	rm -rf $(DEB)/$(DIST)
	@for p in $(DEB)/*.deb; do echo "$$p"; dpkg-deb -f "$$p" Package Version Architecture Installed-Size Depends; done

clean:
	rm -rf build ceduo $(DIST).tar.gz

.PHONY: all deps $(GOALS) $(addprefix do-,$(GOALS)) do-replay do-check-replay $(REPLAYS:%=do-%) $(FUZZERS:%=do-fuzz_%) do-check-scenes do-check-threads do-check-memory do-check-slurm do-check-dist do-check-deb man samples tables pictures po install uninstall dist deb clean
.DELETE_ON_ERROR:
