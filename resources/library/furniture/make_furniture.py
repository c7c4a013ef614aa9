#!/usr/bin/env python3
"""Writes the furniture of the library, one .glb file a piece, beside itself. Same script, same bytes.

Metres, +Y up, each piece stands on y = 0 about the origin with its front towards +z. A piece is one node, a part per
material, so that one click takes all of it and a material from the library goes to one part.
"""
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "..", "scenes"))
from small_scene import Part, Scene, glass, pbr, turn  # noqa: E402
from make_room import at, between, placed  # noqa: E402

# Linear reflectances as measured woods, fabrics and paints have them.
MATERIALS = {
    "Oak": pbr((0.47, 0.33, 0.19), 0.55),
    "Walnut": pbr((0.19, 0.115, 0.07), 0.5),
    "White lacquer": pbr((0.78, 0.78, 0.76), 0.35),
    "Black steel": pbr((0.035, 0.035, 0.037), 0.5),
    "Grey wool": pbr((0.29, 0.32, 0.34), 0.95),
    "Ochre wool": pbr((0.50, 0.32, 0.13), 0.95),
    "Linen": pbr((0.62, 0.57, 0.48), 0.95),
    "White cotton": pbr((0.80, 0.79, 0.76), 0.95),
    "Blue cotton": pbr((0.16, 0.24, 0.34), 0.95),
    "Leaf": pbr((0.07, 0.16, 0.05), 0.7, doubleSided=True),
    "Earthenware": pbr((0.45, 0.21, 0.12), 0.85),
    "Soil": pbr((0.05, 0.035, 0.025), 1.0),
    "Porcelain": pbr((0.77, 0.76, 0.72), 0.25),
    "Clear glass": glass((1.0, 1.0, 1.0), 1.5),
    "Book red": pbr((0.36, 0.07, 0.06), 0.8),
    "Book blue": pbr((0.07, 0.12, 0.25), 0.8),
    "Book cream": pbr((0.60, 0.54, 0.40), 0.8),
}


class Piece:
    """Parts by material, in the order of their first use."""

    def __init__(self):
        self.parts = {}

    def __call__(self, material):
        return self.parts.setdefault(material, Part(material))

    def legs(self, material, x, z, high, thick, foot=None, splay=0.0):
        """Four round legs with their heads at (+-x, high, +-z), feet `splay` metres further out."""
        for sx in (-1, 1):
            for sz in (-1, 1):
                self(material).tube(foot or thick, 0.0, 1.0, 14,
                                    between((sx * (x + splay), 0.0, sz * (z + splay)), (sx * x, high, sz * z)), top=thick)

    def posts(self, material, x, z, high, wide):
        """Four square legs, outer edges at +-x, +-z."""
        for sx in (-1, 1):
            for sz in (-1, 1):
                self(material).box((sx * (x - wide / 2), high / 2, sz * (z - wide / 2)), (wide, high, wide))

    def carcass(self, material, wide, high, deep, low, board=0.02, back=0.008):
        """An open box of boards, its front towards +z."""
        p = self(material)
        for s in (-1, 1):
            p.box((s * (wide - board) / 2, low + high / 2, 0.0), (board, high, deep))
        for y in (low + board / 2, low + high - board / 2):
            p.box((0.0, y, 0.0), (wide - 2 * board, board, deep))
        p.box((0.0, low + high / 2, -deep / 2 + back / 2), (wide - 2 * board, high - 2 * board, back))


def dining_table():
    p = Piece()
    p("Oak").cushion((0, 0.735, 0), (1.8, 0.03, 0.9), 0.006, 1)
    p("Oak").box((0, 0.68, 0.36), (1.5, 0.08, 0.022))
    p("Oak").box((0, 0.68, -0.36), (1.5, 0.08, 0.022))
    for s in (-1, 1):
        p("Oak").box((s * 0.76, 0.68, 0), (0.022, 0.08, 0.70))
    p.legs("Oak", 0.78, 0.36, 0.72, 0.032, 0.020, 0.035)
    return p


def round_table():
    p = Piece()
    top = [(0.0, 0.72), (0.545, 0.72), (0.545, 0.72), (0.55, 0.728), (0.55, 0.742), (0.545, 0.75), (0.545, 0.75), (0.0, 0.75)]
    p("White lacquer").lathe(top, 48)
    p("White lacquer").lathe([(0.0, 0.0), (0.28, 0.0), (0.28, 0.0), (0.285, 0.01), (0.20, 0.025), (0.06, 0.05), (0.035, 0.10),
                              (0.035, 0.55), (0.06, 0.66), (0.16, 0.72), (0.16, 0.72), (0.0, 0.72)], 40)
    return p


