"""A client of `myotact serve` without dependencies: the wire format of src/net/README.md, version 1.

It has no haptic loop: it sends where the hand is and gets the newest force of the simulation. SI units, world frame
(x cranial, y left, z up).
"""
import socket
import string
import struct
import time
import zlib
from dataclasses import dataclass, field

HELLO, WELCOME, TOOL_STATE, TOOL_CONTACT, TOOL_GRIP, FORCE, EVENT, PING, PONG, BYE = range(1, 11)
LOCAL_MODEL, SCENE_KEY, SCENE_DELTA, BONE_POSES, READINGS, MESH, CONTROL = 16, 17, 18, 19, 20, 21, 32
VIEWER, STUDENT, INSTRUCTOR = range(3)
WANT_HAND, WANT_FRAMES, WANT_READINGS, WANT_MESHES = 1, 2, 4, 8
LAST_OF_SCENE = 1
GRID_M = 1e-5
HEADER_BYTES = 24
MOST_PAYLOAD = 1 << 20
CONNECT_WAIT_S = 2.0


class WireError(Exception):
    """The other side broke a rule of the format, refused, is gone, or never was there."""


def token_of(text: str) -> bytes:
    """A token as the server prints it; no text: no token. Raises ValueError."""
    if len(text) not in (0, 32) or any(digit not in string.hexdigits for digit in text):
        raise ValueError("a token is 32 hexadecimal digits, as the server prints it")
    return bytes.fromhex(text) or bytes(16)


def unpack(layout: str, data: bytes, at: int = 0) -> tuple:
    try:
        return struct.unpack_from(layout, data, at)
    except struct.error:
        raise WireError("a frame that is shorter than it says") from None


@dataclass
class Frame:
    type: int
    flags: int
    sequence: int
    time_ns: int
    payload: bytes


def frame_bytes(frame: Frame) -> bytes:
    head = struct.pack("<BBBBIIQ", 0x4D, 1, frame.type, frame.flags, len(frame.payload), frame.sequence, frame.time_ns)
    return head + struct.pack("<I", zlib.crc32(head + frame.payload)) + frame.payload


def parse_frame(data: bytes) -> Frame:
    """The one frame that `data` is."""
    magic, version, kind, flags, length, sequence, time_ns, crc = unpack("<BBBBIIQI", data)
    payload = data[HEADER_BYTES:]
    if (magic, version) != (0x4D, 1):
        raise WireError("no frame of this format")
    if length != len(payload) or zlib.crc32(data[:20] + payload) != crc:
        raise WireError("a frame of another length or check sum than it says")
    return Frame(kind, flags, sequence, time_ns, payload)


@dataclass
class Contact:
    surface: int
    triangle: int
    barycentric: tuple
    normal_world: tuple
    target_world_m: tuple
    stiffness_N_m: float
    touched_world_m: tuple


@dataclass
class Grip:
    line: int = -1
    body: int = -1
    line_fraction: float = 0.0
    line_stiffness_N_m: float = 0.0
    body_point_rest_m: tuple = (0.0, 0.0, 0.0)
    body_target_world_m: tuple = (0.0, 0.0, 0.0)
    body_stiffness_N_m: float = 0.0


@dataclass
class ToolState:
    position_world_m: tuple
    proxy_world_m: tuple = None
    force_world_N: tuple = (0.0, 0.0, 0.0)
    sequence: int = 0
    model_sequence: int = 0
    buttons: int = 0
    faults: int = 0
    contact: Contact = None
    grip: Grip = None


def tool_state_frames(state: ToolState) -> list:
    """(type, flags, payload) of the frames of a state, in their order."""
    frames, flags, third = [], 0, 0.0
    if state.contact is not None:
        c = state.contact
        flags |= 1
        third = c.barycentric[2]
        frames.append((TOOL_CONTACT, 0, struct.pack(
            "<ii12d", c.surface, c.triangle, *c.barycentric[:2], *c.normal_world, *c.target_world_m, c.stiffness_N_m,
            *c.touched_world_m)))
    if state.grip is not None:
        g = state.grip
        flags |= 2
        frames.append((TOOL_GRIP, 0, struct.pack(
            "<ii9d", g.line, g.body, g.line_fraction, g.line_stiffness_N_m, *g.body_point_rest_m,
            *g.body_target_world_m, g.body_stiffness_N_m)))
    proxy = state.proxy_world_m or state.position_world_m
    frames.append((TOOL_STATE, flags, struct.pack(
        "<9dQQIId", *state.position_world_m, *proxy, *state.force_world_N, state.sequence, state.model_sequence,
        state.buttons, state.faults, third)))
    return frames


@dataclass
class Welcome:
    client: int
    resume_id: int
    hand: int
    role: int
    lockstep: bool
    step_ns: int
    server_time_ns: int


@dataclass
class Force:
    tool_sequence: int
    step: int
    force_world_N: tuple


def decode_welcome(payload: bytes) -> Welcome:
    client, resume_id, hand, role, lockstep, step_ns, time_ns = unpack("<IQbBBQQ", payload)
    return Welcome(client, resume_id, hand, role, lockstep == 1, step_ns, time_ns)


def decode_force(payload: bytes) -> Force:
    tool_sequence, step, x, y, z = unpack("<QQ3d", payload)
    return Force(tool_sequence, step, (x, y, z))


@dataclass
class Scene:
    """What is shown: skins by muscle as lists of places [m], poses by body as 12 numbers (3x4, by rows)."""
    skins_world_m: list = field(default_factory=list)
    poses: list = field(default_factory=list)
    sequence: int = 0
    time_s: float = 0.0
    is_whole: bool = False


