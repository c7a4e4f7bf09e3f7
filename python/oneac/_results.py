"""What functions answer: plain records of numpy arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._oneac import Camera

__all__ = [
    "CameraBelief",
    "Correspondences",
    "Covariances",
    "Evaluation",
    "FrameResult",
    "Gps",
    "Imu",
    "MotionEvidence",
    "PairErrors",
    "PlanarFocals",
    "PlanarPoses",
    "Poses",
    "RawlogReport",
    "RelativePoses",
    "RobustResult",
    "Sensors",
    "Speeds",
    "Statistics",
    "Step",
    "TiltBelief",
    "Trajectory",
    "TrajectoryErrors",
]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]


class Poses(NamedTuple):
    """Solutions of one sample, (S, …), or of N samples, (N, M, …) with `count` (N,) of M used.

    What is not used is no motion: R = I, t = 0, n = 0.
    """

    R: Floats
    """(…, 3, 3) rotation: X2 = R X1 + t"""
    t: Floats
    """(…, 3) translation, in the solver's unit"""
    n: Floats
    """(…, 3) normal of the plane, n·X = d in the first camera; means nothing without one"""
    count: Integers  # type: ignore[assignment]  # instead of tuple's own
    """solutions per sample"""


class PlanarPoses(NamedTuple):
    """One planar motion per correspondence: R of the yaw α, t = (tx, 0, tz); identity if invalid."""

    cos_alpha: Floats
    sin_alpha: Floats
    tx: Floats
    """in the solver's unit"""
    tz: Floats
    """in the solver's unit"""
    valid: Flags
    """whether the solver found one"""

    @property
    def R(self) -> Floats:
        """(N, 3, 3): rows (c, 0, −s), (0, 1, 0), (s, 0, c)."""
        R = np.zeros((len(self.tx), 3, 3))
        R[:, 0, 0] = R[:, 2, 2] = self.cos_alpha
        R[:, 2, 0] = self.sin_alpha
        R[:, 0, 2] = -self.sin_alpha
        R[:, 1, 1] = 1.0
        return R

    @property
    def t(self) -> Floats:
        """(N, 3)."""
        return np.stack([self.tx, np.zeros_like(self.tx), self.tz], axis=1)


class PlanarFocals(NamedTuple):
    """Planar motions, |t| = 1, with the focal length that both views share."""

    cos_alpha: Floats
    sin_alpha: Floats
    tx: Floats
    tz: Floats
    focal: Floats
    """true over assumed focal length, pixels for points in pixels; NaN where none was found"""
    strength: Floats
    """how well the motion shows it: the error of ln focal is the correspondence's over it"""
    valid: Flags
    """whether the solver found one"""

    @property
    def R(self) -> Floats:
        """(N, 3, 3), as of PlanarPoses."""
        return PlanarPoses(*self[:4], self.valid).R

    @property
    def t(self) -> Floats:
        """(N, 3)."""
        return PlanarPoses(*self[:4], self.valid).t


class Correspondences(NamedTuple):
    """Affine correspondences [px]."""

    u1: Floats
    """(N, 2)"""
    u2: Floats
    """(N, 2)"""
    A: Floats
    """(N, 2, 2) ∂u2/∂u1"""


@dataclass(frozen=True, eq=False)
class MotionEvidence:
    """How sure the choice between rest and travel is."""

    model: str
    """still, rotation or translation"""
    log_odds: float
    """translation against the better of the others [nats]"""
    length: float
    """|t| by the road's points [camera heights]"""
    length_sigma: float
    """1σ of it; infinite when no road was seen"""


