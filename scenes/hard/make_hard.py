#!/usr/bin/env python3
"""Writes the gallery of hard scenes: what strains arithmetic, memory or patience, one file each.

    make_hard.py                  the small ones, beside this script
    make_hard.py --large FOLDER   those too large to keep, generated for tests

Metres, +Y up. Same script, same bytes. What is expected of each is in tests/extreme/cases.json.
"""
import json
import math
import os
import struct
import sys
import zlib

NAN, INF = float("nan"), float("inf")


def matt(rho, exitance=0.0):
    """Reflects rho and emits `exitance` lumen per square metre."""
    body = {"pbrMetallicRoughness": {"baseColorFactor": [rho, rho, rho, 1.0], "metallicFactor": 0.0}}
    if exitance:
        body["emissiveFactor"] = [1.0, 1.0, 1.0]
        body["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": exitance / math.pi}}
    return body


def mirror(rho):
    return {"pbrMetallicRoughness": {"baseColorFactor": [rho, rho, rho, 1.0], "metallicFactor": 1.0, "roughnessFactor": 0.0}}


def glass(ior):
    return {"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.0},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": ior},
                           "KHR_materials_volume": {"thicknessFactor": 0.01}}}


def quad(a, b, c, d):
    """Two triangles, front where a, b, c, d turn counter-clockwise."""
    return [a, b, c, a, c, d]


def box(size, centre=(0.0, 0.0, 0.0), inwards=False):
    x, y, z = (s / 2 for s in size)
    p = lambda i, j, k: (centre[0] + i * x, centre[1] + j * y, centre[2] + k * z)
    faces = [((1, -1, 1), (1, -1, -1), (1, 1, -1), (1, 1, 1)), ((-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (-1, 1, -1)),
             ((-1, 1, 1), (1, 1, 1), (1, 1, -1), (-1, 1, -1)), ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1)),
             ((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)), ((1, -1, -1), (-1, -1, -1), (-1, 1, -1), (1, 1, -1))]
    out = []
    for f in faces:
        corners = [p(*c) for c in f]
        out += quad(*(reversed(corners) if inwards else corners))
    return out


def sphere(radius, centre=(0.0, 0.0, 0.0), segments=32, inwards=False):
    rings, out = segments // 2, []
    def at(i, j):
        a, b = math.pi * i / rings, 2 * math.pi * (j % segments) / segments
        return (centre[0] + radius * math.sin(a) * math.cos(b), centre[1] + radius * math.cos(a),
                centre[2] - radius * math.sin(a) * math.sin(b))
    for i in range(rings):
        for j in range(segments):
            corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
            triangles = ([corners[:3]] if i < rings - 1 else []) + ([[corners[0], corners[2], corners[3]]] if i > 0 else [])
            if i == rings - 1:
                triangles = [[corners[0], corners[1], corners[3]]]
            for t in triangles:
                out += reversed(t) if inwards else t
    return out


def floor(width, depth, y=0.0, x=0.0, z=0.0):
    w, d = width / 2, depth / 2
    return quad((x - w, y, z + d), (x + w, y, z + d), (x + w, y, z - d), (x - w, y, z - d))


def ceiling(width, depth, y, x=0.0, z=0.0):
    return list(reversed(floor(width, depth, y, x, z)))


