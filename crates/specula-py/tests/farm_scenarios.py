"""What `test_farm.py` looks for, in a cluster's namespaces: scenarios return what they found."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from farm_cluster import (
    CLIENT,
    HEAD,
    SIZE,
    Cluster,
    kill,
    kill_second_node,
    kill_worker,
    main,
    processes,
    wait_for,
    worker_of,
)


def begins(cluster: Cluster, job: str) -> list[tuple[int, int]]:
    """Return the samples of all parts that were begun, without twins of running ones."""
    events = [e for e in cluster.journal(job) if e["event"] == "begin" and not e["twin"]]
    return [(e["samples"][0], e["samples"][1]) for e in events]  # type: ignore[index]


def _samples(event: dict[str, object]) -> range:
    first, end = event["samples"]  # type: ignore[misc]
    return range(first, end)


def start(cluster: Cluster) -> object:
    """Start the cluster: what listens where is said."""
    return cluster.start()


def two_nodes(cluster: Cluster) -> object:
    """Both nodes render; the bits are one machine's, and the second time nothing is rendered.

    The work grows until it is long enough that the second node starts before it is done.
    """
    spp, nodes = 64, 0
    while nodes < 2 and spp < 8192:
        picture = [*SIZE, "--spp", str(spp), "--part-time", "1", "-o", "two.exr", "-o", "two.png"]
        cluster.render(picture)
        nodes = len({e["node"] for e in cluster.journal("two.farm") if e["event"] == "begin"})
        spp *= 2
    spp //= 2
    cluster.alone([*SIZE, "--spp", str(spp), "-o", "one.exr"])
    same = [cluster.same("two.exr", "one.exr")]
    before = len(begins(cluster, "two.farm"))
    cluster.render(picture)
    again = len(begins(cluster, "two.farm")) - before
    more = ["--spp", str(spp + 16)]
    cluster.render([*SIZE, *more, "-o", "two.exr", "-o", "two.png"])
    cluster.alone([*SIZE, *more, "-o", "more.exr"])
    same.append(cluster.same("two.exr", "more.exr"))
    new = begins(cluster, "two.farm")[before:]
    return {"same": same, "nodes": nodes, "again": again, "new": sum(b - a for a, b in new)}


def kills(
    cluster: Cluster, workers: int = 3, nodes: int = 1, spp: int = 1536, every: float = 1.0
) -> object:
    """Workers and a node are killed at random moments, one in so many seconds."""
    chance = random.Random(7)
    words = [*SIZE, "--spp", str(spp), "--part-time", str(every), "-o", "kills.exr"]
    render = cluster.begin(["render", *cluster.program, "--address", HEAD, *words])
    deeds = ["worker"] * workers + ["node"] * nodes
    chance.shuffle(deeds)
    done = 0
    for deed in deeds:
        time.sleep(every * (0.3 + 1.5 * chance.random()))
        # There may be no worker at this moment: the next one is as good.
        while render.poll() is None:
            if kill_worker(chance) if deed == "worker" else kill_second_node():
                done += 1
                break
            time.sleep(0.05)
        if deed == "node" and render.poll() is None:
            cluster.join()
    said = render.communicate(timeout=900)
    assert render.returncode == 0, said
    cluster.alone([*SIZE, "--spp", str(spp), "-o", "unharmed.exr"])
    events = cluster.journal("kills.farm")
    of = {e["task"]: _samples(e) for e in events if e["event"] == "begin"}
    finished = Counter(i for e in events if e["event"] == "done" for i in of[e["task"]])
    failed = sum(e["event"] == "failed" for e in events)
    return {
        "same": cluster.same("kills.exr", "unharmed.exr"),
        "kills": done,
        "asked": len(deeds),
        "parts": len(of),
        "failed": failed,
        "samples": len(finished),
        "twice": sum(count > 1 for count in finished.values()),
        "most often": max(finished.values()),
    }


def children(cluster: Cluster) -> object:
    """A worker that is killed takes the renderer with it."""
    words = [*SIZE, "--spp", "4096", "--part-time", "30", "-o", "children.exr"]
    render = cluster.begin(["render", *cluster.program, "--address", HEAD, *words])
    wait_for(lambda: len(begins(cluster, "children.farm")) > 2)
    killed = 0
    for _ in range(3):
        pairs: dict[int, int] = {}
        while not pairs:
            wait_for(lambda: processes("part.film"))
            found = {renderer: worker_of(renderer) for renderer in processes("part.film")}
            pairs = {renderer: worker for renderer, worker in found.items() if worker}
        renderer, worker = next(iter(pairs.items()))
        kill(worker)
        wait_for(lambda gone=renderer: gone not in processes("part.film"), 20.0)
        killed += 1
    render.send_signal(signal.SIGINT)
    said = render.communicate(timeout=60)
    wait_for(lambda: not processes("part.film"), 20.0)
    return {"killed": killed, "code": render.returncode, "said": said[1]}


def resume(cluster: Cluster) -> object:
    """Ctrl-C leaves a picture and a job, which ends as if nothing had happened."""
    words = [*SIZE, "--spp", "256", "--part-time", "1", "-o", "stop.exr"]
    render = cluster.begin(["render", *cluster.program, "--address", HEAD, *words])
    wait_for(lambda: sum(e["event"] == "done" for e in cluster.journal("stop.farm")) >= 2)
    render.send_signal(signal.SIGINT)
    _, said = render.communicate(timeout=60)
    code, picture = render.returncode, Path(cluster.folder, "stop.exr").exists()
    before = [e for e in cluster.journal("stop.farm") if e["event"] == "done"]
    cluster.farm(["resume", "stop.farm", "--address", HEAD])
    cluster.alone([*SIZE, "--spp", "256", "-o", "whole.exr"])
    parts = {e["task"]: e["samples"] for e in cluster.journal("stop.farm") if e["event"] == "begin"}
    return {
        "code": code,
        "picture": picture,
        "said": said,
        "finished before": len(before),
        "same": cluster.same("stop.exr", "whole.exr"),
        "parts": len(parts),
    }


PBRT = """
Film "rgb" "integer xresolution" [48] "integer yresolution" [32]
LookAt 0 0 -3  0 0 0  0 1 0
Camera "perspective" "float fov" [45]
WorldBegin
LightSource "infinite" "rgb L" [0.8 0.9 1]
Include "{include}"
"""


def client(cluster: Cluster) -> object:
    """From outside by `ray://`: the same bits; strangers are refused there, too."""
    words = [*SIZE, "--spp", "16", "--part-time", "1"]
    cluster.render([*words, "-o", "client.exr"], address=CLIENT)
    cluster.alone([*words[:-2], "-o", "beside.exr"])
    home = cluster.folder / "outside"
    home.mkdir()
    words = ["render", *cluster.program, *words, "-o", "outside.exr", "--address", CLIENT]
    stranger = cluster.farm(words, code=2, HOME=str(home)).stderr
    return {"same": cluster.same("client.exr", "beside.exr"), "stranger": stranger}


STAND_IN = """#!{python}
import os, sys, time
told, both, end = {told!r}, {both!r}, time.monotonic() + 120.0
if "--device" in sys.argv:
    with open(told, "a") as file:
        file.write(sys.argv[sys.argv.index("--device") + 1] + "\\n")
    # The first part of a node is one sample: nobody takes the rest before both have begun.
    while os.path.exists(both) and time.monotonic() < end:
        if {{"cpu", "gpu:0"}} <= set(open(told).read().split()):
            break
        time.sleep(0.05)
