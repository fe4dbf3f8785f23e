"""The arm behind a server, or a simulated one, with the interface of LeRobot's robots."""

import contextlib
import dataclasses
import functools
from typing import Any, Iterator

import numpy as np
import tactus
from lerobot.cameras import CameraConfig
from lerobot.cameras.utils import make_cameras_from_configs
from lerobot.robots import Robot, RobotConfig
from lerobot.utils.errors import DeviceAlreadyConnectedError, DeviceNotConnectedError


@RobotConfig.register_subclass("tactus")
@dataclasses.dataclass(kw_only=True)
class TactusRobotConfig(RobotConfig):
    """`--robot.type=tactus`: the arm of the server at an address, or a simulated one."""

    address: str | None = None  # as of tactus.connect, and so are key, priority and lease_s
    key: str | None = None
    priority: int = 0
    lease_s: float = 1.0
    pipeline: str | None = None  # instead of an address: as of tactus.serve, and so is the program
    program: str | None = None
    rate_hz: float = 30.0  # steps of a chunk per second
    cameras: dict[str, CameraConfig] = dataclasses.field(default_factory=dict)


class TactusRobot(Robot):
    """Observes and commands joint positions, `NAME.pos`, in rad, of prismatic joints m: not in degrees, not normalized.

    A lost server raises DeviceNotConnectedError, and what the server refuses an error of `tactus`.
    """

    config_class = TactusRobotConfig
    name = "tactus"

    def __init__(self, config: TactusRobotConfig):
        super().__init__(config)
        if config.address is not None and config.pipeline is not None:
            raise ValueError(f"address {config.address!r} and pipeline {config.pipeline!r}; give one of them")
        self.config = config
        self.cameras = make_cameras_from_configs(config.cameras)
        self.observed_ns = 0  # when the latest observation was made, by time.monotonic_ns()
        self._robot: tactus.Robot | None = None
        self._opened = contextlib.ExitStack()

    @contextlib.contextmanager
    def _open(self) -> Iterator[tactus.Robot]:
        """Connects to the server, or to one that it starts."""
        config, server = self.config, contextlib.nullcontext(self.config.address)
        if config.pipeline is not None:
            server = tactus.serve(config.pipeline, program=config.program)
        settings = dict(rate_hz=config.rate_hz, key=config.key, priority=config.priority, lease_s=config.lease_s)
        with server as address, tactus.Robot(address, **settings) as robot:
            if not robot.arm.robot.takes_joints:
                raise ValueError(f"pipeline {robot.arm.robot.pipeline} takes poses; serve one that takes joint positions")
            yield robot

    @contextlib.contextmanager
    def connection(self) -> Iterator[tactus.Robot]:
        """Yields the connection. One that is lost meanwhile is closed, and raised as LeRobot expects it."""
        if self._robot is None:
            raise DeviceNotConnectedError(f"{self} is not connected; call connect()")
        try:
            yield self._robot
        except tactus.Lost as error:
            with contextlib.suppress(tactus.Error):
                self._opened.close()
            raise DeviceNotConnectedError(f"{self}: {error}; connect() again") from error

    @functools.cached_property
    def _joints(self) -> dict[str, tactus.Joint]:
        """The joints by feature. LeRobot asks for features before it connects: then the server is asked for them."""
        try:
            with self._open() if self._robot is None else contextlib.nullcontext(self._robot) as robot:
                return {f"{joint.name}.pos": joint for joint in robot.arm.robot.joints}
        except tactus.Lost as error:
            raise DeviceNotConnectedError(f"{self}: {error}") from error

    @property
    def observation_features(self) -> dict[str, Any]:
        return self.action_features | {name: (one.height, one.width, 3) for name, one in self.config.cameras.items()}

    @property
    def action_features(self) -> dict[str, Any]:
        return dict.fromkeys(self._joints, float)

    @property
    def is_connected(self) -> bool:
        return self._robot is not None and all(camera.is_connected for camera in self.cameras.values())

    @property
    def is_calibrated(self) -> bool:
        return True

    def calibrate(self) -> None:
        """Does nothing, as `configure`: the pipeline file has the settings."""

    configure = calibrate

    def connect(self, calibrate: bool = True) -> None:
        """Connects to server and cameras. Nothing moves, and another client may own the arm, until the first action."""
        if self._robot is not None:
            raise DeviceAlreadyConnectedError(f"{self} is connected already; disconnect() first")
        with contextlib.ExitStack() as opened:
            opened.callback(setattr, self, "_robot", None)
            try:
                robot = opened.enter_context(self._open())
            except tactus.Lost as error:
                raise DeviceNotConnectedError(f"{self}: {error}") from error
            for camera in self.cameras.values():
                camera.connect()
                opened.callback(camera.disconnect)
            self._robot, self._opened = robot, opened.pop_all()

    def get_observation(self) -> dict[str, Any]:
        """Returns the measured positions, and an image of each camera."""
        with self.connection() as robot:
            seen = robot.observe()
        self.observed_ns = int(seen["stamp_ns"])
        images = {name: camera.async_read() for name, camera in self.cameras.items()}
        return dict(zip(self._joints, seen["q"].tolist())) | images

    def send_action(self, action: dict[str, Any]) -> dict[str, Any]:
        """Sends positions to go to now, within all limits, and returns them as the server takes them: held in the range.

        The next call raises what the server refuses: a number that is not finite or, as degrees are, 0.1 rad beyond.
        """
        if set(action) != set(self._joints):
            raise ValueError(f"action has {', '.join(action) or 'nothing'}; expected {', '.join(self._joints)}")
        target = [float(action[name]) for name in self._joints]
        with self.connection() as robot:
            robot.act(target)
        ends = np.transpose([(joint.min_rad, joint.max_rad) for joint in self._joints.values()])
        return dict(zip(self._joints, np.clip(target, *ends).tolist()))

    def disconnect(self) -> None:
        """Waits until the arm rests on its last target, cancels what still moves after 5 s, and gives the lease back."""
        with self.connection() as robot, self._opened:
            robot.rest()
