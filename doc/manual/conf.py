# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphinx: a site of the pages in doc/, built by contrib/manual.sh. The source folder is that of the project, so that links between pages, to files beside
doc/ and to pictures are the same here and where the pages are read one by one.
"""

import html
import os
import re

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
include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE.md", "doc/*.md", "contrib/contact-data/README.md"]
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


def setup(app):
    app.connect("source-read", complete)
    app.connect("doctree-read", unwrap_equations)
