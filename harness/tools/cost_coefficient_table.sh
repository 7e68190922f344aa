#!/bin/sh
# Writes the table of cost coefficients (harness/study/study.h) from cost_coefficients.csv.
# usage: cost_coefficient_table.sh OUT.c cost_coefficients.csv   OUT.c is rewritten only if it changes.
set -eu
mkdir -p "$(dirname "$1")"
awk -F, '
BEGIN {
    print "/* Generated from harness/study/cost_coefficients.csv. */"
    print "#include \"harness/study/study.h\""
    print "#include <stddef.h>"
    print "const cost_coefficient cost_coefficients[] = {"
}
/^#/ || /^formulation,/ { next }
$1 == "noise" { noise = $3; next }
{
    name = $1; gsub(/;/, ",", name)
    printf "    {\"%s\", COUNTED_%s, %s},\n", name, $2, $3
}
END {
    print "    {NULL, COUNTED_one, 0}};"
    print "const double counted_cost_noise = " noise ";"
}' "$2" >"$1.new"
if cmp -s "$1.new" "$1"; then rm "$1.new"; else mv "$1.new" "$1"; fi
