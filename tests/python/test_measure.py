"""What is measured from Python is what the program measures, and what closed forms say."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

import myotact
from conftest import LINES


def test_stiffness_equals_the_program(program, tmp_path):
    said = subprocess.run(
        [program, "stiffness", "elbow", "--set", "tissue.default=line", "--levels", "0:0.5:1", "--out", tmp_path]
        + ["--log-level", "error"],
        check=True,
        capture_output=True,
    )
    assert said.returncode == 0
    rows = myotact.stiffness("elbow", levels=[0, 0.5, 1], set=LINES)
    names, *lines = (tmp_path / "stiffness.csv").read_text().splitlines()
    assert list(rows.dtype.names) == names.split(",")
    for row, line in zip(rows, lines, strict=True):
        for value, word in zip(row, line.split(","), strict=True):
            if isinstance(value, np.bool_):
                assert value == (word == "1")
            elif isinstance(value, str):
                assert value == word
            else:
                assert float(value) == float(word) or (np.isnan(value) and word in ("", "nan"))


def test_stiffness_of_a_scene_and_its_refusals(scene):
    rows = scene.stiffness(levels=[0.0, 1.0])
    assert len(rows) == 2 and rows["converged"].all()
    # The slope of the torque, found apart from the Schur complement.
    assert rows["K_schur_Nm_rad"] == pytest.approx(rows["K_perturbed_Nm_rad"], rel=5e-3)
    for wrong in ([1.5], [-0.1], [], [np.nan]):
        with pytest.raises(myotact.DataError, match="levels"):
            scene.stiffness(levels=wrong)
    with pytest.raises(TypeError, match="levels: expected numbers .* got the dtype"):
        scene.stiffness(levels=["much"])
    with pytest.raises(myotact.DataError, match="angles: 3 rad is outside the range of the joint elbow"):
        scene.stiffness(angles=[3.0])
    with pytest.raises(myotact.Error, match="elbow"):
        scene.stiffness(joint="elbw")


def plane(size=0.05):
    vertices = np.array([[-size, -size, 0], [size, -size, 0], [size, size, 0], [-size, size, 0]])
    return vertices, np.array([[0, 1, 2], [0, 2, 3]])


def test_probe_of_a_plane_feels_hooke():
    """A sphere pressed into a rigid plane: stiffness times depth, upright; on the plane, not inside."""
    times = np.linspace(0, 1, 11)
    depth = np.linspace(-2e-3, 3e-3, 11)
    radius, stiffness = 2e-3, 500.0
    path = np.column_stack([times, np.zeros(11), np.zeros(11), radius - depth])
    answer = myotact.probe(plane(), path, radius=radius, stiffness=stiffness)
    rows = answer.rows
    wanted = stiffness * np.maximum(0.0, np.interp(rows["t_s"], times, depth))
    assert rows["force_z_N"] == pytest.approx(wanted, abs=2e-3)
    assert rows["proxy_z_m"].min() > radius - 1e-6
    assert not rows["inside"].any()
    assert answer.summary["rows"] == len(rows)


def test_probe_refuses_what_is_wrong():
    path = [[0, 0, 0, 0.01], [1, 0, 0, 0.0]]
    vertices, triangles = plane()
    with pytest.raises(myotact.DataError, match=r"path: expected the shape \(n, 4\), got \(2, 3\)"):
        myotact.probe(plane(), np.zeros((2, 3)))
    with pytest.raises(myotact.DataError, match="indices in 0 .. 3, got up to 9"):
        myotact.probe((vertices, triangles + 6), path)
    with pytest.raises(TypeError, match="triangles: expected whole numbers .* float64"):
        myotact.probe((vertices, triangles * 1.0), path)
    with pytest.raises(myotact.DataError, match="vertices: expected finite numbers"):
        myotact.probe((vertices * np.nan, triangles), path)
    with pytest.raises(myotact.DataError, match="radius: expected a number in 0 .. 0.005"):
        myotact.probe(plane(), path, radius=1.0)
    with pytest.raises(myotact.MissingError):
        myotact.probe("/nowhere.ply", path)
    with pytest.raises(myotact.Error):
        myotact.probe((np.zeros((0, 3)), np.zeros((0, 3), int)), path)




def shipped_case():
    """The first case that comes with the program."""
    folder = Path(__file__).resolve().parents[2] / "assets" / "cases"
    cases = sorted(folder.glob("*.json"))
    return cases[0] if cases else None


def test_solve_equals_the_program(program, tmp_path):
    import json

    case = shipped_case()
    if case is None:
        pytest.skip("no case is shipped")
    said = subprocess.run([program, "solve", case], capture_output=True, text=True)
    assert said.returncode == 0, said.stderr
    answer, wanted = myotact.solve(case, vtk=tmp_path / "out.vtk"), json.loads(said.stdout)
    answer.pop("wall_s"), wanted.pop("wall_s")
    assert answer == wanted
    assert (tmp_path / "out.vtk").stat().st_size > 0


def test_solve_refuses(tmp_path):
    with pytest.raises(myotact.MissingError):
        myotact.solve(tmp_path / "none.json")
    with pytest.raises(myotact.DataError):
        myotact.solve({"schema": 1, "mash": "x"})
    with pytest.raises(TypeError, match="case: expected a file or a dict, got int"):
        myotact.solve(3)


def test_prepare_is_a_program(tmp_path, monkeypatch):
    with pytest.raises(myotact.MissingError, match="no such program"):
        myotact.prepare("--help", program=tmp_path / "nothing")
    fake = tmp_path / "fake"
    fake.write_text("#!/bin/sh\necho out \"$@\"\n[ \"$1\" = ok ] || { echo what is wrong >&2; exit 65; }\n")
    fake.chmod(0o755)
    monkeypatch.setenv("MYOTACT_PREPARE", str(fake))
    assert myotact.prepare("ok", Path("b")) == "out ok b\n"
    with pytest.raises(myotact.DataError, match="ended with 65: what is wrong") as caught:
        myotact.prepare("bad")
    assert caught.value.status == 65
