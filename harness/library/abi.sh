#!/bin/sh
# Compares the functions of the shared library, with their arguments and types, with harness/library/libbeamwork.abi (abigail-tools).
# A program that was linked with an older library runs with a newer library if no function has been removed or changed.
# usage: abi.sh SHARED [accept]     accept: the present functions become the new dump
# Exit status: 0 if the functions are the same, 1 if they differ, 4 if no dump could be made. If abidiff is missing, prints a message and ends with 0.
set -u
shared=$1 dump=harness/library/libbeamwork.abi
command -v abidw >/dev/null 2>&1 || { echo "SKIP abi: needs abidiff (abigail-tools)"; exit 0; }
now=$(mktemp)
trap 'rm -f "$now" "$now.diff"' EXIT
abidw --header-file harness/library/beamwork.h --exported-interfaces-only --drop-private-types --drop-undefined-syms --no-corpus-path \
    --no-comp-dir-path --no-show-locs --no-elf-needed --no-architecture --out-file "$now" "$shared" || exit 4
[ -s "$now" ] || { echo "abi: $shared shows no functions; was it compiled without -g?"; exit 4; }
if [ "${2:-}" = accept ]; then
    cp "$now" "$dump" && echo "abi: accepted; commit $dump"
    exit
fi
abidiff "$dump" "$now" >"$now.diff" && { echo "abi: $(grep -c '<elf-symbol ' "$dump") functions, as in $dump"; exit 0; }
cat "$now.diff"
if grep -qE '[1-9][0-9]* (Removed|Changed)' "$now.diff"; then
    echo "abi: programs that were linked before would break. Bring it back; or raise the number of the library (SHARED) and 'make abi ACCEPT=1'"
else
    echo "abi: more than before. Where that is meant: 'make abi ACCEPT=1', and commit"
fi
exit 1
