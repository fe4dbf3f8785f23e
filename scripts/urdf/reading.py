"""Reads a URDF as one chain of moving joints from a base link to a tip; what is fixed to a link is merged into it."""

import dataclasses
import math
import pathlib
import re
import xml.etree.ElementTree as xml

import numpy as np

from errors import Refused

MOST_JOINTS = 8
PLAIN = re.compile(r"[A-Za-z0-9_./+-]+")  # a name
SNAP = 1e-3  # rad: an angle this near to a quarter turn is a rounded quarter turn
TURNS = 4.0 * math.pi  # rad: the range of a joint without stops, to either side
LIMITS = {"lower": "rad", "upper": "rad", "velocity": "rad/s", "effort": "N m"}
METRES = {"lower": "m", "upper": "m", "velocity": "m/s", "effort": "N"}  # of a prismatic joint


@dataclasses.dataclass
class Body:
    """A rigid body: kg; m; kg m^2 about the centre of mass. All in one frame."""
    mass: float = 0.0
    com: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(3))
    tensor: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros((3, 3)))

    def moved(self, frame):
        turn = frame[:3, :3]
        return Body(self.mass, frame[:3, 3] + turn @ self.com, turn @ self.tensor @ turn.T)

    def __add__(self, other):
        mass = self.mass + other.mass
        if mass == 0.0:
            return Body()
        com = (self.mass * self.com + other.mass * other.com) / mass
        tensor = sum(part.tensor + part.mass * steiner(part.com - com) for part in (self, other))
        return Body(mass, com, tensor)


@dataclasses.dataclass
class Shape:
    """All points within `radius` of the hull of `points` [n, 3], m, in the frame of a link."""
    points: np.ndarray
    radius: float
    what: str


@dataclasses.dataclass
class Joint:
    name: str
    origin: np.ndarray  # frame of its link in that of the link before, at q = 0
    axis: np.ndarray  # in its own frame
    limits: dict  # lower, upper, velocity, effort
    kind: str  # revolute, continuous or prismatic
    link: str
    body: Body = None
    shapes: list = None

    @property
    def prismatic(self):
        return self.kind == "prismatic"

    @property
    def unit(self):
        return "m" if self.prismatic else "rad"

    @property
    def effort_unit(self):
        return "N" if self.prismatic else "N m"


@dataclasses.dataclass
class Chain:
    base: str
    tip: str
    joints: list
    flange: np.ndarray  # the tip in the frame of the last link
    base_shapes: list
    snapped: list  # what was taken for a quarter turn

    @property
    def names(self):
        """Of the links by number: the base, what moves, and the tool."""
        return [self.base, *(joint.link for joint in self.joints), "tool"]


def steiner(c):
    return c @ c * np.eye(3) - np.outer(c, c)


def turn(axis, angle):
    """Returns the rotation about a unit vector, exact for quarter turns."""
    quarters = angle / (math.pi / 2)
    if quarters == round(quarters):
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[round(quarters) % 4]
    else:
        c, s = math.cos(angle), math.sin(angle)
    x, y, z = axis
    return c * np.eye(3) + s * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]) + (1 - c) * np.outer(axis, axis)


def numbers(element, attribute, default, where):
    text = element.get(attribute) if element is not None else None
    if text is None:
        return np.array(default, float)
    try:
        values = np.array([float(word) for word in text.split()])
    except ValueError:
        values = np.array([math.nan])
    if len(values) != len(default) or not np.isfinite(values).all():
        raise Refused(f"{where}: {attribute}=\"{text}\"; {len(default)} finite numbers are needed")
    return values


def frame_of(element, where, snapped=None):
    """Returns the matrix of an <origin>. With a list, angles near quarter turns are taken for them and noted there."""
    origin = element.find("origin")
    angles = numbers(origin, "rpy", (0, 0, 0), where)
    for k, angle in enumerate(angles):
        quarter = round(angle / (math.pi / 2)) * (math.pi / 2)
        if snapped is not None and 0.0 < abs(angle - quarter) < SNAP:
            if abs(angle - quarter) > 1e-12:
                snapped.append(f"{where}: {'roll pitch yaw'.split()[k]} {angle:g} is taken for a quarter turn, {quarter - angle:+.1e} rad")
            angles[k] = quarter
    roll, pitch, yaw = angles
    frame = np.eye(4)
    frame[:3, :3] = turn((0, 0, 1), yaw) @ turn((0, 1, 0), pitch) @ turn((1, 0, 0), roll)
    frame[:3, 3] = numbers(origin, "xyz", (0, 0, 0), where)
    return frame


