#!/usr/bin/env python3
"""docs_offline.py SITE: ends with 1 if a page or style of the built site loads anything from the network."""

import re
import sys
from pathlib import Path

# What a browser fetches by itself; a link that a person may follow is none of it.
LOADS = [
    re.compile(r"<(?:script|img|iframe|source|video|audio|embed)\b[^>]*\bsrc=[\"']?((?:https?:)?//[^\"'\s>]+)", re.I),
    re.compile(r"<link\b(?![^>]*\brel=[\"']?(?:canonical|next|prev))[^>]*\bhref=[\"']?((?:https?:)?//[^\"'\s>]+)", re.I),
    re.compile(r"url\([\"']?((?:https?:)?//[^\"')]+)", re.I),
    re.compile(r"@import\s+[\"']((?:https?:)?//[^\"']+)", re.I),
]

site = Path(sys.argv[1])
pages = [path for path in sorted(site.rglob("*")) if path.suffix in (".html", ".css")]
loads = [(path, url) for path in pages for one in LOADS for url in one.findall(path.read_text(encoding="utf-8"))]
for path, url in loads:
    print(f"{path.relative_to(site)} loads {url}", file=sys.stderr)
if not pages:
    print(f"no page in {site}", file=sys.stderr)
sys.exit(1 if loads or not pages else 0)
