"""The result of a run in words, for a reader."""

import re

SKIPPED_FILE = "skipped.txt"  # why a run was skipped; left by run_all


def result_words(summary):
    """Returns the result of a run for a reader: "succeeded", or a Status in words and its code."""
    name, code = summary["result"]["name"], summary["result"]["code"]
    return f"{status_words(name)} ({code})" if re.match("k[A-Z]", name) else name


def status_words(name):
    """Returns the name of a Status in words."""
    return re.sub("(?=[A-Z])", " ", name[1:]).strip().lower()


def why(summary):
    """Returns ": " and why a goal was not reached, as the run said it; empty if it did not."""
    words = summary["result"].get("why")
    return f": {words}" if isinstance(words, str) else ""
