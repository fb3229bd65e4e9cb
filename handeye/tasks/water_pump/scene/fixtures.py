"""Adds the fixtures on the table: blocks, stands and rack. Each fixture is displaced from its nominal position by its
placement error in the world.
"""

from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np

from handeye.cell.looks import SEEN
from handeye.core.pose import Array, Pose, planar
from handeye.tasks.stanford_cell.dimensions import Point, dimensions
from handeye.tasks.stanford_cell.shapes import Shaper
from handeye.tasks.water_pump.world.pump_world import Placing, PumpWorld
from handeye.tasks.water_pump.world.stations import Station, plain_stations

EXACT: Final = Placing()


@dataclass(frozen=True, slots=True, kw_only=True)
class Fixture:
    """A fixed body with a frame. Parts placed in this frame by their nominal table coordinates share the
    fixture's placement error."""

    body: mujoco.MjsBody
    X_WF: Pose  # nearly the identity: the error of place, about the fixture's middle

    def stand(
        self,
        shaper: Shaper,
        name: str,
        x: float,
        y: float,
        z: float,
        turn: float = 0.0,
        error: Placing = EXACT,
    ) -> mujoco.MjsBody:
        """Add a free body that starts on this fixture. The nominal pose of the body is given by a position (m) and the
        yaw `turn` (rad); `error` changes both.
        """
        X = self.X_WF @ error.about(x, y, z) @ planar(x, y, z, turn)
        body = _body(shaper, name, X)
        body.add_freejoint(name=name)
        return body


def _body(shaper: Shaper, name: str, X_WB: Pose) -> mujoco.MjsBody:
    quat: Array = np.zeros(4)
    mujoco.mju_mat2Quat(quat, X_WB[:3, :3].ravel())
    return shaper.spec.worldbody.add_body(name=name, pos=X_WB[:3, 3].tolist(), quat=quat.tolist())


def add_fixture(shaper: Shaper, world: PumpWorld, station: str, middle: Point) -> Fixture:
    """Add a fixture without shapes. `middle` is the point (m) about which the placement error turns the fixture."""
    X = world.fixtures[station].about(*middle)
    return Fixture(body=_body(shaper, station, X), X_WF=X)


def add_blocks(shaper: Shaper, world: PumpWorld) -> None:
    """Add the two aligning blocks. The base is pushed first against the far block (+y), then against the left
    block (-x)."""
    d = dimensions()
    far, left, height = d.all("blocks.far"), d.all("blocks.left"), d("blocks.height")
    fixture = add_fixture(shaper, world, Station.BLOCKS, (left[2], far[1]))
    for name, (x0, y0, x1, y1) in (("block_far", far), ("block_left", left)):
        shaper.box(fixture.body, "solid", (x0, y0, 0.0), (x1, y1, height), "block", name).group = SEEN
        middle_x, middle_y, long = (x0 + x1) / 2, (y0 + y1) / 2, max(x1 - x0, y1 - y0) * 0.38
        along_x, along_y = (long, 0.0) if x1 - x0 > y1 - y0 else (0.0, long)
        for side in (-1, 1):
            x, y = middle_x + side * along_x, middle_y + side * along_y
            shaper.cylinder(fixture.body, "look", 0.004, (x, y, height), (x, y, height + 0.003), "steel")


def add_gasket_stand(shaper: Shaper, world: PumpWorld) -> Fixture:
    """Add a stand of two rails that carry the rims of the gasket. The space between the rails is free for the
    fingers."""
    d = dimensions()
    (x, y), height = d.all("gasket_stand.grasp"), d("gasket_stand.height")
    fixture = add_fixture(shaper, world, Station.GASKET_STAND, (x, y))
    for side in (-1, 1):
        y0, y1 = sorted((y + side * 0.0165, y + side * 0.0365))
        low, high = (x - 0.045, y0, height - 0.008), (x + 0.077, y1, height)
        shaper.box(fixture.body, "solid", low, high, "enamel").group = SEEN
        for px in (x - 0.035, x + 0.067):
            post = (px, y + side * 0.0265)
            shaper.cylinder(fixture.body, "look", 0.006, (*post, 0.006), (*post, height - 0.008), "steel")
    shaper.box(fixture.body, "look", (x - 0.05, y - 0.045, 0.0), (x + 0.082, y + 0.045, 0.006), "enamel")
    return fixture


def add_top_stand(shaper: Shaper, world: PumpWorld) -> Fixture:
    """Add a stand for the pump's top."""
    d = dimensions()
    (x, y), height = d.all("top_stand.grasp"), d("top_stand.height")
    fixture = add_fixture(shaper, world, Station.TOP_STAND, (x, y))
    low, high = (x - 0.090, y - 0.045, height - 0.008), (x + 0.045, y + 0.045, height)
    shaper.box(fixture.body, "solid", low, high, "enamel").group = SEEN
    for px in (x - 0.08, x + 0.035):
        for py in (y - 0.035, y + 0.035):
            shaper.cylinder(fixture.body, "look", 0.006, (px, py, 0), (px, py, height - 0.008), "steel")
    return fixture


def add_plain_stations(shaper: Shaper, world: PumpWorld) -> None:
    """Add the stations that consist only of boxes."""
    for name, boxes in plain_stations().items():
        corners = np.array(boxes)
        x, y = (corners[:, :2].min(axis=0) + corners[:, 3:5].max(axis=0)) / 2
        fixture = add_fixture(shaper, world, name, (float(x), float(y)))
        for box in boxes:
            shaper.box(fixture.body, "solid", box[:3], box[3:], "enamel").group = SEEN
