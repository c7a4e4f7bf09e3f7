"""Exact affine correspondences of scenes that a solver assumes."""

import numpy as np

MOTIONS = {"planar motion": ("y", "xz"), "circular planar motion": ("y", "circle"),
           "planar motion and a pitch": ("y", "xz"), "known vertical": ("y", "xyz"),
           "any motion": ("xyz", "xyz")}


def rotation(axis, angle):
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    V = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * V + (1 - np.cos(angle)) * V @ V


def motion(kind, rng):
    """R, t of about a step of a car; yaw_rotation() of docs/conventions.md is about −Y."""
    turn, travel = MOTIONS[kind]
    angle = rng.uniform(0.01, 0.1)
    R = rotation((0, -1, 0) if turn == "y" else rng.normal(size=3), angle)
    if travel == "circle":
        return R, 0.6 * np.array([np.sin(angle / 2), 0, -np.cos(angle / 2)])
    t = np.array([rng.uniform(-0.2, 0.2), rng.uniform(-0.1, 0.1), rng.uniform(-0.8, -0.4)])
    return R, t * (1, travel == "xyz", 1)


def normal(surface, rng):
    side = rng.uniform(0.9, 1.3) * rng.choice([-1, 1])
    return {
        "ground": np.array([0.0, 1.0, 0.0]),
        "wall along the road": np.array([1.0, 0.0, 0.0]),
        "wall across the road": np.array([0.0, 0.0, 1.0]),
        "any wall": np.array([np.sin(side), 0.0, np.cos(side)]),
    }.get(surface, np.array([0.2, 0.5, 0.8]) / np.linalg.norm([0.2, 0.5, 0.8]))


def correspondence(x1, R, t, n):
    """x2 and A of a point x1 on the plane n·X = 1."""
    H = R + np.outer(t, n)
    y = H @ np.append(x1, 1.0)
    x2 = y[:2] / y[2]
    return x2, (H[:2, :2] - np.outer(x2, H[2, :2])) / y[2]


def point(n, rng):
    """Before the camera on the plane, well off its horizon."""
    while True:
        x = rng.uniform(-0.6, 0.6, size=2)
        if n @ np.append(x, 1.0) > 0.15:
            return x


def planes(surface, count, rng):
    if surface in ("any scene", "no plane"):
        found = [np.array([rng.uniform(-0.4, 0.4), rng.uniform(0.1, 0.6), rng.uniform(0.3, 1)])
                 for _ in range(count)]
        return [n / np.linalg.norm(n) / rng.uniform(1, 4) for n in found]
    return [normal(surface, rng)] * count


def scene(solver, rng, count):
    """(x1, x2, A, R, t) with `count` correspondences, t in the solver's unit."""
    kind, surface = solver.assumptions.split(", ")
    R, t = motion(kind, rng)
    normals = planes(surface, count, rng)
    x1 = [point(n / np.linalg.norm(n), rng) for n in normals]
    pairs = [correspondence(x, R, t, n) for x, n in zip(x1, normals)]
    x2, A = [p[0] for p in pairs], [p[1] for p in pairs]
    return np.array(x1), np.array(x2), np.array(A), R, t
