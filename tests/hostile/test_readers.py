"""Nobody but `file_access` opens a file that a user has given or that one of these names."""

import ast
from collections.abc import Iterator
from pathlib import Path

import twinform

_PACKAGE = Path(twinform.__file__).parent
_OPENERS = frozenset({"open", "read_bytes", "read_text"})
_MODULES_THAT_OPEN = frozenset({"filecmp", "fileinput", "mmap", "shutil", "tarfile", "zipfile"})
DATA = "data files of the package"
RESULTS = "results of its own, in a folder that the user has named"
NOWHERE = "the null device"
OTHERS = {
    "cli/batch_run.py": "a report that the user has named",
    "cli/fix.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "cli/format.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "cli/inputs.py": "streams that were named as such",
    "cli/merge.py": "looks for git in the folders of PATH, and calls `read_bytes` of `compiler/input/parsing.py`",
    "cli/process.py": NOWHERE,
    "cli/view.py": "opens a browser",
    "compiler/batch/archives.py": "the archive that the user has named, and a temporary folder",
    "compiler/batch/run_batch.py": "opens a manifest by its own class",
    "compiler/batch/manifest.py": RESULTS,
    "compiler/batch/recording.py": "opens a manifest by its own class, and copies results",
    "compiler/batch/task.py": "the modules of the package",
    "compiler/gazebo_files.py": DATA,
    "compiler/model_config.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "compiler/input/loading.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "compiler/input/expand_xacro.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "compiler/input/xacro_parts.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "compiler/input/xacro/channel.py": NOWHERE,
    "compiler/observing.py": "a file that is being opened anyway",
    "compiler/batch/tar_reader.py": "the archive that the user has named",
    "compiler/packaging/fuel_cache.py": "copies files that were checked",
    "compiler/packaging/package.py": "writes results, and makes digests of files that were checked and may be large",
    "compiler/packaging/ros2_texts.py": DATA,
    "compiler/workers.py": "the null device, and an executor",
    "diagnostics/built_in_rule.py": DATA,
    "diagnostics/generated_files.py": DATA,
    "file_access.py": "the one reader",
    "passes/appearance/materials.py": DATA,
    "passes/classic/tables.py": DATA,
    "passes/mesh_jobs/child.py": NOWHERE,
    "passes/mesh_jobs/usd_jobs.py": "packages of USD, as bytes, in a confined process",
    "passes/mesh_jobs/job.py": "what the kernel says of this process",
    "passes/meshes/convert_meshes.py": DATA,
    "passes/meshes/mesh_pass.py": "results of its own, in the cache of the user",
    "passes/plugins/catalog.py": DATA,
    "passes/plugins/add_sensor.py": DATA,
    "profiles/profile.py": DATA,
    "profiles/walking.py": DATA,
    "report/report_page.py": DATA,
    "schemas/facts.py": DATA,
    "schemas/generate.py": DATA,
    "schemas/meanings.py": DATA,
    "schemas/packaged.py": DATA,
    "schemas/reader.py": "a function of this name that reads a text of an element",
    "server/mapping.py": DATA,
    "storage/staging.py": "files that it has made itself",
    "storage/transaction.py": "files that it has made itself",
    "storage/writing.py": "files that it has made itself, and pipes that are written into",
    "view/words.py": DATA,
}
"""Modules that open something, and what."""


def _opening_modules() -> Iterator[str]:
    for path in sorted(_PACKAGE.rglob("*.py")):
        name = path.relative_to(_PACKAGE).as_posix()
        if not name.startswith("testing/") and any(map(_opens, ast.walk(ast.parse(path.read_text())))):
            yield name


def _opens(node: ast.AST) -> bool:
    match node:
        case ast.Import(names=names):
            return any(each.name in _MODULES_THAT_OPEN for each in names)
        case ast.ImportFrom(module=module):
            return module in _MODULES_THAT_OPEN
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in _OPENERS
        case _:
            return False


def test_only_the_one_reader_opens_files_of_users() -> None:
    found = set(_opening_modules())
    assert found - OTHERS.keys() == set(), "read it by twinform.file_access"
    assert OTHERS.keys() - found == set(), "these open nothing any more"
