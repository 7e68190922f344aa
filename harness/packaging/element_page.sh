#!/bin/sh
# beamwork-element(7), with the version, the date and the physics of the headers.
# usage: element_page.sh VERSION DATE >beamwork-element.7
set -eu
here=$(dirname "$0")
header=$here/../../elements
date=$(LC_ALL=C date -u -d "$2" '+%B %-d, %Y')
abi=$(sed -n 's/^enum { ELEMENT_ABI = \([0-9]*\) };/\1/p' "$header/element.h")
# The rows of its table: {FEATURE_X, "name", "summary"}, also over two lines.
features=$(tr '\n' ' ' <"$header/feature.h" | grep -oE '\{FEATURE_[A-Z_]+, *"[^"]+", *"[^"]+"\}' |
    sed -E "s/^[^\"]*\"([^\"]+)\", *\"([^\"]+)\"\}/.It \1\n\2/; s/'/\\\\(aq/g; s/\^/\\\\(ha/g; s/-/\\\\-/g")
while IFS= read -r line; do
    case $line in
    @FEATURES@*) printf '%s\n%s\n' "$features" "${line#@FEATURES@}" ;;
    *) printf '%s\n' "$line" ;;
    esac
done <"$here/beamwork-element.7" | sed "s/@VERSION@/$1/; s/@RELEASED@/$date/; s/@ABI@/$abi/"
