#!/usr/bin/env python3
"""Runs the scripts of all scenes on a copy and compares what they write with the files that ship."""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

# Folder, script and what it writes.
SCENES = [
    ("sunlit_room", "make_room.py",
     ["sunlit_room.gltf", "sunlit_room.bin", "wood_floor.png", "rug.png", "print_hills.png", "print_dusk.png"]),
    ("ring", "make_ring.py", ["ring.glb"]),
    ("glass-ball", "make_glass_ball.py", ["glass-ball.glb"]),
    ("sun-mirror", "make_sun_mirror.py", ["sun-mirror.glb"]),
    ("lamp", "make_lamp.py", ["lamp.glb"]),
    ("empty-room", "make_empty_room.py", ["empty-room.glb"]),
    ("cabin", "make_cabin.py", ["cabin.glb", "drag.json", "edits.json"]),
    ("street", "make_street.py", ["street.glb", "drag.json", "edits.json"]),
    ("luminaires", "make_luminaires.py", ["narrow_downlight.ies", "wall_washer.ies", "linear_pendant.ies"]),
]


def content(path):
    """Bytes of a file; of a PNG its unpacked rows, for other versions of zlib pack them differently."""
    with open(path, "rb") as f:
        data = f.read()
    if not path.endswith(".png"):
        return data
    at, header, packed = 8, b"", b""
    while at < len(data):
        size, tag = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        header += body if tag == b"IHDR" else b""
        packed += body if tag == b"IDAT" else b""
        at += 12 + size
    return header + zlib.decompress(packed)


def stale_furniture(root, folder, files):
    """The library's pieces that its script does not write like that; it looks for the scenes' modules three folders up."""
    source = os.path.join(root, "resources", "library", "furniture")
    copy = os.path.join(folder, "resources", "library", "furniture")
    os.makedirs(copy)
    os.symlink(folder, os.path.join(folder, "scenes"))
    shutil.copy(os.path.join(source, "make_furniture.py"), copy)
    subprocess.run([sys.executable, os.path.join(copy, "make_furniture.py")], check=True)
    written = {name for name in os.listdir(copy) if name.endswith(".glb")}
    return ["furniture/" + name for name in sorted(written.union(files)) if name not in written or name not in files
            or content(os.path.join(source, name)) != content(os.path.join(copy, name))]


def main():
    source = os.path.join(sys.argv[1], "scenes")
    # The one with an image in it depends on the version of zlib.
    hard = sorted(f for f in os.listdir(os.path.join(source, "hard")) if f.endswith(".glb") and f != "texture-1x1.glb")
    SCENES.append(("hard", "make_hard.py", hard))
    furniture = sorted(f for f in os.listdir(os.path.join(sys.argv[1], "resources", "library", "furniture")) if f.endswith(".glb"))
    stale = []
    with tempfile.TemporaryDirectory() as folder:
        for shared in ("small_scene.py", "large_scene.py"):
            shutil.copy(os.path.join(source, shared), folder)
        for scene, script, _ in SCENES:
            os.mkdir(os.path.join(folder, scene))
            shutil.copy(os.path.join(source, scene, script), os.path.join(folder, scene))
        for scene, script, files in SCENES:
            subprocess.run([sys.executable, os.path.join(folder, scene, script)], check=True)
            stale += ["%s/%s" % (scene, name) for name in files
                      if content(os.path.join(source, scene, name)) != content(os.path.join(folder, scene, name))]
        stale += stale_furniture(sys.argv[1], folder, furniture)
    if stale:
        print("not what the script beside it writes: %s. Run it and commit the result." % ", ".join(stale))
        return 1
    print("%d files are as their scripts write them" % (len(furniture) + sum(len(files) for _, _, files in SCENES)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
