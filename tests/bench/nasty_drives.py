#!/usr/bin/python3
"""Drives of other kinds: does what is called metric lie within its sigma?

Usage: nasty_drives.py ONEAC FOLDER [--kitti DIR] [NAME ...]

Simulated drives of other seeds, cameras, roads and lights, and, with --kitti, 200 images of a KITTI
drive (image_0, calib.txt, poses.txt) made nastier. Prints per drive: metric pairs, their way in
metres against the true one, wrong directions among pairs called ok (beyond 15 deg), the share of
metric pairs within 2 sigma and the number beyond 5 sigma. Needs python3-numpy and, for --kitti,
python3-opencv. Takes about ten seconds a drive; drives are kept in FOLDER and used again.
"""
import argparse
import csv
import pathlib
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

HEIGHT_M = '1.65'  # of KITTI's camera
FRAMES = 200


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
        self.order = list(range(FRAMES))
        self.turn = [np.eye(4)] * FRAMES  # of the camera, on its place
        self.interval = None  # [s] of stamps of a fixed rate; None: as they were taken
        self.rng = np.random.RandomState(7)
        self.change = lambda image, k: image

    def at(self, k):
        return self.change(self.cv2.imread(str(self.files[self.order[k]]), 0), k)

    def stamp(self, k):
        return 0.1 * self.order[k] if self.interval is None else self.interval * k

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
    s.interval = 0.1


def there_and_back(s):
    s.order = list(range(100)) + list(range(100, -1, -1))
    s.turn = [np.eye(4)] * len(s.order)
    s.interval = 0.1


def every(n):
    def change(s):
        s.order = list(range(0, len(s.files), n))
        s.turn = [np.eye(4)] * len(s.order)
    return change


def dropped(lie):
    def change(s):
        s.order = [i for i in range(FRAMES) if i == 0 or s.rng.rand() > 0.35]
        s.interval = 0.1 if lie else None
    return change


def twice(s):
    s.order = [i for i in range(100) for _ in range(2)]
    s.interval = 0.05


def frozen(s):
    s.order = list(range(60)) + [60] * 15 + list(range(75, FRAMES))
    s.interval = 0.1


def stretched(interval):
    def change(s):
        s.interval = interval
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
        for words, place in ((f'10:{k // 600:02d}:{k // 10 % 60:02d} 52 km/h', (20, 360)),
                             ('DASHCAM', (1000, 30))):
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
    spots = [(s.rng.randint(1242), s.rng.randint(375), s.rng.randint(6, 30)) for _ in range(25)]

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
    where = [(s.rng.randint(1242), s.rng.randint(375), s.rng.randint(5, 16)) for _ in range(120)]

    def change(image, k):
        through = s.cv2.flip(s.cv2.GaussianBlur(image, (0, 0), 9), 0)
        mask = np.zeros(image.shape, np.float32)
        for n, (x, y, r) in enumerate(where):
            moved = (7 * x + 131 * (k // 25)) % 1242 if (k // 25 + n) % 4 == 0 else x
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
    s.K[0, 2] = 1241 - s.K[0, 2]
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


NASTIER = {
    'plain': lambda s: None, 'mirror': mirror, 'reverse': reverse, 'there-and-back': there_and_back,
    'every-3rd': every(3), 'every-5th': every(5), 'dropped': dropped(False),
    'dropped-fixed-rate': dropped(True), 'twice': twice, 'frozen': frozen, 'black': black,
    'stamps-10-too-slow': stretched(1.0), 'stamps-10-too-fast': stretched(0.01),
    'night': night, 'fog': fog(0), 'fog-noise': fog(3), 'jpeg-15': jpeg, 'blurred': blurred,
    'exposure': exposure, 'text': text, 'bonnet': bonnet, 'dirt': dirt, 'snow': snow,
    'drops': drops, 'drops-night': drops_at_night, 'upper-260-rows': cut_above(260),
    'half': lambda s: s.scaled(0.5), 'third': lambda s: s.scaled(1 / 3),
    'focal+5%': focal(1.05), 'focal-8%': focal(0.92), 'roll-3': turned([0, 0, 3]),
    'pitch-8': turned([8, 0, 0]), 'yaw-10': turned([0, 10, 0]), 'shaking': shaking,
}


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


def judge(pairs, poses):
    """Counts over the rows of a relative_poses.csv."""
    rows = np.loadtxt(poses).reshape(-1, 3, 4)
    true = [np.vstack([row, [0, 0, 0, 1]]) for row in rows]
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


def report(name, oneac, log, poses, out):
    shutil.rmtree(out, ignore_errors=True)
    code, said = call(oneac, 'run', log, '-o', out, '--no-progress')
    pairs = out / 'relative_poses.csv'
    if not pairs.exists():
        print(f'{name:20} exit {code}: {said}', flush=True)
        return
    c = judge(pairs, poses)
    share = 100 * c['within_2'] / c['metric'] if c['metric'] else 100
    print(f"{name:20} metric {c['metric']} of {c['pairs']}, {c['way']:.1f} of {c['true_way']:.1f} m, "
          f"wrong {c['wrong']}, within 2 sigma {share:.0f} %, beyond 5 sigma {c['beyond_5']}"
          + (f'; {said}' if said else ''), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('oneac')
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('names', nargs='*')
    parser.add_argument('--kitti', type=pathlib.Path)
    asked = parser.parse_intermixed_args()
    for name, flags in SIMULATED.items():
        drive = asked.folder / name
        if asked.names and name not in asked.names or asked.kitti and not asked.names:
            continue
        if not (drive / 'poses.txt').exists():
            call(asked.oneac, 'simulate', '-o', drive, '--no-progress', *flags.split())
        report(name, asked.oneac, drive / 'simulated.rawlog', drive / 'poses.txt',
               asked.folder / f'{name}-run')
    for name, change in NASTIER.items() if asked.kitti else ():
        drive = asked.folder / name
        if asked.names and name not in asked.names:
            continue
        if not (drive / 'poses.txt').exists():
            shutil.rmtree(drive, ignore_errors=True)
            scene = Scene(asked.kitti)
            change(scene)
            write_kitti(scene, drive)
            call(asked.oneac, 'import', 'kitti', drive, '-o', drive / 'drive.rawlog',
                 '--camera-height', HEIGHT_M)
        report(name, asked.oneac, drive / 'drive.rawlog', drive / 'poses.txt',
               asked.folder / f'{name}-run')


if __name__ == '__main__':
    main()
