"use strict";
// Plays the runs of the page. An address that ends with #run=NAME&t=SECONDS shows that moment and waits, one with
// &alone shows nothing but the viewer, one with &bare nothing but the picture.

const APART_M = 0.01;  // nearer than this, the ghost of the reference would only cover the arm
const MARGIN_M = 0.12;  // around what must be in view: the arm is thick

const part = (name) => document.getElementById(name);

/** One run: its objects, and where they are at any time. */
class Run {
  constructor(given) {
    Object.assign(this, given);
    for (const key of ["q", "joints", "pose", "force"]) this[key] = given[key] && decode(given[key]);
    this.arm = new Arm(given.scene, SOLID);
    this.ghost = this.joints ? new Arm(given.scene, ghostLook()) : null;
    this.body = this.joints ? this.ghost.root : this.pose ? toolOf(given.scene, ghostLook()) : new THREE.Group();
    this.count = this.q.length / given.scene.joints.length;
    this.duration = (this.count - 1) * given.step_s;
    this.group = new THREE.Group();
    this.group.add(this.arm.root, this.body, ...given.scene.boxes.map(box));
    this.trace();
    if (!this.force) return;
    this.arrow = arrow();
    this.scale = given.steady_N > 0 ? 0.25 / given.steady_N : 0.02;  // m/N
    this.group.add(this.arrow);
  }

  /** Returns `width` numbers between rows i and i + 1. */
  row(values, i, width, share) {
    const next = Math.min(i + 1, this.count - 1);
    const mix = (_, k) => values[i * width + k] * (1 - share) + values[next * width + k] * share;
    return Array.from({ length: width }, mix);
  }

  /** Draws the ways of the tip: desired whole, measured as far as it has come. */
  trace() {
    const n = this.scene.joints.length, measured = [], desired = [];
    this.corners = [new THREE.Vector3(0, 0, 0)];  // what must be in view
    for (let i = 0; i < this.count; ++i) {
      measured.push(this.arm.place(this.row(this.q, i, n, 0)));
      if (this.joints) desired.push(this.ghost.place(this.row(this.joints, i, n, 0)));
      if (this.pose) desired.push(new THREE.Vector3(...this.row(this.pose, i, 7, 0)));
      if (i % 25 > 0) continue;
      for (const joint of this.arm.joints) this.corners.push(new THREE.Vector3().setFromMatrixPosition(joint.matrixWorld));
    }
    this.corners.push(...measured);
    const wanted = path(desired, 0.0018, COLOURS.desired);
    if (wanted) this.group.add(wanted);
    this.way = [];
    const pieces = Math.min(100, this.count - 1);  // shown one by one
    for (let k = 0; k < pieces; ++k) {
      const from = Math.floor(k * (this.count - 1) / pieces), to = Math.floor((k + 1) * (this.count - 1) / pieces);
      const piece = path(measured.slice(from, to + 1), 0.0035, COLOURS.measured);
      if (!piece) continue;
      this.way.push([to * this.step_s, piece]);
      this.group.add(piece);
    }
  }

  /** Places everything at a time; returns the distance between desired and measured tip, m, and the force, N. */
  show(t) {
    const at = Math.min(t / this.step_s, this.count - 1), i = Math.floor(at), share = at - i;
    const n = this.scene.joints.length;
    const tip = this.arm.place(this.row(this.q, i, n, share));
    let wanted = tip;
    if (this.joints) wanted = this.ghost.place(this.row(this.joints, i, n, share));
    if (this.pose) {
      const [x, y, z, qw, qx, qy, qz] = this.row(this.pose, i, 7, share);
      this.body.position.copy(wanted = new THREE.Vector3(x, y, z));
      this.body.quaternion.set(qx, qy, qz, qw).normalize();
    }
    for (const [until, piece] of this.way) piece.visible = until <= t;
    this.body.visible = tip.distanceTo(wanted) > APART_M;
    const force = this.force ? new THREE.Vector3(...this.row(this.force, i, 3, share)) : null;
    if (force) this.arrow.set(tip, force, this.scale);
    return [tip.distanceTo(wanted), force && force.length()];
  }
}

