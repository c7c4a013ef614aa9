#!/usr/bin/env python3
"""Writes cabin.glb beside this script: a log cabin of three rooms at sunrise. Same script, same bytes.

Metres, +Y up. x runs from west to east, z from north to south, the floor is y = 0. Living room x -5 to 0.8, z -3.2 to 3.2;
bedroom x 0.95 to 5, z -0.6 to 3.2; bathroom x 0.95 to 5, z -3.2 to -0.75; ceilings at 2.6.
The script is long because it lists, room by room, all that a furnished house holds.
"""
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from small_scene import Part, facing, glass, glowing, pbr  # noqa: E402
from large_scene import LargeScene, add, along, mul, quat_mul, reflect, rotate, sub, turn, unit, write_edits  # noqa: E402

W, E, N, S, H = -5.0, 5.0, -3.2, 3.2, 2.6        # planes that the logs of the outer walls touch, and the ceiling
A0, A1 = 0.8, 0.95                               # partition between the living room and the others
B0, B1 = -0.75, -0.6                             # partition between bathroom and bedroom
LOG, COURSE, THICK = 0.125, 0.2, 0.25            # radius of a log, rise of a course, thickness of an outer wall
SUN = unit((-0.69, -0.1405, -0.724))             # 8 degrees high, from the south-east
MIRROR = (2.95, 1.45, B1 + 0.03)                 # of the bedroom
CONTAINER = (1.27, 0.9605, 2.28)                 # middle of the container on the dresser, where its drag starts
LEAN = 5.0                                       # degrees by which the mirror of the living room leans back
FACING = {"N": 0.0, "S": 180.0, "E": -90.0, "W": 90.0}

WOODS = ["Pine 1", "Pine 2", "Pine 3", "Pine 4"]
OAKS = ["Oak 1", "Oak 2", "Oak 3", "Oak 4"]
PAINTED = ["Painted wood 1", "Painted wood 2", "Painted wood 3"]
LOGS = ["Log 1", "Log 2", "Log 3"]
BOOKS = ["Book red", "Book blue", "Book green", "Book cream", "Book slate", "Book ochre", "Book brown"]


def tones(name, colour, count, spread, roughness):
    rng = random.Random(name)
    return {"%s %d" % (name, k + 1): pbr([c * (1 + spread * (2 * (k + 0.5 * rng.random()) / count - 1)) for c in colour], roughness)
            for k in range(count)}


def two_sided(material):
    return {**material, "doubleSided": True}


MATERIALS = {
    **tones("Pine", (0.58, 0.42, 0.25), 4, 0.13, 0.7), **tones("Oak", (0.40, 0.275, 0.165), 4, 0.14, 0.65),
    **tones("Log", (0.50, 0.34, 0.19), 3, 0.12, 0.75), **tones("Brick", (0.40, 0.19, 0.13), 3, 0.16, 0.9),
    **tones("Painted wood", (0.66, 0.67, 0.60), 3, 0.06, 0.8), **tones("Ceiling board", (0.66, 0.53, 0.37), 3, 0.08, 0.8),
    **tones("Slate", (0.24, 0.25, 0.26), 3, 0.14, 0.6), **tones("Tile", (0.66, 0.70, 0.70), 3, 0.05, 0.55),
    "Ceiling pine": pbr((0.66, 0.53, 0.37), 0.8), "Painted pine": pbr((0.66, 0.67, 0.60), 0.8),
    "Walnut": pbr((0.20, 0.125, 0.075), 0.6), "Bark": pbr((0.17, 0.12, 0.08), 0.95), "Plaster": pbr((0.74, 0.72, 0.67), 0.95),
    "Subfloor": pbr((0.12, 0.09, 0.06), 0.95), "Mortar": pbr((0.45, 0.43, 0.40), 0.95),
    "Cast iron": pbr((0.05, 0.05, 0.05), 0.8), "White enamel": pbr((0.76, 0.76, 0.74), 0.55),
    "Porcelain": pbr((0.78, 0.77, 0.74), 0.55), "Blue glaze": pbr((0.12, 0.20, 0.36), 0.55),
    "Green glaze": pbr((0.18, 0.30, 0.20), 0.55), "Terracotta": pbr((0.48, 0.25, 0.15), 0.85), "Leaf": two_sided(pbr((0.11, 0.22, 0.07), 0.8)),
    "Apple": pbr((0.45, 0.09, 0.06), 0.55), "Lemon": pbr((0.65, 0.50, 0.08), 0.6), "Wax": pbr((0.74, 0.68, 0.55), 0.7),
    "Wool red": pbr((0.40, 0.10, 0.08), 0.95), "Wool grey": pbr((0.34, 0.35, 0.36), 0.95), "Wool cream": pbr((0.66, 0.61, 0.50), 0.95),
    "Wool green": pbr((0.16, 0.25, 0.18), 0.95), "Linen": two_sided(pbr((0.70, 0.67, 0.60), 0.95)), "Leather": pbr((0.26, 0.15, 0.09), 0.7),
    "Towel": pbr((0.42, 0.55, 0.58), 0.95), "Paper": pbr((0.70, 0.66, 0.56), 0.95), "Print": pbr((0.34, 0.42, 0.44), 0.9),
    "Print warm": pbr((0.55, 0.38, 0.24), 0.9),
    "Book red": pbr((0.36, 0.08, 0.07), 0.7), "Book blue": pbr((0.09, 0.16, 0.29), 0.7), "Book green": pbr((0.10, 0.22, 0.14), 0.7),
    "Book cream": pbr((0.64, 0.58, 0.44), 0.7), "Book slate": pbr((0.21, 0.22, 0.24), 0.7), "Book ochre": pbr((0.50, 0.32, 0.11), 0.7),
    "Book brown": pbr((0.24, 0.14, 0.08), 0.7), "Gilt": pbr((0.50, 0.40, 0.20), 0.6),
    "Silver": pbr((0.93, 0.94, 0.94), 0.0, 1.0), "Chrome": pbr((0.62, 0.62, 0.63), 0.08, 1.0),
    "Brass": two_sided(pbr((0.86, 0.70, 0.40), 0.15, 1.0)), "Copper": two_sided(pbr((0.93, 0.60, 0.46), 0.1, 1.0)),
    "Steel": two_sided(pbr((0.70, 0.70, 0.71), 0.2, 1.0)), "Black steel": pbr((0.04, 0.04, 0.04), 0.7),
    "Container enamel": pbr((0.10, 0.24, 0.38), 0.55),
    "Pane": glass(solid=False), "Glass": glass(), "Green glass": glass((0.55, 0.86, 0.62)), "Amber glass": glass((0.95, 0.62, 0.25)),
    "Blue glass": glass((0.45, 0.65, 0.95)),
    "Bulb": glowing((1.0, 0.74, 0.46), 9000.0), "Small bulb": glowing((1.0, 0.72, 0.42), 12000.0),
    "Tube": glowing((1.0, 0.86, 0.68), 5000.0), "Globe": glowing((1.0, 0.82, 0.60), 2500.0), "Fire": glowing((1.0, 0.42, 0.12), 2500.0),
    "Flame": glowing((1.0, 0.62, 0.25), 8000.0),
}


def pieces(low, high, cuts):
    """What is left of low..high without the cuts."""
    out, at = [], low
    for a, b in sorted(cuts):
        if a > at:
            out.append((at, a))
        at = max(at, b)
    return out + ([(at, high)] if at < high else [])


# ---------------------------------------------------------------- the house

# Wall, middle along it, width, sill, head, panes
WINDOWS = [("Bedroom window", "E", 1.65, 1.30, 1.0, 2.2, False), ("Bathroom window", "E", -2.1, 0.64, 1.2, 2.0, False),
           ("Living room window", "S", -1.95, 1.50, 0.9, 2.1, True), ("Reading window", "S", -4.0, 0.9, 0.9, 2.1, True),
           ("West window", "W", -1.75, 1.0, 1.0, 2.0, True), ("Kitchen window", "N", -0.2, 1.1, 1.1, 2.1, True)]
FRONT_DOOR = (-0.35, 0.6, 2.1)                   # in the south wall
DOORWAYS = [("Bedroom doorway", -0.42, 0.36), ("Bathroom doorway", -2.05, -1.3)]
HEAD = 2.03                                      # of the doorways


def log_walls(s, house):
    group = s.group("Log walls", house)
    rng = random.Random(21)
    for side in "ESWN":
        along_x = side in "NS"
        plane = {"E": E + LOG, "W": W - LOG, "N": N - LOG, "S": S + LOG}[side]
        low, high = (W - 0.42, E + 0.42) if along_x else (N - 0.07, S + 0.07)
        gaps = {"E": [(B0, B1)], "N": [(A0, A1)], "S": [(A0, A1)], "W": []}[side]  # where partitions stand
        holes = [(m - w / 2, m + w / 2, y0, y1) for _, at, m, w, y0, y1, _ in WINDOWS if at == side]
        holes += [(FRONT_DOOR[0], FRONT_DOOR[1], -0.01, FRONT_DOOR[2])] if side == "S" else []
        wall = s.group("Log wall %s" % {"E": "east", "W": "west", "N": "north", "S": "south"}[side], group)
        for k in range(14 if along_x else 13):
            y = COURSE * k + (0.0 if along_x else COURSE / 2)
            cuts = [(a, b) for a, b, y0, y1 in holes if y0 < y < y1] + gaps
            for i, (a, b) in enumerate(pieces(low, high, cuts)):
                p, q = ((a, y, plane), (b, y, plane)) if along_x else ((plane, y, a), (plane, y, b))
                s.rod("Log %s %d.%d" % (side, k + 1, i + 1), wall, p, q, LOG, rng.choice(LOGS))


def frame(s, name, parent, width, height, depth, material, inside, outside, sill=True):
    """Lining of an opening through a wall, with casings; local x along the wall, z into the room, y = 0 the sill."""
    t, x = 0.03, width / 2
    mid, deep = -depth / 2, depth + 0.02
    for tag, sx in (("left", -1), ("right", 1)):
        s.box("%s jamb %s" % (name, tag), parent, (sx * (x - t / 2), height / 2, mid), (t, height, deep), material)
        for face, z in ((" inside", 0.012), (" outside", -depth - 0.012)):
            if (inside if z > 0 else outside):
                s.box("%s casing %s%s" % (name, tag, face), parent, (sx * (x + 0.035), height / 2, z), (0.09, height + 0.16, 0.024), material)
    s.box("%s head" % name, parent, (0, height - t / 2, mid), (width - 2 * t, t, deep), material)
    if sill:
        s.box("%s sill" % name, parent, (0, t / 2, mid + 0.03), (width - 2 * t, t, deep + 0.06), material)
    for face, z in ((" inside", 0.012), (" outside", -depth - 0.012)):
        if (inside if z > 0 else outside):
            s.box("%s casing top%s" % (name, face), parent, (0, height + 0.035, z), (width - 0.021, 0.09, 0.0238), material)
            if sill:
                s.box("%s casing bottom%s" % (name, face), parent, (0, -0.035, z), (width - 0.021, 0.09, 0.0238), material)


