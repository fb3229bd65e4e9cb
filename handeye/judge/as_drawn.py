"""Finds the parts of a scene that differ from the original model, and the properties in which they differ. Colours
and sleep settings do not count.
"""

from collections.abc import Iterator, Mapping
from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]

_COUNTS: Final = {
    "body": "nbody", "jnt": "njnt", "dof": "nv", "geom": "ngeom", "site": "nsite", "eq": "neq", "actuator": "nu",
}  # fmt: skip
_LOOKS: Final = ("group", "matid", "rgba", "castshadow", "user", "sameframe")
_SHARED: Final = ("bvh", "mesh", "tendon", "wrap")  # fields that belong to no single body
_KINDS: Final = {
    "place": ("body_pos", "body_quat"),
    "mass": ("body_ipos", "body_iquat", "body_mass", "body_inertia", "body_gravcomp"),
    "friction": ("dof_frictionloss", "dof_damping", "dof_armature", "geom_friction", "geom_priority"),
    "contacts": ("geom_contype", "geom_conaffinity", "geom_condim"),
}
_WORDS: Final = {
    "body": "joining", "jnt": "joint", "dof": "joint", "geom": "shape", "site": "hole", "eq": "bond",
    "actuator": "drive", "bvh": "shape", "mesh": "shape",
}  # fmt: skip
_PHYSICS: Final = (
    "gravity", "wind", "magnetic", "density", "viscosity", "impratio", "cone", "o_margin", "o_friction", "o_solref",
    "o_solimp", "disableflags",
)  # fmt: skip


def altered(model: mujoco.MjModel, drawn: mujoco.MjModel, parts: Mask) -> dict[str, list[str]]:
    """Find the bodies that differ between `model` and the original model, `drawn`. Returns, for each of these bodies,
    the kinds of properties that differ.

    The mask `parts`, shape (nbody,), selects the bodies to compare. Any difference counts, however small. Rounding
    cannot cause one, because two builds of the same scene agree in every byte.
    """
    if any(getattr(model, count) != getattr(drawn, count) for count in (*_COUNTS.values(), "nmeshvert")):
        return {"the scene": ["number of elements"]}
    found: dict[str, set[str]] = {}
    for owner, kind in _differences(model, drawn, parts):
        found.setdefault(owner, set()).add(kind)
    return {owner: sorted(kinds) for owner, kinds in sorted(found.items())}


def told(differing: Mapping[str, list[str]]) -> str:
    """Return the differences in words, such as `rotor (joint, place), gasket (shape)`."""
    return ", ".join(f"{part} ({', '.join(kinds)})" for part, kinds in differing.items())


def _differences(model: mujoco.MjModel, drawn: mujoco.MjModel, parts: Mask) -> Iterator[tuple[str, str]]:
    for field, bodies in _fields(drawn):
        one, other = (np.asarray(getattr(m, field)).reshape(len(bodies), -1) for m in (model, drawn))
        for row in np.flatnonzero((one != other).any(axis=1) & parts[bodies] & (bodies >= 0)):
            yield _owner(drawn, field, int(row), int(bodies[row])), _kind(field)
    for number in np.flatnonzero(_meshes(model, drawn)):
        for geom in np.flatnonzero((drawn.geom_dataid == number) & parts[drawn.geom_bodyid]):
            yield _owner(drawn, "geom", int(geom), int(drawn.geom_bodyid[geom])), "shape"
    for field in _shared(drawn):
        if not np.array_equal(getattr(model, field), getattr(drawn, field)):
            yield "the cell", _kind(field)
    if any(np.any(getattr(model.opt, name) != getattr(drawn.opt, name)) for name in _PHYSICS):
        yield "the cell", "physics"


def _fields(drawn: mujoco.MjModel) -> Iterator[tuple[str, NDArray[np.int32]]]:
    """Yield the name of each model field to compare, with an array that gives, for each row of the field, the body to
    which the row belongs.
    """
    bodies = {
        "body": np.arange(drawn.nbody, dtype=np.int32), "jnt": drawn.jnt_bodyid, "dof": drawn.dof_bodyid,
        "geom": drawn.geom_bodyid, "site": drawn.site_bodyid, "eq": _bonded(drawn), "actuator": _driven(drawn),
    }  # fmt: skip
    for field in dir(drawn):
        kind, _, what = field.partition("_")
        if (
            what
            and kind in _COUNTS
            and what not in _LOOKS
            and len(getattr(drawn, field)) == len(bodies[kind])
        ):
            yield field, bodies[kind]
    joint = np.searchsorted(drawn.jnt_qposadr, np.arange(drawn.nq), side="right") - 1
    yield from (("qpos0", drawn.jnt_bodyid[joint]), ("qpos_spring", drawn.jnt_bodyid[joint]))


def _shared(drawn: mujoco.MjModel) -> Iterator[str]:
    """Yield the names of further model fields to compare. These fields do not belong to single bodies. Vertices of
    meshes are compared separately, by shape.
    """
    for field in dir(drawn):
        kind, _, what = field.partition("_")
        if what and kind in _SHARED and what not in _LOOKS and field != "mesh_vert":
            yield field


def _bonded(drawn: mujoco.MjModel) -> NDArray[np.int32]:
    """Return, for each equality constraint, the body of the first of its two objects, or the world body if the
    constraint names no object.
    """
    of_joint = drawn.eq_type == mujoco.mjtEq.mjEQ_JOINT
    of_body = drawn.eq_objtype == mujoco.mjtObj.mjOBJ_BODY
    first = np.where(of_joint | of_body, drawn.eq_obj1id, 0)
    return np.where(of_joint, drawn.jnt_bodyid[np.where(of_joint, first, 0)], first).astype(np.int32)


def _driven(drawn: mujoco.MjModel) -> NDArray[np.int32]:
    """Return, for each actuator, the body that it moves; -1 if it moves a tendon."""
    kinds, bodies = mujoco.mjtTrn, np.full(drawn.nu, -1, np.int32)
    for kind, owners in (
        (kinds.mjTRN_JOINT, drawn.jnt_bodyid),
        (kinds.mjTRN_SITE, drawn.site_bodyid),
        (kinds.mjTRN_BODY, np.arange(drawn.nbody)),
    ):
        mine = drawn.actuator_trntype == kind
        bodies[mine] = owners[drawn.actuator_trnid[mine, 0]]
    return bodies


def _meshes(model: mujoco.MjModel, drawn: mujoco.MjModel) -> Mask:
    """Return a mask, shape (nmesh,), that selects the meshes whose vertices differ."""
    mesh = np.repeat(np.arange(drawn.nmesh), drawn.mesh_vertnum)
    other = np.zeros(drawn.nmesh, bool)
    other[mesh[(model.mesh_vert != drawn.mesh_vert).any(axis=1)]] = True
    return other


def _owner(drawn: mujoco.MjModel, field: str, row: int, body: int) -> str:
    """Return the name of the body, or of the geom if the geom is fixed to the world body."""
    if body == 0 and field.startswith("geom"):
        return drawn.geom(row).name or "the cell"
    return drawn.body(body).name


def _kind(field: str) -> str:
    named = (kind for kind, fields in _KINDS.items() if field in fields)
    return next(named, _WORDS.get(field.partition("_")[0], "joint"))
