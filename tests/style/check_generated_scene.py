#!/usr/bin/env python3
"""Runs scenes/sunlit_room/make_room.py on a copy and compares what it writes with the files that ship."""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

FILES = ["sunlit_room.gltf", "sunlit_room.bin", "wood_floor.png", "rug.png", "print_hills.png", "print_dusk.png"]


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


def main():
    source = os.path.join(sys.argv[1], "scenes", "sunlit_room")
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(os.path.join(source, "make_room.py"), folder)
        subprocess.run([sys.executable, os.path.join(folder, "make_room.py")], check=True)
        stale = [name for name in FILES if content(os.path.join(source, name)) != content(os.path.join(folder, name))]
    if stale:
        print("not what make_room.py writes: %s. Run it and commit the result." % ", ".join(stale))
        return 1
    print("%d files are as make_room.py writes them" % len(FILES))
    return 0


if __name__ == "__main__":
    sys.exit(main())
