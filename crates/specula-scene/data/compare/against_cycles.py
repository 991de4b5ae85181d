"""glTF files rendered by Blender's Cycles and by specula, compared by tiles.

    python3 against_cycles.py --bpy PYTHON --specula SPECULA --scenes SCENES --out FOLDER [NAME...]

PYTHON is one that has bpy. The files have no camera and no lights, and materials that show little:
`specula convert` says which camera and which environment it gives them, Cycles gets the same, and
both read the same file once as it is and then with other materials written into it.
"""
import argparse
import json
import os
import struct
import subprocess
from pathlib import Path

import mitsuba as mi
import numpy as np

import pbrt_text
import pictures
from mitsuba_twin import square_of_sphere

WIDTH, HEIGHT, RUNS = 192, 108, 4
GOLD = {"baseColorFactor": [1.0, 0.766, 0.336, 1], "metallicFactor": 1}
RED = {"baseColorFactor": [0.7, 0.1, 0.08, 1], "metallicFactor": 0}
MATERIALS = {
    # What a mesh without a material has by the specification; Blender's import gives it none.
    "default": {"pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 1}},
    "gold 0.3": {"pbrMetallicRoughness": GOLD | {"roughnessFactor": 0.3}},
    "gold 0.7": {"pbrMetallicRoughness": GOLD | {"roughnessFactor": 0.7}},
    "red 0.3": {"pbrMetallicRoughness": RED | {"roughnessFactor": 0.3}},
    "clearcoat": {
        "pbrMetallicRoughness": RED | {"roughnessFactor": 0.6},
        "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1}},
    },
    "glass": {
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_volume": {"thicknessFactor": 1},
        },
    },
    "emissive": {
        "pbrMetallicRoughness": RED | {"roughnessFactor": 1.0},
        "emissiveFactor": [0.2, 0.5, 1],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}},
    },
}
# File, material (None: as it is), samples per pixel of both.
SCENES = [
    ("boombox", "default", 512),
    ("openpbr-viewer-neutral_objects", None, 256),
    ("openpbr-viewer-openpbr_objects", None, 512),
    ("shaderball", None, 512),
    *(("shaderball", name, 512) for name in MATERIALS if name != "default"),
]


def with_material(source, target, name):
    """Copies a .glb, all its meshes in one material."""
    data = source.read_bytes()
    size = struct.unpack("<I", data[12:16])[0]
    root, rest = json.loads(data[20 : 20 + size]), data[20 + size :]
    if name is not None:
        root["materials"] = [MATERIALS[name]]
        root["extensionsUsed"] = list(MATERIALS[name].get("extensions", {}))
        if not root["extensionsUsed"]:
            del root["extensionsUsed"]
        for mesh in root["meshes"]:
            for primitive in mesh["primitives"]:
                primitive["material"] = 0
    rest = once(root, bytearray(rest))
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest))
    target.write_bytes(head + struct.pack("<I4s", len(text), b"JSON") + text + rest)


def once(root, rest):
    """The binary chunk with each triangle once: one file has every face twice, front and back in the
    same place, where Cycles' shadow rays meet the other one and find darkness."""
    for mesh in root["meshes"]:
        for primitive in mesh["primitives"]:
            accessors = [root["accessors"][i] for i in
                         (primitive["attributes"]["POSITION"], primitive["indices"])]  # fmt: skip
            start = [root["bufferViews"][a["bufferView"]].get("byteOffset", 0) + 8
                     + a.get("byteOffset", 0) for a in accessors]  # fmt: skip
            stride = root["bufferViews"][accessors[0]["bufferView"]].get("byteStride", 12)
            points = np.ndarray((accessors[0]["count"], 3), "<f4", rest, start[0], (stride, 4))
            kind = {5123: "<u2", 5125: "<u4"}[accessors[1]["componentType"]]
            indices = np.frombuffer(rest, kind, accessors[1]["count"], start[1]).reshape(-1, 3)
            corners = np.sort(np.unique(points, axis=0, return_inverse=True)[1].reshape(-1)[indices])
            first = np.sort(np.unique(corners, axis=0, return_index=True)[1])
            kept = indices[first].copy()
            accessors[1]["count"] = kept.size
            rest[start[1] : start[1] + kept.nbytes] = kept.tobytes()
    return bytes(rest)


