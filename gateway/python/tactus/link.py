"""Messages over a socket, encrypted if there is a key."""

import contextlib
import ctypes
import ctypes.util
import hashlib
import os
import pathlib
import re
import secrets
import select
import socket
import stat
from typing import Iterator

import google.protobuf.message

from . import tactus_pb2 as pb
from .arguments import Path
from .errors import Error, Lost
from .protocol import LONGEST_MESSAGE

_NONE = ctypes.c_ulonglong(0)  # bytes of additional data of a record

def _split(data: bytearray, head_bytes: int) -> Iterator[bytes]:
    """Takes the records that are complete from the data; each comes behind its length, least significant byte first."""
    while len(data) >= head_bytes:
        end = head_bytes + int.from_bytes(data[:head_bytes], "little")
        if end - head_bytes > LONGEST_MESSAGE:
            raise Lost(f"a message of {end - head_bytes} bytes; this is no tactus server")
        if len(data) < end:
            return
        record = bytes(data[head_bytes:end])
        del data[:end]
        yield record


class Tunnel:
    """The client's end of an encrypted connection; gateway/sockets/tunnel.hpp describes the bytes. Needs libsodium."""

    PROTOCOL = b"tactus-1"
    ANSWER_BYTES = 32 + 24  # X25519 key of the server, header of its stream
    RECORD_BYTES = 4096  # of plain bytes, at most
    TAG_BYTES = 17  # by which a record is longer

    def __init__(self, key_file: Path):
        self._key = self._read(pathlib.Path(key_file))
        try:
            self._sodium = ctypes.CDLL(ctypes.util.find_library("sodium") or "libsodium.so.23")
        except OSError as error:
            raise Error(f"{error}; a connection with a key needs the package libsodium23") from error
        if self._sodium.sodium_init() < 0:
            raise Error("libsodium cannot be used on this machine")
        self._stream = "crypto_secretstream_xchacha20poly1305_"
        self._own, self._public = secrets.token_bytes(32), ctypes.create_string_buffer(32)
        self._sodium.crypto_scalarmult_base(self._public, self._own)
        size = self._sodium[self._stream + "statebytes"]()
        self._out, self._in = (ctypes.create_string_buffer(size) for _ in range(2))
        self._sealed = bytearray()

    @staticmethod
    def _read(file: pathlib.Path) -> bytes:
        try:
            found = file.stat()
            if not stat.S_ISREG(found.st_mode) or found.st_uid != os.geteuid() or found.st_mode & 0o077:
                raise ValueError(f"key {file}: others may read it, or it is no file: make it yours, then chmod 600")
            digits = file.read_text(encoding="ascii", errors="replace").rstrip("\r\n")
        except OSError as error:
            raise ValueError(f"key {file}: {error.strerror}; openssl rand -hex 32 makes its content") from error
        if not re.fullmatch("[0-9a-fA-F]{64}", digits):
            raise ValueError(f"key {file}: it does not hold 64 hexadecimal digits; openssl rand -hex 32 makes them")
        return bytes.fromhex(digits)

    def hello(self) -> bytes:
        return self.PROTOCOL + self._public.raw

    def answer(self, reply: bytes) -> bytes:
        """Takes the server's key and header; returns the header of the client's stream."""
        server, header, secret = reply[:32], reply[32:], ctypes.create_string_buffer(32)
        if self._sodium.crypto_scalarmult(secret, self._own, server):
            raise Lost("the server has sent a key that is none")
        shared = self.PROTOCOL + secret.raw + self._public.raw + server
        keys = hashlib.blake2b(shared, key=self._key, digest_size=64).digest()
        own_header = ctypes.create_string_buffer(24)
        self._sodium[self._stream + "init_push"](self._out, own_header, keys[:32])
        self._sodium[self._stream + "init_pull"](self._in, header, keys[32:])
        return own_header.raw

    def seal(self, plain: bytes) -> bytes:
        records = bytearray()
        for begin in range(0, len(plain), self.RECORD_BYTES):
            piece = plain[begin : begin + self.RECORD_BYTES]
            size, sealed = ctypes.c_ulonglong(len(piece)), ctypes.create_string_buffer(len(piece) + self.TAG_BYTES)
            self._sodium[self._stream + "push"](self._out, sealed, None, piece, size, None, _NONE, 0)
            records += len(sealed).to_bytes(2, "little") + sealed.raw
        return bytes(records)

    def open(self, sealed: bytes) -> bytes:
        """Returns the plain bytes of the records that are complete; keeps the rest."""
        self._sealed += sealed
        plain = bytearray()
        for record in _split(self._sealed, 2):
            size, piece = ctypes.c_ulonglong(len(record)), ctypes.create_string_buffer(len(record))
            pull = self._sodium[self._stream + "pull"]
            if len(record) < self.TAG_BYTES or pull(self._in, piece, None, None, record, size, None, _NONE):
                raise Lost("a record does not open: the server has another key, or somebody has changed it")
            plain += piece.raw[: len(record) - self.TAG_BYTES]
        return bytes(plain)


