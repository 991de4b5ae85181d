"""Scenes: read from files, or built up by calls."""

from __future__ import annotations

import os
import threading
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, Protocol, Union, runtime_checkable

import numpy as np
import numpy.typing as npt

from specula_render import _native
from specula_render._native import Material as Material

PathLike = Union[str, "os.PathLike[str]"]
Colour = Union[float, Sequence[float], npt.NDArray[Any]]
Vector = Union[Sequence[float], npt.NDArray[Any]]
AnyMaterial = Union[Material, Mapping[str, Any], str]


class SceneWarning(UserWarning):
    """A difference between a scene's file and what is rendered."""


@runtime_checkable
class TriangleMesh(Protocol):
    """What has vertices and faces, as a ``trimesh.Trimesh`` does."""

    @property
    def vertices(self) -> Any:
        """(n, 3) array."""

    @property
    def faces(self) -> Any:
        """(m, 3) array of integers."""


def _material(given: AnyMaterial | None) -> Material | None:
    """Return a material of what a caller may give for one."""
    if given is None or isinstance(given, Material):
        return given
    if isinstance(given, str):
        return Material.parse(given)
    if not isinstance(given, Mapping):
        raise TypeError(
            f"material: expected a Material, a dict or a text, got {type(given).__name__}"
        )
    parameters = dict(given)
    kind = parameters.pop("type", None)
    make = _KINDS.get(str(kind).replace("-", "_"))
    if make is None:
        raise ValueError(f"material: no type {kind!r} (expected one of {', '.join(_KINDS)})")
    material: Material = make(**parameters)
    return material


_KINDS: dict[str, Any] = {
    name: getattr(Material, name)
    for name in (
        "diffuse",
        "diffuse_transmission",
        "conductor",
        "dielectric",
        "thin_dielectric",
        "coated_diffuse",
        "coated_conductor",
        "gltf",
        "principled",
    )
}


def _colour(name: str, given: Colour) -> float | list[float]:
    """Return a colour as Python's own numbers."""
    colour = np.asarray(given, dtype=np.float64)
    if colour.shape not in ((), (3,)):
        raise ValueError(
            f"{name}: expected a number or three, got an array of shape {colour.shape}"
        )
    channels: float | list[float] = colour.tolist()
    return channels


def _vector(name: str, given: Vector) -> list[float]:
    """Return a vector as Python's own numbers."""
    vector = np.asarray(given, dtype=np.float64)
    if vector.shape != (3,):
        raise ValueError(f"{name}: expected three numbers, got an array of shape {vector.shape}")
    numbers: list[float] = vector.tolist()
    return numbers


def _transform(given: npt.ArrayLike) -> list[list[float]]:
    """Return an affine transform as Python's own numbers."""
    matrix = np.asarray(given, dtype=np.float64)
    if matrix.shape == (3, 4):
        matrix = np.vstack([matrix, (0.0, 0.0, 0.0, 1.0)])
    if matrix.shape != (4, 4):
        raise ValueError(
            f"transform: expected an array of shape (4, 4) or (3, 4), got {matrix.shape}"
        )
    rows: list[list[float]] = matrix.tolist()
    return rows


def _faces(given: npt.ArrayLike) -> npt.NDArray[np.int64]:
    """Return the faces of a mesh as they are taken on: C-contiguous, of int64."""
    faces = np.asarray(given)
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise ValueError(f"faces: expected an array of shape (m, 3), got {faces.shape}")
    if faces.size > 0 and not np.issubdtype(faces.dtype, np.integer):
        raise TypeError(f"faces: expected integers, got an array of {faces.dtype}")
    return np.ascontiguousarray(faces, dtype=np.int64)


