"""Pictures: layers as arrays, files, comparisons."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Literal, Union

import numpy as np
import numpy.typing as npt

from specula_render import _native

FloatArray = npt.NDArray[np.float32]
PathLike = Union[str, "os.PathLike[str]"]
ToneMap = Literal["clamp", "filmic"]


@dataclass(frozen=True)
class Comparison:
    """The distances between a picture and its reference."""

    rmse: float
    """Root of the mean squared difference, over pixels and channels."""
    rel_mse: float
    """Mean of ``(t - r)^2 / (r^2 + 0.01)`` (Rousselle et al. 2011)."""
    mae: float
    """Mean absolute difference."""
    bias: float
    """Mean difference: light gained or lost."""
    rel_bias: float
    """``bias`` over the mean of the reference; 0 where that is black."""
    max_difference: float
    """The largest absolute difference of any channel."""
    psnr_db: float
    """Peak signal-to-noise ratio of the displayed values; infinite where equal."""
    flip: float
    """Mean LDR-FLIP at exposure 0 (Andersson et al. 2020)."""
    hdr_flip: float
    """Mean HDR-FLIP (Andersson et al. 2021)."""
    skipped: int
    """Pixels left out of all but FLIP, as one of the two is not finite there."""
    flip_map: FloatArray = field(repr=False, compare=False)
    """HDR-FLIP of each pixel, (h, w), in [0, 1]."""


class Picture:
    """A picture with what a renderer knows about each pixel. Rows run from the top.

    Layers are arrays that cannot be written to; take a copy to change one.

    Parameters
    ----------
    rgb : (h, w, 3) array_like
        Linear RGB, sRGB primaries.

    Attributes
    ----------
    samples : float
        Samples per pixel on average; 0 where unknown.
    noise : float
        Estimated relative error; infinite below two samples per pixel or where unknown.
    rays : int
        Rays that were followed.
    seconds : float
        Time that the rendering took.

    Raises
    ------
    ValueError
        If ``rgb`` has another shape or no pixels.

    Examples
    --------
    >>> import numpy as np
    >>> import specula_render as sr
    >>> grey = sr.Picture(np.full((2, 3, 3), 0.5))
    >>> grey.width, grey.height, grey.albedo is None
    (3, 2, True)
    """

    samples: float = 0.0
    noise: float = float("inf")
    rays: int = 0
    seconds: float = 0.0

    def __init__(self, rgb: npt.ArrayLike) -> None:
        self._data = _native.PictureData.from_rgb(np.asarray(rgb, dtype=np.float32))

    @classmethod
    def _of(cls, data: _native.PictureData) -> Picture:
        picture = cls.__new__(cls)
        picture._data = data
        return picture

    @property
    def width(self) -> int:
        """Pixels in a row."""
        return self._data.size[0]

    @property
    def height(self) -> int:
        """Rows."""
        return self._data.size[1]

    def _layer(self, name: str) -> FloatArray | None:
        layer = self._data.layer(name)
        if layer is not None:
            layer.setflags(write=False)
        return layer

    @cached_property
    def rgb(self) -> FloatArray:
        """Radiance times exposure: (h, w, 3), linear RGB, sRGB primaries."""
        layer = self._layer("rgb")
        if layer is None:
            raise ValueError("the picture has no pixels")
        return layer

    @cached_property
    def albedo(self) -> FloatArray | None:
        """Albedo of the first visible surface: (h, w, 3); None where unknown."""
        return self._layer("albedo")

    @cached_property
    def normal(self) -> FloatArray | None:
        """Shading normal of the first visible surface, in the world: (h, w, 3)."""
        return self._layer("normal")

    @cached_property
    def depth(self) -> FloatArray | None:
        """Distance to the first visible surface, in scene units: (h, w); 0 where there is none."""
        return self._layer("depth")

    @cached_property
    def variance(self) -> FloatArray | None:
        """Estimated variance of ``rgb``, that is, of the mean: (h, w, 3)."""
        return self._layer("variance")

    @cached_property
    def sample_count(self) -> FloatArray | None:
        """Samples of each pixel: (h, w)."""
        return self._layer("sample_count")

    def to_png(
        self, path: PathLike, exposure: float = 0.0, *, tone_map: ToneMap = "clamp"
    ) -> None:
        """Write 8-bit sRGB, whole or not at all.

        Parameters
        ----------
        path
            The file; an older one of that name is replaced.
        exposure
            Stops: colours are multiplied by 2 to this power.
        tone_map
            ``"clamp"``, which shows [0, 1] exactly, or ``"filmic"``.

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        self._data.to_png(os.fspath(path), exposure, tone_map)

    def to_exr(self, path: PathLike) -> None:
        """Write OpenEXR: 32-bit floats, all layers, without loss; whole or not at all.

        Values that are infinite or not a number are written as 0.

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        self._data.to_exr(os.fspath(path))

    def compare(self, reference: Picture | npt.ArrayLike) -> Comparison:
        """Return the distances of this picture's colours to those of a reference.

        Parameters
        ----------
        reference
            A picture, or an array of shape (h, w, 3), linear RGB.

        Raises
        ------
        ValueError
            If the sizes differ.
        """
        if not isinstance(reference, Picture):
            reference = Picture(reference)
        metrics, flip_map = self._data.compare(reference._data)
        return Comparison(flip_map=flip_map, **metrics)

    def _repr_png_(self) -> bytes:
        """The picture as Jupyter shows it."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "picture.png"
            self.to_png(path)
            return path.read_bytes()

    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[np.generic]:
        """``rgb``, for functions of NumPy and Matplotlib."""
        return np.array(self.rgb, dtype=dtype) if copy else np.asarray(self.rgb, dtype=dtype)

    def __repr__(self) -> str:
        """The size, and what is known of the render."""
        parts = [f"{self.width} x {self.height}"]
        if self.samples > 0.0:
            parts.append(f"{self.samples:.4g} samples per pixel")
        if np.isfinite(self.noise):
            parts.append(f"noise {100.0 * self.noise:.2g} %")
        return f"<Picture {', '.join(parts)}>"


def read_exr(path: PathLike) -> Picture:
    """Read an OpenEXR file, by any program.

    Layers other than the colours are known where they bear Specula's names.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If it is damaged, of an unknown compression, or without colours.
    """
    return Picture._of(_native.read_exr(os.fspath(path)))
