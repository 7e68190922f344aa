#!/bin/sh
# Writes the two generated lists (formulations, cases) from the names of the files that exist.
# usage: registry.sh OUT.c elements/a.c ... cases/b.c cases/c.yaml ...   OUT.c is rewritten only if it changes.
set -eu
out=$1
shift
formulations=
cases=
for file in "$@"; do
    name=$(basename "${file%.*}")
    case $file in
    elements/*) formulations="$formulations $name" ;;
    cases/*) cases="$cases $name" ;;
    esac
done
mkdir -p "$(dirname "$out")"
{
    echo '/* Generated from the files in elements/ and cases/. */'
    echo '#include "harness/formulations/formulations.h"'
    echo '#include <stddef.h>'
    for n in $formulations; do echo "extern const element_type element_$n;"; done
    for n in $cases; do echo "extern const case_type case_$n;"; done
    echo 'const element_type *const registry_formulations[] = {'
    for n in $formulations; do echo "    &element_$n,"; done
    echo '    NULL};'
    echo 'const case_type *const registry_cases[] = {'
    for n in $cases; do echo "    &case_$n,"; done
    echo '    NULL};'
} >"$out.new"
if cmp -s "$out.new" "$out"; then rm "$out.new"; else mv "$out.new" "$out"; fi
