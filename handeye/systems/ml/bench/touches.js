// Touches for each period, bandwidth and speed. Sliders choose one touch; four drawings show it among the others.
(() => {
  "use strict";
  const byId = (id) => document.getElementById(id);
  const data = JSON.parse(byId("touches").textContent);
  const NAMES = ["period", "bandwidth", "speed"], SVG = "http://www.w3.org/2000/svg";
  const LEFT = 40, RIGHT = 520, TOP = 14, BOTTOM = 216;
  const chosen = () => NAMES.map((name) => Number(byId(name).value));
  const touch = (p, f, v) => data.touches[(p * data.bandwidth.length + f) * data.speed.length + v];

  const draw = (name, attributes, text) => {
    const made = document.createElementNS(SVG, name);
    for (const [key, content] of Object.entries(attributes)) made.setAttribute(key, content);
    if (text !== undefined) made.textContent = text;
    return made;
  };
  const scale = (low, high, begin, end) => (value) => begin + ((value - low) / (high - low)) * (end - begin);
  const nice = (most) => {
    const unit = 10 ** Math.floor(Math.log10(most / 2));
    return [1, 2, 5, 10].map((n) => n * unit).find((step) => most / step <= 5);
  };

  function axes(low, high, y, unit) {
    const step = nice(high - low), drawn = [];
    for (let at = Math.ceil(low / step - 1e-9) * step; at <= high + 1e-9; at += step) {
      drawn.push(draw("line", { x1: LEFT, x2: RIGHT, y1: y(at), y2: y(at), class: "grid" }));
      drawn.push(draw("text", { x: LEFT - 6, y: y(at) + 3.5, "text-anchor": "end" }, String(Number(at.toFixed(3))).replace("-", "−")));
    }
    return drawn;
  }

  const way = (xs, ys) => `M${xs.map((x, n) => `${x.toFixed(1)},${ys[n].toFixed(1)}`).join("L")}`;

  /** Plot a value of the touch against time. */
  function course(name, values, one, period, others) {
    const times = values.map((_, n) => one.begin + n), shown = times.map((time) => time >= -30 && time <= 100);
    const xs = scale(-30, 100, LEFT, RIGHT), visible = [...values, ...(others ?? [])].filter((_, n) => shown[n % values.length]);
    const low = Math.max(Math.min(...visible, 0), name === "place" ? -2 : -Infinity), high = Math.max(...visible) * 1.06;
    const y = scale(low, high, BOTTOM, TOP), drawn = axes(low, high, y);
    if (name === "place") {
      for (let at = one.reading; at <= 100; at += period) {
        if (at < -30) continue;
        const noticed = one.noticed !== null && Math.abs(at - one.noticed) < 0.01;
        drawn.push(draw("line", { x1: xs(at), x2: xs(at), y1: BOTTOM, y2: noticed ? TOP : BOTTOM - 7, class: noticed ? "reading noticed" : "reading" }));
      }
    }
    drawn.push(draw("line", { x1: xs(0), x2: xs(0), y1: TOP, y2: BOTTOM, class: "axis" }));
    for (const time of [-20, 0, 20, 40, 60, 80, 100]) {
      drawn.push(draw("text", { x: xs(time), y: BOTTOM + 16, "text-anchor": "middle" }, time === 100 ? "100 ms" : String(time).replace("-", "−")));
    }
    const path = (ys, kind) => {
      const kept = times.map((_, n) => n).filter((n) => shown[n] && ys[n] >= low);
      drawn.push(draw("path", { d: way(kept.map((n) => xs(times[n])), kept.map((n) => y(ys[n]))), class: kind }));
    };
    if (others) path(others, "goal");
    path(values, "course");
    byId(name).replaceChildren(...drawn);
  }

  /** Plot a figure of all touches with the chosen bandwidth against their speed. */
  function compared(name, figure, [period, bandwidth, speed]) {
    const xs = scale(Math.log(data.speed[0]), Math.log(data.speed.at(-1)), LEFT + 10, RIGHT - 40);
    const all = data.period.flatMap((_, p) => data.speed.map((_, v) => touch(p, bandwidth, v)[figure]));
    const low = Math.min(...all) * 0.8, high = Math.max(...all);
    const log = scale(Math.log(low), Math.log(high), BOTTOM, TOP), y = (value) => log(Math.log(value)), drawn = [];
    for (const at of [0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200].filter((each) => each > low && each <= high)) {
      drawn.push(draw("line", { x1: LEFT, x2: RIGHT - 30, y1: y(at), y2: y(at), class: "grid" }));
      drawn.push(draw("text", { x: LEFT - 6, y: y(at) + 3.5, "text-anchor": "end" }, String(at)));
    }
    data.speed.forEach((each) => drawn.push(draw("text", { x: xs(Math.log(each)), y: BOTTOM + 16, "text-anchor": "middle" }, String(each))));
    const order = [...data.period.keys()].sort((a, b) => (a === period) - (b === period));
    for (const p of order) {
      const ours = p === period ? "" : "other", found = data.speed.map((_, v) => touch(p, bandwidth, v));
      const across = data.speed.map((each) => xs(Math.log(each))), up = found.map((each) => y(each[figure]));
      drawn.push(draw("path", { d: way(across, up), class: ours }));
      found.forEach((each, v) => drawn.push(draw("circle", { cx: across[v], cy: up[v], r: p === period && v === speed ? 5.5 : 2.6, class: `${ours} ${each.trips ? "hollow" : ""}` })));
      drawn.push(draw("text", { x: RIGHT - 28, y: up.at(-1) + 3.5, class: ours ? "" : "chosen" }, `${data.period[p]} ms`));
    }
    byId(name).replaceChildren(...drawn);
  }

  function show() {
    const at = chosen(), one = touch(...at), period = data.period[at[0]];
    NAMES.forEach((name, n) => { byId(`${name}-shown`).textContent = data[name][at[n]]; });
    const noticed = one.noticed === null ? "The limit is never noticed." : `The limit is noticed ${one.noticed.toFixed(1)} ms after the contact.`;
    const air = one.trips ? ` When the motion starts, a jolt of ${one.jolt.toFixed(1)} N acts on a finger. If the guard were set at the start of the motion, this jolt would trip the guard in the air.` : "";
    byId("said").textContent = `${noticed} After the contact, the slide moves on by ${one.way.toFixed(2)} mm, and the fingers press with up to ${one.force.toFixed(1)} N.${air}`;
    course("place", one.places, one, period, one.goals);
    course("force", one.forces, one, period);
    compared("ways", "way", at);
    compared("forces", "force", at);
  }

  for (const name of NAMES) byId(name).addEventListener("input", show);
  show();
})();
