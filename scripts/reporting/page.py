"""The parts of report.html. The page is complete in itself and fetches nothing, which its policy also forbids."""

import base64
import html
import pathlib
import re
import string

STYLE = pathlib.Path(__file__).with_name("web") / "page.css"
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
ICON = '<link rel="icon" href="data:,">'  # or the browser asks for one

escape = html.escape


def rich(text):
    """Escapes a text and writes K_D as a letter with an index."""
    return re.sub(r"\b([A-Za-z])_([A-Za-z])\b", r"\1<sub>\2</sub>", escape(text))


def identifier(name):
    """Returns an identifier of the page that no other name has."""
    plain = {"_": "-", **{c: c for c in string.ascii_letters + string.digits}}
    return "run-" + "".join(plain.get(c, f".{ord(c):x}.") for c in name)


def table(headers, rows, text_columns):
    """Returns a table; the cells are HTML."""
    def line(tag, row):
        kinds = (' class="text"' if header in text_columns else "" for header in headers)
        return "".join(f"<{tag}{kind}>{cell}</{tag}>" for cell, kind in zip(row, kinds))

    body = "\n".join(f"<tr>{line('td', row)}</tr>" for row in rows)
    head = line("th", [escape(header) for header in headers])
    return f'<table class="numbers">\n<thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody>\n</table>'


def image(svg, words):
    """Embeds an SVG as an image of its own, so that its names do not clash with those of others."""
    data = base64.b64encode(svg.encode()).decode()
    return f'<img alt="{escape(words)}" src="data:image/svg+xml;base64,{data}">'


def figure(svg, caption):
    return f"<figure>{image(svg, caption)}<figcaption>{escape(caption)}</figcaption></figure>"


def numbered(text):
    """Numbers the figures that have a caption, from 1."""
    first, *pieces = text.split("<figcaption>")
    return first + "".join(f"<figcaption><b>Figure {i}.</b> {piece}" for i, piece in enumerate(pieces, 1))


def page(title, first, sections, scripts):
    """Returns the whole file; sections are (identifier, heading, body)."""
    bodies = [f'<section id="{i}"><h2>{escape(heading)}</h2>\n{body}</section>' for i, heading, body in sections]
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>\n'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">{ICON}\n'
        f'<meta name="viewport" content="width=device-width">\n'
        f'<style>{STYLE.read_text(encoding="utf-8")}</style></head>\n'
        f"<body><h1>{escape(title)}</h1>\n{first}\n{numbered(chr(10).join(bodies))}\n{scripts}</body></html>\n"
    )