class Viewer {
  constructor(given, canvas) {
    this.given = given;
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setClearColor(0xffffff);
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.05, 30);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.world = new THREE.Scene();
    this.world.add(new THREE.HemisphereLight(0xffffff, 0xb0b4ba, 0.85));
    this.lamp = new THREE.DirectionalLight(0xffffff, 0.55);
    const floor = new THREE.GridHelper(3, 30, 0xb8bec6, 0xe3e6ea);
    floor.rotation.x = Math.PI / 2;
    this.world.add(this.lamp, floor);
    this.playing = false;
    window.addEventListener("resize", () => this.draw());
  }

  open(index, t) {
    if (this.run) this.world.remove(this.run.group);
    this.index = index;
    this.run = this.given[index].shown = this.given[index].shown || new Run(this.given[index]);
    this.world.add(this.run.group);
    this.time = t;
    this.look();
    part("choose").value = index;
    part("slider").max = this.run.duration;
    part("shown").innerHTML = this.run.caption;
    for (const row of document.querySelectorAll("tr[data-run]"))
      row.classList.toggle("shown", row.dataset.run === this.run.name);
    this.draw();
  }

  /** Looks at arm and way from where the run is seen best, and from as near as shows them all. */
  look() {
    const all = new THREE.Box3().setFromPoints(this.run.corners), from = new THREE.Vector3(...this.run.eye);
    const target = all.getCenter(new THREE.Vector3()), camera = this.camera;
    const up = Math.tan(camera.fov * Math.PI / 360) * 0.95;
    const across = up * this.canvas.clientWidth / this.canvas.clientHeight;
    camera.position.copy(target).add(from);
    camera.lookAt(target);
    const turn = camera.quaternion.clone().inverse();
    const far = this.run.corners.reduce((least, corner) => {
      const { x, y, z } = corner.clone().sub(target).applyQuaternion(turn);
      return Math.max(least, z + (Math.abs(x) + MARGIN_M) / across, z + (Math.abs(y) + MARGIN_M) / up);
    }, 0);
    camera.position.copy(target).addScaledVector(from, far);
    this.lamp.position.copy(from).add(new THREE.Vector3(0, 0, 1.5));
    this.controls.target.copy(target);
    this.controls.update();
  }

  draw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const [error, force] = this.run.show(this.time);
    part("slider").value = this.time;
    part("time").textContent = `${(this.run.start_s + this.time).toFixed(2)} s`;
    part("error").textContent = `${(1e3 * error).toFixed(error < 0.0995 ? 2 : 0)} mm`;
    part("force").parentElement.hidden = force === null;
    if (force !== null) part("force").textContent = `${force.toFixed(1)} N`;
    this.renderer.render(this.world, this.camera);
  }

  play(on) {
    this.playing = on;
    part("play").textContent = on ? "Pause" : "Play";
    if (on && this.time >= this.run.duration) this.time = 0;
    let last = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      this.time += Math.max(0, now - last) / 1e3 * Number(part("speed").value);
      last = now;
      if (this.time > this.run.duration) this.open((this.index + 1) % this.given.length, 0);
      this.draw();
      requestAnimationFrame(step);
    };
    if (on) requestAnimationFrame(step);
  }
}

function start() {
  const given = JSON.parse(part("runs-data").textContent);
  if (given.length === 0) return;
  let viewer;
  try {
    viewer = new Viewer(given, part("canvas"));
  } catch (error) {
    part("shown").textContent = "This browser shows no 3D graphics (WebGL), so that the runs cannot be played.";
    return;
  }
  given.forEach((run, i) => part("choose").add(new Option(run.name, i)));
  const asked = new URLSearchParams(location.hash.slice(1)), time = asked.get("t");
  for (const word of ["alone", "bare"]) document.body.classList.toggle(word, asked.has(word));
  viewer.open(Math.max(0, given.findIndex((run) => run.name === asked.get("run"))), Number(time));
  part("choose").onchange = (event) => viewer.open(Number(event.target.value), 0);
  part("play").onclick = () => viewer.play(!viewer.playing);
  part("slider").oninput = (event) => { viewer.time = Number(event.target.value); viewer.draw(); };
  document.querySelectorAll("tr[data-run] .picture").forEach((cell) => {
    cell.onclick = () => {
      const index = given.findIndex((run) => run.name === cell.parentElement.dataset.run);
      if (index >= 0) { viewer.open(index, 0); viewer.play(true); }
    };
  });
  if (time === null && !matchMedia("(prefers-reduced-motion: reduce)").matches) viewer.play(true);
}

start();
