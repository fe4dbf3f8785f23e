"""What a bound rests on, in addresses, so that a run of the image can refute it: how often loops go back, which functions a
call reaches, and the facts of facts.txt and of the pipeline file. scripts/wcet/refute reads them.
"""

import re

ROOT = r"^tactus::Executive::cycle\("  # nothing is claimed outside of it
FLOW = ("calls", "reaches")


def of(analysis, root=ROOT):
    """Returns the claims of an analysis of `root`, for JSON."""
    functions = {graph.function.begin: graph.function.written for graph in analysis.graphs.values()}
    sites = {
        address: [callee.begin for callee in analysis.callees(graph, address)]
        for graph in analysis.graphs.values()
        for address in graph.calls
    }
    called = {begin: analysis.image.function_at(begin) for found in sites.values() for begin in found}
    assumed = {begin: analysis.facts.assumed(f) for begin, f in called.items() if begin not in functions}
    functions |= {begin: called[begin].written for begin in assumed}
    matching = lambda pattern: [begin for begin, name in functions.items() if re.search(pattern, name)]
    return {
        "root": matching(root),
        "functions": functions,
        "loops": [
            _loop(analysis, begin, group, often) for begin, found in analysis.loop_claims.items() for group, often in found
        ],
        "facts": [
            {"fact": "  ".join(map(str, words)), "kind": words[0], "in": matching(words[1]), "of": matching(words[2]),
             "inner": matching(words[3]) if words[0] == "reaches" else [], "most": analysis.facts.number(words[-1])}
            for words in analysis.facts.facts
            if words[0] in FLOW
        ],
        "sites": sites,
        "sizes": analysis.sizes,
        "assumed": assumed,
    }  # fmt: skip


def _loop(analysis, begin, group, often):
    graph = analysis.graphs[begin]
    last = lambda heads: [graph.blocks[head].last for head in heads]
    return {
        "function": begin,
        "place": analysis.image.place(graph.blocks[group[0].back[0]].last),
        "often": often,
        "enter": last(p for p, _ in group[0].entering),
        "parts": [[part.head, last(part.back)] for part in group],
    }