def windows(s, house):
    group = s.group("Windows", house)
    cloth = curtain(0.30, 1.55)
    for name, side, mid, width, y0, y1, panes in WINDOWS:
        offset = {"E": (E, y0, mid), "W": (W, y0, mid), "N": (mid, y0, N), "S": (mid, y0, S)}[side]
        window = s.group(name, group, offset, turn("y", FACING[side]))
        height = y1 - y0
        frame(s, name, window, width, height, THICK, "Painted pine", True, True)
        if panes:
            z, b = -0.13, 0.045
            x0, x1, low, high = -width / 2 + 0.03, width / 2 - 0.03, 0.03, height - 0.03
            for tag, x in (("left", x0 + b / 2), ("middle", 0.0), ("right", x1 - b / 2)):
                s.box("%s stile %s" % (name, tag), window, (x, height / 2, z), (b, high - low, b), "Painted pine")
            for i, (a, c) in enumerate(((x0 + b, -b / 2), (b / 2, x1 - b))):
                for tag, y in (("bottom", low + b / 2), ("top", high - b / 2)):
                    s.box("%s rail %s %d" % (name, tag, i + 1), window, ((a + c) / 2, y, z), (c - a, b, b - 0.002), "Painted pine")
                s.box("%s bar %d" % (name, i + 1), window, ((a + c) / 2, height * 0.6, z), (c - a, 0.022, 0.03), "Painted pine")
                for tag, ya, yb in (("lower", low + b, height * 0.6 - 0.011), ("upper", height * 0.6 + 0.011, high - b)):
                    s.sheet("%s pane %s %d" % (name, tag, i + 1), window, ((a + c) / 2, (ya + yb) / 2, z), (c - a, yb - ya), "Pane")
            s.rod("%s knob" % name, window, (0.0, height * 0.45, z + 0.02), (0.0, height * 0.45, z + 0.055), 0.012, "Brass", 0.018)
        if side == "S" or name == "Bedroom window":
            rod = height + 0.17
            s.rod("%s curtain rod" % name, window, (-width / 2 - 0.42, rod, 0.09), (width / 2 + 0.42, rod, 0.09), 0.012, "Black steel")
            for tag, sx in (("left", -1), ("right", 1)):
                s.rod("%s finial %s" % (name, tag), window, (sx * (width / 2 + 0.415), rod, 0.09), (sx * (width / 2 + 0.455), rod, 0.09), 0.016, "Walnut", 0.024)
                s.box("%s bracket %s" % (name, tag), window, (sx * (width / 2 + 0.2), rod, 0.04), (0.02, 0.02, 0.08), "Black steel")
                s.node("%s curtain %s" % (name, tag), (sx * (width / 2 + 0.23), rod - 1.56, 0.09), parent=window,
                       mesh=s.mesh("Curtain", cloth))


def curtain(width, height, steps=40, folds=5):
    cloth, rows = Part("Linen"), []
    for k in range(4):
        row = []
        for i in range(steps + 1):
            t = i / steps
            swing = 2 * math.pi * folds
            row.append(((width * (t - 0.5), height * k / 3, 0.03 * math.sin(swing * t)), (-0.03 * swing / width * math.cos(swing * t), 0.0, 1.0)))
        rows.append(list(reversed(row)))
    cloth.grid(rows, lambda p: p)
    return cloth


def planks(s, name, parent, place, low, high, y0, y1, materials, rng, holes=(), step=0.115):
    """Upright boards side by side; place(a, b, y0, y1) gives the corners of one."""
    count = round((high - low) / step)
    width = (high - low) / count
    n = 0
    for k in range(count):
        a, b = low + k * width, low + (k + 1) * width
        cut = [(p, q, top) for p, q, top in holes if p < b - 1e-6 and q > a + 1e-6]
        parts = [(a, b, y0)]
        if cut:
            p, q, top = cut[0]
            parts = [(a, min(b, p), y0), (max(a, q), b, y0), (max(a, p), min(b, q), top)]
        for u, v, bottom in parts:
            if v - u > 0.006:
                n += 1
                s.span("%s %d" % (name, n), parent, *place(u, v, bottom, y1), rng.choice(materials))


def partitions(s, house):
    group = s.group("Partitions", house)
    rng = random.Random(22)
    t = 0.015
    holes = [(a, b, HEAD) for _, a, b in DOORWAYS]
    low, high, top = N - 0.1, S + 0.1, H + 0.01
    for i, (a, b) in enumerate(pieces(low, high, [(a, b) for a, b, _ in holes])):
        s.span("Partition core %d" % (i + 1), group, (A0 + t, 0, a), (A1 - t, top, b), "Plaster")
    for i, (a, b, _) in enumerate(holes):
        s.span("Partition core above doorway %d" % (i + 1), group, (A0 + t, HEAD, a), (A1 - t, top, b), "Plaster")
    s.span("Partition core between bath and bed", group, (A1 - t, 0, B0 + t), (E + 0.1, top, B1 - t), "Plaster")
    planks(s, "Living room plank", s.group("Living room planks", group), lambda a, b, y0, y1: ((A0, y0, a), (A0 + t, y1, b)),
           N - 0.06, S + 0.06, 0.0, H, WOODS, rng, holes)
    planks(s, "Bedroom plank west", s.group("Bedroom planks west", group), lambda a, b, y0, y1: ((A1 - t, y0, a), (A1, y1, b)),
           B1, S + 0.06, 0.0, H, PAINTED, rng, holes)
    planks(s, "Bedroom plank north", s.group("Bedroom planks north", group), lambda a, b, y0, y1: ((a, y0, B1 - t), (b, y1, B1)),
           A1, E + 0.06, 0.0, H, WOODS, rng)
    planks(s, "Bathroom plank west", s.group("Bathroom planks west", group), lambda a, b, y0, y1: ((A1 - t, y0, a), (A1, y1, b)),
           N - 0.06, B0, 0.0, H, PAINTED, rng, holes)
    bath = s.group("Bathroom tiles", group)
    s.span("Bathroom plaster south", bath, (A1, 1.25, B0), (E + 0.06, H, B0 + t), "Plaster")
    columns = 26
    width = (E - A1) / columns
    for i in range(columns):
        for j in range(8):
            a, y = A1 + i * width, 0.155 * j
            s.span("Wall tile %d.%d" % (i + 1, j + 1), bath, (a + 0.0015, y + 0.0015, B0), (a + width - 0.0015, y + 0.1535, B0 + t),
                   rng.choice(["Tile 1", "Tile 2", "Tile 3"]))
    s.span("Tile rail", bath, (A1, 1.24, B0 - 0.012), (E + 0.05, 1.262, B0 + t - 0.001), "Walnut")
    for name, a, b in DOORWAYS:
        door = s.group(name, house, (A0, 0.0, (a + b) / 2), turn("y", -90.0))
        frame(s, name, door, b - a, HEAD, A1 - A0, "Walnut", True, True, sill=False)
        s.box(name + " threshold", door, (0, 0.004, -(A1 - A0) / 2), (b - a - 0.062, 0.02, A1 - A0 + 0.02), "Walnut")
    # Doors of boards: the one to the bedroom stands open along the partition, the front door is shut.
    a, b, top = FRONT_DOOR
    for name, width, height, offset, angle in (("Bedroom door", 0.71, 1.985, (A1 + 0.03, 0.015, 0.31), -6.0),
                                               ("Bathroom door", 0.68, 1.985, (A1 + 0.03, 0.015, -2.0), 6.0),
                                               ("Front door", b - a - 0.05, top - 0.01, (b - 0.025, -0.005, S + 0.10), 180.0)):
        door = s.group(name, house, offset, turn("y", angle))
        count = 6
        for k in range(count):
            w = width / count
            s.box("%s board %d" % (name, k + 1), door, ((k + 0.5) * w, height / 2, 0.0), (w, height, 0.03), WOODS[(k * 3) % 4])
        for k, y in enumerate((0.22, 1.0, height - 0.22)):
            s.box("%s batten %d" % (name, k + 1), door, (width / 2, y, 0.022), (width - 0.08, 0.10, 0.014), "Walnut")
        for tag, z in (("front", 0.05), ("back", -0.05)):
            s.rod("%s knob %s" % (name, tag), door, (width - 0.06, 1.13, z), (width - 0.06, 1.13, z * 1.5), 0.018, "Brass", 0.027)
            s.rod("%s spindle %s" % (name, tag), door, (width - 0.06, 1.13, 0.0), (width - 0.06, 1.13, z), 0.009, "Brass")
    door = s.group("Front door frame", house, ((a + b) / 2, 0.0, S), turn("y", 180.0))
    # Two frames, before and behind the leaf: no surface runs from the sun into the room.
    frame(s, "Front door frame", door, b - a, top, 0.075, "Walnut", True, False, sill=False)
    outer = s.group("Front door outer frame", door, (0.0, 0.0, -0.125))
    frame(s, "Front door outer frame", outer, b - a, top, THICK - 0.125, "Walnut", False, True, sill=False)
    for tag, z0, z1 in (("inside", -0.085, 0.0), ("below", -0.115, -0.085), ("outside", -THICK, -0.115)):
        s.span("Front door threshold " + tag, door, (-(b - a) / 2 + 0.03, -0.02, z0), ((b - a) / 2 - 0.03, 0.004 if tag == "below" else 0.012, z1), "Walnut")


