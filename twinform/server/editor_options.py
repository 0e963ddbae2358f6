"""What an editor asks for when it starts the server, in `initializationOptions`."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Self, cast

from twinform.dataclass import dataclass

_NAMES = {"code_lens": "codeLens", "check_workspace": "checkWorkspace"}


@dataclass(frozen=True, slots=True)
class EditorOptions:
    """The options of an editor.

    Attributes:
        code_lens: whether the number of references stands above each definition.
        check_workspace: whether files that are not open are checked as well.
    """

    code_lens: bool = True
    check_workspace: bool = False

    @classmethod
    def of(cls, given: object) -> Self:
        """Take the options that an editor sent; what is no option, or neither true nor false, is ignored."""
        sent: Mapping[str, Any] = cast("Mapping[str, Any]", given) if isinstance(given, Mapping) else {}
        values = {each.name: sent.get(_NAMES[each.name]) for each in fields(cls)}
        return cls(**{name: value for name, value in values.items() if isinstance(value, bool)})
