"""The section of one run in the report: result, figures, errors and times."""

import dataclasses
import datetime
import math

import numpy as np

from reporting import animation, expected, more_plots, page, panels, plots, result, runs, table, thumbnails
from reporting.inputs import InputError, shown
from reporting.screen import screen
from reporting.units import words

FILES = "log.csv, summary.json, scene.json, pipeline.ini, figure.pdf"
MANNER = "Reference (dashed) and measured (solid)"
MANNER_WITH_POINTS = "Waypoints (circles), reference (dashed) and measured (solid)"


NO_REASON = ("kOk", "kArming", "kNotStarted")
EVENTS_TIME = "in the time of the figures, which counts the cycles in which the drives followed"
ORIENTATION = "rotation vector in base axes, from the first reference to the present orientation"


TIMES = (
    "<details><summary>Execution times</summary><p>Time per stage of the cycle, on the machine that ran it, while it was"
    " also doing other work: the largest values are mostly its interruptions. In virtual time no cycle can be late.</p>"
)


@dataclasses.dataclass
class Section:
    """The part of the report on one run; `problem` is None if everything could be read and drawn."""

    name: str
    summary: dict = None
    kind: str = ""  # simulated, emulated or real; empty if unknown
    written: str = ""  # when the run wrote its summary
    chain: str = ""
    touched: str = ""
    judgement: expected.Judgement = None
    verdict: str = ""
    met: bool = False
    picture: str = ""  # SVG
    still: object = None  # the same as pixels
    animation: dict = None
    body: str = ""
    problem: str = None


def purpose(section):
    """Says what the run should show and what it showed."""
    found = section.judgement
    if found is None:
        return ""
    sign = "as expected" if found.met else "<b>not as expected</b>"
    return (
        f'<p class="verdict">{page.escape(found.what.capitalize())}: <b>{found.seen}</b>, expected {found.expected}'
        f" ({page.rich(found.why)}): {sign}. Touched: {page.escape(section.touched)}.</p>"
    )


def facts(section):
    summary, guard = section.summary, section.summary["guard"]
    return (
        f"<p>Robot {page.escape(summary['robot'])} on {page.escape(summary['board'])}, {summary['rate_hz']:g} Hz,"
        f" {summary['cycles']} cycles, seed {summary['seed']}, configuration {page.escape(summary['config_hash'])}."
        f" The guard limited {guard['limited']} cycles; {summary['slips']} periods were missed,"
        f" {summary['recorder_dropped']} rows of the log lost, {summary['heap_allocations_in_cycle']} heap allocations"
        f" made in cycles. Written {section.written}. Files: {FILES}.</p>"
    )


def events(summary):
    """Lists the changes of rung; a Status that says no more than their cause is left out. What is said of a drive is its own text."""
    said = []
    for event in summary["events"]:
        if "text" in event and event["from"] == event["to"]:
            said.append(f"{event['time_s']:.3f} s {event['text']}")
            continue
        status = "" if event["status"] in NO_REASON else f", {result.status_words(event['status'])}"
        said.append(f"{event['time_s']:.3f} s {event['from']} → {event['to']} ({event['cause']}{status})")
    return f"<p>Events, {EVENTS_TIME}: {page.escape('; '.join(said) or 'none')}.</p>"


def tracking_figures(run):
    for panel in panels.tracking_panels(run):
        predicted = None if panel.entry["quantity"] == "pose" else expected.lag(run, panel.entry)
        manner = MANNER_WITH_POINTS if panel.points else MANNER
        what = ORIENTATION if panel.what == "orientation" else panel.what
        dotted = "" if predicted is None else " (solid) and what its lag should be (dotted)"
        caption = f"{manner} {what}; below, the error {panel.entry['signal']}{dotted}."
        yield page.figure(plots.svg(3.5, plots.draw_panel, panel, predicted), caption)


