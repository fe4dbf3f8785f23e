"""Reading a file that others wrote."""

import re
import stat


class InputError(Exception):
    """A file cannot be used; the message says why."""


def shown(text):
    """Returns a text that can be written; a byte of a name that is not UTF-8 becomes a replacement character."""
    return re.sub("[\ud800-\udfff]", "\ufffd", text)


def read_text(path):
    """Returns the text of a regular file: a FIFO or a device could keep the reader waiting for ever."""
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise InputError(f"{path}: not a regular file")
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: not a text file") from error
