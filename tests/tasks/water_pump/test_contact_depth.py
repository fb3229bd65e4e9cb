"""MuJoCo finds no contact deeper than the parts overlap, where a finger meets the edge of the top's flange.

With MuJoCo's own `ccd_tolerance`, 1e-6 m, some contacts as shallow as those of this cell, some micrometres, come back
as deep as the part is thick, and at right angles to what they are: the top was thrown off its stand.
"""

from collections.abc import Iterator, Sequence
from functools import cache

import mujoco
import numpy as np

from handeye.core.pose import Array
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld

ITS_OWN = 1e-6  # m, MuJoCo's tolerance where a scene does not say
PLACES = 1000
DEPTHS = np.logspace(-9, -5, 9)  # m
UNSURE = 1e-6  # m, beside a tenth of the depth: how exactly the first touch is found, and a tilted depth is measured

# Where the top was thrown off, in the nominal world of seed 880412: a finger overlaps the flange by 3 micrometres.
FLANGE = (-0.00109191644974, -0.0072318979837, 0.999973221537, 0.000252147147591)  # w x y z
FINGER = (-0.000853458078107, 0.00191216935705, 0.999997294167, 0.00101334918543)
BETWEEN = (2.766870223e-05, -0.04777996888, 0.04287994675)  # m, from the flange's middle to the finger's
SHAKEN, DEEP = 2e-6, 1e-4  # m


def test_no_contact_of_a_finger_with_the_flange_is_deeper_than_they_overlap() -> None:
    assert list(_phantoms(_cell().opt.ccd_tolerance)) == []


def test_a_finger_that_touches_the_flange_does_not_throw_it() -> None:
    assert _deepest_where_it_was_thrown(_cell().opt.ccd_tolerance) < DEEP


def test_contacts_that_are_too_deep_are_noticed() -> None:
    assert list(_phantoms(ITS_OWN))
    assert _deepest_where_it_was_thrown(ITS_OWN) > DEEP


def _phantoms(tolerance: float) -> Iterator[tuple[float, float]]:
    """How far the two overlap, and how deep their deepest contact is (m), where that is deeper."""
    pair, random = _Pair(tolerance), np.random.default_rng(0)
    for _ in range(PLACES):
        turned = np.array([1.0, *random.normal(0.0, (0.001, 0.001, 0.009))])
        across = random.uniform(pair.reach - 2 * pair.thick, pair.reach)
        at = (random.normal(0.0, 0.003), -across)
        touch = pair.first_touch(at, turned)
        for overlap in DEPTHS:
            deepest = pair.deepest((*at, touch - overlap), turned)
            if deepest > 1.1 * overlap + UNSURE:
                yield float(overlap), deepest


def _deepest_where_it_was_thrown(tolerance: float) -> float:
    """The deepest contact of a finger that is shaken about where it threw the top (m)."""
    pair, random = _Pair(tolerance, FLANGE), np.random.default_rng(0)
    return max(pair.deepest(BETWEEN + random.normal(0.0, SHAKEN, 3), np.array(FINGER)) for _ in range(PLACES))


class _Pair:
    """A finger of the cell over the flange of the cell's top, which does not move."""

    def __init__(self, tolerance: float, turned: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)) -> None:
        cell, spec = _cell(), mujoco.MjSpec()
        flange, finger = _flange(), cell.geom("stanford/bar_b").id
        radius, half = cell.geom_size[flange][:2]
        self.thick, high = cell.geom_size[finger][1:]
        self.reach, self._upright = radius + self.thick, half + high
        spec.option.ccd_tolerance = tolerance
        hand, top = spec.worldbody.add_body(name="hand"), spec.worldbody.add_body(name="top", quat=turned)
        hand.add_freejoint()
        for body, geom in ((hand, finger), (top, flange)):
            body.add_geom(type=cell.geom_type[geom], size=cell.geom_size[geom], mass=1.0)
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)

    def deepest(self, at: Sequence[float] | Array, turned: Array) -> float:
        """How deep the deepest contact is (m), the finger at a place (m) and turned (w x y z); below 0: none."""
        self._data.qpos[:3], self._data.qpos[3:] = at, turned / np.linalg.norm(turned)
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_collision(self._model, self._data)
        return float(-self._data.contact.dist.min(initial=1.0))

    def first_touch(self, at: tuple[float, float], turned: Array) -> float:
        """The height at which the finger touches on its way down (m); found by halving."""
        low, high = self._upright - 5e-4, self._upright + 5e-4
        while high - low > 1e-12:
            middle = (low + high) / 2
            if self.deepest((*at, middle), turned) >= 0.0:
                low = middle
            else:
                high = middle
        return float(low)


def _flange() -> int:
    """The larger of the two cylinders of the top's flange."""
    cell = _cell()
    discs = [
        geom
        for geom in np.flatnonzero(cell.geom_bodyid == cell.body("top").id)
        if cell.geom_type[geom] == mujoco.mjtGeom.mjGEOM_CYLINDER
        and cell.geom_contype[geom] | cell.geom_conaffinity[geom]
    ]
    return int(max(discs, key=lambda geom: cell.geom_size[geom][0]))


@cache
def _cell() -> mujoco.MjModel:
    return build_cell(PumpWorld.nominal(), camera="ray").truth.model