class SceneDecoder:
    def __init__(self):
        self.scene = Scene()
        self._keys = {}

    def take(self, frame: Frame) -> bool:
        """True when the scene is whole with this frame; other frames change nothing. Raises WireError."""
        if frame.type == SCENE_KEY:
            key, skin, _, count = unpack("<IHHI", frame.payload)
            self._keys[skin] = (key, unpack(f"<{3 * count}i", frame.payload, 12))
        elif frame.type == SCENE_DELTA:
            self._take_delta(frame.payload)
        elif frame.type == BONE_POSES:
            self.scene.sequence, self.scene.time_s, count = unpack("<QdH", frame.payload)
            numbers = unpack(f"<{12 * count}d", frame.payload, 18)
            self.scene.poses = [numbers[12 * i:12 * i + 12] for i in range(count)]
        self.scene.is_whole = frame.type != SCENE_KEY and frame.flags & LAST_OF_SCENE != 0
        return self.scene.is_whole

    def _take_delta(self, payload):
        key, skin, skins, count = unpack("<IHHI", payload)
        known, places = self._keys.get(skin, (None, ()))
        if known != key or len(places) != 3 * count or skin >= skins:
            raise WireError("a skin that refers to a key that did not come")
        numbers, at = [], 12
        for place in places:
            offset, at = self._varint(payload, at)
            numbers.append(GRID_M * (place + offset))
        if len(self.scene.skins_world_m) != skins:
            self.scene.skins_world_m = [[] for _ in range(skins)]
        self.scene.skins_world_m[skin] = [tuple(numbers[i:i + 3]) for i in range(0, len(numbers), 3)]

    @staticmethod
    def _varint(payload, at):
        zigzag = 0
        for shift in range(0, 35, 7):
            if at == len(payload):
                raise WireError("a frame that is shorter than it says")
            byte = payload[at]
            at += 1
            zigzag |= (byte & 0x7F) << shift
            if byte < 0x80:
                break
        return (zigzag >> 1) ^ -(zigzag & 1), at


class Client:
    """One connection. `with Client(...) as client:` sends Bye at its end. All that can go wrong is a WireError."""

    def __init__(self, host, port, role=STUDENT, wants=WANT_HAND, token=bytes(16), name="python", hand=0, resume_id=0,
                 timeout_s=60.0):
        self._address = f"{host}:{port}"
        self._sent = self._got = 0
        self.received = []  # every frame's bytes, when keep() was called
        self._keeps = False
        try:
            self._socket = socket.create_connection((host, port), CONNECT_WAIT_S)
        except OSError as why:
            raise self._failure(f"{why.strerror or why}; is `myotact serve` running there, and is this its port?") from None
        self._socket.settimeout(timeout_s)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        try:
            self.send(HELLO, struct.pack("<HBBBQ16s", 1, role, wants, hand, resume_id, token) + name.encode()[:48])
            self.welcome = decode_welcome(self._expect(WELCOME).payload)
            self.scene_json = self._expect(CONTROL).payload.decode(errors="replace")
        except WireError:
            self._socket.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        try:
            self.send(BYE, bytes([0]))
        except WireError:
            pass  # it is gone already
        self._socket.close()

    def keep(self):
        """Keeps the bytes of every frame from now on in `received`."""
        self._keeps = True

    def send(self, kind, payload=b"", flags=0, time_ns=0):
        try:
            self._socket.sendall(frame_bytes(Frame(kind, flags, self._sent, time_ns, payload)))
        except OSError as why:
            raise self._failure(why.strerror or why) from None
        self._sent += 1

    def send_state(self, state: ToolState, time_ns=None):
        for kind, flags, payload in tool_state_frames(state):
            self.send(kind, payload, flags, time.monotonic_ns() if time_ns is None else time_ns)

    def ping(self):
        self.send(PING, struct.pack("<Q", time.monotonic_ns()))

    def control(self, text: str):
        self.send(CONTROL, text.encode())

    def stop_forces(self):
        self.send(EVENT, struct.pack("<Bi", 1, 0))

    def read(self) -> Frame:
        """The next frame. Raises WireError, too, when the server said good-bye."""
        head = self._take(HEADER_BYTES)
        length, = struct.unpack_from("<I", head, 4)
        if head[0] != 0x4D or length > MOST_PAYLOAD:
            raise self._failure("what answers there speaks another protocol")
        data = head + self._take(length)
        frame = parse_frame(data)
        if frame.sequence != self._got:
            raise self._failure(f"frame {frame.sequence} where {self._got} was due")
        self._got += 1
        if self._keeps:
            self.received.append(data)
        if frame.type == BYE:
            raise self._failure(frame.payload[1:].decode(errors="replace") or "the server said good-bye")
        return frame

    def read_until(self, kind) -> Frame:
        frame = self.read()
        while frame.type != kind:
            frame = self.read()
        return frame

    def _expect(self, kind):
        frame = self.read()
        if frame.type != kind:
            raise self._failure(f"a frame of type {frame.type} where {kind} was due")
        return frame

    def _take(self, count):
        data = b""
        while len(data) < count:
            try:
                part = self._socket.recv(count - len(data))
            except OSError as why:
                raise self._failure(why.strerror or why) from None
            if not part:
                raise self._failure("the server closed the connection" if self._got else
                                    "closed without a word; is this the TCP port of `myotact serve`?")
            data += part
        return data

    def _failure(self, why):
        return WireError(f"{self._address}: {why}")
