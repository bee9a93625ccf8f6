#!/usr/bin/env python3
"""The same path in lockstep by clients in C++, Python and C#: each is sent the same bytes.

same_bytes_test.py MYOTACT SOURCE DRIVE [CLIENT_TEST_EXE]: without the last one C# is left out.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE, DRIVE = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
CSHARP = sys.argv[4] if len(sys.argv) > 4 else None
sys.path.insert(0, str(SOURCE / "tools" / "clients" / "python"))

import myotact_client as mc  # noqa: E402
from server import Server  # noqa: E402


def drive_python(server, states, line):
    wants = mc.WANT_HAND | mc.WANT_FRAMES | mc.WANT_READINGS
    with mc.Client(server.host, server.port, wants=wants) as client:
        client.keep()
        for i in range(states):
            hand = (0.001 * (i % 30), -0.0005 * (i % 20), 0.00025 * (i % 40))
            state = mc.ToolState(hand, hand, sequence=i)
            if line >= 0 and i >= 10:
                state.grip = mc.Grip(line, -1, 0.5, 100.0)
            client.tell(state, time_ns=1_000_000 * i)
            client.read_until(mc.LOCAL_MODEL)
        return b"".join(client.received)


def drive_program(command, server, states, line):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "frames.bin"
        subprocess.run([*command, str(server.port), str(states), str(file), str(line)], check=True, timeout=100)
        return file.read_bytes()


class SameBytes(unittest.TestCase):
    def compare(self, scene, states, line, least):
        with Server(PROGRAM, scene, "--lockstep") as server:
            wanted = drive_program([DRIVE], server, states, line)
            self.assertGreater(len(wanted), least)
            self.assertEqual(drive_python(server, states, line), wanted)
            if CSHARP:
                self.assertEqual(drive_program(["mono", CSHARP, "drive"], server, states, line), wanted)

    def test_spring(self):
        self.compare("spring", 500, -1, 500 * 500)

    def test_elbow(self):
        self.compare("elbow", 40, 0, 40 * 5000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
