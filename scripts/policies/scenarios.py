"""The scenarios of the benchmark: how a policy makes its chunks, and what the way to the robot does to them.

A chunk is made from an observation at t_obs and arrives a lognormal latency later. Its points are the intent at
t_obs + step / rate, and disagree with the other chunks as a policy's do:

  offset    one number per chunk and axis, N(0, offset)
  slope     the same times the time since the observation, in 1/s
  lag       the policy sees an arm that is `lag` behind its command, and plans from there: the point begins at the
            intent of t_obs - lag, and the difference fades with exp(-t / 0.5 s)
  noise     N(0, noise) for each point

Every cause of randomness has its own stream of numbers, so that scenarios differ only in what they name.
"""

import dataclasses
import zlib

import numpy as np

LAG_FADES_S = 0.5
SIGMA = 0.25  # of the logarithm of the latency
REORDERED_S = 0.4  # what a reordered chunk is late in addition
STALL_S = (0.015, 0.065)
LASTS_S = 0.15  # for which a single target is good


@dataclasses.dataclass(frozen=True)
class Scenario:
    """Times in s, angles in rad, rates in Hz, chances per chunk."""

    name: str
    motion: str = "sines"
    horizon: int = 30
    rate_hz: float = 30.0
    interval_s: float = 0.3
    latency_s: float = 0.150
    offset: float = 0.015
    slope: float = 0.0
    lag_s: float = 0.0
    noise: float = 0.001
    loss: float = 0.0
    duplicates: float = 0.0
    reordered: float = 0.0
    drift: float = 0.0  # of the policy's clock since the observation
    clock_s: float = 0.0  # error of its offset, N(0, clock_s) for each chunk
    first_s: float | None = None  # latency of the first chunk
    pause_s: float = 0.0  # added to the latency once in every ten seconds
    stalls: float = 0.0  # 15 to 65 ms are added to the latency
    switch_s: float | None = None
    scale: float = 1.0  # of the motion
    duration_s: float = 60.0

    def agrees(self):
        """True if all chunks say the same of every instant."""
        return not (self.offset or self.slope or self.lag_s or self.noise or self.drift or self.clock_s)


DISAGREE = Scenario("disagree")
AGREE = dataclasses.replace(DISAGREE, name="agree", offset=0.0, noise=0.0)
TELEOPERATION = dataclasses.replace(AGREE, name="teleop", horizon=1, latency_s=0.02, noise=0.0001, stalls=0.05)
SCENARIOS = {
    scenario.name: scenario
    for scenario in (
        DISAGREE,
        AGREE,
        dataclasses.replace(AGREE, name="agree 10 Hz", horizon=8, rate_hz=10.0, interval_s=0.2, latency_s=0.02),
        dataclasses.replace(AGREE, name="agree 15 Hz", horizon=30, rate_hz=15.0, interval_s=0.5, latency_s=0.35),
        dataclasses.replace(AGREE, name="agree 60 Hz", horizon=100, rate_hz=60.0, interval_s=0.5, latency_s=0.35),
        dataclasses.replace(AGREE, name="noise", noise=0.001),
        dataclasses.replace(DISAGREE, name="slope", slope=0.015),
        dataclasses.replace(AGREE, name="lag", lag_s=0.05),
        dataclasses.replace(DISAGREE, name="often", horizon=50, interval_s=0.1, latency_s=0.02),
        dataclasses.replace(DISAGREE, name="slow", horizon=50, interval_s=0.5, latency_s=0.35),
        dataclasses.replace(DISAGREE, name="loss 1 %", loss=0.01),
        dataclasses.replace(DISAGREE, name="loss 10 %", loss=0.1),
        dataclasses.replace(DISAGREE, name="loss 30 %", loss=0.3),
        dataclasses.replace(DISAGREE, name="disorder", duplicates=0.1, reordered=0.1),
        dataclasses.replace(DISAGREE, name="first 0.7 s", first_s=0.7),
        dataclasses.replace(DISAGREE, name="pause", pause_s=0.516),
        dataclasses.replace(AGREE, name="drift 100 ppm", drift=1e-4),
        dataclasses.replace(AGREE, name="drift 9 %", drift=0.09),
        dataclasses.replace(AGREE, name="clock 5 ms", clock_s=0.005),
        dataclasses.replace(DISAGREE, name="reaches", motion="reaches"),
        dataclasses.replace(AGREE, name="switch", switch_s=10.0, duration_s=20.0),
        dataclasses.replace(TELEOPERATION, name="teleop 20 Hz", interval_s=0.05),
        dataclasses.replace(TELEOPERATION, name="teleop 100 Hz", interval_s=0.01),
    )
}


