"""How opposing muscles stiffen the elbow without moving it: joint stiffness K against their co-contraction u.

    python3 co_contraction_curve.py [--tissue line] [--picture FILE]
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import myotact


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tissue", default="fem", help="fem (half a minute) or line (a second)")
    parser.add_argument("--levels", type=int, default=6, help="how many levels between rest and full activation")
    parser.add_argument("--picture", default="co_contraction_curve.png")
    options = parser.parse_args()

    rows = myotact.stiffness("elbow", levels=np.linspace(0, 1, options.levels), set={"tissue.default": options.tissue})
    u = rows["common"]
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    axes.fill_between(u, rows["K_low_Nm_rad"], rows["K_high_Nm_rad"], alpha=0.2, label="what uncertain anatomy leaves open")
    axes.plot(u, rows["K_schur_Nm_rad"], "o-", label="K of the tissue (Schur complement)")
    axes.plot(u, rows["K_perturbed_Nm_rad"], "x", label="K by turning the joint a little")
    axes.plot(u, rows["K_line_Nm_rad"], "--", label="K of the muscle lines")
    axes.set(xlabel="co-contraction u", ylabel="K [N m/rad]", title="Elbow at its file pose", ylim=(0, None))
    axes.legend(fontsize=8, loc="upper left")
    figure.savefig(options.picture, dpi=110)
    for row in rows:
        print(f"u {row['common']:.2f}  K {row['K_schur_Nm_rad']:.3f} N m/rad  net torque {row['net_torque_Nm']:+.1e} N m")
    print("picture:", options.picture)


if __name__ == "__main__":
    main()
