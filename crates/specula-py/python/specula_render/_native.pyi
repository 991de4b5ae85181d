from collections.abc import Callable, Iterator, Sequence
from os import PathLike
from typing import Any, Literal, Protocol, SupportsFloat, TypeAlias, TypedDict, final

import numpy as np
import numpy.typing as npt
from typing_extensions import disjoint_base

__version__: str

class _DLPack(Protocol):
    def __dlpack__(self, *, stream: Any = None) -> Any: ...
    def __dlpack_device__(self) -> tuple[int, int]: ...

_Array: TypeAlias = npt.NDArray[np.floating[Any]] | _DLPack | Sequence[Any] | float
_Colour: TypeAlias = float | Sequence[float] | npt.NDArray[np.floating[Any]]
_Alphas: TypeAlias = float | Sequence[float] | npt.NDArray[np.floating[Any]]
_Paint: TypeAlias = float | Sequence[Any] | npt.NDArray[Any]
_AnyReflectance: TypeAlias = Reflectance | str | _Colour
_Distribution: TypeAlias = Literal["ggx", "beckmann"]
_Sampler: TypeAlias = Literal["heitz", "cap", "bounded", "exact"]
_Masking: TypeAlias = Literal["height-correlated", "separable"]
_Transport: TypeAlias = Literal["radiance", "importance"]
_Axis: TypeAlias = Literal[-1, 0]
_Energy: TypeAlias = Literal["turquin", "turquin-series", "kulla-conty"]
_MisPdf: TypeAlias = Literal["lambert", "hapke", "normalised"]
_Model: TypeAlias = Literal[
    "heitz", "bitterli", "wang", "wang-uncorrelated", "cui", "cui-bidirectional", "specula"
]

class _Metal(TypedDict):
    symbol: str
    name: str
    eta: list[float]
    k: list[float]
    f0: list[float]
    source: str

def level() -> str: ...
def metals() -> list[_Metal]: ...
def dielectric(cos: _Array, eta: SupportsFloat) -> npt.NDArray[Any]: ...
def energy_tables(distribution: str, masking: str) -> dict[str, npt.NDArray[np.float32]]: ...
def command_line(arguments: Sequence[str]) -> int: ...
@final
class Samples:
    @property
    def wi(self) -> npt.NDArray[Any]: ...
    @property
    def weight(self) -> npt.NDArray[Any]: ...
    @property
    def pdf(self) -> npt.NDArray[Any]: ...
    @property
    def outcome(self) -> npt.NDArray[np.uint8]: ...
    def __iter__(self) -> Iterator[npt.NDArray[Any]]: ...

@final
class Reflectance:
    @staticmethod
    def constant(colour: _Colour) -> Reflectance: ...
    @staticmethod
    def conductor(eta: _Colour, k: _Colour) -> Reflectance: ...
    @staticmethod
    def metal(symbol: str) -> Reflectance: ...
    @staticmethod
    def schlick(f0: _Colour) -> Reflectance: ...
    @staticmethod
    def f82_tint(f0: _Colour, tint: _Colour) -> Reflectance: ...
    def tinted(self, tint: _Colour) -> Reflectance: ...
    def eval(self, cos: _Array) -> npt.NDArray[Any]: ...

class _Normals:
    @property
    def alpha(self) -> tuple[float, float]: ...
    def d(self, wm: _Array, *, axis: _Axis = ..., threads: int = 1) -> npt.NDArray[Any]: ...
    def lambda_(self, w: _Array, *, axis: _Axis = ..., threads: int = 1) -> npt.NDArray[Any]: ...
    def g1(self, w: _Array, *, axis: _Axis = ..., threads: int = 1) -> npt.NDArray[Any]: ...
    def g2(
        self,
        wo: _Array,
        wi: _Array,
        *,
        masking: _Masking = "height-correlated",
        axis: _Axis = ...,
        threads: int = 1,
    ) -> npt.NDArray[Any]: ...
    def projected_area(
        self, w: _Array, *, axis: _Axis = ..., threads: int = 1
    ) -> npt.NDArray[Any]: ...
    def d_visible(
        self, wo: _Array, wm: _Array, *, axis: _Axis = ..., threads: int = 1
    ) -> npt.NDArray[Any]: ...

@final
class Ggx(_Normals):
    def __new__(cls, alpha: _Alphas) -> Ggx: ...
    def sample_wm(
        self,
        wo: _Array,
        u: _Array,
        *,
        sampler: Literal["heitz", "cap"] = "cap",
        axis: _Axis = ...,
        threads: int = 1,
    ) -> npt.NDArray[Any]: ...
    def sample_reflection(
        self,
        wo: _Array,
        u: _Array,
        *,
        sampler: _Sampler = "exact",
        axis: _Axis = ...,
        threads: int = 1,
    ) -> npt.NDArray[Any]: ...
    def reflection_pdf(
        self,
        wo: _Array,
        wi: _Array,
        *,
        sampler: _Sampler = "exact",
        axis: _Axis = ...,
        threads: int = 1,
    ) -> npt.NDArray[Any]: ...

