"""Which capsules touch by construction, which can never meet, and a home pose clear of all others."""

import itertools

import numpy as np

from errors import Refused
from mechanics import gravity_and_mass, tip_jacobian
from reading import turn

SAMPLES, TOUCHING = 4000, 0.15  # of random positions
BEYOND, NEVER = 0.05, 0.0101  # rad or m beyond the limits; m
MOST_REGIONS = 40000  # of a proof
TOOL = 0.1, 0.02  # length and radius of the tool that the tests assume, m
HOMES, CLEAR, INSIDE = 3000, (0.1, 0.05, 0.022, 0.012), 0.25  # candidates; m between capsules, the most that enough have; rad from the limits, at most a quarter of the range
TURN, HELD = 1.5, 0.7  # rad: where a candidate is sought; of the effort, at most, against its weight


def frames_of(table, q, first=0, last=None):
    """Returns rotations [n, 3, 3] and origins [n, 3] of the links `first` to `last` in link `first`, at positions q [n, joints]."""
    count = len(q)
    frames = [(np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3)))]
    for i in range(first, len(table.rows) if last is None else last):
        row, (rotation, origin) = table.rows[i], frames[-1]
        angle = row.turn + (0.0 if row.prismatic else q[:, i])
        c, s = np.cos(angle), np.sin(angle)
        about_z = np.zeros((count, 3, 3))
        about_z[:, 0, 0], about_z[:, 0, 1], about_z[:, 1, 0], about_z[:, 1, 1], about_z[:, 2, 2] = c, -s, s, c, 1.0
        frames.append((rotation @ row.rolled() @ about_z, origin + rotation @ row.offset))
        if row.prismatic:
            rotation, origin = frames[-1]
            frames[-1] = rotation, origin + rotation[:, :, 2] * q[:, i:i + 1]
    return frames


def segment_distance(p, p_end, q, q_end):
    """Returns the distances of segments [n, 3]: the least of the inner solution, if there is one, and of the ends."""
    u, v, w = p_end - p, q_end - q, p - q
    a, b, c, d, e = ((u * u).sum(1), (u * v).sum(1), (v * v).sum(1), (u * w).sum(1), (v * w).sum(1))
    least = np.full(len(p), np.inf)
    for point, start, way in ((p, q, v), (p_end, q, v), (q, p, u), (q_end, p, u)):
        share = np.clip(((point - start) * way).sum(1) / np.maximum((way * way).sum(1), 1e-15), 0.0, 1.0)
        least = np.minimum(least, np.linalg.norm(start + share[:, None] * way - point, axis=1))
    det = a * c - b * b
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = (b * e - c * d) / det, (a * e - b * d) / det
        inner = (det > 1e-12) & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
        across = np.linalg.norm(w + s[:, None] * u - t[:, None] * v, axis=1)
    return np.where(inner, np.minimum(least, across), least)


def distances(one, other, frames, first=0):
    """Returns the distances of two capsules, each (link, a, b, radius); `frames` begin with link `first`."""
    ends = []
    for link, a, b, _ in (one, other):
        rotation, origin = frames[link - first]
        ends += [origin + rotation @ a, origin + rotation @ b]
    return segment_distance(*ends) - one[3] - other[3]


def positions(chain, count, seed=7):
    low, high = (np.array([joint.limits[key] for joint in chain.joints]) for key in ("lower", "upper"))
    return np.random.default_rng(seed).uniform(low, high, (count, len(low)))


def tool_capsule(table):
    """Returns the capsule of the tests' tool, as one of the last link."""
    flange, last = table.flange.matrix(), len(table.rows)
    return last + 1, flange[:3, 3], flange[:3, 3] + TOOL[0] * flange[:3, 2], TOOL[1]


def not_neighbours(chain, capsules, table):
    """Returns the pairs of links that are no neighbours, the tool behind the last, with their capsules."""
    all_of = capsules + [tool_capsule(table)]
    for first, second in itertools.combinations(range(len(chain.joints) + 2), 2):
        if second - first > 1:
            ones, others = ([c for c in all_of if c[0] == link] for link in (first, second))
            if ones and others:
                yield first, second, ones, others


def with_tool(frames):
    return frames + [frames[-1]]


def gaps(chain, table, capsules, q):
    """Returns the pairs of links that are no neighbours, the tool behind the last, with their distances at positions q [n, joints]."""
    frames = with_tool(frames_of(table, q))
    return {(first, second): np.min([distances(one, other, frames) for one in ones for other in others], axis=0)
            for first, second, ones, others in not_neighbours(chain, capsules, table)}


def touching(chain, table, capsules):
    """Returns the pairs of links that touch in a good share of all positions, and that share."""
    shares = {pair: float((gap <= 0.0).mean()) for pair, gap in gaps(chain, table, capsules, positions(chain, SAMPLES)).items()}
    return {pair: share for pair, share in shares.items() if share > TOUCHING}


