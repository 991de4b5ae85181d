"""pbrt-v4 scenes rebuilt for Mitsuba 3 (mitsuba_twin.py), compared with specula's pictures by tiles.

    python3 against_mitsuba.py --specula SPECULA --scenes SCENES --out FOLDER [NAME...]

`--variant` is Mitsuba's: llvm_ad_rgb by default (set DRJIT_LIBLLVM_PATH to LLVM 16 or newer),
scalar_rgb without LLVM, llvm_ad_spectral to see what spectra change. Specula's pictures of
against_pbrt.py in the same FOLDER are used again.
"""
import argparse
import json
import os
import subprocess
from pathlib import Path

import mitsuba as mi


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("specula", "scenes", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("names", nargs="*", help="parts of scenes' names")
    options = parser.parse_args()
    mi.set_variant(options.variant)
    import mitsuba_twin
    import pbrt_text
    import pictures
    from against_pbrt import RUNS, SCENES

    rows_file = options.out / f"{options.variant}.json"
    rows = json.loads(rows_file.read_text()) if rows_file.exists() else {}
    for scene, width, height, samples, _ in SCENES:
        if options.names and not any(n == scene or n == Path(scene).name for n in options.names):
            continue
        name = Path(scene).parent.name + "-" + Path(scene).name
        work = options.out / name
        file = pbrt_text.variant(options.scenes / f"{scene}.pbrt", work, width, height, samples)
        mine = work / "specula.exr"
        if not mine.exists():
            command = [options.specula, "render", file, "--spp", samples, "--adaptive=off", "-o", mine, "-q"]
            command += ["--threads", options.threads]
            subprocess.run([str(c) for c in command], check=True)
        made, notes = mitsuba_twin.render(file, samples // RUNS, RUNS)
        for i, picture in enumerate(made):
            path = work / f"{options.variant}-{i}.exr"
            mi.Bitmap(picture.astype("float32")).write(str(path))
        own, peer = pictures.load(mine), pictures.of_runs(made)
        row = pictures.compare(own, peer) | {"size": f"{width}x{height}", "spp": [samples] * 2}
        rows[name] = row | {"notes": notes}
        rows_file.write_text(json.dumps(rows, indent=1))
        pictures.sheet(options.out / f"{options.variant}-{name}.png", own[0], peer[0])
        print(name, rows[name], flush=True)


if __name__ == "__main__":
    main()