def coffee_table():
    p = Piece()
    p("Walnut").cushion((0, 0.385, 0), (1.1, 0.03, 0.6), 0.006, 1)
    p("Walnut").box((0, 0.16, 0), (1.0, 0.018, 0.5))
    p.posts("Black steel", 0.53, 0.28, 0.37, 0.025)
    return p


def desk():
    p = Piece()
    p("Oak").cushion((0, 0.735, 0), (1.4, 0.03, 0.7), 0.006, 1)
    p.carcass("White lacquer", 0.42, 0.13, 0.60, 0.59)
    p("White lacquer").box((0, 0.655, 0.305), (0.41, 0.12, 0.018))
    p("Black steel").box((0, 0.655, 0.322), (0.14, 0.012, 0.016))
    for s in (-1, 1):
        for z in (-0.30, 0.30):
            p("Black steel").box((s * 0.66, 0.36, z), (0.03, 0.72, 0.03))
        p("Black steel").box((s * 0.66, 0.705, 0), (0.03, 0.03, 0.57))
        p("Black steel").box((s * 0.66, 0.015, 0), (0.03, 0.03, 0.57))
    return p


def chair():
    p = Piece()
    p("Oak").cushion((0, 0.445, 0.01), (0.44, 0.03, 0.43), 0.012)
    for s in (-1, 1):
        p("Oak").tube(0.013, 0.0, 1.0, 14, between((s * 0.205, 0, 0.205), (s * 0.185, 0.44, 0.175)), top=0.018)
        p("Oak").tube(0.013, 0.0, 1.0, 14, between((s * 0.200, 0, -0.235), (s * 0.185, 0.44, -0.185)), top=0.018)
        p("Oak").tube(0.018, 0.0, 1.0, 14, between((s * 0.185, 0.44, -0.185), (s * 0.190, 0.80, -0.262)), top=0.013)
    # A bent back rest: a ring segment between the posts.
    rows, steps = [], 14
    for y, back in ((0.655, 0.0), (0.655, 1.0), (0.815, 1.0), (0.815, 0.0), (0.655, 0.0)):
        row = []
        for k in range(steps + 1):
            u = 2 * k / steps - 1
            x, z = 0.20 * u, -0.262 - 0.035 * (1 - u * u) - (0.016 if back else 0.0) - 0.21 * (y - 0.80)
            row.append((x, y, z))
        rows.append(row)
    for a, b in zip(rows, rows[1:]):
        for k in range(steps):
            p("Oak").polygon([a[k], a[k + 1], b[k + 1], b[k]][::-1])
    for row, flip in (([r[0] for r in rows[:4]], 1), ([r[-1] for r in rows[:4]], -1)):
        p("Oak").polygon(row[::flip][::-1])
    return p


def stool():
    p = Piece()
    p("Walnut").lathe([(0.0, 0.635), (0.165, 0.635), (0.165, 0.635), (0.17, 0.645), (0.165, 0.665), (0.165, 0.665), (0.0, 0.655)], 32)
    for k in range(4):
        a = math.pi / 4 + k * math.pi / 2
        c, s = math.cos(a), math.sin(a)
        p("Black steel").tube(0.011, 0.0, 1.0, 12, between((0.20 * c, 0, 0.20 * s), (0.12 * c, 0.64, 0.12 * s)))
        b = a + math.pi / 2
        p("Black steel").tube(0.008, 0.0, 1.0, 10, between((0.173 * c, 0.22, 0.173 * s),
                                                            (0.173 * math.cos(b), 0.22, 0.173 * math.sin(b))))
    return p


def armchair():
    p = Piece()
    p("Ochre wool").cushion((0, 0.26, 0), (0.74, 0.18, 0.74), 0.045, 3)
    p("Ochre wool").cushion((0, 0.0, 0), (0.74, 0.52, 0.15), 0.065, 3, placed(turn("x", -9), (0, 0.56, -0.315)))
    p("Ochre wool").cushion((0, 0.415, 0.05), (0.50, 0.14, 0.62), 0.055, 3)
    for s in (-1, 1):
        p("Ochre wool").cushion((s * 0.33, 0.43, 0.02), (0.12, 0.34, 0.70), 0.055, 3)
    p.legs("Walnut", 0.29, 0.28, 0.18, 0.022, 0.013, 0.03)
    return p


