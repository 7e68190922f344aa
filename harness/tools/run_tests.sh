#!/bin/sh
# Runs every test program given and every Python test, and ends in one line: N passed, M failed.
# usage: run_tests.sh LOGDIR program... [-- python_test_dir...]
set -u
logs=$1
shift
mkdir -p "$logs"
passed=0 failed=0
tally() { # name log exit-status
    p=$(grep -c '^PASS' "$2") f=$(grep -c '^FAIL' "$2")
    if [ "$3" != 0 ] && [ "$f" = 0 ]; then f=1; echo "FAIL $1 ended with status $3"; tail -n 5 "$2"; fi
    if [ "$p" = 0 ] && [ "$f" = 0 ]; then f=1; echo "FAIL $1 checked nothing"; fi
    passed=$((passed + p)) failed=$((failed + f))
    [ "$f" = 0 ] || grep '^FAIL' "$2"
    printf '%-44s %5d passed %3d failed\n' "$1" "$p" "$f"
}
python=0
for program in "$@"; do
    if [ "$program" = -- ]; then python=1; continue; fi
    name=$(basename "$program")
    log=$logs/$name.log
    if [ $python = 1 ]; then
        name=$program
        log=$logs/$(echo "$program" | tr / _).log
        /usr/bin/python3 -m unittest discover -v -s "$program" -t . -p '*_test.py' >"$log.raw" 2>&1
        status=$?
        sed -nE 's/^(.*) \.\.\. ok$/PASS: \1/p; s/^(.*) \.\.\. (FAIL|ERROR)$/FAIL: \1/p' "$log.raw" >"$log"
        [ $status = 0 ] || tail -n 30 "$log.raw" | sed 's/^/    /' >&2
    else
        GSL_TEST_VERBOSE=1 "$program" >"$log" 2>&1
        status=$?
    fi
    tally "$name" "$log" $status
done
echo "$passed passed, $failed failed"
[ $failed = 0 ]
