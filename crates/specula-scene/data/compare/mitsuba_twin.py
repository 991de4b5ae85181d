"""A pbrt-v4 scene rebuilt for Mitsuba 3 with pbrt's conventions, straight from the file's text.

What has no equal there: coateddiffuse becomes the plastics with a nonlinear base (their coat does
not roughen what it lets in), coatedconductor a metal below a coat of the plastics' Fresnel factors,
diffusetransmission is missing. Mitsuba masks separably, pbrt height-correlated.
"""
import gzip
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

import pbrt_text
from pictures import load

METALS = Path(mi.__file__).parent / "data" / "ior"
SMOOTH = 1e-3  # pbrt's: rougher than this is not a mirror


def translate(v):
    m = np.eye(4)
    m[:3, 3] = v
    return m


def rotate(degrees, axis):
    a = np.array(axis) / np.linalg.norm(axis)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    cross = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    m = np.eye(4)
    m[:3, :3] = c * np.eye(3) + s * cross + (1 - c) * np.outer(a, a)
    return m


def look_at(numbers):
    """World to camera; x to the right, y up, z forwards: a left-handed frame."""
    eye, at, up = (np.array(numbers[i : i + 3]) for i in (0, 3, 6))
    z = (at - eye) / np.linalg.norm(at - eye)
    x = np.cross(up / np.linalg.norm(up), z)
    x /= np.linalg.norm(x)
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = x, np.cross(z, x), z, eye
    return np.linalg.inv(m)


def read_ply(path):
    """Vertices by property name, and triangles."""
    data = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
    end = data.index(b"end_header\n") + 11
    types = {"float": "f4", "double": "f8", "uchar": "u1", "uint8": "u1", "int": "i4", "uint": "u4",
             "char": "i1", "short": "i2", "ushort": "u2", "int32": "i4", "float32": "f4"}  # fmt: skip
    order, elements = "<", []
    for line in data[:end].decode().splitlines():
        word = line.split()
        if word[0] == "format":
            order = {"binary_little_endian": "<", "binary_big_endian": ">", "ascii": "a"}[word[1]]
        elif word[0] == "element":
            elements.append((word[1], int(word[2]), []))
        elif word[0] == "property":
            elements[-1][2].append(word[1:])
    vertices, faces, at = None, [], end
    lines = data[end:].decode().split("\n") if order == "a" else None
    for name, count, properties in elements:
        names = [p[-1] for p in properties]
        if lines is not None:
            rows, lines = lines[:count], lines[count:]
            if name == "vertex":
                table = np.array([[float(x) for x in r.split()] for r in rows])
                vertices = {n: table[:, i] for i, n in enumerate(names)}
            elif name == "face":
                faces += [[int(x) for x in r.split()[1 : 1 + int(r.split()[0])]] for r in rows]
        elif name == "vertex":
            dtype = np.dtype([(p[-1], order + types[p[0]]) for p in properties])
            table = np.frombuffer(data, dtype, count, at)
            at += dtype.itemsize * count
            vertices = {n: table[n].astype(np.float64) for n in names}
        elif name == "face":
            for _ in range(count):
                for p in properties:
                    if p[0] != "list":
                        at += np.dtype(types[p[0]]).itemsize
                        continue
                    size = np.frombuffer(data, order + types[p[1]], 1, at)
                    at += size.itemsize
                    row = np.frombuffer(data, order + types[p[2]], int(size[0]), at)
                    at += row.nbytes
                    if p[-1] in ("vertex_indices", "vertex_index"):
                        faces.append(row.tolist())
    triangles = [[f[0], f[i], f[i + 1]] for f in faces for i in range(1, len(f) - 1)]
    return vertices, np.array(triangles)


