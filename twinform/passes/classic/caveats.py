"""What means something else after a migration, or needs the author's hand: said, never silent."""

from collections.abc import Iterator

from twinform.ir import Plugin
from twinform.passes.classic.moving import truth_of
from twinform.passes.classic.tables import Caveat, Migration


def reasons_to_look(migration: Migration, plugin: Plugin, sensor: str | None = None) -> Iterator[str]:
    """What the author has to write beside a migrated plugin, and to know of it; `sensor` is the type it became."""
    if migration.geometry:
        yield migration.geometry
    for caveat in migration.caveats:
        if caveat.type in {None, sensor} and _applies(caveat, plugin):
            yield caveat.says


def _applies(caveat: Caveat, plugin: Plugin) -> bool:
    written = {child.name: child.text or "" for child in plugin.content}
    if any(name in written for name in caveat.unless):
        return False
    return not caveat.where or any(truth_of(written.get(name, "")) for name in caveat.where)
