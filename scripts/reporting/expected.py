"""What a run should show, computed from its pipeline file and its reference, and what it showed.

Five cases, the first that applies:
- The file states a stop: `[expect] collision_stop`. The run has judged cause, pair and rest; the distance of the two is
  measured here, at the joints of the log, and is to be the check's margin at least.
- An admittance meets a box. At rest its spring and the touched surface balance: with the stiffness K along the face's
  normal, the penetration p of the reference, the requested force F_d and the surface's stiffness k, the force is
  (K p + F_d) / (1 + K / k).
- The file states it: `[expect] tracking_rad`, `tracking_m`. The run itself has judged it on every cycle.
- A law that damps the measured velocity instead of its error lags: PD with gravity compensation (eq. 2 of the paper) and
  a PID with `derivative = measurement`. With the friction of the simulated robot and the feed-forward F_V of a PID,
  K_P e + K_I integral(e) = K_D dq_d + friction(dq_d) - F_V dq_d, in steady motion.
- Otherwise the reference is followed: the error is 0, within the goal tolerance of its generator.
"""

import dataclasses
import ipaddress

import numpy as np

from reporting import arm, clearance, friction, panels
from reporting.settings import Settings
from reporting.units import words

SPRING = ("admittance's spring", "the balance of the admittance's spring, the requested force and the surface")
LAG = ("lag by K_D, friction", "the law damps the measured velocity: it lags by (K_D × velocity + friction) / K_P")
STATED = ("stated in the file", "the pipeline file states it, in [expect]")
FOLLOWED = ("reference followed", "the reference is followed, ± the goal tolerance of its generator")
FORCE_SHARE = 0.05  # of the expected force, by which the mean force may differ from it
DRIVES_FRICTION = 1.0  # of fer_drives, times the identified friction
TOUCH_N = {"simulated": 1.0, "emulated": 10.0, "real": 10.0}  # a smaller force is an error of the sensor
EMULATED_STIFFNESS = 2e4  # N/m, of a surface: kStiffness of sim_plant/ur/motion/body.hpp
LAG_SHARE = 0.1  # the same of the largest lag; inertia is not in the formula
PLATEAU_SHARE = 0.98  # of the largest expected force, above which the contact counts as steady ...
SETTLE_S = 1.0  # ... after this time


@dataclasses.dataclass
class Judgement:
    """Seen and expected, in words, the reason in short and in full; `met` says whether they agree."""

    what: str
    seen: str
    expected: str
    short: str
    why: str
    met: bool


@dataclasses.dataclass
class Contact:
    """The force of a box on the tool along its normal [rows], and what it should be; `steady` selects rows."""

    box: str
    normal: np.ndarray
    force: np.ndarray
    expected: np.ndarray
    steady: np.ndarray


def kind(run):
    """Returns "simulated", "emulated" or "real"."""
    return kind_of(run.summary, run.settings.path)


def kind_of(summary, path):
    """Returns the same from a summary and the path of the pipeline file; an emulated robot is on this machine."""
    if summary["simulated"]:
        return "simulated"
    settings = Settings(path)
    wires = ((settings.given("can", "interfaces"), "vcan"), (settings.given("ethercat", "interface"), "veth"))
    if any((interface or "").startswith(virtual) for interface, virtual in wires):
        return "emulated"
    address = settings.given("ur", "address")
    try:
        return "emulated" if address and ipaddress.ip_address(address).is_loopback else "real"
    except ValueError:
        return "real"


def surroundings(run):
    """Returns the boxes that the arm can touch; an emulated one those of the file, as scripts/beside_emulator has it.

    Bodies that are no boxes are known to the collision check alone.
    """
    if kind(run) == "simulated" and run.settings.value("plant", "scene") == "none":
        return []
    return [box for box in run.scene["boxes"] if "inside" not in box]


def ball(run, poses):
    """Returns the centre of the ball at the tip [rows, 3] and its radius; a real tool is taken as a point."""
    if kind(run) == "real":
        return poses[:, :3], 0.0
    radius = run.settings.number("plant", "tip_radius")
    if kind(run) == "emulated":
        return poses[:, :3], radius
    beyond = np.subtract(run.settings.numbers("plant", "payload_tip", 3), run.scene["tool"]["tip"])
    return poses[:, :3] + arm.rotation_matrix(poses[:, 3:]) @ beyond, radius


