# SPDX-License-Identifier: GPL-3.0-or-later
# Tests, benches and other checks. One of a test file's first three lines may have tags, as in "tags: slow threads":
#
#   slow        starts first; not in `make quick`
#   quick       a script that is also in `make quick`, which has the tests of C
#   brief       depends on the language: .ci/run repeats it in Italian and German
#   threads     uses threads: `make check-all` repeats it with a sanitizer for them
#   full        only in `make check-all`, or with FULL=1
#   uncounted   not in `make coverage`
#   unsanitized runs neither program nor library of this build: not repeated with sanitizers
#   manual      also reads the manual or README: repeated with sanitizers in a part of its own

CORES := $(shell nproc 2>/dev/null || echo 1)
# These goals use every core without -j. Many tests mostly wait, so there is one more job than cores.
ifneq ($(filter quick check check-% bench fuzz lint net,$(MAKECMDGOALS)),)
ifeq ($(findstring jobserver,$(MAKEFLAGS)),)
MAKEFLAGS += -j$(shell expr $(CORES) + 1)
endif
endif

T := $(BUILD)/tests
FOLDERS := unit physics memory
C_TESTS := $(wildcard $(FOLDERS:%=tests/%/test_*.c))
SCRIPTS := $(wildcard tests/cli/test_*.py tests/cli/test_*.sh tests/tui/test_*.py tests/physics/test_*.sh)
UNIT := $(C_TESTS:tests/%.c=$(T)/%)
tagged = $(shell grep -l '^..\? tags: .*\<$(1)\>' $(SCRIPTS) $(C_TESTS))
taps = $(patsubst tests/%,$(T)/%.tap,$(patsubst %.c,%,$(1)))
# Slow tests first, so that none runs alone at the end. OMIT: tags of tests that are omitted.
OMITTED = $(foreach tag,$(OMIT) $(if $(FULL),,full),$(call tagged,$(tag)))
CHECKED = $(filter-out $(OMITTED),$(call tagged,slow) $(SCRIPTS) $(C_TESTS))

