"""A filter that follows a command within limits of velocity and acceleration, without any of jerk."""

import numpy as np


def trapezoid(u, dt, v_max, a_max):
    """Returns the positions of an axis that is driven to u: as fast as it can still stop there."""
    p, v, out = u[0].copy(), np.zeros(u.shape[1]), np.empty_like(u)
    for i, target in enumerate(u):
        way = target - p
        # The velocity from which braking by a_max dt a cycle ends after `way`.
        brake = np.sqrt((0.5 * a_max * dt) ** 2 + 2.0 * a_max * np.abs(way)) - 0.5 * a_max * dt
        wanted = np.sign(way) * np.minimum(np.minimum(brake, v_max), np.abs(way) / dt)
        v = np.clip(wanted, v - a_max * dt, v + a_max * dt)
        p = p + v * dt
        out[i] = p
    return out
