"""pbrt-v4's scene language, read independently of the renderer's own reader.

`directives` gives what a file says, one after the other; `variant` writes a scene again with another
film, sampler and filter, and without media, so that two renderers draw the very same thing.
"""
import re
from pathlib import Path

TOKEN = re.compile(r'#[^\n]*|"[^"]*"|\[|\]|[^\s"\[\]#]+')
# Directives with the number of numbers that follow, or the number of names before parameters.
NUMBERS = {"LookAt": 9, "Translate": 3, "Scale": 3, "Rotate": 4}
LISTS = {"Transform", "ConcatTransform"}
PLAIN = {"Identity", "ReverseOrientation", "WorldBegin", "AttributeBegin", "AttributeEnd"}
NAMES = {
    "NamedMaterial": 1, "Include": 1, "MediumInterface": 2, "CoordSysTransform": 1,
    "CoordinateSystem": 1, "Texture": 3,
}  # fmt: skip


class Directive:
    def __init__(self, name, args, params, span):
        self.name, self.args, self.params, self.span = name, args, params, span

    def get(self, name, default=None):
        """A parameter's values; one alone is given as itself."""
        for (_, key), values in self.params.items():
            if key == name:
                return values[0] if len(values) == 1 else values
        return default

    def kind(self, name):
        return next((kind for kind, key in self.params if key == name), None)


def value(token):
    if token.startswith('"'):
        return token[1:-1]
    if token in ("true", "false"):
        return token == "true"
    return float(token)


def directives(text):
    tokens = [m for m in TOKEN.finditer(text) if not m.group().startswith("#")]
    words = [m.group() for m in tokens]
    at, out = 0, []
    while at < len(words):
        start, name = at, words[at]
        at += 1
        args, params = [], {}
        if name in NUMBERS:
            args = [float(w) for w in words[at : at + NUMBERS[name]]]
            at += NUMBERS[name]
        elif name in LISTS:
            end = words.index("]", at)
            args = [float(w) for w in words[at + 1 : end]]
            at = end + 1
        elif name not in PLAIN:
            count = NAMES.get(name, 1)
            while len(args) < count and at < len(words) and words[at].startswith('"'):
                args.append(words[at][1:-1])
                at += 1
            while name not in ("Include", "NamedMaterial", "MediumInterface") and (
                at < len(words) and words[at].startswith('"')
            ):
                kind, key = words[at][1:-1].split()
                at += 1
                if words[at] == "[":
                    end = words.index("]", at)
                    values = [value(w) for w in words[at + 1 : end]]
                    at = end + 1
                else:
                    values = [value(words[at])]
                    at += 1
                params[kind, key] = values
        out.append(Directive(name, args, params, (tokens[start].start(), tokens[at - 1].end())))
    return out


COATED = ("coateddiffuse", "coatedconductor")
# A coat without absorption, its walk not cut.
THIN = ' "float thickness" 1e-6 "integer maxdepth" 100 '


def variant(source, target, width, height, samples, thin_coats=False):
    """Writes `source` to the folder `target`, the scene's other files linked beside it.

    A box filter, 32-bit values, the integrator "path" of the scene's depth without regularization,
    the independent sampler, no media; coats as `THIN` if asked for.
    """
    source, target = Path(source).resolve(), Path(target)
    target.mkdir(parents=True, exist_ok=True)
    for entry in source.parent.iterdir():
        link = target / entry.name
        if entry != source and not link.exists():
            link.symlink_to(entry)
    text = source.read_text()
    found = directives(text)
    depth, iso = 5, 100
    for d in found:
        if d.name == "Integrator":
            depth = int(d.get("maxdepth", 5))
        elif d.name == "Film":
            iso = d.get("iso", 100)
    dropped = {"Film", "Sampler", "PixelFilter", "Integrator", "MakeNamedMedium", "MediumInterface"}
    for d in reversed(found):
        if d.name in dropped:
            text = text[: d.span[0]] + text[d.span[1] :]
        elif thin_coats and d.name in ("Material", "MakeNamedMaterial"):
            if d.args[0] in COATED or d.get("type") in COATED:
                text = text[: d.span[1]] + THIN + text[d.span[1] :]
    head = (
        f'Film "rgb" "string filename" "{source.stem}.exr" "integer xresolution" {width} '
        f'"integer yresolution" {height} "bool savefp16" false "float iso" {iso}\n'
        f'Sampler "independent" "integer pixelsamples" {samples}\n'
        'PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5\n'
        f'Integrator "path" "integer maxdepth" {depth}\n'
    )
    written = target / f"{source.stem}-variant.pbrt"
    written.write_text(head + text)
    return written