@final
class Beckmann(_Normals):
    def __new__(cls, alpha: _Alphas) -> Beckmann: ...
    def sample_wm(
        self, wo: _Array, u: _Array, *, axis: _Axis = ..., threads: int = 1
    ) -> npt.NDArray[Any]: ...

@disjoint_base
class Bsdf:
    @property
    def is_stochastic(self) -> bool: ...
    @property
    def is_specular(self) -> bool: ...
    @property
    def colour(self) -> tuple[float, float, float]: ...
    def eval(
        self,
        wo: _Array,
        wi: _Array,
        *,
        axis: _Axis = ...,
        transport: _Transport = "radiance",
        seed: int = 0,
        threads: int = 1,
        out: npt.NDArray[Any] | None = None,
    ) -> npt.NDArray[Any]: ...
    def pdf(
        self,
        wo: _Array,
        wi: _Array,
        *,
        axis: _Axis = ...,
        threads: int = 1,
        out: npt.NDArray[Any] | None = None,
    ) -> npt.NDArray[Any]: ...
    def eval_pdf(
        self,
        wo: _Array,
        wi: _Array,
        *,
        axis: _Axis = ...,
        transport: _Transport = "radiance",
        seed: int = 0,
        threads: int = 1,
    ) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]: ...
    def sample(
        self,
        wo: _Array,
        u: _Array | None = None,
        *,
        rng: np.random.Generator | None = None,
        axis: _Axis = ...,
        transport: _Transport = "radiance",
        seed: int = 0,
        threads: int = 1,
        out: Samples | None = None,
    ) -> Samples: ...

@final
class Lambert(Bsdf):
    def __new__(cls, albedo: _Colour = ...) -> Lambert: ...

@final
class Eon(Bsdf):
    def __new__(cls, albedo: _Colour = ..., roughness: float = 0.5) -> Eon: ...

@final
class DiffuseTransmission(Bsdf):
    def __new__(
        cls, reflectance: _Colour = ..., transmittance: _Colour = ...
    ) -> DiffuseTransmission: ...

@final
class SmoothConductor(Bsdf):
    def __new__(cls, reflectance: _AnyReflectance = ...) -> SmoothConductor: ...

@final
class RoughConductor(Bsdf):
    def __new__(
        cls,
        alpha: _Alphas,
        reflectance: _AnyReflectance = ...,
        *,
        distribution: _Distribution = "ggx",
        sampler: _Sampler | None = None,
        masking: _Masking = "height-correlated",
        energy: _Energy | None = None,
    ) -> RoughConductor: ...

@final
class MultibounceConductor(Bsdf):
    def __new__(
        cls,
        alpha: _Alphas,
        reflectance: _AnyReflectance = ...,
        *,
        distribution: _Distribution = "ggx",
        model: _Model = "specula",
        mis_pdf: _MisPdf | None = None,
    ) -> MultibounceConductor: ...

@final
class SmoothDielectric(Bsdf):
    def __new__(
        cls,
        eta: float = 1.5,
        *,
        reflection_tint: _Colour = ...,
        transmission_tint: _Colour = ...,
    ) -> SmoothDielectric: ...

@final
class ThinDielectric(Bsdf):
    def __new__(
        cls,
        eta: float = 1.5,
        *,
        reflection_tint: _Colour = ...,
        transmission_tint: _Colour = ...,
    ) -> ThinDielectric: ...

@final
class RoughDielectric(Bsdf):
    def __new__(
        cls,
        alpha: _Alphas,
        eta: float = 1.5,
        *,
        distribution: _Distribution = "ggx",
        sampler: _Sampler | None = None,
        masking: _Masking = "height-correlated",
        compensated: bool = False,
        reflection_tint: _Colour = ...,
        transmission_tint: _Colour = ...,
    ) -> RoughDielectric: ...

@final
class MultibounceDielectric(Bsdf):
    def __new__(
        cls,
        alpha: _Alphas,
        eta: float = 1.5,
        *,
        distribution: _Distribution = "ggx",
        model: Literal["heitz", "specula"] = "specula",
        mis_pdf: _MisPdf | None = None,
        reflection_tint: _Colour = ...,
        transmission_tint: _Colour = ...,
    ) -> MultibounceDielectric: ...

@final
class CoatedDiffuse(Bsdf):
    def __new__(
        cls,
        alpha: _Alphas | None = None,
        eta: float = 1.5,
        albedo: _Colour = ...,
        *,
        thickness: float = 0.0,
        max_depth: int | None = None,
        scattering: Literal["lossless", "single"] = "lossless",
    ) -> CoatedDiffuse: ...

