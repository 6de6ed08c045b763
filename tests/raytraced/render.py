# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
"""Renders scissors by Blender's path tracer, with exact truth: pictures that share nothing with vision/render.

usage: blender --background --factory-startup --python tests/raytraced/render.py -- FOLDER [--seed S] [--first N] [--count K]

Writes FOLDER/NNN.jpg and NNN.truth.json (schema scissors-heldout/1) of scenes N to N + K - 1; the same seed gives the same
scenes, whatever else is rendered. About a minute a picture and core. `bladecurve validate --photographs FOLDER` measures them.
Needs Blender 3.4 and python3-opencv (markers, JPEG).
"""
import argparse
import json
import math
import os
import random as randoms
import sys

import bpy
import cv2
import mathutils
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import surroundings
from scissors import Scissors


class Camera:
    """A pinhole that looks at the world's origin. Pixels: the centre of the top-left one is (0, 0)."""

    def __init__(self, random, mm_per_px, size):
        self.size, self.mm_per_px = size, mm_per_px  # mm_per_px: on the ground at the origin
        distance = random.uniform(350, 700)
        self.focal_px = distance / mm_per_px
        tilt = math.radians(random.choice([0, random.uniform(0, 4), random.uniform(4, 11)]))
        azimuth, roll = random.uniform(0, 2 * math.pi), random.uniform(0, 2 * math.pi)
        back = np.array([math.sin(tilt) * math.cos(azimuth), math.sin(tilt) * math.sin(azimuth), math.cos(tilt)])
        right = np.cross([-math.sin(roll), math.cos(roll), 0], back)
        right /= np.linalg.norm(right)
        self.rotation = np.array([right, -np.cross(back, right), -back])  # world to camera: x right, y down, z ahead
        self.centre = distance * back
        self.k = np.array([[self.focal_px, 0, (size[0] - 1) / 2], [0, self.focal_px, (size[1] - 1) / 2], [0, 0, 1]])

    def project(self, points):
        p = (np.atleast_2d(points) - self.centre) @ self.rotation.T @ self.k.T
        return p[:, :2] / p[:, 2:]

    def place(self):
        data = bpy.data.cameras.new("camera")
        data.sensor_fit, data.sensor_width = "HORIZONTAL", 36
        data.lens = 36 * self.focal_px / self.size[0]
        data.clip_end = 1e5
        thing = bpy.data.objects.new("camera", data)
        bpy.context.collection.objects.link(thing)
        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation.T @ np.diag([1, -1, -1])  # Blender's cameras look along -z, y up
        matrix[:3, 3] = self.centre
        thing.matrix_world = mathutils.Matrix(matrix.tolist())
        bpy.context.scene.camera = thing


class Pose:
    """The scissors' frame in the world: turned about z by heading, then moved."""

    def __init__(self, heading, pivot):
        self.axis = np.array([math.cos(heading), math.sin(heading)])
        self.pivot = pivot

    def world(self, points, z):
        p = np.atleast_2d(points)
        x, y = p[:, :1], p[:, 1:2]
        return np.hstack([self.pivot + x * self.axis + y * np.array([-self.axis[1], self.axis[0]]), np.full((len(p), 1), z)])


def add_mesh(name, vertices, faces, materials, face_material=lambda centre: 0):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices], [], [tuple(f) for f in faces])
    for material in materials: mesh.materials.append(material)
    for polygon in mesh.polygons: polygon.material_index = face_material(polygon.center)
    mesh.validate()
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def apply_last(thing):
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.modifier_apply(modifier=thing.modifiers[-1].name)


def add_screw(shape, z, steel, turn):
    """A chamfered head with a slot, or a dome. Returns it and the height of its rim."""
    radius, height = shape.screw_radius, shape.screw_height
    if not shape.slot:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=1, location=(0, 0, z))
        head = bpy.context.object
        head.scale = (radius, radius, height)
        bpy.ops.object.shade_smooth()
    else:
        bpy.ops.mesh.primitive_cylinder_add(vertices=96, radius=radius, depth=height + 0.6, location=(0, 0, z + (height - 0.6) / 2))
        head = bpy.context.object
        bevel = head.modifiers.new("chamfer", "BEVEL")
        bevel.width, bevel.segments = min(0.18, 0.4 * height), 2
        apply_last(head)
        bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, z + height), rotation=(0, 0, turn))
        blade = bpy.context.object
        blade.scale = (3 * radius, 0.28 * radius, min(1.0, height + 0.4))
        cut = head.modifiers.new("slot", "BOOLEAN")
        cut.object, cut.operation = blade, "DIFFERENCE"
        apply_last(head)
        bpy.data.objects.remove(blade)
    head.data.materials.clear()
    head.data.materials.append(steel)
    return head, z + (height if shape.slot else 0)


