"""The estimate of the server's clock, against clocks whose readings are known."""

import unittest

import numpy as np
from tactus.clock import Clock

OFFSET_NS = 86_400_000_000_000


def estimate(drift, one_way_ns, stalls=0.0, seconds=30, seed=1):
    """Returns the error of the estimate at the end of an exchange every 100 ms, and its own bound. [ns]"""
    rng = np.random.default_rng(seed)
    clock = Clock()

    def server(local):
        return int(local + OFFSET_NS + drift * local)

    local = 0
    for _ in range(seconds * 10):
        local += 100_000_000
        there, back = rng.lognormal(np.log(one_way_ns), 0.5, 2) + (rng.random(2) < stalls) * 40e6
        came = local + int(there)
        left = came + 50_000
        clock.add(local, server(came), server(left), left + int(back))
    return clock.to_server(local) - server(local), clock


class Clocks(unittest.TestCase):
    def test_an_offset_is_found_within_the_shortest_round_trip(self):
        error, clock = estimate(0, 100_000)
        self.assertLess(abs(error), 50_000)
        self.assertLess(clock.uncertainty_ns, 100_000)

    def test_drift_is_followed(self):
        for drift in (1e-4, -1e-4, 0.09):
            with self.subTest(drift):
                error, _ = estimate(drift, 100_000)
                self.assertLess(abs(error), 100_000)

    def test_stalls_of_40_ms_count_little(self):
        error, _ = estimate(1e-4, 200_000, stalls=0.3)
        self.assertLess(abs(error), 200_000)

    def test_many_exchanges_do_not_shorten_the_memory(self):
        clock = Clock()
        for local in range(0, 10_000_000_000, 1_000_000):  # 1 kHz, as of a stream
            clock.add(local, local + OFFSET_NS, local + OFFSET_NS, local + 200_000)
        self.assertGreater(clock._kept[-1][0] - clock._kept[0][0], 9_000_000_000)

    def test_there_and_back_is_the_same(self):
        _, clock = estimate(0.09, 100_000)
        for local in (0, 30_000_000_000, 60_000_000_000):
            self.assertLess(abs(clock.to_local(clock.to_server(local)) - local), 100)


if __name__ == "__main__":
    unittest.main()
