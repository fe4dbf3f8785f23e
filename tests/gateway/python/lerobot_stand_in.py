"""A stand-in for what lerobot_robot_tactus and its tests take of LeRobot, which Debian does not have.

Written from the page "Bring Your Own Hardware" of LeRobot 0.6. Importing this module puts it in the place of `lerobot`.
"""

import abc
import dataclasses
import importlib
import importlib.metadata
import sys
import types
from unittest import mock

ABSTRACT = ("connect", "calibrate", "configure", "get_observation", "send_action", "disconnect", "is_connected")
ABSTRACT += ("is_calibrated", "observation_features", "action_features")
DeviceNotConnectedError = type("DeviceNotConnectedError", (ConnectionError,), {})
DeviceAlreadyConnectedError = type("DeviceAlreadyConnectedError", (ConnectionError,), {})
CameraConfig = dataclasses.make_dataclass("CameraConfig", ["height", "width"])
kinds = {}


@dataclasses.dataclass(kw_only=True)
class RobotConfig:
    id: str | None = None

    @classmethod
    def register_subclass(cls, name):
        return lambda kind: kinds.setdefault(name, kind)


class Robot(abc.ABC):
    locals().update({name: abc.abstractmethod(lambda self: None) for name in ABSTRACT})

    def __init__(self, config):
        self.id = config.id


def make_cameras_from_configs(configs):
    return {name: mock.Mock(**{"async_read.return_value": name}) for name in configs}


def register_third_party_plugins():
    """Imports what is installed under a name that begins as LeRobot asks for."""
    for distribution in importlib.metadata.distributions():
        if distribution.metadata["Name"].startswith("lerobot_robot_"):
            importlib.import_module(distribution.metadata["Name"])


def make_robot(kind, **settings):
    """The class of the robot stands beside that of its configuration, whose name has "Config" behind it."""
    config = kinds[kind](**settings)
    return getattr(sys.modules[type(config).__module__], type(config).__name__.removesuffix("Config"))(config)


for name in ("lerobot", "lerobot.robots", "lerobot.cameras", "lerobot.cameras.utils", "lerobot.utils", "lerobot.utils.errors"):
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update({key: value for key, value in globals().items() if isinstance(value, (type, types.FunctionType))})
