#!/usr/bin/env python3
"""Kills the program's document, saving and autosave at random moments, and looks whether anything was lost.

  tests/kill/kills.py SUBJECT [--kills 200] [--seed 1] [--interval MS] [--keep FOLDER]

SUBJECT is build/release/tests/kill_subject. Each round starts it on the same project, lets it edit, save and autosave, kills it
with SIGKILL (half of the times inside a save or an autosave) and then holds against its log:
  1. the project is a whole file, and what it holds is a state that was being saved: the last confirmed one or a later one;
  2. the recovered file, if there is one, is whole and holds at least the last confirmed autosave;
  3. autosaves begin in time: never later than the work of four intervals, and some turns of the event loop, since the first edit that is not kept;
  4. no state mixes two edits; the next round opens what this one left, by the program's own reader, under the lock of the dead one.
The worst loss is printed: edits, and milliseconds of work, that neither file holds. Exit status 1 when anything was wrong.
"""
import argparse
import ctypes
import json
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib


def end_with_parent():
    """In the child: it is killed when this script ends, however that comes (prctl PR_SET_PDEATHSIG)."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)


# An autosave is late after as many edits beyond its time, one in each turn of the event loop, and as many intervals: the program's
# is 30 seconds and two minutes of work may be lost. Edits alone would blame a busy disk, time alone a busy processor.
LATE_TURNS = 125
LATE_INTERVALS = 4


def png(side, rng):
    """A picture that does not compress, so that writing a project takes a while."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + rng.randbytes(3 * side) for _ in range(side))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b""))


def make_project(path, rng):
    triangle = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<6f", 0, 0, 1, 0, 0, 1)
    image = png(400, rng)
    binary = triangle + image + b"\0" * (-(len(triangle) + len(image)) % 4)
    root = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                        {"buffer": 0, "byteOffset": 60, "byteLength": len(image)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "images": [{"bufferView": 2, "mimeType": "image/png"}],
        "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "nodes": [{"name": "First", "mesh": 0}, {"name": "Second", "mesh": 0}],
        "scenes": [{"nodes": [0, 1]}], "scene": 0,
    }
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<III", 0x46546C67, 2, 20 + len(text) + 8 + len(binary)) + struct.pack("<II", len(text), 0x4E4F534A) +
                     text + struct.pack("<II", len(binary), 0x004E4942) + binary)


def edit_in(path):
    """The edit that a project holds; raises ValueError when the file is not whole or mixes two states."""
    data = path.read_bytes()
    if len(data) < 20:
        raise ValueError(f"{len(data)} bytes")
    magic, version, length = struct.unpack_from("<III", data)
    if magic != 0x46546C67 or version != 2 or length != len(data):
        raise ValueError(f"header says {length} bytes, the file has {len(data)}")
    size, = struct.unpack_from("<I", data, 12)
    nodes = {node["name"]: node for node in json.loads(data[20:20 + size])["nodes"]}
    first, second = (int(nodes[name].get("translation", [0])[0]) for name in ("First", "Second"))
    if first != second:
        raise ValueError(f"mixes edits {first} and {second}")
    return first


def log_lines(path):
    text = path.read_text() if path.exists() else ""
    return [(line[0], int(line.split()[1]), int(line.split()[2])) for line in text.split("\n")[:-1]]


def newest(folder):
    files = sorted(folder.glob("*.atrium"), key=lambda p: p.stat().st_mtime_ns)
    return files[-1] if files else None


