#!/usr/bin/env bash
# A study on HyperQueue workers (https://it4innovations.github.io/hyperqueue).
#
#   hq server start &
#   hq worker start &                            # on as many machines as there are
#   examples/campaign/hyperqueue.sh SUITE DIR SHARDS
#
# A worker that dies takes no row with it: its shards are started again elsewhere and go
# on behind their last row.
set -euo pipefail
suite=$(realpath "$1") shards=$3
mkdir -p "$2"
out=$(realpath "$2")
"${HQ:-hq}" submit --wait --array "1-$shards" --crash-limit 10 --cpus 1 --stdout none --stderr none \
  -- "${VPL:-vpl}" study "$suite" --out "$out" --shard "%{TASK_ID}/$shards" --threads 1
"${VPL:-vpl}" study "$suite" --out "$out"
