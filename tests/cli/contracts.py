#!/usr/bin/env python3
"""Runs atrium-cli on small scenes and checks what scripts rely on. One argument: the group (a TestCase below)."""
import csv
import json
import os
import signal
import struct
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import CLI, ROOM, SHARED, SOURCE, CliTest, box_room, exr_values  # noqa: E402

FEATURES = ["particles", "caustic_textures", "octree", "refraction", "glossy", "sun", "sky", "textures", "direct_layer",
            "specular_view"]
STATISTICS = {
    "version": str, "scene": {"file": str, "nodes": int, "primitives": int, "triangles": int, "materials": int, "lights": int},
    "threads": int, "seed": int, "mode": str, "quality": str, "features": {f: {"used": bool, "why": str} for f in FEATURES},
    "time": {k: float for k in ("load", "build", "solve", "first_picture", "total")},
    "phases": list, "iterations": int, "converged": bool, "residual": float, "error_estimate": float,
    "error_audit": {"rms": float, "low": float, "high": float, "typical": float, "bias": float, "bias_error": float, "points": int, "paths": int,
                    "rays": int, "seconds": float},
    "elements": int, "clusters": int, "links": int, "rays": int, "particles_emitted": int, "particles_stored": int,
    "caustic_textures": list,
    "memory": {k: int for k in ("elements", "links", "particles", "octree", "caustic_textures", "layers", "ray_scene", "peak_rss")},
    "energy": {k: float for k in ("emitted", "absorbed", "escaped", "defect")},
}
POINTS = "x,y,z,nx,ny,nz\n2,0,1.5,0,1,0\n0.5,0,0.5,0,1,0\n2,1.2,0,0,0,1\n"


class Requests(CliTest):
    def test_help_and_version(self):
        self.assertIn("solve", self.run_cli("--help").stdout)
        self.assertRegex(self.run_cli("--version").stdout, r"^atrium-cli \d+\.\d+\.\d+( \([0-9a-f]{12}(, modified)?\))?\n$")
        for name in ("info", "check", "solve", "measure", "render", "edit", "reference", "bench", "compare", "convert"):
            self.assertIn("FILE" if name not in ("compare", "convert") else name, self.run_cli(name, "--help").stdout)

    def test_wrong_requests(self):
        self.refused()
        self.refused("nonsense")
        self.refused("solve")
        self.refused("info", self.room, "--no-such-option")
        for text in ("--quality=best", "--threads=-1", "--threads=many", "--error=0", "--error=2", "--time=-1", "--seed=x"):
            self.refused("solve", self.room, text)

    def test_modes(self):
        self.run_cli("solve", self.room, "--mode", "paper", "--quality", "draft", "--stats", self.path("paper.json"))
        self.assertEqual(json.loads(self.read("paper.json"))["mode"], "paper")
        self.refused("solve", self.room, "--mode", "newest")

    def test_thresholds_that_are_not_there(self):
        self.refused("solve", self.room, "--threshold", "elementSize=1", says=["'elementSize' is not a threshold", "elementEdge", "causticDispersion"])
        self.refused("solve", self.room, "--threshold", "elementEdge", says=["elementEdge", "0.002 to 100 m"])
        for value in ("0.001", "101", "nan", "inf", "1x", "-1", "0"):
            self.refused("solve", self.room, "--threshold", "elementEdge=" + value, says=["'%s' is not a value of elementEdge" % value, "0.002 to 100 m, or auto"])

    def test_missing_file_is_named(self):
        for command in ("info", "check", "solve"):
            self.refused(command, self.path("nowhere.glb"), says=["nowhere.glb"])
        script = self.write("e.json", '{"edits": []}')
        self.refused("edit", self.path("nowhere.glb"), "--script", script, says=["nowhere.glb"])
        self.refused("edit", self.room, "--script", self.path("nowhere.json"), says=["nowhere.json"])


