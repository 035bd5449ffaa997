#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the files that make built, or removes them: src/packaging/install.sh install|uninstall
# The variables are those of the Makefile, which calls this. Files are removed by name, because other programs may have put
# theirs into the same folders. debhelper would run a file named install with other arguments.
set -eu
case ${1-} in install | uninstall) ;; *) echo "usage: $0 install|uninstall" >&2 && exit 2 ;; esac
installs() { [ "$action" = install ]; }
action=$1

files() { # mode folder file...
    mode=$1 to=$DESTDIR$2
    shift 2
    ! installs || { install -d -- "$to" && install -m "$mode" -- "$@" "$to/"; }
    installs || for file; do rm -f -- "$to/${file##*/}"; done
}

link() { # target path
    if installs; then ln -sf -- "$1" "$DESTDIR$2"; else rm -f -- "$DESTDIR$2"; fi
}

leave() { # folder
    installs || rmdir -- "$DESTDIR$1" 2>/dev/null || :
}

pkg_config() { # pkg-config takes a backslash before blanks and signs
    printf 'includedir=%s\nlibdir=%s\n' "$INCLUDEDIR" "$LIBDIR" | LC_ALL=C sed 's|[^[:alnum:]%+,./:=@_-]|\\&|g'
    printf '%s\n' '' 'Name: ceduo' 'Description: rockfall simulation through coppice' "Version: $VERSION" \
        'Cflags: -I${includedir}' 'Libs: -L${libdir} -lceduo' "Libs.private: $LIBRARY_LIBS -pthread"
}

files 755 "$BINDIR" "$BUILD/ceduo"
files 644 "$BASHDIR" "$BUILD/completion/ceduo"
files 644 "$ZSHDIR" "$BUILD/completion/_ceduo"
for section in 1 3 5 7; do files 644 "$MANDIR/man$section" man/*."$section"; done
for page in $PAGES_IT; do files 644 "$MANDIR/it/man${page##*.}" "$page"; done
for l in $LANGUAGES; do files 644 "$LOCALEDIR/$l/LC_MESSAGES" "$BUILD/locale/$l/LC_MESSAGES/ceduo.mo"; done
for kind in scenes/*.yaml slopes/*.yaml stands/*.yaml rules/*.yaml surveys/*.csv observed/* jobs/*.sbatch \
    region/slurm/*.yaml region/*.* region/Snakefile; do
    files 644 "$DATADIR/${kind%/*}" profiles/$kind
    leave "$DATADIR/${kind%/*}"
done
files 644 "$DATADIR/examples" man/examples/*
leave "$DATADIR/examples"
leave "$DATADIR"
files 644 "$LIBDIR" "$BUILD/libceduo.a" "$BUILD/libceduo.so.$VERSION"
link "libceduo.so.$VERSION" "$LIBDIR/$SONAME"
link "$SONAME" "$LIBDIR/libceduo.so"
! installs || pkg_config >"$BUILD/ceduo.pc"
files 644 "$LIBDIR/pkgconfig" "$BUILD/ceduo.pc"
files 644 "$INCLUDEDIR/ceduo" include/ceduo/*.h
leave "$INCLUDEDIR/ceduo"

# The loader finds a library in a folder of the system only after this.
case $DESTDIR$LIBDIR in /usr/lib | /usr/local/lib) PATH=$PATH:/usr/sbin:/sbin ldconfig || : ;; esac
