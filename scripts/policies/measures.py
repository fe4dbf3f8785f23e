"""Runs executors over scenarios and measures their commands."""

import dataclasses
import pathlib

import numpy as np

import metrics
import real_time_chunking
from executors import EXECUTORS
from robots import Command
from scenarios import SCENARIOS, chunks, covered
from signals import reach_spans

SETTLED_S = 2.0  # of the beginning is not measured, except for our limits and where the first chunk is late
GRACE_S = 0.1  # before chunks run out, and after they come again: rests there are no standstills
BASELINE_DT = 1e-3
INTENT, OURS = "intent", "ours"
# Ours on the chunks of real-time chunking, by its weights.
CONDITIONED = {
    "RTC, then ours": real_time_chunking.lerobot,
    "RTC of the paper, then ours": real_time_chunking.published,
}
# Executors of the replay program: its mode, None for that of the space, and its settings, fade and smoothing in s.
REPLAYED = {
    "rest per target": ("rest",),
    "point per target": ("stream",),
    "ours, not smoothed": (None, 0.3, 0.0),
    "ours, no fade": (None, 0.0, 0.03),
    **dict.fromkeys([*CONDITIONED, OURS], (None, 0.3, 0.03)),
}


@dataclasses.dataclass(frozen=True)
class Case:
    """One executor on one scenario; `period_us`, `robot` and `space` matter to ours."""

    scenario: str
    executor: str  # of EXECUTORS or REPLAYED, or INTENT
    robot: str
    space: str = "joint"
    period_us: int = 1000
    seed: int = 1
    duration_s: float | None = None


def shares(q, dt, limits):
    """Returns the largest shares of the limits of velocity, acceleration and jerk in the differences of positions."""
    return [float((metrics.largest(metrics.derivative(q, dt, k + 1)) / limits[k]).max()) for k in range(3)]


def commanded_shares(command, dt, limits, tip):
    """Returns the largest shares in what was commanded: velocities, accelerations, and their differences.

    The limits of a tip are those of lengths, of translation and of rotation.
    """

    def share(rows, limit):
        if not tip:
            return float((metrics.largest(rows) / limit).max())
        return float((np.linalg.norm(rows.reshape(-1, 2, 3), axis=2).max(axis=0) / limit[[0, 3]]).max())

    jerk = np.diff(command.ddq, axis=0) / dt
    return [share(rows, limit) for rows, limit in zip((command.dq, command.ddq, jerk), limits)]


def counted(made, t):
    """Returns the times at which a standstill counts: chunks have not run out, nor a moment ago."""
    margin, dt = GRACE_S, t[1] - t[0]
    gap = (~covered(made, t)).astype(float)
    width = int(round(margin / dt))
    return np.convolve(gap, np.ones(2 * width + 1), "same") < 0.5


def smoothness(q, dt, scenario):
    """Returns the medians of SPARC and LDLJ over all reaches of the first axis."""
    if scenario.motion != "reaches":
        return {}
    speed = np.abs(metrics.derivative(q[:, :1], dt, 1)[:, 0])
    spans = [slice(int(a / dt), int(b / dt)) for a, b in reach_spans(scenario.duration_s) if a > SETTLED_S]
    return {
        "sparc": float(np.median([metrics.sparc(speed[span], dt) for span in spans])),
        "ldlj": float(np.median([metrics.ldlj(speed[span], dt) for span in spans])),
    }


@dataclasses.dataclass
class Run:
    """What an executor commanded, beside what was intended; relative to home, one row per cycle."""

    t: np.ndarray
    dt: float
    q: np.ndarray
    intent: np.ndarray
    made: list
    command: Command | None  # of a replay


def scenario_of(case):
    scenario = SCENARIOS[case.scenario]
    return dataclasses.replace(scenario, duration_s=case.duration_s or scenario.duration_s)


def chunks_of(case, robot):
    """Returns the chunks that the case executes."""
    scenario = scenario_of(case)
    made = chunks(scenario, robot.intent(scenario, case.space), case.seed, robot.units(case.space))
    weights = CONDITIONED.get(case.executor)
    return list(real_time_chunking.conditioned(made, scenario.rate_hz, weights)) if weights else made


def chunk_file(case, folder):
    """Returns the file of its chunks."""
    whose = f"-{case.executor}".replace(",", "") if case.executor in CONDITIONED else ""
    name = f"{case.scenario}-{case.robot}-{case.space}{whose}.csv"
    return pathlib.Path(folder) / name.replace(" ", "-").replace("%", "percent")


def execute(case, robot, folder):
    """Executes the case; the files of chunks are in the folder."""
    scenario, made = scenario_of(case), chunks_of(case, robot)
    replayed = case.executor in REPLAYED
    dt = case.period_us * 1e-6 if replayed else BASELINE_DT
    t = np.arange(int(round(scenario.duration_s / dt))) * dt
    intent, command = robot.intent(scenario, case.space).at(t), None
    if replayed:
        mode, *settings = REPLAYED[case.executor]
        rows = chunk_file(case, folder)
        command = robot.replay(mode or case.space, rows, case.space, case.period_us, scenario.duration_s, settings)
        q = command.q
    elif case.executor == INTENT:
        q = intent
    else:
        q = EXECUTORS[case.executor](made, t, made[0].q[0], scenario.rate_hz)
    return Run(t, dt, q, intent, made, command)


def measure(case, robot, folder):
    """Returns what the case measures, as a dictionary of numbers; steps are those of 1 ms."""
    scenario, run, limits = scenario_of(case), execute(case, robot, folder), robot.limits(case.space)
    t, dt, command = run.t, run.dt, run.command
    settled = slice(0 if scenario.first_s else int(round(SETTLED_S / dt)), None)
    u, r, counts = run.q[settled], run.intent[settled], counted(run.made, t)[settled]
    delays, remains = metrics.delay(u, r, dt)
    result = dict(
        dataclasses.asdict(case),
        agrees=scenario.agrees(),
        chunks=len(run.made),
        step_mrad_ms=float(metrics.largest(metrics.derivative(u, dt, 1)).max()),
        jerk_rms=float(metrics.rms(metrics.derivative(u, dt, 3)).max()),
        standstills=float(metrics.standstills(u, r, dt, counts)),
        axis_rests=float(metrics.axis_rests(u, r, dt, counts).max()),
        delay_ms=1e3 * float(delays[np.argmax(np.abs(delays))]),
        residual_mrad=1e3 * float(remains.max()),
        uncovered=float(1.0 - covered(run.made, t)[settled].mean()),
        **smoothness(run.q, dt, scenario),
    )
    tip = case.space == "task"
    # Limits of a tip are those of lengths: differences of its rotation vector are no angular accelerations.
    result["differences"] = [float("nan")] * 3 if tip else shares(u, dt, limits)
    result["shares"] = result["differences"]
    if command is not None:
        result["shares"] = commanded_shares(command, dt, limits, tip)
        result.update(counts=command.counts)
    if scenario.switch_s:
        before = robot.intent(scenario, case.space).at(t, known_s=0.0)
        result["reaction_ms"] = 1e3 * float(metrics.reaction(run.q, before, run.intent, t, scenario.switch_s).max())
    return result
