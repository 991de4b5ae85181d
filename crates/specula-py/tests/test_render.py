"""Scenes and renders: formats, bits, furnaces, meshes, errors, Ctrl-C."""

from __future__ import annotations

import base64
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from specula_render import rendering
from specula_render.picture import Picture, read_exr
from specula_render.rendering import builtin, load, render, render_iter
from specula_render.scene import Material, Scene, SceneWarning

SCENES = Path(__file__).parents[3] / "data" / "scenes"
SMALL = (32, 32)

# An octahedron.
VERTICES = np.array(
    [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64
)
FACES = np.array(
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
)

BASE = """
LookAt 3 -4 2  0 0 0  0 0 1
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
LightSource "infinite" "rgb L" [0.5 0.6 0.8]
LightSource "point" "point3 from" [2 -3 4] "rgb I" [20 20 20]
Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
Shape "trianglemesh" "point3 P" [-5 -5 -1  5 -5 -1  5 5 -1  -5 5 -1] "integer indices" [0 1 2 0 2 3]
Material "diffuse" "rgb reflectance" [0.75 0.5 0.25]
"""


def quick(scene: Scene, spp: int = 4, seed: int = 0, threads: int = 0) -> Picture:
    """Render a scene small."""
    return render(scene, spp, seed=seed, threads=threads, resolution=SMALL)


def same(a: Picture, b: Picture) -> bool:
    """Tell whether all layers are the same, bit for bit."""
    layers = ("rgb", "albedo", "normal", "depth", "variance", "sample_count")
    return all(np.array_equal(getattr(a, layer), getattr(b, layer)) for layer in layers)


def ball(material: Material | dict[str, object] | str | None = None) -> Scene:
    """Return a sphere that fills most of the picture, in white light."""
    scene = Scene()
    scene.add_sphere((0.0, 0.0, 0.0), 1.0, material)
    scene.set_environment(1.0)
    scene.set_camera((0.0, -5.0, 0.0), (0.0, 0.0, 0.0), fov=28.0, width=32, height=32)
    return scene


def middle(picture: Picture) -> tuple[float, float]:
    """Return the mean over pixels in the middle, and its standard error."""
    assert picture.variance is not None
    values = picture.rgb[8:24, 8:24].mean(axis=2)
    # The channels are taken for fully correlated.
    variance = picture.variance[8:24, 8:24].mean(axis=2)
    return float(values.mean()), float(np.sqrt(variance.sum())) / values.size


@pytest.mark.parametrize(
    "name",
    [
        "cornell-box/cornell-box.pbrt",
        "cornell-box/smallpt.pbrt",
        "cornell-box/cornell-box-environment-map.pbrt",
        "veach-mis/veach-mis.pbrt",
        "veach-mis/geometry/plate1.ply",
        "mitsuba/principled.xml",
        "mitsuba/roughdielectric.xml",
        "mitsuba/textured-roughconductor.xml",
        "gltf/boombox.glb",
    ],
)
@pytest.mark.filterwarnings("ignore::specula_render.scene.SceneWarning")
def test_every_format_is_read(name: str) -> None:
    scene = load(SCENES / name)
    picture = quick(scene, spp=1)
    assert picture.rgb.shape == (32, 32, 3) and picture.rgb.dtype == np.float32
    assert np.isfinite(picture.rgb).all() and picture.rgb.max() > 0.0
    assert Path(name).stem in repr(scene)


def test_the_built_in_scene_and_its_layers() -> None:
    picture = quick(builtin(), spp=2)
    assert (picture.width, picture.height, picture.samples) == (32, 32, 2.0)
    for layer in (picture.rgb, picture.albedo, picture.normal, picture.variance):
        assert layer is not None and layer.shape == (32, 32, 3)
        assert not layer.flags.writeable
    assert picture.depth is not None and picture.depth.shape == (32, 32)
    assert picture.sample_count is not None and (picture.sample_count == 2.0).all()
    assert picture.rgb is picture.rgb
    assert np.asarray(picture).shape == (32, 32, 3)
    assert picture.rays > 32 * 32 * 2 and picture.seconds > 0.0
    assert "2 samples per pixel" in repr(picture)


@pytest.mark.parametrize("name", ["cornell-box/cornell-box.pbrt", "mitsuba/principled.xml"])
@pytest.mark.filterwarnings("ignore::specula_render.scene.SceneWarning")
def test_bits_are_those_of_the_command_line(name: str, tmp_path: Path) -> None:
    path, out = SCENES / name, tmp_path / "a.exr"
    arguments = ["specula", "render", str(path), "--spp", "5", "--seed", "7"]
    arguments += ["--resolution", "32x32", "-o", str(out), "--quiet"]
    code = f"import specula_render._native as n, os; os._exit(n.command_line({arguments!r}))"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
    picture = quick(load(path), spp=5, seed=7)
    assert same(picture, read_exr(out))
    other = quick(load(path), spp=5, seed=8)
    assert not np.array_equal(picture.rgb, other.rgb)


@pytest.mark.parametrize(
    ("material", "energy"),
    [
        ({"type": "diffuse", "reflectance": 1.0}, None),
        (Material.conductor(f0=1.0, alpha=0.8), "multibounce"),
        (Material.conductor(f0=1.0, alpha=(0.2, 0.6)), "multibounce=heitz"),
        ({"type": "dielectric", "eta": 1.5, "alpha": 0.4}, "multibounce"),
    ],
)
def test_white_in_white_is_white(material: Material, energy: str | None) -> None:
    picture = render(ball(material), spp=64, energy=energy, max_depth=64)
    mean, error = middle(picture)
    assert abs(mean - 1.0) < 4.0 * error + 1e-4 and error < 0.01


def test_single_scattering_loses_light() -> None:
    material = Material.conductor(f0=1.0, alpha=0.8)
    mean, error = middle(render(ball(material), spp=64, energy="none"))
    assert mean < 0.95 and error < 0.01


def write_ply(path: Path) -> None:
    header = f"""ply
format ascii 1.0
element vertex {len(VERTICES)}
property float x
property float y
property float z
element face {len(FACES)}
property list uchar int vertex_indices
end_header
"""
    rows = [" ".join(map(str, v)) for v in VERTICES] + ["3 " + " ".join(map(str, f)) for f in FACES]
    path.write_text(header + "\n".join(rows) + "\n", encoding="ascii")


def test_arrays_are_the_mesh_of_a_file(tmp_path: Path) -> None:
    write_ply(tmp_path / "a.ply")
    base, whole = tmp_path / "base.pbrt", tmp_path / "whole.pbrt"
    base.write_text(BASE, encoding="utf-8")
    whole.write_text(BASE + 'Shape "plymesh" "string filename" "a.ply"\n', encoding="utf-8")
    scene, expected = load(base), load(whole)
    scene.add_mesh(VERTICES, FACES, material=Material.diffuse((0.75, 0.5, 0.25)))
    assert same(quick(scene, spp=8), quick(expected, spp=8))
    assert not same(quick(load(base), spp=8), quick(expected, spp=8))


def test_layouts_and_types_of_arrays_do_not_matter() -> None:
    def picture(vertices: npt.ArrayLike, faces: npt.ArrayLike) -> Picture:
        scene = Scene()
        scene.add_mesh(vertices, faces)
        scene.set_environment((0.2, 0.5, 1.0))
        return quick(scene)

    first = picture(VERTICES, FACES)
    assert same(first, picture(VERTICES.astype(np.float32), FACES.astype(np.uint32)))
    assert same(first, picture(np.asfortranarray(VERTICES), np.asfortranarray(FACES)))
    assert same(first, picture(VERTICES.tolist(), FACES.tolist()))


@pytest.mark.filterwarnings("ignore::specula_render.scene.SceneWarning")
def test_textures_are_filtered_as_asked() -> None:
    scene = load(SCENES / "mitsuba" / "textured-roughconductor.xml")
    by_scene, bilinear, trilinear, ewa = (
        render(scene, 1, resolution=SMALL, texture_filter=name)
        for name in ("scene", "bilinear", "trilinear", "ewa")
    )
    # Mitsuba's textures are not filtered over footprints.
    assert same(by_scene, bilinear)
    assert not same(bilinear, trilinear)
    assert not same(trilinear, ewa)


@pytest.mark.filterwarnings("ignore::specula_render.scene.SceneWarning")
def test_normal_maps_are_filtered_into_roughness_on_demand() -> None:
    scene = load(SCENES / "mitsuba" / "normalmap-roughconductor.xml")
    averaged, filtered = (
        render(scene, 1, resolution=SMALL, filter_normal_maps=given) for given in (False, True)
    )
    assert same(averaged, render(scene, 1, resolution=SMALL))
    assert not same(averaged, filtered)


def moving(path: Path) -> Path:
    """Write a glTF file with a lit square that moves from left to right within two seconds."""
    corners = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, -0.5, 0), (0.5, 0.5, 0)]
    numbers = np.array(
        [*corners, (-0.5, 0.5, 0), (0, 2, -1.5), (0, 0, 1.5), (0, 0, 0)], dtype="<f4"
    )
    data = base64.b64encode(numbers.tobytes()).decode()
    views = [(0, 72), (72, 8), (80, 24)]
    kinds = [(6, "VEC3"), (2, "SCALAR"), (2, "VEC3")]
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 1]}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}},
        "nodes": [
            {"mesh": 0},
            {
                "camera": 0,
                "translation": [0, 0, 5],
                "extensions": {"KHR_lights_punctual": {"light": 0}},
            },
        ],
        "cameras": [
            {
                "type": "perspective",
                "perspective": {"yfov": 0.8, "aspectRatio": 1, "znear": 0.1},
            }
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"byteLength": 104, "uri": f"data:application/octet-stream;base64,{data}"}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": n} for at, n in views],
        "accessors": [
            {"bufferView": i, "componentType": 5126, "count": count, "type": kind}
            | ({"min": [0], "max": [2]} if kind == "SCALAR" else {})
            | ({"min": [-0.5, -0.5, 0], "max": [0.5, 0.5, 0]} if count == 6 else {})
            for i, (count, kind) in enumerate(kinds)
        ],
        "animations": [
            {
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                "samplers": [{"input": 1, "output": 2}],
            }
        ],
    }
    path.write_text(json.dumps(document))
    return path


