"""Curves through the points of a chunk, as functions of time."""

import numpy as np
from scipy.interpolate import CubicSpline


def linear(stamps, q, v0):
    """Straight lines; the velocity at the start has no effect."""
    return lambda t: np.column_stack([np.interp(t, stamps, axis) for axis in q.T])


def clamped_cubic(stamps, q, v0, v1):
    """The cubic spline with these velocities at its ends."""
    return CubicSpline(stamps, q, bc_type=((1, v0), (1, v1)))


def natural_cubic(stamps, q):
    """The cubic spline without acceleration at its ends."""
    return CubicSpline(stamps, q, bc_type="natural") if len(stamps) > 1 else lambda t: np.tile(q[0], (len(t), 1))
