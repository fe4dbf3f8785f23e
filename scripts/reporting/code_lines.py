"""The code metric compares the lines of reference handling, shared by all laws, with the lines of each law."""

import re

# Literals are matched so that a // inside them does not count as a comment.
TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/', re.DOTALL)

PAPER = {"reference": 905, "all": 1745}  # Risi et al. 2026, section on the discussion of the experiments
PAPER_TEXT = (
    "The paper takes the JointTrajectoryController of ros2_controllers, which joins a reference generator and a PID law,"
    " and counts approximately 905 of its 1745 source lines (52 %) as reference handling: trajectory validation,"
    " action-server and subscriber callbacks, goal management, trajectory-point processing, real-time safe buffering."
)
OUR_TEXT = (
    "This metric counts lines of code without comments and blank lines: kernel/reference once, shared by all laws, and"
    " each law of kernel/control by itself; no law handles references. 'of both' is the share that reference handling"
    " would have in a controller that joined it with this one law. Buffering and the client's side are not included;"
    " they are listed as 'in addition'. The two metrics do not count the same features: this one also includes"
    " orientation, limits judged at extrema, replacement, pause and override."
)


def code_lines(text):
    """Counts the lines of C++ that hold more than comments and white space."""
    def blank(match):
        comment = match[0].startswith("/")
        return "\n" * match[0].count("\n") if comment else "x"

    return sum(bool(line.strip()) for line in TOKEN.sub(blank, text).splitlines())


def lines_of(paths):
    return sum(code_lines(path.read_text(encoding="utf-8")) for path in paths)


def sources(folder):
    return sorted([*folder.rglob("*.hpp"), *folder.rglob("*.cpp")])


def count(root):
    """Counts the lines below `root`: of reference handling, of each law, and of the parts listed in addition."""
    laws = {}
    for path in sources(root / "kernel" / "control"):
        laws[path.stem] = laws.get(path.stem, 0) + lines_of([path])
    return {
        "reference": lines_of(sources(root / "kernel" / "reference")),
        "laws": laws,
        "beside": {
            "kernel/core/mailbox.hpp": lines_of([root / "kernel/core/mailbox.hpp"]),
            "gateway": lines_of(sources(root / "gateway")),
        },
    }


def rows(metric):
    """Returns the table: name, lines of reference handling, lines of the law, share of both."""
    reference, table = metric["reference"], []
    for name, law in metric["laws"].items():
        table.append((f"kernel/control/{name}", reference, law, f"{100 * reference / (reference + law):.0f} %"))
    alone, all_laws = len(metric["laws"]) * reference, sum(metric["laws"].values())
    part = f"{100 * alone / (alone + all_laws):.0f} %"
    table.append((f"all {len(metric['laws'])}, each with its own", alone, all_laws, part))
    part = f"{100 * reference / (reference + all_laws):.0f} %"
    table.append((f"all {len(metric['laws'])}, sharing one (actual)", reference, all_laws, part))
    for name, lines in metric["beside"].items():
        table.append((f"in addition: {name}", lines, "", ""))
    law = PAPER["all"] - PAPER["reference"]
    part = f"{100 * PAPER['reference'] / PAPER['all']:.0f} %"
    table.append(("the paper: JointTrajectoryController", PAPER["reference"], law, part))
    return table


HEADERS = ("", "reference handling", "law", "of both")
