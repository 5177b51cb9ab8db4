#!/usr/bin/python3
"""Break one token of the library at a time and print which tests notice.

    tests/lab/mutations.py --base COMMIT --checkout DIRECTORY --memory FILE [--new] [--folders F...]

A seed draws mutations from lines of C++ and GLSL. COMMIT and HEAD share them, so the suites of both
can be compared; with --new, only HEAD has them. DIRECTORY is a clean checkout of either. Each
mutation is made there, built, tested until the first failure, and reverted. Prints a line of CSV
for each: number, path, line, its text, column, before and after, the tier and the test that noticed
it, seconds of tests. "none" means that it survived. Mutations that do not compile are skipped.

FILE remembers results: a run that was cut off continues once its build and tests have ended. FILE
lies outside DIRECTORY, or git ignores it. Delete a row to repeat its mutation.
"""

import argparse
import collections
import csv
import fcntl
import os
import random
import re
import subprocess
import sys
import time
from pathlib import Path

FOLDERS = ("lights/", "plugin/", "shadowtech/")
ENDINGS = (".h", ".cpp", ".cxx", ".glsl")

# ctest's arguments for each tier. Commits without tiers have only `all`.
TIERS = {
    "quick": ["--preset", "quick"],
    "rest": ["--preset", "ci", "-LE", "^quick$"],
    "all": ["--preset", "ci"],
}
SECONDS_A_TEST = 400  # a mutation may loop forever

BUILD = ("cmake", "--build", "--preset", "ci")
NOT_COMPILED = ["does not compile"]  # in place of a tier, a test and seconds

OTHERS = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
    "+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=",
    "++": "--", "!": "", "true": "false", "false": "true", "min": "max", "max": "min",
    "continue": "break", "break": "continue",
}
# Spaces around binary operators tell them from templates, pointers and signs.
TOKEN = re.compile(
    r"(?<= )(?:[<>]=?|[=!]=|&&|\|\||[-+*/]=?)(?= )|\+\+|(?<=\()!(?=\w)"
    r"|\b(?:true|false|min|max|continue|break)\b|(?<![\w.])\d+(?:\.\d+)?(?![\w.])")
STRING = re.compile(r'"(?:[^"\\]|\\.)*"')

Mutation = collections.namedtuple("Mutation", "path line text column before after")


def output_of(*command, directory="."):
    return subprocess.run(
        command, cwd=directory, text=True, check=True, stdout=subprocess.PIPE).stdout


def places_of_lines(commit):
    """Map the text of each code line in a commit's sources to its (path, number of line)."""
    places = collections.defaultdict(list)
    for path in output_of("git", "ls-tree", "-r", "--name-only", commit).splitlines():
        if path.startswith(FOLDERS) and path.endswith(ENDINGS):
            source = output_of("git", "show", f"{commit}:{path}")
            for number, line in enumerate(source.split("\n"), 1):
                text = line.strip()
                if not text.startswith(("//", "#", "/*", "*")):
                    places[text].append((path, number))
    return places


def mutations(head, base, checkout, options):
    """Return single-token mutations of a checked out commit, in random order.

    Their lines occur once in head's sources, in one of the folders, and once in base's: new ones
    never there.
    """
    ours, theirs, there = map(places_of_lines, (head, base, checkout))
    texts = sorted(
        text for text, places in ours.items()
        if len(places) == 1 and len(theirs.get(text, ())) == (0 if options.new else 1)
        and any(Path(places[0][0]).is_relative_to(folder) for folder in options.folders))
    found = []
    for text in texts:
        code = STRING.sub(lambda string: " " * len(string[0]), text.split(" //")[0])
        for token in TOKEN.finditer(code):
            before = token[0]
            after = OTHERS.get(before)
            if after is None:
                after = str(float(before) + 1.0) if "." in before else str(int(before) + 1)
            found.append(Mutation(*there[text][0], text, token.start(), before, after))
    random.Random(options.seed).shuffle(found)
    return found


def mutate(source, mutation):
    """Return the text of a file with a mutation in it."""
    lines = source.split("\n")
    line = lines[mutation.line - 1]
    start = line.index(mutation.text) + mutation.column
    lines[mutation.line - 1] = line[:start] + mutation.after + line[start + len(mutation.before):]
    return "\n".join(lines)


