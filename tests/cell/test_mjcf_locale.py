"""What a scene is exported as does not depend on the decimal commas of the program that asks for it."""

import locale
from collections.abc import Iterator

import mujoco
import pytest

from handeye.cell.mjcf import mjcf_files


@pytest.fixture
def numbers() -> Iterator[str]:
    """The name of another locale for numbers, which is in force."""
    before = locale.setlocale(locale.LC_NUMERIC)
    yield locale.setlocale(locale.LC_NUMERIC, "C.UTF-8")
    locale.setlocale(locale.LC_NUMERIC, before)


def test_meshes_are_read_back_with_decimal_points(numbers: str) -> None:
    seen = []

    class Watched:
        """A specification without meshes that notes by which locale it is written."""

        def __getattr__(self, name: str) -> object:
            return getattr(spec, name)

        def to_xml(self) -> str:
            seen.append(locale.setlocale(locale.LC_NUMERIC))
            return spec.to_xml()

    spec = mujoco.MjSpec.from_string('<mujoco><worldbody><geom size=".5"/></worldbody></mujoco>')
    assert b'size="0.5"' in mjcf_files(Watched(), "mark", {})["scene.xml"]
    assert seen == ["C"]
    assert locale.setlocale(locale.LC_NUMERIC) == numbers
