// The state in words and numbers, the events, and the controls.

const MOST_EVENTS = 100;
const MOST_ASKED = 200, MOST_EARLY = 50;
const QUIET_MS = 700;  // after the slider was moved, it follows the robot again

// Name, text, and what it means to the reader.
const NUMBERS = [
  ["Time", (s) => `${s.since_s.toFixed(1)} s`, "Since the server began; the time of events and plots."],
  ["Owner", (s) => s.owner || "nobody", "The client that may move the arm."],
  ["Override", (s) => `${(s.override * 100).toFixed(0)} %`, "Speed of trajectories, of the planned one."],
  ["Robot's speed", (s) => `${(s.speed_scaling * 100).toFixed(0)} %`, "What the robot's own controller makes of it; 100 % of one that makes nothing."],
  ["Stream margin", (s) => `${s.margin_s.toFixed(3)} s`, "Until the targets of a stream run out and the arm comes to rest; 0 without a stream."],
  ["Starved", (s) => times(s.starved), "The arm came to rest because no target of a stream followed: its client is too slow."],
  ["Late chunks", (s) => times(s.late), "All targets of a chunk were past when it came, and it had no effect: its client or network is too slow."],
  ["Slips", (s) => times(s.slips), "Periods in which no cycle began: this computer was busy. Several in a row brake the arm."],
  ["Overruns", (s) => times(s.overruns), "Cycles longer than the period: this computer was busy. Many of them brake the arm."],
  ["Epoch", (s) => s.epoch, "Number of cancels, stops, takeovers and brakes, from 1: what was sent for an older epoch is void. No fault."],
];

function times(count) { return count === 1 ? "once" : `${count} times`; }

function by(id) { return document.getElementById(id); }

export class Panel {
  constructor(link) {
    this.link = link;
    this.moved = -Infinity;
    this.asked = new Map();  // number of a message -> the command that it belongs to
    this.early = [];
    this.cells = NUMBERS.map(([name, , meaning]) => {
      const [term, cell] = [document.createElement("dt"), document.createElement("dd")];
      term.textContent = name;
      term.title = cell.title = meaning;
      by("numbers").append(term, cell);
      return cell;
    });
    by("stop").addEventListener("click", () => this.command("stop"));
    document.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || event.repeat) return;
      event.preventDefault();
      this.command("stop");
    });
    for (const button of document.querySelectorAll("[data-command]"))
      button.addEventListener("click", () => this.command(button.dataset.command));
    this.takeSlider();
  }

  /** While the slider moves, its newest value is sent ten times a second, one after the other. */
  takeSlider() {
    const slider = by("override");
    let waits = false, wish = null;
    const send = async () => {
      const value = wish;
      wish = null;
      await this.command("override", String(value / 100));
      waits = wish !== null;
      if (waits) setTimeout(send, 100);
    };
    slider.addEventListener("input", () => {
      this.moved = performance.now();
      by("override_value").textContent = `${slider.value} %`;
      wish = slider.value;
      if (waits) return;
      waits = true;
      setTimeout(send, 100);
    });
  }

  async command(name, body) {
    this.say(`${name}: sending`, false);
    try {
      const { number } = await this.link.send(name, body);
      this.asked.set(number, { name, number });
      while (this.asked.size > MOST_ASKED) this.asked.delete(this.asked.keys().next().value);
      this.newest = number;
      this.say(`${name}: sent`, false);
      this.early.splice(0).forEach(([kind, message]) => this[kind](message));
    } catch (error) {
      this.say(`${name}: ${error.message}`, true);
    }
  }

  /** The newest command that a message is about; one that comes before its number is known waits. */
  about(kind, message) {
    const asked = this.asked.get(message.number);
    if (asked) return asked.number === this.newest ? asked : null;
    if (message.number < this.newest) return null;  // of the lease, or of another browser
    this.early.push([kind, message]);
    if (this.early.length > MOST_EARLY) this.early.shift();
    return null;
  }

  say(text, refused) {
    by("answer").textContent = text;
    by("answer").classList.toggle("refused", refused);
  }

  answer(message) {
    const asked = this.about("answer", message);
    if (!asked) return;
    if (message.status === 0) return this.say(`${asked.name}: taken`, false);
    this.say(`${asked.name}: refused: ${message.text} (${message.status})`, true);
  }

  report(message) {
    const asked = this.about("report", message), { outcome, text, status } = message;
    if (!asked) return;
    this.say(`${asked.name}: ${outcome}${text ? ": " + text : ""}${status ? ` (${status})` : ""}`, outcome === "refused");
  }

  state(state) {
    const rung = by("rung");
    rung.textContent = state.rung.replace("_", " ");
    rung.className = { nominal: "good", skip_optional: "warn", arming: "warn" }[state.rung] || "bad";
    by("phase").textContent = state.phase;
    by("why").textContent = state.why;
    NUMBERS.forEach(([, text], i) => { this.cells[i].textContent = text(state); });
    if (performance.now() - this.moved < QUIET_MS) return;
    by("override").value = Math.round(state.override * 100);
    by("override_value").textContent = `${Math.round(state.override * 100)} %`;
  }

  /** Leaves out the leases that commands of pages take for a moment. Of an override that slides, the last counts. */
  event({ name, text, since_s }) {
    if (name === "lease" && text.startsWith("page ")) return;
    const what = text.replace(/ to \S+ %$/, ""), newest = by("events").firstChild;
    if (what !== text && newest?.dataset.what === what) newest.remove();
    const item = document.createElement("li"), time = document.createElement("time");
    time.textContent = `${since_s.toFixed(1)} s`;
    item.dataset.what = what;
    item.append(time, `${name}: ${text}`);
    by("events").prepend(item);
    while (by("events").children.length > MOST_EVENTS) by("events").lastChild.remove();
  }

  describe(robot) {
    this.asked.clear();
    this.newest = undefined;
    by("subject").textContent = `${robot.robot} on ${robot.board}, ${robot.pipeline}${robot.simulated ? ", simulated" : ""}`;
    by("tare").hidden = robot.blocks.filter(({ type }) => type === "wrench_front_end").length !== 1;
    document.title = `${robot.robot} – Tactus`;
  }
}
