#!/bin/sh
# Injects the faults of a list written by mutate.py into a copy of the project, one fault at a time. The narrowest check (a selection of 'verify', a test,
# or a program of reference/derive) must detect each physical fault, with the expected exit status.
# Writes WORK.json, lists the survivors, and ends with a line: N killed, M survived.
# usage: LIST=FILE [DRY=1] [FROM=WORD] [TIME=SECONDS] mutants.sh [WORK [WORD]]
#   WORD: only the faults whose name contains WORD; FROM: omits the faults before this one; DRY=1: only checks that each change matches its file
#   A generated fault is detected by the first of several checks that fails within TIME (600 s). A fault that does not compile, or that does not change the
#   machine code, does not count.
set -u
here=$(pwd)
work=${1:-build/mutants} only=${2:-} dry=${DRY:-} list=$LIST
case $work in /*) ;; *) work=$here/$work ;; esac
killed=0 survived=0 idle=0 rows= from=${FROM:-}
if [ -n "$(git ls-files -- "$work" 2>/dev/null | head -n 1)" ]; then
    echo "mutants.sh: $work holds files of the project, and WORK is emptied first: give another folder" >&2
    exit 2
fi
rm -rf "$work"
mkdir -p "$work/base"
git ls-files | tar -cf - -T - | tar -xf - -C "$work/base"
built() { make -s -C "$work/base" -j2 CFLAGS="${CFLAGS:--O1}" "$@"; }

# Builds the copy without a fault.
prepare() {
    built all >"$work/log" 2>&1 || { tail "$work/log"; exit 1; }
}

result() { # name expected status check
    if [ "$3" = idle ]; then
        idle=$((idle + 1)) word=idle
    elif [ "$3" = "$2" ]; then
        killed=$((killed + 1)) word=killed
    else
        survived=$((survived + 1)) word=SURVIVED
    fi
    printf '%-9s %-52s exit %-6s %s\n' "$word" "$1" "$3$([ "$3" = "$2" ] || [ "$3" = idle ] || echo ", not $2")" "$4"
    rows="$rows${rows:+,}
  {\"fault\": \"$1\", \"check\": \"$(echo "$4" | tr -d '"\\')\", \"expected\": \"$2\", \"exit\": \"$3\", \"killed\": $([ "$3" = "$2" ] && echo true || echo false)}"
}

# Runs the narrowest check in the copy. Returns its exit status.
check() {
    kind=$1
    shift
    cd "$work/base" || return 99
    case $kind in
    verify) timeout 300 build/beamwork verify -j 2 "$@" ;;
    test) built "build/$1" && BEAMWORK_TRUTHS=build/truths.h5 timeout 300 "build/$1" ;;
    python)
        BEAMWORK=build/beamwork BEAMWORK_TRUTHS=build/truths.h5 timeout 300 /usr/bin/python3 -m unittest "$@"
        ;;
    run) timeout 300 "$@" ;;
    any) noticed "$@" ;;
    esac
}

# Runs checks (tests in C, modules of tests in Python, verify:SELECTION), and writes the first failure to $work/noticed. A check that exceeds its time limit fails.
noticed() {
    export BEAMWORK="$PWD/build/beamwork" BEAMWORK_TRUTHS="$PWD/build/truths.h5" BEAMWORK_REFERENCE="$PWD/reference"
    until=$(($(date +%s) + ${TIME:-600}))
    for one; do
        [ "$(date +%s)" -lt $until ] || { echo "the checks of ${TIME:-600} s" >"$work/noticed"; return 0; }
        case $one in
        verify:*) timeout 120 build/beamwork verify -j 2 -k "${one#*:}" --not-worse-than harness/baseline.csv ;;
        */*) built "build/$one" && timeout 300 "build/$one" ;;
        *) timeout 300 /usr/bin/python3 -m unittest -f "$one" ;;
        esac
        status=$?
        [ $status = 0 ] || { echo "$one ($status)" >"$work/noticed"; return $status; }
    done
}

# Succeeds if the fault is requested.
wanted() {
    case $1 in *"$from"*) from= ;; *) return 1 ;; esac
    case $1 in *"$only"*) ;; *) return 1 ;; esac
}

# Tests a generated fault, which any failure detects. Compares its object file with the object file without the fault, which is restored at the end.
generated() {
    object=build/${file%.c}.o
    cp -p "$work/base/$object" "$work/object"
    if ! built "$object" >"$work/log" 2>&1; then
        result "$name" noticed idle "does not compile"
    elif cmp -s "$work/base/$object" "$work/object"; then
        result "$name" noticed idle "the same machine code"
    elif ! built all >"$work/log" 2>&1; then
        result "$name" noticed noticed "the build"
    else
        echo "all of $# checks" >"$work/noticed"
        (check any "$@") >"$work/log" 2>&1
        status=$?
        [ $status = 0 ] || status=noticed
        result "$name" noticed $status "$(cat "$work/noticed")"
    fi
    cp -p "$work/saved" "$work/base/$file"
    touch "$work/base/$file"
    built "$object" >"$work/log" 2>&1
}

# `plant` NAME FILE SED-EXPRESSION EXPECTED-STATUS CHECK...
plant() {
    name=$1 file=$2 change=$3 expected=$4
    shift 4
    wanted "$name" || return
    cp -p "$work/base/$file" "$work/saved"
    sed -i -E "$change" "$work/base/$file"
    if cmp -s "$work/saved" "$work/base/$file"; then
        result "$name" planted "nothing matched" "$*"
        return
    fi
    touch "$work/base/$file"
    if [ "$dry" ]; then
        result "$name" matches matches "$*"
    elif [ "$expected" = noticed ]; then
        shift # any
        generated "$@"
    elif built all >"$work/log" 2>&1; then
        (check "$@") >"$work/log" 2>&1
        result "$name" "$expected" $? "$*"
    else
        result "$name" "$expected" "not built" "$*"
    fi
    cp -p "$work/saved" "$work/base/$file"
    touch "$work/base/$file"
}
[ "$dry" ] || prepare
. "$list"
rm -rf "$work"
printf '{"killed": %d, "survived": %d, "mutants": [%s\n]}\n' "$killed" "$survived" "$rows" >"$work.json"
[ "$dry" ] && echo "$killed match, $survived do not" || echo "$killed killed, $survived survived$([ $idle = 0 ] || echo ", $idle do not count")"
[ $survived = 0 ]
