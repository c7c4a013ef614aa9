#!/usr/bin/env python3
"""Writes glass-ball.glb beside this script: a glass ball on a table in the sun."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from small_scene import Part, Scene, glass, pbr  # noqa: E402

RADIUS = 0.05
SUN = (0.8, -math.tan(math.radians(35.0)), 0.6)  # 35 degrees high


def main():
    s = Scene("Glass ball", {"Table": pbr((0.72, 0.70, 0.66), 0.9), "Glass": glass(ior=1.52)}, sky=(700.0, 850.0, 1050.0))
    table = Part("Table")
    table.box((0.0, -0.02, 0.0), (0.9, 0.04, 0.6))
    s.node("Table", mesh=s.mesh("Table", table))
    ball = Part("Glass")
    ball.sphere((0.0, 0.0, 0.0), RADIUS, 64, 32)
    s.node("Ball", (-0.08, RADIUS + 0.0005, -0.03),
           mesh=s.mesh("Ball", ball, shape={"kind": "sphere", "radius": RADIUS}))
    s.sun(SUN, 70000.0, (1.0, 0.94, 0.86), (-0.8, 0.8, -0.6))
    s.camera("Over the table", (0.12, 0.26, 0.42), (-0.01, 0.02, 0.0), 40.0)
    s.write(__file__)


if __name__ == "__main__":
    main()
