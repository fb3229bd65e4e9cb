const STEP = 0.08; // effect of a key: rad, or a fraction of the picture's height
const GRIP = 0.006; // rad per point of a drag
const SHAKE = 4; // points; a press that moves less is a click

const KEYS = {
  ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
};

// Handle mouse, touch and keys on a canvas until `signal` aborts. `moved` is called after each change of the camera.
export function listen(canvas, camera, { moved, clicked, signal }) {
  const fingers = new Map();
  let travelled = 0;
  const on = (name, act, options) => canvas.addEventListener(name, act, { signal, ...options });

  on("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    if (fingers.size === 1) travelled = 0; else travelled = Infinity; // a pinch is not a click
  });

  on("pointermove", event => {
    const old = fingers.get(event.pointerId), now = [event.offsetX, event.offsetY];
    if (!old) return;
    const right = now[0] - old[0], down = now[1] - old[1];
    travelled += Math.hypot(right, down);
    if (travelled < SHAKE) return;
    fingers.set(event.pointerId, now);
    const height = canvas.clientHeight;
    if (fingers.size > 1) {
      const [, other] = [...fingers].find(([id]) => id !== event.pointerId);
      const apart = point => Math.max(1, Math.hypot(point[0] - other[0], point[1] - other[1]));
      camera.zoom(apart(old) / apart(now));
      camera.pan(right / 2 / height, -down / 2 / height);
    } else if (event.buttons & 2 || event.shiftKey) camera.pan(right / height, -down / height);
    else camera.orbit(right * GRIP, down * GRIP);
    moved();
  });

  const released = event => {
    const click = event.type === "pointerup" && fingers.size === 1 && travelled < SHAKE && event.button === 0;
    fingers.delete(event.pointerId);
    if (click) clicked(event.offsetX, event.offsetY);
  };
  on("pointerup", released);
  on("pointercancel", released);
  on("contextmenu", event => event.preventDefault());

  on("wheel", event => { // zooms if the canvas has the focus, and otherwise scrolls the page
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    camera.zoom(Math.exp(0.0022 * Math.max(-60, Math.min(60, event.deltaY))));
    moved();
  }, { passive: false });

  on("keydown", event => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const way = KEYS[event.key], nearer = { "+": 0.9, "=": 0.9, "-": 1 / 0.9 }[event.key];
    if (way && event.shiftKey) camera.pan(-way[0] * STEP, -way[1] * STEP);
    else if (way) camera.orbit(way[0] * STEP, way[1] * STEP);
    else if (nearer) camera.zoom(nearer);
    else return;
    event.preventDefault();
    event.stopPropagation();
    moved();
  });
}
