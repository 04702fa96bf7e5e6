#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Python code by itself: functions of the package and of the commands that draw say what they take and return, nothing needs a Python
newer than 3.9, and mypy, where it is installed, finds no contradiction."""

from __future__ import annotations

import ast
import builtins
import importlib.util
import os
import subprocess
import sys
import unittest

from tread.runs import ROOT

OLDEST = (3, 9)  # of doc/install.md and contrib/python/pyproject.toml
PACKAGE = os.path.join("contrib", "python", "tread")
# What came after it: modules, names in modules, arguments of functions.
NEWER_MODULES = {"tomllib"}
NEWER_NAMES = {"itertools.pairwise", "itertools.batched", "contextlib.chdir", "enum.StrEnum", "hashlib.file_digest", "datetime.UTC", "math.cbrt", "math.exp2",
               "math.sumprod", "self.enterContext", "unittest.addModuleCleanup", "unittest.enterModuleContext", "sys.stdlib_module_names", "sys.orig_argv",
               *(f"typing.{name}" for name in ("ParamSpec", "Concatenate", "TypeAlias", "TypeGuard", "Self", "Never", "assert_never", "assert_type", "override",
                                               "LiteralString", "Required", "NotRequired", "Unpack"))}
NEWER_BUILTINS = {"aiter", "anext", "ExceptionGroup", "BaseExceptionGroup", "EncodingWarning"}
NEWER_ARGUMENTS = {"zip": {"strict"}, "map": {"strict"}, "glob": {"root_dir", "dir_fd", "include_hidden"}, "iglob": {"root_dir", "dir_fd", "include_hidden"},
                   "dataclass": {"slots", "kw_only", "match_args", "weakref_slot"}, "bisect": {"key"}, "bisect_left": {"key"}, "bisect_right": {"key"},
                   "insort": {"key"}, "Popen": {"process_group", "pipesize"}, "run": {"process_group", "pipesize"},
                   "TemporaryDirectory": {"ignore_cleanup_errors", "delete"}}


def files():
    """Paths of all Python files from the root of the source, without those of builds and results, and not through links."""
    found = []
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [name for name in folders if not name.startswith(("build", "results", ".", "__"))]
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in names if name.endswith(".py")]
    return sorted(found)


def files_below(*folders):
    """Those of some folders."""
    return [path for path in files() if path.startswith(tuple(os.path.join(folder, "") for folder in folders))]


def text_of(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as stream:
        return stream.read()


def without_annotations(text):
    """["line: function: what has none"] of functions and methods that others may call."""
    missing = []

    def look(body, of_class):
        for node in body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                look(node.body, True)
            if not isinstance(node, ast.FunctionDef) or (node.name.startswith("_") and node.name != "__init__"):
                continue
            given = node.args
            arguments = given.posonlyargs + given.args
            if of_class and not any(isinstance(one, ast.Name) and one.id == "staticmethod" for one in node.decorator_list):
                arguments = arguments[1:]
            arguments = arguments + given.kwonlyargs + [one for one in (given.vararg, given.kwarg) if one]
            names = [one.arg for one in arguments if one.annotation is None]
            names += ["return"] if node.returns is None and node.name != "__init__" else []
            if names:
                missing.append(f"{node.lineno}: {node.name}: {', '.join(names)}")

    look(ast.parse(text).body, False)
    return missing


def newer_than_the_oldest(text):
    """["line: what"] of what a Python as old as OLDEST does not have."""
    try:
        tree = ast.parse(text, feature_version=OLDEST)
    except SyntaxError as error:
        return [f"{error.lineno}: {error.msg}"]
    found = []
    postponed = any(isinstance(node, ast.ImportFrom) and node.module == "__future__" and node.names[0].name == "annotations" for node in tree.body)
    types = {name for name in dir(builtins) if isinstance(getattr(builtins, name), type)} | {"None"}

    def is_type(node):
        return (isinstance(node, ast.Constant) and node.value is None) or (isinstance(node, ast.Name) and node.id in types) \
            or (isinstance(node, ast.Subscript) and is_type(node.value)) or (isinstance(node, ast.BinOp) and (is_type(node.left) or is_type(node.right)))

    def look(node, tried):
        if isinstance(node, ast.Try):  # an import that may fail
            tried = tried or any("ImportError" in ast.dump(handler.type) or "ModuleNotFoundError" in ast.dump(handler.type)
                                 for handler in node.handlers if handler.type)
        names = [alias.name for alias in node.names] if isinstance(node, (ast.Import, ast.ImportFrom)) else []
        module = [node.module] if isinstance(node, ast.ImportFrom) else names
        if not tried and NEWER_MODULES & {str(name) for name in module}:
            found.append(f"{node.lineno}: import of {', '.join(map(str, module))}")
        if isinstance(node, ast.ImportFrom) and not node.level and not tried:
            found.extend(f"{node.lineno}: {name}" for name in names if f"{node.module}.{name}" in NEWER_NAMES)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and f"{node.value.id}.{node.attr}" in NEWER_NAMES:
            found.append(f"{node.lineno}: {node.value.id}.{node.attr}")
        if isinstance(node, ast.Name) and node.id in NEWER_BUILTINS:
            found.append(f"{node.lineno}: {node.id}")
        if isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            newer = NEWER_ARGUMENTS.get(name, set()) & {keyword.arg for keyword in node.keywords}
            found.extend(f"{node.lineno}: {name}({argument}=...)" for argument in sorted(newer))
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr) and (is_type(node.left) or is_type(node.right)):
            found.append(f"{node.lineno}: types joined by |")
        for name, value in ast.iter_fields(node):
            # Annotations that are not evaluated may have newer forms.
            if postponed and name in ("annotation", "returns"):
                continue
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    look(child, tried)

    look(tree, False)
    return found


class Annotations(unittest.TestCase):
    def test_public_functions_have_them(self):
        paths = files_below(PACKAGE, "contrib/plot")
        self.assertGreater(len(paths), 50)
        for path in paths:
            with self.subTest(path):
                self.assertEqual(without_annotations(text_of(path)), [])

    def test_what_is_missing_is_found(self):
        for text, found in (("def f(a: int) -> int:\n  return a\n", []), ("def f(a):\n  pass\n", ["1: f: a, return"]), ("def _f(a):\n  pass\n", []),
                            ("def f(*a, b: int = 1, **c) -> None:\n  def inner(d):\n    pass\n", ["1: f: a, c"]),
                            ("class A:\n  def __init__(self, a):\n    pass\n  @staticmethod\n  def f(a) -> None:\n    pass\n", ["2: __init__: a", "5: f: a"])):
            self.assertEqual(without_annotations(text), found, text)


class Version(unittest.TestCase):
    def test_nothing_needs_a_newer_python(self):
        paths = files()
        self.assertGreater(len(paths), 100)
        for path in paths:
            with self.subTest(path):
                self.assertEqual(newer_than_the_oldest(text_of(path)), [])

    def test_what_is_newer_is_found(self):
        for text in ("match a:\n  case 1:\n    pass\n", "try:\n  pass\nexcept* OSError:\n  pass\n", "import tomllib\n", "from tomllib import load\n",
                     "from itertools import pairwise\n", "zip(a, b, strict=True)\n", "import glob\nglob.glob('*', root_dir='x')\n", "hashlib.file_digest(a, 'md5')\n", "try:\n  a()\nexcept ExceptionGroup:\n  pass\n",
                     "@dataclass(slots=True)\nclass A:\n  pass\n", "def f(a: int | None):\n  pass\n", "a: dict[str, int] | None = None\n",
                     "isinstance(a, int | str)\n", "from __future__ import annotations\nPlace = tuple[float, float] | None\n"):
            self.assertEqual(len(newer_than_the_oldest(text)), 1, text)
        for text in ("from __future__ import annotations\ndef f(a: int | None) -> str | None:\n  b: int | None = a\n", "a = {1} | {2}\n", "a = b | c\n",
                     "try:\n  import tomllib\nexcept ImportError:\n  import tomli\n", "os.chmod(a, 0o1 | 0o2)\n", "os.chdir(a)\n",
                     "from __future__ import annotations\na: dict[str, int] | None = None\n"):
            self.assertEqual(newer_than_the_oldest(text), [], text)

    def test_pages_and_the_package_say_so(self):
        text = ".".join(map(str, OLDEST))
        for path, words in (("doc/install.md", f"need Python {text} or later"), ("contrib/python/pyproject.toml", f'requires-python = ">={text}"'),
                            ("contrib/python/pyproject.toml", f'python_version = "{text}"'), ("contrib/package/package.cmake", f"python3 (>= {text})")):
            self.assertIn(words, text_of(path), path)


@unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed; on Debian: apt-get install mypy")
class Types(unittest.TestCase):
    """As contrib/python/pyproject.toml has it. It knows the standard library of the oldest Python."""

    def mypy(self, *paths):
        return subprocess.run([sys.executable, "-m", "mypy", "--config-file", os.path.join(ROOT, "contrib", "python", "pyproject.toml"), "--cache-dir", os.devnull,
                               *paths], cwd=ROOT, capture_output=True, text=True)

    def test_nothing_contradicts(self):
        commands = [path for path in files() if os.path.dirname(path) in ("contrib", os.path.join("contrib", "plot"))]
        result = self.mypy(PACKAGE, *commands)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
