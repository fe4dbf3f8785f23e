"""The client's end of the server's tunnel (gateway/sockets/tunnel.hpp), for tests."""

import ctypes
import hashlib
import os
import struct


class Sealed:
    """A socket through the server's tunnel (gateway/sockets/tunnel.hpp)."""

    def __init__(self, inner, key):
        sodium = ctypes.CDLL("libsodium.so.23")
        stream = "crypto_secretstream_xchacha20poly1305_"
        self.push, self.pull = getattr(sodium, stream + "push"), getattr(sodium, stream + "pull")
        size = getattr(sodium, stream + "statebytes")()
        self.to, self.of = ctypes.create_string_buffer(size), ctypes.create_string_buffer(size)
        self.inner, self.buffer = inner, b""
        own, public = os.urandom(32), ctypes.create_string_buffer(32)
        sodium.crypto_scalarmult_base(public, own)
        inner.sendall(b"tactus-1" + public.raw)
        answer = b""
        while len(answer) < 56:
            answer += inner.recv(56 - len(answer))
        secret, header = ctypes.create_string_buffer(32), ctypes.create_string_buffer(24)
        sodium.crypto_scalarmult(secret, own, answer[:32])
        known = b"tactus-1" + secret.raw + public.raw + answer[:32]
        keys = hashlib.blake2b(known, key=key, digest_size=64).digest()
        getattr(sodium, stream + "init_push")(self.to, header, keys[:32])
        getattr(sodium, stream + "init_pull")(self.of, answer[32:], keys[32:])
        inner.sendall(header.raw)

    def settimeout(self, timeout):
        self.inner.settimeout(timeout)

    def sendall(self, plain):
        sealed = ctypes.create_string_buffer(len(plain) + 17)
        self.push(self.to, sealed, None, plain, ctypes.c_ulonglong(len(plain)), None, ctypes.c_ulonglong(0), 0)
        self.inner.sendall(struct.pack("<H", len(sealed.raw)) + sealed.raw)

    def recv(self, _):
        received = self.inner.recv(65536)
        if not received:
            return b""
        self.buffer += received
        plain = b""
        while len(self.buffer) >= 2 and len(self.buffer) >= 2 + struct.unpack("<H", self.buffer[:2])[0]:
            size = struct.unpack("<H", self.buffer[:2])[0]
            opened = ctypes.create_string_buffer(size - 17)
            sealed, self.buffer = self.buffer[2 : 2 + size], self.buffer[2 + size :]
            good = self.pull(self.of, opened, None, None, sealed, ctypes.c_ulonglong(size), None, ctypes.c_ulonglong(0))
            assert good == 0, "a record of the server does not open"
            plain += opened.raw
        if not plain:
            raise TimeoutError
        return plain
