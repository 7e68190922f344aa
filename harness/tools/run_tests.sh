#!/bin/sh
# Runs test programs, and files or folders of tests in Python, with one process per processor.
# Ends with a line: N passed, M failed[, K skipped]. Skipped tests are listed with the reason, such as "SKIP name: needs chromium".
# usage: [SHOW=1] run_tests.sh LOGDIR PROGRAM|FILE.py|FOLDER...     SHOW=1: also prints the output of the tests
set -u
# [s] time limit of a test, far above the longest time on a slow machine with sanitizers
limit=1200
# Programs share the processors, so several threads of OpenBLAS would wait for each other.
export OPENBLAS_NUM_THREADS="${OPENBLAS_NUM_THREADS:-1}"

# Extracts the results from the output of unittest. The line of a test is its name, or its name followed by its docstring.
verdicts() {
    awk '/^[A-Za-z_]+ \(/ { name = $2; gsub(/[()]/, "", name) }
        / \.\.\. ok$/ { sub(/ \.\.\. ok$/, ""); print "PASS: " $0 }
        / \.\.\. (FAIL|ERROR)$/ { sub(/ \.\.\. (FAIL|ERROR)$/, ""); print "FAIL: " $0 }
        / \.\.\. skipped / { sub(/^.* \.\.\. skipped ./, ""); sub(/.$/, ""); print "SKIP " name ": " $0 }'
}
# Prints the processor time [s] from the output of `times`.
processor() {
    awk 'function seconds(t, of) { split(t, of, "[ms]"); return 60 * of[1] + of[2] }
        NR == 2 { print seconds($1) + seconds($2) }' "$1"
}
tally() { # name log exit-status
    p=$(grep -c '^PASS' "$2") f=$(grep -c '^FAIL' "$2") k=$(grep -c '^SKIP' "$2")
    if [ "$3" != 0 ] && [ "$f" = 0 ]; then f=1; echo "FAIL $1 ended with status $3"; tail -n 5 "$2"; fi
    if [ "$p" = 0 ] && [ "$f" = 0 ] && [ "$k" = 0 ]; then f=1; echo "FAIL $1 checked nothing"; fi
    echo "$p $f $k" >"${2%.log}.count"
    [ "$f" = 0 ] || grep '^FAIL' "$2"
    [ "$k" = 0 ] || grep '^SKIP' "$2"
    printf '%-44s %5d passed %3d failed %6.1f s\n' "$1" "$p" "$f" "$(processor "${2%.log}.times")"
}
one() { # program, file or folder
    if [ -d "$1" ] || [ "${1%.py}" != "$1" ]; then
        name=$1 log=$logs/$(echo "$1" | tr / _).log
        if [ -d "$1" ]; then
            set -- discover -v -s "$1" -t . -p '*_test.py'
        else
            set -- -v "$1"
        fi
        timeout -k 30 $limit /usr/bin/python3 -m unittest "$@" >"$log.raw" 2>&1
        status=$?
        verdicts <"$log.raw" >"$log"
        [ $status = 0 ] || tail -n 30 "$log.raw" | sed 's/^/    /' >&2
    else
        name=$(basename "$1") log=$logs/$(echo "$1" | tr / _).log
        GSL_TEST_VERBOSE=1 timeout -k 30 $limit "$1" >"$log" 2>&1
        status=$?
    fi
    times >"${log%.log}.times" # not in a subshell, which has no child processes yet
    told=$([ -z "${SHOW:-}" ] || cat "$log.raw" 2>/dev/null || cat "$log"; tally "$name" "$log" $status) # printed at once
    echo "$told"
}

if [ "$1" = --one ]; then
    logs=$2
    one "$3"
    exit 0
fi
logs=$1
shift
mkdir -p "$logs" && rm -f "$logs"/*.count
[ $# = 0 ] || printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" sh -c '"$0" --one "$1" "$2"; exit 0' "$0" "$logs"
passed=0 failed=0 skipped=0 ran=0
for counts in "$logs"/*.count; do
    [ -e "$counts" ] || continue
    read -r p f k <"$counts"
    passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + k)) ran=$((ran + 1))
done
if [ $ran != $# ]; then
    echo "FAIL $ran of $# test programs and folders came to an end"
    failed=$((failed + 1))
fi
[ $skipped = 0 ] && more= || more=", $skipped skipped"
echo "$passed passed, $failed failed$more"
[ $failed = 0 ]
