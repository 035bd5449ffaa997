# SPDX-License-Identifier: GPL-3.0-or-later
# ceduo: rockfall among the stems of a coppice.
#
#   make            build the program, ./ceduo      make check      run the tests that CI runs; make quick: those of C
#   make deps       install missing packages        make check-all  sanitizers, valgrind, Slurm: slow
#   make run        compute the paper's site        make bench      measure speed against a plain C loop
#   make region     compute the invented road of profiles/region, in build/region
#   make install    PREFIX, DESTDIR; uninstall      make stress     ten million random scenes: slow
#   make bench ONLY=times|errors|NAME...            those for an idle machine, the others, or these; make tables writes them
#   make dist       pack the sources                VARIANT=release|debug|asan|tsan|cov|fuzz
#   make deb        build packages for Debian, in build/deb
#   make man        write the program's tables into the manual; make samples: the output of its commands
#   make pictures   draw the pictures of README     V=1             print whole commands
#   make po         bring the marked text of the sources and the manual into src/po/*.po, src/po/man/it.po
#   make lint       run clang's warnings, cppcheck and clang-tidy
#   make fuzz       run libFuzzer, FUZZ_SECONDS=600 for each reader
#   make net        compare the program's output with an earlier commit's: BEFORE=v0.2 ONLY=plot
#   make coverage   list branches of the library and src/io that no test takes, with their reasons: slow

.DEFAULT_GOAL := all

# ---- a fresh machine ----

DEBIAN := gcc libc6-dev make libncurses-dev libgsl-dev libyaml-dev libunistring-dev librandom123-dev libcmocka-dev man-db mandoc gettext po4a pkgconf python3 \
	tmux zsh locales parallel clang-format jq python3-jsonschema snakemake gdal-bin python3-gdal python3-numpy

.PHONY: deps
deps:
	@missing=; for p in $(DEBIAN); do \
	    dpkg-query -W -f '$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; \
	done; \
	[ -z "$$missing" ] && exit 0; \
	if [ "$$(id -u)" != 0 ]; then echo "run as root: apt-get install$$missing"; exit 1; fi; \
	apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing

# Other goals wait for the packages: after `make -j deps check`, a new make builds each of them.
LATER := $(if $(filter deps,$(MAKECMDGOALS)),$(filter-out deps,$(MAKECMDGOALS)))
ifneq ($(LATER),)
.NOTPARALLEL:
.PHONY: $(LATER)
$(LATER): deps
	@+$(MAKE) --no-print-directory $@
else

VERSION := $(shell sed -n 's/.*CEDUO_VERSION "\(.*\)"/\1/p' include/ceduo/scene.h)
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
# Conditions are counted before the compiler moves any; a forcibly inlined function would be counted once per caller. Counts
# are not atomic, which would be seven times slower: each test has one processor, so that one thread runs at a time.
OPTIMISE_cov = -O2 -g1 -Dalways_inline=unused -fcoverage-mapping $(call quoted,-fprofile-instr-generate=$(CURDIR)/$(BUILD)/counts/%m.profraw)
OPTIMISE_fuzz := -O1 -g -Dalways_inline=unused -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
CFLAGS ?= $(OPTIMISE_$(VARIANT))
# -ffp-contract=off: fused multiply-adds would give different bits on different machines.
ALL_CFLAGS = -std=c17 -D_GNU_SOURCE -Iinclude -Isrc $(WARNINGS) -ffp-contract=off -pthread \
	-MMD -MP $(CFLAGS) $(EXTRA_CFLAGS)
LIBRARY_LIBS := -lyaml -lunistring -lgsl -lgslcblas -lm
LIBS = -lncursesw -ltinfo $(LIBRARY_LIBS)