class Link:
    """Messages over a stream socket: a length of four bytes, least significant first, and the message."""

    def __init__(self, address: str, timeout_s: float, key: Path | None):
        self._bytes = bytearray()
        self._heard = False
        self._tunnel = None if key is None else Tunnel(key)
        kind, _, place = address.partition(":")
        host, _, port = place.rpartition(":")
        target: str | tuple[str, int]
        if kind == "unix" and place:
            self._socket, target = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM), place
        elif kind == "tcp" and host and re.fullmatch("[0-9]{1,5}", port) and int(port) < 65536:
            family = socket.AF_INET6 if ":" in host else socket.AF_INET
            self._socket, target = socket.socket(family, socket.SOCK_STREAM), (host.strip("[]"), int(port))
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        else:
            raise ValueError(f"address {address!r}: write unix:/path/of/the/socket or tcp:HOST:PORT; PORT to 65535")
        try:
            self._socket.settimeout(timeout_s)
            self._socket.connect(target)
            if self._tunnel:
                self._shake_hands(self._tunnel)
        except BaseException as error:
            self._socket.close()
            if isinstance(error, Lost):
                raise Lost(f"{address}: {error}; does the server have a key?") from error
            if isinstance(error, OSError):
                raise Lost(f"{address}: {error.strerror or error}; is a tactus server running there?") from error
            if isinstance(error, (TypeError, ValueError)):  # of Python: no name of a host
                raise ValueError(f"address {address!r}: {error}") from error
            raise

    def _shake_hands(self, tunnel: Tunnel) -> None:
        try:
            self._socket.sendall(tunnel.hello())
            reply = b""
            while len(reply) < tunnel.ANSWER_BYTES:
                piece = self._socket.recv(tunnel.ANSWER_BYTES - len(reply))
                if not piece:
                    raise Lost("the server has ended the connection")
                reply += piece
            self._socket.sendall(tunnel.answer(reply))
        except OSError as error:
            raise Lost(str(error)) from error

    def send(self, message: pb.ToServer) -> None:
        body = message.SerializeToString()
        if len(body) > LONGEST_MESSAGE:
            raise ValueError(f"a message of {len(body)} bytes; at most {LONGEST_MESSAGE} are taken")
        data = len(body).to_bytes(4, "little") + body
        try:
            self._socket.sendall(self._tunnel.seal(data) if self._tunnel else data)
        except OSError as error:
            if isinstance(error, TimeoutError):
                raise Lost(f"the server takes no more: {error}") from error
            raise self._ended(f": {error.strerror}") from error
        except BaseException:  # Ctrl-C, perhaps within the message: nothing can follow it
            self._socket.shutdown(socket.SHUT_RDWR)
            raise

    def _ended(self, how: str) -> Lost:
        hint = "" if self._heard else "; do both ends have the same key, or none?"
        return Lost(f"the server has ended the connection{how}{hint}")

    def can_send(self) -> bool:
        return bool(select.select([], [self._socket], [], 0)[1])

    def receive(self, wait_s: float) -> Iterator[pb.ToClient]:
        """Yields the messages that are complete after at most `wait_s`."""
        if not select.select([self._socket], [], [], max(0.0, wait_s))[0]:
            return
        try:
            piece = self._socket.recv(1 << 16)
        except OSError as error:
            raise self._ended(f": {error.strerror}") from error
        if not piece:
            raise self._ended(" within a message" if self._bytes else "")
        self._bytes += self._tunnel.open(piece) if self._tunnel else piece
        for body in _split(self._bytes, 4):
            self._heard = True
            message = pb.ToClient()
            try:
                read = message.ParseFromString(body)
            except google.protobuf.message.DecodeError:
                read = -1
            if read != len(body):
                raise Lost(f"a message of {len(body)} bytes cannot be read; this is no tactus server")
            yield message

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
