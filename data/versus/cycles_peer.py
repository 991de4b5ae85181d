"""Renders one scene with Cycles on demand: `python3 cycles_peer.py scene.xml THREADS [DEVICE]`.

DEVICE is CPU or what Cycles calls an interface of GPUs (CUDA, OPTIX, HIP, ONEAPI, METAL), of which all are used.

Builds what the Mitsuba file says: spheres (256 x 128 smooth quadrilaterals), rectangles, cubes, PLY
meshes; `diffuse`, `roughconductor`, `dielectric`, `roughdielectric`; `area`, `constant`, `envmap`.
Anything else stops it. y up becomes z up.

Reads lines `PATTERN SPP SEED FILE` and answers `done WALL CPU SPP`: seconds of the render call
alone, the picture written afterwards. Data persist between calls, so that but for the first call
neither the scene's transfer nor its acceleration structure is in them.
"""
import math
import os
import sys
import time
import xml.etree.ElementTree as ElementTree

import bpy
import numpy as np
from mathutils import Matrix, Vector

TO_Z_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
path, threads = os.path.abspath(sys.argv[1]), int(sys.argv[2])
device = sys.argv[3] if len(sys.argv) > 3 else "CPU"


def value(element, name, default=None):
    for child in element:
        if child.get("name") == name:
            return child.get("value")
    return default


def numbers(text):
    found = [float(x) for x in text.replace(",", " ").split()]
    return found * 3 if len(found) == 1 else found


def colour(element, name):
    return (*numbers(value(element, name)), 1.0)


def transform(element):
    matrix = Matrix.Identity(4)
    for step in element if element is not None else ():
        axes = [step.get(a) for a in "xyz"]
        if step.tag == "scale":
            one = step.get("value", "1")
            local = Matrix.Diagonal([float(a or one) for a in axes] + [1.0])
        elif step.tag == "translate":
            local = Matrix.Translation([float(a or 0) for a in axes])
        elif step.tag == "rotate":
            axis = Vector([float(a or 0) for a in axes])
            local = Matrix.Rotation(math.radians(float(step.get("angle"))), 4, axis)
        elif step.tag == "lookat":
            origin, target, up = (Vector(numbers(step.get(k))) for k in ("origin", "target", "up"))
            forward = (target - origin).normalized()
            left = up.cross(forward).normalized()
            columns = (left, forward.cross(left), forward, origin)
            local = Matrix([[c[i] for c in columns] for i in range(3)] + [[0, 0, 0, 1]])
        else:
            raise SystemExit(f"transform {step.tag} is not known")
        matrix = local @ matrix
    return matrix


def shader(nodes, links, bsdf):
    """The closure of a BSDF, widths as GGX's alpha."""
    kind = bsdf.get("type")
    if kind == "diffuse":
        node = nodes.new("ShaderNodeBsdfDiffuse")
        node.inputs["Color"].default_value = colour(bsdf, "reflectance")
    elif kind in ("dielectric", "roughdielectric"):
        node = nodes.new("ShaderNodeBsdfGlass")
        node.distribution = "GGX"
        node.inputs["Color"].default_value = (1, 1, 1, 1)
        node.inputs["Roughness"].default_value = math.sqrt(float(value(bsdf, "alpha", "0")))
        node.inputs["IOR"].default_value = float(value(bsdf, "int_ior"))
    elif kind == "roughconductor":
        node = nodes.new("ShaderNodeBsdfMetallic")
        node.distribution, node.fresnel_type = "GGX", "PHYSICAL_CONDUCTOR"
        node.inputs["IOR"].default_value = numbers(value(bsdf, "eta"))
        node.inputs["Extinction"].default_value = numbers(value(bsdf, "k"))
        along = float(value(bsdf, "alpha_u", value(bsdf, "alpha")))
        across = float(value(bsdf, "alpha_v", value(bsdf, "alpha")))
        node.inputs["Roughness"].default_value = (along * across) ** 0.25
        if along != across:
            # Cycles: alpha_x / alpha_y = 1 / (1 - 0.9 anisotropy), x along the tangent.
            ratio = min(along, across) / max(along, across)
            node.inputs["Anisotropy"].default_value = (1 - ratio) / 0.9
            node.inputs["Rotation"].default_value = 0.0 if along > across else 0.25
            tangent = nodes.new("ShaderNodeTangent")
            tangent.direction_type, tangent.axis = "RADIAL", "Z"
            links.new(tangent.outputs[0], node.inputs["Tangent"])
    else:
        raise SystemExit(f"bsdf {kind} is not known")
    return node


