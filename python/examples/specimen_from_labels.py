"""A specimen from a label map: a small arm is drawn on a lattice, myotact-prepare makes it into a specimen, and its muscle
flexes it.

    python3 specimen_from_labels.py [--folder FOLDER] [--picture FILE]

The label map could as well be a segmented CT. Needs the program myotact-prepare (on the PATH, or in MYOTACT_PREPARE).
"""

import argparse
import gzip
import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import myotact

STEP_MM = 1.5
COUNTS = (36, 48, 90)  # left, posterior, superior
BONES = {"humerus": 1, "radius": 2}
MUSCLE, MUSCLE_LABEL = "flexor", 3
JOINT_MM = np.array([27.0, 25.0, 68.0])  # left, posterior, superior


def draw() -> np.ndarray:
    """Labels (left, posterior, superior): two rods end to end, and behind them a spindle from one to the other."""
    left, posterior, superior = (STEP_MM * index for index in np.indices(COUNTS))
    labels = np.zeros(COUNTS, np.uint8)
    from_axis = np.hypot(left - JOINT_MM[0], posterior - JOINT_MM[1])
    labels[(from_axis < 9) & (superior > 71) & (superior < 128)] = BONES["humerus"]
    labels[(from_axis < 9) & (superior > 6) & (superior < 65)] = BONES["radius"]
    along = (superior - 22) / (114 - 22)
    middle = JOINT_MM[1] + 12 + 9 * np.sin(np.pi * np.clip(along, 0, 1))
    thick = 4.5 + 4.0 * np.sin(np.pi * np.clip(along, 0, 1))
    from_muscle = np.hypot(left - JOINT_MM[0], posterior - middle)
    labels[(labels == 0) & (along > 0) & (along < 1) & (from_muscle < thick)] = MUSCLE_LABEL
    return labels


def write_nrrd(labels: np.ndarray, file: Path) -> None:
    """As 3D Slicer keeps segmentations, with the names in the header."""
    names = {**BONES, MUSCLE: MUSCLE_LABEL}
    header = [
        "NRRD0004",
        "type: unsigned char",
        "dimension: 3",
        "space: left-posterior-superior",
        "sizes: " + " ".join(map(str, labels.shape)),
        f"space directions: ({STEP_MM},0,0) (0,{STEP_MM},0) (0,0,{STEP_MM})",
        "kinds: domain domain domain",
        "encoding: gzip",
        "space origin: (0,0,0)",
    ]
    for index, (name, label) in enumerate(names.items()):
        header += [f"Segment{index}_ID:={name}", f"Segment{index}_LabelValue:={label}", f"Segment{index}_Layer:=0"]
        header += [f"Segment{index}_Name:={name}"]
    points = labels.transpose(2, 1, 0).tobytes()  # the first axis runs fastest
    file.write_bytes("\n".join(header).encode() + b"\n\n" + gzip.compress(points, mtime=0))


def write_joint(file: Path) -> None:
    """The joint's axis, as a line drawn in 3D Slicer: a right-hand rotation about it flexes."""
    ends = [JOINT_MM - [10, 0, 0], JOINT_MM + [10, 0, 0]]
    points = [{"label": f"joint elbow humerus radius-{i + 1}", "position": end.tolist()} for i, end in enumerate(ends)]
    line = {"type": "Line", "coordinateSystem": "LPS", "coordinateUnits": "mm", "controlPoints": points}
    file.write_text(json.dumps({"markups": [line]}))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=Path, default=Path("small_arm"), help="where the files go")
    parser.add_argument("--picture", default="specimen_from_labels.png")
    options = parser.parse_args()

    options.folder.mkdir(parents=True, exist_ok=True)
    labels = draw()
    volume, joint = options.folder / "arm.seg.nrrd", options.folder / "joint elbow humerus radius.mrk.json"
    write_nrrd(labels, volume)
    write_joint(joint)
    made = options.folder / "specimen"
    myotact.prepare(volume, joint, "--guess", "--bones", ",".join(BONES), "-o", made)
    specimen = myotact.Specimen(made)
    print(specimen, {joint.key: joint.type for joint in specimen.joints.values()})

    scene = myotact.Scene(
        {
            "schema": 1,
            "name": "arm",
            "title": "A small arm",
            "specimen": str(made.resolve()),
            "tools": [{"device": "simulated", "hand": "right"}],
        }
    )
    muscle, elbow = scene.muscles[MUSCLE], scene.joints["elbow"]
    rest = muscle.skin.copy()
    times, angles, forces = [], [], []
    muscle.activate(0.5, seconds=0.2)
    while scene.time < 1.5:
        scene.step()
        times.append(scene.time)
        angles.append(np.degrees(elbow.q))
        forces.append(muscle.force)
    print(f"flexed by {angles[-1]:.1f} degrees; {muscle.force:.1f} N at an arm of {1e3 * muscle.moment_arm('elbow'):.1f} mm")

    figure, (cut, after, motion) = plt.subplots(1, 3, figsize=(10, 4), layout="constrained")
    extent = (0, STEP_MM * COUNTS[1], 0, STEP_MM * COUNTS[2])
    cut.imshow(labels[COUNTS[0] // 2].T, origin="lower", extent=extent, cmap="tab10", interpolation="nearest", vmax=9)
    cut.set(title="label map, cut", xlabel="posterior [mm]", ylabel="superior [mm]")
    for skin, colour, name in ((rest, "tab:gray", "before"), (muscle.skin, "tab:red", "after")):
        after.triplot(1e3 * skin[:, 2], 1e3 * skin[:, 0], muscle.skin_triangles, color=colour, linewidth=0.5, label=name)
    after.set(title="the muscle's skin", xlabel="z [mm]", ylabel="x [mm]", aspect="equal", xlim=(20, 90))
    after.legend(fontsize=8)
    motion.plot(times, angles, label="angle [degrees]")
    motion.plot(times, forces, label="force of the muscle [N]")
    motion.set(title="activation 0.5", xlabel="t [s]")
    motion.legend(fontsize=8)
    figure.savefig(options.picture, dpi=90)
    print("picture:", options.picture)


if __name__ == "__main__":
    main()
