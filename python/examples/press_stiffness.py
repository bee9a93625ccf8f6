"""How stiff a muscle feels under a fingertip: force and its slope against the depth of a press, relaxed and contracted.

    python3 press_stiffness.py [--picture FILE]
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import myotact

MUSCLE = "triceps_brachii_long"
WHERE = {"at": 0.45, "direction": (-1.0, 0.0, 0.3)}  # in the middle of the belly, from behind
TOOL = {"device": "simulated", "hand": "right", "radius_m": 3e-3, "force_limit": 1.0}  # all that the device can do: 3.3 N
CLEAR = 5e-3  # [m] from the skin to the middle of the ball before it touches


def press(level: float, depths: "list[float]") -> "list[float]":
    """Forces [N] at these depths of the ball's middle below the skin [m], each held until it is at rest."""
    scene = myotact.Scene("elbow", set={"tools": [TOOL]}, co_contraction=False)
    scene.joints["elbow"].lock()
    scene.muscles[MUSCLE].activate(level)
    scene.run(1.0)
    tool = scene.tools[0]
    tool.touch(MUSCLE, **WHERE, depth=-CLEAR, seconds=1.0)
    scene.run(1.2)
    clear = tool.position
    inwards = -np.array(WHERE["direction"]) / np.linalg.norm(WHERE["direction"])
    forces = []
    for depth in depths:
        tool.move_to(clear + (CLEAR + depth) * inwards, 0.2)
        scene.run(0.5)
        forces.append(float(np.linalg.norm(tool.force)))
    return forces


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--picture", default="press_stiffness.png")
    options = parser.parse_args()

    depths = np.arange(-4e-3, 7.5e-3, 1e-3)
    figure, (above, below) = plt.subplots(2, 1, figsize=(6, 5.5), sharex=True, layout="constrained")
    for level in (0.0, 0.5):
        forces = np.array(press(level, depths.tolist()))
        name = f"activation {level:g}"
        above.plot(1e3 * depths, forces, "o-", label=name)
        below.plot(1e3 * 0.5 * (depths[1:] + depths[:-1]), np.diff(forces) / np.diff(depths), "o-", label=name)
        print(name, " ".join(f"{force:.2f}" for force in forces), "N")
    above.set(ylabel="force on the hand [N]", title="A 3 mm ball on the long head of triceps")
    below.set(xlabel="depth of the ball's middle below the skin [mm]", ylabel="slope [N/m]", ylim=(0, None))
    above.legend()
    figure.savefig(options.picture, dpi=110)
    print("picture:", options.picture)


if __name__ == "__main__":
    main()
