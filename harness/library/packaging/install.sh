#!/bin/sh
# Installs the contents of BUILD. Called by 'make install', which sets the destination (DESTDIR, PREFIX, BINDIR, LIBDIR, INCLUDEDIR,
# SHAREDIR, PYTHONDIR), VERSION, and LIBS of the static library. SHAREDIR/beamwork/installed lists the written files for 'make uninstall'.
# usage: install.sh BUILD
set -eu
build=$1
data=$SHAREDIR/beamwork
list=$(mktemp)
trap 'rm -f "$list"' EXIT

put() { # mode source target
    install -D -m "$1" "$2" "$DESTDIR$3"
    echo "$3" >>"$list"
}

put 755 "$build/beamwork" "$BINDIR/beamwork"
put 755 harness/library/packaging/beamwork-report "$BINDIR/beamwork-report"

put 644 "$build/libbeamwork.so.0" "$LIBDIR/libbeamwork.so.0"
ln -sf libbeamwork.so.0 "$DESTDIR$LIBDIR/libbeamwork.so"
echo "$LIBDIR/libbeamwork.so" >>"$list"
put 644 "$build/static/libbeamwork.a" "$LIBDIR/libbeamwork.a"

# beamwork.h, and the element interface with all headers that it includes.
put 644 harness/library/beamwork.h "$INCLUDEDIR/beamwork/beamwork.h"
for header in $(printf '#include "elements/element.h"\n' | ${CC:-cc} -I. -E -M -xc - | tr ' \\' '\n\n' | grep '^elements/'); do
    put 644 "$header" "$INCLUDEDIR/beamwork/$header"
done

# fill SOURCE TARGET: replaces @NAME@ by its value, and @prefix/LIBDIR@ by a path relative to ${prefix} of pkg-config.
fill() {
    sed -e "s|@prefix/LIBDIR@|$(echo "$LIBDIR" | sed "s|^$PREFIX/|\${prefix}/|")|; s|@prefix/INCLUDEDIR@|$(echo "$INCLUDEDIR" | sed "s|^$PREFIX/|\${prefix}/|")|" \
        -e "s|@PREFIX@|$PREFIX|; s|@LIBDIR@|$LIBDIR|; s|@INCLUDEDIR@|$INCLUDEDIR|; s|@VERSION@|$VERSION|; s|@LIBS@|$LIBS|" "$1" >"$list.filled"
    put 644 "$list.filled" "$2"
    rm -f "$list.filled"
}
fill harness/library/packaging/beamwork.pc.in "$LIBDIR/pkgconfig/beamwork.pc"
fill harness/library/packaging/beamwork-config.cmake.in "$LIBDIR/cmake/beamwork/beamwork-config.cmake"
fill harness/library/packaging/beamwork-config-version.cmake.in "$LIBDIR/cmake/beamwork/beamwork-config-version.cmake"

for file in harness/library/python/beamwork/*.py harness/library/python/beamwork/peers/*.py harness/library/python/beamwork/py.typed; do put 644 "$file" "$PYTHONDIR/${file#harness/library/python/}"; done
put 644 elements/examples/beamwork_element.py "$PYTHONDIR/beamwork_element.py"

put 644 "$build/truths.h5" "$data/truths.h5"
for file in cases/examples/*.yaml; do put 644 "$file" "$data/examples/scenes/${file##*/}"; done
for file in elements/examples/*.*; do put 644 "$file" "$data/examples/elements/${file##*/}"; done

for file in harness/library/python/*.ipynb; do put 644 "$file" "$data/examples/python/${file##*/}"; done

# Programs that draw reports, and programs that derive reference values, with the files that they read.
for file in $(find reports reference -name test -prune -o -name __pycache__ -prune -o -type f -print | sort) elements/*.md; do
    put 644 "$file" "$data/$file"
done
# The report also ranks programs where the Python module is not installed; the module has a link to the same file.
file=harness/library/python/beamwork/peers/_ranking.py
put 644 "$file" "$data/$file"
ln -sfr "$DESTDIR$data/$file" "$DESTDIR$PYTHONDIR/${file#harness/library/python/}"

for page in "$build"/man/*.[0-9]; do put 644 "$page" "$SHAREDIR/man/man${page##*.}/${page##*/}"; done
put 644 harness/cli/beamwork.bash "$SHAREDIR/bash-completion/completions/beamwork"
put 644 harness/cli/_beamwork "$SHAREDIR/zsh/site-functions/_beamwork"
put 644 README.md "$SHAREDIR/doc/beamwork/README.md"
put 644 LICENSE "$SHAREDIR/doc/beamwork/LICENSE"
# Pages to which README.md and the manual refer authors of formulations.
for file in CONTRIBUTING.md harness/formulations/protocol.md; do put 644 "$file" "$SHAREDIR/doc/beamwork/$file"; done

install -D -m 644 "$list" "$DESTDIR$data/installed"
echo "installed $(wc -l <"$list") files below ${DESTDIR:-}$PREFIX"
# Folders that are not system folders require settings. These are printed.
case $PREFIX in /usr | /usr/local) exit ;; esac
[ -z "${DESTDIR:-}" ] || exit 0
echo "  programs and pkg-config find it after: export PATH=$BINDIR:\$PATH LD_LIBRARY_PATH=$LIBDIR PKG_CONFIG_PATH=$LIBDIR/pkgconfig"
case $PYTHONDIR in "$HOME/.local"/*) ;; *) echo "  Python finds its modules after: export PYTHONPATH=$PYTHONDIR" ;; esac
