"""The stepper's answer as a Python program gets it: a record that prints as it does on the terminal."""

from handeye.debugger.formatting import as_text
from handeye.debugger.reply import Reply


class Answer(Reply, frozen=True, kw_only=True):
    """A reply of the stepper; `print` shows it as the stepper does."""

    def __str__(self) -> str:
        """The answer for people, as lines of text."""
        return as_text(self)


def answer(reply: Reply) -> Answer:
    """A reply that prints itself."""
    return Answer(**{field: getattr(reply, field) for field in reply.__struct_fields__})