@final
class Layered(Bsdf):
    def __new__(
        cls,
        alpha: _Alphas | None = None,
        eta: float = 1.5,
        *,
        albedo: _Colour | None = None,
        reflectance: _AnyReflectance | None = None,
        base_alpha: _Alphas | None = None,
        thickness: float = 0.0,
        medium_albedo: _Colour = ...,
        g: float = 0.0,
    ) -> Layered: ...

@final
class Plastic(Bsdf):
    def __new__(
        cls,
        alpha: _Alphas | None = None,
        eta: float = 1.49,
        diffuse: _Colour = ...,
        *,
        specular: _Colour = ...,
        nonlinear: bool = False,
        distribution: _Distribution = "ggx",
        masking: _Masking = "separable",
    ) -> Plastic: ...

@final
class Principled(Bsdf):
    def __new__(
        cls,
        base_color: _Colour = ...,
        roughness: float = 0.5,
        *,
        anisotropic: float = 0.0,
        metallic: float = 0.0,
        spec_trans: float = 0.0,
        eta: float = 1.5,
        spec_tint: float = 0.0,
        sheen: float = 0.0,
        sheen_tint: float = 0.0,
        clearcoat: float = 0.0,
        clearcoat_gloss: float = 0.0,
        flatness: float = 0.0,
        diff_trans: float = 0.0,
        thin: bool = False,
        outside: bool = True,
    ) -> Principled: ...

@final
class Gltf(Bsdf):
    def __new__(
        cls,
        base_color: _Colour = ...,
        metallic: float = 1.0,
        roughness: float = 1.0,
        *,
        anisotropy: float = 0.0,
        ior: float = 1.5,
        specular: float = 1.0,
        specular_color: _Colour = ...,
        transmission: float = 0.0,
        volume: bool = False,
        outside: bool = True,
        clearcoat: float = 0.0,
        clearcoat_roughness: float = 0.0,
        sheen_color: _Colour = ...,
        sheen_roughness: float = 0.0,
        compensated: bool = False,
    ) -> Gltf: ...

@final
class Hair(Bsdf):
    def __new__(
        cls,
        sigma_a: _Colour | None = None,
        *,
        eta: float = 1.55,
        beta_m: float = 0.3,
        beta_n: float = 0.3,
        alpha_deg: float = 2.0,
        colour: _Colour | None = None,
        eumelanin: float | None = None,
        pheomelanin: float | None = None,
        h: float | None = None,
    ) -> Hair: ...

@final
class MeasuredBrdf(Bsdf):
    def __new__(cls, file: str | PathLike[str]) -> MeasuredBrdf: ...
    @property
    def is_isotropic(self) -> bool: ...

@final
class Material:
    @staticmethod
    def parse(text: str) -> Material: ...
    def with_bump_map(self, heights: npt.NDArray[Any]) -> Material: ...
    def with_normal_map(self, normals: npt.NDArray[Any], scale: float = 1.0) -> Material: ...
    @staticmethod
    def diffuse(
        reflectance: _Paint | None = None, *, roughness: _Paint | None = None
    ) -> Material: ...
    @staticmethod
    def diffuse_transmission(
        reflectance: _Paint | None = None, transmittance: _Paint | None = None
    ) -> Material: ...
    @staticmethod
    def conductor(
        metal: str | None = None,
        *,
        eta: _Paint | None = None,
        k: _Paint | None = None,
        reflectance: _Paint | None = None,
        f0: _Paint | None = None,
        alpha: _Alphas | None = None,
        roughness: _Paint | None = None,
        distribution: _Distribution = "ggx",
        tint: _Paint | None = None,
    ) -> Material: ...
    @staticmethod
    def dielectric(
        eta: float = 1.5,
        *,
        alpha: _Alphas | None = None,
        roughness: _Paint | None = None,
        distribution: _Distribution = "ggx",
        reflection_tint: _Paint | None = None,
        transmission_tint: _Paint | None = None,
        absorption: _Colour | None = None,
    ) -> Material: ...
    @staticmethod
    def thin_dielectric(
        eta: float = 1.5,
        *,
        reflection_tint: _Paint | None = None,
        transmission_tint: _Paint | None = None,
    ) -> Material: ...
    @staticmethod
    def coated_diffuse(
        reflectance: _Paint | None = None,
        *,
        eta: float = 1.5,
        alpha: _Alphas | None = None,
        roughness: _Paint | None = None,
        distribution: _Distribution = "ggx",
    ) -> Material: ...
    @staticmethod
    def coated_conductor(
        metal: str | None = None,
        *,
        reflectance: _Paint | None = None,
        eta: float = 1.5,
        coat_alpha: float = 0.0,
        alpha: _Alphas | None = None,
        roughness: _Paint | None = None,
        distribution: _Distribution = "ggx",
    ) -> Material: ...
    @staticmethod
    def gltf(
        base_color: _Paint | None = None,
        metallic: _Paint | None = None,
        roughness: _Paint | None = None,
        *,
        anisotropy: _Paint | None = None,
        ior: float = 1.5,
        specular: _Paint | None = None,
        specular_color: _Paint | None = None,
        transmission: _Paint | None = None,
        volume: bool = False,
        clearcoat: _Paint | None = None,
        clearcoat_roughness: _Paint | None = None,
        sheen_color: _Paint | None = None,
        sheen_roughness: _Paint | None = None,
    ) -> Material: ...
    @staticmethod
    def principled(
        base_color: _Paint | None = None,
        roughness: _Paint | None = None,
        *,
        anisotropic: _Paint | None = None,
        metallic: _Paint | None = None,
        spec_trans: _Paint | None = None,
        eta: float = 1.5,
        spec_tint: _Paint | None = None,
        sheen: _Paint | None = None,
        sheen_tint: _Paint | None = None,
        clearcoat: _Paint | None = None,
        clearcoat_gloss: _Paint | None = None,
        flatness: _Paint | None = None,
    ) -> Material: ...

