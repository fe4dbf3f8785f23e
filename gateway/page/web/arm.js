// The arm in three dimensions: capsules by WebGL, the measured arm solid, the desired one as a ghost.

import { linkFrames, multiply, tip } from "./kinematics.js";

const VERTEX = `
attribute vec4 vertex;  // unit normal of a capsule along z; which end it belongs to
uniform mat4 camera, link;
uniform vec3 a, b;
uniform float radius;
varying vec3 normal;
void main() {
  vec3 along = b - a;
  vec3 z = length(along) > 1e-6 ? normalize(along) : vec3(0.0, 0.0, 1.0);
  vec3 x = normalize(cross(abs(z.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), z));
  vec3 n = x * vertex.x + cross(z, x) * vertex.y + z * vertex.z;
  normal = mat3(link) * n;
  gl_Position = camera * link * vec4(mix(a, b, vertex.w) + radius * n, 1.0);
}`;
const FRAGMENT = `
precision mediump float;
uniform vec4 colour;
uniform float lit;
varying vec3 normal;
void main() {
  float light = 0.45 + 0.2 * normal.z + 0.45 * max(0.0, dot(normalize(normal), normalize(vec3(0.4, -0.6, 0.7))));
  gl_FragColor = vec4(colour.rgb * mix(1.0, light, lit), colour.a);
}`;
const IDENTITY = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
const TRAIL = 200;  // states: 10 s
const BOX = [0.6, 0.3, 0.15, 1];  // of its edges
const EDGES = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((from) => [1, 2, 4].filter((bit) => !(from & bit)).flatMap((bit) => [from, from + bit]));

/** Normals and ends of a capsule, as triangles. */
function capsuleMesh(around = 24, rings = 8) {
  const rows = [];
  for (let i = 0; i <= 2 * rings; ++i) {
    const angle = (i / rings - 1) * Math.PI / 2;
    const ends = i === rings ? [0, 1] : [i < rings ? 0 : 1];
    for (const end of ends) rows.push([Math.cos(angle), Math.sin(angle), end]);
  }
  const vertices = [];
  const corner = ([wide, high, end], k) => {
    const turn = 2 * Math.PI * k / around;
    vertices.push(wide * Math.cos(turn), wide * Math.sin(turn), high, end);
  };
  for (let i = 0; i + 1 < rows.length; ++i) {
    for (let k = 0; k < around; ++k) {
      for (const [row, step] of [[i, 0], [i, 1], [i + 1, 1], [i, 0], [i + 1, 1], [i + 1, 0]]) corner(rows[row], k + step);
    }
  }
  return new Float32Array(vertices);
}

function gridLines(half = 1.5, step = 0.25) {
  const points = [];
  for (let at = -half; at <= half + 1e-9; at += step) points.push(at, -half, 0, at, half, 0, -half, at, 0, half, at, 0);
  return points;
}

function program(gl) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  gl.useProgram(made);
  return made;
}

