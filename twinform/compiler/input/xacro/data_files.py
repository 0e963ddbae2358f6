"""YAML files that `xacro.load_yaml` reads: plain data, with units, and aliases that do not multiply beyond measure."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import yaml

from twinform.compiler.input.xacro.budget import LONGEST_TEXT, ExcessError
from twinform.compiler.input.xacro.expression_values import Value, dotted

LARGEST = 2**20
"""In bytes. The largest real one that we know has 20,000."""


class DataFileError(yaml.YAMLError):
    """A file is no YAML, or none that a model needs."""


class _Loader(yaml.SafeLoader):
    """Counts the nodes of a document, those behind an alias as often as it stands there.

    So neither aliases of aliases nor keys that are merged into each other take more time than the file is long.
    """

    def __init__(self, data: bytes) -> None:
        super().__init__(data)
        self.weight = 0
        self.weights: dict[int, int] = {}

    def compose_node(self, parent: Any, index: Any) -> Any:
        events: Any = self
        alias: bool = events.check_event(yaml.AliasEvent)
        before = self.weight
        self.weight += 1
        node = super().compose_node(parent, index)
        if alias and id(node) not in self.weights:
            raise ExcessError("a data file has an alias inside of what it stands for")
        if alias:
            self.weight += self.weights[id(node)]
        else:
            self.weights[id(node)] = self.weight - before
        if self.weight > LONGEST_TEXT:
            raise ExcessError(f"a data file has more than {LONGEST_TEXT:,} values")
        return node


class DataFiles:
    """Reads data files, in which expressions may stand behind the tags of units."""

    def __init__(self, units: Mapping[str, float], evaluate: Callable[[str], Value]) -> None:
        self.evaluate = evaluate

        class Loader(_Loader):
            """Knows the units of this xacro."""

        for tag, factor in units.items():
            Loader.add_constructor(tag, partial(self._measure, factor=factor))
        self.loader = Loader

    def load(self, data: bytes, file: str) -> Value:
        """The content of a file."""
        if len(data) > LARGEST:
            raise ExcessError(f"a data file has {len(data):,} bytes; the limit is {LARGEST:,}")
        loader: Any = self.loader(data)
        loader.name = file
        try:
            return dotted(loader.get_single_data())
        except yaml.YAMLError as error:
            raise DataFileError(_complaint(file, getattr(error, "problem_mark", None))) from error
        finally:
            loader.dispose()

    def _measure(self, loader: Any, node: Any, *, factor: float) -> float:
        """A number with a unit."""
        return float(self.evaluate(loader.construct_scalar(node))) * factor


def _complaint(file: str, mark: Any) -> str:
    """Where a file is no YAML. What stands there is not repeated: the file may be somebody's secret."""
    place = f", line {mark.line + 1}, column {mark.column + 1}" if mark is not None else ""
    return f"cannot read {file!r}: it is no YAML{place}"