def mesh(name, points, triangles, normals, uv, to_world, reverse, props):
    """A mesh whose geometric normals are pbrt's: towards the given normals, else by winding."""
    points = points @ to_world[:3, :3].T + to_world[:3, 3]
    a, b, c = (points[triangles[:, i]] for i in range(3))
    n = np.cross(b - a, c - a)
    if normals is not None:
        normals = normals @ np.linalg.inv(to_world[:3, :3])
        normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        normals = -normals if reverse else normals
        flip = (n * normals[triangles].sum(1)).sum(1) < 0
    else:
        flip = np.full(len(n), reverse ^ (np.linalg.det(to_world[:3, :3]) < 0))
    triangles = np.where(flip[:, None], triangles[:, ::-1], triangles)
    out = mi.Mesh(name, len(points), len(triangles), props=props,
                  has_vertex_normals=normals is not None, has_vertex_texcoords=uv is not None)  # fmt: skip
    values = mi.traverse(out)
    values["vertex_positions"] = points.astype(np.float32).ravel()
    if normals is not None:
        values["vertex_normals"] = normals.astype(np.float32).ravel()
    if uv is not None:
        values["vertex_texcoords"] = uv.astype(np.float32).ravel()
    values["faces"] = triangles.astype(np.uint32).ravel()
    values.update()
    return out


def square_of_sphere(d):
    """Clarberg 2008's equal-area octahedral map, z up: unit vectors to [0, 1]^2."""
    x, y, z = np.abs(d).T
    r = np.sqrt(np.maximum(1 - z, 0))
    phi = np.where(x + y > 0, np.arctan2(np.minimum(x, y), np.maximum(x, y)), 0) * 2 / np.pi
    phi = np.where(x < y, 1 - phi, phi)
    v = phi * r
    u = r - v
    below = d[:, 2] < 0
    u, v = np.where(below, 1 - v, u), np.where(below, 1 - u, v)
    return np.stack([np.copysign(u, d[:, 0]) + 1, np.copysign(v, d[:, 1]) + 1], axis=1) / 2


def environment(path, to_world, scale):
    """Mitsuba's map in world directions, of pbrt's square one."""
    image = load(path)[0]
    size = image.shape[0]
    width, height = 4 * size, 2 * size + 1
    u = (np.arange(width) + 0.5) / width * 2 * np.pi
    v = np.arange(height) / (height - 1) * np.pi
    u, v = np.meshgrid(u, v)
    d = np.stack([np.sin(u) * np.sin(v), np.cos(v), -np.cos(u) * np.sin(v)], -1).reshape(-1, 3)
    d = d @ np.linalg.inv(to_world[:3, :3]).T
    st = square_of_sphere(d / np.linalg.norm(d, axis=1, keepdims=True)) * size - 0.5
    low = np.floor(st).astype(int)
    f = st - low
    texel = lambda i, j: image[np.clip(j, 0, size - 1), np.clip(i, 0, size - 1)]
    colour = 0
    for i in (0, 1):
        for j in (0, 1):
            w = (f[:, 0] if i else 1 - f[:, 0]) * (f[:, 1] if j else 1 - f[:, 1])
            colour = colour + w[:, None] * texel(low[:, 0] + i, low[:, 1] + j)
    bitmap = mi.Bitmap((scale * colour).reshape(height, width, 3).astype(np.float32))
    return {"type": "envmap", "bitmap": bitmap}


def rgb(v):
    return {"type": "rgb", "value": [float(x) for x in np.broadcast_to(v, 3)]}


