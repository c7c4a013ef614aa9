#!/usr/bin/env python3
"""Writes street.glb beside this script: a street between a brick house and a house of polished metal. Same script, same bytes.

Metres, +Y up. The street runs along z, the brick house stands in the west (its front x = -7.6), the metal house in the east (x = 9).
The sun comes over the brick house, whose shadow covers the street; what lights it is what the metal throws back.
"""
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from small_scene import Part, facing, glass, pbr  # noqa: E402
from large_scene import LargeScene, add, along, cross, dot, mul, reflect, sub, turn, unit, write_edits  # noqa: E402

WEST, EAST = -7.6, 9.0          # fronts of the two houses
CURB, KERB = 4.6, 0.14          # half the width of the road, rise of the pavement
CAR = (-2.6, 0.0, -14.0)        # where its drive starts
LONG = 17.0                     # half the length of the houses
FAR = 26.0                      # where the houses at the ends of the street stand
SUN = unit((math.cos(math.radians(20)) * math.cos(math.radians(15)), -math.sin(math.radians(20)),
            math.cos(math.radians(20)) * math.sin(math.radians(15))))


def tones(name, colour, count, spread, roughness):
    rng = random.Random(name)
    return {"%s %d" % (name, k + 1): pbr([c * (1 + spread * (2 * (k + 0.5 * rng.random()) / count - 1)) for c in colour], roughness)
            for k in range(count)}


MATERIALS = {
    "Paving": pbr((0.43, 0.42, 0.40), 0.9), "Joint": pbr((0.20, 0.195, 0.19), 0.95), **tones("Brick", (0.42, 0.22, 0.16), 3, 0.06, 0.9),
    "Asphalt": pbr((0.10, 0.10, 0.105), 0.95), "Road paint": pbr((0.72, 0.72, 0.70), 0.8), "Granite": pbr((0.36, 0.36, 0.36), 0.8),
    "Ground": pbr((0.16, 0.20, 0.10), 1.0), "Plinth": pbr((0.34, 0.33, 0.31), 0.9), "Limestone": pbr((0.62, 0.59, 0.52), 0.9),
    "Roof tiles": pbr((0.26, 0.14, 0.11), 0.9), "Render": pbr((0.66, 0.62, 0.53), 0.95), "Render grey": pbr((0.50, 0.52, 0.53), 0.95),
    "White wood": pbr((0.72, 0.72, 0.70), 0.7), "Green wood": pbr((0.10, 0.20, 0.15), 0.7), "Bench wood": pbr((0.36, 0.24, 0.14), 0.8),
    "Curtain": pbr((0.62, 0.60, 0.55), 0.95), "Room": pbr((0.11, 0.10, 0.09), 0.95), "Awning": {**pbr((0.46, 0.12, 0.10), 0.9), "doubleSided": True},
    "Dark iron": pbr((0.05, 0.055, 0.06), 0.7), "Concrete": pbr((0.46, 0.46, 0.44), 0.9), "Dark glass": pbr((0.035, 0.045, 0.05), 0.3),
    "Tinted glass": pbr((0.11, 0.13, 0.14), 0.0, 1.0),
    "Pane": glass(solid=False), "Panel": pbr((0.82, 0.83, 0.84), 0.02, 1.0), "Column metal": pbr((0.80, 0.81, 0.82), 0.08, 1.0),
    "Chrome": pbr((0.62, 0.62, 0.63), 0.1, 1.0), "Car paint": pbr((0.45, 0.05, 0.04), 0.5), "Rubber": pbr((0.04, 0.04, 0.04), 0.95),
    "Lamp glass": pbr((0.75, 0.74, 0.70), 0.6), "Red glass": pbr((0.40, 0.03, 0.03), 0.6),
    "Bark": pbr((0.20, 0.15, 0.11), 0.95), "Leaf 1": pbr((0.10, 0.20, 0.06), 0.9), "Leaf 2": pbr((0.13, 0.23, 0.07), 0.9),
    "Soil": pbr((0.10, 0.075, 0.05), 1.0),
}


# ---------------------------------------------------------------- meshes


