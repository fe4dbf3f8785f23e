"""What the server says, as the library hands it on: the robot, its states, feedback, results, events."""

import dataclasses
from typing import Mapping, Sequence

import numpy as np

from . import tactus_pb2 as pb
from .clock import Clock
from .protocol import Array, Code, Outcome, Phase, Rung, copied, named


@dataclasses.dataclass(frozen=True)
class Joint:
    """A joint and its limits: rad, rad/s, rad/s^2, rad/s^3, N m; of a prismatic one m, m/s, m/s^2, m/s^3, N."""

    name: str
    min_rad: float
    max_rad: float
    velocity: float
    acceleration: float
    jerk: float
    effort: float
    continuous: bool = False  # it has no end: angles that differ by whole turns are the same place
    prismatic: bool = False  # it moves along its axis


@dataclasses.dataclass(frozen=True)
class RobotDescription:
    """What the server said when the connection was made."""

    board: str
    name: str
    pipeline: str
    configuration: int  # hash of the pipeline file
    period_s: float
    joints: tuple[Joint, ...]
    takes_joints: bool
    takes_poses: bool
    longest_chunk: int  # targets
    window: int  # waypoints that the server holds at once
    longest_part: int  # waypoints of a message
    outputs: Mapping[int, str]  # digital outputs that can be set, with the robot's names for them, or ""

    @property
    def dof(self) -> int:
        """The number of joints."""
        return len(self.joints)


@dataclasses.dataclass(frozen=True)
class Sample:
    """A reference or a measurement; a field that was not given is None.

    Of the joints q, dq, ddq, tau: [joints] rad, rad/s, rad/s^2, N m. Of the tip pose [7], twist, acceleration and
    wrench [6]: m and quaternion, m/s and rad/s, m/s^2 and rad/s^2, N and N m.
    """

    q: Array | None = None
    dq: Array | None = None
    ddq: Array | None = None
    tau: Array | None = None
    pose: Array | None = None
    twist: Array | None = None
    acceleration: Array | None = None
    wrench: Array | None = None


@dataclasses.dataclass(frozen=True)
class Feedback:
    """Reference and measurement of one cycle while a trajectory is executed. `lost` messages before it were dropped.

    path_s of path_end_s of the trajectory's own time have passed; they wait in a pause and slow down with an override.
    """

    time_s: float
    desired: Sample
    actual: Sample
    lost: int
    path_s: float
    path_end_s: float  # time of the last waypoint that the server has


@dataclasses.dataclass(frozen=True)
class Result:
    """How a trajectory has ended. `stretch` is the fraction by which it was slowed down to keep the limits."""

    outcome: Outcome
    status: int  # a Code
    text: str
    time_s: float
    stretch: float

    @property
    def succeeded(self) -> bool:
        """It has arrived, within the tolerances of its goal."""
        return self.outcome == Outcome.SUCCEEDED


@dataclasses.dataclass(frozen=True)
class Event:
    """An entry of the server's event log."""

    stamp_ns: int  # by this process's time.monotonic_ns()
    name: str
    status: int  # a Code
    text: str


@dataclasses.dataclass(frozen=True)
class State:
    """The arm in one cycle. `stamp_ns` is the begin of the cycle by this process's time.monotonic_ns()."""

    stamp_ns: int
    server_ns: int  # the same by the server's clock
    cycle: int
    rung: int  # a Rung; from HOLD on no references are taken
    status: int  # a Code: why it is not nominal
    phase: int  # a Phase of the motion
    epoch: int
    owner: str  # the client that holds the lease; "" if nobody does
    override: float
    speed_scaling: float
    q: Array  # measured: [joints] rad
    dq: Array  # rad/s
    tau: Array  # N m
    q_d: Array | None  # the reference
    dq_d: Array | None
    pose: Array | None  # of the tip, [7]
    pose_d: Array | None
    wrench: Array | None  # [6] N, N m
    margin_s: float  # until a stream starves
    slips: int
    overruns: int
    lost: int  # States that were not sent since the connection was made
    chunks_taken: int
    chunks_late: int
    chunks_dropped: int
    targets_trimmed: int
    seam: float  # largest difference at the latest seam, rad, or m and rad
    outputs: Mapping[int, bool]  # digital outputs as commanded; those that were left alone are not in it


def robot_of(welcome: pb.Welcome) -> RobotDescription:
    joints = tuple(copied(Joint, joint) for joint in welcome.joints)
    offered = [i for i in range(32) if welcome.outputs >> i & 1]
    outputs = dict(zip(offered, list(welcome.output_names) or [""] * len(offered)))
    return copied(RobotDescription, welcome, name=welcome.robot, joints=joints, outputs=outputs)


def _array(numbers: Sequence[float]) -> Array | None:
    return np.array(numbers, dtype=float) if len(numbers) else None


def _sample(joint: pb.JointPoint, task: pb.TaskPoint) -> Sample:
    return Sample(
        *map(_array, (joint.q, joint.dq, joint.ddq, joint.tau, task.pose, task.twist, task.acceleration, task.wrench))
    )


def feedback_of(told: pb.Feedback) -> Feedback:
    desired, actual = _sample(told.joint_desired, told.task_desired), _sample(told.joint_actual, told.task_actual)
    return copied(Feedback, told, desired=desired, actual=actual)


def result_of(told: pb.Report) -> Result:
    return copied(Result, told, outcome=Outcome(told.outcome), status=named(Code, told.status))


def event_of(told: pb.Event, clock: Clock) -> Event:
    return copied(Event, told, stamp_ns=clock.to_local(told.server_ns), status=named(Code, told.status))


def state_of(told: pb.State, clock: Clock) -> State:
    arrays = ("q", "dq", "tau", "q_d", "dq_d", "pose", "pose_d", "wrench")
    return copied(
        State,
        told,
        stamp_ns=clock.to_local(told.server_ns),
        rung=named(Rung, told.rung),
        status=named(Code, told.status),
        phase=named(Phase, told.phase),
        chunks_taken=told.stream.taken,
        chunks_late=told.stream.late,
        chunks_dropped=told.stream.dropped,
        targets_trimmed=told.stream.trimmed,
        seam=told.stream.seam,
        outputs={i: bool(told.outputs >> i & 1) for i in range(32) if told.outputs_mask >> i & 1},
        **{name: _array(getattr(told, name)) for name in arrays},
    )