@final
class SceneData:
    def __new__(cls) -> SceneData: ...
    def add_mesh(
        self,
        vertices: npt.NDArray[Any],
        faces: npt.NDArray[np.int64],
        normals: npt.NDArray[Any] | None,
        uvs: npt.NDArray[Any] | None,
        transform: Sequence[Sequence[float]] | None,
        surface: tuple[Material | None, _Colour | None, bool],
        opacity: npt.NDArray[Any] | None,
        object: int | None,
    ) -> tuple[int, int]: ...
    def add_sphere(
        self,
        center: Sequence[float],
        radius: float,
        transform: Sequence[Sequence[float]] | None,
        surface: tuple[Material | None, _Colour | None, bool],
        object: int | None,
    ) -> int: ...
    def add_object(self, name: str) -> int: ...
    def add_instance(self, object: int, transform: Sequence[Sequence[float]]) -> None: ...
    def set_camera(
        self,
        position: Sequence[float],
        look_at: Sequence[float],
        up: Sequence[float],
        fov: float,
        resolution: Sequence[int] | None,
        lens_radius: float,
    ) -> None: ...
    def set_environment(self, radiance: npt.NDArray[Any]) -> None: ...
    def add_point_light(self, position: Sequence[float], intensity: _Colour) -> None: ...
    def add_distant_light(
        self, direction: Sequence[float], irradiance: _Colour, half_angle: float
    ) -> None: ...
    def add_spot_light(
        self,
        position: Sequence[float],
        look_at: Sequence[float],
        intensity: _Colour,
        cone_angle: float,
        falloff_start: float,
    ) -> None: ...
    def set_material(self, shape: int, material: Material) -> None: ...
    def replace_material(self, name: str | None, material: Material) -> None: ...
    def material_names(self) -> list[str | None]: ...
    def shape_count(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def resolution(self) -> list[int]: ...

@final
class RenderJob:
    def __new__(
        cls,
        scene: SceneData,
        *,
        spp: int | None,
        is_bounded: bool,
        seed: int,
        threads: int,
        max_depth: int | None,
        energy: str | None,
        sampler: str | None,
        texture_filter: str,
        filter_normal_maps: bool,
        noise: float | None,
        resolution: Sequence[int] | None,
        clamp: float | None,
        regularize: bool,
        checkpoint: str | None,
        max_memory: int | None,
    ) -> RenderJob: ...
    @property
    def samples(self) -> int: ...
    def advance(
        self,
        samples: int | None,
        time: float | None,
        progress: Callable[[float, float, float, int], None] | None,
    ) -> None: ...
    def picture(self) -> tuple[PictureData, float, float, int, int, float]: ...

@final
class PictureData:
    @staticmethod
    def from_rgb(rgb: npt.NDArray[Any]) -> PictureData: ...
    @property
    def size(self) -> list[int]: ...
    @property
    def window(self) -> tuple[list[int], list[int]]: ...
    def layer(self, name: str) -> npt.NDArray[np.float32] | None: ...
    def to_png(self, path: str, exposure: float, tone_map: str) -> int: ...
    def to_exr(self, path: str) -> int: ...
    def compare(
        self, reference: PictureData
    ) -> tuple[dict[str, Any], npt.NDArray[np.float32]]: ...

def load(
    path: str,
    parameters: Sequence[tuple[str, str]],
    search: Sequence[str],
    exposure: tuple[float, float] | None,
    animation: str | None,
) -> tuple[SceneData, list[str]]: ...
def builtin() -> SceneData: ...
def read_exr(path: str) -> PictureData: ...
