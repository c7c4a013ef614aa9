#!/usr/bin/env python3
"""Plays the manual's example (resources/manual/example.md) as it stands: its files are written, its commands run in order.

Needs ATRIUM_CLI and ATRIUM_SOURCE_DIR. With --keep FOLDER what it made stays there, as example.png for the manual.
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT, CLI = os.environ["ATRIUM_SOURCE_DIR"], os.environ["ATRIUM_CLI"]


def require(fine, what):
    if not fine:
        sys.exit("example.md: " + what)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def main():
    with open(os.path.join(ROOT, "resources", "manual", "example.md"), encoding="utf-8") as file:
        text = file.read()
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(os.path.join(ROOT, "scenes", "empty-room", "empty-room.glb"), folder)
        for name, kind in (("furnish.json", "json"), ("desk.csv", "csv")):
            found = re.search(r"`%s`.*?```%s\n(.*?)```" % (re.escape(name), kind), text, re.S)
            require(found, "no text of " + name)
            with open(os.path.join(folder, name), "w") as out:
                out.write(found.group(1))
        commands = [line for block in re.findall(r"```sh\n(.*?)```", text, re.S) for line in block.splitlines()]
        require(len(commands) >= 10, "its commands are gone")
        for command in commands:
            run = subprocess.run(re.sub(r"^atrium-cli", lambda _: '"%s"' % CLI, command), shell=True, cwd=folder, capture_output=True,
                                 text=True)
            require(run.returncode == 0, "%s: exit status %d: %s" % (command, run.returncode, run.stderr.strip()[-500:]))
            print(command + "\n" + "".join("    %s\n" % line for line in run.stdout.splitlines()[:12]))
        if sys.argv[1:2] == ["--keep"]:
            shutil.copytree(folder, sys.argv[2], dirs_exist_ok=True)
        desk, corner = rows(os.path.join(folder, "desk_lux.csv"))
        truth = rows(os.path.join(folder, "desk_truth.csv"))[0]
        require(desk["on_surface"] == "1" and corner["on_surface"] == "1", "its points are on no surface")
        require(float(desk["E"]) > float(corner["E"]) + 300 > 300, "the lamp over the desk lights nothing: %s lx, %s lx far from it" % (desk["E"], corner["E"]))
        off = abs(float(desk["E"]) / float(truth["E"]) - 1)
        require(off < 0.1 + 3 * float(truth["stderr"]) / float(truth["E"]), "the desk is %.0f %% from the truth" % (100 * off))
        with open(os.path.join(folder, "furnished.json")) as file:
            require(json.load(file)["converged"], "its light is not complete")
        for picture in ("example.png", "lux.png", "furnished.glb"):
            require(os.path.getsize(os.path.join(folder, picture)) > 5000, picture + " is empty")
    return 0


if __name__ == "__main__":
    sys.exit(main())