def never_meet(chain, table, one, other):
    """True if a proof by branch and bound over the joints between two capsules shows that they stay apart."""
    joints = range(one[0], other[0])
    own = max(np.linalg.norm(other[1]), np.linalg.norm(other[2])) + other[3]
    low, high = (np.array([chain.joints[i].limits[key] for i in joints]) for key in ("lower", "upper"))
    links = [np.linalg.norm(table.rows[i].offset) + table.rows[i].prismatic * (max(-a, b) + BEYOND) for i, a, b in zip(joints, low, high)]
    reach = np.array([1.0 if table.rows[i].prismatic else own + sum(links[k + 1:]) for k, i in enumerate(joints)])
    middle, half = np.array([0.5 * (low + high)]), np.array([0.5 * (high - low) + BEYOND])
    regions = 0
    while len(middle):
        regions += len(middle)
        if regions > MOST_REGIONS:
            return False
        q = np.zeros((len(middle), other[0]))
        q[:, one[0]:] = middle
        apart = distances(one, other, frames_of(table, q, one[0], other[0]), one[0])
        if not (apart > NEVER).all():
            return False
        left = apart <= NEVER + half @ reach
        middle, half = middle[left], half[left]
        rows, widest = np.arange(len(middle)), (half * reach).argmax(axis=1)
        half[rows, widest] *= 0.5
        step = np.zeros_like(half)
        step[rows, widest] = half[rows, widest]
        middle, half = np.vstack([middle - step, middle + step]), np.vstack([half, half])
    return True


def never(chain, table, capsules, listed):
    """Returns the pairs of capsules, by number, that can never meet."""
    frames = frames_of(table, positions(chain, SAMPLES))
    found = []
    for first, second in itertools.combinations(range(len(capsules)), 2):
        one, other = capsules[first], capsules[second]
        if other[0] - one[0] < 2 or (one[0], other[0]) in listed or distances(one, other, frames).min() <= NEVER:
            continue
        if never_meet(chain, table, one, other):
            found.append((first, second))
    return found


def clearance(chain, table, capsules, listed, q):
    """Returns the least distance of the pairs that are checked, at positions q [n, joints]."""
    near = [gap for pair, gap in gaps(chain, table, capsules, q).items() if pair not in listed]
    return np.min(near, axis=0) if near else np.full(len(q), np.inf)


def lowest(table, capsules, q):
    """Returns the height of the lowest point of the links that move, and of the tool, above the base."""
    frames = with_tool(frames_of(table, q))
    heights = [frames[link][0][:, 2] @ end + frames[link][1][:, 2] - radius
               for link, *ends, radius in capsules + [tool_capsule(table)] if link > 0 for end in ends]
    return np.min(heights, axis=0)


def home_pose(chain, table, capsules, listed):
    """Returns positions clear of limits and collisions, above the base if there are such, at which the tip moves well in every direction."""
    low, high = (np.array([joint.limits[key] for joint in chain.joints]) for key in ("lower", "upper"))
    inside = np.minimum(INSIDE, 0.25 * (high - low))
    near_zero = np.clip(0.0, low + inside, high - inside)
    q = np.random.default_rng(3).uniform(np.maximum(low + inside, near_zero - TURN), np.minimum(high - inside, near_zero + TURN),
                                         (HOMES, len(low))).round(2).clip(low + 0.5 * inside, high - 0.5 * inside)
    apart, above = clearance(chain, table, capsules, listed, q), lowest(table, capsules, q)
    rows = [np.minimum(apart, above) > clear for clear in CLEAR] + [apart > clear for clear in CLEAR]
    if not rows[-1].any():
        gap, pair = min((gap.max(), pair) for pair, gap in gaps(chain, table, capsules, q).items() if pair not in listed)
        raise Refused(f"no home pose is clear of collisions: {' and '.join(chain.names[link] for link in pair)} are at most {1e3 * gap:.1f} mm apart"
                      f" where more than {1e3 * CLEAR[-1]:g} are sought; make their collision shapes smaller, or give a home pose by --srdf")
    q = q[next((row for row in rows if row.sum() > HOMES // 100), rows[-1])]

    def dexterity(position):
        return np.linalg.svd(tip_jacobian(chain, position), compute_uv=False)[min(5, len(low) - 1)]

    load = np.abs([gravity_and_mass(chain, one)[0] for one in q]) / [joint.limits["effort"] for joint in chain.joints]
    least = load[load.max(axis=1).argmin()]
    if least.max() >= HELD:
        name = chain.joints[least.argmax()].name
        raise Refused(f"no home pose can be held: at best the weight takes {100 * least.max():.0f} % of the effort of joint {name}, where less than"
                      f" {100 * HELD:.0f} % is sought; correct the <inertial> of what it carries, or give --limit {name}.effort=VALUE")
    return max(q[load.max(axis=1) < HELD], key=dexterity)
