# SPDX-License-Identifier: BSD-3-Clause
"""The Markdown pages of the tree and what stands in them; standard library alone, since tests read it too."""

import os
import re
import subprocess
import unicodedata
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CITATION = re.compile(r"\[([A-Z][A-Za-z]+(?:19|20)\d\d)\](?!\()")
FENCE = re.compile(r"^```(.*?)\n(.*?)^```$", re.M | re.S)
BIBLIOGRAPHY = ROOT / "docs/theory/bibliography.md"


def tracked(*suffixes):
    """Files of the tree that end so, sorted; of a tree without git all but hidden and built ones."""
    if (ROOT / ".git").exists():
        names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True)
        files = [ROOT / name for name in names.stdout.splitlines()]
    else:
        files = []
        for folder, below, names in os.walk(ROOT):
            below[:] = [name for name in below if name not in ("build", "demo", "evaluation", "node_modules") and name[0] != "."]
            files += [Path(folder) / name for name in names]
    return sorted(file for file in files if file.suffix in suffixes and file.is_file())


def plugin_pages():
    return sorted(ROOT.glob("plugins/*/*/*.md"))


def without_code(text):
    """The text with code blanked out, line numbers kept."""
    text = FENCE.sub(lambda block: "\n" * block.group(0).count("\n"), text)
    return re.sub(r"`[^`\n]*`", "", text)


def slug(heading):
    """The anchor that GitHub gives a heading."""
    words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    words = unicodedata.normalize("NFC", words).lower().strip()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def anchors(text):
    """Anchors of a page; a heading that comes again gets a number."""
    found = []
    blanked = FENCE.sub("", text)
    for heading in re.findall(r"^#{1,6} +(.*?)\s*$", blanked, re.M):
        name = slug(heading)
        count = sum(1 for other in found if re.fullmatch(re.escape(name) + r"(-\d+)?", other))
        found.append(f"{name}-{count}" if count else name)
    return found


def bibliography():
    """Keys of the bibliography, in the order of the page."""
    return re.findall(r"^- \*\*([A-Z][A-Za-z]+\d{4})\*\*", BIBLIOGRAPHY.read_text(), re.M)
