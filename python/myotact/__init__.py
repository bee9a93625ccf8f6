"""Myotact from Python: the muscles of a dog's limb, stepped, touched and measured.

    import myotact
    scene = myotact.Scene("elbow")
    scene.co_contract(0.5)
    scene.run(1.0)
    print(scene.joints["elbow"].stiffness, scene.muscles["biceps_brachii"].nodes)

SI units, world frame W: right-handed, x cranial, y left, z up. Angles are flexion from the file pose [rad]. A scene runs
in lockstep, on a virtual clock; the 1 kHz loop of a real device is never in Python. Not a medical device.
"""

from __future__ import annotations

from pathlib import Path as _Path

from . import _myotact


def _own_data() -> _Path:
    """Of the installed package; of the sources, where the package is used out of them."""
    package = _Path(__file__).resolve().parent
    installed = package / "share"
    return installed if installed.is_dir() else package.parent.parent


_myotact.suggest_data_folder(str(_own_data()))

from ._measure import ProbeAnswer, prepare, probe, solve, stiffness  # noqa: E402
from ._scene import Contact, Joint, Muscle, Scene, Tool  # noqa: E402
from ._specimen import Bone, RestJoint, RestMuscle, Specimen  # noqa: E402
from .errors import DataError, Error, MissingError, MisuseError, UnknownNameError, WriteError  # noqa: E402

__version__: str = _myotact.version

__all__ = [
    "Bone",
    "Contact",
    "DataError",
    "Error",
    "Joint",
    "MissingError",
    "MisuseError",
    "Muscle",
    "ProbeAnswer",
    "RestJoint",
    "RestMuscle",
    "Scene",
    "Specimen",
    "Tool",
    "UnknownNameError",
    "WriteError",
    "built_in_scenes",
    "data_folder",
    "prepare",
    "probe",
    "solve",
    "stiffness",
]


def built_in_scenes() -> list[str]:
    """Names that Scene() takes."""
    return _myotact.built_in_scenes()


def data_folder() -> _Path:
    """Where assets and specimens are: the variable MYOTACT_DATA_DIR, else what came with this package."""
    return _Path(_myotact.data_folder())
