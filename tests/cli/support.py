"""What the tests of atrium-cli share: running it, a small scene, a temporary folder."""
import base64
import json
import os
import struct
import subprocess
import tempfile
import unittest
import zlib

CLI = os.environ["ATRIUM_CLI"]
SOURCE = os.environ["ATRIUM_SOURCE_DIR"]
SHARED = os.environ.get("ATRIUM_SHARED_DIR", "")
ROOM = os.path.join(SOURCE, "scenes", "sunlit_room", "sunlit_room.gltf")


def quad(points):
    """Corner points, counter-clockwise from the front, as two triangles."""
    return [points[k] for k in (0, 1, 2, 0, 2, 3)]


def box_room(sky=False):
    """glTF text: an empty room of 4 x 2.5 x 3 m with a lamp of 1 m2 on the ceiling, all in one buffer, and two cameras."""
    x, y, z = 4.0, 2.5, 3.0
    walls = (quad([(0, 0, z), (x, 0, z), (x, 0, 0), (0, 0, 0)]) + quad([(0, y, 0), (x, y, 0), (x, y, z), (0, y, z)]) +
             quad([(0, 0, 0), (x, 0, 0), (x, y, 0), (0, y, 0)]) + quad([(x, 0, z), (0, 0, z), (0, y, z), (x, y, z)]) +
             quad([(0, 0, z), (0, 0, 0), (0, y, 0), (0, y, z)]) + quad([(x, 0, 0), (x, 0, z), (x, y, z), (x, y, 0)]))
    lamp = quad([(1.5, y - 0.01, 1.0), (2.5, y - 0.01, 1.0), (2.5, y - 0.01, 2.0), (1.5, y - 0.01, 2.0)])
    data = b"".join(struct.pack("<3f", *p) for p in walls + lamp)

    def accessor(points, offset):
        return {"bufferView": 0, "byteOffset": 12 * offset, "componentType": 5126, "count": len(points), "type": "VEC3",
                "min": [min(p[k] for p in points) for k in range(3)], "max": [max(p[k] for p in points) for k in range(3)]}

    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "nodes": [{"name": "Walls", "mesh": 0}, {"name": "Lamp", "mesh": 1},
                  {"name": "Camera one", "camera": 0, "translation": [2.0, 1.2, 2.8]},
                  {"name": "Camera two", "camera": 1, "translation": [3.5, 1.2, 2.8]}],
        "cameras": [{"name": "Front", "type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.01}},
                    {"name": "Side", "type": "perspective", "perspective": {"yfov": 1.2, "znear": 0.01}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                   {"primitives": [{"attributes": {"POSITION": 1}, "material": 1}]}],
        "materials": [{"name": "Paint", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0}},
                      {"name": "Light", "emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": {
                          "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                       "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1000.0}}}],
        "accessors": [accessor(walls, 0), accessor(lamp, len(walls))],
        "bufferViews": [{"buffer": 0, "byteLength": len(data), "target": 34962}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }
    return json.dumps(document)


def exr_values(path):
    """All samples of a scan line EXR of 32-bit floats in blocks of 16 lines, zip compressed, as atrium-cli writes it."""
    with open(path, "rb") as f:
        data = f.read()
    at, header = 8, {}
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    assert header[b"compression"] == b"\3", "zip"
    lines = struct.unpack("<4i", header[b"dataWindow"])[3] + 1
    blocks = (lines + 15) // 16
    values = []
    for offset in struct.unpack_from("<%dQ" % blocks, data, at + 1):
        size = struct.unpack_from("<i", data, offset + 4)[0]
        raw = bytearray(zlib.decompress(data[offset + 8:offset + 8 + size]))
        for i in range(1, len(raw)):  # differences of bytes, lower and upper halves apart
            raw[i] = (raw[i - 1] + raw[i] - 128) & 0xFF
        half = (len(raw) + 1) // 2
        plain = bytearray(len(raw))
        plain[0::2], plain[1::2] = raw[:half], raw[half:]
        values.extend(struct.unpack("<%df" % (len(plain) // 4), plain))
    return values


class CliTest(unittest.TestCase):
    """A temporary folder with room.gltf in it, and run()."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = self._folder.name
        self.room = self.write("room.gltf", box_room())

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8", newline="") as f:
            f.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as f:
            return f.read()

    def run_cli(self, *arguments, status=0, env=None):
        """Runs atrium-cli, checks its exit status and returns the finished process."""
        done = subprocess.run([CLI, *arguments], capture_output=True, text=True, timeout=280,
                              env=dict(os.environ, **(env or {})))
        self.assertEqual(done.returncode, status, "atrium-cli %s\nstdout: %s\nstderr: %s" %
                         (" ".join(arguments), done.stdout[-2000:], done.stderr[-2000:]))
        if status == 1:
            self.assertTrue(done.stderr.strip(), "an error without a message")
        self.assertNotIn("internal error", done.stderr)
        return done

    def refused(self, *arguments, says=()):
        """Exit status 1, nothing on stdout, and the message contains every text of `says`."""
        done = self.run_cli(*arguments, status=1)
        self.assertEqual(done.stdout, "")
        for text in says:
            self.assertIn(text, done.stderr)
        return done

    def rows(self, text):
        """CSV text as a list of dictionaries of numbers."""
        lines = text.splitlines()
        names = lines[0].split(",")
        return [dict(zip(names, (float(v) for v in line.split(",")))) for line in lines[1:]]

    def compare_keys(self, value, expected, where="statistics"):
        """Checks that a JSON object has the members of `expected`, of their types."""
        for name, kind in expected.items():
            self.assertIn(name, value, where)
            if isinstance(kind, dict):
                self.compare_keys(value[name], kind, where + "." + name)
            else:
                kinds = (int, float) if kind is float else (kind,)
                self.assertIsInstance(value[name], kinds, where + "." + name)
                self.assertFalse(kind is int and isinstance(value[name], bool), where + "." + name)