def force_figures(run):
    if not panels.signals_of(run, "wrench"):
        return
    found = expected.contact(run)
    if found is None:
        caption = "Force of the environment on the tool, in base axes. Nothing is there to be touched."
        caption = caption if not expected.surroundings(run) else caption.partition(". ")[0] + "."
    else:
        caption = (
            f"Force of the environment on the tool, in base axes (requested: dashed), and along the normal of the"
            f" {found.box}, measured (grey) and expected once the tip rests on it (dotted). Shaded: where the"
            f" mean is taken. Largest, while the tip approaches: {words(found.force.max(), 'N')}."
        )
    yield page.figure(plots.svg(2.7, more_plots.draw_force, run, found), caption)


def path_figures(run):
    if panels.task_pair(run) is not None:
        caption = "Path of the tip in the plane of the two base axes along which it moves most, reference and measured."
        yield page.figure(plots.svg(3.2, more_plots.draw_path, run), caption)


def joint_figures(run):
    if "robot.q" not in run.names():
        return
    torque = more_plots.commanded_torque(run)
    if torque:
        yield page.figure(plots.svg(2.7, more_plots.draw_torque, run, torque), "Torque that the chain commands, while the drives follow.")
    caption = (
        "Measured joints as shares of their limits. Position: 0 is the middle of the range. Velocity: "
        + ("measured." if "robot.dq" in run.names() else "difference of positions.")
        + " Acceleration: difference of velocities."
    )
    yield page.figure(plots.svg(3.4, more_plots.draw_shares, run), caption)


def flag_words(run, name):
    """Says how often a flag was set."""
    is_set = run.values(name)[:, 0] != 0
    if not is_set.any():
        return f"{name} was never set"
    first = run.log["time_s"][np.argmax(is_set)]
    return f"{name} was set in {is_set.sum()} of {len(is_set)} rows ({100 * is_set.mean():.2g} %), first at {first:g} s"


def scalar_words(run, name):
    values = run.values(name)[:, 0]
    if not np.ptp(values):
        return f"{name} was {values[0]:.4g} throughout"
    return f"{name} was between {np.nanmin(values):.4g} and {np.nanmax(values):.4g}"


def limit_parts(run, pictures):
    """Says whether limits were reached, and draws the recorded scalars and flags if they changed and pictures are wanted."""
    flags, scalars = panels.signals_of(run, "flag"), panels.signals_of(run, "scalar")
    words = [scalar_words(run, name) for name in scalars] + [flag_words(run, name) for name in flags]
    words.insert(0, f"the guard limited {run.summary['guard']['limited']} of {run.summary['cycles']} cycles")
    said = page.escape("; ".join(words))
    yield f"<h3>Limits</h3><p>{said[0].upper()}{said[1:]}.</p>"
    scalars = [name for name in scalars if np.ptp(run.values(name))]
    if pictures and (scalars or any(run.values(name).any() for name in flags)):
        caption = f"Recorded scalars (lines) and flags (bands where set): {', '.join(scalars + flags)}."
        yield page.figure(plots.svg(2.0, more_plots.draw_flags, run, flags, scalars), caption)


def component_names(run, entry):
    """Names the components of the error; that of a pose is a position and an angle."""
    if entry["quantity"] == "pose":
        return ["x [m]", "y [m]", "z [m]", "angle [rad]"]
    port = len(entry["reference"]) + 1
    return [f"{column[port:]} [{entry['unit']}]" for column in run.signal(entry["reference"])["columns"]]


def number(value):
    return "not finite" if value is None or not math.isfinite(value) else f"{value:.3e}"


def error_tables(run):
    headers, tables = ("component", "rms", "max", "final"), ""
    for entry in run.summary["tracking"]:
        rows = zip(component_names(run, entry), *([number(v) for v in entry[key]] for key in headers[1:]))
        heading = f"<h3>Tracking error, {page.escape(entry['signal'])}</h3>"
        tables += f"<div>{heading}{page.table(headers, list(rows), headers[:1])}</div>"
    yield f'<div class="side">{tables}</div>'


