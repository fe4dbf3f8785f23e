"""The code metric: lines of reference handling, shared by all laws, against lines of each law."""

import re

# A string or character literal is matched so that a // inside it is no comment.
TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/', re.DOTALL)

PAPER = {"reference": 905, "all": 1745}  # Risi et al. 2026, section on the discussion of the experiments
PAPER_TEXT = (
    "The paper takes the JointTrajectoryController of ros2_controllers, a reference generator and a PID law in one,"
    " and counts approximately 905 of its 1745 source lines (52 %) as reference handling: trajectory validation,"
    " action-server and subscriber callbacks, goal management, trajectory-point processing, real-time safe buffering."
)
OUR_TEXT = (
    "Ours counts lines of code, without comments and blank lines: kernel/reference once, shared by all laws, and each"
    " law of kernel/control by itself, none of which handles a reference. 'of both' is the part that reference handling"
    " would have of a controller that joined it with this one law. Buffering and the client's side are not in it; they"
    " are listed as 'beside it'. The two metrics do not count the same features: ours also holds orientation, limits"
    " judged at extrema, replacement, pause and override."
)


def code_lines(text):
    """How many lines of C++ hold more than comment and white space."""
    def blank(match):
        comment = match[0].startswith("/")
        return "\n" * match[0].count("\n") if comment else "x"

    return sum(bool(line.strip()) for line in TOKEN.sub(blank, text).splitlines())


def lines_of(paths):
    return sum(code_lines(path.read_text(encoding="utf-8")) for path in paths)


def sources(folder):
    return sorted([*folder.glob("*.hpp"), *folder.glob("*.cpp")])


def count(root):
    """Lines by part of the tree below `root`: reference, laws by name, and what stands beside it."""
    laws = {}
    for path in sources(root / "kernel" / "control"):
        laws[path.stem] = laws.get(path.stem, 0) + lines_of([path])
    return {
        "reference": lines_of(sources(root / "kernel" / "reference")),
        "laws": laws,
        "beside": {
            "kernel/mailbox.hpp": lines_of([root / "kernel" / "mailbox.hpp"]),
            "gateway": lines_of(sources(root / "gateway")),
        },
    }


def rows(metric):
    """The table: what, lines of reference handling, lines of the law, part of both."""
    reference, table = metric["reference"], []
    for name, law in metric["laws"].items():
        table.append((f"kernel/control/{name}", reference, law, f"{100 * reference / (reference + law):.0f} %"))
    alone, all_laws = len(metric["laws"]) * reference, sum(metric["laws"].values())
    part = f"{100 * alone / (alone + all_laws):.0f} %"
    table.append((f"all {len(metric['laws'])}, each with its own", alone, all_laws, part))
    part = f"{100 * reference / (reference + all_laws):.0f} %"
    table.append((f"all {len(metric['laws'])}, sharing one: as it is", reference, all_laws, part))
    for name, lines in metric["beside"].items():
        table.append((f"beside it: {name}", lines, "", ""))
    law = PAPER["all"] - PAPER["reference"]
    part = f"{100 * PAPER['reference'] / PAPER['all']:.0f} %"
    table.append(("the paper: JointTrajectoryController", PAPER["reference"], law, part))
    return table


HEADERS = ("", "reference handling", "law", "of both")