class Scene:
    """What is rendered: shapes with materials, lights and a camera.

    A new scene is empty. Lengths are in scene units, colours linear RGB (sRGB primaries), angles
    in degrees. A render keeps the tree over the shapes for the next: after a change of materials,
    lights or camera it is not built again.

    Materials are a `Material`, a dict of its parameters with the name of its constructor as
    ``"type"``, or a text as the command line takes it:

    >>> import specula_render as sr
    >>> scene = sr.Scene()
    >>> gold = sr.Material.conductor("Au", alpha=0.2)
    >>> scene.add_sphere((0, 0, 0), 1.0, gold)
    0
    >>> scene.set_material(0, {"type": "diffuse", "reflectance": (0.2, 0.5, 0.8)})
    >>> scene.set_material(0, "conductor Cu alpha 0.1 0.4")
    """

    def __init__(self) -> None:
        self._data = _native.SceneData()
        # Held while the scene is prepared: renders of several threads wait for each other there.
        self._lock = threading.Lock()

    @classmethod
    def _of(cls, data: _native.SceneData) -> Scene:
        scene = cls()
        scene._data = data
        return scene

    @property
    def name(self) -> str:
        """The name: that of the file without its extension."""
        return self._data.name

    @property
    def width(self) -> int:
        """Pixels in a row of the picture."""
        return self._data.resolution[0]

    @property
    def height(self) -> int:
        """Rows of the picture."""
        return self._data.resolution[1]

    @property
    def materials(self) -> list[str | None]:
        """The names of the materials; None for one without."""
        return self._data.material_names()

    def add_mesh(
        self,
        vertices: npt.ArrayLike | TriangleMesh,
        faces: npt.ArrayLike | None = None,
        *,
        normals: npt.ArrayLike | None = None,
        uvs: npt.ArrayLike | None = None,
        material: AnyMaterial | None = None,
        emission: Colour | None = None,
        two_sided: bool = False,
        opacity: npt.ArrayLike | None = None,
        transform: npt.ArrayLike | None = None,
        object: int | None = None,
    ) -> int:
        """Add a triangle mesh.

        Parameters
        ----------
        vertices : (n, 3) array_like, or a mesh
            Positions; or an object with ``vertices`` and ``faces``, as of trimesh.
        faces : (m, 3) array_like of int
            Vertices of each triangle, counterclockwise from outside.
        normals : (n, 3) array_like, optional
            Shading normals, not necessarily unit; by default those of the triangles.
        uvs : (n, 2) array_like, optional
            Surface coordinates, of textures and anisotropic materials.
        material
            By default grey.
        emission
            Radiance of each point, which makes the mesh a light: a number or three.
        two_sided
            Whether both sides emit; else the one that the triangles face.
        opacity : float or (h, w) array_like, optional
            Share of the surface that is there, in [0, 1]; a picture cuts the mesh out.
        transform : (4, 4) or (3, 4) array_like, optional
            From the space of the vertices to that of the scene, of column vectors.
        object
            Number of the object, as `add_object` returns it, that the mesh is part of; by default
            it is part of the scene.

        Returns
        -------
        int
            The shape's number, for `set_material`.

        Raises
        ------
        ValueError
            If shapes do not fit, a number is not finite, or a face refers to a vertex that does
            not exist; the message names the first.
        """
        if faces is None:
            mesh: Any = vertices
            if not isinstance(mesh, TriangleMesh):
                raise TypeError("add_mesh: expected vertices and faces, or a mesh that has both")
            vertices, faces = mesh.vertices, mesh.faces
        radiance = None if emission is None else _colour("emission", emission)
        # What is too large for float32 becomes infinite, which is an error.
        with np.errstate(over="ignore"):
            shape, dropped = self._data.add_mesh(
                np.asarray(vertices),
                _faces(faces),
                None if normals is None else np.asarray(normals),
                None if uvs is None else np.asarray(uvs),
                None if transform is None else _transform(transform),
                (_material(material), radiance, two_sided),
                None if opacity is None else np.asarray(opacity),
                object,
            )
        if dropped > 0:
            message = f"{dropped} triangles without area are dropped"
            warnings.warn(message, SceneWarning, stacklevel=2)
        return shape

    def add_sphere(
        self,
        center: Vector,
        radius: float,
        material: AnyMaterial | None = None,
        *,
        emission: Colour | None = None,
        transform: npt.ArrayLike | None = None,
        object: int | None = None,
    ) -> int:
        """Add a sphere.

        Parameters
        ----------
        center : (3,) array_like
        radius
            Above 0.
        material
            By default grey.
        emission
            Radiance of each point, which makes the sphere a light: a number or three.
        transform : (4, 4) or (3, 4) array_like, optional
            Applied to the sphere, of column vectors: an ellipsoid where it stretches.
        object
            Number of the object that the sphere is part of; by default it is part of the scene.

        Returns
        -------
        int
            The shape's number, for `set_material`.

        Raises
        ------
        ValueError
            If a number is out of range.
        """
        radiance = None if emission is None else _colour("emission", emission)
        centre = _vector("center", center)
        return self._data.add_sphere(
            centre,
            radius,
            None if transform is None else _transform(transform),
            (_material(material), radiance, False),
            object,
        )

    def add_object(self, name: str = "") -> int:
        """Add an empty object: shapes that are placed together, any number of times.

        Memory and the time to prepare a render are those of one copy.

        Parameters
        ----------
        name
            For messages.

        Returns
        -------
        int
            The object's number, for `add_mesh`, `add_sphere` and `add_instance`.

        Examples
        --------
        >>> import numpy as np
        >>> import specula_render as sr
        >>> scene = sr.Scene()
        >>> bead = scene.add_object("bead")
        >>> scene.add_sphere((0, 0, 0), 0.1, "conductor Au alpha 0.2", object=bead)
        0
        >>> for i in range(100):
        ...     place = np.eye(4)
        ...     place[:3, 3] = (0.3 * (i % 10), 0.3 * (i // 10), 0.0)
        ...     scene.add_instance(bead, place)
        """
        return self._data.add_object(name)

    def add_instance(self, object: int, transform: npt.ArrayLike) -> None:
        """Place an object in the scene.

        Parameters
        ----------
        object
            Its number.
        transform : (4, 4) or (3, 4) array_like
            From the object's space to that of the scene, of column vectors.

        Raises
        ------
        ValueError
            If there is no such object, or the transform cannot be inverted.
        """
        self._data.add_instance(object, _transform(transform))

    def set_material(self, which: int | str | None, material: AnyMaterial) -> None:
        """Give another material to what is there.

        Parameters
        ----------
        which
            A shape's number, as `add_mesh` and `add_sphere` return it; the name of a material of
            the scene's file, which is replaced wherever it is used; or None for all materials,
            those of lights left out.
        material
            The new one.

        Raises
        ------
        ValueError
            If there is no such shape.
        KeyError
            If no material has this name.
        """
        made = _material(material)
        if made is None:
            raise TypeError("material: expected a Material, a dict or a text, got None")
        if isinstance(which, str) or which is None:
            self._data.replace_material(which, made)
        elif which < 0:
            raise ValueError(f"which: expected the number of a shape, got {which}")
        else:
            self._data.set_material(which, made)

    def set_camera(
        self,
        position: Vector,
        look_at: Vector,
        up: Vector = (0.0, 0.0, 1.0),
        fov: float = 40.0,
        width: int | None = None,
        height: int | None = None,
        *,
        lens_radius: float = 0.0,
    ) -> None:
        """Set the camera, and the size of the picture.

        Parameters
        ----------
        position, look_at : (3,) array_like
            Where it is, and the point in the middle of the picture, which is in focus.
        up : (3,) array_like
            Upwards in the picture.
        fov
            Field of view over the shorter side of the picture, in degrees.
        width, height
            Pixels; as before where they are not given.
        lens_radius
            In scene units; 0 for a pinhole.

        Raises
        ------
        ValueError
            If a number is out of range, or ``up`` is along the view.
        """
        resolution = [
            self.width if width is None else width,
            self.height if height is None else height,
        ]
        if min(resolution) < 1:
            raise ValueError(f"width, height: expected 1 pixel or more, got {resolution}")
        self._data.set_camera(
            _vector("position", position),
            _vector("look_at", look_at),
            _vector("up", up),
            fov,
            None if width is None and height is None else resolution,
            lens_radius,
        )

    def set_environment(self, radiance: Colour) -> None:
        """Set the light from all directions, in place of what there was.

        Parameters
        ----------
        radiance
            A number, three, or a picture by latitude and longitude, (h, w, 3): the first row is at
            +z, columns run with the azimuth from +x.

        Raises
        ------
        ValueError
            If a value is negative or not finite.
        """
        self._data.set_environment(np.asarray(radiance))

    def add_point_light(self, position: Vector, intensity: Colour) -> None:
        """Add a point light.

        Parameters
        ----------
        position : (3,) array_like
        intensity
            Radiant intensity, per steradian: a number or three.
        """
        colour = _colour("intensity", intensity)
        self._data.add_point_light(_vector("position", position), colour)

    def add_distant_light(
        self, direction: Vector, irradiance: Colour, *, half_angle: float = 0.0
    ) -> None:
        """Add parallel light, or a small round light infinitely far away.

        Parameters
        ----------
        direction : (3,) array_like
            In which light travels.
        irradiance
            Of a surface that faces the light: a number or three.
        half_angle
            Half the angle that the light fills, in degrees; 0 for parallel light, 0.27 for the sun.
        """
        colour = _colour("irradiance", irradiance)
        self._data.add_distant_light(_vector("direction", direction), colour, half_angle)

    def add_spot_light(
        self,
        position: Vector,
        look_at: Vector,
        intensity: Colour,
        *,
        cone_angle: float = 30.0,
        falloff_start: float = 25.0,
    ) -> None:
        """Add a spot light.

        Parameters
        ----------
        position, look_at : (3,) array_like
        intensity
            Radiant intensity along the axis, per steradian: a number or three.
        cone_angle, falloff_start
            Half angles in degrees: of the cone, and of where the intensity begins to fall.
        """
        position, look_at = _vector("position", position), _vector("look_at", look_at)
        colour = _colour("intensity", intensity)
        self._data.add_spot_light(position, look_at, colour, cone_angle, falloff_start)

    def __repr__(self) -> str:
        """The name and the counts."""
        shapes, materials = self._data.shape_count(), len(self.materials)
        return (
            f"<Scene {self.name!r}: {self.width} x {self.height} pixels, "
            f"{shapes} shapes, {materials} materials>"
        )