class Twin:
    def __init__(self, file, samples):
        self.folder, self.notes = file.parent, set()
        self.scene = {"type": "scene"}
        self.ctm, self.stack, self.reverse = np.eye(4), [], False
        self.material, self.area = ("diffuse", {}), None
        self.named, self.textures, self.size, self.depth = {}, {}, (0, 0), 5
        self.samples, self.camera, self.fov = samples, np.eye(4), 90.0
        self.read(file)
        w, h = self.size
        flip = np.diag([-1.0, 1, 1, 1])
        self.scene["sensor"] = {
            "type": "perspective", "fov": self.fov, "fov_axis": "smaller", "near_clip": 1e-2,
            "far_clip": 1e6, "to_world": mi.ScalarTransform4f(self.camera @ flip),
            "film": {"type": "hdrfilm", "width": w, "height": h, "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": samples},
        }  # fmt: skip
        # Roulette as late as the path's end, so that the noise is the same as without it.
        self.scene["integrator"] = {"type": "path", "max_depth": self.depth + 1, "rr_depth": 1000}

    def read(self, file):
        for d in pbrt_text.directives(file.read_text()):
            self.directive(d)

    def directive(self, d):
        name = d.name
        if name == "Include":
            self.read(self.folder / d.args[0])
        elif name == "AttributeBegin":
            self.stack.append((self.ctm, self.material, self.area, self.reverse))
        elif name == "AttributeEnd":
            self.ctm, self.material, self.area, self.reverse = self.stack.pop()
        elif name == "WorldBegin":
            self.ctm = np.eye(4)
        elif name == "ReverseOrientation":
            self.reverse = not self.reverse
        elif name == "LookAt":
            self.ctm = self.ctm @ look_at(d.args)
        elif name == "Translate":
            self.ctm = self.ctm @ translate(d.args)
        elif name == "Scale":
            self.ctm = self.ctm @ np.diag([*d.args, 1])
        elif name == "Rotate":
            self.ctm = self.ctm @ rotate(d.args[0], d.args[1:])
        elif name == "Transform":
            self.ctm = np.array(d.args).reshape(4, 4).T
        elif name == "ConcatTransform":
            self.ctm = self.ctm @ np.array(d.args).reshape(4, 4).T
        elif name == "Film":
            self.size = int(d.get("xresolution")), int(d.get("yresolution"))
        elif name == "Integrator":
            self.depth = int(d.get("maxdepth", 5))
        elif name == "Camera":
            self.camera, self.fov = np.linalg.inv(self.ctm), d.get("fov", 90.0)
        elif name == "Texture":
            self.textures[d.args[0]] = self.texture(d)
        elif name == "MakeNamedMaterial":
            self.named[d.args[0]] = (d.get("type"), d)
        elif name == "NamedMaterial":
            self.material = self.named[d.args[0]]
        elif name == "Material":
            self.material = (d.args[0], d)
        elif name == "AreaLightSource":
            self.area = np.array(d.get("L", [1, 1, 1])) * d.get("scale", 1.0)
        elif name == "LightSource":
            path = self.folder / d.get("filename")
            self.scene["environment"] = environment(path, self.ctm, d.get("scale", 1.0))
        elif name == "Shape":
            self.shape(d)

    def texture(self, d):
        if d.args[2] == "checkerboard":
            scale = [d.get("uscale", 1.0) / 2, d.get("vscale", 1.0) / 2, 1]
            return {"type": "checkerboard", "color0": rgb(d.get("tex1", 1.0)),
                    "color1": rgb(d.get("tex2", 0.0)),
                    "to_uv": mi.ScalarTransform3f().scale(scale[:2])}  # fmt: skip
        # Pictures hang upside down relative to pbrt's t.
        flip = mi.ScalarTransform3f().translate([0, 1]).scale([1, -1])
        return {"type": "bitmap", "filename": str(self.folder / d.get("filename")), "to_uv": flip}

    def spectrum(self, d, name, default):
        """Samples (nm, value) of a named or given spectrum."""
        value = d.get(name, default)
        if isinstance(value, str) and value.startswith("metal-"):
            _, metal, which = value.split("-")
            return np.loadtxt(METALS / f"{metal}.{which}.spd", comments="#")
        if isinstance(value, str):
            return np.loadtxt(self.folder / value)
        return np.array(value, dtype=float)

    def index(self, d, prefix=""):
        """eta and k. Spectra for RGB: per channel, those whose Fresnel curve is nearest to the
        spectral one under D65."""
        eta = self.spectrum(d, prefix + "eta", "metal-Cu-eta")
        k = self.spectrum(d, prefix + "k", "metal-Cu-k")
        if "spectral" in mi.variant():
            if eta.ndim == 1:
                # Mitsuba cuts an rgb index at 1 without a word: a line through three wavelengths.
                eta, k = (np.stack([[450.0, 550.0, 610.0], x[::-1]], axis=1) for x in (eta, k))
                eta, k = (np.concatenate([[[300, x[0, 1]]], x, [[900, x[-1, 1]]]]) for x in (eta, k))
            return [{"type": "spectrum", "value": [tuple(map(float, r)) for r in s]} for s in (eta, k)]
        return [rgb(x) for x in ((eta, k) if eta.ndim == 1 else fitted_metal(eta, k))]

    def colour(self, d, name, default):
        value = d.get(name, default)
        if d.kind(name) == "texture":
            return self.textures[value]
        return rgb(np.minimum(value, 1.0))

    def alpha(self, d, prefix=""):
        both = d.get(prefix + "roughness", 0.0)
        pair = [d.get(prefix + "uroughness", both), d.get(prefix + "vroughness", both)]
        return [np.sqrt(a) if d.get("remaproughness", True) else a for a in pair]

    def bsdf(self, material):
        kind, d = material
        if kind == "diffuse":
            reflectance = self.colour(d, "reflectance", 0.5) if d else rgb(0.5)
            return both_sides({"type": "diffuse", "reflectance": reflectance})
        if kind == "conductor":
            eta, k = self.index(d)
            return both_sides(with_alpha("conductor", self.alpha(d), eta=eta, k=k))
        if kind == "dielectric":
            eta = d.get("eta", 1.5)
            if isinstance(eta, str):
                eta = {"glass-BK7": 1.5168}[eta]
                self.notes.add("dispersive glass by one index")
            return with_alpha("dielectric", self.alpha(d), int_ior=float(eta), ext_ior=1.0)
        if kind == "coateddiffuse":
            self.notes.add("coateddiffuse by plastic")
            return both_sides(with_alpha("plastic", [self.alpha(d)[0]] * 2, nonlinear=True,
                int_ior=float(d.get("eta", 1.5)), ext_ior=1.0,
                diffuse_reflectance=self.colour(d, "reflectance", 0.5)))  # fmt: skip
        if kind == "coatedconductor":
            self.notes.add("coatedconductor without its coat")
            eta, k = self.index(d, "conductor.")
            alpha = self.alpha(d, "conductor.")
            return both_sides(with_alpha("conductor", alpha, eta=eta, k=k))
        if kind == "mix":
            parts = [self.bsdf(self.named[n]) for n in d.get("materials")]
            return {"type": "blendbsdf", "weight": d.get("amount", 0.5), "a": parts[0], "b": parts[1]}
        if kind == "diffusetransmission":
            self.notes.add("diffusetransmission without transmission")
            return both_sides({"type": "diffuse", "reflectance": self.colour(d, "reflectance", 0.25)})
        raise ValueError(f"no equal for {kind}")

    def shape(self, d):
        if self.material[0] == "interface":
            return
        parts = {"bsdf": mi.load_dict(self.bsdf(self.material))}
        if self.area is not None:
            parts["emitter"] = mi.load_dict({"type": "area", "radiance": rgb(self.area)})
        name, kind = f"shape{len(self.scene)}", d.args[0]
        if kind in ("sphere", "disk"):
            radius = d.get("radius", 1.0)
            to_world = self.ctm @ translate([0, 0, d.get("height", 0.0)])
            to_world = mi.ScalarTransform4f(to_world @ np.diag([radius, radius, radius, 1]))
            self.scene[name] = {"type": kind, "to_world": to_world, **parts}
            return
        if kind == "trianglemesh":
            grid = lambda n, width: None if d.get(n) is None else np.array(d.get(n)).reshape(-1, width)
            points, normals, uv = grid("P", 3), grid("N", 3), grid("uv", 2)
            triangles = np.array(d.get("indices"), dtype=int).reshape(-1, 3)
        else:
            vertices, triangles = read_ply(self.folder / d.get("filename"))
            stack = lambda names: np.stack([vertices[n] for n in names], axis=1)
            points = stack("xyz")
            normals = stack(["nx", "ny", "nz"]) if "nx" in vertices else None
            pairs = [("u", "v"), ("s", "t"), ("texture_u", "texture_v"), ("texture_s", "texture_t")]
            uv = next((stack(p) for p in pairs if p[0] in vertices), None)
        props = mi.Properties()
        for key, part in parts.items():
            props[key] = part
        self.scene[name] = mesh(name, points, triangles, normals, uv, self.ctm, self.reverse, props)


