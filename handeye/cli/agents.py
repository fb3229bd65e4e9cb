"""The command that serves an agent."""

import os
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import note
from handeye.core.errors import MissingExtra


def mcp(
    *,
    folder: Annotated[
        Path | None,
        Parameter(
            help="The folder of the agent's scripts and runs; nothing outside it is read or written. Default: a new "
            "folder under the current one."
        ),
    ] = None,
) -> int:
    """Serve an agent (model context protocol over standard input and output): twelve tools to write and judge programs.

    Needs the extra `mcp`. The command ends when the agent closes its end; `handeye resume` resumes a run that was in
    progress.
    """
    try:
        from handeye.agents.server import serve
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("mcp", "anyio"):
            raise
        raise MissingExtra("mcp", "mcp", "mcp") from None
    from handeye.agents.agent_folder import AgentFolder
    from handeye.agents.toolbox import Toolbox

    place = AgentFolder.at(folder)
    note(f"the agent's folder is {place.root}")
    try:
        serve(Toolbox(place))
    except KeyboardInterrupt:
        note("interrupted; the runs are closed and can be resumed")
        os._exit(130)  # a thread still waits for standard input, and would keep the process
    return 0
