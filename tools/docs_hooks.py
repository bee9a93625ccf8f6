"""What MkDocs does with the pages of docs/ besides: formulas become MathML, links out of docs/ paths.

$...$ in a line and $$...$$ in a paragraph of its own are formulas, which pandoc turns into MathML, so that no script
draws them. A link to a file outside of docs/ leads somewhere in the repository and nowhere in the site: there it is the
path, as code; a picture from outside is taken along.
"""

import re
import subprocess
from pathlib import Path

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.S | re.M)
DISPLAY = re.compile(r"\$\$(.+?)\$\$", re.S)
INLINE = re.compile(r"(?<![\\$\w])\$([^$\s](?:[^$\n]*[^$\s])?)\$(?![\w$])")
PICTURE = re.compile(r"(!\[[^\]]*\])\((\.\./[^)\s]+)\)")
TAG = re.compile(r"\\tag\{(\w+)\}")
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\((\.\./[^)\s#]+)[^)]*\)")


def mathml_of(formulas, page):
    """One pandoc for all formulas of a page: each a paragraph of its own."""
    if not formulas:
        return []
    text = "\n\n".join(f"$${tex.strip()}$$" if display else f"${tex.strip()}$" for tex, display in formulas)
    run = subprocess.run(["pandoc", "--from=markdown", "--to=html", "--mathml", "--wrap=none"], input=text, text=True,
                         capture_output=True, check=False)
    found = re.findall(r"<math.*?</math>", run.stdout, re.S)
    if run.returncode != 0 or run.stderr or len(found) != len(formulas):
        raise PluginError(f"{page}: pandoc read {len(found)} of {len(formulas)} formulas. {run.stderr.strip()}")
    # The TeX beside it doubles what the search finds. Brackets grow around what is tall only.
    bare = [re.sub(r"<annotation.*?</annotation>", "", one, flags=re.S) for one in found]
    return [one if "\\left" in tex or "\\begin" in tex else one.replace('stretchy="true"', 'stretchy="false"')
            for one, (tex, _) in zip(bare, formulas)]


def on_page_markdown(markdown, page, config, files):
    """Puts a mark in the place of each formula, which Markdown leaves alone; they wait in the page's meta."""
    kept, formulas = [], []

    def keep(text):
        kept.append(text)
        return f"\ue000{len(kept) - 1}\ue001"

    def hold(tex, display):
        formulas.append((tex, display))
        return f"\ue002{len(formulas) - 1}\ue003"

    def place_of(link):
        target = (Path(page.file.abs_src_path).parent / link[2]).resolve()
        if not target.is_relative_to(ROOT) or not target.exists():
            raise PluginError(f"{page.file.src_path}: the link {link[2]} leads nowhere")
        return target, target.relative_to(ROOT).as_posix()

    def take_along(picture):
        _, path = place_of(picture)
        if files.get_file_from_path(path) is None:
            files.append(File(path, str(ROOT), config["site_dir"], config["use_directory_urls"]))
        up = "../" * page.file.src_path.count("/")
        return f"{picture[1]}({up}{path})"

    def path_of(link):
        target, path = place_of(link)
        return f"`{path}`" if link[1].strip("`") in (path, link[2], target.stem) else f"{link[1]} (`{path}`)"

    text = CODE.sub(lambda m: keep(m[0]), markdown)
    text = PICTURE.sub(take_along, text)
    text = LINK.sub(path_of, text)
    text = DISPLAY.sub(lambda m: hold(m[1], True), text)
    text = INLINE.sub(lambda m: hold(m[1], False), text)
    page.meta["formulas"] = formulas
    return re.sub("\ue000(\\d+)\ue001", lambda m: kept[int(m[1])], text)


def on_page_content(html, page, config, files):
    formulas = page.meta.pop("formulas", [])
    numbers = [TAG.search(tex) for tex, _ in formulas]
    mathml = mathml_of([(TAG.sub("", tex), display) for tex, display in formulas], page.file.src_path)

    def put(match):
        one = int(match[1])
        if not formulas[one][1]:
            return mathml[one]
        number = numbers[one]
        label = f'<a class="number" href="#eq-{number[1]}">({number[1]})</a>' if number else ""
        place = f' id="eq-{number[1]}"' if number else ""
        return f'<span class="equation"{place}>{mathml[one]}{label}</span>'

    return re.sub("\ue002(\\d+)\ue003", put, html)
