// Forward kinematics from the robot's table: matrices of 16 numbers, column by column.

export function multiply(a, b) {
  const to = new Float32Array(16);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) to[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return to;
}

/** A frame of the robot's table at a joint position: Trans(x, y, z) RotX(roll) RotZ(turn + q), or Trans(0, 0, q) behind. */
function placed([x, y, z, roll, angle, prismatic], q) {
  const c = Math.cos(roll), s = Math.sin(roll);
  const to = turn(prismatic ? angle : angle + q);
  if (prismatic) to[14] = q;
  return multiply(new Float32Array([1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, x, y, z, 1]), to);
}

function turn(angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return new Float32Array([c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
}

/** Returns the frames of the links, the base first, and behind them that of the flange. */
export function linkFrames(robot, q) {
  const frames = [turn(0)];
  robot.frames.forEach((joint, i) => {
    frames.push(multiply(frames[i], placed(joint, q[i])));
  });
  frames.push(multiply(frames[frames.length - 1], placed(robot.flange_frames[0], 0)));
  return frames;
}

export function transformed(frame, [x, y, z]) {
  return [0, 1, 2].map((row) => frame[row] * x + frame[4 + row] * y + frame[8 + row] * z + frame[12 + row]);
}

/** Where the tip of the tool is. */
export function tip(robot, q) {
  const frames = linkFrames(robot, q);
  return transformed(frames[frames.length - 1], robot.tip);
}
