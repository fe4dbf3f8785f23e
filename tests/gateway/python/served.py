"""The server of the board whose program is $P, for the tests that need an arm."""

import os
import pathlib
import time
import unittest

import numpy as np
import tactus

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = pathlib.Path(os.environ["P"])
ROBOT = PROGRAM.parent.name.split("_")[0]
JOINT_PIPELINE = ROOT / "pipelines" / {"ur10": "ur10_jrg_pid.ini"}.get(ROBOT, f"{ROBOT}_jrg_pdgc.ini")
TASK_PIPELINE = ROOT / "pipelines" / f"{ROBOT}_trg_cpc.ini"
SENSOR_PIPELINE = ROOT / "pipelines" / {"ur10": "ur10_trg_ac_cpc.ini"}.get(ROBOT, f"{ROBOT}_trg_ac_cpc_pid.ini")
DISABLED = 5  # rung of the ladder; the reference stands still, whatever velocity it had
home = np.zeros(0)  # rad; the test module sets it
address = ""  # of the server of the test module


def serve(pipeline=JOINT_PIPELINE):
    return tactus.serve(pipeline, program=PROGRAM)


def serve_module():
    """Serves the joint pipeline for all tests of a module, whose setUpModule this is."""
    global address, home
    address = unittest.enterModuleContext(serve())
    with connect() as arm:
        home = arm.state().q_d


def connect(**settings):
    return tactus.connect(address, **settings)


def moved(dof):
    """The joints that tests move: all but the last, which swings for seconds on the UR10 (ur10_jrg_pdgc.ini)."""
    return np.r_[np.ones(dof - 1), 0.0]


def swing(begin, way=0.2, duration_s=1.0, rate_hz=100):
    """Returns t, q, dq, ddq of a rest-to-rest quintic of all joints but the last from `begin` on."""
    t = np.linspace(0, duration_s, round(duration_s * rate_hz) + 1)
    s = (t / duration_s)[:, None]
    ones = moved(len(begin))
    return dict(
        t=t,
        q=begin + way * (10 * s**3 - 15 * s**4 + 6 * s**5) * ones,
        dq=way / duration_s * (30 * s**2 - 60 * s**3 + 30 * s**4) * ones,
        ddq=way / duration_s**2 * (60 * s - 180 * s**2 + 120 * s**3) * ones,
    )


def at_rest(arm, within_s=5.0):
    """Waits until the reference has rested for 50 ms, or the drives are disabled, and returns the state."""
    end, since = time.monotonic() + within_s, None
    for state in arm.watch():
        goes_on = state.rung != DISABLED and np.abs(state.dq_d).max() > 1e-9
        if goes_on or np.abs(state.dq).max() > 0.05:
            since = None
        elif since is None:
            since = state.stamp_ns
        elif state.stamp_ns - since > 50_000_000:
            return state
        if time.monotonic() > end:
            raise AssertionError(f"the arm moves after {within_s} s: {state}")


def go_home(arm):
    """Moves the arm to where it was when the server began."""
    way = np.abs(at_rest(arm).q_d - home).max()
    if way > 1e-6:
        arm.move(t=[0.3 + 5 * way], q=home[None], dq=np.zeros((1, arm.robot.dof)))
