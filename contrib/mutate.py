#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Test the tests: put small faults into a copy of the sources, one at a time, and see which the tests notice.

The faults are listed in tests/mutations/*.toml: the file, the text `old`, which occurs in it once, what takes its
place, and the tests that should notice it. All of them are compiled into one program; the environment variable
TREAD_FAULT chooses the one that acts. `old` that ends in ';' is whole statements, anything else an expression.

  contrib/mutate.py --check               the places of all faults are there (no build)
  contrib/mutate.py                       build in build-mutations, try the faults not noticed yet, fill doc/dev/records/mutations.md
  contrib/mutate.py --only contact-       try some of them (again)

Ctrl-C ends it after the tests that run, with what was found so far in the page.

A fault counts as noticed when a test near it fails or takes longer than its limit. Each test that noticed one must
pass without any fault. A fault that no test can notice says why in `survives`.
"""

import collections
import concurrent.futures
import filecmp
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import time
import zlib

from tread.commands import command_parser, run_command
from tread.files import DataError, Error, read_toml
from tread.runs import ROOT, environment
from tread.tables import fill, machine, markdown

HEADER = """#ifndef tread_base_chosen_fault_h
#define tread_base_chosen_fault_h
#include <cstdio>
#include <cstdlib>
namespace tread
{
  // -1: none acts, and the numbers of those that are reached are appended to the file TREAD_FAULTS_REACHED.
  inline const int chosen_fault = std::getenv("TREAD_FAULT") ? std::atoi(std::getenv("TREAD_FAULT")) : 0;
  inline bool note_reached_fault(const int number)
  {
    const char *name = std::getenv("TREAD_FAULTS_REACHED");
    if (std::FILE *file = name ? std::fopen(name, "a") : nullptr)
      {
        std::fprintf(file, "%d\\n", number);
        std::fclose(file);
      }
    return false;
  }
  template <int number>
  bool reached_fault()
  {
    static const bool noted = note_reached_fault(number);
    return noted;
  }
  template <int number>
  inline bool fault_acts()
  {
    return chosen_fault == number || (chosen_fault < 0 && reached_fault<number>());
  }
}
#endif
"""
LONGEST = 600  # s a test may take; one without a fault takes less than 200 s on two cores
KEYS = {"name", "file", "old", "new", "what", "tests"}


def faults_of_lists():
    """[fault] of tests/mutations, with its place in the file. @raises DataError naming what is wrong"""
    faults, wrong = [], []
    for path in sorted(glob.glob(os.path.join(ROOT, "tests/mutations/*.toml"))):
        for fault in read_toml(path).get("fault", []):
            if unknown := (KEYS - fault.keys()) | (fault.keys() - KEYS - {"survives"}):
                raise DataError(f"{path}: {fault.get('name', 'a fault')}: {', '.join(sorted(unknown))} missing or unknown")
            try:
                with open(os.path.join(ROOT, fault["file"]), encoding="utf-8") as stream:
                    text = stream.read()
            except OSError:
                wrong.append(f"{fault['name']}: no file {fault['file']}")
                continue
            if (count := text.count(fault["old"])) != 1:
                wrong.append(f"{fault['name']}: found {count} times in {fault['file']}")
            fault["begin"] = text.find(fault["old"])
            wrong += [f"{fault['name']}: {why}" for why in why_not_to_choose(fault, text)]
            fault["number"] = zlib.crc32(fault["name"].encode()) >> 1  # whatever other faults there are
            faults.append(fault)
    names = collections.Counter(fault["name"] for fault in faults)
    wrong += [f"{name}: {count} faults have this name" for name, count in names.items() if count > 1]
    by_place = sorted(faults, key=lambda fault: (fault["file"], fault["begin"]))
    wrong += [f"{one['name']} and {other['name']} overlap" for one, other in zip(by_place, by_place[1:])
              if one["file"] == other["file"] and one["begin"] + len(one["old"]) > other["begin"]]
    if wrong:
        raise DataError("; ".join(wrong))
    return faults


# What stands before and behind an expression that changes, in the text of a fault.
CONDITION = re.compile(r"((?:else )?if \()([^;]*)(\)(?: *//.*)?)", re.DOTALL)
DECLARATION = re.compile(r"((?:const(?:expr)?|double|auto|unsigned|bool)\b[^=;(]* = )([^;]*)(;)", re.DOTALL)
OPERAND = re.compile(r"()(.*?\S)( && ?)", re.DOTALL)

