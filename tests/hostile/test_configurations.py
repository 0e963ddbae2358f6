"""Configurations that came along with a model: each is an error with its place, for little time and memory."""

from pathlib import Path

import pytest

from tests.hostile.child import twinform

_NESTED = "".join(f"p{number} = '@p{number + 1}'\n" for number in range(5000))
_DOUBLED = "".join(f"p{number} = '@p{number + 1},@p{number + 1}'\n" for number in range(25))
_LAST = "p25 = 'check-limits'\n"

WRONG = {
    "a number of 5,000 digits": (f"strict = true\nmax-tags = {'9' * 5000}", ":2: a number has more than 4,300 digits"),
    "a number of 4,000 digits": (f"max-tags = {'9' * 4000}", "max-tags: "),
    "a size of 5,000 digits": (f"max-size = '{'9' * 5000}'", "9...' is no size"),
    "an infinite limit": ("max-tags = inf", "max-tags: should be a valid integer"),
    "a limit that is no number": ("max-tags = nan", "max-tags: should be a valid integer"),
    "a negative limit": ("max-tags = -1", "max-tags: should be greater than 0"),
    "a negative size": ("max-size = -1", "is no size"),
    "a date for a limit": ("max-tags = 1979-05-27", "max-tags: should be a valid integer"),
    "lists in lists": (f"paths = {'[' * 100_000}", "nested too deeply"),
    "tables in tables": (f"a = {'{a = ' * 50_000}1{'}' * 50_000}", "nested too deeply"),
    "a key of 200,000 parts": (f"strict = true\na{'.a' * 200_000} = 1", ":2: a key has more than 64 parts"),
    "a key of quoted parts": ("a" + '. "a"' * 100_000 + " = 1", ":1: a key has more than 64 parts"),
    "a header of 200,000 parts": (f"[a{'.a' * 200_000}]", ":1: a key has more than 64 parts"),
    "a key twice": ("max-tags = 1\nmax-tags = 2", ":2: Cannot overwrite a value"),
    "a zero character": ('baseline = "a\\u0000b"', "zero character"),
    "200,000 folders": ("paths = [" + "'a'," * 200_000 + "]", "paths: List should have at most 1000 items"),
    "200,000 names of rules": ("deny = [" + "'a'," * 200_000 + "]", "deny: List should have at most 1000 items"),
    "30,000 tables of files": ("[[files]]\nmatch = ['*']\n" * 30_000, "files: List should have at most 1000 items"),
    "2 MiB of comments": ("#" * 2**21, "larger than 1048576 bytes"),
    "pipelines that double": (f"passes = '@p0'\n[pipelines]\n{_DOUBLED}{_LAST}", "more than 1,000 passes"),
    "pipelines in pipelines": (f"passes = '@p0'\n[pipelines]\n{_NESTED}", "more than 32 pipelines"),
    "a pipeline of itself": ("passes = '@p0'\n[pipelines]\np0 = '@p0'", "stands for itself"),
    "more tags than usual": ("max-tags = 1000001", "max-tags: 1,000,001 is more than the usual 1,000,000"),
    "larger files than usual": ("max-size = '65MiB'", "max-size: 68,157,440 is more than the usual 67,108,864"),
    "a pass with a number of 5,000 digits": (f"passes = 'fill-limits{{effort={'9' * 5000}}}'", "passes"),
}


@pytest.mark.parametrize("what", WRONG)
@pytest.mark.parametrize("file", ["twinform.toml", pytest.param("pyproject.toml", marks=pytest.mark.deep)])
def test_a_hostile_configuration_is_an_error_with_its_place(what: str, file: str, tmp_path: Path) -> None:
    text, word = WRONG[what]
    (tmp_path / "a.urdf").write_text('<robot name="a"><link name="base"/></robot>')
    (tmp_path / file).write_text(f"{text}\n" if file == "twinform.toml" else f"{_shared(text)}\n")
    found = twinform("convert", "a.urdf", "--to", "sdf", folder=tmp_path)
    assert found.code == 2, found.output
    assert file in found.output
    assert (word if file == "twinform.toml" else word.rpartition(":2: ")[2].rpartition(":1: ")[2]) in found.output
    assert "Traceback" not in found.output
    assert len(found.output) < 8000


def _shared(text: str) -> str:
    """The settings in the file that several tools share."""
    tables = text.replace("[pipelines]", "[tool.twinform.pipelines]").replace("[[files]]", "[[tool.twinform.files]]")
    return f"[tool.twinform]\n{tables}" if not text.startswith("[[files]]") else tables


def test_what_is_no_text_is_an_error_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "a.urdf").write_text('<robot name="a"><link name="base"/></robot>')
    (tmp_path / "twinform.toml").write_bytes(b"strict = true\nmax-tags = 1 # \xff")
    assert "twinform.toml:2: the file is not UTF-8" in twinform("check", "a.urdf", folder=tmp_path).output


@pytest.mark.parametrize(
    ("setting", "option"), [("max-tags = 1000001", "--max-tags"), ("max-size = '65MiB'", "--max-size")]
)
def test_who_calls_may_raise_a_limit(setting: str, option: str, tmp_path: Path) -> None:
    (tmp_path / "a.urdf").write_text('<robot name="a"><link name="base"/></robot>')
    (tmp_path / "twinform.toml").write_text(setting)
    for words in (("--trust-config",), ("--no-config",), (option, "70000000")):
        assert twinform("check", "a.urdf", *words, folder=tmp_path).code == 0
    (tmp_path / "twinform.toml").write_text("max-tags = 1")
    assert "oversized-file" in twinform("check", "a.urdf", folder=tmp_path).output
