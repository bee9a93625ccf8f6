"""The examples run as they are and leave a picture."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "python" / "examples"


def run(name, *words):
    pytest.importorskip("matplotlib")
    done = subprocess.run([sys.executable, EXAMPLES / name, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def is_picture(path):
    return path.read_bytes().startswith(b"\x89PNG") and path.stat().st_size < 100_000


def test_co_contraction_curve(tmp_path):
    said = run("co_contraction_curve.py", "--tissue", "line", "--levels", 3, "--picture", tmp_path / "a.png")
    stiffnesses = [float(line.split()[3]) for line in said.splitlines() if line.startswith("u ")]
    assert len(stiffnesses) == 3 and stiffnesses == sorted(stiffnesses)
    assert is_picture(tmp_path / "a.png")


def test_press_stiffness(tmp_path):
    relaxed, contracted = (
        [float(word) for word in line.split()[2:-1]]
        for line in run("press_stiffness.py", "--picture", tmp_path / "a.png").splitlines()
        if line.startswith("activation")
    )
    assert relaxed[0] == contracted[0] == 0  # not yet in touch
    assert relaxed[-1] > relaxed[6] > 0
    assert contracted[-1] > 1.3 * relaxed[-1]
    assert is_picture(tmp_path / "a.png")


def test_specimen_from_labels(tmp_path):
    if shutil.which(os.environ.get("MYOTACT_PREPARE", "myotact-prepare")) is None:
        pytest.skip("myotact-prepare is not there")
    said = run("specimen_from_labels.py", "--folder", tmp_path / "arm", "--picture", tmp_path / "a.png")
    flexed = float(said.split("flexed by ")[1].split()[0])
    assert flexed > 1
    assert is_picture(tmp_path / "a.png")
