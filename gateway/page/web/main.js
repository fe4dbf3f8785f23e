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

const COMMANDS = [["q_c", "q_d"], ["dq_c", "dq_d"], ["tau_c", "tau_d"]];
let inputs = [];  // of the robot
let values = [];  // of all outputs, the newest

/** Where the pipeline has no reference of the joints, what it commands counts as desired. Nothing is, of drives that are not commanded. */
function addDesired(state) {
  state.commanded = !["disabled", "arming"].includes(state.rung);
  if (!state.commanded) return Object.assign(state, { q_d: [], dq_d: [], tau_d: [], pose_d: [] });
  for (const [command, desired] of COMMANDS) {
    const input = inputs.find(({ port }) => port === command);
    if (input && !(state[desired] || []).length) state[desired] = values[input.from] || [];
    state[desired] = state[desired] || [];
  }
}

const hear = {
  describe(robot) {
    inputs = robot.blocks[robot.blocks.length - 1].inputs;
    values = [];
    for (const part of [panel, arm, plots, wires]) part.describe(robot);
  },
  state(state) {
    found();
    addDesired(state);
    history.add(state);
    arm.show(state);
    wires.commanded(state.commanded);
    panel.state(state);
  },
  ports(ports) {
    values = ports.values;
    wires.show(ports);
  },
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
