"""Wrong arguments are refused with their name, what is expected and what came."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import myotact
from conftest import LINES

BICEPS = "biceps_brachii"


@pytest.mark.parametrize(
    "call, error, text",
    [
        (lambda s: s.muscles["bicps"], KeyError, "got 'bicps' (nearest: biceps_brachii)"),
        (lambda s: s.muscles[0], TypeError, "muscle: expected a text, got int 0"),
        (lambda s: s.joints["knee"], KeyError, "joint: expected one of"),
        (lambda s: s.step(-1), ValueError, "n: expected an integer in 0"),
        (lambda s: s.step(1.5), TypeError, "n: expected an integer, got float 1.5"),
        (lambda s: s.step(True), TypeError, "n: expected an integer, got bool"),
        (lambda s: s.step(10**30), ValueError, "n: expected an integer"),
        (lambda s: s.run(float("nan")), ValueError, "seconds: expected a number in 0"),
        (lambda s: s.co_contract(1.2), ValueError, "common: expected a number in 0 .. 1, got 1.2"),
        (lambda s: s.co_contract("full"), TypeError, "common: expected a number, got str 'full'"),
        (lambda s: s.set_levels(0.5, None), TypeError, "extensors: expected a number, got None"),
        (lambda s: s.hold_posture(1), TypeError, "on: expected True or False, got int 1"),
        (lambda s: s.muscles[BICEPS].activate(0.5), ValueError, "is driven by the scene's co-contraction"),
        (lambda s: s.muscles[BICEPS].moment_arm("elbwo"), KeyError, "nearest: elbow"),
        (lambda s: s.tools[0].move_to([1, 2]), ValueError, "position: expected the shape (3,), got (2,)"),
        (lambda s: s.tools[0].move_to([[0, 0, 0]]), ValueError, "position: expected the shape (3,), got (1, 3)"),
        (lambda s: s.tools[0].move_to("abc"), TypeError, "position: expected numbers of the shape (3,), got the dtype <U3"),
        (lambda s: s.tools[0].move_to([0, 0, 1j]), TypeError, "got the dtype complex128"),
        (lambda s: s.tools[0].move_to([0, 0, np.inf]), ValueError, "position: expected finite numbers, got 1"),
        (lambda s: s.tools[0].move_to([0, 0, 99]), ValueError, "position: expected a point within 10 m"),
        (lambda s: s.tools[0].move_to([0, [1], 2]), (TypeError, ValueError), "position: expected"),
        (lambda s: s.tools[0].touch(BICEPS, direction=(0, 0, 0)), ValueError, "direction: expected a direction"),
        (lambda s: s.tools[0].touch(BICEPS, depth=1), ValueError, "depth: expected a number in -0.05 .. 0.05"),
        (lambda s: s.tools[0].touch("biceps", at=2), (KeyError, ValueError), "biceps_brachii"),
        (lambda s: s.tools[0].grab_bone("femur"), KeyError, "bone: expected one of"),
        (lambda s: s.joints["elbow"].push(np.nan, 1), ValueError, "torque: expected a number"),
        (lambda s: s.samples(), ValueError, "samples: none were kept"),
        (lambda s: s._live.array(99, myotact._myotact.MuscleArray.nodes), IndexError, "muscle 99: must be in 0 .. 6"),
        (lambda s: s._live.joint_state(-1), IndexError, "joint -1"),
    ],
)
def test_refused(scene, call, error, text):
    with pytest.raises(error, match=re.escape(text)):
        call(scene)
    scene.step()  # nothing came of it


@pytest.mark.parametrize(
    "scene, more, error, text",
    [
        ("elbw", {}, FileNotFoundError, 'nearest: "elbow"'),
        ("/nowhere/scene.json", {}, FileNotFoundError, "/nowhere/scene.json"),
        (3, {}, TypeError, "scene: expected a name, a path or a dict, got int"),
        ({}, {}, ValueError, ""),
        ({"schema": 1, "specimen": "/nowhere"}, {}, myotact.Error, ""),
        ("elbow", {"set": {"dt_s": 5}}, ValueError, "/dt_s: is 5"),
        ("elbow", {"set": {"tissue.default": "jelly"}}, ValueError, "fem"),
        ("elbow", {"set": {1: 2}}, TypeError, "set: key: expected a text, got int 1"),
        ("elbow", {"set": {"dt_s": object()}}, TypeError, "set: expected numbers"),
        ("elbow", {"workers": 0}, ValueError, "workers: expected an integer in 1 .. 64, got 0"),
        ("elbow", {"script": "yes"}, TypeError, "script: expected True or False"),
        ("elbow", {"seed": -1}, ValueError, "seed: expected an integer"),
        ("elbow\0", {}, (ValueError, FileNotFoundError), ""),
    ],
)
def test_scene_refused(scene, more, error, text):
    with pytest.raises(error, match=re.escape(text)):
        myotact.Scene(scene, **more)


def test_scene_without_co_contraction(free_scene):
    with pytest.raises(myotact.DataError, match="has no co-contraction"):
        free_scene.co_contract(0.5)


def test_numpy_numbers_and_lists_are_numbers(scene):
    scene.co_contract(np.float32(0.25), np.int64(0))
    scene.step(np.int32(2))
    scene.tools[0].move_to([0, 0, 1])
    assert myotact.Scene("elbow", set={**LINES, "gravity_m_s2": np.zeros(3)}).dt == 0.01


def test_errors_are_of_one_family():
    for kind in ("DataError", "MissingError", "MisuseError", "UnknownNameError", "WriteError"):
        assert issubclass(getattr(myotact, kind), myotact.Error)
    with pytest.raises(myotact.MissingError) as caught:
        myotact.Specimen("/nowhere")
    assert caught.value.status == 66 and "specimen.json" in str(caught.value)


def test_a_damaged_specimen_is_refused(tmp_path):
    (tmp_path / "specimen.json").write_text('{"schema": 1, ')
    with pytest.raises(myotact.DataError, match="specimen.json"):
        myotact.Specimen(tmp_path)


def test_specimen_reads_what_a_scene_has(scene):
    read = myotact.Specimen(myotact.data_folder() / "meshes" / "canine_elbow")
    assert list(read.muscles) == list(scene.specimen.muscles)
    mine, other = read.muscles[BICEPS], scene.specimen.muscles[BICEPS]
    assert np.array_equal(mine.nodes, other.nodes) and mine == other
    assert np.linalg.norm(mine.fibres, axis=1) == pytest.approx(1, abs=1e-6)
    assert read.joints["elbow"].range[0][0] < 0 < read.joints["elbow"].range[0][1]
    bone = read.bones["humerus"]
    assert bone.triangles.max() < len(bone.vertices)


def test_stubs_say_what_is_there():
    """Types by mypy, and the extension module's stub by stubtest, where they are installed."""
    pytest.importorskip("mypy")
    package = Path(myotact.__file__).parent
    settings = dict(os.environ)
    if package.parent.name not in ("site-packages", "dist-packages"):  # mypy finds those itself and wants no path to them
        settings["MYPYPATH"] = str(package.parent)
    allowed = Path(__file__).with_name("stubtest_allowed.txt")
    for words in (
        ["mypy", "--strict", "--no-warn-return-any", str(package)],
        ["mypy.stubtest", "myotact._myotact", "--ignore-missing-stub", "--allowlist", str(allowed)],
    ):
        done = subprocess.run(
            [sys.executable, "-m", *words], capture_output=True, text=True, cwd=allowed.parent, env=settings
        )
        assert done.returncode == 0, done.stdout + done.stderr
