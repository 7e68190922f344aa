#!/bin/sh
# A run in N shards, each a job of an array of Slurm, and a job that merges them; waits for both.
# usage: slurm.sh N FOLDER OUTPUT VERB ARGUMENT...
# All nodes see FOLDER and OUTPUT. BEAMWORK: the program; SBATCH_TIMELIMIT, SBATCH_PARTITION and so on: man sbatch.
set -eu
program=${BEAMWORK:-beamwork} n=$1 folder=$2 output=$3
shift 3
if [ "$n" = merge ]; then
    exec "$program" merge "$folder" -o "$output"
elif [ "${SLURM_ARRAY_TASK_ID:-}" ]; then
    exec "$program" "$@" --shard "$SLURM_ARRAY_TASK_ID/$n" --into "$folder"
fi
mkdir -p "$folder.logs"
array=$(sbatch --parsable --array="1-$n" --output="$folder.logs/%a" "$0" "$n" "$folder" "$output" "$@")
status=0
sbatch --quiet --wait --dependency="afterany:${array%;*}" --output="$folder.logs/merge" "$0" merge "$folder" "$output" || status=$?
cat "$folder.logs/merge"
exit $status
