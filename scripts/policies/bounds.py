"""What is expected of our executor: a bound, the results it applies to, and what it bounds."""

import dataclasses
import typing

OVER = 1e-6  # of a limit, for rounding
# Within a cycle in which limits shape the motion, positions take a little more than is commanded at its ends.
AVERAGED = 1.05
JERK_RMS = 730.0  # rad/s3, of the best simple executor known
STEP = 2.2  # mrad/ms


@dataclasses.dataclass(frozen=True)
class Bound:
    name: str
    applies: typing.Callable
    value: typing.Callable
    limit: typing.Callable


BOUNDS = (
    Bound("velocity, share of its limit", lambda row: True, lambda row: row["shares"][0], lambda row: 1.0 + OVER),
    Bound("acceleration, share of its limit", lambda row: True, lambda row: row["shares"][1], lambda row: 1.0 + OVER),
    Bound("jerk, share of its limit", lambda row: True, lambda row: row["shares"][2], lambda row: 1.0 + OVER),
    Bound(
        "acceleration and jerk in differences of positions, share",
        lambda row: row["space"] == "joint",
        lambda row: max(row["differences"][1:]),
        lambda row: AVERAGED,
    ),
    Bound("standstills while chunks come, 1/s", lambda row: True, lambda row: row["standstills"], lambda row: 0.0),
    Bound(
        "delay on chunks that agree, ms",
        lambda row: row["agrees"] and row["scenario"].startswith("agree"),
        lambda row: abs(row["delay_ms"]),
        lambda row: row["period_us"] * 1e-3,
    ),
    Bound(
        "rms jerk at 15 mrad of disagreement, rad/s3",
        lambda row: row["scenario"] == "disagree",
        lambda row: row["jerk_rms"],
        lambda row: JERK_RMS,
    ),
    Bound(
        "largest step with 30 % of chunks lost, mrad/ms",
        lambda row: row["scenario"] == "loss 30 %",
        lambda row: row["step_mrad_ms"],
        lambda row: STEP,
    ),
)


def place(row):
    """Returns scenario, robot, space and period of a row in words."""
    return f"{row['scenario']}, {row['robot']} {row['space']}, {row['period_us'] / 1000:g} ms, seed {row['seed']}"


def judge(rows):
    """Returns, for every bound, its name, the worst row, its value, the limit, and all rows beyond; of ours."""
    ours = [row for row in rows if row["executor"] == "ours"]
    verdicts = []
    for bound in BOUNDS:
        concerned = [row for row in ours if bound.applies(row)]
        if not concerned:
            continue
        worst = max(concerned, key=lambda row: bound.value(row) - bound.limit(row))
        # NaN is beyond every bound.
        beyond = [(row, bound.value(row)) for row in concerned if not bound.value(row) <= bound.limit(row)]
        verdicts.append((bound.name, worst, bound.value(worst), bound.limit(worst), beyond))
    return verdicts
