"""tactus: moves a robot arm through the gateway of a Tactus server.

    import numpy as np
    import tactus

    with tactus.connect("unix:/run/tactus/socket") as arm:
        here = arm.state().q
        t = np.linspace(0.5, 3.0, 6)
        path = here + np.outer(1 - np.cos(np.linspace(0, np.pi, 6)), 0.1 * np.ones(arm.robot.dof))
        for feedback in arm.start(q=path, t=t):
            print(feedback.time_s, feedback.desired.q - feedback.actual.q)

Units are SI: rad, m, s, N, N m. Joints come in the order of `arm.robot.joints`. A pose is seven numbers
(x, y, z, qw, qx, qy, qz), a twist six (vx, vy, vz, wx, wy, wz), a wrench six (fx, fy, fz, mx, my, mz), all of the tool
tip in the axes of the base; a wrench is what the environment exerts on the tool. n of them are n rows.
Times named *_ns are nanoseconds of this process's `time.monotonic_ns()`; the library converts them to the clock of the
server and follows its drift.

Errors are subclasses of `tactus.Error`. A mistake of the caller that can be seen without the server (the shape of an
array, two kinds of target at once, a number out of its range) is a ValueError; nothing was sent. No call waits without
end: a server that is silent for `timeout_s` has failed (Lost). The arm never depends on this process: if it dies, the
server brings the arm to rest.

All methods may be called from any thread. The library needs numpy and protobuf.
"""

try:
    from . import tactus_pb2
except ImportError as error:
    raise ImportError(f"{error}; pip install gateway/python, or run `make python` and use build/python") from error

from .arm import Arm, connect
from .errors import Aborted, Error, Lost, Refused, Stopped
from .messages import Event, Feedback, Joint, Result, RobotDescription, Sample, State
from .parameters import Parameter
from .protocol import Code, Outcome, Phase, Rung
from .robot import Robot
from .simulation import serve, sim
from .streams import Chunks, Stream
from .trajectories import Motion

__all__ = [
    "Aborted", "Arm", "Chunks", "Code", "Error", "Event", "Feedback", "Joint", "Lost", "Motion", "Outcome",
    "Parameter", "Phase", "Refused", "Result", "Robot", "RobotDescription", "Rung", "Sample", "State", "Stopped",
    "Stream", "connect", "serve", "sim"
]
