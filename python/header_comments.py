#!/usr/bin/env python3
"""Writes the comments above functions in C++ headers, as rows of a C++ table for docstrings.

  header_comments.py TABLE HEADER...

Doxygen's words become plain ones; what concerns the C++ interface alone (@param, @pre, @cost) goes.
"""
import re
import sys
from pathlib import Path

DECLARATION = re.compile(r"(?:\[\[nodiscard\]\] )?[\w:<>, ]+? (\w+)\(")
WORDS = {"return": "Result: ", "degenerate": "Degenerate: "}


def sections(comment):
    """(command, lines) of a comment; the command of what comes first is None."""
    found = [(None, [])]
    for line in comment:
        command = re.match(r"@(\w+)\s*(.*)", line)
        if command:
            found.append((command[1], [command[2]]))
        else:
            found[-1][1].append(line if found[-1][0] is None else line.strip())
    return found


def plain(comment):
    lines = []
    for command, body in sections(comment):
        if command is None:
            lines += body
        elif command in WORDS:
            lines += ["", WORDS[command] + body[0]] + body[1:]
    return "\n".join(lines).strip() + "\n"


def comments_of(header):
    comment = []
    for line in header.read_text(encoding="utf-8").splitlines():
        text = re.match(r"/// ?(.*)", line)
        if text:
            comment.append(text[1])
            continue
        declared = DECLARATION.match(line)
        if comment and declared:
            yield declared[1], plain(comment)
        comment = []


def main():
    table, *headers = sys.argv[1:]
    rows = [f'    {{"{name}", R"doc({text})doc"}},\n'
            for header in headers for name, text in comments_of(Path(header))]
    Path(table).write_text("".join(rows), encoding="utf-8")


if __name__ == "__main__":
    main()
