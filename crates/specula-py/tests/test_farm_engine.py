"""The farm's engine without Ray: what it decides, what it keeps, and jobs for other schedulers."""

from __future__ import annotations

import json
import os
import stat
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import farm_cluster
from specula_render.farm import bundle, cli, export, film, listening, ranges, simulation
from specula_render.farm.policy import Policy
from specula_render.farm.request import Request, default_outputs, scene_of, with_frame
from specula_render.farm.store import JobError, Store

SIZE = ("--resolution=96x64",)


def test_ranges() -> None:
    """Sets of samples."""
    assert ranges.union([(4, 8), (0, 4), (10, 12), (11, 11)]) == [(0, 8), (10, 12)]
    assert ranges.missing([(2, 4), (6, 8)], 0, 10) == [(0, 2), (4, 6), (8, 10)]
    assert ranges.missing([(0, 12)], 0, 10) == []
    assert ranges.overlap([(0, 4)], [(3, 5)]) and not ranges.overlap([(0, 4)], [(4, 5)])


def test_parts_shrink_towards_the_end() -> None:
    """Parts take a minute, less at the end, and more where each costs much."""
    policy = Policy()

    def part(left: int, ahead: float = 0.0) -> int:
        return policy.samples_of_part(left, 10.0, 20.0, 60.0, 0.5, ahead)

    assert [part(left) for left in (10**6, 1000, 40, 1)] == [600, 250, 20, 1]
    # Near the end the slot that is free now takes more than the one that is free in two seconds.
    assert part(40, ahead=1.0) == 30
    assert policy.seconds_of_part(2, 0.5, 0.1) == 60.0
    assert policy.seconds_of_part(2, 10.0, 2.0) == pytest.approx(600.0)
    assert policy.seconds_of_part(10_000, 0.5, 0.1) == pytest.approx(160.0)
    assert policy.keep_level(2, 60.0, 4e8) == 0 and policy.keep_level(1000, 60.0, 4e8) == 3


def test_late_parts_are_rendered_twice() -> None:
    """Where an idle node is done first."""
    policy = Policy()
    assert policy.pays_twice(elapsed=10.0, expected=60.0, here=30.0)
    assert not policy.pays_twice(elapsed=40.0, expected=60.0, here=30.0)
    assert policy.pays_twice(elapsed=100.0, expected=60.0, here=60.0)


@pytest.mark.parametrize(("nodes", "failures"), [(1, 400.0), (7, 60.0), (40, 60.0)])
def test_simulated_farms_render_every_sample_once(nodes: int, failures: float) -> None:
    """However nodes fail, the last film has all samples, none twice."""
    farm = simulation.Farm(hours=0.5, failures=failures, repair=60.0, film=4e6, load=1.0)
    found = simulation.simulate(nodes, farm)
    assert found.failed > 0 and 0.2 < found.efficiency < 1.0


def test_a_farm_is_efficient() -> None:
    """With failures once per node and day."""
    farm = simulation.Farm(film=4e6, load=1.0, scene=1e7)
    assert simulation.simulate(2, replace(farm, failures=0.0, stragglers=0.0)).efficiency > 0.97
    assert simulation.simulate(100, farm).efficiency > 0.85
    heavy = simulation.Farm(hours=0.5)
    plain = simulation.simulate(100, heavy, simulation.PLAIN)
    assert plain.efficiency < 0.5 * simulation.simulate(100, heavy).efficiency


def test_a_job_is_found_again(tmp_path: Path) -> None:
    """What was asked for, films without overlaps, and a lock."""
    store = Store(tmp_path / "a.farm")
    request = Request("a.pbrt", 64, ("a.exr",), frames=(1, 3), noise=0.5, options=SIZE)
    with store.lock():
        store.begin(request.to_json())
        with pytest.raises(JobError, match="another process"), Store(store.folder).lock():
            pass
    assert Request.from_json(store.request()) == request
    whole = store.keep("key", [(0, 8)], b"sum")
    gaps = store.keep("key", [(8, 10), (12, 14)], b"gaps")
    store.keep("key", [(0, 4)], b"part")
    assert store.films("key") == [(whole, [(0, 8)]), (gaps, [(8, 10), (12, 14)])]
    assert sorted(p.suffix for p in whole.parent.iterdir()) == [".film", ".film", ".ranges"]
    store.drop([gaps])
    assert [p.name for p in whole.parent.iterdir()] == ["0-8.film"]