class File:
    """A glTF document in the making; each mesh has one part, without normals, so that facets are flat."""

    def __init__(self, name):
        self.name = name
        self.json = {"asset": {"version": "2.0", "generator": "scenes/hard/make_hard.py", "copyright": "The Atrium authors, Apache-2.0"},
                     "scene": 0, "scenes": [{"name": name, "nodes": []}], "nodes": []}
        self.data = bytearray()
        self.used = set()

    def append(self, key, entry):
        self.json.setdefault(key, []).append(entry)
        return len(self.json[key]) - 1

    def view(self, raw):
        self.data.extend(b"\0" * (-len(self.data) % 4))
        self.data.extend(raw)
        return self.append("bufferViews", {"buffer": 0, "byteOffset": len(self.data) - len(raw), "byteLength": len(raw)})

    def accessor(self, kind, values):
        width = {"VEC3": 3, "VEC2": 2}[kind]
        entry = {"bufferView": self.view(struct.pack("<%df" % (width * len(values)), *(c for v in values for c in v))),
                 "componentType": 5126, "count": len(values), "type": kind}
        finite = [v for v in values if all(math.isfinite(c) for c in v)]
        if kind == "VEC3" and finite:
            single = [struct.unpack("<3f", struct.pack("<3f", *v)) for v in (min(finite), max(finite))]
            entry["min"] = [struct.unpack("<f", struct.pack("<f", min(v[k] for v in finite)))[0] for k in range(3)]
            entry["max"] = [struct.unpack("<f", struct.pack("<f", max(v[k] for v in finite)))[0] for k in range(3)]
            del single
        return self.append("accessors", entry)

    def material(self, name, body):
        self.used |= set(body.get("extensions", {}))
        return self.append("materials", {"name": name, **body})

    def mesh(self, name, triangles, material, uv=None):
        primitive = {"attributes": {"POSITION": self.accessor("VEC3", triangles)}, "material": material}
        if uv:
            primitive["attributes"]["TEXCOORD_0"] = self.accessor("VEC2", uv)
        return self.append("meshes", {"name": name, "primitives": [primitive]})

    def node(self, name, root=True, **rest):
        index = self.append("nodes", {"name": name, **rest})
        if root:
            self.json["scenes"][0]["nodes"].append(index)
        return index

    def thing(self, name, triangles, material, uv=None, **rest):
        return self.node(name, mesh=self.mesh(name, triangles, material, uv), **rest)

    def light(self, name, kind, intensity, **rest):
        self.used.add("KHR_lights_punctual")
        lights = self.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"name": name, "type": kind, "intensity": intensity})
        return self.node(name, extensions={"KHR_lights_punctual": {"light": len(lights) - 1}}, **rest)

    def sun(self, lux, elevation=90.0):
        """Light comes from +X at `elevation` degrees above the horizon."""
        # -Z turned about Y to -X, then down by the elevation.
        e = math.radians(elevation) / 2
        yaw = (0.0, math.sin(math.pi / 4), 0.0, math.cos(math.pi / 4))
        pitch = (-math.sin(e), 0.0, 0.0, math.cos(e))
        x = (yaw[3] * pitch[0] + yaw[0] * pitch[3] + yaw[1] * pitch[2] - yaw[2] * pitch[1],
             yaw[3] * pitch[1] - yaw[0] * pitch[2] + yaw[1] * pitch[3] + yaw[2] * pitch[0],
             yaw[3] * pitch[2] + yaw[0] * pitch[1] - yaw[1] * pitch[0] + yaw[2] * pitch[3],
             yaw[3] * pitch[3] - yaw[0] * pitch[0] - yaw[1] * pitch[1] - yaw[2] * pitch[2])
        return self.light("Sun", "directional", lux, rotation=list(x))

    def sky(self, radiance):
        self.used.add("ATRIUM_environment")
        self.json.setdefault("extensions", {})["ATRIUM_environment"] = {"skyRadiance": [radiance] * 3}

    def camera(self, name="Camera", **rest):
        body = {"name": name, "type": "perspective", "perspective": {"yfov": 1.0, "aspectRatio": 1.5, "znear": 0.01, **rest.pop("lens", {})}}
        return self.node(name, camera=self.append("cameras", body), **rest)

    def png(self, width, height, rows):
        """An image of one grey byte per pixel as a texture."""
        packer, packed = zlib.compressobj(9), []
        for row in rows:
            packed.append(packer.compress(b"\0" + row))
        packed.append(packer.flush())
        chunk = lambda tag, body: struct.pack(">I", len(body)) + tag + body + struct.pack(">I", zlib.crc32(tag + body))
        raw = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
               chunk(b"IDAT", b"".join(packed)) + chunk(b"IEND", b""))
        image = self.append("images", {"name": "grey", "mimeType": "image/png", "bufferView": self.view(raw)})
        return self.append("textures", {"source": image})

    def room(self, rho, size=(4.0, 3.0, 5.0), name="Room", exitance=0.0, **rest):
        """Faces inwards, its floor's middle at the origin."""
        return self.thing(name, box(size, (0.0, size[1] / 2, 0.0), inwards=True),
                          self.material("%s %g" % (name, rho), matt(rho, exitance)), **rest)

    def cie53(self, scale=1.0, **rest):
        """A black room with a square source of 1 m and 1000 pi cd/m2 x 1/pi in its ceiling: CIE 171:2006, 5.3, where
        closed forms give the floor."""
        s, black = scale, self.material("black", matt(0.0))
        walls = box((4 * s, 3 * s, 4 * s), (0.0, 1.5 * s, 0.0), inwards=True)
        self.thing("Room", walls, black, **rest)
        self.thing("Source", ceiling(s, s, 2.999999 * s), self.material("source", matt(0.0, 1000.0 * math.pi)), **rest)
        self.camera(translation=[c + d for c, d in zip((0.0, s, 1.9 * s), rest.get("translation", (0, 0, 0)))])

    def write(self, folder):
        if self.used:
            self.json["extensionsUsed"] = sorted(self.used)
        if self.data:
            self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + b"\0" * (-len(self.data) % 4)
        binary = struct.pack("<II", len(data), 0x004E4942) + data if data else b""
        with open(os.path.join(folder, self.name + ".glb"), "wb") as out:
            out.write(struct.pack("<III", 0x46546C67, 2, 20 + len(text) + len(binary)))
            out.write(struct.pack("<II", len(text), 0x4E4F534A) + text + binary)


