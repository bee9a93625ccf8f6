"""tools/get_full_surfaces.sh on copies of the package that are made up here: python3 full_surfaces_test.py PROJECT"""
import hashlib
import io
import json
import os
import pathlib
import struct
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

PROJECT = pathlib.Path(sys.argv.pop(1))
ROWS = [line.split("\t") for line in (PROJECT / "tools/full_surfaces/files.tsv").read_text().splitlines()[1:]]


def stl(triangles):
    return b"made up".ljust(80) + struct.pack("<I", len(triangles)) + b"".join(triangles)


def triangle(number):
    return struct.pack("<12fH", *([float(number)] * 12), 0)


def made_up():
    """source -> bytes; its triangle tells which it is."""
    return {source: stl([triangle(i)]) for i, (_, source, _) in enumerate(ROWS)}


class FullSurfaces(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.place = pathlib.Path(self.holder.name)
        self.out = self.place / "out"

    def tearDown(self):
        self.holder.cleanup()

    def run_script(self, source, *options, environment=None):
        command = [PROJECT / "tools/get_full_surfaces.sh", self.out, "--sort-only", *options]
        if source is not None:
            command += ["--from", source]
        return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)

    def folder(self, files):
        assets = self.place / "package/dm_control/suite/dog_assets"
        for name, data in files.items():
            path = assets / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        return self.place / "package"

    def check_sorted(self):
        joined = {}
        for i, (surface, _, _) in enumerate(ROWS):
            joined.setdefault(surface, []).append(triangle(i))
        self.assertEqual({str(p.relative_to(self.out)) for p in self.out.rglob("*.stl")}, set(joined))
        for surface, triangles in joined.items():
            data = (self.out / surface).read_bytes()
            self.assertEqual(struct.unpack_from("<I", data, 80)[0], len(triangles), surface)
            self.assertEqual(data[84:], b"".join(triangles), surface)

    def test_sorts_a_copy_of_the_source(self):
        answer = self.run_script(self.folder(made_up()), "--any-version")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.check_sorted()

    def test_sorts_packages_of_both_kinds(self):
        wheel = self.place / "made_up.whl"
        with zipfile.ZipFile(wheel, "w") as archive:
            for name, data in made_up().items():
                archive.writestr("dm_control/suite/dog_assets/" + name, data)
        self.assertEqual(self.run_script(wheel, "--any-version").returncode, 0)
        self.check_sorted()
        source = self.place / "made_up.tar.gz"
        with tarfile.open(source, "w:gz") as archive:
            for name, data in made_up().items():
                member = tarfile.TarInfo("made-up-1/dm_control/suite/dog_assets/" + name)
                member.size = len(data)
                archive.addfile(member, io.BytesIO(data))
        self.out = self.place / "out2"
        self.assertEqual(self.run_script(source, "--any-version").returncode, 0)
        self.check_sorted()

    def refused(self, status, text, source, *options, environment=None):
        answer = self.run_script(source, *options, environment=environment)
        self.assertEqual(answer.returncode, status, answer.stderr)
        self.assertIn(text, answer.stderr)
        self.assertFalse(self.out.exists())

    def test_refuses_other_files_than_those_measured_on(self):
        self.refused(65, "checksum", self.folder(made_up()))

    def test_names_what_is_missing_or_broken(self):
        files = made_up()
        lost = ROWS[40][1]
        del files[lost]
        self.refused(65, lost, self.folder(files), "--any-version")
        self.refused(66, "nowhere", self.place / "nowhere")
        (self.place / "noise.whl").write_bytes(b"PK\x03\x04 no archive")
        self.refused(65, "noise.whl", self.place / "noise.whl")
        (self.place / "empty").mkdir()
        self.refused(66, "dog_assets", self.place / "empty")

    def test_says_that_the_client_or_the_network_is_missing(self):
        tools = self.place / "bin"
        tools.mkdir()
        fake = tools / "python3"
        fake.write_text("#!/bin/sh\nexit 1\n")
        fake.chmod(0o755)
        environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}
        self.refused(69, "pip is not installed", None, environment=environment)
        fake.write_text('#!/bin/sh\n[ "$3" = --version ]\n')
        self.refused(69, "is there a network", None, environment=environment)

    def test_gives_the_measured_files(self):
        canine = os.environ.get("MYOTACT_CANINE_DIR")
        if not canine or not (pathlib.Path(canine) / "manifest.json").is_file():
            self.skipTest("MYOTACT_CANINE_DIR is not set: the full canine meshes are not there")
        known = {}
        for kind in json.loads((pathlib.Path(canine) / "manifest.json").read_text()).values():
            for part in kind if isinstance(kind, list) else []:
                known[part["file"]] = part["sha256"]
        single = {surface: checksum for surface, _, checksum in ROWS if [r[0] for r in ROWS].count(surface) == 1}
        self.assertEqual(len(known), len({row[0] for row in ROWS}))
        for surface, checksum in single.items():
            self.assertEqual(known[surface], checksum)
            self.assertEqual(hashlib.sha256((pathlib.Path(canine) / surface).read_bytes()).hexdigest(), checksum)


if __name__ == "__main__":
    unittest.main()
