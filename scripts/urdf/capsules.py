"""Capsules around the collision shapes of links."""

import importlib.machinery
import importlib.util
import math
import pathlib

import numpy as np
from scipy.optimize import minimize
from scipy.spatial import ConvexHull, QhullError

from errors import Refused
from reading import Shape, frame_of, mesh_path, numbers

RIM = 32  # points of a circle, on a polygon around it
LOOKS = 4000  # directions in which the residual is measured
LEAST_RADIUS = 1e-3  # m


def mesh_points():
    """Returns the function of scripts/hull that reads the points of a mesh, and its error."""
    path = str(pathlib.Path(__file__).resolve().parents[1] / "hull")
    loader = importlib.machinery.SourceFileLoader("hull", path)
    hull = importlib.util.module_from_spec(importlib.util.spec_from_loader("hull", loader))
    loader.exec_module(hull)
    return hull.points_of, hull.MeshError


def rim(radius, z):
    angle = 2.0 * math.pi * np.arange(RIM) / RIM
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), np.full(RIM, z)]) / [*2 * [math.cos(math.pi / RIM)], 1.0]


def mesh(document, element, where):
    points_of, error = mesh_points()
    path = mesh_path(document, element.get("filename", ""))
    try:
        points = points_of(path)
    except error as reason:
        raise Refused(f"{where}: {path}: {reason}") from reason
    if len(points) < 4 or not np.isfinite(points).all():
        raise Refused(f"{where}: {path}: {len(points)} points, or one that is not finite")
    points = points * numbers(element, "scale", (1, 1, 1), where)
    try:
        return points[ConvexHull(points).vertices]
    except QhullError as reason:
        raise Refused(f"{where}: {path}: its points are in one plane") from reason


def size_of(element, attribute, default, where):
    values = numbers(element, attribute, default, where)
    if not (values > 0.0).all():
        raise Refused(f"{where}: {attribute}=\"{element.get(attribute, '')}\"; it must be positive, or the shape removed")
    return values


def shape_of(document, geometry, where):
    """Returns the points of a shape in its own frame, the radius around them, and what it is."""
    sphere, cylinder, box, file = (geometry.find(kind) if geometry is not None else None for kind in ("sphere", "cylinder", "box", "mesh"))
    if sphere is not None:
        return np.zeros((1, 3)), size_of(sphere, "radius", (0,), where)[0], "sphere"
    if cylinder is not None:
        radius, half = size_of(cylinder, "radius", (0,), where)[0], 0.5 * size_of(cylinder, "length", (0,), where)[0]
        return np.vstack([rim(radius, -half), rim(radius, half)]), 0.0, "cylinder"
    if box is not None:
        corners = np.array(np.meshgrid(*3 * [[-0.5, 0.5]])).reshape(3, -1).T
        return corners * size_of(box, "size", (0, 0, 0), where), 0.0, "box"
    if file is not None:
        return mesh(document, file, where), 0.0, f"mesh {' '.join(file.get('filename').split())}"
    raise Refused(f"{where}: it has none of sphere, cylinder, box, mesh")


def shapes_of(document, link, frame):
    """Returns the collision shapes of a link, placed by a frame."""
    shapes = []
    for number, collision in enumerate(document.links[link].findall("collision"), 1):
        where = f"link {link}, collision {number}"
        points, radius, what = shape_of(document, collision.find("geometry"), where)
        place = frame @ frame_of(collision, where)
        shapes.append(Shape(points @ place[:3, :3].T + place[:3, 3], radius, f"{link}, {what}"))
    return shapes


def around(points, axis, centre):
    """Returns ends and radius of the shortest capsule along an axis through a centre that contains the points."""
    along = (points - centre) @ axis
    across = np.linalg.norm(points - centre - np.outer(along, axis), axis=1)
    radius = across.max()
    bulge = np.sqrt(radius * radius - across * across)
    low, high = (along + bulge).min(), (along - bulge).max()
    if low > high:
        low = high = 0.5 * (low + high)
        radius = np.sqrt(across * across + (along - low) ** 2).max()
    return centre + low * axis, centre + high * axis, radius


def volume(capsule, grown):
    a, b, radius = capsule
    return math.pi * (radius + grown)**2 * (np.linalg.norm(b - a) + 4.0 / 3.0 * (radius + grown))


def fitted(shape):
    """Returns the capsule of least volume that a search from the principal axes finds around a shape: a, b, radius."""
    points = shape.points
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))

    def capsule(x):
        axis = x[:3] / np.linalg.norm(x[:3])
        return around(points, axis, middle + x[3:] * scale)

    scale = max(np.ptp(points, axis=0).max(), LEAST_RADIUS)
    principal = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2] if len(points) > 2 else np.eye(3)
    best = None
    for axis in np.vstack([principal, np.eye(3)]):
        found = minimize(lambda x: volume(capsule(x), shape.radius) / scale**3, np.append(axis, np.zeros(3)), method="Nelder-Mead",
                         options={"maxfev": 1500, "xatol": 1e-5, "fatol": 1e-9})
        for x in (np.append(axis, np.zeros(3)), found.x):
            cost = volume(capsule(x), shape.radius)
            if best is None or cost < 0.999 * best[0]:
                best = cost, capsule(x)
    a, b, radius = best[1]
    return outward(points, shape.radius, np.round(a, 4) + 0.0, np.round(b, 4) + 0.0)


def outward(points, rounding, a, b):
    """Returns the capsule between rounded ends with the least radius, rounded up to 0.1 mm, that contains the shape."""
    way = b - a
    share = np.clip((points - a) @ way / max(way @ way, 1e-12), 0.0, 1.0)
    radius = np.linalg.norm(points - a - np.outer(share, way), axis=1).max() + rounding
    return a, b, max(math.ceil(round(1e4 * radius, 3)) / 1e4, LEAST_RADIUS)


def residual(shape, capsule):
    """Returns how far the capsule is beyond the hull of the shape at most, m: the largest difference of their support functions."""
    a, b, radius = capsule
    look = np.random.default_rng(1).normal(size=(LOOKS, 3))
    look /= np.linalg.norm(look, axis=1, keepdims=True)
    of_capsule = np.maximum(look @ a, look @ b) + radius
    return float((of_capsule - (look @ shape.points.T).max(axis=1) - shape.radius).max())
