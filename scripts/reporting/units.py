"""Numbers with units, for a reader: three digits, and a prefix that keeps them short."""

import math

# (unit, smallest value that is written in it, factor)
PREFIXES = {
    "m": (("m", 1.0, 1), ("mm", 1e-3, 1e3), ("µm", 0.0, 1e6)),
    "rad": (("rad", 0.1, 1), ("mrad", 1e-4, 1e3), ("µrad", 0.0, 1e6)),
}


def digits(value):
    """Returns a number with three digits; whole numbers without a fraction."""
    if abs(value - round(value)) < 1e-9:
        return f"{value:.0f}"
    places = 2 - math.floor(math.log10(abs(value)))
    return f"{round(value, places):.{max(0, places)}f}" if 1e-3 <= abs(value) < 1e6 else f"{value:.2e}"


def words(value, unit):
    """Returns a value with its unit, or "not finite"."""
    if value is None or not math.isfinite(value):
        return "not finite"
    choices = PREFIXES.get(unit, ((unit, 0.0, 1),))
    name, _, factor = next(choice for choice in choices if abs(value) >= choice[1])
    return f"{digits(value * factor)} {name}" if value else f"0 {unit}"
