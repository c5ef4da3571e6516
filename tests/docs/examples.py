#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The examples of the pages work: examples.py [--renew] PROGRAM [PAGE...]

Each page runs in a folder of its own. A `yaml` block whose first line is `# NAME.yaml` is that file, a `sh` block is typed as
it stands, and every line of an `output` block comes in what the `sh` block before it printed, in this order: numbers
to 5 %, `...` for what differs from run to run. Every plugin's page has the section "Example"; every page of the guide has one that runs. With --renew, a line that is not
printed any more gives way to the most alike that is; read the change before it is kept.
"""

import difflib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/docs"))
import pages

# Typed by tests of the installed SDK (tests/sdk).
ELSEWHERE = {"docs/guide/plugins.md", "docs/guide/abi.md"}


def same_word(shown, printed):
    if shown == printed:
        return True
    try:
        return abs(float(shown.rstrip(",:%")) - float(printed.rstrip(",:%"))) <= 0.05 * abs(float(shown.rstrip(",:%")))
    except ValueError:
        return False


def same_line(shown, printed):
    shown, printed = shown.split(), printed.split()
    if "..." in shown:
        shown = shown[: shown.index("...")]
        printed = printed[: len(shown)]
    return len(shown) == len(printed) and all(map(same_word, shown, printed))


def missing_line(shown, printed):
    """The first line of the block that was not printed after the one before it; none: all were."""
    lines = iter(printed.splitlines())
    for line in shown.splitlines():
        if line.strip() not in ("", "...") and not any(same_line(line, other) for other in lines):
            return line
    return None


def renewed(shown, printed):
    """The block with each line that is not printed replaced by the most alike of those after the one before it."""
    rest, result = printed.splitlines(), []
    for line in shown.splitlines():
        if line.strip() not in ("", "..."):
            found = next((k for k, other in enumerate(rest) if same_line(line, other)), None)
            if found is None:
                words = line.split()
                found = max(range(len(rest)), default=None,
                            key=lambda k: (rest[k].split()[:1] == words[:1], difflib.SequenceMatcher(None, line, rest[k]).ratio()))
                if found is None:
                    return shown
                line = rest[found]
                if "..." in words:
                    kept = list(re.finditer(r"\S+", line))[: words.index("...")]
                    line = line[: kept[-1].end()] + " ..." if kept else "..."
            rest = rest[found + 1:]
        result.append(line)
    return "\n".join(result) + "\n"


def try_page(page, folder, environment, renew):
    """Faults of a page and the number of its blocks that ran."""
    text, printed, ran = page.read_text(), None, 0
    for language, block in pages.FENCE.findall(text):
        name = re.match(r"# ([\w-]+\.yaml)\n", block)
        if language == "yaml" and name:
            (folder / name.group(1)).write_text(block)
        elif language == "sh":
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", block], cwd=folder, env=environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
            printed, ran = done.stdout, ran + 1
            if done.returncode:
                return [f"exit code {done.returncode}:\n{block}{printed}"], ran
        elif language == "output":
            line = missing_line(block, printed or "")
            if line is not None and renew:
                page.write_text(page.read_text().replace(block, renewed(block, printed or "")))
            elif line is not None:
                return [f"not printed: {line}\nbut:\n{printed}"], ran
    return [], ran


def main():
    arguments = [word for word in sys.argv[1:] if word != "--renew"]
    renew = len(arguments) < len(sys.argv) - 1
    program, *named = arguments
    environment = dict(os.environ, PATH=f"{Path(program).resolve().parent}:{os.environ['PATH']}", LC_ALL="C.UTF-8")
    chosen = [Path(name).resolve() for name in named] or pages.tracked(".md")
    faults = blocks = 0
    with tempfile.TemporaryDirectory() as work:
        for page in chosen:
            name = str(page.relative_to(pages.ROOT))
            if name in ELSEWHERE or name.startswith(("docs/guide/tutorials/", "examples/", "templates/")):
                continue
            folder = Path(work) / name.replace("/", "_")
            folder.mkdir()
            wrong, ran = try_page(page, folder, environment, renew)
            if name.startswith(("docs/guide/", "plugins/")) and not ran:
                wrong.append("no example: a `sh` block is missing")
            if name.startswith("plugins/") and "\n## Example\n" not in page.read_text():
                wrong.append("the section '## Example' is missing")
            faults, blocks = faults + len(wrong), blocks + ran
            for fault in wrong:
                print(f"{name}: {fault}")
    print(f"{blocks} examples, {faults} faults")
    sys.exit(1 if faults or not blocks else 0)


main()
