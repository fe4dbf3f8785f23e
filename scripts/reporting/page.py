"""The parts of report.html. The page is complete in itself: it fetches nothing and runs nothing."""

import base64
import html

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, "Liberation Sans", Arial, sans-serif; color: #1c1c1c; background: #fff;
       max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.3rem; margin-top: 3rem; border-bottom: 1px solid #ccc; }
h3 { font-size: 1rem; margin: 1.5rem 0 0.3rem; }
a { color: #1f4e79; }
p { max-width: 46rem; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; margin: 0.7rem 0; }
th, td { padding: 0.15rem 0.6rem; text-align: right; border-bottom: 1px solid #e4e4e4; white-space: nowrap; }
th { border-bottom: 1px solid #888; } .text { text-align: left; } tr.failed td { background: #fdeceb; }
figure { margin: 1rem 0; } img { width: 100%; height: auto; }
figcaption, .note { font-size: 0.85rem; color: #444; }
pre { background: #f6f6f6; padding: 0.6rem; font-size: 0.8rem; white-space: pre-wrap; }
.failure { border-left: 4px solid #c0392b; padding-left: 0.8rem; }
.wide { overflow-x: auto; }
@media print {
  @page { size: A4; margin: 15mm; }
  body { font-size: 10pt; max-width: none; margin: 0; padding: 0; }
  a { color: inherit; text-decoration: none; }
  h2 { break-before: page; } h2, h3 { break-after: avoid; }
  figure, table, .failure { break-inside: avoid; } .wide { overflow: visible; }
  .wide table { font-size: 7pt; } .wide th, .wide td { padding: 0.1rem 0.3rem; }
}
"""

escape = html.escape


def identifier(name):
    return "run-" + "".join(c if c.isalnum() else "-" for c in name)


def table(headers, rows, text_columns, failed=()):
    """Returns a table; `failed` holds the indices of the rows to mark."""
    def line(tag, row):
        kinds = (' class="text"' if header in text_columns else "" for header in headers)
        return "".join(f"<{tag}{kind}>{cell}</{tag}>" for cell, kind in zip(row, kinds))

    marks = (' class="failed"' if i in failed else "" for i in range(len(rows)))
    body = "\n".join(f"<tr{m}>{line('td', row)}</tr>" for m, row in zip(marks, rows))
    head = line("th", [escape(header) for header in headers])
    return f'<div class="wide"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody>\n</table></div>'


def figure(svg, caption):
    """Embeds an SVG as an image of its own, so that its names do not clash with those of others."""
    data = base64.b64encode(svg.encode()).decode()
    words = escape(caption)
    return (
        f'<figure><img alt="{words}" src="data:image/svg+xml;base64,{data}">'
        f"<figcaption>{words}</figcaption></figure>"
    )


def numbered(parts):
    """Numbers the figures of all sections, from 1."""
    pieces = "\n".join(parts).split("<figcaption>")
    text = pieces[0]
    for number, piece in enumerate(pieces[1:], 1):
        text += f"<figcaption><b>Figure {number}.</b> {piece}"
    return text


def page(title, sections):
    """Returns the whole file; sections are (identifier, heading, body)."""
    contents = "\n".join(f'<li><a href="#{i}">{escape(heading)}</a></li>' for i, heading, _ in sections)
    bodies = [f'<section id="{i}"><h2>{escape(heading)}</h2>\n{body}</section>' for i, heading, body in sections]
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>\n'
        f'<meta name="viewport" content="width=device-width"><style>{STYLE}</style></head>\n'
        f"<body><h1>{escape(title)}</h1>\n<nav><ol>\n{contents}\n</ol></nav>\n{numbered(bodies)}\n</body></html>\n"
    )