given = ["cpu" if a.startswith("gpu:") else a for a in sys.argv[1:]]
os.execv({own[0]!r}, {own!r} + given)
"""


def gpu(cluster: Cluster, own: Sequence[str] | None = None) -> object:
    """GPUs take parts where nodes offer them; or processors, too.

    A program stands in that renders on the processor what it is to render on a GPU, unless another
    is given. It waits until both nodes have begun where both are to render.
    """
    told, both = cluster.folder / "devices.txt", cluster.folder / "both-render"
    program = cluster.folder / "stand-in"
    names = {"python": sys.executable, "told": str(told), "both": str(both)}
    program.write_text(STAND_IN.format(**names, own=cluster.own))
    program.chmod(0o755)
    words = ["--resolution", "32x24", "--spp", "16", "--part-time", "1"]
    found: dict[str, object] = {}
    for device in ("gpu", "mixed"):
        out = ["--device", device, "-o", f"{device}.exr", "--address", HEAD]
        chosen = own or ["--program", str(program)]
        cluster.farm(["render", *chosen, *words, *out])
        begun = [e for e in cluster.journal(f"{device}.farm") if e["event"] == "begin"]
        found[device] = len({e["node"] for e in begun})
        both.touch()
    both.unlink()
    alone = ["--device", "gpu:0"] if own is not None else []
    cluster.alone([*words[:-2], *alone, "-o", "one-gpu.exr"])
    found["same"] = cluster.same("gpu.exr", "one-gpu.exr")
    found["devices"] = sorted(set(told.read_text().split())) if told.exists() else []
    return found


def ship(cluster: Cluster) -> object:
    """A scene's files are sent where they are not; those by absolute paths cannot be."""
    scenes = cluster.folder / "scenes"
    (scenes / "parts").mkdir(parents=True)
    (scenes / "parts" / "ball.pbrt").write_text('Material "diffuse"\nShape "sphere"\n')
    (scenes / "ball.pbrt").write_text(PBRT.format(include="parts/ball.pbrt"))
    absolute = scenes / "parts" / "ball.pbrt"
    (scenes / "absolute.pbrt").write_text(PBRT.format(include=absolute))
    words = ["--ship", "always", "--spp", "16"]
    cluster.render([*words, "scenes/ball.pbrt", "-o", "sent.exr"])
    cluster.alone(["scenes/ball.pbrt", "--spp", "16", "-o", "here.exr"])
    bad = cluster.render([*words, "scenes/absolute.pbrt", "-o", "no.exr"], code=2)
    sent = list(Path(os.environ["TMPDIR"]).glob("specula-farm-*/*/parts/ball.pbrt"))
    return {"same": cluster.same("sent.exr", "here.exr"), "sent": len(sent), "said": bad.stderr}


