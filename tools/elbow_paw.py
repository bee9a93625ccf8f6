"""Makes the forepaw of meshes/canine_elbow anew: all bones of that body in meshes/canine_whole_forelimb, as one mesh.

Usage: elbow_paw.py MESHES
"""

import hashlib
import json
import re
import struct
import sys
from pathlib import Path

VERTEX = 24  # bytes: three doubles
FACE = struct.Struct("<B3i")


def read(path):
    """Header, vertices as they are in the file, triangles."""
    data = path.read_bytes()
    start = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:start].decode("ascii")
    vertices, faces = (int(re.search(rf"element {what} (\d+)", header)[1]) for what in ("vertex", "face"))
    end = start + VERTEX * vertices
    if len(data) != end + FACE.size * faces:
        raise SystemExit(f"{path}: is not made of doubles and triangles")
    return header, data[start:end], list(FACE.iter_unpack(data[end:]))


def join(paths):
    """The meshes side by side, as the bytes of one file."""
    header, vertices, faces = "", b"", b""
    for path in paths:
        header, own, triangles = read(path)
        first = len(vertices) // VERTEX
        vertices += own
        faces += b"".join(FACE.pack(n, a + first, b + first, c + first) for n, a, b, c in triangles)
    header = re.sub(r"element vertex \d+", f"element vertex {len(vertices) // VERTEX}", header)
    header = re.sub(r"element face \d+", f"element face {len(faces) // FACE.size}", header)
    return header.encode("ascii") + vertices + faces


def main():
    meshes = Path(sys.argv[1])
    whole, elbow = meshes / "canine_whole_forelimb", meshes / "canine_elbow"
    bones = json.loads((whole / "specimen.json").read_text(encoding="utf-8"))["bones"]
    paw = join([whole / bone["file"] for bone in bones if bone["body"] == "manus"])
    kept, described = elbow / "bones" / "manus.ply", elbow / "specimen.json"
    text = described.read_text(encoding="utf-8")
    before = hashlib.sha256(kept.read_bytes()).hexdigest()
    if before not in text:
        raise SystemExit(f"{described}: does not name the sum of {kept.name}")
    described.write_text(text.replace(before, hashlib.sha256(paw).hexdigest()), encoding="utf-8")
    kept.write_bytes(paw)


if __name__ == "__main__":
    main()
