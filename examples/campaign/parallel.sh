#!/usr/bin/env bash
# A study on the cores of one machine or of several, by GNU parallel.
#
#   examples/campaign/parallel.sh SUITE DIR SHARDS [--sshlogin a,b …]
#
# Shards write to one folder that all machines see, each to a file of its own. A shard
# that was killed goes on where it stopped: call it again. `--joblog` and `--resume-failed`
# of parallel work as usual.
set -euo pipefail
suite=$1 out=$2 shards=$3
shift 3
seq "$shards" | parallel --halt never --retries 3 "$@" \
  "${VPL:-vpl}" study "$suite" --out "$out" --shard {}/"$shards" --threads 1
"${VPL:-vpl}" study "$suite" --out "$out"
