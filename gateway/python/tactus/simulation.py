"""Simulated robots of this computer."""

import contextlib
import pathlib
import subprocess
import tempfile
import time
from typing import Any, Iterator, Sequence

from .arguments import Path
from .arm import Arm, connect
from .errors import Error, Lost


@contextlib.contextmanager
def serve(pipeline: Path, *, program: Path | None = None, options: Sequence[str] = ()) -> Iterator[str]:
    """Runs a server with a simulated robot on a private socket, and yields its address. The server ends with the block.

    The robot moves at the pace of the wall clock; on a busy machine it waits instead of being braked for late cycles.

    pipeline -- a pipeline file
    program  -- a program of a simulated board; None: build/<robot>_sim/tactus beside the folder of the pipeline file
    options  -- further options of `tactus serve`
    """
    file = pathlib.Path(pipeline).resolve()
    program = _program_for(file) if program is None else pathlib.Path(program).resolve()
    with (
        tempfile.TemporaryDirectory(prefix="tactus-", ignore_cleanup_errors=True) as folder,
        open(f"{folder}/log", "w+", encoding="utf-8", errors="replace") as log,  # not a pipe, which would fill
    ):
        address = f"unix:{folder}/socket"
        command: list[Path] = [program, "serve", file, "--virtual-time", "--listen", address, *options]
        try:
            server = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        except OSError as error:
            raise ValueError(f"program {program}: {error.strerror}") from error
        try:
            await_server(server, address, log)
            yield address
        finally:
            server.terminate()
            try:
                server.wait(10)
            except subprocess.TimeoutExpired:
                server.kill()
                server.wait()


@contextlib.contextmanager
def sim(pipeline: Path, **settings: Any) -> Iterator[Arm]:
    """Runs a simulated robot for the `with` block and yields its Arm; takes what `serve` takes."""
    with serve(pipeline, **settings) as address, connect(address) as arm:
        yield arm


def _program_for(pipeline: pathlib.Path) -> pathlib.Path:
    """Returns the program of the simulated board for the robot that a pipeline file names."""
    try:
        lines = pipeline.read_text(encoding="utf-8", errors="replace").partition("[robot]")[2].splitlines()
    except OSError as error:
        raise ValueError(f"pipeline {pipeline}: {error.strerror}") from error
    robot = next(
        (line.partition("=")[2].split("#")[0].strip() for line in lines if line.split("=")[0].strip() == "name"), ""
    )
    tried = [folder / f"build/{robot}_sim/tactus" for folder in pipeline.parents]
    found = next((program for program in tried if robot and program.exists()), None)
    if found is None:
        raise Error(f"{pipeline}: no build/{robot}_sim/tactus above it; run `make BOARD={robot}_sim`, or give program=")
    return found


def await_server(server: subprocess.Popen[bytes], address: str, log: Any, key: Path | None = None) -> None:
    """Waits until the server takes clients and its arm is armed."""
    end = time.monotonic() + 20.0
    while server.poll() is None and time.monotonic() < end:
        with contextlib.suppress(Lost), connect(address, key=key) as arm:
            arm._await_nominal(20.0)
            return
        time.sleep(0.01)
    log.seek(0)
    raise Lost(f"the simulated robot did not start: {log.read().strip() or 'it says nothing'}")
