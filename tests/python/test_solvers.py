import threading

import numpy as np
import pytest
import scenes

import oneac

SOLVERS = oneac.solvers()
BY_NAME = pytest.mark.parametrize("solver", SOLVERS, ids=lambda s: s.name)


def arguments(solver, x1, x2, A):
    return (x1, x2, A) if solver.affine else (x1, x2)


def one_sample(solver, seed):
    x1, x2, A, R, t = scenes.scene(solver, np.random.default_rng(seed), solver.sample)
    if solver.sample == 1:
        x1, x2, A = x1[0], x2[0], A[0]
    return x1, x2, A, R, t


def direction(t):
    return t / np.linalg.norm(t)


def distance(poses, R, t):
    """Of the nearest of the poses of one sample."""
    return min((np.abs(r - R).max() + np.abs(direction(s) - direction(t)).max()
                for r, s in zip(poses.R, poses.t)), default=np.inf)


@BY_NAME
def test_has_a_function_with_its_comment_and_shapes(solver):
    function = getattr(oneac, solver.name)
    assert solver.name in oneac.__all__
    for word in ("x1, x2", "Returns", "Raises", solver.assumptions, solver.unit):
        assert word in function.__doc__
    assert len(function.__doc__.split("\n")[2]) > 20, "no comment of a header"


@BY_NAME
def test_recovers_the_motion_of_its_scene(solver):
    found = 0
    for seed in range(20):
        x1, x2, A, R, t = one_sample(solver, seed)
        poses = getattr(oneac, solver.name)(*arguments(solver, x1, x2, A))
        assert poses.R.shape == (poses.count, 3, 3) and poses.t.shape == (poses.count, 3)
        found += distance(poses, R, t) < 1e-6
    assert found >= 17, found


def test_ground_gives_lengths_in_camera_heights():
    x1, x2, A, R, t = one_sample(oneac.solver("relpose_1ac_ground"), 3)
    poses = oneac.relpose_1ac_ground(x1, x2, A)
    np.testing.assert_allclose(poses.t[0], t, atol=1e-9)
    np.testing.assert_allclose(poses.n[0], [0, 1, 0])


@BY_NAME
def test_many_samples_at_once_are_the_samples_one_by_one(solver):
    singles = [one_sample(solver, seed)[:3] for seed in range(7)]
    stack = [np.stack(parts) for parts in zip(*singles)]
    stack[0][3] = 0.0  # no sample at all
    poses = solver.solve(*arguments(solver, *stack))
    assert poses.R.shape == (7, solver.max_poses, 3, 3) and poses.count.shape == (7,)
    for i, sample in enumerate(zip(*stack)):
        alone = solver.solve(*arguments(solver, *sample))
        assert poses.count[i] == alone.count == len(alone.R)
        # Rows with a batch form: within 1e-9, the others to the last bit.
        np.testing.assert_allclose(poses.R[i, : alone.count], alone.R, atol=1e-9, rtol=0)
        np.testing.assert_allclose(poses.t[i, : alone.count], alone.t, atol=1e-9, rtol=0)
        np.testing.assert_array_equal(poses.n[i, : alone.count], alone.n)
        assert (poses.t[i, alone.count:] == 0).all()


@BY_NAME
def test_essential_matrices_hold_for_the_sample(solver):
    x1, x2, A, R, t = one_sample(solver, 5)
    E, count = solver.essentials(*arguments(solver, x1, x2, A))
    assert count >= 1
    e = E[:count]
    np.testing.assert_allclose(np.linalg.norm(e, axis=(1, 2)), np.sqrt(2), atol=1e-9)
    true = np.cross(np.eye(3), direction(t)) @ R
    gap = np.minimum(np.abs(e - true).max((1, 2)), np.abs(e + true).max((1, 2)))
    transposed = np.cross(np.eye(3), -direction(t)) @ R
    gap = np.minimum(gap, np.abs(e - transposed).max((1, 2)))
    assert gap.min() < 1e-5