@pytest.mark.filterwarnings("ignore::specula_render.scene.SceneWarning")
def test_animations_are_seen_at_a_moment_and_over_a_time(tmp_path: Path) -> None:
    file = moving(tmp_path / "moving.gltf")

    def place(
        at: float | None, shutter: float | None, animation: str | None = None
    ) -> tuple[float, float]:
        """Return where light is across the picture, from -1 to 1, and how wide."""
        scene = load(file, at=at, shutter=shutter, animation=animation)
        columns = render(scene, 64, resolution=SMALL).rgb.sum(axis=(0, 2)).astype(np.float64)
        across = np.linspace(-1.0, 1.0, 32)
        mean = float((columns * across).sum() / columns.sum())
        return mean, float(np.sqrt((columns * (across - mean) ** 2).sum() / columns.sum()))

    left, middle, right = (place(at, None) for at in (0.0, 1.0, 2.0))
    assert left[0] < -0.5 < -0.1 < middle[0] < 0.1 < 0.5 < right[0]
    assert place(1.0, None, "0") == middle
    blurred = place(0.0, 2.0)
    assert abs(blurred[0]) < 0.1 and blurred[1] > 1.5 * middle[1]
    assert place(0.5, 0.0) != place(0.5, 1.0)
    for name in ("at", "shutter"):
        with pytest.raises(ValueError, match=f"{name}: expected seconds"):
            load(file, **{name: -1.0})
    with pytest.raises(ValueError, match="animation \"walk\" is asked for"):
        load(file, animation="walk")


