"""What do carriers do to other readers of URDF and SDF? Each form of them is put before thirteen readers."""

import os
import tempfile
from collections.abc import Iterable, Iterator
from itertools import product
from pathlib import Path

from lxml import etree

import twinform
from reports.harness.files import SDF_VERSION, converted
from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample, judged_files
from tests.corpus.files import CORPUS, ROOT, CorpusFile, Kind
from tests.engines.readers import READERS, Reader
from tests.engines.readers.judging import Effect, effect, without_carriers
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX

SAMPLE = 25
"""How many corpus files of each kind are converted and read."""
_ABOUT = """\
What a conversion carries stands in elements of the namespace `urn:twinform:1`, which every
other reader is meant to skip. Here readers are asked: each form is put into a small robot, into every kind of element
named, and the reader's verdict and all that it prints are compared with those of the file without it. *Reports that it
skips it* is a line about an unknown element, and nothing else; *reads otherwise* is any other change of what it prints
or returns.

Elements are the form that no reader refuses and none reads otherwise, in either format. An attribute of the namespace
breaks `urdf-usd-converter`; an empty attribute makes libsdformat print an error, so a carried piece has none.
Comments would be silent, but every tool that rewrites a file may drop or move them.

DART reads URDF through urdfdom, and Pinocchio, where it reads SDF, through libsdformat: they are not asked apart.
Gazebo's `gz sdf` is libsdformat."""
_ELEMENT = f"<{PREFIX}:carried xmlns:{PREFIX}='{NAMESPACE}'{{0}}>{{1}}</{PREFIX}:carried>"
_FORMS = {
    "an element": _ELEMENT.format("", ""),
    "with an attribute": _ELEMENT.format(" at='limit'", ""),
    "with `name`": _ELEMENT.format(" name='a'", ""),
    "with `::` in `name`": _ELEMENT.format(" name='a::B'", ""),
    "with text": _ELEMENT.format("", "text"),
    "around elements of URDF": _ELEMENT.format(
        "", "<link name='a'/><joint name='j' type='fixed'/><transmission name='t'/>"
    ),
    "around elements of SDF": _ELEMENT.format(
        "", "<pose relative_to='a'>1 2 3 0 0 0</pose><axis><xyz>1 0 0</xyz></axis>"
    ),
    "around `::` in `name`": _ELEMENT.format("", "<api name='a::B'/>"),
    "around an empty attribute": _ELEMENT.format("", "<material name=''/>"),
    "an attribute": "@",
    "a comment": "<!--carried-->",
    "an instruction": "<?twinform carried?>",
}
_PLACES = {
    ".urdf": (".", "link", "link/inertial", "link/visual", "link/collision", "joint", "joint/limit"),
    ".sdf": ("model", "model/link", ".//inertial", ".//visual", ".//collision", "model/joint", ".//axis", ".//limit"),
}


def measure(sample: Sample) -> Findings:
    """Ask every reader that is here."""
    present = [reader for reader in READERS if reader.present()]
    missing = [f"`{reader.name}` is not here: it needs {reader.needs}" for reader in READERS if reader not in present]
    with tempfile.TemporaryDirectory() as folder:
        forms = [_form_table(present, suffix, Path(folder)) for suffix in _PLACES]
        rows, minded = _corpus(sample, present, Path(folder))
    for reader in present:
        reader.close()
    corpus = section("Converted corpus files", rows if CORPUS.is_dir() else "The corpus is not here.")
    left = [section("Not asked", *missing)] if missing else []
    return Findings([*forms, corpus, *left], "\n".join(missing), minded)


def _form_table(readers: list[Reader], suffix: str, folder: Path) -> str:
    source = ROOT / "examples" / "arm.urdf"
    plain = folder / f"plain{suffix}"
    text = twinform.convert(source, to="sdf", sdf_version=SDF_VERSION, carriers=False).text
    plain.write_bytes(source.read_bytes() if suffix == ".urdf" else text.encode())
    without_carriers(plain, plain)
    asked = [reader for reader in readers if suffix in reader.formats]
    rows = [(name, *(_cell(reader, form, plain, folder) for reader in asked)) for name, form in _FORMS.items()]
    places = ", ".join(f"`{place}`" for place in _PLACES[suffix])
    form_table = table(["form", *(reader.name for reader in asked)], rows)
    return section(f"In {suffix[1:].upper()}", f"In {places}.", form_table)


def _cell(reader: Reader, form: str, plain: Path, folder: Path) -> str:
    """The worst that a form does at any of its places."""
    order, before = list(Effect), reader.ask(plain)
    return max((effect(reader, path, before) for path in _placed(form, plain, folder)), key=order.index).value


def _placed(form: str, plain: Path, folder: Path) -> Iterator[Path]:
    """The file with the form in the first and in all elements of each place, one after the other."""
    for place in _PLACES[plain.suffix]:
        tree = etree.parse(plain)
        for element in tree.iterfind(place) if place != "." else [tree.getroot()]:
            if form == "@":
                element.set(f"{{{NAMESPACE}}}carried", "a")
            else:
                element.append(etree.fromstring(f"<x>{form}</x>")[0])
        output = folder / f"carried{plain.suffix}"
        tree.write(output, xml_declaration=True, encoding="utf-8")
        yield output


def _corpus(sample: Sample, readers: list[Reader], folder: Path) -> tuple[str, list[str]]:
    """A table of effects by reader, and the files that a reader minds."""
    files = [
        path for file in sample.of(_sample()) if (path := converted(file, folder / file.name.replace(os.sep, "+")))
    ]
    counts: dict[tuple[str, str], dict[Effect, int]] = {}
    minded: list[str] = []
    for path, reader in product(files, readers):
        if path.suffix in reader.formats:
            plain = without_carriers(path, folder / f"bare{path.suffix}")
            found = effect(reader, path, reader.ask(plain))
            group = counts.setdefault((path.suffix[1:].upper(), reader.name), dict.fromkeys(Effect, 0))
            group[found] += 1
            if found in {Effect.OTHERWISE, Effect.REFUSED}:
                minded.append(f"{reader.name}: {path.stem}: {found}")
    rows = [(*key, *group.values()) for key, group in sorted(counts.items())]
    return table(["converted to", "reader", *Effect], rows) if rows else "None.", minded


def _sample() -> Iterable[CorpusFile]:
    """So many of each kind, spread over the corpus."""
    files = list(judged_files()) if CORPUS.is_dir() else []
    for urdf in (True, False):
        chosen = [file for file in files if (file.kind is Kind.URDF) is urdf]
        yield from chosen[:: max(1, len(chosen) // SAMPLE)][:SAMPLE]


REPORT = Report("readers", "What carriers do to other readers", _ABOUT, measure, needs=())
