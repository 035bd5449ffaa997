# SPDX-License-Identifier: GPL-3.0-or-later
# ceduo: rockfall among the stems of a coppice.
#
#   make            the program, ./ceduo          make check      the tests that CI runs
#   make deps       installs what Debian lacks    make check-all  sanitizers, valgrind, tmux: slow
#   make run        the paper's site as a page    make bench      speed, against a plain C loop
#   make install    PREFIX, DESTDIR               VARIANT=release|debug|asan|tsan|cov

VERSION := $(shell sed -n 's/.*CEDUO_VERSION "\(.*\)"/\1/p' include/ceduo/version.h)
VARIANT ?= release
PREFIX ?= /usr/local
DESTDIR ?=
BINDIR ?= $(PREFIX)/bin
DATADIR ?= $(PREFIX)/share/ceduo
MANDIR ?= $(PREFIX)/share/man
BUILD := build/$(VARIANT)
CC ?= gcc

WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wformat=2
OPTIMISE_release := -O2
OPTIMISE_debug := -O0 -g
OPTIMISE_asan := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
OPTIMISE_tsan := -O1 -g -fsanitize=thread
OPTIMISE_cov := -O0 -g --coverage
CFLAGS ?= $(OPTIMISE_$(VARIANT))
# -ffp-contract=off: a fused multiply-add would give other bits on other machines.
ALL_CFLAGS = -std=c17 -D_XOPEN_SOURCE=700 -D_DEFAULT_SOURCE -Iinclude -Isrc $(WARNINGS) -ffp-contract=off -pthread \
	-MMD -MP $(CFLAGS) $(EXTRA_CFLAGS)
LIBS = -lyaml -lgsl -lgslcblas -lm

CORE := $(wildcard src/core/*.c)
REST := $(filter-out src/cli/main.c,$(wildcard src/io/*.c src/model/*.c src/view/*.c src/tui/*.c src/cli/*.c))
object = $(patsubst %.c,$(BUILD)/%.o,$(1))
LIBRARY := $(BUILD)/libceduo.a
PARTS := $(BUILD)/libparts.a
PROGRAM := $(BUILD)/ceduo

ifeq ($(VARIANT),release)
all: ceduo
ceduo: $(PROGRAM)
	cp $(PROGRAM) $@
else
all: $(PROGRAM)
endif

$(LIBRARY): $(call object,$(CORE))
	@rm -f $@
	$(AR) rcsD $@ $^

$(PARTS): $(call object,$(REST))
	@rm -f $@
	$(AR) rcsD $@ $^

$(PROGRAM): $(call object,src/cli/main.c) $(PARTS) $(LIBRARY)
	$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) $(DEFINES) -c -o $@ $<

# The program looks for its profiles where it was built and where it is installed.
$(BUILD)/src/io/paths.o: DEFINES = -DCEDUO_SOURCE_PROFILES='"$(CURDIR)/profiles"' -DCEDUO_DATADIR='"$(DATADIR)"'

-include $(shell find build -name '*.d' 2>/dev/null)

clean:
	rm -rf build ceduo

.PHONY: all clean
.DELETE_ON_ERROR:
