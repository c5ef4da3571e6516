#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""links.py [FOLDER]: every link of every Markdown page to a file of the tree, or to a heading of a page, leads somewhere. Of
a folder, such as that of installed pages, all pages below it, and links may not leave it."""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/docs"))
import pages

LINK = re.compile(r"\]\(([^)\s]+)(?: \"[^\"]*\")?\)")

broken = []
links = 0
root = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pages.ROOT
for page in sorted(root.rglob("*.md")) if len(sys.argv) > 1 else pages.tracked(".md"):
    text = pages.without_code(page.read_text())
    for match in LINK.finditer(text):
        target, _, anchor = match.group(1).partition("#")
        if re.match(r"[a-z]+:", target):
            continue
        links += 1
        file = (page.parent / target).resolve() if target else page
        place = f"{page.relative_to(root)}:{text.count(chr(10), 0, match.start()) + 1}"
        if not file.exists() or not file.is_relative_to(root):
            broken.append(f"{place}: there is no {target}")
        elif anchor and anchor not in pages.anchors(file.read_text()):
            broken.append(f"{place}: {target or 'the page'} has no heading #{anchor}")
print(*broken, f"{links} links, {len(broken)} broken", sep="\n")
sys.exit(1 if broken or not links else 0)