SMALL, LARGE = {}, {}


def small(function):
    SMALL[function.__name__.replace("_", "-")] = function
    return function


def large(function):
    LARGE[function.__name__.replace("_", "-")] = function
    return function


def variants(**named):
    """Registers one scene for each name; the function takes the file and the value."""
    def register(function):
        for name, value in named.items():
            SMALL[name.replace("_", "-")] = lambda f, v=value: function(f, v)
        return function
    return register


# ---- reflectance ----
@variants(white_9999=0.9999, white_1=1.0, white_1_2=1.2)
def white(f, rho):
    f.room(rho, exitance=1.0)
    f.camera(translation=[0.0, 1.5, 2.0])


# ---- mirrors and glass ----
@small
def facing_mirrors(f):
    f.thing("Floor", floor(6, 6), f.material("grey", matt(0.5)))
    m = f.material("mirror", mirror(0.99))
    f.thing("Left mirror", quad((-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)), m)
    f.thing("Right mirror", quad((1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1)), m)
    f.light("Lamp", "point", 100.0, translation=[0.2, 1.0, 0.1])
    f.camera(translation=[0.0, 1.0, 0.9])


@small
def mirror_box(f):
    f.thing("Box", box((2, 2, 2), (0, 1, 0), inwards=True), f.material("perfect mirror", mirror(1.0)))
    f.light("Lamp", "point", 100.0, translation=[0.3, 1.2, 0.1])
    f.camera(translation=[0.0, 1.0, 0.9])


@small
def glass_trap(f):
    f.room(0.5)
    f.thing("Glass cube", box((0.5, 0.5, 0.5), (0, 0.3, 0)), f.material("glass", glass(1.5)))
    f.thing("Glow", sphere(0.05, (0, 0.3, 0), 12), f.material("glow", matt(0.0, 10000.0)))
    f.camera(translation=[0.0, 1.0, 2.0])


@variants(ior_1=1.0, ior_1_0001=1.0001, ior_4=4.0)
def ior(f, n):
    f.thing("Floor", floor(2, 2), f.material("grey", matt(0.5)))
    f.thing("Ball", sphere(0.2, (0, 0.4, 0)), f.material("glass", glass(n)))
    f.sun(1000.0)
    f.camera(translation=[0.0, 0.5, 1.5])


@small
def nested_glass(f):
    f.thing("Floor", floor(2, 2), f.material("grey", matt(0.5)))
    for name, radius, n in (("Outer", 0.3, 1.5), ("Middle", 0.2, 1.33), ("Inner", 0.1, 1.0)):
        f.thing(name, sphere(radius, (0, 0.4, 0), 24), f.material(name, glass(n)))
    f.sun(1000.0)
    f.camera(translation=[0.0, 0.5, 1.5])


@small
def inverted_glass(f):
    f.thing("Floor", floor(2, 2), f.material("grey", matt(0.5)))
    f.thing("Ball", sphere(0.3, (0, 0.4, 0), inwards=True), f.material("glass", glass(1.5)))
    f.sun(1000.0)
    f.camera(translation=[0.0, 0.5, 1.5])


@small
def glass_in_glass_touching(f):
    f.thing("Floor", floor(2, 2), f.material("grey", matt(0.5)))
    m = f.material("glass", glass(1.5))
    f.thing("Left", box((0.2, 0.4, 0.2), (-0.1, 0.2, 0)), m)
    f.thing("Right", box((0.2, 0.4, 0.2), (0.1, 0.2, 0)), m)
    f.thing("Across", box((0.3, 0.2, 0.1), (0, 0.2, 0)), m)
    f.sun(1000.0, 50.0)
    f.camera(translation=[0.0, 0.5, 1.5])


