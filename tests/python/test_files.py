import csv
import dataclasses
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


def test_a_trajectory_is_compared_without_its_pairs(drive, result):
    run = oneac.read_run(result)
    reference = oneac.read_trajectory(drive / "poses.txt")
    alone = oneac.evaluate(None, run.trajectory, reference).trajectory
    with_pairs = oneac.evaluate(run.relative_poses, run.trajectory, reference).trajectory
    assert alone.frames == 24 and alone.ape.rmse == with_pairs.ape.rmse > 0
    times = run.trajectory.times
    some = oneac.Trajectory(run.trajectory.T[3:9], times[3:9])
    by_time = oneac.evaluate(None, some, oneac.Trajectory(reference.T, times), "none")
    assert by_time.trajectory.frames == 6 and by_time.rotation_deg is None


def test_trajectories_that_cannot_be_compared_are_an_error(result):
    T, times = (path := oneac.read_run(result).trajectory).T, path.times
    for given, reference, words in (
            (None, path, "relative_poses and trajectory are None"),
            (oneac.Trajectory(T[:5]), path, "5 poses, the reference has 24 poses: must be as many"),
            (oneac.Trajectory(T, times + 1e3), path, "no frame in common"),
            (oneac.Trajectory(T[:0]), oneac.Trajectory(T[:0]), "no frame in common")):
        with pytest.raises(ValueError, match=words):
            oneac.evaluate(None, given, reference)


def test_a_trajectory_that_is_left_out_is_noted(result):
    run = oneac.read_run(result)
    elsewhen = oneac.Trajectory(run.trajectory.T, run.trajectory.times + 1e3)
    found = oneac.evaluate(run.relative_poses, run.trajectory, elsewhen)
    assert found.trajectory is None and "no frame in common" in found.notes[-1]


def test_what_is_no_rotation_is_refused_with_its_row(result):
    run = oneac.read_run(result)
    path, pairs = run.trajectory, run.relative_poses
    mirrored, sheared, projective = path.T.copy(), path.T.copy(), path.T.copy()
    mirrored[7, :3, 0] *= -1
    sheared[7, 0, 1] += 0.01
    projective[7, 3, 3] = 2
    for bad, row in ((path.T * 2, 0), (mirrored, 7), (sheared, 7), (projective, 7)):
        bad = oneac.Trajectory(bad, path.times)
        for name, *given in (("trajectory", pairs, bad, path), ("reference", pairs, path, bad),
                             ("trajectory", None, bad, path)):
            fault = rf"^{name}\.T\[{row}\] is no (rotation|rigid pose): .+$"
            with pytest.raises(ValueError, match=fault):
                oneac.evaluate(*given)
    for R in (-pairs.R, pairs.R * 1.01):
        with pytest.raises(ValueError, match=r"^relative_poses\.R\[0\] is no rotation: .+$"):
            oneac.evaluate(dataclasses.replace(pairs, R=R), None, path)


def test_rotations_may_be_rounded_as_in_files(result):
    path = oneac.read_run(result).trajectory
    rounded = oneac.Trajectory(path.T.round(4), path.times)
    assert oneac.evaluate(None, rounded, path).trajectory.ape.max < 1e-3


def test_masked_rows_are_refused(result):
    path = oneac.read_run(result).trajectory
    mask = np.zeros(path.T.shape, bool)
    whole = oneac.Trajectory(np.ma.masked_array(path.T, mask), path.times)
    assert oneac.evaluate(None, whole, path).trajectory.ape.max < 1e-9
    mask[4] = True
    with pytest.raises(ValueError, match="T has masked entries"):
        oneac.evaluate(None, oneac.Trajectory(np.ma.masked_array(path.T, mask), path.times), path)
    pairs = oneac.read_run(result).relative_poses
    metric = np.ma.masked_array(pairs.metric, pairs.index1 == 4)
    with pytest.raises(ValueError, match="metric has masked entries"):
        oneac.evaluate(dataclasses.replace(pairs, metric=metric), None, path)


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