def floors(s, house):
    rng = random.Random(23)
    s.span("Subfloor", house, (W - 0.25, -0.08, N - 0.25), (E + 0.25, -0.022, S + 0.25), "Subfloor")
    s.span("Roof deck", house, (W - 0.45, H + 0.02, N - 0.45), (E + 0.45, H + 0.14, S + 0.45), "Ceiling pine")
    for room, x0, x1, z0, z1, step in (("Living room", W - 0.09, A0 + 0.014, N - 0.09, S + 0.09, 0.15),
                                       ("Bedroom", A0 + 0.015, E + 0.09, B1 - 0.014, S + 0.09, 0.165)):
        group = s.group(room + " floor", house)
        count = round((x1 - x0) / step)
        width, n = (x1 - x0) / count, 0
        for k in range(count):
            joint = z0 + (z1 - z0) * (0.3 + 0.4 * rng.random())
            for a, b in ((z0, joint), (joint, z1)):
                n += 1
                s.span("%s floor board %d" % (room, n), group, (x0 + k * width + 0.001, -0.022, a + 0.001),
                       (x0 + (k + 1) * width - 0.001, 0.0, b - 0.001), rng.choice(OAKS))
    group = s.group("Bathroom floor", house)
    x0, z0, nx, nz = A0 + 0.015, N - 0.09, 14, 8
    dx, dz = (E + 0.09 - x0) / nx, (B0 + 0.014 - z0) / nz
    for i in range(nx):
        for j in range(nz):
            s.span("Floor tile %d.%d" % (i + 1, j + 1), group, (x0 + i * dx + 0.0015, -0.022, z0 + j * dz + 0.0015),
                   (x0 + (i + 1) * dx - 0.0015, 0.0, z0 + (j + 1) * dz - 0.0015), rng.choice(["Slate 1", "Slate 2", "Slate 3"]))
    for room, x0, x1, z0, z1 in (("Living room", W - 0.09, A0 + 0.014, N - 0.09, S + 0.09), ("Bedroom", A1 - 0.014, E + 0.09, B1 - 0.014, S + 0.09),
                                 ("Bathroom", A1 - 0.014, E + 0.09, N - 0.09, B0 + 0.014)):
        group = s.group(room + " ceiling", house)
        count = round((z1 - z0) / 0.16)
        width = (z1 - z0) / count
        for k in range(count):
            s.span("%s ceiling board %d" % (room, k + 1), group, (x0, H, z0 + k * width), (x1, H + 0.02, z0 + (k + 1) * width),
                   rng.choice(["Ceiling board 1", "Ceiling board 2", "Ceiling board 3"]))
    beams = s.group("Beams", house)
    for k, x in enumerate((-4.3, -2.9, -1.5, -0.1)):
        s.rod("Beam living room %d" % (k + 1), beams, (x, H - 0.085, N - 0.1), (x, H - 0.085, S + 0.1), 0.1, LOGS[k % 3])
    for k, z in enumerate((0.25, 1.45, 2.65)):
        s.rod("Beam bedroom %d" % (k + 1), beams, (A1 - 0.01, H - 0.075, z), (E + 0.1, H - 0.075, z), 0.09, LOGS[k % 3])


# ---------------------------------------------------------------- things


def tumbler():
    p = Part("Glass")
    p.lathe([(0.0, 0.0), (0.030, 0.0), (0.030, 0.0), (0.036, 0.10), (0.036, 0.10), (0.0335, 0.10), (0.0335, 0.10), (0.028, 0.014),
             (0.0, 0.010)], 32)
    return p


def bottle(material, high=0.28):
    """Solid: outer skin up, over the rim, inner skin down."""
    p = Part(material)
    k = high / 0.28
    outer = [(0.034, 0.0), (0.037, 0.006), (0.038, 0.02), (0.038, 0.15), (0.034, 0.175), (0.022, 0.20), (0.015, 0.22), (0.014, 0.28)]
    inner = [(r - 0.003, y) for r, y in reversed(outer[3:])]
    shape = [(0.0, 0.0), outer[0], outer[0]] + outer[1:] + [outer[-1], inner[0], inner[0]] + inner[1:] + [(0.035, 0.02), (0.0, 0.014)]
    p.lathe([(r, y * k) for r, y in shape], 32)
    return p


def vase(material):
    p = Part(material)
    outer = [(0.042, 0.0), (0.055, 0.02), (0.066, 0.07), (0.066, 0.11), (0.052, 0.17), (0.040, 0.21), (0.042, 0.235), (0.055, 0.26)]
    inner = [(r - 0.005, y) for r, y in reversed(outer[1:])]
    p.lathe([(0.0, 0.0), outer[0], outer[0]] + outer[1:] + [outer[-1], inner[0], inner[0]] + inner[1:] + [(0.034, 0.016), (0.0, 0.016)], 32)
    return p


def bowl(material, radius, height, segments=32, steps=7):
    """Of sheet metal or clay, open above."""
    p = Part(material)
    turnings = [k / steps * math.pi / 2 for k in range(steps + 1)]
    outer = [(radius * (0.35 + 0.65 * math.sin(a)), height * (1 - math.cos(a))) for a in turnings]
    inner = [(r - 0.004, y + 0.004 * (1 - k / steps)) for k, (r, y) in enumerate(outer)]
    p.lathe([(0.0, 0.0), outer[0], outer[0]] + outer[1:] + [outer[-1], inner[-1], inner[-1]] + list(reversed(inner))[1:] + [(0.0, 0.004)], segments)
    return p


def plate(radius, material="Porcelain"):
    p = Part(material)
    p.lathe([(0.0, 0.0), (0.55 * radius, 0.0), (0.55 * radius, 0.0), (radius, 0.018), (radius, 0.018), (radius, 0.022), (radius, 0.022),
             (0.6 * radius, 0.006), (0.6 * radius, 0.006), (0.0, 0.005)], 32)
    return p


def cup(material):
    p = Part(material)
    p.lathe([(0.0, 0.0), (0.024, 0.0), (0.024, 0.0), (0.036, 0.03), (0.04, 0.08), (0.04, 0.08), (0.037, 0.08), (0.037, 0.08), (0.033, 0.032),
             (0.02, 0.006), (0.0, 0.006)], 24)
    handle = [(0.038 + 0.022 * math.sin(math.pi * k / 5), 0.018 + 0.045 * k / 5, 0.0) for k in range(6)]
    for a, b in zip(handle, handle[1:]):
        d = sub(b, a)
        length = math.sqrt(sum(c * c for c in d))
        y = mul(d, 1 / length)
        x = (y[1], -y[0], 0.0)
        p.tube(0.004, 0.0, length, 6, lambda q, a=a, x=x, y=y: add(a, add(add(mul(x, q[0]), mul(y, q[1])), (0.0, 0.0, q[2]))))
    return p


def cushion(s, name, parent, offset, size, radius, material, rotation=None, steps=2):
    p = Part(material)
    p.cushion((0, 0, 0), size, radius, steps)
    return s.node(name, offset, rotation, parent, mesh=s.mesh(name, p))


def things(s):
    """Meshes that stand in several places."""
    m = {"tumbler": s.mesh("Tumbler", tumbler()), "plate": s.mesh("Plate", plate(0.13)), "small plate": s.mesh("Small plate", plate(0.09)),
         "blue plate": s.mesh("Blue plate", plate(0.13, "Blue glaze")), "copper bowl": s.mesh("Copper bowl", bowl("Copper", 0.11, 0.07)),
         "brass bowl": s.mesh("Brass bowl", bowl("Brass", 0.07, 0.045)), "steel bowl": s.mesh("Steel bowl", bowl("Steel", 0.12, 0.08)),
         "clay bowl": s.mesh("Clay bowl", bowl("Green glaze", 0.14, 0.08, 32, 6)), "small bowl": s.mesh("Small bowl", bowl("Porcelain", 0.075, 0.05, 24, 5))}
    for colour in ("Porcelain", "Blue glaze", "Green glaze"):
        m["cup " + colour] = s.mesh("Cup " + colour.lower(), cup(colour))
    for colour in ("Glass", "Green glass", "Amber glass", "Blue glass"):
        m["bottle " + colour] = s.mesh("Bottle " + colour.lower(), bottle(colour))
        m["flask " + colour] = s.mesh("Flask " + colour.lower(), bottle(colour, 0.19))
        m["vase " + colour] = s.mesh("Vase " + colour.lower(), vase(colour))
    return m


def chair(s, name, parent, offset, yaw, seat="Oak 2"):
    """Faces +z."""
    g = s.group(name, parent, offset, turn("y", yaw))
    s.box(name + " seat", g, (0, 0.45, 0), (0.42, 0.03, 0.42), seat)
    for i, (x, z) in enumerate(((-1, 1), (1, 1), (-1, -1), (1, -1))):
        s.rod("%s leg %d" % (name, i + 1), g, (x * 0.185, 0.0, z * 0.19), (x * 0.165, 0.435, z * 0.165), 0.018, "Oak 1")
    for i, (z, y) in enumerate(((0.18, 0.18), (-0.18, 0.22))):
        s.rod("%s rung %d" % (name, i + 1), g, (-0.176, y, z), (0.176, y, z), 0.011, "Oak 1")
    for i, x in enumerate((-0.175, 0.175)):
        s.rod("%s post %d" % (name, i + 1), g, (x, 0.465, -0.185), (x, 0.945, -0.254), 0.019, "Oak 1", 0.0133)
    for i in range(5):
        x = -0.11 + 0.055 * i
        s.box("%s spindle %d" % (name, i + 1), g, (x, 0.6525, -0.213), (0.022, 0.376, 0.010), "Oak 1", turn("x", -7.6))
    s.box(name + " top rail", g, (0, 0.865, -0.243), (0.33, 0.075, 0.02), "Oak 1", turn("x", -8.0))


def books(s, name, parent, x0, x1, y, z, room, rng):
    """A row along x whose spines lie at z; the last ones lean or lie now and then."""
    x, n, stop = x0, 0, x0 + (x1 - x0) * (0.72 + 0.26 * rng.random())
    while True:
        thick, tall, deep = 0.014 + 0.02 * rng.random(), room * (0.62 + 0.28 * rng.random()), 0.15 + 0.05 * rng.random()
        if x + thick > stop:
            break
        n += 1
        cover = rng.choice(BOOKS)
        label = "Gilt" if cover != "Book cream" and rng.random() < 0.6 else "Paper" if cover != "Book cream" else "Book red"
        s.span("%s %d" % (name, n), parent, (x, y, z - deep), (x + thick - 0.0015, y + tall, z), cover)
        high = y + tall * (0.62 + 0.2 * rng.random())
        s.span("%s %d label" % (name, n), parent, (x + 0.002, high, z - 0.001), (x + thick - 0.0035, high + 0.035, z + 0.0008), label)
        x += thick
    return x


def bookcase(s, name, parent, offset, yaw, width, levels, height, material, seed):
    """Faces +z, its back at z = 0; levels are the tops of its shelves."""
    g = s.group(name, parent, offset, turn("y", yaw))
    rng = random.Random(seed)
    depth, t = 0.28, 0.022
    for tag, x in (("left", -width / 2 + t / 2), ("right", width / 2 - t / 2)):
        s.box("%s side %s" % (name, tag), g, (x, height / 2, depth / 2), (t, height, depth), material)
    s.box(name + " back", g, (0, height / 2, 0.006), (width - 2 * t, height - 0.002, 0.01), material)
    s.box(name + " top", g, (0, height + t / 2 - 0.001, depth / 2), (width + 0.03, t, depth + 0.02), material)
    for i, y in enumerate(levels):
        s.box("%s shelf %d" % (name, i + 1), g, (0, y - t / 2, depth / 2 + 0.005), (width - 2 * t, t, depth - 0.012), material)
        room = (levels[i + 1] - t if i + 1 < len(levels) else height) - y
        row = s.group("%s books %d" % (name, i + 1), g)
        books(s, "%s book %d" % (name, i + 1), row, -width / 2 + t + 0.004, width / 2 - t - 0.004, y, depth - 0.045, room, rng)
    s.box(name + " plinth", g, (0, (levels[0] - t) / 2, depth - 0.03), (width - 2 * t, levels[0] - t, 0.02), material)
    return g


