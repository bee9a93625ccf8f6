"""Measurements: stiffness, probe, solve; and the program that makes specimens."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _check, _myotact
from .errors import DataError, Error, MissingError, _made

_FLAGS = ("held", "converged", "inside")


def table_of(csv: str) -> npt.NDArray[Any]:
    """A structured array of a table in CSV: columns of flags as bool, of texts as str, all others as float64."""
    lines = csv.splitlines()
    names = lines[0].split(",")
    columns = list(zip(*(line.split(",") for line in lines[1:]))) or [()] * len(names)
    arrays = [_column(name, column) for name, column in zip(names, columns)]
    table = np.empty(len(lines) - 1, dtype=[(name, array.dtype) for name, array in zip(names, arrays)])
    for name, array in zip(names, arrays):
        table[name] = array
    return table


def _column(name: str, words: Sequence[str]) -> npt.NDArray[Any]:
    if name in _FLAGS:
        return np.array([word == "1" for word in words], dtype=bool)
    try:
        return np.array([float(word) if word else np.nan for word in words], dtype=np.float64)
    except ValueError:
        return np.array(words, dtype=f"U{max(map(len, words))}")


def sweep(choice: Any, angles: npt.ArrayLike | None, levels: npt.ArrayLike, joint: str | None) -> npt.NDArray[Any]:
    asked = [] if angles is None else _check.table("angles", np.atleast_1d(angles), (None,)).tolist()
    wanted = _check.table("levels", np.atleast_1d(levels), (None,))
    if not len(wanted) or (wanted < 0.0).any() or (wanted > 1.0).any():
        raise DataError(f"levels: expected one number or more in 0 .. 1, got {wanted.tolist()}"[:200])
    named = "" if joint is None else _check.text("joint", joint)
    return table_of(_myotact.stiffness(choice, asked, wanted.tolist(), named))


def stiffness(
    scene: str | os.PathLike[str] | Mapping[str, Any] = "elbow",
    angles: npt.ArrayLike | None = None,
    levels: npt.ArrayLike = (0.0, 0.25, 0.5, 0.75, 1.0),
    *,
    joint: str | None = None,
    set: Mapping[str, Any] | None = None,
    workers: int = 2,
) -> npt.NDArray[Any]:
    """Joint stiffness against co-contraction, as `myotact stiffness`: a structured array, one row an angle and level.

    angles: of the joint [rad], inside its range; None: the scene's own. levels: of co-contraction, 0 .. 1.
    joint: another joint than that of the scene's co-contraction, driven by its whole groups.

    Columns as of stiffness.csv: joint, q_rad, common, difference, K_schur_Nm_rad (the tissue's), K_perturbed_Nm_rad,
    K_line_Nm_rad, net_torque_Nm, K_muscle_Nm_rad, K_geometry_Nm_rad, K_contact_Nm_rad, K_passive_Nm_rad, held, converged
    and more. Numbers that could not be found are nan.
    """
    from ._scene import choice_of

    return sweep(choice_of(scene, set, workers), angles, levels, joint)


@dataclass(frozen=True)
class ProbeAnswer:
    """What a probe felt."""

    rows: npt.NDArray[Any]  # a row a tick: t_s, proxy_x_m .., force_x_N .., contacts, rescues, inside, tick_us
    summary: dict[str, Any]


def probe(
    surface: str | os.PathLike[str] | tuple[npt.ArrayLike, npt.ArrayLike],
    path: str | os.PathLike[str] | npt.ArrayLike,
    *,
    radius: float = 3e-3,
    stiffness: float = 800.0,
    friction: float = 0.3,
    rate: float = 1000.0,
    frames: str | os.PathLike[str] | None = None,
) -> ProbeAnswer:
    """Drives the proxy along a path over any surface, as `myotact probe`.

    surface: a file (PLY, STL, OBJ, OFF) in metres, or (vertices (n, 3) [m], triangles (m, 3), counter-clockwise from
    outside). path: a CSV file t_s,x_m,y_m,z_m, or an array (n, 4) of the same, times rising.
    radius: of the tool [m], 0 .. 0.005; stiffness: of the coupling [N/m]; friction: coefficient; rate: ticks [1/s];
    frames: folder of a deforming surface.
    """
    how = {
        "radius": _check.number("radius", radius, 0.0, 5e-3),
        "stiffness": _check.number("stiffness", stiffness, 1.0, 1e4),
        "friction": _check.number("friction", friction, 0.0, 2.0),
        "rate": _check.number("rate", rate, 10.0, 1e5),
    }
    with tempfile.TemporaryDirectory(prefix="myotact-") as folder:
        summary, csv = _myotact.probe(
            _surface_file(surface, folder), _path_file(path, folder), "" if frames is None else os.fspath(frames), how
        )
    return ProbeAnswer(table_of(csv), json.loads(summary))


def _surface_file(surface: Any, folder: str) -> str:
    if isinstance(surface, (str, os.PathLike)):
        return os.fspath(surface)
    if not isinstance(surface, tuple) or len(surface) != 2:
        raise TypeError(f"surface: expected a file or (vertices, triangles), got {type(surface).__name__}")
    vertices = _check.table("surface: vertices", surface[0], (None, 3))
    triangles = _check.table("surface: triangles", surface[1], (None, 3), np.int64)
    if len(triangles) and not (0 <= triangles.min() and triangles.max() < len(vertices)):
        raise DataError(f"surface: triangles: expected indices in 0 .. {len(vertices) - 1}, got up to {triangles.max()}")
    file = Path(folder) / "surface.ply"
    faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, triangles
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\n"
        f"property double z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    file.write_bytes(header.encode() + vertices.astype("<f8").tobytes() + faces.tobytes())
    return str(file)


def _path_file(path: Any, folder: str) -> str:
    if isinstance(path, (str, os.PathLike)):
        return os.fspath(path)
    rows = _check.table("path", path, (None, 4))
    file = Path(folder) / "path.csv"
    file.write_text("t_s,x_m,y_m,z_m\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows.tolist()))
    return str(file)


def solve(case: str | os.PathLike[str] | Mapping[str, Any], *, vtk: str | os.PathLike[str] | None = None) -> dict[str, Any]:
    """Solves a finite-element case, as `myotact solve`: the answer {case, converged, steps, iterations, wall_s, outputs,
    units}. Where it did not converge, `converged` is False and the outputs are those of the last state in equilibrium.

    case: a file, or the same as a dict, whose relative paths start at the current folder. vtk: writes the deformed mesh.
    """
    vtk_file = "" if vtk is None else os.fspath(vtk)
    if isinstance(case, (str, os.PathLike)):
        return json.loads(_myotact.solve(os.fspath(case), vtk_file))
    if not isinstance(case, Mapping):
        raise TypeError(f"case: expected a file or a dict, got {type(case).__name__}")
    described = dict(case)
    if isinstance(described.get("mesh"), (str, os.PathLike)):
        described["mesh"] = os.path.abspath(described["mesh"])
    with tempfile.TemporaryDirectory(prefix="myotact-") as folder:
        file = Path(folder) / "case.json"
        file.write_text(json.dumps(described))
        return json.loads(_myotact.solve(str(file), vtk_file))


def prepare(*arguments: str | os.PathLike[str], program: str | os.PathLike[str] | None = None) -> str:
    """Runs the program myotact-prepare with these arguments and returns what it prints; its log goes to standard error.

    It is a program of its own, under the AGPL, and not part of this module. It is looked for in `program`, in the variable
    MYOTACT_PREPARE and on the PATH. Raises MissingError without it; Error with its last lines and exit status where it fails.
    """
    given = program or os.environ.get("MYOTACT_PREPARE") or "myotact-prepare"
    found = shutil.which(os.fspath(given))
    if found is None:
        raise MissingError(
            f"{os.fspath(given)}: there is no such program; install the package myotact-prepare, or name the program in the "
            "variable MYOTACT_PREPARE"
        )
    words = [os.fspath(argument) for argument in arguments]
    done = subprocess.run([found, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")
    if done.returncode != 0:
        said = "\n".join((done.stderr or done.stdout).strip().splitlines()[-8:])
        text = f"myotact-prepare {' '.join(words)}: ended with {done.returncode}: {said}"
        raise _made(done.returncode, text) if done.returncode > 0 else Error(text)
    return done.stdout
