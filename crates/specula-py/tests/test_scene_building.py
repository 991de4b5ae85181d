"""Scenes built in Python: transforms, objects, maps, opacity; checkpoints and memory; live cells."""

from __future__ import annotations

import signal
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from specula_render.picture import Picture
from specula_render.rendering import render, render_live
from specula_render.scene import Material, Scene

SQUARE = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], dtype=np.float64)
FACES = np.array([[0, 1, 2], [0, 2, 3]])
UVS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float64)
GOLD = "conductor Au alpha 0.3"


def empty() -> Scene:
    """Return a scene of 24 x 24 pixels that looks along y, in uneven light."""
    scene = Scene()
    scene.set_environment(np.linspace(0.2, 2.0, 8 * 16 * 3).reshape(8, 16, 3))
    scene.set_camera((0.0, -5.0, 0.0), (0.0, 0.0, 0.0), fov=30.0, width=24, height=24)
    return scene


def picture(scene: Scene, spp: int = 8, **options: Any) -> Picture:
    """Render a scene without saying so."""
    return render(scene, spp, progress=False, **options)


def shift(x: float, y: float, z: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return a translation."""
    matrix = np.eye(4)
    matrix[:3, 3] = (x, y, z)
    return matrix


def covered(a: Picture) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Return where shapes are seen."""
    assert a.normal is not None
    return np.abs(a.normal).max(axis=2) > 0.0


def difference(a: Picture, b: Picture) -> float:
    """Return the mean absolute difference over the mean."""
    return float(np.abs(a.rgb - b.rgb).mean() / b.rgb.mean())


def test_a_transform_moves_turns_and_stretches() -> None:
    turn = np.array([[0.0, 0, -1, 0.5], [0, 2, 0, 0.25], [1, 0, 0, 0], [0, 0, 0, 1]])
    by_transform, by_hand = empty(), empty()
    by_transform.add_mesh(SQUARE, FACES, material=GOLD, transform=turn)
    by_hand.add_mesh(SQUARE @ turn[:3, :3].T + turn[:3, 3], FACES, material=GOLD)
    assert difference(picture(by_transform), picture(by_hand)) < 1e-4
    # Three rows are enough; a transform that changes nothing changes no bit.
    plain, same = empty(), empty()
    plain.add_sphere((0.25, 0.0, 0.5), 0.7, GOLD)
    same.add_sphere((0, 0, 0), 0.7, GOLD, transform=shift(0.25, 0.0, 0.5)[:3])
    assert np.array_equal(picture(plain).rgb, picture(same).rgb)
    flat = empty()
    flat.add_sphere((0, 0, 0), 1.0, GOLD, transform=np.diag([1.2, 1.2, 0.3, 1.0]))
    seen = covered(picture(flat))
    assert 2 * seen.any(axis=1).sum() < seen.any(axis=0).sum()


def test_instances_are_copies_of_an_object() -> None:
    places = [shift(x, 0.3 * x, z) for x in (-0.8, 0.0, 0.8) for z in (-0.5, 0.5)]
    instanced, copied = empty(), empty()
    thing = instanced.add_object("thing")
    instanced.add_mesh(SQUARE * 0.3, FACES, material=GOLD, object=thing)
    ball = instanced.add_sphere((0, 0, 0), 0.2, "diffuse", object=thing)
    for place in places:
        instanced.add_instance(thing, place)
        copied.add_mesh(SQUARE * 0.3, FACES, material=GOLD, transform=place)
        copied.add_sphere((0, 0, 0), 0.2, "diffuse", transform=place)
    assert difference(picture(instanced), picture(copied)) < 1e-3
    # An object without instances is not seen, and its shapes have numbers.
    for scene in (hidden := empty(), plain := empty()):
        scene.add_sphere((0, 0, 0), 0.3, GOLD)
    hidden.add_sphere((0, 0, 0), 1.0, GOLD, object=hidden.add_object())
    assert difference(picture(hidden), picture(plain)) < 1e-6
    before = picture(instanced).rgb
    instanced.set_material(ball, {"type": "diffuse", "reflectance": (0.9, 0.0, 0.0)})
    assert (picture(instanced).rgb[..., 1] - before[..., 1]).min() < -0.05


def test_maps_bend_normals() -> None:
    def with_material(material: Material) -> Picture:
        scene = empty()
        scene.add_mesh(SQUARE, FACES, uvs=UVS, material=material)
        return picture(scene, 16)

    gold = Material.conductor("Au", alpha=0.2)
    plain = with_material(gold)
    flat = np.full((4, 4, 3), (0.5, 0.5, 1.0))
    tilted = np.full((4, 4, 3), (0.8, 0.5, 0.9))
    assert difference(with_material(gold.with_normal_map(flat)), plain) < 1e-3
    bent = difference(with_material(gold.with_normal_map(tilted)), plain)
    less = difference(with_material(gold.with_normal_map(tilted, scale=0.3)), plain)
    assert bent > 0.02 and 0.002 < less < 0.8 * bent
    ramp = np.linspace(0.0, 1.0, 64)[None, :].repeat(4, axis=0)
    assert difference(with_material(gold.with_bump_map(np.ones((4, 4)))), plain) < 1e-3
    assert difference(with_material(gold.with_bump_map(ramp)), plain) > 0.02
    # The material itself stays as it was.
    assert np.array_equal(with_material(gold).rgb, plain.rgb)


def test_opacity_cuts_out() -> None:
    def seen(opacity: Any) -> float:
        scene = empty()
        scene.add_mesh(SQUARE, FACES, uvs=UVS, material="diffuse", opacity=opacity)
        return float(covered(picture(scene)).mean())

    half = np.zeros((4, 4))
    half[:, :2] = 1.0
    whole = seen(None)
    assert seen(1.0) == whole > 0.3
    assert 0.4 * whole < seen(half) < 0.75 * whole
    assert seen(0.0) == 0.0


@pytest.mark.parametrize(
    ("words", "call"),
    [
        ("object: there is no 3", lambda s: s.add_sphere((0, 0, 0), 1.0, object=3)),
        ("object: there is no 0", lambda s: s.add_instance(0, np.eye(4))),
        ("emit no light", lambda s: s.add_sphere((0, 0, 0), 1, emission=1, object=s.add_object())),
        ("shape (4, 4)", lambda s: s.add_instance(s.add_object(), np.eye(2))),
        ("inverted", lambda s: s.add_instance(s.add_object(), np.diag([1, 0, 1, 1]))),
        ("last row", lambda s: s.add_instance(s.add_object(), np.diag([1, 1, 1, 2]))),
        ("finite", lambda s: s.add_sphere((0, 0, 0), 1.0, transform=np.full((3, 4), np.nan))),
        ("opacity", lambda s: s.add_mesh(SQUARE, FACES, opacity=1.5)),
        ("heights", lambda s: Material.diffuse().with_bump_map(np.array(1.0))),
        ("normals", lambda s: Material.diffuse().with_normal_map(np.full((2, 2, 3), -0.1))),
        ("scale", lambda s: Material.diffuse().with_normal_map(np.ones((2, 2, 3)), scale=-1.0)),
    ],
)
def test_mistakes_are_named(words: str, call: Any) -> None:
    with pytest.raises(ValueError) as error:
        call(empty())
    assert words in str(error.value)


def test_a_checkpoint_is_gone_on_with(tmp_path: Path) -> None:
    scene = empty()
    scene.add_sphere((0, 0, 0), 1.0, GOLD)
    film = tmp_path / "ball.film"
    first = picture(scene, 3, checkpoint=film)
    assert film.exists()
    rest = picture(scene, 8, checkpoint=film)
    whole = picture(scene, 8)
    assert np.array_equal(rest.rgb, whole.rgb) and rest.samples == 8
    assert rest.rays < whole.rays and not np.array_equal(first.rgb, whole.rgb)
    # What is done is not done again.
    assert picture(scene, 8, checkpoint=film).rays == 0
    with pytest.raises(ValueError, match="another render: different settings"):
        picture(scene, 8, seed=1, checkpoint=film)
    scene.add_sphere((1, 0, 0), 1.0, GOLD)
    with pytest.raises(ValueError, match="another render: different scenes"):
        picture(scene, 8, checkpoint=film)
    film.write_bytes(film.read_bytes()[:-9])
    with pytest.raises(ValueError, match="damaged"):
        picture(scene, 8, checkpoint=film)
    with pytest.raises(OSError):
        picture(scene, 1, checkpoint=tmp_path / "none" / "ball.film")


def test_an_interrupted_render_is_in_its_checkpoint(tmp_path: Path) -> None:
    scene = empty()
    scene.add_sphere((0, 0, 0), 1.0, GOLD)
    film = tmp_path / "ball.film"

    def interrupt() -> None:
        time.sleep(0.5)
        signal.raise_signal(signal.SIGINT)

    waiting = threading.Thread(target=interrupt)
    waiting.start()
    with pytest.raises(KeyboardInterrupt):
        picture(scene, 1 << 20, checkpoint=film)
    waiting.join()
    again = picture(scene, 1, checkpoint=film)
    assert again.samples >= 1 and again.rays == 0


def test_memory_is_checked_before_a_render_begins() -> None:
    scene = empty()
    scene.add_sphere((0, 0, 0), 1.0, GOLD)
    with pytest.raises(MemoryError, match="more than max_memory, 1 MiB"):
        picture(scene, 1, max_memory=1 << 20)
    with pytest.raises(MemoryError, match="MiB are available"):
        picture(scene, 1, resolution=(65536, 65536))
    assert picture(scene, 1, max_memory=1 << 40).samples == 1
    # Of a scene that is prepared, the film and the pictures still count.
    with pytest.raises(MemoryError, match="MiB are available"):
        picture(scene, 1, resolution=(65536, 65536))
    assert picture(scene, 1).samples == 1


def test_a_live_cell_ends_in_the_picture_of_one_render(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[Picture] = []

    class Cell:
        def update(self, picture: Picture) -> None:
            shown.append(picture)

    def display(picture: Picture, *, display_id: bool) -> Cell:
        assert display_id
        shown.append(picture)
        return Cell()

    monkeypatch.setattr("IPython.display.display", display)
    scene = empty()
    scene.add_sphere((0, 0, 0), 1.0, GOLD)
    last = render_live(scene, 2000, every=0.05)
    assert np.array_equal(last.rgb, picture(scene, 2000).rgb)
    assert len(shown) > 2 and [p.samples for p in shown] == sorted(p.samples for p in shown)
    assert np.array_equal(shown[-1].rgb, last.rgb)

    def interrupting(self: Cell, picture: Picture) -> None:
        shown.append(picture)
        if len(shown) == 3:
            signal.raise_signal(signal.SIGINT)

    shown.clear()
    monkeypatch.setattr(Cell, "update", interrupting)
    early = render_live(scene, 1 << 16, every=0.05)
    assert 1 < early.samples < 1 << 16 and np.array_equal(shown[-1].rgb, early.rgb)
    with pytest.raises(ValueError, match="every"):
        render_live(scene, 1, every=0.0)
