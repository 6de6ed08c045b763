# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
"""What lies under and shines on scissors: materials, grounds, light. For Blender 3.4 (Cycles); 1 unit is 1 mm."""
import math

import bpy

DRAPES = {"blue": (0.03, 0.13, 0.42), "green": (0.03, 0.24, 0.13), "teal": (0.02, 0.25, 0.27), "red": (0.36, 0.03, 0.03),
          "violet": (0.20, 0.08, 0.33)}
GROUNDS = ["paper", "paper", "cloth", "cloth", "drape", "drape", "drape", "wood", "wood", "light_table", "black", "mat", "tray", "marble"]
LIGHTS = ["softbox", "softbox", "window", "window", "overcast", "lamp", "sun", "sun"]
FINISHES = ["polished", "satin", "satin", "satin", "black"]
HANDLES = ["steel", "steel", "gold", "plastic"]


class Nodes:
    """A material's node tree, built from the surface backwards."""

    def __init__(self, name):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.surface = self.tree.nodes["Principled BSDF"]

    def set(self, **inputs):
        for name, value in inputs.items():
            self.surface.inputs[name.replace("_", " ")].default_value = value
        return self

    def add(self, kind, **values):
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in values.items():
            target = node.inputs.get(name.replace("_", " "))
            if target is None: setattr(node, name, value)
            else: target.default_value = value
        return node

    def link(self, source, target):
        self.tree.links.new(source, target)

    def noise(self, stretch, scale, detail=1.0):
        """Noise in the object's own millimetres, drawn out along an axis by `stretch`."""
        mapping = self.add("Mapping")
        mapping.inputs["Scale"].default_value = stretch
        self.link(self.add("TexCoord").outputs["Object"], mapping.inputs["Vector"])
        noise = self.add("TexNoise", Scale=scale, Detail=detail)
        self.link(mapping.outputs["Vector"], noise.inputs["Vector"])
        return noise.outputs["Fac"]

    def bump(self, height, distance, strength=1.0):
        node = self.add("Bump", Distance=distance, Strength=strength)
        self.link(height, node.inputs["Height"])
        before = self.surface.inputs["Normal"].links
        if before: self.link(before[0].from_socket, node.inputs["Normal"])
        self.link(node.outputs["Normal"], self.surface.inputs["Normal"])
        return self

    def colours(self, value, *stops):
        """The base colour from a value in [0, 1]: (place, linear rgb) of each stop."""
        ramp = self.add("ValToRGB")
        elements = ramp.color_ramp.elements
        while len(elements) < len(stops): elements.new(0.5)
        for element, (place, rgb) in zip(elements, stops): element.position, element.color = place, (*rgb, 1)
        self.link(value, ramp.inputs["Fac"])
        self.link(ramp.outputs["Color"], self.surface.inputs["Base Color"])
        return self


def grey(value):
    return (value, value, value)


def metal(random, finish):
    """Brushed along the blade, but for black coatings."""
    rough = {"polished": 0.16, "satin": random.uniform(0.22, 0.4), "black": 0.45}[finish]
    tone = 0.045 if finish == "black" else random.uniform(0.5, 0.62)
    nodes = Nodes(finish).set(Base_Color=(*grey(tone), 1), Metallic=1.0, Roughness=rough)
    along = random.uniform(0.02, 0.1)
    return nodes.bump(nodes.noise((along, 1, 1), random.uniform(2, 5)), 0.01 if finish == "polished" else 0.03).material


def handle(name):
    if name == "gold": return Nodes(name).set(Base_Color=(0.80, 0.52, 0.16, 1), Metallic=1.0, Roughness=0.22).material
    return Nodes(name).set(Base_Color=(0.012, 0.012, 0.014, 1), Roughness=0.35).material


