#!/usr/bin/env python3
"""Writes lamp.glb beside this script: a bulb under a metal shade, beside it a glass and a satin bowl."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from small_scene import Part, Scene, glass, glowing, pbr  # noqa: E402

BULB = 0.03                                      # metres, radius
LUMEN = 800.0
NITS = LUMEN / (4 * math.pi * BULB ** 2 * math.pi)  # evenly over a sphere


def main():
    s = Scene("Lamp", {"Table": pbr((0.62, 0.58, 0.52), 0.8), "Wall": pbr((0.72, 0.70, 0.67), 0.9),
                       "Brushed brass": {**pbr((0.91, 0.76, 0.47), 0.25, 1.0), "doubleSided": True},
                       "Satin steel": {**pbr((0.75, 0.76, 0.77), 0.15, 1.0), "doubleSided": True},
                       "Foot": pbr((0.05, 0.05, 0.05), 0.7), "Glass": glass(ior=1.5),
                       "Bulb": glowing((1.0, 0.82, 0.6), round(NITS, 1))})
    table, wall = Part("Table"), Part("Wall")
    table.polygon([(-0.7, 0, 0.5), (0.7, 0, 0.5), (0.7, 0, -0.5), (-0.7, 0, -0.5)])
    wall.polygon([(-0.7, 0, -0.5), (0.7, 0, -0.5), (0.7, 1.0, -0.5), (-0.7, 1.0, -0.5)])
    wall.polygon([(-0.7, 0, 0.5), (-0.7, 0, -0.5), (-0.7, 1.0, -0.5), (-0.7, 1.0, 0.5)])
    s.node("Table", mesh=s.mesh("Table", table))
    s.node("Walls", mesh=s.mesh("Walls", wall))
    foot, shade, bulb = Part("Foot"), Part("Brushed brass"), Part("Bulb")
    foot.tube(0.07, 0.0, 0.015, 48)
    foot.tube(0.008, 0.015, 0.30, 24)
    s.node("Lamp foot", (-0.25, 0.0, -0.1), mesh=s.mesh("Lamp foot", foot))
    bulb.sphere((0.0, 0.0, 0.0), BULB, 32, 16)
    s.node("Bulb", (-0.25, 0.335, -0.1), mesh=s.mesh("Bulb", bulb, shape={"kind": "sphere", "radius": BULB}))
    shade.lathe([(0.05 + 0.06 * (1 - (1 - k / 8) ** 2), 0.44 - 0.15 * k / 8) for k in range(8, -1, -1)], 96)
    s.node("Shade", (-0.25, 0.0, -0.1), mesh=s.mesh("Shade", shade))
    tumbler = Part("Glass")
    tumbler.lathe([(0.0, 0.0), (0.030, 0.0), (0.030, 0.0), (0.036, 0.11), (0.036, 0.11), (0.033, 0.11), (0.033, 0.11),
                   (0.028, 0.014), (0.020, 0.010), (0.0, 0.010)], 96)
    s.node("Tumbler", (0.02, 0.0005, 0.08), mesh=s.mesh("Tumbler", tumbler))
    bowl = Part("Satin steel")
    bowl.lathe([(0.03 + 0.07 * math.sin(0.5 * math.pi * k / 10), 0.002 + 0.05 * (1 - math.cos(0.5 * math.pi * k / 10)))
                for k in range(11)], 96)
    s.node("Bowl", (0.28, 0.0, -0.12), mesh=s.mesh("Bowl", bowl))
    s.camera("Across the table", (0.45, 0.42, 0.75), (-0.05, 0.12, -0.08), 42.0)
    s.write(__file__)


if __name__ == "__main__":
    main()
