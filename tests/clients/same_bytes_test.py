#!/usr/bin/env python3
"""The same path in lockstep by clients in C++, Python and C#: each is sent the same bytes.

same_bytes_test.py MYOTACT SOURCE SCENE DRIVE [CLIENT_TEST_EXE]: without the last one C# is left out.
"""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

PROGRAM, SOURCE, SCENE, DRIVE = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], sys.argv[4]
CSHARP = sys.argv[5] if len(sys.argv) > 5 else None
# States of the path, and the muscle whose line is in hand from the tenth on, -1: none. In `elbow` the path alone touches
# nothing, and no force would be compared.
STATES, LINE = {"spring": (500, -1), "elbow": (20, 0)}[SCENE]
sys.path.insert(0, str(SOURCE / "tools" / "clients" / "python"))

import myotact_client as mc  # noqa: E402
from server import Server  # noqa: E402


def lockstep():
    """A server for one drive: scenes take seconds to settle, and do it side by side."""
    return Server(PROGRAM, SCENE, "--lockstep")


def drive_python():
    wants = mc.WANT_HAND | mc.WANT_FRAMES | mc.WANT_READINGS
    with lockstep() as server, mc.Client(server.host, server.port, wants=wants) as client:
        client.keep()
        for i in range(STATES):
            hand = (0.001 * (i % 30), -0.0005 * (i % 20), 0.00025 * (i % 40))
            state = mc.ToolState(hand, hand, sequence=i)
            if LINE >= 0 and i >= 10:
                state.grip = mc.Grip(LINE, -1, 0.5, 100.0)
            client.send_state(state, time_ns=1_000_000 * i)
            client.read_until(mc.LOCAL_MODEL)
        return client.received


def drive_program(command):
    with lockstep() as server, tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "frames.bin"
        subprocess.run([*command, str(server.port), str(STATES), str(file), str(LINE)], check=True, timeout=100)
        return frames_of(file.read_bytes())


def frames_of(data):
    frames = []
    while data:
        end = mc.HEADER_BYTES + int.from_bytes(data[4:8], "little")
        frames.append(data[:end])
        data = data[end:]
    return frames


class SameBytes(unittest.TestCase):
    def expect_same(self, frames, wanted):
        for i, (got, reference) in enumerate(zip(frames, wanted)):
            self.assertEqual(got, reference, f"frame {i}, of type {reference[2]}")
        self.assertEqual(len(frames), len(wanted))

    def test_each_language_is_sent_what_cpp_is(self):
        commands = [[DRIVE]] + ([["mono", CSHARP, "drive"]] if CSHARP else [])
        with ThreadPoolExecutor() as pool:
            python = pool.submit(drive_python)
            wanted, *others = pool.map(drive_program, commands)
        for frames in (python.result(), *others):
            self.expect_same(frames, wanted)
        types = [frame[2] for frame in wanted]
        for once_a_state in (mc.FORCE, mc.BONE_POSES, mc.READINGS, mc.LOCAL_MODEL):
            self.assertEqual(types.count(once_a_state), STATES)
        forces = [mc.decode_force(mc.parse_frame(frame).payload) for frame in wanted if frame[2] == mc.FORCE]
        self.assertEqual([force.tool_sequence for force in forces], list(range(STATES)))
        self.assertGreater(math.hypot(*forces[-1].force_world_N), 0.1)


if __name__ == "__main__":
    if not CSHARP:
        print("C# is left out: no mcs and mono here; Debian: mono-mcs mono-runtime")
    unittest.main(argv=sys.argv[:1], verbosity=1)
