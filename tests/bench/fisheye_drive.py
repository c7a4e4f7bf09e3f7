#!/usr/bin/python3
"""A simulated drive as a fisheye sees it: what `calibrate --fisheye` and `refine: full` find.

Usage: fisheye_drive.py ONEAC FOLDER

Remaps a wide simulated drive (seed 1, 300 images) to an equidistant lens with four terms
(Kannala and Brandt), 800 x 600 px, and imports it with the true calibration and with a wrong one.
Prints the truth, then what `oneac calibrate` and `oneac run` say. Needs python3-opencv.
"""
import json
import pathlib
import subprocess
import sys

import cv2
import numpy as np

WIDTH, HEIGHT, WIDE = 800, 600, (1280, 960, 420)
FOCAL, CENTRE, TERMS = 290.0, (399.5, 299.5), (-0.02, 0.006, -0.002, 0.0003)


def angles(stretched):
    """Inverse of the lens by Newton's method."""
    theta = stretched.copy()
    for _ in range(30):
        a = theta * theta
        series = [1, *TERMS]
        value = theta * sum(k * a**i for i, k in enumerate(series))
        slope = sum((2 * i + 1) * k * a**i for i, k in enumerate(series))
        theta -= (value - stretched) / slope
    return theta


def maps():
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    x, y = (u - CENTRE[0]) / FOCAL, (v - CENTRE[1]) / FOCAL
    stretched = np.maximum(np.hypot(x, y), 1e-9)
    scale = WIDE[2] * np.tan(np.minimum(angles(stretched), 1.5)) / stretched
    return ((x * scale + (WIDE[0] - 1) / 2).astype(np.float32),
            (y * scale + (WIDE[1] - 1) / 2).astype(np.float32))


def calibration(file, focal, centre, terms):
    k = terms
    file.write_text('[CAMERA_PARAMS]\nresolution = [%d %d]\ncx = %r\ncy = %r\nfx = %r\nfy = %r\n'
                    'distortion = kannala_brandt\ndist = [%r %r 0 0 %r %r 0 0]\n'
                    % (WIDTH, HEIGHT, *centre, focal, focal, *k))


def call(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True,
                          text=True).stdout


def make(oneac, folder):
    source = folder / 'wide'
    if not source.exists():
        call(oneac, 'simulate', '-o', source, '--frames', 300, '--seed', 1, '--width', WIDE[0],
             '--height', WIDE[1], '--focal', WIDE[2])
    (folder / 'images').mkdir(exist_ok=True)
    mapping = maps()
    for i, file in enumerate(sorted((source / 'Images').iterdir())):
        image = cv2.remap(cv2.imread(str(file), 0), *mapping, cv2.INTER_LINEAR)
        cv2.imwrite(str(folder / 'images' / ('%06d.png' % i)), image)
    calibration(folder / 'right.ini', FOCAL, CENTRE, TERMS)
    calibration(folder / 'wrong.ini', FOCAL * 1.03, (CENTRE[0] + 6, CENTRE[1] - 4), (0.03, 0, 0, 0))
    for name in ('right', 'wrong'):
        call(oneac, 'import', 'images', folder / 'images', '-o', folder / (name + '.rawlog'),
             '--calibration', folder / (name + '.ini'), '--fps', 10, '--camera-height', 1.5)


def main():
    oneac, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    make(oneac, folder)
    print('truth: f', FOCAL, 'c', CENTRE, 'k', TERMS)
    for start in (['--fisheye', '--fov-deg', 120], []):
        print('calibrate', *start)
        print(call(oneac, 'calibrate', folder / 'wrong.rawlog', '-o', folder / 'found.ini',
                   '--no-progress', *start))
    for name in ('right', 'wrong'):
        for refine in ('off', 'full'):
            out = folder / (name + '-' + refine)
            said = call(oneac, 'run', folder / (name + '.rawlog'), '-o', out, '--no-progress',
                        '--quiet', '--set', 'run.reference=%s' % (folder / 'wide' / 'poses.txt'),
                        '--set', 'front_end.calibration.refine=' + refine)
            lines = [line for line in said.splitlines()
                     if line.startswith(('rotation [', 'direction [', 't_rel', 'r_rel'))]
            camera = json.loads((out / 'summary.json').read_text())['camera']['self_calibration']
            print(name, refine, *lines, camera.get('raw_camera_by_bends'), sep='\n  ')


if __name__ == '__main__':
    main()