def picture(s, name, parent, offset, yaw, width, height, sheet, material="Walnut"):
    g = s.group(name, parent, offset, turn("y", yaw))
    b = 0.028
    for tag, x in (("left", -1), ("right", 1)):
        s.box("%s frame %s" % (name, tag), g, (x * (width - b) / 2, 0, 0.012), (b, height, 0.024), material)
    for tag, y in (("bottom", -1), ("top", 1)):
        s.box("%s frame %s" % (name, tag), g, (0, y * (height - b) / 2, 0.012), (width - 2 * b, b, 0.0238), material)
    s.box(name + " mount", g, (0, 0, 0.006), (width - 2 * b, height - 2 * b, 0.012), "Paper")
    s.box(name + " print", g, (0, 0.01, 0.0125), ((width - 2 * b) * 0.7, (height - 2 * b) * 0.66, 0.002), sheet)


def mirror(s, name, parent, offset, rotation, width, height, material):
    """Faces +z, its back at z = 0; the silver is 24 mm before it."""
    g = s.group(name + " group", parent, offset, rotation)
    b = 0.05
    s.box(name + " back", g, (0, 0, 0.011), (width, height, 0.018), material)
    s.sheet(name, g, (0, 0, 0.024), (width, height), "Silver")
    for tag, x in (("left", -1), ("right", 1)):
        s.box("%s frame %s" % (name, tag), g, (x * (width + b) / 2, 0, 0.018), (b, height + 2 * b, 0.036), material)
    for tag, y in (("bottom", -1), ("top", 1)):
        s.box("%s frame %s" % (name, tag), g, (0, y * (height + b) / 2, 0.018), (width, b, 0.0358), material)


def lamp_shade(material, low, high, height):
    p = Part(material)
    p.lathe([(low, 0.0), (high, height)], 40)
    return p


def drawers(s, name, parent, x0, x1, y0, y1, z, columns, rows, front, knob, knobs=2):
    """Fronts that stand 12 mm before the plane z, with knobs."""
    w, h, n = (x1 - x0) / columns, (y1 - y0) / rows, 0
    for i in range(columns):
        for j in range(rows):
            n += 1
            cx, cy = x0 + (i + 0.5) * w, y0 + (j + 0.5) * h
            s.box("%s %d" % (name, n), parent, (cx, cy, z + 0.006), (w - 0.012, h - 0.012, 0.012), front)
            for k in range(knobs):
                x = cx + (0.0 if knobs == 1 else (k - 0.5) * w * 0.5)
                s.rod("%s %d knob %d" % (name, n, k + 1), parent, (x, cy, z + 0.012), (x, cy, z + 0.036), 0.010, knob, 0.015)


# ---------------------------------------------------------------- living room


def stove(s, room):
    g = s.group("Stove corner", room)
    rng = random.Random(31)
    s.span("Hearth", g, (-4.98, -0.001, -3.18), (-3.65, 0.05, -1.95), "Slate 2")
    s.span("Brick backing", g, (-4.98, 0.05, -3.18), (-3.65, 1.61, -3.13), "Mortar")
    for j in range(20):
        x, shift = -4.98 + 0.008, 0.0 if j % 2 else 0.12
        cuts = [x] + [x + shift + 0.2485 * k for k in range(1 if shift else 1, 7) if x + shift + 0.2485 * k < -3.66] + [-3.655]
        cuts = cuts[:1] + ([x + shift] if shift else []) + cuts[1:]
        for i, (a, b) in enumerate(zip(cuts, cuts[1:])):
            if b - a > 0.03:
                s.span("Brick %d.%d" % (j + 1, i + 1), g, (a, 0.056 + 0.0775 * j, -3.14), (b - 0.008, 0.056 + 0.0775 * j + 0.0695, -3.10 - 0.006 * rng.random()),
                       rng.choice(["Brick 1", "Brick 2", "Brick 3"]))
    c = s.group("Stove", g, (-4.3, 0.05, -2.65))
    for i, (x, z) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1))):
        s.rod("Stove leg %d" % (i + 1), c, (x * 0.24, 0.0, z * 0.17), (x * 0.24, 0.17, z * 0.17), 0.022, "Cast iron", 0.03)
    s.box("Stove body", c, (0, 0.45, 0), (0.6, 0.56, 0.46), "Cast iron")
    s.box("Stove top", c, (0, 0.745, 0), (0.68, 0.03, 0.54), "Cast iron")
    s.box("Stove door", c, (0, 0.46, 0.24), (0.46, 0.4, 0.02), "Cast iron")
    s.sheet("Stove fire", c, (0, 0.47, 0.252), (0.34, 0.24), "Fire")
    for i, x in enumerate((-0.08, 0.09)):
        s.box("Stove grille %d" % (i + 1), c, (x, 0.47, 0.262), (0.012, 0.26, 0.012), "Cast iron")
    s.ball("Stove handle", c, (0.2, 0.46, 0.28), 0.02, "Brass")
    s.rod("Stove pipe", c, (0, 0.76, -0.08), (0, 2.56, -0.08), 0.075, "Cast iron")
    s.rod("Stove pipe collar", c, (0, 2.50, -0.08), (0, 2.551, -0.08), 0.13, "Cast iron")
    s.rod("Kettle", c, (0.16, 0.76, 0.08), (0.16, 0.90, 0.08), 0.10, "Copper", 0.07)
    s.rod("Kettle knob", c, (0.16, 0.90, 0.08), (0.16, 0.925, 0.08), 0.01, "Walnut", 0.016)
    s.rod("Kettle spout", c, (0.24, 0.81, 0.08), (0.33, 0.885, 0.08), 0.018, "Copper", 0.01)
    rack = s.group("Firewood", g, (-3.35, 0.0, -2.92))
    for i, x in enumerate((-0.29, 0.29)):
        for j, z in enumerate((-0.13, 0.13)):
            s.rod("Firewood rack post %d" % (2 * i + j + 1), rack, (x, 0.0, z), (x, 0.75, z), 0.01, "Black steel")
    for j, z in enumerate((-0.13, 0.13)):
        s.rod("Firewood rack rail %d" % (j + 1), rack, (-0.29, 0.05, z), (0.29, 0.05, z), 0.01, "Black steel")
    n = 0
    for j in range(7):
        for i in range(5 if j % 2 == 0 else 4):
            n += 1
            r = 0.048 + 0.006 * rng.random()
            x, y = -0.216 + 0.108 * i + (0.054 if j % 2 else 0.0), 0.115 + 0.0945 * j
            s.rod("Firewood %d" % n, rack, (x, y, -0.17 - 0.02 * rng.random()), (x, y, 0.17 + 0.02 * rng.random()), r, rng.choice(["Bark", "Log 1", "Log 3"]))


def hutch(s, room, m):
    """Kitchen dresser with crockery where the reflected sun falls."""
    g = s.group("Kitchen dresser", room, (-2.0, 0.0, N))
    w, t = 1.5, 0.025
    s.span("Kitchen dresser base", g, (-w / 2, 0.08, 0.01), (w / 2, 0.86, 0.48), "Walnut")
    s.span("Kitchen dresser plinth", g, (-w / 2 + 0.03, 0.0, 0.02), (w / 2 - 0.03, 0.08, 0.44), "Walnut")
    s.span("Kitchen dresser top", g, (-w / 2 - 0.02, 0.86, 0.005), (w / 2 + 0.02, 0.9, 0.5), "Oak 3")
    drawers(s, "Kitchen drawer", g, -w / 2 + 0.02, w / 2 - 0.02, 0.66, 0.85, 0.48, 3, 1, "Oak 2", "Porcelain", 1)
    drawers(s, "Kitchen door", g, -w / 2 + 0.02, w / 2 - 0.02, 0.1, 0.65, 0.48, 4, 1, "Oak 2", "Porcelain", 1)
    for tag, x in (("left", -w / 2 + t / 2), ("right", w / 2 - t / 2)):
        s.span("Kitchen dresser side %s" % tag, g, (x - t / 2, 0.9, 0.01), (x + t / 2, 2.06, 0.3), "Walnut")
    s.span("Kitchen dresser back", g, (-w / 2 + t, 0.9, 0.01), (w / 2 - t, 2.06, 0.025), "Painted pine")
    s.span("Kitchen dresser crown", g, (-w / 2 - 0.03, 2.06, 0.005), (w / 2 + 0.03, 2.1, 0.34), "Walnut")
    shelves = [1.28, 1.58, 1.84]
    for i, y in enumerate(shelves):
        s.span("Kitchen dresser shelf %d" % (i + 1), g, (-w / 2 + t, y - 0.02, 0.025), (w / 2 - t, y, 0.29), "Walnut")
        s.rod("Plate rail %d" % (i + 1), g, (-w / 2 + t, y + 0.035, 0.12), (w / 2 - t, y + 0.035, 0.12), 0.006, "Walnut")
    rng = random.Random(32)
    lean = quat_mul(turn("x", 78.0), turn("y", 0.0))
    for j, (y, kind, count, tall) in enumerate(((1.28, "plate", 5, 0.13), (1.58, "small plate", 7, 0.09), (1.84, "small plate", 7, 0.09))):
        for i in range(count):
            x = -0.6 + 1.2 * i / (count - 1)
            what = "blue plate" if kind == "plate" and i % 2 else kind
            s.node("Dresser plate %d.%d" % (j + 1, i + 1), (x, y + tall * math.sin(math.radians(78)) + 0.001, 0.055 + 0.01), lean, g, mesh=m[what])
    n = 0
    for j, (y, z) in enumerate(((1.28, 0.22), (1.58, 0.22), (1.84, 0.22))):
        for i in range(9):
            n += 1
            x = -0.62 + 1.24 * i / 8
            kind = (["cup Porcelain", "cup Blue glaze"], ["tumbler"], ["cup Green glaze", "small bowl"])[j]
            s.node("Dresser %s %d" % ("glass" if j == 1 else "cup", n), (x, y + 0.0005, z), turn("y", 360 * rng.random()), g, mesh=m[rng.choice(kind)])
    for name, kind, x, z in (("Dresser vase", "vase Glass", -0.5, 0.22), ("Dresser copper bowl", "copper bowl", -0.2, 0.26),
                             ("Dresser bottle green", "bottle Green glass", 0.12, 0.2), ("Dresser bottle amber", "bottle Amber glass", 0.24, 0.28),
                             ("Dresser clay bowl", "clay bowl", 0.52, 0.25)):
        s.node(name, (x, 0.9005, z), None, g, mesh=m[kind])
    for i, (x, z, name) in enumerate(((0.47, 0.25, "Apple"), (0.55, 0.29, "Apple"), (0.55, 0.2, "Lemon"))):
        s.ball("Dresser fruit %d" % (i + 1), g, (x, 0.957, z), 0.038, name)


