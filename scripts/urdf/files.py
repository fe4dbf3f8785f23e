"""The texts of a robot's files, by their paths."""

import pathlib
import shutil
import subprocess

import numpy as np

from errors import Refused
from text import comment, direction, euler, number, plain, quaternion, quoted, row, rows_of, tensor_row


def write(files, root, force):
    """Writes texts by their paths, formatted; nothing if one exists."""
    taken = [path for path in files if (root / path).exists()]
    if taken and not force:
        raise Refused(f"{root / taken[0]} exists; give --force to replace the robot's files, or another --name")
    style = pathlib.Path(__file__).resolve().parents[2] / ".clang-format"
    for path, text in files.items():
        if path.endswith("pp") and shutil.which("clang-format"):
            command = ["clang-format", f"--style=file:{style}", f"--assume-filename={path}"]
            text = subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout
        if path in taken and (root / path).read_text() == text:
            continue  # so that nothing is compiled anew
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)


def frame(each):
    """Returns the members of a JointFrame, up to the last that is not the default."""
    rest = [number(each.turn), f"JointType::k{'Prismatic' if each.prismatic else 'Revolute'}", number(each.tilt)]
    told = 3 if each.tilt else 2 if each.prismatic else 1 if each.turn else 0
    return ", ".join([row(each.offset), str(each.quarters), *rest[:told]])