@dataclass(frozen=True, eq=False)
class RobustResult:
    """What a robust estimator found."""

    status: str
    """ok, one_plane, pure_rotation, no_motion or too_few"""
    R: Floats
    """(3, 3) of the camera as it is mounted: X2 = R X1 + t"""
    t: Floats
    """(3,) of length 1, or 0 without travel"""
    inliers: Flags
    """(N,)"""
    cost: float
    """MSAC cost, 0 … N"""
    covariance: Floats
    """(6, 6) of (w, b): R = exp([w]×) R̂, t = t̂ + b, b ⊥ t̂ [rad²]; zero where not estimated"""
    motion: MotionEvidence | None
    """where rest was a question"""
    inlier_count: int
    iterations: int
    """minimal samples drawn, or correspondences solved"""
    hypotheses: int
    local_optimisations: int
    graph_cuts: int

    @property
    def has_direction(self) -> bool:
        """A pose with a direction of translation came out."""
        return self.status in ("ok", "one_plane")


@dataclass(frozen=True, eq=False)
class Step:
    """The motion from the frame before to this one."""

    index1: int
    index2: int
    time1: float
    time2: float
    status: str
    """ok, no_motion, or predicted: the last motion goes on"""
    R: Floats
    """(3, 3): X2 = R X1 + t, optical frames"""
    t: Floats
    """(3,) in metres where metric, else of length 1 or 0"""
    metric: bool
    length: float
    """used in the trajectory [m, or units while the drive has no scale]"""
    length_sigma: float
    """relative 1σ of a metric length"""
    covariance: Floats
    """(6, 6) of (w, t) in the second camera's frame [rad², m² where metric]"""
    acs: int
    inliers: int
    segment: int
    """raised when tracking had to start anew"""


@dataclass(frozen=True, eq=False)
class FrameResult:
    """Pose of one frame as known when it came; FrontEnd.trajectory has the final ones."""

    index: int
    time_s: float
    T_first_cam: Floats
    """(4, 4) camera in the first camera's frame"""
    T_odom_cam: Floats
    """(4, 4) the same by the steps alone: drifts, never jumps"""
    step: Step | None
    """None for the first frame"""
    pitch_up: float
    """[rad] the camera's tilt as believed now"""
    roll_right: float
    """[rad]"""
    keyframe: int | None
    """its number, when this frame became one"""


@dataclass(frozen=True, eq=False)
class TiltBelief:
    """The camera's tilt against the road [rad]."""

    pitch_up: float
    roll_right: float
    pitch_sigma: float
    """1σ"""
    roll_sigma: float
    """1σ"""


@dataclass(frozen=True, eq=False)
class CameraBelief:
    """The camera as given, as used, and as the drive says that it is."""

    given: Camera
    """of the images as the front-end gets them"""
    used: Camera
    """from the newest frame on, without what its lens was found to do"""
    raw_used: Camera
    """of the images as they are stored, from the newest frame on"""
    raw_learned: Camera
    """the same, most probable by bends"""
    raw_sigma: Floats
    """1σ of it: ln f, cx and cy over f, k1, k2"""
    focal_px: float
    """most probable focal length"""
    focal_sigma: float
    """relative 1σ of it"""
    drive_sigma: float
    """the same by the drive alone; above 1: it cannot know"""
    bends: int
    """windows with a bend that were measured"""
    sensors: list[str]
    """whose turns count, too: gyroscope, GPS course"""
    contradicting: list[str]
    """whose turns contradict those of the images"""
    doubt: float
    """relative 1σ that lengths by the given focal length have for it"""
    knows_focal: bool
    """the drive has made the focal length surer than it was given"""


@dataclass(frozen=True, eq=False)
class RelativePoses:
    """Rows of a relative_poses.csv."""

    index1: Integers
    """images of the camera in the log"""
    index2: Integers
    t1: Floats
    """Unix time [s]"""
    t2: Floats
    R: Floats
    """(N, 3, 3): X2 = R X1 + t, optical frames"""
    t: Floats
    """(N, 3) in metres where metric, else of length 1 or 0"""
    metric: Flags
    inliers: Integers
    acs: Integers
    status: list[str]
    sigma_length: Floats
    """[m] 1σ of the length; NaN where not metric"""

    def __len__(self) -> int:
        return len(self.index1)


