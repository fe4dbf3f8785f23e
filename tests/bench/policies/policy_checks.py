#!/usr/bin/python3
"""policy_checks.py NAME: checks one part of scripts/policies against values that are known without it."""

import dataclasses
import pathlib
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "scripts/policies"))

import bounds  # noqa: E402
import chunk_files  # noqa: E402
import metrics  # noqa: E402
import real_time_chunking as rtc  # noqa: E402
from executors import EXECUTORS  # noqa: E402
from scenarios import SCENARIOS, Chunk, chunks, covered  # noqa: E402
from signals import Intent  # noqa: E402

DT = 1e-3
T = np.arange(0.0, 20.0, DT)[:, None]


def near(value, expected, tolerance):
    assert abs(value - expected) <= tolerance, f"{value} is not {expected} within {tolerance}"


def smoothness():
    """The pulse of the authors' own example, and a minimum-jerk movement, whose integral is 720."""
    pulse = np.exp(-5.0 * np.arange(-1.0, 1.0, 0.01) ** 2)
    near(metrics.sparc(pulse, 0.01), -1.41403, 1e-5)
    near(metrics.ldlj(pulse, 0.01), -5.81636, 1e-5)
    u = np.linspace(0.0, 1.0, 2001)
    near(metrics.ldlj(30.0 * (u**2 - 2.0 * u**3 + u**4), u[1]), -np.log(720.0 / 1.875**2), 2e-3)
    twice = 1.0 + np.sin(2.0 * np.pi * 4.0 * u)  # four movements are less smooth than one
    assert metrics.sparc(twice, u[1]) < -2.0


def derivatives():
    """A sine of 0.3 rad and 1.5 Hz: its jerk is A w^3, a steady motion is none."""
    w = 2.0 * np.pi * 1.5
    sine = np.hstack([0.3 * np.sin(w * T), 0.5 * T])
    near(metrics.rms(metrics.derivative(sine, DT, 3))[0], 0.3 * w**3 / np.sqrt(2.0), 0.05)
    near(metrics.largest(metrics.derivative(sine, DT, 2))[0], 0.3 * w**2, 0.001)
    assert np.allclose(metrics.largest(metrics.derivative(sine, DT, 1)), [0.3 * w, 0.5], atol=1e-3)
    near(metrics.rms(metrics.derivative(sine, DT, 3))[1], 0.0, 1e-4)


def standstills():
    """Ten rests of 10 ms and five of 6 ms, which are too short; the other axis rests in three of them."""
    v = np.full((len(T), 2), 0.5)
    for k in range(15):
        begin = 1000 * (k + 1)
        v[begin : begin + (10 if k < 10 else 6), : 2 if k < 3 else 1] = 0.0
    u, reference = np.cumsum(v, axis=0) * DT, np.hstack([0.5 * T, 0.5 * T])
    always = np.ones(len(T), bool)
    assert np.allclose(metrics.axis_rests(u, reference, DT, always) * 20.0, [10.0, 3.0], atol=0.01)
    near(metrics.standstills(u, reference, DT, always) * 20.0, 3.0, 0.01)
    near(metrics.standstills(u, reference, DT, ~always), 0.0, 0.0)
    near(metrics.standstills(u, 0.1 * reference, DT, always), 0.0, 0.0)


def delay():
    """A sine that comes 12.3 ms late, one that comes early, and one with an error of its own."""

    def motion(t):
        return 0.5 * np.sin(3.0 * t) + 0.1 * np.sin(8.0 * t)

    other = 0.02 * np.sqrt(2.0) * np.sin(40.0 * T)
    u = np.hstack([motion(T - 0.0123), motion(T + 0.004), motion(T) + other])
    delays, remains = metrics.delay(u, np.hstack([motion(T)] * 3), DT)
    assert np.allclose(delays, [0.0123, -0.004, 0.0], atol=2e-4), delays
    assert np.allclose(remains, [0.0, 0.0, 0.02], atol=3e-4), remains


def scenarios():
    """The same seed gives the same chunks; what a scenario does not name stays as it is without it."""
    intent = Intent("sines", [1.0, 0.5])
    whole, lossy = SCENARIOS["disagree"], SCENARIOS["loss 30 %"]
    first, again, other = (chunks(whole, intent, seed) for seed in (7, 7, 8))
    assert all(np.array_equal(a.q, b.q) and a.t_arrival == b.t_arrival for a, b in zip(first, again))
    assert not np.array_equal(first[0].q, other[0].q)
    kept = {chunk.number: chunk for chunk in chunks(lossy, intent, 7)}
    assert 0.6 < len(kept) / len(first) < 0.8
    assert all(np.array_equal(chunk.q, kept[chunk.number].q) for chunk in first if chunk.number in kept)
    offsets = np.array([(chunk.q - intent.at(chunk.t)).mean(axis=0) for chunk in first])
    assert 0.013 < offsets.std() < 0.017, offsets.std()
    late = np.median([chunk.t_arrival - chunk.t_obs for chunk in first])
    assert 0.14 < late < 0.16, late
    for name in ("agree", "agree 60 Hz", "switch"):
        chunk = chunks(SCENARIOS[name], intent, 1)[3]
        assert np.array_equal(chunk.q, intent.at(chunk.t)), name
    mind = Intent("sines", [1.0], switch_s=10.0)
    near(float((mind.at([12.0]) - mind.at([12.0], known_s=9.0))[0, 0]), 0.2, 1e-12)


