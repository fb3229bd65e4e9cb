"""What is predicted of the pump is what happens to it: worlds, hands, eye, and what the program feels and saves."""

import json
from functools import cache

import numpy as np
import pytest
from pump_bench import bench, stage
from short_runs import plan_of

import handeye
from handeye.arm.ik import solve
from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import InvalidInput
from handeye.core.pose import Array, hand, inverse, planar, pose, translated
from handeye.core.variation import Overrides, WorldSpec
from handeye.planfile.plan import Plan
from handeye.program.program import Program
from handeye.runs.scripts import default_script, plan_script
from handeye.tasks import task
from handeye.tasks.water_pump.prediction import eye, layers, pins, screws
from handeye.tasks.water_pump.prediction.assembly import Assembly
from handeye.tasks.water_pump.prediction.hands import Hands
from handeye.tasks.water_pump.prediction.poses import placed
from handeye.tasks.water_pump.prediction.predict import predict
from handeye.tasks.water_pump.prediction.things import drawn_on_stand, standing_base
from handeye.tasks.water_pump.prediction.worlds import Worlds
from handeye.tasks.water_pump.world.dimensions import web_centre
from handeye.tasks.water_pump.world.nominal import DRAWING, LOOKS, PARK
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.tasks.water_pump.world.variation import variation
from handeye.vision.calibration import Sighting, calibrate, moved

HIGH = WorldSpec(seed=3, level="high")
SEEDS = range(3, 13)


@cache
def program() -> Program:
    """The careful program."""
    plan = plan_script(default_script()).plan
    assert isinstance(plan, Plan)
    return plan.program


def assembly(spec: WorldSpec) -> Assembly:
    """A prediction of one world, at its beginning."""
    return Assembly(worlds=Worlds(spec, [spec.seed]), program=program())


# -- the same worlds ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "overrides", [Overrides(), Overrides(without=("arm.offset", "fixtures"), set={"holes.top.1.x": 1e-4})]
)
def test_many_worlds_are_drawn_as_each_by_itself(overrides: Overrides) -> None:
    spec = WorldSpec(seed=3, level="high", overrides=overrides)
    worlds = Worlds(spec, SEEDS)
    drawn = [variation(seed).draw(WorldSpec(seed=seed, level="high", overrides=overrides)) for seed in SEEDS]
    for name in variation(3).quantities:
        assert worlds[name].tolist() == [world[name] for world in drawn], name


def test_things_stand_where_the_scene_has_them() -> None:
    ways = ("x", "y", "z", "yaw", "pitch", "roll")
    found = placed(Worlds(HIGH, SEEDS), "fixtures.rack", (0.2, 0.8, 0.0), ways)
    for X, seed in zip(found, SEEDS, strict=True):
        world = PumpWorld.draw(WorldSpec(seed=seed, level="high"))
        assert pytest.approx(world.fixtures["rack"].about(0.2, 0.8), abs=1e-12) == X


def test_hands_are_where_the_true_joints_put_them() -> None:
    X_WT = assembly(HIGH).planned("H0")
    world, q = PumpWorld.draw(HIGH), solve(STANFORD, X_WT, PARK).q
    assert q is not None
    true = forward(STANFORD, world.arm.positions(q))
    true = translated(true, true[:3, 2] * world.arm_build.hand_length)
    hands = Hands(Worlds(HIGH, [3]))
    assert hands.at(X_WT)[0] == pytest.approx(true, abs=1e-9)
    assert hands.at_each(X_WT[None], X_WT)[0] == pytest.approx(true, abs=1e-9)


def test_in_a_world_without_errors_nothing_is_off() -> None:
    everything = tuple(sorted({name.split(".")[0] for name in variation(0).quantities}))
    world = WorldSpec(seed=0, overrides=Overrides(without=everything))
    for each in predict(program(), world, [0], ()):
        told = f"{each.operation}, {each.at}: {each.what}"
        assert each.used[0] < 0.7, told
        if each.what in {"off", "along", "across", "lean"} and each.operation != "grasp":
            assert each.off[0] == pytest.approx(0, abs=0.1), told