# ---- light of extreme strength, size and range ----
@small
def tiny_lamp(f):
    f.thing("Floor", floor(2, 2), f.material("black", matt(0.0)))
    side = 1e-4
    f.thing("Lamp", ceiling(side, side, 3.0), f.material("lamp", matt(0.0, 1000.0 / side ** 2)))
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def sun_and_standby(f):
    """Two closed rooms: one open to the sun above, one with nothing but a standby light."""
    f.thing("Court", box((4, 3, 4), (0, 1.5, 0), inwards=True)[:12] + floor(4, 4), f.material("court", matt(0.0)))
    f.thing("Cellar", box((4, 3, 4), (0, -1.6, 0), inwards=True), f.material("cellar", matt(0.0)))
    f.sun(100000.0)
    f.light("Standby", "point", 0.0225, translation=[0.0, -1.6, 0.0])
    f.camera(translation=[0.0, -1.0, 1.9])


@variants(strong_lamp=3e38, faint_lamp=1e-40)
def strength(f, candela):
    f.room(0.5)
    f.light("Lamp", "point", candela, translation=[0.0, 2.0, 0.0])
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def strong_surface(f):
    f.room(0.8)
    f.thing("Lamp", ceiling(1, 1, 2.9), f.material("lamp", matt(0.0, 3e38)))
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def slit(f):
    """A bright floor under a screen with a slit of 1 mm x 1 m; a receiver above it."""
    f.thing("Glow", floor(4, 4, -0.5), f.material("glow", matt(0.0, 1000.0 * math.pi)))
    black = f.material("black", matt(0.0))
    f.thing("Left screen", floor(2, 4, 0.0, -1.0005), black)
    f.thing("Right screen", floor(2, 4, 0.0, 1.0005), black)
    f.thing("Near screen", floor(0.001, 1.5, 0.0, 0.0, 1.25), black)
    f.thing("Far screen", floor(0.001, 1.5, 0.0, 0.0, -1.25), black)
    f.thing("Receiver", ceiling(0.2, 0.2, 1.0), black)
    f.camera(translation=[0.0, 0.5, 2.0])


@variants(grazing=0.0, setting_sun=0.53)
def grazing(f, degrees):
    f.thing("Table", floor(10, 10), f.material("grey", matt(0.0)))
    f.sun(100000.0, 0.1)
    f.json["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"] = {"angularDiameterDegrees": degrees}
    f.camera(translation=[0.0, 1.0, 4.0])


@small
def near_spot(f):
    """A spot of 100 cd that shines straight down from a millimetre above a table of 10 m, nearly to its horizon."""
    f.thing("Table", floor(10, 10), f.material("black", matt(0.0)))
    s = math.sqrt(0.5)
    f.light("Spot", "spot", 100.0, translation=[0.0, 0.001, 0.0], rotation=[-s, 0.0, 0.0, s])
    f.json["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"] = {"innerConeAngle": 1.5703, "outerConeAngle": 1.5707}
    f.camera(translation=[0.0, 1.0, 4.0])


@small
def leak(f):
    """Rooms that share a wall without thickness; a lamp in one."""
    for name, x in (("Lit room", -2.0), ("Dark room", 2.0)):
        f.room(0.5, (4.0, 3.0, 4.0), name, translation=[x, 0.0, 0.0])
    f.light("Lamp", "point", 500.0, translation=[-2.0, 2.0, 0.0])
    f.camera(translation=[2.0, 1.5, 1.5])


@variants(corner=0.0, corner_gap=1e-4)
def corner(f, gap):
    """A room of six walls that meet in their edges, or miss each other by `gap`; lamps outside, nothing inside."""
    white = f.material("white", matt(0.8))
    a = 1.0 - gap
    for name, axis, sign in (("+X", 0, 1), ("-X", 0, -1), ("+Y", 1, 1), ("-Y", 1, -1), ("+Z", 2, 1), ("-Z", 2, -1)):
        u, v = [k for k in range(3) if k != axis]
        def at(s, t):
            p = [0.0, 0.0, 0.0]
            p[axis], p[u], p[v] = float(sign), s * a, t * a
            return tuple(p)
        wall = quad(at(-1, -1), at(1, -1), at(1, 1), at(-1, 1))
        f.thing("Wall " + name, wall + list(reversed(wall)), white)
    for x in (-2.5, 2.5):
        f.light("Lamp", "point", 1000.0, translation=[x, 2.0, 1.5])
    f.camera(translation=[0.0, 0.0, 0.8])


