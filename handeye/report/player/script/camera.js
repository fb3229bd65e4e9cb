import { add, axes, clamp, mixed, multiplied, perspective, seenFrom, subtract } from "./geometry.js";

const NEAR = 0.03, FAR = 14; // m
const NEAREST = 0.1, FARTHEST = 3.6; // m from the eye to the point at which it looks
const LOWEST = -0.05, HIGHEST = 1.52; // rad, elevation of the eye above this point
const BROAD = 1.15; // in a picture with a smaller ratio of width to height, the angle of view is widened
const GLIDE = 450; // ms for a change of the view

// The viewpoint: the point at which the eye looks, and the eye's direction and distance from there. A view that belongs
// to a body moves with the body.
export class Camera {
  constructor(views, placeOf) {
    this.views = new Map(views.map(view => [view.name, view]));
    this.placeOf = placeOf;
    this.look(this.aimed(views[0]));
  }

  aimed({ eye, at, angle, body }) {
    const [x, y, z] = subtract(eye, at), far = Math.hypot(x, y, z), slope = Math.tan(angle * Math.PI / 360);
    return { at, far, yaw: Math.atan2(y, x), pitch: Math.asin(z / far), slope, body };
  }

  look(aim) {
    Object.assign(this, aim);
    this.glide = null;
  }

  // Change to a view: at once or, with `now` (ms), gradually from that time on.
  view(name, now = null) {
    const aim = this.aimed(this.views.get(name));
    if (now === null) return this.look(aim);
    const { far, yaw, pitch, slope } = this, at = subtract(this.middle, this.base(aim.body));
    aim.yaw = yaw + Math.atan2(Math.sin(aim.yaw - yaw), Math.cos(aim.yaw - yaw)); // turn the shorter way
    this.glide = { since: now, from: { at, far, yaw, pitch, slope }, aim };
  }

  // Continue a gradual change of the view.
  move(now) {
    if (!this.glide) return;
    const { since, from, aim } = this.glide, share = clamp((now - since) / GLIDE, 0, 1);
    if (share === 1) return this.look(aim);
    const k = share * share * (3 - 2 * share);
    for (const name of ["far", "yaw", "pitch", "slope"]) this[name] = from[name] + k * (aim[name] - from[name]);
    this.at = mixed(from.at, aim.at, k);
    this.body = aim.body;
  }

  base(body) {
    return (body && this.placeOf(body)) || [0, 0, 0];
  }

  get middle() {
    return add(this.base(this.body), this.at);
  }

  get eye() {
    const { yaw, pitch, far } = this, level = Math.cos(pitch);
    return add(this.middle, [Math.cos(yaw) * level, Math.sin(yaw) * level, Math.sin(pitch)], far);
  }

  // The eye and its projection. `jitter`: shift to the right and up, in points; `lens`: shift from the lens centre, m.
  seen(width, height, jitter = [0, 0], lens = [0, 0]) {
    const { middle, eye, far } = this, around = axes(subtract(middle, eye)), aspect = width / height;
    const slope = this.slope * Math.max(1, BROAD / aspect);
    const from = add(add(eye, around.right, lens[0]), around.up, lens[1]);
    const half = [slope * aspect * far, slope * far]; // half the width and height of the view in the plane of focus, m
    const shift = [2 * jitter[0] / width - lens[0] / half[0], 2 * jitter[1] / height - lens[1] / half[1]];
    const matrix = multiplied(perspective(slope, aspect, NEAR, FAR, shift), seenFrom(from, around));
    return { eye: from, matrix, points: height / slope / 2 }; // points: a metre at a distance of a metre
  }

  orbit(right, up) {
    this.glide = null;
    this.yaw -= right;
    this.pitch = clamp(this.pitch + up, LOWEST, HIGHEST);
  }

  // Shift the view by fractions of the picture's height.
  pan(right, up) {
    this.glide = null;
    const { right: x, up: y } = axes(subtract(this.middle, this.eye)), size = 2 * this.far * this.slope;
    this.at = add(add(this.at, x, -right * size), y, up * size);
  }

  zoom(factor) {
    this.glide = null;
    this.far = clamp(this.far * factor, NEAREST, FARTHEST);
  }
}
