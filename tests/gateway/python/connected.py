"""The client and the stand-in for a server, connected."""

import contextlib

import stand_in
import tactus
from stand_in import Peer


@contextlib.contextmanager
def connected(peer=Peer, **settings):
    """Yields an arm and the peer that serves it."""
    with stand_in.stand_in(peer) as (address, peers), tactus.connect(address, **settings) as arm:
        yield arm, peers[0]


def sent(peer, kind):
    return [getattr(message, kind) for message in peer.taken if message.WhichOneof("request") == kind]
