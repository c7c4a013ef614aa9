#!/usr/bin/env python3
"""Writes sun-mirror.glb beside this script: sun through a window onto a mirror that throws a patch on the wall."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from small_scene import Part, Scene, glass, pbr  # noqa: E402

W, E, N, S, H = -2.0, 2.0, -2.5, 2.5, 2.7  # inner faces of the room, x from west to east, z from north to south
X0, X1, Y0, Y1 = -0.5, 1.3, 0.9, 2.2       # the window in the south wall
OUT = 0.25                                 # thickness of that wall
SUN = (-0.20, -0.42, -0.885)
MIRROR_Y = 0.752                           # it lies on the table; the sun leaves it as steeply as it came


def main():
    s = Scene("Sun and mirror", {"Wall": pbr((0.75, 0.74, 0.71), 0.9), "Floor": pbr((0.42, 0.31, 0.21), 0.7),
                                 "Ceiling": pbr((0.85, 0.85, 0.84), 0.9), "Table": pbr((0.28, 0.18, 0.11), 0.7),
                                 "Silver": pbr((0.93, 0.94, 0.94), 0.0, 1.0), "Pane": glass(solid=False)},
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
    pane = Part("Pane")
    z = S + 0.5 * OUT
    pane.polygon([(X1, Y0, z), (X0, Y0, z), (X0, Y1, z), (X1, Y1, z)])
    s.node("Window pane", mesh=s.mesh("Window pane", pane))
    table = Part("Table")
    table.box((0.0, 0.73, 0.5), (1.4, 0.04, 0.8))
    for x in (-0.62, 0.62):
        for leg in (0.18, 0.82):
            table.box((x, 0.355, leg), (0.06, 0.71, 0.06))
    s.node("Table", mesh=s.mesh("Table", table))
    mirror = Part("Silver")
    mirror.polygon([(-0.3, 0, 0.2), (0.3, 0, 0.2), (0.3, 0, -0.2), (-0.3, 0, -0.2)])
    s.node("Mirror", (0.0, MIRROR_Y, 0.5), mesh=s.mesh("Mirror", mirror))
    s.sun(SUN, 45000.0, (1.0, 0.88, 0.72), (1.0, 3.5, 5.0))
    s.camera("From the window", (1.5, 1.6, 2.3), (-0.45, 1.25, -1.6), 58.0)
    s.write(__file__)


if __name__ == "__main__":
    main()
