"""The scene obeys: things stay, drop home, seat, and do not go where there is metal."""

import numpy as np
import pytest
from scene_bench import FREE, Bench, pinned_base, shift, standard_base

from handeye.core.pose import planar, translated
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, pin_seat, screw_holes, standard
from handeye.tasks.water_pump.scene.solids import casting
from handeye.tasks.water_pump.world.pump_world import PumpWorld


@pytest.mark.slow
@pytest.mark.parametrize(
    "world",
    [PumpWorld.nominal(), PumpWorld.sample(1), PumpWorld.sample(2)],
    ids=lambda w: f"seed{w.drawn.spec.seed}",
)
def test_everything_stays_where_it_starts(world):
    bench = Bench(world)
    before = {part: bench.pose(part) for part in FREE}
    bench.run(1.0)
    moved = {part: shift(before[part], bench.pose(part)) for part in FREE}
    assert all(distance < 0.5e-3 and angle < 0.5 for distance, angle in moved.values()), moved
    assert bench.warnings() == 0


@pytest.mark.slow
def test_pins_a_millimetre_off_drop_home_through_the_chamfers():
    bench, d = pinned_base(), dimensions()
    for pin, hole in enumerate(int(k) for k in d.all("base.screw_holes.pinned")):
        home = standard() @ planar(*screw_holes()[hole], base_top(), 0.0)
        p = bench.pose(f"pin{pin}")[:3, 3] - home[:3, 3]
        seat = pin_seat(d("base.screw_holes.chamfer"), d("base.screw_holes.radius"))
        assert abs(p[2] - seat) < 0.05e-3  # its shoulder rests on the mouth
        assert np.hypot(p[0], p[1]) < 0.2e-3


@pytest.mark.slow
def test_gasket_and_top_dropped_over_the_pins_seat_on_the_base():
    bench = pinned_base()
    off = [0.0003, -0.0003, 0.03]  # a top that falls farther, or farther aside, tips and binds on a pin
    bench.put("gasket", translated(standard(), [*off[:2], base_top() + off[2]]))
    bench.run(0.5)
    assert abs(bench.pose("gasket")[2, 3] - base_top()) < 0.3e-3
    bench.put("top", translated(standard(), [*off[:2], base_top() + off[2]]))
    bench.run(0.8)
    height = bench.pose("top")[2, 3] - bench.pose("gasket")[2, 3]
    assert abs(height - dimensions()("gasket.thickness")) < 0.3e-3
    assert bench.pose("top")[2, 2] > np.cos(np.radians(0.5))
    assert bench.warnings() == 0


@pytest.mark.slow
def test_a_pin_that_misses_its_hole_stands_on_the_face():
    bench = pinned_base()
    bench.put("pin0", translated(standard(), [-1.3 * 0.0254, 0.3 * 0.0254, base_top() + 0.0195]))
    bench.run(0.05)
    assert bench.pose("pin0")[2, 3] > base_top() + 0.0185


def meets_the_base(bench: Bench, pin: str) -> bool:
    """True if the pin touches the base, or a body that is fixed to the base."""
    parts = {bench.model.body(name).id for name in ("base", "base_lands", "base_bores")}
    of = bench.model.geom_bodyid
    pairs = ({int(of[a]), int(of[b])} for a, b in bench.data.contact.geom)
    return any(bench.model.body(pin).id in pair and pair & parts for pair in pairs)


@pytest.mark.slow
def test_the_nose_of_a_pin_meets_metal_wherever_the_face_of_the_casting_is_drawn():
    bench = standard_base()
    vertices, triangles = casting(6)
    corners = vertices[triangles]
    up = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] / 2
    face = np.flatnonzero((up > 0) & (corners[:, :, 2].min(axis=1) > base_top() - 1e-6))
    rng = np.random.default_rng(1)
    chosen = corners[rng.choice(face, 3000, p=up[face] / up[face].sum())]
    places = np.einsum("ni,nij->nj", rng.dirichlet(np.ones(3), 3000), chosen)
    entered = []
    for x, y, _ in places:
        z = base_top() + dimensions()("pin.nose_length") - 0.002  # the nose 2 mm deep
        bench.put("pin0", standard() @ planar(x, y, z, 0.0))
        if not meets_the_base(bench, "pin0"):
            entered.append((x, y))
    assert entered == []


@pytest.mark.parametrize("screws", [6, 7])
def test_every_tapped_hole_is_free_for_the_nose_of_a_pin(screws: int):
    bench = standard_base(PumpWorld.nominal(screws))
    for x, y in screw_holes(screws):
        bench.put("pin0", standard() @ planar(x, y, base_top() + 0.001, 0.0))
        assert not meets_the_base(bench, "pin0")


@pytest.mark.slow
def test_a_screw_cannot_enter_a_tapped_hole_by_itself():
    bench, point = pinned_base(), dimensions()("screw.point_length")
    X = standard() @ planar(*screw_holes()[0], base_top() + 0.001, 0.0)
    bench.put("screw0", X)
    bench.run(0.15)
    depth = base_top() - bench.pose("screw0")[2, 3]
    assert point - 1e-3 < depth < point + 1e-3  # its dog point is in, its thread is not


@pytest.mark.slow
def test_the_scene_of_a_seed_is_always_the_same():
    first, second = (Bench(PumpWorld.sample(5)) for _ in range(2))
    for bench in (first, second):
        bench.run(0.1)
    assert np.array_equal(first.data.qpos, second.data.qpos)
