#!/usr/bin/env python3
"""Loops of a run against the true poses of a simulated drive.

    loops_truth.py DRIVE RUN     DRIVE: folder with poses.txt, of oneac simulate or there_and_back.py,
                                 RUN: of oneac run --loops

Prints: loops; of the keyframes whose camera stands within 3 m and 15 degrees of an earlier keyframe's,
more than 30 m of driving ago, the share that has a loop; errors; false loops (off by more than 1 m or
3 degrees); how many lengths lie within two of their sigmas; how far from where it should be the drive ends.
"""
import csv
import math
import sys
from pathlib import Path


def times_of(path):
    return [float(line.split()[0]) for line in open(path) if not line.startswith("#")]


def transposed(R):
    return [list(row) for row in zip(*R)]


def product(A, B):
    return [[sum(a * b for a, b in zip(row, column)) for column in zip(*B)] for row in A]


def applied(R, v):
    return [sum(r * x for r, x in zip(row, v)) for row in R]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def angle(R):
    cosine = 0.5 * (R[0][0] + R[1][1] + R[2][2] - 1.0)
    return math.degrees(math.acos(max(-1.0, min(1.0, cosine))))


def rotation(w, x, y, z):
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def errors_of(row, poses):
    (Ra, a), (Rb, b) = (poses[int(row[name])] for name in ("index1", "index2"))
    Rt = transposed(Rb)
    true_t = applied(Rt, minus(a, b))
    R = rotation(*(float(row[name]) for name in ("qw", "qx", "qy", "qz")))
    t = [float(row[name]) for name in ("tx", "ty", "tz")]
    off = math.hypot(*minus(t, true_t))
    turn = angle(product(transposed(product(Rt, Ra)), R))
    length = (math.hypot(*t) - math.hypot(*true_t)) / float(row["sigma_length"])
    return off, turn, abs(length), math.hypot(*true_t)


def places_seen_again(keyframes, poses):
    driven = [0.0]
    for (_, a), (_, b) in zip(poses, poses[1:]):
        driven.append(driven[-1] + math.dist(a, b))

    def same(k, m):
        (Rk, a), (Rm, b) = poses[k], poses[m]
        near = driven[k] - driven[m] > 30.0 and math.dist(a, b) < 3.0
        return near and angle(product(transposed(Rk), Rm)) < 15.0

    return [k for i, k in enumerate(keyframes) if any(same(k, m) for m in keyframes[:i])]


def poses_of(path):
    poses = []
    for line in open(path):
        v = [float(word) for word in line.split()]
        poses.append(([v[0:3], v[4:7], v[8:11]], [v[3], v[7], v[11]]))
    return poses


def end_of(poses):
    """Where the last camera is in the first one's frame."""
    (R, begin), (_, end) = poses[0], poses[-1]
    return applied(transposed(R), minus(end, begin))


def main(drive, run):
    poses = poses_of(drive / "poses.txt")
    index_at = {t: i for i, t in enumerate(times_of(run / "trajectory_camera.tum"))}
    keyframes = [index_at[t] for t in times_of(run / "keyframes.tum")]
    rows = list(csv.DictReader(open(run / "loops.csv")))
    found = {int(row["index2"]) for row in rows}
    again = places_seen_again(keyframes, poses)
    got = sum(k in found for k in again)
    print(f"loops {len(rows)}, of {len(again)} places seen again {got}")
    if not rows:
        return
    off, turn, sigmas, apart = zip(*(errors_of(row, poses) for row in rows))
    false = sum(m > 1.0 or d > 3.0 for m, d in zip(off, turn))
    print(f"apart      median {quantile(apart, 0.5):.2f} m, largest {max(apart):.2f} m")
    print(f"position   median {quantile(off, 0.5):.3f} m, 95% {quantile(off, 0.95):.3f} m, largest {max(off):.3f} m")
    print(f"rotation   median {quantile(turn, 0.5):.3f} deg, largest {max(turn):.3f} deg")
    print(f"false      {false}")
    print(f"length within two sigmas {100.0 * sum(s < 2.0 for s in sigmas) / len(rows):.1f} %")
    off = [math.dist(end_of(poses_of(run / f"trajectory_{name}camera.kitti")), end_of(poses)) for name in ("", "optimised_")]
    print(f"end        off by {off[0]:.3f} m before, {off[1]:.3f} m after")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
