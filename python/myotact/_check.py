"""What is asked of arguments: every refusal names the argument, what is expected and what came."""

from __future__ import annotations

import math
from typing import Any, Sequence

import numpy as np
import numpy.typing as npt

from .errors import DataError


def number(name: str, value: Any, lowest: float = -math.inf, highest: float = math.inf) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{name}: expected a number, got {_kind(value)}")
    found = float(value)
    if not math.isfinite(found) or not lowest <= found <= highest:
        if math.isinf(lowest) and math.isinf(highest):
            allowed = "a finite number"
        elif math.isinf(highest):
            allowed = f"a number of at least {lowest:g}"
        else:
            allowed = f"a number in {lowest:g} .. {highest:g}"
        raise DataError(f"{name}: expected {allowed}, got {found!r}")
    return found


def whole(name: str, value: Any, lowest: int, highest: int) -> int:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name}: expected an integer, got {_kind(value)}")
    if not lowest <= int(value) <= highest:
        raise DataError(f"{name}: expected an integer in {lowest} .. {highest}, got {int(value)}")
    return int(value)


def flag(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: expected True or False, got {_kind(value)}")
    return bool(value)


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name}: expected a text, got {_kind(value)}")
    return value


def table(name: str, value: Any, shape: Sequence[int | None], dtype: type = np.float64) -> npt.NDArray[Any]:
    """An array of finite numbers of that shape; None: any length. Integers serve as floats, nothing else is converted."""
    expected = f"({', '.join('n' if length is None else str(length) for length in shape)}{',' * (len(shape) == 1)})"
    wanted = "whole numbers" if dtype is not np.float64 else "numbers"
    try:
        array = np.asarray(value)
    except ValueError as error:  # a ragged list
        raise DataError(f"{name}: expected {wanted} of the shape {expected}, got {_kind(value)}: {error}") from None
    if array.dtype.kind not in ("iu" if dtype is not np.float64 else "iuf"):
        raise TypeError(f"{name}: expected {wanted} of the shape {expected}, got the dtype {array.dtype}")
    fits = array.ndim == len(shape) and all(want in (None, have) for want, have in zip(shape, array.shape))
    if not fits:
        raise DataError(f"{name}: expected the shape {expected}, got {array.shape}")
    if not np.isfinite(array).all():
        raise DataError(f"{name}: expected finite numbers, got {int((~np.isfinite(array)).sum())} that are not")
    return np.ascontiguousarray(array, dtype=dtype)


def triple(name: str, value: Any, farthest: float = math.inf) -> tuple[float, float, float]:
    x, y, z = (float(part) for part in table(name, value, (3,)))
    if math.sqrt(x * x + y * y + z * z) > farthest:
        raise DataError(f"{name}: expected a point within {farthest:g} m of the origin, got ({x:g}, {y:g}, {z:g})")
    return x, y, z


def direction(name: str, value: Any) -> tuple[float, float, float]:
    x, y, z = triple(name, value)
    length = math.sqrt(x * x + y * y + z * z)
    if not 1e-9 < length < 1e9:
        raise DataError(f"{name}: expected a direction, got ({x:g}, {y:g}, {z:g})")
    return x / length, y / length, z / length


def _kind(value: Any) -> str:
    kind = type(value).__name__
    return kind if value is None else f"{kind} {value!r}"[:80]
