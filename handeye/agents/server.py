"""Serves the tools to one agent over standard input and output, with the Python SDK of the model context protocol.

Calls that use a cell are executed in a thread, one at a time, in the order in which they arrive. Meanwhile, the server
answers all other calls. If the agent leaves, the runs are closed, and can be resumed.
"""

import base64
import logging
import re
import sys
from contextlib import suppress
from typing import Any, Final, Self

import anyio
import anyio.from_thread
import anyio.to_thread
from mcp import types
from mcp.server.context import ServerRequestContext
from mcp.server.lowlevel import Server
from mcp.server.stdio import stdio_server

from handeye.agents.call import Call
from handeye.agents.replies import Reply
from handeye.agents.requests import schema
from handeye.agents.toolbox import Toolbox
from handeye.agents.tools import TOOLS, Tool, tool_named, used
from handeye.core.errors import NoSuchName
from handeye.core.versions import HANDEYE

INSTRUCTIONS: Final = (
    "handeye simulates the Stanford arm of 1973, which assembles by force and touch. Write programs in its "
    "language, check them, run them in simulated worlds, and submit them to the referee. Read `docs` (language, "
    "tutorial) first. A program that is not sure must call the operator and must not report success: a silent "
    "failure is the worst outcome."
)
Context = ServerRequestContext[Any, Any]


def serve(toolbox: Toolbox) -> None:
    """Serve an agent until it leaves."""
    logging.getLogger("mcp").setLevel(logging.ERROR)
    try:
        anyio.run(_serve, toolbox)
    finally:
        toolbox.close()


async def _serve(toolbox: Toolbox) -> None:
    server = server_of(toolbox)
    async with stdio_server(stdin=_Lines()) as (incoming, outgoing):  # type: ignore[arg-type] # it only iterates
        await server.run(incoming, outgoing, server.create_initialization_options())


class _Lines:
    """The lines of standard input. While a server waits for one of these lines, it can be interrupted at once. A
    server that reads standard input as a file could not be interrupted while it waits.
    """

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> str:
        line: bytes = await anyio.to_thread.run_sync(sys.stdin.buffer.readline, abandon_on_cancel=True)
        if not line:
            raise StopAsyncIteration
        return decodable(line.decode("utf-8", errors="replace"))


_ESCAPED: Final = re.compile(
    r"\\u[dD][89abAB][\da-fA-F]{2}\\u[dD][c-fC-F][\da-fA-F]{2}|(\\u[dD][89a-fA-F][\da-fA-F]{2})|\\."
)
"""An escape in a JSON text. The group of this expression matches one half of a surrogate pair if the other half is
missing.
"""


def decodable(line: str) -> str:
    """Return a message that the decoder of the SDK accepts. The decoder drops a message with half of a surrogate pair,
    and sends no answer. This function therefore replaces such a half by a replacement character.
    """
    return _ESCAPED.sub(lambda found: r"\ufffd" if found[1] else found[0], line)


def server_of(toolbox: Toolbox) -> Server[Any]:
    """Return the server of an agent's tools, for any transport."""
    one_at_a_time = anyio.Lock()

    async def listed(_: Context, __: types.PaginatedRequestParams | None) -> types.ListToolsResult:
        return types.ListToolsResult(tools=[_described(tool) for tool in TOOLS])

    async def called(context: Context, asked: types.CallToolRequestParams) -> types.CallToolResult:
        try:
            tool = tool_named(asked.name)
        except NoSuchName as error:
            return _result(Reply(text=str(error), failed=True))
        if not tool.queues:
            return _result(await _executed(tool, toolbox, asked.arguments, context))
        async with one_at_a_time:
            return _result(await _executed(tool, toolbox, asked.arguments, context))

    return Server(
        "handeye",
        version=HANDEYE,
        instructions=INSTRUCTIONS,
        on_list_tools=listed,
        on_call_tool=called,
    )


async def _executed(tool: Tool, toolbox: Toolbox, arguments: object, context: Context) -> Reply:
    """Execute a call in a thread. If the call is cancelled, the run pauses, and then the thread ends."""

    def report(done: float, whole: float | None, text: str) -> None:
        with suppress(Exception):  # an agent that has left hears nothing; its run pauses all the same
            anyio.from_thread.run(context.session.report_progress, done, whole, text)

    call = Call(report=report)
    replies: list[Reply] = []

    async def cancel_when_asked() -> None:
        try:
            await anyio.sleep_forever()
        finally:
            call.cancelled.set()

    async with anyio.create_task_group() as group:
        group.start_soon(cancel_when_asked)
        replies.append(await anyio.to_thread.run_sync(used, tool, toolbox, arguments, call))
        group.cancel_scope.cancel()
    return replies[0]


def _described(tool: Tool) -> types.Tool:
    return types.Tool(
        name=tool.name,
        description=tool.about,
        input_schema=schema(tool.takes),
        annotations=types.ToolAnnotations(
            read_only_hint=not tool.changes,
            destructive_hint=tool.drops,
            idempotent_hint=not tool.changes,
            open_world_hint=False,
        ),
    )


def _result(reply: Reply) -> types.CallToolResult:
    content: list[types.ContentBlock] = [types.TextContent(type="text", text=reply.text)]
    if reply.png is not None:
        data = base64.b64encode(reply.png).decode()
        content.append(types.ImageContent(type="image", data=data, mime_type="image/png"))
    return types.CallToolResult(content=content, structured_content=reply.data, is_error=reply.failed)
