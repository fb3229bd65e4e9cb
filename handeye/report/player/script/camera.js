import { add, axes, clamp, mixed, multiplied, perspective, seenFrom, subtract } from "./geometry.js";

const NEAR = 0.03, FAR = 14; // m
const NEAREST = 0.1, FARTHEST = 3.6; // m from the point that is looked at
const LOWEST = -0.05, HIGHEST = 1.52; // rad above it
const BROAD = 1.15; // as wide as high a picture has to be to be shown whole
const GLIDE = 450; // ms from view to view

// The viewpoint: at a point, from a direction and a distance; both go with a body, if the view does.
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

  // Go to a view: at once, or from `now` (ms) on, step by step.
  view(name, now = null) {
    const aim = this.aimed(this.views.get(name));
    if (now === null) return this.look(aim);
    const { far, yaw, pitch, slope } = this, at = subtract(this.middle, this.base(aim.body));
    aim.yaw = yaw + Math.atan2(Math.sin(aim.yaw - yaw), Math.cos(aim.yaw - yaw)); // the short way round
    this.glide = { since: now, from: { at, far, yaw, pitch, slope }, aim };
  }

  // Go on to where a glide is now.
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

  // The eye and what it sees. `jitter`: part of a point right and up; `lens`: off the middle of the lens, m.
  seen(width, height, jitter = [0, 0], lens = [0, 0]) {
    const { middle, eye, far } = this, around = axes(subtract(middle, eye)), aspect = width / height;
    const slope = this.slope * Math.max(1, BROAD / aspect);
    const from = add(add(eye, around.right, lens[0]), around.up, lens[1]);
    const half = [slope * aspect * far, slope * far]; // of what is seen where it is sharp, m
    const shift = [2 * jitter[0] / width - lens[0] / half[0], 2 * jitter[1] / height - lens[1] / half[1]];
    const matrix = multiplied(perspective(slope, aspect, NEAR, FAR, shift), seenFrom(from, around));
    return { eye: from, matrix, points: height / slope / 2 }; // points of a metre a metre away
  }

  orbit(right, up) {
    this.glide = null;
    this.yaw -= right;
    this.pitch = clamp(this.pitch + up, LOWEST, HIGHEST);
  }

  // By parts of the picture's height.
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
