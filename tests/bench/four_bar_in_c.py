"""The four-bar as a plain loop in C, compiled as fast as the compiler can without loose arithmetic.

The same formulas as in ``linkages_by_formulas``.
"""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np

SOURCE = r"""
#include <math.h>

void four_bar(long n, const double *restrict degrees, double *restrict out)
{
    const double omega = 10.0, l = 0.04, r = 0.09, s = 0.07, gx0 = 0.1;
    for (long i = 0; i < n; i++) {
        double phi = degrees[i] * (3.14159265358979323846 / 180);
        double x = l * cos(phi), y = l * sin(phi);
        double vx = -omega * y, vy = omega * x;
        double ax = -omega * omega * x, ay = -omega * omega * y;
        double gx = gx0 - x, gy = -y, inverse = 1 / (gx * gx + gy * gy);
        double along = 0.5 + 0.5 * (r * r - s * s) * inverse;
        double across = sqrt(r * r * inverse - along * along);
        double ux = along * gx - across * gy, uy = along * gy + across * gx;
        double wx = ux - gx, wy = uy - gy;
        inverse = 1 / (ux * wy - uy * wx);
        double w2 = -(vx * wx + vy * wy) * inverse, w3 = -(vx * ux + vy * uy) * inverse;
        double bx = ax - w2 * w2 * ux, by = ay - w2 * w2 * uy;
        double e2 = -(bx * wx + by * wy + w3 * w3 * s * s) * inverse;
        double *at = out + 12 * i;
        at[0] = x;
        at[1] = y;
        at[2] = vx;
        at[3] = vy;
        at[4] = ax;
        at[5] = ay;
        at[6] = x + ux;
        at[7] = y + uy;
        at[8] = vx - w2 * uy;
        at[9] = vy + w2 * ux;
        at[10] = bx - e2 * uy;
        at[11] = by + e2 * ux;
    }
}
"""


def compiled(folder: Path) -> Callable[[np.ndarray], np.ndarray] | None:
    """The loop as a function of the crank's angles, positions by twelve; None without compiler."""
    compiler = shutil.which("cc")
    if compiler is None:
        return None
    source, library = folder / "four_bar.c", folder / "four_bar.so"
    source.write_text(SOURCE, encoding="utf-8")
    options = ["-O3", "-march=native", "-fno-math-errno", "-shared", "-fPIC"]
    subprocess.run([compiler, *options, str(source), "-o", str(library), "-lm"], check=True)
    loop = ctypes.CDLL(str(library)).four_bar
    loop.argtypes, loop.restype = [ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p], None

    def run(degrees: np.ndarray) -> np.ndarray:
        out = np.empty((degrees.size, 12))
        loop(degrees.size, degrees.ctypes.data, out.ctypes.data)
        return out

    return run
