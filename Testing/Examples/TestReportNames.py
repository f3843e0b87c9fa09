# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What a report is given to show is shown, and neither becomes HTML nor leads out of its folder."""
import html.parser
import pathlib

from ExampleTesting import examples, output, sys

sys.path[:0] = [str(examples), str(examples.parent / "ReproduceThesis")]
import report  # noqa: E402, found there

EVIL = "../../<script>alert('&amp;')</script>\"><img src=x onerror=alert(1)>\n{0}%s$\\frac"


@report.experiment("A4.1", title=EVIL, where=EVIL, claim=EVIL)
def shows(section, context):
    section.text(EVIL)
    section.table(EVIL, [EVIL], [[EVIL], ["=1+1"]], caption=EVIL)
    section.check(True, EVIL, EVIL)
    section.verdict(why=EVIL)


@report.experiment("A4.2", title="breaks off", where="", claim="")
def breaks_off(section, context):
    raise report.model_files.ModelError(EVIL)


class Tags(html.parser.HTMLParser):
    """Of a page, with their attributes, and its text."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.text = [], ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_data(self, text):
        self.text += text


def files_in(folder):
    return sorted(file.relative_to(folder).as_posix() for file in folder.rglob("*"))


def write(folder):
    sections = [report.run(experiment, None, folder) for experiment in report.EXPERIMENTS]
    report.write(folder, sections, [(EVIL, EVIL)])
    return [section.verdicts for section in sections]


folder = output / "report"
folder.mkdir()
write(folder)
numbers, = (folder / "numbers").iterdir()
assert files_in(folder) == ["chapter-4.html", "index.html", "numbers", f"numbers/{numbers.name}"], files_in(folder)
assert files_in(output) == ["report"] + [f"report/{file}" for file in files_in(folder)]
for page, times in (("index.html", 4), ("chapter-4.html", 13)):
    read = Tags((folder / page).read_text(encoding="utf-8"))
    assert not {"script", "img"} & {tag for tag, _ in read.tags}, page
    assert not any(name.startswith("on") for _, attributes in read.tags for name in attributes), page
    for _, attributes in read.tags:
        link = attributes.get("href", "#").split("#")[0]
        assert not link or (folder / link).resolve().is_relative_to(folder.resolve()), link
    assert read.text.count(EVIL) == times, (page, read.text.count(EVIL))

# Links in the folder: pages are replaced, and folders that lead elsewhere break the experiment off.
elsewhere, linked = output / "elsewhere", output / "linked"
elsewhere.mkdir()
linked.mkdir()
(elsewhere / "kept").write_text("kept", encoding="utf-8")
(linked / "numbers").symlink_to(elsewhere, target_is_directory=True)
(linked / "index.html").symlink_to(elsewhere / "kept")
(linked / "chapter-4.html").symlink_to(elsewhere / "new")
verdicts = write(linked)
assert verdicts[0]["A4.1"][0] == report.FAILED and "leads out of" in verdicts[0]["A4.1"][1], verdicts
assert files_in(elsewhere) == ["kept"] and pathlib.Path(elsewhere / "kept").read_text(encoding="utf-8") == "kept"
assert not (linked / "index.html").is_symlink() and not (linked / "chapter-4.html").is_symlink()
