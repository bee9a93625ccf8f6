#!/usr/bin/env python3
"""The C# client against the golden vectors and against a server: csharp_client_test.py MYOTACT SOURCE CLIENT_TEST_EXE"""
import pathlib
import subprocess
import sys
import unittest

from server import Server

PROGRAM, SOURCE, CLIENT_TEST = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
TOKEN = "000102030405060708090a0b0c0d0e0f"


class CSharp(unittest.TestCase):
    def test_frames_are_those_of_the_vectors_and_axes_are_the_engines(self):
        subprocess.run(["mono", CLIENT_TEST, "vectors", SOURCE / "tests" / "net" / "vectors"], check=True, timeout=60)

    def test_the_behaviour_feels_the_spring_until_the_server_is_killed(self):
        with Server(PROGRAM, "spring", "--no-websocket", token=TOKEN) as server:
            hand = subprocess.Popen(["mono", CLIENT_TEST, "hand", str(server.port), TOKEN], stdout=subprocess.PIPE, text=True)
            self.assertEqual(hand.stdout.readline(), "felt\n")
            server.process.kill()
            hand.communicate(timeout=60)
            self.assertEqual(hand.returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
