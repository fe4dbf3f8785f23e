"""What the worst case of a pipeline is sought among: a recorded run, hostile tapes, and those a search has found."""

import pathlib
import re

import hostile

SEEDS = 150
RUN = "run"  # the tape of the run: what is typical
CORPUS = pathlib.Path(__file__).resolve().parents[2] / "tests/wcet/corpus"
BUILD = pathlib.Path("build/wcet")
DOF = {"fer": 7, "ur10": 6}


def pipeline_text(pipeline):
    return (BUILD / f"{pipeline}.ini").read_text(encoding="utf-8")


def board_of(pipeline):
    """The board that a pipeline's images are built for."""
    return re.search(r"^name\s*=\s*(\w+)", pipeline_text(pipeline), re.MULTILINE)[1] + "_sim"


def hostile_tapes(pipeline):
    """{name: bytes} of those made by hand and by seed."""
    dof = DOF[board_of(pipeline).removesuffix("_sim")]
    tapes = {f"hand-{i}": tape.data for i, tape in enumerate(hostile.by_hand(dof))}
    tapes |= {f"seed-{seed}": hostile.at_random(dof, seed).data for seed in range(SEEDS)}
    return tapes


def found_tapes(pipeline):
    """{name: bytes} of those that a search has found and somebody kept."""
    return {path.stem: path.read_bytes() for path in sorted((CORPUS / pipeline).glob("*.tape"))}


def all_tapes(pipeline):
    run = {RUN: (BUILD / pipeline / "run.tape").read_bytes()}
    return run | hostile_tapes(pipeline) | found_tapes(pipeline)
