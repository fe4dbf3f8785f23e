#!/usr/bin/python3
"""odd_arm.py FOLDER [SEED]: writes arm.urdf of an arm of six joints whose link frames and axes point anywhere; neighbouring axes are parallel
and perpendicular, and once neither; the third is prismatic, the fourth has no stops; with a hand that is fixed to it, and collision shapes of every
kind, a mesh among them.
"""

import pathlib
import sys

import numpy as np
from scipy.spatial.transform import Rotation

# Of each joint: the angle to the axis before, degrees, and where the axis is, m, in the axes of the base at q = 0.
ARM = ((0, (0.02, -0.01, 0.21)), (90, (0.03, 0.02, 0.11)), (180, (0.05, -0.02, 0.33)), (90, (0.04, 0.03, 0.19)), (90, (0.01, 0.0, 0.21)),
       (71, (0.02, 0.05, 0.09)))
MASSES = 3.1, 4.2, 2.9, 1.7, 1.2, 0.8  # kg
SHAPES = ('<cylinder radius="0.06" length="0.14"/>', '<box size="0.08 0.09 0.2"/>', '<mesh filename="link.stl" scale="0.001 0.001 0.001"/>',
          '<cylinder radius="0.04" length="0.1"/>', '<sphere radius="0.045"/>', '<box size="0.05 0.06 0.04"/>')


def text(values):
    return " ".join(repr(float(value)) for value in values)


def origin(frame):
    return f'<origin xyz="{text(frame[:3, 3])}" rpy="{text(Rotation.from_matrix(frame[:3, :3]).as_euler("xyz"))}"/>'


def frame_of(rotation, position):
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = rotation.as_matrix(), position
    return frame


def across(axis, random):
    """Returns a unit vector at right angles to an axis."""
    vector = np.cross(axis, random.normal(size=3))
    return vector / np.linalg.norm(vector)


def along(way, random):
    """Returns a rotation to axes whose z is along a vector."""
    z, x = way / np.linalg.norm(way), across(way, random)
    return Rotation.from_matrix(np.column_stack([x, np.cross(z, x), z]))


def link(name, mass, random, shape=""):
    place = frame_of(Rotation.random(random_state=random), random.uniform(-0.06, 0.06, 3))
    a, b, c = np.sort(random.uniform(0.6, 1.0, 3)) * mass * 0.01
    return f"""  <link name="{name}">
    <inertial>{origin(place)}<mass value="{mass}"/>
      <inertia ixx="{a!r}" iyy="{b!r}" izz="{c!r}" ixy="0" ixz="0" iyz="0"/></inertial>
{shape}  </link>
"""


def stl(path):
    """A wedge, in mm."""
    corners = 1e3 * np.array([(x, y, z) for x in (-0.05, 0.05) for y in (-0.04, 0.04) for z in (-0.1, 0.02 + x)], "<f4")
    faces = [(0, 1, 2), (1, 3, 2), (4, 6, 5), (5, 6, 7), (0, 4, 1), (1, 4, 5), (2, 3, 6), (3, 7, 6), (0, 2, 4), (2, 6, 4), (1, 5, 3), (3, 5, 7)]
    data = b"".join(np.zeros(3, "<f4").tobytes() + corners[list(face)].tobytes() + b"\0\0" for face in faces)
    path.write_bytes(bytes(80) + len(faces).to_bytes(4, "little") + data)


def main():
    folder, random = pathlib.Path(sys.argv[1]), np.random.RandomState(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    base = '    <collision><geometry><cylinder radius="0.08" length="0.1"/></geometry></collision>\n'
    parts, axis, place, before = [f'  <link name="base">\n{base}  </link>\n'], np.array([0.0, 0.0, 1.0]), np.zeros(3), np.eye(4)
    for number, ((angle, step), mass, shape) in enumerate(zip(ARM, MASSES, SHAPES), 1):
        axis = Rotation.from_rotvec(np.radians(angle) * across(axis, random)).apply(axis)
        place = place + step
        frame = frame_of(Rotation.random(random_state=random), place)
        if number > 1:
            parts.append(link(f"link{number - 1}", MASSES[number - 2], random, collision))
        way = np.array(ARM[number][1]) if number < len(ARM) else 0.08 * axis
        middle = frame_of(along(way, random), place + 0.5 * way)
        collision = f"    <collision>{origin(np.linalg.inv(frame) @ middle)}<geometry>{shape}</geometry></collision>\n"
        parent = "base" if number == 1 else f"link{number - 1}"
        kind, ends = {3: ("prismatic", 'lower="-0.1" upper="0.3"'), 4: ("continuous", "")}.get(number, ("revolute", 'lower="-2.6" upper="2.5"'))
        parts.append(f"""  <joint name="joint{number}" type="{kind}">
    {origin(np.linalg.inv(before) @ frame)}<parent link="{parent}"/><child link="link{number}"/>
    <axis xyz="{text(frame[:3, :3].T @ axis)}"/><limit {ends} velocity="2" effort="120"/>
  </joint>
""")
        before = frame
    parts.append(link("link6", MASSES[5], random, collision))
    hand = frame_of(along(axis, random), place + 0.08 * axis)
    parts.append(link("hand", 0.5, random))
    parts.append(f'  <joint name="grip" type="fixed">\n    {origin(np.linalg.inv(before) @ hand)}<parent link="link6"/><child link="hand"/>\n'
                 "  </joint>\n")
    # MuJoCo would merge what is fixed.
    merge = '  <mujoco><compiler fusestatic="false" balanceinertia="false"/></mujoco>\n'
    (folder / "arm.urdf").write_text('<robot name="odd">\n' + merge + "".join(parts) + "</robot>\n")
    stl(folder / "link.stl")


main()
