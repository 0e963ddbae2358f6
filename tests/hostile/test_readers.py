"""Nobody but `file_access` opens a file that a user has given, and no parser of XML opens one that a document names."""

import ast
from collections.abc import Iterator
from pathlib import Path

import twinform
from twinform.profiles.xml_parsers import parse_with_lxml

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
    "compiler/input/mjcf/model_files.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "compiler/input/mjcf/splice_includes.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "compiler/input/included_parts.py": "calls `read_bytes` of `compiler/input/parsing.py`",
    "compiler/input/xacro/channel.py": NOWHERE,
    "compiler/observing.py": "a file that is being opened anyway",
    "compiler/batch/tar_reader.py": "the archive that the user has named",
    "compiler/packaging/fuel_cache.py": "copies files that were checked",
    "compiler/packaging/package.py": "writes results, and makes digests of files that were checked and may be large",
    "compiler/packaging/ros2_texts.py": DATA,
    "compiler/workers.py": "the null device, and an executor",
    "diagnostics/built_in_rule.py": DATA,
    "file_access.py": "the one reader",
    "installation.py": "what uv and pip have noted of this installation",
    "passes/appearance/materials.py": DATA,
    "passes/classic/tables.py": DATA,
    "passes/mesh_jobs/child.py": NOWHERE,
    "passes/mesh_jobs/image_making.py": "images, as bytes, in a confined process",
    "passes/mesh_jobs/usd_jobs.py": "packages of USD, as bytes, in a confined process",
    "passes/mesh_jobs/job.py": "what the kernel says of this process",
    "passes/meshes/convert_meshes.py": DATA,
    "passes/meshes/mesh_pass.py": "results of its own, in the cache of the user",
    "passes/plugins/catalog.py": DATA,
    "passes/plugins/add_sensor.py": DATA,
    "profiles/features.py": DATA,
    "profiles/profile.py": DATA,
    "profiles/reads_tables.py": DATA,
    "report/report_page.py": DATA,
    "schemas/facts.py": DATA,
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
_LXML_READERS = frozenset({"XMLParser", "XMLPullParser", "iterparse"})


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


def test_every_parser_of_lxml_leaves_entities_alone() -> None:
    """`iterparse` of lxml before 6.1 resolves external entities unless it is told not to (CVE-2026-41066)."""
    for path in _PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            match node:
                case ast.Call(func=ast.Attribute(attr=name)) if name in _LXML_READERS:
                    told = {each.arg: ast.unparse(each.value) for each in node.keywords}
                    assert told.get("resolve_entities") == "False", f"{path.name}:{node.lineno}"
                case _:
                    pass


def test_recovery_of_the_text_of_a_consumer_reads_no_file_that_an_entity_names(tmp_path: Path) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text("not for the document")
    content = f'<!DOCTYPE r [<!ENTITY e SYSTEM "{secret.as_uri()}">]><robot>&e;<drake:a/></robot'.encode()
    (root,), mistake = parse_with_lxml(content)
    assert mistake
    assert "not for" not in repr(root)
