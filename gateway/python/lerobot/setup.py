"""Builds the package for pip, and writes nothing into this folder."""

import pathlib
import re
import tempfile

import setuptools
from setuptools.command.egg_info import egg_info

HEADER = pathlib.Path(__file__).resolve().parents[3] / "program/library/tactus_version.h"
VERSION = re.findall(r"^#define TACTUS_VERSION_[A-Z]+ (\d+)$", HEADER.read_text(encoding="utf-8"), re.MULTILINE)


class Named(egg_info):
    """Keeps the underscores of the name, by which LeRobot finds the package; setuptools of Debian 12 writes hyphens."""

    name = "lerobot_robot_tactus"


with tempfile.TemporaryDirectory() as scratch:
    setuptools.setup(
        version=".".join(VERSION),
        cmdclass={"egg_info": Named},
        options={"build": {"build_base": scratch}, "egg_info": {"egg_base": scratch}},
    )