@BY_NAME
def test_least_squares_take_any_number(solver):
    x1, x2, A, R, t = scenes.scene(solver, np.random.default_rng(8), solver.sample + 12)
    if not solver.has_least_squares:
        with pytest.raises(ValueError, match="no form for more"):
            solver.least_squares(*arguments(solver, x1, x2, A))
        return
    poses = solver.least_squares(*arguments(solver, x1, x2, A))
    assert distance(poses, R, t) < 1e-5
    with pytest.raises(ValueError, match=r"must have \(N, 2\)"):
        solver.least_squares(*arguments(solver, x1[None], x2[None], A[None]))


@BY_NAME
def test_planar_form_is_the_solver(solver):
    if not solver.has_planar:
        x = np.zeros((3, 2))
        with pytest.raises(ValueError, match="one planar motion"):
            solver.planar(x, x, np.zeros((3, 2, 2)))
        return
    rng = np.random.default_rng(1)
    parts = [scenes.scene(solver, rng, 1)[:3] for _ in range(1500)]
    stack = [np.concatenate(column) for column in zip(*parts)]
    stack[0][11] = stack[1][11] = 0.0
    poses, planar = solver.solve(*arguments(solver, *stack)), solver.planar(*stack)
    np.testing.assert_array_equal(planar.valid, poses.count == 1)
    some = planar.valid
    assert some.sum() > 1400
    np.testing.assert_allclose(planar.R[some], poses.R[some, 0], atol=1e-9)
    np.testing.assert_allclose(planar.t[some], poses.t[some, 0], atol=1e-9)
    assert (planar.cos_alpha[~some] == 1).all()


@BY_NAME
def test_other_shapes_are_one_clear_error(solver):
    x1, x2, A, _, _ = one_sample(solver, 0)
    for bad in (x1[..., :1], np.zeros((2, 2, 2, 2, 2)), np.zeros(()), np.zeros((12, 12, 2))):
        with pytest.raises(ValueError, match="x1 has shape .*(takes|must have)"):
            solver.solve(*arguments(solver, bad, bad, np.zeros(bad.shape[:-1] + (2, 2))))
    with pytest.raises(ValueError, match="x2 has shape"):
        solver.solve(*arguments(solver, x1, x2[..., :1], A))
    if solver.affine:
        with pytest.raises(ValueError, match="A has shape"):
            solver.solve(x1, x2, A[..., 0])
        with pytest.raises(ValueError, match="A is missing"):
            solver.solve(x1, x2)


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf])
@BY_NAME
def test_a_number_that_is_not_finite_is_named(solver, number):
    sample = one_sample(solver, 0)[:3]
    for i, name in enumerate(("x1", "x2", "A")[: 3 if solver.affine else 2]):
        bad = [part.copy() for part in sample]
        bad[i].flat[-1] = number
        with pytest.raises(ValueError, match=rf"{name}\[{solver.sample - 1}\] is not finite"):
            solver.solve(*arguments(solver, *bad))


@pytest.mark.parametrize("bad", ["text", [[1, 2], [3]], 1j * np.ones(2), None, [True, False]])
def test_what_are_no_numbers_is_an_error(bad):
    with pytest.raises(ValueError, match="x1"):
        oneac.relpose_1ac_ground(bad, [0, 0], np.eye(2))


def test_lists_other_types_and_orders_of_memory_will_do():
    x1, x2, A, _, _ = one_sample(oneac.solver("relpose_1ac_ground"), 1)
    expected = oneac.relpose_1ac_ground(x1, x2, A)
    poses = oneac.relpose_1ac_ground(list(x1), tuple(x2), np.asfortranarray(A))
    np.testing.assert_array_equal(poses.t, expected.t)
    near = oneac.relpose_1ac_ground(*(part.astype(np.float32) for part in (x1, x2, A)))
    np.testing.assert_allclose(near.t, expected.t, atol=1e-3)