def kitchen(s, room, m):
    g = s.group("Kitchen", room)
    x0, x1, z1 = -1.12, A0 - 0.02, N + 0.6
    s.span("Counter base", g, (x0, 0.1, N + 0.02), (x1, 0.86, z1 - 0.03), "Painted pine")
    s.span("Counter plinth", g, (x0 + 0.01, 0.0, N + 0.03), (x1, 0.1, z1 - 0.08), "Black steel")
    s.span("Counter top", g, (x0 - 0.01, 0.86, N + 0.005), (x1, 0.9, z1), "Oak 4")
    drawers(s, "Counter door", g, x0 + 0.01, x1 - 0.01, 0.12, 0.66, z1 - 0.03, 4, 1, "Painted pine", "Walnut", 1)
    drawers(s, "Counter drawer", g, x0 + 0.01, x1 - 0.01, 0.67, 0.855, z1 - 0.03, 4, 1, "Painted pine", "Walnut", 1)
    sink = Part("White enamel")
    sink.lathe([(0.0, 0.004), (0.12, 0.006), (0.17, 0.03), (0.19, 0.10), (0.195, 0.13), (0.195, 0.13), (0.21, 0.13), (0.21, 0.13), (0.205, 0.09),
                (0.18, 0.0), (0.18, 0.0), (0.0, 0.0)][::-1], 40)
    s.node("Sink", (-0.2, 0.9005, N + 0.31), None, g, mesh=s.mesh("Sink", sink))
    pipe = [(-0.2, 0.9, N + 0.06), (-0.2, 1.12, N + 0.06), (-0.2, 1.17, N + 0.11), (-0.2, 1.17, N + 0.22), (-0.2, 1.12, N + 0.25)]
    for i, (a, b) in enumerate(zip(pipe, pipe[1:])):
        s.rod("Kitchen tap %d" % (i + 1), g, a, b, 0.012, "Chrome")
        if i < 3:
            s.ball("Kitchen tap joint %d" % (i + 1), g, b, 0.0125, "Chrome")
    for name, kind, x, z in (("Counter steel bowl", "steel bowl", 0.36, 0.3), ("Counter tumbler 1", "tumbler", -0.55, 0.40), ("Counter tumbler 2", "tumbler", -0.66, 0.32),
                             ("Counter bottle", "bottle Green glass", 0.62, 0.2), ("Counter flask", "flask Amber glass", 0.5, 0.42), ("Counter vase", "vase Blue glass", -0.9, 0.28)):
        s.node(name, (x, 0.9005, N + z), None, g, mesh=m[kind])
    for i in range(5):
        r, h = 0.055 - 0.005 * i, 0.20 - 0.022 * i
        x = -1.03 + 0.001 * i + 0.115 * i
        s.rod("Counter jar %d" % (i + 1), g, (x, 0.9, N + 0.12), (x, 0.9 + h, N + 0.12), r, ["Porcelain", "Blue glaze"][i % 2])
        s.rod("Counter jar %d lid" % (i + 1), g, (x, 0.9 + h, N + 0.12), (x, 0.918 + h, N + 0.12), r * 0.95, "Oak 2")
        s.rod("Counter jar %d knob" % (i + 1), g, (x, 0.918 + h, N + 0.12), (x, 0.942 + h, N + 0.12), 0.010, "Oak 2", 0.014)
    tiles = s.group("Kitchen splashback", g)
    rng = random.Random(35)
    s.span("Kitchen splashback panel", tiles, (x0, 0.9, N - 0.05), (x1, 1.0, N + 0.012), "Mortar")
    count = 37
    for i in range(count):
        for j in range(2):
            a, w = x0 + (x1 - x0) * i / count, (x1 - x0) / count
            s.span("Kitchen tile %d.%d" % (i + 1, j + 1), tiles, (a + 0.001, 0.901 + 0.05 * j, N), (a + w - 0.001, 0.949 + 0.05 * j, N + 0.018),
                   "Blue glaze" if (i + j) % 2 else rng.choice(["Tile 1", "Tile 2", "Tile 3"]))
    s.box("Chopping board", g, (0.1, 0.91, N + 0.42), (0.34, 0.02, 0.22), "Pine 3", turn("y", 12))
    rail = s.group("Kitchen rail", g, (A0, 1.62, -2.85), turn("y", -90.0))
    s.rod("Kitchen rail rod", rail, (-0.32, 0, 0.05), (0.32, 0, 0.05), 0.008, "Black steel")
    for i, x in enumerate((-0.3, 0.3)):
        s.rod("Kitchen rail bracket %d" % (i + 1), rail, (x, 0, 0.0), (x, 0, 0.05), 0.008, "Black steel")
    for i in range(5):
        x, r = -0.24 + 0.12 * i, 0.03 + 0.006 * (i % 3)
        s.rod("Utensil %d handle" % (i + 1), rail, (x, -0.01, 0.05), (x, -0.24, 0.05), 0.005, "Walnut")
        s.rod("Utensil %d head" % (i + 1), rail, (x, -0.24, 0.05), (x, -0.24 - r * 1.4, 0.05), 0.01, "Walnut" if i % 2 else "Black steel", 0.8 * r)


def dining(s, room, m):
    g = s.group("Dining", room, (-1.1, 0.0, -0.75))
    top, w, d = 0.75, 1.7, 0.88
    for i in range(5):
        b = d / 5
        s.box("Table board %d" % (i + 1), g, (0, top - 0.0175, -d / 2 + (i + 0.5) * b), (w, 0.035, b - 0.0015), OAKS[(i * 3) % 4])
    for tag, z in (("north", -0.36), ("south", 0.36)):
        s.box("Table apron %s" % tag, g, (0, 0.67, z), (w - 0.26, 0.09, 0.022), "Oak 1")
    for tag, x in (("west", -0.74), ("east", 0.74)):
        s.box("Table apron %s" % tag, g, (x, 0.67, 0), (0.022, 0.09, 0.66), "Oak 1")
        for k, z in enumerate((-0.36, 0.36)):
            s.rod("Table leg %s %d" % (tag, k + 1), g, (x, 0.0, z), (x, 0.714, z), 0.028, "Oak 1", 0.04)
            s.rod("Table leg ring %s %d" % (tag, k + 1), g, (x, 0.5, z), (x, 0.53, z), 0.045, "Oak 1")
    places = [(-0.5, -0.30, 0), (0.1, -0.30, 0), (-0.5, 0.30, 180), (0.1, 0.30, 180), (0.66, 0.0, 270), (-0.68, 0.0, 90)]
    seats = [(-0.5, -0.60, 0), (0.1, -0.58, 4), (-0.5, 0.62, 183), (0.1, 0.60, 178), (1.02, 0.02, 272), (-1.06, -0.03, 88)]
    for i, ((x, z, yaw), (cx, cz, cyaw)) in enumerate(zip(places, seats)):
        chair(s, "Chair %d" % (i + 1), g, (cx, 0.0, cz), cyaw)
        p = s.group("Setting %d" % (i + 1), g, (x, top, z), turn("y", yaw))
        s.node("Setting %d plate" % (i + 1), (0, 0.0005, 0), None, p, mesh=m["plate"])
        s.node("Setting %d bowl" % (i + 1), (0, 0.0065, 0), None, p, mesh=m["small bowl"])
        s.node("Setting %d glass" % (i + 1), (-0.15 if i < 4 else 0.16, 0.0005, 0.11 if i < 4 else 0.02), None, p, mesh=m["tumbler"])
        for k, (tag, dx, length) in enumerate((("fork", 0.155, 0.19), ("knife", -0.155, 0.21), ("spoon", -0.175, 0.18))):
            s.box("Setting %d %s" % (i + 1, tag), p, (dx, 0.0025, -0.03), (0.011, 0.003, length), "Black steel" if tag == "knife" else "Walnut")
    s.node("Table vase", (-0.22, top + 0.0005, 0.02), None, g, mesh=m["vase Blue glass"])
    s.node("Table copper bowl", (0.24, top + 0.0005, 0.02), None, g, mesh=m["copper bowl"])
    s.node("Table bottle", (0.02, top + 0.0005, -0.05), None, g, mesh=m["bottle Green glass"])
    for i, (x, z) in enumerate(((0.21, -0.005), (0.28, 0.03), (0.22, 0.06))):
        s.ball("Table apple %d" % (i + 1), g, (x, top + 0.05, z), 0.034, "Apple")


