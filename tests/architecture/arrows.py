#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""arrows.py SOURCE [--write]: compares the includes between folders with the arrows that docs/architecture.md draws.

An arrow is drawn as `from -> to, to` in the block below the heading "Arrows". --write draws those that there are.
"""
import os
import pathlib
import re
import sys

FLOORS_WITH_ROOMS = ("core/kernel", "core/study", "core/show", "core/problem", "core/include/toposcope")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
BLOCK = re.compile(r"(^## Arrows\n.*?^```[a-z]*\n)(.*?)(^```$)", re.MULTILINE | re.DOTALL)


def room(path: pathlib.PurePath) -> str:
    """The folder that a file counts for: plugins/<kind>/<id> is one, a library with rooms has one for each."""
    folder = path.parent.as_posix()
    if folder.startswith("plugins/"):
        return "/".join(path.parts[:3])
    for floor in FLOORS_WITH_ROOMS:
        if folder.startswith(floor):
            return "/".join(path.parts[: len(floor.split("/")) + 1]) if folder != floor else floor
    return "/".join(path.parts[:2])


def short(name: str) -> str:
    return name.removeprefix("core/include/").removeprefix("core/")


def find_arrows(source: pathlib.Path):
    """(file, room, included room) of each include of one of the tree's own headers, by the folders that a file may see."""
    files = [p.relative_to(source) for top in ("core", "plugins") for p in sorted((source / top).rglob("*"))
             if p.suffix in (".h", ".cpp")]
    known = {p.as_posix() for p in files}
    for path in files:
        seen = [path.parent.as_posix(), "core/include", "core/kernel", "core/problem", "core/conformance", "core/study",
                "core/show", "core/geometry", "core/labeling", *{"/".join(path.parts[:i]) for i in range(1, len(path.parts))}]
        for name in INCLUDE.findall((source / path).read_text()):
            places = [os.path.normpath(f"{folder}/{name}") for folder in seen] + [name]
            target = next((p for p in places if p in known), None)
            if target is None:
                yield path, room(path), None, name
            else:
                yield path, room(path), room(pathlib.PurePosixPath(target)), name


def circle(arrows):
    """A chain of rooms that leads back to its first, or nothing."""
    done, chain = set(), []

    def visit(at):
        if at in chain:
            return chain[chain.index(at):] + [at]
        if at in done:
            return None
        chain.append(at)
        for to in sorted(arrows.get(at, ())):
            if found := visit(to):
                return found
        chain.pop()
        done.add(at)
        return None

    return next((found for at in sorted(arrows) if (found := visit(at))), None)


def drawn_arrows(block: str):
    drawn = {}
    for line in filter(str.strip, block.splitlines()):
        at, _, to = line.partition("->")
        drawn[at.strip()] = {name.strip() for name in to.split(",") if name.strip()}
    return drawn


def main() -> int:
    source = pathlib.Path(sys.argv[1])
    page = source / "docs/architecture.md"
    faults, arrows = [], {}
    for path, at, to, name in find_arrows(source):
        if to is None:
            faults.append(f'{path}: "{name}" is no header of the tree; name it by its path below the folder of its library')
        elif at.startswith("plugins/") and to.startswith("plugins/") and at != to:
            faults.append(f'{path}: a plugin includes "{name}" of another; move what both need to core/include/toposcope')
        elif at.startswith("core/") and to.startswith("plugins/"):
            faults.append(f'{path}: core includes "{name}" of a plugin; a plugin is loaded, never included')
        elif at != to:
            at = "/".join(at.split("/")[:2]) if at.startswith("plugins/") else at
            arrows.setdefault(short(at), set()).add(short(to))
    if found := circle(arrows):
        faults.append("a circle of folders: " + " -> ".join(found) + "; move what the first needs to a folder below both")
    text = page.read_text()
    block = BLOCK.search(text)
    if block is None:
        print(f'{page}: there is no block below the heading "Arrows"; draw the arrows there, one line for each folder')
        return 1
    if "--write" in sys.argv:
        lines = "".join(f"{at} -> {', '.join(sorted(arrows[at]))}\n" for at in sorted(arrows))
        page.write_text(text[: block.start(2)] + lines + text[block.end(2):])
        return 0
    drawn = drawn_arrows(block[2])
    for at in sorted(arrows.keys() | drawn.keys()):
        for to in sorted(arrows.get(at, set()) - drawn.get(at, set())):
            faults.append(f"{at} -> {to} is not drawn in {page.name}: take the include out, or draw it and say why")
        for to in sorted(drawn.get(at, set()) - arrows.get(at, set())):
            faults.append(f"{at} -> {to} is drawn in {page.name} and no file includes so: take the arrow out")
    print("\n".join(faults))
    return 1 if faults else 0


sys.exit(main())
