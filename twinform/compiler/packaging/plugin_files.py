"""Files that parameters of plugins name: not put into a package, since only the plugin knows what they mean."""

import re
from collections.abc import Callable, Iterator

from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import UNPACKAGED_PARAMETER
from twinform.ir import Document, Element, Plugin, rewrite
from twinform.ir.rewrite import untyped_elements

_FILE = re.compile(r"(?:package|model|file)://\S+|\$\(find [^)]*\)\S*")


def report_plugin_files(document: Document, is_there: Callable[[str], bool], sink: DiagnosticSink) -> None:
    """Report each URI in parameters of plugins, once, but for those of which it is known that they are there."""
    reported: set[str] = set()
    for uri, plugin, where in _uris(document):
        if uri not in reported and not is_there(uri):
            reported.add(uri)
            message = f"plugin {plugin!r} names {uri!r}, which is not put into the package"
            sink.report(UNPACKAGED_PARAMETER, message, where, found=uri)


def _uris(document: Document) -> Iterator[tuple[str, str, Location]]:
    """The URIs, the plugin that has each, and where it stands."""
    plugins: list[Plugin] = []

    def note(plugin: Plugin) -> Plugin:
        plugins.append(plugin)
        return plugin

    rewrite(document, Plugin, note)
    for plugin in plugins:
        for part in plugin.content:
            yield from _in_element(part, plugin.name or plugin.filename or "", plugin.location)
    for element in untyped_elements(document):
        for inner in element.walk() if element.name == "plugin" else ():
            yield from _in_element(inner, element.get("name") or element.get("filename") or "", document.location)


def _in_element(element: Element, plugin: str, around: Location) -> Iterator[tuple[str, str, Location]]:
    for inner in element.walk():
        where = inner.location if inner.source else around
        for text in (inner.text or "", *(value for _, value in inner.attributes)):
            yield from ((uri, plugin, where) for uri in _FILE.findall(text))