def timing_table(summary):
    headers = ("stage", "p50 [µs]", "p99 [µs]", "max [µs]")
    rows = [
        [page.escape(stage)] + [f"{times[key] / 1e3:.2f}" for key in ("p50_ns", "p99_ns", "max_ns")]
        for stage, times in summary["timing"].items()
    ]
    return TIMES + page.table(headers, rows, headers[:1]) + "</details>"


def figures_of(run):
    """Yields the figures of a run; where something was to be touched, the force comes first."""
    groups = [tracking_figures, path_figures, force_figures]
    if expected.contact(run) is not None:
        groups = [force_figures, path_figures, tracking_figures]
    for group in (*groups, joint_figures):
        yield from group(run)


def verdict_of(summary, judgement, folder):
    """Returns the verdict in words, and whether nothing was against what was expected."""
    if runs.is_skipped(folder):
        return table.SKIPPED, False
    if summary is None:
        begun = any((folder / file).exists() for file in ("log.csv", "incomplete.txt"))
        return ("incomplete" if begun else table.REFUSED), False
    if summary["result"]["code"] != 0:
        refused = f"{table.REFUSED}: " if runs.is_refused(summary) else ""
        return refused + result.result_words(summary), False
    if judgement is None:
        return table.NOT_COMPARED, True
    return (table.AS_EXPECTED if judgement.met else f"not {table.AS_EXPECTED}"), judgement.met


def moment_of(path):
    """Says when a file was written, in local time."""
    return f"{datetime.datetime.fromtimestamp(path.stat().st_mtime).astimezone():{table.MOMENT}}"


def judged(section, run, pictures):
    """Judges a run, and draws it if pictures are wanted; returns the parts of its section."""
    section.chain, section.touched = run.settings.chain(), expected.touched(run)
    section.judgement = expected.judge(run)
    parts = [purpose(section), facts(section), events(section.summary)]
    if pictures:
        section.picture = plots.svg(0.62, thumbnails.draw_alone, run, width=0.9)
        section.still = thumbnails.still(run)
        section.animation = animation.data(run)
        if section.animation and expected.stop_stated(run):
            section.animation["caption"] += page.escape(f"; {section.judgement.what}: {section.judgement.seen}")
        parts += figures_of(run)
    return [*parts, *limit_parts(run, pictures), *error_tables(run), timing_table(section.summary)]


def section_of(out, name, pictures=True):
    """Returns the section of one run; a file that cannot be read or drawn is named in its place."""
    folder, parts, section = runs.folder_of(out, name), [], Section(shown(name))
    try:
        if missing := runs.without_result(folder):
            raise InputError(missing)
        section.summary = runs.read_summary(folder / "summary.json")
        section.written = moment_of(folder / "summary.json")
        section.kind = expected.kind_of(section.summary, folder / "pipeline.ini")
        if section.summary["result"]["code"] != 0:
            said = page.escape(result.result_words(section.summary))
            why = page.escape(result.why(section.summary))
            parts += [f'<div class="failure"><p>This run did not succeed: <b>{said}</b>{why}.</p>']
            parts += [screen(folder), "</div>"]
        if runs.is_refused(section.summary):
            parts += [facts(section)]
        else:
            parts += judged(section, runs.read_run(folder, section.name), pictures)
    except (InputError, OSError, ValueError) as error:
        section.problem = f"{folder}: {error}" if isinstance(error, ValueError) else str(error)
        what = "This run wrote no result." if section.summary is None else "Not everything could be drawn."
        parts += [f'<div class="failure"><p>{what}</p><p>{page.escape(section.problem)}</p>']
        parts += [screen(folder) if section.summary is None else "", "</div>"]
    section.verdict, section.met = verdict_of(section.summary, section.judgement, folder)
    if section.problem is not None and section.summary is not None:
        section.verdict, section.met = "not readable", False
    section.body = "\n".join(parts)
    return section
