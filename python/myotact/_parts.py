"""Parts of a limb by their names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

from . import _check, _myotact
from .errors import UnknownNameError

Part = TypeVar("Part")


class Parts(Mapping[str, Part]):
    """Muscles, joints or bones by key, in the specimen's order. An unknown key is refused with the nearest known one."""

    def __init__(self, kind: str, parts: dict[str, Part]) -> None:
        self._kind = kind
        self._parts = parts

    def __getitem__(self, key: str) -> Part:
        found = self._parts.get(_check.text(self._kind, key))
        if found is None:
            raise UnknownNameError(unknown(self._kind, key, list(self._parts)))
        return found

    def __contains__(self, key: object) -> bool:
        return key in self._parts

    def __iter__(self) -> Iterator[str]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)

    def __repr__(self) -> str:
        return f"<{len(self)} {self._kind}s: {', '.join(self._parts)}>"


def unknown(kind: str, key: str, known: list[str]) -> str:
    """Says that there is none of that name, and which may be meant."""
    nearest = _myotact.nearest_word(key, known)
    return f"{kind}: expected one of the {len(known)} names of this limb, got {key!r}" + (
        f" (nearest: {nearest})" if nearest else ""
    )