def test_a_strangers_folder_is_left_alone(tmp_path: Path) -> None:
    """A folder that is no job's is refused, and so is a job that is none."""
    (tmp_path / "precious").write_text("")
    with pytest.raises(JobError, match="no job's folder"):
        Store(tmp_path).begin({})
    (tmp_path / "job.json").write_text("[]")
    with pytest.raises(JobError, match="another version"):
        Store(tmp_path).request()


def test_bundles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files arrive where they were, once; their fingerprint is that of their contents."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    (tmp_path / "s" / "t").mkdir(parents=True)
    (tmp_path / "s" / "a.pbrt").write_text("a")
    (tmp_path / "s" / "t" / "b.ply").write_text("b")
    paths = [tmp_path / "s" / "a.pbrt", tmp_path / "s" / "t" / "b.ply"]
    packed = bundle.of_files(paths)
    folder = bundle.unpacked(packed.fingerprint, packed.pack)
    assert (folder / "t" / "b.ply").read_text() == "b"

    def never() -> bytes:
        raise AssertionError("it is there")

    assert bundle.unpacked(packed.fingerprint, never) == folder
    paths[1].write_text("c")
    assert bundle.of_files(paths).fingerprint != packed.fingerprint


def test_names_of_frames() -> None:
    """A frame's number takes the place of as many #."""
    assert with_frame("a.###.exr", 7) == "a.007.exr" and with_frame("a.#.exr", 12) == "a.12.exr"
    assert default_outputs("x/seq.###.pbrt", (0, 2)) == ("seq.####.exr", "seq.####.png")
    assert default_outputs(None, None) == ("orbs.exr", "orbs.png")


