"""OpenGL that is not there, is too old, or is sent to a device that is not there: known before a run relies on it."""

import os
import subprocess
import sys
from types import ModuleType

import mujoco
import pytest

from handeye.cell import opengl, photograph
from handeye.cell.camera import make_renderer
from handeye.cell.photograph import Photographer
from handeye.core.errors import Refused

MODEL = mujoco.MjModel.from_xml_string("<mujoco/>")
TOO_OLD = "OpenGL version 1.5 or higher required"


class Context:
    """A context as a driver gives it, however old."""

    def __init__(self, width: int, height: int) -> None: ...

    def make_current(self) -> None: ...


@pytest.fixture
def old(monkeypatch: pytest.MonkeyPatch) -> None:
    """A driver that gives contexts, and refuses every scene."""

    def refuse(*_: object) -> None:
        raise mujoco.FatalError(TOO_OLD)

    driver = ModuleType("old_driver")
    driver.GLContext = Context  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "old_driver", driver)
    monkeypatch.setattr(opengl, "PLATFORMS", (("EGL", "old_driver", (), ()),))
    monkeypatch.setattr(opengl, "context", opengl.context.__wrapped__)
    monkeypatch.setattr(mujoco, "MjrContext", refuse)
    for name in filter(lambda name: name.startswith(opengl.SETTINGS), list(os.environ)):
        monkeypatch.delenv(name)


def test_where_opengl_is_too_old_pictures_are_ray_cast(old: None) -> None:
    assert make_renderer("auto", MODEL).identity.method == "rays"


def test_asked_for_by_name_it_is_refused_with_the_driver_s_reason(old: None) -> None:
    with pytest.raises(
        Refused, match=rf"^OpenGL does not work on this machine \({TOO_OLD}\); photographs need OpenGL"
    ):
        make_renderer("gl", MODEL)


def test_the_refusal_names_the_settings_that_may_be_at_fault(
    old: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MESA_GL_VERSION_OVERRIDE", "1.4")
    monkeypatch.setenv("PYOPENGL_PLATFORM", "egl")  # which MuJoCo sets itself
    with pytest.raises(Refused, match=r"required; unset MESA_GL_VERSION_OVERRIDE, and run handeye again"):
        opengl.context()


def test_without_libraries_the_refusal_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(opengl, "PLATFORMS", (("EGL", "none", ("libNone.so",)),))
    monkeypatch.setenv("MUJOCO_EGL_DEVICE_ID", "0")
    with pytest.raises(
        Refused, match=r"^OpenGL does not work on this machine \(on Debian, install libegl1, "
    ):
        opengl.context.__wrapped__()


def test_a_scene_that_the_driver_cannot_keep_is_refused_in_a_sentence(
    old: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in (opengl, photograph):  # the empty one it could
        monkeypatch.setattr(module, "context", lambda: ("EGL", Context(8, 8)))
    with pytest.raises(Refused, match=rf"^OpenGL on this machine cannot draw 64 x 48 pixels: {TOO_OLD}$"):
        Photographer(MODEL, width=64, height=48)


@pytest.mark.slow
@pytest.mark.parametrize("setting", ["MESA_GL_VERSION_OVERRIDE=1.3", "MUJOCO_EGL_DEVICE_ID=99"])
def test_real_drivers_are_refused_before_a_picture_is_taken(setting: str) -> None:
    name, value = setting.split("=")
    call = "from handeye.cell.opengl import context; context()"
    done = subprocess.run(
        [sys.executable, "-c", call],
        env={**os.environ, name: value},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Refused: OpenGL does not work on this machine (" in done.stderr
    assert f"unset {name}, and run handeye again" in done.stderr or "install" in done.stderr
