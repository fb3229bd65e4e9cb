"""The folder of what can be made again is where each platform wants it."""

from pathlib import Path

import pytest

from handeye.core.resources import cache_folder

HOME = {"HOME": "/home/ann", "USERPROFILE": "/home/ann"}


@pytest.mark.parametrize(
    ("platform", "variables", "folder"),
    [
        ("linux", {}, "/home/ann/.cache/handeye"),
        ("linux", {"XDG_CACHE_HOME": "/fast"}, "/fast/handeye"),
        ("linux", {"XDG_CACHE_HOME": "not/absolute"}, "/home/ann/.cache/handeye"),
        ("linux", {"XDG_CACHE_HOME": ""}, "/home/ann/.cache/handeye"),
        ("darwin", {"XDG_CACHE_HOME": "/fast"}, "/home/ann/Library/Caches/handeye"),
        ("win32", {"LOCALAPPDATA": "/local"}, "/local/handeye/Cache"),
        ("win32", {}, "/home/ann/AppData/Local/handeye/Cache"),
        ("linux", {"HANDEYE_CACHE": "/mine", "XDG_CACHE_HOME": "/fast"}, "/mine"),
        ("linux", {"HANDEYE_CACHE": ""}, None),
    ],
)
def test_the_folder_is_that_of_the_platform_unless_it_is_named(
    platform: str, variables: dict[str, str], folder: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("XDG_CACHE_HOME", "LOCALAPPDATA", "HANDEYE_CACHE"):
        monkeypatch.delenv(name, raising=False)
    for name, value in {**HOME, **variables}.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr("sys.platform", platform)
    assert cache_folder() == (None if folder is None else Path(folder))


def test_nothing_is_kept_where_nobody_knows_the_home(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError

    for name in ("XDG_CACHE_HOME", "HANDEYE_CACHE"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr(Path, "home", homeless)
    assert cache_folder() is None
