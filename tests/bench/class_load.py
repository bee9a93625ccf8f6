#!/usr/bin/env python3
"""A class on one machine: students that look on at a served scene, half of them touching it.

  class_load.py MYOTACT SCENE [--students N] [--hands N] [--seconds S]

Each student takes pictures and says which it has seen, pings ten times a second and sends the state of its hand sixty
times a second. Prints as JSON: pictures and bits a second of a student, the simulation's rate, the server's memory at
the beginning and the end. Only addresses of this machine are used.
"""
import argparse
import json
import pathlib
import selectors
import struct
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "clients" / "python"))

import myotact_client as mc  # noqa: E402

PICTURE, PICTURE_SEEN = 23, 24
WANT_PICTURES, WANT_CLASS = 32, 64


class Student:
    def __init__(self, host, port, number, has_hand):
        wants = WANT_PICTURES | WANT_CLASS | (mc.WANT_HAND if has_hand else 0)
        self.client = mc.Client(host, port, mc.STUDENT, wants, name=f"student {number}")
        self.number, self.has_hand = number, has_hand
        self.pictures = self.bytes = self.states = 0
        self.late_ms = []
        self.buffer = b""
        self.next_state = self.next_ping = time.monotonic() + 0.001 * number

    @property
    def socket(self):
        return self.client._socket

    def take(self):
        self.buffer += self.socket.recv(1 << 16)
        while len(self.buffer) >= mc.HEADER_BYTES:
            kind, length = self.buffer[2], struct.unpack_from("<I", self.buffer, 4)[0]
            size = mc.HEADER_BYTES + length
            if len(self.buffer) < size:
                return
            frame, self.buffer = self.buffer[:size], self.buffer[size:]
            self.bytes += size
            if kind == PICTURE:
                self.pictures += 1
                self.client.send(PICTURE_SEEN, frame[24:32])

    def act(self, now):
        if now >= self.next_ping:
            self.next_ping = now + 0.1
            self.client.ping()
        if self.has_hand and now >= self.next_state:
            self.next_state = now + 1 / 60
            self.states += 1
            state = mc.ToolState((0.3, 0.3, 0.3), sequence=self.states)
            if self.number % 2 == 0:  # presses on a muscle with half a newton
                place = (0.0, 0.0, 0.0)
                state.contact = mc.Contact(self.number % 3, 10 * self.number, (0.3, 0.3, 0.4), (0, 1, 0), place, 1.0,
                                           place)
            self.client.send_state(state)


def memory_kB(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(next(line.split()[1] for line in status.splitlines() if line.startswith("VmRSS")))


def serve(program, scene, hands):
    process = subprocess.Popen([program, "serve", scene, "--port", "0", "--no-websocket", "--log-level", "off",
                                "--hands", str(hands), "--json"], stdout=subprocess.PIPE, text=True)
    host, port = process.stdout.readline().split()[1].rsplit(":", 1)
    return process, host, int(port)


def attend(students, seconds):
    selector = selectors.DefaultSelector()
    for student in students:
        selector.register(student.socket, selectors.EVENT_READ, student)
    end = time.monotonic() + seconds
    while (now := time.monotonic()) < end:
        for key, _ in selector.select(0.002):
            key.data.take()
        for student in students:
            student.act(now)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("scene")
    arguments.add_argument("--students", type=int, default=30)
    arguments.add_argument("--hands", type=int, default=30)
    arguments.add_argument("--seconds", type=float, default=20)
    given = arguments.parse_args()
    process, host, port = serve(given.program, given.scene, given.hands)
    try:
        students = [Student(host, port, i, i < given.hands) for i in range(given.students)]
        attend(students, 3)
        before = memory_kB(process)
        for student in students:
            student.pictures = student.bytes = 0
        attend(students, given.seconds)
        after = memory_kB(process)
    finally:
        process.terminate()
    report = json.loads(process.stdout.read())
    rates = [student.pictures / given.seconds for student in students]
    bits = [8e-6 * student.bytes / given.seconds for student in students]
    print(json.dumps({"scene": given.scene, "students": given.students, "hands": given.hands,
                      "pictures_a_second": {"least": min(rates), "mean": sum(rates) / len(rates)},
                      "Mbit_s_a_student": sum(bits) / len(bits),
                      "simulated_over_wall": report["simulated_s"] / report["wall_s"],
                      "memory_kB": [before, after]}, indent=2))


if __name__ == "__main__":
    main()
