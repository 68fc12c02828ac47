"""A study on HyperQueue workers (PyPI: hyperqueue).

    python examples/campaign/hyperqueue_study.py SUITE DIR SHARDS [--local WORKERS]

Shards go to the server that `hq server start` left in the usual place or in
$HQ_SERVER_DIR, whose workers all see DIR; with `--local`, to workers of one core each
that live as long as this script. HyperQueue starts a task again elsewhere when its worker
dies; one that was itself killed is submitted again here. Both go on behind their last row.
"""

import argparse
import contextlib
import os
import subprocess
from pathlib import Path

from hyperqueue import Client, Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

VPL = os.environ.get("VPL", "vpl")
TRIES = 10


@contextlib.contextmanager
def client_of(workers: int):
    if not workers:
        yield Client(os.environ.get("HQ_SERVER_DIR"))
        return
    with LocalCluster() as cluster:
        for _ in range(workers):
            cluster.start_worker(WorkerConfig(cores=1))
        yield cluster.client()


def run(client: Client, suite: str, out: str, numbers: list[int], of: int) -> list[int]:
    """Runs some shards; gives those that failed."""
    job = Job(max_fails=None)
    for number in numbers:
        command = [VPL, "study", suite, "--out", out, "--shard", f"{number}/{of}", "--threads", "1"]
        job.program(command, stdout=None, stderr=None, name=f"shard {number}/{of}", crash_limit=TRIES)
    submitted = client.submit(job)
    if client.wait_for_jobs([submitted], raise_on_error=False):
        return []
    return [numbers[task] for task in sorted(client.get_failed_tasks(submitted))]


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("suite", type=Path)
    arguments.add_argument("out", type=Path)
    arguments.add_argument("shards", type=int)
    arguments.add_argument("--local", type=int, default=0, metavar="WORKERS")
    given = arguments.parse_args()
    suite, out = str(given.suite.resolve()), str(given.out.resolve())
    left = list(range(1, given.shards + 1))
    with client_of(given.local) as client:
        for _ in range(TRIES):
            left = run(client, suite, out, left, given.shards)
            if not left:
                break
            print(f"again: shards {left}", flush=True)
    if left:
        raise SystemExit(f"shards {left} failed {TRIES} times: see `{VPL} study {suite} --out {out} --shard {left[0]}/{given.shards}`")
    subprocess.run([VPL, "study", suite, "--out", out], check=True)


if __name__ == "__main__":
    main()
