#!/usr/bin/env python3
"""animation.py MYOTACT FILE.webp: twenty seconds of the elbow's co-contraction, at rest, up to full and back.

Every frame is one run of the scene `elbow` at rest at a level: the picture, the joint's angle and its stiffness K are
the program's, and so is the curve. Needs python3-pil.
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

LEVELS = [k / 20 for k in range(21)]
WIDTH, HEIGHT = 640, 480  # of the animation
SHOW = ["labels=off", "lines=off", "colour=activation", "faded=triceps_brachii_long,triceps_brachii_lateral"]
INK, PALE, PAPER, FLEX, EXTEND = "#2b2b2b", "#c9c9c9", "#f4f6f8", "#c8963c", "#4a7fa5"


def font(size, bold=False):
    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(f"/usr/share/fonts/truetype/dejavu/{name}", size)


def measure(program, level, folder):
    """The scene at rest at this level: picture and the last row of its table."""
    picture = folder / f"{level}.png"
    subprocess.run([program, "run", "elbow", "--set", "script=[]", "--set", f"co_contraction.common={level}",
                    "--levels", "none", "--seconds", "0.2", "--size", "960x960", "--view", "medial", "--show", *SHOW,
                    "--png", picture, "--out", folder / "out"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(folder / "out" / "samples.csv", encoding="ascii") as table:
        row = list(csv.DictReader(table))[-1]
    return {"level": level, "picture": Image.open(picture).convert("RGB"), "K": float(row["elbow_K_Nm_rad"]),
            "angle": float(row["elbow_q_rad"]) * 57.29577951308232, "flexors": float(row["a_biceps_brachii"]),
            "extensors": float(row["a_triceps_brachii_medial"])}


def draw_bar(draw, top, name, share, colour):
    draw.text((270, top), name, INK, font(15))
    draw.rectangle((370, top + 3, 610, top + 16), outline=PALE)
    draw.rectangle((370, top + 3, 370 + round(240 * share), top + 16), fill=colour)


def draw_curve(draw, states, now):
    left, right, top, bottom = 300, 612, 270, 440
    largest = 10.0
    place = lambda s: (left + (right - left) * s["level"], bottom - (bottom - top) * s["K"] / largest)
    draw.line((left, top, left, bottom, right, bottom), fill=INK, width=1)
    for K in (0, 5, 10):
        y = bottom - (bottom - top) * K / largest
        draw.line((left - 4, y, left, y), fill=INK)
        draw.text((left - 8, y), str(K), INK, font(12), anchor="rm")
    draw.text((left - 28, top - 10), "K  N m/rad", INK, font(12), anchor="ls")
    draw.text(((left + right) / 2, bottom + 6), "co-contraction, 0 to 1", INK, font(12), anchor="mt")
    draw.line([place(s) for s in states], fill=PALE, width=3)
    done = [s for s in states if s["level"] <= now["level"]]
    if len(done) > 1:
        draw.line([place(s) for s in done], fill="#a23b2a", width=3)
    x, y = place(now)
    draw.ellipse((x - 6, y - 6, x + 6, y + 6), fill="#a23b2a")


def frame(states, now):
    image = Image.new("RGB", (WIDTH, HEIGHT), PAPER)
    limb = now["picture"].crop((320, 20, 640, 940))
    image.paste(limb.resize((round(320 * HEIGHT / 920), HEIGHT), Image.LANCZOS), (50, 0))
    draw = ImageDraw.Draw(image)
    draw.text((270, 18), "Both sides of the elbow contract.", INK, font(17, True))
    draw_bar(draw, 54, "flexors", now["flexors"], FLEX)
    draw_bar(draw, 80, "extensors", now["extensors"], EXTEND)
    angle = abs(round(now["angle"], 1))  # no -0.0
    draw.text((270, 116), f"The joint stays: turned by {angle:.1f}°.", INK, font(17, True))
    draw.text((270, 152), "Its stiffness grows:", INK, font(17, True))
    draw.text((270, 186), f"K = {now['K']:.1f} N m/rad", "#a23b2a", font(30, True))
    draw_curve(draw, states, now)
    return image


def main():
    program, target = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        states = [measure(program, level, Path(folder)) for level in LEVELS]
        for state in states:
            print(f"{state['level']:.2f}  K {state['K']:.3f} N m/rad, {state['angle']:+.6f} degrees", flush=True)
        order = states + states[-2::-1]
        lengths_ms = [2300] + [300] * 19 + [4000] + [300] * 19 + [2300]
        assert sum(lengths_ms) == 20000
        frames = [frame(states, state) for state in order]
        frames[0].save(target, save_all=True, append_images=frames[1:], duration=lengths_ms, loop=0, quality=80,
                       method=4)


main()
