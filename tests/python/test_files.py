import csv
import json

import numpy as np
import pytest

import oneac


def test_a_run_reads_as_arrays(result):
    run = oneac.read_run(result)
    with open(result / "relative_poses.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    poses = run.relative_poses
    assert len(poses) == len(rows) == 23
    np.testing.assert_array_equal(poses.t[:, 2], [float(row["tz"]) for row in rows])
    np.testing.assert_array_equal(poses.index2, [int(row["index2"]) for row in rows])
    assert poses.metric.dtype == bool and poses.status == [row["status"] for row in rows]
    np.testing.assert_allclose(np.linalg.det(poses.R), 1.0)
    assert run.covariances.covariance.shape == (23, 6, 6)
    np.testing.assert_array_equal(run.covariances.covariance,
                                  np.swapaxes(run.covariances.covariance, 1, 2))
    assert run.trajectory.T.shape == (24, 4, 4) and len(run.vehicle) == 24
    assert run.trajectory.positions.shape == (24, 3)
    assert run.summary == json.loads((result / "summary.json").read_text())


def test_no_length_has_no_sigma(result, tmp_path):
    lines = (result / "relative_poses.csv").read_text().splitlines()
    columns, values = lines[0].split(","), lines[1].split(",")
    values[columns.index("metric")], values[columns.index("sigma_length")] = "0", ""
    (tmp_path / "relative_poses.csv").write_text("\n".join([lines[0], ",".join(values), ""]))
    poses = oneac.read_relative_poses(tmp_path / "relative_poses.csv")
    assert np.isnan(poses.sigma_length).all() and not poses.metric.any()


def test_errors_are_those_of_the_run(drive, result):
    run = oneac.read_run(result)
    reference = oneac.read_trajectory(drive / "poses.txt")
    found = oneac.evaluate(run.relative_poses, run.trajectory, reference)
    told = json.dumps(run.summary)
    assert found.bad == 0 and len(found.pairs.rotation_deg) == 23
    assert str(found.rotation_deg.mean)[:9] in told
    assert str(found.trajectory.ape.rmse)[:9] in told
    assert found.trajectory.alignment == "se3"
    alone = oneac.evaluate(run.relative_poses, None, reference)
    assert alone.trajectory is None and alone.rotation_deg.mean == found.rotation_deg.mean


def test_what_does_not_fit_is_an_error(drive, result):
    run = oneac.read_run(result)
    reference = oneac.read_trajectory(drive / "poses.txt")
    with pytest.raises(ValueError, match="alignment|none, se3"):
        oneac.evaluate(run.relative_poses, run.trajectory, reference, "affine")
    with pytest.raises(ValueError, match="T has shape"):
        oneac.evaluate(None, oneac.Trajectory(np.eye(3)[None]), reference)
    short = oneac.Trajectory(run.trajectory.T[:5], run.trajectory.times[:5])
    with pytest.raises(ValueError):
        oneac.evaluate(run.relative_poses, short, reference)


def test_unreadable_files_are_input_errors_with_their_place(result, tmp_path):
    text = (result / "relative_poses.csv").read_text().splitlines()
    text[3] = text[3].replace(",", ";", 1)
    (tmp_path / "relative_poses.csv").write_text("\n".join(text))
    with pytest.raises(oneac.InputError, match="line 4|:4"):
        oneac.read_relative_poses(tmp_path / "relative_poses.csv")
    for read in (oneac.read_relative_poses, oneac.read_trajectory, oneac.read_covariances,
                 oneac.read_summary, oneac.read_run):
        with pytest.raises(oneac.InputError, match="none"):
            read(tmp_path / "none")
    (tmp_path / "summary.json").write_text("[1]")
    with pytest.raises(oneac.InputError, match="no JSON object"):
        oneac.read_summary(tmp_path / "summary.json")
