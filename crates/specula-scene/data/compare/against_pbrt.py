"""Scenes rendered by pbrt-v4 and by specula from the very same file, compared by tiles.

    python3 against_pbrt.py --pbrt PBRT --specula SPECULA --scenes SCENES --out FOLDER [NAME...]

PBRT and SPECULA are the programs; SCENES is the folder of scenes. Both read what
`pbrt_text.variant` writes. pbrt renders four pictures of different seeds, which give its noise;
specula's pictures hold theirs. Prints a line per scene, and writes FOLDER/pbrt.json and a sheet
per scene (specula's, pbrt's, relative difference).
"""
import argparse
import json
import os
import subprocess
import time
from pathlib import Path

import pbrt_text
import pictures

# Scene, width, height, samples per pixel of specula and of pbrt in all.
SCENES = [
    ("cornell-box/cornell-box", 120, 120, 512, 512),
    ("cornell-box/cornell-box-silver", 120, 120, 512, 512),
    ("cornell-box/cornell-box-specular", 120, 120, 1024, 1024),
    ("cornell-box/cornell-box-environment-map", 120, 120, 256, 256),
    ("cornell-box/cornell-box-volume", 96, 96, 128, 128),
    ("cornell-box/cornell-box-specular-volume", 96, 96, 256, 256),
    ("cornell-box/smallpt", 96, 96, 256, 256),
    ("cornell-box/volumetric-caustic", 96, 96, 256, 256),
    ("veach-mis/veach-mis", 160, 120, 256, 256),
    ("veach-mis/veach-mis-colorized", 160, 120, 128, 128),
    ("material-testball/material-testball", 192, 108, 256, 256),
    ("material-testball/material-testball-sequence", 192, 108, 64, 64),
    ("staircase2/staircase2", 128, 128, 512, 512),
    ("bmw-m6/bmw-m6", 136, 96, 128, 128),
    ("volumetric-caustic/volumetric-caustic", 96, 96, 256, 256),
    # Our own, of `data`.
    ("features/motion", 160, 120, 1024, 1024),
    ("features/flat", 160, 120, 512, 512),
    ("features/exact-shapes", 192, 128, 2048, 2048),
    ("features/curves", 192, 128, 1024, 1024),
    ("features/hair", 160, 120, 512, 512),
]
RUNS = 4


def run(command, log):
    start = time.monotonic()
    with open(log, "a") as file:
        subprocess.run([str(c) for c in command], check=True, stdout=file, stderr=file)
    return time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("pbrt", "specula", "scenes", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--thin-coats", action="store_true", help="pbrt's coats do not absorb")
    parser.add_argument("--world", action="store_true", help="pbrt interpolates motions in the world")
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("names", nargs="*", help="parts of scenes' names")
    options = parser.parse_args()
    rows_file = options.out / "pbrt.json"
    options.out.mkdir(parents=True, exist_ok=True)
    rows = json.loads(rows_file.read_text()) if rows_file.exists() else {}
    for scene, width, height, our_samples, their_samples in SCENES:
        if options.names and not any(n == scene or n == Path(scene).name for n in options.names):
            continue
        name = Path(scene).parent.name + "-" + Path(scene).name
        name += "-thin-coats" if options.thin_coats else ""
        work = options.out / name
        file = pbrt_text.variant(
            options.scenes / f"{scene}.pbrt", work, width, height, their_samples // RUNS,
            options.thin_coats,
        )  # fmt: skip
        log, mine = work / "log.txt", work / "specula.exr"
        t = options.threads
        command = [
            options.specula, "render", file, "--spp", our_samples, "--adaptive=off", "-o", mine,
            "--threads", t,
        ]  # fmt: skip
        our_time = run(command, log)
        theirs, their_time = [], 0.0
        for seed in range(RUNS):
            picture = work / f"pbrt-{seed}.exr"
            command = [options.pbrt, "--quiet", "--nthreads", t, "--seed", seed + 1]
            command += ["--render-coord-sys", "world"] if options.world else []
            their_time += run([*command, "--outfile", picture, file], log)
            theirs.append(pictures.load(picture)[0])
        own, peer = pictures.load(mine), pictures.of_runs(theirs)
        row = pictures.compare(own, peer)
        row |= {"size": f"{width}x{height}", "spp": [our_samples, their_samples]}
        row["seconds"] = [round(our_time, 1), round(their_time, 1)]
        pictures.sheet(options.out / f"pbrt-{name}.png", own[0], peer[0])
        rows[name] = row
        rows_file.write_text(json.dumps(rows, indent=1))
        print(name, row, flush=True)


if __name__ == "__main__":
    main()