def both_sides(bsdf):
    return {"type": "twosided", "bsdf": bsdf}


def with_alpha(name, alpha, **rest):
    if max(alpha) < SMOOTH:
        return {"type": name, **rest}
    width = {"alpha_u": float(alpha[0]), "alpha_v": float(alpha[1])}
    if name == "plastic":
        width = {"alpha": float(alpha[0])}
    return {"type": f"rough{name}", "distribution": "ggx", **width, **rest}


def conductor(cosine, eta, k):
    """Unpolarised Fresnel reflectance."""
    index = eta + 1j * k
    t = np.sqrt(1 - (1 - cosine**2) / index**2)
    s = np.abs((cosine - index * t) / (cosine + index * t)) ** 2
    p = np.abs((index * cosine - t) / (index * cosine + t)) ** 2
    return (s + p) / 2


FITTED = {}


def fitted_metal(eta, k):
    key = (eta.tobytes(), k.tobytes())
    if key not in FITTED:
        FITTED[key] = fit(eta, k)
    return FITTED[key]


def fit(eta, k):
    nm = np.arange(380.0, 721.0, 5.0)
    weights = observer(nm)
    held = lambda s: np.interp(nm, s[:, 0], s[:, 1])
    cosines = np.linspace(0.05, 1.0, 20)
    spectral = np.stack([conductor(c, held(eta), held(k)) for c in cosines])
    curves = spectral @ weights
    out = np.zeros((2, 3))
    for channel in range(3):
        best, centre, span = None, np.array([1.0, 4.0]), np.array([3.0, 4.0])
        for _ in range(40):
            n = np.clip(centre[0] + span[0] * np.linspace(-1, 1, 11), 0.01, None)
            kk = np.clip(centre[1] + span[1] * np.linspace(-1, 1, 11), 0.0, None)
            n, kk = (x.ravel() for x in np.meshgrid(n, kk))
            error = sum(
                c * (conductor(c, n, kk) - curve) ** 2 for c, curve in zip(cosines, curves[:, channel])
            )
            best = error.argmin()
            centre, span = np.array([n[best], kk[best]]), span * 0.7
        out[:, channel] = centre
    return out