def ground(random, kind, drape):
    """The material of the ground."""
    nodes = Nodes(kind).set(Roughness=0.9)
    nodes.surface.inputs["Specular"].default_value = 0.1
    if kind == "paper": nodes.set(Base_Color=(*grey(random.uniform(0.7, 0.85)), 1)).bump(nodes.noise((1, 1, 1), 3), 0.02)
    elif kind in ("cloth", "drape"):
        rgb = DRAPES[drape] if kind == "drape" else grey(random.uniform(0.15, 0.75))
        weave = random.uniform(1.5, 4)
        nodes.colours(nodes.noise((1, 1, 1), weave), (0.3, [0.75 * c for c in rgb]), (0.7, rgb))
        nodes.bump(nodes.noise((1, 1, 1), weave), 0.15).bump(nodes.noise((1, 0.5, 1), 0.02, 1), random.uniform(0, 14))
    elif kind == "wood":
        dark, light = random.choice([((0.10, 0.045, 0.02), (0.22, 0.11, 0.05)), ((0.35, 0.2, 0.1), (0.55, 0.36, 0.2))])
        nodes.set(Roughness=0.45).colours(nodes.noise((0.05, 1, 1), random.uniform(0.1, 0.4), 5), (0.35, dark), (0.65, light))
    elif kind == "light_table": nodes.set(Base_Color=(*grey(0.8), 1), Emission=(1, 1, 1, 1), Emission_Strength=random.uniform(0.7, 1.2))
    elif kind == "black": nodes.set(Base_Color=(*grey(0.012), 1)).bump(nodes.noise((1, 1, 1), 3), 0.1)
    elif kind == "mat":
        lines = nodes.add("TexBrick", offset=0.0, Scale=0.1, Mortar_Size=0.012, Brick_Width=1.0, Row_Height=1.0,
                          Color1=(0.02, 0.16, 0.10, 1), Color2=(0.02, 0.16, 0.10, 1), Mortar=(0.55, 0.6, 0.4, 1))
        nodes.link(nodes.add("TexCoord").outputs["Object"], lines.inputs["Vector"])
        nodes.link(lines.outputs["Color"], nodes.surface.inputs["Base Color"])
        nodes.bump(nodes.noise((1, 1, 1), 4), 0.05)
    elif kind == "tray":
        nodes.set(Base_Color=(*grey(0.55), 1), Metallic=1.0, Roughness=random.uniform(0.3, 0.5)).bump(nodes.noise((0.05, 1, 1), 2), 0.04)
    else: nodes.set(Roughness=0.25).colours(nodes.noise((1, 1, 1), 0.06, 6), (0.35, grey(0.25)), (0.5, grey(0.65)), (0.8, grey(0.75)))
    return nodes.material


def add_light(kind, place, power, **sizes):
    """A light at `place` that faces the origin."""
    data = bpy.data.lights.new(kind, kind)
    data.energy = power
    for name, value in sizes.items(): setattr(data, name, value)
    thing = bpy.data.objects.new(kind, data)
    thing.location = place
    thing.rotation_mode = "QUATERNION"
    thing.rotation_quaternion = (-thing.location).to_track_quat("-Z", "Y")
    bpy.context.collection.objects.link(thing)


def light(random, kind):
    """Lights of that kind from somewhere, and a room that metal mirrors: a world of soft brighter and darker parts."""
    azimuth, height = random.uniform(0, 2 * math.pi), math.radians(random.uniform(30, 65))
    towards = (math.cos(azimuth) * math.cos(height), math.sin(azimuth) * math.cos(height), math.sin(height))
    at = lambda distance: tuple(distance * c for c in towards)
    if kind == "softbox": add_light("AREA", at(900), 6e6, size=600)
    elif kind == "window": add_light("AREA", at(1800), 2.4e7, size=900)
    elif kind == "lamp": add_light("AREA", at(700), 4e6, size=90)
    elif kind == "sun": add_light("SUN", at(1000), 3.0, angle=math.radians(0.53))
    ambient = {"softbox": 0.25, "window": 0.15, "overcast": 1.0, "lamp": 0.15, "sun": 0.22}[kind]
    world = bpy.context.scene.world or bpy.data.worlds.new("room")
    bpy.context.scene.world = world
    world.use_nodes = True
    world.cycles.sampling_method, world.cycles.sample_map_resolution = "MANUAL", 128  # nothing in it is small
    tree = world.node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.noise_dimensions = "4D"
    noise.inputs["W"].default_value = random.uniform(0, 100)
    noise.inputs["Scale"].default_value, noise.inputs["Detail"].default_value = 1.3, 0
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0.4, (*grey(0.25), 1)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.62, (*grey(1.6), 1)
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], noise.inputs["Vector"])
    tree.links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
    tree.links.new(ramp.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    tree.nodes["Background"].inputs["Strength"].default_value = ambient