def add_scissors(random, shape, pose):
    """The two members, their rings and the screw, in the world; which member is on top is drawn. Returns the height of the screw's rim."""
    steel = surroundings.metal(random, random.choice(surroundings.FINISHES))
    colour = random.choice(surroundings.HANDLES)
    grip = steel if colour == "steel" else surroundings.handle(colour)
    upper_on_top = random.random() < 0.5
    things = []
    for sign in (1, -1):
        on_top = (sign > 0) == upper_on_top
        vertices, faces = shape.solid(sign, on_top)
        if sign * (1 if on_top else -1) < 0: faces = [f[::-1] for f in faces]
        is_handle = lambda centre: int(math.hypot(centre[0], centre[1]) > shape.handle_from and centre[0] < 0)
        things.append(add_mesh("member", vertices, faces, [steel, grip], is_handle))
        bpy.ops.mesh.primitive_torus_add(major_radius=shape.ring, minor_radius=0.42 * shape.shank, major_segments=96, minor_segments=24,
                                         location=(*shape.ring_centre(sign), shape.edge_height))
        ring = bpy.context.object
        bpy.ops.object.shade_smooth()
        ring.data.materials.append(grip)
        things.append(ring)
    head, rim = add_screw(shape, shape.edge_height + shape.thickness, steel, random.uniform(0, math.pi))
    for thing in things + [head]:
        thing.rotation_euler[2] += math.atan2(pose.axis[1], pose.axis[0])
        x, y, z = thing.location
        thing.location = pose.world([[x, y]], z)[0]
    return rim


def marker_image(number):
    """One pixel a module, the black border included, and one of white paper round it; bottom row first, as Blender has it."""
    bits = cv2.aruco.drawMarker(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50), number, 6)
    bits = np.pad(bits, 1, constant_values=255)[::-1] / 255.0
    image = bpy.data.images.new("marker", 8, 8, float_buffer=True)
    image.pixels = np.dstack([0.03 + 0.77 * bits] * 3 + [np.ones_like(bits)]).ravel().tolist()
    return image


def add_marker(number, size, centre, angle):
    """Its truth: corners in the world, clockwise from its own top left as seen."""
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    square = np.array([[-1, 1], [1, 1], [1, -1], [-1, -1]]) * size / 2
    paper = centre + square * 8 / 6 @ turn.T
    nodes = surroundings.Nodes("marker").set(Roughness=0.9)
    texture = nodes.add("TexImage", image=marker_image(number), interpolation="Closest")
    nodes.link(texture.outputs["Color"], nodes.surface.inputs["Base Color"])
    thing = add_mesh("marker", [(*p, 0.05) for p in paper], [(3, 2, 1, 0)], [nodes.material])
    layer = thing.data.uv_layers.new()
    for corner, uv in zip(layer.data, [(0, 0), (1, 0), (1, 1), (0, 1)]): corner.uv = uv
    return np.column_stack([centre + square @ turn.T, np.full(4, 0.05)])


def add_markers(random, camera, silhouette):
    """One to four on the free ground."""
    size, count, placed = random.choice([25, 50]), random.choice([1, 2, 4, 4]), []
    half = max(camera.size) * camera.mm_per_px / 2
    for _ in range(400):
        if len(placed) == count: break
        centre = np.array([random.uniform(-half, half), random.uniform(-half, half)])
        angle = random.uniform(0, 2 * math.pi)
        reach = 0.95 * size
        px = camera.project([[*(centre + reach * np.array(d)), 0] for d in ((1, 0), (-1, 0), (0, 1), (0, -1))])
        if (px < 0).any() or (px >= camera.size).any(): continue
        if np.linalg.norm(silhouette - centre, axis=1).min() < reach + 2: continue
        if any(np.linalg.norm(centre - other) < 1.5 * size for other, _ in placed): continue
        placed.append((centre, angle))
    return size, [(n, add_marker(n, size, *place)) for n, place in enumerate(placed)]


def develop(random, path, linear):
    """A JPEG as a camera makes it of linear light: exposure, noise, the curve of sRGB, compression."""
    exposure = random.uniform(0.6, 1.0) / np.percentile(linear, random.uniform(96, 99.5))
    lit = cv2.GaussianBlur(linear * exposure, (0, 0), random.uniform(0.3, 0.9))
    srgb = np.where(lit <= 0.0031308, 12.92 * lit, 1.055 * np.maximum(lit, 0.0031308) ** (1 / 2.4) - 0.055)
    noise = np.random.default_rng(random.getrandbits(32)).normal(0, random.uniform(0.5, 2.5), srgb.shape)
    quality = random.randint(82, 96)
    cv2.imwrite(path, np.clip(np.rint(255 * srgb + noise), 0, 255).astype(np.uint8), [cv2.IMWRITE_JPEG_QUALITY, quality])