def observer(nm):
    """Weights (wavelength, channel) that turn a reflectance under D65 into linear sRGB: CIE 1931 by
    Wyman, Sloan and Shirley 2013's fit, and D65 by a blackbody of 6504 K, normalised to white."""
    lobe = lambda c, l, r: np.exp(-0.5 * ((nm - c) * np.where(nm < c, l, r)) ** 2)
    x = 1.056 * lobe(599.8, 1 / 37.9, 1 / 31.0) + 0.362 * lobe(442.0, 1 / 16.0, 1 / 26.7)
    x -= 0.065 * lobe(501.1, 1 / 20.4, 1 / 26.2)
    y = 0.821 * lobe(568.8, 1 / 46.9, 1 / 40.5) + 0.286 * lobe(530.9, 1 / 16.3, 1 / 31.1)
    z = 1.217 * lobe(437.0, 1 / 11.8, 1 / 36.0) + 0.681 * lobe(459.0, 1 / 26.0, 1 / 13.8)
    light = nm**-5.0 / (np.exp(1.4388e7 / (nm * 6504)) - 1)
    matrix = np.array(
        [[3.2404542, -1.5371385, -0.4985314], [-0.969266, 1.8760108, 0.041556],
         [0.0556434, -0.2040259, 1.0572252]]
    )  # fmt: skip
    weights = (np.stack([x, y, z], axis=1) * light[:, None]) @ matrix.T
    return weights / weights.sum(0)


def render(file, samples, runs):
    """Independent pictures of a variant's scene, and what was not the same."""
    twin = Twin(Path(file), samples)
    scene = mi.load_dict(twin.scene)
    pictures = [np.array(mi.render(scene, spp=samples, seed=s + 1), float) for s in range(runs)]
    return [p[:, :, :3] for p in pictures], sorted(twin.notes)


if __name__ == "__main__":
    made, differs = render(sys.argv[1], 64, 2)
    print(np.mean(made), differs)
