#!/usr/bin/env python3
"""Checks the direction of #include lines (LAYOUT in ARCHITECTURE.md) and where heavy libraries may be seen.

usage: check_layers.py SOURCE_DIR     exit 1 with one line per violation
       check_layers.py --self-test    plants violations and makes sure that each is found
"""
import os
import re
import sys
import tempfile

# Each engine folder may include itself and those before it.
ENGINE = ["base", "geometry", "scene", "optics", "io", "raycast", "radiosity", "particles", "caustics", "layers", "update", "solver",
          "view", "reference", "measure", "session", "debug"]
UI_MAY_SEE = {"base", "scene", "solver", "session", "io", "measure", "view", "debug", "layers"}
# Header pattern, where it may appear, what to do instead. The first match counts.
LIBRARIES = [
    (re.compile(r"^glm/"), lambda p: p == "engine/base/math.h", "include engine/base/math.h"),
    (re.compile(r"^embree"), lambda p: p.startswith("engine/raycast/"), "use engine/raycast/ray_scene.h"),
    (re.compile(r"^OpenMesh/"), lambda p: p.startswith("engine/geometry/"), "use what engine/geometry offers"),
    (re.compile(r"^(tiny_gltf|tinygltf)"), lambda p: p.startswith("engine/io/") and p.endswith(".cpp"),
     "use engine/io/scene_file.h"),
    (re.compile(r"^OpenImageIO/"), lambda p: p.startswith("engine/io/") and p.endswith(".cpp"), "use engine/io/image_file.h"),
    (re.compile(r"^(Q[A-Z]\w*|Qt\w*/.*|qt\w*\.h|GL/.*|GLES\d?/.*)$"),
     lambda p: p.startswith("ui/") or p == "app/main_editor.cpp", "the engine and atrium-cli know no Qt and no OpenGL"),
    (re.compile(r"^CLI/"), lambda p: p.startswith("app/") and p != "app/main_editor.cpp", "parse arguments in app/"),
]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]')
CODE = (".h", ".hpp", ".cpp", ".cc")


def judge(path, quote, header):
    """What is wrong with this include, or None."""
    for pattern, allowed, advice in LIBRARIES:
        if pattern.match(header):
            return None if allowed(path) else "<%s> has no place here: %s" % (header, advice)
    if quote == "<" and not header.startswith(("engine/", "ui/", "app/")):
        return None
    top = path.split("/")[0]
    target = header.split("/")
    if target[0] not in ("engine", "ui", "app"):
        if quote == '"':
            return '"%s" is not written from the root of the sources' % header
        return None
    order = {"engine": 0, "ui": 1, "app": 2}
    if order[target[0]] > order[top]:
        return '"%s": %s may not include %s (app -> ui -> engine)' % (header, top, target[0])
    if top == "app":
        if target[0] == "ui" and path != "app/main_editor.cpp":
            return '"%s": atrium-cli links no Qt' % header
        return None
    if target[0] != "engine":
        return None
    if len(target) < 3 or target[1] not in ENGINE:
        return '"%s": engine/%s is not a folder of the engine' % (header, target[1])
    if top == "ui":
        return None if target[1] in UI_MAY_SEE else '"%s": ui may not see engine/%s' % (header, target[1])
    own = path.split("/")[1]
    if own not in ENGINE:
        return "%s is not a folder of the engine: add it to check_layers.py in its place" % own
    if ENGINE.index(target[1]) > ENGINE.index(own):
        return '"%s": engine/%s comes before engine/%s and may not include it' % (header, own, target[1])
    return None


def check(root):
    problems, files = [], 0
    for top in ("engine", "ui", "app"):
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders.sort()
            for name in sorted(names):
                if not name.endswith(CODE):
                    continue
                files += 1
                full = os.path.join(folder, name)
                path = os.path.relpath(full, root).replace(os.sep, "/")
                with open(full, encoding="utf-8", errors="replace") as f:
                    for number, line in enumerate(f, 1):
                        found = INCLUDE.match(line)
                        wrong = judge(path, *found.groups()) if found else None
                        if wrong:
                            problems.append("%s:%d: %s" % (path, number, wrong))
    return problems, files


PLANTED = [
    ("engine/io/a.cpp", '#include "engine/raycast/ray_scene.h"'),
    ("engine/base/a.h", '#include "engine/scene/scene.h"'),
    ("engine/solver/a.cpp", '#include "ui/document/document.h"'),
    ("engine/solver/b.cpp", "#include <QObject>"),
    ("engine/solver/c.cpp", "#include <QtWidgets/QWidget>"),
    ("engine/scene/a.h", "#include <glm/vec3.hpp>"),
    ("engine/scene/b.h", "#include <embree3/rtcore.h>"),
    ("engine/io/a.h", "#include <tiny_gltf.h>"),
    ("engine/view/a.cpp", "#include <OpenImageIO/imageio.h>"),
    ("engine/scene/c.h", "  #  include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>"),
    ("engine/scene/d.cpp", '#include "scene.h"'),
    ("engine/shiny/a.cpp", '#include "engine/base/math.h"'),
    ("ui/panels/a.cpp", '#include "engine/raycast/ray_scene.h"'),
    ("ui/panels/b.cpp", '#include "app/cli_support.h"'),
    ("app/cli_a.cpp", '#include "ui/document/document.h"'),
    ("app/cli_b.cpp", "#include <QString>"),
    ("engine/solver/d.cpp", "#include <CLI/App.hpp>"),
]
ALLOWED = [
    ("engine/base/math.h", "#include <glm/vec3.hpp>"),
    ("engine/io/b.cpp", "#include <tiny_gltf.h>"),
    ("engine/raycast/a.cpp", "#include <embree3/rtcore.h>"),
    ("engine/solver/e.cpp", '#include "engine/layers/surface_layer.h"'),
    ("engine/solver/f.cpp", "#include <vector>"),
    ("engine/solver/g.cpp", '// #include "ui/document/document.h"'),
    ("ui/panels/c.cpp", '#include "engine/solver/solution.h"'),
    ("ui/panels/d.cpp", "#include <QWidget>"),
    ("app/main_editor.cpp", '#include "ui/window/main_window.h"'),
    ("app/cli_c.cpp", '#include "engine/raycast/ray_scene.h"'),
]


def self_test():
    failures = []
    for planted, expected in ((PLANTED, 1), (ALLOWED, 0)):
        for path, line in planted:
            with tempfile.TemporaryDirectory() as root:
                full = os.path.join(root, path)
                os.makedirs(os.path.dirname(full))
                with open(full, "w", encoding="utf-8") as f:
                    f.write("// a file\n" + line + "\n")
                problems, files = check(root)
                if len(problems) != expected or files != 1:
                    failures.append("%s with %s: %d problems, expected %d %s" % (path, line, len(problems), expected, problems))
                elif expected and ":2: " not in problems[0]:
                    failures.append("%s: wrong line in %s" % (path, problems[0]))
    return failures


def main():
    if sys.argv[1:] == ["--self-test"]:
        failures = self_test()
        print("\n".join(failures) if failures else "%d violations found, %d fine lines passed" % (len(PLANTED), len(ALLOWED)))
        return 1 if failures else 0
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    problems, files = check(sys.argv[1])
    if files == 0:
        print("no sources below %s" % sys.argv[1], file=sys.stderr)
        return 2
    print("\n".join(problems) if problems else "%d files: includes point the right way" % files)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
