"""No module imports itself by way of others, be it in a function or for its types alone."""

from graphlib import TopologicalSorter

from grimp import build_graph


def test_imports_run_in_no_circle() -> None:
    graph = build_graph("twinform", cache_dir=None)
    imports = {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    TopologicalSorter(imports).prepare()  # which raises a CycleError that names the circle
