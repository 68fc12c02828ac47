"""A study on a Ray cluster.

    python examples/campaign/ray_study.py SUITE DIR SHARDS

DIR is on a file system that all nodes see. A task whose worker dies is started again and
goes on behind its last row.
"""

import os
import subprocess
import sys
from pathlib import Path

import ray

VPL = os.environ.get("VPL", "vpl")


@ray.remote(num_cpus=1, max_retries=10, retry_exceptions=True)
def shard(suite: str, out: str, number: int, of: int) -> int:
    command = [VPL, "study", suite, "--out", out, "--shard", f"{number}/{of}", "--threads", "1"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return number


def main() -> None:
    suite, out, of = str(Path(sys.argv[1]).resolve()), str(Path(sys.argv[2]).resolve()), int(sys.argv[3])
    ray.init(address=os.environ.get("RAY_ADDRESS"), include_dashboard=False)
    waiting = [shard.remote(suite, out, number, of) for number in range(1, of + 1)]
    while waiting:
        done, waiting = ray.wait(waiting)
        print(f"shard {ray.get(done[0])}/{of} is done", flush=True)
    subprocess.run([VPL, "study", suite, "--out", out], check=True)


if __name__ == "__main__":
    main()
