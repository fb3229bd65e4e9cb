// A vector has three numbers. A matrix has sixteen, column by column. A rotation is a quaternion w, x, y, z.

export const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
export const subtract = (a, b) => add(a, b, -1);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = a => Math.hypot(a[0], a[1], a[2]);
export const unit = a => a.map(x => x / (length(a) || 1));
export const mixed = (a, b, k) => a.map((x, i) => x + k * (b[i] - x));
export const clamp = (x, least, most) => Math.min(most, Math.max(least, x));

export function rotated([w, x, y, z], v) {
  const half = cross([x, y, z], v);
  return add(add(v, half, 2 * w), cross([x, y, z], half), 2);
}

export function multiplied(a, b) {
  const c = new Float32Array(16);
  for (let i = 0; i < 16; i++) for (let k = 0; k < 4; k++) c[i] += a[k * 4 + (i & 3)] * b[(i & 12) + k];
  return c;
}

// Unit vectors right, up and forward for an eye that looks along a direction, with the world's z axis upright.
export function axes(direction) {
  const forward = unit(direction), upright = Math.abs(forward[2]) > 0.999 ? [0, 1, 0] : [0, 0, 1];
  const right = unit(cross(forward, upright));
  return { right, up: cross(right, forward), forward };
}

// The matrix that converts world coordinates to the frame of an eye.
export function seenFrom(eye, { right: r, up: u, forward: f }) {
  return [r[0], u[0], -f[0], 0, r[1], u[1], -f[1], 0, r[2], u[2], -f[2], 0, -dot(r, eye), -dot(u, eye), dot(f, eye), 1];
}

// `slope`: tangent of half the vertical angle of view; `shift`: shift of the picture's middle, in halves of a picture.
export function perspective(slope, aspect, near, far, shift = [0, 0]) {
  const deep = near - far, middle = (far + near) / deep, end = 2 * far * near / deep;
  return [1 / slope / aspect, 0, 0, 0, 0, 1 / slope, 0, 0, shift[0], shift[1], middle, -1, 0, 0, end, 0];
}

export function parallel(radius, near, far) {
  const deep = near - far;
  return [1 / radius, 0, 0, 0, 0, 1 / radius, 0, 0, 0, 0, 2 / deep, 0, 0, 0, (far + near) / deep, 1];
}

// Gauss-Jordan elimination.
export function inverse(matrix) {
  const four = [0, 1, 2, 3], rows = four.map(r => [...four.map(c => matrix[c * 4 + r]), ...four.map(c => +(c === r))]);
  for (let i = 0; i < 4; i++) {
    let best = i;
    for (let r = i + 1; r < 4; r++) if (Math.abs(rows[r][i]) > Math.abs(rows[best][i])) best = r;
    [rows[i], rows[best]] = [rows[best], rows[i]];
    rows[i] = rows[i].map(x => x / rows[i][i]);
    for (let r = 0; r < 4; r++) if (r !== i) rows[r] = rows[r].map((x, c) => x - rows[r][i] * rows[i][c]);
  }
  return new Float32Array(four.flatMap(c => rows.map(row => row[c + 4])));
}

// The left, right, lower and upper border planes of a view: each has its inward normal and its distance.
export function sides(m) {
  return [[1, 0], [-1, 0], [0, 1], [0, -1]].map(([x, y]) => {
    const plane = [0, 1, 2, 3].map(k => m[k * 4 + 3] + x * m[k * 4] + y * m[k * 4 + 1]), size = length(plane);
    return plane.map(v => v / size);
  });
}

// Sequences of points that fill the unit square and the unit disc evenly, whatever the number of points.
export function halton(number, base) {
  let share = 1, sum = 0;
  for (let i = number; i > 0; i = Math.floor(i / base)) sum += (share /= base) * (i % base);
  return sum;
}

export function disc(number, base, other) {
  const radius = Math.sqrt(halton(number, base)), turn = 2 * Math.PI * halton(number, other);
  return [radius * Math.cos(turn), radius * Math.sin(turn)];
}
