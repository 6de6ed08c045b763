#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
"""Our splines against scipy's on the same points: one table of error against time.

usage: compare_scipy.py COMPARE_DRIVER [--draws N]

Points of a known edge with Gaussian noise; the error is the rms distance from the known edge, mean of the draws. Times are
the best of 15 calls, the call alone. The counterparts: given-knots and make_lsq_spline, the same knots; chosen-knots and
make_smoothing_spline; one-curve and odr, a curve of the same knots by orthogonal distances with its covariance, ours with
the pose of the scissors as well. whole-fit is FitBlade, which makes a dozen such fits: outliers, scatter, mirror image, both
families, tests of the residuals; its time is shown beside odr's but not asked for.
Exits with 77 (skipped) if scipy is missing, with 1 if ours is less accurate or not 5 times as fast as its counterpart.
"""
import argparse
import subprocess
import sys
import time

try:
    import numpy as np
    from scipy import interpolate, odr
except ImportError:
    print("scipy is missing: nothing to compare with")
    sys.exit(77)

SIGMA = 0.02
COUNTERPART = {"given-knots": "make_lsq_spline", "chosen-knots": "make_smoothing_spline", "one-curve": "odr", "whole-fit": "odr"}
SPEED = {"given-knots": 5, "chosen-knots": 5, "one-curve": 5, "whole-fit": 0}  # times its counterpart's


def edge(u):
    """A blade's edge, mm: curved, with one gentle wave."""
    t = (u - 12) / 48
    return -6 * (1 - t) + 1.5 * t * (1 - t) + 0.15 * np.sin(5 * t)


def best_of(call, repeats=15):
    times, result = [], None
    for _ in range(repeats):
        start = time.perf_counter()
        result = call()
        times.append(1e3 * (time.perf_counter() - start))
        if times[-1] > 500: break  # what takes so long varies little
    return min(times), result


def by_scipy(u, v, knots, places):
    full = np.r_[[u[0]] * 4, knots, [u[-1]] * 4]
    weights = np.full_like(u, 1 / SIGMA)
    cubic = lambda beta, x: interpolate.BSpline(full, beta, 3, extrapolate=True)(x)
    start = interpolate.make_lsq_spline(u, v, full, 3).c
    methods = {
        "make_lsq_spline": lambda: interpolate.make_lsq_spline(u, v, full, 3, w=weights),
        "make_smoothing_spline": lambda: interpolate.make_smoothing_spline(u, v, w=weights),
        "splrep": lambda: interpolate.BSpline(*interpolate.splrep(u, v, w=weights, s=len(u))),
        "odr": lambda: odr.ODR(odr.RealData(u, v, sx=SIGMA, sy=SIGMA), odr.Model(cubic), beta0=start, maxit=10).run(),
    }
    rows = {}
    for name, call in methods.items():
        ms, result = best_of(call, 3 if name in ("odr", "make_smoothing_spline") else 15)
        curve = (lambda x, beta=result.beta: cubic(beta, x)) if name == "odr" else result
        rows[name] = (ms, curve(places))
    return rows


def by_us(driver, u, v, knots, places):
    lines = [f"{len(knots)} {len(u)} {len(places)}", " ".join(map(repr, knots.tolist()))]
    lines += [f"{a!r} {b!r} {SIGMA}" for a, b in zip(u.tolist(), v.tolist())]
    lines.append(" ".join(map(repr, places.tolist())))
    out = subprocess.run([driver], input="\n".join(lines), capture_output=True, text=True, check=True).stdout
    return {f[0]: (float(f[1]), np.array(f[2:], float)) for f in map(str.split, out.strip().splitlines())}


def measure(driver, points, draws):
    """name -> (ms, rms error in micrometres), over the draws."""
    u = np.linspace(12, 60, points)
    places = np.linspace(12.5, 59.5, 200)
    knots = np.linspace(12, 60, 6)[1:-1]
    times, squares = {}, {}
    for draw in range(draws):
        v = edge(u) + SIGMA * np.random.default_rng(draw).standard_normal(points)
        rows = {**by_us(driver, u, v, knots, places), **by_scipy(u, v, knots, places)}
        for name, (ms, values) in rows.items():
            times[name] = min(ms, times.get(name, np.inf))
            squares.setdefault(name, []).append(np.mean((values - edge(places)) ** 2))
    return {name: (times[name], 1e3 * np.sqrt(np.mean(squares[name]))) for name in times}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("driver")
    parser.add_argument("--draws", type=int, default=5)
    arguments = parser.parse_args()
    behind = []
    for points in (200, 2000, 20000):
        table = measure(arguments.driver, points, arguments.draws)
        print(f"\n{points} points, sigma {SIGMA} mm\n{'method':24s}{'ms':>10s}{'error um':>10s}  against")
        for name, (ms, error) in table.items():
            other = COUNTERPART.get(name)
            note = ""
            if other:
                speed, accuracy = table[other][0] / ms, table[other][1] / error
                note = f"{other}: {speed:.1f} x as fast, {accuracy:.2f} x as accurate"
                # 2 %: the difference of two criteria of distance (vertical, orthogonal) at equal noise.
                if accuracy < 0.98 or speed < SPEED[name]:
                    behind.append(f"{points} points: {name} against {note}")
            print(f"{name:24s}{ms:10.3f}{error:10.2f}  {note}")
    for line in behind:
        print("BEHIND", line)
    sys.exit(1 if behind else 0)


if __name__ == "__main__":
    main()