def test_frames_of_one_file(tmp_path: Path) -> None:
    """Frames of glTF's animations by their number, of others by ``$frame``."""
    for name, option in (("a.glb", "--frame"), ("A.GLTF", "--frame"), ("a.xml", "-D")):
        value = "frame=7" if option == "-D" else "7"
        request = Request(name, 8, ("out.##.exr",), frames=(3, 9))
        assert scene_of(request, 7) == (name, (option, value))
        script = tmp_path / f"{name}.sh"
        export.write(request, 2, "slurm", script)
        assert f'{option} "{value.replace("7", "$frame")}"' in script.read_text()
    assert scene_of(Request("a.##.glb", 8, ()), 7) == ("a.07.glb", ())


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["render", "--spp", "0"], "above 0"),
        (["render", "--spp", "4", "--frames", "3..3"], "A < B"),
        (["render", "--spp", "4", "--noise", "-1"], "above 0"),
        (["render"], "--spp"),
        (["simulate", "--hours", "x"], "above 0"),
    ],
)
def test_wrong_options(words: list[str], text: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Code 2, and what was expected."""
    with pytest.raises(SystemExit) as ended:
        cli.main(words)
    assert ended.value.code == 2 and text in capsys.readouterr().err


def test_simulate_prints_a_table(capsys: pytest.CaptureFixture[str]) -> None:
    """In Markdown."""
    assert cli.main(["simulate", "--nodes", "2,3", "--hours", "0.1"]) == 0
    assert capsys.readouterr().out.count("|") == 8 * 4


def test_sockets_are_listed() -> None:
    """The listing neither fails nor lists what is not Ray's."""
    assert all(len(pair) == 2 for pair in listening.sockets())
    assert listening._address("0100007F:1F90") == "127.0.0.1, port 8080"
    assert listening._address("00000000:1F90") == "all interfaces, port 8080"


# Jobs for other schedulers.


@pytest.fixture
def program(tmp_path: Path) -> str:
    """The program in a file of its own, as schedulers start it."""
    path = tmp_path / "specula"
    package = farm_cluster.PACKAGE
    start = f'exec "{sys.executable}" -m specula_render "$@"'
    own = os.environ.get("SPECULA_FARM_PROGRAM")
    start = f'exec "{own}" "$@"' if own else f'PYTHONPATH="{package}" {start}'
    path.write_text(f"#!/bin/sh\n{start}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


def render_alone(program: str, folder: Path, *words: str) -> None:
    """Render with one process."""
    size = [program, "render", *words, *SIZE, "--spp", "10", "--adaptive=off", "-q", "-o", "alone.exr"]
    subprocess.run(size, cwd=folder, check=True)


def test_openjd_renders_the_same_bits(program: str, tmp_path: Path) -> None:
    """`openjd run` renders parts and merges them."""
    command = Path(sys.executable).with_name("openjd")
    if not command.exists():
        pytest.skip("OpenJD's command is not installed: pip install openjd-cli")
    request = Request(None, 10, (str(tmp_path / "jd.exr"),), options=SIZE, program=(program,))
    template = tmp_path / "job.template.json"
    export.write(request, 3, "openjd", template)
    check = subprocess.run([command, "check", template], capture_output=True, text=True)
    assert check.returncode == 0, check.stdout
    run = [command, "run", template, "--step", "Merge", "--run-dependencies"]
    done = subprocess.run([*run, "-p", f"Folder={tmp_path}/f"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    render_alone(program, tmp_path)
    assert farm_cluster.pixels(tmp_path / "jd.exr") == farm_cluster.pixels(tmp_path / "alone.exr")


SBATCH = """#!/bin/sh
for word in "$@"; do case "$word" in --array=0-*) last=${word#--array=0-};; esac; done
while case "$1" in --*) true;; *) false;; esac; do shift; done
for i in $(seq 0 "$last"); do SLURM_ARRAY_TASK_ID=$i bash "$@" >&2 || exit 1; done
echo "7;cluster"
"""
"""A stand-in for Slurm's `sbatch`: runs an array's tasks one after the other."""


def test_slurm_renders_the_same_bits(
    program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The script submits itself as an array; frames of a sequence."""
    # The films' folder is below the working one.
    monkeypatch.chdir(tmp_path)
    for frame in (8, 9):
        scene = (
            'Film "rgb"\nCamera "perspective"\nWorldBegin\n'
            f'LightSource "infinite" "rgb L" [1 1 {frame}]\n'
            'Translate 0 0 4\nShape "sphere"\n'
        )
        (tmp_path / f"it's {frame:02d}.pbrt").write_text(scene)
    (tmp_path / "sbatch").write_text(SBATCH)
    (tmp_path / "sbatch").chmod(0o755)
    outputs = (str(tmp_path / "out ##.exr"),)
    scene = str(tmp_path / "it's ##.pbrt")
    request = Request(scene, 10, outputs, frames=(8, 10), options=SIZE, program=(program,))
    script = tmp_path / "job.sh"
    export.write(request, 3, "slurm", script)
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    run = subprocess.run(
        ["bash", script],
        cwd=tmp_path,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stderr
    render_alone(program, tmp_path, "it's 09.pbrt")
    alone = farm_cluster.pixels(tmp_path / "alone.exr")
    assert farm_cluster.pixels(tmp_path / "out 09.exr") == alone
    assert farm_cluster.pixels(tmp_path / "out 08.exr") != alone


def test_heads_of_films(program: str, tmp_path: Path) -> None:
    """What a film's file says before its sums."""
    path = tmp_path / "a.film"
    render = [program, "render", *SIZE, "--samples", "3..5", "-q", "-o", str(path)]
    subprocess.run(render, check=True)
    head = film.read_head(path)
    assert (head.resolution, head.first_sample, head.parts, head.work) == ((96, 64), 3, None, 0.0)
    assert head.seconds > 0.0 and "depth" in head.settings
    with pytest.raises(film.NotAFilm):
        film.parse_head(path.read_bytes()[:40])
    with pytest.raises(film.NotAFilm):
        film.parse_head(b"P6 1 1")
    shown = subprocess.run([program, "info", "--film", str(path)], capture_output=True, text=True)
    assert json.loads(shown.stdout)["samples"] == [[3, 5]]
