import numpy as np
import pytest
import scenes

import oneac

FOCAL = 700.0


def pair(seed=0, outliers=0):
    """Levelled correspondences on the ground and elsewhere, with their motion."""
    rng = np.random.default_rng(seed)
    R, t = scenes.motion("planar motion", rng)
    normals = scenes.planes("ground", 100, rng) + scenes.planes("any scene", 200, rng)
    x1 = np.array([scenes.point(n / np.linalg.norm(n), rng) for n in normals])
    both = [scenes.correspondence(x, R, t, n) for x, n in zip(x1, normals)]
    x2, A = np.array([b[0] for b in both]), np.array([b[1] for b in both])
    x2 += rng.normal(scale=0.1 / FOCAL, size=x2.shape)
    x2[:outliers] += rng.uniform(-0.1, 0.1, size=(outliers, 2))
    return x1, x2, A, R, t / np.linalg.norm(t)


def check(result, R, t, outliers):
    assert result.status == "ok" and result.has_direction
    assert oneac.rotation_error(result.R, R) < np.radians(0.05)
    assert oneac.direction_error(result.t, t) < np.radians(0.5)
    assert result.inliers.dtype == bool and result.inliers.shape == (300,)
    assert result.inlier_count == result.inliers.sum() > 280 - outliers
    assert result.inliers[:outliers].sum() < 0.1 * outliers + 1
    assert result.covariance.shape == (6, 6)


def test_the_consensus_finds_the_motion():
    x1, x2, A, R, t = pair(outliers=60)
    check(oneac.one_ac_consensus(x1, x2, A, focal_px=FOCAL), R, t, 60)


@pytest.mark.parametrize("solver", ["essential_5pc", "relpose_1ac_planar", "homography_2ac"])
def test_gc_ransac_runs_any_solver(solver):
    x1, x2, A, R, t = pair(outliers=60)
    check(oneac.gc_ransac(solver, x1, x2, A, focal_px=FOCAL, seed=4), R, t, 60)


def test_gc_ransac_needs_affinities_only_where_the_solver_does():
    x1, x2, A, R, t = pair()
    check(oneac.gc_ransac("essential_5pc", x1, x2, focal_px=FOCAL), R, t, 0)
    with pytest.raises(ValueError, match="A is missing"):
        oneac.gc_ransac("relpose_1ac_ground", x1, x2, focal_px=FOCAL)


def test_the_same_seed_gives_the_same_bits():
    x1, x2, A, _, _ = pair(outliers=100)
    first, second = (oneac.gc_ransac("essential_5pc", x1, x2, focal_px=FOCAL, seed=9)
                     for _ in range(2))
    np.testing.assert_array_equal(first.R, second.R)
    assert first.iterations == second.iterations


@pytest.mark.parametrize("name", oneac.initialiser_names())
def test_every_initialiser_is_made_by_name(name):
    x1, x2, A, R, t = pair()
    method = oneac.Initialiser(name)
    assert method.name == name and method.estimators
    result = method.estimate(x1, x2, A, focal_px=FOCAL)
    assert oneac.rotation_error(result.R, R) < np.radians(0.2)
    assert oneac.direction_error(result.t, t) < np.radians(3)


def test_a_tilted_camera_is_levelled():
    x1, x2, A, R, t = pair()
    L = oneac.levelling_rotation(np.radians(8), np.radians(-2))
    tilted = oneac.rotate_views(x1, x2, A, L.T)
    result = oneac.one_ac_consensus(*tilted, focal_px=FOCAL, R_level_cam=L)
    assert oneac.rotation_error(result.R, L.T @ R @ L) < np.radians(0.05)
    assert oneac.direction_error(result.t, L.T @ t) < np.radians(0.5)


def test_options_are_those_of_the_parameters():
    x1, x2, A, _, _ = pair()
    tight = oneac.one_ac_consensus(x1, x2, A, focal_px=FOCAL, threshold_px=0.05)
    assert tight.inlier_count < 200
    with pytest.raises(ValueError, match="treshold_px.*threshold_px"):
        oneac.one_ac_consensus(x1, x2, A, focal_px=FOCAL, treshold_px=1)
    with pytest.raises(ValueError, match="threshold_px"):
        oneac.gc_ransac("essential_5pc", x1, x2, focal_px=FOCAL, threshold_px=-1)
    with pytest.raises(ValueError, match="threshold_px.*number"):
        oneac.Initialiser("5pc", gc_ransac={"threshold_px": "wide"})
    with pytest.raises(ValueError, match="estimator"):
        oneac.Initialiser("5pc", estimator="consensus")


def test_an_unknown_initialiser_is_an_input_error_with_the_nearest():
    with pytest.raises(oneac.InputError, match="1ac_poold.*did you mean '1ac_pooled'") as caught:
        oneac.Initialiser("1ac_poold")
    assert isinstance(caught.value, ValueError) and type(caught.value).__module__ == "oneac"


@pytest.mark.parametrize("focal", [0, -1, np.nan, np.inf])
def test_a_focal_length_that_is_none_is_refused(focal):
    x1, x2, A, _, _ = pair()
    for call in (lambda: oneac.one_ac_consensus(x1, x2, A, focal_px=focal),
                 lambda: oneac.gc_ransac("essential_5pc", x1, x2, focal_px=focal),
                 lambda: oneac.Initialiser("5pc").estimate(x1, x2, A, focal_px=focal)):
        with pytest.raises(ValueError, match="focal_px"):
            call()


def test_bad_rotations_priors_and_numbers_are_named():
    x1, x2, A, _, _ = pair()
    with pytest.raises(ValueError, match="R_level_cam is no rotation"):
        oneac.one_ac_consensus(x1, x2, A, focal_px=FOCAL, R_level_cam=2 * np.eye(3))
    with pytest.raises(ValueError, match="prior has no 'speed'"):
        oneac.one_ac_consensus(x1, x2, A, focal_px=FOCAL, prior={"speed": 1})
    A[7] = np.nan
    with pytest.raises(ValueError, match=r"A\[7\] is not finite"):
        oneac.one_ac_consensus(x1, x2, A, focal_px=FOCAL)


def test_few_correspondences_are_no_pose():
    x1, x2, A, _, _ = pair()
    result = oneac.one_ac_consensus(x1[:3], x2[:3], A[:3], focal_px=FOCAL)
    assert result.status == "too_few" and not result.has_direction
    empty = oneac.gc_ransac("essential_5pc", np.zeros((0, 2)), np.zeros((0, 2)), focal_px=FOCAL)
    assert empty.status == "too_few" and np.isfinite(empty.R).all()


def test_pixels_become_normalised():
    K = np.array([[700.0, 0, 320], [0, 710, 240], [0, 0, 1]])
    x1, x2, A, _, _ = pair()
    u1, u2 = (x @ K[:2, :2].T + K[:2, 2] for x in (x1, x2))
    A_px = K[:2, :2] @ A @ np.linalg.inv(K[:2, :2])
    back = oneac.normalise(u1, u2, A_px, K)
    for found, expected in zip(back, (x1, x2, A)):
        np.testing.assert_allclose(found, expected, atol=1e-12)
    with pytest.raises(ValueError, match="K1 must be"):
        oneac.normalise(u1, u2, A_px, K + np.eye(3)[[1, 0, 2]])
