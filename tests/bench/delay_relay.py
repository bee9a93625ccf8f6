#!/usr/bin/env python3
"""20 s of real time over a slow link: a hand (`myotact feel`) feels a scene of `myotact serve` through a relay that
holds every byte for half of the round trip, each way. The forces beside those of the same hand without a relay.

delay_relay.py MYOTACT [SCENE...]: prints met or missed; results/ says on which machine, when and what. A scene whose
script also moves the limb is not the same twice: the server's script begins before the hand's.
"""
import asyncio
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

SECONDS = 20
GOALS = {0.005: 0.05, 0.020: 0.15}  # round trip [s] -> error of the force


async def pipe(reader, writer, delay_s):
    loop = asyncio.get_running_loop()

    def pass_on(data):
        if not writer.is_closing():
            writer.write(data)

    try:
        while data := await reader.read(1 << 16):
            loop.call_later(delay_s, pass_on, data)
    except (OSError, asyncio.CancelledError):
        pass  # the hand has left, and what was still on its way is nobody's
    loop.call_later(delay_s, writer.close)


async def feel_through(program, server, round_trip_s, out):
    async def join(reader, writer):
        there, back = await asyncio.open_connection(*server)
        try:
            await asyncio.gather(pipe(reader, back, round_trip_s / 2), pipe(there, writer, round_trip_s / 2))
        except asyncio.CancelledError:
            pass  # the hand has left

    relay = await asyncio.start_server(join, "127.0.0.1", 0)
    host, port = relay.sockets[0].getsockname()
    feel = await asyncio.create_subprocess_exec(
        program, "feel", "--connect", f"{host}:{port}", "--seconds", str(SECONDS), "--every", "1", "--out", out,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    await feel.wait()
    relay.close()


def feel(program, server, round_trip_s):
    with tempfile.TemporaryDirectory() as folder:
        if round_trip_s:
            asyncio.run(feel_through(program, server, round_trip_s, folder))
        else:
            subprocess.run([program, "feel", "--connect", "%s:%d" % server, "--seconds", str(SECONDS), "--every", "1",
                            "--out", folder], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = json.loads((pathlib.Path(folder) / "summary.json").read_text())
        with open(pathlib.Path(folder) / "samples.csv", newline="") as file:
            rows = list(csv.DictReader(file))
    columns = [name for name in rows[0] if name.startswith("force_") and name.endswith("_N") and name[6] in "xyz"]
    assert len(columns) == 3, list(rows[0])
    return [[float(row[name]) for name in columns] for row in rows], report["link"]


def size(forces):
    return math.sqrt(sum(x * x for force in forces for x in force) / len(forces))


def error(forces, reference):
    """Least over small shifts of the one start against the other."""
    best = math.inf
    for shift in range(-40, 41, 2):
        a, b = forces[max(0, shift):], reference[max(0, -shift):]
        difference = [[p - q for p, q in zip(x, y)] for x, y in zip(a, b)]
        best = min(best, size(difference) / size(reference))
    return best


def measure(program, scene):
    serve = subprocess.Popen([program, "serve", scene, "--port", "0", "--no-websocket"], stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL, text=True)
    try:
        line = next(line for line in serve.stdout if line.startswith("tcp "))
        host, port = line.split()[1].rsplit(":", 1)
        server = (host, int(port))
        reference, _ = feel(program, server, 0)
        again, _ = feel(program, server, 0)
        print(f"{scene}: {size(reference):.3f} N; the same once more differs by {100 * error(again, reference):.1f} %")
        for round_trip_s, goal in GOALS.items():
            forces, link = feel(program, server, round_trip_s)
            found = error(forces, reference)
            verdict = "met" if found <= goal else "missed"
            print(f"  {1e3 * round_trip_s:.0f} ms: told {link['round_trip_ms']:.1f} ms, error {100 * found:.1f} % (goal "
                  f"{100 * goal:.0f}: {verdict}), {100 * size(forces) / size(reference):.1f} % of the force, "
                  f"{link['missed_ticks']} of {link['ticks']} ticks missed, {link['connections']} connection", flush=True)
    finally:
        serve.terminate()
        serve.wait()


if __name__ == "__main__":
    for name in sys.argv[2:] or ["spring", "particle"]:
        measure(sys.argv[1], name)
