#!/usr/bin/env python3
"""Writes empty-room.glb beside this script: four walls, a window in the sun, nothing in it. The manual's example starts here."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from small_scene import Part, Scene, glass, glowing, pbr  # noqa: E402

W, E, N, S, H = -2.0, 2.0, -2.5, 2.5, 2.6  # inner faces of the room, x from west to east, z from north to south
X0, X1, Y0, Y1 = -1.0, 1.0, 0.9, 2.2       # the window in the south wall
OUT = 0.25                                 # thickness of that wall


def main():
    # The last four are for what is put into the room.
    s = Scene("Empty room", {"Wall": pbr((0.75, 0.74, 0.71), 0.9), "Floor": pbr((0.42, 0.31, 0.21), 0.7),
                             "Ceiling": pbr((0.85, 0.85, 0.84), 0.9), "Oak": pbr((0.45, 0.31, 0.18), 0.7),
                             "Chrome": pbr((0.9, 0.9, 0.9), 0.0, 1.0), "Glass": glass(), "Lamp": glowing((1.0, 0.86, 0.7), 9000.0)},
              sky=(1900.0, 2200.0, 2700.0))
    floor, ceiling, wall = Part("Floor"), Part("Ceiling"), Part("Wall")
    floor.polygon([(W, 0, S), (E, 0, S), (E, 0, N), (W, 0, N)])
    ceiling.polygon([(W, H, N), (E, H, N), (E, H, S), (W, H, S)])
    wall.polygon([(W, 0, N), (E, 0, N), (E, H, N), (W, H, N)])
    wall.polygon([(W, 0, S), (W, 0, N), (W, H, N), (W, H, S)])
    wall.polygon([(E, 0, N), (E, 0, S), (E, H, S), (E, H, N)])
    for x0, x1, y0, y1 in ((W, X0, 0, H), (X1, E, 0, H), (X0, X1, 0, Y0), (X0, X1, Y1, H)):
        wall.polygon([(x1, y0, S), (x0, y0, S), (x0, y1, S), (x1, y1, S)])
        wall.polygon([(x0, y0, S + OUT), (x1, y0, S + OUT), (x1, y1, S + OUT), (x0, y1, S + OUT)])
    wall.polygon([(X0, Y0, S), (X1, Y0, S), (X1, Y0, S + OUT), (X0, Y0, S + OUT)])
    wall.polygon([(X0, Y1, S + OUT), (X1, Y1, S + OUT), (X1, Y1, S), (X0, Y1, S)])
    wall.polygon([(X0, Y0, S), (X0, Y0, S + OUT), (X0, Y1, S + OUT), (X0, Y1, S)])
    wall.polygon([(X1, Y0, S + OUT), (X1, Y0, S), (X1, Y1, S), (X1, Y1, S + OUT)])
    for name, part in (("Floor", floor), ("Ceiling", ceiling), ("Walls", wall)):
        s.node(name, mesh=s.mesh(name, part))
    s.sun((0.35, -0.6, -0.72), 40000.0, (1.0, 0.93, 0.84), (-1.0, 3.5, 5.0))
    s.camera("From the door", (1.6, 1.55, 2.2), (-0.7, 0.9, -1.4), 58.0)
    s.write(__file__)


if __name__ == "__main__":
    main()
