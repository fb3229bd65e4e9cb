"""The simulated television camera: the designed camera with the errors of the world, behind the device interface."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Final, Literal

import mujoco
import numpy as np

from handeye.cell.device_errors import CameraErrors
from handeye.cell.mechanism import Mechanism
from handeye.cell.opengl import OpenGlRenderer
from handeye.cell.raster import HALF
from handeye.cell.raycasting import RayRenderer, cast
from handeye.cell.rendering import RendererMaker, SceneRenderer
from handeye.cell.signal_lines import SOUND, SignalLines
from handeye.cell.state import check_noise, finite, noise_state, set_noise
from handeye.cell.vidicon import Vidicon, blur_disc
from handeye.core.errors import InvalidInput, NoSuchName, Refused
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.core.units import DEGREE
from handeye.ports.camera import FIRST_LENS, Picture, Renderer, TvCamera
from handeye.vision.camera_model import CameraModel, View

TURRET: Final = 20.0  # s for which the turret turns
SLEW: Final = 5 * DEGREE  # rad/s of pan and of tilt, which turn together
REFOCUS: Final = 0.0347
"""Speed of refocusing, in 1/m per second: a focus ring turns in proportion to the reciprocal of the distance. The
paper gives 90 s for all lens changes and focusing. With `TURRET`, `SLEW` and `REFOCUS`, the camera's movements and
pictures for one pump take 90 s: 40 s for the turret, 12 s for turning by 60 degrees, 36 s for refocusing by 1.25 1/m,
and 2 s for four pictures. Section 6 of the layout study divides the 90 s in this way.
"""


class CameraState(Record, frozen=True, kw_only=True):
    """State of the camera's mechanism and tube."""

    noise: str  # state of its generator, as JSON
    lens: float
    pots: tuple[float, float]
    stand: tuple[float, float]  # true pan and tilt, in rad
    focus: float | None  # in m; None for infinity
    gain: float | None


class SimulatedCamera(Mechanism[CameraState], TvCamera):
    """The television camera of a simulated cell."""

    name = "camera"
    kind = CameraState

    def __init__(
        self,
        data: mujoco.MjData,
        errors: CameraErrors,
        rng: np.random.Generator,
        renderer: SceneRenderer,
        drawing: CameraModel,
        lines: SignalLines = SOUND,
    ) -> None:
        """Make a camera that takes pictures of the simulated scene in its state `data`. The camera never changes
        `data`.

        `rng` generates the noise of tube and mount. The signal lines are `picture`, `turret` (the commanded focal
        length, m), and `camera.pan` and `camera.tilt` (the true angles of the mount, rad).
        """
        self._data = data
        self._lines = lines
        self._rng = rng
        self._renderer = renderer
        self._pot_noise = errors.pot_noise
        self._raster, self._drift = errors.raster, errors.drift
        self._model = true_camera(errors, drawing)
        self._vidicon = Vidicon(rng)
        self._lens = self._model.lens(FIRST_LENS).focal_length
        self._pots = self._stand = (0.0, 0.0)
        self._focus = math.inf

    def lens(self, focal_length: float) -> float:
        wanted = self._model.lens(focal_length).focal_length
        chosen = self._lines.carried("turret", wanted)
        if chosen == self._lens:
            return 0.0
        self._lens = chosen
        self._focus = math.inf
        return TURRET

    def aim(self, pan: float, tilt: float) -> float:
        finite((pan, tilt), "the aim of the camera")
        if (pan, tilt) == self._pots:
            return 0.0
        way = max(abs(pan - self._pots[0]), abs(tilt - self._pots[1]))
        self._pots = (pan, tilt)
        wobble = self._rng.normal(0.0, self._pot_noise, 2) if self._pot_noise else np.zeros(2)
        self._stand = (pan + float(wobble[0]), tilt + float(wobble[1]))
        return way / SLEW

    def focus(self, distance: float) -> float:
        nearest = max(lens.focal_length for lens in self._model.lenses)
        if not distance > nearest:
            raise Refused(f"the camera cannot be focused at {distance:g} m; the minimum is {nearest:g} m")
        way = abs(1 / distance - 1 / self._focus)
        self._focus = distance
        return way / REFOCUS

    def pots(self) -> tuple[float, float]:
        return self._pots

    @contextmanager
    def without_shadows(self) -> Iterator[None]:
        """Draw pictures without shadows while the context is open. This idealisation is for pictures of the lamp on
        the arm.

        The lamp is found from two pictures, one with the lamp on and one with the lamp off. Shadows are the same in
        both pictures.
        """
        self._renderer.shadows = False
        try:
            yield
        finally:
            self._renderer.shadows = True

    def digitise(self, *, hold_target: bool = False) -> Picture:
        view = self.true_view()
        drift = self._rng.normal(0.0, self._drift, 2) * HALF if self._drift else np.zeros(2)
        light = self._raster.read(self._renderer.render(self._data, view), drift)
        X_WC = view.X_WC
        geom, distance, _ = cast(self._data.model, self._data, X_WC[:3, 3], X_WC[None, :3, 2])
        disc = blur_disc(self._lens, self._focus, float(distance[0]) if geom[0] >= 0 else 1e3)
        picture = self._vidicon.expose(light, disc=disc, hold_target=hold_target)
        return self._lines.carried_picture(picture)

    @property
    def renderer(self) -> Renderer:
        return self._renderer.identity

    def state(self) -> CameraState:
        return CameraState(
            noise=noise_state(self._rng),
            lens=self._lens,
            pots=self._pots,
            stand=self._stand,
            focus=None if math.isinf(self._focus) else self._focus,
            gain=self._vidicon.gain,
        )

    def check(self, state: CameraState) -> None:
        check_noise(state.noise)
        self._model.lens(state.lens)
        finite((*state.pots, *state.stand, state.focus or 0.0, state.gain or 0.0), "the camera")

    def restore(self, state: CameraState) -> None:
        set_noise(self._rng, state.noise)
        self._lens = self._model.lens(state.lens).focal_length
        self._pots, self._stand = state.pots, state.stand
        self._focus = math.inf if state.focus is None else state.focus
        self._vidicon.gain = state.gain

    def true_view(self) -> View:
        """Return the true present view, for the referee and for tests. The program knows only `pots`."""
        pan, tilt = self._stand
        return self._model.view(
            self._lens,
            self._lines.carried("camera.pan", pan),
            self._lines.carried("camera.tilt", tilt),
        )

    def shown(self, points_W: Array) -> Array:
        """Return the true picture points, shape (n, 2), of points in W (in m, shape (n, 3)), without the drift of the
        tube. Only trials and tests use this method.
        """
        return self._raster.shown(self.true_view().project(points_W))


