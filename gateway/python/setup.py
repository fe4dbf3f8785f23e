"""Builds the package for pip: adds the module that protoc generates, and writes nothing into this folder."""

import pathlib
import re
import subprocess
import tempfile

import setuptools
from setuptools.command.build_py import build_py

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = ROOT / "program/library/tactus_version.h"
VERSION = re.findall(r"^#define TACTUS_VERSION_[A-Z]+ (\d+)$", HEADER.read_text(encoding="utf-8"), re.MULTILINE)


class Build(build_py):
    def run(self):
        super().run()
        folder = pathlib.Path(self.build_lib) / "tactus"
        command = ["protoc", f"-I{ROOT}/gateway", f"--python_out={folder}", f"--pyi_out={folder}", "tactus.proto"]
        subprocess.run(command, check=True)


with tempfile.TemporaryDirectory() as scratch:
    setuptools.setup(
        version=".".join(VERSION),
        cmdclass={"build_py": Build},
        options={"build": {"build_base": scratch}, "egg_info": {"egg_base": scratch}},
    )
