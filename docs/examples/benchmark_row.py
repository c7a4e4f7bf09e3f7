#!/usr/bin/env python3
"""Repeats a row of README.md's table of accuracy: benchmark_row.py LOG POSES CAMERA_HEIGHT"""

import sys

import oneac

log, poses, height = sys.argv[1:]
front_end = oneac.FrontEnd(camera_height=float(height))
for frame in oneac.Rawlog(log):
    front_end.process(frame)
front_end.finish()

pairs, path = front_end.relative_poses, front_end.trajectory
errors = oneac.evaluate(pairs, path, oneac.read_trajectory(poses))
R, d, length, whole = errors.rotation_deg, errors.direction_deg, errors.length, errors.trajectory
assert R and d and length and whole and whole.scale_error is not None
print(f"| {len(path)} frames, {whole.length:.0f} m | {R.mean:.3f} / {R.median:.3f} "
      f"| {d.mean:.2f} / {d.median:.2f} | {errors.bad} of {len(pairs)} | {100 * length.median:.1f} "
      f"| {whole.t_rel_percent:.1f} | {whole.r_rel_deg_per_100m:.2f} "
      f"| {100 * whole.scale_error:.1f} | {whole.ape.rmse:.2f} |")