@dataclass(frozen=True, eq=False)
class Covariances:
    """Rows of a covariance.csv."""

    index1: Integers
    index2: Integers
    covariance: Floats
    """(N, 6, 6) of (w, t) in the second camera's frame, docs/conventions.md"""
    position_sigma: Floats
    """(N, 3) [m] of frame index2 in the first camera's frame; NaN without metres"""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses T_world_body."""

    T: Floats
    """(N, 4, 4)"""
    times: Floats | None = None
    """(N,) Unix time [s], increasing; None: not known"""

    @property
    def positions(self) -> Floats:
        """(N, 3) in the world."""
        return self.T[:, :3, 3]

    def __len__(self) -> int:
        return len(self.T)


@dataclass(frozen=True, eq=False)
class Statistics:
    """Of a set of errors."""

    count: int
    mean: float
    median: float
    p95: float
    rmse: float
    max: float


@dataclass(frozen=True, eq=False)
class PairErrors:
    """Of the pairs that have a reference."""

    index1: Integers
    index2: Integers
    true_step: Floats
    """[m]"""
    rotation_deg: Floats
    direction_deg: Floats
    """NaN where it cannot be judged"""
    length: Floats
    """|t| / |t_ref| − 1; NaN where not metric"""
    bad: Flags
    """rotation off by more than 1° or direction by more than 15°"""


@dataclass(frozen=True, eq=False)
class TrajectoryErrors:
    """Of a trajectory, docs/conventions.md."""

    frames: int
    length: float
    """path of the reference [m]"""
    alignment: str
    aligned_scale: float
    ape: Statistics
    """[m] after alignment"""
    t_rel_percent: float | None
    r_rel_deg_per_100m: float | None
    scale_error: float | None
    """path of estimate / of reference − 1, before alignment"""


@dataclass(frozen=True, eq=False)
class Evaluation:
    """Errors as `oneac eval` has them."""

    pairs: PairErrors
    rotation_deg: Statistics | None
    direction_deg: Statistics | None
    length: Statistics | None
    """of the absolute length errors [-]"""
    bad: int
    trajectory: TrajectoryErrors | None
    notes: list[str]


@dataclass(frozen=True, eq=False)
class Gps:
    """Epochs of a log's GPS; NaN for what an epoch does not tell."""

    time_s: Floats
    position_enu: Floats
    """(N, 3) east, north, up of the first fix [m]"""
    speed: Floats
    """over ground [m/s]"""
    course: Floats
    """clockwise from north [rad]"""


@dataclass(frozen=True, eq=False)
class Imu:
    """Samples of a log's IMU in the vehicle's axes; NaN for what a sample does not tell."""

    time_s: Floats
    acceleration: Floats
    """(N, 3) specific force [m/s²]"""
    angular_rate: Floats
    """(N, 3) [rad/s]"""


@dataclass(frozen=True, eq=False)
class Speeds:
    """Speeds over ground, in time order."""

    time_s: Floats
    speed: Floats
    """[m/s]"""
    sigma: Floats
    """[m/s] 1σ"""

    def __len__(self) -> int:
        return len(self.time_s)


class Sensors(NamedTuple):
    """What the other sensors of a log say."""

    gps: Gps
    imu: Imu


@dataclass(frozen=True, eq=False)
class RawlogReport:
    """What a pass over a log met so far."""

    images_in_log: int
    images_missing: int
    first_missing: str
    pairs_delivered: int
    damage: str
    """one line when the log ends badly, else empty"""
    first_lone: str = ""
    """first image that came without its right one, where that was asked for"""
    names_out_of_order: str = ""
    """one line when names of images do not follow their times, else empty"""
    wheel_readings: int = 0
    calibration_scaled: str = ""
    """one line when the calibration was given for another size, else empty"""
    undistorted_by_log: bool = False
    """images are taken for raw, because the log's calibration has distortion"""
