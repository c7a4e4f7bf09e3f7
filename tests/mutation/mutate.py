#!/usr/bin/env python3
"""Changes a sign, an index or a constant in the equations of the solvers, and sees a test fail.

  tests/mutation/mutate.py                   every equation line (hours)
  tests/mutation/mutate.py --sample 200      the same 200 of them on every machine
  tests/mutation/mutate.py --list            what would be changed
Works on a copy in build/mutation; results are kept in build/mutation/results.jsonl, so that a run
that was interrupted goes on. Mutants known to change no result are in equivalent.txt, with reasons.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from mutants import mutants_of

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "mutation"
SOURCE = WORK / "source"
RESULTS = WORK / "results.jsonl"
TESTS = {"solvers": ["solvers_test"], "geometry": ["geometry_test", "solvers_test"]}


def equations():
    """The files whose lines are changed."""
    files = sorted((ROOT / "modules/solvers/src").glob("**/*.*"))
    files += sorted((ROOT / "modules/geometry/src").glob("*.cpp"))
    return [str(file.relative_to(ROOT)) for file in files]


def prepare():
    """A copy of the sources, configured to compile fast."""
    skipped = shutil.ignore_patterns("build", ".git", "demo", "__pycache__")
    for entry in ROOT.iterdir():
        if entry.name in ("build", ".git", "demo"):
            continue
        target = SOURCE / entry.name
        if entry.is_dir():
            shutil.copytree(entry, target, ignore=skipped, dirs_exist_ok=True,
                            copy_function=copy_changed)
        else:
            copy_changed(entry, target)
    subprocess.run(
        ["cmake", "-S", str(SOURCE), "-B", str(WORK / "build"), "-G", "Ninja",
         "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O1 -DNDEBUG",
         "-DCMAKE_CXX_COMPILER_LAUNCHER=env"],
        check=True, stdout=subprocess.DEVNULL)


def copy_changed(source, target):
    """Leaves the time stamps of what is the same, so that nothing is compiled again."""
    source, target = Path(source), Path(target)
    if target.exists() and target.read_bytes() == source.read_bytes():
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)


def build(targets):
    return subprocess.run(["ninja", "-C", str(WORK / "build"), "-j1", *targets],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT).returncode == 0


def tests_pass(programs, limit):
    for program in programs:
        module = program.replace("_test", "")
        path = WORK / "build/modules" / module / program
        try:
            done = subprocess.run([str(path), "--gtest_brief=1", "--gtest_fail_fast"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  timeout=limit)
        except subprocess.TimeoutExpired:  # a mutant that never ends is noticed
            return False
        if done.returncode != 0:
            return False
    return True


def write_line(mutant, text):
    path = SOURCE / mutant.path
    lines = path.read_text().split("\n")
    lines[mutant.line - 1] = text
    path.write_text("\n".join(lines))


def judge(mutant, limit):
    """killed, survived, or invalid for one that does not compile."""
    programs = TESTS[mutant.path.split("/")[1]]
    write_line(mutant, mutant.after)
    try:
        if not build(programs):
            return "invalid"
        return "survived" if tests_pass(programs, limit) else "killed"
    finally:
        write_line(mutant, mutant.before)


def known_results():
    if not RESULTS.exists():
        return {}
    rows = [json.loads(line) for line in RESULTS.read_text().splitlines()]
    return {row["key"]: row["result"] for row in rows}


def equivalents():
    """{key: reason}: two lines each in equivalent.txt."""
    text = (Path(__file__).parent / "equivalent.txt").read_text()
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return {key.strip(): reason.strip() for key, reason in zip(lines[::2], lines[1::2])}


def judge_all(mutants, seconds):
    known = known_results()
    waiting = [mutant for mutant in mutants if mutant.key not in known]
    if not waiting:
        return
    prepare()
    if not build(["solvers_test", "geometry_test"]):
        sys.exit("mutate: the sources do not build")
    began = time.monotonic()
    if not tests_pass(TESTS["geometry"], 3600):
        sys.exit("mutate: the tests fail without a mutant")
    limit = 20 + 5 * (time.monotonic() - began)
    for count, mutant in enumerate(waiting):
        if time.monotonic() - began > seconds:
            print(f"mutate: {len(waiting) - count} left for another call", file=sys.stderr)
            return
        result = judge(mutant, limit)
        with RESULTS.open("a") as out:
            row = {"key": mutant.key, "kind": mutant.kind, "line": mutant.line, "result": result}
            out.write(json.dumps(row) + "\n")
        print(f"{result:9} {mutant.kind:9} {mutant.key}", flush=True)


def report(mutants, total):
    """The table of docs/reliability.md; the number of survivors without a reason."""
    known, reasons = known_results(), equivalents()
    rows, survivors = {}, []
    for mutant in mutants:
        result = known.get(mutant.key)
        if result == "survived" and mutant.key in reasons:
            result = "equivalent"
        elif result == "survived":
            survivors.append(mutant)
        for row in (mutant.path.split("/")[1], mutant.kind):
            rows.setdefault(row, {}).setdefault(result, []).append(mutant)
    print(f"\n{len(mutants)} of {total} equation lines\n")
    print("| lines | mutants | killed | equal in effect | survived | do not compile |")
    print("|---|---|---|---|---|---|")
    for name, row in rows.items():
        count = [len(row.get(r, [])) for r in ("killed", "equivalent", "survived", "invalid")]
        print(f"| {name} | {sum(count[:3])} | {count[0]} | {count[1]} | {count[2]} | {count[3]} |")
    for mutant in survivors:
        print(f"survived: {mutant.path}:{mutant.line}\n  {mutant.key}")
    return len(survivors)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sample", type=int, default=0, help="so many lines; 0: all")
    parser.add_argument("--minutes", type=float, default=1e9, help="stop after, to go on later")
    parser.add_argument("--again", action="store_true", help="judge survivors once more")
    parser.add_argument("--list", action="store_true", help="print the mutants and end")
    arguments = parser.parse_args()
    everything = mutants_of(ROOT, equations())
    mutants = everything[:arguments.sample or None]
    if arguments.list:
        for mutant in mutants:
            print(f"{mutant.kind:9} {mutant.path}:{mutant.line}  {mutant.key.split(': ', 1)[1]}")
        print(len(mutants), "of", len(everything))
        return 0
    if arguments.again and RESULTS.exists():
        rows = RESULTS.read_text().splitlines(keepends=True)
        RESULTS.write_text("".join(r for r in rows if json.loads(r)["result"] != "survived"))
    os.makedirs(WORK, exist_ok=True)
    judge_all(mutants, 60 * arguments.minutes)
    return 1 if report(mutants, len(everything)) else 0


if __name__ == "__main__":
    sys.exit(main())
