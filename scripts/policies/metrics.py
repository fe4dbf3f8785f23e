"""What the benchmark measures of a command u(t), sampled with the period dt, one column per axis.

Derivatives are differences of the samples. Where a limit holds between the samples it holds for them too: the k-th
difference over dt^k is an average of the k-th derivative.
"""

import numpy as np

STILL_RAD_S, MOVING_RAD_S, STILL_S = 0.02, 0.2, 0.008
SPARC_PADDING, SPARC_HZ, SPARC_LEAST = 4, 10.0, 0.05
LONGEST_DELAY_S, DELAY_SAMPLES_S = 0.25, 0.010


def derivative(u, dt, order):
    """Returns the difference of the given order over dt^order; it is `order` rows shorter."""
    return np.diff(u, order, axis=0) / dt**order


def rms(values):
    """Returns the root of the mean square of every column."""
    return np.sqrt(np.mean(np.square(values), axis=0))


def largest(values):
    return np.max(np.abs(values), axis=0)


def runs(flags):
    """Returns (begin, end) of every run of true flags."""
    edges = np.flatnonzero(np.diff(np.r_[False, flags, False].astype(int)))
    return edges.reshape(-1, 2)


def still(u, reference, dt, counted):
    """Returns, for every cycle and axis, whether the axis rests while its reference moves, and `counted` is true."""
    moving = np.abs(derivative(reference, dt, 1)) > MOVING_RAD_S
    return (np.abs(derivative(u, dt, 1)) < STILL_RAD_S) & moving & counted[1:, None]


def rests(flags, dt):
    """Returns how often a second a flag is set for at least 8 ms."""
    return sum((end - begin) * dt >= STILL_S - 1e-9 for begin, end in runs(flags)) / (len(flags) * dt)


def axis_rests(u, reference, dt, counted):
    """Returns how often a second every axis rests for at least 8 ms while its reference moves.

    An axis also rests where it makes up for a disagreement against the direction of a slow reference.
    """
    return np.array([rests(flags, dt) for flags in still(u, reference, dt, counted).T])


def standstills(u, reference, dt, counted):
    """Returns how often a second all axes rest for at least 8 ms while the reference of one of them moves."""
    slow = np.all(np.abs(derivative(u, dt, 1)) < STILL_RAD_S, axis=1)
    return rests(slow & np.any(still(u, reference, dt, counted), axis=1), dt)


def delay(u, reference, dt):
    """Returns the shift d that minimises rms(u(t) - reference(t - d)), for every axis, and that rms.

    The optimum lies between samples: a parabola through the three best mean squares.
    """
    most = int(round(LONGEST_DELAY_S / dt))
    shifts = np.arange(-(most // 4), most + 1)
    chosen = np.arange(most, len(u) - most, max(int(round(DELAY_SAMPLES_S / dt)), 1))
    squares = np.array([np.mean((u[chosen] - reference[chosen - k]) ** 2, axis=0) for k in shifts])
    delays, remains = np.zeros(u.shape[1]), np.zeros(u.shape[1])
    for axis, column in enumerate(squares.T):
        best = int(np.clip(np.argmin(column), 1, len(shifts) - 2))
        before, at, after = column[best - 1 : best + 2]
        bend = before - 2.0 * at + after
        part = 0.5 * (before - after) / bend if bend > 0.0 else 0.0
        delays[axis] = (shifts[best] + part) * dt
        remains[axis] = np.sqrt(max(at - 0.25 * (before - after) * part, 0.0))
    return delays, remains


def sparc(speed, dt):
    """Returns the spectral arc length of the speed of one movement: nearer to 0 is smoother.

    [Balasubramanian, Melendez-Calderon, Roby-Brami, Burdet, J. NeuroEngineering and Rehabilitation 12:112, 2015]
    """
    size = 2 ** (int(np.ceil(np.log2(len(speed)))) + SPARC_PADDING)
    frequency = np.arange(size // 2) / (size * dt)
    spectrum = np.abs(np.fft.rfft(speed, size))[: size // 2]
    spectrum = spectrum / spectrum.max()
    low = frequency <= SPARC_HZ
    frequency, spectrum = frequency[low], spectrum[low]
    last = np.flatnonzero(spectrum >= SPARC_LEAST)[-1]
    frequency, spectrum = frequency[: last + 1], spectrum[: last + 1]
    span = frequency[-1] - frequency[0]
    return -np.sum(np.hypot(np.diff(frequency) / span, np.diff(spectrum)))


def ldlj(speed, dt):
    """Returns the logarithmic dimensionless jerk of the speed of one movement: nearer to 0 is smoother."""
    jerk = np.diff(speed, 2) / dt**2
    duration = len(speed) * dt
    return -np.log(duration**3 / np.max(speed) ** 2 * np.sum(jerk**2) * dt)


def reaction(u, before, after, t, switch_s):
    """Returns how much later than the intent every axis has gone half the way from the old intent to the new one, s."""
    way = after - before
    gone = np.divide((u - before) * np.sign(way), np.abs(way).max(axis=0))
    ideal = np.abs(way) / np.abs(way).max(axis=0)
    late = [
        t[np.argmax((gone[:, k] >= 0.5) & (t > switch_s))] - t[np.argmax((ideal[:, k] >= 0.5) & (t > switch_s))]
        for k in range(u.shape[1])
    ]
    return np.array(late)
