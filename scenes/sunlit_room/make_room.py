#!/usr/bin/env python3
"""Writes sunlit_room.gltf, sunlit_room.bin and the textures beside this script. Same script, same bytes.

Metres, +Y up. The room's floor spans x -2.5 (west) to 2.5 (east), z -3 (north) to 3 (south), y 0 to 2.7.
Only the standard library is used.
"""
import json
import math
import os
import random
import struct
import sys
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))

# ---------------------------------------------------------------- small vector algebra


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return mul(a, 1.0 / length) if length > 1e-12 else (0.0, 1.0, 0.0)


def turn(axis, degrees):
    """Quaternion x, y, z, w of a rotation about a coordinate axis."""
    h = math.radians(degrees) / 2
    q = [0.0, 0.0, 0.0, math.cos(h)]
    q["xyz".index(axis)] = math.sin(h)
    return q


def quat_mul(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz]


def rotate(q, v):
    u = (q[0], q[1], q[2])
    t = mul(cross(u, v), 2.0)
    return add(add(v, mul(t, q[3])), cross(u, t))


def facing(direction):
    """Quaternion that turns -z into `direction` with +y kept up, as cameras and lights want it."""
    z = unit(mul(direction, -1.0))
    x = unit(cross((0.0, 1.0, 0.0), z))
    y = cross(z, x)
    yaw = math.degrees(math.atan2(z[0], z[2]))
    pitch = math.degrees(math.asin(max(-1.0, min(1.0, -z[1]))))
    q = quat_mul(turn("y", yaw), turn("x", pitch))
    assert dot(rotate(q, (0.0, 1.0, 0.0)), y) > 0.999
    return q


# ---------------------------------------------------------------- shapes


class Part:
    """Triangles of one material. Counter-clockwise from the front."""

    def __init__(self, material):
        self.material = material
        self.position, self.normal, self.uv, self.index = [], [], [], []

    def grid(self, rows, place):
        """Joins rows of (position, normal) pairs; row-major, front where the rows turn counter-clockwise."""
        base = len(self.position)
        width = len(rows[0])
        for row in rows:
            for p, n in row:
                self.position.append(place(p))
                self.normal.append(unit(sub(place(n), place((0.0, 0.0, 0.0)))))
        for i in range(len(rows) - 1):
            for j in range(width - 1):
                a, b = base + i * width + j, base + (i + 1) * width + j
                for t in ((a, b, b + 1), (a, b + 1, a + 1)):
                    p = [self.position[k] for k in t]
                    c = cross(sub(p[1], p[0]), sub(p[2], p[0]))
                    if dot(c, c) > 1e-18:
                        self.index.extend(t)

    def polygon(self, points, place=lambda p: p, uv=None):
        """Convex and flat; the normal comes from the order of the points."""
        points = [place(p) for p in points]
        n = unit(cross(sub(points[1], points[0]), sub(points[2], points[0])))
        base = len(self.position)
        self.position.extend(points)
        self.normal.extend([n] * len(points))
        if uv:
            self.uv.extend(uv)
        for i in range(1, len(points) - 1):
            self.index.extend((base, base + i, base + i + 1))

    def box(self, centre, size, place=lambda p: p):
        hx, hy, hz = size[0] / 2, size[1] / 2, size[2] / 2
        corner = lambda sx, sy, sz: (centre[0] + sx * hx, centre[1] + sy * hy, centre[2] + sz * hz)
        for a in (((1, -1, 1), (1, -1, -1), (1, 1, -1), (1, 1, 1)), ((-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (-1, 1, -1)),
                  ((-1, 1, 1), (1, 1, 1), (1, 1, -1), (-1, 1, -1)), ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1)),
                  ((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)), ((1, -1, -1), (-1, -1, -1), (-1, 1, -1), (1, 1, -1))):
            self.polygon([corner(*s) for s in a], place)

    def cushion(self, centre, size, radius, steps=2, place=lambda p: p):
        """Box with rounded edges and smooth normals."""
        half = [s / 2 for s in size]
        inner = [h - radius for h in half]
        line = []
        for axis in range(3):
            angles = [math.tan(math.pi / 4 * (1 - k / steps)) for k in range(steps + 1)]
            low = [-inner[axis] - radius * t for t in angles]
            line.append(low + [-v for v in reversed(low)])
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for side in (1, -1):
                rows = []
                for b in line[v]:
                    row = []
                    for a in (line[u] if side < 0 else list(reversed(line[u]))):
                        q = [0.0, 0.0, 0.0]
                        q[axis], q[u], q[v] = side * half[axis], a, b
                        core = tuple(max(-i, min(i, c)) for c, i in zip(q, inner))
                        n = unit(sub(tuple(q), core))
                        row.append((add(centre, add(core, mul(n, radius))), n))
                    rows.append(row)
                self.grid(rows, place)

    def lathe(self, profile, segments, place=lambda p: p):
        """Turns (radius, y) points about y. Front on the right-hand side walking along the profile: upward = outside.
        Two equal points in a row make a crease."""
        pieces, piece = [], [profile[0]]
        for p in profile[1:]:
            if p == piece[-1]:
                pieces.append(piece)
                piece = [p]
            else:
                piece.append(p)
        pieces.append(piece)
        for piece in pieces:
            slope = []
            for k in range(len(piece)):
                a, b = piece[max(k - 1, 0)], piece[min(k + 1, len(piece) - 1)]
                slope.append((b[1] - a[1], -(b[0] - a[0])))
            rows = []
            for k, (r, y) in enumerate(piece):
                row = []
                for j in range(segments + 1):
                    a = -2 * math.pi * (j % segments) / segments
                    row.append(((r * math.cos(a), y, r * math.sin(a)),
                                (slope[k][0] * math.cos(a), slope[k][1], slope[k][0] * math.sin(a))))
                rows.append(list(reversed(row)))
            self.grid(rows, place)

    def tube(self, radius, low, high, segments, place=lambda p: p, top=None):
        """Cylinder or frustum with both caps."""
        top = radius if top is None else top
        self.lathe([(0.0, low), (radius, low), (radius, low), (top, high), (top, high), (0.0, high)], segments, place)

    def sphere(self, centre, radius, segments=16, rings=10, place=lambda p: p):
        profile = [(radius * math.sin(math.pi * k / rings), -radius * math.cos(math.pi * k / rings)) for k in range(rings + 1)]
        profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
        self.lathe(profile, segments, lambda p: place(add(p, centre)))


def at(*offset):
    return lambda p: add(p, offset)


