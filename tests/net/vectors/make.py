#!/usr/bin/env python3
"""Writes the golden vectors of the wire format: NAME.bin, one frame each, and manifest.json with what is in them.

Packs the bytes by the tables of src/net/README.md, independently of the program, whose test compares both ways.
"""
import json
import pathlib
import struct
import zlib

HERE = pathlib.Path(__file__).parent
MANIFEST = []
TYPES = {"Hello": 1, "Welcome": 2, "ToolState": 3, "ToolContact": 4, "ToolGrip": 5, "Force": 6, "Event": 7, "Ping": 8,
         "Pong": 9, "Bye": 10, "LocalModel": 16, "SceneKey": 17, "SceneDelta": 18, "BonePoses": 19, "Readings": 20,
         "Mesh": 21, "InForce": 22, "Picture": 23, "PictureSeen": 24, "Control": 32}


def write(name, kind, payload, fields, flags=0, sequence=0, time_ns=0):
    head = struct.pack("<BBBBIIQ", 0x4D, 1, TYPES[kind], flags, len(payload), sequence, time_ns)
    frame = head + struct.pack("<I", zlib.crc32(head + payload)) + payload
    (HERE / f"{name}.bin").write_bytes(frame)
    MANIFEST.append({"file": f"{name}.bin", "type": kind, "flags": flags, "sequence": sequence, "time_ns": time_ns,
                     "fields": fields, "hex": frame.hex()})


def doubles(*numbers):
    return struct.pack(f"<{len(numbers)}d", *numbers)


def varint(value):
    zigzag = value << 1 if value >= 0 else (-value << 1) - 1
    out = b""
    while zigzag >= 0x80:
        out += bytes([zigzag & 0x7F | 0x80])
        zigzag >>= 7
    return out + bytes([zigzag])


write("hello", "Hello", struct.pack("<HBBBQ", 1, 1, 3, 2, 0x1122334455667788) + bytes(range(16)) + "Zoë".encode(),
      {"version": 1, "role": "student", "wants": ["hand", "frames"], "hand": "right",
       "resume_id": 0x1122334455667788, "token": bytes(range(16)).hex(), "name": "Zoë"})
write("welcome", "Welcome", struct.pack("<IQbBBQQ", 7, 99, 0, 1, 1, 10_000_000, 123_456_789),
      {"client": 7, "resume_id": 99, "hand": 0, "role": "student", "lockstep": True, "step_ns": 10_000_000,
       "server_time_ns": 123_456_789}, sequence=0)
write("control", "Control", '{"do": "co_contract", "common": 0.2, "difference": 0}'.encode(),
      {"text": '{"do": "co_contract", "common": 0.2, "difference": 0}'}, sequence=1)
write("tool_contact", "ToolContact",
      struct.pack("<ii", 3, 77) + doubles(0.25, 0.5, 0, 0.6, 0.8, 0.1, 0.2, 0.3, 812.5, 0.11, 0.21, 0.31),
      {"surface": 3, "triangle": 77, "barycentric": [0.25, 0.5], "normal_world": [0, 0.6, 0.8],
       "target_world_m": [0.1, 0.2, 0.3], "stiffness_N_m": 812.5, "touched_world_m": [0.11, 0.21, 0.31]}, sequence=2)
write("tool_grip", "ToolGrip", struct.pack("<ii", 2, 1) + doubles(0.3, 250, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 333.25),
      {"grabbed_line": 2, "grabbed_body": 1, "grab_fraction": 0.3, "line_stiffness_N_m": 250,
       "body_point_rest_m": [0.01, 0.02, 0.03], "body_target_world_m": [0.04, 0.05, 0.06],
       "body_stiffness_N_m": 333.25}, sequence=3)
write("tool_state", "ToolState",
      doubles(0.1, -0.2, 0.3, 0.11, -0.21, 0.31, 1.5, -2.5, 0.5) + struct.pack("<QQII", 12345678901, 4321, 5, 9) +
      doubles(0.25),
      {"tool_position_world_m": [0.1, -0.2, 0.3], "proxy_position_world_m": [0.11, -0.21, 0.31],
       "force_world_N": [1.5, -2.5, 0.5], "sequence": 12345678901, "model_sequence": 4321, "buttons": 5, "faults": 9,
       "third_barycentric": 0.25}, flags=3, sequence=4, time_ns=987_654_321)
write("force", "Force", struct.pack("<QQ", 12345678901, 42) + doubles(0.1, -0.2, 0.3),
      {"tool_sequence": 12345678901, "step": 42, "force_world_N": [0.1, -0.2, 0.3]}, sequence=1)
