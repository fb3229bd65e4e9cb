"""The player shows a run in 3D on a page, with WebGL 2 and without any library.

A page contains the scene, the tracks of its bodies, and the script. Equal traces give equal bytes. The page
decompresses scene and tracks (`DecompressionStream("gzip")`) and passes them to the script:

```js
const player = await createPlayer(canvas, scene, tracks, options);
```

If the browser has no WebGL 2, the promise is rejected with an `Error`. The message of the error names what is missing.
Times are seconds since the run began. There are two options. `still`: the view changes at once instead of gliding; the
default follows the browser's setting for reduced motion. `exposures`: the number of pictures that are averaged when
nothing moves.

| member | |
|---|---|
| `begin`, `end`, `duration` | the range of the tracks, s |
| `at(seconds)`, `time` | show the run at a time; the time that is shown. Only the page advances the time |
| `views`, `view(name)` | names of the views, `room` first; change to a view |
| `names`, `pose(body, seconds)` | names of the bodies, as in `Trace.poses`; a body's position (m) and
quaternion w, x, y, z, or null if it is hidden |
| `pick(x, y)` | the displayed name of the body at a point of the canvas (CSS pixels), or null |
| `onpick` | null, or a function `(name, x, y)` that is called at each click |
| `projection(width, height)` | a function from a place in the world (m) to its point in a picture of this size (CSS
pixels), or to null if the place is behind the eye |
| `overlay(canvas, sensed)` | draw what the hand sensed on a second canvas over the view (`report/page/overlay.py` makes
`sensed`); returns an object with `force(time)`, `holds(time)`, `label(time)`,
`feel(time, force)` for live cells, and the switch `shown` |
| `settled()` | a promise that is fulfilled when the averaged picture is shown |
| `frames` | number of pictures drawn so far |
| `destroy()` | release canvas and graphics memory |

Gestures: one finger or the left button turns the view, two fingers or the right button move it, a pinch zooms. While
the canvas has the focus, the wheel and the plus and minus keys zoom, the arrow keys turn the view, and Shift with the
arrow keys moves it. The page sets the size of the canvas. The style `touch-action` of the canvas determines which
touches the canvas receives. With `none`, the canvas receives all touches; with `pan-y`, it receives all touches except
vertical scrolling.
"""

from pathlib import Path
from typing import Final

import numpy as np

from handeye.cell.posed import drawn_poses
from handeye.report.player import scene, tracks
from handeye.trace.messages import Poses
from handeye.trace.trace import Trace

__all__ = ["scene_bytes", "script", "shown_poses", "tracks_bytes"]

MODULES: Final = (
    "geometry", "packed", "tracks", "shaders", "graphics", "bodies", "shadows", "camera", "picture", "hands", "senses",
    "player",
)  # fmt: skip
"""Modules of the script, each after the modules from which it imports."""
SOURCES: Final = Path(__file__).with_name("script")


def scene_bytes(trace: Trace) -> bytes:
    """Return the surfaces, materials, names and views of a run's scene as compressed bytes."""
    return scene.scene_bytes(trace.scene)


def tracks_bytes(trace: Trace) -> bytes:
    """Return the tracks of all visible bodies, and the clock of the run, as compressed bytes."""
    begin, end = trace.covers
    return tracks.tracks_bytes(
        shown_poses(trace),
        times=trace.times,
        begin=begin,
        end=end,
        lowest=scene.lowest(trace.scene),
    )


def shown_poses(trace: Trace) -> dict[str, Poses]:
    """Return the poses of the visible bodies in all servo periods. The poses come from the trace or, for bodies that
    no run moves, from the scene.
    """
    model, poses = trace.scene, trace.poses
    shown = [model.body(body).name for body in range(1, model.nbody) if scene.seen(model, body)]
    drawn = drawn_poses(model, [name for name in shown if name not in poses], trace.times)
    return {name: poses[name] if name in poses else drawn[name].astype(np.float32) for name in shown}


def script() -> str:
    """Return the script, `const createPlayer = ...;`. The script contains all modules, so that a page can embed the
    script and permit it by its hash.
    """
    parts = [_plain((SOURCES / f"{name}.js").read_text("utf-8")) for name in MODULES]
    return f'const createPlayer = (() => {{\n"use strict";\n{"".join(parts)}return createPlayer;\n}})();\n'


def _plain(module: str) -> str:
    """Return a module without comments and import statements. It needs no imports, because all modules share one scope
    in the page.
    """
    lines = (line.strip().removeprefix("export ") for line in module.splitlines())
    return "".join(f"{line}\n" for line in lines if line and not line.startswith(("import ", "//")))
