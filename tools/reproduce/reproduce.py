#!/usr/bin/env python3
"""reproduce.py MYOTACT OUT [NAME...]: makes the figures and tables of README and paper again and prints what differs.

Without names all of them; --list tells them. What is made comes to OUT. Status: 0 all as kept, 1 something differs.
"""

import argparse
import csv
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import figures

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "paper" / "data"
SCENES = {"elbow": "0", "stifle": "20", "hock": "0"}  # degrees of flexion that the README's table is of


def run(program, *arguments):
    environment = dict(os.environ, MYOTACT_DATA_DIR=str(ROOT), LC_ALL="C.UTF-8")
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, env=environment, check=False)
    if done.returncode not in (0, 1):  # 1: a check failed, which is told
        line = " ".join(map(str, arguments))
        raise RuntimeError(f"myotact {line} ended with {done.returncode}:\n{done.stderr[-2000:]}")
    return done.stdout


def rows_of(path):
    with open(path, encoding="utf-8") as table:
        return list(csv.DictReader(table))


def as_printed(value, printed):
    """Whether the value rounds to the number that is printed."""
    digits = len(printed.partition(".")[2])
    return abs(value - float(printed)) <= 0.5001 * 10.0**-digits


def compare_tables(kept, made, keys, share):
    """Differences of more than `share` between two tables with the same rows."""
    if len(kept) != len(made):
        return [f"{len(made)} rows in place of {len(kept)}"]
    found = []
    for old, new in zip(kept, made):
        for key in keys:
            a, b = float(old[key]), float(new[key])
            if abs(a - b) > share * max(abs(a), abs(b), 1e-3):
                found.append(f"{old.get('scene', '')} {old.get('common', '')} {key}: {b:.5g} in place of {a:.5g}")
    return found


