import os
import shutil
import subprocess
import sys
from pathlib import Path

import conftest
import pytest

import oneac

PACKAGE = Path(oneac.__file__).parent
SOURCE = Path(__file__).resolve().parents[2]


def test_everything_public_is_there_and_explained():
    for name in oneac.__all__:
        assert (getattr(oneac, name).__doc__ or "").strip(), name
    for cls in (oneac.FrontEnd, oneac.Initialiser, oneac.Rawlog, oneac.Solver):
        assert cls.__doc__.strip()
    assert (PACKAGE / "py.typed").exists()
    assert oneac.version().startswith(oneac.__version__)


def test_stubs_have_every_solver():
    text = (PACKAGE / "_solvers.pyi").read_text()
    for solver in oneac.solvers():
        assert f"def {solver.name}(x1: ArrayLike" in text


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not installed")
def test_types_agree_with_what_is_there(tmp_path):
    # Of pybind11's classes themselves, not of their members: what type() says of them.
    (tmp_path / "allowed").write_text("oneac\\._oneac\\.[A-Z][A-Za-z]*(\\.__init__)?\n")
    run = [sys.executable, "-m", "mypy.stubtest", "oneac._oneac", "oneac._solvers",
           "--ignore-missing-stub", "--ignore-unused-allowlist", "--allowlist", "allowed"]
    done = subprocess.run(run, cwd=tmp_path, text=True, capture_output=True,
                          env=dict(os.environ, MYPYPATH=str(PACKAGE.parent)))
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not installed")
def test_programs_can_be_checked(tmp_path):
    (tmp_path / "wrong.py").write_text("import oneac\noneac.relpose_1ac_ground(1.0)\n")
    example = SOURCE / "docs" / "examples" / "benchmark_row.py"
    for program, code in ((example, 0), (tmp_path / "wrong.py", 1)):
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir",
                               str(tmp_path / "cache"), str(program)], cwd=tmp_path, text=True,
                              capture_output=True,
                              env=dict(os.environ, MYPYPATH=str(PACKAGE.parent)))
        assert done.returncode == code, done.stdout + done.stderr


def test_the_example_prints_a_row_of_the_table(tmp_path):
    conftest.oneac("simulate", "-o", tmp_path, "--frames", 60, "--width", 320, "--height", 240,
                   "--focal", 250)
    script = SOURCE / "docs" / "examples" / "benchmark_row.py"
    assert len(script.read_text().splitlines()) <= 25
    done = subprocess.run([sys.executable, script, tmp_path / "simulated.rawlog",
                           tmp_path / "poses.txt", "0"], text=True, capture_output=True, check=True)
    assert done.stdout.startswith("| 60 frames") and "| 0 of 59 |" in done.stdout