# ---- triangles ----
@small
def slivers(f):
    """CIE 5.3 with a floor of strips 4 m x 4 um and the rest of it between them."""
    f.cie53()
    strips, thin = [], 4e-6
    for i in range(200):
        strips += floor(4.0, thin, 1e-5, 0.0, -1.9 + i * 0.019)
    f.thing("Strips", strips, f.material("strips", matt(0.0)))


@small
def sliver_floor(f):
    """One floor of 1,000 strips of 4 m x 4 mm that meet, halved along their diagonals."""
    f.thing("Floor", [p for i in range(1000) for p in floor(4.0, 0.004, 0.0, 0.0, -1.998 + 0.004 * i)],
            f.material("black", matt(0.0)))
    f.thing("Source", ceiling(1, 1, 3.0), f.material("source", matt(0.0, 1000.0 * math.pi)))
    f.camera(translation=[0.0, 1.0, 1.9])


@small
def coplanar(f):
    """The floor twice, a carpet a micrometre above, a picture on the wall without any distance."""
    f.room(0.0, (4.0, 3.0, 4.0))
    f.thing("Floor again", floor(4, 4), f.material("grey", matt(0.0)))
    f.thing("Carpet", floor(2, 2, 1e-6), f.material("red", matt(0.0)))
    f.thing("Picture", quad((-0.5, 1, -2), (0.5, 1, -2), (0.5, 2, -2), (-0.5, 2, -2)), f.material("picture", matt(0.0)))
    f.light("Lamp", "point", 100.0, translation=[0.0, 2.0, 0.0])
    f.camera(translation=[0.0, 1.5, 1.5])


@small
def interpenetrating(f):
    f.room(0.6)
    wood = f.material("wood", matt(0.5))
    f.thing("Standing", box((0.5, 0.5, 0.5), (0, 0.25, 0)), wood)
    f.thing("Touching", box((0.5, 0.5, 0.5), (0.5, 0.25, 0)), wood)
    f.thing("Twice", box((0.5, 0.5, 0.5), (0.5, 0.25, 0)), wood)
    f.thing("Crossing", box((0.5, 0.5, 0.5), (0.2, 0.6, 0.2)), wood)
    f.thing("Sunk", box((0.5, 0.5, 0.5), (-1, 0.0, 0)), wood)
    f.light("Lamp", "point", 100.0, translation=[0.0, 2.5, 0.0])
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def through_wall(f):
    f.room(0.6)
    f.thing("Box", box((0.5, 0.5, 0.5)), f.material("wood", matt(0.5)), translation=[0.0, 0.25, 0.0])
    f.light("Lamp", "point", 100.0, translation=[0.5, 2.5, 0.0])
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def zero_area(f):
    f.cie53()
    points = []
    for i in range(100):
        x = -1.9 + 0.038 * i
        points += [(x, 0.5, 0)] * 3 if i % 2 else [(x, 0.5, 0), (x + 0.01, 0.5, 0), (x + 0.02, 0.5, 0)]
    f.thing("No area", points, f.material("thin", matt(0.5)))
    f.thing("No extent", [(0, 1, 0)] * 3, f.material("nothing", matt(0.5, 100.0)))


@small
def not_numbers(f):
    f.cie53()
    points = []
    for i in range(10):
        points += [(0.1 * i, 0.5, 0.0), (NAN if i % 2 else INF, 0.5, 0.1), (0.1 * i, -INF if i % 3 else 0.6, 0.1)]
    f.thing("Not numbers", points, f.material("broken", matt(0.5)))


@small
def flat_scale(f):
    f.cie53()
    wood = f.material("wood", matt(0.0))
    f.thing("Flat", box((0.2, 0.2, 0.2)), wood, translation=[1.0, 1.0, 1.0], scale=[1.0, 0.0, 1.0])
    f.thing("Point", box((0.2, 0.2, 0.2)), wood, translation=[1.0, 1.5, 1.0], scale=[0.0, 0.0, 0.0])
    f.thing("Mirrored", box((0.2, 0.2, 0.2)), wood, translation=[-1.0, 1.0, 1.0], scale=[-1.0, 1.0, 1.0])


