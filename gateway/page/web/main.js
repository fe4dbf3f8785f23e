// The page: gives what the server tells to its parts.

import { ArmView } from "./arm.js";
import { Link } from "./link.js";
import { Panel } from "./panel.js";
import { History, Plots } from "./plots.js";
import { Wires } from "./wires.js";

const by = (id) => document.getElementById(id);
const history = new History(), plots = new Plots(history), arm = new ArmView(by("arm"));
const wires = new Wires(by("wires"), by("reading"));
let panel = null;

function found() {
  by("lost").hidden = true;
  document.body.classList.remove("lost");
}

const hear = {
  describe(robot) {
    for (const part of [panel, arm, plots, wires]) part.describe(robot);
  },
  state(state) {
    found();
    history.add(state);
    arm.show(state);
    panel.state(state);
  },
  ports: (ports) => wires.show(ports),
  answer: (answer) => panel.answer(answer),
  report: (report) => panel.report(report),
  event: (event) => panel.event(event),
  lost(text) {
    by("lost").textContent = text;
    by("lost").hidden = false;
    document.body.classList.add("lost");
  },
};

const link = new Link(hear);
panel = new Panel(link);
