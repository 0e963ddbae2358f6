"""Features: small files in `data/features/`, each of which asks what a consumer makes of one thing.

A feature is named by its folder and its file, such as `joints/mimic`. Its first comment is its title and its question.
`data/shown_by.json` says which feature shows what a row of a profile is about; it is made by assessing all features
(`generators/shown_by.py`).
"""

import json
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

from twinform.dataclass import dataclass
from twinform.diagnostics.catalog import HOME
from twinform.lazy import lazy_pattern

_DATA = Path(__file__).with_name("data")
FEATURES, SHOWN_BY = _DATA / "features", _DATA / "shown_by.json"
PLAIN = "trees/two-links"
"""The feature that has nothing but two links and a joint: what is said of it is said of every robot."""
_PAGES = "docs/reference/who_reads_what"
_ABOUT = lazy_pattern(r"<!-- (?P<title>[^?]+?): (?P<question>[^?]+\?) -->")


@dataclass(frozen=True, slots=True)
class Feature:
    """A file that asks one thing of every consumer."""

    name: str
    title: str
    question: str
    path: Path
    text: str

    @property
    def group(self) -> str:
        """What the feature is about, such as `joints`."""
        return self.name.partition("/")[0]

    @property
    def page(self) -> str:
        """Where it stands what every consumer was seen to do: an address, or a path if the project has no address."""
        group, _, stem = self.name.partition("/")
        return f"{HOME}/blob/main/{_PAGES}/{group}.md#{stem}" if HOME else f"{_PAGES}/{group}.md#{stem}"

    @property
    def format(self) -> str:
        """The format of the file, `URDF` or `SDF`."""
        return self.path.suffix[1:].upper()


@cache
def features() -> dict[str, Feature]:
    """All features by name, sorted."""
    paths = [path for path in sorted(FEATURES.glob("*/*")) if path.suffix in {".urdf", ".sdf"}]
    return {each.name: each for each in map(_read_feature, paths)}


def _read_feature(path: Path) -> Feature:
    text = _decode(path.read_bytes())
    found = _ABOUT.search(text)
    if found is None:
        raise ValueError(f"{path.name} has no comment with a title and a question")
    title, question = (re.sub(r"\s+", " ", found[part]) for part in ("title", "question"))
    return Feature(f"{path.parent.name}/{path.stem}", title, f"{question[0].upper()}{question[1:]}", path, text)


def shown_by(about: str, path: str, rule: str = "") -> str:
    """The name of the feature that shows what a row is about; empty where there is none.

    Args:
        about: What the row says that the consumer does.
        path: Where it was found: an XPath, whose predicates do not count.
        rule: The rule of the finding, where there is one. Another rule is another thing.
    """
    plain = strip_predicates(path)
    known = [each for each in _shown().get(about, ()) if rule in {"", each[0]}]
    fitting: tuple[Callable[[str], bool], ...] = (
        lambda other: other == plain,
        lambda other: other.rpartition("/")[2] == plain.rpartition("/")[2],
        lambda _: True,
    )
    return next((feature for fits in fitting for _, other, feature in known if fits(other)), "")


def strip_predicates(path: str) -> str:
    """An XPath without the predicates that tell an element from its like."""
    return re.sub(r"\[[^]]*\]", "", path)


@cache
def _shown() -> dict[str, list[tuple[str, str, str]]]:
    return json.loads(SHOWN_BY.read_text(encoding="utf-8"))


def _decode(content: bytes) -> str:
    """The text of a file, by its byte order mark; what is no UTF-8 is Latin-1."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return content.decode("utf-16")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")
