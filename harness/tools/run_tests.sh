#!/bin/sh
# Runs every test program given and every Python test, and ends in one line: N passed, M failed[, K skipped].
# A skipped test is named with what it needs: "SKIP name: needs chromium".
# usage: run_tests.sh LOGDIR program... [-- python_test_dir...]
set -u
logs=$1
shift
mkdir -p "$logs"
passed=0 failed=0 skipped=0
tally() { # name log exit-status
    p=$(grep -c '^PASS' "$2") f=$(grep -c '^FAIL' "$2") k=$(grep -c '^SKIP' "$2")
    if [ "$3" != 0 ] && [ "$f" = 0 ]; then f=1; echo "FAIL $1 ended with status $3"; tail -n 5 "$2"; fi
    if [ "$p" = 0 ] && [ "$f" = 0 ] && [ "$k" = 0 ]; then f=1; echo "FAIL $1 checked nothing"; fi
    passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + k))
    [ "$f" = 0 ] || grep '^FAIL' "$2"
    [ "$k" = 0 ] || grep '^SKIP' "$2"
    printf '%-44s %5d passed %3d failed\n' "$1" "$p" "$f"
}
# Of unittest's output: a test's line is its name, or its name and then its docstring.
verdicts() {
    awk '/^[A-Za-z_]+ \(/ { name = $2; gsub(/[()]/, "", name) }
        / \.\.\. ok$/ { sub(/ \.\.\. ok$/, ""); print "PASS: " $0 }
        / \.\.\. (FAIL|ERROR)$/ { sub(/ \.\.\. (FAIL|ERROR)$/, ""); print "FAIL: " $0 }
        / \.\.\. skipped / { sub(/^.* \.\.\. skipped ./, ""); sub(/.$/, ""); print "SKIP " name ": " $0 }'
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
        verdicts <"$log.raw" >"$log"
        [ $status = 0 ] || tail -n 30 "$log.raw" | sed 's/^/    /' >&2
    else
        GSL_TEST_VERBOSE=1 "$program" >"$log" 2>&1
        status=$?
    fi
    tally "$name" "$log" $status
done
[ $skipped = 0 ] && more= || more=", $skipped skipped"
echo "$passed passed, $failed failed$more"
[ $failed = 0 ]
