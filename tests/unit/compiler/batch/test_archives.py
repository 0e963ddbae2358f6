"""Archives that anybody may have made."""

import io
import os
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from twinform.compiler.batch import archives
from twinform.compiler.batch.archives import is_archive, unpacked
from twinform.compiler.batch.entries import FolderError
from twinform.compiler.observing import digest

Entries = list[tuple[str, bytes]]


def _tar(path: Path, entries: Entries) -> Path:
    with tarfile.open(path, "w:gz") as archive:
        for name, content in entries:
            info = tarfile.TarInfo(name)
            info.size, info.mtime = len(content), 1_000_000_000
            archive.addfile(info, io.BytesIO(content))
    return path


def _zip(path: Path, entries: Entries) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries:
            archive.writestr(zipfile.ZipInfo(name, (2001, 9, 9, 1, 46, 40)), content, zipfile.ZIP_DEFLATED)
    return path


@pytest.fixture(params=["a.tar.gz", "a.zip"])
def make(request: pytest.FixtureRequest, tmp_path: Path) -> Callable[[Entries], Path]:
    """Makes an archive of one kind or the other."""
    name: str = request.param
    return lambda entries: (_zip if name.endswith("zip") else _tar)(tmp_path / name, entries)


def _files(folder: Path) -> dict[str, bytes]:
    found = (path for path in folder.rglob("[!.]*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


def test_files_come_with_their_times(make: Callable[[Entries], Path]) -> None:
    with unpacked(make([("a/b.urdf", b"one"), ("c.urdf", b"two")])) as made:
        assert _files(made.folder) == {"a/b.urdf": b"one", "c.urdf": b"two"}
        assert made.contents == {name: digest(content) for name, content in _files(made.folder).items()}
        assert abs((made.folder / "c.urdf").stat().st_mtime - 1_000_000_000) < 15 * 3600  # zip has no time zones
    assert not made.folder.exists()


@pytest.mark.parametrize("name", ["../up.urdf", "/root.urdf", "a/../../up.urdf", "a\\..\\up.urdf", "C:up.urdf"])
def test_a_name_that_leads_out_is_refused(name: str, make: Callable[[Entries], Path], tmp_path: Path) -> None:
    archive = make([("good.urdf", b"x"), (name, b"y")])
    with pytest.raises(FolderError, match="leads out of it"), unpacked(archive):
        pass
    assert sorted(path.name for path in tmp_path.iterdir()) == [archive.name]


def test_what_unpacks_to_too_much_is_refused(make: Callable[[Entries], Path], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(archives, "LEAST_BYTES", 1000)
    archive = make([("bomb.urdf", bytes(5_000_000))])
    with pytest.raises(FolderError, match=r"more than [\d,]+ bytes; unpack it yourself"), unpacked(archive):
        pass
    monkeypatch.setattr(archives, "LEAST_FILES", 1)
    monkeypatch.setattr(archives, "BYTES_PER_FILE", 10**6)
    many = make([(f"{number}.urdf", b"") for number in range(3)])
    with pytest.raises(FolderError, match="more than 1 files and folders"), unpacked(many):
        pass


def test_links_and_devices_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "a.tar"
    with tarfile.open(path, "w") as archive:
        for name, kind in (("soft", tarfile.SYMTYPE), ("hard", tarfile.LNKTYPE), ("pipe", tarfile.FIFOTYPE)):
            info = tarfile.TarInfo(f"{name}.urdf")
            info.type, info.linkname = kind, "/etc/passwd"
            archive.addfile(info)
        archive.addfile(tarfile.TarInfo("good.urdf"))
    with unpacked(path) as made:
        assert _files(made.folder) == {"good.urdf": b""}
    link = zipfile.ZipInfo("soft.urdf")
    link.external_attr = 0o120777 << 16
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr(link, "/etc/passwd")
    with unpacked(tmp_path / "a.zip") as made:
        assert _files(made.folder) == {}


def test_the_last_of_two_files_of_one_name_counts(tmp_path: Path) -> None:
    with unpacked(_tar(tmp_path / "a.tar.gz", [("a.urdf", b"one"), ("a.urdf", b"two")])) as made:
        assert _files(made.folder) == {"a.urdf": b"two"}


def test_a_file_where_a_folder_is_needed_is_refused(make: Callable[[Entries], Path]) -> None:
    with pytest.raises(FolderError, match="cannot be unpacked"), unpacked(make([("a", b""), ("a/b.urdf", b"")])):
        pass


@pytest.mark.parametrize("name", ["a.zip", "a.tar", "a.tar.xz"])
@pytest.mark.parametrize("content", [b"", b"no archive at all" * 100])
def test_what_is_no_archive_is_said(name: str, content: bytes, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    assert is_archive(path)
    with pytest.raises(FolderError, match="cannot be unpacked"), unpacked(path):
        pass


def test_a_cut_archive_is_refused(tmp_path: Path) -> None:
    path = _tar(tmp_path / "a.tar.gz", [("a.urdf", os.urandom(100_000))])
    path.write_bytes(path.read_bytes()[:50_000])
    with pytest.raises(FolderError, match="cannot be unpacked"), unpacked(path):
        pass


def test_nothing_is_looked_for_above_an_archive(tmp_path: Path) -> None:
    from twinform.file_access import folders_around  # noqa: PLC0415 - only here

    with unpacked(_tar(tmp_path / "a.tar.gz", [("a/b.urdf", b"")])) as made:
        assert folders_around(made.folder / "a/b.urdf") == (made.folder / "a", made.folder)
