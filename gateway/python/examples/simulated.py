"""The arm of an example: that of an address, or a simulated one."""

import contextlib
import pathlib

import tactus

PIPELINES = pathlib.Path(__file__).resolve().parents[3] / "pipelines"


def arm_of(arguments, pipeline):
    """Returns the arm at the address in the arguments, or one that runs a pipeline in simulation, for a `with`."""
    return tactus.connect(arguments[0]) if arguments else tactus.sim(PIPELINES / f"{pipeline}.ini")


def address_of(arguments, pipeline):
    """Returns the address in the arguments, or that of a simulated arm that runs a pipeline, for a `with`."""
    return contextlib.nullcontext(arguments[0]) if arguments else tactus.serve(PIPELINES / f"{pipeline}.ini")
