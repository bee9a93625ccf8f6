"""Exceptions of myotact. Each text names the place, the value, what is allowed and the remedy."""

from __future__ import annotations

__all__ = ["DataError", "Error", "MissingError", "MisuseError", "UnknownNameError", "WriteError"]


class Error(Exception):
    """Any error of myotact. `status` is the exit status with which the program would end."""

    status: int = 70

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class DataError(Error, ValueError):
    """A scene, case, mesh or argument holds what cannot be used."""

    status = 65


class MissingError(Error, FileNotFoundError):
    """A scene, specimen or file is not there."""

    status = 66


class WriteError(Error, OSError):
    """A file cannot be read or written."""

    status = 74


class UnknownNameError(Error, KeyError):
    """No muscle, joint or bone has that name; the text names the nearest one."""

    status = 2


class MisuseError(Error, RuntimeError):
    """A call out of a step of the same scene, in a forked child, or while Python ends."""


_BY_STATUS: dict[int, type[Error]] = {-1: MisuseError, 2: DataError, 65: DataError, 66: MissingError, 74: WriteError}


def _made(status: int, text: str) -> Error:
    error = _BY_STATUS.get(status, Error)(text)
    if status >= 0:
        error.status = status
    return error
