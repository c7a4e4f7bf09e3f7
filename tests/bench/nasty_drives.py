#!/usr/bin/python3
"""Drives of other kinds: does what is called metric lie within its sigma?

Usage: nasty_drives.py ONEAC FOLDER [--kitti DIR] [--import-flags=FLAGS] [--drawn COUNT] [NAME ...]

Simulated drives of other seeds, cameras, roads and lights, and, with --kitti, 200 images of a drive
in KITTI's layout (image_0, calib.txt, times.txt, poses.txt) made nastier, with --drawn by several
changes at once that are drawn from a number. Prints per drive: metric pairs, their way in
metres against the true one, wrong directions among pairs called ok (beyond 15 deg), the share of
metric pairs within 2 sigma and the number beyond 5 sigma; of pairs called ok the same of direction
and rotation (off over the root of 2 or 3 degrees of freedom). Needs python3-numpy and, for --kitti,
python3-opencv. Takes about ten seconds a drive; drives are kept in FOLDER and used again.
"""
import argparse
import csv
import pathlib
import random
import shutil
import subprocess

import numpy as np

SIMULATED = {
    'jam-wide': '--hard stop-and-go --traffic crossing --width 800 --height 450 --focal 380 '
                '--fps 15 --frames 220 --scenery far',
    'red-light': '--hard red-light --seed 2',
    'red-light-dark': '--hard red-light --seed 3 --road dark --focal 700',
    'bus': '--hard bus --seed 2',
    'bus-low': '--hard bus --seed 3 --camera-height 1.1 --tilt-deg 0',
    'stop-and-go': '--hard stop-and-go --seed 2',
    'stop-truck': '--hard stop-and-go --seed 4 --traffic truck --truck-gap 6',
    'stop-oncoming': '--hard stop-and-go --seed 5 --traffic oncoming',
    'queue-2': '--hard queue --seed 2',
    'queue-3': '--hard queue --seed 3',
    'oncoming-night': '--hard oncoming --seed 2 --night',
    'overtaking-far': '--hard overtaking --seed 2 --scenery far --road dark',
    'tele': '--frames 120 --seed 7 --focal 1100 --fps 20 --speed 5',
    'van': '--frames 120 --seed 8 --camera-height 2.6 --tilt-deg -8 --fps 5',
    'springs': '--frames 120 --seed 9 --suspension-pitch 0.8 --suspension-roll 0.5',
    'slope': '--frames 120 --seed 10 --slope 6',
    'rain-2': '--hard rain --seed 2',
    'rain-3': '--hard rain --seed 3',
    'rain-night': '--hard rain --seed 2 --night',
    'rain-dark': '--hard rain --seed 2 --road dark',
    'night-2': '--hard night --seed 2',
    'night-3': '--hard night --seed 3',
    'wiper-night': '--wiper --night --frames 100 --seed 4',
    'bonnet': '--hard bonnet --seed 2',
    'bonnet-town-stop': '--frames 160 --bonnet 0.3 --seed 3 --route stop-and-go',
    'dashes': '--hard dashes --seed 2',
    'roundabout-far': '--hard roundabout --seed 2 --scenery far',
    'truck-2': '--hard truck --seed 2',
    'truck-3': '--hard truck --seed 3',
    'left': '--hard left --seed 2',
    'far': '--hard far --seed 2',
}

KITTI_FLAGS = '--camera-height 1.65'
FRAMES = 200  # at most


