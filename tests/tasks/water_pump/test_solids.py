"""The pump's solids as another library measures them: trimesh, which had no part in building them."""

import numpy as np
import pytest
import trimesh

from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump.scene import solids

SOLIDS = {
    "casting": (solids.casting(6), 1),  # the second large hole; the others have a floor
    "plate": (solids.plate(), 0),
    "gasket": (solids.gasket(6), 8),  # six for screws, and the large one, which the web parts in two
    "flange": (solids.flange(6), 6),
}
"""Surfaces of solids, and how many holes go through each."""
CENTRE = 2.5e-3  # m: the figure of the drawing is a little off that of these solids


def measured(surface: solids.Surface) -> trimesh.Trimesh:
    """The surface that is given to MuJoCo, as trimesh reads it."""
    return trimesh.Trimesh(*surface)


@pytest.mark.parametrize("name", SOLIDS)
def test_a_solid_is_closed_and_turned_outwards(name: str) -> None:
    solid = measured(SOLIDS[name][0])
    assert (solid.is_watertight, solid.is_winding_consistent) == (True, True)
    assert solid.volume > 0


@pytest.mark.parametrize("name", SOLIDS)
def test_a_solid_has_the_holes_that_go_through_it(name: str) -> None:
    solid, holes = SOLIDS[name]
    assert measured(solid).euler_number == 2 - 2 * holes


@pytest.mark.parametrize("name", SOLIDS)
def test_volume_and_moments_of_a_solid_are_those_of_trimesh(name: str) -> None:
    volume, centre, moments = solids.volume_moments(SOLIDS[name][0])
    there = measured(SOLIDS[name][0])
    assert volume == pytest.approx(there.volume)
    assert centre == pytest.approx(there.center_mass, abs=1e-9)
    assert moments == pytest.approx(np.diag(there.moment_inertia))


def test_the_plate_weighs_what_aluminium_does() -> None:
    density = dimensions()("base.plate.mass") / measured(solids.plate()).volume
    assert density == pytest.approx(2700, rel=0.01)


def test_the_base_has_its_mass_centre_where_plate_and_casting_have_theirs() -> None:
    d = dimensions()
    masses = [d("base.plate.mass"), d("base.casting.mass")]
    centres = [measured(solid).center_mass for solid in (solids.plate(), solids.casting(6))]
    weighed = np.average(centres, axis=0, weights=masses)
    assert np.abs(weighed - d.all("base.casting.mass_centre")).max() < CENTRE
