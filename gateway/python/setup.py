"""Builds the package for pip: adds the module that protoc generates, and writes nothing into this folder."""

import pathlib
import re
import subprocess
import tempfile

import setuptools
from setuptools.command.build_py import build_py

ROOT = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"^VERSION := ([\d.]+)", (ROOT / "program/install.mk").read_text(encoding="utf-8"), re.MULTILINE)


class Build(build_py):
    def run(self):
        super().run()
        folder = pathlib.Path(self.build_lib) / "tactus"
        command = ["protoc", f"-I{ROOT}/gateway", f"--python_out={folder}", f"--pyi_out={folder}", "tactus.proto"]
        subprocess.run(command, check=True)


with tempfile.TemporaryDirectory() as scratch:
    setuptools.setup(
        version=VERSION[1],
        cmdclass={"build_py": Build},
        options={"build": {"build_base": scratch}, "egg_info": {"egg_base": scratch}},
    )
