#!/usr/bin/env python3
"""Solves scenes with atrium-cli and prints one line each: load, first picture, solve, memory, error.

usage: interiors.py ATRIUM_CLI [--quality Q] [--threads N] [--pictures DIR] FILE...

Times are wall clock, in one run after another on whatever else the machine does: compare ratios within one table.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cli")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--quality", default="normal")
    parser.add_argument("--threads", default="0")
    parser.add_argument("--pictures", help="also render each scene into this folder")
    a = parser.parse_args()
    print("| scene | triangles | load s | first picture s | solve s | peak MiB | elements | links | Mrays | error est. | energy defect |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    failed = False
    for name in a.files:
        with tempfile.TemporaryDirectory() as folder:
            stats = pathlib.Path(folder) / "stats.json"
            project = pathlib.Path(folder) / "solved.atrium"
            run = subprocess.run([a.cli, "solve", name, "-o", project, "--daylight", "--quality", a.quality, "--threads", a.threads,
                                  "--stats", stats], capture_output=True, text=True)
            stem = pathlib.Path(name).stem
            if run.returncode != 0:
                failed = True
                print(f"| {stem} | failed: {run.stderr.strip()} |")
                continue
            s = json.loads(stats.read_text())
            t = s["time"]
            print(f"| {stem} | {s['scene']['triangles']} | {t['load']:.2f} | {t['first_picture']:.2f} | {t['solve']:.2f} "
                  f"| {s['memory']['peak_rss'] / 2**20:.0f} | {s['elements']} | {s['links']} | {s['rays'] / 1e6:.1f} "
                  f"| {s['error_estimate']:.3f} | {s['energy']['defect']:+.4f} |", flush=True)
            if a.pictures:
                pathlib.Path(a.pictures).mkdir(parents=True, exist_ok=True)
                subprocess.run([a.cli, "render", project, "-o", pathlib.Path(a.pictures) / f"{stem}.png", "--size", "1280x720"])
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
