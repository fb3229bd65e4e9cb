// The tables of a machine, cycle by cycle. A report reads them from its record; a live page receives them from the server.
const tables = (() => {
  "use strict";
  const byId = (id) => document.getElementById(id);
  const facts = JSON.parse(byId("tables-facts").textContent);
  const SVG = "http://www.w3.org/2000/svg", HIGH = 150, EDGE = 46, ACROSS = 16;
  let courses = new Map(); // by the word's number: its `values`, and the cycle in which each of them began
  let last = facts.last, cycle = 0, follows = true, picked = null, write = null, drawing = null;
  const open = new Set(facts.open), panels = new Map();

  // -- words ------------------------------------------------------------------------------------------

  /** Index of the last change of a course up to a cycle; -1 before the first. */
  function found(course, at) {
    let low = 0, high = course.cycles.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (course.cycles[middle] <= at) low = middle + 1; else high = middle;
    }
    return low - 1;
  }

  function value(number, at) {
    const course = courses.get(number), index = course ? found(course, at) : -1;
    return index < 0 ? 0 : course.values[index];
  }

  function changed(number, at) {
    const course = courses.get(number), index = course ? found(course, at) : -1;
    return index >= 0 && at > 0 && course.cycles[index] === at;
  }

  function set(at, number, word) {
    let course = courses.get(number);
    if (!course) courses.set(number, course = { cycles: [], values: [] });
    if (course.cycles.at(-1) === at) course.values[course.values.length - 1] = word;
    else { course.cycles.push(at); course.values.push(word); }
  }

  const segmentOf = (name, side) => facts.segments.find((each) => each.table === name && (!each.side || each.side === side));
  const placed = (segment, line, word) => segment.base + (line - 1) * segment.words + word - 1;
  const first = facts.segments[0].side;

  // -- the record -------------------------------------------------------------------------------------

  async function record() {
    const packed = Uint8Array.from(atob(byId("tables-record").textContent), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    let at = 0, number = -1;
    const next = () => {
      let result = 0, scale = 1;
      for (;;) {
        const byte = bytes[at++] ?? 0;
        result += (byte & 127) * scale;
        if (byte < 128) return result;
        scale *= 128;
      }
    };
    const sums = (count, unfold) => {
      let sum = 0;
      return Array.from({ length: count }, () => sum += unfold(next()));
    };
    const head = next();
    at += head;
    while (at < bytes.length) {
      number += 1 + next();
      const count = next();
      courses.set(number, { cycles: sums(count, (n) => n), values: sums(count, (n) => (n % 2 ? -(n + 1) / 2 : n / 2)) });
    }
  }

  // -- panels -----------------------------------------------------------------------------------------

  function make(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, content] of Object.entries(attributes)) {
      if (key in made) made[key] = content; else made.setAttribute(key, content);
    }
    made.append(...children);
    return made;
  }

  const named = (segment) => (segment.side && facts.arms > 1 ? `${segment.table} ${segment.side}` : segment.table);
  const keyOf = (segment) => `${segment.table} ${segment.side}`.trim();

  /** The lines to show. If the table has lines that are connected to a device: these, and all lines that change. If not: all lines that are not always 0. */
  function used(segment) {
    const lines = new Set(Object.keys(segment.labels).map(Number)), labelled = lines.size > 0;
    for (const [number, course] of courses) {
      const line = Math.floor((number - segment.base) / segment.words) + 1;
      if (line >= 1 && line <= segment.lines && (!labelled || course.cycles.at(-1) > 0)) lines.add(line);
    }
    return [...lines].sort((a, b) => a - b);
  }

  function build(segment) {
    const body = make("tbody"), cells = [], rows = new Map(), lines = used(segment);
    const cell = (line, word) => {
      const number = placed(segment, line, word);
      const made = make("td", { tabIndex: -1 });
      made.dataset.number = number;
      cells.push([number, made]);
      return made;
    };
    const head = make("tr");
    if (segment.words === 1 && !Object.keys(segment.labels).length) { // words without names, in rows
      const blocks = [...new Set(lines.map((line) => Math.floor((line - 1) / ACROSS)))];
      head.append(make("td"), ...Array.from({ length: Math.min(ACROSS, segment.lines) }, (_, n) => make("th", { textContent: `+${n}` })));
      for (const block of blocks) {
        const row = make("tr", {}, make("th", { scope: "row", textContent: block * ACROSS + 1 }));
        for (let line = block * ACROSS + 1; line <= Math.min((block + 1) * ACROSS, segment.lines); line++) row.append(cell(line, 1));
        body.append(row);
      }
    } else {
      const titles = segment.names.length === segment.words ? segment.names : Array.from({ length: segment.words }, (_, n) => `${n + 1}`);
      head.append(make("td"), ...titles.map((title) => make("th", { textContent: segment.words === 1 ? "word" : title, scope: "col" })));
      for (const line of lines) {
        const label = segment.labels[line] ?? (segment.table === "TK" ? facts.statements[line] ?? "" : "");
        const row = make("tr", {}, make("th", { scope: "row", title: label }, make("b", { textContent: line }), ` ${label}`));
        for (let word = 1; word <= segment.words; word++) row.append(cell(line, word));
        rows.set(line, row);
        body.append(row);
      }
    }
    const table = make("table", {}, make("thead", {}, head), body);
    const heading = make("h3", {}, make("b", { textContent: named(segment) }), ` ${segment.title}`);
    const left = segment.lines - lines.length;
    const note = lines.length === 0 ? "all words have always been 0" : left && rows.size ? `${left} unused ${left === 1 ? "line" : "lines"} left out` : "";
    const shown = make("div", { className: "panel" }, heading, make("div", { className: "words" }, table));
    if (note) shown.append(make("p", { className: "left-out", textContent: note }));
    shown.addEventListener("click", ({ target }) => {
      const at = target.closest("td")?.dataset.number;
      if (at !== undefined) pick(Number(at));
    });
    return { shown, cells, rows, segment, lines: lines.length };
  }

  function arrange() {
    const shown = facts.segments.filter((segment) => open.has(keyOf(segment)));
    for (const segment of shown) {
      const key = keyOf(segment);
      if (panels.get(key)?.lines !== used(segment).length) panels.set(key, build(segment));
    }
    byId("tables-panels").replaceChildren(...shown.map((segment) => panels.get(keyOf(segment)).shown));
    for (const button of byId("tables-names").children) button.setAttribute("aria-pressed", open.has(button.value));
    show();
  }

  function show() {
    for (const segment of facts.segments) {
      const panel = open.has(keyOf(segment)) && panels.get(keyOf(segment));
      if (!panel) continue;
      for (const [number, cell] of panel.cells) {
        const text = String(value(number, cycle)).replace("-", "−");
        if (cell.textContent !== text) cell.textContent = text;
        cell.classList.toggle("lit", changed(number, cycle));
        cell.classList.toggle("picked", number === picked);
      }
      if (segment.table === "ST") for (const [line, row] of panel.rows) mark(segment, line, row);
    }
    const lit = new Set();
    for (const number of courses.keys()) if (changed(number, cycle)) lit.add(tableOf(number));
    for (const button of byId("tables-names").children) button.classList.toggle("lit", lit.has(button.value));
    stand();
    cursor();
  }

  /** Show whether the flag of a sensor is on, and which of its limits are open. */
  function mark(segment, line, row) {
    const word = (n) => value(placed(segment, line, n), cycle);
    row.classList.toggle("flag", word(11) !== 0);
    row.children[8].classList.toggle("open", (word(10) & 1) !== 0);
    row.children[9].classList.toggle("open", (word(10) & 2) !== 0);
    row.children[13].classList.toggle("open", (word(15) & 1) !== 0);
    row.children[14].classList.toggle("open", (word(15) & 2) !== 0);
  }

  function segmentWith(number) {
    return facts.segments.find((each) => number >= each.base && number < each.base + each.lines * each.words);
  }
  const tableOf = (number) => keyOf(segmentWith(number));

  function stand() {
    const statement = value(placed(segmentOf("AR", first), 1, 3), cycle);
    const text = facts.statements[statement];
    const when = cycle > last ? `after cycle ${last}` : `cycle ${cycle}, ${(cycle / 100).toFixed(2)} s`;
    byId("tables-cycle").value = cycle;
    byId("tables-now").textContent = last < 0 ? "before the first cycle" : when;
    byId("tables-statement").textContent = statement ? `${statement} ${text ?? ""}` : "no stored statement is executed";
  }

  // -- the time line, and the course of a word --------------------------------------------------------

  const draw = (name, attributes) => {
    const made = document.createElementNS(SVG, name);
    for (const [key, content] of Object.entries(attributes)) made.setAttribute(key, content);
    return made;
  };
  let wide = 900;
  const x = (at) => EDGE + (at / Math.max(last, 1)) * (wide - EDGE - 2);

  /** Spans of cycles in which the value of a word fits. Each is a pair: its first cycle, and the first cycle after it. */
  function spans(number, fits) {
    const course = courses.get(number), result = [];
    let begun = course && course.cycles[0] === 0 ? null : fits(0) ? 0 : null;
    course?.cycles.forEach((at, n) => {
      if (fits(course.values[n])) begun ??= at;
      else if (begun !== null) { result.push([begun, at]); begun = null; }
    });
    if (begun !== null) result.push([begun, last + 1]);
    return result;
  }

  function timeline() {
    const strip = byId("tables-strip");
    wide = Math.max(strip.clientWidth, 300);
    strip.setAttribute("viewBox", `0 0 ${wide} 22`);
    const bars = [];
    for (const [from, to] of spans(placed(segmentOf("AR", first), 1, 2), (word) => word === 0)) {
      bars.push(draw("rect", { x: x(from), width: Math.max(x(to) - x(from), 1), y: 12, height: 8, class: "moves" }));
    }
    const sensors = segmentOf("ST", first);
    for (let line = 1; line <= sensors.lines; line++) {
      for (const [from, to] of spans(placed(sensors, line, 11), (word) => word !== 0)) {
        bars.push(draw("rect", { x: x(from) - 0.5, width: Math.max(x(to) - x(from), 2), y: 1, height: 8, class: "flags" }));
      }
    }
    const label = (y, text) => {
      const made = draw("text", { x: 0, y });
      made.textContent = text;
      return made;
    };
    strip.replaceChildren(label(8, "flags"), label(20, "motion"), ...bars, draw("line", { class: "cursor", y1: 0, y2: 22 }));
  }

  /** Words to plot together with the picked one: goals with a position, limits with a reading. */
  function companions(number) {
    const segment = segmentWith(number), word = (number - segment.base) % segment.words + 1, start = number - word;
    if (segment.table === "MT" && [1, 4, 5].includes(word)) return [4, 5, 1].map((n) => [start + n, segment.names[n - 1]]);
    if (segment.table === "ST" && word === 7) {
      const limit = (n, bit) => [start + n, segment.names[n - 1], (at) => (value(start + 10, at) & bit) === 0];
      return [limit(8, 1), limit(9, 2), [number, segment.names[6]]];
    }
    return [[number, segment.names[word - 1] ?? ""]];
  }

  function plot() {
    const box = byId("tables-plot");
    box.setAttribute("viewBox", `0 0 ${wide} ${HIGH}`);
    if (picked === null) { box.replaceChildren(); return; }
    const curves = companions(picked).map(([number, name, there]) => ({ number, name, there, course: courses.get(number) ?? { cycles: [], values: [] } }));
    const known = curves.flatMap(({ course, there }) => (there ? course.values.filter((_, n) => there(course.cycles[n])) : course.values));
    let low = Math.min(0, ...known.length < 1e5 ? known : [value(picked, 0)]), high = Math.max(0, ...known.length < 1e5 ? known : [value(picked, 0)]);
    if (known.length >= 1e5) for (const each of known) { low = Math.min(low, each); high = Math.max(high, each); }
    if (low === high) high = low + 1;
    const y = (word) => HIGH - 8 - ((word - low) / (high - low)) * (HIGH - 20);
    const drawn = [draw("line", { x1: EDGE, x2: wide, y1: y(0), y2: y(0), class: "axis" })];
    for (const [word, anchor] of [[low, 0], [high, 8]]) {
      const text = draw("text", { x: EDGE - 6, y: y(word) + (anchor ? 6 : 0), "text-anchor": "end" });
      text.textContent = String(word).replace("-", "−");
      drawn.push(text);
    }
    for (const { number, there, course } of curves) {
      let way = "", on = false, level = 0, begun = there ? there(0) : true;
      const to = (at, word, visible) => {
        if (visible && !on) way += `M${x(at).toFixed(1)},${y(word).toFixed(1)}`;
        else if (on) way += `H${x(at).toFixed(1)}`;
        if (visible && on && word !== level) way += `V${y(word).toFixed(1)}`;
        on = visible; level = word;
      };
      const moments = there ? [...new Set([...course.cycles, ...opened(number)])].sort((a, b) => a - b) : course.cycles;
      if (moments[0] !== 0) to(0, 0, begun);
      for (const at of moments) to(at, value(number, at), there ? there(at) : true);
      to(last, level, on);
      drawn.push(draw("path", { d: way, class: number === picked ? "course" : there ? "limit" : "beside" }));
    }
    box.replaceChildren(...drawn, draw("line", { class: "cursor", y1: 0, y2: HIGH }));
    const segment = segmentWith(picked), line = Math.floor((picked - segment.base) / segment.words) + 1, word = (picked - segment.base) % segment.words + 1;
    const place = segment.words === 1 ? `${named(segment)} ${line}` : `${named(segment)} ${line} ${word}`;
    const label = [segment.labels[line], segment.names[word - 1]].filter(Boolean).join(", ");
    const beside = curves.filter(({ number }) => number !== picked).map(({ name, there }) => (there ? `${name} limit` : name));
    byId("tables-picked").replaceChildren(make("b", { textContent: place }), ` ${label}`, ...(beside.length ? [make("span", { textContent: `; thin lines: ${beside.join(", ")}` })] : []));
  }

  const opened = (limit) => {
    const segment = segmentWith(limit), word = (limit - segment.base) % segment.words + 1;
    return courses.get(limit - word + 10)?.cycles ?? [];
  };

  function cursor() {
    for (const each of document.querySelectorAll(".tables .cursor")) {
      each.setAttribute("x1", x(Math.min(cycle, last)));
      each.setAttribute("x2", x(Math.min(cycle, last)));
    }
    if (picked !== null) byId("tables-value").textContent = String(value(picked, cycle)).replace("-", "−");
  }

  // -- what the user does -----------------------------------------------------------------------------

  function go(to) {
    cycle = Math.min(Math.max(Math.round(to), 0), last + 1);
    follows = cycle >= last;
    show();
  }

  function pick(number) {
    picked = number;
    plot();
    show();
    write?.(number);
  }

  /** Go to the next change of the picked word, or to the one before. */
  function change(way) {
    const changes = (courses.get(picked)?.cycles ?? []).filter((at) => at > 0);
    const next = way > 0 ? changes.find((at) => at > cycle) : changes.findLast((at) => at < cycle);
    if (next !== undefined) go(next);
  }

  function resized() {
    timeline();
    plot();
    cursor();
  }

  function range() {
    byId("tables-cycle").max = last + 1;
    timeline();
    plot();
  }

  function begin() {
    const steps = { "tables-first": () => go(0), "tables-back": () => go(cycle - 1), "tables-on": () => go(cycle + 1), "tables-last": () => go(last + 1) };
    for (const [id, act] of Object.entries(steps)) byId(id).addEventListener("click", act);
    byId("tables-before").addEventListener("click", () => change(-1));
    byId("tables-after").addEventListener("click", () => change(1));
    byId("tables-cycle").addEventListener("input", ({ target }) => go(Number(target.value)));
    for (const id of ["tables-strip", "tables-plot"]) {
      byId(id).addEventListener("click", (event) => {
        const left = byId(id).getBoundingClientRect().left;
        go(((event.clientX - left - EDGE) / (wide - EDGE - 2)) * Math.max(last, 1));
      });
    }
    byId("tables-names").addEventListener("click", ({ target }) => {
      const key = target.closest("button")?.value;
      if (!key) return;
      if (!open.delete(key)) open.add(key);
      arrange();
    });
    byId("tables-names").replaceChildren(...facts.segments.map((segment) => make("button", { type: "button", value: keyOf(segment), textContent: named(segment), title: segment.title })));
    new ResizeObserver(resized).observe(byId("tables-strip"));
    byId("tables-live").hidden = false;
    byId("tables-plain")?.remove();
    picked = facts.picked;
  }

  /** Show a finished run. */
  async function shown() {
    await record();
    begin();
    range();
    arrange();
    const moment = () => {
      const time = /^#t=([0-9.]+)$/.exec(location.hash);
      go(time ? Number(time[1]) * 100 : last + 1);
    };
    window.addEventListener("hashchange", moment);
    moment();
  }

  /** Begin to show a live run. `chosen` is called with the number of each word that the user picks. */
  function live(chosen) {
    write = chosen;
    begin();
    range();
    arrange();
    chosen(picked);
  }

  /** Take in changes, as triples: a cycle, the number of a word, and its value. If `restarted`, forget all earlier changes. */
  function feed(changes, passed, restarted) {
    if (restarted) { courses = new Map(); panels.clear(); }
    for (let n = 0; n < changes.length; n += 3) set(changes[n], changes[n + 1], changes[n + 2]);
    last = passed;
    if (follows || restarted) cycle = Math.max(last, ...changes.slice(-3, -2)); // the cycle of the last change
    drawing ??= requestAnimationFrame(() => {
      drawing = null;
      range();
      if (facts.segments.some((segment) => open.has(keyOf(segment)) && panels.get(keyOf(segment))?.lines !== used(segment).length)) arrange();
      else show();
    });
  }

  return { shown, live, feed, place: (number) => {
    const segment = segmentWith(number);
    return { table: segment.table, side: segment.side || first, line: Math.floor((number - segment.base) / segment.words) + 1, word: (number - segment.base) % segment.words + 1 };
  } };
})();
