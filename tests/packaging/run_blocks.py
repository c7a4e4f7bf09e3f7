#!/usr/bin/env python3
"""Runs the commands that Markdown pages show, and compares the output that they show.

  run_blocks.py [--renew] PROGRAM SOURCE_DIR PAGE...

A page is a session: its blocks run one after the other in one scratch folder that looks like a
checkout, with PROGRAM in the PATH. Three kinds of blocks are looked at:
  ```bash      a script; it must succeed
  ```console   "$ command" lines, each followed by what it prints; "..." stands for any lines, and
               numbers may be others: the words must be the same
  others       must not start a line with one of this project's commands
A block after <!-- not run: REASON --> is passed over, and so said. --renew writes the output that
the commands have now into the page, shortened ones excepted.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

COMMAND = re.compile(r"^(\$ |(sudo |bash )?(oneac |apps/|tests/|docs/|cmake |ctest |apt ))", re.M)
NUMBER = re.compile(r"-?\d[\d.]*(e[-+]?\d+)?|\bnan\b")
TIMEOUT_S = 600


class Block:
    def __init__(self, language, first, lines, reason):
        self.language, self.first, self.lines, self.reason = language, first, lines, reason


def blocks_of(page):
    """Fenced blocks of a page; `first` is the index of the line after the fence."""
    block, reason = None, None
    for number, line in enumerate(page.read_text().split("\n")):
        if block is not None:
            if line.strip() == "```":
                yield block
                block, reason = None, None
            else:
                block.lines.append(line)
        elif line.startswith("```"):
            block = Block(line[3:].strip(), number + 1, [], reason)
        elif line.strip():
            mark = re.match(r"<!-- not run: (.+) -->$", line.strip())
            reason = mark.group(1) if mark else None


def shape(text):
    """A line without its numbers, and without what follows from them: spaces, the best in bold."""
    return re.sub(r"\s+", " ", NUMBER.sub("#", text).replace("**", "")).strip()


def same(shown, printed):
    """Whether the lines agree; "..." in `shown` stands for any number of lines."""
    if not shown:
        return not printed
    if shown[0].strip() == "...":
        return any(same(shown[1:], printed[i:]) for i in range(len(printed) + 1))
    return bool(printed) and shape(shown[0]) == shape(printed[0]) and same(shown[1:], printed[1:])


class Session:
    def __init__(self, program, source, folder):
        self.folder = Path(folder)
        for entry in source.iterdir():
            if not entry.name.startswith(".") and entry.name not in ("build", "demo"):
                (self.folder / entry.name).symlink_to(entry)
        path = f"{program.parent}:{os.environ['PATH']}"
        self.environment = dict(os.environ, PATH=path, TERM="dumb", LC_ALL="C.UTF-8")

    def run(self, script):
        return subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=self.folder,
                              env=self.environment, stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=TIMEOUT_S)


def commands_of(lines):
    """(command lines, output lines, index of the first output line) of a console block."""
    i = 0
    while i < len(lines):
        command = [lines[i][2:]]
        while command[-1].endswith("\\"):
            i += 1
            command.append(lines[i])
        i += 1
        first = i
        while i < len(lines) and not lines[i].startswith("$ "):
            i += 1
        yield "\n".join(command), lines[first:i], first


def run_console(session, block, edits):
    problems = []
    for command, shown, first in commands_of(block.lines):
        done = session.run(command)
        printed = done.stdout.rstrip("\n").split("\n") if done.stdout.strip() else []
        expected = [line for line in shown if line.strip()]
        if same(expected, [line for line in printed if line.strip()]):
            continue
        if "..." not in [line.strip() for line in shown]:
            edits.append((block.first + first, len(shown), printed))
        problems.append(f"$ {command}\nprints (exit code {done.returncode})\n{done.stdout}")
    return problems


def run_page(page, session, edits):
    problems = []
    for block in blocks_of(page):
        where = f"{page.name}:{block.first}"
        if block.reason:
            print(f"   {where} not run: {block.reason}")
        elif block.language == "bash":
            done = session.run("\n".join(block.lines))
            if done.returncode != 0:
                problems.append(f"{where} exit code {done.returncode}\n{done.stdout}")
        elif block.language == "console":
            problems += [f"{where} {text}" for text in run_console(session, block, edits)]
        elif COMMAND.search("\n".join(block.lines)) and block.language != "text":
            problems.append(f"{where} shows commands: name it bash, console or (a synopsis) text")
    return problems


def renew(page, edits):
    lines = page.read_text().split("\n")
    for first, count, printed in sorted(edits, reverse=True):
        lines[first:first + count] = printed
    page.write_text("\n".join(lines))


def main():
    arguments = sys.argv[1:]
    renewing = "--renew" in arguments
    program, source, *pages = [Path(a).resolve() for a in arguments if a != "--renew"]
    failed = 0
    for page in pages:
        print(f"-- {page}", flush=True)
        edits = []
        with tempfile.TemporaryDirectory() as folder:
            problems = run_page(page, Session(program, source, folder), edits)
        if renewing:
            renew(page, edits)
        for problem in problems:
            print(f"FAILED: {problem}", file=sys.stderr)
        failed += len(problems)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
