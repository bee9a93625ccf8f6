"""A specimen: bones, joints and muscles as they are at the file pose."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _myotact
from ._parts import Parts

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]


@dataclass(frozen=True)
class RestMuscle:
    """A muscle of a specimen. Arrays look into the specimen's own memory and are read-only; SI units, world frame."""

    key: str
    name_la: str
    name_en: str
    peak_force: float  # [N]
    optimal_fibre: float  # [m]
    pennation: float  # [rad]
    rest_stretch: float  # fibre length over the optimal one at the file pose
    tendon_slack: float  # [m]
    estimated: tuple[str, ...]  # which of these are estimates
    _specimen: Any = field(repr=False, compare=False)
    _index: int = field(repr=False, compare=False)

    @property
    def nodes(self) -> Floats:
        """Corner nodes of the tetrahedra, (n, 3) [m]."""
        return self._specimen.nodes(self._index)

    @property
    def tets(self) -> Ints:
        """Corner nodes of each tetrahedron, (m, 4)."""
        return self._specimen.tets(self._index)

    @property
    def fibres(self) -> Floats:
        """Direction of the fibres in each tetrahedron, from origin to insertion, (m, 3), unit."""
        return self._specimen.fibres(self._index)

    @property
    def skin(self) -> Floats:
        """Vertices of the surface, (k, 3) [m]."""
        return self._specimen.skin(self._index)

    @property
    def skin_triangles(self) -> Ints:
        """Vertices of each triangle, counter-clockwise from outside, (t, 3)."""
        return self._specimen.skin_triangles(self._index)


@dataclass(frozen=True)
class Bone:
    """A bone of a specimen. Arrays are read-only; metres, world frame at the file pose."""

    key: str
    name_la: str
    name_en: str
    body: str  # the body that it belongs to
    _specimen: Any = field(repr=False, compare=False)
    _index: int = field(repr=False, compare=False)

    @property
    def vertices(self) -> Floats:
        """Vertices of the surface, (k, 3) [m]."""
        return self._specimen.bone_vertices(self._index)

    @property
    def triangles(self) -> Ints:
        """Vertices of each triangle, counter-clockwise from outside, (t, 3)."""
        return self._specimen.bone_triangles(self._index)


@dataclass(frozen=True)
class RestJoint:
    """A joint of a specimen: a right-hand rotation of `child` about an axis is flexion, 0 at the file pose."""

    key: str
    type: str  # hinge, universal, ball or weld
    parent: str  # body
    child: str  # body
    centre: tuple[float, float, float]  # [m], world frame
    axes: tuple[tuple[float, float, float], ...]  # unit
    range: tuple[tuple[float, float], ...]  # [rad], one an axis
    passive_stiffness: float  # [N m/rad]


def _fixed(facts: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in facts.items()}


class Specimen:
    """Reads a specimen folder, as `myotact-prepare` writes it, and checks it."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """Raises MissingError where there is no specimen, DataError where it cannot be used."""
        self._fill(_myotact.Specimen(os.fspath(folder)))

    @classmethod
    def _of(cls, held: Any) -> Specimen:
        made = cls.__new__(cls)
        made._fill(held)
        return made

    def _fill(self, held: Any) -> None:
        self._held = held
        self._facts = held.facts()
        self.muscles: Parts[RestMuscle] = Parts(
            "muscle",
            {
                facts["key"]: RestMuscle(**_fixed(facts), _specimen=held, _index=index)
                for index, facts in enumerate(held.muscles())
            },
        )
        self.bones: Parts[Bone] = Parts(
            "bone",
            {facts["key"]: Bone(**facts, _specimen=held, _index=index) for index, facts in enumerate(held.bones())},
        )
        self.joints: Parts[RestJoint] = Parts(
            "joint",
            {
                facts["key"]: RestJoint(**_fixed(facts))
                for facts in held.joints()
            },
        )

    @property
    def name(self) -> str:
        return self._facts["name"]

    @property
    def facts(self) -> dict[str, str]:
        """name, species, breed, side, source, licence, created_by."""
        return dict(self._facts)

    def __repr__(self) -> str:
        return f"<Specimen {self.name!r}: {len(self.muscles)} muscles, {len(self.bones)} bones>"