def distances(box, centre, radius):
    """Returns the distances of a ball from the six faces [rows, 6], negative inside, and their normals [6, 3]."""
    axes = arm.rotation_matrix(box["rotation"]).T
    normals = np.vstack([axes, -axes])
    return (centre - box["centre"]) @ normals.T - np.tile(box["size"], 2) / 2 - radius, normals


def touched_face(run, measured):
    """Returns the box and the face that the ball comes nearest to, or None."""
    nearest = None
    for box in surroundings(run):
        away, _ = distances(box, *ball(run, measured))
        outside = away.max(axis=1)
        row = outside.argmin()
        if nearest is None or outside[row] < nearest[0]:
            nearest = outside[row], box, away[row].argmax()
    return nearest and nearest[1:]


def surface(run):
    """Returns the stiffness of the touched surface, N/m; that of a real one is not known."""
    if kind(run) == "simulated":
        return run.settings.number("plant", "contact_stiffness")
    return EMULATED_STIFFNESS if kind(run) == "emulated" else np.inf


def contact(run):
    """Returns the contact of an admittance with a box, or None; its wrench must be recorded."""
    blocks = [name for name in run.settings.blocks("admittance") if run.settings.given(name, "h") in run.names()]
    poses = panels.task_pair(run)
    face = touched_face(run, poses[1]) if blocks and poses else None
    if face is None:
        return None
    block, (box, index) = blocks[0], face
    away, normals = distances(box, *ball(run, poses[0]))
    normal = normals[index]
    along = np.tile(normal, (len(away), 1))
    if run.settings.value(block, "frame") != "base":
        along = np.einsum("rij,ri->rj", arm.rotation_matrix(poses[0][:, 3:]), along)
    stiffness = along**2 @ run.settings.numbers(block, "stiffness", 3)
    requested = run.settings.given(block, "h_d")
    pull = run.values(requested)[:, :3] @ normal if requested in run.names() else 0.0
    expected = np.maximum((pull - stiffness * away[:, index]) / (1 + stiffness / surface(run)), 0.0)
    t = run.log["time_s"]
    steady = expected >= PLATEAU_SHARE * expected.max()
    steady &= t >= t[steady.argmax()] + SETTLE_S
    force = run.values(run.settings.given(block, "h"))[:, :3] @ normal
    return Contact(box["name"], normal, force, expected, steady)


def plant_friction(run, velocity):
    """Returns the friction torque of a simulated arm, behind emulated drives too; that of a real one is not known."""
    if kind(run) == "real" or run.settings.given("ur", "address"):
        return 0.0
    times = run.settings.number("plant", "friction") if kind(run) == "simulated" else DRIVES_FRICTION
    return times * friction.torque(run.summary["robot"], velocity)


def lag_with_integral(torque, kp, kd, ki, t):
    """Returns e of kp e + kd de/dt + ki integral(e) = torque [rows, joints], from rest."""
    error, integral = np.zeros_like(torque), np.zeros(torque.shape[1])
    for row, dt in enumerate(np.diff(t), 1):
        error[row] = (torque[row] - integral + kd / dt * error[row - 1]) / (kp + kd / dt + ki * dt)
        integral = integral + ki * dt * error[row]
    return error


def lag(run, entry):
    """Returns the error that a law should have that damps the measured velocity [rows, joints], or None."""
    for kind_of_law in ("pd_gravity", "pid"):
        for law in run.settings.blocks(kind_of_law):
            if run.settings.given(law, "q_d") != entry["reference"]:
                continue
            is_pid = kind_of_law == "pid"
            if is_pid and run.settings.value(law, "derivative") != "measurement":
                continue
            joints = len(run.scene["joints"])
            kp, kd = (np.array(run.settings.numbers(law, key, joints)) for key in ("kp", "kd"))
            ki, ahead = (
                np.array(run.settings.numbers(law, key, joints)) if is_pid else np.zeros(joints)
                for key in ("ki", "velocity_gain")
            )
            velocity = panels.velocity_of(run, entry["reference"])
            torque = (kd - ahead) * velocity + plant_friction(run, velocity)
            return lag_with_integral(torque, kp, kd, ki, run.log["time_s"]) if np.any(ki) else torque / kp
    return None


