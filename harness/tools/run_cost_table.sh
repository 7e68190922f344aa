#!/bin/sh
# Writes the table of expected costs (harness/study/study.h) from run_cost.csv.
# usage: run_cost_table.sh OUT.c run_cost.csv   OUT.c is rewritten only if it changes.
set -eu
mkdir -p "$(dirname "$1")"
awk -F, '
BEGIN {
    print "/* Generated from harness/study/run_cost.csv. */"
    print "#include \"harness/study/study.h\""
    print "#include <stddef.h>"
}
/^#/ || /^table,/ { next }
$1 == "work" { work = work sprintf("    [RUN_COST_%s] = {%s, %s},\n", $2, $3, $4) }
$1 == "formulation" { factor = factor sprintf("    {\"%s\", {%s, %s}},\n", $2, $3, $4) }
END {
    printf "const run_cost_pair run_cost_work[RUN_COST_KINDS] = {\n%s};\n", work
    printf "const run_cost_factor run_cost_factors[] = {\n%s    {NULL, {1, 1}}};\n", factor
}' "$2" >"$1.new"
if cmp -s "$1.new" "$1"; then rm "$1.new"; else mv "$1.new" "$1"; fi