# ---- places and sizes ----
@small
def far_away(f):
    f.cie53(translation=[1e6, 2e6, 0.0])


@small
def far_vertices(f):
    """The same, but the distance is in the vertices, which have 6 cm steps there."""
    black = f.material("black", matt(0.5))
    f.thing("Room", box((4, 3, 4), (1e6, 1.5, 0.0), inwards=True), black)
    f.light("Lamp", "point", 100.0, translation=[1e6, 2.0, 0.0])
    f.camera(translation=[1e6, 1.5, 1.5])


@variants(millimetre=2.5e-4, ten_kilometres=3e3)
def scaled(f, scale):
    f.cie53(scale)


# ---- little or nothing there ----
@small
def empty(f):
    f.used = set()


@small
def no_light(f):
    f.room(0.5)
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def no_surfaces(f):
    f.light("Lamp", "point", 100.0)
    f.sun(1000.0)
    f.sky(1000.0)
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def only_sky(f):
    """A plate that looks up and one that looks down under an even sky."""
    f.thing("Plate", floor(1, 1), f.material("grey", matt(0.5)))
    f.thing("Underside", ceiling(1, 1, 0.5, 3.0), f.material("dark", matt(0.0)))
    f.sky(100.0)
    f.camera(translation=[0.0, 0.5, 1.5])


@small
def facets(f):
    """CIE 5.3 with every triangle of room and lamp three times: as it is, again, and turned round."""
    s, black = 1.0, f.material("black", matt(0.0))
    walls = box((4 * s, 3 * s, 4 * s), (0.0, 1.5 * s, 0.0), inwards=True)
    f.thing("Room", walls + walls + list(reversed(walls)), black)
    source = ceiling(s, s, 2.999999 * s)
    f.thing("Source", source + source + list(reversed(source)), f.material("source", matt(0.0, 1000.0 * math.pi)))
    f.camera(translation=[0.0, 1.0, 1.9])


@small
def only_a_mirror(f):
    f.thing("Mirror", floor(1, 1), f.material("mirror", mirror(0.9)))
    f.sun(1000.0)
    f.camera(translation=[0.0, 1.0, 1.0])


@small
def bad_cameras(f):
    f.room(0.5)
    f.thing("Block", box((0.5, 0.5, 0.5), (0, 0.25, 0)), f.material("block", matt(0.5)))
    f.light("Lamp", "point", 100.0, translation=[0.0, 2.5, 0.0])
    f.camera("No angle", lens={"yfov": 1e-30}, translation=[0.0, 1.5, 2.0])
    f.camera("Half turn", lens={"yfov": math.pi}, translation=[0.0, 1.5, 2.0])
    f.camera("No near plane", lens={"znear": 1e-30, "zfar": 1e-29}, translation=[0.0, 1.5, 2.0])
    f.camera("Flat", translation=[0.0, 1.5, 2.0], scale=[0.0, 0.0, 0.0])
    f.camera("Straight down", translation=[0.0, 2.9, 0.0], rotation=[-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])
    f.camera("Inside a solid", translation=[0.0, 0.25, 0.0])
    f.camera("In a wall", translation=[2.0, 1.5, 0.0])
    f.json["cameras"].append({"name": "Flat view", "type": "orthographic",
                              "orthographic": {"xmag": 1e-30, "ymag": 1e-30, "znear": 0.01, "zfar": 10.0}})
    f.node("Flat view", camera=len(f.json["cameras"]) - 1, translation=[0.0, 1.5, 2.0])


# ---- trees, textures ----
@small
def deep(f):
    """A thousand groups within each other, each turned a little, and a lamp and a box at the end."""
    f.room(0.5)
    turn = math.radians(0.36) / 2  # a full turn in all
    mesh = f.mesh("Box", box((0.2, 0.2, 0.2)), f.material("wood", matt(0.5)))
    f.used.add("KHR_lights_punctual")
    f.json.setdefault("extensions", {})["KHR_lights_punctual"] = {"lights": [{"name": "Lamp", "type": "point", "intensity": 100.0}]}
    first = len(f.json["nodes"])
    for i in range(1000):
        f.node("Level %d" % (i + 1), root=i == 0, translation=[0.0, 0.002, 0.0], rotation=[0.0, math.sin(turn), 0.0, math.cos(turn)],
               children=[first + i + 1])
    f.node("Box", root=False, mesh=mesh, translation=[0.0, -1.5, 0.0], extensions={"KHR_lights_punctual": {"light": 0}})
    f.camera(translation=[0.0, 1.5, 2.0])


