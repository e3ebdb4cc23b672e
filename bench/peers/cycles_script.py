"""Runs inside Blender: blender -b -P cycles_script.py -- JOB.json"""
import json
import math
import sys
import time

import bpy
from mathutils import Vector


def mesh(name, points, faces, material):
    data = bpy.data.meshes.new(name)
    data.from_pydata(points, [], faces)
    data.materials.append(material)
    made = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(made)
    return made


def box(name, low, high, material):
    points = [[(high if k >> axis & 1 else low)[axis] for axis in range(3)] for k in range(8)]
    return mesh(name, points, [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)], material)


def empty_nodes(owner):
    owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree


def scatter(tree, output):
    """White and isotropic: nothing is absorbed."""
    node = tree.nodes.new("ShaderNodeVolumeScatter")
    node.inputs["Color"].default_value = (1, 1, 1, 1)
    node.inputs["Anisotropy"].default_value = 0
    tree.links.new(node.outputs["Volume"], tree.nodes.new(output).inputs["Volume"])
    return node.inputs["Density"]


def math_node(tree, operation, a, b=None):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, (a, b)):
        if isinstance(value, float):
            socket.default_value = value
        elif value is not None:
            tree.links.new(value, socket)
    return node.outputs[0]


def gaussians(tree, blobs):
    position = tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    total = 0.0
    for center, radius, extinction in blobs:
        distance = tree.nodes.new("ShaderNodeVectorMath")
        distance.operation = "DISTANCE"
        tree.links.new(position, distance.inputs[0])
        distance.inputs[1].default_value = center
        scaled = math_node(tree, "MULTIPLY", distance.outputs["Value"], 1 / radius)
        square = math_node(tree, "MULTIPLY", math_node(tree, "MULTIPLY", scaled, scaled), -1.0)
        blob = math_node(tree, "MULTIPLY", math_node(tree, "EXPONENT", square), float(extinction))
        total = math_node(tree, "ADD", blob, total)
    return total


with open(sys.argv[sys.argv.index("--") + 1]) as file:
    job = json.load(file)
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y = job["size"]
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.threads_mode, scene.render.threads = "FIXED", 2
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = job["samples"]
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.max_bounces = cycles.volume_bounces = 0  # single scattering
cycles.light_sampling_threshold = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01  # the centre of the pixel
cycles.volume_max_steps = 65536

camera = bpy.data.cameras.new("camera")
camera.sensor_fit, camera.angle = "VERTICAL", math.pi / 4
camera.clip_start, camera.clip_end = 1e-4, 1e4
scene.camera = bpy.data.objects.new("camera", camera)
scene.collection.objects.link(scene.camera)

world = scene.world = bpy.data.worlds.new("world")
tree = empty_nodes(world)
if job["extinction"]:
    scatter(tree, "ShaderNodeOutputWorld").default_value = job["extinction"]
    world.cycles.volume_sampling = job["sampling"]

for position, intensity in job["lights"]:
    lamp = bpy.data.lights.new("lamp", "POINT")
    lamp.energy, lamp.shadow_soft_size = 4 * math.pi * intensity, 0
    made = bpy.data.objects.new("lamp", lamp)
    made.location = position
    scene.collection.objects.link(made)

black = bpy.data.materials.new("black")
tree = empty_nodes(black)
node = tree.nodes.new("ShaderNodeBsdfDiffuse")
node.inputs["Color"].default_value = (0, 0, 0, 1)
tree.links.new(node.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
if job["wall"] is not None:
    z = job["wall"]
    wall = mesh("wall", [(-100, -100, z), (100, -100, z), (100, 100, z), (-100, 100, z)], [(0, 1, 2, 3)], black)
    wall.visible_shadow = False
for low, high in job["boxes"]:
    box("box", low, high, black)

if job["gaussians"]:
    cloud = bpy.data.materials.new("cloud")
    tree = empty_nodes(cloud)
    tree.links.new(gaussians(tree, job["gaussians"]), scatter(tree, "ShaderNodeOutputMaterial"))
    cloud.cycles.volume_sampling = job["sampling"]
    low, high = map(Vector, job["bounds"])
    box("cloud", low, high, cloud)
    extent = sum(high - low) / 3
    cloud.cycles.volume_step_rate = job["step"] / (extent / 10)

scene.render.filepath = job["image"]
# Once with one sample and a few pixels, so that loading the kernels is not counted.
scene.render.resolution_percentage, cycles.samples = 10, 1
bpy.ops.render.render()
scene.render.resolution_percentage, cycles.samples = 100, job["samples"]
start, used = time.perf_counter(), time.process_time()
bpy.ops.render.render()
seconds, used = time.perf_counter() - start, time.process_time() - used
bpy.data.images["Render Result"].save_render(job["image"])
with open(job["image"] + ".txt", "w") as file:
    file.write(f"{seconds} {used}\n")