def load(
    path: PathLike,
    *,
    parameters: Mapping[str, object] | None = None,
    search: Sequence[PathLike] = (),
    at: float | None = None,
    shutter: float | None = None,
    animation: str | None = None,
) -> Scene:
    """Read a scene: pbrt-v4, Mitsuba 3, glTF 2.0, OBJ or PLY; the content tells which.

    Parameters
    ----------
    path
        The file; it may be packed by gzip.
    parameters
        Values of ``$name`` in a Mitsuba scene.
    search
        Folders that are searched for files that the scene names and that are not beside it.
    at
        The moment of a glTF file's animation that is shown, in seconds; by default the pose that
        the file stores.
    shutter
        Seconds that the shutter is open from that moment on: what moves is blurred.
    animation
        Which animation of a glTF file, by its name or its number from 0; by default all together,
        or the first alone where they move the same.

    Raises
    ------
    OSError
        If a file cannot be read.
    ValueError
        If the scene is damaged or would be meaningless; the message begins with file, line and
        column. If a time is below 0, or there is no such animation.

    Warns
    -----
    SceneWarning
        Of every difference between the file and what is rendered.
    """
    given = [(name, str(value)) for name, value in (parameters or {}).items()]
    folders = [os.fspath(p) for p in search]
    still = at is None and shutter is None and animation is None
    exposure = None if still else (at or 0.0, shutter or 0.0)
    data, messages = _native.load(os.fspath(path), given, folders, exposure, animation)
    for message in dict.fromkeys(messages):
        warnings.warn(message, SceneWarning, stacklevel=2)
    return Scene._of(data)


def builtin() -> Scene:
    """Return the built-in scene: ten orbs of rough metal, 960 x 400 pixels."""
    return Scene._of(_native.builtin())