# Prints one short line per file; with V=1 make prints the command instead.
says = $(if $(filter 1,$(V)),,@$(if $(findstring s,$(firstword -$(MAKEFLAGS))),,printf '  %-4s %s\n' $(1) $(2) &&))
compile = $(call says,CC,$<) $(CC) $(ALL_CFLAGS) $(DEFINES) -c -o $@ $<
archive = $(call says,AR,$@) rm -f $@ && $(AR) rcsD $@ $^
link = $(call says,LD,$@) $(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $(filter %.o,$^) $(filter %.a,$^)

# ---- the program and its library ----

# The rooms of the library, with their folders; the other rooms use them.
rooms = $(wildcard $(patsubst %,src/%/*.c,$(1)) $(patsubst %,src/%/*/*.c,$(1)))
CORE := $(call rooms,base scene core study io view api)
HEADERS := $(wildcard include/ceduo/*.h)
REST := $(filter-out src/cli/main.c,$(call rooms,model tui cli))
object = $(patsubst %.c,$(BUILD)/%.o,$(1))
LIBRARY := $(BUILD)/libceduo.a
SONAME := libceduo.so.1
SHARED := $(BUILD)/libceduo.so.$(VERSION)
PARTS := $(BUILD)/libparts.a
PROGRAM := $(BUILD)/ceduo
LANGUAGES := $(patsubst src/po/%.po,%,$(wildcard src/po/*.po))
MO := $(LANGUAGES:%=$(BUILD)/locale/%/LC_MESSAGES/ceduo.mo)
# The Italian manual is made from the English one and src/po/man/it.po; untranslated text stays English.
PAGES_IT := $(addprefix $(BUILD)/man/it/,ceduo.1 ceduo-output.5 ceduo-terminal.7 ceduo-workflows.7)

.PHONY: all
all: $(if $(filter release,$(VARIANT)),ceduo,$(PROGRAM)) $(SHARED) $(MO) $(PAGES_IT)

ceduo: $(PROGRAM)
	@cp -f $(PROGRAM) $@

$(LIBRARY): $(call object,$(CORE))
	$(archive)

# One set of objects for both libraries. The shared one exports exactly the functions of its headers.
$(call object,$(CORE)): ALL_CFLAGS += -fPIC -fno-semantic-interposition
$(SHARED): $(call object,$(CORE)) $(BUILD)/exports
	$(link) -shared -Wl,-soname,$(SONAME) -Wl,--version-script,$(BUILD)/exports $(LIBRARY_LIBS)
	@ln -sf $(@F) $(@D)/$(SONAME) && ln -sf $(SONAME) $(@D)/libceduo.so

$(BUILD)/exports: $(HEADERS)
	@mkdir -p $(@D)
	@{ echo '{ global:'; grep -oh '\<ceduo_[a-z0-9_]*[([]' $(HEADERS) | LC_ALL=C sort -u | tr '([' ';;'; echo 'local: *; };'; } >$@

$(PARTS): $(call object,$(REST))
	$(archive)

$(PROGRAM): $(call object,src/cli/main.c) $(PARTS) $(LIBRARY)
	$(link) $(LIBS)

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(compile)

# The program searches for profiles in its own folder, then here.
c_string = "$(subst ?,\?,$(subst ",\",$(subst \,\\,$(1))))"
$(BUILD)/src/io/file.o: DEFINES = -DCEDUO_DATADIR=$(call quoted,$(call c_string,$(DATADIR)))
$(BUILD)/src/cli/messages.o: DEFINES = -DCEDUO_LOCALEDIR=$(call quoted,$(call c_string,$(LOCALEDIR)))

# Only this variant's: another one may be under construction.
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)

.PHONY: run
run: all
	$(PROGRAM) --batch profiles/scenes/paper-site.yaml
	@echo
	@echo "The terminal program: ./ceduo          Four systems side by side: ./ceduo --batch four-systems"
	@echo "More: ./ceduo --help; man man/ceduo.1"

# Copies the workflow of a region and runs it on two cores. What has not changed is not computed again.
.PHONY: region
region: all
	@mkdir -p build/region && cp -Rup profiles/region/. build/region
	cd build/region && PATH=$(call quoted,$(CURDIR)/$(BUILD)):$$PATH snakemake --cores 2 --rerun-incomplete

# ---- translations ----

$(MO): $(BUILD)/locale/%/LC_MESSAGES/ceduo.mo: src/po/%.po
	@mkdir -p $(@D)
	$(call says,MO,$<) msgfmt -o $@ $<

# All marked text, by file. "95 % of" is no format, although xgettext treats it as one.
TEMPLATE := $(BUILD)/ceduo.pot
.PHONY: $(TEMPLATE) po
$(TEMPLATE):
	@mkdir -p $(@D)
	@find src -name '*.[ch]' | LC_ALL=C sort | xgettext -f - -o $@ --force-po --from-code=UTF-8 -L C -k -k_ -kN_ -kngettext:1,2 -kP_:1c,2 -kNP_:1c,2 --flag=N_:1:no-c-format --add-location=file -c'Translators:' \
	    --package-name=ceduo --copyright-holder=
	@awk -v RS= '!/%[-+\#0-9.*]*(ll|l|z|h)?[diouxXeEfgGscp%]/ { sub(/\#, c-format\n/, "") } { gsub(/"POT-Creation-Date[^\n]*\n/, ""); print $$0 "\n" }' \
	    $@ >$@.tmp && mv $@.tmp $@

$(PAGES_IT): $(BUILD)/man/it/%: man/% src/po/man/it.po
	@mkdir -p $(@D)
	$(call says,PO4A,$@) po4a-translate -f man -m $< -M UTF-8 -L UTF-8 -p src/po/man/it.po -l $@ -k 0 >$@.log 2>&1 || \
	    { cat $@.log; exit 1; }

po: $(TEMPLATE)
	@mkdir -p $(BUILD)/man
	po4a -f --variable build=$(BUILD) --no-translations --msgmerge-opt=--compendium=$(CURDIR)/src/po/it.po src/po/man/po4a.cfg
	@sed -i '/^"POT-Creation-Date/d' src/po/man/it.po && msgfmt --statistics -o /dev/null src/po/man/it.po
	@for l in $(LANGUAGES); do msgmerge -q --update --backup=none --no-wrap --add-location=file src/po/$$l.po $(TEMPLATE) && \
	    msgfmt -c --statistics -o /dev/null src/po/$$l.po || exit 1; done

# ---- tools: the manual and its pictures, completion ----

TABLES := $(BUILD)/tests/tables
COMPLETION := $(BUILD)/man/completion
$(TABLES): $(BUILD)/man/tables.o $(PARTS) $(LIBRARY)
	@mkdir -p $(@D)
	$(link) $(LIBS)
$(COMPLETION): $(BUILD)/man/completion.o $(PARTS) $(LIBRARY)
	$(link) $(LIBS)

# Writes the synopsis and the tables of keys, goals, ranges and figures into the manual pages.
.PHONY: man samples tables pictures
man: $(TABLES)
	@for table in synopsis goals; do $(TABLES) $$table man/ceduo.1; done
	@$(TABLES) ranges man/ceduo-scene.5
	@for table in search figures; do $(TABLES) $$table man/ceduo-output.5; done
	@$(TABLES) keys man/ceduo-terminal.7

# Writes the output of the manual's commands into its pages.
samples: all
	@CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) BUILD=$(BUILD) tests/cli/test_pages.py --write

# Writes the last results of the benches into the pages.
tables:
	@tests/bench/tables.py man/ceduo-accuracy.7 man/ceduo-validation.7

# Draws the screens of README from their keys, and writes its page.
pictures: all
	@CEDUO=$(call quoted,$(CURDIR)/$(PROGRAM)) BUILD=$(BUILD) tests/cli/test_workflows.py --readme

SCRIPTS_COMPLETION := $(BUILD)/completion/ceduo $(BUILD)/completion/_ceduo
$(SCRIPTS_COMPLETION): $(COMPLETION)
	@mkdir -p $(@D)
	@$(COMPLETION) $(if $(findstring _ceduo,$@),zsh,bash) >$@

# ---- installing and packing ----

.PHONY: install uninstall dist deb clean
install: all $(SCRIPTS_COMPLETION)
install uninstall:
	@$(foreach v,BUILD VERSION SONAME LANGUAGES PAGES_IT LIBRARY_LIBS DESTDIR BINDIR DATADIR MANDIR \
	    LOCALEDIR LIBDIR INCLUDEDIR BASHDIR ZSHDIR,$v=$(call quoted,$($v))) src/packaging/install.sh $@

dist:
	src/packaging/release dist $(VERSION)

# Packages for Debian, built from the sources packed as above.
deb: dist
	@+$(MAKE) --no-print-directory DEBIAN="$(DEBIAN) debhelper lintian" deps
	src/packaging/release deb $(VERSION)

clean:
	rm -rf build ceduo ceduo-$(VERSION).tar.gz

include tests/tests.mk

.DELETE_ON_ERROR:
endif
