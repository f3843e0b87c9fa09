# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Prepares the pages for MkDocs and checks the finished site. Utilities/docs.sh runs this script.

    docs.py pages PROJECT PAGES   copies the pages of the project and everything they link to
    docs.py links SITE            checks every link of the site, including anchors
"""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

PICTURES = {".png", ".jpg", ".svg", ".gif"}
LANGUAGES = {".py": "python", ".cxx": "cpp", ".h": "cpp", ".sh": "bash", ".cmake": "cmake", ".yml": "yaml"}
LINK = re.compile(r"(\]\()([^)\s]+)(\))")
FENCE = re.compile(r"^```.*?^```$|`[^`\n]+`", re.MULTILINE | re.DOTALL)
STYLE = """\
/* Wide tables and formulas scroll in their own box; pictures have a white ground, also at night. */
.md-grid { max-width: 76rem; }
.md-typeset { overflow-wrap: break-word; }
.md-typeset img { background: #fff; }
.md-typeset table:not([class]) td code, .md-typeset table:not([class]) th code { white-space: nowrap; }
.md-typeset table:not([class]) th { min-width: 3.5rem; }
@media screen and (max-width: 44em) { .md-typeset table:not([class]) td:nth-child(2) { min-width: 8rem; } }
"""


def files_of(project):
    listed = subprocess.run(["git", "-C", project, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            check=True, capture_output=True, text=True).stdout
    return {pathlib.PurePosixPath(name) for name in listed.split("\0")
            if name and (project / name).is_file()}


def code_block(project, file):
    language = "cmake" if file.name == "CMakeLists.txt" else LANGUAGES.get(file.suffix, "text")
    fence = "````"
    return f"{fence}{language}\n{(project / file).read_text()}{fence}\n"


class Pages:
    """Copies the pages of a project to a folder. Other files that they link to become pages as well."""

    def __init__(self, project, folder):
        self.project, self.folder = project, folder
        self.files = files_of(project)
        self.shown = set()

    def write(self, path, text):
        target = self.folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)

    def show(self, path):
        """Makes a page that shows a source file, or all files of a folder."""
        page = path.parent / f"{path.name.lstrip('.')}.md" # MkDocs leaves out what starts with a dot
        if path in self.shown:
            return page
        self.shown.add(path)
        inside = sorted(file for file in self.files if file.parent == path)
        if path in self.files:
            text = f"# {path.name}\n\n`{path}`\n\n{code_block(self.project, path)}"
        elif inside:
            text = f"# {path}\n\n" + "\n".join(
                f"## {file.name}\n\n{code_block(self.project, file)}" for file in inside)
        else:
            return None
        self.write(page, text)
        return page

    def link(self, page, address):
        """The address of a page's link in the site; the address itself if it need not change."""
        parts = urllib.parse.urlsplit(address)
        if parts.scheme or parts.netloc or not parts.path:
            return address
        depth = len(page.parent.parts)
        target = []
        for part in (*page.parent.parts, *urllib.parse.unquote(parts.path).rstrip("/").split("/")):
            if part == ".." and target:
                target.pop()
            elif part not in (".", ""):
                target.append(part)
        path = pathlib.PurePosixPath(*target)
        if path.suffix == ".md" or path.suffix in PICTURES:
            return address # MkDocs reports it if it is missing
        shown = path / "README.md" if path / "README.md" in self.files else self.show(path)
        if shown is None:
            sys.exit(f"{page}: broken link {address}")
        return "../" * depth + str(shown) + (f"#{parts.fragment}" if parts.fragment else "")

    def convert(self, page):
        text = (self.project / page).read_text()
        kept, result, last = [match.span() for match in FENCE.finditer(text)], [], 0
        for match in LINK.finditer(text):
            if any(start <= match.start() < end for start, end in kept):
                continue
            result += [text[last:match.start(2)], self.link(page, match[2])]
            last = match.end(2)
        self.write(page, "".join(result) + text[last:])

    def make(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        navigation = (self.project / "mkdocs.yml").read_text().split("\nnav:")[1]
        lost = [str(file) for file in sorted(self.files)
                if file.suffix == ".md" and not file.parts[0].startswith(".") and f": {file}\n" not in navigation]
        if lost:
            sys.exit(f"mkdocs.yml does not list these pages under nav: {', '.join(lost)}")
        for file in sorted(self.files):
            if file.parts[0].startswith("."):
                continue
            if file.suffix == ".md":
                self.convert(file)
            elif file.suffix in PICTURES:
                (self.folder / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(self.project / file, self.folder / file)
        self.write("site.css", STYLE)


class Links(html.parser.HTMLParser):
    """The links and the anchors of a page of the site."""

    def __init__(self, text):
        super().__init__()
        self.addresses, self.anchors = [], {""}
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.addresses.append((tag, value))
            elif name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)


def check_links(site):
    pages = {file.resolve(): Links(file.read_text()) for file in site.rglob("*.html")}
    wrong = []
    for file, links in sorted(pages.items()):
        if file.name == "404.html": # its addresses work only on a server
            continue
        for tag, address in links.addresses:
            parts = urllib.parse.urlsplit(address)
            name = file.relative_to(site.resolve())
            if parts.scheme or parts.netloc:
                # Links to other sites are fine, but nothing may be loaded from them: the site works without a network.
                if tag != "a" and parts.scheme != "data":
                    wrong.append(f"{name}: loads {address} from the network")
                continue
            target = (file.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else file
            if not target.is_file():
                wrong.append(f"{name}: broken link {address}")
            elif target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                wrong.append(f"{name}: {target.name} has no #{parts.fragment}")
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{len(pages)} pages, {sum(len(links.addresses) for links in pages.values())} links, {len(wrong)} broken")
    return 1 if wrong or not pages else 0


def main():
    match sys.argv[1:]:
        case ["pages", project, folder]:
            Pages(pathlib.Path(project), pathlib.Path(folder)).make()
            return 0
        case ["links", site]:
            return check_links(pathlib.Path(site))
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