# -- against the code of the product -----------------------------------------------------------------------


def test_the_eye_is_off_as_a_calibration_leaves_it() -> None:
    """The linear gain beside the fit itself, with the lamps and the camera of a world, and no noise."""
    still = WorldSpec(seed=3, overrides=Overrides(without=("camera.pot_noise",)))
    worlds = Worlds(still, [3])
    hands, holes = Hands(worlds), np.array([[1.13, 0.71, 0.07], [1.13, 0.78, 0.07]])
    true = moved(DRAWING, (worlds.each(*eye._TRUE) / np.array([*eye._TRUE.values()]))[0])
    sightings = []
    for look in LOOKS:
        pan, tilt = DRAWING.aim(look.at, look.lens)
        for place in look.places:
            lamp = true_lamp(PumpWorld.draw(still), np.array(place), look.hand_angle)
            u, v = true.view(look.lens, pan, tilt).project(lamp)[0]
            sightings.append(
                Sighting(lens=look.lens, pan=pan, tilt=tilt, u=float(u), v=float(v), point_W=place)
            )
    fitted, aim = calibrate(sightings, DRAWING).model, DRAWING.aim(holes.mean(axis=0), 0.05)
    seen = true.view(0.05, *aim).project(holes)
    found = np.stack(
        [fitted.view(0.05, *aim).back_project(uv, hole[2])[0] for uv, hole in zip(seen, holes, strict=True)]
    )
    off = (found - holes)[:, :2]
    assert np.abs(off).max() > 3e-4  # it is something
    assert eye.seen_off(worlds, hands, holes)[0] == pytest.approx(off, abs=2e-4)


def true_lamp(world: PumpWorld, place: Array, angle: float) -> Array:
    """Where the lamp is when the arm believes it at a place, m."""
    drawn = np.array(STANFORD.hand.lamp)
    X_WT = hand(0, 0, 0, angle, np.pi / 2, 0)
    q = solve(STANFORD, translated(X_WT, place - X_WT[:3, :3] @ drawn), PARK).q
    assert q is not None
    X = forward(STANFORD, world.arm.positions(q))
    return X[:3, 3] + X[:3, :3] @ (drawn + world.lamp + (0, 0, world.arm_build.hand_length))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [15, 23])
def test_a_pin_is_off_as_the_simulated_hand_finds_it(seed: int) -> None:
    """Where it comes down 2.5 and 3.6 mm beside its hole, the search ends within a place of the predicted."""
    spec = WorldSpec(seed=seed, level="high")
    predicted = assembly(spec)
    pins.insert(predicted, pins.PINS[0])
    lay = {"base": standing_base(predicted.worlds)[0]}
    done = bench(stage("insert the aligning pins"), world=PumpWorld.draw(spec), lay=lay)
    done.go(lambda: "Y1" in done.run.state.saved)
    (search,) = (each for each in predicted.found if each.places is not None)
    assert search.off > 2.4
    assert done.tries > 1
    assert abs(search.places - done.tries) <= 1
    for name, most in (("Y1", 0.8), ("E1", 1.5)):
        off = done.saved(name)[:2] * 25.4 - predicted.saved[name][0, :2] * 1e3
        assert np.abs(off).max() < most, (name, off)


TAKING = {
    "gasket": ("G", "OPEN 1.9\nMOVE GUP\nMOVE G DIRECT\nCLOSE .7\n", (web_centre(), 0.0, 0.0)),
    "top": ("TOP", "OPEN 2.8\nMOVE TOP\nCENTER 2\nCLOSE 2 2.4\n", (0.0, 0.0, 0.0)),
}
"""Where a layer is taken, how, and by which point of it."""