class InfoAndCheck(CliTest):
    def test_info(self):
        done = self.run_cli("info", self.room)
        self.assertIn("4.000 x 2.500 x 3.000 m", done.stdout)
        self.assertEqual(done.stderr, "")
        facts = json.loads(self.run_cli("info", self.room, "--json").stdout)
        self.assertEqual(facts["scene"]["nodes"], 4)
        self.assertEqual(facts["scene"]["triangles"], 14)
        self.assertEqual(facts["scene"]["primitives"], 2)
        self.assertEqual(facts["camera_names"], ["Front", "Side"])
        self.assertFalse(facts["has_solution"])
        self.assertLessEqual(set(FEATURES), set(facts["features"]))
        for name in ("sun", "sky", "refraction", "textures"):
            self.assertFalse(facts["features"][name]["used"], name)
            self.assertTrue(facts["features"][name]["why"])

    def test_photometric_lamps(self):
        room = json.loads(box_room())
        name = "narrow_downlight.ies"
        with open(os.path.join(SOURCE, "scenes", "luminaires", name), "rb") as f:
            lamp = f.read()
        with open(self.path(name), "wb") as f:
            f.write(lamp)
        room["extensionsUsed"].append("EXT_lights_ies")
        room["extensions"] = {"EXT_lights_ies": {"lights": [{"uri": name}]}}
        room["nodes"].append({"name": "Downlight", "translation": [2, 2.4, 1.5], "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
                              "extensions": {"EXT_lights_ies": {"light": 0, "multiplier": 0.5}}})
        room["scenes"][0]["nodes"].append(4)
        file = self.write("downlight.gltf", json.dumps(room))
        self.assertIn("photometry   Downlight: narrow_downlight.ies, 400 lm (50 % of its intensity), beam 21 degrees",
                      self.run_cli("info", file).stdout)
        facts = json.loads(self.run_cli("info", file, "--json").stdout)
        self.assertTrue(facts["features"]["photometry"]["used"])
        self.assertEqual(len(facts["photometry"]), 1)
        told = facts["photometry"][0]
        self.assertEqual((told["node"], told["file"], told["manufacturer"]), ("Downlight", name, "Atrium"))
        self.assertAlmostEqual(told["file_lumens"], 800, delta=0.5)
        self.assertAlmostEqual(told["lumens"], 400, delta=0.3)
        self.assertAlmostEqual(told["dimming"], 0.5, places=6)
        # Straight below, I / d^2: 3940.8 cd at half, 2.4 m. In one file it goes along.
        packed = self.path("packed.glb")
        self.run_cli("convert", file, packed)
        os.remove(self.path(name))
        points = self.write("points.csv", "x,y,z,nx,ny,nz\n2,1e-6,1.5,0,1,0\n")
        lit = self.path("lit.csv")
        self.run_cli("measure", packed, "--points", points, "--free", "-o", lit, "--quality", "draft")
        dark = self.path("dark.csv")
        script = self.write("off.json", json.dumps({"edits": [{"kind": "light", "node": "Downlight", "intensity": 0}]}))
        off = self.path("off.atrium")
        self.run_cli("edit", packed, "--script", script, "-o", off, "--quality", "draft")
        self.run_cli("measure", off, "--points", points, "--free", "-o", dark)
        def lux(path):
            with open(path) as f:
                header, row = f.read().split()[:2]
            return float(row.split(",")[header.split(",").index("E")])
        # What the walls reflect of the beam comes on top.
        self.assertGreater(lux(lit) - lux(dark), 0.5 * 3940.8 / 2.4 ** 2)
        self.assertLess(lux(lit) - lux(dark), 1.2 * 0.5 * 3940.8 / 2.4 ** 2)

    def test_check_passes(self):
        self.run_cli("check", self.room)
        result = json.loads(self.run_cli("check", self.room, "--json").stdout)
        self.assertTrue(result["readable"])
        self.assertEqual(result["errors"], 0)

    def test_shipped_scenes_have_no_problems(self):
        for name in ("ring", "glass-ball", "sun-mirror", "lamp", "empty-room", "cabin", "street"):
            result = json.loads(self.run_cli("check", os.path.join(SOURCE, "scenes", name, name + ".glb"), "--json").stdout)
            self.assertEqual(result["problems"], [], name)

    def test_damaged_files(self):
        text = self.read("room.gltf")
        for name, damaged in (("cut.gltf", text[:len(text) // 2]), ("empty.gltf", ""), ("number.gltf", "42"),
                              ("range.gltf", text.replace('"bufferView": 0', '"bufferView": 7')),
                              ("cut.glb", "glTF")):
            path = self.write(name, damaged)
            self.refused("check", path, says=[name])
            self.refused("solve", path, says=[name])
            done = self.run_cli("check", path, "--json", status=1)
            result = json.loads(done.stdout)
            self.assertGreaterEqual(result["errors"], 1)
            self.assertEqual(result["problems"][0]["severity"], "error")


class Solve(CliTest):
    def test_statistics_and_silence(self):
        done = self.run_cli("solve", self.room, "--stats", self.path("s.json"), "--quality", "draft", "--seed", "7", "--threads", "2")
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        s = json.loads(self.read("s.json"))
        self.compare_keys(s, STATISTICS)
        self.assertEqual((s["seed"], s["mode"], s["quality"]), (7, "default", "draft"))
        self.assertTrue(s["converged"])
        for name in ("elements", "links", "rays"):
            self.assertGreater(s[name], 0, name)
        self.assertAlmostEqual(s["energy"]["emitted"], 3141.59, delta=3.2)  # pi x 1000 cd/m2 x 1 m2
        # What was not used is zero everywhere.
        self.assertFalse(s["features"]["particles"]["used"])
        for figure in (s["particles_emitted"], s["particles_stored"], s["memory"]["particles"], s["memory"]["octree"],
                       s["memory"]["caustic_textures"]):
            self.assertEqual(figure, 0)
        self.assertEqual(s["caustic_textures"], [])
        for phase in s["phases"]:
            self.assertLessEqual({"name", "seconds", "share"}, set(phase))
        self.assertGreater(s["time"]["total"], 0)
        self.assertGreater(s["memory"]["peak_rss"], 1 << 20)

    def test_error_is_measured(self):
        s = json.loads(self.run_cli("solve", self.room, "--quality", "draft", "--stats", "-").stdout)
        audit = s["error_audit"]
        self.assertGreater(audit["points"], 200)
        self.assertEqual(s["error_estimate"], audit["rms"] or audit["high"])
        self.assertLessEqual(audit["low"], audit["rms"])
        self.assertLessEqual(audit["rms"], audit["high"])
        # Better qualities follow until the wish is met, and where none meets it that is said.
        easy = self.run_cli("solve", self.room, "--error", "0.9", "--stats", "-")
        self.assertEqual((json.loads(easy.stdout)["quality"], easy.stderr), ("draft", ""))
        hard = self.run_cli("solve", self.room, "--error", "0.00001", "--stats", "-")
        self.assertEqual(json.loads(hard.stdout)["quality"], "fine")
        self.assertIn("asked for an error of 0.0 %", hard.stderr)

    def test_statistics_to_standard_output(self):
        self.compare_keys(json.loads(self.run_cli("solve", self.room, "--quality", "draft", "--stats", "-").stdout), STATISTICS)

    def test_project_is_glb_and_is_not_solved_again(self):
        project = self.path("room.atrium")
        self.run_cli("solve", self.room, "-o", project, "--quality", "normal")
        with open(project, "rb") as f:
            magic, version, _, size, kind = struct.unpack("<4sII I4s", f.read(20))
            document = json.loads(f.read(size))
        self.assertEqual((magic, version, kind), (b"glTF", 2, b"JSON"))
        self.assertFalse([e for e in document.get("extensionsRequired", []) if e.startswith("ATRIUM")])
        self.assertTrue(json.loads(self.run_cli("info", project, "--json").stdout)["has_solution"])

        def reused(*options):
            return json.loads(self.run_cli("solve", project, "--stats", "-", *options).stdout)["solution_reused"]

        self.assertTrue(reused())
        self.assertTrue(reused("--quality", "draft"))
        self.assertTrue(reused("--error", "1"))
        self.assertFalse(reused("--seed", "99"))
        self.assertFalse(reused("--quality", "fine"))

    def test_thresholds_reach_the_light_and_are_kept(self):
        project = self.path("room.atrium")

        def solved(*options):
            return json.loads(self.run_cli("solve", *options, "--stats", "-", "--quality", "draft").stdout)

        automatic = solved(self.room)
        # Before FILE, too: it takes one word and no more.
        finer = solved("--threshold", "elementEdge=0.1", "--threshold", "linkShare=1e-5", self.room, "-o", project)
        self.assertGreater(finer["elements"], 2 * automatic["elements"])
        with open(project, "rb") as f:
            document = json.loads(f.read(struct.unpack("<4sII I4s", f.read(20))[3]))
        self.assertEqual(document["extensions"]["ATRIUM_settings"]["thresholds"], {"elementEdge": 0.1, "linkShare": 1e-5})
        self.assertTrue(solved(project)["solution_reused"])
        self.assertTrue(solved(project, "--threshold", "elementEdge=0.1")["solution_reused"], "what it has")
        back = solved(project, "--threshold", "elementEdge=auto", "--threshold", "linkShare=auto")
        self.assertFalse(back["solution_reused"])
        self.assertEqual(back["elements"], automatic["elements"])

    def test_wrong_outputs_are_refused_before_solving(self):
        start = time.monotonic()
        self.refused("solve", self.room, "-o", self.path("room.glb"), says=[".atrium"])
        self.refused("solve", self.room, "-o", self.path("no/such/folder/room.atrium"), says=["folder"])
        self.refused("solve", self.room, "--stats", self.path("no/such/folder/s.json"), says=["folder"])
        self.assertLess(time.monotonic() - start, 10)
        self.assertEqual(os.listdir(self.folder), ["room.gltf"])

    def test_progress_goes_to_standard_error(self):
        done = self.run_cli("solve", self.room, "--quality", "draft", "--progress")
        self.assertEqual(done.stdout, "")
        self.assertIn("progress:", done.stderr)

    def test_curve(self):
        points = self.write("p.csv", POINTS)
        self.run_cli("measure", self.room, "--points", points, "-o", self.path("reference.csv"))
        self.run_cli("solve", self.room, "--curve", self.path("c.csv"), "--reference", self.path("reference.csv"))
        rows = self.rows(self.read("c.csv"))
        self.assertEqual(list(rows[0]), ["seconds", "final", "elements", "links", "error_estimate", "rel_rmse"])
        self.assertEqual(rows[-1]["final"], 1)
        self.assertLess(rows[-1]["rel_rmse"], 1e-6)  # the same solve as the reference; the file has the digits of a float
        self.refused("solve", self.room, "--curve", self.path("c.csv"), "--reference", points, says=["column E"])


class Stopping(CliTest):
    def test_time_limit(self):
        done = self.run_cli("solve", self.room, "--time", "0.001", "--stats", self.path("s.json"), status=2)
        self.assertIn("stopped", done.stderr)
        s = json.loads(self.read("s.json"))
        self.assertTrue(s["stopped"])
        self.assertFalse(s["converged"])

    def test_time_is_a_wish_for_the_best_light(self):
        start = time.monotonic()
        self.run_cli("solve", self.room, "--time", "20", "--stats", self.path("s.json"))
        took = time.monotonic() - start
        self.assertLess(took, 24.0)
        s = json.loads(self.read("s.json"))
        self.assertFalse(s["stopped"])
        # A draft is left only where better light could not be expected in time, or was begun in vain.
        self.assertTrue(s["quality"] != "draft" or s["time"]["solve"] > 20.0 / 6.0 or took > 15.0, (s["quality"], s["time"], took))

    def test_stopped_solve_falls_back_on_stored_light(self):
        project = self.path("room.atrium")
        self.run_cli("solve", self.room, "-o", project, "--quality", "draft")
        done = self.run_cli("render", project, "-o", self.path("a.png"), "--size", "16x16", "--quality", "fine", "--time", "0.001",
                            status=2)
        self.assertIn("stored", done.stderr)
        self.assertTrue(os.path.getsize(self.path("a.png")) > 0)
        # A virtual sensor needs the hierarchy, which no file holds: nothing is made up.
        points = self.write("p.csv", POINTS)
        self.run_cli("measure", project, "--points", points, "--free", "--time", "0.001", "-o", self.path("m.csv"), status=2)
        self.assertFalse(os.path.exists(self.path("m.csv")))

    def test_signals(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            name = "s%d.json" % number
            process = subprocess.Popen([CLI, "solve", ROOM, "--quality", "fine", "--progress", "--stats", self.path(name)],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            process.stderr.read(1) # it is at work, however busy the machine
            self.assertIsNone(process.poll(), "finished before the signal")
            process.send_signal(number)
            started = time.monotonic()
            out, _ = process.communicate(timeout=60)
            self.assertEqual((process.returncode, out), (2, b""))
            self.assertLess(time.monotonic() - started, 20)
            self.assertTrue(json.loads(self.read(name))["stopped"])


class Measure(CliTest):
    def measure(self, points, *options):
        return self.rows(self.run_cli("measure", self.room, "--points", self.write("p.csv", points), *options).stdout)

    def test_output(self):
        text = self.run_cli("measure", self.room, "--points", self.write("p.csv", POINTS), "--quality", "draft").stdout
        self.assertEqual(text.splitlines()[0], "x,y,z,nx,ny,nz,E_r,E_g,E_b,E,stderr,on_surface")
        rows = self.rows(text)
        self.assertEqual(len(rows), 3)
        for row in rows:
            self.assertEqual(row["on_surface"], 1)
            self.assertGreaterEqual(row["stderr"], 0)
            self.assertAlmostEqual(row["E"], 0.2126 * row["E_r"] + 0.7152 * row["E_g"] + 0.0722 * row["E_b"], delta=1e-3 * row["E"])
        self.assertGreater(rows[0]["E"], rows[1]["E"])  # under the lamp and in the corner
        # Direct light under the middle of a 1 x 1 m lamp of 1000 cd/m2 at 2.49 m is 148 lx; bounces add less than as much.
        self.assertGreater(rows[0]["E"], 148)
        self.assertLess(rows[0]["E"], 450)

    def test_where_points_lie(self):
        points = "x,y,z,nx,ny,nz\n2,0.009,1.5,0,1,0\n2,0.011,1.5,0,1,0\n2,0,1.5,0,-1,0\n2,1,1.5,0,1,0\n"
        self.assertEqual([r["on_surface"] for r in self.measure(points)], [1, 0, 0, 0])
        self.refused("measure", self.room, "--points", self.path("p.csv"), "--on-surface", says=["p.csv", "line 3", "1 cm"])
        self.assertEqual([r["on_surface"] for r in self.measure(points, "--free")], [0, 0, 0, 0])

    def test_surface_and_free_agree(self):
        surface = self.measure(POINTS)
        free = self.measure(POINTS.replace("2,0,1.5", "2,0.001,1.5").replace("0.5,0,0.5", "0.5,0.001,0.5"), "--free")
        for a, b in zip(surface[:2], free[:2]):
            self.assertAlmostEqual(a["E"] / b["E"], 1.0, delta=0.08)

    def test_forgiving_csv(self):
        plain = self.measure(POINTS)
        dressed = "\ufeff nx , ny,nz, label, x,y, z \r\n\r\n" + "".join(
            " 0 , +1 ,0, a, %s \r\n" % p for p in ("2, 0.0 , 1.5e0", "0.5,0,.5"))
        self.assertEqual(self.measure(dressed), plain[:2])

    def test_bad_csv_is_reported_by_line(self):
        for points, line in (("x,y,z,nx,ny,nz\n1,0,1,0,1,0\n1,0,1,0,1\n", "line 3"), ("x,y,z,nx,ny,nz\n\n1,0,a,0,1,0\n", "line 3"),
                             ("x,y,z,nx,ny,nz\n1,0,1,0,0,0\n", "line 2"), ("x,y,z,nx,ny,nz\n1,0,nan,0,1,0\n", "line 2"),
                             ("x,y,z,nx,ny,nz\n1,0,inf,0,1,0\n", "line 2"), ("x,y,z\n1,0,1\n", "line 1"),
                             ("x,y,z,nx,ny,nz\n1,5,0,1,0,1,0,2\n", "line 2"), ("", "empty")):
            self.refused("measure", self.room, "--points", self.write("bad.csv", points), says=["bad.csv", line])
        self.refused("measure", self.room, "--points", self.path("none.csv"), says=["none.csv"])

    def test_no_points_give_a_header(self):
        self.assertEqual(self.measure("x,y,z,nx,ny,nz\n"), [])

    def test_threads_and_locale_change_nothing(self):
        points = self.write("p.csv", POINTS)
        one = self.run_cli("measure", self.room, "--points", points, "--threads", "1").stdout
        self.assertEqual(self.run_cli("measure", self.room, "--points", points, "--threads", "3").stdout, one)
        self.assertEqual(self.run_cli("measure", self.room, "--points", points, env={"LC_ALL": "de_DE.UTF-8"}).stdout, one)

    def test_project_answers_from_its_layers(self):
        project = self.path("room.atrium")
        self.run_cli("solve", self.room, "-o", project)
        points = self.write("p.csv", POINTS)
        fresh = self.run_cli("measure", self.room, "--points", points, "--on-surface").stdout
        stored = self.run_cli("measure", project, "--points", points, "--on-surface", "--stats", self.path("s.json")).stdout
        self.assertTrue(json.loads(self.read("s.json"))["solution_reused"])
        for a, b in zip(self.rows(fresh), self.rows(stored)):
            self.assertAlmostEqual(a["E"] / b["E"], 1.0, delta=1e-3)


class Render(CliTest):
    def test_png_and_exr(self):
        self.run_cli("render", self.room, "-o", self.path("a.png"), "--size", "64x48", "--quality", "draft")
        with open(self.path("a.png"), "rb") as f:
            head = f.read(24)
        self.assertEqual((head[:8], struct.unpack(">II", head[16:])), (b"\x89PNG\r\n\x1a\n", (64, 48)))
        self.run_cli("render", self.room, "-o", self.path("a.exr"), "--size", "64x48", "--quality", "draft", "--camera", "Side")
        with open(self.path("a.exr"), "rb") as f:
            self.assertEqual(f.read(4), b"\x76\x2f\x31\x01")

    def test_cameras(self):
        size = ("--size", "48x32", "--quality", "draft")
        for name, options in (("first.png", ()), ("zero.png", ("--camera", "0")), ("front.png", ("--camera", "Front")),
                              ("side.png", ("--camera", "1"))):
            self.run_cli("render", self.room, "-o", self.path(name), *size, *options)
        data = {}
        for name in ("first.png", "zero.png", "front.png", "side.png"):
            with open(self.path(name), "rb") as f:
                data[name] = f.read()
        self.assertEqual(data["first.png"], data["zero.png"])
        self.assertEqual(data["first.png"], data["front.png"])
        self.assertNotEqual(data["first.png"], data["side.png"])

    def test_exposure_brightens_png_only(self):
        size = ("--size", "48x32", "--quality", "draft")
        self.run_cli("render", self.room, "-o", self.path("a.png"), *size)
        self.run_cli("render", self.room, "-o", self.path("b.png"), *size, "--exposure", "2")
        bias = json.loads(self.run_cli("compare", self.path("b.png"), self.path("a.png"), "--json").stdout)["mean_relative_bias"]
        self.assertGreater(bias, 0.2)
        self.run_cli("render", self.room, "-o", self.path("a.exr"), *size)
        self.run_cli("render", self.room, "-o", self.path("b.exr"), *size, "--exposure", "2")
        self.assertEqual(json.loads(self.run_cli("compare", self.path("b.exr"), self.path("a.exr"), "--json").stdout)["relMSE"], 0)

    def test_layers(self):
        size = ("--size", "32x32", "--quality", "draft")
        self.run_cli("render", self.room, "-o", self.path("a.exr"), *size)
        self.run_cli("render", self.room, "-o", self.path("b.exr"), *size, "--layers", "direct,diffuse,caustic,specular")
        self.assertEqual(json.loads(self.run_cli("compare", self.path("a.exr"), self.path("b.exr"), "--json").stdout)["relMSE"], 0)
        self.refused("render", self.room, "-o", self.path("c.exr"), "--layers", "diffuse,shiny", says=["shiny"])
        # A room without mirrors and glass has a black caustic layer, and a layer that does not exist is refused.
        self.run_cli("render", self.room, "-o", self.path("c.exr"), "--layers", "caustic", "--quality", "draft", "--size", "16x16")
        self.refused("render", self.room, "-o", self.path("n.exr"), "--layers", "nonsense", says=["direct", "diffuse", "caustic"])

    def test_render_final_and_channels(self):
        size = ("--size", "24x20", "--quality", "draft")
        self.run_cli("render", self.room, "-o", self.path("f.exr"), *size, "--final", "--samples", "4", "--channels")
        self.run_cli("render", self.room, "-o", self.path("g.exr"), *size, "--final", "--samples", "4")
        self.run_cli("render", self.room, "-o", self.path("h.exr"), *size)
        same = json.loads(self.run_cli("compare", self.path("f.exr"), self.path("g.exr"), "--json").stdout)
        self.assertEqual(same["relRMSE"], 0)  # the same light with more channels beside it
        other = json.loads(self.run_cli("compare", self.path("f.exr"), self.path("h.exr"), "--json").stdout)
        self.assertGreater(other["relRMSE"], 0)  # computed, not read from the layers
        self.assertLess(abs(other["mean_relative_bias"]), 0.2)
        with open(self.path("f.exr"), "rb") as file:
            header = file.read(4000)
        for name in (b"direct.R", b"diffuse.G", b"caustic.B", b"specular.R", b"albedo.R", b"normal.X", b"depth.Z"):
            self.assertIn(name, header)
        self.refused("render", self.room, "-o", self.path("a.png"), "--channels", says=[".exr"])
        self.refused("render", self.room, "-o", self.path("a.png"), "--final", "--samples", "0", says=["--samples"])
        self.refused("render", self.room, "-o", self.path("a.png"), "--final", "--false-colour", "illuminance")

    def test_false_colour(self):
        project = self.path("room.atrium")
        self.run_cli("solve", self.room, "-o", project, "--quality", "draft")
        size = ("--size", "32x24")
        legend = self.path("legend.csv")
        self.run_cli("render", project, "-o", self.path("a.png"), *size, "--false-colour", "illuminance", "--scale", "linear",
                     "--range", "0,500", "--contours", "--legend", legend)
        lines = self.read("legend.csv").split()
        self.assertEqual(lines[:2] + lines[-1:], ["lux,colour", "0,#440154", "500,#fde725"])
        self.run_cli("render", project, "-o", self.path("b.png"), *size, "--false-colour", "luminance", "--legend", legend)
        self.assertTrue(self.read("legend.csv").startswith("cd/m2,colour"))
        self.run_cli("render", project, "-o", self.path("c.png"), *size)
        pictures = []
        for name in ("a.png", "b.png", "c.png"):
            with open(self.path(name), "rb") as f:
                pictures.append(f.read())
        self.assertEqual(len(set(pictures)), 3)
        self.refused("render", project, "-o", self.path("a.exr"), "--false-colour", "illuminance", says=[".png"])
        self.refused("render", project, "-o", self.path("a.png"), "--range", "0,500")
        for wrong in ("500", "500,100", "a,b", "0,100", "1,inf"):
            self.refused("render", project, "-o", self.path("a.png"), "--false-colour", "illuminance", "--range=" + wrong, says=[wrong])

    def test_direct_and_diffuse_add_up(self):
        document = json.loads(self.read("room.gltf"))
        document["nodes"][2]["rotation"] = [0.2588190451, 0.0, 0.0, 0.9659258263]  # 30 degrees up: the lamp is in the picture
        scene = self.write("up.gltf", json.dumps(document))
        project = self.path("up.atrium")
        self.run_cli("solve", scene, "-o", project, "--quality", "draft")
        values = {}
        for layers in ("direct,diffuse", "direct", "diffuse", "specular"):
            self.run_cli("render", project, "-o", self.path("a.exr"), "--size", "24x20", "--layers", layers)
            values[layers] = exr_values(self.path("a.exr"))
        self.assertEqual(len(values["direct,diffuse"]), 24 * 20 * 3)
        for a, b, c in zip(values["direct,diffuse"], values["direct"], values["diffuse"]):
            self.assertAlmostEqual(a, b + c, delta=1e-3 * a + 1e-3)
        # What shines itself is direct light; nothing here is a mirror.
        self.assertAlmostEqual(max(values["direct"]), 1000.0, delta=1.0)
        self.assertLess(max(values["diffuse"]), 500.0)
        self.assertGreater(min(values["direct,diffuse"]), 0.0)
        self.assertEqual(max(values["specular"]), 0.0)

    def test_wrong_requests(self):
        self.refused("render", self.room, says=["-o"])
        self.refused("render", self.room, "-o", self.path("a.gif"), says=[".exr", ".png"])
        self.refused("render", self.room, "-o", self.path("a.png"), "--camera", "Nobody", says=["Nobody"])
        self.refused("render", self.room, "-o", self.path("a.png"), "--camera", "9")
        for size in ("64", "64x", "0x64", "64x-1", "64x48x2", "99999x10", "axb"):
            self.refused("render", self.room, "-o", self.path("a.png"), "--size=" + size, says=[size])


class Bench(CliTest):
    def crate_room(self):
        """A project with a crate in it, and its drag beside it."""
        os.mkdir(self.path("crate"))
        add = self.write("add.json", json.dumps({"edits": [
            {"kind": "add", "shape": "box", "name": "Crate", "size": [0.6, 0.6, 0.6], "translation": [1, 0.3, 1]}]}))
        self.run_cli("edit", self.room, "--script", add, "--quality", "draft", "-o", self.path("room.atrium"))
        self.run_cli("convert", self.path("room.atrium"), self.path("crate/crate.glb"))
        drag = {"kind": "drag", "node": "Crate", "positions": [[1 + 0.2 * i, 0.3, 1.2] for i in range(6)]}
        self.write("crate/drag.json", json.dumps({"edits": [drag]}))
        return self.path("crate/crate.glb")

    def test_paper_and_solve(self):
        scene = self.crate_room()
        done = self.run_cli("bench", scene, self.room, "--checks", "2", "-o", self.path("tables"))
        self.assertEqual(done.stderr, "")
        self.assertEqual(sorted(os.listdir(self.path("tables"))),
                         ["crate_frames.csv"] + [f"{t}.{e}" for t in ("paper", "paper_errors", "solve") for e in ("csv", "md")])
        for name in ("paper", "paper_errors", "solve"):
            self.assertIn(self.read(f"tables/{name}.md"), done.stdout)
        self.assertEqual(len(self.read("tables/paper.csv").splitlines()), 2)  # the room has no drag
        self.assertEqual(len(self.read("tables/solve.csv").splitlines()), 3)
        frames = [{k: float(v) if v else None for k, v in row.items()}
                  for row in csv.DictReader(self.read("tables/crate_frames.csv").splitlines())]
        self.assertEqual(len(frames), 6)
        looked_at = [i for i, f in enumerate(frames) if f["settled_rms"] is not None]
        self.assertEqual(looked_at, [2, 5])
        for i in looked_at:
            f = frames[i]
            # Light that follows is nearer to the truth than light that stays, and settled light nearer still or as near.
            self.assertLess(f["degraded_rms"], 0.5 * f["stayed_rms"])
            self.assertLess(f["settled_rms"], 1.2 * f["degraded_rms"])
            self.assertLess(f["settled_rms_where_changed"], 0.5)
            self.assertGreater(f["changed_share"], 0)

    def test_wrong_requests(self):
        self.refused("bench", "--suite", "none")
        self.refused("bench", self.room, "--suite", "paper", says=["drag.json"])
        scene = self.crate_room()
        self.write("crate/drag.json", '{"edits": [{"kind": "drag", "node": "Nobody", "positions": [[0, 0, 0]]}]}')
        self.refused("bench", scene, "--suite", "paper", says=["drag.json", "Nobody"])
        self.refused("bench", self.path("nowhere.glb"), says=["nowhere.glb"])


class Edit(CliTest):
    # After any edits the light is that of a fresh solve of the same scene and seed, within this share of the mean.
    SAME = 0.02
    SCRIPT = [
        {"kind": "add", "shape": "box", "name": "Crate", "size": [0.6, 0.6, 0.6], "translation": [1, 0.3, 1], "material": "Paint"},
        {"kind": "drag", "node": "Crate", "positions": [[1 + 0.1 * i, 0.3, 1.2] for i in range(8)], "interval_ms": 10},
        {"kind": "move", "node": "Crate", "translation": [1.5, 0.31, 2], "rotation": [0, 0.6, 0, 0.8], "scale": [1, 1, 0.5]},
        {"kind": "material", "material": "Paint", "baseColor": [0.6, 0.3, 0.3], "roughness": 0.9},
        {"kind": "light", "node": "Lamp", "intensity": 500.0, "color": [1, 0.9, 0.8]},
        {"kind": "delete", "node": "Crate"}, {"kind": "undo"}, {"kind": "redo"}]
    FRAME = {"latency": float, "degraded": bool, "particles_traced": int, "links_changed": int}
    FIGURES = {"kind": str, "node": str, "frames": list, "settle": float, "particles_traced": int, "particles_share": float,
               "links_visited": int, "links_changed": int, "octree_bytes": int,
               "verify": {"fresh_seconds": float, "rel_rms": float, "rel_max": float, "energy_rel": float}}

    def script(self, edits, name="edits.json"):
        return self.write(name, json.dumps({"edits": edits}))

    def test_every_kind(self):
        done = self.run_cli("edit", self.room, "--script", self.script(self.SCRIPT), "--verify", "--quality", "draft",
                            "--stats", self.path("s.json"), "-o", self.path("out.atrium"))
        self.assertEqual(done.stderr, "")
        self.assertEqual(len(done.stdout.splitlines()), 1 + len(self.SCRIPT))
        stats = json.loads(self.read("s.json"))
        self.compare_keys(stats, STATISTICS)
        self.assertFalse(stats["stopped"])
        edits = stats["edits"]
        self.assertEqual([e["kind"] for e in edits], [e["kind"] for e in self.SCRIPT])
        self.assertEqual([e["node"] for e in edits],
                         ["Crate", "Crate", "Crate", "Paint", "Lamp", "Crate", "Crate", "Crate"])
        for edit in edits:
            self.compare_keys(edit, self.FIGURES, edit["kind"])
            self.assertEqual(len(edit["frames"]), 8 if edit["kind"] == "drag" else 1)
            for frame in edit["frames"]:
                self.compare_keys(frame, self.FRAME, edit["kind"])
                self.assertLess(frame["latency"], 20)
            self.assertLess(edit["verify"]["rel_rms"], self.SAME, edit)
            self.assertLess(edit["verify"]["energy_rel"], self.SAME, edit)
            self.assertGreaterEqual(edit["verify"]["points"], 2000)
            self.assertGreater(edit["verify"]["fresh_seconds"], 0)
        # The project is the edited scene with its light: the crate is gone, the lamp is dimmer, nothing needs solving.
        facts = json.loads(self.run_cli("info", self.path("out.atrium"), "--json").stdout)
        self.assertEqual((facts["scene"]["nodes"], facts["has_solution"]), (4, True))
        self.run_cli("solve", self.path("out.atrium"), "--stats", self.path("t.json"))
        again = json.loads(self.read("t.json"))
        self.assertTrue(again["solution_reused"])
        self.assertLess(again["energy"]["emitted"], 0.5 * 3141.59)

    def test_undo_leads_back_to_the_light_before(self):
        self.run_cli("solve", self.room, "--quality", "draft", "-o", self.path("before.atrium"))
        back = [e for edit in self.SCRIPT[3:5] for e in (edit, {"kind": "undo"})] + [
            {"kind": "drag", "node": "Lamp", "positions": [[0.1 * i, 0, 0] for i in range(1, 6)]}, {"kind": "undo"}]
        self.run_cli("edit", self.path("before.atrium"), "--script", self.script(back), "--quality", "draft",
                     "-o", self.path("after.atrium"))
        figures = json.loads(self.run_cli("compare", self.path("after.atrium"), self.path("before.atrium"), "--json").stdout)
        self.assertGreaterEqual(figures["values"], 1900)
        self.assertLess(figures["relRMSE"], self.SAME)
        self.run_cli("edit", self.path("before.atrium"), "--script", self.script(back[:1]), "--quality", "draft",
                     "-o", self.path("after.atrium"))
        figures = json.loads(self.run_cli("compare", self.path("after.atrium"), self.path("before.atrium"), "--json").stdout)
        self.assertGreater(figures["relRMSE"], 0.1, "the comparison would see an edit")

    def test_statistics_to_standard_output(self):
        done = self.run_cli("edit", self.room, "--script", self.script([]), "--verify", "--quality", "draft", "--stats", "-")
        self.assertEqual(json.loads(done.stdout)["edits"], [])
        done = self.run_cli("edit", self.room, "--script", self.script([{"kind": "move", "node": "#2", "scale": [2, 2, 2]}]),
                            "--quality", "draft")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_a_drag_that_is_not_waited_for(self):
        edits = [{"kind": "drag", "node": "Lamp", "positions": [[0.2, 0, 0], [0.4, 0, 0]], "settle": False}, {"kind": "undo"}]
        self.run_cli("edit", self.room, "--script", self.script(edits), "--verify", "--quality", "draft",
                     "--stats", self.path("s.json"))
        first, second = json.loads(self.read("s.json"))["edits"]
        self.assertEqual((first["settle"], first["verify"]), (None, None))
        self.assertTrue(all(f["latency"] >= 0 for f in first["frames"]))
        self.assertLess(second["verify"]["rel_rms"], self.SAME)

    def test_wrong_scripts(self):
        start = time.monotonic()
        for edits, says in (([{"kind": "undo"}], ["edits/0 (undo)", "nothing to undo"]),
                            ([self.SCRIPT[0], {"kind": "drag", "node": "Crete", "positions": [[0, 0, 0]]}],
                             ["edits/1 (drag Crete)", "no node named 'Crete'"]),
                            ([{"kind": "delete", "node": "#9"}], ["edits/0 (delete #9)", "only 4"]),
                            ([{"kind": "light", "node": "Walls", "intensity": 3}], ["no light"]),
                            ([{"kind": "material", "material": "Paint"}], ["edits/0 (material)", "baseColor"]),
                            ([{"kind": "jump"}], ["edits/0", "jump", "drag"])):
            self.refused("edit", self.room, "--script", self.script(edits), "-o", self.path("no.atrium"),
                         says=["edits.json", *says])
            self.assertFalse(os.path.exists(self.path("no.atrium")))
        self.refused("edit", self.room, "--script", self.write("edits.json", "{"), says=["edits.json", "not JSON"])
        self.refused("edit", self.room, says=["--script"])
        self.refused("edit", self.room, "--script", self.script([]), "-o", self.path("a.glb"), says=[".atrium"])
        self.assertLess(time.monotonic() - start, 20, "found before anything is solved")

    def test_stopping(self):
        edits = [{"kind": "drag", "node": "Lamp", "positions": [[0.001 * i, 0, 0] for i in range(20000)]}]
        process = subprocess.Popen([CLI, "edit", self.room, "--script", self.script(edits), "--quality", "draft",
                                    "--stats", self.path("s.json"), "-o", self.path("out.atrium")],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(3.0)
        process.send_signal(signal.SIGINT)
        _, message = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 2, message)
        self.assertIn(b"stopped by a signal after 0 of 1 edits", message)
        stats = json.loads(self.read("s.json"))
        self.assertTrue(stats["stopped"])
        self.assertIsNone(stats["edits"][0]["settle"])
        self.assertLess(len(stats["edits"][0]["frames"]), 20000)
        self.assertEqual(json.loads(self.run_cli("info", self.path("out.atrium"), "--json").stdout)["scene"]["nodes"], 4)
        done = self.run_cli("edit", self.room, "--script", self.script(edits), "--quality", "draft", "--time", "2",
                            "--stats", self.path("s.json"), status=2)
        self.assertIn("stopped at the time limit", done.stderr)
        self.assertLess(json.loads(self.read("s.json"))["time"]["total"], 30)
        self.run_cli("edit", self.room, "--script", self.script(edits), "--time", "0.001", "--stats", self.path("s.json"), status=2)
        self.assertEqual(json.loads(self.read("s.json"))["edits"], [])


class Reference(CliTest):
    def test_points_and_columns(self):
        points = self.write("p.csv", POINTS)
        done = self.run_cli("reference", self.room, "--points", points, "--error", "0.01", "--time", "200")
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout.splitlines()[0], "x,y,z,nx,ny,nz,E_r,E_g,E_b,E,stderr,on_surface")
        rows = self.rows(done.stdout)
        self.assertEqual(len(rows), 3)
        for row in rows:
            self.assertEqual(row["on_surface"], 1)
            self.assertAlmostEqual(row["E"], 0.2126 * row["E_r"] + 0.7152 * row["E_g"] + 0.0722 * row["E_b"], delta=1e-3)
            self.assertLessEqual(row["stderr"], 0.01 * row["E"])
        # Below the lamp of 1 m2 and 1000 cd/m2 at 2.49 m, whose form factor is 4 x 0.01218; the walls add to that.
        self.assertGreater(rows[0]["E"], 1000 * 3.14159 * 0.0487)
        again = self.run_cli("reference", self.room, "--points", points, "--error", "0.01", "--time", "200", "--threads", "1")
        self.assertEqual(again.stdout, done.stdout)
        other = self.run_cli("reference", self.room, "--points", points, "--error", "0.01", "--time", "200", "--seed", "9")
        for a, b in zip(rows, self.rows(other.stdout)):
            self.assertNotEqual(a["E"], b["E"])
            self.assertAlmostEqual(a["E"], b["E"], delta=6 * (a["stderr"] + b["stderr"]))

    def test_time_limit_is_a_normal_end(self):
        points = self.write("p.csv", POINTS)
        start = time.monotonic()
        self.run_cli("reference", self.room, "--points", points, "--time", "2", "-o", self.path("r.csv"))
        self.assertLess(time.monotonic() - start, 20)
        self.assertEqual(len(self.rows(self.read("r.csv"))), 3)
        # An error that was asked for and not reached is not: what there was is written.
        self.run_cli("reference", self.room, "--points", points, "--time", "2", "--error", "1e-6", "-o", self.path("s.csv"),
                     status=2)
        self.assertEqual(len(self.rows(self.read("s.csv"))), 3)

    def test_nothing_is_made_up_without_time(self):
        points = self.write("p.csv", POINTS)
        done = self.run_cli("reference", self.room, "--points", points, "--time", "0.001", "-o", self.path("r.csv"), status=2)
        self.assertIn("stopped before the first estimate", done.stderr)
        self.assertFalse(os.path.exists(self.path("r.csv")))

    def test_signal(self):
        points = self.write("p.csv", POINTS)
        process = subprocess.Popen([CLI, "reference", self.room, "--points", points, "--time", "100", "-o", self.path("r.csv")],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(2.0)
        process.send_signal(signal.SIGINT)
        _, message = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 2, message)
        self.assertIn(b"stopped by a signal", message)
        self.assertEqual(len(self.rows(self.read("r.csv"))), 3)

    def test_picture(self):
        self.run_cli("reference", self.room, "--camera", "Front", "-o", self.path("a.exr"), "--size", "48x32", "--time", "4")
        with open(self.path("a.exr"), "rb") as f:
            head = f.read(400)
        self.assertEqual(head[:4], b"\x76\x2f\x31\x01")
        self.assertIn(b"standard_error.Y", head)
        # The light solution sees the same room.
        self.run_cli("render", self.room, "-o", self.path("b.exr"), "--camera", "Front", "--size", "48x32")
        figures = json.loads(self.run_cli("compare", self.path("b.exr"), self.path("a.exr"), "--json").stdout)
        self.assertLess(abs(figures["mean_relative_bias"]), 0.1)
        self.run_cli("reference", self.room, "--camera", "0", "-o", self.path("a.png"), "--size", "16x16", "--time", "2")

    def test_wrong_requests(self):
        points = self.write("p.csv", POINTS)
        self.refused("reference", self.room, says=["nothing is asked for"])
        self.refused("reference", self.room, "--points", points, "--camera", "0", says=["exclude"])
        self.refused("reference", self.room, "--camera", "0", says=["-o"])
        self.refused("reference", self.room, "--camera", "0", "-o", self.path("a.jpg"), says=["a.jpg"])
        self.refused("reference", self.room, "--camera", "Nobody", "-o", self.path("a.exr"), says=["Nobody"])
        self.refused("reference", self.room, "--points", self.path("none.csv"), says=["none.csv"])
        self.refused("reference", self.path("none.glb"), "--points", points, says=["none.glb"])


class Inspect(CliTest):
    BALL = os.path.join(os.path.dirname(ROOM), "..", "glass-ball", "glass-ball.glb")

    def test_caustics_of_a_glass_ball(self):
        out = self.path("textures")
        done = self.run_cli("inspect", self.BALL, "--json", "--extract", out, "--quality", "draft")
        told = json.loads(done.stdout)
        self.assertTrue(any("texture" == r["decision"] for r in told["caustics"]), done.stdout[:2000])
        self.assertTrue(any(name.endswith(".exr") for name in os.listdir(out)))

    def test_what_is_set_by_hand_is_done_saved_and_told(self):
        script = self.write("hand.json", json.dumps({"edits": [{"kind": "caustics", "node": "Table", "show": "mesh"}]}))
        project = self.path("by_hand.atrium")
        self.run_cli("edit", self.BALL, "--script", script, "--quality", "draft", "-o", project)
        told = json.loads(self.run_cli("inspect", project, "--json").stdout)
        self.assertTrue(told["solution_stored"])
        table = [r for r in told["caustics"] if r["surface"] == "Table"]
        self.assertTrue(any(r["decision"] == "mesh: set by hand" and r["decision_by_itself"] == "texture" for r in table), table)
        self.assertTrue(all(r["set_by_hand"] for r in table))
        self.assertEqual(told["memory"]["caustic_textures"], 0)
        self.assertIn("set by hand to mesh", self.run_cli("inspect", project).stdout)

    def test_nothing_specular_nothing_listed(self):
        done = self.run_cli("inspect", self.room, "--json", "--quality", "draft")
        told = json.loads(done.stdout)
        self.assertEqual(told["caustics"], [])
        self.assertEqual(told["memory"]["caustic_textures"], 0)


class Compare(CliTest):
    def figures(self, a, b):
        return json.loads(self.run_cli("compare", self.path(a), self.path(b), "--json").stdout)

    def measurement(self, name, factor=1.0, noise=()):
        lines = ["x,y,z,nx,ny,nz,E_r,E_g,E_b,E,stderr,on_surface"]
        for i in range(100):
            e = (100 + i) * factor + (noise[i % len(noise)] if noise else 0)
            lines.append("%d,0,0,0,1,0,%r,%r,%r,%r,0,1" % (i, e, e, e, e))
        self.write(name, "\n".join(lines) + "\n")

    def test_measurements(self):
        self.measurement("a.csv")
        self.measurement("b.csv", 1.1)
        same = self.figures("a.csv", "a.csv")
        self.assertEqual({k: same[k] for k in ("relMSE", "relRMSE", "mean_relative_bias", "p95", "p99")},
                         {"relMSE": 0, "relRMSE": 0, "mean_relative_bias": 0, "p95": 0, "p99": 0})
        self.assertNotIn("FLIP", same)
        more = self.figures("b.csv", "a.csv")
        self.assertAlmostEqual(more["mean_relative_bias"], 0.1, delta=1e-9)
        self.assertAlmostEqual(more["p95"], 0.1, delta=0.002)
        self.assertAlmostEqual(more["relRMSE"], 0.1, delta=0.005)
        self.assertAlmostEqual(more["relMSE"], 0.01, delta=1e-4)
        self.measurement("c.csv", 1.0, (5, -5))
        self.assertAlmostEqual(self.figures("c.csv", "a.csv")["mean_relative_bias"], 0.0, delta=1e-12)
        self.assertIn("relRMSE", self.run_cli("compare", self.path("b.csv"), self.path("a.csv")).stdout)

    def test_images(self):
        for name, exposure in (("a.png", "0"), ("b.png", "1")):
            self.run_cli("render", self.room, "-o", self.path(name), "--size", "64x48", "--quality", "draft", "--exposure", exposure)
        self.assertEqual(self.figures("a.png", "a.png")["FLIP"], 0)
        different = self.figures("b.png", "a.png")
        self.assertTrue(0.01 < different["FLIP"] < 1, different)
        self.run_cli("render", self.room, "-o", self.path("c.png"), "--size", "48x48", "--quality", "draft")
        self.refused("compare", self.path("a.png"), self.path("c.png"), says=["48x48", "64x48"])

    def test_projects(self):
        self.run_cli("solve", self.room, "-o", self.path("a.atrium"), "--quality", "draft")
        self.run_cli("solve", self.room, "-o", self.path("b.atrium"), "--quality", "normal")
        self.assertEqual(self.figures("a.atrium", "a.atrium")["relMSE"], 0)
        figures = self.figures("a.atrium", "b.atrium")
        self.assertGreater(figures["values"], 1000)
        self.assertLess(figures["relRMSE"], 0.25)

    def test_unlike_things(self):
        self.measurement("a.csv")
        self.measurement("b.csv")
        self.refused("compare", self.path("a.csv"), self.room)
        self.refused("compare", self.path("a.csv"), self.path("none.csv"), says=["none.csv"])
        moved = self.read("b.csv").replace("5,0,0,0,1,0", "5,0,1,0,1,0", 1)
        self.refused("compare", self.path("a.csv"), self.write("moved.csv", moved), says=["another point"])
        self.run_cli("convert", self.room, self.path("unsolved.atrium"))
        self.refused("compare", self.path("unsolved.atrium"), self.path("unsolved.atrium"), says=["no light"])


class Convert(CliTest):
    def names(self, path):
        done = json.loads(self.run_cli("info", path, "--json").stdout)
        return done["scene"]["nodes"], done["scene"]["triangles"], done["camera_names"], done["bounds"]

    def test_round_trips(self):
        expected = self.names(self.room)
        previous = self.room
        for name in ("a.glb", "b.gltf", "c.atrium", "d.glb"):
            done = self.run_cli("convert", previous, self.path(name))
            self.assertEqual((done.stdout, done.stderr), ("", ""))
            self.assertEqual(self.names(self.path(name)), expected, name)
            previous = self.path(name)

    def test_same_scene_same_bytes(self):
        self.run_cli("convert", self.room, self.path("a.glb"))
        self.run_cli("convert", self.room, self.path("b.glb"))
        with open(self.path("a.glb"), "rb") as a, open(self.path("b.glb"), "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_light_stays_in_projects(self):
        self.run_cli("solve", self.room, "-o", self.path("a.atrium"), "--quality", "draft")
        self.run_cli("convert", self.path("a.atrium"), self.path("b.atrium"))
        self.run_cli("convert", self.path("a.atrium"), self.path("c.glb"))
        for name, expected in (("b.atrium", True), ("c.glb", False)):
            self.assertEqual(json.loads(self.run_cli("info", self.path(name), "--json").stdout)["has_solution"], expected, name)

    def test_wrong_output(self):
        self.refused("convert", self.room, self.path("a.obj"), says=[".gltf"])
        self.refused("convert", self.room, self.path("no/folder/a.glb"), says=["folder"])


class SunlitRoom(CliTest):
    def test_facts(self):
        facts = json.loads(self.run_cli("info", ROOM, "--json").stdout)
        self.assertEqual([p for p in facts["problems"] if p["severity"] != "note"], [])
        self.assertEqual(facts["camera_names"], ["From the door", "From the bookshelf"])
        for name in ("sun", "sky", "textures", "transmittance", "specular_view"):
            self.assertTrue(facts["features"][name]["used"], name)
        with open(os.path.join(os.path.dirname(ROOM), "README.md"), encoding="utf-8") as f:
            text = f.read()
        self.assertIn("{:,} triangles drawn, {} nodes, {} materials".format(
            facts["scene"]["triangles"], facts["scene"]["nodes"], facts["scene"]["materials"]), text)
        self.assertEqual(self.run_cli("check", ROOM).stderr, "")


class SharedScenes(CliTest):
    def files(self, folder):
        top = os.path.join(SHARED, "scenes", folder)
        if not os.path.isdir(top):
            print("skipped: %s is not there" % top)
            sys.exit(77)
        for here, _, names in sorted(os.walk(top)):
            for name in sorted(names):
                if name.endswith((".gltf", ".glb")):
                    yield os.path.join(here, name)

    def test_conformance_files_are_read(self):
        for path in self.files("conformance"):
            with self.subTest(path):
                self.run_cli("info", path)

    def test_broken_files_never_crash(self):
        for path in self.files("broken"):
            with self.subTest(path):
                done = subprocess.run([CLI, "check", path], capture_output=True, timeout=60)
                self.assertIn(done.returncode, (0, 1))


if __name__ == "__main__":
    unittest.main()
