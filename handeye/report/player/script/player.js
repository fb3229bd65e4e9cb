import { Bodies } from "./bodies.js";
import { Camera } from "./camera.js";
import { clamp, multiplied } from "./geometry.js";
import { Graphics } from "./graphics.js";
import { listen } from "./hands.js";
import { unpacked } from "./packed.js";
import { Picture } from "./picture.js";
import { Senses } from "./senses.js";
import { Shadows } from "./shadows.js";
import { Tracks } from "./tracks.js";

const DETAIL = [1, 0.75, 0.5]; // possible resolutions of a draft, as fractions of the canvas's
const SLOW = 45, FAST = 14; // ms for a draft: a slower one is made coarser, a faster one finer
const TIMED = 24; // one draft in this number is timed
const REST = [150, 800]; // ms without change before fine pictures begin: least and greatest value
const SHOWN = 8; // the average is shown each time this number of exposures has been added
const PATIENCE = 4000; // ms after which the next shown average is the last
const MOST = 2; // points per CSS pixel, at most

class Player {
  constructor(canvas, scene, tracks, levels, { still, exposures = 32 }) {
    Object.assign(this, { canvas, scene, tracks, levels, exposures, onpick: null, senses: null, frames: 0 });
    this.still = still ?? matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.detail = 1;
    this.drafts = 0;
    this.drawn = -Infinity;
    this.waiting = [];
    this.over = new AbortController();
    this.names = scene.header.bodies.map(body => body.name).filter(name => tracks.tracks.has(name));
    this.build();
    this.camera = new Camera(scene.header.views, body => this.now(body));
    const { signal } = this.over;
    const clicked = (x, y) => this.onpick?.(this.pick(x, y), x, y);
    listen(canvas, this.camera, { signal, clicked, moved: () => this.wake() });
    canvas.addEventListener("webglcontextlost", event => { event.preventDefault(); this.lost = true; }, { signal });
    canvas.addEventListener("webglcontextrestored", () => this.build(), { signal });
    this.resized = new ResizeObserver(() => this.wake());
    this.resized.observe(canvas);
    this.at(tracks.begin);
  }

  // Create everything on the graphics card, at the start and after the card has lost it.
  build() {
    const { header } = this.scene, graphics = this.graphics = new Graphics(this.canvas);
    this.lost = false;
    this.bodies = new Bodies(graphics, this.scene);
    const rows = header.materials.map(row => [...row, 0, 0]);
    const materials = graphics.table(rows, 3), grain = graphics.grains(this.levels, header.grains);
    const shadows = new Shadows(graphics, header.lamp, this.bodies);
    this.picture = new Picture(graphics, this.bodies, shadows, materials, grain);
    if (this.time !== undefined) this.at(this.time);
    if (this.camera) this.wake();
  }

  // ---- the interface for pages

  get begin() { return this.tracks.begin; }
  get end() { return this.tracks.end; }
  get duration() { return this.end - this.begin; }
  get views() { return this.scene.header.views.map(view => view.name); }

  at(seconds) {
    this.time = seconds;
    let changed = false;
    for (const name of this.names) changed = this.bodies.put(name, this.pose(name, seconds)) || changed;
    if (changed) this.wake(); else this.senses?.draw();
  }

  // Draw over the view, on a canvas of its own, what the hand sensed.
  overlay(canvas, sensed) {
    this.senses = new Senses(canvas, this, sensed);
    this.wake();
    return this.senses;
  }

