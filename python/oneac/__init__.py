"""oneac: relative poses from one affine correspondence, and a front-end for vehicles.

Conventions of all functions: camera X right, Y down, Z forward; X2 = R X1 + t; normalised points
x1, x2 (x = K⁻¹ u), A = ∂x2/∂x1; T_b_a maps a to b. Lengths are metres only where a result says
metric. A wrong shape, a number that is not finite or an option out of bounds is a ValueError that
names it; input that cannot be used is an InputError: where, fault, cure.

    oneac.relpose_1ac_ground(x1, x2, A)      every solver: oneac.solvers()
    oneac.one_ac_consensus(x1, x2, A, focal_px=700), oneac.gc_ransac("essential_5pc", x1, x2, …)
    oneac.Initialiser("1ac_pooled").estimate(x1, x2, A, focal_px=700)
    oneac.planar_focal(x1, x2, A)            the focal length with the motion
    oneac.FrontEnd(camera, camera_height=1.65).feed(image, time_s)
    oneac.Rawlog("drive.rawlog"), oneac.read_run("result")

docs/tutorial-python.md shows them at work.
"""

from . import _results, _runs, _solvers
from ._oneac import (
    Camera,
    Frame,
    FrontEnd,
    Initialiser,
    InputError,
    Rawlog,
    Solver,
    describe_log,
    direction_error,
    evaluate,
    gc_ransac,
    initialiser_names,
    levelling_rotation,
    mount,
    normalise,
    one_ac_consensus,
    planar_focal,
    planar_focal_of_all,
    read_covariances,
    read_relative_poses,
    read_sensors,
    read_trajectory,
    rotate_views,
    rotation_error,
    solver,
    solvers,
    version,
)
from ._results import *  # noqa: F403
from ._runs import *  # noqa: F403
from ._solvers import *  # noqa: F403

__version__ = version().split()[0]

__all__ = [
    "Camera",
    "Frame",
    "FrontEnd",
    "Initialiser",
    "InputError",
    "Rawlog",
    "Solver",
    "describe_log",
    "direction_error",
    "evaluate",
    "gc_ransac",
    "initialiser_names",
    "levelling_rotation",
    "mount",
    "normalise",
    "one_ac_consensus",
    "planar_focal",
    "planar_focal_of_all",
    "read_covariances",
    "read_relative_poses",
    "read_sensors",
    "read_trajectory",
    "rotate_views",
    "rotation_error",
    "solver",
    "solvers",
    "version",
]
__all__ += _results.__all__
__all__ += _runs.__all__
__all__ += _solvers.__all__
