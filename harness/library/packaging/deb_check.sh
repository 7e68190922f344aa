#!/bin/sh
# Checks the Debian packages in FOLDER: lintian must report no error and no warning, and the contents must work from an empty tree
# (the program with its reference values, an element and a program of a third party, Python, manual, completion).
# usage: deb_check.sh FOLDER
set -eu
folder=$(cd "$1" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
root=$tree/root
mkdir "$root" "$tree/work"
cd "$tree/work"

lintian --allow-root --fail-on error,warning "$folder"/*.changes
for package in "$folder"/*.deb; do dpkg-deb -x "$package" "$root"; done
libraries=$(dirname "$(find "$root/usr/lib" -name 'libbeamwork.so.0')")

"$root/usr/bin/beamwork" verify -k "c_column/default and collocation" >/dev/null
cc -O2 -shared -fPIC -I"$root/usr/include/beamwork" "$root/usr/share/beamwork/examples/elements/timoshenko.c" -o timoshenko.so
"$root/usr/bin/beamwork" solve elastica --element ./timoshenko.so -f timoshenko -n 16 >/dev/null

sed -n '/^```c$/,/^```$/{/^```/d;p}' "$OLDPWD/harness/library/packaging/api/index.md" >mine.c
PKG_CONFIG_PATH=$libraries/pkgconfig PKG_CONFIG_SYSROOT_DIR=$root \
    sh -c 'cc mine.c -o mine $(pkg-config --cflags --libs beamwork)'
LD_LIBRARY_PATH=$libraries BEAMWORK_TRUTHS=$root/usr/share/beamwork/truths.h5 ./mine >answer
grep -q '^0.3017.*error [0-9-]' answer || { echo "a program of somebody else says: $(cat answer)"; exit 1; }

PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -B -c '
import beamwork
result = beamwork.Scene.case("c_column").solve("collocation", elements=2)
assert abs(result["buckling_load"] - 12011055.7) < 0.1, result'

test -s "$root/usr/share/doc/beamwork-doc/api/index.html"
for page in beamwork.1 beamwork-solve.1 beamwork-scene.5 beamwork-element.7; do
    gzip -t "$root/usr/share/man/man${page##*.}/$page.gz"
done
bash --norc -c '
    source "$1/usr/share/bash-completion/completions/beamwork"
    COMP_LINE="$1/usr/bin/beamwork sol" COMP_POINT=${#COMP_LINE} COMP_WORDS=("$1/usr/bin/beamwork" sol) COMP_CWORD=1
    COMP_POINT=${#COMP_LINE}
    _beamwork
    [ "${COMPREPLY[*]}" = solve ]' bash "$root"
echo "the packages work from an empty tree"
