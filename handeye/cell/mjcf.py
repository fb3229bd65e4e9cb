"""Writes a scene as files that plain MuJoCo opens: XML with numbers in full precision, meshes as OBJ, textures as
PNG.
"""

import ctypes
import locale
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import cv2
import mujoco
import numpy as np
import trimesh

from handeye.core.errors import Refused

SCENE: Final = "scene.xml"
MESHES: Final = "meshes"
TEXTURES: Final = "textures"
_ALL: Final = 17  # digits that tell any two figures apart
_FIGURE: Final = re.compile(r'(?<=[\s"])-?\d+(?:\.\d+(?:e[-+]\d+)?|e[-+]\d+)(?=[\s"])')
_DIGITS: Final = 10  # decimals of a vertex, in m: finer than the single precision in which MuJoCo keeps it


def mjcf_files(spec: mujoco.MjSpec, mark: str, told: Mapping[str, str]) -> dict[str, bytes]:
    """Return the content of each file of a scene; the keys are the names of the files in their folder. Raises Refused
    if the installed version of MuJoCo cannot write numbers in full precision.

    The specification is changed, because its meshes and textures become files. `mark` is a comment in the first
    line of the XML. `told` maps the names of the texts in the element `<custom>` to these texts.
    """
    for name, text in told.items():
        spec.add_text(name=name, data=text)
    assets = {**_meshes(spec), **_textures(spec)}
    spec.assets = assets
    with _in_full(), _decimal_points():
        xml = spec.to_xml()
    return {SCENE: f"<!-- {mark} -->\n{_FIGURE.sub(_short, xml)}".encode(), **assets}


def mesh_of(mesh: mujoco.MjsMesh) -> trimesh.Trimesh:
    """Convert a mesh of a specification to a triangle mesh (m). If the mesh has only points, return their convex
    hull.
    """
    points = np.array(mesh.uservert).reshape(-1, 3)
    if not len(mesh.userface):
        hull: trimesh.Trimesh = trimesh.Trimesh(points).convex_hull
        return hull
    return trimesh.Trimesh(points, np.array(mesh.userface).reshape(-1, 3), process=False)


def _meshes(spec: mujoco.MjSpec) -> dict[str, bytes]:
    files = {}
    for mesh in spec.meshes:
        shape = mesh_of(mesh)
        mesh.uservert, mesh.userface, mesh.file = [], [], f"{MESHES}/{mesh.name}.obj"
        text = shape.export(
            file_type="obj", digits=_DIGITS, header=None,
            include_normals=False, include_color=False, include_texture=False,
        )  # fmt: skip
        assert isinstance(text, str)
        files[mesh.file] = text.encode()
    return files


def _textures(spec: mujoco.MjSpec) -> dict[str, bytes]:
    files = {}
    for texture in spec.textures:
        size = (texture.height, texture.width, texture.nchannel)
        pixels = np.frombuffer(texture.data, dtype=np.uint8).reshape(size)
        done, data = cv2.imencode(".png", pixels[:, :, ::-1])
        assert done
        texture.data, texture.file = b"", f"{TEXTURES}/{texture.name}.png"
        files[texture.file] = data.tobytes()
    return files


@contextmanager
def _in_full() -> Iterator[None]:
    """Make MuJoCo write numbers in full precision while the context is open. MuJoCo has a setting for full precision,
    but no Python name for this setting.
    """
    try:
        (library,) = Path(mujoco.__file__).parent.glob("*mujoco.[0-9ds]*")
        functions = ctypes.CDLL(str(library))
        before = functions._mjPRIVATE__get_xml_precision()
        functions._mjPRIVATE__set_xml_precision(_ALL)
    except (ValueError, OSError, AttributeError):
        raise Refused(
            f"MuJoCo {mujoco.__version__} writes numbers with only six digits, which are too few for a scene"
        ) from None
    try:
        yield
    finally:
        functions._mjPRIVATE__set_xml_precision(before)


@contextmanager
def _decimal_points() -> Iterator[None]:
    """Use a C locale with decimal points in this process while the context is open. MuJoCo needs such a locale to read
    meshes.
    """
    before = locale.setlocale(locale.LC_NUMERIC)
    locale.setlocale(locale.LC_NUMERIC, "C")
    try:
        yield
    finally:
        locale.setlocale(locale.LC_NUMERIC, before)


def _short(figure: re.Match[str]) -> str:
    """Write a number as the shortest text that keeps its precision, single or double."""
    value = float(figure[0])
    single = np.float32(value)
    text = str(single) if float(single) == value else repr(value)
    return text.removesuffix(".0")