class Scene:
    """Images of a drive by the index of their original, with K, true poses and stamps [s]."""

    def __init__(self, kitti):
        import cv2
        self.cv2 = cv2
        self.files = sorted((kitti / 'image_0').iterdir())
        first = (kitti / 'calib.txt').read_text().split('\n', 1)[0].split()[1:]
        self.K = np.array(first, float).reshape(3, 4)[:, :3]
        rows = np.loadtxt(kitti / 'poses.txt').reshape(-1, 3, 4)
        self.true = [np.vstack([row, [0, 0, 0, 1]]) for row in rows]
        self.taken = np.loadtxt(kitti / 'times.txt')
        self.usual = float(np.median(np.diff(self.taken)))  # interval of the images [s]
        self.height, self.width = cv2.imread(str(self.files[0]), 0).shape
        self.frames = min(FRAMES, len(self.files), len(self.true))
        self.order = list(range(self.frames))
        self.turn = [np.eye(4)] * self.frames  # of the camera, on its place
        self.interval = None  # [s] of stamps of a fixed rate; None: as they were taken
        self.rng = np.random.RandomState(7)
        self.change = lambda image, k: image

    def at(self, k):
        return self.change(self.cv2.imread(str(self.files[self.order[k]]), 0), k)

    def stamp(self, k):
        return self.taken[self.order[k]] if self.interval is None else self.interval * k

    def pose(self, k):
        return self.true[self.order[k]] @ self.turn[k]

    def turned(self, rotations):
        """Every camera turned on its place by R (X of it = R X of the original)."""
        K, inverse = self.K, np.linalg.inv(self.K)
        self.turn = []
        for R in rotations:
            turn = np.eye(4)
            turn[:3, :3] = R.T
            self.turn.append(turn)
        self.change = lambda image, k: self.cv2.warpPerspective(
            image, K @ rotations[k] @ inverse, image.shape[::-1])

    def rotation(self, vector_deg):
        return self.cv2.Rodrigues(np.radians(np.array(vector_deg, float)))[0]

    def scaled(self, factor):
        self.K[:2] *= factor
        self.K[:2, 2] += 0.5 * (factor - 1.0)
        self.change = lambda image, k: self.cv2.resize(
            image, None, fx=factor, fy=factor, interpolation=self.cv2.INTER_AREA)


def grey(values):
    return np.clip(values, 0, 255).astype(np.uint8)


def reverse(s):
    s.order.reverse()
    s.interval = s.usual


def there_and_back(s):
    s.order = list(range(100)) + list(range(100, -1, -1))
    s.turn = [np.eye(4)] * len(s.order)
    s.interval = s.usual


def every(n):
    def change(s):
        s.order = list(range(0, min(len(s.files), len(s.true)), n))
        s.turn = [np.eye(4)] * len(s.order)
    return change


def dropped(lie):
    def change(s):
        s.order = [i for i in range(s.frames) if i == 0 or s.rng.rand() > 0.35]
        s.interval = s.usual if lie else None
    return change


def twice(s):
    s.order = [i for i in range(100) for _ in range(2)]
    s.turn = [np.eye(4)] * len(s.order)
    s.interval = s.usual / 2


def frozen(s):
    s.order = list(range(60)) + [60] * 15 + list(range(75, s.frames))
    s.interval = s.usual


def stretched(factor):
    def change(s):
        s.interval = factor * s.usual
    return change


def night(s):
    s.change = lambda image, k: grey(
        64 * (image / 255.0) ** 1.5 + 5 * s.rng.randn(*image.shape))


def fog(noise):
    def change(s):
        s.change = lambda image, k: grey(0.3 * image + 140 + noise * s.rng.randn(*image.shape))
    return change


def jpeg(s):
    def change(image, k):
        flags = [s.cv2.IMWRITE_JPEG_QUALITY, 15]
        return s.cv2.imdecode(s.cv2.imencode('.jpg', image, flags)[1], 0)
    s.change = change


def blurred(s):
    s.change = lambda image, k: s.cv2.GaussianBlur(image, (0, 0), 2)


def exposure(s):
    gains = [1.0 if s.rng.rand() < 0.7 else s.rng.uniform(0.4, 1.8) for _ in s.order]
    s.change = lambda image, k: grey(gains[k] * image)


