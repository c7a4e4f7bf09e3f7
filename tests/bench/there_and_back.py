#!/usr/bin/env python3
"""A KITTI drive there and back: the even frames as they were taken, then the odd ones from the end.

    there_and_back.py ONEAC KITTI OUT    KITTI: image_0, calib.txt, poses.txt; OUT: folder to make

Every place is seen again, by an image that was not seen before, and in the direction of the first
time: the camera goes backwards. Writes OUT/drive.rawlog, and OUT/poses.txt for loops_truth.py.
"""
import shutil
import subprocess
import sys
from pathlib import Path

INTERVAL_S = 0.2  # of every second frame of KITTI


def order_of(frames):
    last = frames - 1 if frames % 2 == 0 else frames - 2
    return list(range(0, frames, 2)) + list(range(last, 0, -2))


def main(oneac, kitti, out):
    files = sorted((kitti / "image_0").iterdir())
    poses = (kitti / "poses.txt").read_text().splitlines()
    order = order_of(min(len(files), len(poses)))
    (out / "image_0").mkdir(parents=True)
    for name, i in enumerate(order):
        shutil.copy(files[i], out / "image_0" / f"{name:06d}{files[i].suffix}")
    shutil.copy(kitti / "calib.txt", out)
    (out / "poses.txt").write_text("".join(poses[i] + "\n" for i in order))
    (out / "times.txt").write_text("".join(f"{INTERVAL_S * k:.1f}\n" for k in range(len(order))))
    subprocess.run([oneac, "import", "kitti", out, "-o", out / "drive.rawlog"], check=True)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
