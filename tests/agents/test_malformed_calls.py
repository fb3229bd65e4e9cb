"""Calls that a tool cannot execute: each gets a sentence, and begins nothing."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pytest

from handeye.agents.agent_folder import AgentFolder
from handeye.agents.call import Call
from handeye.agents.requests import schema
from handeye.agents.toolbox import Toolbox
from handeye.agents.tools import TOOLS, tool_named, used

VALUES: tuple[Any, ...] = (
    None, True, -1, 0, 10**40, 1.5, float("nan"), float("inf"), "", "\x00", "../x.al", "/etc/passwd", "nix.al", "a\\b",
    "~", "é" * 300, [], [1], ["a", None], {}, {"a": [1]}, {"": {}},
)  # fmt: skip
PATHS = ("../x.al", "/etc/passwd", "nix.al", "\x00", "a\\b", "~", "runs/x", "CON", "é" * 300)


@pytest.fixture(scope="module")
def toolbox(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Toolbox]:
    found = Toolbox(AgentFolder.at(tmp_path_factory.mktemp("agent")))
    yield found
    found.close()


def drawn(random: np.random.Generator) -> tuple[str, Any]:
    """A tool, and arguments that it cannot accept: no table at all, an unknown name, a wrong type, or the name of
    something that does not exist.
    """

    def one(of: Sequence[Any]) -> Any:
        return of[random.integers(len(of))]

    tool = one(TOOLS)
    known = [*schema(tool.takes)["properties"]]
    match random.integers(4):
        case 0:
            return tool.name, one(
                [value for value in VALUES if value is not None and not isinstance(value, dict)]
            )
        case 1:
            return tool.name, {one(known): one(VALUES), one(["nix", "", "Script", "\x00"]): one(VALUES)}
        case 2:
            return tool.name, {name: one([[1], {"a": [1]}, [{}]]) for name in known[: random.integers(1, 4)]}
    return tool.name, {
        "script" if "script" in known else "run": one(PATHS),
        **({} if "script" in known else {"x": 1}),
    }


def test_each_of_200_malformed_calls_gets_one_sentence_and_begins_nothing(toolbox: Toolbox) -> None:
    random = np.random.default_rng(1)
    for tool, arguments in (drawn(random) for _ in range(200)):
        reply = used(tool_named(tool), toolbox, arguments, Call())
        assert reply.failed, (tool, arguments)
        assert len(reply.text.splitlines()) == 1, (tool, arguments, reply.text)
        assert "defect in handeye" not in reply.text, (tool, arguments)
        assert list(toolbox.folder.root.iterdir()) == []


@pytest.mark.parametrize(
    ("tool", "arguments", "said"),
    [
        ("run", {"script": 5}, "the arguments of `run` cannot be used: script: a whole number instead of a text"),
        ("run", {}, "no run has begun yet; `run` begins one"),
        ("run", {"seed": 3}, "`seed` is for a new run; give its `script` too, or leave `seed` out"),
        ("run", {"script": "insertion", "until": "L", "steps": 1}, "give `until` or `steps`, not both"),
        ("run", {"script": "insertion", "answer": "retry"}, "`answer` is for a run that has called the operator; a new "
         "run has not"),
        ("run", {"script": "insertion", "set": {"nix": 1}}, "the world has no quantity `nix`; choose from"),
        ("run", {"script": "palletise.trig"}, "there is no script `palletise.trig`, neither in the folder"),
        ("state", {"run": "run-9"}, "there is no run run-9; the runs are none"),
        ("plan", {"script": "insertion", "stage": 3}, "there is no stage 3; the plan has 2 stages"),
        ("world", {"task": "nix"}, "there is no task `nix`"),
        ("docs", {"topic": "turorial"}, "there is no page `turorial`; did you mean tutorial?"),
        ("explain", {"word": "CHANGED"}, "there is no code, error number or instruction `CHANGED`; did you mean "
         "`CHANGE`?"),
        ("submit", {"script": "insertion", "worlds": 21}, "the arguments of `submit` cannot be used: worlds: expected "
         "`int` <= 20"),
    ],
)  # fmt: skip
def test_the_sentence_names_what_is_wrong(toolbox: Toolbox, tool: str, arguments: object, said: str) -> None:
    reply = used(tool_named(tool), toolbox, arguments, Call())
    assert reply.failed
    assert reply.text.startswith(said)


@pytest.mark.parametrize(
    ("sent", "read"),
    [
        (r'"\ud800"', "�"),
        (r'"\udc00nix \uD83d"', "�nix �"),
        (r'"\ud800\ud83d\ude00"', "�😀"),
        (r'"\ud83d\ude00 \\ud800 \u0041"', r"😀 \ud800 A"),
    ],
)
def test_half_of_a_surrogate_pair_does_not_leave_a_client_without_an_answer(sent: str, read: str) -> None:
    from mcp.types import JSONRPCRequest, jsonrpc_message_adapter  # only where it is used: it takes seconds

    from handeye.agents.server import decodable

    asked = '{"jsonrpc":"2.0","id":1,"method":"tools/call","params":{"name":"docs","arguments":{"topic":%s}}}'
    message = jsonrpc_message_adapter.validate_json(decodable(asked % sent))
    assert isinstance(message, JSONRPCRequest)
    assert message.params == {"name": "docs", "arguments": {"topic": read}}