def text(s):
    def change(image, k):
        for words, place in ((f'10:{k // 600:02d}:{k // 10 % 60:02d} 52 km/h', (20, s.height - 15)),
                             ('DASHCAM', (s.width - 242, 30))):
            s.cv2.putText(image, words, place, s.cv2.FONT_HERSHEY_SIMPLEX, 1.0, 255, 2)
        return image
    s.change = change


def bonnet(s):
    static = {}

    def change(image, k):
        h, w = image.shape
        if not static:
            noise = s.cv2.GaussianBlur(s.rng.rand(h, w).astype(np.float32) * 255, (0, 0), 3)
            x = np.arange(w) / (w / 2) - 1
            static['where'] = np.arange(h)[:, None] >= h * (0.82 + 0.12 * x ** 2)[None, :]
            static['grey'] = grey((noise - noise.mean()) * 8 + 90)
        image[static['where']] = static['grey'][static['where']]
        return image
    s.change = change


def dirt(s):
    spots = [(s.rng.randint(s.width), s.rng.randint(s.height), s.rng.randint(6, 30)) for _ in range(25)]

    def change(image, k):
        mask = np.zeros(image.shape, np.float32)
        for x, y, r in spots:
            s.cv2.circle(mask, (x, y), r, 0.85, -1)
        mask = s.cv2.GaussianBlur(mask, (0, 0), 4)
        return grey(image * (1 - mask) + 60 * mask)
    s.change = change


def snow(s):
    def change(image, k):
        for _ in range(400):
            at = s.rng.randint(image.shape[1]), s.rng.randint(image.shape[0])
            s.cv2.circle(image, at, s.rng.randint(1, 4), 235, -1)
        return s.cv2.GaussianBlur(image, (0, 0), 0.7)
    s.change = change