def material(bsdf, emitter):
    made = bpy.data.materials.new("material")
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if emitter is None:
        links.new(shader(nodes, links, bsdf).outputs[0], output.inputs["Surface"])
        return made
    emission, geometry = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeNewGeometry")
    emission.inputs["Color"].default_value = colour(emitter, "radiance")
    front = nodes.new("ShaderNodeMath")
    front.operation = "SUBTRACT"
    front.inputs[0].default_value = 1.0
    links.new(geometry.outputs["Backfacing"], front.inputs[1])
    links.new(front.outputs[0], emission.inputs["Strength"])
    links.new(emission.outputs[0], output.inputs["Surface"])
    made.cycles.emission_sampling = "FRONT"
    return made


def ply(name):
    """Vertices and triangles of a binary PLY of floats and `uchar int` lists."""
    with open(name, "rb") as file:
        counts = {}
        while (line := file.readline().decode().split()) != ["end_header"]:
            if line[0] == "element":
                counts[line[1]] = int(line[2])
        vertices = np.fromfile(file, "<f4", 3 * counts["vertex"]).reshape(-1, 3)
        faces = np.fromfile(file, [("n", "u1"), ("v", "<i4", 3)], counts["face"])["v"]
    return vertices, faces


def mesh(shape):
    kind = shape.get("type")
    if kind == "sphere":
        centre = [c for c in shape if c.get("name") == "center"]
        local = Matrix.Scale(float(value(shape, "radius", "1")), 4)
        if centre:
            at = Vector([float(centre[0].get(a)) for a in "xyz"])
            local = Matrix.Translation(at) @ local
        bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128)
        bpy.ops.object.shade_smooth()
    elif kind == "rectangle":
        local = Matrix.Identity(4)
        bpy.ops.mesh.primitive_plane_add(size=2)
    elif kind == "cube":
        local = Matrix.Identity(4)
        bpy.ops.mesh.primitive_cube_add(size=2)
    elif kind == "ply":
        local = Matrix.Identity(4)
        vertices, faces = ply(os.path.join(os.path.dirname(path), value(shape, "filename")))
        made = bpy.data.meshes.new("ply")
        made.vertices.add(len(vertices))
        made.vertices.foreach_set("co", vertices.ravel())
        made.loops.add(3 * len(faces))
        made.loops.foreach_set("vertex_index", faces.ravel())
        made.polygons.add(len(faces))
        made.polygons.foreach_set("loop_start", np.arange(0, 3 * len(faces), 3, dtype=np.int32))
        made.update(calc_edges=True)
        made.shade_flat()
        thing = bpy.data.objects.new("ply", made)
        bpy.context.scene.collection.objects.link(thing)
        return thing, local
    else:
        raise SystemExit(f"shape {kind} is not known")
    return bpy.context.object, local


def world(scene, emitter):
    made = bpy.data.worlds.new("world")
    scene.world = made
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    links.new(background.outputs[0], output.inputs[0])
    background.inputs[0].default_value = (0, 0, 0, 1)
    if emitter is not None and emitter.get("type") == "constant":
        background.inputs[0].default_value = colour(emitter, "radiance")
    elif emitter is not None:
        picture, where = nodes.new("ShaderNodeTexEnvironment"), nodes.new("ShaderNodeTexCoord")
        turn = nodes.new("ShaderNodeMapping")
        turn.inputs["Rotation"].default_value = (0, 0, math.pi / 2)
        links.new(where.outputs["Generated"], turn.inputs[0])
        links.new(turn.outputs[0], picture.inputs[0])
        file = os.path.join(os.path.dirname(path), value(emitter, "filename"))
        picture.image = bpy.data.images.load(file)
        picture.image.colorspace_settings.name = "Linear Rec.709"
        links.new(picture.outputs[0], background.inputs[0])


