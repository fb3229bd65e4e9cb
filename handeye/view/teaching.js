// Teaching: buttons that move the arm by a step, and the form that records the arm's place.
(() => {
  "use strict";
  const { byId, say, tell } = live;

  for (const button of document.querySelectorAll(".jogs button")) {
    button.addEventListener("click", () => {
      const [way, sign] = [button.value.slice(0, -1), button.value.slice(-1)];
      say(`${way.replace("FRAME", byId("frame").value)}${sign}${byId(button.dataset.step).value}`);
    });
  }
  byId("go").addEventListener("click", () => byId("record").reportValidity() && say(`move ${byId("name").value}`));
  byId("record").addEventListener("submit", (event) => {
    event.preventDefault();
    const part = byId("part").value, again = byId("again").checked;
    say(`here ${byId("name").value}${part ? ` of ${part}` : ""}${again ? " again" : ""}`);
  });
  live.begin({
    begun: (line) => { tell(`> ${line}`); byId("state").textContent = "the arm is moving"; },
    answer: (shown, { afloat, unsaved, taught }) => {
      if (shown) tell(shown);
      live.fill("taught", taught);
      const held = afloat ? "The brakes are off: push the arm where you want it." : "The arm is held.";
      byId("state").textContent = unsaved.length ? `${held} Not saved: ${unsaved.join(", ")}.` : held;
    },
  });
})();
