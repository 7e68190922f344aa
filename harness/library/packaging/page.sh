#!/bin/sh
# Prints a hand-written manual page, completed by the version, the date and the physics in the headers.
# usage: page.sh PAGE VERSION DATE >build/man/PAGE
set -eu
here=$(dirname "$0")
header=$here/../../../elements
date=$(LC_ALL=C date -u -d "$3" '+%B %-d, %Y')
abi=$(sed -n 's/^enum { ELEMENT_ABI = \([0-9]*\) };/\1/p' "$header/element.h")
# Reads the rows of the table: {FEATURE_X, "name", "summary"}, on one or two lines.
features=$(tr '\n' ' ' <"$header/feature.h" | grep -oE '\{FEATURE_[A-Z_]+, *"[^"]+", *"[^"]+"\}' |
    sed -E "s/^[^\"]*\"([^\"]+)\", *\"([^\"]+)\"\}/.It \1\n\2/; s/'/\\\\(aq/g; s/\^/\\\\(ha/g; s/-/\\\\-/g")
while IFS= read -r line; do
    case $line in
    @FEATURES@*) printf '%s\n%s\n' "$features" "${line#@FEATURES@}" ;;
    *) printf '%s\n' "$line" ;;
    esac
done <"$here/$1" | sed "s/@VERSION@/$2/; s/@RELEASED@/$date/; s/@ABI@/$abi/"
