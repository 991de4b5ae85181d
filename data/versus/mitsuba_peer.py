"""Renders one Mitsuba scene on demand: `python3 mitsuba_peer.py scene.xml llvm_ad_rgb 2`.

Reads lines `SAMPLER SPP SEED FILE` from standard input and answers each with
`done WALL CPU SPP`: seconds of `mi.render` alone, the work synchronised, and the samples per pixel
that the sampler made of the ones asked for. The first answer of a sampler holds the making of its
kernels: ask twice. Many samples are rendered in passes of at most 64, as all samples of a pass are in
memory at once.
"""
import os
import sys
import time
import xml.etree.ElementTree as ElementTree

file, variant, threads = sys.argv[1], sys.argv[2], int(sys.argv[3])
import drjit as dr
import mitsuba as mi

mi.set_variant(variant)
dr.set_thread_count(threads)
# A warning would end in colour codes without a newline, right before an answer.
mi.set_log_level(mi.LogLevel.Error)
PASS = 64


def resolved(path, defaults=None):
    """The file's tree, its includes in place and its defaults put in for their names."""
    defaults = {} if defaults is None else defaults
    root = ElementTree.parse(path).getroot()
    version = root.get("version")

    def resolve(element):
        for child in list(element):
            if child.tag == "default":
                defaults.setdefault(child.get("name"), child.get("value"))
            if child.tag == "include":
                file = fill(child.get("filename"))
                at = list(element).index(child)
                element.remove(child)
                included = resolved(os.path.join(os.path.dirname(path), file), defaults)
                element[at:at] = list(included)
                continue
            for key, text in child.attrib.items():
                child.set(key, fill(text))
            resolve(child)

    def fill(text):
        for name in sorted(defaults, key=len, reverse=True):
            text = text.replace("$" + name, defaults[name])
        return text

    resolve(root)
    root.set("version", version)
    return root


def sensors(path):
    """A function from a sampler's name to the file's sensor with that sampler."""
    root = resolved(path)
    made = {}

    def sensor(name):
        if name not in made:
            element = root.find("sensor")
            if element is None:
                raise SystemExit(f"{path}: the scene has no sensor")
            element.set("version", root.get("version"))
            for sampler in element.findall("sampler"):
                element.remove(sampler)
            sampler = ElementTree.SubElement(element, "sampler", type=name)
            ElementTree.SubElement(sampler, "integer", name="sample_count", value="16")
            made[name] = mi.load_string(ElementTree.tostring(element, encoding="unicode"))
        return made[name]

    return sensor


start = time.perf_counter()
scene = mi.load_file(file)
dr.sync_thread()
sensor_with = sensors(file)
print("ready", mi.__version__, time.perf_counter() - start, flush=True)
for line in sys.stdin:
    name, spp, seed, target = line.split()
    sensor, left, taken, image = sensor_with(name), int(spp), 0, None
    seed, index = int(seed), 0
    wall = cpu = 0.0
    while left > 0:
        begin, used = time.perf_counter(), os.times()
        picture = mi.render(scene, sensor=sensor, spp=min(left, PASS), seed=1000 * seed + index)
        dr.eval(picture)
        dr.sync_thread()
        wall += time.perf_counter() - begin
        now = os.times()
        cpu += now.user + now.system - used.user - used.system
        samples = sensor.sampler().sample_count()
        left, index = left - samples, index + 1
        image = samples * picture if image is None else image + samples * picture
        dr.eval(image)
        taken += samples
    mi.Bitmap(image / taken).convert(
        mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=False
    ).write(target)
    print("done", wall, cpu, taken, flush=True)