DECLARED = re.compile(r"(const|constexpr|double|auto|unsigned|bool|std::[\w:]+<.*> \w+|[A-Z]\w* \w+) ?[\w{(=;]")
NO_OPERAND = re.compile(r"(if|for|while|else|return|const|constexpr)\b|[?:=,|/]|.*(&&|\|\||[?:=,+*/({<-])\s*$", re.DOTALL)


def is_expression(text):
    bare = re.sub(r"\"(\\.|[^\"])*\"|'(\\.|[^'])*'|::", "", text)
    return (not NO_OPERAND.match(text) and not (";" in bare and "{" not in bare) and bare.count("?") <= bare.count(":")
            and all(bare.count(pair[0]) == bare.count(pair[1]) for pair in ("()", "[]", "{}")))


def is_torn(text, before, behind):
    """Whether what stands beside an expression binds closer than what is in it, so that brackets around it change what it is."""
    outside = re.sub(r"->|\"[^\"]*\"", "", text)
    while (less := re.sub(r"\([^()]*\)|\[[^][]*\]|\{[^{}]*\}", "", outside)) != outside:
        outside = less
    compares, adds, divides = (re.search(each, outside) for each in (r"&&|\|\||[<>=!]=|\?| [<>] ", r" [+-] ", r" [*/%] "))
    return bool((compares and (re.search(r"[-+*/<>!]$", before) or re.match(r"[-+*/<>]|[=!]=", behind)))
                or ("||" in outside and "&&" in (before, behind))
                or (adds and (re.search(r"[-*/]$", before) or re.match(r"[*/]", behind)))
                or (divides and before.endswith("/"))
                or ((compares or adds or divides) and re.match(r"\.|\[|->", behind)))


def why_not_to_choose(fault, text):
    """Why a fault cannot be chosen while the program runs, as far as one can see without a compiler; text: of its file."""
    old, before, behind = fault["old"], text[:max(0, fault["begin"])], text[max(0, fault["begin"]) + len(fault["old"]):]
    try:
        with_choice(old, fault["new"], "")
    except ValueError as error:
        yield str(error)
    if old.endswith(";"):
        if re.sub(r"//.*", "", before).rstrip()[-1:] not in ("", *";{})"):
            yield "begins within a statement and ends with one"
    elif is_torn(old, before.rstrip()[-2:], behind.lstrip()[:2]):
        yield "what stands beside it binds closer"


def with_choice(old, new, chosen):
    """The text that is `new` where `chosen`, otherwise `old`: statements, an expression, or an expression in what both have around it.
    @raises ValueError where they are neither, as far as one can see without a compiler"""
    for form in (CONDITION, DECLARATION, OPERAND):
        one, other = form.fullmatch(old), form.fullmatch(new)
        if one and other and (one[1], one[3].split("//")[0].strip()) == (other[1], other[3].split("//")[0].strip()):
            around, (new, old) = (one[1].replace("constexpr ", "const "), one[3]), (other[2], one[2])
            break
    else:
        around = ("", "")
        if old.endswith(";"):
            if DECLARED.match(old):
                raise ValueError("declares what is unknown behind a choice")
            return f"if ({chosen}) {{ {new} }} else {{ {old} }}"
    if not is_expression(old) or not is_expression(new):
        raise ValueError("is neither an expression nor whole statements")
    return f"{around[0]}({chosen} ? ({new}) : ({old})){around[1]}"


def with_faults(text, faults):
    """The text of a file in which each of the faults waits for its number; `both`: the text that chooses, where it is another one."""
    for fault in sorted(faults, key=lambda fault: -fault["begin"]):
        old, new, chosen = fault["old"], fault["new"], f"tread::fault_acts<{fault['number']}>()"
        both = fault["both"].replace("CHOSEN", chosen) if "both" in fault else with_choice(old, new, chosen)
        text = text[:fault["begin"]] + both + text[fault["begin"] + len(old):]
    return "#include <tread/base/chosen_fault.h>\n" + text