def files():
    """A file holds chunks to the last bit of their positions, and the nanosecond of their times."""
    made = chunks(dataclasses.replace(SCENARIOS["disorder"], duration_s=6.0), Intent("sines", [1.0, 1 / 3]), 1)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "chunks.csv"
        chunk_files.write(path, made, ["q1_rad", "q2_rad"])
        read = chunk_files.read(path)
    assert [chunk.number for chunk in read] == [chunk.number for chunk in made]
    for a, b in zip(made, read):
        assert np.array_equal(a.q, b.q) and np.array_equal(a.gripper, b.gripper)
        assert abs(a.t_arrival - b.t_arrival) < 1e-9 and np.allclose(a.t, b.t, atol=1e-9)


def coverage():
    """Chunks run out from 1 s to 2 s, and from 3.5 s on; an old one that comes late does not count."""

    def chunk(number, arrival, begin, end):
        return Chunk(number, begin, arrival, np.array([begin, end]), np.zeros((2, 1)), np.zeros(2))

    made = [chunk(1, 0.1, 0.0, 1.0), chunk(2, 2.0, 1.9, 3.5), chunk(0, 2.5, 2.0, 9.0)]
    t = np.array([0.05, 0.5, 1.5, 2.5, 3.4, 3.6])
    assert covered(made, t).tolist() == [False, True, False, True, True, False]


def executors():
    """A steady motion without disagreement: the delay of every executor can be told beforehand."""
    period = 1.0 / 30.0
    scenario = dataclasses.replace(SCENARIOS["agree"], duration_s=10.0)
    intent = Intent("sines", [1.0])
    intent.motion = lambda t: 0.5 * t
    made, t = chunks(scenario, intent, 1), np.arange(0.0, 10.0, DT)
    expected = {
        "queue, held": period / 2.0,
        "queue, linear": period,
        "0.3/0.7, linear": period,
        "ACT ensemble": period,
        "RTC, held": period / 2.0,
        "linear splice": 0.0,
        "cubic from p and v": 0.0,
        "cubic, crossfade": 0.0,
    }
    for name, delayed in expected.items():
        behind = (intent.at(t) - EXECUTORS[name](made, t, made[0].q[0], 30.0))[5000:, 0] / 0.5
        near(behind.mean(), delayed, 0.001)
    slowest = {name: np.diff(EXECUTORS[name](made, t, made[0].q[0], 30.0)[5000:, 0]).min() / DT for name in expected}
    assert slowest["cubic from p and v"] > 0.49 and slowest["cubic, crossfade"] > 0.49, slowest
    assert slowest["queue, held"] == 0.0
    behind = (intent.at(t) - EXECUTORS["cubic from measured"](made, t, made[0].q[0], 30.0))[5000:, 0] / 0.5
    assert behind.max() > 0.04, "the plant lags by 50 ms"


def real_time_chunks():
    """Chunks that agree stay as they are; the others keep the targets of the delay, and leave the rest as told."""
    agreeing = chunks(dataclasses.replace(SCENARIOS["agree"], duration_s=10.0), Intent("sines", [1.0, 0.5]), 1)
    for weights in (rtc.lerobot, rtc.published):
        for chunk, made in zip(agreeing, rtc.conditioned(agreeing, 30.0, weights)):
            assert np.allclose(made.q, chunk.q, rtol=0.0, atol=1e-12) and np.array_equal(made.t, chunk.t)

    def chunk(number, observed, latency, value):
        t = observed + np.arange(21) / 10.0
        return Chunk(number, observed, observed + latency, t, np.full((21, 1), value), np.zeros(21))

    # The first inference does not count, the second takes 3 steps; the fourth chunk comes when targets have run out.
    four = [chunk(0, 0.0, 0.45, 0.0), chunk(1, 0.5, 0.25, 0.0), chunk(2, 1.0, 0.15, 1.0), chunk(3, 4.0, 0.25, 2.0)]
    for queued in (False, True):
        *_, third, fourth = rtc.conditioned(four, 10.0, rtc.lerobot, queued)
        assert np.array_equal(third.q[:3], np.zeros((3, 1))) and np.array_equal(third.q[10:], np.ones((11, 1)))
        assert np.allclose(third.q[3:10, 0], np.arange(1, 8) / 8.0)
        assert np.array_equal(fourth.q, four[3].q)
        near(fourth.t[0], 4.3 if queued else 4.0, 1e-12)
    *_, third, _ = rtc.conditioned(four, 10.0, rtc.published)
    assert np.array_equal(third.q[:3], np.zeros((3, 1))) and np.array_equal(third.q[16:], np.ones((5, 1)))
    near(1.0 - third.q[9, 0], 0.5 / (np.sqrt(np.e) + 1.0), 1e-12)  # half of the way, of which 16 targets are left


def verdicts():
    """A result beyond a bound is named, one that is not a number too, and none that is not ours."""
    row = {"executor": "ours", "scenario": "disagree", "robot": "fer", "space": "joint", "period_us": 1000, "seed": 1}
    row.update(shares=[1.0, 1.0, 1.0], differences=[1.0, 1.0, 1.0], standstills=0.0, delay_ms=0.0, agrees=False)
    row.update(jerk_rms=100.0, step_mrad_ms=1.0)

    def beyond(**changes):
        return [name for name, *_, rows in bounds.judge([{**row, **changes}]) if rows]

    assert beyond() == []
    assert len(beyond(shares=[1.1, 1.1, 1.1])) == 3
    assert len(beyond(jerk_rms=float("nan"), standstills=0.1)) == 2
    assert len(beyond(scenario="agree", agrees=True, delay_ms=-1.1)) == 1
    assert len(beyond(scenario="loss 30 %", step_mrad_ms=2.3)) == 1
    assert beyond(executor="queue, held", jerk_rms=1e7) == []


if __name__ == "__main__":
    globals()[sys.argv[1]]()
