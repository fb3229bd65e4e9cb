import { add, clamp, rotated } from "./geometry.js";
import { countUpTo } from "./tracks.js";

const PER_NEWTON = 0.005; // m for each N of the force
const LONGEST_ARROW = 0.15; // m
const LEAST_FORCE = 0.15; // N; a weaker force has no arrow
const FADING = 2; // s for which the last force of a motion remains
const TRAILING = 12, TRAIL_STEP = 0.1; // s: duration of the drawn path of the hand, and interval between its points
const LINGERING = 12; // s for which the places of a search remain after the last of them
const FINEST = 2; // points per CSS pixel, at most
const INKS = { force: "#ff6a3d", strong: "#ff2d2d", path: "#4fb3ff", tried: "#ffd24a", found: "#58e07f", halo: "rgb(0 0 0 / 60%)" };

// Draws onto the 3D view what the hand sensed: its force, its path, and the places of a search.
export class Senses {
  constructor(canvas, player, { tools, forces = [], searches = [], held = [] }) {
    Object.assign(this, { canvas, player, tools, forces, searches, held, shown: true });
    this.begins = forces.map(motion => motion.times[0]);
    this.pen = canvas.getContext("2d");
  }

  // The force at the given time: its vector (N), the limit of the guard (N, or null), and its strength, which fades from 1 to 0
  // after the motion. Null if no force was sensed.
  force(time) {
    const motion = this.forces[countUpTo(this.begins, time + 1e-6) - 1];
    const strength = motion ? clamp(1 - (time - motion.times.at(-1)) / FADING, 0, 1) : 0;
    if (!strength) return null;
    const { times, rows, limit } = motion, one = clamp(countUpTo(times, time) - 1, 0, rows.length - 1);
    const other = Math.min(one + 1, rows.length - 1), span = times[other] - times[one];
    const share = span > 0 ? clamp((time - times[one]) / span, 0, 1) : 0;
    return { vector: rows[one].map((x, k) => x + share * (rows[other][k] - x)), limit, strength };
  }

  // Take over the force (N) that is sensed now in a live cell; null if none is sensed.
  feel(time, force) {
    if (force) [this.begins, this.forces] = [[time], [{ times: [time], rows: [force], limit: null }]];
  }

  holds(time) {
    return this.held.find(({ begin, end }) => begin <= time && time < end)?.name ?? null;
  }

  // What the hand senses and holds at the given time, as a line of text.
  label(time) {
    const sensed = this.force(time), held = this.holds(time), told = [];
    if (sensed) told.push(`force ${Math.hypot(...sensed.vector).toFixed(1)} N`);
    if (sensed && sensed.limit !== null) told.push(`limit ${sensed.limit.toFixed(1)} N`);
    if (held) told.push(`holds ${held}`);
    return told.join(" · ");
  }

  // Where the hand's tool centre point was at a time (m).
  tool({ body, at }, time) {
    const pose = this.player.pose(body, time);
    return pose && add(rotated(pose.slice(3), at), pose);
  }

  draw() {
    const { canvas, pen, player } = this, { clientWidth: w, clientHeight: h } = canvas;
    const points = Math.min(devicePixelRatio, FINEST), [width, height] = [w, h].map(side => Math.round(side * points));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    pen.setTransform(points, 0, 0, points, 0, 0);
    pen.clearRect(0, 0, w, h);
    if (!this.shown || !w) return;
    this.onto = player.projection(w, h);
    for (const tool of this.tools) this.drawPath(tool, player.time);
    if (this.tools.length !== 1) return;
    this.drawPlaces(this.tools[0], player.time);
    this.drawForce(this.tools[0], player.time);
  }

  drawPath(tool, time) {
    const first = Math.max(time - TRAILING, this.player.begin), count = Math.ceil((time - first) / TRAIL_STEP);
    let last = null;
    for (let i = 0; i <= count; i++) {
      const now = Math.min(first + i * TRAIL_STEP, time), place = this.tool(tool, now), at = place && this.onto(place);
      if (at && last) this.line([last, at], INKS.path, 2, 0.9 * (i / count));
      last = at;
    }
  }

  drawPlaces(tool, time) {
    for (const { times, found } of this.searches) {
      if (time < times[0] || time > times.at(-1) + LINGERING) continue;
      const tried = times.filter(each => each <= time), all = tried.length === times.length;
      const places = tried.map(each => this.tool(tool, each)).map(place => place && this.onto(place));
      places.forEach((at, i) => {
        if (!at) return;
        if (i && places[i - 1]) this.line([places[i - 1], at], INKS.tried, 1, 0.7);
        this.ring(at, all && found && i === tried.length - 1 ? INKS.found : INKS.tried);
      });
    }
  }

  // The arrow points to where the hand pushes.
  drawForce(tool, time) {
    const sensed = this.force(time), place = this.tool(tool, time);
    if (!sensed || !place) return;
    const size = Math.hypot(...sensed.vector);
    if (size < LEAST_FORCE) return;
    const long = Math.min(size * PER_NEWTON, LONGEST_ARROW) / size;
    const from = this.onto(place), to = this.onto(add(place, sensed.vector, long));
    if (from && to) this.arrow(from, to, sensed.limit !== null && size > sensed.limit ? INKS.strong : INKS.force, sensed.strength);
  }

  arrow(from, to, ink, strength) {
    const [x, y] = [to[0] - from[0], to[1] - from[1]], long = Math.hypot(x, y), head = clamp(long / 2, 4, 11);
    if (long < 1) return;
    const [u, v] = [x / long, y / long], neck = [to[0] - u * head, to[1] - v * head];
    const side = k => [neck[0] - v * head * k, neck[1] + u * head * k];
    this.line([from, neck], ink, 4, strength);
    const { pen } = this;
    pen.globalAlpha = strength;
    pen.beginPath();
    for (const [i, [px, py]] of [to, side(0.6), side(-0.6)].entries()) i ? pen.lineTo(px, py) : pen.moveTo(px, py);
    pen.closePath();
    Object.assign(pen, { strokeStyle: INKS.halo, lineWidth: 2, fillStyle: ink });
    pen.stroke();
    pen.fill();
    pen.globalAlpha = 1;
  }

  line(points, ink, width, strength) {
    const { pen } = this;
    pen.globalAlpha = strength;
    pen.beginPath();
    points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    for (const [strokeStyle, lineWidth] of [[INKS.halo, width + 2], [ink, width]]) {
      Object.assign(pen, { strokeStyle, lineWidth });
      pen.stroke();
    }
    pen.globalAlpha = 1;
  }

  ring([x, y], ink) {
    const { pen } = this;
    pen.beginPath();
    pen.arc(x, y, 4, 0, 2 * Math.PI);
    for (const [strokeStyle, lineWidth] of [[INKS.halo, 4], [ink, 2]]) {
      Object.assign(pen, { strokeStyle, lineWidth });
      pen.stroke();
    }
  }
}