  // Return a function that converts a place (m) to its point in a picture of this size, or to null if the place is behind the eye.
  projection(width, height) {
    const { matrix: m } = this.camera.seen(width, height);
    return ([x, y, z]) => {
      const [right, up, , far] = [0, 1, 2, 3].map(k => m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]);
      return far > 0 ? [(1 + right / far) * width / 2, (1 - up / far) * height / 2] : null;
    };
  }

  view(name) {
    this.camera.view(name, this.still ? null : performance.now());
    this.wake();
  }

  pose(body, seconds) {
    return this.tracks.pose(body, seconds);
  }

  // Draw this one point as a whole picture, with a different colour for each body, and read the colour.
  pick(x, y) {
    const { clientWidth: w, clientHeight: h } = this.canvas, { matrix } = this.camera.seen(w, h);
    const onPoint = [w, 0, 0, 0, 0, h, 0, 0, 0, 0, 1, 0, w - 2 * x - 1, 2 * y + 1 - h, 0, 1];
    return this.bodies.pick(multiplied(onPoint, matrix));
  }

  settled() {
    return this.rests ? Promise.resolve() : new Promise(done => this.waiting.push(done));
  }

  destroy() {
    this.over.abort();
    this.resized.disconnect();
    clearTimeout(this.timer);
    cancelAnimationFrame(this.request);
    this.lost = true;
    this.graphics.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  // ---- drawing: a draft after each change; if nothing changes for a while, a fine picture, exposure by exposure

  now(body) {
    return this.bodies.named.get(body)?.pose?.slice(0, 3);
  }

  wake() {
    this.changed = true;
    this.rests = false;
    clearTimeout(this.timer);
    this.next();
  }

  next() {
    if (!this.request && !this.lost) this.request = requestAnimationFrame(now => this.draw(now));
  }

  draw(now) {
    this.request = 0;
    if (this.lost || !this.canvas.clientWidth) return;
    this.rest = clamp(2 * (now - this.drawn), ...REST); // if drawing is slow, the next change arrives late
    this.drawn = now;
    this.camera.move(now);
    if (this.changed) this.drawDraft(now);
    else this.drawFine(now);
    this.senses?.draw();
    this.frames++;
    if (this.camera.glide) this.wake();
  }

  drawDraft(now) {
    const timed = this.drafts++ % TIMED === 3, begun = performance.now();
    this.picture.draft(this.camera, ...this.size(DETAIL[this.detail]));
    if (timed) this.tune(begun);
    this.changed = false;
    this.exposed = -1;
    this.changedAt = now;
    this.timer = setTimeout(() => this.next(), this.rest);
  }

  // Adjust the resolution of drafts to the speed of this machine.
  tune(begun) {
    this.graphics.finish();
    const cost = performance.now() - begun;
    if (cost > SLOW && this.detail < DETAIL.length - 1) this.detail++;
    else if (cost < FAST && this.detail > 0) this.detail--;
  }

  // Draw a draft in full size first, and then one exposure after another.
  drawFine(now) {
    const [width, height] = this.size(1);
    if (this.exposed < 0) this.picture.draft(this.camera, width, height);
    else this.picture.expose(this.camera, width, height, this.exposed);
    const count = ++this.exposed, shown = count > 0 && count % SHOWN === 0;
    const done = count === this.exposures || !this.graphics.floats || (shown && now - this.changedAt > PATIENCE);
    if (count && (done || shown)) this.picture.develop(width, height, count);
    if (!done) return this.next();
    this.rests = true;
    this.waiting.splice(0).forEach(tell => tell());
  }

  size(detail) {
    const { canvas } = this, points = detail * Math.min(devicePixelRatio, MOST);
    const sides = [canvas.clientWidth, canvas.clientHeight];
    const [width, height] = sides.map(side => Math.max(2, Math.round(side * points)));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    return [width, height];
  }
}

// Return the levels of a grey picture, row by row.
async function levelsOf(file) {
  const image = await createImageBitmap(new Blob([file])), { width, height } = image;
  const pen = new OffscreenCanvas(width, height).getContext("2d");
  pen.drawImage(image, 0, 0);
  return pen.getImageData(0, 0, width, height).data.filter((_, i) => i % 4 === 0);
}

// Return a player on a canvas; `handeye.report.player` describes it. The promise is rejected, with a sentence as its reason, if the browser cannot draw.
export async function createPlayer(canvas, sceneBuffer, tracksBuffer, options = {}) {
  const scene = unpacked(sceneBuffer), levels = scene.header.grains ? await levelsOf(scene.array("picture")) : null;
  return new Player(canvas, scene, new Tracks(tracksBuffer), levels, options);
}
