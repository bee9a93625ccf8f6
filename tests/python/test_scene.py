"""A scene from Python is the program's, and its arrays are where they are."""

import gc
import statistics
import subprocess
import sys
import threading
import weakref

import numpy as np
import pytest

import myotact
from conftest import LINES

BICEPS = "biceps_brachii"


def address(array):
    return array.__array_interface__["data"][0]


@pytest.mark.parametrize("tissue", ["line", "fem"])
def test_equals_the_program_bit_for_bit(program, tmp_path, tissue):
    seconds = "0.6"
    subprocess.run(
        [program, "run", "elbow", "--seconds", seconds, "--out", tmp_path, "--levels", "none"]
        + ["--set", f"tissue.default={tissue}", "--log-level", "error"],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    scene = myotact.Scene("elbow", set={"tissue.default": tissue}, script=True, samples=1, workers=1)
    scene.run(float(seconds))
    assert scene.samples_csv() == (tmp_path / "samples.csv").read_text()
    assert len(scene.samples()) == 600


def test_same_calls_give_the_same_bits():
    def played():
        scene = myotact.Scene("elbow", set=LINES)
        scene.co_contract(0.4)
        scene.tools[0].touch(BICEPS, direction=(1, 0, 0), seconds=0.2)
        scene.step(40)
        return scene.state_hash, scene.tools[0].force.tolist()

    assert played() == played()


def test_arrays_stay_in_place_and_follow(tissue_scene):
    muscle = tissue_scene.muscles[BICEPS]
    arrays = {"nodes": muscle.nodes, "velocities": muscle.velocities, "skin": muscle.skin}
    before = {name: (address(array), array.copy()) for name, array in arrays.items()}
    tissue_scene.co_contract(0.8)
    tissue_scene.step(10)
    for name, array in arrays.items():
        assert getattr(muscle, name) is array
        assert address(array) == before[name][0]
        assert array.dtype == np.float64 and array.shape[1] == 3
        assert not array.flags.owndata
        assert np.isfinite(array).all()
        assert not np.array_equal(array, before[name][1]), f"{name} did not follow"
    assert muscle.tets.max() < len(muscle.nodes)
    assert muscle.skin_triangles.max() < len(muscle.skin)
    moved = (arrays["nodes"] - before["nodes"][1])
    assert 1e-6 < np.abs(moved).max() < 0.02


def test_velocity_is_the_change_of_position(tissue_scene):
    muscle = tissue_scene.muscles[BICEPS]
    tissue_scene.co_contract(0.2)
    tissue_scene.step(3)
    before, velocity_before = muscle.nodes.copy(), muscle.velocities.copy()
    tissue_scene.step()
    mean = (muscle.nodes - before) / tissue_scene.dt
    scale = np.abs(mean).max()
    assert scale > 1e-4
    # Second order in time: the mean over the step lies near the mean of both ends.
    assert np.abs(mean - 0.5 * (velocity_before + muscle.velocities)).max() < 0.3 * scale


def test_tets_of_the_scene_keep_their_volume(tissue_scene):
    muscle = tissue_scene.muscles[BICEPS]

    def volume(nodes):
        a, b, c, d = (nodes[muscle.tets[:, k]] for k in range(4))
        return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6

    assert volume(muscle.rest.nodes) > 0
    assert volume(muscle.nodes) == pytest.approx(volume(muscle.rest.nodes), rel=0.05)


def test_arrays_cannot_be_written(scene):
    muscle = scene.muscles[BICEPS]
    for array in (muscle.nodes, muscle.velocities, muscle.skin, muscle.tets, muscle.rest.fibres, muscle.line):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
        with pytest.raises(ValueError):
            array.setflags(write=True)


def test_arrays_outlive_their_scene():
    scene = myotact.Scene("elbow", set=LINES)
    muscle = scene.muscles[BICEPS]
    kept = [muscle.nodes, muscle.skin, muscle.tets, muscle.rest.nodes, scene.specimen.bones["humerus"].vertices]
    values = [array.copy() for array in kept]
    del scene, muscle
    gc.collect()
    filler = [bytes(1 << 20) for _ in range(50)]  # what was freed is used again
    for array, value in zip(kept, values):
        assert np.array_equal(array, value)
    del filler


def test_joint_yields_to_a_push_as_its_stiffness_says(scene):
    joint = scene.joints["elbow"]
    scene.hold_posture(False)
    scene.co_contract(0.5)
    scene.run(3.0)
    start, stiffness = joint.q, joint.stiffness
    scene.joints["elbow"].push(0.01, 4.0)
    scene.run(3.5)
    assert joint.q - start == pytest.approx(0.01 / stiffness, rel=0.05)


def test_torque_is_force_times_moment_arm(free_scene):
    muscle = free_scene.muscles["brachialis"]
    muscle.activate(0.6)
    free_scene.joints["elbow"].lock()
    free_scene.run(1.5)
    assert muscle.activation == pytest.approx(0.6, abs=1e-3)
    total = sum(m.force * m.moment_arm("elbow") for m in free_scene.muscles.values())
    assert total == pytest.approx(free_scene.joints["elbow"].torque, rel=1e-6)


def test_tool_presses_and_lets_go(tissue_scene):
    tissue_scene.co_contract(0.0)
    tool = tissue_scene.tools[0]
    tool.touch(BICEPS, direction=(1, 0, 0), depth=3e-3, seconds=0.6)
    tissue_scene.run(0.9)
    assert np.linalg.norm(tool.force) > 0.1
    contact = tool.contacts[0]
    assert contact.part == BICEPS
    skin = tissue_scene.muscles[BICEPS].skin
    assert np.linalg.norm(skin - contact.point, axis=1).min() < 0.02
    assert np.dot(tool.force, contact.normal) > 0.5 * np.linalg.norm(tool.force)
    shallow = np.linalg.norm(tool.force)
    tool.touch(BICEPS, direction=(1, 0, 0), depth=6e-3, seconds=0.6)
    tissue_scene.run(0.9)
    assert np.linalg.norm(tool.force) > 1.2 * shallow
    tool.release(0.3)
    tissue_scene.run(0.6)
    assert np.linalg.norm(tool.force) == 0
    assert tool.contacts == []


def test_reset_goes_back(scene):
    start = scene.joints["elbow"].q
    scene.set_levels(0.5, 0.0)
    scene.run(0.5)
    assert scene.joints["elbow"].q > start + 0.05
    scene.set_levels(0.0, 0.0)
    scene.reset()
    assert scene.joints["elbow"].q == pytest.approx(start, abs=0.02)
    scene.tools[0].move_to([0.3, 0.1, 0.36], 0.4)
    scene.run(0.6)
    assert scene.tools[0].position == pytest.approx([0.3, 0.1, 0.36], abs=1e-3)


def test_a_scene_as_a_dict():
    described = myotact.Scene("elbow", set=LINES).description
    described["tools"][0]["radius_m"] = 0.005
    changed = myotact.Scene(described)
    assert changed.tools[0].radius == 0.005
    described["tols"] = []
    with pytest.raises(myotact.DataError, match="tools"):
        myotact.Scene(described)


def test_another_thread_runs_during_a_step(tissue_scene):
    """In the time of a step the other one does most of what it does alone."""
    count = 0
    running = True

    def work():
        nonlocal count
        while running:
            count += 1

    other = threading.Thread(target=work)
    other.start()
    counts = []
    for _ in range(20):
        before = count
        tissue_scene._live.step(1)
        counts.append(count - before)
    running = False
    other.join()
    # The median: on a busy machine the scheduler leaves the other thread out of
    # single steps; a lock that is kept leaves it out of all of them.
    assert statistics.median(counts) > 100, "a step kept the lock"


def test_two_threads_step_one_scene():
    scene = myotact.Scene("elbow", set=LINES)
    failures = []

    def work():
        try:
            for _ in range(50):
                scene.step(2)
                assert np.isfinite(scene.muscles[BICEPS].nodes).all()
                scene.joints["elbow"].readout()
        except BaseException as failure:
            failures.append(failure)

    threads = [threading.Thread(target=work) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    assert scene.time == pytest.approx(3 * 50 * 2 * scene.dt)


def run_python(code, timeout=120):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=timeout)


OPEN = "import os, signal, threading, time, sys, myotact; s = myotact.Scene('elbow', set={'tissue.default': 'line'})\n"


def test_a_forked_child_is_refused():
    done = run_python(
        OPEN
        + "child = os.fork()\n"
        + "if child == 0:\n"
        + "    try: s.step()\n"
        + "    except myotact.MisuseError as e: print('refused:', e)\n"
        + "    del s\n"
        + "    fresh = myotact.Scene('elbow', set={'tissue.default': 'line'}); fresh.step(); sys.exit(7)\n"
        + "print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])); s.step(); print('parent steps on')\n"
    )
    assert done.returncode == 0, done.stderr
    assert "refused: this scene was made before the process forked" in done.stdout
    assert "7\nparent steps on" in done.stdout


def test_ctrl_c_ends_a_long_step():
    done = run_python(
        OPEN
        + "threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
        + "try: s.step(10**8)\n"
        + "except KeyboardInterrupt: print('stopped')\n"
        + "s.step(); print('usable', s.time > 0)\n"
    )
    assert done.stdout == "stopped\nusable True\n", done.stderr


def test_a_step_within_a_step_is_refused():
    done = run_python(
        OPEN
        + "def again(*_): s.step()\n"
        + "signal.signal(signal.SIGALRM, again); signal.setitimer(signal.ITIMER_REAL, 0.3)\n"
        + "try: s.step(10**8)\n"
        + "except myotact.MisuseError as e: print(e)\n"
        + "s.step(); print('usable')\n"
    )
    assert "this very thread" in done.stdout and done.stdout.endswith("usable\n"), done.stderr


def test_python_ends_under_a_stepping_thread():
    done = run_python(OPEN + "threading.Thread(target=lambda: s.step(10**8), daemon=True).start(); time.sleep(0.3)\n")
    assert done.returncode in (0, 1), (done.returncode, done.stderr)
    assert done.returncode >= 0


def test_a_scene_goes_with_its_last_name():
    """No part of it keeps the others: a large scene's memory is free at once."""
    scene = myotact.Scene("elbow", set=LINES)
    seen = weakref.ref(scene)
    gc.disable()
    try:
        del scene
        assert seen() is None
    finally:
        gc.enable()


@pytest.mark.parametrize("name", ["plane", "plate", "particle", "spring", "bimanual"])
def test_every_kind_of_scene_steps(name):
    scene = myotact.Scene(name, set=LINES if name == "bimanual" else {})
    assert len(scene.tools) == (2 if name == "bimanual" else 1)
    for tool in scene.tools:
        tool.move_to(tool.position + [0.01, 0, 0], 0.05)
    scene.step(10)
    assert scene.time == pytest.approx(10 * scene.dt)
    for tool in scene.tools:
        assert np.isfinite(tool.force).all()
