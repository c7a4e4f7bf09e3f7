import copy
import os
import pickle
import re
import shutil
import subprocess
import sys
from pathlib import Path

import conftest
import numpy as np
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


def type_faults(folder, program):
    """Lines of `mypy --strict` on a program and on the package, but its notes."""
    # Without PYTHONPATH: mypy keeps quiet about faults of packages that are installed.
    env = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary",
                           "--show-error-codes", "--cache-dir", str(folder / "cache"),
                           str(program)], cwd=folder, text=True, capture_output=True,
                          env=dict(env, MYPYPATH=str(PACKAGE.parent)))
    assert done.returncode in (0, 1) and done.stderr == "", done.stdout + done.stderr
    return [line for line in done.stdout.splitlines() if ": note: " not in line]


def program_of(folder, name, lines):
    """A program with these lines from the fourth on."""
    head = ["import numpy as np", "from numpy.typing import NDArray", "import oneac"]
    (folder / name).write_text("\n".join(head + lines + [""]))
    return folder / name


def call_of(solver):
    A = ", A=[[1, 0], [0, 1]]" if solver.affine else ""
    return f"oneac.{solver.name}(np.zeros(2), (0.0, 0.0){A})"


RIGHT = [
    "poses: oneac.Poses = oneac.relpose_1ac_ground(np.zeros(2), np.zeros(2), np.eye(2))",
    "count: NDArray[np.int64] = poses.count",
    "camera = oneac.Camera(480, 360, 375, 375, 240, 180, np.zeros(5))",
    "oneac.Camera(480, 360, 375, 375, 240, 180, [0.1, 0])",
    "oneac.Camera(480, 360, 375, 375, 240, 180, (0, 0), lens='kannala_brandt')",
    "known = {camera: camera == camera}",
    "for frame in oneac.Rawlog('drive.rawlog', calibration=camera, every=2):",
    "    pixels: NDArray[np.uint8] = frame.image",
    "path = oneac.Trajectory(np.eye(4)[None])",
    "found = oneac.evaluate(None, path, path).trajectory",
    "rmse: float = found.ape.rmse if found else 0.0",
]

# A line, the code of its error and words of it.
WRONG = [
    ("oneac.relpose_1ac_moon(np.zeros(2))", "attr-defined", 'no attribute "relpose_1ac_moon"'),
    ("oneac.relpose_1ac_ground(object(), [0, 0], np.eye(2))", "arg-type", 'Argument 1 to "relpose'),
    ("oneac.relpose_1ac_ground([0, 0], [0, 0], C=np.eye(2))", "call-arg", 'keyword argument "C"'),
    ("oneac.essential_5pc([0, 0], [0, 0], np.eye(2))", "call-arg", "Too many arguments"),
    ("one: int = oneac.essential_5pc([0, 0], [0, 0]).count", "assignment", "Incompatible types"),
    ("oneac.essential_5pc([0, 0], [0, 0]).counts", "attr-defined", '"Poses" has no attribute'),
    ("oneac.Camera(480, 360, 375, 375, 240, 180, 'k1')", "arg-type", 'Argument 7 to "Camera"'),
    ("oneac.Camera(480, 360, 375, 375, 240, 180, 0.1)", "arg-type", 'Argument 7 to "Camera"'),
    ("oneac.evaluate(None, None, None)", "arg-type", 'Argument 3 to "evaluate"'),
    ("oneac.Rawlog('drive.rawlog', evry=2)", "call-arg", 'keyword argument "evry"'),
]


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not installed")
def test_right_programs_pass_the_strict_type_check(tmp_path):
    lines = RIGHT + [f"poses = {call_of(solver)}" for solver in oneac.solvers()]
    for program in (SOURCE / "docs" / "examples" / "benchmark_row.py",
                    program_of(tmp_path, "right.py", lines)):
        assert type_faults(tmp_path, program) == []


@pytest.mark.skipif(shutil.which("mypy") is None, reason="mypy is not installed")
def test_each_wrong_line_fails_the_type_check_for_its_own_reason(tmp_path):
    wrong = WRONG + [(f"oneac.{solver.name}([0, 0])", "call-arg", "Missing positional argument")
                     for solver in oneac.solvers()]
    faults = type_faults(tmp_path, program_of(tmp_path, "wrong.py", [line for line, *_ in wrong]))
    assert len(faults) == len(wrong), "\n".join(faults)
    for number, (fault, (line, code, words)) in enumerate(zip(faults, wrong), 4):
        told = re.fullmatch(r"wrong\.py:(\d+): error: (.*)  \[([\w-]+)\]", fault)
        assert told and (int(told[1]), told[3]) == (number, code), (line, fault)
        assert words in told[2], (line, fault)


CAMERA = (480, 360, 375, 376, 240.5, 180.25, (0.1, -0.01, 0.0, 1e-3), "kannala_brandt")


def test_a_camera_can_be_copied_and_pickled():
    camera = oneac.Camera(*CAMERA)
    for twin in (copy.copy(camera), copy.deepcopy(camera), pickle.loads(pickle.dumps(camera))):
        assert twin is not camera and twin.lens == "kannala_brandt"
        assert (twin.width, twin.height, twin.distortion) == (480, 360, camera.distortion)
        np.testing.assert_array_equal(twin.K, camera.K)


def test_cameras_are_equal_when_all_their_numbers_are():
    camera = oneac.Camera(*CAMERA)
    assert camera == oneac.Camera(*CAMERA) and hash(camera) == hash(oneac.Camera(*CAMERA))
    assert not camera != oneac.Camera(*CAMERA)
    others = [481, 361, 377, 377, 241, 181, (0.1, -0.01), "plumb_bob"]
    for i, other in enumerate(others):
        assert camera != oneac.Camera(*CAMERA[:i], other, *CAMERA[i + 1:]), i
    assert camera != CAMERA and camera is not None and len({camera, oneac.Camera(*CAMERA)}) == 1


@pytest.mark.parametrize("distortion", [np.zeros(9), np.zeros((1, 5)), ["k1"], 0.1, "none", [1j]])
def test_distortion_is_a_row_of_at_most_eight_numbers(distortion):
    with pytest.raises(ValueError, match="distortion"):
        oneac.Camera(480, 360, 375, 375, 240, 180, distortion)


def test_the_example_prints_a_row_of_the_table(tmp_path):
    conftest.oneac("simulate", "-o", tmp_path, "--frames", 60, "--width", 320, "--height", 240,
                   "--focal", 250)
    script = SOURCE / "docs" / "examples" / "benchmark_row.py"
    assert len(script.read_text().splitlines()) <= 25
    done = subprocess.run([sys.executable, script, tmp_path / "simulated.rawlog",
                           tmp_path / "poses.txt", "0"], text=True, capture_output=True, check=True)
    assert done.stdout.startswith("| 60 frames") and "| 0 of 59 |" in done.stdout
