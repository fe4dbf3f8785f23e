"""The first screen of the report: how many runs were as expected, the table, and the runs as a film."""

import collections
import datetime

from reporting import animation, expected, page, table

KINDS = {
    "simulated": "of a robot arm simulated by MuJoCo",
    "emulated": "with an <em>emulated</em> robot controller, whose arm is simulated",
    "real": "with a <b>real robot</b>",
    "": "<b>unknown</b>, for which no file says whether a real robot moved",
}
ARMS = {"fer": "Franka FER", "lift6": "Lift6, of our own making", "ur10": "Universal Robots UR10"}
HEADS = ("", "run", "robot", "touched", "seen", "expected", "verdict")
LEGEND = (
    "JRG, TRG: reference generator of joints, of the task space; PDGC: PD with gravity compensation; CPC: Cartesian pose"
    " control; AC: admittance control. Seen and expected: the task's reference minus what was measured. A run in contact is judged by its mean force,"
    " not by its tracking error. The verdict's small print is when the run wrote its result. Click a"
    " picture to see the run, a name for its figures. ± is the goal tolerance of the reference generator,"
    f" {100 * expected.FORCE_SHARE:.0f} % of a force, {100 * expected.LAG_SHARE:.0f} % of a lag if that is more."
)


def provenance(sections):
    """Says what moved: how many runs are of which kind; in a skipped one nothing did."""
    sections = [section for section in sections if section.verdict != table.SKIPPED]
    counts = collections.Counter(section.kind for section in sections)
    told = [f"{count} {'run' if count == 1 else 'runs'} {KINDS[kind]}" for kind, count in counts.items()]
    told = told or ["nothing was run"]
    none = "" if counts["real"] or counts[""] else "No real robot moved: "
    names = sorted({section.summary["robot"] for section in sections if section.summary})
    arms = ", ".join(page.escape(f"{name}: {ARMS[name]}" if name in ARMS else name) for name in names)
    return f'<p class="provenance">{none}{"; ".join(told)}. <span>{arms}.</span></p>'


def made():
    """Says when the report is made, in local time."""
    return f"Made {datetime.datetime.now().astimezone():{table.MOMENT}}"


def picture(section):
    return page.image(section.picture, f"{section.name}: arm and path") if section.picture else ""


def row(section):
    """Returns a row of the table: two lines in each cell."""
    found, summary = section.judgement, section.summary
    name = f'<a href="#{page.identifier(section.name)}">{page.escape(section.name).replace("_", "_<wbr>")}</a>'
    rate = f"{summary['rate_hz']:g} Hz" if summary else ""
    kind = section.kind if section.kind == "simulated" else f"<em>{section.kind}</em>"
    manner = ", ".join(filter(None, (section.chain, rate)))
    cells = [
        f"{name}<small>{page.escape(manner)}</small>",
        f"{page.escape(summary['robot'])}<small>{kind}</small>" if summary else "",
        page.escape(section.touched),
        f"<b>{found.seen}</b><small>{page.escape(found.what)}</small>" if found else "",
        f"{found.expected}<small>{page.rich(found.short)}</small>" if found else "",
        f"{page.escape(section.verdict)}<small>{section.written}</small>",
    ]
    mark = "met" if section.met else "failed"
    text = "".join(f'<td data-head="{head}">{cell}</td>' for head, cell in zip(HEADS[1:], cells))
    start = f'<tr class="{mark}" data-run="{page.escape(section.name)}">'
    return f'{start}<td class="picture">{picture(section)}</td>{text}</tr>'


def first_screen(sections, pictures):
    head = "".join(f"<th>{cell}</th>" for cell in HEADS)
    rows = "\n".join(map(row, sections))
    well = "all" if all(section.met for section in sections) else "some"
    made_how = made() if pictures else f"{made()}, without pictures"
    return (
        f'<p class="headline {well}">{table.headline(sections)}</p>{provenance(sections)}\n'
        f'<p class="note">{made_how}</p>\n'
        f'<div class="first"><div><table class="runs"><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>'
        f'<p class="note">{LEGEND}</p></div>\n{animation.VIEWER if pictures else ""}</div>'
    )


def sheet(sections):
    """Returns the pictures of the runs, each with what was seen and expected."""
    for section in sections:
        if section.still is not None:
            found = section.judgement
            told = f"{found.seen}\nexpected {found.expected}" if found else section.verdict
            yield section.still, f"{section.name}\n{section.kind}: {told}"


def counters(sections):
    """Returns the table of the counters, which belongs to the machine and not to the control."""
    rows = [[page.escape(cell) for cell in table.counters(section)] for section in sections]
    return page.table(table.COUNTERS, rows, table.COUNTERS_TEXT) + f'<p class="note">{table.COUNTERS_LEGEND}</p>'