def true_camera(errors: CameraErrors, drawing: CameraModel) -> CameraModel:
    """Return the true camera model: the designed camera with the errors of the world."""
    x, y, z = np.add(drawing.mount, errors.place)
    pan, tilt, roll = errors.turn
    return CameraModel(
        mount=(float(x), float(y), float(z)),
        pan0=drawing.pan0 + pan,
        tilt0=drawing.tilt0 + tilt,
        roll=drawing.roll + roll,
        lenses=tuple(
            replace(
                lens,
                scale=lens.scale * scale,
                forward=lens.forward + forward,
                side=lens.side + side,
                up=lens.up + up,
            )
            for lens, scale, (forward, side, up) in zip(
                drawing.lenses, errors.focal_scale, errors.lens_place, strict=True
            )
        ),
    )


def renderer_here(kind: str) -> Literal["gl", "ray"]:
    """Return the renderer, `gl` or `ray`, that is used on this computer if the user asks for `kind`. Raises
    InvalidInput if no renderer of the kind `kind` works on this computer.
    """
    made = make_renderer(kind, mujoco.MjModel.from_xml_string("<mujoco/>"))
    return "gl" if made.identity.method == "opengl" else "ray"


def make_renderer(kind: str | RendererMaker, model: mujoco.MjModel) -> SceneRenderer:
    """Make a renderer. `kind` is `gl`, `ray`, `auto` (`gl` if OpenGL works on this computer), or a function of the
    caller that makes a renderer. Raises InvalidInput if no renderer can be made.
    """
    if not isinstance(kind, str):
        return kind(model)
    if kind == "ray":
        return RayRenderer(model)
    if kind == "gl":
        return OpenGlRenderer(model)
    if kind != "auto":
        raise NoSuchName(f"there is no renderer `{kind}`; choose `auto`, `gl` or `ray`")
    try:
        return OpenGlRenderer(model)
    except InvalidInput:
        return RayRenderer(model)
