#!/bin/sh
# Removes the files in the list written by 'make install', and then the folders of beamwork that are empty.
set -eu
list=$DESTDIR$SHAREDIR/beamwork/installed
[ -f "$list" ] || { echo "nothing is installed there: no $list"; exit 1; }
count=0
while IFS= read -r file; do
    rm -f "$DESTDIR$file"
    count=$((count + 1))
done <"$list"
rm -f "$list"
for folder in "$SHAREDIR/beamwork" "$INCLUDEDIR/beamwork" "$LIBDIR/cmake/beamwork" "$SHAREDIR/doc/beamwork" "$PYTHONDIR/beamwork"; do
    [ ! -d "$DESTDIR$folder" ] || find "$DESTDIR$folder" -depth -type d -empty -delete
done
echo "removed $count files below ${DESTDIR:-}$PREFIX"
