#!/usr/bin/env python3
"""The commands of tools/clients/README.md as they stand, and what they say to bad input: drive_spring_test.py MYOTACT SOURCE

Without mcs and mono those in C# are left out.
"""
import math
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

from server import Server

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
README = SOURCE / "tools" / "clients" / "README.md"
HAS_MONO = shutil.which("mcs") is not None and shutil.which("mono") is not None
TOKEN = "000102030405060708090a0b0c0d0e0f"


def commands(word):
    """The README's commands that hold the word."""
    lines = README.read_text(encoding="utf-8").splitlines()
    return [line[2:] for line in lines if line.startswith("$ ") and word in line]


class AtTheProjectsRoot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "tools").symlink_to(SOURCE / "tools")

    def run_command(self, command, address="127.0.0.1:7480", token=""):
        environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}", "MYOTACT_TOKEN": token}
        return subprocess.run(["bash", "-c", command.replace("127.0.0.1:7480", address)], cwd=self.folder, timeout=60,
                              env=environment, capture_output=True, text=True, check=False)

    def drives(self):
        """What leads a hand round, in each language that is here."""
        if HAS_MONO:
            build = self.run_command(commands("mcs ")[0])
            self.assertEqual(build.returncode, 0, build.stderr)
        return commands("drive_spring.py ") + (commands("mono out") if HAS_MONO else [])


class Readme(AtTheProjectsRoot):
    def test_a_hand_is_led_round(self):
        with Server(PROGRAM, "spring", "--no-websocket", token=TOKEN) as server:
            for command in self.drives():
                done = self.run_command(command, f"{server.host}:{server.port}", TOKEN)
                self.assertEqual((done.returncode, done.stderr), (0, ""), command)
                head, *rows = [line.split(",") for line in done.stdout.splitlines()]
                x, y = head.index("force_x_N"), head.index("force_y_N")
                self.assertEqual(len(rows), 200)
                # The server is behind, on a busy machine by some steps, but all places are 30 mm from the origin: 30 N/m.
                for row in rows[100:]:
                    self.assertAlmostEqual(math.hypot(float(row[x]), float(row[y])), 0.9, 3)

    def test_a_recording_is_read(self):
        done = self.run_command(commands("myotact_recording.py")[0])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[-1], "100 steps, 1000 ticks, complete")


def answer_as_a_web_server(listener):
    guest, _ = listener.accept()
    with guest:
        guest.recv(200)
        guest.sendall(b"HTTP/1.1 400 Bad Request\r\n\r\n")


class BadInput(AtTheProjectsRoot):
    def expect(self, command, address, token, said):
        done = self.run_command(command, address, token)
        self.assertIn(done.returncode, (1, 2))
        self.assertIn(said, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)  # no stack trace

    def test_an_address_without_a_server(self):
        with socket.socket() as nobody:
            nobody.bind(("127.0.0.1", 0))  # but does not listen
            address = f"127.0.0.1:{nobody.getsockname()[1]}"
            for command in self.drives():
                self.expect(command, address, "", f"{address}: Connection refused; is `myotact serve` running there")
                self.expect(command, "127.0.0.1", "", "HOST:PORT")
                self.expect(command, "127.0.0.1:99999", "", "a port of 1 to 65535")

    def test_a_wrong_token(self):
        with Server(PROGRAM, "spring", "--no-websocket", token=TOKEN) as server:
            address = f"{server.host}:{server.port}"
            for command in self.drives():
                self.expect(command, address, "", f"{address}: wrong token; the server printed the right one")
                self.expect(command, address, "abc", "a token is 32 hexadecimal digits")

    def test_no_server_of_this_protocol(self):
        for command in self.drives():
            with socket.create_server(("127.0.0.1", 0)) as listener:
                threading.Thread(target=answer_as_a_web_server, args=[listener], daemon=True).start()
                address = f"127.0.0.1:{listener.getsockname()[1]}"
                self.expect(command, address, "", f"{address}: what answers there speaks another protocol")


if __name__ == "__main__":
    if not HAS_MONO:
        print("C# is left out: no mcs and mono here; Debian: mono-mcs mono-runtime")
    unittest.main(argv=sys.argv[:1], verbosity=1)
