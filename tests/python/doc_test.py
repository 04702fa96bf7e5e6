#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages: links lead somewhere, sections that pages name are there, doc/README.md lists every page, and the messages explained in doc/faq.md are the program's. Samples of measurements are what their script makes."""

import glob
import os
import re
import runpy
import unittest

from tread.runs import ROOT

PAGES = sorted(path for pattern in ("*.md", "doc/**/*.md", "contrib/*/README.md") for path in glob.glob(os.path.join(ROOT, pattern), recursive=True))
LINK = r"\]\(([^)\s]+)\)"


def text_of(path):
    with open(path, encoding="utf-8") as stream:
        return stream.read()


def prose(text):
    """Without blocks and pieces of code, in which brackets mean something else."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"(?m)^(?: {4}|\t).*$", "", text)
    return re.sub(r"`[^`\n]*`", "", text)


def headings(text):
    return re.findall(r"^#+ (.*)$", text, flags=re.MULTILINE)


def anchor(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def wrong_links(page, text):
    wrong = []
    for link in re.findall(LINK, prose(text)) + re.findall(r'<img [^>]*src="([^"]+)"', text):
        if "://" in link:
            continue
        path, _, place = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if not os.path.exists(target):
            wrong.append(f"{link}: there is no such file")
        elif place and place not in map(anchor, headings(text_of(target))):
            wrong.append(f"{link}: there is no such heading")
    return wrong


def wrong_sections(page, text):
    """Of places that are named behind a link: [a](b.md), "Heading"; [a](b.md), section 2; [a](b.md), 2.1; [a](b.md), (10)."""
    wrong = []
    for link, quoted, number, equation in re.findall(
            LINK.replace(r"[^)\s]+", r"[^)\s#]+\.md") + r',\s(?:"([^"]+)"|(?:section\s)?(\d+(?:\.\d+)?)(?![\w.]*\d)|\((\d+\w?)\))', text):
        target = os.path.join(os.path.dirname(page), link)
        if not os.path.exists(target):
            continue # said by wrong_links()
        there = text_of(target)
        titles = headings(there) + re.findall(r"(?m)^(?:- )?\*\*([^*]+)\*\*", there)
        if quoted and not any(" ".join(title.split()).startswith(quoted) for title in titles):
            wrong.append(f'{link}, "{quoted}": there is no such heading')
        if number and not any(re.match(re.escape(number) + r"[. ]", title) for title in titles):
            wrong.append(f"{link}, section {number}: there is no such heading")
        if equation and f"\\tag{{{equation}}}" not in there:
            wrong.append(f"{link}, ({equation}): there is no such equation")
    return wrong


class Pages(unittest.TestCase):
    def test_links(self):
        for page in PAGES:
            with self.subTest(page=os.path.relpath(page, ROOT)):
                self.assertEqual(wrong_links(page, text_of(page)), [])

    def test_sections(self):
        for page in PAGES:
            with self.subTest(page=os.path.relpath(page, ROOT)):
                self.assertEqual(wrong_sections(page, text_of(page)), [])

    def test_what_is_wrong_is_found(self):
        page = os.path.join(ROOT, "doc", "made-up.md")
        self.assertEqual(len(wrong_links(page, "[a](nothing.md) [b](method.md#nothing) ![c](pictures/no.png) `[d](no.md)` [e](method.md#2-cells)")), 3)
        self.assertEqual(len(wrong_sections(page, '[a](track.md), "No heading" [b](method.md), section 99 [c](verification.md), 2.99 [d](method.md), (99)')), 4)
        self.assertEqual(wrong_sections(page, '[a](track.md), "How many spans" [b](method.md), section 7 [c](verification.md), 2.1 [d](method.md), (7a)'), [])

    def test_every_page_is_listed(self):
        listed = re.findall(r"^- " + r"\[[^]]*" + LINK, text_of(os.path.join(ROOT, "doc", "README.md")), flags=re.MULTILINE)
        for page in glob.glob(os.path.join(ROOT, "doc", "**", "*.md"), recursive=True):
            if os.path.basename(page) != "README.md":
                self.assertIn(os.path.relpath(page, os.path.join(ROOT, "doc")), listed)

    def test_sources(self):
        keys = re.findall(r"^@\w+\{(\w+),", text_of(os.path.join(ROOT, "doc", "bibliography.bib")), flags=re.MULTILINE)
        for page in PAGES:
            for key in re.findall(r"\[([a-z]+\d{4})[],]", prose(text_of(page))):
                self.assertIn(key, keys, page)

    def test_samples(self):
        folder = os.path.join(ROOT, "prm", "tutorial", "measured")
        made = runpy.run_path(os.path.join(folder, "make-samples.py"))["samples"]()
        self.assertEqual(len(made), 4)
        for name, text in made.items():
            self.assertEqual(text_of(os.path.join(folder, name)), text, f"{name}: run make-samples.py")

    def test_next_steps_keep_the_results_of_each_other(self):
        """Each command of the README that writes has a folder of its own, and none that of the quickstart."""
        readme = text_of(os.path.join(ROOT, "README.md"))
        steps = re.search(r"## Next steps\n(.*?)\n\nFrom Python", readme, re.DOTALL)[1]
        quick = re.search(r"^results=(\S+)", text_of(os.path.join(ROOT, "contrib", "quickstart.sh")), re.MULTILINE)[1]
        folders, writers = [quick], 0
        for command in re.findall(r"^    (.*)$", steps, re.MULTILINE):
            command = command.partition(" #")[0]
            if ".prm" not in command or "--dry-run" in command:
                continue
            writers += 1
            named = re.search(r"--output (\S+)", command)
            self.assertTrue(named, f"{command}: it writes to the folder that other commands on this scene write to")
            folders.append(named[1])
        self.assertGreaterEqual(writers, 6)
        self.assertEqual(len(folders), len(set(folders)), folders)

    def test_scenes_of_a_page_have_a_folder_each(self):
        """The program refuses a folder that holds the finished run of another scene."""
        seen = 0
        for page in PAGES:
            scenes = {}
            for command in re.findall(r"(?m)^    (.*)$", text_of(page).replace("\\\n", " ")):
                command = command.partition(" #")[0]
                scene = re.match(r"(?:mpirun -np \d+ )?(?:build/source/)?tread (?:(run|reference|modes|contact-points|wear) )?(\S+\.prm)\b", command)
                if not scene or "--dry-run" in command:
                    continue
                named = re.search(r"--output (\S+)", command)
                folder = named[1] if named else "results" + (f"-{scene[1]}" if scene[1] not in (None, "run") else "")
                self.assertEqual(scenes.setdefault(folder, scene[2]), scene[2], f"{os.path.basename(page)}: two scenes write to {folder}")
                seen += 1
        self.assertGreater(seen, 60)

    def test_quickstart_builds_what_the_readme_uses(self):
        built = re.search(r"^cmake --build build --target (.*) -j", text_of(os.path.join(ROOT, "contrib", "quickstart.sh")), re.MULTILINE)[1].split()
        readme = text_of(os.path.join(ROOT, "README.md"))
        used = {"build/source/tread": "tread", "contrib/contact-inp.py": "tread_half_space"}
        for what, target in used.items():
            self.assertIn(what, readme)
            self.assertIn(target, built)
        for program in set(re.findall(r"build/\S+/(\w+)", re.sub(r"(?m)^.*-m venv.*$", "", readme))) - {"manual"}:
            self.assertIn(program, built)

    def test_messages(self):
        sources = [path for folder in ("source", "include") for ending in ("cc", "h") for path in glob.glob(f"{ROOT}/{folder}/**/*.{ending}", recursive=True)]
        said = re.sub(r'"\s*\n\s*"', "", "".join(map(text_of, sources))).replace("%%", "%")
        messages = re.findall(r"^\| `([^`]+)` \|", text_of(os.path.join(ROOT, "doc", "faq.md")), flags=re.MULTILINE)
        self.assertGreater(len(messages), 30)
        for message in messages:
            if message.startswith("mpirun"):
                continue # Open MPI's
            for part in message.split("..."):
                self.assertIn(part.strip(" ';"), said, message)


if __name__ == "__main__":
    unittest.main()
