"""Graphs of models: links and joints, with nested models, worlds, frames and mimics, as Mermaid, DOT or SVG."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from twinform.compiler.graph.graph import Attachment, Cluster, Follower, Graph, GraphJoint, GraphNode, build_graph
from twinform.compiler.graph.languages import dot, mermaid
from twinform.compiler.graph.svg import svg

WRITERS: Mapping[str, Callable[[Graph], str]] = MappingProxyType({"mermaid": mermaid, "dot": dot, "svg": svg})
"""Every language by its name on the command line."""

__all__ = ["WRITERS", "Attachment", "Cluster", "Follower", "Graph", "GraphJoint", "GraphNode", "build_graph"]