def sitting(s, room, m):
    g = s.group("Sitting corner", room)
    s.span("Rug", g, (-3.0, 0.001, 0.85), (-0.95, 0.014, 2.5), "Wool red")
    for i in range(5):
        z = 1.0 + 0.3375 * i
        s.span("Rug stripe %d" % (i + 1), g, (-2.96, 0.014, z - 0.035), (-0.99, 0.0155, z + 0.035), "Wool cream" if i % 2 == 0 else "Wool grey")
    for tag, x in (("west", -3.0), ("east", -0.95)):
        for i in range(22):
            z = 0.87 + 1.61 * i / 21
            sx = -1 if tag == "west" else 1
            s.box("Rug fringe %s %d" % (tag, i + 1), g, (x + sx * 0.025, 0.004, z), (0.05, 0.005, 0.007), "Wool cream")
    sofa = s.group("Sofa", g, (-1.95, 0.0, 2.72), turn("y", 180.0))
    cushion(s, "Sofa base", sofa, (0, 0.24, 0), (2.0, 0.22, 0.84), 0.03, "Wool green")
    cushion(s, "Sofa back", sofa, (0, 0.52, -0.34), (1.66, 0.56, 0.15), 0.05, "Wool green")
    for tag, x in (("left", 0.91), ("right", -0.91)):
        cushion(s, "Sofa arm " + tag, sofa, (x, 0.36, 0.0), (0.18, 0.46, 0.86), 0.06, "Wool green")
        cushion(s, "Sofa seat " + tag, sofa, (x * 0.45, 0.42, 0.09), (0.81, 0.15, 0.68), 0.055, "Wool green")
        cushion(s, "Sofa back cushion " + tag, sofa, (x * 0.45, 0.68, -0.17), (0.79, 0.42, 0.16), 0.065, "Wool green", turn("x", -10.0))
        for k, z in enumerate((-0.34, 0.34)):
            s.rod("Sofa foot %s %d" % (tag, k + 1), sofa, (x, 0.0, z), (x, 0.14, z), 0.02, "Walnut", 0.028)
    cushion(s, "Pillow red", sofa, (0.6, 0.69, 0.02), (0.4, 0.4, 0.14), 0.065, "Wool red", quat_mul(turn("y", -14), turn("x", -22)))
    cushion(s, "Pillow cream", sofa, (-0.6, 0.69, 0.02), (0.4, 0.4, 0.14), 0.065, "Wool cream", quat_mul(turn("y", 15), turn("x", -22)))
    table = s.group("Coffee table", g, (-1.95, 0.0155, 1.55))
    for i in range(4):
        s.box("Coffee table board %d" % (i + 1), table, (0, 0.415, -0.2175 + 0.145 * i), (1.1, 0.03, 0.1435), OAKS[i])
    for i, (x, z) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1))):
        s.rod("Coffee table leg %d" % (i + 1), table, (x * 0.49, 0.0, z * 0.23), (x * 0.47, 0.40, z * 0.22), 0.02, "Oak 1", 0.026)
    s.box("Coffee table shelf", table, (0, 0.17, 0), (0.94, 0.018, 0.44), "Oak 2")
    s.node("Coffee table vase", (0.3, 0.4305, -0.1), None, table, mesh=m["vase Glass"])
    s.node("Coffee table brass bowl", (0.44, 0.4305, 0.14), None, table, mesh=m["brass bowl"])
    s.node("Coffee table tumbler", (-0.36, 0.4305, 0.1), None, table, mesh=m["tumbler"])
    chess = s.group("Chess", table, (-0.02, 0.43, 0.04), turn("y", 14.0))
    s.box("Chess board", chess, (0, 0.006, 0), (0.34, 0.012, 0.34), "Walnut")
    for i in range(8):
        for j in range(8):
            x, z = 0.037 * (i - 3.5), 0.037 * (j - 3.5)
            s.box("Chess square %d.%d" % (i + 1, j + 1), chess, (x, 0.0135, z), (0.0362, 0.003, 0.0362), "Walnut" if (i + j) % 2 else "Pine 4")
            if j in (1, 3, 6) and (i * 7 + j) % 3 == 0 or (j in (0, 7) and i in (2, 4, 6)):
                tall = 0.03 if j in (1, 3, 6) else 0.055
                s.rod("Chess piece %d.%d" % (i + 1, j + 1), chess, (x, 0.015, z), (x, 0.015 + tall, z), 0.012, "Black steel" if j > 4 else "Wax", 0.006)
    s.rod("Candle", table, (-0.3, 0.43, -0.12), (-0.3, 0.55, -0.12), 0.03, "Wax")
    s.ball("Candle flame", table, (-0.3, 0.572, -0.12), 0.010, "Flame", 1.9)
    for i, (c, yaw) in enumerate((("Book blue", 6), ("Book ochre", -9), ("Book slate", 3))):
        s.box("Coffee table book %d" % (i + 1), table, (0.1, 0.191 + 0.026 * i, 0.02), (0.22, 0.024, 0.30), c, turn("y", yaw))
    chairs = s.group("Armchair", g, (-0.30, 0.0, 1.75), turn("y", -72.0))
    cushion(s, "Armchair base", chairs, (0, 0.27, 0), (0.7, 0.18, 0.72), 0.04, "Leather")
    cushion(s, "Armchair back", chairs, (0, 0.58, -0.30), (0.7, 0.54, 0.14), 0.06, "Leather", turn("x", -7))
    cushion(s, "Armchair seat", chairs, (0, 0.42, 0.05), (0.5, 0.13, 0.60), 0.05, "Leather")
    for tag, x in (("left", 0.31), ("right", -0.31)):
        cushion(s, "Armchair arm " + tag, chairs, (x, 0.44, 0.01), (0.11, 0.34, 0.68), 0.05, "Leather")
        for k, z in enumerate((-0.27, 0.28)):
            s.rod("Armchair foot %s %d" % (tag, k + 1), chairs, (x * 0.9, 0.0, z), (x * 0.9, 0.19, z), 0.014, "Walnut", 0.02)
    bookcase(s, "Tall bookcase", g, (A0 - 0.001, 0.0, 2.60), -90.0, 1.0, [0.08, 0.42, 0.76, 1.08, 1.40, 1.70], 2.0, "Walnut", 41)
    bookcase(s, "Second bookcase", g, (A0 - 0.001, 0.0, 1.53), -90.0, 1.0, [0.08, 0.42, 0.76, 1.08, 1.40, 1.70], 2.0, "Walnut", 42)
    bookcase(s, "Low bookcase", g, (W + 0.001, 0.0, 1.95), 90.0, 1.6, [0.07, 0.41, 0.73], 1.03, "Oak 2", 43)
    bookcase(s, "Window bookcase", g, (W + 0.001, 0.0, -1.2), 90.0, 1.5, [0.07, 0.43], 0.80, "Oak 3", 45)
    low = s.group("Low bookcase things", g, (W, 1.051, 1.95), turn("y", 90.0))  # local x runs to the north
    for i, (kind, x, z) in enumerate((("bottle Green glass", -0.62, 0.14), ("bottle Glass", -0.46, 0.18), ("vase Amber glass", -0.2, 0.15),
                                      ("flask Blue glass", 0.02, 0.2), ("copper bowl", 0.26, 0.15), ("flask Amber glass", 0.5, 0.12), ("flask Glass", 0.62, 0.2))):
        s.node("Shelf glass %d" % (i + 1), (x, 0.0005, z), None, low, mesh=m[kind])
    mirror(s, "Leaning mirror", g, (W + 0.165, 0.94, -0.05), quat_mul(turn("y", 90.0), turn("x", -LEAN)), 0.62, 1.72, "Oak 2")
    for i, (name, offset, yaw, w, h, sheet) in enumerate((
            ("Picture lake", (W + 0.001, 1.68, 0.95), 90, 0.5, 0.4, "Print"), ("Picture deer", (-3.2, 1.55, S - 0.001), 180, 0.36, 0.46, "Print warm"),
            ("Picture hills", (A0 - 0.001, 1.6, -0.86), -90, 0.5, 0.6, "Print"))):
        picture(s, name, g, offset, yaw, w, h, sheet)
    hooks = s.group("Coat hooks", g, (A0, 1.7, 0.75), turn("y", -90.0))
    s.box("Coat board", hooks, (0, 0, 0.01), (0.5, 0.1, 0.02), "Walnut")
    for i in range(4):
        x = -0.18 + 0.12 * i
        s.rod("Coat hook %d" % (i + 1), hooks, (x, 0, 0.02), (x, 0.02, 0.075), 0.007, "Black steel")
    pot = s.group("Plant", g, (-4.55, 0.0, 2.85))
    s.rod("Plant pot", pot, (0, 0, 0), (0, 0.3, 0), 0.13, "Terracotta", 0.175)
    s.rod("Plant soil", pot, (0, 0.3, 0), (0, 0.303, 0), 0.15, "Subfloor")
    rng, leaf = random.Random(33), Part("Leaf")
    for k in range(22):
        a, tall, reach = 2.39996 * k, 0.35 + 0.5 * rng.random(), 0.08 + 0.2 * rng.random()
        out, side = (math.cos(a), 0.0, math.sin(a)), (-math.sin(a), 0.0, math.cos(a))
        rows = []
        for i in range(8):
            t = i / 7
            spine = add((0.05 * out[0], 0.3, 0.05 * out[2]), add(mul(out, reach * t * t), (0.0, tall * math.sin(t * 1.5), 0.0)))
            half = 0.008 + 0.045 * math.sin(math.pi * t) if i < 7 else 0.002
            n = unit(add((0.0, 1.0, 0.0), mul(out, -0.6 * t)))
            rows.append([(add(spine, mul(side, half)), n), (spine, n), (sub(spine, mul(side, half)), n)])
        leaf.grid(rows, lambda p: p)
    s.node("Plant leaves", None, None, pot, mesh=s.mesh("Plant leaves", leaf))


# ---------------------------------------------------------------- bedroom


def dresser(s, room, m):
    g = s.group("Dresser group", room)
    x0, x1, z0, z1, top = A1 + 0.005, A1 + 0.47, 0.55, 2.45, 0.82
    s.span("Dresser body", g, (x0, 0.1, z0 + 0.02), (x1 - 0.02, top - 0.03, z1 - 0.02), "Walnut")
    s.span("Dresser", g, (x0, top - 0.03, z0), (x1 + 0.01, top, z1), "Oak 3")
    s.span("Dresser plinth", g, (x0 + 0.02, 0.0, z0 + 0.04), (x1 - 0.06, 0.1, z1 - 0.04), "Walnut")
    front = s.group("Dresser drawers", g, (x1 - 0.02, 0.0, (z0 + z1) / 2), turn("y", 90.0))
    half = (z1 - z0) / 2 - 0.03
    drawers(s, "Dresser drawer", front, -half, half, 0.115, top - 0.045, 0.0, 3, 4, "Oak 1", "Porcelain")
    c = s.group("Dresser things", g, (0.0, top, 0.0))
    for name, kind, x, z in (("Dresser brass bowl", "brass bowl", 1.07, 1.72), ("Dresser flask", "flask Glass", 1.04, 1.42), ("Dresser blue flask", "flask Blue glass", 1.04, 1.27),
                             ("Dresser flower vase", "vase Amber glass", 1.06, 2.26)):
        s.node(name, (x, 0.0005, z), None, c, mesh=m[kind])
    picture(s, "Dresser picture", c, (1.02, 0.106, 0.68), 75.0, 0.17, 0.21, "Print warm")
    s.rod("Candlestick foot", c, (1.06, 0, 0.92), (1.06, 0.015, 0.92), 0.05, "Brass", 0.02)
    s.rod("Candlestick stem", c, (1.06, 0.015, 0.92), (1.06, 0.15, 0.92), 0.011, "Brass")
    s.rod("Candlestick candle", c, (1.06, 0.15, 0.92), (1.06, 0.28, 0.92), 0.012, "Wax")
    # The container: what the drag moves. Its origin is the middle of its body.
    x, y, z = CONTAINER
    s.rod("Container", g, (x, y - 0.14, z), (x, y + 0.14, z), 0.08, "Container enamel")


