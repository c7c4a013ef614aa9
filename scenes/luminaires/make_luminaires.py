#!/usr/bin/env python3
"""Writes the photometric files beside it: luminaires as formulas have them, in IES LM-63 form."""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def rad(degrees):
    return math.radians(degrees)


def narrow(v, _):
    """A core of 10 degrees to half its intensity, and a weak rim that ends at 60."""
    core = math.exp(-math.log(2) * (v / 10.0) ** 2)
    return core + (0.05 * math.cos(rad(1.5 * v)) if v < 60 else 0.0)


def washer(v, h):
    """A lobe towards C90, 37 degrees from nadir, over a weak one straight down."""
    y, down = math.sin(rad(v)) * math.sin(rad(h)), math.cos(rad(v))
    to_wall = (0.75 * y + down) / math.hypot(0.75, 1.0)
    return (math.exp(14 * (to_wall - 1)) + 0.18 * math.exp(6 * (down - 1))) * max(0.0, min(1.0, (90 - v) / 15))


def pendant(v, h):
    """Two wings across (C90) below, less and wider above."""
    across = math.sin(rad(h)) ** 2
    if v <= 90:
        return math.cos(rad(v)) ** 1.2 * (1 + 1.1 * across * math.exp(-((v - 38) / 18) ** 2)) if v < 90 else 0.0
    return 0.55 * math.cos(rad(180 - v)) ** 0.6 * (1 + 0.4 * across * math.exp(-((v - 125) / 20) ** 2))


def integral(shape, vertical, horizontal):
    """Flux of intensities that are linear in the angles between these, over the whole circle."""
    planes = horizontal if len(horizontal) > 1 else [0, 360]
    total = circle = 0.0
    for h0, h1 in zip(planes, planes[1:]):
        circle += rad(h1 - h0)
        for v0, v1 in zip(vertical, vertical[1:]):
            a, b = rad(v0), rad(v1)
            f0 = 0.5 * (shape(v0, h0) + shape(v0, h1))
            f1 = 0.5 * (shape(v1, h0) + shape(v1, h1))
            total += rad(h1 - h0) * (f0 * math.cos(a) - f1 * math.cos(b) + (f1 - f0) / (b - a) * (math.sin(b) - math.sin(a)))
    return total * 2 * math.pi / circle


def write(name, version, label, number, watts, size, vertical, horizontal, shape, lumens):
    scale = lumens / integral(shape, vertical, horizontal)

    def rows(values):
        words = ["%g" % round(value, 1) for value in values]
        return [" ".join(words[k:k + 13]) for k in range(0, len(words), 13)]

    lines = ["IESNA:LM-63-%d" % version, "[TEST] computed from a formula, not measured", "[TESTLAB] Atrium",
             "[ISSUEDATE] 2026", "[MANUFAC] Atrium", "[LUMCAT] " + number, "[LUMINAIRE] " + label, "[LAMP] LED", "TILT=NONE",
             "1 -1 1 %d %d 1 2 %s" % (len(vertical), len(horizontal), size), "1 1 %g" % watts]
    lines += rows(vertical) + rows(horizontal)
    for h in horizontal:
        lines += rows(scale * shape(v, h) for v in vertical)
    with open(os.path.join(HERE, name), "wb") as f:
        f.write("".join(line + "\r\n" for line in lines).encode("ascii"))


def steps(first, last, step):
    return [first + step * k for k in range(round((last - first) / step) + 1)]


write("narrow_downlight.ies", 2002, "Recessed downlight, 20 degree beam", "A-DL20", 9, "-0.08 0 0",
      steps(0, 90, 2.5), [0], narrow, 800)
# Symmetric about the plane C90-C270, which LM-63 wrote like this in 1995.
write("wall_washer.ies", 1995, "Recessed wall washer, light towards C90", "A-WW", 14, "0.12 0.12 0",
      steps(0, 90, 2.5), steps(90, 270, 15), washer, 1200)
write("linear_pendant.ies", 2002, "Linear pendant, direct and indirect", "A-LP12", 38, "1.2 0.08 0.06",
      steps(0, 180, 5), steps(0, 90, 15), pendant, 4000)