def render_linear(size, samples, scratch):
    """Linear light, BGR, top row first."""
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.device, scene.cycles.samples = "CYCLES", "CPU", samples
    scene.cycles.max_bounces, scene.cycles.use_denoising = 3, False
    scene.cycles.use_adaptive_sampling, scene.cycles.adaptive_threshold, scene.cycles.adaptive_min_samples = True, 0.04, 6
    scene.cycles.sample_clamp_indirect = 4
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = *size, 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = scratch
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scratch)
    pixels = np.empty(size[0] * size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    os.remove(scratch)
    return pixels.reshape(size[1], size[0], 4)[::-1, :, 2::-1].astype(np.float64)


def edge_truth(shape, pose, camera, sign):
    blade = shape.edge(sign)
    scissors = shape.placed(blade, sign)
    px = camera.project(pose.world(scissors, shape.edge_height))
    return {"z_world_mm": shape.edge_height, "bernstein_mm": shape.bernstein(sign).tolist(), "u_range_mm": [shape.heel, shape.length],
            "free_u_range_mm": [shape.free_from() if sign > 0 else shape.heel, shape.length], "end_px": px[-1].tolist(),
            "blade_mm": blade.tolist(), "scissors_mm": scissors.tolist(), "px": px.tolist()}


def truth(shape, pose, camera, rim, markers, size, tags):
    at = lambda x, z: camera.project(pose.world([[x, 0]], z))[0]
    ahead = at(0.5, shape.edge_height) - at(-0.5, shape.edge_height)
    corners = [(n, camera.project(c)) for n, c in markers]
    scale = 1 / float(np.linalg.norm(ahead))
    return {
        "schema": "scissors-heldout/1", "expect": "ok", "tags": tags,
        "image": {"width": camera.size[0], "height": camera.size[1]}, "units": "mm, degrees",
        "theta_deg": math.degrees(shape.theta),
        "pivot": {"px": at(0, shape.edge_height).tolist(), "screw_top_center_px": at(0, rim).tolist()},
        "symmetry_axis": {"dir_px": (ahead * scale).tolist()},
        "scale": {"known_mm_per_px": None if markers else scale, "mm_per_px_edge_plane": {"at_pivot_along_axis": scale}},
        "camera": {"type": "persp", "K": camera.k.tolist(), "R_world_to_cam": camera.rotation.tolist(),
                   "t_world_to_cam": (-camera.rotation @ camera.centre).tolist(), "distortion": {"k1": 0.0}},
        "marker": {"dictionary": "DICT_4X4_50", "size_mm": size, "plane_z_world_mm": 0.05,
                   "markers": [{"id": n, "size_mm": size, "corners_px": c.tolist()} for n, c in corners]} if markers else None,
        "edge_upper": edge_truth(shape, pose, camera, 1), "edge_lower": edge_truth(shape, pose, camera, -1)}


def view_of(random, shape):
    """A camera and the scissors' pose: blades and pivot within the picture, handles often not."""
    while True:
        size = random.choice([(1600, 1200), (1600, 1200), (2000, 1500)])
        mm_per_px = shape.length / (random.uniform(0.33, 0.58) * size[1])
        heading, ahead = random.uniform(0, 2 * math.pi), random.uniform(-0.1, 0.3) * shape.length
        middle = random.uniform(-0.04, 0.04) * size[0] * mm_per_px
        pose = Pose(heading, middle - ahead * np.array([math.cos(heading), math.sin(heading)]))
        camera = Camera(random, mm_per_px, size)
        outlines = [shape.placed(shape.outline(sign)[0], sign) for sign in (1, -1)]
        blades = camera.project(pose.world(np.vstack([o[o[:, 0] > -shape.joint] for o in outlines]), shape.edge_height))
        margin = 0.02 * size[1]
        if (blades > margin).all() and (blades < np.array(size) - margin).all(): return camera, pose


def render_scene(seed, number, folder, samples):
    random = randoms.Random(seed * 1000003 + number)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    shape = Scissors.drawn(random)
    camera, pose = view_of(random, shape)
    kind, lit, drape = random.choice(surroundings.GROUNDS), random.choice(surroundings.LIGHTS), random.choice(sorted(surroundings.DRAPES))
    if kind == "light_table": lit = "overcast"
    surroundings.light(random, lit)
    rim = add_scissors(random, shape, pose)
    bpy.ops.mesh.primitive_plane_add(size=4000, rotation=(0, 0, random.uniform(0, math.pi)))
    bpy.context.object.data.materials.append(surroundings.ground(random, kind, drape))
    size_mm, markers = 0, []
    if random.random() < 0.6 and kind != "light_table":
        size_mm, markers = add_markers(random, camera, pose.world(shape.silhouette(), 0)[:, :2])
    camera.place()
    stem = os.path.join(folder, f"{number:03d}")
    develop(random, stem + ".jpg", render_linear(camera.size, samples, stem + ".exr"))
    with open(stem + ".truth.json", "w") as file:
        json.dump(truth(shape, pose, camera, rim, markers, size_mm, [kind, lit]), file)


def main():
    parser = argparse.ArgumentParser(prog="render.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--samples", type=int, default=24, help="rays a pixel")
    asked = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    os.makedirs(asked.folder, exist_ok=True)
    for number in range(asked.first, asked.first + asked.count):
        render_scene(asked.seed, number, asked.folder, asked.samples)


main()