class Files:
    """What the importer found, and the texts that state it."""

    def __init__(self, name, source, chain, table, options):
        self.name, self.type, self.source = name, name.capitalize(), source
        self.chain, self.table, self.options = chain, table, options

    def robot(self):
        """kernel/robots/NAME.hpp"""
        chain, table, options = self.chain, self.table, self.options
        joints = chain.joints
        frames = [frame(each) for each in table.rows]
        links = [row((b.mass, *b.com, *b.tensor[0], *b.tensor[1, 1:], b.tensor[2, 2])) for b in table.bodies]
        limits = [row((j.limits["lower"], j.limits["upper"], j.limits["velocity"], options.acceleration[i], options.jerk[i],
                       j.limits["effort"], options.torque_rate[i])) for i, j in enumerate(joints)]
        endless = sum(1 << i for i, j in enumerate(joints) if j.kind == "continuous")
        about = comment(f"""{self.type}: the table of constants, written by scripts/robot-import from {self.source}.

Base {chain.base}, flange {chain.tip}. Kinematics, inertias, position, velocity and torque are those of the URDF; acceleration, jerk,
torque rate and the limits of the tip are options of the import. A joint without stops has a range of two turns to either side, which
is chosen.""")
        return f"""{about}
#pragma once

#include <array>

#include "kernel/robots/robot_table.hpp"

namespace tactus {{

struct {self.type} {{
  static constexpr int kDof = {len(joints)};
  static constexpr const char* kName = "{self.name}";

  static constexpr std::array<const char*, kDof> kJointNames = {{{quoted(j.name for j in joints)}}};

  // clang-format off
  //   x, y, z, quarter turns, turn, type, tilt
  static constexpr std::array<JointFrame, kDof> kJoints = {{{{
{rows_of(frames)}
  }}}};
  static constexpr JointFrame kFlange = {{{frame(table.flange)}}};

  //   mass, cx, cy, cz, Ixx, Ixy, Ixz, Iyy, Iyz, Izz
  static constexpr std::array<LinkInertia, kDof> kLinks = {{{{
{rows_of(links)}
  }}}};

  static constexpr unsigned kContinuousJoints = {endless:#b};  // bit i: joint i has no stops

  //   q_min, q_max, dq, ddq, dddq, tau, dtau
  static constexpr std::array<JointLimit, kDof> kLimits = {{{{
{rows_of(limits)}
  }}}};

  //                                         v, a, j, w, alpha, dalpha, force, moment
  static constexpr TaskLimit kTaskLimit = {{{row(options.tip_limits)}}};
  // clang-format on
}};

}}  // namespace tactus
"""

    def capsules(self, capsules, residuals, listed, never):
        """kernel/robots/NAME_capsules.hpp"""
        names = [self.chain.base] + [joint.link for joint in self.chain.joints]
        rows = [f"{link}, {{{row(a)}}}, {{{row(b)}}}, {number(radius)}" for link, a, b, radius in capsules]
        rows = "\n".join(f"      {{{line}}},  // {what}, at most {1e3 * far:.1f} mm beyond"
                         for line, (what, far) in zip(rows, residuals))
        share = " ".join(f"{first} and {second} in {100 * part:.0f} %." for (first, second), part in listed.items())
        pairs = ", ".join(f"{{{first}, {second}}}" for first, second in listed)
        apart = ", ".join(f"{{{first}, {second}}}" for first, second in never)
        about = comment(f"""{self.type}: its links as capsules, fitted by scripts/robot-import to the collision shapes of {self.source}. Each
contains its shape and is of nearly the least volume; beside it is how far it reaches beyond the convex hull of the shape.""")
        return f"""{about}
#pragma once

#include <array>

#include "kernel/robots/capsule_table.hpp"
#include "kernel/robots/{self.name}.hpp"

namespace tactus {{

template <>
struct Capsules<{self.type}> {{
  static constexpr std::array<const char*, {len(names)}> kLinkNames = {{{quoted(names)}}};

  // clang-format off
  //   link, a, b, radius
  static constexpr std::array<LinkCapsule, {len(capsules)}> kCapsules = {{{{
{rows}
  }}}};

  /// Links whose capsules touch in a good share of all positions{": " + share if share else "; there are none."}
  static constexpr std::array<LinkPair, {len(listed)}> kTouching = {{{"{" + pairs + "}" if pairs else ""}}};

  /// The joints between these capsules do not bend so far that they meet.
  static constexpr std::array<CapsulePair, {len(never)}> kNever = {{{"{" + apart + "}" if apart else ""}}};
  // clang-format on
}};

}}  // namespace tactus
"""

    def mjcf(self, home):
        """sim_plant/arm/NAME_mjcf.cpp"""
        bodies = []
        for i, joint in enumerate(self.chain.joints, 1):
            place, body = joint.origin, joint.body
            bodies.append(f"""    <body name="link{i}" pos="{plain(place[:3, 3])}" quat="{plain(quaternion(place[:3, :3]))}"
          user="{tensor_row(body.tensor).replace(',', '')}">
      <inertial mass="{number(body.mass)}" pos="{plain(body.com)}" diaginertia="1 1 1"/>
      <joint name="joint{i}"{' type="slide"' if joint.prismatic else ''} axis="{plain(joint.axis)}"/>""")
        flange = self.chain.flange
        bodies.append(f'    <body name="flange" pos="{plain(flange[:3, 3])}" quat="{plain(quaternion(flange[:3, :3]))}">')
        joints = self.chain.joints
        text = "\n".join(bodies)
        about = comment(f"""Written by scripts/robot-import from {self.source}: every body has the frame of its link in the URDF, what is fixed to it
merged. A tensor is about the centre of mass, kg m^2, in the order xx yy zz xy xz yz. Friction: none. The drives give the torque of the
URDF, and turn at 1.2 times its velocity, which is chosen.""")
        return f"""{about}
#include "sim_plant/arm/robot_mjcf.hpp"

namespace tactus {{
namespace {{

constexpr const char* kBodies = R"(
{text}
)";

constexpr RobotMjcf k{self.type} = {{
    kBodies,
    {{{row(home)}}},
    0.0,
    {{{row(j.limits["effort"] for j in joints)}}},
    {{{row(1.2 * j.limits["velocity"] for j in joints)}}}}};

}}  // namespace

const RobotMjcf& robot_mjcf() {{
  return k{self.type};
}}

}}  // namespace tactus
"""

    def kdl(self):
        """tests/oracles/kdl_NAME.cpp"""
        chain, table = self.chain, self.table
        count = len(chain.joints)
        places = [link.dot(np.eye(4)) for link in table.links]
        origins = [joint.origin for joint in chain.joints] + [chain.flange]
        ends = [np.linalg.inv(link) for link in places[1:]] + [np.eye(4)]
        frames = [places[i] @ origins[i] @ ends[i] for i in range(count + 1)]
        kinds = [f", KDL::Joint::{'TransZ' if joint.prismatic else 'RotZ'}" for joint in chain.joints] + [", KDL::Joint::Fixed"]
        joints = [f"{{{row(f[:3, 3])}}}, {{{row(euler(f[:3, :3]))}}}{kind}" for f, kind in zip(frames, kinds)]
        bodies = [joint.body.moved(link) for joint, link in zip(chain.joints, places[1:])]
        links = [f"{number(b.mass)}, {{{row(b.com)}}}, {{{tensor_row(b.tensor)}}}" for b in bodies]
        about = comment(f"""{self.type} for KDL, written by scripts/robot-import from {self.source}: position, and roll, pitch and yaw of each joint
frame in the one before at q = 0, as they follow from the URDF.""")
        return f"""{about}
#include "tests/oracles/kdl_arm.hpp"

namespace tactus {{
namespace {{

constexpr int kJoints = {count};

struct Place {{
  double p[3], rpy[3];           // m, rad
  KDL::Joint::JointType joint;  // about or along z of this frame
}};

struct Link {{
  double mass, c[3], tensor[6];  // kg; m; kg m^2: xx yy zz xy xz yz
}};

// clang-format off
constexpr Place kPlaces[kJoints + 1] = {{
{rows_of(joints)}
}};

constexpr Link kLinks[kJoints] = {{
{rows_of(links)}
}};
// clang-format on

KDL::Frame place(int i) {{
  const Place& at = kPlaces[i];
  return {{KDL::Rotation::RPY(at.rpy[0], at.rpy[1], at.rpy[2]),
          KDL::Vector(at.p[0], at.p[1], at.p[2])}};
}}

}}  // namespace

/// A fixed segment first, and each inertia shifted to the far end of its segment.
KDL::Chain kdl_arm(const KDL::RigidBodyInertia& tool) {{
  KDL::Chain chain;
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), place(0)));
  for (int i = 0; i < kJoints; ++i) {{
    const Link& l = kLinks[i];
    const double* t = l.tensor;
    const KDL::RigidBodyInertia link(l.mass, KDL::Vector(l.c[0], l.c[1], l.c[2]),
                                     KDL::RotationalInertia(t[0], t[1], t[2], t[3], t[4], t[5]));
    KDL::RigidBodyInertia at_end = place(i + 1).Inverse() * link;
    if (i == kJoints - 1) at_end = at_end + tool;
    chain.addSegment(KDL::Segment(KDL::Joint(kPlaces[i].joint), place(i + 1), at_end));
  }}
  return chain;
}}

double kdl_along_axis(int) {{
  return 0.0;
}}

}}  // namespace tactus
"""

    def published(self, states, inertia, orientation, reach, stretched, capsules):
        """tests/oracles/published_NAME.cpp"""
        state = "\n".join(f"      {{{{{row(q)}}}, {{{row(p)}}}, {{{row(g)}}}}}," for q, p, g in states)
        shapes = "\n".join("      {%d, {{%s}, {%s}, %s, %s}}," % (link, row(0.5 * (a + b)), row(direction(a, b)), number(radius),
                                                                 number(np.linalg.norm(b - a))) for link, a, b, radius in capsules)
        turn = ", ".join(f"{{{row(line)}}}" for line in orientation[1])
        about = comment(f"""{self.type}: computed by scripts/robot-import from {self.source}, by Jacobians of the centres of mass and without the table
of the kernel.""")
        return f"""{about}
#include "tests/oracles/published.hpp"

namespace tactus {{

// clang-format off
const PublishedArm& published() {{
  static const PublishedArm numbers = {{
    {{
{state}
    }},
    {{{{{row(inertia[0])}}}, {{{row(inertia[1])}}}}},
    {{{{{row(orientation[0])}}}, {{{turn}}}}},
    {number(reach)},
    {{{row(stretched)}}},
    {{
{shapes}
    }},
  }};
  return numbers;
}}
// clang-format on

}}  // namespace tactus
"""

    def pipeline(self, rotor, kp, kd):
        """pipelines/NAME_jrg_pdgc.ini"""
        gains = [" ".join(f"{value:.3g}" for value in values) for values in (kp, kd)]
        prismatic = any(joint.prismatic for joint in self.chain.joints)
        of_kp, of_kd, of_rotor, of_q = ("N m/rad or N/m", "N m s/rad or N s/m", "kg m^2 or kg", "rad or m") if prismatic else (
            "N m/rad", "N m s/rad", "kg m^2", "rad")
        return f"""# JRG -> PD with gravity compensation -> {self.type}, torque, 1 kHz. Written by scripts/robot-import.
# Gains: about 3 Hz at every joint with its rotor and the most inertia of random positions, critically damped.

[robot]
name      = {self.name}
period_us = 1000
tau_c     = pd.tau

[plant]                             # simulated boards only
rotor_inertia = {rotor:g}                 # {of_rotor}, on every joint

[gateway]
trajectory = trajectories/{self.name}_five_waypoints.csv

[guard]
velocity_allowance = 0.09           # of the limit
position_allowance = 0.01           # {of_q}

[model]
type = robot_model
q    = robot.q
dq   = robot.dq
tool = robot.tool

[jrg]
type = joint_reference_generator
q    = robot.q                      # the reference at start: the measured position

[pd]
type = pd_gravity
q_d  = jrg.q_d
q    = robot.q
dq   = robot.dq
g    = model.g
kp   = {gains[0]}   # {of_kp}
kd   = {gains[1]}   # {of_kd}

[recorder]
signals  = robot.q robot.dq jrg.q_d jrg.dq_d pd.tau
tracking = jrg.q_d robot.q
"""

    def trajectory(self, times, q, dq):
        """pipelines/trajectories/NAME_five_waypoints.csv"""
        count = range(1, q.shape[1] + 1)
        units = [joint.unit for joint in self.chain.joints]
        head = ["time_s", *(f"q{i}_{unit}" for i, unit in zip(count, units)), *(f"dq{i}_{unit}_s" for i, unit in zip(count, units))]
        lines = [",".join(f"{value + 0.0:.6g}" for value in (time, *place, *speed)) for time, place, speed in zip(times, q, dq)]
        return f"# {self.type}, five waypoints from the home position back to it, on a cubic spline. Written by scripts/robot-import.\n" + \
            ",".join(head) + "\n" + "\n".join(lines) + "\n"

    def board(self):
        """boards/NAME_sim/board.mk and board.cpp"""
        return f"""# A simulated {self.type} in virtual time, on the host.
ROBOT  := {self.type}
SRCS   += boards/{self.name}_sim/board.cpp
PARTS  := $(SIM)
LDLIBS += -lmujoco

# What `make run` runs: pipeline, or pipeline:trajectory.
RUNS   += {self.name}_jrg_pdgc

TESTS  := $(ANY_ROBOT)
""", f"""// {self.name}_sim: a simulated {self.type} in virtual time.
#include "program/sim/sim_board.hpp"

int main(int argc, char** argv) {{
  return tactus::run_sim_board(argc, argv, "{self.name}_sim");
}}
"""
