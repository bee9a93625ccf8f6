"""Reads the recordings of `myotact --record`: "MYOREC01", then chunks {u32 length, u32 type, payload, u32 CRC-32 of type
and payload}, little-endian. What a crash cut off is left out. SI units, world frame.
"""
import json
import struct
import sys
import zlib
from dataclasses import dataclass, field

MAGIC = b"MYOREC01"
HEADER, END, STEP, TICKS, MODEL = 1, 4, 7, 8, 9
TOOL_BYTES, TICK = 296, struct.Struct("<6dQI4xQQB")


@dataclass
class Tool:
    sequence: int
    position_world_m: tuple
    proxy_world_m: tuple
    force_world_N: tuple
    surface: int  # that is touched, -1: none


@dataclass
class Step:
    excitations: tuple
    joint_torques_Nm: tuple
    gravity_m_s2: tuple
    tools: list
    state_hash: int


@dataclass
class Tick:
    position_world_m: tuple
    velocity_world_m_s: tuple
    buttons: int
    model_sequence: int
    time_ns: int
    forces_stopped: bool


@dataclass
class Recording:
    header: dict
    steps: list = field(default_factory=list)
    ticks: dict = field(default_factory=dict)  # by tool
    is_complete: bool = False


def chunks(data: bytes):
    """(type, payload) of every whole, undamaged chunk up to the first that is not."""
    at = len(MAGIC)
    while at + 12 <= len(data):
        length, kind = struct.unpack_from("<II", data, at)
        end = at + 8 + length
        if end + 4 > len(data) or zlib.crc32(data[at + 4:end]) != struct.unpack_from("<I", data, end)[0]:
            return
        yield kind, data[at + 8:end]
        at = end + 4


def read_tool(data: bytes) -> Tool:
    sequence, = struct.unpack_from("<Q", data)
    numbers = struct.unpack_from("<9d", data, 24)
    surface, = struct.unpack_from("<i", data, 96)
    return Tool(sequence, numbers[:3], numbers[3:6], numbers[6:], surface)


def read_step(data: bytes) -> Step:
    def numbers(at):
        count, = struct.unpack_from("<I", data, at)
        return struct.unpack_from(f"<{count}d", data, at + 4), at + 4 + 8 * count

    excitations, at = numbers(0)
    torques, at = numbers(at)
    gravity = struct.unpack_from("<3d", data, at)
    count, = struct.unpack_from("<I", data, at + 24)
    at += 28
    tools = [read_tool(data[at + i * TOOL_BYTES:at + (i + 1) * TOOL_BYTES]) for i in range(count)]
    state_hash, = struct.unpack_from("<Q", data, at + count * TOOL_BYTES)
    return Step(excitations, torques, gravity, tools, state_hash)


def take_chunk(kind: int, payload: bytes, recording: Recording):
    if kind == STEP:
        recording.steps.append(read_step(payload))
    elif kind == TICKS:
        tool, = struct.unpack_from("<I", payload)
        ticks = recording.ticks.setdefault(tool, [])
        for n in TICK.iter_unpack(payload[4:]):
            ticks.append(Tick(n[:3], n[3:6], n[7], n[8], n[9], n[10] != 0))
    elif kind == END:
        recording.is_complete = True


def read_recording(path) -> Recording:
    """Raises ValueError for a file that is no recording of this version."""
    with open(path, "rb") as file:
        data = file.read()
    found = chunks(data)
    if not data.startswith(MAGIC) or next(iter(found), None) is None:
        raise ValueError(f"{path}: no recording of the version {MAGIC.decode()}")
    found = chunks(data)
    recording = Recording(json.loads(next(found)[1]))
    for kind, payload in found:
        try:
            take_chunk(kind, payload, recording)
        except struct.error:
            raise ValueError(f"{path}: a chunk of the type {kind} is shorter than it says") from None
    return recording


def main():
    if len(sys.argv) != 2:
        print("usage: myotact_recording.py FILE", file=sys.stderr)
        sys.exit(2)
    try:
        shown = read_recording(sys.argv[1])
    except (OSError, ValueError) as why:
        sys.exit(str(why))
    print(f"{len(shown.steps)} steps, {sum(len(t) for t in shown.ticks.values())} ticks, "
          f"{'complete' if shown.is_complete else 'cut off'}")


if __name__ == "__main__":
    main()