def drops(s):
    where = [(s.rng.randint(s.width), s.rng.randint(s.height), s.rng.randint(5, 16)) for _ in range(120)]

    def change(image, k):
        through = s.cv2.flip(s.cv2.GaussianBlur(image, (0, 0), 9), 0)
        mask = np.zeros(image.shape, np.float32)
        for n, (x, y, r) in enumerate(where):
            moved = (7 * x + 131 * (k // 25)) % s.width if (k // 25 + n) % 4 == 0 else x
            s.cv2.circle(mask, (moved, y), r, 1, -1)
        mask = s.cv2.GaussianBlur(mask, (0, 0), 1.5)
        return grey(image * (1 - mask) + through * mask)
    s.change = change


def drops_at_night(s):
    drops(s)
    wet = s.change
    night(s)
    dark = s.change
    s.change = lambda image, k: dark(wet(image, k), k)


def mirror(s):
    s.K[0, 2] = s.width - 1 - s.K[0, 2]
    flip = np.diag([-1.0, 1, 1, 1])
    s.true = [flip @ pose @ flip for pose in s.true]
    s.change = lambda image, k: s.cv2.flip(image, 1)


def cut_above(rows):
    def change(s):
        s.change = lambda image, k: image[:rows].copy()
    return change


def black(s):
    s.change = lambda image, k: 0 * image if 80 <= k < 95 else image


def focal(factor):
    def change(s):
        s.K[0, 0] *= factor
        s.K[1, 1] *= factor
    return change


def turned(vector_deg):
    return lambda s: s.turned([s.rotation(vector_deg)] * len(s.order))


def shaking(s):
    s.turned([s.rotation(s.rng.randn(3) * [0.4, 0.2, 0.4]) for _ in s.order])


def zoomed(s):
    def change(image, k):
        if s.order[k] < s.frames // 2:
            return image
        c = s.K[0, 2], s.K[1, 2]
        return s.cv2.warpAffine(image, s.cv2.getRotationMatrix2D(c, 0, 1.06), image.shape[::-1])
    s.change = change


def bumped(vector_deg):
    def change(s):
        s.turned([s.rotation(vector_deg) if 2 * k > s.frames else np.eye(3)
                  for k in range(len(s.order))])
    return change


def stutter(s):
    s.order = [i - (i % 5 == 4) for i in s.order]
    s.interval = s.usual


def swapped(s):
    s.order = [i + 1 if i % 10 == 4 else i - 1 if i % 10 == 5 else i for i in range(s.frames)]
    s.interval = s.usual


def jitter(s):
    s.taken = s.taken + s.usual * s.rng.uniform(0, 0.6, len(s.taken))


def gap(s):
    s.order = [i for i in s.order if not s.frames // 3 <= i < s.frames // 3 + 30]


def headlights(s):
    """A night whose only light is the car's own: its edge on the road travels with the car."""
    y, x = np.mgrid[:s.height, :s.width].astype(np.float32)
    across = (x - s.K[0, 2]) / np.maximum(40.0, y - s.K[1, 2] + 60)
    cone = np.exp(-(across / 1.3) ** 4) * (y > s.K[1, 2] + 4) * (1 + 0.3 * np.sin(3 * across))
    light = s.cv2.GaussianBlur(cone, (0, 0), 3) * 0.6 + 0.05
    s.change = lambda image, k: grey(image * light + 3 * s.rng.randn(*image.shape))


def own_shadow(s):
    """The car's shadow beside and before it, on the road, at rest in the picture."""
    mask = np.zeros((s.height, s.width), np.float32)
    w, h, cx, cy = s.width, s.height, s.K[0, 2], s.K[1, 2]
    low = int(cy + 0.35 * (h - cy))
    s.cv2.fillPoly(mask, [np.array([[int(cx - 0.3 * w), h], [int(cx - 0.12 * w), low],
                                    [int(cx + 0.1 * w), low], [int(cx + 0.2 * w), h]])], 1)
    mask = s.cv2.GaussianBlur(mask, (0, 0), 1.5)
    s.change = lambda image, k: grey(image * (1 - 0.55 * mask))


def letterbox(s):
    def change(image, k):
        image[:s.height // 8] = 0
        image[-s.height // 8:] = 0
        return image
    s.change = change


def middle(s):
    width = s.width // 3
    s.K[0, 2] -= width
    s.change = lambda image, k: image[:, width:2 * width].copy()


def glare(s):
    at = s.width // 2 + s.width // 10, int(s.K[1, 2] * 0.8)
    y, x = np.mgrid[:s.height, :s.width]
    halo = 400 * np.exp(-np.hypot(x - at[0], y - at[1]) / (0.12 * s.width))
    s.change = lambda image, k: grey(0.7 * image + halo)


def vignette(s):
    y, x = np.mgrid[:s.height, :s.width]
    shade = 1 - 0.75 * np.hypot((x - s.width / 2) / s.width, (y - s.height / 2) / s.height) ** 2 * 2
    s.change = lambda image, k: grey(image * shade)


def dead_pixels(s):
    rows, columns = s.rng.randint(s.height, size=400), s.rng.randint(s.width, size=400)

    def change(image, k):
        image[rows, columns] = 255
        return image
    s.change = change


def interlaced(s):
    def change(image, k):
        image[::2] = np.roll(image[::2], 3, axis=1)
        return image
    s.change = change


def rolled_shutter(s):
    """Rows read one after the other while the camera shakes about its yaw."""
    def change(image, k):
        phase = 2 * np.pi * (0.9 * k + np.arange(s.height) / s.height)
        y, x = np.mgrid[:s.height, :s.width].astype(np.float32)
        return s.cv2.remap(image, x + (1.5 * np.sin(phase)[:, None]).astype(np.float32), y,
                           s.cv2.INTER_LINEAR)
    s.change = change


def potholes(s):
    s.turned([s.rotation([1.2 * np.sin(0.9 * (k % 40)) * np.exp(-0.3 * (k % 40)), 0, 0])
              for k in range(len(s.order))])


NASTIER = {
    'plain': lambda s: None, 'mirror': mirror, 'reverse': reverse, 'there-and-back': there_and_back,
    'every-3rd': every(3), 'every-5th': every(5), 'dropped': dropped(False),
    'dropped-fixed-rate': dropped(True), 'twice': twice, 'frozen': frozen, 'black': black,
    'stamps-10-too-slow': stretched(10), 'stamps-10-too-fast': stretched(0.1),
    'night': night, 'fog': fog(0), 'fog-noise': fog(3), 'jpeg-15': jpeg, 'blurred': blurred,
    'exposure': exposure, 'text': text, 'bonnet': bonnet, 'dirt': dirt, 'snow': snow,
    'drops': drops, 'drops-night': drops_at_night, 'upper-260-rows': cut_above(260),
    'half': lambda s: s.scaled(0.5), 'third': lambda s: s.scaled(1 / 3),
    'focal+5%': focal(1.05), 'focal-8%': focal(0.92), 'roll-3': turned([0, 0, 3]),
    'pitch-8': turned([8, 0, 0]), 'yaw-10': turned([0, 10, 0]), 'shaking': shaking,
    'zoomed': zoomed, 'bumped-pitch': bumped([3, 0, 0]), 'bumped-yaw': bumped([0, 4, 0]),
    'stutter': stutter, 'swapped': swapped, 'jitter': jitter, 'gap': gap,
    'stamps-2-too-fast': stretched(0.5), 'stamps-2-too-slow': stretched(2),
    'headlights': headlights, 'own-shadow': own_shadow, 'letterbox': letterbox, 'middle': middle,
    'glare': glare, 'vignette': vignette, 'dead-pixels': dead_pixels, 'interlaced': interlaced,
    'rolled-shutter': rolled_shutter, 'potholes': potholes, 'focal+10%': focal(1.1),
    'focal-3%': focal(0.97), 'pitch+5-down': turned([-5, 0, 0]), 'upside-down': turned([0, 0, 180]),
    'pitch-15': turned([15, 0, 0]), 'roll-6-pitch-6': turned([6, 0, 6]),
    'yaw-10-pitch-8': turned([8, 10, 0]),
}

# Of which --drawn takes one each, and of the last kind as often two.
ORDERS = ['plain'] * 6 + ['reverse', 'every-3rd', 'dropped', 'twice', 'frozen', 'stutter', 'swapped',
                          'jitter', 'gap', 'there-and-back', 'stamps-2-too-slow']
CAMERAS = ['plain'] * 3 + ['half', 'third', 'focal+5%', 'focal-3%', 'roll-3', 'pitch-8',
                           'pitch+5-down', 'yaw-10', 'shaking', 'potholes', 'bumped-pitch',
                           'bumped-yaw', 'mirror', 'upper-260-rows', 'middle', 'yaw-10-pitch-8',
                           'pitch-15', 'zoomed']
PICTURES = ['night', 'fog', 'fog-noise', 'jpeg-15', 'blurred', 'exposure', 'text', 'bonnet', 'dirt',
            'snow', 'own-shadow', 'headlights', 'glare', 'vignette', 'dead-pixels', 'interlaced',
            'rolled-shutter', 'letterbox', 'black', 'drops']


def drawn_names(number):
    r = random.Random(number)
    return [r.choice(ORDERS), r.choice(CAMERAS), r.choice(PICTURES),
            r.choice(PICTURES + ['plain'] * 12)]


def after(first, then):
    return lambda image, k: then(first(image, k).copy(), k)


def draw(scene, number):
    """Changes order, camera and, one upon the other, pictures."""
    scene.rng = np.random.RandomState(number + 100)
    order, camera, *pictures = drawn_names(number)
    NASTIER[order](scene)
    NASTIER[camera](scene)
    for name in pictures:
        before = scene.change
        sample = before(scene.cv2.imread(str(scene.files[0]), 0), 0)
        scene.height, scene.width = sample.shape
        scene.change = lambda image, k: image
        NASTIER[name](scene)
        scene.change = after(before, scene.change)


def changes(asked):
    """Of real images: (folder, what is said of it, change of a scene)."""
    for number in range(asked.drawn):
        yield str(number), ' '.join([str(number), *drawn_names(number)]), \
            lambda scene, number=number: draw(scene, number)
    for name, change in NASTIER.items() if not asked.drawn else ():
        if not asked.names or name in asked.names:
            yield name, name, change


def write_kitti(scene, folder):
    (folder / 'image_0').mkdir(parents=True)
    for k in range(len(scene.order)):
        scene.cv2.imwrite(str(folder / f'image_0/{k:06d}.png'), scene.at(k))
    P = np.hstack([scene.K, np.zeros((3, 1))]).ravel()
    (folder / 'calib.txt').write_text('P0: ' + ' '.join(f'{x:.12e}' for x in P) + '\n')
    (folder / 'times.txt').write_text(
        ''.join(f'{scene.stamp(k):.6e}\n' for k in range(len(scene.order))))
    np.savetxt(folder / 'poses.txt', [scene.pose(k)[:3].ravel() for k in range(len(scene.order))])


def call(*words):
    result = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    return result.returncode, ' | '.join(result.stderr.split('\n')).strip(' |')


def true_poses(poses):
    rows = np.loadtxt(poses).reshape(-1, 3, 4)
    return [np.vstack([row, [0, 0, 0, 1]]) for row in rows]


def in_sigmas(off, covariance):
    """Mahalanobis distance over the root of its degrees of freedom."""
    regular = covariance + 1e-14 * np.eye(len(off))
    return np.sqrt(max(off @ np.linalg.solve(regular, off), 0) / len(off))


def rotation_of(row):
    w, x, y, z = (float(row[key]) for key in ('qw', 'qx', 'qy', 'qz'))
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def angles_in_sigmas(row, step, covariance):
    """Of the direction and of the rotation of one pair, true step and 6x6 covariance beside it."""
    t = np.array([float(row[key]) for key in ('tx', 'ty', 'tz')])
    told, truth = np.linalg.norm(t), np.linalg.norm(step[:3, 3])
    across = np.linalg.svd((t / told).reshape(1, 3))[2][1:]
    off = across @ (step[:3, 3] / truth - t / told)
    turn = step[:3, :3] @ rotation_of(row).T
    turned = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
    return (in_sigmas(off, across @ covariance[3:, 3:] @ across.T / told ** 2),
            in_sigmas(turned, covariance[:3, :3]))


def judge_angles(out, poses):
    """Counts over the pairs of a run that are called ok and moved, by its covariance.csv."""
    true = true_poses(poses)
    entries = {(row['index1'], row['index2']): row
               for row in csv.DictReader((out / 'covariance.csv').open())}
    count = dict(ok=0, direction_within_2=0, direction_beyond_5=0, metric_direction_beyond_5=0,
                 rotation_within_2=0, rotation_beyond_5=0)
    for row in csv.DictReader((out / 'relative_poses.csv').open()):
        step = np.linalg.inv(true[int(row['index2'])]) @ true[int(row['index1'])]
        moved = row['status'] == 'ok' and np.linalg.norm(step[:3, 3]) > 0.05
        entry = entries.get((row['index1'], row['index2']))
        if not moved or entry is None or not entry['c00']:
            continue
        covariance = np.array([[float(entry[f'c{min(a, b)}{max(a, b)}']) for b in range(6)]
                               for a in range(6)])
        direction, rotation = angles_in_sigmas(row, step, covariance)
        count['ok'] += 1
        count['direction_within_2'] += direction < 2
        count['direction_beyond_5'] += direction > 5
        count['metric_direction_beyond_5'] += direction > 5 and row['metric'] == '1'
        count['rotation_within_2'] += rotation < 2
        count['rotation_beyond_5'] += rotation > 5
    return count


def angles_text(count):
    ok = max(count['ok'], 1)
    return (f"of {count['ok']} ok direction {100 * count['direction_within_2'] / ok:.0f} % / "
            f"{count['direction_beyond_5']} ({count['metric_direction_beyond_5']} metric), "
            f"rotation {100 * count['rotation_within_2'] / ok:.0f} % / {count['rotation_beyond_5']}")


def judge(pairs, poses):
    """Counts over the rows of a relative_poses.csv."""
    true = true_poses(poses)
    count = dict(pairs=0, metric=0, way=0.0, true_way=0.0, wrong=0, within_2=0, beyond_5=0)
    for row in csv.DictReader(pairs.open()):
        step = np.linalg.inv(true[int(row['index2'])]) @ true[int(row['index1'])]
        t = np.array([float(row[key]) for key in ('tx', 'ty', 'tz')])
        truth, told = np.linalg.norm(step[:3, 3]), np.linalg.norm(t)
        count['pairs'] += 1
        if row['status'] == 'ok' and truth > 0.1 and told > 0:
            count['wrong'] += step[:3, 3] @ t < np.cos(np.radians(15)) * truth * told
        if row['metric'] != '1':
            continue
        off, sigma = abs(told - truth), max(float(row['sigma_length']), 1e-3)
        count['metric'] += 1
        count['way'] += told
        count['true_way'] += truth
        count['within_2'] += off < 2 * sigma
        count['beyond_5'] += off > 5 * sigma
    return count


def share_within_2(count):
    return 100 * count['within_2'] / count['metric'] if count['metric'] else 100


def run(oneac, log, poses, out, *flags):
    """The counts of a run, or None, and what there is to say of it."""
    shutil.rmtree(out, ignore_errors=True)
    code, said = call(oneac, 'run', log, '-o', out, '--no-progress', *flags)
    pairs = out / 'relative_poses.csv'
    if not pairs.exists():
        return None, f'exit {code}: {said}'
    c = {**judge(pairs, poses), **judge_angles(out, poses)}
    return c, (f"metric {c['metric']} of {c['pairs']}, {c['way']:.1f} of {c['true_way']:.1f} m, "
               f"wrong {c['wrong']}, within 2 sigma {share_within_2(c):.0f} %, "
               f"beyond 5 sigma {c['beyond_5']}; {angles_text(c)}" + (f'; {said}' if said else ''))


def report(name, oneac, log, poses, out):
    print(f'{name:20} {run(oneac, log, poses, out)[1]}', flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('oneac')
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('names', nargs='*')
    parser.add_argument('--kitti', type=pathlib.Path)
    parser.add_argument('--import-flags', default=KITTI_FLAGS)
    parser.add_argument('--drawn', type=int, default=0, help='drives of changes drawn at random')
    asked = parser.parse_intermixed_args()
    for name, flags in SIMULATED.items():
        drive = asked.folder / name
        if asked.names and name not in asked.names or asked.kitti and not asked.names:
            continue
        if not (drive / 'poses.txt').exists():
            call(asked.oneac, 'simulate', '-o', drive, '--no-progress', *flags.split())
        report(name, asked.oneac, drive / 'simulated.rawlog', drive / 'poses.txt',
               asked.folder / f'{name}-run')
    for folder, name, change in changes(asked) if asked.kitti else ():
        drive = asked.folder / folder
        if not (drive / 'poses.txt').exists():
            shutil.rmtree(drive, ignore_errors=True)
            scene = Scene(asked.kitti)
            change(scene)
            write_kitti(scene, drive)
            call(asked.oneac, 'import', 'kitti', drive, '-o', drive / 'drive.rawlog',
                 *asked.import_flags.split())
        report(name, asked.oneac, drive / 'drive.rawlog', drive / 'poses.txt',
               asked.folder / f'{folder}-run')


if __name__ == '__main__':
    main()