def test_meshes_of_trimesh_are_taken() -> None:
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed")
    meshes = [trimesh.creation.icosphere(subdivisions=2), trimesh.creation.box()]
    scene = Scene()
    for mesh in meshes:
        scene.add_mesh(mesh, material="conductor Au alpha 0.3")
    scene.set_environment(1.0)
    assert (quick(scene).albedo is not None) and quick(scene).rgb.max() > 0.1


def test_lights_are_seen() -> None:
    def brightness(scene: Scene) -> float:
        return float(render(scene, spp=32).rgb[15:17, 15:17].mean())

    def dark() -> Scene:
        scene = ball({"type": "diffuse", "reflectance": 0.5})
        scene.set_environment(0.0)
        return scene

    assert brightness(dark()) == 0.0
    point, distant, spot, area = dark(), dark(), dark(), dark()
    point.add_point_light((0, -4, 0), 9.0 * np.pi)
    distant.add_distant_light((0, 1, 0), np.pi)
    spot.add_spot_light((0, -4, 0), (0, 0, 0), 9.0 * np.pi)
    square = [[-9, -8, -9], [9, -8, -9], [9, -8, 9], [-9, -8, 9]]
    area.add_mesh(square, [[0, 2, 1], [0, 3, 2]], emission=(1, 1, 1))
    # Straight from ahead: irradiance pi, radiance of the albedo.
    for scene in (point, distant, spot):
        assert brightness(scene) == pytest.approx(0.5, rel=0.05)
    assert 0.1 < brightness(area) < 0.5
    sky = dark()
    sky.set_environment(np.ones((8, 16, 3)))
    assert brightness(sky) == pytest.approx(0.5, rel=0.01)


