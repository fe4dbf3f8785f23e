"""Facts from a pipeline file about its cycle: the blocks that step in it, and their names."""

import pathlib
import re

from wcet.bound.image import ROOT, Unbounded
from wcet.kinds import kinds

POSITIONS = 10  # that a collision check looks at: kCheckedPositions


def sections(path):
    """Returns [(name, {key: value})] of the file, in order."""
    found = []
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        line = line.split("#")[0].strip()
        if match := re.fullmatch(r"\[(\w+)\]", line):
            found.append((match[1], {}))
        elif found and (match := re.fullmatch(r"(\w+)\s*=\s*(.*)", line)):
            found[-1][1][match[1]] = match[2]
    return found


def blocks(path):
    """Returns (section, class) of every block of the file, in order."""
    table = kinds()
    typed = [(name, keys["type"]) for name, keys in sections(path) if "type" in keys]
    for name, word in typed:
        if word not in table:
            raise Unbounded(f"{path}: [{name}]: unknown type '{word}'")
    return [(name, table[word]) for name, word in typed]


def tell(facts, path):
    """Adds the facts of the file: the number of blocks, in total and of each kind, and the paths that its settings, which
    no cycle changes, rule out."""
    steps, keys = blocks(path), dict(sections(path))
    facts.add("loop", r"Pipeline::(step|brake)\(", r"i < count_", str(len(steps)))
    facts.add("loop", r"Executive::", r"i < pipeline_\.schedule\.count\(\)", str(1 + ("collision" in keys)))
    tell_collision(facts, path)
    for kind in kinds().values():
        count = sum(kind == step for _, step in steps)
        facts.add("calls", r"Pipeline::step\(", rf"step_block<tactus::{kind}>", str(count))
        space = kind.removesuffix("ReferenceGenerator") + "Space"
        if kind.endswith("ReferenceGenerator"):
            facts.add("calls", r"Pipeline::brake\(", rf"ReferenceGenerator<tactus::{space}>::brake\(", str(count))
    for command, limiter in (("q_c", "PositionLimiter"), ("dq_c", "VelocityLimiter")):
        if command not in keys.get("robot", {}):  # the guard limits only this kind of command
            facts.add("calls", r"tactus::Guard::", rf"{limiter}::(next|brake|follows)\(", "0")
    modes = [section.get("online", "limit") for section in keys.values() if "reference_generator" in section.get("type", "")]
    if "limit" not in modes:  # points are not shaped
        facts.add("calls", r"ReferenceGenerator<.*>::(take_requests|take_point)\(", r"Motion<.*>::reach\(", "0")
        facts.add("calls", r"Motion<.*>::", r"PointStream<.*>::target\(", "0")  # to which only reach() adds
        facts.add("calls", r"Motion<.*>::move_on\(", r"Motion<.*>::can_leave\(", "0")  # what only reach() makes it ask
    if "JointReferenceGenerator" not in [kind for _, kind in steps]:  # an offset of the tip has no position limits
        facts.add("loop", r"tactus::plan_inside\(", r"i < kHalvings", "0")


def robot(path):
    """The name of the robot that the file is for."""
    return dict(sections(path))["robot"]["name"]


def robot_table(robot):
    """Returns of a robot's table: the link of every capsule; the names of the links; pairs of links that always touch, and of
    capsules that never do. The tool comes after the last link."""
    text = (ROOT / "kernel/robots" / f"{robot}_capsules.hpp").read_text(encoding="utf-8")
    links = [int(link) for link in re.findall(r"^\s*\{(\d+),\s*\{", text, re.MULTILINE)]
    names = re.findall(r'"(\w+)"', re.search(r"kLinkNames = \{(.*?)\}", text, re.DOTALL)[1])
    pairs = lambda name: {
        (int(first), int(second))
        for first, second in re.findall(r"\{(\d+), (\d+)\}", re.search(rf"{name} = (.*?);", text, re.DOTALL)[1])
    }
    return [*links, max(links) + 1], [*names, "tool"], pairs("kTouching"), pairs("kNever")


def tell_collision(facts, path):
    """Adds the number of shapes, pairs and positions that a cycle checks for collisions."""
    keys, boxes = dict(sections(path)), [name for name, word in blocks(path) if word == "BoxObstacle"]
    links, names, touching, never = robot_table(robot(path))
    settings = keys.get("collision", {})
    allowed = {frozenset(pair.split()) for pair in settings.get("allow", "").split(",")}
    checked = lambda first, second: frozenset((first, second)) not in allowed
    pairs = sum(
        second - first >= 2 and (first, second) not in touching and (j, i) not in never and checked(names[first], names[second])
        for i, second in enumerate(links) for j, first in enumerate(links[:i])
    )  # fmt: skip
    box_pairs = sum(link > 0 and checked(names[link], box) for link in links for box in boxes)
    text = (ROOT / "kernel/guard/collision_section.hpp").read_text(encoding="utf-8")
    cycles = int(settings.get("cycles", re.search(r"cycles = (\d+);", text)[1]))
    facts.add("loop", r"Collision::", r"bodies_\.size\(\)", str(len(links)))
    facts.add("calls", r"Collision::(step|advance)", r"Collision::look_(now|ahead)", str(POSITIONS // cycles))
    facts.add("calls", r"Collision::look_", r"Collision::place", "1")
    facts.add("calls", r"Collision::look_", r"separation\(.*Capsule const&\)", str(pairs))
    facts.add("calls", r"Collision::look_", r"separation\(.*BoxShape", str(box_pairs))
    facts.add("loop", r"Collision::", r"i < (pair|due)_count_", str(pairs + box_pairs))


def stages(analysis, steps):
    """Returns the bounds of all stages: each block, the guard's check and limit, the cycle without rows, the row that
    checks collisions, and the whole."""
    def largest(pattern, without=None):
        found = analysis.image.matching(pattern)
        if not found:
            raise Unbounded(f"{analysis.image.path}: no function matches {pattern}")
        return max(analysis.bound(f, without=without) for f in found)

    found = {section: largest(rf"step_block<tactus::{kind}>") for section, kind in steps}
    found["read"] = largest(r"^tactus::Guard::check\(")
    found["guard"] = largest(r"^tactus::Guard::limit\(")
    cycle, row = r"^tactus::Executive::cycle\(", r"::check_collision\("
    found["cycle"] = largest(cycle, row)
    found["collision"] = largest(row)
    found["with rows"] = largest(cycle)
    return found