def touched(run):
    """Returns what the tool touched, in words; without a force sensor only an empty place is certain."""
    if kind(run) != "real" and not surroundings(run):
        return "nothing"
    found = contact(run)
    if found is None:
        return "not measured"
    return found.box if found.force.max() > TOUCH_N[kind(run)] else "nothing"


def around(seen, expected, band, unit, why):
    """Returns the expected value with its band in words, why it is expected, and whether the seen one is within it."""
    return f"{words(expected, unit)} ± {words(band, unit)}", *why, bool(abs(seen - expected) <= band)


def judge_contact(found):
    if not found.steady.any():
        return Judgement("mean force", "none steady", words(found.expected.max(), "N"), *SPRING, False)
    seen, expected = found.force[found.steady].mean(), found.expected[found.steady].mean()
    return Judgement("mean force", words(seen, "N"), *around(seen, expected, FORCE_SHARE * expected, "N", SPRING))


def judge_lag(scene, predicted, error, tolerance):
    seen, expected = np.abs(error).max(), np.abs(predicted).max()
    band = max(LAG_SHARE * expected, tolerance)
    unit = "m" if arm.prismatic(scene["joints"][np.abs(error).max(axis=0).argmax()]) else "rad"
    return Judgement("max joint error", words(seen, unit), *around(seen, expected, band, unit, LAG))


def judge_stated(run, what, unit):
    """Returns the judgement of the error that the pipeline file states, or None."""
    entry = run.summary.get("expect", {}).get(f"tracking_{unit}")
    if entry is None:
        return None
    seen, stated = entry["seen"], entry["stated"]
    return Judgement(what, words(seen, unit), f"at most {words(stated, unit)}", *STATED, bool(seen <= stated))


def stop_stated(run):
    """Returns the two bodies before whose contact the pipeline file wants the arm to be stopped, or None."""
    entry = run.summary.get("expect", {}).get("collision_stop")
    return entry and entry["stated"].split()


def judge_stop(run):
    """Returns the judgement of the stop that the pipeline file states."""
    entry, names = run.summary["expect"]["collision_stop"], stop_stated(run)
    margin, near = run.settings.number("collision", "margin"), clearance.nearest(run, names)
    when = "".join([f" ({event['time_s']:g} s)" for event in run.summary["events"] if event["to"] == "stop"][:1])
    place = words(near, "m") if near > 0.0 else "they met"
    seen = f"stopped at {place}{when}" if entry["met"] else f"{entry['seen']}{when}; nearest: {place}"
    what, told = " to ".join(names), f"stopped at {words(margin, 'm')} or more"
    return Judgement(what, seen, told, *STATED, entry["met"] and bool(near >= margin))


def tolerance(run, reference, is_pose):
    """Returns the goal tolerance of the generator of a reference, m or the smallest of the joints, rad."""
    block = reference.partition(".")[0]
    if is_pose:
        return run.settings.number(block, "goal_position_tolerance")
    return min(run.settings.numbers(block, "goal_tolerance", len(run.scene["joints"])))


def judge(run):
    """Returns what the run was supposed to show and what it showed, or None if nothing was tracked."""
    if stop_stated(run):
        return judge_stop(run)
    entry = panels.task_entry(run)
    if entry is None:
        return None
    found = contact(run)
    if found is not None:
        return judge_contact(found)
    reference, measured = panels.pair(run, entry)
    is_pose = entry["quantity"] == "pose"
    unit = "m" if is_pose else entry["unit"]
    what = "max tip error" if is_pose else "max joint error"
    stated = judge_stated(run, what, unit)
    if stated is not None:
        return stated
    error = reference[:, :3] - measured[:, :3] if is_pose else reference - measured
    bound = tolerance(run, entry["reference"], is_pose) if panels.from_generator(run, entry["reference"]) else 0.0
    predicted = None if is_pose else lag(run, entry)
    if predicted is not None:
        return judge_lag(run.scene, predicted, error, bound)
    largest = np.linalg.norm(error, axis=1).max() if is_pose else np.abs(error).max()
    return Judgement(what, words(largest, unit), f"0 ± {words(bound, unit)}", *FOLLOWED, bool(largest <= bound))
