"""Renders a glTF file with Cycles; run by a Python that has bpy: `python3 cycles_render.py job.json`.

The job names file, picture, size, samples, seeds, bounces, camera matrix (glTF's axes, Blender's
camera), field of view over the shorter side and, unless it is dark, an environment in Blender's
layout.
"""
import json
import math
import sys

import bpy
from mathutils import Matrix

job = json.load(open(sys.argv[1]))
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=job["file"])
scene = bpy.context.scene
for material in bpy.data.materials:
    for node in material.node_tree.nodes if material.node_tree else []:
        if node.type == "BSDF_PRINCIPLED":
            node.distribution = "GGX"

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
y_up_to_z_up = Matrix.Rotation(math.pi / 2, 4, "X")
camera.matrix_world = y_up_to_z_up @ Matrix(job["camera"])
width, height = job["size"]
camera.data.sensor_fit = "VERTICAL" if height <= width else "HORIZONTAL"
camera.data.angle = math.radians(job["fov_deg"])
camera.data.clip_start, camera.data.clip_end = 1e-3, 1e5
scene.camera = camera

world = bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
nodes.clear()
background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
background.inputs[0].default_value = (0, 0, 0, 1)
if "environment" in job:
    picture = nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(job["environment"])
    picture.image.colorspace_settings.name = "Linear Rec.709"
    links.new(picture.outputs[0], background.inputs[0])
links.new(background.outputs[0], output.inputs[0])

render, cycles = scene.render, scene.cycles
render.engine = "CYCLES"
render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
render.threads_mode, render.threads = "FIXED", job["threads"]
render.image_settings.file_format = "OPEN_EXR"
render.image_settings.color_depth = "32"
cycles.device, cycles.samples = "CPU", job["samples"]
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.pixel_filter_type = "BOX"
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.light_sampling_threshold = cycles.blur_glossy = 0
cycles.min_light_bounces = cycles.min_transparent_bounces = 64
for kind in ("max", "diffuse", "glossy", "transmission"):
    setattr(cycles, "max_bounces" if kind == "max" else f"{kind}_bounces", job["bounces"])
for seed, path in enumerate(job["pictures"]):
    cycles.seed = seed + 1
    render.filepath = path
    bpy.ops.render.render(write_still=True)