def test_masked_numbers_are_refused():
    sample = one_sample(oneac.solver("relpose_1ac_ground"), 1)[:3]
    expected = oneac.relpose_1ac_ground(*sample)
    for i, name in enumerate(("x1", "x2", "A")):
        masked = [*sample]
        masked[i] = np.ma.masked_array(sample[i], np.zeros(sample[i].shape, bool))
        np.testing.assert_array_equal(oneac.relpose_1ac_ground(*masked).t, expected.t)
        masked[i].mask.flat[0] = True
        with pytest.raises(ValueError, match=f"{name} has masked entries"):
            oneac.relpose_1ac_ground(*masked)
    rows = [np.ma.masked_array(part, part == part[0]) for part in sample[2]]
    with pytest.raises(ValueError, match="A has masked entries"):
        oneac.relpose_1ac_ground(*sample[:2], rows)


def test_no_samples_give_no_poses():
    poses = oneac.essential_5pc(np.zeros((0, 5, 2)), np.zeros((0, 5, 2)))
    assert poses.R.shape == (0, 10, 3, 3) and poses.count.shape == (0,)


def test_an_unknown_name_is_an_error():
    with pytest.raises(ValueError, match="relpose_1ac_moon"):
        oneac.solver("relpose_1ac_moon")


def test_other_threads_go_on_meanwhile():
    solver = oneac.solver("essential_5pc")
    x1, x2 = np.random.default_rng(0).uniform(-0.5, 0.5, size=(2, 30000, 5, 2))
    entered = threading.Event()

    def work():
        entered.set()
        solver.solve(x1, x2)

    thread = threading.Thread(target=work)
    thread.start()
    entered.wait()
    rounds = 0
    while thread.is_alive():
        rounds += 1
    assert rounds > 1000  # a call that kept the lock would let this thread run some three times


def test_the_focal_length_comes_with_the_motion():
    rng = np.random.default_rng(5)
    stack = []
    for _ in range(700):
        R, _ = scenes.motion("planar motion", rng)
        t = np.array([rng.choice([-0.4, 0.4]), 0, -0.5])  # a turn and a travel that show it
        n = np.array([0.2, 0.5, 0.8])
        n /= np.linalg.norm(n)
        x1 = scenes.point(n, rng)
        x2, A = scenes.correspondence(x1, R, t, n)
        stack.append((1.25 * x1, 1.25 * x2, A))  # assumed: a focal length 1.25 times too short
    x1, x2, A = map(np.array, zip(*stack))
    found = oneac.planar_focal(x1, x2, A, max_ratio=2)  # as the list has it
    poses = oneac.relpose_1ac_planar_focal(x1, x2, A)
    np.testing.assert_array_equal(found.valid, poses.count == 1)
    assert found.valid.mean() > 0.5
    strong = found.valid & (found.strength > 1e-3)
    np.testing.assert_allclose(found.focal[strong], 1.25, rtol=1e-6)
    np.testing.assert_allclose(found.R[strong], poses.R[strong, 0], atol=1e-9)
    assert np.isnan(found.focal[~found.valid]).all()
    kept = oneac.planar_focal(x1, x2, A, max_ratio=1.1)
    assert not (kept.valid & strong).any()
    one = oneac.planar_focal_of_all(x1[:1], x2[:1], A[:1], weights=[2.0])
    assert len(one.focal) == 1
    for call in (lambda: oneac.planar_focal(x1[0], x2[0], A[0]),
                 lambda: oneac.planar_focal(x1, x2, A, max_ratio=0.5),
                 lambda: oneac.planar_focal_of_all(x1, x2, A, weights=[1.0])):
        with pytest.raises(ValueError, match="must"):
            call()


def test_the_list_says_what_a_solver_costs_and_who_pools_it():
    assert all(solver.typical_ns > 0 for solver in oneac.solvers())
    assert "relpose_1ac_ground" in [s.name for s in oneac.solvers() if s.in_pool]
