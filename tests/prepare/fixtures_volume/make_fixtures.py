#!/usr/bin/env python3
"""Writes the phantom of ../phantom_volume.cpp with programs of other people: nibabel (NIfTI) and teem (NRRD).

Needs Debian's python3-nibabel and teem-apps. ITK's files are written by make_fixtures.mjs, from what --raw leaves.
"""

import json
import os
import subprocess
import sys
import tempfile

import nibabel
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LPS_TO_RAS = np.diag([-1.0, -1.0, 1.0])


def phantom_label(p):
    """As phantom_label() of phantom_volume.cpp; LPS millimetres."""
    if np.linalg.norm(p - [12, 11, 12]) < 9.0:
        return 1
    if np.linalg.norm(p - [12, 26, 12]) < 6.0:
        return 2
    x, y = p[0] - 29, p[1] - 20
    from_axis = np.hypot(x, y)
    if from_axis < 4.5:
        return 3
    if np.hypot(from_axis - 8.0, p[2] - 16.0) < 3.4 and y > -2.0:
        return 4
    if 33.9 < p[2] < 37.7 and p[0] < 22.0:
        return 5
    return 0


class Grid:
    """Counts, origin and steps (columns), LPS millimetres; labels with index order i, j, k."""

    def __init__(self, counts, origin, steps):
        self.counts, self.origin, self.steps = counts, np.array(origin, float), np.array(steps, float)
        self.labels = np.zeros(counts, int)
        for index in np.ndindex(*counts):
            self.labels[index] = phantom_label(self.origin + self.steps @ np.array(index))

    def ras_affine(self):
        affine = np.eye(4)
        affine[:3, :3] = LPS_TO_RAS @ self.steps
        affine[:3, 3] = LPS_TO_RAS @ self.origin
        return affine


def turned(axis, angle):
    x, y, z = np.array(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)


STRAIGHT = Grid((20, 22, 21), (0.13, 0.27, 0.41), 1.9 * np.eye(3))
# Columns run to the head, rows to the right, slices to the back: a left-handed lattice.
SAGITTAL = Grid((21, 20, 22), (36.23, 0.27, 0.41), 1.9 * np.array([[0, -1, 0], [0, 0, 1], [1, 0, 0]], float))
STEPS = turned((1, -2, 3), 0.4) @ np.diag([1.3, 1.9, 3.1])
OBLIQUE = Grid((28, 21, 12), np.array([20, 20, 20]) - STEPS @ [13.5, 10, 5.5], STEPS)


def path(name):
    return os.path.join(HERE, name)


def write_nifti():
    oblique = nibabel.Nifti1Image(OBLIQUE.labels.astype(np.uint16), OBLIQUE.ras_affine())
    oblique.set_qform(None, 0)
    oblique.header.set_xyzt_units("mm")
    nibabel.save(oblique, path("nibabel_oblique_sform.nii.gz"))

    header = nibabel.Nifti1Header(endianness=">")
    header.set_data_dtype(np.int16)
    mirrored = nibabel.Nifti1Image(SAGITTAL.labels.astype(np.int16), None, header)
    mirrored.set_qform(SAGITTAL.ras_affine(), 1)
    mirrored.set_sform(None, 0)
    mirrored.header.set_xyzt_units("mm")
    nibabel.save(mirrored, path("nibabel_qform_big_endian.nii"))

    microns = SAGITTAL.ras_affine()
    microns[:3] *= 1000
    second = nibabel.Nifti2Image(SAGITTAL.labels.astype(np.int64), microns, dtype=np.int64)
    second.header.set_xyzt_units("micron")
    nibabel.save(second, path("nibabel_nifti2_microns.nii.gz"))


def write_nrrd(name, grid, dtype, teem_type, space, signs, options):
    vectors = [signs * grid.steps[:, axis] for axis in range(3)]
    text = lambda v: "(" + ",".join(repr(float(x)) for x in v) + ")"
    with tempfile.TemporaryDirectory() as folder:
        raw = os.path.join(folder, "raw")
        grid.labels.astype(dtype).ravel(order="F").tofile(raw)
        made = os.path.join(folder, "made.nrrd")
        subprocess.run(
            ["teem-unu", "make", "-i", raw, "-t", teem_type, "-en", "little", "-s", *map(str, grid.counts)]
            + ["-spc", space, "-orig", text(signs * grid.origin), "-dirs", " ".join(map(text, vectors)), "-o", made],
            check=True,
        )
        subprocess.run(["teem-unu", "save", "-i", made, *options, "-o", path(name)], check=True)


def write_raw(folder):
    for name, grid in {"straight": STRAIGHT, "sagittal": SAGITTAL, "oblique": OBLIQUE}.items():
        spacing = np.linalg.norm(grid.steps, axis=0)
        about = {
            "size": list(grid.counts),
            "origin": list(grid.origin),
            "spacing": list(spacing),
            "direction": (grid.steps / spacing).ravel().tolist(),
            "labels": grid.labels.ravel(order="F").tolist(),
        }
        with open(os.path.join(folder, name + ".json"), "w") as file:
            json.dump(about, file)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--raw"]:
        write_raw(sys.argv[2])
        sys.exit()
    write_nifti()
    ras, las, lps = np.array([-1, -1, 1]), np.array([1, -1, 1]), np.array([1, 1, 1])
    write_nrrd("teem_ras_gzip_big_endian.nrrd", OBLIQUE, np.uint16, "ushort", "RAS", ras,
               ["-f", "nrrd", "-e", "gzip", "-en", "big"])
    write_nrrd("teem_las_detached.nhdr", SAGITTAL, np.uint8, "uchar", "LAS", las, ["-f", "nrrd", "-e", "raw"])
    write_nrrd("teem_lps_int.nrrd", STRAIGHT, np.int32, "int", "LPS", lps, ["-f", "nrrd", "-e", "gzip"])