@small
def cycle(f):
    f.json["nodes"] = [{"name": "A", "children": [1]}, {"name": "B", "children": [0]}]
    f.json["scenes"][0]["nodes"] = [0]


@small
def texture_1x1(f):
    f.cie53()
    texture = f.png(1, 1, [b"\x80"])
    f.thing("Carpet", floor(2, 2, 0.01), f.material("carpet", {"pbrMetallicRoughness": {
        "baseColorTexture": {"index": texture}, "metallicFactor": 0.0}}),
        uv=[(0, 1), (1, 1), (1, 0), (0, 1), (1, 0), (0, 0)])


@large
def texture_16k(f):
    f.room(0.5)
    side = 16384
    texture = f.png(side, side, (bytes([64 + (y >> 7 & 127)]) * side for y in range(side)))
    f.thing("Carpet", floor(2, 2, 0.01), f.material("carpet", {"pbrMetallicRoughness": {
        "baseColorTexture": {"index": texture}, "metallicFactor": 0.0}}),
        uv=[(0, 1), (1, 1), (1, 0), (0, 1), (1, 0), (0, 0)])
    f.light("Lamp", "point", 100.0, translation=[0.0, 2.5, 0.0])
    f.camera(translation=[0.0, 1.5, 2.0])


# ---- much of it ----
@large
def million_triangles(f):
    """A ball of 1,000,000 triangles in a room."""
    f.room(0.6)
    f.thing("Ball", sphere(0.8, (0.0, 1.2, 0.0), 1000), f.material("white", matt(0.7)))
    f.light("Lamp", "point", 100.0, translation=[1.2, 2.5, 1.0])
    f.camera(translation=[0.0, 1.5, 2.3])


@large
def one_beside_many(f):
    """A ball of 1,000,000 triangles beside 4,000 boxes of 12."""
    f.room(0.6, (20.0, 4.0, 20.0))
    f.thing("Ball", sphere(0.8, (0.0, 1.5, 0.0), 1000), f.material("white", matt(0.7)))
    mesh = f.mesh("Box", box((0.1, 0.2, 0.1)), f.material("wood", matt(0.5)))
    for i in range(4000):
        f.node("Box %d" % (i + 1), mesh=mesh, translation=[-9.5 + 19.0 * (i % 80) / 79, 0.1, -9.5 + 19.0 * (i // 80) / 49])
    f.light("Lamp", "point", 1000.0, translation=[4.0, 3.5, 3.0])
    f.camera(translation=[0.0, 1.5, 9.0])


@large
def thousand_lamps(f):
    f.room(0.6, (40.0, 4.0, 40.0))
    lamp = f.mesh("Lamp", ceiling(0.3, 0.3, 0.0), f.material("lamp", matt(0.0, 20000.0)))
    for i in range(1000):
        f.node("Lamp %d" % (i + 1), mesh=lamp, translation=[-19.0 + 38.0 * (i % 40) / 39, 3.95, -19.0 + 38.0 * (i // 40) / 24])
    f.camera(translation=[0.0, 1.5, 19.0])


@large
def ten_thousand_objects(f):
    f.room(0.6, (40.0, 4.0, 40.0))
    mesh = f.mesh("Box", box((0.15, 0.3, 0.15)), f.material("wood", matt(0.5)))
    for i in range(10000):
        f.node("Box %d" % (i + 1), mesh=mesh, translation=[-19.8 + 0.4 * (i % 100), 0.15 + 0.0001 * (i % 7), -19.8 + 0.4 * (i // 100)])
    for x in (-10.0, 10.0):
        for z in (-10.0, 10.0):
            f.light("Lamp", "point", 1000.0, translation=[x, 3.5, z])
    f.camera(translation=[0.0, 1.5, 19.0])


def main():
    folder, chosen = os.path.dirname(os.path.abspath(__file__)), SMALL
    if len(sys.argv) == 3 and sys.argv[1] == "--large":
        folder, chosen = sys.argv[2], LARGE
    elif len(sys.argv) != 1:
        sys.exit(__doc__)
    os.makedirs(folder, exist_ok=True)
    for name, function in chosen.items():
        file = File(name)
        function(file)
        file.write(folder)


main()
