#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""run.py PROGRAM SHIM [--points N] [--kinds KIND,...]: a run of a small mesh in which one call fails, over and over.

The calls are allocations, writes, opens and renames (fail_nth.c). Each run must end with a documented exit code and, where that
is not 0, a message that is no "internal error"; every file that it leaves is whole, and no temporary one is left. Without
--points each place of the program that makes such a call fails once; with it so many of them, evenly spread over each kind.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

DOCUMENTED = {0, 1, 2, 3, 4}
SECONDS = 60


def arguments(mesh, out):
    return ["run", mesh, "--model", "cup", "--out", out / "out", "--lock", out / "run.lock", "--save-problem",
            out / "problem.json", "--features", out / "features.csv", "--threads", "1"]


def run(options, mesh, folder, **environment):
    (folder / "tmp").mkdir(parents=True)
    everything = os.environ | {"LD_PRELOAD": str(options.shim), "TMPDIR": str(folder / "tmp")} | environment
    return subprocess.run([options.program, *arguments(mesh, folder)], env=everything, capture_output=True, text=True,
                          errors="replace", timeout=SECONDS, check=False)


def files_below(folder):
    return {str(path.relative_to(folder)): path for path in folder.rglob("*") if not path.is_dir()}


def without_times(document):
    if isinstance(document, dict):
        return {key: without_times(value) for key, value in document.items() if key not in ("timings", "timings_ms")}
    return [without_times(each) for each in document] if isinstance(document, list) else document


def whole(path, reference, done):
    """Whether a file says what it says where nothing fails, but for how long it took."""
    content, expected = path.read_bytes(), reference.read_bytes()
    if path.suffix in (".json", ".lock"):
        try:
            content, expected = without_times(json.loads(content)), without_times(json.loads(expected))
        except ValueError:
            return False
        # A truth that cannot be read costs a warning, and its marks.
        return content == expected or (path.name == "scene.json" and "its marks are not shown" in done.stderr)
    if path.suffix == ".html":
        return content.rstrip().endswith(b"</html>")
    if path.suffix == ".csv" and done.returncode != 0:  # the head and rows of the meshes that were done
        return content.endswith(b"\n")
    return content == expected


def faults_of(point, folder, options, mesh, reference):
    """What is wrong with the run in which this call fails."""
    try:
        done = run(options, mesh, folder, FAIL=point)
    except subprocess.TimeoutExpired:
        return [f"has not ended after {SECONDS} s"]
    faults = []
    if done.returncode not in DOCUMENTED:
        faults.append(f"exit code {done.returncode}: {done.stderr[-300:]}")
    elif done.returncode != 0 and not done.stderr.strip():
        faults.append(f"exit code {done.returncode} without a message")
    if "internal error" in done.stderr:
        faults.append("internal error: " + done.stderr[-300:])
    left, expected = files_below(folder), files_below(reference)
    for name, path in left.items():
        if name not in expected:
            faults.append(f"leaves {name}")
        elif not whole(path, expected[name], done):
            faults.append(f"exit code {done.returncode}: {name} is not whole or says something else")
    missing = sorted(set(expected) - set(left))
    if done.returncode == 0 and missing and not all(name.split("/")[-1] in done.stderr for name in missing):
        faults.append("exit code 0 without " + ", ".join(missing))
    return faults


def spread(points, count):
    """So many of the points, of each kind in proportion to the root of their number, the first and last among them."""
    kinds = {}
    for point in points:
        kinds.setdefault(point.split(":")[0], []).append(point)
    roots = {kind: len(all_of_it) ** 0.5 for kind, all_of_it in kinds.items()}
    chosen = []
    for kind, all_of_it in kinds.items():
        n = min(len(all_of_it), max(2, round(count * roots[kind] / sum(roots.values()))))
        chosen += [all_of_it[round(i * (len(all_of_it) - 1) / max(1, n - 1))] for i in range(n)]
    return chosen


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("shim", type=pathlib.Path)
    parser.add_argument("--points", type=int)
    parser.add_argument("--kinds", default="alloc,write,open,rename")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        top = pathlib.Path(scratch)
        mesh, reference, places = top / "cup.ply", top / "reference", top / "places"
        subprocess.run([options.program, "sample", "cup", "--faces", "1200", "-o", mesh], check=True, capture_output=True)
        done = run(options, mesh, reference, FAIL_LIST=str(places))
        if done.returncode != 0:
            sys.exit(f"the run fails by itself, with exit code {done.returncode}: {done.stderr}")
        points = [":".join(line.split()) for line in places.read_text().splitlines()]
        points = [point for point in points if point.split(":")[0] in options.kinds.split(",")]
        found = len(points)
        if options.points:
            points = spread(points, options.points)
        failed = 0

        def examine(point):
            with tempfile.TemporaryDirectory(dir=top) as folder:
                return faults_of(point, pathlib.Path(folder) / "run", options, mesh, reference)

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for point, faults in zip(points, pool.map(examine, points)):
                for fault in faults:
                    print(f"FAIL={point}: {fault}")
                failed += bool(faults)
        print(f"{len(points)} of {found} places, {failed} with faults")
        sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