def sofa():
    p = Piece()
    cloth = p("Grey wool")
    cloth.cushion((0, 0.245, 0), (2.1, 0.22, 0.88), 0.035, 3)
    cloth.cushion((0, 0.52, -0.36), (1.74, 0.56, 0.16), 0.055, 3)
    for s in (-1, 1):
        cloth.cushion((s * 0.965, 0.37, 0), (0.19, 0.47, 0.9), 0.065, 3)
        cloth.cushion((s * 0.4345, 0.425, 0.085), (0.865, 0.15, 0.72), 0.06, 3)
        cloth.cushion((0, 0, 0), (0.84, 0.44, 0.17), 0.075, 3, placed(turn("x", -10), (s * 0.4345, 0.69, -0.195)))
    p("Linen").cushion((0, 0, 0), (0.42, 0.42, 0.14), 0.068, 3, placed(turn("x", -24), (0.60, 0.69, -0.005)))
    p.legs("Walnut", 0.93, 0.35, 0.14, 0.024, 0.016, 0.02)
    return p


def double_bed():
    p = Piece()
    p("Oak").cushion((0, 0.50, -1.015), (1.72, 0.92, 0.05), 0.012)
    for s in (-1, 1):
        p("Oak").box((s * 0.835, 0.26, 0.02), (0.03, 0.20, 2.02))
    p("Oak").box((0, 0.26, 1.015), (1.64, 0.20, 0.03))
    p("Oak").box((0, 0.235, 0.0), (1.64, 0.02, 2.0))
    for s in (-1, 1):
        p("Oak").box((s * 0.80, 0.13, 0.98), (0.05, 0.26, 0.05))
        p("Oak").box((s * 0.80, 0.13, -0.98), (0.05, 0.26, 0.05))
    p("White cotton").cushion((0, 0.36, 0), (1.60, 0.24, 1.98), 0.05, 3)
    p("Blue cotton").cushion((0, 0.455, 0.30), (1.70, 0.10, 1.42), 0.048, 3)
    p("White cotton").cushion((0, 0.462, -0.34), (1.70, 0.104, 0.24), 0.05, 3)
    for s in (-1, 1):
        p("White cotton").cushion((0, 0, 0), (0.70, 0.16, 0.42), 0.078, 3, placed(turn("x", 16), (s * 0.40, 0.545, -0.72)))
    return p


def bedside_table():
    p = Piece()
    p.carcass("White lacquer", 0.45, 0.30, 0.38, 0.18)
    p("White lacquer").box((0, 0.405, 0.185), (0.40, 0.14, 0.016))
    p("Black steel").box((0, 0.405, 0.20), (0.10, 0.012, 0.016))
    p("White lacquer").box((0, 0.325, 0), (0.41, 0.016, 0.36))
    p.legs("Oak", 0.19, 0.155, 0.18, 0.017, 0.011, 0.012)
    return p


def bookcase():
    p = Piece()
    wide, high, deep = 0.9, 1.9, 0.30
    p.carcass("Oak", wide, high, deep, 0.0, 0.022)
    levels = 5
    for k in range(1, levels):
        p("Oak").box((0, high * k / levels, 0.004), (wide - 0.044, 0.022, deep - 0.01))
    # Books of some shelves; their sizes run through a fixed row.
    sizes = [(0.032, 0.25, 0.18), (0.024, 0.22, 0.15), (0.040, 0.27, 0.20), (0.020, 0.20, 0.14), (0.028, 0.24, 0.17)]
    colours = ["Book blue", "Book cream", "Book red", "Book cream", "Book blue", "Book red", "Book cream"]
    number = 0
    for shelf, (start, count) in enumerate(((-0.40, 12), (0.05, 9), (-0.40, 17), (-0.20, 8))):
        x, floor = start, high * (shelf + 1) / levels + 0.011 if shelf else 0.022
        for _ in range(count):
            w, h, d = sizes[number % len(sizes)]
            if x + w > wide / 2 - 0.03:
                break
            p(colours[number % len(colours)]).box((x + w / 2, floor + h / 2, -deep / 2 + 0.012 + d / 2), (w - 0.001, h, d))
            x += w
            number += 1
    return p


def sideboard():
    p = Piece()
    p.carcass("Walnut", 1.6, 0.50, 0.42, 0.20, 0.022)
    for k in range(3):
        x = (k - 1) * 0.519
        p("Walnut").box((x, 0.45, 0.20), (0.510, 0.45, 0.018))
        p("Black steel").box((x + (0.20 if k == 0 else -0.20), 0.45, 0.217), (0.012, 0.14, 0.018))
    p.legs("Black steel", 0.72, 0.16, 0.20, 0.014, 0.014, 0.0)
    return p


def wardrobe():
    p = Piece()
    p.carcass("White lacquer", 1.2, 2.0, 0.60, 0.08, 0.022)
    p("White lacquer").box((0, 0.04, -0.02), (1.16, 0.08, 0.52))
    for s in (-1, 1):
        p("White lacquer").cushion((s * 0.2985, 1.08, 0.31), (0.590, 1.98, 0.02), 0.004, 1)
        p("Black steel").box((s * 0.045, 1.08, 0.33), (0.014, 0.30, 0.02))
    return p


