"""A simulated drive, and what `oneac run` makes of it, once for all tests of a file."""

import os
import subprocess

import pytest

PROGRAM = os.environ.get("ONEAC_PROGRAM", "oneac")


def oneac(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


@pytest.fixture(scope="session")
def drive(tmp_path_factory):
    """Folder of a drive of 24 small images: simulated.rawlog, Images, poses.txt."""
    folder = tmp_path_factory.mktemp("drive")
    oneac("simulate", "-o", folder, "--frames", 24, "--width", 480, "--height", 360, "--focal", 375)
    return folder


@pytest.fixture(scope="session")
def result(drive, tmp_path_factory):
    """Folder that `oneac run` wrote."""
    folder = tmp_path_factory.mktemp("result")
    oneac("run", drive / "simulated.rawlog", "-o", folder, "--quiet")
    return folder
