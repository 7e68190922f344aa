#!/bin/sh
# A run in N shards, each a process that mpirun starts (Open MPI), then merged. No shard sends a message to another.
# usage: mpirun.sh N FOLDER OUTPUT VERB ARGUMENT...
# All nodes see FOLDER. BEAMWORK: the program; OMPI_MCA_orte_default_hostfile, OMPI_MCA_rmaps_base_oversubscribe=1 and so on: man mpirun.
# When one process is killed mpirun ends the others: start again, what is finished stays.
set -eu
program=${BEAMWORK:-beamwork} n=$1 folder=$2 output=$3
shift 3
status=0
mpirun --bind-to none -n "$n" sh -c 'program=$1 folder=$2
    shift 2
    exec "$program" "$@" --shard "$((OMPI_COMM_WORLD_RANK + 1))/$OMPI_COMM_WORLD_SIZE" --into "$folder"' \
    shard "$program" "$folder" "$@" || status=$?
[ $status = 0 ] || echo "mpirun.sh: mpirun ended with status $status; merging what is there" >&2
exec "$program" merge "$folder" -o "$output"
