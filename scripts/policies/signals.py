"""What a policy intends: smooth motions of several axes over time, in rad (or in the unit of the axis).

Every axis follows the same motion, shifted in time and scaled, so that no two are alike and each stays within its
limits.
"""

import numpy as np

SINES = ((0.5, 0.25), (0.15, 0.7), (0.04, 1.5))  # rad, Hz
SHIFT_S = 1.37  # from one axis to the next
REACH_RAD, REACH_S, PAUSE_S = 0.6, 0.8, 0.5
SWITCH_RAD, SWITCH_S = 0.2, 0.6


def minimum_jerk(s):
    """Returns the minimum-jerk way from 0 to 1 at the fraction `s` of its time.  [Flash and Hogan 1985]"""
    s = np.clip(s, 0.0, 1.0)
    return s**3 * (10.0 - 15.0 * s + 6.0 * s**2)


def sines(t):
    """Returns the sum of three sines whose accelerations hardly ever peak together."""
    return sum(a * np.sin(2.0 * np.pi * f * t) for a, f in SINES)


def reaches(t):
    """Returns minimum-jerk reaches to and fro, with pauses between them."""
    number, since = np.divmod(np.asarray(t, float), REACH_S + PAUSE_S)
    way = minimum_jerk(since / REACH_S)
    return REACH_RAD * np.where(number % 2 == 0, way, 1.0 - way) - REACH_RAD / 2


def reach_spans(duration_s):
    """Returns (begin, end) of every reach that ends within `duration_s`, with time to arrive late."""
    period = REACH_S + PAUSE_S
    return [(k * period, k * period + REACH_S + 0.8 * PAUSE_S) for k in range(int(duration_s / period))]


MOTIONS = {"sines": (sines, SHIFT_S), "reaches": (reaches, 0.0)}


class Intent:
    """The intended motion of all axes; `switch_s` is the time at which the policy changes its mind, or None."""

    def __init__(self, kind, scales, switch_s=None):
        self.motion, self.shift_s = MOTIONS[kind]
        self.scales = np.asarray(scales, float)
        self.switch_s = switch_s

    def at(self, t, known_s=np.inf):
        """Returns the positions at the times `t`, one row each, as the policy knows them at the time `known_s`."""
        t = np.asarray(t, float)
        axes = np.arange(len(self.scales))
        q = self.scales * self.motion(t[:, None] + self.shift_s * axes)
        if self.switch_s is not None and known_s >= self.switch_s:
            q = q + SWITCH_RAD * self.scales * minimum_jerk((t[:, None] - self.switch_s) / SWITCH_S)
        return q
