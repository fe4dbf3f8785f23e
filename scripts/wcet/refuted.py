"""Compares what an image did, as events of the plugin, with the claims of its bound. Yields what a claim does not allow.

Every call has a frame: the functions that it has reached, how often each loop went back, and how often its own calls did
what a fact limits. A function that another one ends in by a jump has a frame too, which ends with that of the other.
"""

import array

CALL, RETURN = 1 << 30, 1 << 29


class Frame:
    def __init__(self, begin, site, jumped):
        self.begin, self.site, self.jumped = begin, site, jumped
        self.reached, self.last, self.backs, self.done = 0, None, {}, {}


class Claims:
    """`claims` as claims.py lists them."""

    def __init__(self, claims):
        self.names = {int(begin): name for begin, name in claims["functions"].items()}
        self.sites = {int(address): set(callees) for address, callees in claims["sites"].items()}
        self.sizes = {int(address): often for address, often in claims["sizes"].items()}
        self.assumed = {int(begin): most for begin, most in claims["assumed"].items()}
        self.loops, self.facts = claims["loops"], claims["facts"]
        self.enters, self.heads, self.reach, self.limits = {}, {}, {}, {}
        self.root = set(claims["root"])
        self.copying = {begin for address in self.sizes for begin in self.sites[address]}
        for n, loop in enumerate(self.loops):
            for address in loop["enter"]:
                self.enters.setdefault(address, []).append(n)
            for head, backs in loop["parts"]:
                self.heads.setdefault(head, []).append((n, set(backs)))
        for n, fact in enumerate(self.facts):
            for begin in fact["inner"] or fact["of"]:
                self.reach[begin] = self.reach.get(begin, 0) | 1 << n
            for begin in fact["in"]:
                self.limits.setdefault(begin, []).append((n, set(fact["of"]), fact["most"]))

    def marks(self):
        """Returns the addresses whose execution is an event."""
        backs = {address for loop in self.loops for _, found in loop["parts"] for address in found}
        return {*self.names, *self.enters, *self.heads, *backs}


class Replay:
    """`bad` collects complaints, each once."""

    def __init__(self, claims):
        self.claims, self.stack, self.bad, self.seen = claims, [], {}, set()

    def run(self, path):
        events, n = array.array("I"), 0
        with open(path, "rb") as file:
            events.frombytes(file.read())
        while n < len(events):
            event = events[n]
            n += 1
            if event & CALL:
                self.call(events[n], event - CALL)
                n += 2 if n + 1 < len(events) and events[n] == events[n + 1] and events[n] in self.claims.names else 1
                if self.stack:
                    self.mark(events[n - 1])
            elif event & RETURN:
                for _ in range(event - RETURN):
                    self.leave()
            elif self.stack:
                if event in self.claims.names and event != self.stack[-1].begin and event not in self.claims.heads:
                    self.enter(Frame(event, None, True))
                self.mark(event)
        return self.bad

    def call(self, begin, behind):
        if not self.stack and begin not in self.claims.root:
            return
        site = next((a for a in (behind - 4, behind - 2) if a in self.claims.sites), None)
        if site is not None and begin not in self.claims.sites[site]:
            self.complain(f"0x{site:x} calls 0x{begin:x} {self.claims.names.get(begin, '')}, which is not among its targets")
        self.enter(Frame(begin, site, False))

    def enter(self, frame):
        frame.reached = self.claims.reach.get(frame.begin, 0)
        self.seen.add(frame.begin)
        self.stack.append(frame)

    def leave(self):
        """Ends the last call, and with it the functions that it has jumped to."""
        jumped = True
        while jumped and self.stack:
            frame = self.stack.pop()
            jumped = frame.jumped
            if self.stack:
                self.stack[-1].reached |= frame.reached
                self.count(self.stack[-1], frame)

    def count(self, caller, frame):
        for n, callees, most in self.claims.limits.get(caller.begin, ()):
            if frame.begin in callees and frame.reached >> n & 1:
                caller.done[n] = caller.done.get(n, 0) + 1
                if caller.done[n] > most:
                    fact = self.claims.facts[n]["fact"]
                    self.complain(f"a call of {self.claims.names[caller.begin]} breaks the fact: {fact}")

    def mark(self, address):
        frame, claims = self.stack[-1], self.claims
        for n, backs in claims.heads.get(address, ()):
            if frame.last in backs:
                frame.backs[n] = frame.backs.get(n, 0) + 1
                self.back(frame, n)
        for n in claims.enters.get(address, ()):
            frame.backs[n] = 0
        frame.last = address

    def back(self, frame, n):
        loop, often = self.claims.loops[n], self.claims.loops[n]["often"]
        if frame.begin in self.claims.copying:
            often = self.claims.sizes.get(frame.site, often if frame.site else frame.backs[n])
        if frame.backs[n] > often:
            self.complain(f"{self.claims.names[frame.begin]}: a loop goes back more than {often} times: {loop['place']}")

    def took(self, begin, instructions):
        """Compares what the longest call of a function took with what is assumed of it."""
        if instructions > self.claims.assumed.get(begin, instructions):
            self.complain(f"{self.claims.names[begin]} takes {instructions} instructions, not {self.claims.assumed[begin]}")

    def complain(self, text):
        self.bad[text] = self.bad.get(text, 0) + 1
