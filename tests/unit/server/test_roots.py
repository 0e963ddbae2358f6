"""Workspaces of several folders: what lies in one is found from the files of another."""

import pickle
from pathlib import Path

import pytest

from twinform.server.checking import no_settings
from twinform.server.completion import complete
from twinform.server.document_outline import links
from twinform.server.documents import TextDocument
from twinform.server.navigation import search_of
from twinform.server.session import Session

MESH = '<mesh filename="package://far/a.stl"/>'
TEXT = f'<robot name="r"><link name="a"><visual><geometry>{MESH}</geometry></visual></link></robot>'


@pytest.fixture(name="opened")
def opened_document(tmp_path: Path) -> tuple[Session, TextDocument]:
    near, far = tmp_path / "near" / "robot", tmp_path / "other" / "deep" / "far"
    for folder in (near, far):
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(f"<package><name>{folder.name}</name></package>")
        (folder / ".git").mkdir()
    (far / "a.stl").write_bytes(b"solid a\nendsolid a\n")
    session = Session(no_settings, lambda _: None)
    session.folders = [tmp_path / "near", tmp_path / "other"]
    return session, session.documents.follow((near / "r.urdf").as_uri(), TEXT, 1, "urdf")


def test_packages_of_another_folder_are_found(opened: tuple[Session, TextDocument]) -> None:
    session, document = opened
    (link,) = links(document, search_of(session, document))
    assert (link.tooltip or "").endswith("far/a.stl")
    job = session.job(document.uri)
    assert job is not None
    assert job.load_options.search.find("package://far/a.stl", document.path).name == "a.stl"  # in the check as well
    offered = {each.label for each in complete(session, document, TEXT.index("package://") + len("package://")).items}
    assert {"package://far/", "package://robot/"} <= offered


def test_packages_of_folders_that_are_not_open_are_not(opened: tuple[Session, TextDocument]) -> None:
    session, document = opened
    session.folders.pop()
    assert links(document, search_of(session, document)) == []


def test_what_the_worker_is_told_can_be_sent_to_it(opened: tuple[Session, TextDocument]) -> None:
    session, document = opened
    links(document, search_of(session, document))
    assert pickle.loads(pickle.dumps(session.job(document.uri))) == session.job(document.uri)
