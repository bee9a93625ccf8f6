#!/usr/bin/env python3
"""Sorts the dog's surfaces of dm_control into forelimb_left/ and hindlimb_left/ with bones/ and muscles/ each.

usage: sort_surfaces.py SOURCE OUT [--any-version]

SOURCE is a folder that holds suite/dog_assets somewhere, or the package itself (.whl, .zip, .tar.gz). files.tsv beside
this script says which file becomes which. Files are copied byte for byte; those of a paw are joined: header and count
are new, the triangles are not touched. A file with another checksum is refused, since attachments were measured on
these; --any-version takes it with a warning. Exit: 65 bad data, 66 no such input, 74 cannot write.
"""
import argparse
import hashlib
import os
import pathlib
import shutil
import struct
import sys
import tarfile
import tempfile
import zipfile

HEADER_BYTES = 80  # of a binary STL, before the count
RECORD_BYTES = 50
LARGEST_BYTES = 64 << 20  # the largest source has 1 MB


class Failure(Exception):
    def __init__(self, status, text):
        super().__init__(text)
        self.status = status


class Folder:
    """The assets in a folder, at any depth."""

    def __init__(self, root):
        found = sorted(p for p in root.rglob("dog_assets") if p.is_dir())
        if root.name == "dog_assets":
            found.insert(0, root)
        if not found:
            raise Failure(66, f"{root}: holds no folder dog_assets; name a copy of dm_control, or its package")
        self.root = found[0]

    def read(self, name):
        path = self.root / name
        return path.read_bytes() if path.is_file() else None


class Archive:
    """The assets in a package: by the end of their paths."""

    def __init__(self, path):
        self.members = {}
        try:
            if zipfile.is_zipfile(path):
                self.file = zipfile.ZipFile(path)
                for member in self.file.infolist():
                    self.add(member.filename, member, member.file_size)
            else:
                self.file = tarfile.open(path)
                for member in self.file:
                    if member.isfile():
                        self.add(member.name, member, member.size)
        except (tarfile.TarError, zipfile.BadZipFile, EOFError, OSError) as error:
            raise Failure(65, f"{path}: is neither a folder nor a package that can be read: {error}") from error
        if not self.members:
            raise Failure(65, f"{path}: holds no folder dog_assets; get the package again, in another version")

    def add(self, name, member, size):
        _, found, rest = name.partition("dog_assets/")
        if found and size <= LARGEST_BYTES:
            self.members[rest] = member

    def read(self, name):
        if name not in self.members:
            return None
        if isinstance(self.file, zipfile.ZipFile):
            return self.file.read(self.members[name])
        return self.file.extractfile(self.members[name]).read()


def table(path):
    """surface -> [(source, checksum)], in order."""
    surfaces = {}
    for line in path.read_text(encoding="ascii").splitlines():
        if line.startswith("#"):
            continue
        surface, source, checksum = line.split("\t")
        surfaces.setdefault(surface, []).append((source, checksum))
    return surfaces


def checked(assets, source, checksum, any_version):
    data = assets.read(source)
    if data is None:
        raise Failure(65, f"{source}: is not among the assets; get the package in another version")
    if hashlib.sha256(data).hexdigest() == checksum:
        return data
    if not any_version:
        raise Failure(65, f"{source}: is not the file that attachments were measured on (its checksum differs); get "
                          "another version of the package, or take it with --any-version")
    print(f"warning: {source}: its checksum differs", file=sys.stderr)
    return data


def joined(parts):
    """Binary STL files as one. parts: [(source, bytes)]."""
    records = b""
    for source, data in parts:
        if len(data) < HEADER_BYTES + 4:
            raise Failure(65, f"{source}: is no binary STL: it has {len(data)} bytes")
        (count,) = struct.unpack_from("<I", data, HEADER_BYTES)
        if len(data) != HEADER_BYTES + 4 + count * RECORD_BYTES:
            raise Failure(65, f"{source}: announces {count} triangles and has {len(data)} bytes; must have "
                              f"{HEADER_BYTES + 4 + count * RECORD_BYTES}")
        records += data[HEADER_BYTES + 4:]
    header = b"joined".ljust(HEADER_BYTES, b" ")
    return header + struct.pack("<I", len(records) // RECORD_BYTES) + records


def sort(assets, surfaces, folder, any_version):
    for surface, sources in surfaces.items():
        parts = [(source, checked(assets, source, checksum, any_version)) for source, checksum in sources]
        path = folder / surface
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(parts[0][1] if len(parts) == 1 else joined(parts))


def run(arguments):
    source, out = pathlib.Path(arguments.source), pathlib.Path(arguments.out)
    if not source.exists():
        raise Failure(66, f"{source}: is not there")
    if out.exists() and any(out.iterdir()):
        raise Failure(74, f"{out}: is not empty; name another folder")
    assets = Folder(source.resolve()) if source.is_dir() else Archive(source)
    surfaces = table(pathlib.Path(__file__).resolve().parent / "files.tsv")
    out.parent.mkdir(parents=True, exist_ok=True)
    fresh = pathlib.Path(tempfile.mkdtemp(prefix=out.name + ".", dir=out.parent))
    try:
        sort(assets, surfaces, fresh, arguments.any_version)
        fresh.chmod(0o755)
        os.replace(fresh, out)  # onto an empty folder or nothing
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    print(f"{out}: {len(surfaces)} surfaces", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("source")
    parser.add_argument("out")
    parser.add_argument("--any-version", action="store_true")
    try:
        run(parser.parse_args())
    except Failure as failure:
        print(f"error: {failure}", file=sys.stderr)
        return failure.status
    except OSError as error:
        print(f"error: {error.filename}: {error.strerror}", file=sys.stderr)
        return 74
    return 0


if __name__ == "__main__":
    sys.exit(main())
