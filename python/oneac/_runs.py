"""The folder that `oneac run` writes, as arrays."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _oneac
from ._results import Covariances, RelativePoses, Trajectory

__all__ = ["Run", "read_run", "read_summary"]


@dataclass(frozen=True, eq=False)
class Run:
    """What `oneac run` found: docs/formats.md says what each file holds."""

    summary: dict[str, Any]
    """summary.json"""
    relative_poses: RelativePoses
    """relative_poses.csv"""
    covariances: Covariances
    """covariance.csv"""
    trajectory: Trajectory
    """trajectory_camera.tum: camera in the first camera's frame"""
    vehicle: Trajectory
    """trajectory_vehicle.tum: vehicle in its first frame"""


def read_summary(path: str | os.PathLike[str]) -> dict[str, Any]:
    """A summary.json. InputError when it is not there or no JSON object."""
    try:
        summary = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise _oneac.InputError(f"{path}: {error}; name a summary.json of oneac run") from error
    if not isinstance(summary, dict):
        raise _oneac.InputError(f"{path}: no JSON object; name a summary.json of oneac run")
    return summary


def read_run(folder: str | os.PathLike[str]) -> Run:
    """All of a run's folder. InputError naming the file that is missing or damaged."""
    place = Path(folder)
    return Run(
        summary=read_summary(place / "summary.json"),
        relative_poses=_oneac.read_relative_poses(place / "relative_poses.csv"),
        covariances=_oneac.read_covariances(place / "covariance.csv"),
        trajectory=_oneac.read_trajectory(place / "trajectory_camera.tum"),
        vehicle=_oneac.read_trajectory(place / "trajectory_vehicle.tum"),
    )
