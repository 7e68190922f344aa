#!/bin/sh
# Checks the layers of the code: files include only files of lower layers, no layer names a part that it must not know,
# and neither files nor folders depend on each other in circles.
# usage: layers.sh OBJECT...
set -eu
bad=0
# rule PATHS... -- FORBIDDEN-REGEX -- reason
rule() {
    where=$1 pattern=$2 reason=$3
    hits=$(grep -rnE "^[[:space:]]*#[[:space:]]*include[[:space:]]+\"($pattern)" $where --include='*.c' --include='*.h' 2>/dev/null | grep -vE '/(test|kit)/' || true)
    if [ -n "$hits" ]; then
        echo "$hits" | sed "s|\$|   <- $reason|"
        bad=1
    fi
}
rule elements 'cases/|harness/|reference/|reports/' 'elements know no case, truth or solver'
rule elements/math 'elements/(section|element|feature|beamw|sheet|geometrically_exact|collocation|shared/[^s])' 'math is the lowest floor, but for status'
rule elements/shared 'elements/(beamw|sheet|geometrically_exact|collocation)' 'what all families share names none'
rule elements/sheet 'elements/(beamw|geometrically_exact|collocation)' 'families borrow from shared/ only'
rule elements/beamw 'elements/(sheet|geometrically_exact|collocation)' 'families borrow from shared/ only'
rule elements/geometrically_exact 'elements/(sheet|beamw|collocation)' 'families borrow from shared/ only'
rule elements/collocation 'elements/(sheet|beamw)' 'families borrow from shared/ and from what they solve'
rule elements/section 'elements/(element|beamw|sheet|geometrically_exact|collocation)' 'a section knows no element'
rule cases 'harness/|reference/|reports/|elements/(element|beamw|sheet|geometrically_exact|collocation)' 'a case knows no formulation and no solver'
rule cases/scene 'cases/format/' 'a scene knows no file'
# Layers of the harness, with the lowest layer first. A layer includes only files of itself and of lower layers.
floors="numerics formulations model section_forces newton time analysis study records terminal import_export experiments cli library"
above=$floors
for room in $floors; do
    above=${above#"$room"}
    above=${above# }
    [ -z "$above" ] || rule "harness/$room" "harness/($(echo $above | tr ' ' '|'))/" "$room stands below"
done
rule harness/numerics 'cases/|elements/(element|section|beamw|sheet|geometrically_exact|collocation)' 'numerics know no beam'
rule harness 'reference/|reports/|elements/(beamw|sheet|geometrically_exact|collocation)/' 'the harness names no formulation and no truth'
for room in ${floors%% study *}; do
    rule "harness/$room" 'cases/format/' 'what solves reads no files'
done
# The README of a folder begins with one sentence without "and".
for page in elements/README.md elements/*/README.md cases/README.md cases/*/README.md harness/*/README.md harness/*/*/README.md; do
    sed -n 2p "$page" | grep -E '^[^.:;]*\.$' | grep -qvw and || { echo "$page: begin with one sentence without 'and'"; bad=1; }
done
# It names the header that other folders include, and lists what the folder may include.
for room in $floors; do
    page=harness/$room/README.md entry=$room.h
    [ "$room" = library ] && entry=beamwork.h
    grep -q "^Read first: \`$entry\`" "$page" || { echo "$page: the first file to read is $entry"; bad=1; }
    may=$(sed -n '/^May include:/,/^$/p' "$page" | grep -o '`[^`]*`' | tr -d '`')
    hits=$(grep -hoE '^ *# *include +"[^"]+/[^"]+"' "harness/$room"/*.c "harness/$room"/*.h | cut -d '"' -f 2 | sort -u |
        awk -v room="$room" -v may="$may" 'BEGIN { n = split(may, word, /[ \n]+/) }
            { path = $0; sub("^harness/", "", path); ok = index(path, room "/") == 1
              for (i = 1; i <= n; i++) ok = ok || index(path "/", word[i] "/") == 1
              if (!ok) print }')
    [ -z "$hits" ] || { echo "$hits" | sed "s|\$|   <- $page does not list it|"; bad=1; }
done
# A file *_impl.h is internal to its folder. Tests of this folder may include it; texts that tools generate may not.
hits=$(grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]+"[^"]*_impl\.h"' elements cases harness --include='*.c' --include='*.h' 2>/dev/null |
    awk -F '[:"]' '{ home = $4; file = $1; sub("/[^/]*$", "", home); sub("/(test/)?[^/]*$", "", file) }
        file != home { print $0 "   <- this is internal to " home }' || true)
[ -z "$hits" ] || { echo "$hits"; bad=1; }
hits=$(grep -rnE 'include .{0,2}"[^"]*_impl\.h' harness/tools --include='*.sh' --include='*.py' --include='*.c' | grep -v '/layers.sh:' || true)
[ -z "$hits" ] || { echo "$hits" | sed 's|$|   <- generated texts include no internal header|'; bad=1; }
# The names of types are unique.
hits=$(grep -rhoE '^\} [a-z_0-9]+;' elements cases harness --include='*.c' --include='*.h' --exclude-dir=test --exclude-dir=tools --exclude-dir=examples | sort | uniq -d)
[ -z "$hits" ] || { echo "$hits" | sed 's|$|   <- two types have this name|'; bad=1; }
# The harness uses generated lists and names neither a formulation nor a case.
for file in elements/*.c cases/benchmarks/*; do
    [ -f "$file" ] || continue
    name=$(basename "${file%.*}")
    quoted="\"$name\"|"
    case $name in release) quoted="" ;; esac # also a word of scene files
    hits=$(grep -rnwE "${quoted}element_$name|case_$name" harness cases/format --include='*.c' --include='*.h' 2>/dev/null | grep -vE '/(test|kit)/' || true)
    if [ -n "$hits" ]; then
        echo "$hits" | sed "s|\$|   <- the harness names $name|"
        bad=1
    fi
done
# Reports call no program of beamwork, and reference values share no code with it.
hits=$(grep -rnE 'ctypes|cffi|libbeamwork|subprocess|os\.system' reports --include='*.py' 2>/dev/null | grep -vE '/(test|kit)/' || true)
[ -z "$hits" ] || { echo "$hits" | sed 's|$|   <- reports read files only|'; bad=1; }
hits=$(grep -rnE 'ctypes|cffi|libbeamwork|build/beamwork|import (harness|reports|elements)' reference --include='*.py' 2>/dev/null || true)
[ -z "$hits" ] || { echo "$hits" | sed 's|$|   <- a truth shares no code with what it judges|'; bad=1; }
# Solutions of one model in several threads share no variables.
hits=$(printf '%s\n' "$@" | grep -E '(^|/)harness/(model|section_forces|newton|time|analysis)/' | xargs -r objdump -t |
    awk '/file format/ { file = $1 } / O \.t?(data|bss)(\.rel(\.local)?)?[ \t]/ && $NF !~ /^__odr_asan\./ { print file " " $NF "   <- a variable that outlives the call" }')
[ -z "$hits" ] || { echo "$hits"; bad=1; }
/usr/bin/python3 harness/tools/circles.py "$@" || bad=1
[ $bad = 0 ] && echo "layers: every include points down, nothing in circles"
exit $bad