# Random bytes for the readers, keys and the handle. `make check` uses the seeds, inputs that libFuzzer found, and this number of
# fixed changes of both, check-all ten times this number; in `make fuzz` libFuzzer changes them.
FUZZERS := $(patsubst tests/fuzz/%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
REPLAYS := $(FUZZERS:fuzz_%=$(T)/fuzz/replay_%)
CHANGES_scene := 2000
CHANGES_csv := 2000
CHANGES_set := 1000
CHANGES_table := 500
CHANGES_keys := 1000
CHANGES_each := 500
CHANGES_handle := 500
SEEDS_scene := profiles/scenes/*.yaml

# ---- goals that run tests ----

.PHONY: quick check check-brief check-threads check-manual check-scenes replay FORCE
quick: all $(call taps,$(filter-out $(call tagged,slow),$(C_TESTS)) $(call tagged,quick))
check: all $(call taps,$(CHECKED)) $(REPLAYS:=.tap)
check-brief: all $(call taps,$(call tagged,brief))
check-threads: all $(call taps,$(call tagged,threads))
check-manual: all $(call taps,$(call tagged,manual))
check-scenes: all $(T)/cli/test_random_scenes.py.tap
quick check check-brief check-threads check-manual check-scenes: # the last line is: N passed, N failed
	@tests/summary $(filter %.tap,$^)

# ---- tests of C: one program per folder, which runs the test file named like the program ----

OTHERS := tests/physics/bits.c tests/physics/constants.c # programs of test_bits.sh and test_constants.sh
LINKED := $(call object,tests/main.c $(filter-out $(OTHERS),$(wildcard $(FOLDERS:%=tests/%/*.c))))
SUPPORT := $(filter-out $(T)/unit/% $(T)/memory/% $(T)/physics/test_%,$(LINKED))
PROGRAMS := $(FOLDERS:%=$(T)/%/all)
define PROGRAM_OF
$(T)/$(1)/all: $(filter $(T)/$(1)/%,$(LINKED))
$(filter $(T)/$(1)/%,$(UNIT)): $(T)/$(1)/all
endef
$(foreach folder,$(FOLDERS),$(eval $(call PROGRAM_OF,$(folder))))
$(PROGRAMS): $(SUPPORT) $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(link) -lcmocka $(LIBS)

$(UNIT):
	@ln -sf all $@

# The tests of memory replace these functions.
WRAPPED := malloc calloc realloc aligned_alloc strdup realpath free pthread_create fsync ceduo_arena_alloc ceduo_arena_grow \
	ceduo_arena_copy ceduo_arena_string ceduo_arena_vformat
$(T)/memory/all: LDFLAGS += $(WRAPPED:%=-Wl,--wrap=%)

$(UNIT:=.tap): %.tap: % FORCE
	@tests/run $@ $<

$(call taps,$(SCRIPTS)): $(T)/%.tap: tests/% $(PROGRAM) $(MO) $(PAGES_IT) FORCE
	@CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) CC="$(CC)" BUILD=$(BUILD) tests/run $@ $<

# These also compare the output of the tools.
$(T)/cli/test_net.py.tap $(T)/cli/test_manual.sh.tap: $(TABLES) $(COMPLETION)

# Both install at the same time: neither may find half-made files of the other.
$(T)/cli/test_install.py.tap $(T)/cli/test_library.py.tap: $(SCRIPTS_COMPLETION)

$(BUILD)/tests/%.o: DEFINES = -Itests
.SECONDARY:

# ---- fuzzing ----

replay: $(REPLAYS:=.tap)
$(REPLAYS): $(T)/fuzz/replay_%: $(BUILD)/tests/fuzz/fuzz_%.o $(BUILD)/tests/fuzz/replay.o $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(link) $(LIBS)

$(REPLAYS:=.tap): $(T)/fuzz/replay_%.tap: $(T)/fuzz/replay_% FORCE
	@tests/run $@ $< $* $(CHANGES_$*)$(if $(FULL),0) $(wildcard tests/fuzz/seeds/$*/* tests/fuzz/found/$*/*) $(SEEDS_$*)

$(FUZZERS:%=$(T)/fuzz/%): $(T)/fuzz/%: $(BUILD)/tests/fuzz/%.o $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(link) -fsanitize=fuzzer $(LIBS)

FUZZ_SECONDS ?= 600
FUZZ_OPTIONS = -max_total_time=$(FUZZ_SECONDS) -timeout=20 -rss_limit_mb=1000 -max_len=8192 -print_final_stats=1 \
	-dict=tests/fuzz/words.dict -artifact_prefix=$(call quoted,$(CURDIR)/$(T)/fuzz/)
.PHONY: fuzz $(FUZZERS)
$(FUZZERS): fuzz_%: $(T)/fuzz/fuzz_%
	@mkdir -p $(T)/fuzz/corpus/$*
	$< $(FUZZ_OPTIONS) $(foreach f,$(T)/fuzz/corpus/$* $(wildcard tests/fuzz/seeds/$* tests/fuzz/found/$*) $(dir $(SEEDS_$*)), \
	    $(call quoted,$(CURDIR)/$f)) 2>$<.log || { tail -40 $<.log; exit 1; }
	@grep 'stat::number_of_executed_units\|cov:' $<.log | tail -2

# Installs packages that a goal needs in addition to deps.
need = @+$(MAKE) --no-print-directory DEBIAN="$(1)" deps
DEBIAN_FUZZ := clang libclang-rt-dev
fuzz:
	$(call need,$(DEBIAN_FUZZ))
	@+$(MAKE) --no-print-directory CC=clang VARIANT=fuzz $(FUZZERS)

# ---- other compilers and analysers ----

# These checks of cppcheck are off: uninitialised variables whose address alone is used, and memory kept by realloc if a later
# one fails (both correct here, and checked by -Wall, the sanitizers and the tests of failing allocations); two variables with
# the same initial value; NULL at the end of arguments, which is a pointer in POSIX.
CPPCHECK := -q --error-exitcode=1 --std=c11 --enable=warning,performance,portability --inline-suppr \
	--suppress=missingIncludeSystem --suppress=uninitvar --suppress=legacyUninitvar --suppress=ctuuninitvar \
	--suppress=memleak --suppress=duplicateAssignExpression --suppress=varFuncNullUB
CLANG_DEFINES := -std=c17 -D_GNU_SOURCE -Iinclude -Isrc -Itests "-DCEDUO_DATADIR=\"\"" "-DCEDUO_LOCALEDIR=\"\""
.PHONY: lint coverage net
lint:
	$(call need,cppcheck clang clang-tidy)
	find src tests -name '*.c' | xargs -P $(CORES) -n 8 clang -fsyntax-only -Werror $(WARNINGS) $(CLANG_DEFINES)
	cppcheck $(CPPCHECK) -D_GNU_SOURCE -Iinclude -Isrc src
	find src -name '*.c' | xargs -P $(CORES) -n 4 sh -c 'clang-tidy --quiet "$$@" -- $(CLANG_DEFINES) 2>/dev/null' tidy

# Runs tests on a build that counts branches, then reports untaken branches without a comment. Omits tests of the screen and of
# workflows, which are slow and cover nothing more of these parts; the test of the house, which runs nothing; and that of the
# installed library, which uses other compilers.
COUNTED = $(call taps,$(filter-out tests/tui/% $(call tagged,uncounted),$(CHECKED)))
COUNT = $(MAKE) --no-print-directory -j$(CORES) CC=clang VARIANT=cov
coverage:
	$(call need,$(DEBIAN_FUZZ) llvm)
	@+$(COUNT) all $(PROGRAMS:$(T)/%=build/cov/tests/%) $(REPLAYS:$(T)/%=build/cov/tests/%)
	@rm -rf build/cov/counts build/cov/processors; mkdir -p build/cov/processors
	@+SCENES=500 TEST_SECONDS=20000 PROCESSORS=$(call quoted,$(CURDIR)/build/cov/processors) \
	    $(COUNT) $(COUNTED:$(T)/%=build/cov/tests/%) replay
	@tests/coverage.py build/cov; explained=$$?; \
	    tests/summary $(patsubst $(T)/%,build/cov/tests/%,$(COUNTED) $(REPLAYS:=.tap)) && exit $$explained

# For changes that should not affect output.
net: all $(TABLES) $(COMPLETION)
	@CC="$(CC)" tests/net.py --program $(PROGRAM) $(if $(BEFORE),--before '$(BEFORE)') $(if $(ONLY),--only '$(value ONLY)')

# ---- check-all ----

# Takes seven hours of processor, three of them for the scenes. Parts that have passed are skipped until a file that they read
# changes: tests/all.
# ONLY='threads memory': only these. MORE: parts that run only if ONLY names them.
PARTS_OF_ALL := check sanitizers manual scenes clang threads memory arm slurm dist deb lint
MORE_OF_ALL := coverage fuzz stress
.PHONY: check-all $(PARTS_OF_ALL:%=all-%) $(MORE_OF_ALL:%=all-%)
check-all:
	$(call need,$(DEBIAN_FUZZ) gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user valgrind slurmctld slurmd slurm-client munge \
	    chromium tidy poppler-utils)
	@+MAKE="$(MAKE)" PARTS="$(PARTS_OF_ALL)" MORE="$(MORE_OF_ALL)" tests/all $(ONLY)

all-check:
	@+$(MAKE) --no-print-directory FULL=1 check
all-sanitizers:
	@+$(MAKE) --no-print-directory FULL=1 TEST_SECONDS=20000 VARIANT=asan OMIT='manual unsanitized' check
all-manual:
	@+$(MAKE) --no-print-directory FULL=1 TEST_SECONDS=20000 VARIANT=asan check-manual
all-scenes:
	@+$(MAKE) --no-print-directory SCENES=10000 TEST_SECONDS=20000 VARIANT=asan check-scenes
all-clang: # its sanitizer reports offsets to null pointers, gcc's does not
	@+$(MAKE) --no-print-directory CC=clang VARIANT=fuzz FULL=1 replay
all-threads:
	@+$(MAKE) --no-print-directory VARIANT=tsan check-threads
all-lint: lint
all-coverage: coverage
all-fuzz:
	@+$(MAKE) --no-print-directory FUZZ_SECONDS=600 fuzz
all-stress:
	@+$(MAKE) --no-print-directory STRESS=10000000 stress

# Runs these under valgrind: every scene as a batch, a picture, a report, years, uncertainty, a search, and the terminal program
# with a script. Uncertainty takes most of the time, and is computed for two scenes.
VALGRIND := valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite,possible
define IN_VALGRIND
--batch -n 200 -s uncertainty=none $(wildcard profiles/scenes/*.yaml)
--plot profile -n 200 paper-site
--report - -n 100 -s uncertainty=none paper-site staggered
--years 0:3 -f json -n 100 rotation
--sensitivity=3 -n 50 paper-site four-systems
--batch -n 50 paper-site
--find forest[0].stand.stools.per_ha=500:5000 --goal adc=30 paper-site
--script $(BUILD)/valgrind.keys paper-site
endef
all-memory: export IN_VALGRIND := $(IN_VALGRIND)
all-memory: export LC_ALL := C.UTF-8
all-memory: all
	printf '%s\n' 'key 2 Down Down Enter' 'type 0.5' 'key Enter u Ctrl-R' 'resize 120 40' 'key 1 a 3 4 5 6 ? Esc' 'dump -' \
	    >$(BUILD)/valgrind.keys
	echo "$$IN_VALGRIND" | xargs -d '\n' -P $(CORES) -I@ sh -c 'echo "@"; exec $(VALGRIND) $(PROGRAM) @ >/dev/null'

# Another processor architecture.
all-arm:
	tests/arm.sh

# Runs the workflows again, with Slurm on one node for their job arrays and for the jobs of a region; reports the reason if Slurm does not start.
all-slurm: all
	CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) tests/slurm.sh sh -c 'tests/cli/test_workflows.py && tests/cli/test_region_workflow.py' || \
	    [ $$? = 77 ]

# Runs the tests in the archive, unpacked elsewhere.
all-dist: dist
	+to=$$(mktemp -d) && tar -xzf ceduo-$(VERSION).tar.gz -C "$$to" && \
	    $(MAKE) --no-print-directory -C "$$to/ceduo-$(VERSION)" check; status=$$?; rm -rf "$$to"; exit $$status

# Builds the packages for Debian, installs, uses and purges them.
all-deb: deb
	CC=$(CC) tests/deb.sh || [ $$? = 77 ]

# ---- stress and benches ----

# Number of random scenes; each core runs a part.
STRESS ?= 10000000
.PHONY: stress bench
stress: $(T)/physics/test_stress
	@rm -f $(T)/stress-*.log; each=$$((($(STRESS) + $(CORES) - 1) / $(CORES))); \
	for i in $$(seq 0 $$(($(CORES) - 1))); do \
	    STRESS=$$each STRESS_FIRST=$$((100000 + i * each)) $< >$(T)/stress-$$i.log 2>&1 || echo "FAILED: part $$i" >>$(T)/stress-$$i.log & \
	done; wait; \
	grep -h 'scenes:\|scene \|seed \|FAILED' $(T)/stress-*.log; ! grep -q FAILED $(T)/stress-*.log

BENCH := $(patsubst tests/%.c,$(T)/%,$(wildcard tests/bench/bench_*.c))
$(BENCH): $(T)/%: $(BUILD)/tests/%.o $(call object,$(filter-out tests/bench/bench_%,$(wildcard tests/bench/*.c)) \
		tests/physics/paper_site.c tests/physics/line_scene.c tests/physics/plane_map.c tests/physics/quarry_site.c) $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(link) $(LIBS)

bench: all $(BENCH)
	$(call need,python3-numpy)
	@CC="$(CC)" ONLY="$(ONLY)" tests/bench/results.sh $(BENCH) tests/bench/numpy_loop.py tests/bench/bench_valley.py tests/bench/bench_handle.py \
	    tests/bench/bench_ground.py
	@$(MAKE) --no-print-directory tables
