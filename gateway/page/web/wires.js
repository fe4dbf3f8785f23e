// The pipeline as a picture: a box for each block, a line for each wire, and the values of its outputs.

const BOX = 222, GAP = 62, ROW = 17, HEAD = 36, SPACE = 22;
const SHOWN = 3;  // numbers beside an output

function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** Returns the column of each block: behind every earlier block that it reads. */
function columns(blocks, maker) {
  const column = blocks.map(() => 0);
  blocks.forEach((block, i) => {
    for (const { from } of block.inputs) {
      const source = maker.get(from);
      if (source !== undefined && source < i) column[i] = Math.max(column[i], column[source] + 1);
    }
    if (i > 0) column[i] = Math.max(column[i], 1);
  });
  column[column.length - 1] = Math.max(...column.slice(0, -1)) + 1;
  return column;
}

function label(value) {
  if (Math.abs(value) >= 1000) return value.toFixed(0);
  return Math.abs(value) >= 100 ? value.toFixed(1) : value.toFixed(2);
}

export class Wires {
  constructor(svg, reading) {
    this.svg = svg;
    [this.name, this.numbers] = [reading.querySelector("b"), reading.querySelector("span")];
    this.values = [];
  }

  describe(robot) {
    const { blocks } = robot, maker = new Map();
    this.svg.replaceChildren();
    this.outputs = new Map();
    this.paths = [];
    blocks.forEach((block, i) => { for (const output of block.outputs) maker.set(output.number, i); });
    const column = columns(blocks, maker), below = [];
    this.ends = new Map();
    const boxes = blocks.map((block, i) => {
      const x = 10 + column[i] * (BOX + GAP), y = below[column[i]] || 10;
      const height = HEAD + ROW * Math.max(block.inputs.length, block.outputs.length) + 6;
      below[column[i]] = y + height + SPACE;
      return { x, y, height };
    });
    const width = 20 + (Math.max(...column) + 1) * (BOX + GAP) - GAP, height = Math.max(...below.filter(Boolean));
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    Object.assign(this.svg.style, { width: "100%", minWidth: `${0.75 * width}px`, maxWidth: `${width}px` });
    blocks.forEach((block, i) => this.placeOutputs(block, boxes[i]));
    blocks.forEach((block, i) => this.drawWires(block, boxes[i]));
    blocks.forEach((block, i) => this.drawBlock(block, boxes[i]));
    const command = blocks[blocks.length - 1].inputs[0];
    if (command) this.choose(command.from);
  }

  placeOutputs(block, { x, y }) {
    block.outputs.forEach((output, row) => this.ends.set(output.number, [x + BOX, y + HEAD + ROW * row + 8]));
  }

  drawWires(block, { x, y }) {
    block.inputs.forEach(({ from }, row) => {
      const start = this.ends.get(from);
      if (!start) return;
      const [x1, y1] = start, y2 = y + HEAD + ROW * row + 8, bend = Math.max(40, Math.abs(x - x1) * 0.45);
      const path = element("path", { d: `M${x1},${y1} C${x1 + bend},${y1} ${x - bend},${y2} ${x},${y2}`, "data-from": from });
      this.paths.push(path);
      this.svg.append(path);
    });
  }

  drawBlock(block, { x, y, height }) {
    this.svg.append(element("rect", { x, y, width: BOX, height, rx: 5 }));
    this.svg.append(element("text", { x: x + 8, y: y + 15, "font-weight": 700 }, block.name));
    this.robot = element("text", { x: x + 8, y: y + 28, class: "type" }, block.type);
    this.robotType = block.type;
    this.svg.append(this.robot);
    block.inputs.forEach(({ port }, row) => {
      this.svg.append(element("text", { x: x + 5, y: y + HEAD + ROW * row + 12 }, port));
    });
    block.outputs.forEach((output, row) => this.drawOutput(block, output, x, y + HEAD + ROW * row + 12));
  }

  drawOutput(block, output, x, y) {
    const live = output.count > 0;
    const group = element("g", live ? { class: "output", tabindex: 0, role: "button" } : { class: "output" });
    group.append(element("title", {}, `${block.name}.${output.port}: ${output.quantity}, ${output.unit}`));
    group.append(element("text", { class: live ? "port" : "dead", x: x + BOX - 5, y, "text-anchor": "end" }, output.port));
    const value = element("text", { class: "value", x: x + BOX - Math.max(42, 16 + 7 * output.port.length), y, "text-anchor": "end" });
    group.append(value);
    this.svg.append(group);
    this.outputs.set(output.number, { ...output, name: `${block.name}.${output.port}`, group, value });
    if (!live) return;
    group.addEventListener("click", () => this.choose(output.number));
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      this.choose(output.number);
    });
  }

  choose(number) {
    this.chosen = number;
    for (const path of this.paths) path.classList.toggle("chosen", Number(path.dataset.from) === number);
    for (const [its, output] of this.outputs) output.group.classList.toggle("chosen", its === number);
    this.read();
  }

  /** The values are still computed while nothing is sent to the drives; the robot, which is the last block, says so. */
  commanded(is) {
    this.svg.classList.toggle("idle", !is);
    if (this.robot) this.robot.textContent = is ? this.robotType : "not commanded";
  }

  show({ values }) {
    this.values = values;
    for (const [number, output] of this.outputs) {
      const numbers = values[number] || [];
      output.value.textContent = numbers.slice(0, SHOWN).map(label).join(" ") + (numbers.length > SHOWN ? " …" : "");
    }
    this.read();
  }

  /** All numbers of the chosen output, with their names. */
  read() {
    const output = this.outputs.get(this.chosen);
    if (!output) return;
    const parts = output.components.split(" ").filter(Boolean);
    this.name.textContent = `${output.name}, ${output.quantity}, ${output.unit}:`;
    this.numbers.textContent = (this.values[this.chosen] || [])
      .map((value, i) => `${parts[i] || i + 1} ${value.toFixed(4)}`).join("   ");
  }
}
