#!/usr/bin/env python3
"""Writes ring.glb beside this script: a polished ring on a floor in the sun."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from small_scene import Part, Scene, pbr  # noqa: E402

RADIUS, HEIGHT, WALL = 0.1, 0.02, 0.003
SEGMENTS = 256


def main():
    s = Scene("Ring", {"Floor": pbr((0.7, 0.68, 0.64), 0.9), "Polished gold": pbr((0.95, 0.79, 0.45), 0.0, 1.0),
                       "Outside": pbr((0.35, 0.29, 0.18), 0.8)}, sky=(900.0, 1050.0, 1250.0))
    floor = Part("Floor")
    floor.polygon([(-0.4, 0, 0.4), (0.4, 0, 0.4), (0.4, 0, -0.4), (-0.4, 0, -0.4)])
    s.node("Floor", mesh=s.mesh("Floor", floor))
    inside, outside = Part("Polished gold"), Part("Outside")
    inside.lathe([(RADIUS, HEIGHT), (RADIUS, 0.0)], SEGMENTS)
    outside.lathe([(RADIUS + WALL, 0.0), (RADIUS + WALL, HEIGHT), (RADIUS + WALL, HEIGHT), (RADIUS, HEIGHT)], SEGMENTS)
    s.node("Ring", mesh=s.mesh("Ring", inside, outside))
    s.sun((1.0, -1.0, 0.0), 80000.0, (1.0, 0.96, 0.9), (-0.5, 0.5, 0.0))
    s.camera("Above", (0.0, 0.36, 0.30), (0.02, 0.0, 0.0), 40.0)
    s.write(__file__)


if __name__ == "__main__":
    main()
