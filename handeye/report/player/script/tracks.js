import { rowsOf, summed, unpacked } from "./packed.js";

const UNIT = 0x1fff; // the number that stands for 1 in a quaternion
const SAME = 1e-3; // resolution of times, as a fraction of a servo period

// Return how many of these increasing numbers are at most `value`.
export function countUpTo(numbers, value) {
  let low = 0, high = numbers.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (numbers[middle] <= value) low = middle + 1; else high = middle;
  }
  return low;
}

// The track of a body: spans of servo periods in which the body is present, and some poses in each span. All other
// poses are interpolated.
class Track {
  constructor({ spans, scale }, periods, places, turns) {
    let row = 0;
    this.spans = spans.map(([first, after, rows]) => ({ first, after, row, end: (row += rows) }));
    Object.assign(this, { scale, periods, places, turns });
  }

  pose(period) {
    const now = Math.floor(period + SAME), span = this.spans.find(({ first, after }) => first <= now && now < after);
    if (!span) return null;
    const times = this.periods.subarray(span.row, span.end), found = countUpTo(times, period + SAME) - 1;
    const one = Math.max(found, 0), other = Math.min(one + 1, times.length - 1);
    const share = other > one ? Math.min((period - times[one]) / (times[other] - times[one]), 1) : 0;
    return this.between(span.row + one, span.row + other, Math.max(share, 0));
  }

  between(one, other, share) {
    const { scale, places, turns } = this, pose = [];
    for (let k = 0; k < 3; k++) {
      const a = places[one * 3 + k], b = places[other * 3 + k];
      pose.push(scale[k] + scale[3] * (a + share * (b - a)));
    }
    for (let k = 0; k < 4; k++) {
      const a = turns[one * 4 + k], b = turns[other * 4 + k];
      pose.push((a + share * (b - a)) / UNIT);
    }
    const size = Math.hypot(pose[3], pose[4], pose[5], pose[6]);
    for (let k = 3; k < 7; k++) pose[k] /= size;
    return pose;
  }
}

// The tracks of all bodies in a run, and the run's clock.
export class Tracks {
  constructor(buffer) {
    const { header, array } = unpacked(buffer), { begin, end, still, moving } = header;
    Object.assign(this, { begin, end, tracks: new Map() });
    this.clock = Float64Array.from(array("clock"));
    this.clock.forEach((step, i, clock) => { clock[i] = i ? clock[i - 1] + step / 1e6 : step / 1e6; });
    for (const [body, pose] of Object.entries(still)) this.tracks.set(body, { pose: () => pose });
    const periods = summed(array("periods")), places = rowsOf(array("places"), 3);
    const turns = rowsOf(array("turns"), 4, Int16Array);
    let row = 0;
    for (const told of moving) {
      const end = row + told.spans.reduce((sum, span) => sum + span[2], 0);
      const part = (rows, width) => rows.subarray(row * width, end * width);
      this.tracks.set(told.body, new Track(told, part(periods, 1), part(places, 3), part(turns, 4)));
      row = end;
    }
  }

  // Return the number of the last servo period that ended by this time, plus the elapsed fraction of the next one.
  period(seconds) {
    const { clock } = this, i = Math.max(countUpTo(clock, seconds) - 1, 0);
    const span = i + 1 < clock.length ? clock[i + 1] - clock[i] : Infinity;
    return i + Math.max(0, Math.min(1, (seconds - clock[i]) / span));
  }

  // Return the position (m) and quaternion of a body, or null if the body is hidden.
  pose(body, seconds) {
    return this.tracks.get(body)?.pose(this.period(seconds)) ?? null;
  }
}