@dataclasses.dataclass
class Chunk:
    """Times in s on the robot's clock; `q` has one row per point, at the times `t`."""

    number: int
    t_obs: float
    t_arrival: float
    t: np.ndarray
    q: np.ndarray
    gripper: np.ndarray


def gripper(t):
    """Returns the intended opening, 0 or 1: it changes every two seconds."""
    return (np.floor(t / 2.0) % 2 == 0).astype(float)


def chunks(scenario, intent, seed, units=1.0):
    """Returns the chunks of a scenario in the order of their arrival; `units` scales the disagreement of each axis."""

    def random(cause):
        return np.random.default_rng([seed, zlib.crc32(cause.encode())])

    units = np.ones(len(intent.scales)) * units
    offsets, slopes, noises = random("offset"), random("slope"), random("noise")
    latencies, losses, copies, orders = map(random, ("latency", "loss", "copies", "order"))
    clocks, stalls = random("clock"), random("stalls")
    made = []
    for number in range(int(round(scenario.duration_s / scenario.interval_s))):
        t_obs = number * scenario.interval_s
        since = np.arange(scenario.horizon) / scenario.rate_hz
        q = intent.at(t_obs + since, t_obs)
        q = q + units * scenario.offset * offsets.normal(size=len(units))
        q = q + units * scenario.slope * slopes.normal(size=len(units)) * since[:, None]
        q = q + units * scenario.noise * noises.normal(size=q.shape)
        if scenario.lag_s:
            behind = intent.at([t_obs - scenario.lag_s], t_obs) - intent.at([t_obs], t_obs)
            q = q + behind * np.exp(-since[:, None] / LAG_FADES_S)
        latency = scenario.latency_s * np.exp(SIGMA * latencies.normal())
        if number == 0 and scenario.first_s is not None:
            latency = scenario.first_s
        if scenario.pause_s and number % round(10.0 / scenario.interval_s) == round(5.0 / scenario.interval_s):
            latency += scenario.pause_s
        if stalls.uniform() < scenario.stalls:
            latency += stalls.uniform(*STALL_S)
        latency += REORDERED_S * (orders.uniform() < scenario.reordered)
        stamps = t_obs + since * (1.0 + scenario.drift) + scenario.clock_s * clocks.normal()
        lost, twice = losses.uniform() < scenario.loss, copies.uniform() < scenario.duplicates
        if lost:
            continue
        one = Chunk(number, t_obs, t_obs + latency, stamps, q, gripper(t_obs + since))
        made.append(one)
        if twice:
            made.append(dataclasses.replace(one, t_arrival=one.t_arrival + 0.05))
    return sorted(made, key=lambda chunk: (chunk.t_arrival, chunk.number))


def covered(made, t):
    """Returns for every time whether a chunk that has arrived, and that no newer one has replaced, still has points."""
    until, newest = np.full(len(t), -np.inf), -1
    for chunk in made:
        if chunk.number > newest:
            newest = chunk.number
            until[t >= chunk.t_arrival] = chunk.t[-1] if len(chunk.t) > 1 else chunk.t_arrival + LASTS_S
    return t <= until
