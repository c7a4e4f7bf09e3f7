#!/usr/bin/python3
"""Solvers from Python against a C++ loop over the same function, as a Markdown table.

    PYTHONPATH=build/dev/python /usr/bin/python3 tests/bench/python_solvers.py \
        build/dev/tests/bench/liboneac_bench_python_loops.so [SOLVER...]

Both run in this process, turn by turn, on the same correspondences; CPU time, the least of the
rounds. The loop keeps what the function returns in a vector; Python's call checks its input and
gives new numpy arrays.
"""

import ctypes
import sys
import time
from pathlib import Path

import numpy as np

import oneac

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
import scenes  # noqa: E402

SCENES, SAMPLES = 1000, 100_000
ROUNDS, SECONDS = 15, 6.0  # the slow solvers get fewer rounds, at least three


def samples_for(solver):
    """x1, x2, A of SAMPLES samples, (N, 2) or (N, k, 2), from SCENES of its own."""
    rng = np.random.default_rng(42)
    made = [scenes.scene(solver, rng, solver.sample)[:3] for _ in range(SCENES)]
    arrays = [np.stack([np.asarray(scene[k]) for scene in made]) for k in range(3)]
    if solver.sample == 1:
        arrays = [a[:, 0] for a in arrays]
    times = SAMPLES // SCENES
    return [np.ascontiguousarray(np.tile(a, (times,) + (1,) * (a.ndim - 1))) for a in arrays]


def cpu_ms(call):
    start = time.thread_time_ns()
    call()
    return (time.thread_time_ns() - start) / 1e6


def alternate(*calls):
    """The least time of each, [ms]."""
    times, end = [], time.monotonic() + SECONDS
    while len(times) < 3 or (len(times) < ROUNDS and time.monotonic() < end):
        times.append([cpu_ms(call) for call in calls])
    return np.min(times, axis=0)


def take(library, solver, x1, x2, A):
    address = [a.ctypes.data_as(ctypes.POINTER(ctypes.c_double)) for a in (x1, x2, A)]
    library.oneac_loops_take(*address, ctypes.c_size_t(solver.sample), ctypes.c_size_t(len(x1)))


def rows(library, solver):
    x1, x2, A = samples_for(solver)
    take(library, solver, x1, x2, A)
    name = solver.name.encode()
    found = library.oneac_loops_run(name)
    if found < 0:
        sys.exit(f"python_loops.cpp has no loop for {solver.name}")
    inputs = (x1, x2, A) if solver.affine else (x1, x2)
    poses = getattr(oneac, solver.name)(*inputs)
    assert poses.count.sum() == found, (solver.name, poses.count.sum(), found)
    calls = {solver.name: lambda: getattr(oneac, solver.name)(*inputs)}
    if solver.has_planar:
        calls[solver.name + "` `planar()"] = lambda: solver.planar(*inputs)
    *python, loop = alternate(*calls.values(), lambda: library.oneac_loops_run(name))
    return [f"| `{call}` | {ms:.1f} | {loop:.1f} | {ms / loop:.2f} |"
            for call, ms in zip(calls, python)]


def main():
    library = ctypes.CDLL(sys.argv[1])
    library.oneac_loops_run.restype = ctypes.c_long
    wanted = sys.argv[2:]
    print(f"| {SAMPLES} samples, CPU time [ms] | Python | C++ loop | ratio |\n|---|---|---|---|")
    for solver in oneac.solvers():
        if not wanted or solver.name in wanted:
            print("\n".join(rows(library, solver)), flush=True)


if __name__ == "__main__":
    main()
