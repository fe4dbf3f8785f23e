"use strict";
// The things of a run as three.js objects, in metres, in the base frame with z upwards.

const COLOURS = {
  arm: 0xaab2bd, tool: 0x5f6b7a, ghost: 0xd98a00, measured: 0x1f5fa8, desired: 0x333333, force: 0xc0392b, box: 0xb9a27c,
};

/** Returns the numbers of a base64 text of 32-bit floats. */
function decode(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

/** Returns a rod with round ends from a to b; a ball if they are the same: of a cylinder without length Three.js makes one of 1 m. */
function capsule(a, b, radius, material) {
  const from = new THREE.Vector3(...a), along = new THREE.Vector3(...b).sub(from), group = new THREE.Group();
  if (along.length() > 0) {
    const tube = new THREE.Mesh(new THREE.CylinderBufferGeometry(radius, radius, along.length(), 40, 1, true), material);
    tube.position.copy(from).addScaledVector(along, 0.5);
    tube.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.clone().normalize());
    group.add(tube);
  }
  for (const end of [a, b]) {
    const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(radius, 40, 20), material);
    ball.position.set(...end);
    group.add(ball);
  }
  return group;
}

/** Returns a frame x, y, z, roll about x, turn about z of scene.json; prismatic or not. */
function fixedFrame([x, y, z, roll, turn]) {
  const frame = new THREE.Group();
  frame.position.set(x, y, z);
  frame.rotation.set(roll, 0, turn);  // RotX RotZ: Three.js turns in the order XYZ
  return frame;
}

/** The arm as nested frames, whose matrices are the forward kinematics. `look` gives the materials. */
class Arm {
  constructor(scene, look) {
    this.root = new THREE.Group();
    this.joints = [];
    const links = [this.root];
    for (const joint of scene.joints) {
      const frame = fixedFrame(joint), moving = new THREE.Group();
      moving.prismatic = joint[5];
      links[links.length - 1].add(frame);
      frame.add(moving);
      this.joints.push(moving);
      links.push(moving);
    }
    this.flange = fixedFrame(scene.flange);
    links[links.length - 1].add(this.flange);
    this.tip = new THREE.Group();
    this.tip.position.set(...scene.tool.tip);
    this.flange.add(this.tip);
    for (const material of look) {
      for (const c of scene.capsules)
        if (!scene.hulls.some((h) => h.link === c.link)) links[c.link].add(capsule(c.a, c.b, c.radius, material.link));
      for (const h of scene.hulls) links[h.link].add(new THREE.Mesh(surface(h), material.link));
      if (scene.tool.triangles) this.flange.add(new THREE.Mesh(surface(scene.tool), material.tool));
      else if (this.tip.position.length() > 0)
        this.flange.add(capsule([0, 0, 0], scene.tool.tip, scene.tool.radius, material.tool));
    }
    this.last = links[links.length - 1];
  }

  /** Moves the joints and returns where the tip is. */
  place(q) {
    this.joints.forEach((joint, i) => { (joint.prismatic ? joint.position : joint.rotation).z = q[i]; });
    this.root.updateMatrixWorld(true);
    return new THREE.Vector3().setFromMatrixPosition(this.tip.matrixWorld);
  }
}

/** Returns the last link and the tool of an arm, as a body whose origin is the tip. */
function toolOf(scene, look) {
  const arm = new Arm(scene, look), body = new THREE.Group();
  arm.place(scene.joints.map(() => 0));
  const tool = arm.last;
  const toTip = new THREE.Matrix4().getInverse(arm.tip.matrixWorld).multiply(tool.matrixWorld);
  tool.parent.remove(tool);
  toTip.decompose(tool.position, tool.quaternion, tool.scale);
  body.add(tool);
  return body;
}

function solid(colour) {
  return new THREE.MeshStandardMaterial({ color: colour, roughness: 0.55, metalness: 0.1 });
}

const SOLID = [{ link: solid(COLOURS.arm), tool: solid(COLOURS.tool) }];

/** First the depth alone, so that only the nearest surface of the ghost shows; behind the arm where they coincide. */
function ghostLook() {
  const behind = { polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 16 };
  const depth = new THREE.MeshBasicMaterial({ colorWrite: false, transparent: true, ...behind });
  const tint = new THREE.MeshStandardMaterial(
    { color: COLOURS.ghost, transparent: true, opacity: 0.45, roughness: 0.8, depthWrite: false, ...behind });
  return [{ link: depth, tool: depth }, { link: tint, tool: tint }];
}

/** Returns a line of some thickness through points; null if they are one place. */
function path(points, radius, colour) {
  const chosen = points.filter((point, i) => i === 0 || point.distanceTo(points[i - 1]) > 1e-6);
  if (chosen.length < 2) return null;
  const curve = new THREE.CatmullRomCurve3(chosen, false, "centripetal");
  const count = Math.min(chosen.length, 800);
  const shape = new THREE.TubeBufferGeometry(curve, count, radius, 8);
  return new THREE.Mesh(shape, new THREE.MeshBasicMaterial({ color: colour }));
}

/** Returns an arrow that set() puts in place. */
function arrow() {
  const look = { color: COLOURS.force, depthTest: false, transparent: true };
  const group = new THREE.Group(), material = new THREE.MeshBasicMaterial(look);
  const shaft = new THREE.Mesh(new THREE.CylinderBufferGeometry(0.006, 0.006, 1, 24), material);
  const head = new THREE.Mesh(new THREE.ConeBufferGeometry(0.02, 0.05, 32), material);
  shaft.position.y = 0.5;
  shaft.renderOrder = head.renderOrder = 9;  // seen through the arm, into which it points
  group.add(shaft, head);
  group.set = (from, force, scale) => {
    const length = Math.min(force.length() * scale, 0.5);
    group.visible = length > 0.01;
    if (!group.visible) return;
    group.position.copy(from);
    group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), force.clone().normalize());
    shaft.scale.y = length;
    shaft.position.y = length / 2;
    head.position.y = length;
  };
  return group;
}

/** Returns the surface of a convex body with flat faces. */
function surface({ corners, triangles }) {
  const shape = new THREE.BufferGeometry();
  shape.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
  shape.setIndex(triangles);
  const flat = shape.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}

/** Returns a box of scene.json, or the body inside it; one that is not there is drawn by its edges. */
function box(given) {
  const shape = given.triangles ? surface(given) : new THREE.BoxBufferGeometry(...given.size), group = new THREE.Group();
  if (given.there) {
    const look = { color: COLOURS.box, transparent: true, opacity: 0.3, depthWrite: false };
    group.add(new THREE.Mesh(shape, new THREE.MeshBasicMaterial(look)));
  }
  group.add(new THREE.LineSegments(new THREE.EdgesGeometry(shape), new THREE.LineBasicMaterial({ color: 0x7a6a4a })));
  const [w, x, y, z] = given.rotation;
  group.position.set(...given.centre);
  group.quaternion.set(x, y, z, w);
  return group;
}
