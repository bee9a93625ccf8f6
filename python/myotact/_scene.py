"""A scene that is stepped from Python."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _check, _measure, _myotact
from ._parts import Parts
from ._specimen import Floats, Ints, RestJoint, RestMuscle, Specimen
from .errors import DataError

_FARTHEST_M = 10.0  # of a tool from the origin
_GLIDE_S = 0.1  # a level that jumps is felt as a blow
_LONGEST_S = 3600.0


def choice_of(
    scene: str | os.PathLike[str] | Mapping[str, Any],
    set: Mapping[str, Any] | None,
    workers: int,
    **more: Any,
) -> Any:
    """What the extension module needs to read a scene."""
    choice = _myotact.SceneChoice()
    if isinstance(scene, Mapping):
        choice.scene = json.dumps(dict(scene))
        choice.folder = os.getcwd()
    elif isinstance(scene, (str, os.PathLike)):
        choice.scene = os.fspath(scene)
    else:
        raise TypeError(f"scene: expected a name, a path or a dict, got {type(scene).__name__}")
    overrides = {}
    for key, value in (set or {}).items():
        overrides[_check.text("set: key", key)] = value if isinstance(value, str) else json.dumps(value, default=_plain)
    choice.set = overrides
    choice.workers = _check.whole("workers", workers, 1, 64)
    for name, value in more.items():
        setattr(choice, name, value)
    return choice


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"set: expected numbers, texts, lists and dicts, got {type(value).__name__}")


class Muscle:
    """A muscle of a scene. Arrays are read-only views: each is made once, stays where it is in memory, follows the scene
    from step to step and outlives it. SI units, world frame W (x cranial, y left, z up)."""

    def __init__(self, live: Any, index: int, rest: RestMuscle, joints: Parts[int]) -> None:
        self._live = live
        self._index = index
        self._rest = rest
        self._joints = joints
        self._arrays: dict[str, Floats] = {}
        self.key = rest.key

    def _array(self, what: str) -> Floats:
        if what not in self._arrays:
            self._arrays[what] = self._live.array(self._index, getattr(_myotact.MuscleArray, what))
        return self._arrays[what]

    def _state(self, what: str) -> Any:
        return self._live.muscle_state(self._index)[what]

    @property
    def nodes(self) -> Floats:
        """Positions of the nodes, (n, 3) [m], W: the corners that `tets` names, then the mid-sides of quadratic ones."""
        return self._array("nodes")

    @property
    def velocities(self) -> Floats:
        """Velocities of the nodes, (n, 3) [m/s], W; zero for a muscle that is not solved for (rigid, line, asleep)."""
        return self._array("velocities")

    @property
    def skin(self) -> Floats:
        """Vertices of the surface, (k, 3) [m], W."""
        return self._array("skin")

    @property
    def tets(self) -> Ints:
        """Corner nodes of each tetrahedron, (m, 4)."""
        return self._rest.tets

    @property
    def skin_triangles(self) -> Ints:
        """Vertices of each triangle of the surface, counter-clockwise from outside, (t, 3)."""
        return self._rest.skin_triangles

    @property
    def rest(self) -> RestMuscle:
        """The muscle at the file pose."""
        return self._rest

    @property
    def line(self) -> Floats:
        """Points of the muscle line from origin to insertion, round its wraps, (p, 3) [m], W; a new array each time."""
        return self._live.line(self._index)

    @property
    def length(self) -> float:
        """Of the muscle line [m]."""
        return float(np.linalg.norm(np.diff(self.line, axis=0), axis=1).sum())

    @property
    def activation(self) -> float:
        """0 .. 1; follows the level that was asked for with the muscle's time constants."""
        return self._state("activation")

    @property
    def force(self) -> float:
        """Tension that the muscle hands to its tendon [N]."""
        return self._state("force")

    @property
    def contact_force(self) -> float:
        """Sum of the contact forces on its surface [N]."""
        return self._state("contact_force")

    @property
    def volume_ratio(self) -> float:
        """Volume over that at rest."""
        return self._state("volume_ratio")

    def moment_arm(self, joint: str) -> float:
        """Of the muscle line about a joint [m], positive flexes."""
        return self._live.moment_arm(self._index, self._joints[joint])

    def activate(self, level: float, seconds: float = _GLIDE_S) -> None:
        """Asks for an activation of 0 .. 1, reached evenly within `seconds`. Raises DataError for a muscle that the scene's
        co-contraction drives: use Scene.co_contract or Scene.set_levels, or make the scene with co_contraction=False."""
        level = _check.number("level", level, 0.0, 1.0)
        seconds = _check.number("seconds", seconds, 0.0, _LONGEST_S)
        if self._state("driven"):
            raise DataError(
                f"{self.key}: is driven by the scene's co-contraction; use scene.co_contract() or scene.set_levels(), or "
                "make the scene with co_contraction=False"
            )
        self._live.activate(self._index, level, seconds)

    def __repr__(self) -> str:
        return f"<Muscle {self.key}>"


