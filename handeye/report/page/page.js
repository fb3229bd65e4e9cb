"use strict";
(() => {
  const run = JSON.parse(document.getElementById("moments").textContent);
  const byId = (name) => document.getElementById(name);
  const [screen, slider, clock, play, speed] = ["strip", "time", "clock", "play", "speed"].map(byId);
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const photographs = [...screen.querySelectorAll("figure")];
  const bars = [...byId("stages").children];
  const pictures = [...document.querySelectorAll("#seen figure")];
  let now = run.show, playing = false, last = 0, lit = null, player = null, senses = null, televised = null;

  // -- finding what belongs to a moment --------------------------------------------------------------------

  /** Return the number of the last row that begins at or before a time; -1 if there is none. */
  function rowAt(rows, time) {
    let first = 0, behind = rows.length;
    while (first < behind) {
      const middle = (first + behind) >> 1;
      if (rows[middle][0] <= time + 1e-6) first = middle + 1; else behind = middle;
    }
    return first - 1;
  }

  function told(time) {
    const tenths = Math.floor(Math.max(0, time) * 10 + 1e-6);
    return `${Math.floor(tenths / 600)}:${String(Math.floor(tenths / 10) % 60).padStart(2, "0")}.${tenths % 10}`;
  }

  // -- showing it -----------------------------------------------------------------------------------

  function show(time) {
    now = Math.min(Math.max(time, run.begin), run.end);
    slider.value = now;
    slider.setAttribute("aria-valuetext", told(now));
    clock.textContent = told(now);
    const stage = rowAt(run.stages, now), step = rowAt(run.steps, now);
    bars.forEach((bar, number) => {
      bar.classList.toggle("on", number === stage);
      bar.setAttribute("aria-current", number === stage);
    });
    light(step < 0 ? null : byId(run.steps[step][1]));
    caption(stage);
    if (player) player.at(now); else photograph();
    if (senses) sense();
  }

  // -- what the hand sensed, and the last picture, over the view ---------------------------------------------

  function sense() {
    const label = senses.label(now);
    byId("hand-label").textContent = label;
    byId("hand-label").hidden = !senses.shown || !label;
    televise(pictures.filter((figure) => Number(figure.dataset.time) <= now + 1e-6).at(-1));
  }

  /** Show a picture of the camera in the corner of the view, with its age. */
  function televise(figure) {
    const frame = byId("television");
    frame.hidden = !senses.shown || !figure;
    if (!figure) return;
    if (figure !== televised) {
      const name = figure.querySelector("b").textContent.split(",")[0];
      frame.replaceChildren(figure.querySelector(".picture").cloneNode(true), document.createElement("p"));
      frame.dataset.name = name;
      televised = figure;
    }
    const age = now - Number(figure.dataset.time);
    frame.lastChild.textContent = `${frame.dataset.name}, ${age < 1 ? "now" : `${told(age)} ago`}`;
  }

  /** Highlight the current line, and scroll the script until it is visible. The page itself does not scroll. */
  function light(line) {
    if (line === lit) return;
    if (lit) lit.classList.remove("on");
    lit = line;
    if (!line) return;
    line.classList.add("on");
    const frame = byId("script"), above = line.getBoundingClientRect().top - frame.getBoundingClientRect().top;
    if (above < 40 || above > frame.clientHeight - 60) frame.scrollTop += above - frame.clientHeight / 3;
  }

  function caption(stage) {
    const said = rowAt(run.told, now), begin = stage < 0 ? 0 : run.stages[stage][0];
    const name = document.createElement("b");
    name.textContent = stage < 0 ? "" : run.stages[stage][2];
    byId("caption").replaceChildren(name, said < 0 || run.told[said][0] < begin ? "" : run.told[said][1]);
  }

  /** Show the last photograph taken up to the present moment. */
  function photograph() {
    const taken = photographs.filter((figure) => Number(figure.dataset.time) <= now + 1e-6);
    const shown = taken.at(-1) ?? photographs[0];
    photographs.forEach((figure) => figure.classList.toggle("on", figure === shown));
  }

  // -- going through it -----------------------------------------------------------------------------

  function go(on) {
    playing = on;
    play.textContent = on ? "Pause" : "Play";
    if (on && now >= run.end) show(run.begin);
    if (on) { last = 0; requestAnimationFrame(advance); } else keep();
  }

  function advance(time) {
    if (!playing) return;
    if (last) show(now + (time - last) / 1000 * Number(speed.value));
    last = time;
    if (now >= run.end) go(false); else requestAnimationFrame(advance);
  }

  /** Put the moment into the address of the page, so that a copied address leads to it. */
  function keep() {
    history.replaceState(null, "", `#t=${now.toFixed(2)}`);
  }

  function seek(time) {
    show(time);
    keep();
  }

  /** Go forwards or back by rows. Back leads first to the beginning of the present row, unless it has just begun. */
  function skip(rows, by) {
    const here = rowAt(rows, now);
    const next = by < 0 && here >= 0 && now > rows[here][0] + 0.2 ? here : here + by;
    if (rows.length) seek(rows[Math.min(Math.max(next, 0), rows.length - 1)][0]);
  }

  function faster(by) {
    speed.selectedIndex = Math.min(Math.max(speed.selectedIndex + by, 0), speed.length - 1);
  }

  function addressed() {
    const found = /^#t=(\d+(?:\.\d+)?)$/.exec(location.hash);
    return found ? Number(found[1]) : null;
  }

  // -- views ----------------------------------------------------------------------------------------

  function choose(name) {
    player.view(name);
    for (const button of byId("views").children) button.setAttribute("aria-pressed", button.value === name);
  }

  function viewButton(name, number) {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", value: name, textContent: name, title: `view: ${number + 1}` });
    button.setAttribute("aria-keyshortcuts", String(number + 1));
    button.addEventListener("click", () => choose(name));
    return button;
  }

  async function unpacked(name) {
    const bytes = Uint8Array.from(atob(byId(name).textContent), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  }

  /** Show the 3D view instead of the photographs, if the browser can draw it. */
  async function draw() {
    if (!byId("scene")) return;
    const canvas = byId("view");
    canvas.hidden = false;
    try {
      const drawn = await createPlayer(canvas, await unpacked("scene"), await unpacked("tracks"), {});
      drawn.onpick = picked;
      byId("views").replaceChildren(...drawn.views.map(viewButton));
      player = canvas.player = drawn;  // for tests
    } catch (error) {
      canvas.hidden = true;
      byId("instead").textContent = `${error.message} Photographs replace the view.`;
      byId("instead").hidden = false;
      return;
    }
    senses = player.overlay(byId("senses"), JSON.parse(byId("sensed").textContent));
    choose(player.views.includes(run.view) ? run.view : player.views[0]);
    show(now);
    byId("run").classList.add("drawn");
  }

  function picked(name) {
    byId("picked").textContent = name ?? "";
    byId("picked").hidden = !name;
  }

  // -- keys -----------------------------------------------------------------------------------------

  const KEYS = {
    " ": () => go(!playing),
    ArrowLeft: (event) => skip(event.shiftKey ? run.stages : run.steps, -1),
    ArrowRight: (event) => skip(event.shiftKey ? run.stages : run.steps, 1),
    "[": () => faster(-1),
    "]": () => faster(1),
    m: () => byId("marks")?.click(),
    s: () => byId("sensing").click(),
  };

  function pressed(event) {
    const own = event.target.closest("button, a, select, summary, input[type=checkbox]");
    if (event.ctrlKey || event.altKey || event.metaKey || (event.key === " " && own)) return;
    if (own?.matches("select") && event.key.startsWith("Arrow")) return;
    const view = player?.views[Number(event.key) - 1];
    if (view) choose(view); else if (KEYS[event.key]) KEYS[event.key](event); else return;
    event.preventDefault();
  }

  // -- beginning ------------------------------------------------------------------------------------

  document.documentElement.classList.add("live");
  ["controls", "keys", "caption"].forEach((name) => { byId(name).hidden = false; });
  play.addEventListener("click", () => go(!playing));
  slider.addEventListener("input", () => show(Number(slider.value)));
  slider.addEventListener("change", keep);
  byId("sensing").addEventListener("change", (event) => {
    if (!senses) return;
    senses.shown = event.target.checked;
    senses.draw();
    sense();
  });
  addEventListener("keydown", pressed);
  addEventListener("hashchange", () => {
    const time = addressed();
    if (time === null) return;
    show(time);
    byId("run").scrollIntoView({ behavior: calm ? "auto" : "smooth" });
  });
  show(addressed() ?? run.show);
  draw();
})();
