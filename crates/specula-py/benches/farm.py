"""Measure the farm on two nodes: kills, efficiency, what Ray costs, an animation, merging.

Runs in network and process namespaces of its own. `cargo xtask farm` starts it. Figures go to
standard output, a line of JSON for each scenario; names as arguments choose scenarios.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

import farm_cluster
import farm_scenarios
from farm_cluster import HEAD, Cluster

SECONDS = float(os.environ.get("SPECULA_FARM_SECONDS", "120"))
"""What the render takes whose efficiency is measured."""


def start(cluster: Cluster) -> object:
    """Seconds to start a head and a second node."""
    begun = time.monotonic()
    offer = ["--cpus", "1", "--gpus", "1"]
    cluster.farm(["head", "--host", "127.0.0.2", "--port", "6399", *offer])
    head = time.monotonic()
    cluster.join()
    return {"head": round(head - begun, 1), "join": round(time.monotonic() - head, 1)}


TASKS = """
import json, sys, time
begun = time.monotonic()
from specula_render.farm import cluster
ray = cluster.load_ray()
ray.init(address=sys.argv[1], log_to_driver=False, logging_level="error")
ready = time.monotonic()
nothing = ray.remote(num_cpus=0)(lambda: None)
ray.get([nothing.remote() for _ in range(20)])
warm = time.monotonic()
ray.get([nothing.remote() for _ in range(1000)])
print(json.dumps({"init": ready - begun, "per task": (time.monotonic() - warm) / 1000}))
"""


def tasks(cluster: Cluster) -> object:
    """Seconds to connect, and for a task that does nothing."""
    done = subprocess.run(
        [sys.executable, "-c", TASKS, HEAD],
        env=cluster.environment,
        capture_output=True,
        text=True,
        check=True,
    )
    found: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return {name: round(value, 4) for name, value in found.items()}


def efficiency(cluster: Cluster) -> object:
    """Share of both nodes' time, from the command's start to its end, that samples took."""
    size = ["--resolution", "480x320"]
    cluster.render([*size, "--spp", "8", "-o", "pilot.exr"])
    done = [e for e in cluster.journal("pilot.farm") if e["event"] == "done"]
    second = sum(float(str(e["seconds"])) for e in done) / 8
    spp = max(16, round(SECONDS * 2 / second))
    begun = time.monotonic()
    cluster.render([*size, "--spp", str(spp), "-o", "long.exr"])
    wall = time.monotonic() - begun
    events = cluster.journal("long.farm")
    twins = {e["task"] for e in events if e["event"] == "begin" and e["twin"]}
    taken = [e for e in events if e["event"] == "done" and e["task"] not in twins]
    seconds = sum(float(str(e["seconds"])) for e in taken)
    return {"wall": round(wall, 1), "parts": len(taken), "efficiency": round(seconds / wall / 2, 3)}


def kills(cluster: Cluster) -> object:
    """20 kills of workers and 3 of a node, at random moments."""
    spp = int(os.environ.get("SPECULA_KILLS_SPP", "8192"))
    return farm_scenarios.kills(cluster, 20, 3, spp, every=4.0)


def animation(cluster: Cluster) -> object:
    """24 frames, by frames and by samples: seconds, parts, and whether the bits agree."""
    (cluster.folder / "turn24.xml").write_text(farm_scenarios.MITSUBA)
    found: dict[str, object] = {}
    for by in ("frames", "samples"):
        begun = time.monotonic()
        words = ["turn24.xml", "--frames", "0..24", "--spp", "64", "--by", by]
        cluster.render([*words, "-o", f"a-{by}.##.exr"])
        job = f"a-{by}.farm"
        found[by] = {
            "seconds": round(time.monotonic() - begun, 1),
            "parts": len(farm_scenarios.begins(cluster, job)),
        }
    frames = range(24)
    found["same"] = all(
        cluster.same(f"a-frames.{i:02d}.exr", f"a-samples.{i:02d}.exr") for i in frames
    )
    return found


def gpu(cluster: Cluster) -> object:
    """GPU 0 of a node takes parts, with the bits of the GPU alone; with processors, too, both."""
    return farm_scenarios.gpu(cluster, cluster.program)


def merging(cluster: Cluster) -> object:
    """Memory and seconds of `merge`: 8 and 64 films of 3840 x 2160 pixels."""
    # Nothing is seen, so that films are small once they are deflated.
    scene = 'Film "rgb" "integer xresolution" [3840] "integer yresolution" [2160]\n'
    rest = 'Camera "perspective"\nWorldBegin\nTranslate 0 0 -9\nShape "sphere"\n'
    (cluster.folder / "empty.pbrt").write_text(scene + rest)
    size = ["empty.pbrt", "--checkpoint", "off"]
    found: dict[str, object] = {}
    counts = [int(n) for n in os.environ.get("SPECULA_MERGE_FILMS", "8,64").split(",")]
    for count in counts:
        for i in range(count):
            if not (cluster.folder / f"{i}.film").exists():
                cluster.alone([*size, "--samples", f"{i}..{i + 1}", "-o", f"{i}.film"])
        begun = time.monotonic()
        names = [f"{i}.film" for i in range(count)]
        merge = [*cluster.own, "merge", *names, "-q", "-o", "sum.exr"]
        child = subprocess.Popen(merge, cwd=cluster.folder, env=cluster.environment)
        _, status, usage = os.wait4(child.pid, 0)
        assert status == 0
        found[f"{count} films"] = {
            "film MB": round((cluster.folder / "0.film").stat().st_size / 1e6),
            "MiB": round(usage.ru_maxrss / 1024),
            "seconds per film": round((time.monotonic() - begun) / count, 2),
        }
    return found


SCENARIOS: dict[str, Callable[[Cluster], object]] = {
    "start": start,
    "tasks": tasks,
    "animation": animation,
    "kills": kills,
    "efficiency": efficiency,
    "gpu": gpu,
    "merging": merging,
}

if __name__ == "__main__":
    if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir():
        farm_cluster.main(SCENARIOS, Path(sys.argv[1]), sys.argv[2:])
    else:
        chosen = [name for name in sys.argv[1:] if name != "start"]
        names = sys.argv[1:] and ["start", *chosen]
        for name, found in farm_cluster.run(Path(__file__), *names, timeout=3600.0).items():
            print(json.dumps({name: found}))