class Joint:
    """A joint of a scene. Angles [rad] are 0 at the file pose; q, torques and velocities are positive where they flex."""

    def __init__(self, live: Any, index: int, rest: RestJoint) -> None:
        self._live = live
        self._index = index
        self.key = rest.key
        self.rest = rest

    def readout(self) -> dict[str, float]:
        """All at once: q [rad], velocity [rad/s], torque and own_torque [N m], stiffness, line_stiffness,
        contact_stiffness and passive_stiffness [N m/rad], damping [N m s/rad], inertia [kg m2]."""
        return self._live.joint_state(self._index)

    @property
    def q(self) -> float:
        """Angle [rad]."""
        return self.readout()["q"]

    @property
    def velocity(self) -> float:
        """[rad/s]"""
        return self.readout()["velocity"]

    @property
    def torque(self) -> float:
        """Of all muscles together [N m]."""
        return self.readout()["torque"]

    @property
    def stiffness(self) -> float:
        """K = -d(torque)/dq at held activations, muscles, contact and the joint itself [N m/rad]. A muscle's part is
        renewed every few steps: after a change wait until all had their turn (3 steps a muscle)."""
        return self.readout()["stiffness"]

    def push(self, torque: float, seconds: float) -> None:
        """A constant torque [N m] from the next step on, for so long."""
        torque = _check.number("torque", torque, -1e3, 1e3)
        self._live.push(self._index, torque, _check.number("seconds", seconds, 0.0, _LONGEST_S))

    def lock(self, on: bool = True) -> None:
        """A locked joint keeps its angle."""
        self._live.lock(self._index, _check.flag("on", on))

    def __repr__(self) -> str:
        return f"<Joint {self.key}>"


@dataclass(frozen=True)
class Contact:
    """Where a tool rests on a part."""

    part: str  # key of the muscle or bone
    triangle: int  # of its skin
    point: tuple[float, float, float]  # [m], W
    normal: tuple[float, float, float]  # unit, out of the tissue, W


class Tool:
    """A tool in a simulated hand. What it is asked to do happens while the scene is stepped; its force comes from the same
    haptic loop that a device has, a tick a millisecond, in C++."""

    def __init__(self, live: Any, index: int, muscles: Parts[int], bones: Parts[int], facts: Mapping[str, Any]) -> None:
        self._live = live
        self._index = index
        self._muscles = muscles
        self._bones = bones
        self.hand: str = facts["hand"]  # left or right
        self.radius: float = facts["radius"]  # [m]
        self.stiffness: float = facts["stiffness"]  # of the coupling [N/m]

    def _state(self) -> dict[str, Any]:
        return self._live.tool_state(self._index)

    @property
    def position(self) -> Floats:
        """Of the hand, (3,) [m], W."""
        return np.array(self._state()["position"])

    @property
    def proxy(self) -> Floats:
        """Of the tool that stays outside of the tissue, (3,) [m], W."""
        return np.array(self._state()["proxy"])

    @property
    def force(self) -> Floats:
        """On the hand, after the force gate, (3,) [N], W."""
        return np.array(self._state()["force"])

    @property
    def contacts(self) -> list[Contact]:
        """What the tool rests on, the one that bears most first."""
        return [Contact(*contact) for contact in self._state()["contacts"]]

    @property
    def line_in_hand(self) -> str | None:
        """Key of the muscle whose line is in hand."""
        return self._state()["line_in_hand"]

    @property
    def body_in_hand(self) -> str | None:
        """Key of the body that is in hand."""
        return self._state()["body_in_hand"]

    def move_to(self, position: npt.ArrayLike, seconds: float = 0.1) -> None:
        """Moves the hand straight to a point (3,) [m], W, within `seconds`, starting and ending softly."""
        self._live.move(self._index, _duration(seconds), _check.triple("position", position, _FARTHEST_M))

    def touch(
        self,
        muscle: str,
        at: float = 0.5,
        direction: npt.ArrayLike = (0.0, 1.0, 0.0),
        depth: float = 4e-3,
        seconds: float = 1.0,
    ) -> None:
        """Comes to a muscle from outside and presses.

        at: place along its line, 0 origin .. 1 insertion; direction: out of the muscle, from which the hand comes, W;
        depth: of the hand below the skin as it is now [m], -0.05 .. 0.05.
        """
        found = self._muscles[muscle]
        self._live.touch(
            self._index, _duration(seconds), found, _share(at), _check.direction("direction", direction), _depth(depth)
        )

    def slide(self, to: float, depth: float = 4e-3, seconds: float = 1.0) -> None:
        """Strokes the muscle that was touched last, as far as `to` along its line (0 .. 1), pressing."""
        self._live.slide(self._index, _duration(seconds), _check.number("to", to, 0.0, 1.0), _depth(depth))

    def grab_line(
        self,
        muscle: str,
        at: float = 0.5,
        direction: npt.ArrayLike = (0.0, 1.0, 0.0),
        drag: npt.ArrayLike = (0.0, 0.0, 0.0),
        seconds: float = 2.0,
    ) -> None:
        """Comes to a muscle's line, takes it and drags it by (3,) [m], W."""
        found = self._muscles[muscle]
        self._live.grab_line(
            self._index,
            _duration(seconds),
            found,
            _share(at),
            _check.direction("direction", direction),
            _check.triple("drag", drag, _FARTHEST_M),
        )

    def grab_bone(
        self,
        bone: str,
        direction: npt.ArrayLike = (0.0, 1.0, 0.0),
        drag: npt.ArrayLike = (0.0, 0.0, 0.0),
        seconds: float = 2.0,
    ) -> None:
        """Comes to a bone from outside, takes it where it meets it and drags it by (3,) [m], W."""
        found = self._bones[bone]
        self._live.grab_bone(
            self._index,
            _duration(seconds),
            found,
            _check.direction("direction", direction),
            _check.triple("drag", drag, _FARTHEST_M),
        )

    def release(self, seconds: float = 0.4) -> None:
        """Lets go and lifts off by 40 mm."""
        self._live.release(self._index, _duration(seconds))

    def __repr__(self) -> str:
        return f"<Tool in the {self.hand} hand>"


