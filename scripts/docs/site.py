#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""site.py PROGRAM FOLDER: one browsable site of all pages, the models' pictures and the reference of the public headers.

Debian's Python, for its Markdown (python3-markdown-it); doxygen and graphviz besides.
"""

import html
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from markdown_it import MarkdownIt

import pages

HERE = Path(__file__).resolve().parent
KINDS = ["filters", "worksets", "shapes", "relations", "labelers"]
MODELS = ["cup", "airplane", "pipe-fitting", "plate", "neal-1999/cup", "neal-1999/airplane", "neal-1999/pipe-fitting"]
GUIDE = ["run", "models", "families", "report", "page", "evaluate", "sample", "meshes", "prepare", "problems", "reproducing", "plugins", "abi"]


def title(page):
    found = re.search(r"^# (.*)$", page.read_text(), re.M)
    return found.group(1).replace("`", "") if found else page.stem


def sections():
    """Headings of the sidebar, each with its pages."""
    docs = pages.ROOT / "docs"
    listed = [docs / f"guide/{name}.md" for name in GUIDE]
    guide = listed + sorted(set(docs.glob("guide/*.md")) - set(listed))
    yield "Guide", guide + sorted(docs.glob("guide/tutorials/*.md"))
    yield "Theory", sorted(docs.glob("theory/*.md"))
    yield "Measured", sorted(docs.glob("measured/*.md"))
    for kind in KINDS:
        yield kind.capitalize(), sorted(pages.ROOT.glob(f"plugins/{kind}/*/*.md"))
    yield "Project", [docs / "architecture.md", *(pages.ROOT / f"{name}.md" for name in ("CONTRIBUTING", "MIGRATION", "CHANGELOG")),
                      *sorted(pages.ROOT.glob("examples/**/*.md"))]


def place(page):
    """Where a page comes to lie in the site."""
    return Path("index.html") if page == pages.ROOT / "README.md" else page.relative_to(pages.ROOT).with_suffix(".html")


class Site:
    def __init__(self, folder):
        self.folder = folder
        self.sections = list(sections())
        self.pages = {pages.ROOT / "README.md"} | {page for _, group in self.sections for page in group}
        self.markdown = MarkdownIt("commonmark", {"html": True}).enable("table")

    def sidebar(self, here):
        up = os.path.relpath(self.folder, (self.folder / here).parent)
        lines = [f'<a class="home" href="{up}/index.html">Toposcope</a>', f'<a href="{up}/models.html">Models, drawn</a>',
                 f'<a href="{up}/reference/annotated.html">Reference of the headers</a>']
        for name, group in self.sections:
            inside = any(place(page) == here for page in group)
            lines.append(f"<details{' open' if inside or name == 'Guide' else ''}><summary>{name}</summary>")
            for page in group:
                mark = ' class="here"' if place(page) == here else ""
                lines.append(f'<a{mark} href="{up}/{place(page)}">{html.escape(title(page))}</a>')
            lines.append("</details>")
        return "\n".join(lines), up

    def write(self, here, name, body):
        sidebar, up = self.sidebar(here)
        file = self.folder / here
        file.parent.mkdir(parents=True, exist_ok=True)
        template = (HERE / "page.html").read_text()
        for key, value in {"TITLE": html.escape(name), "UP": up, "SIDEBAR": sidebar, "BODY": body}.items():
            template = template.replace(f"@{key}@", value)
        file.write_text(template)

    def target(self, page, link):
        """Where a page's link leads in the site; what is no page is copied along."""
        path, mark, anchor = link.partition("#")
        if not path or re.match(r"[a-z]+:", link):
            return link
        file = (page.parent / path).resolve()
        if file in self.pages:
            goal = place(file)
        else:
            goal = file.relative_to(pages.ROOT)
            if file.is_dir():
                shutil.copytree(file, self.folder / goal, dirs_exist_ok=True)
            else:
                (self.folder / goal).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, self.folder / goal)
        return os.path.relpath(self.folder / goal, (self.folder / place(page)).parent) + mark + anchor

    def render(self, page):
        text = page.read_text()
        tokens, anchors = self.markdown.parse(text), iter(pages.anchors(text))
        for token in tokens:
            if token.type == "heading_open":
                token.attrSet("id", next(anchors, ""))
            for child in token.children or []:
                for name in ("href", "src"):
                    if child.attrGet(name):
                        child.attrSet(name, self.target(page, child.attrGet(name)))
        body = self.markdown.renderer.render(tokens, self.markdown.options, {})
        up = os.path.relpath(self.folder, (self.folder / place(page)).parent)
        if page == pages.BIBLIOGRAPHY:
            body = re.sub(r"<strong>(\w+\d{4})</strong>", r'<strong id="\1">[\1]</strong>', body)
        else:
            body = pages.CITATION.sub(rf'<a href="{up}/docs/theory/bibliography.html#\1">[\1]</a>', body)
        self.write(place(page), title(page), re.sub(r"(<table>.*?</table>)", r'<div class="wide">\1</div>', body, flags=re.S))

    def models(self, program):
        body = "<h1>The shipped models, drawn</h1>\n<p>Made by <code>toposcope model show NAME --format dot | dot -Tsvg</code>.</p>\n"
        for name in MODELS:
            graph = subprocess.run([program, "model", "show", name, "--format", "dot"], capture_output=True, check=True).stdout
            drawn = self.folder / "models" / f"{name.replace('/', '-')}.svg"
            drawn.parent.mkdir(parents=True, exist_ok=True)
            drawn.write_bytes(subprocess.run(["dot", "-Tsvg"], input=graph, capture_output=True, check=True).stdout)
            body += f'<h2 id="{drawn.stem}">{name}</h2>\n<a href="models/{drawn.name}"><img src="models/{drawn.name}" alt="{name}"></a>\n'
        self.write(Path("models.html"), "Models", body)

    def reference(self):
        """The reference; doxygen's warnings, which go on the screen as they are."""
        run = subprocess.run(["doxygen", HERE / "Doxyfile"], cwd=pages.ROOT, env=dict(os.environ, SITE=str(self.folder)),
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=True)
        return [line.replace(f"{pages.ROOT}/", "") for line in run.stderr.splitlines() if "warning:" in line]

    def broken(self):
        """Links of the site to files or places that are not there."""
        ids = {}
        for file in self.folder.rglob("*.html"):
            if "reference" in file.parts[len(self.folder.parts):]:
                continue
            for link in re.findall(r'(?:href|src)="([^"]+)"', file.read_text()):
                if re.match(r"[a-z]+:", link):
                    continue
                path, _, anchor = html.unescape(link).partition("#")
                goal = (file.parent / path).resolve() if path else file
                if not goal.exists():
                    yield f"{file.relative_to(self.folder)}: there is no {link}"
                elif anchor and goal.suffix == ".html":
                    if goal not in ids:
                        ids[goal] = set(re.findall(r'(?:id|name)="([^"]+)"', goal.read_text()))
                    if anchor not in ids[goal]:
                        yield f"{file.relative_to(self.folder)}: no place {link}"


def main():
    program, folder = sys.argv[1], Path(sys.argv[2]).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    shutil.copy(HERE / "style.css", folder)
    site = Site(folder)
    for page in sorted(site.pages):
        site.render(page)
    site.models(program)
    warnings = site.reference()
    faults = list(site.broken())
    print(*warnings, *faults, sep="\n")
    print(f"{folder}/index.html: {len(site.pages)} pages, {len(warnings)} warnings of doxygen, {len(faults)} broken links")
    sys.exit(1 if warnings or faults else 0)


main()
