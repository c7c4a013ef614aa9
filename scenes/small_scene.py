"""What the scripts of the small scenes share: shapes and materials in, one .glb file out. Same script, same bytes.

Metres, +Y up. Only the standard library is used; shapes come from sunlit_room/make_room.py.
"""
import json
import math
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "sunlit_room"))
from make_room import Part, facing, pbr, sub, turn  # noqa: E402,F401  (the scripts take them from here)


def glass(colour=(1.0, 1.0, 1.0), ior=1.5, solid=True):
    extensions = {"KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": ior}}
    if solid:
        extensions["KHR_materials_volume"] = {"thicknessFactor": 0.01}
    return pbr(colour, 0.0, extensions=extensions)


def glowing(colour, strength):
    """Emits strength x colour cd/m2 and reflects nothing."""
    return pbr((0.0, 0.0, 0.0), 1.0, emissiveFactor=list(colour),
               extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength}})


class Scene:
    """A glTF document in the making."""

    def __init__(self, name, materials, sky=None):
        self.name, self.sky = name, sky
        self.materials = list(materials.items())
        self.index = {material: i for i, (material, _) in enumerate(self.materials)}
        self.data = bytearray()
        self.views, self.accessors, self.meshes, self.nodes, self.cameras, self.lights = [], [], [], [], [], []
        self.triangles = 0

    def accessor(self, values, kind):
        if kind == "SCALAR":
            large = max(values) > 65535
            packed, component = struct.pack("<%d%s" % (len(values), "I" if large else "H"), *values), 5125 if large else 5123
            bounds = {}
        else:
            rounded = [[round(c, 6) + 0.0 for c in v] for v in values]
            packed = b"".join(struct.pack("<3f", *v) for v in rounded)
            component = 5126
            single = [struct.unpack("<3f", struct.pack("<3f", *v)) for v in rounded]
            bounds = {"min": [min(v[k] for v in single) for k in range(3)], "max": [max(v[k] for v in single) for k in range(3)]}
        self.data.extend(b"\0" * (-len(self.data) % 4))
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed),
                           "target": 34963 if kind == "SCALAR" else 34962})
        self.data.extend(packed)
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component, "count": len(values), "type": kind,
                               **(bounds if kind == "VEC3" and values is not None else {})})
        return len(self.accessors) - 1

    def mesh(self, name, *parts, shape=None):
        """Node-ready mesh; `shape` is the primitive that its triangles stand for (ATRIUM_shape)."""
        primitives = []
        for part in parts:
            primitives.append({"attributes": {"POSITION": self.accessor(part.position, "VEC3"),
                                              "NORMAL": self.accessor(part.normal, "VEC3")},
                               "indices": self.accessor(part.index, "SCALAR"), "material": self.index[part.material]})
            self.triangles += len(part.index) // 3
        body = {"name": name, "primitives": primitives}
        if shape:
            body["extensions"] = {"ATRIUM_shape": shape}
        self.meshes.append(body)
        return len(self.meshes) - 1

    def node(self, name, offset=None, rotation=None, **rest):
        entry = {"name": name}
        if offset:
            entry["translation"] = [round(c, 6) for c in offset]
        if rotation:
            entry["rotation"] = [round(c, 9) for c in rotation]
        entry.update(rest)
        self.nodes.append(entry)

    def sun(self, direction, lux, colour=(1.0, 1.0, 1.0), offset=(0.0, 2.0, 0.0)):
        self.lights.append({"name": "Sun", "type": "directional", "color": list(colour), "intensity": lux})
        self.node("Sun", offset, facing(direction), extensions={"KHR_lights_punctual": {"light": len(self.lights) - 1}})

    def camera(self, name, eye, target, degrees):
        self.cameras.append({"name": name, "type": "perspective",
                             "perspective": {"yfov": round(math.radians(degrees), 6), "aspectRatio": round(16 / 9, 6),
                                             "znear": 0.02}})
        self.node("Camera " + name[0].lower() + name[1:], eye, facing(sub(target, eye)), camera=len(self.cameras) - 1)

    def write(self, script):
        """Writes <script's folder>/<name of the folder>.glb."""
        folder = os.path.dirname(os.path.abspath(script))
        name = os.path.basename(script)[len("make_"):-len(".py")].replace("_", "-")
        self.write_to(os.path.join(folder, name + ".glb"), "scenes/%s/%s" % (name, os.path.basename(script)))

    def write_to(self, path, generator):
        held = {child for node in self.nodes for child in node.get("children", ())}
        document = {"asset": {"version": "2.0", "generator": generator,
                              "copyright": "The Atrium authors, Apache-2.0"},
                    "scene": 0, "scenes": [{"name": self.name, "nodes": [i for i in range(len(self.nodes)) if i not in held]}],
                    "nodes": self.nodes, "meshes": self.meshes, "cameras": self.cameras,
                    "materials": [{"name": key, **body} for key, body in self.materials],
                    "accessors": self.accessors, "bufferViews": self.views, "buffers": [{"byteLength": len(self.data)}]}
        root = {}
        if self.sky:
            root["ATRIUM_environment"] = {"skyRadiance": list(self.sky)}
        if self.lights:
            root["KHR_lights_punctual"] = {"lights": self.lights}
        if root:
            document["extensions"] = root
        used = set(root) | {e for m in self.meshes + self.cameras for e in m.get("extensions", {})}
        used |= {e for _, body in self.materials for e in body.get("extensions", {})}
        document["extensionsUsed"] = sorted(used)
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + b"\0" * (-len(self.data) % 4)
        with open(path, "wb") as out:
            out.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(data)))
            out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
            out.write(struct.pack("<II", len(data), 0x004E4942) + data)
        name = os.path.splitext(os.path.basename(path))[0]
        print("%s: %d triangles, %d nodes" % (name, self.triangles, len(self.nodes)), file=sys.stderr)
