# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphinx: a site of the pages in doc/, built by contrib/manual.sh. The source folder is that of the project, so that links between pages, to files beside
doc/ and to pictures are the same here and where the pages are read one by one.
"""

import html
import os
import re
import unicodedata

from docutils import nodes

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def version_of_project():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as stream:
        return re.search(r"project\(tread VERSION (\S+)", stream.read()).group(1)


project = "tread"
author = "the authors of tread"
release = version_of_project()
extensions = ["myst_parser", "sphinx.ext.mathjax"]
root_doc = "doc/README"
include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE.md", "doc/*.md", "doc/**/*.md", "contrib/contact-data/README.md"]
exclude_patterns = [".git", "build*", "results*", "source", "include", "tests", "prm", "benchmarks", "doc/manual"]
myst_enable_extensions = ["dollarmath", "html_image"]
myst_heading_anchors = 3
html_theme = "sphinx_rtd_theme"
html_title = f"tread {release}"
html_extra_path = ["index.html"]  # leads to root_doc
html_static_path = ["wide.css"]
html_css_files = ["wide.css"]
html_copy_source = False
html_show_copyright = False
# Blocks of code are shell commands, parameter files and Python side by side.
highlight_language = "none"


def tables_of_contents(text):
    """The sections and links of doc/README.md as tables of contents, which Sphinx draws at the side."""
    tables = []
    for section in re.split(r"^## ", text, flags=re.MULTILINE)[1:]:
        caption, _, body = section.partition("\n")
        pages = [os.path.normpath(os.path.join("doc", link[:-3])) for link in re.findall(r"^- \[[^]]*\]\(([^)#]*\.md)\)", body, flags=re.MULTILINE)]
        if pages:
            tables.append("```{toctree}\n:hidden:\n:maxdepth: 2\n:caption: " + caption + "\n\n" + "".join(f"/{page}\n" for page in pages) + "```\n")
    return "\n".join(tables)


def complete(app, name, source):
    if name == root_doc:
        source[0] += "\n" + tables_of_contents(source[0])
    elif name == "LICENSE":  # plain text
        source[0] = f"# Licence\n\n```\n{source[0]}\n```\n"


def unwrap_equations(app, doctree):
    """Equations as they stand: Sphinx puts those with a line break into an environment in which equations have no numbers."""
    for equation in doctree.findall(nodes.math_block):
        equation.replace_self(nodes.raw("", f'<div class="math notranslate nohighlight">\\[{html.escape(equation.astext())}\\]</div>\n', format="html"))


def plain(text):
    """Without the marks of LaTeX."""
    text = re.sub(r"""\{?\\(["'~])\{?(\w)\}?\}?""", lambda m: unicodedata.normalize("NFC", m[2] + {'"': "\u0308", "'": "\u0301", "~": "\u0303"}[m[1]]), text)
    return " ".join(re.sub(r"[{}]", "", text.replace("{\\ss}", "\u00df").replace("\\&", "&").replace("--", "\u2013")).split())


def sources():
    """What doc/bibliography.bib says, by key: {field: text}."""
    with open(os.path.join(ROOT, "doc", "bibliography.bib"), encoding="utf-8") as stream:
        entries = re.findall(r"^@\w+\{(\w+),(.*?)^\}", stream.read(), flags=re.MULTILINE | re.DOTALL)
    field = r"(\w+)\s*=\s*\{((?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}"
    return {key: {name: plain(text) for name, text in re.findall(field, entry)} for key, entry in entries}


SOURCES = sources()


def link_sources(app, doctree):
    """[key] leads to its line in the list of sources."""
    page = app.builder.get_relative_uri(app.env.docname, "doc/bibliography")
    for text in list(doctree.findall(nodes.Text)):
        if isinstance(text.parent, (nodes.literal, nodes.literal_block, nodes.math, nodes.raw, nodes.reference)):
            continue
        parts = re.split(r"\[(" + "|".join(SOURCES) + r")(?=[],])", text.astext())
        if len(parts) > 1:
            new = [nodes.Text(parts[0])]
            for key, rest in zip(parts[1::2], parts[2::2]):
                source = SOURCES[key]
                title = ", ".join(source[name] for name in ("author", "title", "year") if name in source)
                new += [nodes.Text("["), nodes.reference("", key, refuri=f"{page}#{key}", reftitle=title), nodes.Text(rest)]
            text.parent.replace(text, new)


def page_of_sources(app):
    lines = []
    for key, source in sorted(SOURCES.items()):
        said = [f"<em>{html.escape(source[name])}</em>" if name in ("journal", "booktitle") else html.escape(source[name])
                for name in ("author", "title", "journal", "booktitle", "school", "publisher", "volume", "pages", "year", "note") if name in source]
        if "doi" in source:
            said.append(f'<a href="https://doi.org/{html.escape(source["doi"])}">{html.escape(source["doi"])}</a>')
        lines.append(f'<dt id="{key}">{key}</dt><dd>{", ".join(said)}</dd>\n')
    yield "doc/bibliography", {"title": "Bibliography", "body": "<h1>Bibliography</h1>\n<dl>\n" + "".join(lines) + "</dl>\n"}, "page.html"


def setup(app):
    app.connect("source-read", complete)
    app.connect("doctree-read", unwrap_equations)
    app.connect("doctree-read", link_sources)
    app.connect("html-collect-pages", page_of_sources)
