"""Figures of the paper, and how pictures are compared. Needs python3-matplotlib and python3-pil."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from PIL import Image, ImageChops, ImageStat  # noqa: E402

STYLE = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "savefig.dpi": 160}


def save(figure, path):
    figure.savefig(path, bbox_inches="tight", metadata={"Software": None})
    pyplot.close(figure)


def draw_stiffness(rows, path):
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    with pyplot.rc_context(STYLE):
        figure, axes = pyplot.subplots(1, len(scenes), figsize=(8.4, 2.8))
        for axis, scene in zip(axes, scenes):
            own = [row for row in rows if row["scene"] == scene]
            column = lambda key: [float(row[key]) for row in own]
            axis.fill_between(column("common"), column("K_low_Nm_rad"), column("K_high_Nm_rad"), color="#e4d3cc", lw=0,
                              label="left open by the anatomy")
            axis.plot(column("common"), column("K_line_Nm_rad"), "--", color="#777777",
                      label="muscle lines at the same activations")
            axis.plot(column("common"), column("K_schur_Nm_rad"), color="#a23b2a", label="complement, finite elements")
            axis.plot(column("common"), column("K_perturbed_Nm_rad"), "o", ms=3.5, mfc="none", color="black",
                      label="perturbed angle, finite elements")
            axis.set_title(scene)
            axis.set_xlabel("co-contraction")
            axis.axhline(0.0, color="black", lw=0.6)
        axes[0].set_ylabel("K [N m/rad]")
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower center", ncol=4, frameon=False, bbox_to_anchor=(0.5, -0.12),
                      fontsize=7.5)
        save(figure, path)


FAMILIES = {
    "laws and patches": ("homogeneous", "febio", "patch", "tangent"),
    "elements on beams, tubes, muscles": ("beam", "cylinder", "elements", "bar"),
    "fibre curves, activation": ("curves", "isotonic", "activation"),
    "time rules, pendulum": ("order", "oscillator", "solid", "pendulum"),
    "joint stiffness of lines": ("pair", "line", "pulse"),
}


def family_of(case):
    return next((name for name, starts in FAMILIES.items() if case.startswith(starts)), "other")


def draw_validation(rows, path):
    names = [name for name in [*FAMILIES, "other"] if any(family_of(row["case"]) == name for row in rows)]
    with pyplot.rc_context(STYLE):
        figure, axis = pyplot.subplots(figsize=(6.4, 2.6))
        for height, name in enumerate(reversed(names)):
            shares = sorted(max(float(row["share"]), 1e-6) for row in rows if family_of(row["case"]) == name)
            spread = [height + 0.3 * ((k * 0.618034) % 1.0 - 0.5) * 2 for k in range(len(shares))]
            axis.plot(shares, spread, ".", ms=4, alpha=0.6, color="#a23b2a")
        axis.axvline(1.0, color="black", lw=0.8)
        axis.text(1.1, len(names) - 0.45, "tolerance", fontsize=7.5)
        axis.set_xscale("log")
        axis.set_xlabel("error over the tolerance of its source (1e-6: as much or less)")
        axis.set_yticks(range(len(names)), reversed(names))
        save(figure, path)


def picture_difference(kept, made):
    """Empty where two pictures, or the frames of two animations, look alike: less than 1.5 of 255 apart on the mean."""
    with Image.open(kept) as old, Image.open(made) as new:
        count = getattr(old, "n_frames", 1)
        if old.size != new.size or count != getattr(new, "n_frames", 1):
            return [f"{kept.name}: {new.size} in place of {old.size}, or another number of frames"]
        for frame in range(count):
            old.seek(frame), new.seek(frame)
            apart = ImageStat.Stat(ImageChops.difference(old.convert("RGB"), new.convert("RGB"))).mean
            if max(apart) > 1.5:
                return [f"{kept.name}, frame {frame}: {max(apart):.1f} of 255 apart"]
    return []


def join_pictures(paths, path):
    """Pictures of one height side by side, without the paws: nothing is touched there."""
    images = [Image.open(one).convert("RGB") for one in paths]
    images = [image.crop((0, 0, image.width, image.height * 3 // 5)) for image in images]
    joined = Image.new("RGB", (sum(image.width for image in images), images[0].height))
    left = 0
    for image in images:
        joined.paste(image, (left, 0))
        left += image.width
    joined.save(path)