@pytest.mark.parametrize("layer", ["gasket", "top"])
def test_a_layer_lies_in_the_simulated_hand_as_predicted(layer: str) -> None:
    """In the middle between the fingers, and off across them, where nothing is felt."""
    spec = WorldSpec(seed=15, level="high")
    goal, script, grip = TAKING[layer]
    predicted, point = assembly(spec), np.array(grip)
    X_TP = layers._held(predicted, layer, goal, point)[0]
    feeling = script + "STOP [0 0 40]\nCHANGE [0 0 1] .1\n"  # of one that feels, the arm has weighed itself
    done = bench(feeling, world=PumpWorld.draw(spec)).to("CHANGE")
    tool = done.cell.truth.data.site("stanford/tool")
    X_WT, X_WP = pose(tool.xmat.reshape(3, 3), tool.xpos), done.pose(layer)
    drawn = inverse(predicted.planned(goal)) @ planar(*drawn_on_stand(layer))
    held, told = ((X @ [*point, 1.0])[:3] for X in (inverse(X_WT) @ X_WP, X_TP))
    assert held * 1e3 == pytest.approx(told * 1e3, abs=0.5)
    assert abs(told - (drawn @ [*point, 1.0])[:3])[0] * 1e3 > 0.7  # across the fingers it is something


def test_the_demo_saved_what_is_predicted_of_its_world() -> None:
    """Differences that the program saved in the run that comes with handeye, mm."""
    trace = handeye.open(handeye.demo)
    predicted = assembly(trace.head.world)
    first: dict[str, Array] = {}
    for told, data in zip(trace.table("events")["event"], trace.table("events")["data"], strict=True):
        if told == "Saved":
            saved = json.loads(data)
            first.setdefault(saved["name"], np.array(saved["difference"][:2]))
    for pin in pins.PINS:
        pins.insert(predicted, pin)
    held = screws.take_driver(predicted, "driver")
    for name, most in (("Y1", 0.8), ("X2", 0.8), ("DRV", 0.8), ("DRX", 0.8), ("E1", 1.5), ("E2", 1.5)):
        off = (first[name] - predicted.saved[name][0, :2]) * 1e3
        assert np.abs(off).max() < most, (name, first[name] * 1e3, predicted.saved[name] * 1e3)
    layers.save_heights(predicted)
    screws.drive(predicted, held, screws.SCREWS[:1])
    for name in ("DS", "HS"):
        off = (first[name] - predicted.saved[name][0, :2]) * 1e3
        assert np.abs(off).max() < 1.5, (name, first[name] * 1e3, predicted.saved[name] * 1e3)


# -- the program decides ------------------------------------------------------------------------------


def test_what_the_program_restores_is_what_it_is_predicted_by() -> None:
    """Without what both pins told, the first screw comes down farther off its hole."""
    deaf = replace_restores(program())
    careful, careless = (
        next(each for each in predict(plan, HIGH, SEEDS, ()) if (each.at, each.what) == ("H0", "off"))
        for plan in (program(), deaf)
    )
    assert np.median(careless.off) > 3 * np.median(careful.off)


def replace_restores(plan: Program) -> Program:
    """The program, which restores nothing on its way to the first screw."""
    from msgspec.structs import replace as changed

    steps = tuple(
        changed(step, operation=changed(step.operation, restore=()))
        if getattr(step.operation, "goal", "") == "H0"
        else step
        for step in plan.steps
    )
    return changed(plan, steps=steps)


@pytest.mark.parametrize(
    ("sense", "at"), [("search", "T1"), ("vision", "A"), ("touch", "H0"), ("centring", "H0")]
)
def test_without_a_sense_something_uses_more_of_its_room(sense: str, at: str) -> None:
    whole, lacking = (
        next(each for each in predict(program(), HIGH, SEEDS, senses) if (each.at, each.what) == (at, "off"))
        for senses in ((), (sense,))
    )
    assert np.median(lacking.used) > 2 * np.median(whole.used)


def test_what_it_cannot_predict_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"^the prediction takes motions to end where they should"):
        task().predict(program(), HIGH, SEEDS, without=("force",))
    with pytest.raises(
        InvalidInput, match=r"^the prediction is of the pump's program; this one never goes to A$"
    ):
        task().predict(plan_of("OPEN 1\n").program, HIGH, SEEDS)
    with pytest.raises(InvalidInput, match=r"predicts nothing"):
        task("insertion").predict(program(), HIGH, SEEDS)