def test_textures_are_seen() -> None:
    square = [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
    uvs = [[0, 0], [1, 0], [1, 1], [0, 1]]
    rows = np.zeros((2, 2, 3))
    rows[0, 0] = (1.0, 0.0, 0.0)
    scene = Scene()
    painted = Material.diffuse(rows)
    scene.add_mesh(square, [[0, 1, 2], [0, 2, 3]], uvs=uvs, material=painted)
    scene.set_environment(1.0)
    scene.set_camera((0, -5, 0), (0, 0, 0), fov=22.6, width=32, height=32)
    albedo = quick(scene).albedo
    assert albedo is not None
    # The first row is the uppermost, the first column at u = 0.
    assert albedo[8, 8, 0] > 0.8 and albedo[8, 8, 1] == 0.0
    assert albedo[24, 24, 0] < 0.2


MATERIALS: dict[str, dict[str, object]] = {
    "diffuse": {"roughness": 0.3},
    "diffuse_transmission": {},
    "conductor": {"eta": (0.2, 0.4, 1.4), "k": 3.0, "roughness": 0.4, "distribution": "beckmann"},
    "dielectric": {"alpha": 0.1, "absorption": (0.5, 0.1, 0.1)},
    "thin_dielectric": {},
    "coated_diffuse": {"reflectance": (0.1, 0.2, 0.8), "alpha": 0.05},
    "coated_conductor": {"metal": "Cu", "alpha": 0.2},
    "gltf": {"base_color": (0.9, 0.6, 0.3), "metallic": 0.5, "clearcoat": 1.0},
    "principled": {"base_color": (0.9, 0.6, 0.3), "metallic": 0.5, "sheen": 0.3},
}


@pytest.mark.parametrize("kind", MATERIALS)
def test_every_material_renders(kind: str) -> None:
    picture = quick(ball({"type": kind, **MATERIALS[kind]}))
    assert np.isfinite(picture.rgb).all()
    assert 0.0 < picture.rgb[16, 16].min() and picture.rgb.mean() < 1.5


def test_a_changed_material_gives_the_picture_of_a_new_scene() -> None:
    scene = ball("diffuse 0.5")
    before = quick(scene)
    scene.set_material(0, "conductor Au alpha 0.3")
    assert same(quick(scene), quick(ball("conductor Au alpha 0.3")))
    scene.set_material(0, "diffuse 0.5")
    assert same(quick(scene), before)
    scene.set_camera((0.0, -9.0, 0.0), (0.0, 0.0, 0.0))
    assert not same(quick(scene), before)
    # By name, in a scene of a file.
    orbs = builtin()
    name = next(n for n in orbs.materials if n is not None and n.startswith("Au"))
    first = quick(orbs)
    orbs.set_material(name, Material.diffuse(0.1))
    assert not same(quick(orbs), first)
    with pytest.raises(KeyError, match="unobtainium"):
        orbs.set_material("unobtainium", "diffuse 0.5")


def test_a_changed_material_does_not_build_the_tree_again() -> None:
    side = 250
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    vertices = np.stack([x, y, 0.1 * np.sin(9 * x) * np.cos(7 * y)], axis=-1).reshape(-1, 3)
    i = np.arange(side * side).reshape(side, side)
    corners = [i[:-1, :-1], i[:-1, 1:], i[1:, 1:]], [i[:-1, :-1], i[1:, 1:], i[1:, :-1]]
    faces = np.concatenate([np.stack(c, axis=-1).reshape(-1, 3) for c in corners])
    scene = Scene()
    scene.add_mesh(vertices, faces)

    def seconds() -> float:
        begin = time.monotonic()
        render(scene, spp=1, resolution=(8, 8))
        return time.monotonic() - begin

    first, later = seconds(), []
    for material in ("diffuse 0.2", "conductor Au", "dielectric 1.5"):
        scene.set_material(0, material)
        later.append(seconds())
    # A sixteenth, on an idle machine.
    assert min(later) < 0.5 * first


def test_threads_do_not_matter() -> None:
    scene = builtin()
    first = quick(scene, threads=1)
    assert all(same(first, quick(scene, threads=n)) for n in (2, 3, 5))


def test_steps_end_in_the_picture_of_one_render() -> None:
    scene = builtin()
    steps = list(render_iter(scene, spp=6, resolution=SMALL))
    assert [p.samples for p in steps] == [1.0, 2.0, 4.0, 6.0]
    assert same(steps[-1], quick(scene, spp=6))
    assert same(steps[1], quick(scene, spp=2))
    assert steps[-1].noise < steps[1].noise


def test_bounds_end_a_render() -> None:
    scene = ball("diffuse 0.8")
    begin = time.monotonic()
    picture = render(scene, time=0.3)
    assert 0.1 < time.monotonic() - begin < 3.0 and picture.samples > 1.0
    picture = render(scene, noise=0.05)
    assert picture.noise <= 0.05
    assert picture.sample_count is not None
    picture = render(builtin(), spp=32, adaptive=True, resolution=(96, 64))
    assert np.unique(np.asarray(picture.sample_count)).size > 1
    again = render(builtin(), spp=32, adaptive=True, resolution=(96, 64), threads=1)
    assert same(picture, again)


def test_mistakes_are_errors_that_name_them(tmp_path: Path) -> None:
    scene = Scene()
    broken = VERTICES.copy()
    broken[3, 1] = np.nan
    with pytest.raises(ValueError, match=r"vertices\[3\].*NaN"):
        scene.add_mesh(broken, FACES)
    outside = FACES.copy()
    outside[5, 1] = 6
    with pytest.raises(ValueError, match=r"faces\[5\].*6 vertices"):
        scene.add_mesh(VERTICES, outside)
    outside[5, 1] = -1
    with pytest.raises(ValueError, match=r"faces\[5\]"):
        scene.add_mesh(VERTICES, outside)
    with pytest.raises(ValueError, match=r"vertices.*\(n, 3\)"):
        scene.add_mesh(VERTICES[:, :2], FACES)
    with pytest.raises(ValueError, match="normals.*6 vertices"):
        scene.add_mesh(VERTICES, FACES, normals=VERTICES[:4])
    with pytest.raises(ValueError, match=r"normals\[0\]"):
        scene.add_mesh(VERTICES, FACES, normals=np.zeros((6, 3)))
    with pytest.raises(TypeError, match="integers"):
        scene.add_mesh(VERTICES, FACES.astype(np.float64))
    with pytest.raises(TypeError, match="faces"):
        scene.add_mesh(VERTICES)
    with pytest.raises(ValueError, match="triangle with area"):
        scene.add_mesh(VERTICES, [[0, 0, 1]])
    with pytest.warns(SceneWarning, match="1 triangles"):
        scene.add_mesh(VERTICES, [[0, 0, 1], [0, 2, 4]])
    with pytest.raises(ValueError, match="emission"):
        scene.add_mesh(VERTICES, FACES, emission=(1.0, 2.0))
    with pytest.raises(ValueError, match=r"vertices\[0\]"):
        scene.add_mesh(1e300 * VERTICES, FACES)
    with pytest.raises(ValueError, match="radius"):
        scene.add_sphere((0, 0, 0), 0.0)
    with pytest.raises(ValueError, match="up"):
        scene.set_camera((0, 0, 5), (0, 0, 0), up=(0, 0, 1))
    with pytest.raises(ValueError, match="shape"):
        scene.set_material(7, "diffuse 0.5")


def test_mistakes_in_materials_and_options_are_errors() -> None:
    with pytest.raises(ValueError, match="unobtainium"):
        Material.conductor("unobtainium")
    with pytest.raises(ValueError, match="one of metal"):
        Material.conductor("Au", f0=0.5)
    with pytest.raises(ValueError, match="exclude"):
        Material.conductor("Au", alpha=0.1, roughness=0.3)
    with pytest.raises(ValueError, match="reflectance"):
        Material.diffuse(1.5)
    with pytest.raises(ValueError, match=r"shape \[2\]"):
        Material.diffuse([0.5, 0.5])
    with pytest.raises(ValueError, match="velvet"):
        ball({"type": "velvet"})
    with pytest.raises(TypeError):
        ball({"type": "diffuse", "colour": 0.5})
    with pytest.raises(ValueError, match="no shape"):
        render(Scene(), spp=1)
    with pytest.raises(TypeError, match="expected a Scene"):
        render("scene.pbrt")  # type: ignore[arg-type]
    scene = ball()
    for options in (
        {"spp": 0},
        {"spp": -1},
        {"seed": -1},
        {"threads": -1},
        {"max_depth": -1},
        {"energy": "much"},
        {"sampler": "none"},
        {"texture_filter": "gaussian"},
        {"noise": -1.0},
        {"time": 0.0},
        {"time": float("nan")},
        {"clamp": 0.0},
        {"resolution": (0, 32)},
    ):
        with pytest.raises(ValueError):
            render(scene, **options)


def test_files_that_are_missing_or_damaged_are_errors(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"missing\.pbrt"):
        load(tmp_path / "missing.pbrt")
    with pytest.raises(FileNotFoundError, match=r"missing\.exr"):
        read_exr(tmp_path / "missing.exr")
    damaged = tmp_path / "damaged.pbrt"
    damaged.write_text(BASE + 'Material "copper"\nShape "sphere"\n', encoding="utf-8")
    with pytest.raises(ValueError, match=r"damaged\.pbrt:11:\d+: .*copper"):
        load(damaged)
    text = tmp_path / "text.exr"
    text.write_text("no picture", encoding="utf-8")
    with pytest.raises(ValueError, match="OpenEXR"):
        read_exr(text)
    with pytest.raises(OSError):
        quick(ball(), spp=1).to_exr(tmp_path / "no folder" / "a.exr")


def test_readers_warn(tmp_path: Path) -> None:
    odd = tmp_path / "odd.pbrt"
    odd.write_text(BASE + 'Shape "sphere" "float width" 0.5\n', encoding="utf-8")
    with pytest.warns(SceneWarning, match=r"odd\.pbrt:11:"):
        load(odd)


def test_pictures_come_back(tmp_path: Path) -> None:
    picture = quick(builtin())
    picture.to_exr(tmp_path / "a.exr")
    assert same(read_exr(tmp_path / "a.exr"), picture)
    picture.to_png(tmp_path / "a.png", exposure=1.0, tone_map="filmic")
    signature = b"\x89PNG\r\n\x1a\n"
    assert (tmp_path / "a.png").read_bytes().startswith(signature)
    assert picture._repr_png_().startswith(signature)
    with pytest.raises(ValueError, match="tone map"):
        picture.to_png(tmp_path / "a.png", tone_map="vivid")  # type: ignore[arg-type]


def test_comparisons_are_of_known_distances() -> None:
    grey = Picture(np.full((8, 6, 3), 0.5))
    equal = grey.compare(grey)
    assert (equal.rmse, equal.rel_mse, equal.flip, equal.hdr_flip) == (0.0, 0.0, 0.0, 0.0)
    dark = Picture(np.full((8, 6, 3), 0.25)).compare(grey)
    assert (dark.rmse, dark.bias, dark.rel_bias) == (0.25, -0.25, -0.5)
    assert dark.flip_map.shape == (8, 6) and dark.flip > 0.0
    assert grey.compare(np.full((8, 6, 3), 0.5)).rmse == 0.0
    with pytest.raises(ValueError, match="size"):
        grey.compare(np.zeros((8, 8, 3)))
    with pytest.raises(ValueError, match=r"\(h, w, 3\)"):
        Picture(np.zeros((8, 8)))


INTERRUPTED = """
import sys, threading
from specula_render.rendering import builtin, render
scene = builtin()
render(scene, spp=1, resolution=(32, 32))
print("ready", flush=True)
try:
    render(scene, spp=1 << 20)
except KeyboardInterrupt:
    again = render(scene, spp=1, resolution=(32, 32))
    print("interrupted", again.samples, flush=True)
    raise
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for a process")
def test_interrupts_end_a_render_at_once() -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None and process.stdout.readline() == "ready\n"
    time.sleep(1.0)
    begin = time.monotonic()
    os.kill(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=20)
    assert time.monotonic() - begin < 2.0
    assert out == "interrupted 1.0\n" and "KeyboardInterrupt" in err
    assert process.returncode != 0


def test_other_threads_run_during_a_render() -> None:
    counts = [0]
    is_over = threading.Event()

    def count() -> None:
        while not is_over.wait(0.01):
            counts[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    render(builtin(), time=0.5, resolution=(64, 32))
    is_over.set()
    thread.join()
    assert counts[0] >= 10


def test_threads_render_a_scene_at_once() -> None:
    scene = builtin()
    pictures: list[Picture] = []
    threads = [
        threading.Thread(target=lambda: pictures.append(quick(scene, spp=2))) for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(pictures) == 4 and all(same(p, pictures[0]) for p in pictures)


def test_progress_is_shown_where_it_is_asked_for(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    render(ball(), spp=1, progress="always")
    monkeypatch.setattr(rendering, "_QUIET", 0.0)
    render(ball(), spp=8, progress=True)
    # It was short, and standard error is no terminal.
    assert capsys.readouterr().err == ""
    render(ball(), spp=8, progress="always")
    shown = capsys.readouterr().err
    assert shown.startswith("\r[") and "spp" in shown and shown.endswith("\r")
    assert "100 %  8 spp" in shown
