"""The manual pages and completions tell what --help tells, the version names one number, and desktop files are valid."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

ROOT = os.environ["ATRIUM_SOURCE_DIR"]
PROGRAMS = {"atrium-cli": os.environ["ATRIUM_CLI"]}
if os.environ.get("ATRIUM_EDITOR"):
    PROGRAMS["atrium"] = os.environ["ATRIUM_EDITOR"]


def output(*command):
    without_display = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.run(command, check=True, capture_output=True, text=True, env=without_display, timeout=60).stdout


def text(*path):
    with open(os.path.join(*path)) as file:
        return file.read()


def option_names(help_text):
    """Names in the first column of --help."""
    names = set()
    for line in help_text.splitlines():
        first = re.match(r"\s+(-[^\s<]+(?:, -[^\s<]+)*)", line)
        if first:
            names |= {name.strip() for name in first.group(1).split(",")}
    return names - {"--help-all"}  # Qt's own


def completions(script, words):
    """What the completion offers for the last of the words."""
    call = ('source /usr/share/bash-completion/bash_completion; source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($#-1)); '
            'COMP_LINE="$*"; COMP_POINT=${#COMP_LINE}; function_name=$(complete -p "$1" | sed "s/.*-F \\([^ ]*\\).*/\\1/"); '
            '$function_name; printf "%s\\n" "${COMPREPLY[@]}"')
    return set(output("bash", "-c", call, "bash", script, *words).split())


class Documents(unittest.TestCase):
    def test_every_option_of_help_is_in_the_page(self):
        for name, program in PROGRAMS.items():
            page = output(program, "--write-manual-page").replace("\\-", "-").replace("\\fB", "").replace("\\fR", "")
            commands = re.findall(r"^  (\w+) ", output(program, "--help").split("Subcommands:")[-1], re.M) if name == "atrium-cli" else []
            self.assertTrue(name == "atrium" or len(commands) >= 10, commands)
            wanted = option_names(output(program, "--help").split("Subcommands:")[0])
            for command in commands:
                self.assertIn("\n.SS %s\n" % command, page)
                wanted |= option_names(output(program, command, "--help"))
            self.assertGreater(len(wanted), 5)
            for option in wanted:
                self.assertRegex(page, r"(?m)^(.*, )?%s(,| |$)" % re.escape(option), "%s of %s" % (option, name))

    def test_the_pages_are_clean_troff(self):
        if not shutil.which("man") or not shutil.which("groff"):
            self.skipTest("no man here")
        for name, program in PROGRAMS.items():
            with tempfile.NamedTemporaryFile("w", suffix=".1") as page:
                page.write(output(program, "--write-manual-page"))
                page.flush()
                run = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page.name], capture_output=True,
                                     text=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
                self.assertEqual((run.returncode, run.stderr), (0, ""), name)

    def test_completions_offer_commands_options_and_choices(self):
        if not os.path.exists("/usr/share/bash-completion/bash_completion"):
            self.skipTest("no bash-completion here")
        with tempfile.TemporaryDirectory() as folder:
            script = os.path.join(folder, "completion")
            with open(script, "w") as out:
                out.write(output(PROGRAMS["atrium-cli"], "--write-completion"))
            self.assertEqual(completions(script, ["atrium-cli", "so"]), {"solve"})
            self.assertEqual(completions(script, ["atrium-cli", "solve", "--qu"]), {"--quality"})
            self.assertEqual(completions(script, ["atrium-cli", "solve", "--quality", ""]), {"draft", "normal", "fine"})
            self.assertEqual(completions(script, ["atrium-cli", "solve", "--threshold", "mesh"]), {"meshEdge=", "meshContrast="})
            for name in ("a.glb", "b.txt"):
                open(os.path.join(folder, name), "w").close()
            self.assertEqual(completions(script, ["atrium-cli", "info", folder + "/"]), {folder + "/a.glb"})

    def test_one_version(self):
        number = re.search(r"project\(atrium VERSION (\S+) ", text(ROOT, "CMakeLists.txt")).group(1)
        for name, program in PROGRAMS.items():
            self.assertRegex(output(program, "--version"), r"^%s %s( \([0-9a-f]{7,40}(, modified)?\))?\n$" % (name, re.escape(number)))
            self.assertIn('"Atrium %s"' % number, output(program, "--write-manual-page").splitlines()[0])

    def test_file_types_of_the_desktop_entry_are_known(self):
        folder = os.path.join(ROOT, "packaging", "desktop")
        entry = text(folder, "atrium.desktop")
        types = set(re.search(r"^MimeType=(.*);$", entry, re.M).group(1).split(";"))
        space = "{http://www.freedesktop.org/standards/shared-mime-info}"
        own = xml.parse(os.path.join(folder, "atrium-mime.xml")).getroot().findall(space + "mime-type")
        self.assertEqual([(t.get("type"), t.find(space + "glob").get("pattern")) for t in own], [("application/x-atrium", "*.atrium")])
        self.assertEqual(types, {"application/x-atrium", "model/gltf+json", "model/gltf-binary"})
        provided = {t.text for t in xml.parse(os.path.join(folder, "atrium.metainfo.xml.in")).getroot().iter("mediatype")}
        self.assertEqual(types, provided)
        if shutil.which("desktop-file-validate"):
            subprocess.run(["desktop-file-validate", os.path.join(folder, "atrium.desktop")], check=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
