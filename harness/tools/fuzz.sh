#!/bin/sh
# Reads arbitrary bytes as every kind of input, with the address and undefined-behaviour sanitizers (harness/tools/fuzz/fuzz_*.c with libFuzzer of clang).
# Seeds come from reference tables and stored runs. Writes BUILD/fuzz.json, and ends with a line: N executions, M findings.
# usage: fuzz.sh BUILD [FACTOR]     FACTOR multiplies the number of executions
set -u
build=$1 factor=${2:-1}
here=$build/fuzz
flags="-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer"
command -v clang >/dev/null 2>&1 || { echo "fuzz: clang is needed. Run: sudo apt-get install clang"; exit 1; }
make -s -j2 BUILD="$here" CC=clang CFLAGS="$flags -fsanitize=fuzzer-no-link" "$here/libbeamwork.a" >"$build/fuzz.log" 2>&1 ||
    { tail "$build/fuzz.log"; exit 1; }
include=$(sed -n 's/^DEP_CFLAGS := //p' "$build/flags.mk") libraries=$(sed -n 's/^DEP_LIBS := //p' "$build/flags.mk")
rm -rf "$here/seeds" "$here/found" "$here/corpus"
/usr/bin/python3 harness/tools/fuzz_seeds.py "$build/beamwork" "$here/seeds" || exit 1
mkdir -p "$here/found"
total=0 findings=0 rows=

# fuzz NAME EXECUTIONS LONGEST [linker options]
fuzz() {
    name=$1 runs=$(($2 * factor)) longest=$3
    shift 3
    clang -std=c11 -D_GNU_SOURCE -I. $flags -fsanitize=fuzzer $include "harness/tools/fuzz/fuzz_$name.c" "$@" "$here/libbeamwork.a" $libraries -o "$here/fuzz_$name" ||
        { findings=$((findings + 1)); return; }
    mkdir -p "$here/corpus/$name"
    began=$(date +%s)
    ASAN_OPTIONS=detect_leaks=$leaks FUZZ_BASE=$here/seeds/$name/seed000 "$here/fuzz_$name" -seed=1 -runs="$runs" -max_len="$longest" -rss_limit_mb=4000 -close_fd_mask=1 \
        -artifact_prefix="$here/found/$name-" "$here/corpus/$name" "$here/seeds/$name" >"$here/$name.log" 2>&1
    status=$?
    done=$(sed -nE 's/^Done ([0-9]+) runs.*/\1/p' "$here/$name.log")
    done=${done:-0}
    total=$((total + done))
    if [ $status != 0 ]; then
        findings=$((findings + 1))
        grep -avE "NEW|REDUCE|pulse" "$here/$name.log" | tail -n 40
    fi
    printf '%-12s %8d executions  %4d s  %s\n' "$name" "$done" $(($(date +%s) - began)) "$([ $status = 0 ] && echo "no finding" || echo "FINDING: $here/found")"
    rows="$rows${rows:+,}
  {\"input\": \"$name\", \"executions\": $done, \"finding\": $([ $status = 0 ] && echo false || echo true)}"
}
leaks=1
fuzz words 500000 500
fuzz formula 300000 300
fuzz parameters 300000 500
fuzz table 300000 3000
fuzz scene 200000 4000
fuzz import 200000 2000
fuzz library 30000 4000
fuzz truths 4000 64
fuzz results 10000 64
leaks=0 # argp of the C library does not free its memory when the program ends
fuzz command 100000 300 -Wl,--wrap=exit,--wrap=argp_parse
printf '{"executions": %d, "findings": %d, "inputs": [%s\n]}\n' "$total" "$findings" "$rows" >"$build/fuzz.json"
echo "$total executions, $findings findings"
[ "$findings" = 0 ]