def bedroom(s, house, m):
    room = s.group("Bedroom", house)
    dresser(s, room, m)
    mirror(s, "Mirror", room, (MIRROR[0], MIRROR[1], B1), None, 0.60, 0.90, "Walnut")
    bed = s.group("Bed", room, (3.35, 0.0, 2.13), turn("y", 180.0))  # head at z = -1.0 of its own: the south wall
    for tag, z, high in (("head", -1.0, 1.05), ("foot", 1.02, 0.62)):
        for side, x in (("left", -0.8), ("right", 0.8)):
            s.rod("Bed post %s %s" % (tag, side), bed, (x, 0.0, z), (x, high, z), 0.035, "Log 1")
            s.rod("Bed knob %s %s" % (tag, side), bed, (x, high, z), (x, high + 0.05, z), 0.035, "Log 1", 0.049)
        for k, y in enumerate((0.36, high - 0.08)):
            s.rod("Bed rail %s %d" % (tag, k + 1), bed, (-0.8, y, z), (0.8, y, z), 0.025, "Log 2")
        for k in range(9):
            x = -0.64 + 0.16 * k
            s.rod("Bed spindle %s %d" % (tag, k + 1), bed, (x, 0.36, z), (x, high - 0.08, z), 0.014, "Log 3")
    for side, x in (("left", -0.8), ("right", 0.8)):
        s.box("Bed side " + side, bed, (x, 0.32, 0.01), (0.03, 0.14, 1.98), "Log 2")
    cushion(s, "Mattress", bed, (0, 0.44, 0.01), (1.54, 0.2, 1.94), 0.06, "Wool cream")
    cushion(s, "Duvet", bed, (0, 0.545, 0.24), (1.62, 0.10, 1.46), 0.045, "Wool grey", steps=3)
    cushion(s, "Throw", bed, (0, 0.563, 0.70), (1.64, 0.10, 0.42), 0.045, "Wool red", steps=3)
    for tag, x in (("left", 0.38), ("right", -0.38)):
        cushion(s, "Bed pillow " + tag, bed, (x, 0.60, -0.72), (0.66, 0.16, 0.42), 0.07, "Linen", turn("x", 14.0), 3)
    for tag, x in (("west", 2.22), ("east", 4.48)):
        n = s.group("Nightstand " + tag, room, (x, 0.0, 2.96), turn("y", 180.0))
        s.box("Nightstand %s body" % tag, n, (0, 0.29, 0), (0.42, 0.46, 0.36), "Walnut")
        s.box("Nightstand %s top" % tag, n, (0, 0.535, 0.005), (0.46, 0.03, 0.40), "Oak 3")
        for i, (a, b) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1))):
            s.rod("Nightstand %s foot %d" % (tag, i + 1), n, (a * 0.18, 0.0, b * 0.15), (a * 0.18, 0.06, b * 0.15), 0.015, "Walnut", 0.02)
        drawers(s, "Nightstand %s drawer" % tag, n, -0.2, 0.2, 0.08, 0.5, 0.18, 1, 2, "Oak 1", "Porcelain", 1)
        lamp = s.group("Bedside lamp " + tag, n, (0.06, 0.55, -0.03))
        s.rod("Bedside lamp %s foot" % tag, lamp, (0, 0, 0), (0, 0.02, 0), 0.07, "Walnut", 0.05)
        s.ball("Bedside lamp %s body" % tag, lamp, (0, 0.085, 0), 0.065, "Blue glaze")
        s.rod("Bedside lamp %s stem" % tag, lamp, (0, 0.145, 0), (0, 0.20, 0), 0.012, "Walnut")
        s.ball("Bedside lamp %s bulb" % tag, lamp, (0, 0.235, 0), 0.032, "Small bulb")
        s.node("Bedside lamp %s shade" % tag, (0, 0.17, 0), None, lamp, mesh=s.mesh("Bedside shade", lamp_shade("Linen", 0.13, 0.085, 0.17)))
        s.node("Nightstand %s tumbler" % tag, (-0.13, 0.5505, 0.06), None, n, mesh=m["tumbler"])
        for i, (c, yaw) in enumerate((("Book red", 8), ("Book slate", -5))):
            s.box("Nightstand %s book %d" % (tag, i + 1), n, (-0.12, 0.562 + 0.024 * i, -0.08), (0.14, 0.023, 0.19), c, turn("y", yaw))
    wardrobe = s.group("Wardrobe", room, (E - 0.001, 0.0, -0.05), turn("y", -90.0))
    s.span("Wardrobe body", wardrobe, (-0.5, 0.08, 0.0), (0.5, 2.0, 0.52), "Oak 1")
    s.span("Wardrobe plinth", wardrobe, (-0.48, 0.0, 0.02), (0.48, 0.08, 0.48), "Walnut")
    s.span("Wardrobe crown", wardrobe, (-0.54, 2.0, 0.0), (0.54, 2.05, 0.56), "Walnut")
    for i, x in enumerate((-0.25, 0.25)):
        s.box("Wardrobe door %d" % (i + 1), wardrobe, (x, 1.04, 0.532), (0.485, 1.86, 0.02), "Oak 2")
        for j, (y, h) in enumerate(((0.6, 0.8), (1.5, 0.8))):
            s.box("Wardrobe panel %d.%d" % (i + 1, j + 1), wardrobe, (x, y, 0.547), (0.35, h, 0.01), "Oak 1")
        k = x + (0.19 if i == 0 else -0.19)
        s.rod("Wardrobe knob %d" % (i + 1), wardrobe, (k, 1.05, 0.55), (k, 1.05, 0.58), 0.014, "Porcelain", 0.02)
    bookcase(s, "Bedroom bookcase", room, (1.75, 0.0, B1 + 0.001), 0.0, 0.95, [0.08, 0.42, 0.76, 1.08, 1.40], 1.72, "Oak 3", 44)
    for i in range(3):
        s.box("Bookcase box %d" % (i + 1), room, (1.5 + 0.25 * i, 1.795, B1 + 0.15), (0.2, 0.105, 0.2), ["Wool grey", "Print warm", "Book cream"][i])
    chair(s, "Bedroom chair", room, (4.2, 0.0, 0.85), 200.0)
    s.span("Bedside rug", room, (1.75, 0.001, 1.35), (2.45, 0.013, 2.55), "Wool cream")
    for i in range(5):
        s.span("Bedside rug stripe %d" % (i + 1), room, (1.77, 0.013, 1.46 + 0.21 * i), (2.43, 0.0145, 1.52 + 0.21 * i), "Wool green")
    for name, offset, yaw, w, h, sheet in (("Bedroom picture west", (A1 + 0.001, 1.72, 2.5), 90, 0.40, 0.52, "Print"),
                                           ("Bedroom picture south", (3.35, 1.65, S - 0.001), 180, 0.9, 0.55, "Print warm"),
                                           ("Bedroom picture north", (4.1, 1.6, B1 + 0.001), 0, 0.42, 0.32, "Print")):
        picture(s, name, room, offset, yaw, w, h, sheet)


# ---------------------------------------------------------------- bathroom


def bathroom(s, house, m):
    room = s.group("Bathroom", house)
    tub = s.group("Bathtub", room, (4.02, 0.0, N + 0.42))
    shell, n = Part("White enamel"), 48
    rows = []
    for scale, y, slope in ((0.62, 0.06, None), (0.80, 0.06, None), (0.98, 0.58, None), (1.06, 0.60, None), (1.06, 0.57, None), (0.94, 0.555, None), (0.74, 0.14, None),
                            (0.55, 0.12, None), (0.0, 0.115, None)):
        rows.append([(scale * 0.82 * math.cos(2 * math.pi * k / n), y, scale * 0.36 * math.sin(2 * math.pi * k / n)) for k in range(n)])
    for a, b in zip(rows, rows[1:]):
        for k in range(n):
            j = (k + 1) % n
            corners = [a[k], b[k], b[j], a[j]]
            if b[k] == b[j]:
                corners = corners[:2] + corners[3:]
            elif a[k] == a[j]:
                corners = corners[:3]
            shell.polygon(corners)
    s.node("Bathtub shell", None, None, tub, mesh=s.mesh("Bathtub shell", shell))
    for i, (x, z) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1))):
        s.rod("Bathtub foot %d" % (i + 1), tub, (x * 0.40, 0.0, z * 0.15), (x * 0.40, 0.07, z * 0.15), 0.03, "Cast iron", 0.045)
    s.rod("Bathtub pipe", tub, (-0.93, 0.0, 0.0), (-0.93, 0.74, 0.0), 0.014, "Chrome")
    s.rod("Bathtub spout", tub, (-0.93, 0.74, 0.0), (-0.78, 0.72, 0.0), 0.016, "Chrome")
    for tag, z in (("hot", -0.05), ("cold", 0.05)):
        s.rod("Bathtub tap " + tag, tub, (-0.93, 0.75, z), (-0.93, 0.79, z), 0.014, "Chrome", 0.02)
    s.rod("Bathtub bridge", tub, (-0.93, 0.76, -0.05), (-0.93, 0.76, 0.05), 0.009, "Chrome")
    tiles = s.group("Bath splashback", room)
    rng = random.Random(34)
    s.span("Bath splashback panel", tiles, (2.85, 0.0, N - 0.05), (E + 0.05, 1.24, N + 0.012), "Mortar")
    for i in range(14):
        for j in range(8):
            x, y = 2.86 + 0.155 * i, 0.155 * j
            s.span("Bath tile %d.%d" % (i + 1, j + 1), tiles, (x + 0.0015, y + 0.0015, N + 0.005), (min(x + 0.1535, E + 0.04), y + 0.1535, N + 0.02),
                   rng.choice(["Tile 1", "Tile 2", "Tile 3"]))
    s.span("Bath splashback rail", tiles, (2.85, 1.24, N - 0.05), (E + 0.05, 1.265, N + 0.03), "Walnut")
    shelf = s.group("Bath shelf", room, (4.0, 1.32, N))
    s.box("Bath shelf board", shelf, (0, 0, 0.075), (0.9, 0.024, 0.15), "Oak 3")
    for i, x in enumerate((-0.35, 0.35)):
        s.box("Bath shelf bracket %d" % (i + 1), shelf, (x, -0.06, 0.06), (0.024, 0.096, 0.10), "Oak 1")
    for i, (kind, x) in enumerate((("flask Blue glass", -0.34), ("flask Glass", -0.2), ("flask Amber glass", -0.08), ("brass bowl", 0.08), ("flask Green glass", 0.24), ("tumbler", 0.36))):
        s.node("Bath shelf thing %d" % (i + 1), (x, 0.0125, 0.09), None, shelf, mesh=m[kind])
    basin = s.group("Washstand", room, (2.7, 0.0, B0), turn("y", 180.0))
    s.box("Washstand cabinet", basin, (0, 0.44, 0.24), (0.8, 0.74, 0.44), "Walnut")
    s.box("Washstand plinth", basin, (0, 0.035, 0.22), (0.74, 0.07, 0.38), "Black steel")
    s.box("Washstand top", basin, (0, 0.825, 0.245), (0.84, 0.03, 0.47), "Slate 3")
    drawers(s, "Washstand door", basin, -0.39, 0.39, 0.09, 0.79, 0.46, 2, 1, "Oak 1", "Porcelain", 1)
    s.node("Wash bowl", (0, 0.8405, 0.26), None, basin, (1.6, 1.6, 1.6), mesh=s.mesh("Wash bowl", bowl("Porcelain", 0.115, 0.08)))
    for i, (a, b) in enumerate((((0, 0.84, 0.07), (0, 1.06, 0.07)), ((0, 1.06, 0.07), (0, 1.04, 0.19)))):
        s.rod("Wash tap %d" % (i + 1), basin, a, b, 0.012, "Chrome")
        if i == 0:
            s.ball("Wash tap joint", basin, b, 0.0125, "Chrome")
    s.node("Wash tumbler", (0.3, 0.8405, 0.18), None, basin, mesh=m["tumbler"])
    s.node("Soap dish", (-0.31, 0.8405, 0.2), None, basin, mesh=m["brass bowl"])
    cushion(s, "Soap", basin, (-0.31, 0.868, 0.2), (0.075, 0.028, 0.05), 0.012, "Wool cream")
    mirror(s, "Bathroom mirror", basin, (0, 1.58, 0.0), None, 0.7, 0.56, "Walnut")
    s.rod("Bathroom tube", basin, (-0.3, 2.02, 0.06), (0.3, 2.02, 0.06), 0.018, "Tube")
    for tag, x in (("left", -0.32), ("right", 0.32)):
        s.rod("Bathroom tube holder " + tag, basin, (x, 2.02, 0.0), (x, 2.02, 0.08), 0.022, "Black steel")
    toilet = s.group("Toilet", room, (2.15, 0.0, N + 0.02))
    s.box("Toilet cistern", toilet, (0, 0.62, 0.09), (0.40, 0.36, 0.17), "Porcelain")
    s.box("Toilet lid of cistern", toilet, (0, 0.81, 0.09), (0.42, 0.025, 0.19), "Porcelain")
    s.rod("Toilet foot", toilet, (0, 0.0, 0.36), (0, 0.30, 0.36), 0.12, "Porcelain", 0.17)
    s.node("Toilet bowl", (0, 0.36, 0.38), None, toilet, (0.40, 0.13, 0.50), mesh=s.unit("cylinder", "Porcelain"))
    s.node("Toilet seat", (0, 0.44, 0.385), None, toilet, (0.41, 0.03, 0.51), mesh=s.unit("cylinder", "Oak 2"))
    s.box("Toilet pipe", toilet, (0, 0.37, 0.14), (0.2, 0.14, 0.12), "Porcelain")
    rail = s.group("Towel rail", room, (4.05, 0.0, B0), turn("y", 180.0))
    for tag, x in (("left", -0.26), ("right", 0.26)):
        s.rod("Towel rail post " + tag, rail, (x, 0.35, 0.07), (x, 1.6, 0.07), 0.016, "White enamel")
        for k, y in enumerate((0.5, 1.45)):
            s.rod("Towel rail stay %s %d" % (tag, k + 1), rail, (x, y, -0.01), (x, y, 0.07), 0.01, "White enamel")
    for k in range(11):
        y = 0.42 + 0.11 * k
        s.rod("Towel rail bar %d" % (k + 1), rail, (-0.26, y, 0.07), (0.26, y, 0.07), 0.011, "White enamel")
    for k, (y, h, x, c) in enumerate(((1.31, 0.5, 0.0, "Towel"), (0.76, 0.36, 0.06, "Wool cream"))):
        cushion(s, "Towel %d" % (k + 1), rail, (x, y - h / 2 + 0.03, 0.10), (0.36, h, 0.03), 0.013, c)
        cushion(s, "Towel %d fold" % (k + 1), rail, (x, y - h * 0.35 + 0.03, 0.036), (0.36, h * 0.7, 0.024), 0.011, c)
        cushion(s, "Towel %d top" % (k + 1), rail, (x, y + 0.027, 0.07), (0.36, 0.03, 0.09), 0.013, c)
    stool = s.group("Bath stool", room, (3.05, 0.0, -2.6))
    s.rod("Bath stool seat", stool, (0, 0.41, 0), (0, 0.44, 0), 0.17, "Oak 3")
    for i in range(3):
        a = 2.1 * i
        s.rod("Bath stool leg %d" % (i + 1), stool, (0.15 * math.cos(a), 0.0, 0.15 * math.sin(a)), (0.1 * math.cos(a), 0.41, 0.1 * math.sin(a)), 0.015, "Oak 1")
    for i in range(3):
        cushion(s, "Folded towel %d" % (i + 1), stool, (0.0, 0.465 + 0.05 * i, 0.0), (0.26, 0.048, 0.18), 0.02, ["Towel", "Wool cream", "Towel"][i])
    basket = s.group("Laundry basket", room, (1.3, 0.0, N + 0.32))
    s.rod("Laundry basket body", basket, (0, 0, 0), (0, 0.55, 0), 0.19, "Pine 3", 0.23)
    s.rod("Laundry basket lid", basket, (0, 0.55, 0), (0, 0.575, 0), 0.24, "Pine 1")
    s.rod("Laundry basket knob", basket, (0, 0.575, 0), (0, 0.605, 0), 0.014, "Walnut", 0.022)
    s.span("Bath mat", room, (3.55, 0.001, -2.36), (4.45, 0.012, -1.85), "Towel")
    picture(s, "Bathroom picture", room, (A1 + 0.001, 1.6, -2.6), 90, 0.36, 0.46, "Print")