MITSUBA = """<scene version="3.0.0"><default name="frame" value="0"/>
<sensor type="perspective"><transform name="to_world">
<lookat origin="$frame, 2, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="48"/><integer name="height" value="32"/></film>
</sensor><emitter type="constant"/><shape type="sphere"/></scene>
"""


def frames(cluster: Cluster) -> object:
    """Frames of a Mitsuba scene by a parameter, by frames and by samples; files of a sequence."""
    (cluster.folder / "turn.xml").write_text(MITSUBA)
    same = []
    for by in ("frames", "samples"):
        out = ["-o", f"{by}.##.exr", "-o", f"{by}.##.png"]
        cluster.render(["turn.xml", "--frames", "0..3", "--spp", "8", "--by", by, *out])
        for frame in range(3):
            alone = f"alone{frame}.exr"
            if not (cluster.folder / alone).exists():
                cluster.alone(["turn.xml", "-D", f"frame={frame}", "--spp", "8", "-o", alone])
            same.append(cluster.same(f"{by}.{frame:02d}.exr", alone))
    for number in (7, 8):
        scene = PBRT.format(include="ball.pbrt")
        (cluster.folder / f"seq.{number:03d}.pbrt").write_text(scene)
    (cluster.folder / "ball.pbrt").write_text('Material "diffuse"\nShape "sphere"\n')
    cluster.render(["seq.###.pbrt", "--frames", "7..9", "--spp", "4"])
    written = sorted(p.name for p in cluster.folder.glob("seq.*.png"))
    return {"same": same, "written": written}


def adaptive(cluster: Cluster) -> object:
    """Rounds of adaptive sampling over nodes are those of one machine."""
    same = []
    for name, aim in (
        ("work", ["--adaptive", "--spp", "64"]),
        ("noise", ["--noise", "0.12", "--spp", "128"]),
    ):
        cluster.render([*SIZE, *aim, "-o", f"{name}.exr"])
        cluster.alone([*SIZE, *aim, "-o", f"alone-{name}.exr"])
        same.append(cluster.same(f"{name}.exr", f"alone-{name}.exr"))
    return {"same": same}


def wrong(cluster: Cluster) -> object:
    """What is wrong ends with code 2 and says so."""
    (cluster.folder / "broken.pbrt").write_text("WorldBegin\nNonsense\n")
    said = []
    for words in (
        ["broken.pbrt", "--spp", "4"],
        [*SIZE, "--spp", "4", "--energy", "nonsense"],
        ["--spp", "4", "-o", "a.jpg"],
        ["--spp", "4", "--frames", "1..3"],
    ):
        said.append(cluster.render([*words, "--job", f"wrong{len(said)}.farm"], code=2).stderr)
    said.append(cluster.render(["--spp", "4"], address="127.0.0.2:9", code=2).stderr)
    said.append(cluster.farm(["resume", "nowhere.farm"], code=2).stderr)
    return said


def open_cluster(cluster: Cluster) -> object:
    """A cluster that wants no token is refused, unless that is asked for."""
    ray = [sys.executable, "-m", "ray.scripts.scripts", "start", "--head", "--port=6500"]
    options = ["--num-cpus=1", "--node-ip-address=127.0.0.4", "--include-dashboard=false"]
    environment = {**cluster.environment, "RAY_AUTH_MODE": "disabled"}
    subprocess.run([*ray, *options], env=environment, check=True, capture_output=True)
    words = [*SIZE, "--spp", "4", "-o", "open.exr"]
    refused = cluster.render(words, address="127.0.0.4:6500", code=2).stderr
    taken = cluster.render([*words, "--insecure"], address="127.0.0.4:6500").stderr
    words = [*SIZE, "--spp", "4", "-o", "stranger.exr", "--address", HEAD]
    home = cluster.folder / "elsewhere"
    home.mkdir()
    stranger = cluster.farm(["render", *cluster.program, *words], code=2, HOME=str(home)).stderr
    return {"refused": refused, "taken": taken, "stranger": stranger}


def local(cluster: Cluster) -> object:
    """Without a cluster, this machine is one."""
    done = cluster.farm(
        ["render", *cluster.program, *SIZE, "--spp", "8", "-o", "local.exr", "--cpus", "1"]
    )
    cluster.alone([*SIZE, "--spp", "8", "-o", "alone8.exr"])
    return {"same": cluster.same("local.exr", "alone8.exr"), "said": done.stderr}


SCENARIOS = {
    "start": start,
    "two_nodes": two_nodes,
    "resume": resume,
    "ship": ship,
    "frames": frames,
    "adaptive": adaptive,
    "wrong": wrong,
    "client": client,
    "gpu": gpu,
    "children": children,
    "kills": kills,
    "open_cluster": open_cluster,
    "local": local,
}

if __name__ == "__main__":
    main(SCENARIOS, Path(sys.argv[1]), sys.argv[2:])
