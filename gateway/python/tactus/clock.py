"""The clock of the server."""

import collections

import numpy as np


class Clock:
    """Estimates the server's clock from request and answer: the offset by the shortest round trips, and its drift.

    A round trip that took `trip` ns bounds the offset to half of it. Of each tenth of a second the shortest is kept; a
    line is fitted to the offsets of the last 13 s, in which a trip counts the less the longer it took.
    """

    KEPT = 128
    BETWEEN_NS = 100_000_000
    FLOOR_NS = 20_000.0  # by which round trips vary on an idle machine

    def __init__(self) -> None:
        self._kept: collections.deque[tuple[int, int, int]] = collections.deque(maxlen=self.KEPT)  # local, offset, trip
        self._line = (0, 0.0, 0.0)  # at a local time: offset, drift
        self.uncertainty_ns = float("inf")

    def add(self, sent: int, came: int, left: int, received: int) -> None:
        """Takes one exchange: sent and received by the local clock, came and left by the server's. [ns]"""
        trip = max(0, (received - sent) - (left - came))
        if self._kept and received - self._kept[-1][0] < self.BETWEEN_NS:
            if trip >= self._kept[-1][2]:
                return
            self._kept.pop()
        self._kept.append((received, (came + left - sent - received) // 2, trip))
        self._fit()

    def _fit(self) -> None:
        last, first_offset, _ = self._kept[-1][0], *self._kept[0][1:]
        at, offsets, trips = np.array([(t - last, o - first_offset, trip) for t, o, trip in self._kept], dtype=float).T
        weights = (trips - trips.min() + self.FLOOR_NS) ** -2
        weights /= weights.sum()
        at_mean, mean = weights @ at, weights @ offsets
        drift = 0.0
        if -at[0] > 5 * self.BETWEEN_NS:
            drift = weights @ ((at - at_mean) * (offsets - mean)) / (weights @ (at - at_mean) ** 2)
        self._line = (last, first_offset + mean - drift * at_mean, float(drift))
        self.uncertainty_ns = trips.min() / 2

    def to_server(self, local_ns: int) -> int:
        at, offset, drift = self._line
        return int(local_ns + offset + drift * (local_ns - at))

    def to_local(self, server_ns: int) -> int:
        at, offset, drift = self._line
        return int(at + (server_ns - offset - at) / (1.0 + drift))