def body_of(link, name):
    inertial = link.find("inertial")
    if inertial is None:
        return Body()
    where = f"link {name}, inertial"
    mass = numbers(inertial.find("mass"), "value", (0,), where)[0]
    tensor = inertial.find("inertia")
    keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    xx, xy, xz, yy, yz, zz = (numbers(tensor, key, (0,), where)[0] for key in keys)
    if mass < 0.0:
        raise Refused(f"{where}: mass {mass:g} kg is negative")
    body = Body(mass, np.zeros(3), np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
    return body.moved(frame_of(inertial, where))


def named(root, kind):
    """Returns the links or joints by name."""
    found = {}
    for element in root.findall(kind):
        name = element.get("name", "")
        if not PLAIN.fullmatch(name):
            raise Refused(f"{kind} {name!r}: its name is written into sources; take letters, digits and _ . / + -")
        if name in found:
            raise Refused(f"{kind} {name}: there are two of this name; rename one")
        found[name] = element
    return found


class Document:
    """The elements of a URDF by name, and the joints that are held fixed by option."""

    def __init__(self, path, fixed, overrides, packages, exact):
        self.path, self.overrides, self.packages, self.exact, self.snapped = path, overrides, packages, exact, []
        try:
            root = xml.parse(path).getroot()
        except (OSError, xml.ParseError) as error:
            raise Refused(f"{path}: {error}") from error
        if root.tag != "robot":
            raise Refused(f"{path}: the root is <{root.tag}>, not <robot>; expand xacro first: xacro {path} > robot.urdf")
        self.links, self.joints = named(root, "link"), named(root, "joint")
        self.fixed = set(fixed)
        for name in self.fixed - set(self.joints):
            raise Refused(f"--fix {name}: the URDF has no such joint; it has {', '.join(sorted(self.joints))}")
        self.parent_joint, self.children = {}, {name: [] for name in self.links}
        for name, joint in self.joints.items():
            self._connect(name, *(joint.find(end).get("link") if joint.find(end) is not None else None for end in ("parent", "child")))

    def _connect(self, name, parent, child):
        for end in (parent, child):
            if end not in self.links:
                raise Refused(f"joint {name}: link {end} does not exist")
        if child in self.parent_joint:
            raise Refused(f"joint {name}: link {child} is already the child of joint {self.parent_joint[child]}; a closed chain"
                          " cannot be represented; remove one of the joints")
        self.parent_joint[child] = name
        self.children[parent].append(name)

    def child(self, name):
        return self.joints[name].find("child").get("link")

    def is_fixed(self, name):
        return name in self.fixed or self.joints[name].get("type") == "fixed"

    def origin(self, name):
        return frame_of(self.joints[name], f"joint {name}, origin", None if self.exact else self.snapped)

    def path_to(self, base, tip):
        """Returns the names of the joints from base to tip."""
        names, link = [], tip
        while link != base:
            if link not in self.parent_joint or len(names) > len(self.joints):
                raise Refused(f"link {tip} is not carried by link {base}; give --base and --tip of one chain")
            names.append(self.parent_joint[link])
            link = self.joints[names[-1]].find("parent").get("link")
        return names[::-1]

    def ends(self, base, tip):
        """Returns the links at which the chain begins and ends."""
        for option, link in (("--base", base), ("--tip", tip)):
            if link is not None and link not in self.links:
                raise Refused(f"{option} {link}: the URDF has no such link; it has {', '.join(self.links)}")
        roots = [link for link in self.links if link not in self.parent_joint]
        if base is None and len(roots) != 1:
            raise Refused(f"{len(roots)} links without a parent ({', '.join(roots)}); give --base")
        leaves = [link for link in self.links if not self.children[link]]
        if tip is None and len(leaves) != 1:
            raise Refused(f"{len(leaves)} links carry nothing: {', '.join(leaves)}; give the end of the chain as --tip")
        return base or roots[0], tip or leaves[0]

    def merged(self, link, on_chain, shapes_of, frame=None):
        """Returns body and shapes of a link and of all that is fixed to it, in its frame; and where the links are."""
        frame = np.eye(4) if frame is None else frame
        body, shapes, places = body_of(self.links[link], link).moved(frame), shapes_of(self, link, frame), {link: frame}
        for name in self.children[link]:
            if self.is_fixed(name):
                below = self.merged(self.child(name), on_chain, shapes_of, frame @ self.origin(name))
                body, shapes = body + below[0], shapes + below[1]
                places.update(below[2])
            elif name not in on_chain:
                raise Refused(f"joint {name}, type {self.joints[name].get('type')}: it moves, and is not between base and tip; hold it"
                              f" at zero by --fix {name}, or give another --tip")
        return body, shapes, places

    def units(self, name):
        return METRES if self.joints[name].get("type") == "prismatic" else LIMITS

    def limit(self, name, attribute):
        """Returns a limit of a joint, from an option before the file."""
        key = f"{name}.{attribute}"
        if key in self.overrides:
            return self.overrides[key]
        element = self.joints[name].find("limit")
        if element is None or element.get(attribute) is None:
            raise Refused(f"joint {name}: <limit> has no {attribute}; give it as --limit {key}=VALUE, {self.units(name)[attribute]}")
        return numbers(element, attribute, (0,), f"joint {name}, limit")[0]


REFUSED_TYPES = {
    "floating": "the base of an arm does not move",
    "planar": "a joint has one axis",
}


def joint_of(document, name, before):
    """Returns a moving joint; `before` is the frame of its parent in the link of the joint before."""
    element = document.joints[name]
    kind = element.get("type")
    if kind not in ("revolute", "continuous", "prismatic"):
        reason = REFUSED_TYPES.get(kind, "revolute, continuous, prismatic and fixed joints are known")
        raise Refused(f"joint {name}, type {kind}: {reason}; hold it at zero by --fix {name}")
    if element.find("mimic") is not None:
        raise Refused(f"joint {name}, mimic: a joint that follows another cannot be represented; hold it at zero by --fix {name}")
    axis = numbers(element.find("axis"), "xyz", (1, 0, 0), f"joint {name}, axis")
    if not np.linalg.norm(axis) > 0.0:
        raise Refused(f"joint {name}, axis: its length is 0")
    limits = {key: document.limit(name, key) for key in ("velocity", "effort")}
    endless = kind == "continuous"
    for key, sign in (("lower", -1), ("upper", 1)):
        given = not endless or f"{name}.{key}" in document.overrides
        limits[key] = document.limit(name, key) if given else sign * TURNS
    for key in ("velocity", "effort"):
        if not limits[key] > 0.0:
            raise Refused(f"joint {name}: {key} {limits[key]:g} is not more than 0; give --limit {name}.{key}=VALUE,"
                          f" {document.units(name)[key]}")
    if not limits["lower"] < limits["upper"]:
        raise Refused(f"joint {name}: lower {limits['lower']:g} is not less than upper {limits['upper']:g}; give --limit"
                      f" {name}.lower=VALUE or {name}.upper=VALUE, {document.units(name)['lower']}")
    origin = before @ document.origin(name)
    return Joint(name, origin, axis / np.linalg.norm(axis), limits, kind, document.child(name))


def read_chain(document, base, tip, shapes_of):
    """Returns the chain of the URDF from base to tip."""
    base, tip = document.ends(base, tip)
    moving = [name for name in document.path_to(base, tip) if not document.is_fixed(name)]
    if len(moving) == 3:
        raise Refused(f"3 joints move between {base} and {tip}; such an arm cannot be built: its joint vectors would be of the type of points;"
                      " hold one by --fix, or describe one more")
    if not 1 <= len(moving) <= MOST_JOINTS:
        raise Refused(f"{len(moving)} joints move between {base} and {tip} ({', '.join(moving)}); an arm has 1 to {MOST_JOINTS}: give"
                      " other ends by --base and --tip, or hold joints by --fix")
    body, base_shapes, places = document.merged(base, moving, shapes_of)
    joints = []
    for name in moving:
        parent = document.joints[name].find("parent").get("link")
        joint = joint_of(document, name, places[parent])
        joint.body, joint.shapes, places = document.merged(joint.link, moving, shapes_of)
        if not joint.body.mass > 0.0:
            raise Refused(f"link {joint.link}, behind joint {name}: no mass; give the link an <inertial>")
        if not np.linalg.eigvalsh(joint.body.tensor).min() > 0.0:
            raise Refused(f"link {joint.link}, inertia: not positive definite; correct its <inertial>")
        joints.append(joint)
    for key in document.overrides:
        if key.rpartition(".")[0] not in moving or key.rpartition(".")[2] not in LIMITS:
            raise Refused(f"--limit {key}: joint and attribute are needed; the joints are {', '.join(moving)}; {', '.join(LIMITS)}")
    return Chain(base, tip, joints, places[tip], base_shapes, document.snapped)


def mesh_path(document, name):
    """Returns the file of a mesh: beside the URDF, or in the folder of its package."""
    if not name.startswith("package://"):
        return pathlib.Path(document.path).parent / name.removeprefix("file://")
    package, _, rest = name.removeprefix("package://").partition("/")
    if package not in document.packages:
        raise Refused(f"mesh {name}: give the folder of the package: --package {package}=FOLDER")
    return pathlib.Path(document.packages[package]) / rest
