"""Steps one environment of one library with random actions, and prints what it is and what the steps cost, as JSON.

Run as a file, by the interpreter of an environment in which the library is installed; `simulators.py` does so.
"""

import contextlib
import json
import platform
import sys
import time
from importlib import import_module
from importlib.metadata import version
from typing import Any

import numpy as np

SHARE = 0.2
"""Size of the random actions, as a fraction of the range of each component."""
WARM_UP = 20  # steps before the measured ones


class Stepped:
    """An environment, and how to step it."""

    def __init__(self, library: str, name: str) -> None:
        self.packages = (library, "mujoco", "numpy")
        self.still: dict[int, float] = {}  # components of the action that are not random
        getattr(self, f"_{library.replace('-', '_')}")(name)

    def _handeye(self, name: str) -> None:
        from handeye.env.environment import AssemblyEnv

        env: Any = AssemblyEnv(name)
        env.reset(seed=1)
        runner = env._runner  # no policy may look at it; a benchmark counts contacts
        assert runner is not None
        truth = runner.arm_cell.truth
        self.model, self.data, self.step = truth.model, truth.data, env.step
        self.low, self.high = env.action_space.low, env.action_space.high
        self.control_s = 1 / 60
        held = {"grip": 0.5}  # the fingers stay closed, whether or not they hold something
        moved = ("move.", "turn.")
        self.still = {
            place: held.get(component.name, 0.0)
            for place, component in enumerate(env.components)
            if not component.name.startswith(moved)
        }

    def _gymnasium_robotics(self, name: str) -> None:
        gymnasium: Any = import_module("gymnasium")
        gymnasium.register_envs(import_module("gymnasium_robotics"))
        env = gymnasium.make(name, max_episode_steps=10**9)
        env.reset(seed=1)
        inner = env.unwrapped
        self.model, self.data, self.step = inner.model, inner.data, env.step
        self.low, self.high = env.action_space.low, env.action_space.high
        self.control_s = inner.n_substeps * inner.model.opt.timestep

    def _metaworld(self, name: str) -> None:
        gymnasium: Any = import_module("gymnasium")
        import_module("metaworld")  # registers its environments
        env = gymnasium.make("Meta-World/MT1", env_name=name, seed=1, max_episode_steps=10**9)
        env.reset(seed=1)
        inner = env.unwrapped
        inner.max_path_length = 10**9
        self.model, self.data, self.step = inner.model, inner.data, env.step
        self.low, self.high = env.action_space.low, env.action_space.high
        self.control_s = inner.frame_skip * inner.model.opt.timestep

    def _robosuite(self, name: str) -> None:
        robosuite: Any = import_module("robosuite")
        env = robosuite.make(
            name,
            robots="Panda",
            has_renderer=False,
            has_offscreen_renderer=False,
            use_camera_obs=False,
            ignore_done=True,
            seed=1,
        )
        env.reset()
        self.low, self.high = env.action_spec
        self.model, self.data, self.step = env.sim.model._model, env.sim.data._data, env.step
        self.control_s = 1 / env.control_freq


def measured(stepped: Stepped, seconds: float) -> dict[str, Any]:
    """Step for some seconds of simulated time, and return the cost."""
    random = np.random.default_rng(1)
    low, high = np.asarray(stepped.low, float), np.asarray(stepped.high, float)
    count = round(seconds / stepped.control_s)
    actions = (low + high) / 2 + SHARE * (high - low) / 2 * random.uniform(-1, 1, (WARM_UP + count, len(low)))
    for place, value in stepped.still.items():
        actions[:, place] = value
    for action in actions[:WARM_UP]:
        stepped.step(action)
    contacts, began = 0, time.process_time()
    for action in actions[WARM_UP:]:
        stepped.step(action)
        contacts += int(stepped.data.ncon)
    return {"steps": count, "cpu_s": time.process_time() - began, "contacts": contacts / count}


def main(library: str, name: str, seconds: str) -> None:
    """Measure one environment."""
    with contextlib.redirect_stdout(sys.stderr):
        stepped = Stepped(library, name)
        found = measured(stepped, float(seconds))
    model = stepped.model
    told = {
        "library": library,
        "environment": name,
        "versions": {
            "python": platform.python_version(),
            **{each: version(each) for each in stepped.packages},
        },
        "control_hz": 1 / stepped.control_s,
        "timestep_s": float(model.opt.timestep),
        "degrees_of_freedom": int(model.nv),
        "geoms": int(model.ngeom),
        **found,
    }
    sys.stdout.write(json.dumps(told) + "\n")


main(*sys.argv[1:])