def _duration(seconds: Any) -> float:
    return _check.number("seconds", seconds, 0.0, _LONGEST_S)


def _share(at: Any) -> float:
    return _check.number("at", at, 0.0, 1.0)


def _depth(depth: Any) -> float:
    return _check.number("depth", depth, -0.05, 0.05)


def _places(kind: str, parts: Parts[Any]) -> Parts[int]:
    return Parts(kind, {key: index for index, key in enumerate(parts)})


class Scene:
    """A limb, its muscles and tools, on a virtual clock: nothing moves but in step(). The same calls give the same numbers,
    bit for bit, on one build and machine. Another thread's call waits for its turn; a step holds no lock of Python."""

    def __init__(
        self,
        scene: str | os.PathLike[str] | Mapping[str, Any] = "elbow",
        *,
        set: Mapping[str, Any] | None = None,
        script: bool = False,
        co_contraction: bool = True,
        workers: int = 2,
        seed: int = 1,
        samples: int = 0,
    ) -> None:
        """Reads the scene and puts it at rest, which takes seconds.

        scene: a built-in name (myotact.built_in_scenes()), the path of a scene file, or such a file as a dict.
        set: overrides as the program's --set, {"joints.elbow.q_rad": 0.3, "tissue.default": "line"}.
        script: the scene's script moves the hand and the muscles, as in `myotact run`.
        co_contraction: False leaves the scene's co-contraction out; every muscle then has a level of its own.
        workers: threads of a step; the numbers do not depend on it. seed: of what is random (textures).
        samples: keeps a row for samples() every so many haptic ticks (of 1 ms); 0: none.

        Raises MissingError, DataError.
        """
        self._choice = choice_of(
            scene,
            set,
            workers,
            script=_check.flag("script", script),
            co_contraction=_check.flag("co_contraction", co_contraction),
            seed=_check.whole("seed", seed, 0, 2**64 - 1),
            samples=_check.whole("samples", samples, 0, 2**31 - 1),
        )
        self._live = _myotact.LiveScene(self._choice)
        self._facts = self._live.facts()
        self.specimen = Specimen._of(self._live.specimen())
        rest = self.specimen
        muscles, bones, joints = _places("muscle", rest.muscles), _places("bone", rest.bones), _places("joint", rest.joints)
        live = self._live
        self.muscles: Parts[Muscle] = Parts(
            "muscle", {key: Muscle(live, index, rest.muscles[key], joints) for key, index in muscles.items()}
        )
        self.joints: Parts[Joint] = Parts(
            "joint", {key: Joint(live, index, rest.joints[key]) for key, index in joints.items()}
        )
        self.tools = [Tool(live, index, muscles, bones, facts) for index, facts in enumerate(live.tool_facts())]

    @property
    def name(self) -> str:
        return self._facts["name"]

    @property
    def title(self) -> str:
        return self._facts["title"]

    @property
    def note(self) -> str:
        """What a person should know about the scene's settings."""
        return self._facts["note"]

    @property
    def description(self) -> dict[str, Any]:
        """The scene file with its overrides, to be changed and given to Scene()."""
        return json.loads(self._facts["text"])

    @property
    def dt(self) -> float:
        """Length of a step [s]."""
        return self._facts["dt"]

    @property
    def time(self) -> float:
        """Simulated [s]."""
        return self._live.state()["time"]

    @property
    def script_end(self) -> float:
        """When the script's last action ends [s]; 0 without a script."""
        return self._live.state()["script_end"]

    @property
    def notice(self) -> str:
        """What a person should know about the last step, or nothing: muscles that cannot hold the posture and the like."""
        return self._live.state()["notice"]

    @property
    def state_hash(self) -> int:
        """Equal for equal bits of everything that moves."""
        return self._live.state()["hash"]

    @property
    def failed_steps(self) -> int:
        """Steps that had to be repeated in shorter parts."""
        return self._live.state()["failed_steps"]

    def step(self, n: int = 1) -> None:
        """`n` steps of dt, each after its haptic ticks, without Python's lock. Between two steps signals are seen: Ctrl-C
        raises KeyboardInterrupt, and the scene stays usable."""
        self._live.step(_check.whole("n", n, 0, 10**9))

    def run(self, seconds: float) -> None:
        """Steps for so long [s], to the nearest step."""
        self.step(round(_check.number("seconds", seconds, 0.0, 1e6) / self.dt))

    def co_contract(self, common: float, difference: float = 0.0, seconds: float = _GLIDE_S) -> None:
        """The weaker side works at `common` (0 .. 1), the other balances it; `difference` (-1 .. 1) is added to the
        flexors where positive, else to the extensors. Reached evenly within `seconds`."""
        self._require_co_contraction()
        self._live.co_contract(
            _check.number("common", common, 0.0, 1.0),
            _check.number("difference", difference, -1.0, 1.0),
            _duration(seconds),
        )

    def set_levels(self, flexors: float, extensors: float, seconds: float = _GLIDE_S) -> None:
        """Both sides of the co-contraction at levels of their own, 0 .. 1, with no balance."""
        self._require_co_contraction()
        flexors = _check.number("flexors", flexors, 0.0, 1.0)
        self._live.set_levels(flexors, _check.number("extensors", extensors, 0.0, 1.0), _duration(seconds))

    def hold_posture(self, on: bool = True) -> None:
        """Trims the balance slowly until the joint is back where it is now."""
        self._require_co_contraction()
        self._live.hold_posture(_check.flag("on", on))

    def gravity(self, on: bool = True) -> None:
        """The scene's own gravity, else 9.81 m/s2 downwards; or none."""
        self._live.set_gravity(_check.flag("on", on))

    def reset(self) -> None:
        """Back to the starting posture and the beginning of the script; time and what was asked for stay."""
        self._live.reset()

    def stiffness(
        self, angles: npt.ArrayLike | None = None, levels: npt.ArrayLike = (0.0, 0.25, 0.5, 0.75, 1.0), joint: str | None = None
    ) -> npt.NDArray[Any]:
        """As myotact.stiffness(), of this scene as it begins, on simulations of its own."""
        return _measure.sweep(self._choice, angles, levels, joint)

    def samples_csv(self) -> str:
        """samples.csv of `myotact run`, one row a haptic tick; needs Scene(..., samples=1)."""
        if self._choice.samples == 0:
            raise DataError("samples: none were kept; make the scene with samples=1, or every n-th tick with samples=n")
        return self._live.samples_csv()

    def samples(self) -> npt.NDArray[Any]:
        """The same as a structured array, one field a column."""
        return _measure.table_of(self.samples_csv())

    def _require_co_contraction(self) -> None:
        if self._facts["co_contraction_joint"] is None:
            raise DataError(f"{self.name}: the scene has no co-contraction; take another scene, or add it with set=")

    def __repr__(self) -> str:
        return f"<Scene {self.name!r} at {self.time:g} s: {len(self.muscles)} muscles, {len(self.joints)} joints>"
