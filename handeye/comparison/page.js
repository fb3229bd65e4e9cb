"use strict";
(() => {
  const legs = JSON.parse(document.getElementById("moments").textContent);
  const byId = (name) => document.getElementById(name);
  const [slider, play, speed] = ["time", "play", "speed"].map(byId);
  const sides = ["a", "b"], end = legs.at(-1)[0];
  let now = 0, playing = false, last = 0, players = [];

  // -- where both runs stand --------------------------------------------------------------------------

  /** Return the index of the leg at the given time: the last leg that has begun by then, never the end itself. */
  function legAt(time) {
    let first = 0, behind = legs.length - 1;
    while (first < behind) {
      const middle = (first + behind) >> 1;
      if (legs[middle][0] <= time + 1e-6) first = middle + 1; else behind = middle;
    }
    return Math.max(first - 1, 0);
  }

  /** Convert a time on the common timeline to the time of one of the runs, in s since this run began. */
  function moment(leg, side, time) {
    const [begin, ...from] = legs[leg], [over, ...to] = legs[leg + 1];
    const share = over > begin ? Math.min(Math.max((time - begin) / (over - begin), 0), 1) : 0;
    return from[side] + share * (to[side] - from[side]);
  }

  function told(time) {
    const tenths = Math.floor(Math.max(0, time) * 10 + 1e-6);
    return `${Math.floor(tenths / 600)}:${String(Math.floor(tenths / 10) % 60).padStart(2, "0")}.${tenths % 10}`;
  }

  function show(time) {
    now = Math.min(Math.max(time, 0), end);
    slider.value = now;
    const leg = legAt(now);
    sides.forEach((name, side) => {
      const at = moment(leg, side, now);
      byId(`clock-${name}`).textContent = told(at);
      byId(`line-${name}`).textContent = legs[leg][3 + side] || "waits";
      players[side]?.at(at);
      felt(name, players[side], at);
    });
    slider.setAttribute("aria-valuetext", sides.map((name) => byId(`clock-${name}`).textContent).join(", "));
  }

  function felt(name, player, time) {
    const label = player ? player.senses.label(time) : "";
    byId(`hand-label-${name}`).textContent = label;
    byId(`hand-label-${name}`).hidden = !label;
  }

  // -- going through it ---------------------------------------------------------------------------------

  function go(on) {
    playing = on;
    play.textContent = on ? "Pause" : "Play";
    if (on && now >= end) show(0);
    if (on) { last = 0; requestAnimationFrame(advance); } else keep();
  }

  function advance(time) {
    if (!playing) return;
    if (last) show(now + (time - last) / 1000 * Number(speed.value));
    last = time;
    if (now >= end) go(false); else requestAnimationFrame(advance);
  }

  function keep() {
    history.replaceState(null, "", `#t=${now.toFixed(2)}`);
  }

  /** Go to the next leg, or back. Back leads first to the beginning of the present leg, unless it has just begun. */
  function skip(by) {
    const here = legAt(now);
    const next = by < 0 && now > legs[here][0] + 0.2 ? here : here + by;
    show(legs[Math.min(Math.max(next, 0), legs.length - 1)][0]);
    keep();
  }

  function addressed() {
    const found = /^#t=(\d+(?:\.\d+)?)$/.exec(location.hash);
    return found ? Number(found[1]) : null;
  }

  // -- views --------------------------------------------------------------------------------------------

  function choose(name) {
    players.forEach((player) => player.view(name));
    for (const button of byId("views").children) button.setAttribute("aria-pressed", button.value === name);
  }

  function viewButton(name) {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", value: name, textContent: name });
    button.addEventListener("click", () => choose(name));
    return button;
  }

  async function unpacked(name) {
    const bytes = Uint8Array.from(atob(byId(name).textContent), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  }

  async function drawn(name) {
    const canvas = byId(`view-${name}`);
    canvas.hidden = false;
    const player = await createPlayer(canvas, await unpacked(`scene-${name}`), await unpacked(`tracks-${name}`), {});
    player.overlay(byId(`senses-${name}`), JSON.parse(byId(`sensed-${name}`).textContent));
    return canvas.player = player;
  }

  async function draw() {
    if (!byId("scene-a")) return;
    try {
      players = await Promise.all(sides.map(drawn));
    } catch (error) {
      players = [];
      byId("instead").textContent = error.message;
      byId("instead").hidden = false;
      return;
    }
    const both = players[0].views.filter((name) => players[1].views.includes(name));
    byId("views").replaceChildren(...both.map(viewButton));
    choose(both.includes("hand") ? "hand" : both[0]);
    show(now);
    byId("run").classList.add("drawn");
  }

  // -- beginning ----------------------------------------------------------------------------------------

  const KEYS = { " ": () => go(!playing), ArrowLeft: () => skip(-1), ArrowRight: () => skip(1) };

  addEventListener("keydown", (event) => {
    const own = event.target.closest("button, a, select, summary");
    if (event.ctrlKey || event.altKey || event.metaKey || (event.key === " " && own) || !KEYS[event.key]) return;
    if (own?.matches("select") || event.target.closest("canvas")) return;
    KEYS[event.key]();
    event.preventDefault();
  });
  document.documentElement.classList.add("live");
  byId("controls").hidden = false;
  play.addEventListener("click", () => go(!playing));
  slider.addEventListener("input", () => show(Number(slider.value)));
  slider.addEventListener("change", keep);
  addEventListener("hashchange", () => {
    const time = addressed();
    if (time === null) return;
    show(time);
    byId("run").scrollIntoView();
  });
  show(addressed() ?? Number(slider.getAttribute("value")));
  draw();
})();
