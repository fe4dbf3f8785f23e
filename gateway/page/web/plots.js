// Plots of the last 10 s: measured and desired, the limits where they are in the picture, and a band while no drive is commanded.

const SPAN_S = 10, TICK_S = 5;
const MOST = 400;  // states

/** The numbers of the states, oldest first. */
export class History {
  constructor() { this.states = []; }

  add(state) {
    const last = this.states[this.states.length - 1];
    if (last && state.since_s < last.since_s) this.states = [];  // another server
    this.states.push(state);
    const from = state.since_s - SPAN_S - 1;
    while (this.states.length > MOST || this.states[0].since_s < from) this.states.shift();
  }
}

function style(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** One plot; `pick(state)` gives [measured, desired], undefined where there is none. */
class Plot {
  constructor(place) {
    this.figure = document.createElement("figure");
    this.figure.innerHTML = "<figcaption><span></span><output></output></figcaption><canvas></canvas>";
    [this.title, this.value, this.canvas] = ["span", "output", "canvas"].map((tag) => this.figure.querySelector(tag));
    this.canvas.setAttribute("role", "img");
    place.append(this.figure);
  }

  set(title, unit, pick, limits = []) {
    Object.assign(this, { unit, pick, limits });
    this.title.textContent = title;
    this.canvas.setAttribute("aria-label", `${title}, last ${SPAN_S} s, ${unit || "no unit"}`);
  }

  /** The range of the values, wide enough that noise is not all there is to see. */
  range(points) {
    let low = Infinity, high = -Infinity;
    for (const pair of points) for (const y of pair) if (Number.isFinite(y)) { low = Math.min(low, y); high = Math.max(high, y); }
    if (low > high) return [-1, 1];
    const least = this.unit[0] === "N" ? 5 : 0.05, middle = (low + high) / 2, half = Math.max(high - low, least) * 0.6;
    return [middle - half, middle + half];
  }

  draw(states, colours) {
    const scale = devicePixelRatio || 1, { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0) return;
    this.canvas.width = width * scale;
    this.canvas.height = height * scale;
    const to = this.canvas.getContext("2d"), points = states.map(this.pick);
    to.scale(scale, scale);
    const [low, high] = this.range(points), end = states.length ? states[states.length - 1].since_s : 0;
    const x = (s) => width - (end - s) / SPAN_S * width, y = (v) => 4 + (high - v) / (high - low) * (height - 20);
    this.bands(to, states, x, height, colours);
    this.times(to, end, x, height, colours);
    this.axes(to, { low, high, width, y }, colours);
    for (const [which, dash] of [[1, [5, 3]], [0, []]]) {
      to.strokeStyle = which ? colours.desired : colours.measured;
      to.lineWidth = which ? 2 : 1.4;
      to.setLineDash(dash);
      this.curve(to, points.map((pair, i) => [x(states[i].since_s), y(pair[which])]));
    }
    const last = points.length ? points[points.length - 1][0] : undefined;
    this.value.textContent = Number.isFinite(last) ? `${last.toFixed(3)} ${this.unit}` : "–";
  }

  /** A curve ends where there is no value, and begins anew behind it. */
  curve(to, points) {
    let draws = false;
    to.beginPath();
    for (const [x, y] of points) {
      if (Number.isFinite(y)) draws ? to.lineTo(x, y) : to.moveTo(x, y);
      draws = Number.isFinite(y);
    }
    to.stroke();
  }

  /** Where the drives are not commanded. */
  bands(to, states, x, height, colours) {
    to.font = "10px sans-serif";
    states.forEach(({ commanded, since_s }, i) => {
      if (commanded) return;
      to.fillStyle = colours.line;
      to.fillRect(x(since_s), 0, x(states[i + 1]?.since_s ?? since_s) - x(since_s) + 1, height);
    });
    const first = states.findIndex(({ commanded, since_s }) => !commanded && x(since_s) >= 0);
    to.fillStyle = colours.ink;
    if (first >= 0) to.fillText("drives disabled", x(states[first].since_s) + 2, 10);
  }

  /** The time since the server began, as in the list of events. */
  times(to, end, x, height, colours) {
    to.fillStyle = to.strokeStyle = colours.quiet;
    to.lineWidth = 0.5;
    to.setLineDash([]);
    for (let s = Math.max(0, Math.ceil((end - SPAN_S) / TICK_S)) * TICK_S; s <= end; s += TICK_S) {
      to.beginPath();
      to.moveTo(x(s), 0);
      to.lineTo(x(s), height);
      to.stroke();
      to.fillText(`${s} s`, x(s) + 2, height - 2);
    }
  }

  axes(to, { low, high, width, y }, colours) {
    to.font = "10px sans-serif";
    to.fillStyle = to.strokeStyle = colours.quiet;
    to.lineWidth = 0.5;
    to.setLineDash([]);
    const digits = high - low < 0.1 ? 3 : high - low < 20 ? 2 : 0;
    for (const value of [low + (high - low) * 0.08, (low + high) / 2, high - (high - low) * 0.08]) {
      to.beginPath();
      to.moveTo(0, y(value));
      to.lineTo(width, y(value));
      to.stroke();
      to.fillText(value.toFixed(digits), 2, y(value) - 2);
    }
    to.strokeStyle = to.fillStyle = colours.limit;
    to.setLineDash([8, 3]);
    to.lineWidth = 1.2;
    for (const limit of this.limits) {
      if (limit <= low || limit >= high) continue;
      to.beginPath();
      to.moveTo(0, y(limit));
      to.lineTo(width, y(limit));
      to.stroke();
    }
    if (this.limits.length) {
      const text = `limits ${this.limits.map((l) => l.toFixed(2)).join(" … ")}`;
      to.fillText(text, width - to.measureText(text).width - 2, 10);
    }
  }
}

const JOINT = {
  q: { desired: "q_d", unit: "rad", limits: (joint) => [joint.min, joint.max] },
  dq: { desired: "dq_d", unit: "rad/s", limits: (joint) => [-joint.velocity, joint.velocity] },
  tau: { desired: "tau_d", unit: "N m", limits: (joint) => [-joint.effort, joint.effort] },
};
const OF_PRISMATIC = { rad: "m", "rad/s": "m/s", "N m": "N" };
const POSE = [["x", "m"], ["y", "m"], ["z", "m"], ["qw", ""], ["qx", ""], ["qy", ""], ["qz", ""]];

/** All plots of the page. */
export class Plots {
  constructor(history) {
    this.history = history;
    document.getElementById("quantity").addEventListener("change", () => this.choose());
    this.joints = this.pose = [];
    setInterval(() => this.draw(), 100);
  }

  describe(robot) {
    this.robot = robot;
    const fresh = (section, count) => {
      const place = document.querySelector(`#${section} .plots`);
      place.replaceChildren();
      return Array.from({ length: count }, () => new Plot(place));
    };
    this.history.states = [];
    this.joints = fresh("joints", robot.joints.length);
    this.pose = fresh("pose", POSE.length);
    POSE.forEach(([name, unit], i) => this.pose[i].set(name, unit, (s) => [s.pose[i], s.pose_d[i]]));
    this.choose();
  }

  choose() {
    const key = document.querySelector("#quantity :checked").value, { desired, unit, limits } = JOINT[key];
    this.robot.joints.forEach((joint, i) => {
      const own = this.robot.frames[i][5] ? OF_PRISMATIC[unit] : unit;
      this.joints[i].set(`${i + 1} ${joint.name}`, own, (s) => [s[key][i], s[desired][i]], limits(joint));
    });
  }

  draw() {
    if (document.hidden) return;
    const { states } = this.history;
    const colours = Object.fromEntries(["measured", "desired", "limit", "quiet", "line", "ink"].map((name) => [name, style("--" + name)]));
    document.getElementById("pose").hidden = states.length > 0 && states[states.length - 1].pose.length === 0;
    for (const plot of [...this.joints, ...this.pose]) plot.draw(states, colours);
  }
}
