"""Kinematics and dynamics straight from the chain of the URDF, by Jacobians of the centres of mass; it shares nothing with the table."""

import numpy as np

from reading import turn

GRAVITY = 9.81  # m/s^2, as the kernel's


def places(chain, q):
    """Returns the frames of the URDF's links that move, and that of the tip."""
    frames, frame = [], np.eye(4)
    for joint, position in zip(chain.joints, q):
        frame = frame @ joint.origin
        if joint.prismatic:
            frame[:3, 3] += frame[:3, :3] @ joint.axis * position
        else:
            frame[:3, :3] = frame[:3, :3] @ turn(joint.axis, position)
        frames.append(frame.copy())
    return frames, frame @ chain.flange


def jacobian(chain, frames, point, count):
    """Returns the columns of the first `count` joints, the linear part first."""
    J = np.zeros((6, len(chain.joints)))
    for k in range(count):
        axis = frames[k][:3, :3] @ chain.joints[k].axis
        if chain.joints[k].prismatic:
            J[:3, k] = axis
        else:
            J[:3, k], J[3:, k] = np.cross(axis, point - frames[k][:3, 3]), axis
    return J


def gravity_and_mass(chain, q):
    """Returns g(q), N m, and M(q), kg m^2; N and kg of prismatic joints."""
    frames, _ = places(chain, q)
    g, M = np.zeros(len(q)), np.zeros((len(q), len(q)))
    for i, (joint, frame) in enumerate(zip(chain.joints, frames)):
        body = joint.body.moved(frame)
        J = jacobian(chain, frames, body.com, i + 1)
        g += body.mass * GRAVITY * J[2]
        M += body.mass * J[:3].T @ J[:3] + J[3:].T @ body.tensor @ J[3:]
    return g, M


def tip_jacobian(chain, q):
    frames, tip = places(chain, q)
    return jacobian(chain, frames, tip[:3, 3], len(q))