write("event", "Event", struct.pack("<Bi", 1, -5) + "stop".encode(), {"code": "stop", "value": -5, "text": "stop"})
write("ping", "Ping", struct.pack("<Q", 111), {"sent_ns": 111})
write("pong", "Pong", struct.pack("<QQQ", 111, 222, 333), {"ping_ns": 111, "arrived_ns": 222, "left_ns": 333})
write("bye", "Bye", struct.pack("<B", 3) + "wrong token".encode(), {"reason": "token", "text": "wrong token"})

model = struct.pack("<QQQQ", 17, 1_000_000_007, 10_000_000, 99) + doubles(0.1, 0.2, 0.3, 0.03)  # coverage
model += struct.pack("<i", 0) + doubles(0.5, 0, -0.5) + doubles(*[1e-3 * i for i in range(9)])  # contact
model += struct.pack("<i", 1) + doubles(0.25, 1, 2, 3, 4, 5, 6, 7, 8, 9, 41.5, 0.2, 1000, 2)  # line
model += struct.pack("<i", -1) + doubles(*([0] * 42))  # grip: none
model += doubles(0.5, -0.1, 0.002, 0.01, 1.25, -0.3)  # joint
model += doubles(30, 0.01, 0.02, 0.03, 0.1, 0.2, 0.3)  # tether
model += doubles(0, 0, 0) + struct.pack("<i", 0)  # reported contacts: none
model += struct.pack("<ii", 3, 1)
model += doubles(*[0.01 * i for i in range(9)]) + doubles(*[0.01 * i + 0.001 for i in range(9)])
model += struct.pack("<iiBBBBff", 0, 5, 0, 1, 2, 1, 0.5, -0.25)
write("local_model", "LocalModel", model,
      {"sequence": 17, "published_at_ns": 1_000_000_007, "vertices": 3, "triangles": 1, "contact_surface": 0,
       "line_tension_N": 41.5, "joint_stiffness_Nm_rad": 1.25, "tether_stiffness_N_m": 30}, sequence=2)

places = [(10_000, 20_000, 30_000), (-5, 0, 1)]
write("scene_key", "SceneKey", struct.pack("<IHHI", 1, 0, 1, 2) + struct.pack("<6i", *places[0], *places[1]),
      {"key": 1, "skin": 0, "skins": 1, "grid": places}, sequence=3)
moved = [0, -1, 64, 100, -8192, 3]
write("scene_delta", "SceneDelta", struct.pack("<IHHI", 1, 0, 1, 2) + b"".join(varint(m) for m in moved),
      {"key": 1, "skin": 0, "skins": 1, "moved": moved}, sequence=4)
pose = [1, 0, 0, 0.1, 0, 1, 0, 0.2, 0, 0, 1, 0.3]
write("bone_poses", "BonePoses", struct.pack("<QdH", 5, 1.25, 1) + doubles(*pose),
      {"sequence": 5, "time_s": 1.25, "poses": [pose]}, flags=1, sequence=5)

in_force = struct.pack("<BBB", 2, 3, 1 + 4) + doubles(0.5, 0.25, 0.75, -0.125, 0.625)
write("in_force", "InForce", in_force,
      {"drive": "balance", "driver": "network", "hold_posture": True, "gravity": False, "paused": True,
       "recording": False, "flexors": 0.5, "extensors": 0.25, "common": 0.75, "difference": -0.125,
       "common_now": 0.625}, sequence=6)



def picture(sequence, since, time_s, skins, parts):
    """Stored, not compressed: the bytes are the same with every zlib. `skins`: {index: [numbers by x, y, z]}."""
    inner = struct.pack("<dH", time_s, 1) + struct.pack("<12f", *pose) + struct.pack("<H", len(skins))
    for index, numbers in skins.items():
        inner += struct.pack("<HI", index, len(numbers) // 3) + b"".join(varint(n) for n in numbers)
    return struct.pack("<QQ", sequence, since) + zlib.compress(inner + parts, 0)


write("picture", "Picture",
      picture(5, 0, 1.25, {0: [2000, -1, 4000, 0, 6000, 1]}, struct.pack("<BI", 2, len(in_force)) + in_force),
      {"sequence": 5, "since": 0, "time_s": 1.25, "poses": [pose],
       "skins_m": [[[0.1, 0.2, 0.3], [-0.00005, 0, 0.00005]]], "common_now": 0.625}, sequence=7)
write("picture_change", "Picture", picture(8, 5, 1.5, {0: [0, 1, -64, 64, 0, 0]}, b"\0"),
      {"sequence": 8, "since": 5, "time_s": 1.5, "poses": [pose],
       "skins_m": [[[0.1, 0.1968, 0.3], [0, 0.0032, 0.00005]]]}, sequence=8)
write("picture_seen", "PictureSeen", struct.pack("<Q", 8), {"sequence": 8}, sequence=9)

(HERE / "manifest.json").write_text(json.dumps(MANIFEST, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
