"""Reading a file that others wrote."""


class InputError(Exception):
    """A file cannot be used; the message says why."""


def read_text(path):
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: not a text file") from error
