"""What the scripts of the large scenes share: thousands of high-level primitives as nodes that scale a few unit shapes.

A unit shape is stored once per material, its triangles once in all. Metres, +Y up, standard library only.
"""
import json
import math
import os
import sys

from small_scene import Part, Scene
from make_room import add, cross, dot, mul, quat_mul, rotate, sub, turn, unit  # noqa: F401  (the scripts take them from here)

SEGMENTS = 32  # as the program cuts curved primitives


def upward(a, b):
    """Quaternion that turns +y into the direction from a to b."""
    d = unit(sub(b, a))
    if d[1] < -0.999999:
        return [1.0, 0.0, 0.0, 0.0]
    axis = cross((0.0, 1.0, 0.0), d)
    q = [axis[0], axis[1], axis[2], 1.0 + d[1]]
    length = math.sqrt(sum(c * c for c in q))
    return [c / length for c in q]


def reflect(d, n):
    return sub(d, mul(n, 2.0 * dot(d, n)))


class LargeScene(Scene):
    """Nodes with parents, primitives by size, meshes that share their triangles between materials."""

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.units, self.stored, self.drawn = {}, {}, {}
        self.primitives = 0

    # ------------------------------------------------------------ nodes

    def node(self, name, offset=None, rotation=None, parent=None, scale=None, **rest):
        if scale:
            rest["scale"] = [round(c, 5) for c in scale]
        if rotation and max(abs(c) for c in rotation[:3]) < 1e-9:
            rotation = None
        offset = None if offset is None else [round(c, 5) for c in offset]
        super().node(name, offset, None if rotation is None else [round(c, 7) for c in rotation], **rest)
        index = len(self.nodes) - 1
        if parent is not None:
            self.nodes[parent].setdefault("children", []).append(index)
        if "mesh" in rest:
            triangles, parts = self.drawn[rest["mesh"]]
            self.triangles += triangles
            self.primitives += parts
        return index

    def group(self, name, parent=None, offset=None, rotation=None):
        return self.node(name, offset, rotation, parent)

    # ------------------------------------------------------------ primitives

    def box(self, name, parent, centre, size, material, rotation=None):
        return self.node(name, centre, rotation, parent, size, mesh=self.unit("box", material))

    def span(self, name, parent, low, high, material):
        """Box between two corners."""
        return self.box(name, parent, [(a + b) / 2 for a, b in zip(low, high)], [b - a for a, b in zip(low, high)], material)

    def rod(self, name, parent, a, b, radius, material, top=None, capped=True):
        """Cylinder from a to b, or a cone where the radius at b differs."""
        middle, length = mul(add(a, b), 0.5), math.sqrt(dot(sub(b, a), sub(b, a)))
        if top is None or top == radius:
            mesh = self.unit("cylinder", material, capped=capped)
        else:
            ratio = round(top / radius, 2)
            mesh = self.unit("cone", material, ratio, capped)
        return self.node(name, middle, upward(a, b), parent, (2 * radius, length, 2 * radius), mesh=mesh)

    def ball(self, name, parent, centre, radius, material, squash=1.0):
        return self.node(name, centre, None, parent, (2 * radius, 2 * radius * squash, 2 * radius), mesh=self.unit("sphere", material))

    def disc(self, name, parent, centre, radius, material, rotation=None):
        return self.node(name, centre, rotation, parent, (2 * radius, 2 * radius, 1.0), mesh=self.unit("disc", material))

    def sheet(self, name, parent, centre, size, material, rotation=None):
        """Rectangle that faces +z before it is turned."""
        return self.node(name, centre, rotation, parent, (size[0], size[1], 1.0), mesh=self.unit("polygon", material))

    def unit(self, kind, material, ratio=1.0, capped=True):
        key = (kind, material, ratio, capped)
        if key not in self.units:
            part, shape = Part(material), {"kind": kind}
            if kind == "box":
                part.box((0, 0, 0), (1, 1, 1))
                shape["size"] = [1, 1, 1]
            elif kind == "sphere":
                part.sphere((0, 0, 0), 0.5, SEGMENTS, SEGMENTS // 2)
                shape["radius"] = 0.5
            elif kind == "polygon":
                part.polygon([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)])
                shape["outer"] = [-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5]
            elif kind == "disc":
                part.lathe([(0.5, 0.0), (0.0, 0.0)], SEGMENTS, lambda p: (p[0], -p[2], p[1]))
                shape["radius"] = 0.5
            else:
                top = 0.5 * ratio
                profile = [(0.5, -0.5), (top, 0.5)]
                if capped:
                    profile = [(0.0, -0.5), (0.5, -0.5)] + profile + ([(top, 0.5), (0.0, 0.5)] if top > 0.0 else [])
                part.lathe(profile, SEGMENTS)
                shape.update({"radius": 0.5} if kind == "cylinder" else {"baseRadius": 0.5, "topRadius": top})
                shape.update({"height": 1, "capped": capped})
            label = "%s of %s" % (kind.capitalize(), material[0].lower() + material[1:])
            self.units[key] = self.mesh(label, part, shape=shape)
        return self.units[key]

    # ------------------------------------------------------------ meshes

    def mesh(self, name, *parts, shape=None):
        primitives, triangles = [], 0
        for part in parts:
            position, normal, index = self.welded(part)
            key = (tuple(position), tuple(normal), tuple(index))
            if key not in self.stored:
                self.stored[key] = (self.accessor(position, "VEC3"), self.accessor(normal, "VEC3"), self.accessor(index, "SCALAR"))
            p, n, i = self.stored[key]
            primitives.append({"attributes": {"POSITION": p, "NORMAL": n}, "indices": i, "material": self.index[part.material]})
            triangles += len(index) // 3
        body = {"name": name, "primitives": primitives}
        if shape:
            body["extensions"] = {"ATRIUM_shape": shape}
        self.meshes.append(body)
        self.drawn[len(self.meshes) - 1] = (triangles, len(parts))
        return len(self.meshes) - 1

    @staticmethod
    def welded(part):
        """Equal vertices once: lathes and grids repeat their seams."""
        seen, position, normal, remap = {}, [], [], []
        for p, n in zip(part.position, part.normal):
            p, n = tuple(round(c, 6) + 0.0 for c in p), tuple(round(c, 4) + 0.0 for c in n)
            if (p, n) not in seen:
                seen[(p, n)] = len(position)
                position.append(p)
                normal.append(unit(n))
            remap.append(seen[(p, n)])
        return position, normal, [remap[i] for i in part.index]

    # ------------------------------------------------------------ lights

    def light(self, name, parent, offset, direction=None, **body):
        """Point light, or a spot along `direction`."""
        self.lights.append({"name": name, **body})
        return self.node(name, offset, upward_spot(direction) if direction else None, parent,
                         extensions={"KHR_lights_punctual": {"light": len(self.lights) - 1}})

    def write(self, script):
        self.check()
        print("%d primitives" % self.primitives, file=sys.stderr)
        super().write(script)

    def check(self):
        names = [n["name"] for n in self.nodes]
        double = sorted({n for n in names if names.count(n) > 1}) if len(set(names)) < len(names) else []
        assert not double, "names that repeat: %s" % ", ".join(double[:10])


def upward_spot(direction):
    """Quaternion that turns -z into `direction`, which may be straight down."""
    return quat_mul(upward((0, 0, 0), direction), turn("x", 90.0))


def write_edits(script, name, edits):
    """Writes an edit script (atrium-cli edit --script) beside `script`, one edit or position a line."""
    lines = []
    for edit in edits:
        text = json.dumps(edit)
        if "positions" in edit:
            places = ",\n    ".join(json.dumps([round(c, 4) for c in p]) for p in edit["positions"])
            text = json.dumps({**edit, "positions": []}).replace("[]", "[\n    " + places + "]")
        lines.append("  " + text)
    with open(os.path.join(os.path.dirname(os.path.abspath(script)), name), "w", encoding="utf-8") as out:
        out.write('{"edits": [\n' + ",\n".join(lines) + "\n]}\n")


def along(a, b, count):
    """Places from a to b, both included."""
    return [add(a, mul(sub(b, a), k / (count - 1))) for k in range(count)]