def camera(scene, sensor):
    made = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(made)
    # Mitsuba looks along +z with x to the left, Blender along -z with x to the right.
    turn = Matrix.Diagonal((-1, 1, -1, 1))
    made.matrix_world = TO_Z_UP @ transform(sensor.find("transform")) @ turn
    made.data.sensor_fit = "HORIZONTAL"
    made.data.angle = math.radians(float(value(sensor, "fov")))
    made.data.clip_start, made.data.clip_end = 1e-3, 1e5
    scene.camera = made
    film = sensor.find("film")
    render = scene.render
    render.resolution_x = int(value(film, "width"))
    render.resolution_y = int(value(film, "height"))
    render.resolution_percentage = 100


def use_gpus(cycles):
    """Renders on all GPUs of the interface, and on nothing else."""
    preferences = bpy.context.preferences.addons["cycles"].preferences
    known = [name for name, *_ in preferences.get_device_types(bpy.context)]
    if device not in known:
        raise SystemExit(f"this Cycles has no {device}, but {', '.join(known)}")
    preferences.compute_device_type = device
    preferences.refresh_devices()
    gpus = [found for found in preferences.devices if found.type == device]
    if not gpus:
        raise SystemExit(f"Cycles finds no GPU for {device}")
    for found in preferences.devices:
        found.use = found.type == device
    cycles.device = "GPU"


def settings(scene, bounces):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.threads_mode, render.threads = "FIXED", threads
    render.use_persistent_data = True
    render.use_compositing = render.use_sequencer = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    cycles.device = "CPU"
    if device != "CPU":
        use_gpus(cycles)
    cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.max_bounces = bounces
    for kind in ("diffuse", "glossy", "transmission", "transparent_max"):
        setattr(cycles, f"{kind}_bounces", bounces)


def build():
    root = ElementTree.parse(path).getroot()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    named = {bsdf.get("id"): bsdf for bsdf in root.findall("bsdf")}
    for shape in root.findall("shape"):
        thing, local = mesh(shape)
        place = transform(shape.find("transform")) @ local
        thing.matrix_world = TO_Z_UP @ place
        reference = shape.find("ref")
        bsdf = shape.find("bsdf") if reference is None else named[reference.get("id")]
        thing.data.materials.clear()
        thing.data.materials.append(material(bsdf, shape.find("emitter")))
    world(scene, root.find("emitter"))
    camera(scene, root.find("sensor"))
    # Mitsuba counts the light among a path's vertices and the camera's edge among its length.
    settings(scene, int(value(root.find("integrator"), "max_depth")) - 2)
    return scene


start = time.perf_counter()
scene = build()
print("ready", bpy.app.version_string.replace(" ", "-"), time.perf_counter() - start, flush=True)
for line in sys.stdin:
    pattern, spp, seed, target = line.split()
    pattern, *adaptive = pattern.split(",")
    scene.cycles.sampling_pattern = pattern
    # Its threshold follows the number of samples.
    scene.cycles.use_adaptive_sampling = bool(adaptive)
    scene.cycles.adaptive_threshold = 0
    scene.cycles.samples, scene.cycles.seed = int(spp), int(seed)
    scene.update_tag()
    begin, used = time.perf_counter(), os.times()
    bpy.ops.render.render()
    wall, now = time.perf_counter() - begin, os.times()
    cpu = now.user + now.system - used.user - used.system
    bpy.data.images["Render Result"].save_render(os.path.abspath(target))
    print("done", wall, cpu, int(spp), flush=True)
