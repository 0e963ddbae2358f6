"""The `<compiler>` sections of MJCF: units, rotation sequences and folders of files, which canonical MJCF has applied.

What only the compiler of MuJoCo can apply, such as `balanceinertia` and `settotalmass`, stays where it is.
"""

from posixpath import basename, isabs, join

from twinform.compiler.input.mjcf.element_findings import ElementFindings, set_line
from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.passes.shared.document_uris import FILES_OF_MJCF
from twinform.schemas import XmlElement

APPLIED = ("autolimits", "coordinate", "eulerseq", "meshdir", "texturedir", "assetdir", "strippath")
"""Attributes of which nothing is left to do in canonical MJCF."""
_USUAL_SEQUENCE = "xyz"
_MESH_FILES = frozenset({"mesh", "hfield", "skin", "flexcomp"})


@dataclass(frozen=True, slots=True)
class CompilerSettings:
    """How the numbers and names of a file are meant."""

    degrees: bool = True
    autolimits: bool = True
    sequence: str = _USUAL_SEQUENCE
    mesh_folder: str = ""
    texture_folder: str = ""
    strip_path: bool = False

    @classmethod
    def of(cls, root: XmlElement) -> "CompilerSettings":
        """Read the settings of a file: of several sections, what stands last counts, wherever it stands."""
        values = {str(name): str(value) for each in root.iterchildren("compiler") for name, value in each.items()}
        folder = values.get("assetdir", "")
        return cls(
            values.get("angle", "degree") == "degree",
            values.get("autolimits", "true") == "true",
            _sequence(values.get("eulerseq", _USUAL_SEQUENCE)),
            values.get("meshdir", folder),
            values.get("texturedir", folder),
            values.get("strippath", "false") == "true",
        )

    def resolve_files(self, element: XmlElement) -> None:
        """Write the names of an asset's files as they are found from the folder of the main file."""
        tag = str(element.tag)
        if tag in _MESH_FILES:
            self._resolve(element, "file", self.mesh_folder)
        elif tag == "texture":
            for name in FILES_OF_MJCF:
                self._resolve(element, name, self.texture_folder)

    def _resolve(self, element: XmlElement, name: str, folder: str) -> None:
        file = element.get(name)
        if not file:
            return
        file = basename(file.replace("\\", "/")) if self.strip_path else file
        element.set(name, file if isabs(file) or not folder else join(folder, file))


def report_sequences(root: XmlElement, findings: ElementFindings) -> None:
    """Report sequences of axes that are none."""
    for section in root.iterchildren("compiler"):
        written = section.get("eulerseq", _USUAL_SEQUENCE)
        if _sequence(written) != written:
            expected = "three letters of x, y, z, X, Y and Z"
            message = f"'eulerseq' is {written!r}; expected {expected}"
            findings.report(rules.INVALID_VALUE, section, message, "@eulerseq", found=written, expected=expected)


def _sequence(text: str) -> str:
    """Return a sequence of axes, or the usual one where a text is none."""
    return text if len(text) == 3 and all(letter in "xyzXYZ" for letter in text) else _USUAL_SEQUENCE


def rewrite_compiler(root: XmlElement) -> None:
    """Write the settings of canonical MJCF into the one section of a tree, first among the sections."""
    section = root.find("compiler")
    if section is None:
        section = root.makeelement("compiler", {})
        set_line(section, root)
        root.insert(0, section)
    for name in APPLIED:
        section.attrib.pop(name, None)
    section.set("angle", "radian")
