"""`handeye --install-completion` writes what it says into the home folder."""

import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import Command

BASH = shutil.which("bash")
WRITTEN = {
    "bash": (".local/share/bash-completion/completions/handeye", ".bashrc"),
    "zsh": (".zsh/completions/_cyclopts_handeye", ".zshrc"),
    "fish": (".config/fish/completions/handeye.fish", None),
}
"""By shell: the completions, and the file that is told to load them."""


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home folder without a start-up file, where no framework of zsh is installed."""
    for name in ("ZSH", "ZSH_CUSTOM"):
        monkeypatch.delenv(name, raising=False)
    for name in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(tmp_path))
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize("shell", WRITTEN)
def test_everything_that_is_written_is_told(
    command: Command, home: Path, monkeypatch: pytest.MonkeyPatch, shell: str
) -> None:
    monkeypatch.setenv("SHELL", f"/usr/bin/{shell}")
    code, out, _ = command("--install-completion")
    told = {line.split(":")[0] for line in out.splitlines() if line.startswith(str(home))}
    assert (code, told) == (0, {str(home / name) for name in WRITTEN[shell] if name})
    assert told == {str(file) for file in home.rglob("*") if file.is_file()}


@pytest.mark.slow
def test_a_start_up_file_keeps_its_lines_and_is_told_only_once(command: Command, home: Path) -> None:
    (home / ".bashrc").write_text("export EDITOR=ed\n")
    command("--install-completion", "--shell", "bash")
    once = (home / ".bashrc").read_text()
    _, out, _ = command("--install-completion", "--shell", "bash")
    assert f"{home}/.bashrc: already loads this file" in out
    assert (home / ".bashrc").read_text() == once
    assert once.startswith("export EDITOR=ed\n")


@pytest.mark.slow
@pytest.mark.skipif(BASH is None, reason="there is no bash here")
def test_bash_completes_a_command(command: Command, home: Path) -> None:
    assert BASH is not None
    command("--install-completion", "--shell", "bash")
    ask = "COMP_WORDS=(handeye asse); COMP_CWORD=1; _handeye; echo ${COMPREPLY[@]}"
    done = subprocess.run(
        [BASH, "-c", f". {home}/.bashrc; {ask}"], capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == ("assemble\n", "")


@pytest.mark.parametrize(
    ("named", "found"),
    [("/bin/tcsh", "the variable SHELL names `tcsh`"), ("", "the variable SHELL names no shell")],
)
def test_for_an_unknown_shell_nothing_is_written(
    command: Command, home: Path, monkeypatch: pytest.MonkeyPatch, named: str, found: str
) -> None:
    monkeypatch.setenv("SHELL", named)
    assert command("--install-completion") == (
        2,
        "",
        f"handeye: completion is available for bash, zsh and fish, but {found}: choose one with --shell\n",
    )
    assert [*home.iterdir()] == []
