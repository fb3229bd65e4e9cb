"""The folder in which a scene is handed to plain MuJoCo."""

from typing import Final

import msgspec

from handeye.cell.mjcf import MESHES, SCENE, TEXTURES, mjcf_files
from handeye.core.folders import FolderKind
from handeye.core.plain_text import counted, printable
from handeye.core.versions import HANDEYE, versions
from handeye.runs.exported_state import ExportedState
from handeye.tasks import task

README: Final = "README.md"
_MARK: Final = "handeye exported this scene; README.md says what it shows"
EXPORT: Final = FolderKind(
    name="an export of handeye",
    known_by=SCENE,
    begins=f"<!-- {_MARK} -->".encode(),
    holds=(SCENE, README, f"{MESHES}/*.obj", f"{TEXTURES}/*.png"),
)


def scene_files(exhibit: ExportedState) -> dict[str, bytes]:
    """The files of an exhibit by their names in its folder; equal exhibits give equal bytes; raises InvalidInput if its
    task exports no scene, or this MuJoCo cannot write one.
    """
    scene = task(exhibit.task).exported(exhibit.world, exhibit.truth, exhibit.moment)
    files = mjcf_files(scene.spec, _MARK, told(exhibit))
    return {README: _readme(exhibit, scene.about).encode(), **files}


def told(exhibit: ExportedState) -> dict[str, str]:
    """What the files of an exhibit tell programs, by name."""
    return {
        "moment": exhibit.moment,
        "shows": shows(exhibit),
        "world": msgspec.json.encode(exhibit.world).decode(),
        "handeye": HANDEYE,
    }


def shows(exhibit: ExportedState) -> str:
    """What an exhibit shows, as a piece of a sentence."""
    world = f"the world of {exhibit.world}"
    if exhibit.moment == "drawn":
        return f"{world}, as it is drawn, before anything happened"
    program = printable(exhibit.program or "")
    done = f"{program} in {world}, after {counted(exhibit.steps, 'step')}"
    if exhibit.moment == "final":
        return f"{done}: its end"
    where = "" if exhibit.stage is None else f", at “{printable(exhibit.stage)}”"
    return f"{done}{where}: unfinished"


def _readme(exhibit: ExportedState, about: str) -> str:
    made = ", ".join(f"{name} {version}" for name, version in versions().items())
    return f"""# A scene of handeye

This shows {shows(exhibit)}.

`{SCENE}` is a model of MuJoCo that needs nothing but the folders beside it:
`mujoco.MjModel.from_xml_path("{SCENE}")`. What it shows is its last keyframe, `{exhibit.moment}`,
and the state that it begins with. Lengths are in m, angles in rad, masses in kg. World frame:
origin at a corner of the table, z up, table top z = 0. The texts in `<custom>` say the same for
programs: `moment` (`drawn`, `final` or `unfinished`), `shows`, and `world`.

{about.strip()}

Made with {made}.
"""
