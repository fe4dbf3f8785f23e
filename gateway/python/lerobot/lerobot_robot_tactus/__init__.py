"""A Tactus arm as a robot of LeRobot, type "tactus", which LeRobot finds when the package is installed."""

from .chunking import RealTimeChunking
from .robot import TactusRobot, TactusRobotConfig

__all__ = ["RealTimeChunking", "TactusRobot", "TactusRobotConfig"]