def placed(q, offset):
    return lambda p: add(rotate(q, p), offset)


def between(a, b):
    """Maps y in 0..1 onto the segment a..b (for slanted legs and branches), x and z unscaled."""
    d = sub(b, a)
    length = math.sqrt(dot(d, d))
    y = unit(d)
    x = unit(cross(y, (0.0, 0.0, 1.0) if abs(y[2]) < 0.9 else (1.0, 0.0, 0.0)))
    z = cross(x, y)
    return lambda p: add(a, add(add(mul(x, p[0]), mul(y, p[1] * length)), mul(z, p[2])))


# ---------------------------------------------------------------- pictures


def write_png(name, width, height, pixel):
    """RGB, 8 bit; pixel(x, y) gives three numbers in 0..1, sRGB encoded."""
    raw = bytearray()
    for y in range(height):
        raw.append(0)
        for x in range(width):
            raw.extend(max(0, min(255, int(round(c * 63)) * 255 // 63)) for c in pixel(x, y))

    def chunk(tag, data):
        body = tag + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    with open(os.path.join(HERE, name), "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                chunk(b"IDAT", zlib.compress(bytes(raw), 9)) + chunk(b"IEND", b""))


def lattice(seed, nx, ny):
    """Periodic value noise of nx x ny cells; f(u, v) with u, v in turns, in 0..1."""
    rng = random.Random(seed)
    table = [[rng.random() for _ in range(nx)] for _ in range(ny)]

    def value(u, v):
        x, y = (u % 1.0) * nx, (v % 1.0) * ny
        i, j = int(x) % nx, int(y) % ny
        s, t = x - int(x), y - int(y)
        s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
        a = table[j][i] * (1 - s) + table[j][(i + 1) % nx] * s
        b = table[(j + 1) % ny][i] * (1 - s) + table[(j + 1) % ny][(i + 1) % nx] * s
        return a * (1 - t) + b * t

    return value


def srgb(c):
    return 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055


def wood_floor():
    """Eight oak boards of 15 cm, 2.4 m before they repeat."""
    size, boards = 256, 8
    rng = random.Random(11)
    tone = [0.86 + 0.26 * rng.random() for _ in range(2 * boards)]
    joint = [rng.random() for _ in range(boards)]
    fine, broad = lattice(1, 5, 128), lattice(2, 3, 24)

    def pixel(x, y):
        board = y * boards // size
        u, v = x / size, y / size
        shifted = (u - joint[board]) % 1.0
        half = 0 if shifted < 0.5 else 1
        shade = tone[2 * board + half] * (0.88 + 0.14 * fine(u + 0.37 * board, v) + 0.12 * broad(u + 0.61 * board, v))
        gap = y % (size // boards) == 0 or min(shifted % 0.5, 0.5 - shifted % 0.5) < 0.003
        shade *= 0.55 if gap else 1.0
        return [srgb(c * shade) for c in (0.47, 0.325, 0.19)]

    write_png("wood_floor.png", size, size, pixel)


def rug():
    width, height = 160, 112

    def pixel(x, y):
        edge = min(x, y, width - 1 - x, height - 1 - y)
        weave = 0.96 + 0.04 * ((x + y) % 2)
        wool, deep, warm = (0.62, 0.57, 0.48), (0.13, 0.17, 0.24), (0.48, 0.22, 0.12)
        colour = wool
        if 5 <= edge < 8:
            colour = deep
        elif edge >= 13:
            d = (abs((x - width / 2) % 28 - 14) * 1.15 + abs((y - height / 2) % 28 - 14))
            colour = deep if d < 5 else warm if d < 8 else wool
        return [srgb(c * weave) for c in colour]

    write_png("rug.png", width, height, pixel)


def picture(name, seed, layers, sky):
    """Layered hills under a low sun."""
    width, height = 128, 96
    shape = [lattice(seed + k, 4 + 2 * k, 1) for k in range(len(layers))]

    def pixel(x, y):
        u, v = x / width, y / height
        colour = [a * (1 - v) + b * v for a, b in zip(*sky)]
        if (u - 0.68) ** 2 * (width / height) ** 2 + (v - 0.36) ** 2 < 0.011:
            colour = (0.85, 0.55, 0.28)
        for k, tint in enumerate(layers):
            if v > 0.42 + 0.15 * k - 0.13 * shape[k](u, 0.0):
                colour = tint
        return [srgb(c) for c in colour]

    write_png(name, width, height, pixel)


# ---------------------------------------------------------------- the file

SOFA_GREY, OCHRE = (0.27, 0.32, 0.36), (0.52, 0.33, 0.13)
GLASS = {"KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": 1.5}}


def pbr(colour, roughness=0.8, metallic=0.0, texture=None, **rest):
    body = {"baseColorFactor": [round(c, 4) for c in colour] + [1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
    if texture is not None:
        body["baseColorTexture"] = {"index": texture}
    return {"pbrMetallicRoughness": body, **rest}


def lamp(colour, strength):
    return pbr((0.0, 0.0, 0.0), 1.0, emissiveFactor=list(colour),
               extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength}})


MATERIALS = {
    "White paint": pbr((0.80, 0.79, 0.76), 0.9),
    "Ceiling paint": pbr((0.85, 0.85, 0.84), 0.95),
    "Accent paint": pbr((0.40, 0.47, 0.45), 0.9),
    "Oak floor": pbr((1.0, 1.0, 1.0), 0.55, texture=0),
    "Rug": pbr((1.0, 1.0, 1.0), 0.95, texture=1),
    "Print hills": pbr((1.0, 1.0, 1.0), 0.8, texture=2),
    "Print dusk": pbr((1.0, 1.0, 1.0), 0.8, texture=3),
    "White lacquer": pbr((0.78, 0.78, 0.76), 0.35),
    "Oak": pbr((0.47, 0.33, 0.19), 0.6),
    "Walnut": pbr((0.19, 0.115, 0.07), 0.5),
    "Black steel": pbr((0.04, 0.04, 0.045), 0.5),
    "Sofa wool": pbr(SOFA_GREY, 0.95),
    "Armchair wool": pbr(OCHRE, 0.95),
    "Cushion rust": pbr((0.45, 0.16, 0.08), 0.95),
    "Cushion linen": pbr((0.66, 0.61, 0.52), 0.95),
    "Curtain linen": pbr((0.68, 0.65, 0.58), 0.95, doubleSided=True),
    "Shade linen": pbr((0.74, 0.70, 0.62), 0.95, doubleSided=True),
    "Shade enamel": pbr((0.55, 0.57, 0.53), 0.4, doubleSided=True),
    "Mirror silver": pbr((0.93, 0.94, 0.93), 0.0, 1.0),
    "Window glass": pbr((1.0, 1.0, 1.0), 0.0, doubleSided=True, extensions=GLASS),
    "Clear glass": pbr((1.0, 1.0, 1.0), 0.0, extensions=dict(GLASS, KHR_materials_volume={
        "thicknessFactor": 0.004, "attenuationColor": [0.80, 0.93, 0.88], "attenuationDistance": 0.05})),
    "Terracotta": pbr((0.48, 0.24, 0.14), 0.85),
    "Soil": pbr((0.07, 0.05, 0.035), 1.0),
    "Leaf": pbr((0.10, 0.22, 0.06), 0.6, doubleSided=True),
    "Ceramic": pbr((0.72, 0.70, 0.64), 0.3),
    "Brass": pbr((0.80, 0.60, 0.30), 0.3, 1.0),
    "Paper": pbr((0.72, 0.69, 0.60), 0.95),
    "Book red": pbr((0.38, 0.07, 0.06), 0.7),
    "Book blue": pbr((0.08, 0.15, 0.28), 0.7),
    "Book green": pbr((0.10, 0.22, 0.14), 0.7),
    "Book cream": pbr((0.66, 0.59, 0.44), 0.7),
    "Book slate": pbr((0.20, 0.21, 0.23), 0.7),
    "Floor lamp bulb": lamp((1.0, 0.74, 0.46), 6500.0),
    "Pendant bulb": lamp((1.0, 0.78, 0.52), 6000.0),
}
MATERIAL_INDEX = {name: i for i, name in enumerate(MATERIALS)}


class File:
    def __init__(self):
        self.data = bytearray()
        self.views, self.accessors, self.meshes, self.nodes, self.cameras, self.lights = [], [], [], [], [], []
        self.triangles = 0
        self.drawn = {}

    def accessor(self, values, kind):
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[kind]
        flat = values if width == 1 else [c for v in values for c in v]
        if width == 1:
            wide = max(flat) > 65534
            payload = struct.pack("<%d%s" % (len(flat), "I" if wide else "H"), *flat)
            component, target = (5125 if wide else 5123), 34963
        else:
            payload = struct.pack("<%df" % len(flat), *flat)
            component, target = 5126, 34962
        while len(self.data) % 4:
            self.data.append(0)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(payload), "target": target})
        self.data.extend(payload)
        entry = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(values), "type": kind}
        if kind == "VEC3":
            stored = list(zip(*[iter(struct.unpack("<%df" % len(flat), payload))] * 3))
            entry["min"] = [min(v[k] for v in stored) for k in range(3)]
            entry["max"] = [max(v[k] for v in stored) for k in range(3)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def mesh(self, name, *parts):
        primitives = []
        for part in parts:
            # Equal vertices are stored once: lathes and grids repeat their seams.
            seen, order, remap = {}, [], []
            for k in range(len(part.position)):
                key = tuple(round(c, 6) for c in part.position[k]) + tuple(round(c, 4) for c in part.normal[k])
                if part.uv:
                    key += tuple(round(c, 6) for c in part.uv[k])
                if key not in seen:
                    seen[key] = len(order)
                    order.append(k)
                remap.append(seen[key])
            used = [remap[i] for i in part.index]
            attributes = {"POSITION": self.accessor([part.position[k] for k in order], "VEC3"),
                          "NORMAL": self.accessor([part.normal[k] for k in order], "VEC3")}
            if part.uv:
                attributes["TEXCOORD_0"] = self.accessor([part.uv[k] for k in order], "VEC2")
            primitives.append({"attributes": attributes, "indices": self.accessor(used, "SCALAR"),
                               "material": MATERIAL_INDEX[part.material]})
        self.meshes.append({"name": name, "primitives": primitives})
        self.drawn[len(self.meshes) - 1] = sum(len(p.index) // 3 for p in parts)
        return len(self.meshes) - 1

    def node(self, name, parent=None, offset=None, rotation=None, **rest):
        entry = {"name": name}
        if offset:
            entry["translation"] = [round(c, 5) for c in offset]
        if rotation:
            entry["rotation"] = [round(c, 9) for c in rotation]
        entry.update(rest)
        if "mesh" in rest:
            self.triangles += self.drawn[rest["mesh"]]
        self.nodes.append(entry)
        index = len(self.nodes) - 1
        if parent is not None:
            self.nodes[parent].setdefault("children", []).append(index)
        return index


W, E, N, S, H = -2.5, 2.5, -3.0, 3.0, 2.7  # inner faces of the room
OUT = 0.3  # thickness of the window wall
WINDOWS = [("Window north", -2.3, -0.3), ("Window south", 0.8, 2.2)]
SILL, HEAD = 0.85, 2.35
DOOR = (1.35, 2.25, 2.05)  # x from, x to, height; in the south wall
SUN = (-math.cos(math.radians(25)) * math.cos(math.radians(40)), -math.sin(math.radians(25)),
       -math.cos(math.radians(25)) * math.sin(math.radians(40)))


def shell(f, room):
    group = f.node("Shell", room)
    floor = Part("Oak floor")
    corners = [(W, 0, S), (E, 0, S), (E, 0, N), (W, 0, N)]
    floor.polygon(corners, uv=[(p[2] / 2.4, p[0] / 1.2) for p in corners])
    f.node("Floor", group, mesh=f.mesh("Floor", floor))
    ceiling = Part("Ceiling paint")
    ceiling.polygon([(W, H, N), (E, H, N), (E, H, S), (W, H, S)])
    f.node("Ceiling", group, mesh=f.mesh("Ceiling", ceiling))
    north = Part("Accent paint")
    north.polygon([(W, 0, N), (E, 0, N), (E, H, N), (W, H, N)])
    f.node("Wall north", group, mesh=f.mesh("Wall north", north))
    west = Part("White paint")
    west.polygon([(W, 0, S), (W, 0, N), (W, H, N), (W, H, S)])
    f.node("Wall west", group, mesh=f.mesh("Wall west", west))

    south = Part("White paint")
    a, b, top = DOOR
    for x0, x1, y0, y1 in ((W, a, 0, top), (b, E, 0, top), (W, a, top, H), (a, b, top, H), (b, E, top, H)):
        south.polygon([(x1, y0, S), (x0, y0, S), (x0, y1, S), (x1, y1, S)])
    depth = S + 0.12
    south.polygon([(a, 0, depth), (a, top, depth), (a, top, S), (a, 0, S)])
    south.polygon([(b, 0, S), (b, top, S), (b, top, depth), (b, 0, depth)])
    south.polygon([(a, top, S), (a, top, depth), (b, top, depth), (b, top, S)])
    f.node("Wall south", group, mesh=f.mesh("Wall south", south))

    # Window wall: inner face, outer face, reveals and the closing edges, all cut along the same lines.
    wall = Part("White paint")
    zs = [N, WINDOWS[0][1], WINDOWS[0][2], WINDOWS[1][1], WINDOWS[1][2], S]
    ys = [0.0, SILL, HEAD, H]
    X = E + OUT
    for i in range(5):
        for j in range(3):
            if i in (1, 3) and j == 1:
                continue
            z0, z1, y0, y1 = zs[i], zs[i + 1], ys[j], ys[j + 1]
            wall.polygon([(E, y0, z0), (E, y0, z1), (E, y1, z1), (E, y1, z0)])
            wall.polygon([(X, y0, z1), (X, y0, z0), (X, y1, z0), (X, y1, z1)])
    for _, z0, z1 in WINDOWS:
        wall.polygon([(E, SILL, z0), (E, SILL, z1), (X, SILL, z1), (X, SILL, z0)])
        wall.polygon([(X, HEAD, z0), (X, HEAD, z1), (E, HEAD, z1), (E, HEAD, z0)])
        wall.polygon([(E, SILL, z0), (X, SILL, z0), (X, HEAD, z0), (E, HEAD, z0)])
        wall.polygon([(X, SILL, z1), (E, SILL, z1), (E, HEAD, z1), (X, HEAD, z1)])
    wall.polygon([(E, H, N), (E, H, S), (X, H, S), (X, H, N)])
    wall.polygon([(X, 0, N), (X, 0, S), (E, 0, S), (E, 0, N)])
    wall.polygon([(X, 0, N), (E, 0, N), (E, H, N), (X, H, N)])
    wall.polygon([(E, 0, S), (X, 0, S), (X, H, S), (E, H, S)])
    f.node("Wall east", group, mesh=f.mesh("Wall east", wall))

    skirting = Part("White lacquer")
    t, h = 0.014, 0.08
    skirting.box((0, h / 2, N + t / 2), (5.0, h, t))
    skirting.box((W + t / 2, h / 2, 0), (t, h, 6.0 - 2 * t))
    skirting.box((E - t / 2, h / 2, 0), (t, h, 6.0 - 2 * t))
    a, b = a - 0.07, b + 0.07
    skirting.box(((W + a) / 2, h / 2, S - t / 2), (a - W, h, t))
    skirting.box(((b + E) / 2, h / 2, S - t / 2), (E - b, h, t))
    f.node("Skirting boards", group, mesh=f.mesh("Skirting boards", skirting))


def openings(f, room):
    group = f.node("Openings", room)
    x = E + 0.17
    for name, z0, z1 in WINDOWS:
        frame, pane, sill = Part("White lacquer"), Part("Window glass"), Part("White lacquer")
        w, d = 0.06, 0.07
        mid = (z0 + z1) / 2
        frame.box((x, SILL + w / 2, mid), (d, w, z1 - z0))
        frame.box((x, HEAD - w / 2, mid), (d, w, z1 - z0))
        for z in (z0 + w / 2, z1 - w / 2, mid):
            frame.box((x, (SILL + HEAD) / 2, z), (d, HEAD - SILL - 2 * w, w))
        for a, b in ((z0 + w, mid - w / 2), (mid + w / 2, z1 - w)):
            pane.polygon([(x, SILL + w, a), (x, SILL + w, b), (x, HEAD - w, b), (x, HEAD - w, a)])
        sill.box((E + 0.035, SILL + 0.0125, mid), (0.20, 0.025, z1 - z0 - 0.002))
        handle = Part("Brass")
        handle.box((x - 0.045, 1.5, mid), (0.02, 0.11, 0.02))
        window = f.node(name, group)
        f.node(name + " frame", window, mesh=f.mesh(name + " frame", frame, handle))
        f.node(name + " panes", window, mesh=f.mesh(name + " panes", pane))
        f.node(name + " sill", window, mesh=f.mesh(name + " sill", sill))

    a, b, top = DOOR
    leaf, trim, knob = Part("White lacquer"), Part("White lacquer"), Part("Brass")
    z = S + 0.05
    # The leaf is let into the reveals and the threshold, so that no daylight leaks around it.
    leaf.box(((a + b) / 2, (top + 0.005) / 2, z + 0.02), (b - a + 0.01, top + 0.005, 0.04))
    threshold = Part("Oak")
    threshold.polygon([(a, 0.0, z + 0.02), (b, 0.0, z + 0.02), (b, 0.0, S), (a, 0.0, S)])
    for y0, y1 in ((0.14, 0.92), (1.06, 1.92)):  # raised panels
        for x0, x1 in ((a + 0.12, (a + b) / 2 - 0.05), ((a + b) / 2 + 0.05, b - 0.12)):
            leaf.box(((x0 + x1) / 2, (y0 + y1) / 2, z - 0.004), (x1 - x0, y1 - y0, 0.008))
    for cx in (a - 0.035, b + 0.035):
        trim.box((cx, (top + 0.07) / 2, S - 0.009), (0.07, top + 0.07, 0.018))
    trim.box(((a + b) / 2, top + 0.035, S - 0.009), (b - a, 0.07, 0.018))
    knob.tube(0.024, 0.0, 0.008, 12, placed(turn("x", -90), (a + 0.07, 1.02, z)))
    knob.tube(0.009, 0.0, 0.05, 10, placed(turn("x", -90), (a + 0.07, 1.02, z)))
    knob.tube(0.009, 0.0, 0.12, 10, placed(turn("z", -90), (a + 0.065, 1.02, z - 0.05)))
    door = f.node("Door", group)
    f.node("Door leaf", door, mesh=f.mesh("Door leaf", leaf, knob))
    f.node("Door threshold", door, mesh=f.mesh("Door threshold", threshold))
    f.node("Door trim", door, mesh=f.mesh("Door trim", trim))

    # Curtains hang clear of the openings; one mesh, four places.
    cloth = Part("Curtain linen")
    steps, width, height = 36, 0.34, 2.42
    rows = []
    for y in (0.02, height):
        row = []
        for k in range(steps + 1):
            s = k / steps
            p = (0.035 * math.sin(s * 10 * math.pi), y, width * (s - 0.5))
            slope = 0.035 * 10 * math.pi / width * math.cos(s * 10 * math.pi)
            row.append((p, (-1.0, 0.0, slope)))
        rows.append(row)
    cloth.grid(rows, lambda p: p)
    mesh = f.mesh("Curtain", cloth)
    rail = Part("Black steel")
    rail.tube(0.011, -1.33, 1.33, 8, placed(turn("x", 90), (0, 0, 0)))
    rail_mesh = f.mesh("Curtain rail", rail)
    for (name, z0, z1), label, c in zip(WINDOWS, ("north", "south"), (-1.32, 1.5)):
        half = f.node("Curtains " + label, group)
        f.node("Curtain %s left" % label, half, (E - 0.09, 0.0, z0 - 0.2), mesh=mesh)
        f.node("Curtain %s right" % label, half, (E - 0.09, 0.0, z1 + 0.2), mesh=mesh)
        f.node("Curtain rail " + label, half, (E - 0.09, 2.45, (z0 + z1) / 2), mesh=rail_mesh)

    radiator = Part("White lacquer")
    radiator.box((E - 0.06, 0.42, 1.5), (0.012, 0.5, 1.2))
    radiator.box((E - 0.12, 0.42, 1.5), (0.012, 0.5, 1.2))
    for k in range(13):
        radiator.box((E - 0.09, 0.42, 0.93 + k * 0.095), (0.05, 0.48, 0.012))
    for z in (1.05, 1.95):
        radiator.box((E - 0.027, 0.42, z), (0.054, 0.04, 0.04))
    f.node("Radiator", group, mesh=f.mesh("Radiator", radiator))


def sofa(f, parent):
    node = f.node("Sofa", parent, (-0.95, 0.0, 2.5), turn("y", 180))
    body, legs = Part("Sofa wool"), Part("Walnut")
    body.cushion((0, 0.245, 0), (2.1, 0.23, 0.88), 0.03)
    body.cushion((0, 0.53, -0.36), (1.74, 0.56, 0.16), 0.05)
    for s in (-1, 1):
        body.cushion((s * 0.965, 0.36, 0), (0.19, 0.46, 0.9), 0.06)
        for z in (-0.36, 0.36):
            legs.tube(0.017, 0.0, 0.14, 10, at(s * 0.95, 0, z), top=0.026)
    f.node("Sofa frame", node, mesh=f.mesh("Sofa frame", body, legs))
    seat, back = Part("Sofa wool"), Part("Sofa wool")
    seat.cushion((0, 0, 0), (0.865, 0.15, 0.72), 0.055)
    back.cushion((0, 0, 0), (0.84, 0.44, 0.17), 0.07)
    seat_mesh, back_mesh = f.mesh("Seat cushion", seat), f.mesh("Back cushion", back)
    for s, side in ((1, "left"), (-1, "right")):
        f.node("Seat cushion " + side, node, (s * 0.4345, 0.434, 0.085), mesh=seat_mesh)
        f.node("Back cushion " + side, node, (s * 0.4345, 0.70, -0.185), turn("x", -10), mesh=back_mesh)
    for material, side, x, yaw in (("Cushion rust", "rust", 0.62, -14), ("Cushion linen", "linen", -0.60, 16)):
        pillow = Part(material)
        pillow.cushion((0, 0, 0), (0.42, 0.42, 0.15), 0.07)
        f.node("Pillow " + side, node, (x, 0.705, 0.0), quat_mul(turn("y", yaw), turn("x", -22)),
               mesh=f.mesh("Pillow " + side, pillow))


def armchair(f, parent):
    node = f.node("Armchair", parent, (-1.93, 0.0, 0.28), turn("y", 82))
    body, legs, seat = Part("Armchair wool"), Part("Walnut"), Part("Armchair wool")
    body.cushion((0, 0.27, 0), (0.72, 0.18, 0.74), 0.04)
    body.cushion((0, 0.56, -0.30), (0.72, 0.52, 0.14), 0.06, 2, placed(turn("x", -7), (0, 0.02, -0.03)))
    for s in (-1, 1):
        body.cushion((s * 0.32, 0.44, 0.02), (0.11, 0.34, 0.70), 0.05)
        for z in (-0.28, 0.30):
            legs.tube(0.014, 0.0, 0.19, 10, at(s * 0.29, 0, z), top=0.022)
    seat.cushion((0, 0.425, 0.06), (0.52, 0.13, 0.62), 0.05)
    f.node("Armchair frame", node, mesh=f.mesh("Armchair frame", body, legs))
    f.node("Armchair seat", node, mesh=f.mesh("Armchair seat", seat))


def coffee_table(f, parent):
    node = f.node("Coffee table", parent, (-0.85, 0.012, 1.1))
    top, legs = Part("Oak"), Part("Black steel")
    top.box((0, 0.405, 0), (1.15, 0.03, 0.6))
    top.box((0, 0.16, 0), (1.05, 0.02, 0.5))
    for sx in (-1, 1):
        for sz in (-1, 1):
            legs.box((sx * 0.54, 0.195, sz * 0.265), (0.025, 0.39, 0.025))
    f.node("Coffee table frame", node, mesh=f.mesh("Coffee table frame", top, legs))

    # Solid glass: the outer skin up, over the rim and down the inner skin; a thick base.
    vase = Part("Clear glass")
    outer = [(0.040, 0.0), (0.052, 0.02), (0.062, 0.06), (0.064, 0.10), (0.056, 0.15), (0.044, 0.19), (0.042, 0.215), (0.050, 0.25)]
    inner = [(r - 0.004, y) for r, y in reversed(outer[1:])]
    vase.lathe([(0.0, 0.0), outer[0], outer[0]] + outer[1:] + [outer[-1]] + [(inner[0][0], inner[0][1])] * 2 + inner[1:] +
               [(0.034, 0.016), (0.0, 0.016)], 28)
    f.node("Glass vase", node, (0.22, 0.42, -0.08), mesh=f.mesh("Glass vase", vase))
    tumbler = Part("Clear glass")
    tumbler.lathe([(0.0, 0.0), (0.031, 0.0), (0.031, 0.0), (0.036, 0.095), (0.036, 0.095), (0.034, 0.095), (0.034, 0.095),
                   (0.029, 0.012), (0.029, 0.012), (0.0, 0.012)], 28)
    f.node("Drinking glass", node, (-0.12, 0.42, 0.14), mesh=f.mesh("Drinking glass", tumbler))
    for k, (material, size, yaw) in enumerate((("Book slate", (0.24, 0.026, 0.30), 8), ("Book cream", (0.20, 0.022, 0.26), -6))):
        book, paper = Part(material), Part("Paper")
        w, h, d = size
        book.box((0, 0.002, 0), (w, 0.003, d))
        book.box((0, h - 0.002, 0), (w, 0.003, d))
        book.box((-w / 2 + 0.002, h / 2, 0), (0.003, h - 0.007, d))
        paper.box((0.002, h / 2, 0), (w - 0.012, h - 0.008, d - 0.01))
        f.node("Book on table %d" % (k + 1), node, (-0.34, 0.421 + 0.027 * k, -0.08), turn("y", yaw),
               mesh=f.mesh("Book on table %d" % (k + 1), book, paper))


def dining(f, parent):
    node = f.node("Dining table", parent, (-1.0, 0.0, -1.8))
    top, stem = Part("Walnut"), Part("Black steel")
    top.lathe([(0.0, 0.71), (0.44, 0.71), (0.50, 0.725), (0.505, 0.732), (0.50, 0.74), (0.50, 0.74), (0.0, 0.74)], 40)
    stem.lathe([(0.0, 0.0), (0.28, 0.0), (0.28, 0.0), (0.28, 0.008), (0.20, 0.016), (0.05, 0.035), (0.032, 0.08), (0.032, 0.66),
                (0.06, 0.70), (0.16, 0.71)], 24)
    f.node("Dining table top", node, mesh=f.mesh("Dining table top", top))
    f.node("Dining table foot", node, mesh=f.mesh("Dining table foot", stem))
    bowl = Part("Ceramic")
    profile = [(0.0, 0.0), (0.05, 0.0), (0.055, 0.008), (0.09, 0.03), (0.125, 0.065), (0.14, 0.09)]
    bowl.lathe(profile + [(0.14, 0.09), (0.134, 0.09), (0.134, 0.09), (0.118, 0.066), (0.085, 0.036), (0.05, 0.014), (0.0, 0.01)], 28)
    f.node("Fruit bowl", node, (0.08, 0.74, 0.05), mesh=f.mesh("Fruit bowl", bowl))
    fruit = Part("Cushion rust")
    for x, z in ((0.045, 0.0), (-0.035, 0.035), (-0.02, -0.045)):
        fruit.sphere((x, 0.062, z), 0.038, 12, 8)
    f.node("Oranges", node, (0.08, 0.74, 0.05), mesh=f.mesh("Oranges", fruit))

    seat, frame = Part("Oak"), Part("Oak")
    seat.cushion((0, 0.45, 0), (0.42, 0.03, 0.42), 0.014, 1)
    for sx in (-1, 1):
        frame.tube(0.015, 0.0, 1.0, 8, between((sx * 0.19, 0.0, 0.20), (sx * 0.165, 0.44, 0.165)))
        frame.tube(0.015, 0.0, 1.0, 8, between((sx * 0.19, 0.0, -0.22), (sx * 0.175, 0.44, -0.185)))
        frame.tube(0.014, 0.0, 1.0, 8, between((sx * 0.175, 0.44, -0.185), (sx * 0.175, 0.84, -0.245)))
        frame.tube(0.009, 0.0, 1.0, 8, between((sx * 0.18, 0.20, 0.185), (sx * 0.183, 0.20, -0.203)))
    rows = []
    for side in (1, -1):  # curved back rest: two skins
        for y in ((0.70, 0.83) if side > 0 else (0.83, 0.70)):
            row = []
            for k in range(9):
                s = (k / 8 - 0.5) * 2
                p = (0.195 * s, y, -0.262 + 0.03 * s * s + side * 0.008 - (y - 0.70) * 0.15)
                row.append((p, (-0.3 * s * side, 0.0, side)))
            rows.append(list(reversed(row)))
    for a, b in ((0, 1), (2, 3)):
        frame.grid([rows[a], rows[b]], lambda p: p)
    for a, b in ((1, 2), (3, 0)):  # top and bottom edges
        ra, rb = rows[a], rows[b]
        up = (0.0, 1.0 if a == 1 else -1.0, 0.0)
        frame.grid([[(p, up) for p, _ in ra], [(p, up) for p, _ in rb]], lambda p: p)
    mesh = f.mesh("Chair", seat, frame)
    for name, angle, distance in (("Chair east", 100, 0.62), ("Chair north", 192, 0.60), ("Chair south", 340, 0.66)):
        a = math.radians(angle)
        f.node(name, parent, (-1.0 + distance * math.sin(a), 0.0, -1.8 + distance * math.cos(a)), turn("y", angle + 180), mesh=mesh)


def bookshelf(f, parent):
    node = f.node("Bookshelf", parent, (W + 0.165, 0.0, -1.75), turn("y", 90))
    wood = Part("Oak")
    width, height, depth, t = 1.8, 2.06, 0.3, 0.025
    for x in (-width / 2 + t / 2, 0.0, width / 2 - t / 2):
        wood.box((x, height / 2, 0), (t, height, depth))
    levels = [0.06, 0.44, 0.80, 1.14, 1.46, 1.76, height - t / 2]
    bay = width / 2 - 1.5 * t
    for y in levels:
        for s in (-1, 1):
            wood.box((s * (bay + t) / 2, y, 0), (bay, t, depth - 0.01))
    wood.box((0, height / 2, -depth / 2 + 0.004), (width - 2 * t, height - 0.04, 0.006))
    f.node("Bookshelf case", node, mesh=f.mesh("Bookshelf case", wood))

    rng = random.Random(5)
    colours = ["Book red", "Book blue", "Book green", "Book cream", "Book slate"]
    for level in range(1, 6):
        for s, side in ((-1, "left"), (1, "right")):
            floor_y, room = levels[level] + t / 2, levels[level + 1] - levels[level] - t
            x, end = s * (bay + t) / 2 - bay / 2 + 0.01, s * (bay + t) / 2 + bay / 2 - 0.02
            stop = x + (end - x) * (0.45 + 0.5 * rng.random())
            parts = {}
            while x < stop:
                thick, tall, deep = 0.022 + 0.03 * rng.random(), room * (0.66 + 0.26 * rng.random()), 0.15 + 0.06 * rng.random()
                if x + thick > end:
                    break
                name = rng.choice(colours)
                part = parts.setdefault(name, Part(name))
                part.box((x + thick / 2, floor_y + tall / 2, 0.125 - deep / 2), (thick - 0.002, tall, deep))
                x += thick
            f.node("Books %d %s" % (level, side), node,
                   mesh=f.mesh("Books %d %s" % (level, side), *[parts[k] for k in colours if k in parts]))
    jar = Part("Ceramic")
    jar.lathe([(0.0, 0.0), (0.045, 0.0), (0.045, 0.0), (0.07, 0.05), (0.075, 0.10), (0.06, 0.15), (0.035, 0.175), (0.035, 0.20),
               (0.035, 0.20), (0.0, 0.20)], 24)
    f.node("Jar", node, (0.30, levels[0] + t / 2, 0.0), mesh=f.mesh("Jar", jar))
    basket = Part("Cushion linen")
    basket.cushion((0, 0.12, 0), (0.42, 0.24, 0.24), 0.03, 1)
    f.node("Basket", node, (-0.44, levels[0] + t / 2, 0.0), mesh=f.mesh("Basket", basket))


def mirror(f, parent):
    """Cheval mirror: swings between two posts; tilted so that the low sun goes up onto the west wall."""
    node = f.node("Standing mirror", parent, (1.2, 0.0, -2.52))
    stand = Part("Walnut")
    for s in (-1, 1):
        stand.box((s * 0.355, 0.52, 0), (0.035, 0.98, 0.035))
        stand.box((s * 0.355, 0.02, 0), (0.05, 0.04, 0.52))
        stand.tube(0.016, 0.0, 0.05, 12, placed(turn("z", 90), (s * 0.33 + 0.025, 0.94, 0)))
    stand.box((0, 0.10, 0), (0.68, 0.04, 0.03))
    f.node("Mirror stand", node, mesh=f.mesh("Mirror stand", stand))
    swing = f.node("Mirror swing", node, (0.0, 0.94, 0.0), turn("x", -17))
    frame, glass = Part("Walnut"), Part("Mirror silver")
    w, h, b = 0.60, 1.56, 0.035
    for s in (-1, 1):
        frame.box((s * (w / 2 - b / 2), 0, 0), (b, h, 0.03))
        frame.box((0, s * (h / 2 - b / 2), 0), (w - 2 * b, b, 0.03))
    frame.box((0, 0, -0.009), (w - 2 * b, h - 2 * b, 0.006))
    x, y = w / 2 - b, h / 2 - b
    glass.polygon([(-x, -y, 0.006), (x, -y, 0.006), (x, y, 0.006), (-x, y, 0.006)])
    f.node("Mirror frame", swing, mesh=f.mesh("Mirror frame", frame))
    f.node("Mirror glass", swing, mesh=f.mesh("Mirror glass", glass))


def lamps(f, parent):
    node = f.node("Floor lamp", parent, (-2.2, 0.0, -0.48))
    stand, shade, bulb = Part("Brass"), Part("Shade linen"), Part("Floor lamp bulb")
    stand.lathe([(0.0, 0.0), (0.14, 0.0), (0.14, 0.0), (0.14, 0.018), (0.03, 0.03), (0.011, 0.05), (0.011, 1.36), (0.011, 1.36),
                 (0.0, 1.36)], 20)
    for k in range(3):  # spokes that carry the shade
        a = 2 * math.pi * k / 3
        stand.tube(0.003, 0.0, 1.0, 6, between((0.01 * math.cos(a), 1.355, 0.01 * math.sin(a)),
                                               (0.229 * math.cos(a), 1.355, 0.229 * math.sin(a))))
    shade.lathe([(0.23, 1.32), (0.16, 1.64)], 32)
    bulb.sphere((0, 1.44, 0), 0.06, 20, 12)
    f.node("Floor lamp stand", node, mesh=f.mesh("Floor lamp stand", stand))
    f.node("Floor lamp shade", node, mesh=f.mesh("Floor lamp shade", shade))
    f.node("Floor lamp bulb", node, mesh=f.mesh("Floor lamp bulb", bulb))

    node = f.node("Pendant lamp", parent, (-1.0, 1.62, -1.8))
    cord, shade, bulb = Part("Black steel"), Part("Shade enamel"), Part("Pendant bulb")
    cord.tube(0.004, 0.15, 1.06, 8)
    cord.tube(0.05, 1.055, 1.08, 16)
    cord.tube(0.022, 0.10, 0.17, 12)
    shade.lathe([(0.21, -0.04), (0.195, 0.02), (0.15, 0.075), (0.08, 0.115), (0.024, 0.13)], 32)
    bulb.sphere((0, 0.045, 0), 0.05, 20, 12)
    f.node("Pendant cord", node, mesh=f.mesh("Pendant cord", cord))
    f.node("Pendant shade", node, mesh=f.mesh("Pendant shade", shade))
    f.node("Pendant bulb", node, mesh=f.mesh("Pendant bulb", bulb))


def plant(f, parent):
    node = f.node("Plant", parent, (2.08, 0.0, 0.26))
    pot, soil, leaf = Part("Terracotta"), Part("Soil"), Part("Leaf")
    pot.lathe([(0.0, 0.0), (0.12, 0.0), (0.12, 0.0), (0.165, 0.30), (0.165, 0.30), (0.18, 0.30), (0.18, 0.30), (0.185, 0.35),
               (0.185, 0.35), (0.165, 0.35), (0.165, 0.35), (0.155, 0.27)], 28)
    soil.lathe([(0.158, 0.295), (0.08, 0.305), (0.0, 0.31)], 28)
    rng = random.Random(3)
    for k in range(17):
        turn_about = k * 2.39996
        tall, reach = 0.45 + 0.50 * rng.random() + 0.2 * (k % 3 == 0), 0.10 + 0.20 * rng.random()
        root = (0.05 * math.cos(turn_about), 0.30, 0.05 * math.sin(turn_about))
        out = (math.cos(turn_about), 0.0, math.sin(turn_about))
        side = (-out[2], 0.0, out[0])
        rows = []
        for i in range(9):
            s = i / 8
            spine = add(root, add(mul(out, reach * s * s + 0.10 * max(0.0, s - 0.6)), (0.0, tall * math.sin(s * math.pi * 0.47), 0.0)))
            half = 0.012 if s < 0.3 else 0.012 + 0.055 * math.sin(math.pi * (s - 0.3) / 0.7) * (1 - 0.2 * s)
            half = 0.001 if i == 8 else half
            along = unit((out[0] * 2 * reach * s, tall * math.cos(s * math.pi * 0.47) * 1.47, out[2] * 2 * reach * s))
            n = unit(cross(along, side))
            rows.append([(add(spine, add(mul(side, half), mul(n, -0.25 * half))), n), (spine, n),
                         (add(spine, add(mul(side, -half), mul(n, -0.25 * half))), n)])
        # Each leaf is cut where it is bent; the winding follows the normals.
        test = cross(sub(rows[1][0][0], rows[0][0][0]), sub(rows[1][1][0], rows[0][0][0]))
        if dot(test, rows[0][0][1]) < 0:
            rows = [list(reversed(r)) for r in rows]
        leaf.grid(rows, lambda p: p)
    f.node("Plant pot", node, mesh=f.mesh("Plant pot", pot, soil))
    f.node("Plant leaves", node, mesh=f.mesh("Plant leaves", leaf))


def pictures(f, parent):
    group = f.node("Pictures", parent)
    for name, material, frame_material, size, offset, yaw in (
            ("Picture hills", "Print hills", "Black steel", (0.96, 0.72), (-0.95, 1.62, S - 0.014), 180),
            ("Picture dusk", "Print dusk", "Oak", (0.48, 0.36), (W + 0.014, 1.62, 0.06), 90),
            ("Picture valley", "Print hills", "Oak", (0.48, 0.36), (W + 0.014, 1.62, 0.64), 90),
            ("Picture evening", "Print dusk", "Black steel", (0.64, 0.48), (-1.0, 1.55, N + 0.014), 0)):
        w, h = size
        b = 0.022
        mat = 0.055
        frame, mount, sheet = Part(frame_material), Part("Paper"), Part(material)
        for s in (-1, 1):
            frame.box((s * (w / 2 - b / 2), 0, 0), (b, h, 0.026))
            frame.box((0, s * (h / 2 - b / 2), 0), (w - 2 * b, b, 0.026))
        x, y = w / 2 - b, h / 2 - b
        mount.polygon([(-x, -y, 0.002), (x, -y, 0.002), (x, y, 0.002), (-x, y, 0.002)])
        x, y = x - mat, y - mat
        sheet.polygon([(-x, -y, 0.004), (x, -y, 0.004), (x, y, 0.004), (-x, y, 0.004)],
                      uv=[(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)])
        f.node(name, group, offset, turn("y", yaw) if yaw else None, mesh=f.mesh(name, frame, mount, sheet))


def carpet(f, parent):
    part, edge = Part("Rug"), Part("Cushion linen")
    x0, x1, z0, z1, y = -2.1, 0.4, 0.05, 1.8, 0.012
    part.polygon([(x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0)], uv=[(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)])
    corners = [(x0, z1), (x1, z1), (x1, z0), (x0, z0)]
    for (ax, az), (bx, bz) in zip(corners, corners[1:] + corners[:1]):
        edge.polygon([(ax, 0.001, az), (bx, 0.001, bz), (bx, y, bz), (ax, y, az)])
    f.node("Rug", parent, mesh=f.mesh("Rug", part, edge))


def main():
    wood_floor()
    rug()
    picture("print_hills.png", 20, [(0.36, 0.42, 0.40), (0.20, 0.29, 0.27), (0.09, 0.16, 0.15)], ((0.62, 0.66, 0.62), (0.74, 0.66, 0.50)))
    picture("print_dusk.png", 40, [(0.45, 0.28, 0.26), (0.27, 0.16, 0.20), (0.12, 0.08, 0.13)], ((0.36, 0.40, 0.52), (0.78, 0.50, 0.34)))

    f = File()
    room = f.node("Sunlit room")
    shell(f, room)
    openings(f, room)
    furniture = f.node("Furniture", room)
    carpet(f, furniture)
    sofa(f, furniture)
    armchair(f, furniture)
    coffee_table(f, furniture)
    dining(f, furniture)
    bookshelf(f, furniture)
    mirror(f, furniture)
    plant(f, furniture)
    pictures(f, furniture)
    lights = f.node("Lights", room)
    lamps(f, lights)
    f.lights.append({"name": "Sun", "type": "directional", "color": [1.0, 0.80, 0.58], "intensity": 32000.0})
    f.node("Sun", lights, (6.0, 4.0, 1.5), facing(SUN), extensions={"KHR_lights_punctual": {"light": 0}})
    cameras = f.node("Cameras", room)
    for name, eye, target, fov in (("From the door", (2.1, 1.6, 2.72), (-0.75, 0.98, -0.95), 58.0),
                                   ("From the bookshelf", (-2.0, 1.6, -2.75), (0.75, 0.95, 1.0), 60.0)):
        f.cameras.append({"name": name, "type": "perspective",
                          "perspective": {"yfov": round(math.radians(fov), 6), "aspectRatio": round(16 / 9, 6), "znear": 0.02}})
        f.node("Camera " + name[0].lower() + name[1:], cameras, eye, facing(sub(target, eye)), camera=len(f.cameras) - 1)

    images = ["wood_floor.png", "rug.png", "print_hills.png", "print_dusk.png"]
    document = {
        "asset": {"version": "2.0", "generator": "scenes/sunlit_room/make_room.py", "copyright": "The Atrium authors, Apache-2.0"},
        "extensionsUsed": ["ATRIUM_environment", "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
                           "KHR_materials_transmission", "KHR_materials_volume"],
        "extensions": {"ATRIUM_environment": {"skyRadiance": [1750.0, 2050.0, 2500.0]}, "KHR_lights_punctual": {"lights": f.lights}},
        "scene": 0,
        "scenes": [{"name": "Sunlit room", "nodes": [room]}],
        "nodes": f.nodes, "cameras": f.cameras, "meshes": f.meshes,
        "materials": [{"name": name, **body} for name, body in MATERIALS.items()],
        "textures": [{"sampler": 0, "source": k} for k in range(len(images))],
        "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
        "images": [{"name": name[:-4], "uri": name} for name in images],
        "accessors": f.accessors, "bufferViews": f.views,
        "buffers": [{"uri": "sunlit_room.bin", "byteLength": len(f.data)}],
    }
    with open(os.path.join(HERE, "sunlit_room.bin"), "wb") as out:
        out.write(f.data)
    with open(os.path.join(HERE, "sunlit_room.gltf"), "w", encoding="utf-8") as out:
        json.dump(document, out, separators=(",", ":"))
        out.write("\n")
    print("%d triangles drawn, %d nodes, %d materials" % (f.triangles, len(f.nodes), len(MATERIALS)), file=sys.stderr)


if __name__ == "__main__":
    main()
