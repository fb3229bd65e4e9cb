// Stepping: the current line of the script, breakpoints, and the operator's answers.
(() => {
  "use strict";
  const { byId, facts, say, tell } = live;
  const breaks = new Map();

  function stand({ script, line, stage_number: number, stage, tasks = [] }) {
    document.querySelector("#script li.on")?.classList.remove("on");
    for (const row of document.querySelectorAll("#script li.task")) { row.classList.remove("task"); row.removeAttribute("title"); }
    for (const task of tasks) {
      const row = byId(`line-${Math.max(facts.files.indexOf(task.file ?? ""), 0)}-${task.line}`);
      row?.classList.add("task");
      if (row) row.title = task.waits_for ? `${task.task} waits for ${task.waits_for}` : task.task;
    }
    if (line === null) return;
    const row = byId(`line-${Math.max(facts.files.indexOf(script), 0)}-${line}`);
    row?.classList.add("on");
    if (row) bring(row);
    if (stage) byId("state").textContent = `stage ${number}, ${stage}`;
  }

  /** Scroll the script, but not the page, until a row is visible. */
  function bring(row) {
    const box = byId("script"), top = row.getBoundingClientRect().top - box.getBoundingClientRect().top;
    if (top < 0 || top > box.clientHeight - 2 * row.clientHeight) box.scrollTop += top - box.clientHeight / 3;
  }

  /** Mark the lines with breakpoints. `told` lists one new breakpoint (if `more`) or all breakpoints. */
  function marked(more, told) {
    if (!more) breaks.clear();
    for (const { number, stop } of told) {
      if (stop.stop === "AtLine") breaks.set(`line-${facts.files.indexOf(stop.file ?? "")}-${stop.line}`, number);
    }
    for (const row of document.querySelectorAll("#script li")) row.classList.toggle("break", breaks.has(row.id));
  }

  byId("pace").addEventListener("change", () => say(`pace ${byId("pace").value}`));
  byId("script").addEventListener("click", ({ target }) => {
    const row = target.closest("li");
    if (!row || !live.driving()) return;
    const [, file, line] = row.id.split("-");
    const name = facts.files[Number(file)];
    say(breaks.has(row.id) ? `delete ${breaks.get(row.id)}` : `break ${name ? `${name}:` : ""}${line}`);
  });
  live.begin({
    under_way: (step) => { stand(step); tell(`${String(step.line).padStart(5)} ${step.text.replace(/\s+/g, " ")}`); },
    reply: (reply, { shown, called, pace }) => {
      tell(`> ${reply.command}\n${shown}`);
      stand(reply);
      const { pause } = reply;
      if (pause) byId("state").textContent = pause.sentence;
      byId("answers").hidden = !called;
      byId("pace").value = pace === null ? "free" : `${pace}x`;
      if (reply.breaks) marked(reply.command.startsWith("break "), reply.breaks);
    },
  });
})();