# ---------------------------------------------------------------- light


def lamps(s, house):
    g = s.group("Lights", house)
    pendant = s.group("Pendant lamp", g, (-1.1, 1.62, -0.75))
    s.rod("Pendant cord", pendant, (0, 0.2, 0), (0, 0.97, 0), 0.005, "Black steel")
    s.rod("Pendant rose", pendant, (0, 0.955, 0), (0, 0.981, 0), 0.05, "Black steel")
    s.ball("Pendant bulb", pendant, (0, 0.05, 0), 0.045, "Bulb")
    s.rod("Pendant socket", pendant, (0, 0.085, 0), (0, 0.2, 0), 0.022, "Black steel")
    s.node("Pendant shade", (0, 0.0, 0), None, pendant, mesh=s.mesh("Pendant shade", lamp_shade("Brass", 0.21, 0.03, 0.17)))
    floor = s.group("Floor lamp", g, (-3.35, 0.0, 2.72))
    s.rod("Floor lamp foot", floor, (0, 0, 0), (0, 0.03, 0), 0.15, "Black steel", 0.12)
    s.rod("Floor lamp pole", floor, (0, 0.03, 0), (0, 1.42, 0), 0.012, "Black steel")
    s.ball("Floor lamp bulb", floor, (0, 1.47, 0), 0.045, "Bulb")
    s.node("Floor lamp shade", (0, 1.36, 0), None, floor, mesh=s.mesh("Floor lamp shade", lamp_shade("Linen", 0.22, 0.14, 0.28)))
    for k in range(3):
        a = 2 * math.pi * k / 3
        s.rod("Floor lamp spoke %d" % (k + 1), floor, (0, 1.40, 0), (0.208 * math.cos(a), 1.40, 0.208 * math.sin(a)), 0.003, "Black steel")
    globe = s.group("Bathroom globe", g, (3.0, 2.42, -1.9))
    s.ball("Globe", globe, (0, 0, 0), 0.11, "Globe")
    s.rod("Globe base", globe, (0, 0.10, 0), (0, 0.1805, 0), 0.07, "Brass")
    for i, x in enumerate((-0.75, 0.3)):
        s.rod("Kitchen spot %d housing" % (i + 1), g, (x, 2.5, N + 0.5), (x, 2.6005, N + 0.5), 0.045, "Black steel")
        s.light("Kitchen spot %d" % (i + 1), g, (x, 2.49, N + 0.5), (0.0, -1.0, -0.12), type="spot", intensity=420.0, color=[1.0, 0.80, 0.58],
                spot={"innerConeAngle": 0.3, "outerConeAngle": 0.75})
    s.light("Reading spot", g, (-4.35, 2.35, 2.2), (-0.35, -1.0, -0.2), type="spot", intensity=350.0, color=[1.0, 0.78, 0.55],
            spot={"innerConeAngle": 0.25, "outerConeAngle": 0.6})
    s.rod("Reading spot housing", g, (-4.33, 2.37, 2.212), (-4.3, 2.46, 2.23), 0.04, "Black steel")
    s.lights.append({"name": "Sun", "type": "directional", "color": [1.0, 0.74, 0.46], "intensity": 13000.0})
    s.node("Sun", (8.0, 3.0, 8.0), facing(SUN), g, extensions={"KHR_lights_punctual": {"light": len(s.lights) - 1}})


def edits():
    x, y, z = CONTAINER
    write_edits(__file__, "drag.json", [{"kind": "drag", "node": "Container", "positions": along((x, y, z - 0.05), (x, y, 0.73), 31),
                                         "interval_ms": 16, "settle": True}])
    write_edits(__file__, "edits.json", [
        {"kind": "move", "node": "Mirror group", "rotation": [round(c, 7) for c in turn("y", 6.0)]},
        {"kind": "undo"},
        {"kind": "redo"},
        {"kind": "material", "material": "Container enamel", "baseColor": [0.93, 0.6, 0.46], "metallic": 1.0, "roughness": 0.1},
        {"kind": "light", "node": "Kitchen spot 1", "enabled": False},
        {"kind": "add", "shape": "sphere", "name": "Ball", "translation": [-0.72, 0.811, -0.62], "size": [0.12], "material": "Glass"},
        {"kind": "delete", "node": "Chair 2"},
        {"kind": "undo"},
        {"kind": "move", "node": "Table copper bowl", "translation": [0.36, 0.7505, 0.3]},
        {"kind": "delete", "node": "Dresser flask"},
        {"kind": "material", "material": "Painted wood 2", "baseColor": [0.35, 0.45, 0.5]},
        {"kind": "light", "node": "Sun", "intensity": 9000.0, "color": [1.0, 0.66, 0.36]},
        {"kind": "undo"},
        {"kind": "undo"},
        {"kind": "redo"}])


def patch(n, mirror_at, plane, axis):
    """Where the middle of a mirror throws the sun on a plane, and along what."""
    d = reflect(SUN, n)
    t = (plane - mirror_at[axis]) / d[axis]
    return tuple(round(a + t * b, 3) for a, b in zip(mirror_at, d))


def main():
    s = LargeScene("Cabin", MATERIALS, sky=(900.0, 1060.0, 1300.0))
    house = s.group("Cabin")
    log_walls(s, house)
    windows(s, house)
    partitions(s, house)
    floors(s, house)
    m = things(s)
    room = s.group("Living room", house)
    stove(s, room)
    hutch(s, room, m)
    kitchen(s, room, m)
    dining(s, room, m)
    sitting(s, room, m)
    bedroom(s, house, m)
    bathroom(s, house, m)
    lamps(s, house)
    s.camera("Living room", (0.45, 1.62, 0.62), (-3.2, 0.95, -1.35), 60.0)
    s.camera("Bedroom", (4.55, 1.58, 2.05), (1.3, 0.98, 0.55), 60.0)
    s.camera("Dresser", (2.75, 1.40, 0.75), (0.95, 0.98, 1.50), 46.0)
    s.camera("Bathroom", (1.15, 1.6, -0.95), (4.0, 0.95, -2.55), 60.0)
    s.camera("From the stove", (-4.2, 1.6, -1.6), (-1.0, 0.95, 2.2), 62.0)
    for camera, stops in zip(s.cameras, (0.7, 0.3, 0.0, 0.3, 0.7)):
        if stops:
            camera["extensions"] = {"ATRIUM_camera": {"exposure": stops}}
    s.write(__file__)
    edits()
    lean = rotate(quat_mul(turn("y", 90.0), turn("x", -LEAN)), (0.0, 0.0, 1.0))
    print("sun from the bedroom's mirror on the west wall", patch((0, 0, 1), MIRROR, A1, 0), file=sys.stderr)
    print("sun from the leaning mirror on the north wall", patch(lean, (W + 0.19, 0.94, -0.05), N, 2), file=sys.stderr)


if __name__ == "__main__":
    main()
