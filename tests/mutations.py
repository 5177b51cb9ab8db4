#!/usr/bin/python3
"""Break one token of the library at a time and print which tests notice.

    tests/mutations.py --base COMMIT --checkout DIRECTORY [--tiers all] [--only NUMBER...]

A seed draws mutations from the lines of C++ and GLSL that COMMIT and HEAD share, so the suites of
both can be compared. DIRECTORY is a clean checkout of either. Each mutation is made there, built,
tested until the first failure, and reverted. Prints a line of CSV for each: number, place, before
and after, the tier and the test that noticed it, seconds of tests. "none" means that it survived.
Mutations that do not compile are skipped.
"""

import argparse
import collections
import csv
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

Mutation = collections.namedtuple("Mutation", "text start before after")


def output_of(*command, directory="."):
    return subprocess.run(
        command, cwd=directory, text=True, check=True, stdout=subprocess.PIPE).stdout


def places_of_lines(commit):
    """Map the text of each code line in a commit's sources to its (path, index of line)."""
    places = collections.defaultdict(list)
    for path in output_of("git", "ls-tree", "-r", "--name-only", commit).splitlines():
        if path.startswith(FOLDERS) and path.endswith(ENDINGS):
            source = output_of("git", "show", f"{commit}:{path}")
            for index, line in enumerate(source.split("\n")):
                text = line.strip()
                if not text.startswith(("//", "#", "/*", "*")):
                    places[text].append((path, index))
    return places


def mutations(base, seed):
    """Return single-token mutations of lines that occur once in both commits, in random order."""
    ours, theirs = places_of_lines("HEAD"), places_of_lines(base)
    shared = sorted(
        text for text in ours if len(ours[text]) == 1 and len(theirs.get(text, ())) == 1)
    found = []
    for text in shared:
        code = STRING.sub(lambda string: " " * len(string[0]), text.split(" //")[0])
        for token in TOKEN.finditer(code):
            before = token[0]
            after = OTHERS.get(before)
            if after is None:
                after = str(float(before) + 1.0) if "." in before else str(int(before) + 1)
            found.append(Mutation(text, token.start(), before, after))
    random.Random(seed).shuffle(found)
    return found


def mutate(source, mutation):
    """Return the text of a file with a mutation in it."""
    lines = source.split("\n")
    index = next(i for i, line in enumerate(lines) if line.strip() == mutation.text)
    indent = len(lines[index]) - len(lines[index].lstrip())
    start = indent + mutation.start
    lines[index] = lines[index][:start] + mutation.after + \
        lines[index][start + len(mutation.before):]
    return "\n".join(lines)


def succeeds(directory, *command):
    environment = {**os.environ, "GTEST_FAIL_FAST": "1"}
    environment.pop("DISPLAY", None)
    done = subprocess.run(command, cwd=directory, text=True, check=False, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
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


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--base", required=True, help="a commit that shares lines with HEAD")
    parser.add_argument("--checkout", required=True, type=Path, help="where to make mutations")
    parser.add_argument("--tiers", nargs="*", default=["quick", "rest"], choices=TIERS,
                        help="one after the other")
    parser.add_argument("--seed", default=1, type=int)
    parser.add_argument("--count", default=12, type=int, help="of mutations that compile")
    parser.add_argument("--only", nargs="*", type=int, help="numbers; all if none is named")
    options = parser.parse_args()

    places = places_of_lines(output_of("git", "rev-parse", "HEAD", directory=options.checkout)[:-1])
    rows = csv.writer(sys.stdout)
    number = 0
    for mutation in mutations(options.base, options.seed):
        if number == options.count:
            break
        path, index = places[mutation.text][0]
        file = options.checkout / path
        source = file.read_text(encoding="utf-8")
        file.write_text(mutate(source, mutation), encoding="utf-8")
        try:
            if not succeeds(options.checkout, "cmake", "--build", "--preset", "ci")[0]:
                continue
            number += 1
            if options.only and number not in options.only:
                continue
            start = time.monotonic()
            noticed = first_failure(options.tiers, options.checkout)
            rows.writerow([number, f"{path}:{index + 1}", mutation.before, mutation.after, *noticed,
                           round(time.monotonic() - start)])
            sys.stdout.flush()
        finally:
            file.write_text(source, encoding="utf-8")


if __name__ == "__main__":
    main()
