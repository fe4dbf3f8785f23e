"""Numbers, rows and comments as they are in sources."""

import math

import numpy as np

LINE = 100  # columns


def number(value):
    return repr(float(value) + 0.0)


def row(values):
    return ", ".join(number(value) for value in values)


def quoted(names):
    return ", ".join(f'"{name}"' for name in names)


def rows_of(lines):
    return "\n".join(f"      {{{line}}}," for line in lines)


def comment(text):
    """Returns paragraphs as lines of a comment."""
    lines = []
    for paragraph in text.strip().split("\n\n"):
        lines += ["//"] if lines else []
        line = "//"
        for word in paragraph.split():
            if len(line) + 1 + len(word) > LINE:
                lines.append(line)
                line = "//"
            line += " " + word
        lines.append(line)
    return "\n".join(lines)


def euler(rotation):
    """Returns roll, pitch and yaw of a rotation matrix."""
    pitch = math.atan2(-rotation[2, 0], math.hypot(rotation[0, 0], rotation[1, 0]))
    if abs(rotation[2, 0]) > 1.0 - 1e-14:
        return math.atan2(-rotation[1, 2], rotation[1, 1]), pitch, 0.0
    return math.atan2(rotation[2, 1], rotation[2, 2]), pitch, math.atan2(rotation[1, 0], rotation[0, 0])


def quaternion(rotation):
    """Returns w, x, y, z of a rotation matrix: of its four forms the one that loses no digits."""
    trace, d = rotation.trace(), rotation.diagonal()
    squares = np.array([1 + trace, *(1 + 2 * d - trace)])
    k = int(squares.argmax())
    x, y, z = rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]
    if k == 0:
        parts = np.array([squares[0], x, y, z])
    else:
        sums = rotation[k - 1] + rotation[:, k - 1]
        sums[k - 1] = squares[k]
        parts = np.array([(x, y, z)[k - 1], *sums])
    return parts / np.linalg.norm(parts)


def tensor_row(t):
    return row((t[0, 0], t[1, 1], t[2, 2], t[0, 1], t[0, 2], t[1, 2]))


def plain(values):
    return " ".join(number(value) for value in values)


def direction(a, b):
    return b - a if np.linalg.norm(b - a) > 0.0 else np.array([0.0, 0.0, 1.0])