def write_if_changed(path, text):
    if os.path.exists(path):
        with open(path, encoding="utf-8") as stream:
            if stream.read() == text:
                return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(text)


def copy_sources(folder, faults):
    """The project in `folder` with the faults in it. Files that are the same keep their times, so that nothing is compiled twice."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode:
        sys.exit(f"{ROOT} is no clone of the project by git, whose files are copied: {listed.stderr.strip()}")
    files = listed.stdout
    of_file = collections.defaultdict(list)
    for fault in faults:
        of_file[fault["file"]].append(fault)
    for name in filter(None, files.split("\0")):
        source, target = os.path.join(ROOT, name), os.path.join(folder, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if os.path.islink(source):
            if not os.path.lexists(target):
                os.symlink(os.readlink(source), target)
        elif name in of_file:
            with open(source, encoding="utf-8") as stream:
                write_if_changed(target, with_faults(stream.read(), of_file[name]))
        elif os.path.exists(source) and not (os.path.exists(target) and filecmp.cmp(source, target, shallow=False)):
            shutil.copy(source, target)
    write_if_changed(os.path.join(folder, "include/tread/base/chosen_fault.h"), HEADER)


def build(folder, jobs):
    """Compile the copy. @raises Error naming the log"""
    log = os.path.join(folder, "build.log")
    with open(log, "w", encoding="utf-8") as stream:
        for command in (["cmake", "-S", ".", "-B", "build", "-DCMAKE_BUILD_TYPE=Release", "-DTREAD_UNITY=ON"],
                        ["cmake", "--build", "build", "-j", str(jobs), "--", "-k"]):
            if subprocess.run(command, cwd=folder, stdout=stream, stderr=stream).returncode:
                raise Error(f"the copy with faults does not compile: {log}")


def tests_of(folder):
    """{name: test as ctest describes it} of the copy."""
    listed = subprocess.run(["ctest", "--test-dir", os.path.join(folder, "build"), "--show-only=json-v1"], check=True,
                            capture_output=True, text=True).stdout
    return {test["name"]: test for test in json.loads(listed)["tests"]}


def fails(test, number, longest=LONGEST, **more):
    """Whether a test does not pass while a fault acts, or takes longer than `longest` s; 0: none. more: variables of its environment."""
    properties = {entry["name"]: entry["value"] for entry in test["properties"]}
    variables = environment() | dict(entry.split("=", 1) for entry in properties.get("ENVIRONMENT", []))
    process = subprocess.Popen(test["command"], cwd=properties["WORKING_DIRECTORY"], env=variables | {"TREAD_FAULT": str(number)} | more,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        return process.wait(timeout=longest) != 0
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        process.wait()
        return True


def near(fault, tests):
    """Tests that should notice a fault, those of single parts before whole runs."""
    names = [name for name in tests if re.search(fault["tests"], name)]
    if not names:
        raise DataError(f"{fault['name']}: no test is called {fault['tests']}")
    return sorted(names, key=lambda name: name.startswith("scene."))


def attempt(fault, tests):
    """Run the tests near a fault until one fails."""
    start = time.monotonic()
    noticed = next((name for name in near(fault, tests) if fails(tests[name], fault["number"])), None)
    seconds = time.monotonic() - start
    print(f"{fault['name']:<44} {noticed or 'SURVIVES':<40} {seconds:6.0f} s", flush=True)
    return {"change": change_of(fault), "noticed": noticed}


def change_of(fault):
    return [fault["old"], fault["new"]]


def write_page(faults, results):
    """The tables of doc/dev/records/mutations.md."""
    folders = collections.defaultdict(list)
    for fault in faults:
        folders[fault["name"].split("-")[0]].append(fault)
    rows, survivors = [], []
    counts = collections.Counter()
    for folder, listed in sorted(folders.items()):
        tried = [fault for fault in listed if fault["name"] in results]
        noticed = [fault for fault in tried if results[fault["name"]]["noticed"]]
        if not tried:
            continue
        rows.append([folder, str(len(tried)), str(len(noticed)), f"{100 * len(noticed) / len(tried):.0f} %"])
        counts.update(tried=len(tried), noticed=len(noticed))
        survivors += [[f"`{fault['name']}`", fault["what"], fault.get("survives", "a test is missing")]
                      for fault in tried if fault not in noticed]
    if not counts["tried"]:
        return
    rows.append(["all", str(counts["tried"]), str(counts["noticed"]), f"{100 * counts['noticed'] / counts['tried']:.1f} %"])
    fill("dev/records/mutations.md", "mutations", markdown(["folder", "faults", "noticed", "share"], rows)
         + f"\n\n{counts['tried']} of the {len(faults)} listed faults have been tried. {machine()}; `contrib/mutate.py`.")
    fill("dev/records/mutations.md", "survivors", markdown(["fault", "what it does", "why no test notices it"], survivors or [["-", "-", "-"]]))
    fill("dev/records/mutations.md", "faults", markdown(["fault", "what it does", "noticed by"],
                                            [[f"`{fault['name']}`", fault["what"], f"`{results[fault['name']]['noticed']}`"]
                                             for fault in faults if results.get(fault["name"], {}).get("noticed")]))


def main():
    parser = command_parser(__doc__)
    parser.add_argument("--check", action="store_true", help="only see that each fault has its place")
    parser.add_argument("--folder", default=os.path.join(ROOT, "build-mutations"), help="copy, its build and the results (build-mutations)")
    parser.add_argument("--only", metavar="REGEX", help="try the faults whose names match, also again")
    parser.add_argument("--tests", metavar="REGEX", help="run these tests, not those that the faults name")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers and faults at a time (number of processors)")
    arguments = parser.parse_args()
    if arguments.jobs < 1:
        raise Error("--jobs must be at least 1")
    faults = faults_of_lists()
    if arguments.tests:
        faults = [{**fault, "tests": arguments.tests} for fault in faults]
    if arguments.check:
        print(f"{len(faults)} faults have their places")
        return

    copy_sources(arguments.folder, faults)
    build(arguments.folder, arguments.jobs)
    tests = tests_of(arguments.folder)

    store = os.path.join(arguments.folder, "results.json")
    results = {}
    if os.path.exists(store):
        with open(store, encoding="utf-8") as stream:
            results = json.load(stream)
    by_name = {fault["name"]: fault for fault in faults}
    results = {name: result for name, result in results.items()
               if name in by_name and result["change"] == change_of(by_name[name])}

    def save():
        with open(store + ".new", "w", encoding="utf-8") as stream:
            json.dump(results, stream, indent=1)
        os.replace(store + ".new", store)

    def is_due(fault):
        result = results.get(fault["name"])
        return result is None or not (result["noticed"] or "survives" in fault)

    chosen = [fault for fault in faults if (re.search(arguments.only, fault["name"]) if arguments.only else is_due(fault))]
    # Whole runs take longest: what needs few of them comes first.
    chosen.sort(key=lambda fault: sum(name.startswith("scene.") for name in near(fault, tests)))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        running = {pool.submit(attempt, fault, tests): fault for fault in chosen}
        try:
            for done in concurrent.futures.as_completed(running):
                results[running[done]["name"]] = done.result()
                save()
        except KeyboardInterrupt:
            print("interrupted: the tests that run come to their end", flush=True)
            pool.shutdown(cancel_futures=True)
            running = {done: fault for done, fault in running.items() if not done.cancelled()}
            results |= {fault["name"]: done.result() for done, fault in running.items()}
            save()
            chosen = list(running.values())
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        # A test that fails anyhow notices nothing.
        noticing = sorted({results[fault["name"]]["noticed"] for fault in chosen} - {None})
        wrong = [name for name, failed in zip(noticing, pool.map(lambda name: fails(tests[name], 0), noticing)) if failed]
    if wrong:
        results = {name: result for name, result in results.items() if result["noticed"] not in wrong}
        save()
        raise Error("these tests fail without any fault: " + ", ".join(wrong))
    write_page(faults, results)
    surviving = [fault["name"] for fault in chosen if not results[fault["name"]]["noticed"] and "survives" not in fault]
    if surviving:
        sys.exit("no test notices " + ", ".join(surviving))


if __name__ == "__main__":
    run_command(main)