def write_rows(path, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8", newline="") as table:
        writer = csv.DictWriter(table, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def keep_or_compare(args, name, rows, keys, share):
    write_rows(args.out / f"{name}.csv", rows)
    kept = DATA / f"{name}.csv"
    if args.keep or not kept.exists():
        write_rows(kept, rows)
        return [] if args.keep else [f"{kept.relative_to(ROOT)} was not there and is new"]
    return compare_tables(rows_of(kept), rows, keys, share)


# ---- what is made

def tissue_settings(scene, column):
    """--set arguments that make the scene's soft muscles lines."""
    if column == "finite elements":
        return []
    text = re.sub(r"(?m)(^|\s)//.*$", "", (ROOT / "assets" / "scenes" / f"{scene}.json").read_text(encoding="utf-8"))
    tissue = json.loads(text)["tissue"]
    as_line = lambda model: "line" if model == "fem" else model
    muscles = {key: as_line(model) for key, model in tissue.get("muscles", {}).items()}
    whole = {"default": as_line(tissue["default"]), "muscles": muscles, "tendon": column.split()[1]}
    return ["--set", f"tissue={json.dumps(whole)}"]


def joint_stiffness(args):
    """README and paper, table of joint stiffness."""
    found = []
    columns = ["finite elements", "lines, elastic tendon", "lines, rigid tendon"]
    for scene, angle in SCENES.items():
        printed = {}
        for page in ("README.md", "paper/paper.md", "docs/accuracy.md"):
            row = re.search(rf"^\| `{scene}`[^|]*\|(.*)\|$", (ROOT / page).read_text(encoding="utf-8"), re.M)
            printed[page] = re.findall(r"[\d.]+ to [\d.]+", row[1]) if row else []
        made = []
        for index, column in enumerate(columns):
            folder = args.out / f"{scene}_{index}"
            settings = tissue_settings(scene, column.replace("lines, ", "lines "))
            run(args.program, "stiffness", scene, "--angles", angle, "--levels", "0,1", *settings, "--out", folder)
            K = [float(row["K_schur_Nm_rad"]) for row in rows_of(folder / "stiffness.csv")]
            made.append(f"{K[0]:.2f} to {K[1]:#.3g}")
            for page, cells in printed.items():
                if len(cells) != len(columns):
                    found.append(f"{page}: no row of {scene} with {len(columns)} cells")
                elif not all(map(as_printed, K, cells[index].split(" to "))):
                    found.append(f"{page}, {scene}, {column}: {K[0]:.4g} to {K[1]:.4g} in place of {cells[index]}")
        print(f"  | `{scene}` | {' | '.join(made)} |")
    return sorted(set(found))


def stiffness_curves(args):
    """Paper, figure 2: stiffness against co-contraction at three joints, three ways."""
    rows = []
    for scene, angle in SCENES.items():
        folder = args.out / f"{scene}_curve"
        run(args.program, "stiffness", scene, "--angles", angle, "--levels", "0:0.125:1", "--out", folder)
        for row in rows_of(folder / "stiffness.csv"):
            keys = ("common", "K_schur_Nm_rad", "K_perturbed_Nm_rad", "K_line_Nm_rad", "K_low_Nm_rad", "K_high_Nm_rad",
                    "held", "converged")
            rows.append({"scene": scene, **{key: row[key] for key in keys}})
    compared = ("K_schur_Nm_rad", "K_perturbed_Nm_rad", "K_line_Nm_rad")
    found = keep_or_compare(args, "stiffness_curves", rows, compared, 0.005)
    figures.draw_stiffness(rows, args.figures / "stiffness.png")
    return found


def validation(args):
    """README and paper, number of validated cases; paper, figure 3: error over tolerance of every check."""
    cases = json.loads(run(args.program, "validate", "--json"))["cases"]
    rows, failed = [], []
    for case in cases:
        for check in case["checks"]:
            if check.get("passed") is False:
                failed.append(f"{case['name']}, {check['quantity']}: {check['obtained']:.6g} is outside of its bound")
            if check.get("tolerance") and "value" in check:
                rows.append({"case": case["name"], "quantity": check["quantity"],
                             "share": f"{check['error'] / check['tolerance']:.4g}"})
    write_rows(args.out / "validation.csv", rows)
    figures.draw_validation(rows, args.figures / "validation.png")
    print(f"  {len(cases)} cases, {len(rows)} checks with a tolerance, {len(failed)} failed")
    for page, told in (("README.md", f"{len(cases)} analytic"), ("paper/paper.md", f"{len(cases)} cases"),
                       ("paper/paper.md", f"{len(rows)} checks")):
        if not re.search(rf"\b{told}", (ROOT / page).read_text(encoding="utf-8")):
            failed.append(f"{page} tells of no {told}")
    return failed


def fidelity(args):
    """Paper, figures of the elbow's script: difference, rotation, jitter."""
    folder = args.out / "fidelity"
    run(args.program, "fidelity", "elbow", "--out", folder)
    made = json.loads((folder / "fidelity.json").read_text(encoding="utf-8"))
    whole = made["compared"]["force"]
    text = " ".join((ROOT / "paper" / "paper.md").read_text(encoding="utf-8").split())
    printed = re.search(r"by ([\d.]+) % \(root mean square\), with ([\d.]+) mN of jitter", text)
    values = [100.0 * whole["error_rms_share"], 1000.0 * whole["noise_rms_N"]]
    print(f"  {values[0]:.2f} % RMS, {values[1]:.1f} mN of jitter")
    if not printed:
        return ["the paper names no such figures"]
    pairs = zip(values, printed.groups())
    return [f"{value:.4g} in place of {kept}" for value, kept in pairs if not as_printed(value, kept)]


def touch_map(args):
    """Paper, figure 4: touch at six random places of every muscle of the elbow. Some minutes."""
    folder = args.out / "map"
    run(args.program, "fidelity", "elbow", "--map", "--places", "6", "--seed", "1", "--out", folder)
    grades = [row["verdict"] for row in rows_of(folder / "touch_map.csv")]
    made = [grades.count(grade) for grade in ("good", "fair", "poor")]
    print("  good, fair, poor:", *made)
    sides = [folder / f"touch_map_{side}.png" for side in ("lateral", "medial")]
    figures.join_pictures(sides, args.figures / "touch_map.png")
    text = " ".join((ROOT / "paper" / "paper.md").read_text(encoding="utf-8").split())
    printed = re.search(r"(\d+) of 42 are good \([^)]*\), (\d+) fair, (\d+) poor", text)
    if printed and [int(one) for one in printed.groups()] == made:
        return []
    return [f"the paper tells of {printed and printed.groups()}"]


def pictures(args):
    """README and docs: the elbow and the whole forelimb with names."""
    found = []
    for scene in ("elbow", "forelimb"):
        made = args.out / f"{scene}.png"
        run(args.program, "run", scene, "--seconds", "0.01", "--levels", "none", "--size", "1000x1100", "--show",
            "labels=on", "lines=off", "--png", made, "--out", args.out / f"{scene}_run")
        found += figures.picture_difference(ROOT / "docs" / "pictures" / f"{scene}.png", made)
    return found


def animation(args):
    """README, the twenty seconds of co-contraction. Three minutes."""
    made = args.out / "co_contraction.webp"
    script = Path(__file__).with_name("animation.py")
    subprocess.run([sys.executable, script, args.program, made], check=True, stdout=subprocess.DEVNULL,
                   env=dict(os.environ, MYOTACT_DATA_DIR=str(ROOT)))
    return figures.picture_difference(ROOT / "docs" / "pictures" / "co_contraction.webp", made)


def recorded(args):
    """Paper, figures of speed: of a machine of their own, so compared with the recorded results they are from."""
    text = (ROOT / "paper" / "paper.md").read_text(encoding="utf-8")
    found = []
    for row in re.finditer(r"^\| ([^|]+) \|(.+)\| `(tests/bench/results/[^`]+)` \|$", text, re.M):
        source = (ROOT / row[3]).read_text(encoding="utf-8")
        for number in re.findall(r"\d[\d,.]*", row[2]):
            if not re.search(rf"(?<![\d.,]){re.escape(number.strip('.,'))}(?![\d])", source):
                found.append(f"{row[1].strip()}: {number} does not stand in {row[3]}")
    print("  window.png and class.png were taken by hand of a window and a browser, and are not made again")
    return found


ITEMS = [joint_stiffness, stiffness_curves, validation, fidelity, touch_map, pictures, animation, recorded]


def main():
    reader = argparse.ArgumentParser(description=__doc__)
    reader.add_argument("program")
    reader.add_argument("out", type=Path)
    reader.add_argument("names", nargs="*")
    reader.add_argument("--list", action="store_true", help="what there is, and go")
    reader.add_argument("--keep", action="store_true", help="what comes out becomes what is kept in paper/")
    args = reader.parse_intermixed_args()
    if args.list:
        for item in ITEMS:
            print(f"{item.__name__:18} {item.__doc__}")
        return 0
    unknown = set(args.names) - {item.__name__ for item in ITEMS}
    if unknown:
        print(f"there is no {', '.join(unknown)}; --list tells what there is", file=sys.stderr)
        return 2
    args.out.mkdir(parents=True, exist_ok=True)
    args.figures = ROOT / "paper" / "figures" if args.keep else args.out / "figures"
    args.figures.mkdir(parents=True, exist_ok=True)
    differing = 0
    for item in ITEMS:
        if args.names and item.__name__ not in args.names:
            continue
        print(f"{item.__name__}: {item.__doc__}", flush=True)
        start = time.monotonic()
        found = item(args)
        differing += bool(found)
        print(*(f"  differs: {one}" for one in found) if found else ["  as kept"], sep="\n")
        print(f"  {time.monotonic() - start:.0f} s", flush=True)
    return 1 if differing else 0


sys.exit(main())
