# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
"""Scissors as solids, and what is true of them. mm and radians; needs numpy alone.

Each blade has its own frame, as physics has it: origin at the pivot, +u to its distal end, +v to its back. The lower blade's
is mirrored (v down). World: z up, the ground at z = 0, both cutting edges in the plane z = edge_height.
"""
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Scissors:
    length: float  # pivot to distal end
    heel: float  # where the ground edge begins
    inclination: float  # slope of the edge's chord against the ray from the pivot to the distal end
    bow: float  # how far the middle of the edge lies above its chord
    curve: float  # both blades bend to one side by that much
    width: float  # of a blade at the pivot
    tip_radius: float
    bevel: float  # width of the ground band along the edge
    thickness: float
    joint: float  # how far the wide part reaches behind the pivot
    shank: float  # its width
    shank_length: float  # pivot to the middle of the ring
    ring: float  # radius of a ring
    screw_radius: float
    screw_height: float  # of its head over the upper member
    slot: bool  # else a domed rivet
    handle_from: float  # behind the pivot: from there on the handle's colour
    lift: float  # of the lower member over the ground: rings and shanks carry the blades
    theta: float = 0.4
    edge_height: float = field(init=False)

    def __post_init__(self):
        self.edge_height = self.thickness + self.lift

    @staticmethod
    def drawn(random):
        """A pair of the shapes that surgeons and seamstresses use, iris to large Mayo."""
        length = random.uniform(32, 85)
        stout = random.uniform(0.8, 1.25)
        width = stout * (3.5 + 0.085 * length)
        heel, thickness = width * random.uniform(0.6, 1.3), stout * random.uniform(1.4, 2.4)
        household = random.random() < 0.15
        return Scissors(
            length=length, heel=heel, inclination=random.uniform(0.36, 0.56) * width / (length - heel),
            bow=random.uniform(0.1, 0.02 * length), curve=random.choice([0, 0, 0, random.uniform(0.02, 0.08) * length]),
            width=width, tip_radius=random.choice([0.3, 0.6, 1.0, 1.4]) * stout, bevel=thickness * random.uniform(0.7, 1.3),
            thickness=thickness, joint=width * random.uniform(0.8, 1.3), shank=width * random.uniform(0.42, 0.6),
            shank_length=random.uniform(70, 105), ring=random.uniform(15, 22) if household else random.uniform(10, 14),
            screw_radius=width * random.uniform(0.24, 0.36), screw_height=random.uniform(0.1, 1.0), slot=random.random() < 0.75,
            handle_from=random.choice([1e3, 1e3, random.uniform(15, 60)]), lift=random.uniform(0.3, 2.5),
            theta=np.radians(random.uniform(9, 55)))

    def bernstein(self, sign):
        """The edge v = s(u) of the upper (+1) or the lower (-1) blade as one cubic from the heel to the distal end."""
        chord = -self.inclination * (self.length - self.heel)
        raised = 4 / 3 * (self.bow + sign * self.curve)  # a cubic's middle moves by 3/4 of its inner coefficients
        return np.array([chord, chord * 2 / 3 + raised, chord / 3 + raised, 0])

    def edge(self, sign, count=401):
        u = np.linspace(self.heel, self.length, count)
        t = (u - self.heel) / (self.length - self.heel)
        c = self.bernstein(sign)
        v = c[0] * (1 - t) ** 3 + 3 * c[1] * t * (1 - t) ** 2 + 3 * c[2] * t**2 * (1 - t) + c[3] * t**3
        return np.column_stack([u, v])

    def placed(self, points, sign):
        """From a blade's frame to that of the scissors: x along the axis to the tips, y to the upper blade."""
        c, s = np.cos(self.theta / 2), np.sin(self.theta / 2)
        u, v = points[:, 0], points[:, 1]
        return np.column_stack([c * u - s * v, sign * (s * u + c * v)])

    def free_from(self):
        """u of the upper edge from which on nothing of the lower blade lies under it."""
        blade = self.edge(1)
        upper, lower = self.placed(blade, 1), self.placed(self.edge(-1), -1)
        covered = np.flatnonzero(upper[:, 1] <= np.interp(upper[:, 0], lower[:, 0], lower[:, 1]))
        return float(blade[covered[-1] + 1 if len(covered) else 0, 0])

    def outline(self, sign):
        """Points round one member, counter-clockwise in its frame, and which of them lie on the cutting edge."""
        edge = self.edge(sign, 121)
        back_end = np.array([self.heel * 0.5, self.width * 0.5])
        tip = self.tip(edge, back_end)
        t = np.linspace(0, 1, 60)[1:, None]
        swell = np.array([0, 0.06 * self.width + sign * self.curve])
        back = tip[-1] + t * (back_end - tip[-1]) + 4 * t * (1 - t) * swell
        behind = np.vstack([back[-1:], self.joint_and_shank(edge[0, 1]), edge[:1]])
        points = np.vstack([edge, tip, back[:-1], rounded(behind)[:-1]])
        sharp = np.zeros(len(points), bool)
        sharp[:len(edge)] = True
        return points, sharp

    def tip(self, edge, back_end):
        """The arc that leaves the edge tangentially at its distal end and goes over into the back."""
        slope = edge[-1] - edge[-2]
        along = np.arctan2(slope[1], slope[0])
        centre = edge[-1] + self.tip_radius * np.array([-np.sin(along), np.cos(along)])
        to_back = back_end - centre
        turn = np.linspace(along, np.arctan2(to_back[1], to_back[0]), 17)[1:] - np.pi / 2
        return centre + self.tip_radius * np.column_stack([np.cos(turn), np.sin(turn)])

    def joint_and_shank(self, heel_v):
        """From the blade's back round the joint, along the shank, about its end and back to the heel, which lies at `heel_v`."""
        half = self.shank / 2
        u = np.linspace(-self.joint * 1.5, 0.95 * self.ring - self.shank_length, 24)
        v = -half - 0.6 - (self.ring - half) * smooth((-u - self.joint) / (self.shank_length - self.joint))
        back = [[-0.25 * self.joint, 0.5 * self.width], [-self.joint * 0.9, 0.36 * self.width]]
        front = [[-self.joint * 0.8, min(-0.5 * self.width, v[0] - half)], [-0.2 * self.joint, -0.52 * self.width],
                 [self.heel * 0.5, min(-0.5 * self.width, heel_v)]]
        return np.vstack([back, np.column_stack([u, v + half]), [[u[-1] - half, v[-1]]], np.column_stack([u, v - half])[::-1], front])

    def solid(self, sign, on_top):
        """Vertices and faces of one member, in the frame of the scissors: the cutting edge lies in the plane where both meet."""
        ring, sharp = self.outline(sign)
        inset = np.where(sharp, self.bevel, 0.12 * self.shank)
        step = np.minimum(inset, 0.35 * room(ring))[:, None] * inward(ring)
        thin = np.interp(ring[:, 0], [0, self.length], [1, 0.55])[:, None]
        away = 1 if on_top else -1
        flank = np.where(sharp[:, None], 0.85, 0.55) * self.thickness * thin  # where the bevel ends and a small facet begins
        z = self.edge_height
        layers = [np.column_stack([self.placed(ring, sign), np.full(len(ring), z)]),
                  np.column_stack([self.placed(ring + np.where(sharp[:, None], step, 0), sign), z + away * flank]),
                  np.column_stack([self.placed(ring + step, sign), z + away * self.thickness * thin])]
        n = len(ring)
        quads = [(k * n + i, k * n + (i + 1) % n, (k + 1) * n + (i + 1) % n, (k + 1) * n + i) for k in range(2) for i in range(n)]
        return np.vstack(layers), quads + [tuple(range(n))[::-1], tuple(range(2 * n, 3 * n))]

    def silhouette(self):
        """Points round members and rings, in the frame of the scissors."""
        turn = np.linspace(0, 2 * np.pi, 24)
        circle = self.ring * np.column_stack([np.cos(turn), np.sin(turn)])
        members = [self.placed(self.outline(sign)[0][::4], sign) for sign in (1, -1)]
        return np.vstack(members + [self.ring_centre(sign) + circle for sign in (1, -1)])

    def ring_centre(self, sign):
        return self.placed(np.array([[-self.shank_length, -self.ring - 0.6]]), sign)[0]


def smooth(t):
    t = np.clip(t, 0, 1)
    return t * t * (3 - 2 * t)


def rounded(points, steps=6):
    """Catmull and Rom's curve through the points, ends included."""
    p = np.vstack([2 * points[0] - points[1], points, 2 * points[-1] - points[-2]])
    t = np.linspace(0, 1, steps, endpoint=False)[:, None]
    pieces = [0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)
              for a, b, c, d in zip(p, p[1:], p[2:], p[3:])]
    return np.vstack(pieces + [points[-1:]])[1:]


def inward(ring):
    """Unit normals to the left of a counter-clockwise outline."""
    along = np.roll(ring, -1, 0) - np.roll(ring, 1, 0)
    along /= np.maximum(np.linalg.norm(along, axis=1), 1e-9)[:, None]
    return np.column_stack([-along[:, 1], along[:, 0]])


def room(ring):
    """How far it is from each point of an outline to the side that faces it."""
    normals = inward(ring)
    facing = normals @ normals.T < 0.2
    return np.where(facing, np.linalg.norm(ring[:, None] - ring[None], axis=2), np.inf).min(1)
