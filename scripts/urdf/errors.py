"""What the import of a robot refuses."""


class Refused(Exception):
    """What cannot be represented or is missing: where, why, and the remedy."""
