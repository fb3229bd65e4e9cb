"""Makes the views that show the state of a paused run."""

from collections.abc import Collection
from pathlib import Path
from typing import Any

from handeye.core.diagnostics import quoted
from handeye.core.errors import CannotWrite, NoSuchName, Refused
from handeye.core.files import write_whole
from handeye.core.plain_text import one_line
from handeye.debugger.breakpoints import meant
from handeye.debugger.view_records import PictureShown, RunViews, TaskView
from handeye.program.events import PictureTaken
from handeye.results.pictures import annotated_png
from handeye.runs.runner import Runner


def show(runner: Runner, what: str = "", pictures: Path | None = None) -> RunViews:
    """Return the views for the topics in `what`. The names of topics may be abbreviated. If `what` is empty, all
    topics except `positions` are shown. Raises InvalidInput if a topic is unknown.

    The last picture is written to the folder `pictures`, if one is given.
    """
    known = {**runner.kind.topics, **({"tasks": ("tasks", task_views)} if task_views(runner) else {})}
    names = [_topic(word, known) for word in what.split()] or [n for n in known if n != "positions"]
    fields: dict[str, Any] = {}
    for name in names:
        field, look = known[name]
        fields[field] = look(runner)
    last = fields.get("picture")
    if last is not None and pictures is not None:
        fields["picture"] = _kept(runner, last.name, pictures)
    return RunViews(**fields)


def task_views(runner: Runner) -> tuple[TaskView, ...]:
    """Return, for each task, the place that it has reached in the program. Returns no views if the tasks have no
    names, as in a system with one task.
    """
    steps = runner.listing.steps
    return tuple(
        TaskView(
            task=place.task,
            step=place.step,
            file=steps[place.step].file,
            line=steps[place.step].line,
            text=one_line(steps[place.step].text),
            waits_for=place.waits_for,
        )
        for place in runner.places
        if place.task
    )


def write_picture(runner: Runner, file: Path) -> str:
    """Write the last picture with its marks as a PNG file. Returns the name of the picture. Raises InvalidInput
    if there is no picture.
    """
    last = last_picture(runner)
    if last is None:
        raise Refused("the program has taken no picture yet")
    write_whole(file, annotated_png(runner.system, last))
    return last


def _topic(what: str, topics: Collection[str]) -> str:
    found = [name for name in topics if name.startswith(what.casefold())]
    if what.casefold() not in topics and len(found) != 1:
        near = meant(what, topics) or f"; the topics are {', '.join(topics)}"
        raise NoSuchName(f"there is no {quoted(what)} to show{near}")
    return found[0]


def last_picture(runner: Runner) -> str | None:
    """Return the name of the last picture that still exists, or None if there is no such picture."""
    taken = [event.picture for event in runner.events if isinstance(event, PictureTaken)]
    return next((name for name in reversed(taken) if name in runner.system.shots), None)


def _kept(runner: Runner, name: str, folder: Path) -> PictureShown:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotWrite(f"the folder {folder} cannot be created: {error.strerror}") from None
    file = folder / f"{name.lower()}.png"
    write_picture(runner, file)
    return PictureShown(name=name, file=str(file))
