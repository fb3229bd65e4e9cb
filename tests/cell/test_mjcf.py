"""A scene is written with every figure in full, and MuJoCo writes as before afterwards."""

import ctypes
from typing import NoReturn

import mujoco
import numpy as np
import pytest

from handeye.cell.mjcf import SCENE, mjcf_files
from handeye.core.errors import InvalidInput

THIRD = 1 / 3
GRAIN = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)


def small() -> mujoco.MjSpec:
    """A wedge on a free body, with figures that six digits do not hold, and a grain."""
    spec = mujoco.MjSpec()
    texture = spec.add_texture(
        name="grain", type=mujoco.mjtTexture.mjTEXTURE_2D, width=4, height=4, nchannel=3
    )
    texture.data = GRAIN.tobytes()
    spec.add_mesh(name="wedge", uservert=[0, 0, 0, THIRD, 0, 0, 0, THIRD, 0, 0, 0, THIRD])
    body = spec.worldbody.add_body(name="wedge", pos=[THIRD, 1e-7 / 3, 2e6 / 3])
    body.add_freejoint(name="wedge")
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="wedge", density=7800 * THIRD)
    return spec


def read_back(files: dict[str, bytes]) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(files[SCENE].decode(), files)


def test_what_is_read_back_is_what_was_written() -> None:
    wanted = small().compile()
    model = read_back(mjcf_files(small(), "a scene", {}))
    assert np.array_equal(model.body_pos, wanted.body_pos)
    assert np.array_equal(model.tex_data, GRAIN.ravel())
    assert model.body_mass == pytest.approx(wanted.body_mass, rel=1e-7)


def test_texts_and_the_mark_are_in_the_file_as_they_were_given() -> None:
    xml = mjcf_files(small(), "a scene", {"world": '{"a":1.50}'})[SCENE]
    assert xml.startswith(b"<!-- a scene -->\n<mujoco")
    assert (
        bytes(read_back({**mjcf_files(small(), "a", {"world": '{"a":1.50}'})}).text_data) == b'{"a":1.50}\0'
    )


def test_mujoco_writes_as_before_afterwards() -> None:
    mjcf_files(small(), "a scene", {})
    spec = mujoco.MjSpec.from_string(f'<mujoco><worldbody><body pos="{THIRD} 0 0"/></worldbody></mujoco>')
    spec.compile()
    assert 'pos="0.333333 0 0"' in spec.to_xml()


def test_a_mujoco_that_cannot_write_figures_in_full_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(_: str) -> NoReturn:
        raise OSError("no such library")

    monkeypatch.setattr(ctypes, "CDLL", none)
    with pytest.raises(InvalidInput, match=r"^MuJoCo \S+ writes numbers with only six digits"):
        mjcf_files(small(), "a scene", {})
