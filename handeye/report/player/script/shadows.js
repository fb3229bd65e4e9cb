import { add, axes, multiplied, parallel, perspective, seenFrom, subtract, unit } from "./geometry.js";

const POINTS = { draft: 1024, fine: 2048, dome: 1024 }; // points along a side of a map
const SLOPE = 0.58; // tangent of half the angle of the lamp's cone of light
const SIZE = 0.09; // radius of the lamp, m
const REACH = [1.5, 0.1, 6]; // m; where bodies cast shadows in light from above: radius, least and greatest distance
const AWAY = 3; // m, distance of the source of light from above

// The shadow maps. The map of still bodies is stored, and moving bodies are drawn into a copy of it.
export class Shadows {
  constructor(graphics, lamp, bodies) {
    this.graphics = graphics;
    this.bodies = bodies;
    this.lamp = lamp;
    this.draft = graphics.shadowMap(POINTS.draft);
    this.kept = graphics.shadowMap(POINTS.draft);
    this.keptFor = null;
  }

  // The light of one point of the lamp. `off`: its distance from the lamp's middle, in units of the lamp's radius.
  light(off = [0, 0]) {
    const { eye, at } = this.lamp, { right, up, forward } = axes(subtract(at, eye));
    const lamp = add(add(eye, right, off[0] * SIZE), up, off[1] * SIZE), away = Math.hypot(...subtract(at, eye));
    const view = multiplied(perspective(SLOPE, 1, 0.28 * away, 1.9 * away), seenFrom(lamp, axes(subtract(at, lamp))));
    return { lamp, aim: forward, view };
  }

  // Draw the map of all present shadows. `still` and `moving` select bodies; `key` changes with the still bodies.
  drawDraft({ view }, still, moving, key) {
    const { gl } = this.graphics, side = POINTS.draft;
    if (key !== this.keptFor) this.fill(this.kept, view, still);
    this.keptFor = key;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.kept.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.draft.frame);
    gl.blitFramebuffer(0, 0, side, side, 0, 0, side, side, gl.DEPTH_BUFFER_BIT, gl.NEAREST);
    this.fill(this.draft, view, moving, false);
  }

  drawFine({ view }) {
    this.fine ??= this.graphics.shadowMap(POINTS.fine);
    this.fill(this.fine, view, () => true);
  }

  // Draw the shadow map for light from above, from one direction.
  drawDome(direction, middle) {
    this.dome ??= this.graphics.shadowMap(POINTS.dome);
    const eye = add(middle, unit(direction), AWAY), towards = axes(subtract(middle, eye));
    const view = multiplied(parallel(...REACH), seenFrom(eye, towards));
    this.fill(this.dome, view, () => true);
    return view;
  }

  fill(map, view, which, fresh = true) {
    const { gl } = this.graphics;
    this.graphics.into(map, map.size, map.size);
    if (fresh) gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1.5, 3);
    this.bodies.drawDepth(view, which);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }
}
