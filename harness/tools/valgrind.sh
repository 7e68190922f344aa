#!/bin/sh
# Runs a small selection of 'verify', including worker processes, and the C library with valgrind. No access may be invalid or uninitialised, and no memory lost.
# usage: valgrind.sh BUILD
set -u
build=$1
logs=$build/valgrind
command -v valgrind >/dev/null 2>&1 || { echo "valgrind is needed. Run: sudo apt-get install valgrind"; exit 1; }
rm -rf "$logs"
mkdir -p "$logs"
bad=0 cells=0
for selection in "elastica/default" "c_column/default and beamw_consistent" "warping_torsion/default" "sheet_wagner/default and sheet_third" "moment_buckling/default and collocation"; do
    printed=$(OPENBLAS_CORETYPE=Nehalem valgrind --quiet --leak-check=full --errors-for-leak-kinds=definite --error-exitcode=9 --log-file="$logs/%p.log" \
        "$build/beamwork" verify --time-limit 0 -j 2 -k "$selection" -o "$logs/r.h5") || { bad=1; echo "$printed" | tail -n 5; }
    cells=$((cells + $(echo "$printed" | sed -nE 's/^([0-9]+) cells[,;].*/\1/p')))
done
# The library makes and frees a thousand scenes and solutions.
printed=$(OPENBLAS_CORETYPE=Nehalem BEAMWORK_TRUTHS="$build/truths.h5" valgrind --quiet --leak-check=full --errors-for-leak-kinds=definite --error-exitcode=9 \
    --log-file="$logs/%p.log" "$build/harness/library/test/cycles" 1000) || bad=1
echo "$printed"
found=$(cat "$logs"/*.log | grep -cE '^==[0-9]+== (Invalid|Conditional|Use of|Syscall|[0-9,]+ bytes in [0-9,]+ blocks are definitely)')
[ "$found" = 0 ] || cat "$logs"/*.log | head -n 60
echo "valgrind: $cells cells, $found errors"
[ "$found" = 0 ] && [ $bad = 0 ]
