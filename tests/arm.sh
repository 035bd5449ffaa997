#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Another processor architecture: compiles the tests of physics for 64-bit ARM, runs them with qemu, and compares the bits of rocks
# with those of this machine. Debian's libraries for ARM are unpacked below build and not installed.
set -e
cd "$(dirname "$0")/.."
arm=$PWD/build/debian-arm
mkdir -p "$arm/lists/partial" "$arm/archives/partial" "$arm/system"
: >"$arm/status"
for step in update 'install -y -q --download-only --no-install-recommends libncurses-dev libgsl-dev libyaml-dev libunistring-dev libcmocka-dev'; do
    apt-get -q -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State::Lists="$arm/lists" \
        -o Dir::Cache::Archives="$arm/archives" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= \
        -o Dir::State::status="$arm/status" $step >"$arm/apt.log" 2>&1 || { cat "$arm/apt.log"; exit 1; }
done
rm -f "$arm"/archives/libc6-dev_* # the compiler has its own
for package in "$arm"/archives/*.deb; do dpkg -x "$package" "$arm/system"; done
linked() { printf -- '-L%s -Wl,-rpath-link,%s ' "$1" "$1"; }
link=$(linked "$arm/system/usr/lib/aarch64-linux-gnu" && linked "$arm/system/lib/aarch64-linux-gnu")
tests='physics/test_golden physics/test_lanes physics/test_years physics/test_elementary'
make --no-print-directory -j"$(nproc)" VARIANT=arm CC=aarch64-linux-gnu-gcc CFLAGS=-O2 LDFLAGS="$link" $(printf 'build/arm/tests/%s ' $tests)
for test in $tests; do qemu-aarch64 -L "$arm/system" "build/arm/tests/$test"; done

bits() { # build compiler...
    build=build/$1
    shift
    "$@" -std=c17 -Iinclude -Isrc -Itests -o $build/bits tests/physics/bits.c tests/physics/paper_site.c $build/libceduo.a \
        -lunistring -lgsl -lgslcblas -lm -pthread
}
make --no-print-directory build/release/libceduo.a
bits release gcc
bits arm aarch64-linux-gnu-gcc $link
build/release/bits 1 >build/release/bits.txt
qemu-aarch64 -L "$arm/system" build/arm/bits 1 | cmp - build/release/bits.txt
echo "the same bits on ARM"
