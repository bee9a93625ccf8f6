#!/usr/bin/env python3
"""The Python client against the golden vectors and against a server: python_client_test.py MYOTACT SOURCE."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "tools" / "clients" / "python"))

import myotact_client as mc  # noqa: E402
import myotact_recording  # noqa: E402
from server import Server  # noqa: E402

VECTORS = SOURCE / "tests" / "net" / "vectors"


def vector(name):
    return (VECTORS / f"{name}.bin").read_bytes()


class Vectors(unittest.TestCase):
    def test_every_vector_reads_and_writes_back(self):
        manifest = json.loads((VECTORS / "manifest.json").read_text(encoding="utf-8"))
        self.assertGreater(len(manifest), 10)
        for entry in manifest:
            data = (VECTORS / entry["file"]).read_bytes()
            frame = mc.parse_frame(data)
            self.assertEqual(frame.sequence, entry["sequence"])
            self.assertEqual(frame.time_ns, entry["time_ns"])
            self.assertEqual(mc.frame_bytes(frame), data)

    def test_a_state_is_the_three_frames_of_the_vectors(self):
        state = mc.ToolState((0.1, -0.2, 0.3), (0.11, -0.21, 0.31), (1.5, -2.5, 0.5), 12345678901, 4321, 5, 9)
        state.contact = mc.Contact(3, 77, (0.25, 0.5, 0.25), (0, 0.6, 0.8), (0.1, 0.2, 0.3), 812.5, (0.11, 0.21, 0.31))
        state.grip = mc.Grip(2, 1, 0.3, 250, (0.01, 0.02, 0.03), (0.04, 0.05, 0.06), 333.25)
        frames = mc.tool_state_frames(state)
        for (kind, flags, payload), name in zip(frames, ["tool_contact", "tool_grip", "tool_state"]):
            wanted = mc.parse_frame(vector(name))
            self.assertEqual((kind, flags, payload), (wanted.type, wanted.flags, wanted.payload), name)

    def test_small_frames_say_what_the_manifest_says(self):
        welcome = mc.decode_welcome(mc.parse_frame(vector("welcome")).payload)
        self.assertEqual((welcome.client, welcome.hand, welcome.lockstep, welcome.step_ns), (7, 0, True, 10_000_000))
        force = mc.decode_force(mc.parse_frame(vector("force")).payload)
        self.assertEqual((force.step, force.force_world_N), (42, (0.1, -0.2, 0.3)))

    def test_a_scene_is_put_together(self):
        decoder = mc.SceneDecoder()
        whole = [decoder.take(mc.parse_frame(vector(name))) for name in ("scene_key", "scene_delta", "bone_poses")]
        self.assertEqual(whole, [False, False, True])
        for got, grid in zip(decoder.scene.skins_world_m[0][0], (10_000, 19_999, 30_064)):
            self.assertAlmostEqual(got, 1e-5 * grid, 12)
        self.assertEqual(decoder.scene.poses[0][11], 0.3)

    def test_what_is_cut_off_is_noticed(self):
        decoder = mc.SceneDecoder()
        readers = {"scene_key": decoder.take, "scene_delta": decoder.take, "bone_poses": decoder.take,
                   "welcome": lambda frame: mc.decode_welcome(frame.payload),
                   "force": lambda frame: mc.decode_force(frame.payload)}
        for name, read in readers.items():
            frame = mc.parse_frame(vector(name))
            read(frame)
            whole = frame.payload
            for length in range(len(whole)):
                frame.payload = whole[:length]
                with self.assertRaises(mc.WireError, msg=f"{length} bytes of {name}"):
                    read(frame)

    def test_a_token_is_what_the_server_prints(self):
        self.assertEqual(mc.token_of("000102030405060708090A0b0c0d0e0f"), bytes(range(16)))
        self.assertEqual(mc.token_of(""), bytes(16))
        for wrong in ("00", 15 * "00" + "0x", 16 * "00" + "0", 16 * "+1"):
            with self.assertRaises(ValueError):
                mc.token_of(wrong)

    def test_damage_is_noticed(self):
        data = bytearray(vector("force"))
        data[-1] ^= 1
        with self.assertRaises(mc.WireError):
            mc.parse_frame(bytes(data))


def drive(server, states, wants):
    """The bytes of every frame that a path gets in lockstep, after Welcome and scene."""
    with mc.Client(server.host, server.port, wants=wants) as client:
        client.keep()
        for i in range(states):
            angle = 0.05 * i
            hand = (0.03 * math.cos(angle), 0.03 * math.sin(angle), 0.0)
            client.send_state(mc.ToolState(hand, sequence=i), time_ns=1_000_000 * i)
            client.read_until(mc.LOCAL_MODEL)
        return b"".join(client.received)


class Lockstep(unittest.TestCase):
    def test_the_same_states_get_the_same_bytes(self):
        with Server(PROGRAM, "spring", "--lockstep") as server:
            wants = mc.WANT_HAND | mc.WANT_FRAMES | mc.WANT_READINGS
            first = drive(server, 50, wants)
            self.assertEqual(drive(server, 50, wants), first)
            self.assertGreater(len(first), 50 * 500)

    def test_the_spring_pulls_as_it_should(self):
        with Server(PROGRAM, "spring", "--lockstep") as server, mc.Client(server.host, server.port) as client:
            k = json.loads(json.loads(client.scene_json)["scene"]["text"])["original"]["spring"]["stiffness_N_m"]
            for i in range(20):
                hand = (0.001 * i, -0.002 * i, 0.0005 * i)
                client.send_state(mc.ToolState(hand, sequence=i))
                force = mc.decode_force(client.read_until(mc.FORCE).payload)
                self.assertEqual(force.tool_sequence, i)
                self.assertLess(math.dist(force.force_world_N, [-k * x for x in hand]), 1e-9)


class OnTheWallClock(unittest.TestCase):
    def test_the_force_is_that_of_a_moment_ago(self):
        with Server(PROGRAM, "spring", "--no-websocket") as server, mc.Client(server.host, server.port) as client:
            hand = (0.02, 0.01, 0.0)
            forces = []
            for i in range(2000):
                client.send_state(mc.ToolState(hand, sequence=i + 1))
                forces.append(mc.decode_force(client.read_until(mc.FORCE).payload).force_world_N)
                if math.dist(forces[-1], (-0.6, -0.3, 0.0)) < 1e-9:
                    break
                client.ping()
                client.read_until(mc.PONG)
            self.assertLess(math.dist(forces[-1], (-0.6, -0.3, 0.0)), 1e-9)

    def test_a_scene_is_shown(self):
        with Server(PROGRAM, "particle", "--no-websocket") as server:
            with mc.Client(server.host, server.port, mc.VIEWER, mc.WANT_FRAMES) as client:
                decoder = mc.SceneDecoder()
                while not decoder.take(client.read()):
                    pass
                self.assertEqual(len(decoder.scene.poses[0]), 12)

    def test_a_student_may_not_change_the_scene(self):
        with Server(PROGRAM, "particle", "--no-websocket") as server, mc.Client(server.host, server.port) as client:
            client.control('{"do": "reset"}')
            self.assertIn("instructor", client.read_until(mc.EVENT).payload[5:].decode())


class Recordings(unittest.TestCase):
    def test_a_recording_holds_what_was_run(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "spring.rec"
            subprocess.run([PROGRAM, "run", "spring", "--seconds", "1", "--record", file, "--out", folder],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            recording = myotact_recording.read_recording(file)
            self.assertTrue(recording.is_complete)
            self.assertEqual(len(recording.steps), json.loads((pathlib.Path(folder) / "summary.json").read_text())["steps"])
            self.assertEqual(len(recording.ticks[0]), 1000)
            rows = (pathlib.Path(folder) / "samples.csv").read_text().splitlines()
            last = [float(number) for number in rows[-1].split(",")[1:4]]
            self.assertEqual(list(recording.steps[-1].tools[0].position_world_m), last)
            cut = pathlib.Path(folder) / "cut.rec"
            cut.write_bytes(file.read_bytes()[:-20])
            self.assertFalse(myotact_recording.read_recording(cut).is_complete)
            with self.assertRaises(ValueError):
                myotact_recording.read_recording(pathlib.Path(folder) / "samples.csv")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