class Round:
    def __init__(self, options, folder, number, rng):
        self.options, self.folder, self.number, self.rng = options, folder, number, rng
        self.project, self.recovery, self.log = folder / "room.atrium", folder / "recovery", folder / "log"
        self.wrong = []

    def run(self):
        self.log.unlink(missing_ok=True)
        before = edit_in(self.project)
        left = newest(self.recovery)
        # An autosave that is older than the project would be asked about on saving; nobody answers here.
        fresh = left is not None and left.stat().st_mtime_ns > self.project.stat().st_mtime_ns + 2_000_000
        recover = fresh and self.rng.random() < 0.5
        start = edit_in(left) if recover else before
        arguments = [self.options.subject, self.project, self.recovery, self.log, str(self.options.interval), str(self.rng.getrandbits(31))]
        if recover:
            arguments.append("--recover")
        old = set(self.recovery.glob("*.atrium"))
        process = subprocess.Popen(arguments, stderr=subprocess.PIPE, preexec_fn=end_with_parent)
        inside = self.wait(process)
        process.send_signal(signal.SIGKILL)
        process.wait()
        complaint = process.stderr.read().decode()
        lines = log_lines(self.log)
        if process.returncode != -signal.SIGKILL or complaint.strip():
            self.wrong.append(f"it ended by itself ({process.returncode}): {complaint.strip()}")
        if not lines or lines[0][0] != "O":
            self.wrong.append("nothing was opened")
            return None
        if lines[0][1] != start:
            self.wrong.append(f"opened edit {lines[0][1]} instead of {start}")
        return self.check(lines, before, recover, left, old, inside)

    def wait(self, process):
        """Until the moment of the kill. True inside a save or an autosave, as far as the log tells."""
        inside = self.rng.random() < 0.5
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and process.poll() is None and not any(k == "E" for k, _, _ in log_lines(self.log)):
            time.sleep(0.002)
        time.sleep(self.rng.random() * 2.5 * self.options.interval / 1000)
        if inside:
            seen = len(log_lines(self.log))
            while time.monotonic() < deadline and process.poll() is None:
                if any(k in "BW" for k, _, _ in log_lines(self.log)[seen:]):
                    break
                time.sleep(0.0005)
            time.sleep(self.rng.random() * 0.02)
        return inside

    def check(self, lines, before, recover, left, old, inside):
        edits = [(n, t) for k, n, t in lines if k == "E"]
        last_edit, end = (edits[-1] if edits else (lines[0][1], lines[0][2]))
        confirmed = [n for k, n, _ in lines if k == "S"]
        begun = [n for k, n, _ in lines if k == "B"]
        kept = [n for k, n, _ in lines if k == "V"]
        # 1
        in_project = -1
        try:
            in_project = edit_in(self.project)
            least = confirmed[-1] if confirmed else before
            allowed = {least} | {n for n in begun if not confirmed or n >= confirmed[-1]}
            if in_project not in allowed:
                self.wrong.append(f"the project holds edit {in_project}, not one of {sorted(allowed)}")
        except (ValueError, KeyError, OSError) as e:
            self.wrong.append(f"the project is not whole: {e}")
        # 2
        in_recovery = -1
        ours = [p for p in self.recovery.glob("*.atrium") if p not in old]
        if ours:
            try:
                in_recovery = edit_in(ours[0])
            except (ValueError, KeyError, OSError) as e:
                self.wrong.append(f"the recovered file is not whole: {e}")
        elif recover and left.exists():
            in_recovery = edit_in(left)
        if kept and max(in_recovery, in_project) < kept[-1]:
            self.wrong.append(f"edit {kept[-1]} was kept, and only {max(in_recovery, in_project)} is there")
        # 3: an autosave is seen in every stretch of an interval with unsaved edits, unless one, or the project, is being written
        waiting_since, writing, saving, late = None, False, False, 0
        for k, n, t in lines:
            if k == "W":
                writing, waiting_since = True, None
            elif k == "V":
                writing = False
            elif k == "B":
                saving = True
            elif k == "S":
                waiting_since, saving = None, False
            elif k == "E" and waiting_since is None:
                waiting_since, late = t, 0
            elif k == "E" and not writing and not saving and t - waiting_since > self.options.interval:
                late += 1  # a turn of the event loop each; milliseconds say nothing on a busy machine
                if late > LATE_TURNS and t - waiting_since > LATE_INTERVALS * self.options.interval:
                    self.wrong.append(f"no autosave {late} edits after its time, {t - waiting_since} ms (edit {n})")
                    break
        held = max(in_project, in_recovery)
        first_lost = next((t for n, t in edits if n > held), end)
        return {"inside": inside, "edits": last_edit - lines[0][1], "lost": max(0, last_edit - held), "lost_ms": max(0, end - first_lost),
                "saves": len(confirmed), "autosaves": len(kept)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("subject", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--interval", type=int, default=300, help="of autosave, milliseconds (the program: 30000)")
    parser.add_argument("--keep", type=pathlib.Path, help="work here and leave everything")
    options = parser.parse_args()
    folder = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="atrium-kills-"))
    folder.chmod(0o700)
    (folder / "recovery").mkdir(parents=True, exist_ok=True)
    os.environ["HOME"] = os.environ["XDG_RUNTIME_DIR"] = str(folder)
    rng = random.Random(options.seed)
    make_project(folder / "room.atrium", rng)
    results, failures = [], 0
    started = time.monotonic()
    for number in range(options.kills):
        one = Round(options, folder, number, rng)
        result = one.run()
        for wrong in one.wrong:
            failures += 1
            print(f"kill {number + 1}: {wrong}")
        if result is not None:
            results.append(result)
        if rng.random() < 0.3:  # the user decided about what was offered
            for path in (folder / "recovery").iterdir():
                path.unlink()
    torn = len(list(folder.glob(".room.atrium.*.tmp")))
    lost = sorted(r["lost_ms"] for r in results)
    print(f"{options.kills} kills in {time.monotonic() - started:.0f} s, seed {options.seed}: {failures} failures; "
          f"{sum(r['edits'] for r in results)} edits, {sum(r['saves'] for r in results)} saves, "
          f"{sum(r['autosaves'] for r in results)} autosaves; {sum(r['inside'] for r in results)} kills aimed inside a write, "
          f"{torn} half-written files left beside the project")
    if lost:
        print(f"lost work: median {lost[len(lost) // 2]} ms, worst {lost[-1]} ms at an autosave every {options.interval} ms "
              f"(worst {max(r['lost'] for r in results)} edits)")
    if not options.keep:
        shutil.rmtree(folder, ignore_errors=True)
    return 1 if failures or len(results) < options.kills else 0


if __name__ == "__main__":
    sys.exit(main())
