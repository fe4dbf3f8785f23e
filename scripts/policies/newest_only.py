"""The order of chunks."""


def newest_only(chunks):
    """Yields the chunks that are newer than all before."""
    newest = -1
    for chunk in chunks:
        if chunk.number > newest:
            newest = chunk.number
            yield chunk
