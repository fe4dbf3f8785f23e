"""What the page needs to play a run: joint positions, the reference and the force of the environment on the tool."""

import base64
import json
import pathlib

import numpy as np

from reporting import arm, expected, page, panels, view
from reporting.inputs import InputError, read_text

FRAMES_HZ = 50
FILES = pathlib.Path(__file__).with_name("web")
LIBRARY = pathlib.Path("/usr/share/javascript/three")  # of the Debian package libjs-three
NOTICE = pathlib.Path(__file__).resolve().parents[2] / "NOTICE"  # the licence of the library, which goes with a copy
LIBRARY_FILES = ("three.min.js", "examples/js/controls/OrbitControls.js")
REFERENCES = {"pose": "pose", "joint position": "joints"}  # a quantity, and its name on the page
CAPTIONS = {
    "simulated": "simulated robot",
    "emulated": "<em>emulated</em> robot controller; no real robot",
    "real": "real robot",
}


def packed(values, rows):
    return base64.b64encode(np.ascontiguousarray(values[rows], "<f4").tobytes()).decode()


def mesh(body):
    """Returns the surface of a body of scene.json as the page takes it."""
    corners, triangles = arm.surface(body)
    return {"corners": np.round(corners, 4).ravel().tolist(), "triangles": triangles.ravel().tolist()}


def data(run):
    """Returns the data of one run, or None if it recorded no joint positions, or only one."""
    t, kind = run.log["time_s"], expected.kind(run)
    if "robot.q" not in run.names() or len(t) < 2:
        return None
    rows = np.searchsorted(t, np.arange(t[0], t[-1], 1 / FRAMES_HZ) - 1e-9)
    entry, found = panels.task_entry(run), expected.contact(run)
    there = [box["name"] for box in expected.surroundings(run)]
    boxes = [{**box, "there": box["name"] in there} for box in run.scene["boxes"]]
    for box in boxes:
        if "inside" in box:
            box.update(mesh(box.pop("inside")))
    shown = {key: run.scene[key] for key in ("joints", "flange", "capsules", "tool")}
    if tool_points := shown["tool"].get("points"):
        shown["tool"] = {**shown["tool"], **mesh({"core": "hull", "points": tool_points, "rounding": shown["tool"]["radius"]})}
    shown["hulls"] = [{"link": hull["link"], **mesh({"core": "hull", **hull})} for hull in run.scene.get("hulls", [])]
    result = {
        "name": run.name,
        "caption": f"<b>{page.escape(run.name)}</b>, {CAPTIONS[kind]}",
        "eye": [round(float(x), 4) for x in view.eye(run)],
        "start_s": float(t[0]),
        "step_s": 1 / FRAMES_HZ,
        "q": packed(run.values("robot.q"), rows),
        "scene": {**shown, "boxes": boxes},
    }
    if entry is not None and entry["quantity"] in REFERENCES:
        result[REFERENCES[entry["quantity"]]] = packed(run.values(entry["reference"]), rows)
    for name in panels.signals_of(run, "wrench"):
        if not panels.from_generator(run, name):
            result["force"] = packed(run.values(name)[:, :3], rows)
            result["steady_N"] = float(found.expected.max()) if found else 0.0
    return result


def scripts(runs):
    """Returns the scripts of the page: the library, the program and the data of the runs."""
    try:
        texts = [read_text(LIBRARY / file) for file in LIBRARY_FILES]
    except InputError as error:
        raise InputError(f"{error}; install the Debian package libjs-three: scripts/setup") from error
    texts += [read_text(FILES / file) for file in ("arm.js", "viewer.js")]
    numbers = json.dumps(runs).replace("<", "\\u003c")
    given = f'<script type="application/json" id="runs-data">{numbers}</script>'
    return f"<!--\n{read_text(NOTICE)}-->\n{given}" + "".join(f"<script>{text}</script>\n" for text in texts)


VIEWER = """<figure id="viewer"><canvas id="canvas"></canvas>
<figcaption id="shown"></figcaption>
<div class="controls"><button id="play" type="button">Play</button>
<input id="slider" type="range" min="0" max="1" value="0" step="0.01" aria-label="time">
<output id="time"></output></div>
<div class="controls"><label>Run <select id="choose"></select></label>
<label>Speed <select id="speed"><option value="0.25">0.25 ×</option><option value="1">1 ×</option>
<option value="2" selected>2 ×</option><option value="5">5 ×</option></select></label></div>
<p class="readings">Reference − tip <output id="error"></output><span hidden> Force on the tool
<output id="force"></output></span></p>
<p class="key"><span><i style="background:#aab2bd"></i>arm, measured</span>
<span><i style="background:#ecc480"></i>reference, if apart</span>
<span><i class="line" style="background:#1f5fa8"></i>path of the tip</span>
<span><i class="line" style="background:#333"></i>desired path</span>
<span><i class="line" style="background:#c0392b"></i>force on the tool</span></p>
<p class="key hint">Drag to turn, scroll to zoom. After a run comes the next.</p>
</figure>"""
