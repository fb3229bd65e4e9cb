"""The plan format as a JSON schema, made from the Python types. `plans/plan.schema.json` is its committed text."""

import json
from typing import Final

import msgspec

from handeye.core.files import Kind
from handeye.planfile.plan import VERSION, Plan

DIALECT: Final = "https://json-schema.org/draft/2020-12/schema"
SCHEMA: Final = Kind("JSON schema", rb'\{\s*"\$schema":')


def plan_schema() -> str:
    """Return the schema as JSON text."""
    (whole,), components = msgspec.json.schema_components([Plan], ref_template="#/$defs/{name}")
    definition = components["Plan"]
    definition["properties"]["format"] = {"const": "handeye plan"}
    definition["properties"]["version"] = {"const": VERSION}
    definition["required"] = ["format", "version", *definition["required"]]
    head = {"$schema": DIALECT, "title": f"handeye plan, version {VERSION}"}
    return json.dumps(head | whole | {"$defs": components}, indent=1, ensure_ascii=False) + "\n"
