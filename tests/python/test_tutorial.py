"""docs/tutorial-python.md, block by block: what it shows is what is printed."""

import contextlib
import io
import os
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "packaging"))

from run_blocks import blocks_of, same  # noqa: E402


def run_python(block, names):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile("\n".join(block.lines), f"tutorial-python.md:{block.first}", "exec"), names)
    return [line for line in out.getvalue().split("\n") if line.strip()]


def run_bash(block):
    program = Path(os.environ.get("ONEAC_PROGRAM", "oneac")).parent
    subprocess.run(["bash", "-eu", "-c", "\n".join(block.lines)], check=True,
                   stdout=subprocess.DEVNULL,
                   env=dict(os.environ, PATH=f"{program}:{os.environ['PATH']}"))


def test_the_tutorial_prints_what_it_shows(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names, printed, shown = {"__name__": "tutorial"}, [], 0
    for block in blocks_of(SOURCE / "docs" / "tutorial-python.md"):
        if block.reason:
            continue
        if block.language == "bash":
            run_bash(block)
        elif block.language == "python":
            printed = run_python(block, names)
        elif block.language == "text":
            shown += 1
            wanted = [line for line in block.lines if line.strip()]
            assert same(wanted, printed), "prints\n" + "\n".join(printed)
    assert shown >= 5
