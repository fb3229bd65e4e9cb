// Shows the cell, and exchanges messages with the server. Another script handles the messages.
const live = (() => {
  "use strict";
  const byId = (id) => document.getElementById(id);
  const facts = JSON.parse(byId("facts").textContent);
  const poses = new Map(), heard = {};
  const KEPT = 2000; // rows of the log that are kept
  let player = null, socket = null, drives = false, left = false;

  // -- the cell ---------------------------------------------------------------------------------------

  async function unpacked(name) {
    const bytes = Uint8Array.from(atob(byId(name).textContent), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  }

  async function draw() {
    if (!byId("view")) return;
    try {
      const drawn = await createPlayer(byId("view"), await unpacked("scene"), await unpacked("tracks"), {});
      drawn.pose = (body) => poses.get(body) ?? null;
      drawn.overlay(byId("senses"), { tools: facts.tools });
      byId("views").replaceChildren(...drawn.views.map(viewButton));
      player = byId("view").player = drawn;
    } catch (error) {
      byId("view").hidden = true;
      byId("instead").textContent = error.message;
      byId("instead").hidden = false;
      return;
    }
    player.view(player.views.includes("work") ? "work" : player.views[0]);
    player.at(0);
    document.querySelector(".viewer").classList.add("drawn");
  }

  function viewButton(name) {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", textContent: name });
    button.addEventListener("click", () => player.view(name));
    return button;
  }

  /** Show a state of the cell: figures, joints, channels, and seven numbers for each body (NaN if it is hidden). */
  function moment(buffer) {
    const numbers = new Float32Array(buffer), [time, gap, ...force] = numbers.subarray(0, facts.figures);
    let at = facts.figures + facts.joints;
    const sensed = facts.channels.map(([name, unit, listed]) => [name, numbers[at++], unit, listed]);
    for (const body of facts.bodies) {
      const pose = Array.from(numbers.subarray(at, at += 7));
      if (pose[2] >= facts.lowest) poses.set(body, pose); else poses.delete(body);
    }
    byId("figures").textContent = [`${time.toFixed(2)} s`, ...place(), ...felt(gap, force), ...shown(sensed)].join(", ");
    if (facts.axes.length === facts.joints) turn(numbers.subarray(facts.figures, facts.figures + facts.joints));
    if (player) push(time, force);
    player?.at(time);
  }

  /** Draw an arrow for the force of the hand on its surroundings, in N. */
  function push(time, force) {
    player.senses.feel(time, force.some(Number.isNaN) ? null : force);
  }

  /** Show the place of the hand, in inches. */
  function place() {
    const [tool] = facts.tools, pose = tool && poses.get(tool.body);
    if (!pose) return [];
    const [x, y, z, w, ...v] = pose, at = tool.at;
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const t = cross(v, at).map((n) => 2 * n), u = cross(v, t);
    const hand = [x, y, z].map((n, k) => ((n + at[k] + w * t[k] + u[k]) / 0.0254).toFixed(2));
    return [`hand at (${hand.join(", ")}) in`];
  }

  /** Show each joint between its limits. Near a limit, the joint is marked. */
  function turn(joints) {
    const list = byId("axes");
    list.hidden = joints.some(Number.isNaN); // until the arm first moves
    if (list.hidden) return;
    if (!list.children.length) list.append(...facts.axes.map(axisRow));
    facts.axes.forEach(([, unit, size, lower, upper], number) => {
      const value = joints[number] / size, share = (value - lower) / (upper - lower), row = list.children[number];
      row.children[1].textContent = `${value.toFixed(1)} ${unit}`;
      row.children[2].firstChild.style.left = `${100 * Math.min(Math.max(share, 0), 1)}%`;
      row.classList.toggle("near", share < 0.05 || share > 0.95);
    });
  }

  function axisRow([name, unit, , lower, upper]) {
    const row = document.createElement("li"), bar = document.createElement("span");
    const told = [`${name}, ${lower.toFixed(0)} to ${upper.toFixed(0)} ${unit}`, ""];
    row.append(...told.map((textContent) => Object.assign(document.createElement("span"), { textContent })), bar);
    bar.append(document.createElement("i"));
    return row;
  }

  function shown(sensed) {
    const told = sensed.filter(([, value, , listed]) => listed && !Number.isNaN(value));
    return told.map(([name, value, unit]) => `${name} ${value.toPrecision(3)} ${unit}`.trim());
  }

  function felt(gap, force) {
    const told = Number.isNaN(gap) ? [] : [`gap ${(gap / 0.0254).toFixed(2)} in`];
    if (force.some(Number.isNaN)) return told;
    return [...told, `the hand presses with (${force.map((n) => (n / 0.27801385).toFixed(1)).join(", ")}) oz`];
  }

  // -- messages ---------------------------------------------------------------------------------------

  function tell(text) {
    const told = byId("told"), atEnd = told.scrollTop + told.clientHeight >= told.scrollHeight - 4;
    const rows = `${told.textContent}${text}\n`.split("\n");
    told.textContent = rows.slice(-KEPT).join("\n");
    if (atEnd) told.scrollTop = told.scrollHeight;
  }

  const HEARD = {
    television: (figure) => fill("television", figure),
    refused: (sentence) => tell(sentence),
    viewers: (count, { drives: mine, free }) => {
      drives = mine;
      byId("looking").textContent = `${count === 1 ? "1 viewer" : `${count} viewers`}; ${mine ? "you have control" : free ? "no viewer has control" : "another viewer has control"} `;
      byId("drive").hidden = mine;
      const driven = ".controls :is(button, select, input):not(#panic), .jogs button, #line";
      for (const each of document.querySelectorAll(driven)) each.disabled = !mine;
    },
    left: () => { left = true; byId("state").textContent = "the run has ended"; },
  };

  /** Show markup from the server, which has escaped all text in it. */
  function fill(name, markup) {
    byId(name).innerHTML = markup;
    byId(name).hidden = !markup;
  }

  function send(wish) {
    if (socket?.readyState === WebSocket.OPEN) socket.send(JSON.stringify(wish));
  }

  const say = (line) => send({ do: "say", line });

  function listen() {
    socket = new WebSocket(`ws://${location.host}/live${location.search}`);
    socket.binaryType = "arraybuffer";
    socket.addEventListener("message", ({ data }) => {
      if (typeof data !== "string") { moment(data); return; }
      const told = JSON.parse(data);
      for (const [name, act] of Object.entries({ ...HEARD, ...heard })) if (name in told) act(told[name], told);
    });
    socket.addEventListener("open", () => { byId("told").textContent = ""; byId("state").textContent = ""; });
    socket.addEventListener("close", () => {
      if (left) return;
      byId("state").textContent = "connection lost; trying again";
      setTimeout(listen, 1000);
    });
  }

  // -- beginning --------------------------------------------------------------------------------------

  /** Add handlers for further messages, by the names of the messages' fields. */
  const hear = (more) => Object.assign(heard, more);

  /** Begin, with further handlers for messages, by the names of the messages' fields. */
  function begin(more) {
    hear(more);
    for (const button of document.querySelectorAll(".say")) button.addEventListener("click", () => say(button.value));
    byId("panic").addEventListener("click", () => send({ do: "panic" }));
    byId("drive").addEventListener("click", () => send({ do: "drive" }));
    byId("form").addEventListener("submit", (event) => {
      event.preventDefault();
      say(byId("line").value);
      byId("line").value = "";
    });
    draw();
    listen();
  }

  return { byId, facts, say, tell, fill, begin, hear, driving: () => drives };
})();
