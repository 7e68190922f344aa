#!/bin/sh
# Writes the table of cost coefficients (harness/study/study.h) from prices.csv.
# usage: price_table.sh OUT.c prices.csv   OUT.c is rewritten only if it changes.
set -eu
mkdir -p "$(dirname "$1")"
awk -F, '
BEGIN {
    print "/* Generated from harness/study/prices.csv. */"
    print "#include \"harness/study/study.h\""
    print "#include <stddef.h>"
    print "const price_row price_rows[] = {"
}
/^#/ || /^formulation,/ { next }
$1 == "noise" { noise = $3; next }
{
    name = $1; gsub(/;/, ",", name)
    factors = split($2, factor, "*")
    printf "    {\"%s\", PRICE_%s, PRICE_%s, %s},\n", name, factor[1], (factors > 1 ? factor[2] : "one"), $3
}
END {
    print "    {NULL, PRICE_one, PRICE_one, 0}};"
    print "const double price_noise = " noise ";"
}' "$2" >"$1.new"
if cmp -s "$1.new" "$1"; then rm "$1.new"; else mv "$1.new" "$1"; fi
