"""Merges the namespace prefixes of documents that become one."""

from collections.abc import Iterable

Namespaces = tuple[tuple[str, str], ...]
"""Prefixes, each with its namespace; the empty prefix is the default."""


def joined(first: Namespaces, others: Iterable[Namespaces]) -> Namespaces:
    """Merge namespace declarations: those of the first document win; others add prefixes that are still free."""
    found, known = dict(first), {uri for _, uri in first}
    for prefix, uri in (pair for each in others for pair in each):
        if prefix and uri not in known and found.setdefault(prefix, uri) == uri:
            known.add(uri)
    return tuple(found.items())