export class ArmView {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
    this.turn = { azimuth: -0.9, elevation: 0.35, distance: 2.7 };
    this.trail = [];
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    if (!this.gl) canvas.replaceWith("This browser has no WebGL: the arm is not drawn.");
    else this.prepare();
  }

  prepare() {
    const gl = this.gl, made = program(gl);
    this.at = Object.fromEntries(["camera", "link", "a", "b", "radius", "colour", "lit"].map((n) => [n, gl.getUniformLocation(made, n)]));
    const place = gl.getAttribLocation(made, "vertex");
    gl.enableVertexAttribArray(place);
    this.use = (buffer) => { gl.bindBuffer(gl.ARRAY_BUFFER, buffer); gl.vertexAttribPointer(place, 4, gl.FLOAT, false, 0, 0); };
    this.mesh = gl.createBuffer();
    this.lines = gl.createBuffer();
    const mesh = capsuleMesh();
    this.corners = mesh.length / 4;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.mesh);
    gl.bufferData(gl.ARRAY_BUFFER, mesh, gl.STATIC_DRAW);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.takeOrbit();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.dark.addEventListener("change", () => this.draw());
  }

  takeOrbit() {
    const { canvas, turn } = this;
    const move = (right, up, factor = 1) => {
      turn.azimuth -= right;
      turn.elevation = Math.max(-1.5, Math.min(1.5, turn.elevation + up));
      turn.distance = Math.max(0.6, Math.min(12, turn.distance * factor));
      this.draw();
    };
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) move(event.movementX * 0.008, event.movementY * 0.008);
    });
    canvas.addEventListener("wheel", (event) => { event.preventDefault(); move(0, 0, Math.exp(event.deltaY * 0.001)); }, { passive: false });
    const keys = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1], "+": [0, 0, 0.9], "-": [0, 0, 1.1] };
    canvas.addEventListener("keydown", (event) => {
      if (!keys[event.key]) return;
      event.preventDefault();
      move(...keys[event.key]);
    });
  }

  describe(robot) {
    this.robot = robot;
    this.trail = [];
    this.q = this.qd = null;
  }

  show(state) {
    this.q = state.q;
    this.qd = state.q_d.length === state.q.length ? state.q_d : null;
    this.trail.push(tip(this.robot, state.q));
    if (this.trail.length > TRAIL) this.trail.shift();
    this.draw();
  }

  /** The perspective from the eye to the middle of the arm. */
  camera() {
    const { azimuth, elevation, distance } = this.turn, aspect = this.canvas.width / this.canvas.height;
    const back = [Math.cos(elevation) * Math.sin(-azimuth), -Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation)];
    const right = [Math.cos(azimuth), -Math.sin(azimuth), 0];
    const up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]];
    const middle = [0, 0, 0.45], dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const look = [];
    for (let k = 0; k < 3; ++k) look.push(right[k], up[k], back[k], 0);
    look.push(-dot(right, middle), -dot(up, middle), -dot(back, middle) - distance, 1);
    const f = 1 / Math.tan(0.35), near = 0.05, far = 30;
    const lens = [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
    return multiply(lens, look);
  }

  draw() {
    if (this.asked || !this.gl) return;
    this.asked = true;
    requestAnimationFrame(() => { this.asked = false; this.paint(); });
  }

  paint() {
    const { gl, canvas, at } = this, scale = devicePixelRatio || 1;
    const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    const paper = this.dark.matches ? [0.085, 0.095, 0.11] : [0.985, 0.988, 0.992];
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(at.camera, false, this.camera());
    const grey = this.dark.matches ? 0.27 : 0.82;
    this.strokes(gl.LINES, gridLines(), [grey, grey, grey, 1]);
    for (const axis of [0, 1, 2]) {
      const colour = [0.2, 0.2, 0.2, 1], end = [0, 0, 0];
      colour[axis] = 0.8;
      end[axis] = 0.3;
      this.strokes(gl.LINES, [0, 0, 0.001, ...end], colour);
    }
    for (const { corners } of this.robot?.boxes ?? [])
      this.strokes(gl.LINES, EDGES.flatMap((corner) => corners.slice(3 * corner, 3 * corner + 3)), BOX);
    if (!this.q) return;
    this.strokes(gl.LINE_STRIP, this.trail.flat(), [0.15, 0.6, 0.3, 1]);
    this.solid(this.q, this.dark.matches ? [0.62, 0.7, 0.8, 1] : [0.66, 0.72, 0.8, 1]);
    if (this.qd) this.ghost(this.qd, [0.95, 0.6, 0.1, 0.45]);
  }

  /** Lines are capsules of no radius: only the ends count. */
  strokes(kind, points, colour) {
    const { gl, at } = this, vertices = [];
    for (let i = 0; i < points.length; i += 3) vertices.push(points[i], points[i + 1], points[i + 2], 0);
    gl.uniform1f(at.lit, 0);
    gl.uniform4fv(at.colour, colour);
    gl.uniformMatrix4fv(at.link, false, IDENTITY);
    gl.uniform3f(at.a, 0, 0, 0);
    gl.uniform3f(at.b, 0, 0, 0);
    gl.uniform1f(at.radius, 1);
    this.use(this.lines);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(vertices), gl.STREAM_DRAW);
    gl.drawArrays(kind, 0, vertices.length / 4);
  }

  solid(q, colour) {
    const { gl, at, robot } = this, frames = linkFrames(robot, q);
    gl.uniform1f(at.lit, 1);
    gl.uniform4fv(at.colour, colour);
    this.use(this.mesh);
    const rods = robot.capsules.map((c) => [frames[c.link], c.a, c.b, c.radius]);
    if (Math.hypot(...robot.tip) > 0) rods.push([frames[frames.length - 1], [0, 0, 0], robot.tip, 0.02]);
    for (const [frame, a, b, radius] of rods) {
      gl.uniformMatrix4fv(at.link, false, frame);
      gl.uniform3fv(at.a, a);
      gl.uniform3fv(at.b, b);
      gl.uniform1f(at.radius, radius);
      gl.drawArrays(gl.TRIANGLES, 0, this.corners);
    }
  }

  /** First the depth alone, so that only the nearest surface shows; behind the arm where they coincide. */
  ghost(q, colour) {
    const { gl } = this;
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2, 16);
    gl.colorMask(false, false, false, false);
    this.solid(q, colour);
    gl.colorMask(true, true, true, false);
    gl.enable(gl.BLEND);
    gl.depthFunc(gl.LEQUAL);
    this.solid(q, colour);
    gl.depthFunc(gl.LESS);
    gl.disable(gl.BLEND);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.colorMask(true, true, true, true);
  }
}
