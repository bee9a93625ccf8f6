#!/usr/bin/env python3
"""The C# client against the golden vectors and against a server: csharp_client_test.py MYOTACT SOURCE CLIENT_TEST_EXE"""
import pathlib
import subprocess
import sys
import unittest

from server import Server

PROGRAM, SOURCE, CLIENT_TEST = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]


class CSharp(unittest.TestCase):
    def run_client(self, *arguments):
        subprocess.run(["mono", CLIENT_TEST, *arguments], check=True, timeout=60)

    def test_frames_are_those_of_the_vectors_and_axes_are_the_engines(self):
        self.run_client("vectors", str(SOURCE / "tests" / "net" / "vectors"))

    def test_the_behaviour_feels_the_spring(self):
        with Server(PROGRAM, "spring", "--no-websocket") as server:
            self.run_client("hand", str(server.port))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
