#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The bladecurve authors
# SPDX-License-Identifier: MIT
"""Calls an exported blade from Python, with ctypes alone.

usage: eval_blade.py BLADE.so THETA_DEG X_MM...
prints x_mm,phi_mm,phi_x,phi_theta_mm_per_rad,flags
"""
import ctypes
import math
import sys


class Sample(ctypes.Structure):  # bladecurve_sample of model/blade_plugin.h
    _fields_ = [(name, ctypes.c_double) for name in (
        "phi_mm", "phi_x", "phi_theta_mm_per_rad",
        "phi_xx_per_mm", "phi_xtheta_per_rad", "phi_thetatheta_mm_per_rad2")]
    _fields_.append(("flags", ctypes.c_uint))


def load(path):
    blade = ctypes.CDLL(path)
    blade.bladecurve_eval.argtypes = [ctypes.c_double, ctypes.c_double, ctypes.POINTER(Sample)]
    blade.bladecurve_eval.restype = None
    return blade


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    blade = load(sys.argv[1])
    theta_rad = float(sys.argv[2]) * (math.pi / 180)
    for x_mm in map(float, sys.argv[3:]):
        s = Sample()
        blade.bladecurve_eval(x_mm, theta_rad, ctypes.byref(s))
        print(x_mm, s.phi_mm, s.phi_x, s.phi_theta_mm_per_rad, s.flags, sep=",")


if __name__ == "__main__":
    main()