def bench():
    p = Piece()
    p("Oak").cushion((0, 0.43, 0), (1.4, 0.035, 0.36), 0.01)
    for s in (-1, 1):
        p("Black steel").box((s * 0.58, 0.206, 0.14), (0.03, 0.412, 0.03))
        p("Black steel").box((s * 0.58, 0.206, -0.14), (0.03, 0.412, 0.03))
        p("Black steel").box((s * 0.58, 0.397, 0), (0.03, 0.03, 0.25))
    return p


def glass_vase():
    """Solid glass: the outer skin up, over the rim, down the inner skin; a thick base."""
    p = Piece()
    outer = [(0.042, 0.0), (0.055, 0.02), (0.066, 0.07), (0.066, 0.11), (0.052, 0.17), (0.040, 0.21), (0.042, 0.235), (0.055, 0.26)]
    inner = [(r - 0.005, y) for r, y in reversed(outer[1:])]
    p("Clear glass").lathe([(0.0, 0.0), outer[0], outer[0]] + outer[1:] + [outer[-1], inner[0], inner[0]] + inner[1:] +
                           [(0.034, 0.016), (0.0, 0.016)], 40)
    return p


def bowl():
    p = Piece()
    radius, height, steps = 0.14, 0.075, 10
    angles = [k / steps * math.pi / 2 for k in range(steps + 1)]
    outer = [(radius * (0.32 + 0.68 * math.sin(a)), height * (1 - math.cos(a))) for a in angles]
    inner = [(r - 0.004, y + 0.004 * (1 - k / steps)) for k, (r, y) in enumerate(outer)]
    p("Porcelain").lathe([(0.0, 0.0), outer[0], outer[0]] + outer[1:] + [outer[-1], inner[-1], inner[-1]] +
                         list(reversed(inner))[1:] + [(0.0, 0.004)], 40)
    return p


def potted_plant():
    p = Piece()
    p("Earthenware").lathe([(0.0, 0.0), (0.11, 0.0), (0.11, 0.0), (0.155, 0.26), (0.155, 0.26), (0.165, 0.26), (0.165, 0.26),
                            (0.165, 0.30), (0.165, 0.30), (0.148, 0.30), (0.148, 0.30), (0.142, 0.27)], 32)
    p("Soil").lathe([(0.144, 0.27), (0.08, 0.278), (0.0, 0.28)][::1], 32)
    golden = math.pi * (3 - math.sqrt(5))
    for k in range(26):
        a = k * golden
        lean = 0.25 + 0.75 * ((k * 7) % 26) / 26
        length = 0.46 + 0.30 * ((k * 11) % 26) / 26
        c, s = math.cos(a), math.sin(a)
        root = (0.03 * c, 0.27, 0.03 * s)
        spine, steps = [], 8
        for i in range(steps + 1):
            t = i / steps
            out, up = lean * length * t * (0.35 + 0.65 * t), length * t * (1.25 - 0.55 * lean * t)
            spine.append((root[0] + c * out, root[1] + up, root[2] + s * out))
        rows = []
        for i, q in enumerate(spine):
            t = i / steps
            w = 0.006 + 0.034 * math.sin(math.pi * min(1.0, t * 0.92 + 0.04)) ** 1.5 if i < steps else 0.002
            ahead, behind = spine[min(i + 1, steps)], spine[max(i - 1, 0)]
            d = [ahead[j] - behind[j] for j in range(3)]
            side = (-s, 0.0, c)
            n = (d[1] * side[2] - d[2] * side[1], d[2] * side[0] - d[0] * side[2], d[0] * side[1] - d[1] * side[0])
            n = n if n[1] > 0 else tuple(-v for v in n)
            fold = 0.25 * w
            rows.append([((q[0] - side[0] * w, q[1] + fold, q[2] - side[2] * w), n), (q, n),
                         ((q[0] + side[0] * w, q[1] + fold, q[2] + side[2] * w), n)])
        p("Leaf").grid([list(reversed(row)) for row in rows], lambda v: v)
    return p


PIECES = [dining_table, round_table, coffee_table, desk, chair, stool, armchair, sofa, bench, double_bed, bedside_table, bookcase,
          sideboard, wardrobe, glass_vase, bowl, potted_plant]


def main():
    for make in PIECES:
        piece = make()
        name = make.__name__.replace("_", " ").capitalize()
        scene = Scene(name, {key: MATERIALS[key] for key in piece.parts})
        scene.node(name, mesh=scene.mesh(name, *piece.parts.values()))
        scene.write_to(os.path.join(HERE, make.__name__ + ".glb"), "resources/library/furniture/make_furniture.py")


if __name__ == "__main__":
    main()
