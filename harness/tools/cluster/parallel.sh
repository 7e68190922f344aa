#!/bin/sh
# A run in N shards, each a job of GNU parallel, here or over ssh on other machines, then merged.
# usage: parallel.sh N FOLDER OUTPUT VERB ARGUMENT...
# All machines see FOLDER under the same name. BEAMWORK: the program; PARALLEL='--jobs 4', PARALLEL='--sshloginfile hosts --workdir .' and so on: man parallel.
set -eu
program=${BEAMWORK:-beamwork} n=$1 folder=$2 output=$3
shift 3
status=0
seq "$n" | parallel --quote "$program" "$@" --shard "{}/$n" --into "$folder" || status=$?
[ $status = 0 ] || echo "parallel.sh: parallel ended with status $status; merging what is there" >&2
exec "$program" merge "$folder" -o "$output"