def for_blender(path, to_world):
    """An environment in Blender's layout, of pbrt's square one."""
    image = pictures.load(path)[0]
    size = image.shape[0]
    width, height = 4 * size, 2 * size
    phi = (0.5 - (np.arange(width) + 0.5) / width) * 2 * np.pi
    theta = (0.5 - (np.arange(height) + 0.5) / height) * np.pi
    phi, theta = np.meshgrid(phi, theta)
    # Blender's z is glTF's y, its y is glTF's -z.
    x, y, z = np.cos(phi) * np.cos(theta), np.sin(phi) * np.cos(theta), np.sin(theta)
    d = np.stack([x, z, -y], axis=-1).reshape(-1, 3) @ np.linalg.inv(to_world[:3, :3]).T
    at = np.clip((square_of_sphere(d) * size).astype(int), 0, size - 1)
    return image[at[:, 1], at[:, 0]].reshape(height, width, 3)


def job_of(converted):
    """Camera, field of view, bounces and environment that specula gives a file."""
    ctm, job, inside = np.eye(4), {}, False
    for d in pbrt_text.directives(converted.read_text()):
        if d.name == "Transform":
            ctm = np.array(d.args).reshape(4, 4).T
        elif d.name == "Camera":
            # Blender's camera looks along -z.
            job["camera"] = (np.linalg.inv(ctm) @ np.diag([1, 1, -1, 1])).tolist()
            job["fov_deg"] = d.get("fov")
        elif d.name == "Integrator":
            job["bounces"] = int(d.get("maxdepth")) - 1
        elif d.name == "LightSource" and d.args[0] == "infinite":
            picture = for_blender(converted.parent / d.get("filename"), ctm)
            path = converted.parent / "environment.exr"
            mi.Bitmap(picture.astype(np.float32)).write(str(path))
            job["environment"] = str(path)
    return job


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("bpy", "specula", "scenes", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("names", nargs="*", help="files or materials")
    options = parser.parse_args()
    rows_file = options.out / "cycles.json"
    rows = json.loads(rows_file.read_text()) if rows_file.exists() else {}
    for scene, material, samples in SCENES:
        if options.names and not {scene, material} & set(options.names):
            continue
        name = scene if material is None else f"{scene} {material}"
        work = options.out / name.replace(" ", "-")
        work.mkdir(parents=True, exist_ok=True)
        file, mine, converted = work / "scene.glb", work / "specula.exr", work / "scene.pbrt"
        with_material(options.scenes / "gltf-shaderballs" / f"{scene}.glb", file, material)
        with open(work / "log.txt", "w") as log:
            run = lambda *c: subprocess.run([str(x) for x in c], check=True, stdout=log, stderr=log)
            run(options.specula, "convert", file, converted)
            run(options.specula, "render", file, "--resolution", f"{WIDTH}x{HEIGHT}", "--spp", samples,
                "--adaptive=off", "-o", mine, "--threads", options.threads)  # fmt: skip
            job = job_of(converted) | {
                "file": str(file), "size": [WIDTH, HEIGHT], "samples": samples // RUNS,
                "threads": options.threads,
                "pictures": [str(work / f"cycles-{i}.exr") for i in range(RUNS)],
            }  # fmt: skip
            (work / "job.json").write_text(json.dumps(job))
            run(options.bpy, Path(__file__).with_name("cycles_render.py"), work / "job.json")
        own = pictures.load(mine)
        peer = pictures.of_runs([pictures.load(p)[0] for p in job["pictures"]])
        row = pictures.compare(own, peer) | {"size": f"{WIDTH}x{HEIGHT}", "spp": [samples, samples]}
        pictures.sheet(options.out / f"cycles-{work.name}.png", own[0], peer[0])
        rows[name] = row
        rows_file.write_text(json.dumps(rows, indent=1))
        print(name, row, flush=True)


if __name__ == "__main__":
    main()
