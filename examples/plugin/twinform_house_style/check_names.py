"""Check that names look alike."""

import re
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Joint, Link, walk
from twinform.passes import Pass
from twinform_house_style.rules import UNUSUAL_NAME


class CheckNames(Pass):
    """Find links and joints whose names do not look like those of the others.

    Changes nothing.
    Diagnostics: `unusual-name` at each link and joint whose name `pattern` does not match.
    """

    name: ClassVar[str] = "check-names"
    example: ClassVar[str] = 'check-names{pattern="[a-z0-9_]+"}'
    pattern: str = Field(default="[a-z][a-z0-9_]*", description="What a whole name has to match.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The same document."""
        for node in walk(document):
            if isinstance(node, Link | Joint) and not re.fullmatch(self.pattern, node.name):
                sink.report(UNUSUAL_NAME, f"{node.name!r} is an unusual name", node.location, found=node.name)
        return document
