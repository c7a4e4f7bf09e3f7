#!/usr/bin/python3
"""Simulated drives drawn at random: does what is called metric lie within its sigma?

Usage: random_drives.py ONEAC FOLDER [--first N] [--count N] [--source stereo|gps|wheels]
                        [--road slabs|wet]

Every number is a drive: its camera, mount, road, light, traffic and speed follow from it. Prints
per drive what nasty_drives.py prints, the flags of `oneac simulate`, and *** where a metric pair
is beyond 5 sigma, ** where fewer than 85 % are within 2 sigma. Takes about ten seconds a drive;
drives are kept in FOLDER and used again. Needs python3-numpy.
"""
import argparse
import collections
import pathlib
import random

from nasty_drives import angles_text, call, run, share_within_2


def some(r, share, *flags):
    """The flags, in so many of the drives."""
    return list(flags) if r.random() < share else []


def springs(r):
    return ['--suspension-pitch', round(r.uniform(0, 0.8), 2),
            '--suspension-roll', round(r.uniform(0, 0.6), 2)]


def camera(r):
    size = r.choice([(640, 360), (800, 450), (640, 480), (400, 300)])
    focal = round(size[0] * r.uniform(0.45, 1.3))
    flags = some(r, 0.5, '--width', size[0], '--height', size[1], '--focal', focal)
    flags += ['--fps', r.choice([5, 10, 10, 15, 20, 30]), '--speed', round(r.uniform(3, 14), 1),
              '--camera-height', round(r.uniform(0.9, 2.8), 2),
              '--tilt-deg', round(r.uniform(-8, 8), 1)]
    mount = r.random()
    if mount < 0.25:
        flags += ['--silent-mount']
    elif mount < 0.4:
        flags += ['--mount-roll', r.choice([3, -5, 10, 90, 180])]
    elif mount < 0.5:
        flags += ['--mount-yaw', r.choice([5, -10, 25, 60, 180, -90])]
    return flags


def traffic(r, route):
    if r.random() < 0.2:
        return ['--traffic', 'crossing']
    if route not in ('straight', 'stop-and-go'):
        return []
    return some(r, 0.4, '--traffic', r.choice(['overtaking', 'oncoming', 'truck']),
                '--truck-gap', r.choice([6, 10, 20]))


def scene(r):
    route = r.choice(['street', 'straight', 'stop-and-go', 'roundabout', 'street'])
    flags = ['--route', route] + traffic(r, route)
    flags += some(r, 0.5, *springs(r)) + some(r, 0.2, '--slope', r.choice([-8, -4, 4, 8]))
    flags += some(r, 0.25, '--scenery', 'far')
    flags += some(r, 0.4, '--road', r.choice(['dark', 'dashes']))
    flags += some(r, 0.15, '--night') + some(r, 0.12, '--rain') + some(r, 0.1, '--wiper')
    flags += some(r, 0.15, '--exposure-jumps')
    flags += some(r, 0.15, '--bonnet', round(r.uniform(0.08, 0.3), 2))
    flags += some(r, 0.15, '--rolling-shutter', r.choice([0.01, 0.02, 0.03]))
    flags += some(r, 0.3, '--noise', r.choice([1, 4, 8]))
    if route == 'street':
        flags += some(r, 0.2, '--stop', r.choice([1, 3]))
    return flags


def sensors(r, source):
    """What measures the metres besides the road, as good and as bad as such things are."""
    if source == 'stereo':
        return ['--stereo', '--baseline', round(r.uniform(0.08, 0.55), 2)]
    if source == 'gps':
        return ['--gps-noise', r.choice([0.02, 0.1, 0.3, 1, 2])]
    if source == 'wheels':
        return ['--odometry', '--wheel-error', round(r.uniform(-4, 4), 1)]
    return []


def drive_flags(number, source=None, road=None):
    """Of `oneac simulate`."""
    r = random.Random(number)
    flags = ['--seed', number, '--frames', r.choice([80, 120, 160])] + camera(r) + scene(r)
    flags += sensors(r, source)
    if road:
        if '--road' in flags:
            flags[flags.index('--road') + 1] = road
        else:
            flags += ['--road', road]
    return [str(flag) for flag in flags]


def run_flags(flags, source=None):
    """A log that is silent about its mount says no height, either; somebody measured it."""
    keys = [f'front_end.scale.source={source}'] if source else []
    if '--silent-mount' in flags:
        keys.append('front_end.camera_height=' + flags[flags.index('--camera-height') + 1])
    return [part for key in keys for part in ('--set', key)]


def mark(count):
    if count is None:
        return ''
    return '***' if count['beyond_5'] else '**' if share_within_2(count) < 85 else ''


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('oneac')
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('--first', type=int, default=0)
    parser.add_argument('--count', type=int, default=60)
    parser.add_argument('--source', choices=['stereo', 'gps', 'wheels'],
                        help='of the metres; without it the camera\'s height')
    parser.add_argument('--road', choices=['slabs', 'wet'], help='of every drive')
    asked = parser.parse_args()
    total = collections.Counter()
    for number in range(asked.first, asked.first + asked.count):
        flags = drive_flags(number, asked.source, asked.road)
        name = '-'.join([str(number), *filter(None, (asked.source, asked.road))])
        drive, out = asked.folder / name, asked.folder / f'{name}-run'
        if not (drive / 'poses.txt').exists():
            call(asked.oneac, 'simulate', '-o', drive, '--no-progress', *flags)
        count, text = run(asked.oneac, drive / 'simulated.rawlog', drive / 'poses.txt', out,
                          *run_flags(flags, asked.source))
        print(f"{number:4} {mark(count):3} {' '.join(flags)} | {text}", flush=True)
        total.update(count or {})
    print(f"all: metric {total['metric']} of {total['pairs']}, wrong {total['wrong']}, "
          f"within 2 sigma {share_within_2(total):.1f} %, beyond 5 sigma {total['beyond_5']}; "
          f"{angles_text(total)}")


if __name__ == '__main__':
    main()
