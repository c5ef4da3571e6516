#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What pages, headers and plugins cite is in docs/theory/bibliography.md, and all of that is cited somewhere.

Pages and public headers cite by key, [Gibson1998]; other sources may say (Gibson 1998), and descriptors "Gibson 1998".
"""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/docs"))
import pages

# (Curless and Levoy 1996), (splitmix64, Steele et al. 2014; de Givry 2005): author and year are the key.
IN_BRACKETS = re.compile(r"[(;]\s*(?:[a-z0-9]+,? )*([A-Z][\w-]+)[^0-9();]*?\s((?:19|20)\d\d)\b")


def name_and_year(words):
    """Allouche2015 of "anytime search: Allouche et al. 2015"; nothing where no year is named."""
    found = re.search(r"([A-Z][\w-]+).*?\b((?:19|20)\d\d)\b", words.rpartition(": ")[2], re.S)
    return found and found.group(1).replace("-", "") + found.group(2)


def cited(text):
    """Keys, the character where each stands, and whether it stands there in words."""
    for match in pages.CITATION.finditer(text):
        yield match.group(1), match.start(), False
    for match in IN_BRACKETS.finditer(re.sub(r"\n\s*///?", lambda comment: "\n".ljust(len(comment.group(0))), text)):
        yield match.group(1).replace("-", "") + match.group(2), match.start(), True
    for match in re.finditer(r"\.citation =\s*\"([^\"]*)\"", text):
        for part in match.group(1).split(";"):
            key = name_and_year(part)
            if key:
                yield key, match.start(), False


keys = pages.bibliography()
wrong = [f"the key {key} stands twice in the bibliography" for key in set(keys) if keys.count(key) > 1]
used = set()
public = pages.ROOT / "core/include"
for file in pages.tracked(".md", ".h", ".cpp"):
    name = file.relative_to(pages.ROOT)
    # Tests make citations up; examples and templates are projects of their own.
    if file == pages.BIBLIOGRAPHY or name.parts[0] in ("tests", "examples", "templates"):
        continue
    text = pages.without_code(file.read_text()) if file.suffix == ".md" else file.read_text()
    by_key = file.suffix == ".md" or public in file.parents
    for key, place, in_words in cited(text):
        used.add(key)
        if in_words and by_key:
            wrong.append(f"{name}:{text.count(chr(10), 0, place) + 1}: cite by key, [{key}]")
        if key not in keys:
            wrong.append(f"{name}:{text.count(chr(10), 0, place) + 1}: {key} is not in the bibliography")
wrong += [f"{key} is in the bibliography, and nothing cites it" for key in keys if key not in used]
print(*wrong, f"{len(keys)} entries, {len(wrong)} faults", sep="\n")
sys.exit(1 if wrong or not keys else 0)