def loft(part, rings, closed=True):
    """Skin over rings of equally many points, front on the right walking along a ring with the next ring above."""
    n = len(rings[0])
    rows = []
    for i, ring in enumerate(rings):
        row = []
        for k in range(n + 1 if closed else n):
            j = k % n
            before, after = (ring[(j - 1) % n], ring[(j + 1) % n]) if closed else (ring[max(j - 1, 0)], ring[min(j + 1, n - 1)])
            down, up = rings[max(i - 1, 0)][j], rings[min(i + 1, len(rings) - 1)][j]
            across = sub(after, before)
            if dot(across, across) < 1e-12:  # a pole
                middle = mul(add(rings[1 if i == 0 else i - 1][0], rings[1 if i == 0 else i - 1][n // 2]), 0.5)
                row.append((ring[j], unit(sub(ring[j], middle))))
            else:
                row.append((ring[j], unit(cross(across, sub(up, down)))))
        rows.append(row)
    base = len(part.position)
    for row in rows:
        for p, normal in row:
            part.position.append(p)
            part.normal.append(normal)
    width = len(rows[0])
    for i in range(len(rows) - 1):
        for k in range(width - 1):
            a, b = base + i * width + k, base + (i + 1) * width + k
            for t in ((a, a + 1, b + 1), (a, b + 1, b)):
                p = [part.position[q] for q in t]
                c = cross(sub(p[1], p[0]), sub(p[2], p[0]))
                if dot(c, c) > 1e-16:
                    part.index.extend(t)


def rounded(x, z, r, y, corner=4, cx=0.0, cz=0.0):
    """Ring in the plane y around a rectangle of half sizes x, z."""
    out = []
    for k, (sx, sz) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for i in range(corner + 1):
            a = math.pi / 2 * (k + i / corner)
            out.append((cx + sx * (x - r) + r * math.cos(a), y, cz + sz * (z - r) + r * math.sin(a)))
    return list(reversed(out))


def cap(part, ring, up=True):
    part.polygon(ring if up else list(reversed(ring)))


def blob(part, centre, radius, rng, segments=12, rings=8):
    """Bumpy ball: foliage."""
    wave = [(rng.uniform(2, 5), rng.uniform(0, 6.28), rng.uniform(2, 5), rng.uniform(0, 6.28)) for _ in range(3)]
    rows = []
    for i in range(rings + 1):
        ring = []
        polar = math.pi * i / rings
        for k in range(segments):
            a = 2 * math.pi * k / segments
            bump = 1 + 0.07 * sum(math.sin(round(f) * a + p) * math.sin(round(g) * polar + q) for f, p, g, q in wave)
            r = radius * (bump if 0 < i < rings else 1.0)
            ring.append((centre[0] + r * math.sin(polar) * math.cos(a), centre[1] - 0.85 * r * math.cos(polar), centre[2] - r * math.sin(polar) * math.sin(a)))
        rows.append(ring)
    loft(part, rows)


def tree(seed):
    rng = random.Random(seed)
    parts = [Part("Leaf 1"), Part("Leaf 2")]
    blob(parts[0], (0.0, 3.5, 0.0), 1.15, rng)
    for k in range(8):
        a, y = 2.39996 * k, 2.75 + 1.9 * k / 7
        out = 0.95 - 0.55 * abs(k / 7 - 0.35)
        blob(parts[k % 2], (out * math.cos(a), y, out * math.sin(a)), 0.84 - 0.25 * k / 7, rng)
    return parts


# ---------------------------------------------------------------- the street


def ground(s, root):
    g = s.group("Ground group", root)
    s.span("Ground", g, (WEST - 9.4, -0.5, -FAR - 5.6), (EAST + 9.6, -0.06, FAR + 5.6), "Ground")
    s.span("Road", g, (-CURB, -0.3, -FAR), (CURB, 0.0, FAR), "Asphalt")
    for k in range(18):
        z = -FAR + 1.35 + 2.9 * k
        s.span("Centre line %d" % (k + 1), g, (-0.07, -0.01, z - 0.75), (0.07, 0.004, z + 0.75), "Road paint")
    for k in range(9):
        x = -4.0 + k
        s.span("Crossing bar %d" % (k + 1), g, (x - 0.25, -0.01, 19.0), (x + 0.25, 0.004, 22.0), "Road paint")
    for side, x0, x1 in (("west", WEST, -CURB - 0.22), ("east", CURB + 0.22, EAST)):
        walk = s.group("Walk " + side, g)
        edge = -CURB - 0.22 if side == "west" else CURB
        s.span("Kerb " + side, walk, (edge, -0.2, -FAR), (edge + 0.22, KERB, FAR), "Granite")
        for k in range(1, 26):
            s.span("Kerb joint %s %d" % (side, k), walk, (edge - 0.001, -0.1, -FAR + 2 * k - 0.005), (edge + 0.221, KERB + 0.001, -FAR + 2 * k + 0.005), "Joint")
        # One surface, so that bright shapes lie on it undivided; the joints are thin strips.
        s.span("Pavement " + side, walk, (x0 - 0.3, -0.3, -FAR), (x1 + 0.001, KERB, FAR), "Paving")
        rows, length = (4 if side == "west" else 6), 1.04
        wide, count = (x1 - x0) / rows, round(2 * FAR / length)
        for i in range(1, rows):
            x = x0 + wide * i
            s.span("Joint %s %d" % (side, i), walk, (x - 0.006, KERB - 0.01, -FAR), (x + 0.006, KERB + 0.0012, FAR), "Joint")
        for i in range(rows):
            for j in range(count):
                z = -FAR + 2 * FAR * (j + 0.5 * (i % 2)) / count
                if j or i % 2:
                    s.span("Joint %s %d.%d" % (side, i + 1, j + 1), walk, (x0 + wide * i + 0.006, KERB - 0.01, z - 0.006),
                           (x0 + wide * (i + 1) - 0.006, KERB + 0.0012, z + 0.006), "Joint")


def sash(s, name, parent, width, height, wood):
    """Window in an opening; local z out of the wall, origin in the middle of its sill, the front of the wall at z = 0."""
    b, z = 0.07, -0.16
    for tag, x in (("left", -1), ("right", 1)):
        s.box("%s stile %s" % (name, tag), parent, (x * (width - b) / 2, height / 2, z), (b, height, b), wood)
    for tag, y in (("bottom", b / 2), ("top", height - b / 2)):
        s.box("%s rail %s" % (name, tag), parent, (0, y, z), (width - 2 * b, b, b), wood)
    s.box(name + " mullion", parent, (0, height / 2, z), (0.05, height - 2 * b, 0.06), wood)
    s.box(name + " transom", parent, (0, height * 0.68, z + 0.001), (width - 2 * b, 0.045, 0.056), wood)
    s.sheet(name + " pane", parent, (0, height / 2, z - 0.01), (width - 2 * b, height - 2 * b), "Pane")


def brick_house(s, root):
    g = s.group("Brick house", root)
    rng = random.Random(52)
    top, deep = 8.2, 9.0
    s.span("Brick house body", g, (WEST - deep, -0.2, -LONG), (WEST - 0.9, top, LONG), "Render")
    columns, floors = 12, [(0.95, 2.75), (3.9, 5.6), (6.05, 7.35)]
    bay, wide = 2 * LONG / columns, 1.25
    front = s.group("Brick front", g)
    for k in range(columns + 1):
        z0 = -LONG if k == 0 else -LONG + (k - 1) * bay + (bay + wide) / 2
        z1 = LONG if k == columns else -LONG + k * bay + (bay - wide) / 2
        s.span("Pier %d" % (k + 1), front, (WEST - 0.3, 0.0, z0), (WEST, top, z1), "Brick %d" % (1 + k % 3))
    s.span("Brick house side north", g, (WEST - 0.9, 0.0, -LONG), (WEST - 0.3, top, -LONG + 0.2), "Render")
    s.span("Brick house side south", g, (WEST - 0.9, 0.0, LONG - 0.2), (WEST - 0.3, top, LONG), "Render")
    s.span("Brick house lid", g, (WEST - 0.9, top - 0.1, -LONG + 0.2), (WEST - 0.3, top, LONG - 0.2), "Render")
    for k in range(columns):
        mid = -LONG + (k + 0.5) * bay
        door = k in (3, 8)
        edges = [0.0] + [y for f in floors for y in f] + [top]
        for i in range(0, len(edges), 2):
            if door and i == 0:
                continue
            low = edges[i] + (0.205 if i and not (door and i == 2) else 0.0)
            high = edges[i + 1] - (0.065 if i < 6 else 0.25)
            s.span("Spandrel %d.%d" % (k + 1, i // 2 + 1), front, (WEST - 0.3, low, mid - wide / 2), (WEST, high, mid + wide / 2), rng.choice(["Brick 1", "Brick 2", "Brick 3"]))
        for i, (y0, y1) in enumerate(floors):
            name = "Window %d.%d" % (k + 1, i + 1)
            if door and i == 0:
                d = s.group("Door %d" % (k + 1), front, (WEST, 0.0, mid), turn("y", 90.0))
                s.box("Door %d leaf" % (k + 1), d, (0, 1.17, -0.16), (wide, 2.06, 0.06), "Green wood")
                for j, (x, y) in enumerate(((-0.29, 0.7), (0.29, 0.7), (-0.29, 1.6), (0.29, 1.6))):
                    s.box("Door %d panel %d" % (k + 1, j + 1), d, (x, y, -0.125), (0.42, 0.7, 0.02), "Green wood")
                s.box("Door %d light" % (k + 1), d, (0, 2.475, -0.17), (wide, 0.55, 0.04), "Dark glass")
                s.rod("Door %d handle" % (k + 1), d, (0.5, 1.05, -0.08), (0.5, 1.25, -0.08), 0.015, "Chrome")
                s.box("Door %d step" % (k + 1), d, (0, 0.1, 0.12), (1.6, 0.22, 0.5), "Granite")
                s.box("Door %d hood" % (k + 1), d, (0, 2.9, 0.3), (1.8, 0.08, 0.7), "Limestone")
                for j, x in enumerate((-0.75, 0.75)):
                    s.box("Door %d console %d" % (k + 1, j + 1), d, (x, 2.72, 0.14), (0.12, 0.28, 0.28), "Limestone")
                continue
            w = s.group(name, front, (WEST, y0, mid), turn("y", 90.0))
            sash(s, name, w, wide, y1 - y0, "White wood")
            s.box(name + " sill", w, (0, -0.03, -0.105), (wide + 0.2, 0.07, 0.39), "Limestone")
            s.box(name + " lintel", w, (0, y1 - y0 + 0.1025, -0.14), (wide + 0.3, 0.205, 0.32), "Limestone")
            s.box(name + " room", w, (0, (y1 - y0) / 2, -0.87), (wide + 0.5, y1 - y0 + 0.3, 0.04), "Room")
            for j, x in enumerate((-1, 1)):
                part = 0.22 + 0.14 * rng.random()
                s.box("%s curtain %d" % (name, j + 1), w, (x * (wide / 2 - part / 2), (y1 - y0) / 2, -0.32), (part, y1 - y0, 0.03), "Curtain")
            if i == 1 and k % 3 == 1:
                b = s.group("Balcony %d" % (k + 1), w)
                s.box("Balcony %d slab" % (k + 1), b, (0, -0.12, 0.5), (2.3, 0.12, 1.0), "Limestone")
                for j, (x, z, lx, lz) in enumerate(((0, 0.97, 2.2, 0.04), (-1.1, 0.49, 0.04, 0.95), (1.1, 0.49, 0.04, 0.95))):
                    s.box("Balcony %d rail %d" % (k + 1, j + 1), b, (x, 0.9, z), (lx, 0.05, lz), "Dark iron")
                for j in range(19):
                    s.box("Balcony %d bar %d" % (k + 1, j + 1), b, (-1.08 + 0.12 * j, 0.4, 0.97), (0.016, 0.95, 0.016), "Dark iron")
                for j in range(7):
                    for side, x in (("left", -1.1), ("right", 1.1)):
                        s.box("Balcony %d bar %s %d" % (k + 1, side, j + 1), b, (x, 0.4, 0.1 + 0.12 * j), (0.016, 0.95, 0.016), "Dark iron")
    s.span("Brick plinth", g, (WEST - 0.28, 0.0, -LONG - 0.03), (WEST + 0.06, 0.55, -LONG + 3 * bay + (bay - wide) / 2), "Plinth")
    s.span("Brick plinth middle", g, (WEST - 0.28, 0.0, -LONG + 3 * bay + (bay + wide) / 2), (WEST + 0.06, 0.55, -LONG + 8 * bay + (bay - wide) / 2), "Plinth")
    s.span("Brick plinth south", g, (WEST - 0.28, 0.0, -LONG + 8 * bay + (bay + wide) / 2), (WEST + 0.06, 0.55, LONG + 0.03), "Plinth")
    for i, y in enumerate((3.35, 7.95)):
        s.span("String course %d" % (i + 1), g, (WEST - 0.28, y, -LONG - 0.04), (WEST + 0.10 + 0.12 * i, y + 0.18 + 0.08 * i, LONG + 0.04), "Limestone")
    s.span("Eaves board", g, (WEST - 0.04, 8.15, -LONG - 0.25), (WEST + 0.02, 8.58, LONG + 0.25), "White wood")
    rise, half = 2.6, deep / 2 + 0.45
    slope = math.degrees(math.atan2(rise, half))
    length = math.hypot(rise, half)
    for tag, sx in (("front", 1), ("back", -1)):
        s.box("Roof %s" % tag, g, (WEST - deep / 2 + sx * half / 2, top + 0.2 + rise / 2, 0), (length + 0.1, 0.18, 2 * LONG + 0.6), "Roof tiles",
              turn("z", -sx * slope))
    gable = Part("Render")
    for sz in (-1, 1):
        z = sz * (LONG - 0.1)
        corners = [(WEST, top, z), (WEST - deep, top, z), (WEST - deep / 2, top + rise - 0.05, z)]
        gable.polygon(corners if sz < 0 else corners[::-1])
    s.node("Gables", None, None, g, mesh=s.mesh("Gables", gable))
    for i, z in enumerate((-11.0, 2.0, 12.5)):
        s.span("Chimney %d" % (i + 1), g, (WEST - deep / 2 - 1.2, top + 1.2, z - 0.45), (WEST - deep / 2 - 0.5, top + 4.0, z + 0.45), "Brick 2")
        for j, dz in enumerate((-0.2, 0.2)):
            s.rod("Chimney %d pot %d" % (i + 1, j + 1), g, (WEST - deep / 2 - 0.85, top + 4.0, z + dz), (WEST - deep / 2 - 0.85, top + 4.5, z + dz), 0.13, "Roof tiles", 0.104)
    for i, (z, w) in enumerate(((-LONG + 1.5 * bay, 3.4), (-LONG + 10.5 * bay, 3.4))):
        cloth = Part("Awning")
        cloth.polygon([(0, 0, w / 2), (1.3, -0.55, w / 2), (1.3, -0.55, -w / 2), (0, 0, -w / 2)])
        cloth.polygon([(1.3, -0.55, w / 2), (1.3, -0.8, w / 2), (1.3, -0.8, -w / 2), (1.3, -0.55, -w / 2)])
        s.node("Awning %d" % (i + 1), (WEST + 0.03, 3.3, z), None, g, mesh=s.mesh("Awning", cloth))
    for i, z in enumerate((-LONG + 0.25, LONG - 0.25)):
        s.rod("Downpipe %d" % (i + 1), g, (WEST + 0.12, 0.14, z), (WEST + 0.12, 7.95, z), 0.06, "Dark iron")


def metal_house(s, root):
    """Bands of polished panels between bands of dark windows; each panel hangs a little out of true, as real ones do."""
    g = s.group("Metal house", root)
    rng = random.Random(53)
    top, deep = 17.2, 10.0
    s.span("Metal house body", g, (EAST + 0.12, -0.2, -LONG), (EAST + deep, top, LONG), "Concrete")
    s.span("Metal house parapet", g, (EAST - 0.05, top, -LONG - 0.05), (EAST + deep + 0.05, top + 0.35, LONG + 0.05), "Concrete")
    bays, storeys, low, rise = 14, 4, 3.7, 3.35
    bay = 2 * LONG / bays
    count = 0
    for j in range(storeys):
        y = low + rise * j
        for i in range(bays):
            z = -LONG + (i + 0.5) * bay
            s.span("Metal window %d.%d" % (j + 1, i + 1), g, (EAST + 0.06, y + 1.55, z - bay / 2 + 0.05), (EAST + 0.12, y + rise - 0.05, z + bay / 2 - 0.05), "Tinted glass")
            s.span("Metal mullion %d.%d" % (j + 1, i + 1), g, (EAST - 0.02, y + 1.5, z - bay / 2 - 0.04), (EAST + 0.12, y + rise, z - bay / 2 + 0.04), "Dark iron")
            s.span("Metal transom %d.%d" % (j + 1, i + 1), g, (EAST + 0.02, y + 2.3, z - bay / 2 + 0.04), (EAST + 0.12, y + 2.36, z + bay / 2 - 0.04), "Dark iron")
            count += 1
            s.box("Panel %d" % count, g, (EAST, y + 0.76, z), (0.04, 1.44, bay - 0.06), "Panel",
                  [rng.uniform(-0.004, 0.004), rng.uniform(-0.007, 0.007), rng.uniform(-0.007, 0.007), 1.0])
    for node in s.nodes:  # rotations of unit length
        if node["name"].startswith("Panel "):
            q = node["rotation"]
            node["rotation"] = [round(c / math.sqrt(sum(v * v for v in q)), 7) for c in q]
    for k in range(bays + 1):
        z = -LONG + k * bay
        s.rod("Column %d" % (k + 1), g, (EAST - 0.15, KERB, z), (EAST - 0.15, low - 0.25, z), 0.19, "Column metal" if k % 2 == 0 else "Concrete")
    s.span("Metal house fascia", g, (EAST - 0.35, low - 0.25, -LONG - 0.2), (EAST + 0.12, low, LONG + 0.2), "Concrete")
    for i in range(bays):
        z = -LONG + (i + 0.5) * bay
        s.span("Shop window %d" % (i + 1), g, (EAST + 0.06, 0.6, z - bay / 2 + 0.15), (EAST + 0.12, 3.2, z + bay / 2 - 0.15), "Tinted glass")
        for j, (y0, y1) in enumerate(((0.5, 0.6), (3.2, 3.3))):
            s.span("Shop frame %d.%d" % (i + 1, j + 1), g, (EAST + 0.0, y0, z - bay / 2 + 0.1), (EAST + 0.12, y1, z + bay / 2 - 0.1), "Dark iron")
        for j, sx in enumerate((-1, 1)):
            s.span("Shop post %d.%d" % (i + 1, j + 1), g, (EAST + 0.0, 0.6, z + sx * (bay / 2 - 0.125) - 0.025), (EAST + 0.12, 3.2, z + sx * (bay / 2 - 0.125) + 0.025), "Dark iron")


def end_houses(s, root):
    for tag, sz, wall in (("north", -1, "Render"), ("south", 1, "Render grey")):
        g = s.group("House " + tag, root, (0.0, 0.0, sz * (FAR + 0.0)), None if sz < 0 else turn("y", 180.0))
        s.span("House %s body" % tag, g, (-14.0, -0.2, -5.2), (14.0, 7.4, -0.02), wall)
        s.span("House %s eaves" % tag, g, (-14.4, 7.4, -5.5), (14.4, 7.65, 0.3), "Limestone")
        for side, sx in (("front", 1), ("back", -1)):
            s.box("House %s roof %s" % (tag, side), g, (0, 8.40, -2.6 + sx * 1.42), (28.8, 0.2, 3.3), "Roof tiles", turn("x", sx * 28.0))
        gable = Part(wall)
        for x in (-13.9, 13.9):
            corners = [(x, 7.6, 0.0), (x, 7.6, -5.2), (x, 9.0, -2.6)]
            gable.polygon(corners if x > 0 else corners[::-1])
        s.node("House %s gables" % tag, None, None, g, mesh=s.mesh("House %s gables" % tag, gable))
        for i in range(7):
            for j, (y0, y1) in enumerate(((1.1, 2.7), (4.2, 5.9))):
                x = -12.0 + 4.0 * i
                name = "House %s window %d.%d" % (tag, j + 1, i + 1)
                s.span(name, g, (x - 0.6, y0, -0.02), (x + 0.6, y1, 0.0), "Dark glass")
                for k, (x0, x1) in enumerate(((x - 0.7, x - 0.6), (x - 0.03, x + 0.03), (x + 0.6, x + 0.7))):
                    s.span("%s stile %d" % (name, k + 1), g, (x0, y0, -0.02), (x1, y1, 0.03), "White wood")
                for k, (a, b) in enumerate(((y0 - 0.1, y0), (y1, y1 + 0.1))):
                    s.span("%s rail %d" % (name, k + 1), g, (x - 0.75, a, -0.02), (x + 0.75, b, 0.05), "White wood")


def furniture(s, root):
    g = s.group("Street furniture", root)
    kinds = [s.mesh("Tree crown %d" % (k + 1), *tree(60 + k)) for k in range(2)]
    spots = [(-5.6, -21.0), (-5.6, -12.0), (-5.6, 12.5), (-5.6, 21.5), (5.9, -22.0), (5.9, 22.0)]
    for i, (x, z) in enumerate(spots):
        t = s.group("Tree %d" % (i + 1), g, (x, KERB, z), turn("y", 77.0 * i))
        s.node("Tree %d crown" % (i + 1), None, None, t, [0.95 + 0.04 * (i % 3)] * 3, mesh=kinds[i % 2])
        s.rod("Tree %d trunk" % (i + 1), t, (0, 0, 0), (0, 2.6, 0), 0.15, "Bark", 0.105)
        for k in range(3):
            a = 2.1 * k + i
            s.rod("Tree %d branch %d" % (i + 1, k + 1), t, (0, 1.9 + 0.2 * k, 0), (0.6 * math.cos(a), 2.8 + 0.2 * k, 0.6 * math.sin(a)), 0.06, "Bark", 0.03)
        s.box("Tree %d soil" % (i + 1), t, (0, 0.005, 0), (1.3, 0.012, 1.3), "Soil")
        for k, (x0, z0, lx, lz) in enumerate(((0, 0.68, 1.44, 0.08), (0, -0.68, 1.44, 0.08), (0.68, 0, 0.08, 1.28), (-0.68, 0, 0.08, 1.28))):
            s.box("Tree %d edging %d" % (i + 1, k + 1), t, (x0, 0.02, z0), (lx, 0.06, lz), "Granite")
    for i, (x, z) in enumerate(((-5.2, -16.5), (-5.2, -5.5), (-5.2, 5.5), (-5.2, 16.8), (5.2, -16.5), (5.2, -5.5), (5.2, 5.5), (5.2, 16.8))):
        p = s.group("Lamp post %d" % (i + 1), g, (x, KERB, z), turn("y", 0.0 if x < 0 else 180.0))
        s.box("Lamp post %d foot" % (i + 1), p, (0, 0.35, 0), (0.16, 0.7, 0.16), "Dark iron")
        s.rod("Lamp post %d pole" % (i + 1), p, (0, 0.7, 0), (0, 4.9, 0), 0.055, "Dark iron")
        s.rod("Lamp post %d arm" % (i + 1), p, (0, 4.85, 0), (0.9, 5.05, 0), 0.03, "Dark iron")
        s.rod("Lamp post %d hood" % (i + 1), p, (0.9, 4.95, 0), (0.9, 5.15, 0), 0.24, "Dark iron", 0.072)
        s.rod("Lamp post %d glass" % (i + 1), p, (0.9, 4.84, 0), (0.9, 4.95, 0), 0.12, "Lamp glass", 0.192)
    for i, (x, z) in enumerate(((WEST + 0.62, -3.0), (WEST + 0.62, 9.0), (7.6, -9.5), (7.6, 10.0))):
        b = s.group("Bench %d" % (i + 1), g, (x, KERB, z), turn("y", 90.0 if x < 0 else -90.0))
        for k in range(4):
            s.box("Bench %d slat %d" % (i + 1, k + 1), b, (0, 0.45, -0.18 + 0.12 * k), (1.7, 0.035, 0.095), "Bench wood")
        for k in range(3):
            s.box("Bench %d back %d" % (i + 1, k + 1), b, (0, 0.58 + 0.12 * k, -0.27 - 0.02 * k), (1.7, 0.095, 0.03), "Bench wood")
        for k, x0 in enumerate((-0.7, 0.7)):
            s.box("Bench %d leg %d" % (i + 1, k + 1), b, (x0, 0.215, 0.0), (0.06, 0.43, 0.4), "Dark iron")
            s.box("Bench %d stay %d" % (i + 1, k + 1), b, (x0, 0.64, -0.325), (0.05, 0.5, 0.03), "Dark iron", turn("x", -9.5))
    for i in range(9):
        s.rod("Bollard %d" % (i + 1), g, (5.25, KERB, -13.0 + 3.2 * i + (0.5 if i in (2, 6) else 0.0)), (5.25, KERB + 0.85, -13.0 + 3.2 * i + (0.5 if i in (2, 6) else 0.0)), 0.07, "Dark iron", 0.0602)
    rng = random.Random(54)
    for i, z in enumerate((-9.8, -1.0, 4.4, 14.6)):
        p = s.group("Planter %d" % (i + 1), g, (WEST + 0.4, KERB, z))
        s.box("Planter %d box" % (i + 1), p, (0, 0.24, 0), (0.55, 0.48, 1.3), "Concrete")
        s.box("Planter %d soil" % (i + 1), p, (0, 0.485, 0), (0.45, 0.012, 1.2), "Soil")
        shrub = Part("Leaf 2")
        for k in range(3):
            blob(shrub, (0.0, 0.62, -0.4 + 0.4 * k), 0.27 + 0.05 * rng.random(), rng, 12, 8)
        s.node("Planter %d shrub" % (i + 1), None, None, p, mesh=s.mesh("Shrub %d" % (i + 1), shrub))
    s.rod("Litter bin", g, (WEST + 0.4, KERB, 1.0), (WEST + 0.4, KERB + 0.8, 1.0), 0.22, "Dark iron", 0.25)
    box = s.group("Post box", g, (7.6, KERB, 0.0))
    s.rod("Post box body", box, (0, 0, 0), (0, 1.3, 0), 0.24, "Red glass")
    s.rod("Post box cap", box, (0, 1.3, 0), (0, 1.42, 0), 0.28, "Red glass", 0.112)
    s.box("Post box slot", box, (-0.235, 1.1, 0), (0.03, 0.04, 0.26), "Dark iron")


def car(s, root):
    """4.3 m long, heads along +z; its origin lies on the road under its middle."""
    c = s.group("Car", root, CAR)
    body = Part("Car paint")
    # Sections across its length: z, half width, bottom, top; each a ring of a rounded rectangle.
    stations = [(-2.15, 0.62, 0.42, 0.78), (-2.12, 0.72, 0.34, 0.86), (-2.0, 0.80, 0.28, 0.92), (-1.6, 0.86, 0.24, 0.95), (-0.9, 0.88, 0.23, 0.94),
                (0.0, 0.88, 0.23, 0.92), (0.7, 0.88, 0.23, 0.90), (1.3, 0.87, 0.24, 0.83), (1.8, 0.83, 0.26, 0.75), (2.05, 0.76, 0.32, 0.66), (2.15, 0.62, 0.40, 0.58)]
    rings = []
    for z, w, low, high in stations:
        h, mid = (high - low) / 2, (high + low) / 2
        rings.append([(p[0], p[2] + mid, z) for p in reversed(rounded(w, h, min(0.16, 0.8 * h), 0.0, 4))])
    loft(body, rings)
    cap(body, rings[0], False)
    cap(body, rings[-1], True)
    s.node("Car body", None, None, c, mesh=s.mesh("Car body", body))
    house, roof = Part("Dark glass"), Part("Car paint")
    levels = [(0.80, 1.30, 0.18, 0.86, -0.32), (0.79, 1.27, 0.18, 0.92, -0.32), (0.72, 1.02, 0.2, 1.18, -0.38), (0.66, 0.84, 0.2, 1.36, -0.42)]
    loft(house, [rounded(x, z, r, y, 4, 0.0, cz) for x, z, r, y, cz in levels])
    tops = [(0.67, 0.85, 0.2, 1.355, -0.42), (0.66, 0.84, 0.2, 1.39, -0.42), (0.60, 0.76, 0.2, 1.425, -0.42), (0.40, 0.5, 0.2, 1.44, -0.42)]
    skins = [rounded(x, z, r, y, 4, 0.0, cz) for x, z, r, y, cz in tops]
    loft(roof, skins)
    cap(roof, skins[-1])
    cap(roof, skins[0], False)
    s.node("Car windows", None, None, c, mesh=s.mesh("Car windows", house))
    s.node("Car roof", None, None, c, mesh=s.mesh("Car roof", roof))
    for i, (x, z0, z1) in enumerate(((-1, 0.915, 0.40), (1, 0.915, 0.40))):
        s.rod("Car pillar front %d" % (i + 1), c, (x * 0.765, 0.93, 0.84), (x * 0.655, 1.37, 0.32), 0.028, "Car paint")
        s.rod("Car pillar middle %d" % (i + 1), c, (x * 0.79, 0.92, -0.4), (x * 0.665, 1.37, -0.42), 0.028, "Car paint")
        s.rod("Car pillar rear %d" % (i + 1), c, (x * 0.765, 0.93, -1.5), (x * 0.655, 1.37, -1.18), 0.035, "Car paint")
        s.box("Car mirror %d" % (i + 1), c, (x * 0.93, 0.98, 0.62), (0.16, 0.1, 0.06), "Car paint")
        s.box("Car handle %d" % (i + 1), c, (x * 0.885, 0.78, -0.3), (0.02, 0.025, 0.16), "Chrome")
        s.rod("Car headlight %d" % (i + 1), c, (x * 0.56, 0.60, 1.98), (x * 0.56, 0.60, 2.14), 0.09, "Lamp glass", 0.081)
        s.box("Car tail light %d" % (i + 1), c, (x * 0.62, 0.68, -2.125), (0.22, 0.12, 0.06), "Red glass")
    s.rod("Car bumper front", c, (-0.7, 0.42, 2.13), (0.7, 0.42, 2.13), 0.055, "Chrome")
    s.rod("Car bumper rear", c, (-0.7, 0.44, -2.15), (0.7, 0.44, -2.15), 0.055, "Chrome")
    s.box("Car plate front", c, (0, 0.42, 2.19), (0.5, 0.11, 0.01), "White wood")
    s.box("Car plate rear", c, (0, 0.44, -2.21), (0.5, 0.11, 0.01), "White wood")
    for i, (x, z) in enumerate(((-1, 1.35), (1, 1.35), (-1, -1.35), (1, -1.35))):
        s.rod("Car wheel %d" % (i + 1), c, (x * 0.70, 0.31, z), (x * 0.90, 0.31, z), 0.31, "Rubber")
        s.rod("Car hub %d" % (i + 1), c, (x * 0.89, 0.31, z), (x * 0.915, 0.31, z), 0.19, "Chrome", 0.1501)
    return c


def edits():
    x, y, z = CAR
    write_edits(__file__, "drag.json", [{"kind": "drag", "node": "Car", "positions": along((x, y, z + 0.9), (x, y, 14.0), 31),
                                         "interval_ms": 16, "settle": True}])
    write_edits(__file__, "edits.json", [
        {"kind": "move", "node": "Car", "translation": [x, y, 0.0]},
        {"kind": "undo"},
        {"kind": "redo"},
        {"kind": "material", "material": "Car paint", "baseColor": [0.06, 0.12, 0.3]},
        {"kind": "delete", "node": "Panel 20"},
        {"kind": "undo"},
        {"kind": "add", "shape": "box", "name": "Crate", "translation": [-5.9, 0.5405, 2.6], "size": [0.8, 0.8, 0.8], "material": "Bench wood"},
        {"kind": "move", "node": "Crate", "translation": [-5.9, 0.5405, 7.0]},
        {"kind": "material", "material": "Panel", "roughness": 0.2},
        {"kind": "undo"},
        {"kind": "light", "node": "Sun", "intensity": 50000.0, "color": [1.0, 0.8, 0.6]},
        {"kind": "delete", "node": "Bench 1"},
        {"kind": "undo"},
        {"kind": "undo"},
        {"kind": "redo"}])


def main():
    s = LargeScene("Street", MATERIALS, sky=(3200.0, 4000.0, 5400.0))
    root = s.group("Street")
    ground(s, root)
    brick_house(s, root)
    metal_house(s, root)
    end_houses(s, root)
    furniture(s, root)
    car(s, root)
    s.lights.append({"name": "Sun", "type": "directional", "color": [1.0, 0.90, 0.76], "intensity": 70000.0})
    s.node("Sun", (-30.0, 20.0, -10.0), facing(SUN), root, extensions={"KHR_lights_punctual": {"light": 0}})
    s.camera("Along the street", (3.4, 1.65, 18.0), (-2.6, 2.8, -4.0), 55.0)
    s.camera("Brick front", (7.4, 2.2, 4.5), (-8.0, 3.2, -1.5), 55.0)
    s.camera("Metal front", (-6.4, 1.9, 9.6), (9.0, 6.0, -5.5), 62.0)
    s.camera("From a window", (8.6, 9.6, 9.0), (-7.0, 0.8, -3.0), 55.0)
    s.write(__file__)
    edits()
    d = reflect(SUN, (-1.0, 0.0, 0.0))
    t = (WEST - EAST) / d[0]
    print("from height y, z of the metal to y - %.2f, z + %.2f of the brick" % (-t * d[1], t * d[2]), file=sys.stderr)


if __name__ == "__main__":
    main()
