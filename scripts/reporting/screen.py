"""The output of a run as run_all kept it."""

from reporting import page, runs
from reporting.inputs import InputError


def is_of_this_run(path, folder):
    """Returns whether a file is not older than those that the run in the folder wrote itself."""
    own = [folder / file for file in runs.BEGUN]
    return path.exists() and all(path.stat().st_mtime >= file.stat().st_mtime for file in own if file.exists())


def screen(folder):
    """Returns the output of the run, which run_all writes after the run has ended."""
    path = folder / "output.txt"
    try:
        words = runs.read_text(path).strip() if is_of_this_run(path, folder) else ""
    except InputError as error:
        words = str(error)
    return f"<pre>{page.escape(words)}</pre>" if words else ""
