"""The section of one run in the report: result, figures, errors and times."""

import dataclasses
import math

import numpy as np

from reporting import page, panels, plots, runs, table

MANNER = "Reference (dashed) and measured (solid)"
MANNER_WITH_POINTS = "Waypoints (circles), reference (dashed) and measured (solid)"


@dataclasses.dataclass
class Section:
    """The part of the report on one run; `problem` is None if everything could be read and drawn."""

    name: str
    summary: dict
    body: str
    problem: str


def facts(summary):
    guard = summary["guard"]
    return (
        f"<p>Robot {page.escape(summary['robot'])} on {page.escape(summary['board'])}, {summary['rate_hz']:g} Hz,"
        f" {summary['cycles']} cycles, seed {summary['seed']}, configuration {page.escape(summary['config_hash'])}."
        f" {summary['slips']} slips, {summary['overruns']} overruns, {guard['limited']} cycles limited by the guard,"
        f" {summary['recorder_dropped']} rows lost by the recorder, {summary['heap_allocations_in_cycle']} heap"
        f" allocations in cycles, {summary['realtime_factor']:.0f} times real time.</p>"
    )


def tracking_figures(run):
    for panel in panels.tracking_panels(run):
        manner = MANNER_WITH_POINTS if panel.points else MANNER
        turn = ", as the rotation vector in base axes from the first reference" if panel.what == "orientation" else ""
        caption = f"{run.name}: {manner} {panel.what}{turn}; below, the error {panel.entry['signal']}."
        yield page.figure(plots.svg(4.4, plots.draw_panel, panel), caption)


def contact_figures(run):
    wrenches, found = panels.signals_of(run, "wrench"), panels.displacement(run)
    if not wrenches or found is None:
        return
    name, displacement = found
    caption = (
        f"{run.name}: position error {name} in base axes, and the forces of the environment on the tip:"
        f" {', '.join(wrenches)} (references are dashed)."
    )
    yield page.figure(plots.svg(4.4, plots.draw_contact, run, displacement, wrenches), caption)


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


def limit_parts(run):
    """Says whether limits were reached, and draws the recorded scalars and flags if they changed."""
    flags, scalars = panels.signals_of(run, "flag"), panels.signals_of(run, "scalar")
    words = [scalar_words(run, name) for name in scalars] + [flag_words(run, name) for name in flags]
    words.append(f"the guard limited {run.summary['guard']['limited']} of {run.summary['cycles']} cycles")
    yield f"<h3>Limits</h3><p>{page.escape('; '.join(words))}.</p>"
    scalars = [name for name in scalars if np.ptp(run.values(name))]
    if scalars or any(run.values(name).any() for name in flags):
        caption = f"{run.name}: recorded scalars (lines) and flags (bands where set): {', '.join(scalars + flags)}."
        yield page.figure(plots.svg(2.2, plots.draw_limits, run, flags, scalars), caption)


def component_names(run, entry):
    """Names the components of the error; that of a pose is a position and an angle."""
    if entry["quantity"] == "pose":
        return ["x [m]", "y [m]", "z [m]", "angle [rad]"]
    port = len(entry["reference"]) + 1
    return [f"{column[port:]} [{entry['unit']}]" for column in run.signal(entry["reference"])["columns"]]


def number(value):
    return "not finite" if value is None or not math.isfinite(value) else f"{value:.3e}"


def error_tables(run):
    headers = ("component", "rms", "max", "final")
    for entry in run.summary["tracking"]:
        rows = zip(component_names(run, entry), *([number(v) for v in entry[key]] for key in headers[1:]))
        yield f"<h3>Tracking error, {page.escape(entry['signal'])}</h3>" + page.table(headers, list(rows), headers[:1])


def timing_table(summary):
    headers = ("stage", "p50 [us]", "p99 [us]", "max [us]")
    rows = [
        [page.escape(stage)] + [f"{times[key] / 1e3:.2f}" for key in ("p50_ns", "p99_ns", "max_ns")]
        for stage, times in summary["timing"].items()
    ]
    return "<h3>Time per stage of the cycle</h3>" + page.table(headers, rows, headers[:1])


def screen(folder):
    """Returns the output of the run."""
    path = folder / "output.txt"
    words = runs.read_text(path).strip() if path.exists() else ""
    return f"<pre>{page.escape(words)}</pre>" if words else ""


def section_of(out, name):
    """Returns the section of one run; a file that cannot be read or drawn is named in its place."""
    folder, parts, summary, problem = out / name.replace(":", "_"), [], None, None
    try:
        summary = runs.read_summary(folder / "summary.json")
        if summary["result"]["code"] != 0:
            result = page.escape(runs.result_words(summary))
            parts += [f'<div class="failure"><p>This run did not succeed: <b>{result}</b>.</p>']
            parts += [screen(folder), "</div>"]
        parts += [facts(summary)]
        run = runs.read_run(folder, name)
        for group in (tracking_figures, contact_figures, limit_parts, error_tables):
            parts += group(run)
        parts += [timing_table(summary)]
    except (runs.InputError, OSError) as error:
        problem = str(error)
        what = "This run wrote no result." if summary is None else "Not everything could be drawn."
        parts += [f'<div class="failure"><p>{what}</p><p>{page.escape(problem)}</p>']
        parts += [screen(folder) if summary is None else "", "</div>"]
    return Section(name, summary, "\n".join(parts), problem)


def is_failed(section):
    return section.problem is not None or section.summary["result"]["code"] != 0


def overview(sections):
    """Returns the table of all runs; each name is a link to its section."""
    rows = []
    for section in sections:
        name, *cells = map(page.escape, table.cells(section.name, section.summary))
        rows.append([f'<a href="#{page.identifier(section.name)}">{name}</a>', *cells])
    failed = [i for i, section in enumerate(sections) if is_failed(section)]
    note = f'<p class="note">{page.escape(table.LEGEND)}</p>'
    return page.table(table.HEADERS, rows, table.TEXT_COLUMNS, failed) + note
