#!/bin/sh
# Builds the Debian packages in a copy of the source and writes them to FOLDER. As root, missing tools are installed first;
# the build itself fetches nothing from the network.
# usage: deb.sh VERSION RELEASED FOLDER
set -eu
version=$1 released=$2 folder=$3
here=$(dirname "$0")
cd "$here/../../.."
harness/tools/dependencies.sh deb
rm -rf "$folder"
copy=$folder/beamwork-$version
mkdir -p "$copy"
# Files of the source: in a clone, the files tracked by git; otherwise, all files except built files.
if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files -z
else
    find . -path ./build -prune -o -type f -print0
fi | tar -cf - --null -T - | tar -xf - -C "$copy"
cp -r harness/library/packaging/debian "$copy/debian"
sed "s/@VERSION@/$version/; s/@DATE@/$(LC_ALL=C date -u -d "$released" -R)/" "$copy/debian/changelog.in" >"$copy/debian/changelog"
rm "$copy/debian/changelog.in"
unset MAKEFLAGS MFLAGS MAKELEVEL
export DEB_BUILD_OPTIONS="noautodbgsym ${DEB_BUILD_OPTIONS:-}"
(cd "$copy" && dpkg-buildpackage -us -uc -b >../build.log 2>&1) || {
    tail -n 30 "$folder/build.log"
    exit 1
}
rm -rf "$copy"
ls "$folder"/*.deb