def succeeds(directory, *command):
    environment = {**os.environ, "GTEST_FAIL_FAST": "1"}
    environment.pop("DISPLAY", None)
    done = subprocess.run(command, cwd=directory, text=True, check=False, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, close_fds=False)
    return done.returncode == 0, done.stdout


def first_failure(tiers, checkout):
    """Return the tier and the case, or program, that fails first; ("none", "") if all pass."""
    for tier in tiers:
        passes, log = succeeds(checkout, "ctest", *TIERS[tier], "--stop-on-failure",
                               "--timeout", str(SECONDS_A_TEST))
        if not passes:
            case = re.search(r"\[  FAILED  \] ([^\s,]+)", log) or \
                re.search(r"Test +#\d+: (\S+) .*\*\*\*", log)
            return tier, case[1] if case else log[-200:]
    return "none", ""


def result_of(mutation, options):
    """Make, build, test and revert a mutation."""
    file = options.checkout / mutation.path
    source = file.read_text(encoding="utf-8")
    try:
        file.write_text(mutate(source, mutation), encoding="utf-8")
        if succeeds(options.checkout, *BUILD)[0]:
            start = time.monotonic()
            noticed = first_failure(options.tiers, options.checkout)
            return [*noticed, round(time.monotonic() - start)]
    finally:
        file.write_text(source, encoding="utf-8")
    builds, log = succeeds(options.checkout, *BUILD)
    if not builds:
        sys.exit(f"{options.checkout} does not build without mutations:\n{log[-2000:]}")
    return NOT_COMPILED


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--base", required=True, help="the commit to compare HEAD with")
    parser.add_argument("--checkout", required=True, type=Path, help="where to make mutations")
    parser.add_argument("--memory", required=True, help="a CSV file of results")
    parser.add_argument("--new", action="store_true", help="mutate lines that the base lacks")
    parser.add_argument("--folders", nargs="+", default=FOLDERS, help="where HEAD has the lines")
    parser.add_argument("--tiers", nargs="*", default=["quick", "rest"], choices=TIERS,
                        help="one after the other")
    parser.add_argument("--seed", default=1, type=int)
    parser.add_argument("--count", default=12, type=int, help="of mutations that compile")
    options = parser.parse_args()

    head, base = output_of("git", "rev-parse", "HEAD", options.base + "^{commit}").split()
    checkout = output_of("git", "rev-parse", "HEAD", directory=options.checkout).strip()
    if checkout != head and (options.new or checkout != base):
        parser.error(f"{options.checkout} is at {checkout}, without the lines")
    header = [f"HEAD {head}", f"base {base}", f"checkout {checkout}", f"seed {options.seed}",
              "new" if options.new else "shared", *sorted(options.folders), *options.tiers]
    found = mutations(head, base, checkout, options)

    memory = open(options.memory, "a+", newline="", encoding="utf-8", buffering=1)
    # Builds and tests inherit the lock, as they may outlive a killed run.
    os.set_inheritable(memory.fileno(), True)
    fcntl.flock(memory, fcntl.LOCK_EX)
    memory.seek(0)
    rows, writer = list(csv.reader(memory)), csv.writer(memory)
    if not rows:
        writer.writerow(header)
    elif rows[0] != header:
        parser.error(f"{options.memory} has results of\n{rows[0]}, expected\n{header}")
    results = {tuple(row[:6]): row[6:] for row in rows[1:]}  # an empty one is under way

    for mutation in found:
        if results.get(tuple(map(str, mutation))) == []:
            file = options.checkout / mutation.path
            source = output_of("git", "show", f"{checkout}:{mutation.path}")
            if file.read_text(encoding="utf-8") == mutate(source, mutation):
                file.write_text(source, encoding="utf-8")
    if changes := output_of("git", "status", "--porcelain", directory=options.checkout):
        parser.error(f"{options.checkout} is not clean:\n{changes}")

    number = 0
    for mutation in found:
        if number == options.count:
            break
        result = results.get(tuple(map(str, mutation)))
        if not result:
            writer.writerow(mutation)
            result = result_of(mutation, options)
            writer.writerow([*mutation, *result])
        if result != NOT_COMPILED:
            number += 1
            csv.writer(sys.stdout).writerow([number, *mutation, *result])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
